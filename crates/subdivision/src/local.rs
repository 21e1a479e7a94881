//! Local refinement: subdivides some of the faces, and cuts faces around them so that the mesh has no cracks.
//!
//! # Triangles
//!
//! Chosen triangles are cut into four ("red"). If a neighbor of a red triangle is not red, the new vertex on their
//! common edge is a hanging vertex of the neighbor. Between levels, a triangle that is not cut keeps its hanging vertex
//! as a fourth corner in the middle of a straight side. A triangle that would get a second hanging vertex, on the same
//! side or on a different side, is also cut into four, and so on. So there is at most one hanging vertex on the common
//! edge of two triangles. After the last level, triangles with a hanging vertex are cut in two ("green"):
//!
//! ```text
//!            c                              c
//!          / | \                          / | \
//!        /   |   \                      /   |   y
//!      /     |     \                  /     | / | \
//!    a       |  red  d     -->      a ----- x   |   d      x: on an edge between a red triangle and
//!      \     |     /                  \     | \ | /           a triangle that is not red;
//!        \   |   /                      \   |   z             a-x makes two green triangles
//!          \ | /                          \ | /
//!            b                              b
//! ```
//!
//! Without smoothing, each new triangle is similar to its old triangle, or is half of a triangle that is similar to the
//! old triangle. So the smallest angle has a lower bound that does not depend on the number of levels. Over all levels
//! together, the cotangent of the smallest angle grows by at most a factor of three. Source: Bank, Sherman and Weiser,
//! "Refinement Algorithms and Data Structures for Regular Local Mesh Refinement", 1983.
//!
//! # Polygons
//!
//! Chosen faces are cut into one quad for each corner. A face that is not chosen stays whole. On its common edges with
//! chosen faces, the new vertices become additional corners of this face.

mod builder;
mod closure;
mod pieces;
mod smoothed;

use std::borrow::Cow;

use mesh::{FaceId, Mesh};
use progress::{Cancelled, Meter, Progress};

use crate::error::SubdivisionError;
use crate::input::{check_faces, dense};
use crate::level;
use crate::rules::{Rules, Scheme, Split};
use crate::sharpness::Sharpness;
use crate::size::{Size, TooLarge};

use closure::Cuts;
use pieces::{Pieces, SmoothedElements};
use smoothed::LocalMasks;

