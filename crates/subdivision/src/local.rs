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

use std::borrow::Cow;

use mesh::{FaceId, Mesh};
use progress::{Cancelled, Meter, Progress};

use crate::error::SubdivisionError;
use crate::input::{check_faces, dense};
use crate::level;
use crate::rules::{Rules, Scheme, Split};
use crate::sharpness::Sharpness;
use crate::size::{Size, TooLarge};

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
/// [`SubdivisionError::WholeMesh`] for other schemes, [`SubdivisionError::Choices`] unless `faces` has one value
/// for each face, [`SubdivisionError::NotTriangle`] if the scheme needs triangles and a face has more corners,
/// [`SubdivisionError::TooLarge`] if on some level the elements would outnumber the ids or take more than `budget`
/// bytes, [`SubdivisionError::Cancelled`].
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
        return Err(SubdivisionError::Choices {
            faces: n,
            choices: faces.len(),
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
        let pieces = Pieces::new(&mesh, cuts, Area::of(&mesh, &chosen));
        let finer = finer(&mesh, &pieces, rules, &meter)?;
        chosen = pieces.inherited(&chosen);
        mesh = Cow::Owned(finer);
    }
    if is_triangles {
        let cuts = Cuts::in_two(&mesh);
        check_size(&mesh, &cuts, rules.scheme, levels, budget)?;
        let pieces = Pieces::new(&mesh, cuts, Area::of(&mesh, &vec![false; chosen.len()]));
        // Nothing is smoothed, and nothing fades.
        let linear = Rules {
            scheme: Scheme::Midpoint(Split::Triangles),
            ..rules
        };
        mesh = Cow::Owned(finer(&mesh, &pieces, linear, &meter)?);
    }
    meter.finish()?;
    Ok(mesh.into_owned())
}

/// One level of a dense mesh.
fn finer(mesh: &Mesh, pieces: &Pieces, rules: Rules, meter: &Meter) -> Result<Mesh, Cancelled> {
    let sharpness = Sharpness::of(mesh, rules);
    level::with_masks(mesh, rules, sharpness, |masks| {
        let masks = AreaMasks { pieces, masks };
        level::build(mesh, rules, sharpness, pieces, &masks, meter)
    })
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

/// The sides of a face in order, from its first half-edge.
fn sides(mesh: &Mesh, f: usize) -> mesh::Orbit<'_> {
    mesh.face_half_edges(FaceId::new(f))
}
