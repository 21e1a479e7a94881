//! Tests of written glTF files. The `gltf` crate reads and validates the files, and this crate also reads them.

use geometry::shapes;
use glam::{DVec2, DVec3, DVec4};
use mesh::{CORNER_NORMAL, Domain, MATERIAL, Mesh, UV, VERTEX_NORMAL};
use mesh_io::{PeekGeometry, ReadOptions, WriteOptions};
use scene::{AlphaMode, Geometry, Material, Object};
use serde_json::Value;

use crate::{Folder, assert_same, only, read, scene, tag, write};

/// A triangulated sphere with texture seams.
pub(crate) fn sphere() -> Mesh {
    let mut mesh = shapes::icosahedron();
    for p in mesh.positions_mut() {
        *p = p.as_vec3().as_dvec3();
    }
    let mut uvs = vec![DVec2::ZERO; mesh.n_half_edges()];
    for f in mesh.faces() {
        for h in mesh.face_half_edges(f) {
            let p = mesh.position(mesh.origin(h));
            let wraps = mesh.face_center(f).x < 0.0 && p.y < 0.0;
            let u = if wraps { 0.75 } else { 0.25 };
            uvs[h.index()] = DVec2::new(u, if p.z > 0.0 { 0.5 } else { 0.125 });
        }
    }
    mesh.set(UV, uvs);
    mesh
}

type Corner = ([f32; 3], Option<[f32; 2]>);

/// Returns the content of a file according to the `gltf` crate: for each object, the positions and the texture
/// coordinates of the corners of its triangles. Here, v points down.
fn read_by_gltf_crate(path: &std::path::Path) -> Vec<(String, Vec<Corner>)> {
    let file = gltf::Gltf::open(path).unwrap();
    let mut objects = Vec::new();
    for node in file.scenes().next().unwrap().nodes() {
        let mut corners = Vec::new();
        for primitive in node.mesh().into_iter().flat_map(|mesh| mesh.primitives()) {
            let reader = primitive.reader(|_| file.blob.as_deref());
            let positions: Vec<_> = reader.read_positions().unwrap().collect();
            let uvs: Option<Vec<_>> = reader
                .read_tex_coords(0)
                .map(|uvs| uvs.into_f32().collect());
            for normal in reader.read_normals().into_iter().flatten() {
                let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
                assert!((length - 1.0).abs() < 1e-6);
            }
            let indices = reader.read_indices().unwrap().into_u32();
            let corner = |i: u32| {
                (
                    positions[i as usize],
                    uvs.as_ref().map(|uvs| uvs[i as usize]),
                )
            };
            corners.extend(indices.map(corner));
        }
        objects.push((node.name().unwrap().to_owned(), corners));
    }
    objects
}

#[test]
fn another_reader_finds_the_same_triangles() {
    let folder = Folder::new();
    let path = folder.path("a.glb");
    let mesh = sphere();
    write(
        &path,
        [
            Object::mesh("ball", mesh.clone()),
            Object::mesh("box", shapes::cube()),
        ],
    );

    let found = read_by_gltf_crate(&path);
    assert_eq!(found.len(), 2);
    assert_eq!((found[1].0.as_str(), found[1].1.len()), ("box", 36));
    let corners = mesh.faces().flat_map(|f| mesh.face_half_edges(f));
    let expected: Vec<_> = corners
        .map(|h| {
            let uv = mesh.get(UV).unwrap()[h.index()];
            let position = mesh.position(mesh.origin(h)).as_vec3().to_array();
            (
                position,
                Some(DVec2::new(uv.x, 1.0 - uv.y).as_vec2().to_array()),
            )
        })
        .collect();
    assert_eq!(found[0], ("ball".to_owned(), expected));
}

