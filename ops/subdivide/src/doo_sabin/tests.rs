//! The operation: counts, refusals, recipes.

use mesh::shapes;
use op::test::{applied_as_planned, counts};

use crate::doo_sabin::DooSabin;

#[test]
fn a_cube_gets_26_faces_and_then_98() {
    let mesh = shapes::cube();
    assert_eq!(
        counts(&applied_as_planned(&DooSabin::levels(1), &mesh)),
        [24, 48, 26]
    );
    assert_eq!(
        counts(&applied_as_planned(&DooSabin::levels(2), &mesh)),
        [96, 192, 98]
    );
}

#[test]
fn a_recipe_can_leave_the_levels_out_and_nothing_else_is_taken() {
    let parsed =
        |text: &str| ron::from_str::<DooSabin>(&format!("#![enable(implicit_some)]{text}"));
    assert_eq!(parsed("(levels: 3)"), Ok(DooSabin::levels(3)));
    assert_eq!(parsed("()"), Ok(DooSabin::default()));
    assert!(parsed("(level: 3)").is_err());
    assert!(parsed("(levels: -1)").is_err());
}
