//! Compares small pictures with golden files, pixel by pixel.
//!
//! If the environment variable `MESHWRIGHT_UPDATE` is set, the files in `tests/goldens` are written instead. Look at
//! the files before you commit them.

use std::path::PathBuf;

use geometry::shapes;
use mesh::{CREASE, DVec3, DVec4, Domain, EdgeId, FaceId, Mesh, VertexId};
use render::{
    Background, Camera, Color, ColorMap, Coloring, Elements, Highlight, Image, Lines, Overlays,
    Projection, Shading, Side, Style, Up, picture,
};
use scene::{Geometry, Material, Object, Scene, Texture};

const SIZE: [u32; 2] = [64, 64];

/// The memory budget of a picture, in bytes.
const BUDGET: u64 = 1 << 30;

fn scene(objects: impl IntoIterator<Item = Object>) -> Scene {
    let mut scene = Scene::new();
    for object in objects {
        scene.insert(object).unwrap();
    }
    scene
}

fn mesh(mesh: Mesh) -> Scene {
    scene([Object::mesh("a", mesh)])
}

fn from(side: Side) -> Camera {
    Camera::Fit {
        from: side,
        up: Up::Z,
        projection: Projection::default(),
        margin: 0.05,
        steady: false,
    }
}

#[expect(clippy::unnecessary_wraps, reason = "a field of a style")]
fn lines(width: f64, color: Color, hidden: f64) -> Option<Lines> {
    Some(Lines {
        width,
        color,
        hidden,
    })
}

/// Encodes an image of four pixels: red, green, blue and white.
fn checker() -> Vec<u8> {
    let image = Image {
        width: 2,
        height: 2,
        pixels: vec![
            [255, 0, 0, 255],
            [0, 255, 0, 255],
            [0, 0, 255, 255],
            [255; 4],
        ],
    };
    image.to_png(&[]).unwrap()
}

/// Draws a picture and compares it with its golden file.
#[track_caller]
fn golden(name: &str, scene: &Scene, camera: &Camera, style: &Style, overlays: &Overlays) {
    let mut images = |path: &str| (path == "checker.png").then(checker);
    let (rendered, missing) =
        picture(scene, camera, style, overlays, SIZE, BUDGET, &mut images).unwrap();
    assert!(missing.is_empty(), "{missing:?}");
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("tests/goldens")
        .join(name)
        .with_extension("png");
    if std::env::var_os("MESHWRIGHT_UPDATE").is_some() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, rendered.image.to_png(&[]).unwrap()).unwrap();
    }
    let file = std::fs::File::open(&path).unwrap();
    let mut decoder = png::Decoder::new(std::io::BufReader::new(file));
    decoder.set_transformations(png::Transformations::ALPHA);
    let mut reader = decoder.read_info().unwrap();
    let mut expected = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut expected).unwrap();
    let found = rendered.image.pixels.as_flattened();
    assert_eq!(expected.len(), found.len(), "the sizes differ");
    let differing = expected
        .chunks(4)
        .zip(found.chunks(4))
        .filter(|(a, b)| a != b);
    let n = differing.count();
    assert!(n == 0, "{n} pixels differ from {}", path.display());
}

#[test]
fn a_flat_icosahedron() {
    let style = Style {
        shading: Shading::Flat,
        wireframe: lines(1.0, Color::rgb(20, 20, 20), 0.2),
        ..Style::default()
    };
    let camera = from(Side::ThreeQuarter);
    golden(
        "flat_icosahedron",
        &mesh(shapes::icosahedron()),
        &camera,
        &style,
        &Overlays::default(),
    );
}

#[test]
fn a_smooth_cylinder_has_sharp_rims() {
    let camera = from(Side::ThreeQuarter);
    let cylinder = mesh(shapes::cylinder(20, true));
    golden(
        "smooth_cylinder",
        &cylinder,
        &camera,
        &Style::default(),
        &Overlays::default(),
    );
}

#[test]
fn an_open_cylinder_shows_its_back_and_its_boundary() {
    let style = Style {
        boundary: lines(2.0, Color::rgb(190, 30, 60), 0.4),
        shading: Shading::Phong,
        ..Style::default()
    };
    let camera = from(Side::ThreeQuarter);
    golden(
        "open_cylinder",
        &mesh(shapes::cylinder(20, false)),
        &camera,
        &style,
        &Overlays::default(),
    );
}

#[test]
fn a_torus_of_clay_with_a_transparent_background() {
    let style = Style {
        shading: Shading::Matcap,
        background: Background::Transparent,
        ..Style::default()
    };
    let torus = mesh(shapes::torus(32, 16, 1.0, 0.4));
    golden(
        "clay_torus",
        &torus,
        &from(Side::Isometric),
        &style,
        &Overlays::default(),
    );
}

#[test]
fn numbers_are_shown_as_colors() {
    let torus = shapes::torus(32, 16, 1.0, 0.4);
    let values = torus.positions().iter().map(|p| p.z).collect();
    let overlays = Overlays {
        colorings: vec![Coloring {
            object: "a".into(),
            domain: Domain::Vertex,
            values,
            map: ColorMap::Diverging,
            range: [-0.4, 0.4],
        }],
        ..Overlays::default()
    };
    golden(
        "colors",
        &mesh(torus),
        &from(Side::Isometric),
        &Style::default(),
        &overlays,
    );
}

