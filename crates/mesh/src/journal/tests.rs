use proptest::prelude::*;

use super::*;
use crate::{
    COLOR, CREASE, DVec2, DVec4, EdgeId, EditError, FaceId, MATERIAL, Rule, UV, VERTEX_NORMAL,
    shapes,
};

/// Adds columns of several types and rules.
fn with_attributes(mut mesh: Mesh) -> Mesh {
    let (v, h) = (mesh.n_vertices(), mesh.n_half_edges());
    let (e, f) = (mesh.n_edges(), mesh.n_faces());
    mesh.set(UV, (0..h).map(|i| DVec2::new(i as f64, 0.5)).collect());
    mesh.set(COLOR, vec![DVec4::new(0.25, 0.5, 1.0, 1.0); v]);
    mesh.set(VERTEX_NORMAL, vec![DVec3::Z; v]);
    mesh.set(CREASE, (0..e).map(|i| i as f64).collect());
    mesh.set(MATERIAL, (0..).take(f).collect());
    let tag = crate::Attribute::<EdgeId, bool>::new("tag", Rule::Copy);
    mesh.set(tag, (0..e).map(|i| i % 2 == 0).collect());
    let number = crate::Attribute::<VertexId, f64>::new("number", Rule::Drop);
    mesh.set(number, vec![7.0; v]);
    mesh
}

/// Applies one of several edits to the element at index `i`. Ignores refusals.
fn edit(mesh: &mut Mesh, (kind, i): (u8, usize)) {
    let e = EdgeId::new(i % mesh.domain_len(Domain::Edge).max(1));
    let f = FaceId::new(i % mesh.domain_len(Domain::Face).max(1));
    let v = VertexId::new(i % mesh.domain_len(Domain::Vertex).max(1));
    let result: Result<(), EditError> = match kind {
        0 => mesh.flip_edge(e),
        1 => mesh.split_edge(e, 0.25).map(drop),
        2 => mesh.delete_face(f),
        3 if mesh.has_vertex(v) => {
            mesh.set_position(v, DVec3::splat(i as f64));
            Ok(())
        }
        4 => {
            // The mesh has no vertices after all its faces were deleted.
            if let Some(position) = mesh.positions_mut().first_mut() {
                *position *= 2.0;
            }
            Ok(())
        }
        5 => {
            mesh.get_mut(CREASE)
                .into_iter()
                .flatten()
                .for_each(|c| *c += 1.0);
            mesh.remove_column(Domain::Vertex, "normal");
            mesh.set(MATERIAL, vec![3; mesh.domain_len(Domain::Face)]);
            Ok(())
        }
        6 => {
            mesh.delete_isolated_vertices();
            Ok(())
        }
        7 => {
            mesh.compact();
            Ok(())
        }
        _ => {
            let mut attributes = mesh.attributes().clone();
            attributes.drop_by_rule();
            mesh.set_attributes(attributes);
            Ok(())
        }
    };
    let _ = result;
}

#[derive(Clone, Copy, Debug)]
enum Action {
    Edit(u8, usize),
    Begin,
    Commit,
    Rollback,
}

fn action() -> impl Strategy<Value = Action> {
    prop_oneof![
        8 => (0..9_u8, 0..200_usize).prop_map(|(kind, i)| Action::Edit(kind, i)),
        2 => Just(Action::Begin),
        1 => Just(Action::Commit),
        1 => Just(Action::Rollback),
    ]
}

proptest! {
    #[test]
    fn undo_and_redo_restore_the_same_bytes(
        shape in 0..3_usize, actions in prop::collection::vec(action(), 0..40),
    ) {
        let shape = [shapes::grid(3, 2), shapes::octahedron(), shapes::cube()][shape].clone();
        let start = with_attributes(shape);
        let mut mesh = start.clone();
        mesh.begin();
        let mut meshes_at_begin: Vec<Mesh> = Vec::new();
        for action in actions {
            match action {
                Action::Edit(kind, i) => edit(&mut mesh, (kind, i)),
                Action::Begin => {
                    meshes_at_begin.push(mesh.clone());
                    mesh.begin();
                }
                Action::Commit => if meshes_at_begin.pop().is_some() {
                    prop_assert_eq!(mesh.commit(), None);
                },
                Action::Rollback => if let Some(before) = meshes_at_begin.pop() {
                    mesh.rollback();
                    prop_assert_eq!(&mesh, &before);
                },
            }
        }
        for _ in meshes_at_begin {
            mesh.commit();
        }
        let change = mesh.commit().expect("the outermost level");
        prop_assert!(!mesh.is_recording());
        let end = mesh.clone();
        let redo = mesh.revert(change);
        prop_assert_eq!(&mesh, &start);
        let undo = mesh.revert(redo);
        prop_assert_eq!(&mesh, &end);
        mesh.revert(undo);
        prop_assert_eq!(&mesh, &start);
    }
}

#[test]
fn a_small_change_of_a_large_mesh_takes_little_memory() {
    let mut mesh = shapes::fans(&shapes::torus(100, 100, 2.0, 1.0));
    mesh.begin();
    mesh.flip_edge(EdgeId::new(100)).unwrap();
    mesh.split_edge(EdgeId::new(200), 0.5).unwrap();
    let change = mesh.commit().unwrap();
    assert!(change.bytes() < 2000, "{}", change.bytes());
    assert!(!change.is_empty());
}

#[test]
fn entries_larger_than_the_mesh_are_replaced_by_a_copy_of_it() {
    let start = shapes::fans(&shapes::torus(40, 40, 2.0, 1.0));
    let mut mesh = start.clone();
    mesh.begin();
    for _ in 0..4 {
        for e in start.edges() {
            let _ = mesh.flip_edge(e);
        }
    }
    let recorded = mesh.journal.as_ref().unwrap().recorded.bytes();
    assert!(recorded < mesh.bytes(), "{recorded}");
    let end = mesh.clone();
    // Nested calls of `begin` still work.
    mesh.begin();
    mesh.split_edge(EdgeId::new(3), 0.5).unwrap();
    mesh.rollback();
    assert_eq!(mesh, end);
    mesh.rollback();
    assert_eq!(mesh, start);
}

#[test]
fn an_edit_that_fails_half_way_is_undone_completely() {
    let mut mesh = shapes::grid(2, 2);
    let before = mesh.clone();
    let result = mesh.atomically(|mesh| {
        mesh.split_edge(EdgeId::new(0), 0.5)?;
        mesh.split_edge(EdgeId::new(1), 2.0)
    });
    assert_eq!(result, Err(EditError::OutsideEdge(2.0)));
    assert_eq!(mesh, before);
    assert!(!mesh.is_recording());
}

#[test]
fn without_edits_the_change_is_empty() {
    let mut mesh = shapes::square();
    mesh.begin();
    assert!(mesh.commit().unwrap().is_empty());
}
