//! The operation: counts, refusals, recipes.

use mesh::{Mesh, shapes};

use crate::DooSabin;

fn applied(operation: &DooSabin, mesh: &Mesh) -> Mesh {
    let new = op::test::applied(operation, mesh.clone());
    assert!(op::test::is_as_planned(operation, mesh, &new));
    new
}

fn counts(mesh: &Mesh) -> [usize; 3] {
    [mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()]
}

#[test]
fn a_cube_gets_26_faces_and_then_98() {
    let mesh = shapes::cube();
    assert_eq!(counts(&applied(&DooSabin::levels(1), &mesh)), [24, 48, 26]);
    assert_eq!(counts(&applied(&DooSabin::levels(2), &mesh)), [96, 192, 98]);
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
