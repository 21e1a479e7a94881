//! The operation: counts, refusals, recipes.

use mesh::shapes;
use op::test::{applied_as_planned, counts};

use crate::butterfly::Butterfly;

#[test]
fn an_icosahedron_becomes_80_triangles_and_then_320() {
    let mesh = shapes::icosahedron();
    assert_eq!(
        counts(&applied_as_planned(&Butterfly::levels(1), &mesh)),
        [42, 120, 80]
    );
    assert_eq!(
        counts(&applied_as_planned(&Butterfly::levels(2), &mesh)),
        [162, 480, 320]
    );
}

#[test]
fn polygons_are_refused_before_anything_runs() {
    let cube = shapes::cube();
    let reason = op::test::refused(&Butterfly::default(), cube.clone());
    assert_eq!(reason, op::Refusal::NotTriangle);
    let (_, problems) = op::test::planned(&Butterfly::default(), &cube);
    assert_eq!(problems.len(), 1);
    assert!(problems[0].message.contains("at least 4 corners"));
}

#[test]
fn a_recipe_can_leave_the_levels_out_and_nothing_else_is_taken() {
    let parsed =
        |text: &str| ron::from_str::<Butterfly>(&format!("#![enable(implicit_some)]{text}"));
    assert_eq!(parsed("(levels: 3)"), Ok(Butterfly::levels(3)));
    assert_eq!(parsed("()"), Ok(Butterfly::default()));
    assert!(parsed("(level: 3)").is_err());
    assert!(parsed("(levels: -1)").is_err());
}
