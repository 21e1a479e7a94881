//! The operation: counts, refusals, recipes.

use mesh::shapes;
use op::test::{applied_as_planned, counts};

use crate::catmull_clark::CatmullClark;

#[test]
fn a_cube_becomes_24_quads_and_then_96() {
    let mesh = shapes::cube();
    assert_eq!(
        counts(&applied_as_planned(&CatmullClark::levels(1), &mesh)),
        [26, 48, 24]
    );
    assert_eq!(
        counts(&applied_as_planned(&CatmullClark::levels(2), &mesh)),
        [98, 192, 96]
    );
}

#[test]
fn polygons_of_all_degrees_become_quads() {
    let new = applied_as_planned(&CatmullClark::default(), &shapes::cylinder(7, true));
    assert!(new.faces().all(|f| new.degree(f) == 4));
    assert_eq!(new.n_faces(), 7 * 4 + 2 * 7);
}

#[test]
fn a_recipe_can_leave_the_levels_out_and_nothing_else_is_taken() {
    let parsed =
        |text: &str| ron::from_str::<CatmullClark>(&format!("#![enable(implicit_some)]{text}"));
    assert_eq!(parsed("(levels: 3)"), Ok(CatmullClark::levels(3)));
    assert_eq!(parsed("()"), Ok(CatmullClark::default()));
    assert!(parsed("(level: 3)").is_err());
    assert!(parsed("(levels: -1)").is_err());
}
