//! Tests of the three selection types.

use super::*;
use crate::{Files, NoProgress};
use geometry::shapes;
use mesh::{EdgeId, FaceId};
use proptest::prelude::*;
use scene::{Object, Scene};

fn edges(selection: &EdgeSelection, mesh: &Mesh) -> Vec<EdgeId> {
    let files = Files::default();
    selection
        .resolve(mesh, &Context::new(&NoProgress, &files))
        .unwrap()
}

fn refusal(selection: &EdgeSelection, mesh: &Mesh) -> (Refusal, String) {
    let files = Files::default();
    match selection.resolve(mesh, &Context::new(&NoProgress, &files)) {
        Err(OpError::Refused {
            reason, message, ..
        }) => (reason, message),
        other => panic!("expected a refusal, got {other:?}"),
    }
}

fn parse(text: &str) -> EdgeSelection {
    ron::from_str(text).unwrap()
}

#[test]
fn predicates_select_by_geometry_and_connectivity() {
    let cube = shapes::cube();
    let grid = shapes::grid(3, 2);
    assert_eq!(edges(&parse("All"), &cube).len(), 12);
    assert_eq!(edges(&parse("Boundary"), &grid).len(), 10);
    assert_eq!(edges(&parse("Sharp(above: 89)"), &cube).len(), 12);
    assert_eq!(edges(&parse("Sharp(above: 91)"), &cube).len(), 0);
    assert_eq!(edges(&parse("Flat(below: 1)"), &grid).len(), 7);
    assert_eq!(edges(&parse("Longer(than: 1.9)"), &cube).len(), 12);
    assert_eq!(edges(&parse("Shorter(than: 1.9)"), &cube).len(), 0);
    assert_eq!(edges(&parse("Between(0, 1)"), &cube).len(), 1);
    assert_eq!(edges(&parse("EdgesOf(Faces([0]))"), &cube).len(), 4);
    assert_eq!(edges(&parse("EdgesAround(Vertices([0]))"), &cube).len(), 3);
    assert_eq!(
        edges(&parse("EdgesWithin(Vertices([0, 1, 3]))"), &cube).len(),
        2
    );
    assert_eq!(
        edges(
            &parse("EdgesWithin(CornersOf(FacesAround(Valence(2))))"),
            &grid
        )
        .len(),
        17
    );
    let top = "Inside(HalfSpace(point: (0, 0, 1), normal: (0, 0, 1)))";
    assert_eq!(edges(&parse(top), &cube).len(), 4);
    let sphere = "Inside(Sphere(center: (1, 1, 1), radius: 2))";
    assert_eq!(edges(&parse(sphere), &cube).len(), 3);
    let slab = "Inside(Box(min: (-2, -2, -2), max: (2, 2, 0)))";
    assert_eq!(edges(&parse(slab), &cube).len(), 4);
}

/// Returns a grid whose vertices and faces have attributes.
fn with_attributes() -> Mesh {
    let mut mesh = shapes::grid(3, 2);
    let mut insert = |domain, name: &str, values| {
        let (name, rule) = (name.to_owned(), mesh::Rule::Copy);
        mesh.insert_column(domain, mesh::Column { name, rule, values });
    };
    let numbers = |n: u32| (0..n).map(f64::from).collect::<Vec<f64>>();
    insert(Domain::Vertex, "wall", mesh::Values::Float(numbers(12)));
    let vectors = numbers(12).into_iter().map(|x| DVec3::new(0.0, x, 1.0));
    insert(
        Domain::Vertex,
        "flow",
        mesh::Values::Vec3(vectors.collect()),
    );
    insert(Domain::Face, "kind", mesh::Values::Int((0..6).collect()));
    insert(Domain::Face, "mark", mesh::Values::Tag(vec![true; 6]));
    mesh
}

