//! `Not`, and what an expectation says about itself.

use scene::Scene;

use super::{check, cube, expectation, holds_and_fails};
use crate::expect::Other;

#[test]
fn not_is_the_contrary() {
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
        "expected Faces(eq:None,min:Some(6),max:None) not to hold, but it does",
    );
}

#[test]
fn not_does_not_hold_for_what_cannot_be_told() {
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
    // A selection that is refused is an answer: there is no such edge.
    assert_eq!(
        check(&cube(), "Not(Count(of: Edges(Between(0, 7)), eq: 1))"),
        Ok(())
    );
}

#[test]
fn what_has_no_bound_is_a_problem() {
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
        "Not(Faces())",
    ] {
        let problem = expectation(text).problem();
        assert_eq!(
            problem,
            Some("it has no bound, so it can never fail"),
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
fn what_it_compares_with_is_named() {
    let object = Other::Object("b".to_owned());
    assert_eq!(
        expectation("Not(Same(as: Object(\"b\")))").others(),
        Some(&object)
    );
    assert_eq!(
        expectation("DistanceTo(other: File(\"b\"), below: 1)").others(),
        Some(&Other::File("b".to_owned()))
    );
    assert_eq!(expectation("Closed").others(), None);
}