#[test]
fn triangles_with_seams_and_materials_survive_a_round_trip() {
    for name in ["a.glb", "with blank é.gltf"] {
        let folder = Folder::new();
        let path = folder.path(name);
        let mut mesh = sphere();
        let mut normals = vec![DVec3::ZERO; mesh.n_half_edges()];
        for h in mesh.half_edges().filter(|&h| mesh.face(h).is_some()) {
            let axis = mesh.face(h).unwrap().index() % 3;
            normals[h.index()] = DVec3::AXES[axis];
        }
        mesh.set(CORNER_NORMAL, normals);
        let n = mesh.n_vertices();
        mesh.set(
            mesh::COLOR,
            (0..n)
                .map(|i| DVec4::new(0.5, 0.25, 1.0, (i % 2) as f64))
                .collect(),
        );
        // The writer orders faces by material. The faces of this mesh already have this order, so writing does not
        // change it.
        mesh.set(MATERIAL, (0..20).map(|i| i / 8 - 1).collect());
        let materials = vec![
            Material {
                base_color: [0.8, 0.1, 0.3, 0.5],
                alpha: AlphaMode::Blend,
                ..Material::new("glass")
            },
            Material {
                metallic: 0.7,
                roughness: 0.2,
                ..Material::new("steel")
            },
        ];
        let object = Object {
            materials,
            ..Object::mesh("thing", mesh)
        };
        let report = write(&path, [object.clone()]);
        assert_eq!(report.losses, []);
        let back = only(&path);
        assert_same(back.as_mesh().unwrap(), object.as_mesh().unwrap());
        assert_eq!((back.name, back.materials), (object.name, object.materials));
    }
}

#[test]
fn vertex_normals_stay_on_vertices() {
    let folder = Folder::new();
    let path = folder.path("a.glb");
    let mut mesh = shapes::octahedron();
    mesh.set(VERTEX_NORMAL, mesh.positions().to_vec());
    write(&path, [Object::mesh("a", mesh.clone())]);
    assert_same(only(&path).as_mesh().unwrap(), &mesh);
}

#[test]
fn normals_of_32_bits_are_written_unchanged() {
    // Dividing this normal by its length would change the last digit of z each time the file is written.
    let normal = DVec3::new(
        -0.725_670_099_258_422_9,
        0.688_042_759_895_324_7,
        -7.422_940_143_442_247e-6,
    );
    let mut mesh = shapes::tetrahedron();
    mesh.set(VERTEX_NORMAL, vec![normal; 4]);
    let folder = Folder::new();
    let path = folder.path("a.glb");
    write(&path, [Object::mesh("a", mesh.clone())]);
    let back = only(&path);
    assert_eq!(
        back.as_mesh().unwrap().get(VERTEX_NORMAL),
        mesh.get(VERTEX_NORMAL)
    );
}

#[test]
fn content_that_gltf_cannot_store_is_counted() {
    let folder = Folder::new();
    let path = folder.path("a.glb");
    let positions = vec![DVec3::ZERO, DVec3::X, DVec3::ONE, DVec3::Y, DVec3::Z];
    let (mut mesh, _) = Mesh::from_polygons(positions, &[vec![0, 1, 2, 3]]).unwrap();
    mesh.set(mesh::CREASE, vec![1.0; 4]);
    mesh.set(mesh::SMOOTHING, vec![1]);
    mesh.set(VERTEX_NORMAL, vec![DVec3::ZERO; 5]);
    mesh.set(mesh::COLOR, vec![DVec4::splat(2.0); 5]);
    mesh.set(MATERIAL, vec![3]);
    tag(&mut mesh, Domain::Face, "side", vec![true]);
    let object = Object {
        materials: vec![Material::new("paint")],
        ..Object::mesh("a", mesh)
    };
    let report = write(&path, [object]);
    let lost: Vec<_> = report
        .losses
        .iter()
        .map(|l| (l.attribute.as_str(), l.count))
        .collect();
    let expected = [
        ("crease", 4),
        ("side", 1),
        ("smoothing", 1),
        ("normal", 4),
        ("color", 4),
        ("position", 1),
        ("polygon", 1),
        ("material", 1),
        ("paint", 1),
    ];
    assert_eq!(lost, expected);
    assert_eq!(read_by_gltf_crate(&path)[0].1.len(), 6);
}

