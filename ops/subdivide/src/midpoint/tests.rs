//! The operation: counts, refusals, recipes.

use mesh::shapes;
use op::test::{applied_as_planned, counts};
use subdivision::Split;

use crate::midpoint::Midpoint;

#[test]
fn an_icosahedron_becomes_80_triangles_and_a_cube_24_quads() {
    let new = applied_as_planned(&Midpoint::default(), &shapes::icosahedron());
    assert_eq!(counts(&new), [42, 120, 80]);
    let quads = Midpoint {
        into: Split::Quads,
        ..Midpoint::default()
    };
    assert_eq!(
        counts(&applied_as_planned(&quads, &shapes::cube())),
        [26, 48, 24]
    );
    let area = applied_as_planned(&quads, &shapes::cube()).area();
    assert!((area - shapes::cube().area()).abs() < 1e-14);
}

#[test]
fn polygons_are_refused_before_anything_runs() {
    let cube = shapes::cube();
    let reason = op::test::refused(&Midpoint::default(), cube.clone());
    assert_eq!(reason, op::Refusal::NotTriangle);
    let (_, problems) = op::test::planned(&Midpoint::default(), &cube);
    assert_eq!(problems.len(), 1);
    assert!(problems[0].message.contains("at least 4 corners"));
}

#[test]
fn a_recipe_can_leave_the_levels_out_and_nothing_else_is_taken() {
    let parsed =
        |text: &str| ron::from_str::<Midpoint>(&format!("#![enable(implicit_some)]{text}"));
    assert_eq!(parsed("(levels: 3)"), Ok(Midpoint::levels(3)));
    assert_eq!(parsed("()"), Ok(Midpoint::default()));
    assert!(parsed("(level: 3)").is_err());
    assert!(parsed("(levels: -1)").is_err());
}
