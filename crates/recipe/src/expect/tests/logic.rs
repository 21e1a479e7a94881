//! Tests of `Not`, and of expectations that are invalid.

use scene::Scene;

use super::{check, cube, expectation, holds_and_fails};
use crate::expect::OtherMesh;

#[test]
fn not_inverts_an_expectation() {
    holds_and_fails(
        &cube(),
        "Not(Faces(eq: 7))",
        "Not(Closed)",
        "expected Closed not to hold, but it does",
    );
    holds_and_fails(
        &cube(),
        "Not(Not(Faces(min: 6)))",
        "Not(Faces(min: 6))",
        "expected Faces(min: 6) not to hold, but it does",
    );
}

#[test]
fn not_shows_the_expectation_as_a_recipe_writes_it() {
    for text in [
        "Closed",
        "EdgeLength(max: 5.0)",
        "Not(Faces(eq: 7))",
        "Count(of: Vertices(Boundary), max: 3)",
        "Bounds(min: (-0.5, -0.5, -0.5), max: (0.5, 0.5, 0.5))",
        "Position(of: Vertices([0]), is: (-0.5, -0.5, -0.5), tolerance: 1.0)",
        "Area(eq: 6.0, tolerance: 0.5)",
        "Not(Digest(\"0a\"))",
    ] {
        assert_eq!(expectation(text).as_written(), text);
    }
}

#[test]
fn an_expectation_about_no_elements_is_unknown() {
    let empty = "And([Boundary, Not(Boundary)])";
    for (text, word) in [
        ("EdgeLength(of: EMPTY, max: 1)", "edges"),
        ("DihedralAngle(of: EMPTY, max: 1)", "edges"),
        ("Valence(of: EMPTY, max: 1)", "vertices"),
        ("Thickness(of: EMPTY, max: 1)", "vertices"),
        ("MinAngle(of: EMPTY, max: 1)", "faces"),
        ("MeanMinAngle(of: EMPTY, max: 1)", "faces"),
        ("MeanFaceArea(of: EMPTY, max: 1)", "faces"),
    ] {
        let text = text.replace("EMPTY", if word == "faces" { "Faces([])" } else { empty });
        let message = format!("the selection contains no {word}");
        assert_eq!(check(&cube(), &text), Err(message.clone()), "{text}");
        assert_eq!(
            check(&cube(), &format!("Not({text})")),
            Err(message),
            "{text}"
        );
    }
}

#[test]
fn not_fails_if_the_inner_expectation_cannot_be_checked() {
    assert_eq!(
        check(&cube(), "Not(Same(as: File(\"other.obj\")))"),
        Err("folder/other.obj is broken".to_owned())
    );
    assert_eq!(
        check(&Scene::new(), "Not(Closed)"),
        Err("expected a mesh, found none".to_owned())
    );
    assert_eq!(
        check(&cube(), "Not(Not(Same(as: Object(\"sphere\"))))"),
        Err("no object is named \"sphere\"".to_owned())
    );
    // The edge does not exist, so the selection is refused and the inner expectation does not hold.
    assert_eq!(
        check(&cube(), "Not(Count(of: Edges(Between(0, 7)), eq: 1))"),
        Ok(())
    );
}

#[test]
fn an_expectation_without_a_bound_is_an_error() {
    for text in [
        "Objects()",
        "Vertices()",
        "Edges()",
        "Faces()",
        "Components()",
        "BoundaryLoops()",
        "EulerCharacteristic()",
        "Genus()",
        "Area()",
        "Volume(tolerance: 1)",
        "Count(of: Faces(All))",
        "Valence()",
        "DihedralAngle(of: Boundary)",
        "MeanFaceArea(of: All)",
        "EdgeLength()",
        "MinAngle(of: All)",
        "MeanMinAngle()",
        "Thickness()",
        "SelfIntersections()",
        "Not(Faces())",
    ] {
        let problem = expectation(text).problem();
        assert_eq!(
            problem,
            Some("the expectation has no bound, so it can never fail"),
            "{text}"
        );
    }
    for text in [
        "Faces(eq: 0)",
        "Genus(min: 0)",
        "Area(max: 0)",
        "Valence(max: 6)",
        "DihedralAngle(reaches: 1)",
        "Manifold",
        "Closed",
        "SymmetricUnder(group: AxisMirrors)",
        "Not(Closed)",
    ] {
        assert_eq!(expectation(text).problem(), None, "{text}");
    }
}

#[test]
fn other_mesh_returns_the_object_or_file_of_a_comparison() {
    let object = OtherMesh::Object("b".to_owned());
    assert_eq!(
        expectation("Not(Same(as: Object(\"b\")))").other_mesh(),
        Some(&object)
    );
    assert_eq!(
        expectation("DistanceTo(other: File(\"b\"), below: 1)").other_mesh(),
        Some(&OtherMesh::File("b".to_owned()))
    );
    assert_eq!(expectation("Closed").other_mesh(), None);
}
