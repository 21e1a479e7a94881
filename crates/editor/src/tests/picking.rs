use glam::DMat4;
use mesh::{DVec2, DVec3, DVec4, Element};
use op::ElementKind;
use scene::{Object, Scene};

use crate::select::propose_one;
use crate::{Area, Indexes, PickMode, Picked, Projection, keep_visible, pick, pick_area, propose};

/// Returns a parallel projection in the direction -z. In the picture, the square from (-1, -1) to (1, 1) is 800 pixels
/// wide.
fn front() -> Projection {
    // The depth is 0 at z = 5 and 1 at z = -5.
    let to_clip = DMat4::from_cols(
        DVec4::X,
        DVec4::Y,
        DVec4::Z * -0.1,
        DVec4::new(0.0, 0.0, 0.5, 1.0),
    );
    Projection::new(to_clip, DVec2::splat(800.0))
}

fn cube() -> Scene {
    let mut scene = Scene::new();
    let mut mesh = geometry::shapes::cube();
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for p in mesh.positions() {
        (low, high) = (low.min(*p), high.max(*p));
    }
    for p in mesh.positions_mut() {
        *p = (*p - low) / (high - low) - DVec3::splat(0.5);
    }
    scene.insert(Object::mesh("cube", mesh)).unwrap();
    scene
}

#[test]
fn a_point_picks_the_smallest_thing_within_the_radius() {
    let scene = cube();
    let indexes = Indexes::new();
    let mesh = scene.objects()[0].as_mesh().unwrap();
    assert!(indexes.wait_for(mesh).is_some());
    // The front of the cube covers the pixels from 200 to 600.
    let at = |x: f64, y: f64, mode| pick(&scene, &indexes, &front(), DVec2::new(x, y), mode);
    let element = |x, y| at(x, y, PickMode::Any).map(|hit| hit.element);
    let Some(Element::Face(f)) = element(400.0, 400.0) else {
        panic!()
    };
    assert_eq!(mesh.face_normal(f), DVec3::Z);
    let Some(Element::Edge(e)) = element(400.0, 205.0) else {
        panic!()
    };
    assert!(
        mesh.edge_vertices(e)
            .iter()
            .all(|&v| mesh.position(v).y == 0.5 && mesh.position(v).z == 0.5)
    );
    let Some(Element::Vertex(v)) = element(205.0, 205.0) else {
        panic!()
    };
    assert_eq!(mesh.position(v), DVec3::new(-0.5, 0.5, 0.5));
    // The first two points are outside the cube, but within the pick radius of an edge or a vertex. The third point is
    // too far from the cube.
    assert!(matches!(element(400.0, 195.0), Some(Element::Edge(_))));
    assert!(matches!(element(196.0, 196.0), Some(Element::Vertex(_))));
    assert_eq!(element(400.0, 190.0), None);
    // The half-edge lies on the face under the cursor.
    let hit = at(400.0, 230.0, PickMode::HalfEdge).unwrap();
    let Element::HalfEdge(h) = hit.element else {
        panic!()
    };
    assert_eq!((mesh.face(h), hit.face), (Some(f), Some(f)));
    assert_eq!(at(400.0, 400.0, PickMode::Vertex), None);
    assert!(matches!(
        at(205.0, 205.0, PickMode::Face).unwrap().element,
        Element::Face(_)
    ));
}

#[test]
fn a_box_and_a_lasso_pick_what_lies_inside() {
    let scene = cube();
    let whole = Area::Box(DVec2::splat(700.0), DVec2::splat(100.0));
    let all = pick_area(&scene, &front(), &whole, ElementKind::Faces);
    assert_eq!((all.len(), all[0].len()), (1, 6));
    let left = Area::Lasso(vec![
        DVec2::new(100.0, 100.0),
        DVec2::new(300.0, 100.0),
        DVec2::new(300.0, 700.0),
        DVec2::new(100.0, 700.0),
    ]);
    let picked = pick_area(&scene, &front(), &left, ElementKind::Vertices);
    assert_eq!(picked[0].len(), 4);
    assert_eq!(
        pick_area(&scene, &front(), &left, ElementKind::Edges)[0].len(),
        4
    );
    let nothing = Area::Box(DVec2::ZERO, DVec2::splat(10.0));
    assert!(pick_area(&scene, &front(), &nothing, ElementKind::Edges).is_empty());
}

#[test]
fn hidden_elements_are_removed_from_an_area() {
    let scene = cube();
    let indexes = Indexes::new();
    let mesh = scene.objects()[0].as_mesh().unwrap();
    assert!(indexes.wait_for(mesh).is_some());
    let whole = Area::Box(DVec2::splat(700.0), DVec2::splat(100.0));
    let mut picked = pick_area(&scene, &front(), &whole, ElementKind::Faces);
    keep_visible(&scene, &indexes, &front(), &mut picked);
    let facing = |z: f64| mesh.faces().find(|&f| mesh.face_normal(f).z == z).unwrap();
    assert!(picked[0].contains(facing(1.0).into()));
    assert!(!picked[0].contains(facing(-1.0).into()));
    let back = pick_area(&scene, &front(), &whole, ElementKind::Vertices);
    assert_eq!(back[0].len(), 8);
}

#[test]
fn picks_become_selections_that_mean_exactly_them() {
    let scene = cube();
    let mesh = scene.objects()[0].as_mesh().unwrap();
    let texts = |picked: &Picked| -> Vec<String> {
        propose(&scene, picked, "")
            .into_iter()
            .map(|proposal| proposal.text)
            .collect()
    };
    let edge = mesh.edges().next().unwrap();
    let [v, w] = mesh.edge_vertices(edge).map(mesh::VertexId::index);
    let one = texts(&Picked::one("cube", Element::Edge(edge)));
    assert_eq!(one[0], format!("Between({}, {})", v.min(w), v.max(w)));
    let all = Picked::new("cube", op::Selected::Edges(mesh.edges().collect()));
    assert_eq!(texts(&all)[0], "All");
    let top: Vec<_> = mesh
        .faces()
        .filter(|&f| mesh.face_normal(f) == DVec3::Y)
        .collect();
    let top = texts(&Picked::new("cube", op::Selected::Faces(top.clone())));
    assert!(top[0].starts_with("Faces(["), "{top:?}");
    assert!(
        top.iter()
            .any(|text| text
                .starts_with("Expect(count: 1, of: Facing(direction: (0, 1, 0), within: ")),
        "{top:?}"
    );
    assert!(propose(&scene, &Picked::one("other", Element::Edge(edge)), "").is_empty());
}

#[test]
fn one_element_is_meant_by_the_first_selection_of_the_list() {
    let mut scene = cube();
    scene
        .insert(Object::mesh("b", geometry::shapes::icosahedron()))
        .unwrap();
    for object in scene.objects() {
        let mesh = object.as_mesh().unwrap();
        let vertices = mesh.vertices().map(Element::Vertex);
        let edges = mesh.edges().map(Element::Edge);
        let faces = mesh.faces().map(Element::Face);
        for element in vertices.chain(edges).chain(faces) {
            let picked = Picked::one(&object.name, element);
            let all = propose(&scene, &picked, "");
            assert_eq!(propose_one(&scene, &picked).as_ref(), all.first());
        }
    }
    let two = Picked::new(
        "b",
        op::Selected::Faces(vec![mesh::FaceId::new(0), mesh::FaceId::new(1)]),
    );
    assert_eq!(propose_one(&scene, &two), None);
}
