//! The operation: counts, refusals, recipes.

use mesh::shapes;
use op::test::{applied_as_planned, counts};

use crate::sqrt3::Sqrt3;

#[test]
fn an_icosahedron_becomes_60_triangles_and_then_180() {
    let mesh = shapes::icosahedron();
    assert_eq!(
        counts(&applied_as_planned(&Sqrt3::levels(1), &mesh)),
        [32, 90, 60]
    );
    assert_eq!(
        counts(&applied_as_planned(&Sqrt3::levels(2), &mesh)),
        [92, 270, 180]
    );
}

#[test]
fn polygons_are_refused_before_anything_runs() {
    let cube = shapes::cube();
    let reason = op::test::refused(&Sqrt3::default(), cube.clone());
    assert_eq!(reason, op::Refusal::NotTriangle);
    let (_, problems) = op::test::planned(&Sqrt3::default(), &cube);
    assert_eq!(problems.len(), 1);
    assert!(problems[0].message.contains("at least 4 corners"));
}

#[test]
fn a_boundary_is_cut_on_every_second_level() {
    let mesh = shapes::fans(&shapes::grid(3, 2));
    let n_outer = |levels| {
        let new = applied_as_planned(&Sqrt3::levels(levels), &mesh);
        new.edges().filter(|&e| new.is_boundary_edge(e)).count()
    };
    assert_eq!([1, 2, 3, 4].map(n_outer), [10, 30, 30, 90]);
}

#[test]
fn a_recipe_can_leave_the_levels_out_and_nothing_else_is_taken() {
    let parsed = |text: &str| ron::from_str::<Sqrt3>(&format!("#![enable(implicit_some)]{text}"));
    assert_eq!(parsed("(levels: 3)"), Ok(Sqrt3::levels(3)));
    assert_eq!(parsed("()"), Ok(Sqrt3::default()));
    assert!(parsed("(level: 3)").is_err());
    assert!(parsed("(levels: -1)").is_err());
}
