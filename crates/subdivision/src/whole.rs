//! Levels of a whole mesh.

use std::borrow::Cow;
use std::ops::Range;

use mesh::Mesh;
use progress::{Meter, Progress};

use crate::error::SubdivisionError;
use crate::input::{check_faces, dense};
use crate::level;
use crate::rules::Rules;
use crate::size::Size;

/// The mesh after `levels` levels.
///
/// Ids: with Loop, Butterfly and Midpoint old vertices keep their numbers, the vertex on edge e is V + e,
/// edge e becomes edges 2e and 2e + 1, and face f becomes faces 4f to 4f + 3, or, in quads, one for each
/// corner in order; the center of face f is V + E + f. With Doo-Sabin face f stays f, edge e becomes face
/// F + e and edges 2e and 2e + 1, and the faces of vertices follow. With Sqrt3 old vertices keep their
/// numbers and face f becomes faces 3f to 3f + 2. A mesh with dead elements is compacted first, and the ids
/// are those of the compacted mesh.
///
/// Vertex attributes are smoothed with the weights of the positions; corner values by
/// [`Rules::face_varying`]; parts of an edge or a face take the values of the whole. Normals are left out,
/// because they would be wrong. Sharpness ([`mesh::CREASE`], [`mesh::VERTEX_SHARPNESS`]) shapes Loop and Catmull-Clark
/// surfaces and fades with the levels; other schemes hand it on.
///
/// Progress is reported from the threads that work.
///
/// # Errors
///
/// [`SubdivisionError::NotTriangle`] if the scheme needs triangles and a face has more corners,
/// [`SubdivisionError::TooLarge`] if the elements would outnumber the ids, [`SubdivisionError::Cancelled`].
pub fn subdivide(
    mesh: &Mesh,
    rules: Rules,
    levels: u32,
    progress: &dyn Progress,
) -> Result<Mesh, SubdivisionError> {
    subdivide_within(mesh, rules, 0..levels, u64::MAX, progress)
}

/// The mesh after some levels, of which the first begins with this mesh, if it takes at most `budget` bytes.
///
/// Levels count from 0 where subdivision began: with [`Scheme::Sqrt3`](crate::Scheme::Sqrt3) even and odd ones differ.
///
/// # Errors
///
/// Those of [`subdivide`]; [`SubdivisionError::TooLarge`] also for the budget. Both are known before anything
/// is computed.
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
