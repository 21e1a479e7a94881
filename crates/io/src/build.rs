//! Building a mesh from the polygons of a file, with notes about what had to be changed.

use std::path::Path;

use glam::DVec3;
use mesh::{BuildReport, Built};

use crate::ReadOptions;
use crate::error::ReadError;
use crate::note::Notes;

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
    let built =
        mesh::build(positions, offsets, corners, options.non_manifold).map_err(|source| {
            ReadError::Mesh {
                path: path.to_path_buf(),
                source,
            }
        })?;
    let BuildReport {
        split_edges,
        split_vertices,
        dropped_faces,
    } = &built.report;
    if let Some([v, w]) = split_edges.first() {
        let what = format!("non-manifold edges split (first {v}-{w})");
        notes.changed(split_edges.len(), None, what);
    }
    if let Some((v, _)) = split_vertices.first() {
        let what = format!("copies made of non-manifold vertices (first {v})");
        notes.changed(split_vertices.len(), None, what);
    }
    if let Some(f) = dropped_faces.first() {
        let what =
            format!("faces left out that visit a vertex twice (first: face {f} of the file)");
        notes.left_out(dropped_faces.len(), None, what);
    }
    Ok(built)
}

/// Values of the vertices of the file, and behind them those of the copies that building made.
pub(crate) fn values_of_copies<T: Copy + Default>(mut values: Vec<T>, built: &Built) -> Vec<T> {
    values.resize(built.mesh.n_vertices(), T::default());
    for (v, copy) in &built.report.split_vertices {
        values[copy.index()] = values[v.index()];
    }
    values
}