#[test]
fn highlights_creases_normals_and_points() {
    let mut cube = shapes::cube();
    let mut creases = vec![0.0; cube.n_edges()];
    (creases[0], creases[1]) = (10.0, 3.0);
    cube.set(CREASE, creases);
    let highlight = |elements, size| Highlight {
        object: "a".into(),
        elements,
        color: Color::rgb(230, 159, 0),
        size,
        hidden: 0.3,
    };
    let overlays = Overlays {
        highlights: vec![
            highlight(Elements::Faces(vec![FaceId::new(0), FaceId::new(3)]), 0.0),
            highlight(Elements::Edges(vec![EdgeId::new(5)]), 3.0),
            highlight(
                Elements::Vertices(vec![VertexId::new(6), VertexId::new(99)]),
                7.0,
            ),
        ],
        ..Overlays::default()
    };
    let style = Style {
        creases: lines(1.5, Color::rgb(0, 114, 178), 0.3),
        normals: Some(0.3),
        points: Some(3.0),
        ..Style::default()
    };
    golden(
        "highlights",
        &mesh(cube),
        &from(Side::Isometric),
        &style,
        &overlays,
    );
}

#[test]
fn patches_curves_and_polylines() {
    let patch = bezier::Patch::new(std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let bump = if (1..3).contains(&i) && (1..3).contains(&j) {
                1.5
            } else {
                0.0
            };
            DVec3::new(i as f64 - 1.5, j as f64 - 1.5, bump)
        })
    }));
    let points = [[-1.5, -1.5], [-1.0, 1.0], [1.0, -2.0], [1.5, 1.5]];
    let curve = bezier::Curve::new(points.map(mesh::DVec2::from).to_vec());
    let line = vec![
        DVec3::new(-1.5, 1.5, 0.0),
        DVec3::new(0.0, 0.0, 2.0),
        DVec3::new(1.5, -1.5, 0.0),
    ];
    let object = |name: &str, geometry| Object {
        name: name.into(),
        geometry,
        materials: Vec::new(),
    };
    let scene = scene([
        object("patch", Geometry::Patches(vec![patch.unwrap()])),
        object("curve", Geometry::Curve(curve.unwrap())),
        object("line", Geometry::Polylines(vec![line])),
    ]);
    let style = Style {
        control_nets: lines(1.0, Color::rgb(190, 60, 40), 0.2),
        curve_width: 2.0,
        ..Style::default()
    };
    golden(
        "patch",
        &scene,
        &from(Side::ThreeQuarter),
        &style,
        &Overlays::default(),
    );
}

#[test]
fn textures_materials_and_vertex_colors() {
    let textured = |name: &str, mut mesh: Mesh, offset: f64| {
        for p in mesh.positions_mut() {
            p.x += offset;
        }
        let uvs = mesh.half_edges().map(|h| {
            let p = mesh.position(mesh.origin(h));
            mesh::DVec2::new(p.x - offset, p.y)
        });
        let uvs = uvs.collect();
        mesh.set(mesh::UV, uvs);
        let n = mesh.n_faces();
        mesh.set(mesh::MATERIAL, vec![0; n]);
        Object::mesh(name, mesh)
    };
    let mut material = Material::new("checker");
    material.base_color_texture = Some(Texture::file("checker.png"));
    let mut glass = Material::new("glass");
    glass.base_color = [0.1, 0.6, 0.2, 0.5];
    glass.alpha = scene::AlphaMode::Blend;
    let mut colored = shapes::square();
    for p in colored.positions_mut() {
        *p += DVec3::new(0.2, 1.1, 0.0);
    }
    let colors = [0.1, 0.3, 0.6, 1.0].map(|c| DVec4::new(c, 1.0 - c, 0.5, 1.0));
    colored.set(mesh::COLOR, colors.to_vec());
    let scene = scene([
        Object {
            materials: vec![material],
            ..textured("a", shapes::square(), 0.0)
        },
        Object {
            materials: vec![glass],
            ..textured("b", shapes::square(), 0.6)
        },
        Object::mesh("c", colored),
    ]);
    let style = Style {
        shading: Shading::Plain,
        ..Style::default()
    };
    golden(
        "materials",
        &scene,
        &from(Side::Top),
        &style,
        &Overlays::default(),
    );
}

#[test]
fn a_concave_face_is_one_surface() {
    // The polygon has the shape of an L. The rest of its bounding box stays white.
    let points = [[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]];
    let points = points.map(|[x, y]| DVec3::new(f64::from(x), f64::from(y), 0.0));
    let (mesh, _) = Mesh::from_polygons(points.to_vec(), &[[0, 1, 2, 3, 4, 5]]).unwrap();
    let style = Style {
        wireframe: lines(1.5, Color::rgb(0, 0, 0), 0.0),
        ..Style::default()
    };
    golden(
        "concave",
        &self::mesh(mesh),
        &from(Side::Top),
        &style,
        &Overlays::default(),
    );
}