#[test]
fn elements_are_selected_by_the_values_of_attributes() {
    let mesh = with_attributes();
    let files = Files::default();
    let cx = Context::new(&NoProgress, &files);
    let vertices = |text: &str| {
        let selection: VertexSelection = ron::from_str(text).unwrap();
        let found = selection.resolve(&mesh, &cx).unwrap();
        found.iter().map(|v| v.index()).collect::<Vec<_>>()
    };
    let some = "#![enable(implicit_some)]";
    let at = |text: &str| vertices(&format!("{some} {text}"));
    assert_eq!(at("Where(attribute: \"wall\", below: 2)"), [0, 1]);
    assert_eq!(at("Where(attribute: \"wall\", above: 9)"), [10, 11]);
    assert_eq!(at("Where(attribute: \"wall\", above: 3, below: 5)"), [4]);
    assert_eq!(
        at("Where(attribute: \"flow\", component: 1, below: 1)"),
        [0]
    );
    assert_eq!(
        at("Where(attribute: \"flow\", component: 2, below: 1)").len(),
        0
    );
    let faces: FaceSelection =
        ron::from_str(&format!("{some} Where(attribute: \"kind\", above: 3.5)")).unwrap();
    assert_eq!(faces.resolve(&mesh, &cx).unwrap(), [4, 5].map(FaceId::new));
}

#[test]
fn wrong_attributes_are_refused_with_help() {
    let mesh = with_attributes();
    let files = Files::default();
    let cx = Context::new(&NoProgress, &files);
    let message = |text: &str| {
        let text = format!("#![enable(implicit_some)] {text}");
        let selection: VertexSelection = ron::from_str(&text).unwrap();
        selection.resolve(&mesh, &cx).unwrap_err().to_string()
    };
    for (text, expected) in [
        (
            "Where(attribute: \"walls\", below: 2)",
            "no attribute of vertices is named \"walls\"; numeric attributes of vertices: flow, wall",
        ),
        (
            "Where(attribute: \"kind\", below: 2)",
            "\"kind\" is an attribute of faces, but a selection of vertices is needed: write `CornersOf(Where(attribute: \"kind\", ..))`",
        ),
        (
            "Where(attribute: \"wall\")",
            "`Where` needs `above`, `below` or both",
        ),
        (
            "Where(attribute: \"wall\", component: 0, below: 2)",
            "the type of the vertex attribute \"wall\" is number: remove `component`",
        ),
        (
            "Where(attribute: \"flow\", below: 2)",
            "the type of the vertex attribute \"flow\" is 3 numbers: choose one number with `component`, counted from 0",
        ),
        (
            "Where(attribute: \"flow\", component: 3, below: 2)",
            "the type of the vertex attribute \"flow\" is 3 numbers: `component` must be at most 2",
        ),
        (
            "CornersOf(Where(attribute: \"mark\", below: 2))",
            "the face attribute \"mark\" is a tag, which has no numbers: to select its elements, write `Tagged(\"mark\")`",
        ),
    ] {
        assert_eq!(message(text), expected);
    }
}

