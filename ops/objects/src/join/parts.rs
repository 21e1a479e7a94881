//! Joins the connectivity and the positions of several meshes.

use mesh::{Connectivity, DVec3, Mesh};
use op::{Context, OpError};

/// The largest number of elements of one kind: 2^32 - 2. With at most this number of elements, every id fits into 32
/// bits and is not `NONE`.
pub(crate) const MAX_ELEMENTS: u64 = u32::MAX as u64 - 1;

pub(crate) fn too_many(n: u64) -> String {
    format!(
        "the result would have {n} elements of one kind, such as vertices, but at most {MAX_ELEMENTS} are supported"
    )
}

/// Joins meshes that have no deleted elements into one mesh. The result has no attributes. For each kind of element,
/// the ids of a part are increased by the number of elements in all earlier parts.
pub(crate) fn connected(parts: &[&Mesh], cx: &Context) -> Result<Mesh, OpError> {
    let total = |count: fn(&Mesh) -> usize| -> usize { parts.iter().map(|m| count(m)).sum() };
    let n_half_edges = total(Mesh::n_half_edges);
    let n_vertices = total(Mesh::n_vertices);
    let n_faces = total(Mesh::n_faces);
    let largest = n_half_edges.max(n_vertices).max(n_faces) as u64;
    if largest > MAX_ELEMENTS {
        return Err(OpError::Budget(too_many(largest)));
    }

    let mut all = Connectivity {
        next: Vec::with_capacity(n_half_edges),
        origin: Vec::with_capacity(n_half_edges),
        face: Vec::with_capacity(n_half_edges),
        vertex_half_edge: Vec::with_capacity(n_vertices),
        face_half_edge: Vec::with_capacity(n_faces),
    };
    let mut positions: Vec<DVec3> = Vec::with_capacity(n_vertices);
    for (done, part) in (0..).zip(parts) {
        cx.advance("join", done, parts.len() as u64)?;
        all.append(part.connectivity());
        positions.extend_from_slice(part.positions());
    }
    Ok(Mesh::from_arrays(all, positions))
}
