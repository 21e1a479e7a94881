//! Tests of the expectations about counts, manifolds, boundaries and attributes.

use bezier::Curve;
use geometry::shapes;
use mesh::{Connectivity, DVec3, Domain, FaceId, HalfEdgeId, Mesh, Rule, Values, VertexId};
use scene::{Geometry, Object, Scene};

use super::{check, check_on, cube, holds_and_fails, lines, scene};

#[test]
fn counts_are_compared_with_eq_min_and_max() {
    let cases = [
        ("Objects", 1, "objects"),
        ("Vertices", 8, "vertices"),
        ("Edges", 12, "edges"),
        ("Faces", 6, "faces"),
        ("Components", 1, "components"),
        ("BoundaryLoops", 0, "boundary loop"),
    ];
    for (name, n, what) in cases {
        let over = n + 1;
        holds_and_fails(
            &cube(),
            &format!("{name}(eq: {n})"),
            &format!("{name}(eq: {over})"),
            &format!("expected {over} {what}, found {n}"),
        );
        holds_and_fails(
            &cube(),
            &format!("{name}(min: {n}, max: {n})"),
            &format!("{name}(min: {over})"),
            &format!("expected at least {over} {what}, found {n}"),
        );
    }
    for (name, n, what) in [
        ("EulerCharacteristic", 2, "an Euler characteristic"),
        ("Genus", 0, "a genus"),
    ] {
        let over = n + 1;
        holds_and_fails(
            &cube(),
            &format!("{name}(eq: {n})"),
            &format!("{name}(min: {over})"),
            &format!("expected {what} of at least {over}, found {n}"),
        );
    }
    holds_and_fails(
        &cube(),
        "Faces(max: 6)",
        "Faces(max: 5)",
        "expected at most 5 faces, found 6",
    );
}

#[test]
fn counts_are_summed_over_all_meshes_or_those_named_in_on() {
    let two = scene([
        ("cube", shapes::cube()),
        ("torus", shapes::torus(4, 3, 2.0, 1.0)),
    ]);
    assert_eq!(check(&two, "Faces(eq: 18)"), Ok(()));
    assert_eq!(check(&two, "Genus(eq: 1)"), Ok(()));
    let torus = ["torus".to_owned()];
    assert_eq!(check_on(&two, Some(&torus), "Faces(eq: 12)"), Ok(()));
    let missing = ["sphere".to_owned()];
    assert_eq!(
        check_on(&two, Some(&missing), "Faces(eq: 12)"),
        Err("no object is named \"sphere\"".to_owned())
    );
}

#[test]
fn an_open_sheet_has_a_boundary_loop() {
    let sheet = scene([("sheet", shapes::grid(3, 2))]);
    holds_and_fails(
        &sheet,
        "BoundaryLoops(eq: 1)",
        "BoundaryLoops(eq: 0)",
        "expected 0 boundary loops, found 1",
    );
}

#[test]
fn points_of_curves_and_polylines_count_as_vertices() {
    let points = vec![glam::DVec2::ZERO, glam::DVec2::new(2.0, 1.0)];
    let mut scene = lines();
    let curve = Geometry::Curve(Curve::new(points).unwrap());
    scene.insert(Object::new("curve", curve)).unwrap();
    holds_and_fails(
        &scene,
        "Vertices(eq: 5)",
        "Vertices(eq: 3)",
        "expected 3 vertices, found 5",
    );
    assert_eq!(
        check(&scene, "Bounds(min: (0, 0, 0), max: (3, 1, 0))"),
        Ok(())
    );
}

#[test]
fn selected_elements_are_counted() {
    holds_and_fails(
        &cube(),
        "Count(of: Vertices(Valence(3)), eq: 8)",
        "Count(of: Edges(Sharp(above: 91)), min: 1)",
        "expected at least 1 selected edge, found 0",
    );
    holds_and_fails(
        &cube(),
        "Count(of: Faces(Degree(4)), min: 6, max: 6)",
        "Count(of: Edges(Between(0, 7)), eq: 1)",
        "no edge joins vertices 0 and 7",
    );
}

#[test]
fn a_manifold_has_no_defects() {
    let mut broken = shapes::cube();
    broken.positions_mut()[3].x = f64::NAN;
    assert_eq!(check(&cube(), "Manifold"), Ok(()));
    assert_eq!(
        check(&scene([("broken", broken)]), "Manifold"),
        Err(
            "expected a manifold, but \"broken\" has a defect: the position of the vertex v3 is not finite"
                .to_owned()
        )
    );
    assert_eq!(
        check(&Scene::new(), "Manifold"),
        Err("expected a mesh, found none".to_owned())
    );
}