#[test]
fn inside_of_selects_by_the_winding_number_of_another_object() {
    let mut scene = Scene::new();
    let mut mould = shapes::uv_sphere(40, 20);
    for p in mould.positions_mut() {
        *p *= 1.5;
    }
    // The selection `InsideOf` does not depend on the orientation of the other mesh, and tolerates a small hole.
    mould.reverse();
    mould.delete_face(FaceId::new(3)).unwrap();
    let grid = shapes::grid(8, 8);
    scene.insert(Object::mesh("mould", mould)).unwrap();
    scene.insert(Object::mesh("part", grid.clone())).unwrap();
    let lines = scene::Geometry::Polylines(Vec::new());
    scene.insert(Object::new("lines", lines)).unwrap();
    let files = Files::default();
    let mut cx = Context::new(&NoProgress, &files);
    cx.set_object(&scene, "part");
    let found = |text: &str| {
        ron::from_str::<VertexSelection>(text)
            .unwrap()
            .resolve(&grid, &cx)
    };
    let sphere = "Inside(Sphere(center: (0, 0, 0), radius: 1.4999))";
    let inside = found(r#"InsideOf("mould")"#).unwrap();
    assert_eq!(inside, found(sphere).unwrap());
    assert!(!inside.is_empty() && inside.len() < grid.n_vertices());
    let edges = parse(r#"InsideOf("mould")"#).resolve(&grid, &cx).unwrap();
    assert_eq!(edges, parse(sphere).resolve(&grid, &cx).unwrap());
    for (name, message) in [
        (
            "mold",
            "no object is named \"mold\"; other objects at this point: \"mould\", \"lines\"",
        ),
        ("part", "needs an object other than \"part\""),
        ("lines", "\"lines\" is not a mesh"),
    ] {
        let error = found(&format!("InsideOf(\"{name}\")")).unwrap_err();
        assert!(error.to_string().contains(message), "{error}");
    }
}

#[test]
fn self_intersecting_faces_are_those_that_other_faces_pass_through() {
    let files = Files::default();
    let cx = Context::new(&NoProgress, &files);
    let found = |mesh: &Mesh| FaceSelection::SelfIntersecting.resolve(mesh, &cx).unwrap();
    assert_eq!(found(&shapes::torus(12, 8, 2.0, 0.7)), []);
    let mut torus = shapes::torus(12, 8, 2.0, 0.7);
    let v = VertexId::new(0);
    torus.set_position(v, -torus.position(v));
    let faces = found(&torus);
    assert!(torus.vertex_faces(v).all(|f| faces.contains(&f)));
    assert!(faces.len() > 4);
}

#[test]
fn choices_select_at_most_count_elements() {
    let grid = shapes::grid(4, 4);
    assert_eq!(edges(&parse("Random(count: 7, seed: 1)"), &grid).len(), 7);
    assert_eq!(
        edges(&parse("Random(count: 700, seed: 1)"), &grid).len(),
        grid.n_edges()
    );
    assert_eq!(edges(&parse("Longest(count: 3)"), &grid).len(), 3);
    let nearest = edges(&parse("Nearest(to: (-2, -2, 0), count: 2)"), &grid);
    assert!(
        nearest
            .iter()
            .all(|&e| grid.edge_vertices(e).contains(&VertexId::new(0)))
    );
}

#[test]
fn random_choices_depend_on_seed_and_step_only() {
    let grid = shapes::grid(20, 20);
    let files = Files::default();
    let choose = |seed: u64, stream| {
        let mut cx = Context::new(&NoProgress, &files);
        cx.stream = stream;
        let random = EdgeSelection::Random {
            count: 20,
            of: Box::default(),
            seed,
        };
        random.resolve(&grid, &cx).unwrap()
    };
    assert_eq!(choose(1, "a"), choose(1, "a"));
    assert_ne!(choose(1, "a"), choose(2, "a"));
    assert_ne!(choose(1, "a"), choose(1, "b"));
}

#[test]
fn random_choices_are_uniform() {
    // Among 2000 choices of 10 out of 40 edges, each edge is chosen about 500 times. The probability that an edge is
    // chosen fewer than 400 times, or 600 times or more, is below one in a million.
    let grid = shapes::grid(4, 4);
    let mut times_chosen = vec![0; 40];
    for seed in 0..2000 {
        for e in edges(
            &EdgeSelection::Random {
                count: 10,
                of: Box::default(),
                seed,
            },
            &grid,
        ) {
            times_chosen[e.index()] += 1;
        }
    }
    assert!(
        times_chosen.iter().all(|n| (400..600).contains(n)),
        "{times_chosen:?}"
    );
}

#[test]
fn an_edge_that_does_not_exist_is_refused() {
    let cube = shapes::cube();
    let (reason, message) = refusal(&parse("Between(0, 7)"), &cube);
    assert_eq!(reason, Refusal::Missing);
    assert_eq!(message, "no edge joins vertices 0 and 7");
    let (_, message) = refusal(&parse("Between(0, 8)"), &cube);
    assert_eq!(message, "vertex 8 does not exist: the mesh has 8 vertices");
    let (_, message) = refusal(&parse("Between(0, 4294967295)"), &cube);
    assert_eq!(
        message,
        "vertex 4294967295 does not exist: the mesh has 8 vertices"
    );
}

#[test]
fn an_unknown_tag_is_refused_with_a_list_of_the_known_tags() {
    let mut cube = shapes::cube();
    let tag = mesh::Attribute::<EdgeId, bool>::new("rim", mesh::Rule::Copy);
    cube.set(tag, (0..12).map(|i| i < 5).collect());
    assert_eq!(edges(&parse("Tagged(\"rim\")"), &cube).len(), 5);
    let (reason, message) = refusal(&parse("Tagged(\"rib\")"), &cube);
    assert_eq!(reason, Refusal::Missing);
    assert_eq!(message, "no edges are tagged \"rib\"; known tags: rim");
}

#[test]
fn a_number_that_differs_from_the_expected_number_is_refused() {
    let cube = shapes::cube();
    assert_eq!(edges(&parse("Expect(count: 12, of: All)"), &cube).len(), 12);
    let (reason, message) = refusal(&parse("Expect(count: 4, of: Sharp(above: 30))"), &cube);
    assert_eq!(reason, Refusal::Expectation);
    assert_eq!(message, "expected 4 selected edges, found 12");
}

#[test]
fn faces_are_selected_by_material() {
    let mut cube = shapes::cube();
    cube.set(mesh::MATERIAL, vec![0, 1, 1, 0, -1, 1]);
    let files = Files::default();
    let mut cx = Context::new(&NoProgress, &files);
    cx.materials = vec!["red".into(), "blue".into()];
    let blue = FaceSelection::Material("blue".into())
        .resolve(&cube, &cx)
        .unwrap();
    assert_eq!(
        blue.iter().map(|f| f.index()).collect::<Vec<_>>(),
        [1, 2, 5]
    );
    assert!(
        FaceSelection::Material("green".into())
            .resolve(&cube, &cx)
            .is_err()
    );
}

/// Generates selections on a 5 x 4 grid, nested up to three levels deep.
fn any_selection() -> impl Strategy<Value = EdgeSelection> {
    let leaf = prop_oneof![
        Just(EdgeSelection::All),
        Just(EdgeSelection::Boundary),
        (0..31_u32)
            .prop_map(|v| EdgeSelection::EdgesAround(VertexSelection::Vertices(vec![v % 30]))),
        (0..20_u32).prop_map(|f| EdgeSelection::EdgesOf(FaceSelection::Faces(vec![f]))),
        (0..40_u32, 0..9_u64).prop_map(|(count, seed)| EdgeSelection::Random {
            count,
            of: Box::default(),
            seed
        }),
    ];
    leaf.prop_recursive(3, 12, 3, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..3).prop_map(EdgeSelection::And),
            prop::collection::vec(inner.clone(), 0..3).prop_map(EdgeSelection::Or),
            inner.clone().prop_map(|s| EdgeSelection::Not(Box::new(s))),
            inner.clone().prop_map(|s| EdgeSelection::Grow(Box::new(s))),
            inner.prop_map(|s| EdgeSelection::Shrink(Box::new(s))),
        ]
    })
}

