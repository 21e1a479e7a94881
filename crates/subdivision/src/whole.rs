//! Subdivision of a whole mesh.

use std::borrow::Cow;
use std::ops::Range;

use mesh::Mesh;
use progress::{Meter, Progress};

use crate::error::SubdivisionError;
use crate::input::{check_faces, dense};
use crate::level;
use crate::rules::Rules;
use crate::size::Size;

/// Subdivides a mesh `levels` times.
///
/// If the old mesh has V vertices, E edges and F faces, one level changes ids as follows:
///
/// - Loop, Butterfly, Catmull-Clark and Midpoint: old vertices keep their ids. The vertex on edge e is V + e, and edge
///   e becomes edges 2e and 2e + 1. Triangle f becomes faces 4f to 4f + 3. If the scheme makes quads, each corner
///   becomes one face, in order of the corners, and the center of face f is vertex V + E + f.
/// - Doo-Sabin: face f keeps its id, and edge e becomes face F + e and edges 2e and 2e + 1. The faces that replace
///   vertices come after all other faces.
/// - Sqrt3: old vertices keep their ids, and face f becomes faces 3f to 3f + 2.
///
/// A mesh with dead (deleted) elements is compacted first, and the ids are those of the compacted mesh.
///
/// Vertex attributes are smoothed with the weights of the positions. Loop and Catmull-Clark smooth corner values as
/// defined by [`Rules::face_varying`]; all other schemes interpolate corner values linearly within each old face. Parts
/// of an edge or a face copy the values of the old edge or face. Normals are dropped, because they would be wrong.
/// Sharpness ([`mesh::CREASE`], [`mesh::VERTEX_SHARPNESS`]) shapes Loop and Catmull-Clark surfaces and decreases with
/// each level; other schemes copy it unchanged.
///
/// Worker threads call `progress`, possibly several at the same time.
///
/// # Errors
///
/// Returns [`SubdivisionError::NotTriangle`] if the scheme needs triangles and a face is not a triangle, and
/// [`SubdivisionError::TooFar`] if a coordinate is too large. Returns [`SubdivisionError::TooLarge`] if the result
/// would have more elements than there are ids, and [`SubdivisionError::Cancelled`] if the progress listener asks to
/// stop.
pub fn subdivide(
    mesh: &Mesh,
    rules: Rules,
    levels: u32,
    progress: &dyn Progress,
) -> Result<Mesh, SubdivisionError> {
    subdivide_within(mesh, rules, 0..levels, u64::MAX, progress)
}

/// Computes a range of levels, starting from this mesh. Fails if the result would take more than `budget` bytes.
///
/// `levels.start` is the number of levels that were applied to this mesh before; 0 for a coarse mesh. The index of a
/// level matters for [`Scheme::Sqrt3`](crate::Scheme::Sqrt3), whose even and odd levels differ.
///
/// # Errors
///
/// Returns an error in the same cases as [`subdivide`], and [`SubdivisionError::TooLarge`] if the result would exceed
/// the budget. The size is checked before any level is computed.
pub fn subdivide_within(
    mesh: &Mesh,
    rules: Rules,
    levels: Range<u32>,
    budget: u64,
    progress: &dyn Progress,
) -> Result<Mesh, SubdivisionError> {
    let mut mesh = dense(mesh);
    check_faces(&mesh, rules.scheme)?;
    let size = Size::of(&mesh);
    size.check(rules.scheme, levels.clone(), budget)?;
    let work = size.work(rules.scheme, levels.clone());
    let meter = Meter::new(progress, rules.scheme.name(), work);
    for level in levels {
        mesh = Cow::Owned(level::finer(&mesh, rules, level, &meter)?);
    }
    meter.finish()?;
    Ok(mesh.into_owned())
}
