//! Writes scenes of all kinds as glTF into `target/tmp/gltf`, where the Khronos validator checks them (`.ci/run`). The
//! tests in this file check only that this crate and the `gltf` crate can read the files.

use std::path::PathBuf;

use geometry::shapes;
use glam::{DVec2, DVec3, DVec4};
use mesh::{CORNER_NORMAL, CORNER_TANGENT, Domain, MATERIAL, Mesh, UV, VERTEX_NORMAL};
use mesh_io::{Compression, Quantization, WriteOptions};
use scene::{AlphaMode, Image, Material, Object, Scene, Texture};

use crate::gltf_attributes::add_column;
use crate::gltf_materials::{PNG, painted, rich};
use crate::gltf_written::sphere;
use crate::{read, scene, tag};

/// Writes a scene as four files and reads them: a `.glb` file, a `.gltf` file, a quantized file, and a quantized and
/// compressed file.
pub(crate) fn written(name: &str, scene: &Scene) {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("gltf");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("a picture.png"), PNG).unwrap();
    let options = WriteOptions {
        provenance: Some(format!("\"{name}\" \u{1f980}\n\t\\")),
        ..WriteOptions::default()
    };
    for extension in ["glb", "gltf"] {
        let path = folder.join(name).with_extension(extension);
        mesh_io::write(&store::Disk, &path, scene, &options).unwrap();
        let back = read(&path).unwrap();
        assert!(back.objects.len() <= scene.objects().len());
        gltf::Gltf::open(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    }
    let quantized = WriteOptions {
        quantization: Some(Quantization::default()),
        ..options
    };
    let path = folder.join(format!("{name}_quantized.glb"));
    mesh_io::write(&store::Disk, &path, scene, &quantized).unwrap();
    read(&path).unwrap();
    let compressed = WriteOptions {
        compression: Some(Compression::Meshopt),
        ..quantized
    };
    let path = folder.join(format!("{name}_compressed.glb"));
    mesh_io::write(&store::Disk, &path, scene, &compressed).unwrap();
    read(&path).unwrap();
}

fn polygon(points: &[[f64; 2]]) -> Mesh {
    let positions = points.iter().map(|&[x, y]| DVec3::new(x, y, 0.0));
    let all = (0..points.len()).map(|i| u32::try_from(i).unwrap());
    Mesh::from_polygons(positions.collect(), &[all.collect::<Vec<_>>()])
        .unwrap()
        .0
}

#[test]
fn shapes_are_valid() {
    written("none", &scene([]));
    written("empty", &scene([Object::mesh("empty", Mesh::default())]));
    written(
        "empty_and_full",
        &scene([
            Object::mesh("none", Mesh::default()),
            Object::mesh("box", shapes::cube()),
        ]),
    );
    let points = Mesh::from_polygons(vec![DVec3::X, DVec3::Y], &[] as &[Vec<u32>]).unwrap();
    written("points", &scene([Object::mesh("points", points.0)]));
    let positions = vec![DVec3::ONE, DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let isolated = Mesh::from_polygons(positions, &[vec![1, 2, 3]]).unwrap().0;
    written("isolated", &scene([Object::mesh("one", isolated)]));
    let star: Vec<_> = (0..10)
        .map(|i| {
            let (sin, cos) = libm::sincos(f64::from(i) * 0.628);
            let r = if i % 2 == 0 { 2.0 } else { 0.5 };
            [r * cos, r * sin]
        })
        .collect();
    let line = polygon(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]]);
    written(
        "polygons",
        &scene([
            Object::mesh("star", polygon(&star)),
            Object::mesh("line", line),
        ]),
    );
}

#[test]
fn sizes_around_16_bits_are_valid() {
    // For at most 65535 vertices, 16-bit indices are sufficient.
    for (columns, rows) in [(254, 256), (255, 255), (279, 249)] {
        let mesh = shapes::grid(columns, rows);
        written(
            &format!("grid_{}", mesh.n_vertices()),
            &scene([Object::mesh("grid", mesh)]),
        );
    }
}

#[test]
fn positions_of_every_size_are_valid() {
    let largest = f64::from(f32::MAX);
    let smallest = f64::from(f32::from_bits(1));
    for (i, size) in [
        largest,
        -largest,
        1e30,
        1e-30,
        smallest,
        1e-46,
        1.0 / 3.0,
        16_777_217.1,
    ]
    .into_iter()
    .enumerate()
    {
        let mut mesh = shapes::cube();
        for p in mesh.positions_mut() {
            *p *= size / p.abs().max_element();
        }
        written(&format!("size_{i}"), &scene([Object::mesh("box", mesh)]));
    }
    let mut mixed = shapes::octahedron();
    for (i, p) in mixed.positions_mut().iter_mut().enumerate() {
        *p = DVec3::new(-0.0, smallest * i as f64, largest / (i + 1) as f64);
    }
    written("sizes", &scene([Object::mesh("mixed", mixed)]));
}