#[test]
fn empty_meshes_and_scenes_can_be_written() {
    let folder = Folder::new();
    let path = folder.path("a.glb");
    assert_eq!(
        write(&path, [Object::mesh("none", Mesh::default())])
            .losses
            .len(),
        1
    );
    assert!(read(&path).unwrap().objects.is_empty());
    write(&path, []);
    assert!(read(&path).unwrap().objects.is_empty());
}

#[test]
fn positions_outside_of_the_32_bit_range_are_refused() {
    let mut mesh = shapes::square();
    mesh.positions_mut()[1].x = 1e300;
    let folder = Folder::new();
    let scene = scene([Object::mesh("far", mesh)]);
    let error = mesh_io::write(
        &store::Disk,
        &folder.path("a.glb"),
        &scene,
        &WriteOptions::default(),
    )
    .unwrap_err();
    assert!(
        error
            .to_string()
            .contains("of the vertex v1 exceeds the range of the 32-bit floats of glTF"),
        "{error}"
    );
    assert_eq!(folder.count(), 0);
}

#[test]
fn generator_and_provenance_are_in_the_asset() {
    let folder = Folder::new();
    let path = folder.path("a.gltf");
    let options = WriteOptions {
        provenance: Some("recipe \"x\"".into()),
        ..WriteOptions::default()
    };
    mesh_io::write(
        &store::Disk,
        &path,
        &scene([Object::mesh("a", shapes::cube())]),
        &options,
    )
    .unwrap();
    let json: Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    assert!(
        json["asset"]["generator"]
            .as_str()
            .unwrap()
            .starts_with("meshwright ")
    );
    assert_eq!(json["asset"]["extras"]["meshwright"], "recipe \"x\"");
    assert_eq!(json["buffers"][0]["uri"], "a.bin");
}

#[test]
fn large_meshes_get_32_bit_indices() {
    let folder = Folder::new();
    let path = folder.path("a.glb");
    for n in [254, 255] {
        // 255 x 256 = 65280 vertices get 16-bit indices. 256 x 256 vertices would need the index 65535, which has a
        // special meaning in 16-bit indices.
        let mesh = shapes::grid(n, 255);
        write(&path, [Object::mesh("a", mesh.clone())]);
        let document = gltf::Gltf::open(&path).unwrap();
        let indices = document
            .meshes()
            .next()
            .unwrap()
            .primitives()
            .next()
            .unwrap()
            .indices();
        let short = indices.unwrap().data_type() == gltf::accessor::DataType::U16;
        assert_eq!(short, n == 254);
        assert_eq!(read_by_gltf_crate(&path)[0].1.len(), 6 * mesh.n_faces());
    }
}

#[test]
fn peeking_reads_only_the_document() {
    let folder = Folder::new();
    for name in ["a.glb", "a.gltf"] {
        let path = folder.path(name);
        write(
            &path,
            [
                Object::mesh("ball", sphere()),
                Object::mesh("box", shapes::cube()),
            ],
        );
        let peek = mesh_io::peek(&store::Disk, &path, &ReadOptions::default()).unwrap();
        let counts: Vec<_> = peek
            .objects
            .iter()
            .map(|object| match object.geometry {
                PeekGeometry::Mesh(mesh) => {
                    (object.name.as_str(), mesh.vertices, mesh.faces, mesh.uvs)
                }
                other => panic!("{other:?}"),
            })
            .collect();
        assert_eq!(counts[1], ("box", 8, 12, false));
        assert_eq!((counts[0].2, counts[0].3), (20, true));
    }
    // Peeking also works if the end of the binary part of the file is missing.
    let whole = std::fs::read(folder.path("a.glb")).unwrap();
    let cut = folder.with("cut.glb", &whole[..whole.len() - 100]);
    assert!(mesh_io::peek(&store::Disk, &cut, &ReadOptions::default()).is_ok());
    assert!(read(&cut).is_err());
}

#[test]
fn patches_are_refused() {
    let folder = Folder::new();
    let scene = scene([Object::new("p", Geometry::Patches(Vec::new()))]);
    for name in ["a.glb", "a.gltf"] {
        assert!(
            mesh_io::write(
                &store::Disk,
                &folder.path(name),
                &scene,
                &WriteOptions::default()
            )
            .is_err()
        );
    }
}