/// Subdivides some of the faces of a mesh `levels` times. The first level refines the chosen faces. Each further level
/// refines the parts into which the previous level has cut the chosen faces.
///
/// `faces` has one flag for each face, which is true if the face is chosen. Supports Loop, Catmull-Clark and midpoint
/// subdivision.
///
/// Around the chosen faces, triangles are cut in four or in two so that no vertex lies inside an edge. If the
/// scheme makes quads, the neighbors of chosen faces get additional corners instead. The surface outside of the
/// chosen faces does not change. An old vertex follows the masks of the scheme if all its faces are
/// chosen; otherwise it stays in place. A new vertex on an edge follows the masks if all faces at the edge are
/// chosen; otherwise it lies in the middle of the edge. If all faces are chosen, the result is the same as that of
/// [`subdivide`](crate::subdivide).
///
/// Ids change as follows. Old vertices keep their ids. Each level appends the new vertices on edges, in order of the
/// edges, then the new vertices in faces, in order of the faces. Edges and faces are renumbered. The parts of an edge
/// have consecutive ids, in order along the first half-edge of the edge. The parts of a face have consecutive ids too.
/// New edges inside faces come after the parts of old edges, in order of the faces. A mesh with dead (deleted) elements
/// is compacted first.
///
/// Vertex attributes are blended with the weights of the positions. Where positions are smoothed, corner values
/// are smoothed as defined by [`Rules::face_varying`]. Elsewhere each corner value is a mean of values of its own
/// face, so that seams are preserved. Parts of an edge or a face copy the values of the old edge or face, and new
/// edges inside faces have the value zero. Sharpness decreases where positions are smoothed and is kept
/// elsewhere. Normals are dropped.
///
/// If the result is refined again, triangles that were cut in two are treated as ordinary triangles. So each call of
/// this function can halve angles once more. Within one call, angles are halved at most once, even if the call computes
/// several levels.
///
/// If `levels` is 0 or no face is chosen, returns the compacted mesh.
///
/// # Errors
///
/// Returns [`SubdivisionError::WholeMesh`] for Butterfly, Sqrt3 and Doo-Sabin. Returns [`SubdivisionError::FlagCount`]
/// unless `faces` has one flag for each face. Returns [`SubdivisionError::NotTriangle`] if the scheme needs triangles
/// and a face is not a triangle. Returns [`SubdivisionError::TooLarge`] if a level would have more elements than there
/// are ids or take more than `budget` bytes. Returns [`SubdivisionError::TooFar`] if a coordinate is too large, and
/// [`SubdivisionError::Cancelled`] if the progress listener asks to stop.
pub fn refine_faces(
    mesh: &Mesh,
    faces: &[bool],
    rules: Rules,
    levels: u32,
    budget: u64,
    progress: &dyn Progress,
) -> Result<Mesh, SubdivisionError> {
    let is_triangles = match rules.scheme {
        Scheme::Loop(_) | Scheme::Midpoint(Split::Triangles) => true,
        Scheme::CatmullClark | Scheme::Midpoint(Split::Quads) => false,
        Scheme::Butterfly | Scheme::Sqrt3 | Scheme::DooSabin => {
            return Err(SubdivisionError::WholeMesh(rules.scheme));
        }
    };
    let n = mesh.domain_len(mesh::Domain::Face);
    if faces.len() != n {
        return Err(SubdivisionError::FlagCount {
            faces: n,
            flags: faces.len(),
        });
    }
    let mut chosen: Vec<bool> = mesh.faces().map(|f| faces[f.index()]).collect();
    let mut mesh = dense(mesh);
    check_faces(&mesh, rules.scheme)?;
    if levels == 0 || !chosen.contains(&true) {
        return Ok(mesh.into_owned());
    }

    let meter = Meter::new(progress, rules.scheme.name(), work(&mesh, &chosen, levels));
    for level in 1..=levels {
        let cuts = if is_triangles {
            Cuts::of_triangles(&mesh, &chosen, &meter)?
        } else {
            Cuts::of_polygons(&mesh, &chosen)
        };
        check_size(&mesh, &cuts, rules.scheme, level, budget)?;
        let pieces = Pieces::new(&mesh, cuts, SmoothedElements::of(&mesh, &chosen));
        let finer = finer(&mesh, &pieces, rules, &meter)?;
        chosen = pieces.inherited_flags(&chosen);
        mesh = Cow::Owned(finer);
    }
    if is_triangles {
        let cuts = Cuts::in_two(&mesh);
        check_size(&mesh, &cuts, rules.scheme, levels, budget)?;
        let pieces = Pieces::new(
            &mesh,
            cuts,
            SmoothedElements::of(&mesh, &vec![false; chosen.len()]),
        );
        // The last step, which cuts triangles with a hanging vertex in two, does not smooth positions or decrease
        // sharpness.
        let linear = Rules {
            scheme: Scheme::Midpoint(Split::Triangles),
            ..rules
        };
        mesh = Cow::Owned(finer(&mesh, &pieces, linear, &meter)?);
    }
    meter.finish()?;
    Ok(mesh.into_owned())
}

/// Computes one level of a mesh without deleted elements. `pieces` defines the parts into which faces and edges are
/// cut.
fn finer(mesh: &Mesh, pieces: &Pieces, rules: Rules, meter: &Meter) -> Result<Mesh, Cancelled> {
    let sharpness = Sharpness::of(mesh, rules);
    level::with_masks(mesh, rules, sharpness, |masks| {
        let masks = LocalMasks { pieces, masks };
        level::build(mesh, rules, sharpness, pieces, &masks, meter)
    })
}

/// Estimates how much the levels add to the progress meter. Counts only parts of chosen faces, although faces around
/// the chosen faces can also be cut.
fn work(mesh: &Mesh, chosen: &[bool], levels: u32) -> u64 {
    let kept = (mesh.n_vertices() + mesh.n_faces()) as u64;
    let n_chosen = chosen.iter().filter(|&&c| c).count() as u64;
    (1..=levels).fold(0, |sum: u64, level| {
        let new = n_chosen.saturating_mul(4_u64.saturating_pow(level));
        sum.saturating_add(kept).saturating_add(new)
    })
}

fn check_size(
    mesh: &Mesh,
    cuts: &Cuts,
    scheme: Scheme,
    level: u32,
    budget: u64,
) -> Result<(), TooLarge> {
    let [vertices, edges, faces] = cuts.counts_after(mesh);
    let size = Size {
        vertices,
        edges,
        faces,
        ..Size::of(mesh)
    };
    size.check(scheme, level..level, budget)
}

/// Iterates over the half-edges of a face, starting with its first half-edge.
fn sides(mesh: &Mesh, f: usize) -> mesh::Orbit<'_> {
    mesh.face_half_edges(FaceId::new(f))
}