#[test]
fn attributes_are_valid() {
    let mut mesh = sphere();
    let (n, n_corners) = (mesh.n_vertices(), mesh.n_half_edges());
    let (n_edges, n_faces) = (mesh.n_edges(), mesh.n_faces());
    let corner = |i: usize| DVec2::new(i as f64 / 7.0, 1e6 / (i + 1) as f64);
    for set in 1..9 {
        let uvs: Vec<_> = (0..n_corners).map(|i| corner(i + set)).collect();
        add_column(&mut mesh, Domain::Corner, &format!("uv{set}"), uvs);
    }
    let odd = [
        0.0,
        -0.0,
        1e-45,
        3.4e38,
        -2.5,
        1e300,
        f64::NAN,
        f64::INFINITY,
    ];
    let numbers = || (0..n).map(|i| odd[i % odd.len()]);
    for name in [
        "Quality",
        "é 2",
        "_",
        "uv_1",
        "POSITION",
        "a\"b\\c\n",
        "🦀",
        "joints_0",
        "TEXCOORD_0",
    ] {
        add_column(&mut mesh, Domain::Vertex, name, numbers().collect());
    }
    add_column(
        &mut mesh,
        Domain::Vertex,
        "two",
        numbers().map(DVec2::splat).collect(),
    );
    add_column(
        &mut mesh,
        Domain::Vertex,
        "three",
        numbers().map(DVec3::splat).collect(),
    );
    add_column(
        &mut mesh,
        Domain::Vertex,
        "four",
        numbers().map(DVec4::splat).collect(),
    );
    add_column(&mut mesh, Domain::Corner, "stress", vec![0.5; n_corners]);
    add_column(&mut mesh, Domain::Edge, "length", vec![0.5; n_edges]);
    add_column(&mut mesh, Domain::Face, "area", vec![0.5; n_faces]);
    add_column(&mut mesh, Domain::Face, "count", vec![1_i32; n_faces]);
    tag(&mut mesh, Domain::Face, "picked", vec![true; n_faces]);
    tag(&mut mesh, Domain::Vertex, "fixed", vec![true; n]);
    mesh.set(mesh::CREASE, vec![1.0; n_edges]);
    mesh.set(mesh::TANGENT, vec![DVec3::X; n]);
    mesh.set(mesh::COLOR, numbers().map(DVec4::splat).collect());
    let normals = (0..n_corners).map(|i| DVec3::AXES[i % 3] * odd[i % 5]);
    mesh.set(CORNER_NORMAL, normals.collect());
    let tangents = (0..n_corners).map(|i| (DVec3::AXES[i % 3] * odd[i % 5]).extend(odd[i % 8]));
    mesh.set(CORNER_TANGENT, tangents.collect());
    written("attributes", &scene([Object::mesh("ball", mesh)]));

    let mut mesh = shapes::octahedron();
    let normals = mesh.positions().iter().map(|p| *p * 1e-200).collect();
    mesh.set(VERTEX_NORMAL, normals);
    written("normals", &scene([Object::mesh("small normals", mesh)]));
}

#[test]
fn materials_and_names_are_valid() {
    let file = |path: &str| Texture {
        image: Image::File(path.into()),
        ..Texture::new(Image::File(path.into()))
    };
    // The mesh has no tangents, and the validator warns about normal textures on meshes without tangents.
    let rich = || Material {
        normal_texture: None,
        normal_scale: 1.0,
        ..rich()
    };
    let unlit = Material {
        unlit: true,
        ..rich()
    };
    let from_file = Material {
        base_color_texture: Some(file("a picture.png")),
        emissive_texture: Some(file("./a picture.png")),
        alpha: AlphaMode::Blend,
        ..Material::new("")
    };
    let broken = Material {
        base_color: [f64::NAN, 2.0, -1.0, 1e300],
        metallic: 2.0,
        roughness: -1.0,
        emissive: [9.0; 3],
        emissive_strength: f64::INFINITY,
        alpha: AlphaMode::Mask(-3.0),
        ..Material::new("é \"\\ \u{1f980} \n")
    };
    written(
        "materials",
        &scene([
            painted("a", rich()),
            painted("b", rich()),
            painted("unlit", unlit),
            painted("file", from_file.clone()),
            painted("broken", broken.clone()),
        ]),
    );
    let mut mesh = shapes::cube();
    mesh.set(MATERIAL, vec![0, 1, 2, 3, -1, 70]);
    mesh.set(UV, vec![DVec2::new(0.25, 0.75); mesh.n_half_edges()]);
    let names = ["a/b", "é \u{1f980}", "\"quoted\" \\ \n\u{1}", " ", "CON"];
    written(
        "names and é",
        &scene(names.map(|name| Object {
            materials: vec![
                from_file.clone(),
                rich(),
                broken.clone(),
                Material::new("unused"),
            ],
            ..Object::mesh(name, mesh.clone())
        })),
    );
}