proptest! {
    #[test]
    fn the_laws_of_the_algebra_hold(a in any_selection(), b in any_selection()) {
        let grid = shapes::grid(5, 4);
        let not = |s: &EdgeSelection| EdgeSelection::Not(Box::new(s.clone()));
        let boxed = |s: &EdgeSelection| Box::new(s.clone());
        // The following checks are De Morgan's laws.
        let both = EdgeSelection::And(vec![a.clone(), b.clone()]);
        let neither = EdgeSelection::Or(vec![not(&a), not(&b)]);
        prop_assert_eq!(edges(&not(&both), &grid), edges(&neither, &grid));
        prop_assert_eq!(edges(&not(&not(&a)), &grid), edges(&a, &grid));
        // `Grow` only adds elements. Shrinking a selection is the same as growing its complement and then taking the
        // complement of the result.
        let grown = edges(&EdgeSelection::Grow(boxed(&a)), &grid);
        prop_assert!(edges(&a, &grid).iter().all(|e| grown.contains(e)));
        prop_assert_eq!(
            edges(&EdgeSelection::Shrink(boxed(&a)), &grid),
            edges(&not(&EdgeSelection::Grow(Box::new(not(&a)))), &grid)
        );
        // The number of selected elements is within the planned range.
        let planned = a.count(&MeshPlan::of(&grid));
        prop_assert!(planned.contains(edges(&a, &grid).len() as u64), "{:?}", planned);
    }

    #[test]
    fn a_selection_survives_a_round_trip_through_text(a in any_selection()) {
        prop_assert_eq!(parse(&ron::to_string(&a).unwrap()), a);
    }
}

fn faces(text: &str, mesh: &Mesh) -> Vec<usize> {
    let files = Files::default();
    let selection: FaceSelection = ron::from_str(text).unwrap();
    let found = selection.resolve(mesh, &Context::new(&NoProgress, &files));
    found.unwrap().into_iter().map(FaceId::index).collect()
}

/// Returns the vertices of the selected edges, without duplicates.
fn ends(text: &str, mesh: &Mesh) -> Vec<usize> {
    let found = edges(&parse(text), mesh);
    let ends = found.iter().flat_map(|&e| mesh.edge_vertices(e));
    let ends: std::collections::BTreeSet<_> = ends.map(VertexId::index).collect();
    ends.into_iter().collect()
}

