//! The scenes on which every operation is tested. The first mesh of a scene has the name "mesh", and the second mesh
//! has the name "other", because the sample parameters of operations refer to these names.

use bezier::Curve;
use geometry::shapes;
use glam::{DVec2, DVec3, DVec4};
use mesh::{
    COLOR, CORNER_NORMAL, CREASE, Column, Domain, MATERIAL, Mesh, Rule, SMOOTHING, UV,
    VERTEX_NORMAL, Values,
};
use scene::{Geometry, Material, Object, Scene};

/// Returns every test scene with its name.
pub(crate) fn scenes() -> Vec<(&'static str, Scene)> {
    let mut scenes: Vec<_> = meshes()
        .into_iter()
        .map(|(name, mesh)| (name, one(Object::mesh("mesh", mesh))))
        .collect();
    scenes.push(("no objects", Scene::new()));
    scenes.push((
        "squares with attributes",
        one(with_attributes(shapes::grid(4, 3))),
    ));
    scenes.push((
        "triangles with attributes",
        one(with_attributes(shapes::fans(&shapes::grid(4, 3)))),
    ));
    scenes.push(("patches", one(Object::new("patches", teapot()))));
    scenes.push(("curve", one(Object::new("curve", curve()))));
    scenes.push(("everything", everything()));
    scenes
}

/// Returns the meshes of the test scenes that consist of one mesh without attributes.
pub(crate) fn meshes() -> Vec<(&'static str, Mesh)> {
    vec![
        ("nothing", Mesh::default()),
        ("one triangle", one_triangle()),
        ("open grid", shapes::grid(3, 2)),
        ("cube", shapes::cube()),
        ("cube of triangles", shapes::fans(&shapes::cube())),
        ("tetrahedron", shapes::tetrahedron()),
        ("torus", shapes::torus(8, 6, 2.0, 1.0)),
        (
            "large torus of triangles",
            shapes::fans(&shapes::torus(90, 60, 2.0, 1.0)),
        ),
        ("two components", two_components()),
        ("bow-tie vertex", bow_tie()),
        ("two cubes at one vertex", two_cubes()),
        ("cylinder of 5 sides", shapes::cylinder(5, true)),
        ("cylinder of 7 sides", shapes::cylinder(7, true)),
        ("isolated vertices", isolated_vertices()),
        ("no area", no_area()),
        ("pillow", pillow()),
    ]
}

/// Returns the faces of a mesh as lists of vertex ids, in order.
fn polygons(mesh: &Mesh) -> Vec<Vec<u32>> {
    let number = |v: mesh::VertexId| u32::try_from(v.index()).expect("ids have 32 bits");
    mesh.faces()
        .map(|f| mesh.face_vertices(f).map(number).collect())
        .collect()
}

/// Adds attributes of every domain, type and rule, UV seams and two materials to a mesh.
pub(crate) fn with_attributes(mut mesh: Mesh) -> Object {
    let (n_vertices, n_edges, n_faces) = (mesh.n_vertices(), mesh.n_edges(), mesh.n_faces());
    let corner = |h: mesh::HalfEdgeId| {
        let place = mesh.position(mesh.origin(h)).truncate();
        // Every fourth face has separate texture coordinates.
        match mesh.face(h) {
            Some(f) if f.index() % 4 == 3 => place + DVec2::new(10.0, 0.0),
            Some(_) => place,
            None => DVec2::ZERO,
        }
    };
    let uvs = mesh.half_edges().map(corner).collect();
    mesh.set(UV, uvs);
    mesh.set(CORNER_NORMAL, vec![DVec3::Z; 2 * n_edges]);
    mesh.set(VERTEX_NORMAL, vec![DVec3::Z; n_vertices]);
    let shade = |i: usize| DVec4::new(i as f64 / n_vertices as f64, 0.5, 0.25, 1.0);
    mesh.set(COLOR, (0..n_vertices).map(shade).collect());
    mesh.set(CREASE, (0..n_edges).map(|e| (e % 3) as f64).collect());
    mesh.set(MATERIAL, (0..n_faces).map(|f| [0, 1, -1][f % 3]).collect());
    mesh.set(SMOOTHING, vec![1; n_faces]);
    for domain in Domain::ALL {
        // Each corner has a value that depends only on its vertex, so that corner attributes add no seams.
        let sources: Vec<usize> = match domain {
            Domain::Corner => mesh.half_edges().map(|h| mesh.origin(h).index()).collect(),
            _ => (0..mesh.domain_len(domain)).collect(),
        };
        let n = sources.len();
        let number = |&i: &usize| i32::try_from(i).expect("a small mesh");
        let tag = Values::Tag(sources.iter().map(|i| i % 2 == 0).collect());
        let count = Values::Int(sources.iter().map(number).collect());
        for (name, rule, values) in [
            ("marked", Rule::Copy, tag),
            ("count", Rule::Copy, count),
            ("passing", Rule::Drop, Values::Float(vec![0.5; n])),
        ] {
            let name = name.to_owned();
            mesh.insert_column(domain, Column { name, rule, values });
        }
    }
    let mut object = Object::mesh("mesh", mesh);
    object.materials = vec![Material::new("clay"), Material::new("glaze")];
    object
}

fn one(object: Object) -> Scene {
    let mut scene = Scene::new();
    scene.insert(object).expect("the first object");
    scene
}

