//! The operation: counts, kinds of surfaces, refusals, threads, recipes.

use mesh::{Mesh, shapes};

use crate::CatmullClark;

fn applied(operation: &CatmullClark, mesh: &Mesh) -> Mesh {
    let new = op::test::applied(operation, mesh.clone());
    assert!(op::test::is_as_planned(operation, mesh, &new));
    new
}

fn counts(mesh: &Mesh) -> [usize; 3] {
    [mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()]
}

#[test]
fn a_cube_becomes_24_quads_and_then_96() {
    let mesh = shapes::cube();
    assert_eq!(
        counts(&applied(&CatmullClark::levels(1), &mesh)),
        [26, 48, 24]
    );
    assert_eq!(
        counts(&applied(&CatmullClark::levels(2), &mesh)),
        [98, 192, 96]
    );
}

#[test]
fn a_closed_surface_stays_closed_and_keeps_its_genus() {
    for mesh in [
        shapes::cube(),
        shapes::cylinder(5, true),
        shapes::torus(5, 4, 2.0, 1.0),
    ] {
        let new = applied(&CatmullClark::levels(3), &mesh);
        assert_eq!(new.n_boundary_loops(), 0);
        assert_eq!(new.euler_characteristic(), mesh.euler_characteristic());
    }
}

#[test]
fn levels_follow_one_another_and_none_changes_nothing() {
    let mesh = shapes::grid(3, 2);
    let apply = |levels, mesh: &Mesh| applied(&CatmullClark::levels(levels), mesh);
    assert!(apply(0, &mesh) == mesh);
    assert!(apply(1, &mesh) == applied(&CatmullClark::default(), &mesh));
    assert!(apply(3, &mesh) == apply(1, &apply(1, &apply(1, &mesh))));
}

#[test]
fn the_bytes_are_the_same_for_any_number_of_threads() {
    let mesh = shapes::grid(3, 2);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().unwrap();
        pool.install(|| op::test::applied(&CatmullClark::levels(4), mesh.clone()))
    };
    // Equal as bits: `==` would take -0 for 0.
    let bits = |m: &Mesh| -> Vec<[u64; 3]> {
        let bits = m.positions().iter().map(|p| p.to_array().map(f64::to_bits));
        bits.collect()
    };
    let one = with(1);
    for threads in [2, 8] {
        let other = with(threads);
        assert_eq!(bits(&other), bits(&one), "{threads}");
        assert!(other == one, "{threads}");
    }
}

#[test]
fn polygons_of_all_degrees_become_quads() {
    let new = applied(&CatmullClark::default(), &shapes::cylinder(7, true));
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
