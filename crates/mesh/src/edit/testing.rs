//! What the tests of the edits share.

use glam::{DVec2, DVec4};

use crate::{COLOR, Column, Domain, EditError, MATERIAL, Mesh, Rule, UV, Values, shapes};

/// Closed and open meshes of triangles, squares and larger faces, with attributes on some of them.
pub(super) fn shapes_to_try() -> Vec<Mesh> {
    vec![
        shapes::square(),
        dressed(shapes::grid(3, 2)),
        dressed(shapes::fans(&shapes::grid(3, 2))),
        shapes::cube(),
        shapes::tetrahedron(),
        shapes::octahedron(),
        shapes::icosahedron(),
        shapes::torus(4, 3, 2.0, 1.0),
        shapes::cylinder(5, true),
        shapes::cylinder(3, false),
    ]
}

/// The mesh with UVs and colors that are linear in x and y, and a seam of the UVs: on face 0 they are
/// x and y, on the others 10 more. Materials are 5, 6, 6, ..., and a face column has the rule drop.
pub(super) fn dressed(mut mesh: Mesh) -> Mesh {
    let place = |h| mesh.position(mesh.origin(h)).truncate();
    let uv = |h| match mesh.face(h) {
        Some(f) if f.index() == 0 => place(h),
        Some(_) => place(h) + DVec2::splat(10.0),
        None => DVec2::ZERO,
    };
    let uvs = mesh.half_edges().map(uv).collect();
    let colors = mesh.positions().iter();
    let colors = colors.map(|p| DVec4::new(p.x, p.y, p.z, 1.0)).collect();
    let n = mesh.n_faces();
    mesh.set(UV, uvs);
    mesh.set(COLOR, colors);
    mesh.set(
        MATERIAL,
        (0..n).map(|f| if f == 0 { 5 } else { 6 }).collect(),
    );
    let passing = Column {
        name: "passing".to_owned(),
        rule: Rule::Drop,
        values: Values::Float(vec![0.5; n]),
    };
    mesh.insert_column(Domain::Face, passing);
    mesh
}

/// Does an edit, takes it back, does it again, and reverts and redoes that: each time the mesh must be
/// bit-identical to what it was. Returns the edited mesh; a refusal must leave the mesh unchanged.
pub(super) fn undone_and_redone(
    before: &Mesh,
    edit: impl Fn(&mut Mesh) -> Result<(), EditError>,
) -> Result<Mesh, EditError> {
    let mut mesh = before.clone();
    let done = edit(&mut mesh);
    assert_eq!(mesh.defects(), [], "after {done:?}");
    if done.is_err() {
        assert_eq!(&mesh, before, "a refused edit changes nothing");
    }
    done?;
    let after = mesh;
    let mut mesh = before.clone();
    mesh.begin();
    edit(&mut mesh)?;
    assert_eq!(mesh, after);
    mesh.rollback();
    assert_eq!(&mesh, before);
    mesh.begin();
    edit(&mut mesh)?;
    let change = mesh.commit().expect("the outermost level");
    let again = mesh.revert(change);
    assert_eq!(&mesh, before);
    mesh.revert(again);
    assert_eq!(mesh, after);
    Ok(after)
}