/// Returns a mesh of five triangles in which two edges join v0 and v1, and two edges join v1 and v2. The faces around
/// each vertex form one fan.
pub(super) fn with_double_edges() -> Mesh {
    let origins = [
        [0, 1],
        [1, 2],
        [2, 0],
        [2, 1],
        [1, 0],
        [1, 3],
        [3, 2],
        [1, 4],
        [4, 3],
        [2, 4],
    ];
    let faces = [[0, 2, 4], [5, 6, 8], [3, 10, 12], [11, 14, 16], [15, 7, 18]];
    let origin: Vec<VertexId> = origins.concat().into_iter().map(VertexId::new).collect();
    let n = origin.len();
    let mut next = vec![HalfEdgeId::NONE; n];
    let mut face = vec![FaceId::NONE; n];
    for (f, corners) in faces.into_iter().enumerate() {
        for i in 0..3 {
            next[corners[i]] = HalfEdgeId::new(corners[(i + 1) % 3]);
            face[corners[i]] = FaceId::new(f);
        }
    }
    let boundary_half_edge = |v: VertexId| {
        let boundary = (0..n).find(|&h| face[h] == FaceId::NONE && origin[h] == v);
        HalfEdgeId::new(boundary.unwrap())
    };
    for h in (0..n).filter(|&h| face[h] == FaceId::NONE) {
        next[h] = boundary_half_edge(origin[h ^ 1]);
    }
    let connectivity = Connectivity {
        vertex_half_edge: (0..5)
            .map(|v| boundary_half_edge(VertexId::new(v)))
            .collect(),
        face_half_edge: faces.map(|corners| HalfEdgeId::new(corners[0])).to_vec(),
        next,
        origin,
        face,
    };
    let positions = (0..5).map(|i| DVec3::new(f64::from(i), f64::from(i * i), 0.0));
    Mesh::from_arrays(connectivity, positions.collect())
}

#[test]
fn two_edges_between_the_same_vertices_are_not_manifold() {
    let mesh = with_double_edges();
    assert_eq!(mesh.defects(), []);
    assert_eq!(
        check(&scene([("double", mesh)]), "Manifold"),
        Err(
            "expected a manifold, but several edges of \"double\" join the vertices v0 and v1"
                .to_owned()
        )
    );
}

#[test]
fn a_closed_mesh_has_no_boundary() {
    assert_eq!(check(&cube(), "Closed"), Ok(()));
    assert_eq!(
        check(&scene([("sheet", shapes::square())]), "Closed"),
        Err(
            "expected no boundary edges, but the edge v0-v1 of \"sheet\" is a boundary edge"
                .to_owned()
        )
    );
    assert_eq!(
        check(&lines(), "Closed"),
        Err("expected a mesh, found none".to_owned())
    );
}

#[test]
fn an_attribute_must_exist_on_every_mesh() {
    let mut tagged = shapes::cube();
    let column = mesh::Column {
        name: "rim".to_owned(),
        rule: Rule::Copy,
        values: Values::Tag(vec![true; 12]),
    };
    tagged.insert_column(Domain::Edge, column);
    holds_and_fails(
        &scene([("cube", tagged)]),
        "HasAttribute(domain: Edge, name: \"rim\")",
        "HasAttribute(domain: Corner, name: \"uv\")",
        "expected the corner attribute \"uv\", but \"cube\" does not have it",
    );
}

#[test]
fn messages_use_the_singular_for_one() {
    for (text, message) in [
        ("Vertices(eq: 1)", "expected 1 vertex, found 8"),
        ("Faces(max: 1)", "expected at most 1 face, found 6"),
        ("Edges(eq: 2)", "expected 2 edges, found 12"),
        (
            "BoundaryLoops(min: 1)",
            "expected at least 1 boundary loop, found 0",
        ),
        ("Genus(eq: 1)", "expected a genus of 1, found 0"),
        (
            "Count(of: Vertices(All), eq: 1)",
            "expected 1 selected vertex, found 8",
        ),
        (
            "SymmetricUnder(group: AxisMirrors, eq: 1)",
            "expected 1 symmetry, found 8",
        ),
    ] {
        assert_eq!(check(&cube(), text), Err(message.to_owned()), "{text}");
    }
}
