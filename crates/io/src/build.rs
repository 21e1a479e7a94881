//! Building a mesh from the polygons of a file, with notes about what had to be changed.

use std::path::Path;

use glam::DVec3;
use mesh::{BuildError, Built, Elements};

use crate::clean::Kept;
use crate::error::ReadError;
use crate::note::{Given, NoteKind, Notes};
use crate::{NonManifold, Orientation, Policies};

/// Builds a mesh of polygons; see [`mesh::build()`]. `kept` says which polygons of the file they are.
///
/// # Errors
///
/// If there are too many, or they are no manifold and the policies refuse that.
pub(crate) fn build_mesh(
    path: &Path,
    positions: Vec<DVec3>,
    offsets: &[u32],
    corners: &[u32],
    policies: Policies,
    kept: &Kept,
    notes: &mut Notes,
) -> Result<Built, ReadError> {
    let policy = match (policies.non_manifold, policies.orientation) {
        (NonManifold::Split, Orientation::Orient) => mesh::NonManifold::Split,
        (NonManifold::Split, Orientation::Keep) => mesh::NonManifold::SplitAsGiven,
        (NonManifold::Refuse, Orientation::Orient) => mesh::NonManifold::Refuse,
        (NonManifold::Refuse, Orientation::Keep) => mesh::NonManifold::RefuseAsGiven,
    };
    let in_file = |f: usize| kept.as_ref().map_or(f, |kept| kept[f] as usize);
    let built = mesh::build(positions, offsets, corners, policy).map_err(|mut source| {
        if let BuildError::NoSuchVertex { face, .. } = &mut source {
            *face = in_file(*face);
        }
        ReadError::Mesh {
            path: path.to_path_buf(),
            source,
        }
    })?;
    // Copies of vertices come behind the vertices that were given.
    let given = Given {
        positions: built.mesh.positions(),
        offsets,
        corners,
    };
    let dropped = built.report.dropped();
    let changed = built.report.repairs().into_iter();
    for (repair, kind) in (changed.map(|repair| (repair, NoteKind::Changed)))
        .chain(dropped.map(|dropped| (dropped, NoteKind::LeftOut)))
    {
        let places = given.places(&repair.elements);
        let elements = numbered_by(repair.elements, in_file);
        notes.elements(kind, repair.what, elements, places);
    }
    Ok(built)
}

fn numbered_by(elements: Elements, in_file: impl Fn(usize) -> usize) -> Elements {
    match elements {
        Elements::Faces(faces) => Elements::Faces(faces.into_iter().map(in_file).collect()),
        vertices => vertices,
    }
}