/// Returns a scene with an object of each kind, and two meshes.
fn everything() -> Scene {
    let lines = vec![
        vec![DVec3::ZERO, DVec3::X, DVec3::ONE],
        vec![DVec3::Y, DVec3::Z],
    ];
    let mut scene = Scene::new();
    for object in [
        Object::mesh("mesh", shapes::octahedron()),
        with_attributes_as("other", shapes::fans(&shapes::cube())),
        Object::new("patches", teapot()),
        Object::new("curve", curve()),
        Object::new("lines", Geometry::Polylines(lines)),
    ] {
        scene.insert(object).expect("the names differ");
    }
    scene
}

fn with_attributes_as(name: &str, mesh: Mesh) -> Object {
    let mut object = with_attributes(mesh);
    name.clone_into(&mut object.name);
    object
}

fn teapot() -> Geometry {
    let path = crate::root().join("scenes/assets/teapot.bez");
    let loaded =
        mesh_io::read(&store::Disk, &path, &mesh_io::ReadOptions::default()).expect("the teapot");
    let [object] = &loaded.objects[..] else {
        panic!("the teapot is one object");
    };
    object.geometry.clone()
}

fn curve() -> Geometry {
    let points = [(0.0, 0.0), (1.0, 3.0), (3.0, 4.0), (5.0, 1.0)];
    let points = points.map(|(x, y)| DVec2::new(x, y)).to_vec();
    Geometry::Curve(Curve::new(points).expect("four points are a curve"))
}

fn one_triangle() -> Mesh {
    of(vec![DVec3::ZERO, DVec3::X, DVec3::Y], &[[0, 1, 2]])
}

fn two_components() -> Mesh {
    let (a, b) = (shapes::tetrahedron(), shapes::octahedron());
    let mut positions = a.positions().to_vec();
    positions.extend(b.positions().iter().map(|&p| p + DVec3::new(5.0, 0.0, 0.0)));
    let mut faces = polygons(&a);
    let shifted = |face: Vec<u32>| face.into_iter().map(|v| v + 4).collect();
    faces.extend(polygons(&b).into_iter().map(shifted));
    of(positions, &faces)
}

/// Returns two triangles that share a vertex. Building the mesh splits the common vertex.
fn bow_tie() -> Mesh {
    let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let positions = vec![
        at(0., 0.),
        at(1., -1.),
        at(1., 1.),
        at(-1., 1.),
        at(-1., -1.),
    ];
    of(positions, &[[0, 1, 2], [0, 3, 4]])
}

/// Returns two closed cubes that share a vertex. Building the mesh splits the common vertex.
fn two_cubes() -> Mesh {
    let cube = shapes::cube();
    let mut positions = cube.positions().to_vec();
    // Vertex 7 of the first cube is vertex 0 of the second.
    let others = cube.positions().iter().skip(1);
    positions.extend(others.map(|&p| p + DVec3::splat(2.0)));
    let mut faces = polygons(&cube);
    let shifted = |v: u32| v + 7;
    faces.extend(
        polygons(&cube)
            .into_iter()
            .map(|face| face.into_iter().map(shifted).collect()),
    );
    of(positions, &faces)
}

fn isolated_vertices() -> Mesh {
    let positions = [5.0, 0.0, 1.0, 7.0, 0.0].map(|x| DVec3::new(x, x * x, 0.0));
    of(positions.to_vec(), &[[1, 2, 0]])
}

/// Returns triangles that degenerate to a segment or to a point.
fn no_area() -> Mesh {
    let x = |x: f64| DVec3::new(x, 0.0, 0.0);
    let positions = vec![x(0.0), x(1.0), x(2.0), x(0.0), x(0.0), x(0.0)];
    of(positions, &[[0, 1, 2], [2, 1, 3], [3, 4, 5]])
}

/// Returns two triangles with the same vertices and opposite orientations.
fn pillow() -> Mesh {
    let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
    of(positions, &[[0, 1, 2], [0, 2, 1]])
}

fn of(positions: Vec<DVec3>, faces: &[impl AsRef<[u32]> + Sync]) -> Mesh {
    let (mesh, _) = Mesh::from_polygons(positions, faces).expect("the faces use existing points");
    mesh
}

#[test]
fn every_fixture_is_valid() {
    for (name, scene) in scenes() {
        for mesh in scene.objects().iter().filter_map(Object::as_mesh) {
            assert_eq!(mesh.defects(), [], "{name}");
        }
    }
}

#[test]
fn the_fixtures_have_the_intended_properties() {
    let scenes = scenes();
    let mesh = |name: &str| {
        let (_, scene) = scenes.iter().find(|(n, _)| *n == name).expect(name);
        scene.object("mesh").and_then(Object::as_mesh).expect(name)
    };
    assert_eq!(mesh("bow-tie vertex").n_vertices(), 6);
    assert_eq!(mesh("two cubes at one vertex").n_vertices(), 16);
    assert_eq!(geometry::n_components(mesh("two components")), 2);
    assert_eq!(mesh("isolated vertices").n_isolated_vertices(), 2);
    for name in ["squares with attributes", "triangles with attributes"] {
        let mesh = mesh(name);
        assert!(mesh.edges().any(|e| mesh.is_seam(e)), "{name}");
        assert!(
            mesh.edges()
                .any(|e| !mesh.is_boundary_edge(e) && !mesh.is_seam(e)),
            "{name}"
        );
    }
    // Some algorithms process vertices in blocks of 4096. The largest mesh must have more vertices than one block.
    assert!(mesh("large torus of triangles").n_vertices() > 4096);
}