#[test]
fn loops_and_rings_go_around_a_torus() {
    // The torus has 7 cross sections of 5 vertices. Vertex j of cross section i has the id 5 i + j.
    let torus = shapes::torus(7, 5, 2.0, 1.0);
    let across: Vec<usize> = (0..5).collect();
    assert_eq!(ends("EdgeLoop(Between(0, 1))", &torus), across);
    let around: Vec<usize> = (0..7).map(|i| 5 * i).collect();
    assert_eq!(ends("EdgeLoop(Between(0, 5))", &torus), around);
    let ring = edges(&parse("EdgeRing(Between(0, 5))"), &torus);
    let expected = (0..5).map(|j| torus.find_half_edge(VertexId::new(j), VertexId::new(j + 5)));
    let mut expected: Vec<_> = expected.map(|h| h.unwrap().edge()).collect();
    expected.sort();
    assert_eq!(ring, expected);
    assert_eq!(edges(&parse("EdgeRing(Between(0, 1))"), &torus).len(), 7);
}

#[test]
fn loops_end_at_vertices_without_four_edges() {
    let grid = shapes::grid(4, 3);
    // The edge loop goes from one side of the sheet to the opposite side.
    assert_eq!(ends("EdgeLoop(Between(6, 7))", &grid), [5, 6, 7, 8, 9]);
    assert_eq!(edges(&parse("EdgeLoop(Between(0, 1))"), &grid).len(), 14);
    assert_eq!(edges(&parse("EdgeRing(Between(0, 1))"), &grid).len(), 4);
    // At the corners of a cube, three edges meet, so edge loops end there. In triangles, no edge has an opposite edge,
    // so edge rings end there.
    assert_eq!(
        edges(&parse("EdgeLoop(Between(0, 1))"), &shapes::cube()).len(),
        1
    );
    assert_eq!(
        edges(&parse("EdgeRing(Between(0, 1))"), &shapes::cube()).len(),
        4
    );
    let triangles = shapes::fans(&grid);
    assert_eq!(
        edges(&parse("EdgeRing(Between(6, 7))"), &triangles).len(),
        1
    );
}

#[test]
fn a_path_is_the_shortest() {
    let grid = shapes::grid(4, 3);
    assert_eq!(ends("Path(from: 5, to: 8)", &grid), [5, 6, 7, 8]);
    assert_eq!(edges(&parse("Path(from: 0, to: 19)"), &grid).len(), 7);
    assert_eq!(edges(&parse("Path(from: 3, to: 3)"), &grid).len(), 0);
    // Vertex 7 is far from all other vertices, so the direct path over vertex 7 is long. A path around vertex 7 has
    // more edges, but is shorter.
    let mut fans = shapes::fans(&grid);
    fans.positions_mut()[7] += DVec3::new(0.0, 0.0, 100.0);
    assert!(!ends("Path(from: 6, to: 8)", &fans).contains(&7));
    let two = "Path(from: 0, to: 4)";
    let apart = Mesh::from_polygons(
        [0, 1, 2, 0, 1, 2]
            .map(|i: u8| DVec3::new(f64::from(i % 2), f64::from(i / 2), 0.0))
            .to_vec(),
        &[[0, 1, 2], [3, 4, 5]],
    );
    let (reason, message) = refusal(&parse(two), &apart.unwrap().0);
    assert_eq!(reason, Refusal::Missing);
    assert_eq!(
        message,
        "no path along edges leads from vertex 0 to vertex 4"
    );
}

#[test]
fn faces_are_selected_by_direction_angle_and_component() {
    let cube = shapes::cube();
    let up = faces("Facing(direction: (0, 0, 3), within: 10)", &cube);
    assert_eq!(up.len(), 1);
    assert!(cube.face_normal(FaceId::new(up[0])).z > 0.9);
    assert_eq!(
        faces("Facing(direction: (1, 1, 1), within: 60)", &cube).len(),
        3
    );
    assert_eq!(
        faces("Facing(direction: (0, 0, 0), within: 180)", &cube).len(),
        0
    );
    assert_eq!(faces("Expand(to_angle: 89, of: Faces([2]))", &cube), [2]);
    assert_eq!(
        faces("Expand(to_angle: 91, of: Faces([2]))", &cube).len(),
        6
    );
    let sides = shapes::fans(&cube);
    assert_eq!(
        faces("Expand(to_angle: 1, of: Faces([0]))", &sides).len(),
        2
    );
    assert_eq!(faces("Component(Faces([3]))", &sides).len(), 12);
    assert_eq!(faces("Component(Not(All))", &sides).len(), 0);
}
