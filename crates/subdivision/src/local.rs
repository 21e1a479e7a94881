//! Levels of some faces only, and what keeps the mesh without cracks around them.
//!
//! # Triangles
//!
//! Chosen triangles are cut into four ("red"). A new vertex on an edge between a red triangle and one that is
//! not hangs on that: it is kept, for the levels, as a fourth corner in the middle of a straight side. A
//! triangle on which a second vertex would come to hang, on the same side or on another one, is cut into
//! four too, and so on, so that sizes change by steps of two. After the last level triangles with a hanging
//! vertex are cut in two ("green"):
//!
//! ```text
//!            c                              c
//!          / | \                          / | \
//!        /   |   \                      /   |   y
//!      /     |     \                  /     | / | \
//!    a       |  red  d     -->      a ----- x   |   d      x: on an edge of a red triangle and one
//!      \     |     /                  \     | \ | /           that is not, so in the middle;
//!        \   |   /                      \   |   z             a-x makes two green triangles
//!          \ | /                          \ | /
//!            b                              b
//! ```
//!
//! All pieces are similar to their old triangle or half of one that is, so that angles do not get smaller
//! with the levels: the cotangent of the smallest is at most three times what it was. Bank, Sherman and
//! Weiser, "Refinement Algorithms and Data Structures for Regular Local Mesh Refinement", 1983.
//!
//! # Polygons
//!
//! Chosen faces are cut into a quad for each corner. Faces beside them get the new vertices on common edges
//! as additional corners and are not cut.

mod area;
mod closure;
mod drawing;
mod pieces;

use mesh::{FaceId, Mesh};
use op::{OpError, Progress};

use crate::forecast::Size;
use crate::level;
use crate::masks::{AnyMasks, CatmullClarkMasks, LoopMasks, MidpointMasks};
use crate::meter::Meter;
use crate::sharpness::Sharpness;
use crate::{Rules, Scheme, Split, check_faces};

use area::{Area, AreaMasks};
use closure::Cuts;
use pieces::Pieces;

/// The mesh after so many levels of some of its faces: each level refines them and all that they became.
///
/// For Loop, Catmull-Clark and Midpoint. Around the chosen faces triangles are cut so that no vertex lies on
/// an edge of another one, in four or in two; with polygons the neighbors get additional corners. The surface
/// outside of the chosen faces stays as it was, point by point: vertices between two chosen faces, or on the
/// boundary of one, follow the masks of the scheme, old vertices do so if all their faces are chosen, and all
/// other new vertices lie in the middle of edges. If all faces are chosen, the result is that of
/// [`subdivide`](crate::subdivide).
///
/// Ids: old vertices keep their numbers, new ones follow, level by level in order of the edges that they lie
/// on, then in order of the faces. The parts of an edge stand together, from the end that its first half
/// leaves to the other, and so do those of a face; the edges inside of faces follow those that were there,
/// in order of their faces. A mesh with dead elements is compacted first.
///
/// Vertex attributes have the weights of the positions. Corner values are means within their own face, so
/// that seams stay seams, and smoothed by [`Rules::face_varying`] where the positions are. Parts of an edge
/// or a face take the values of the whole, edges inside have zero. Sharpness fades where the scheme smooths
/// and is kept elsewhere. Normals are left out.
///
/// The mesh can be refined again: triangles that were cut in two are triangles like others then. So each
/// call can cut angles once more, but not each level.
///
/// Nothing changes for no levels and where no face is chosen.
///
/// # Errors
///
/// [`OpError::Parameter`] for other schemes and unless `faces` has one value for each face,
/// [`OpError::Refused`] with [`Refusal::NotTriangle`](op::Refusal::NotTriangle) if the scheme needs triangles
/// and a face has more corners, [`OpError::Budget`] if the elements would outnumber the ids,
/// [`OpError::Cancelled`].
pub fn refine_faces(
    mesh: &Mesh,
    faces: &[bool],
    rules: Rules,
    levels: u32,
    progress: &dyn Progress,
) -> Result<Mesh, OpError> {
    refine_within(mesh, faces, rules, levels, u64::MAX, progress)
}

