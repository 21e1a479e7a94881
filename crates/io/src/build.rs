//! Building a mesh from the polygons of a file, with notes about what had to be changed.

use std::path::Path;

use glam::DVec3;
use mesh::Built;

use crate::error::ReadError;
use crate::note::Notes;
use crate::{NonManifold, Orientation, Policies, ReadOptions};

/// Builds a mesh of polygons; see [`mesh::build()`].
///
/// # Errors
///
/// If there are too many, or they are no manifold and the options refuse that.
pub(crate) fn build_mesh(
    path: &Path,
    positions: Vec<DVec3>,
    offsets: &[u32],
    corners: &[u32],
    options: &ReadOptions,
    notes: &mut Notes,
) -> Result<Built, ReadError> {
    let Policies {
        non_manifold,
        orientation,
        ..
    } = options.policies;
    let policy = match (non_manifold, orientation) {
        (NonManifold::Split, Orientation::Orient) => mesh::NonManifold::Split,
        (NonManifold::Split, Orientation::Keep) => mesh::NonManifold::SplitAsGiven,
        (NonManifold::Refuse, _) => mesh::NonManifold::Refuse,
    };
    let built =
        mesh::build(positions, offsets, corners, policy).map_err(|source| ReadError::Mesh {
            path: path.to_path_buf(),
            source,
        })?;
    for (count, what) in built.report.changes() {
        notes.changed(count, None, what);
    }
    let dropped = &built.report.dropped_faces;
    if let Some(f) = dropped.first() {
        let what = match dropped.len() {
            1 => format!("face left out that visits a vertex twice (face {f} of the file)"),
            _ => format!("faces left out that visit a vertex twice (first: face {f} of the file)"),
        };
        notes.left_out(dropped.len(), None, what);
    }
    Ok(built)
}