/// [`refine_faces`] unless the mesh takes more than `budget` bytes on some level.
pub(crate) fn refine_within(
    mesh: &Mesh,
    faces: &[bool],
    rules: Rules,
    levels: u32,
    budget: u64,
    progress: &dyn Progress,
) -> Result<Mesh, OpError> {
    let is_triangles = match rules.scheme {
        Scheme::Loop(_) | Scheme::Midpoint(Split::Triangles) => true,
        Scheme::CatmullClark | Scheme::Midpoint(Split::Quads) => false,
        Scheme::Butterfly | Scheme::Sqrt3 | Scheme::DooSabin => {
            let name = rules.scheme.name();
            let message = format!("{name} cannot refine some of the faces only");
            return Err(OpError::Parameter(message));
        }
    };
    let n = mesh.domain_len(mesh::Domain::Face);
    if faces.len() != n {
        let message = format!(
            "expected a choice for each of {n} faces, not {}",
            faces.len()
        );
        return Err(OpError::Parameter(message));
    }
    let mut chosen: Vec<bool> = mesh.faces().map(|f| faces[f.index()]).collect();
    let mut mesh = mesh.clone();
    mesh.compact();
    check_faces(&mesh, rules.scheme)?;
    if levels == 0 || !chosen.contains(&true) {
        return Ok(mesh);
    }

    let meter = Meter::new(progress, rules.scheme.name(), work(&mesh, &chosen, levels));
    for level in 1..=levels {
        let cuts = if is_triangles {
            Cuts::of_triangles(&mesh, &chosen, &meter)?
        } else {
            Cuts::of_polygons(&mesh, &chosen)
        };
        check_size(&mesh, &cuts, level, budget)?;
        let pieces = Pieces::new(&mesh, cuts, Area::of(&mesh, &chosen));
        let finer = finer(&mesh, &pieces, rules, &meter)?;
        chosen = pieces.inherited(&chosen);
        mesh = finer;
    }
    if is_triangles {
        let cuts = Cuts::in_two(&mesh);
        check_size(&mesh, &cuts, levels, budget)?;
        let pieces = Pieces::new(&mesh, cuts, Area::of(&mesh, &vec![false; chosen.len()]));
        // Nothing is smoothed, and nothing fades.
        let linear = Rules {
            scheme: Scheme::Midpoint(Split::Triangles),
            ..rules
        };
        mesh = finer(&mesh, &pieces, linear, &meter)?;
    }
    meter.finish()?;
    Ok(mesh)
}

/// One level of a dense mesh.
fn finer(mesh: &Mesh, pieces: &Pieces, rules: Rules, meter: &Meter) -> Result<Mesh, OpError> {
    let run = |masks: &dyn AnyMasks, sharpness: Option<Sharpness>| {
        let masks = AreaMasks { pieces, masks };
        level::finer(mesh, rules, meter, pieces, &masks, sharpness)
    };
    let sharpness = Sharpness::of(mesh, rules);
    match rules.scheme {
        Scheme::Loop(weights) => {
            let masks = LoopMasks {
                mesh,
                sharpness,
                weights,
            };
            run(&masks, Some(sharpness))
        }
        Scheme::CatmullClark => {
            let masks = CatmullClarkMasks { mesh, sharpness };
            run(&masks, Some(sharpness))
        }
        _ => {
            let split = Split::Quads;
            let masks = MidpointMasks { mesh, split };
            run(&masks, None)
        }
    }
}

/// About how much the levels add to the meter, without what is cut around the chosen faces.
fn work(mesh: &Mesh, chosen: &[bool], levels: u32) -> u64 {
    let kept = (mesh.n_vertices() + mesh.n_faces()) as u64;
    let n_chosen = chosen.iter().filter(|&&c| c).count() as u64;
    (1..=levels).fold(0, |sum: u64, level| {
        let new = n_chosen.saturating_mul(4_u64.saturating_pow(level));
        sum.saturating_add(kept).saturating_add(new)
    })
}

fn check_size(mesh: &Mesh, cuts: &Cuts, level: u32, budget: u64) -> Result<(), OpError> {
    let counts = cuts.counts_after(mesh);
    Size::of(mesh)
        .check_counts(counts, level, budget)
        .map_err(|too_large| OpError::Budget(too_large.message()))
}

/// The sides of a face in order, from its first half-edge.
fn sides(mesh: &Mesh, f: usize) -> mesh::Orbit<'_> {
    mesh.face_half_edges(FaceId::new(f))
}
