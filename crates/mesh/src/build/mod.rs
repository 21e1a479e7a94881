//! Builds a mesh from polygons, without a hash map. The result is the same for any number of threads.
//!
//! Each corner of a polygon also represents a directed side of the polygon. If the vertex of corner c is a and the next
//! vertex is b, the side of c runs from a to b. The twin of c is a corner whose side runs from b to a. The corners are
//! bucketed by vertex. Around each vertex, outgoing sides are then paired with incoming sides. The pairs also show
//! whether the faces around the vertex form one fan. In a fan, all faces are connected through edges at the vertex.
//! Edges are numbered in the order in which the polygons first use them. The first half-edge of an edge lies on the
//! polygon that first used this edge.
//!
//! ```text
//!    polygons --> buckets --> star, pair ----------------> assemble --> mesh
//!                               |  orient: reverses polygons, then starts again
//!                               |  split: copies vertices
//! ```
//!
//! By default ([`NonManifold::Split`]), input that is not a manifold is repaired, and a [`BuildReport`] lists all
//! repairs:
//!
//! - Two polygons that share an edge have a consistent orientation if their sides run along the edge in opposite
//!   directions. Polygons belong to the same part if they are connected through edges that exactly two polygons share.
//!   Each part is treated separately. If the polygons of a part can get a consistent orientation, they form two groups.
//!   The first group has the same orientation as the first polygon of the part, and the second group the opposite
//!   orientation. The smaller group is reversed. If both groups have the same size, the second group is reversed. If a
//!   part cannot get a consistent orientation, none of its polygons is reversed. The first corner of a reversed polygon
//!   stays the first.
//! - An edge between vertices a and b is not manifold if more than two polygons share it. It is also not manifold if
//!   exactly two polygons share it, and their sides still run along it in the same direction after polygons have been
//!   reversed. On a non-manifold edge, the k-th side from a to b is paired with the k-th side from b to a. The sides
//!   are counted in the order of the corners. Unpaired sides become boundary edges.
//! - If the faces around a vertex form several fans, the fan that contains the first corner at the vertex keeps the
//!   vertex. Each other fan gets a copy of the vertex. The copies come after all other vertices.
//! - A polygon that has fewer than three corners, or that contains a vertex twice, is dropped.

mod assemble;
mod buckets;
mod orient;
mod pair;
mod polygons;
mod report;
mod split;
mod star;

use glam::DVec3;
use rayon::prelude::*;

use crate::{EdgeId, FaceId, HalfEdgeId, Mesh, VertexId};
use assemble::Edges;
use buckets::Buckets;
use orient::Orientation;
use pair::{PairedSides, pair};
use polygons::{Polygons, check, flatten};
use split::split_vertices;

pub use report::{BuildReport, Elements, Repair};

/// Why a mesh could not be built from polygons.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BuildError {
    /// A polygon refers to a vertex that does not exist.
    #[error(
        "face {face} refers to vertex {vertex}, but there are {n_vertices} vertices, numbered from 0"
    )]
    NoSuchVertex {
        /// The index of the polygon.
        face: usize,
        /// The vertex that the polygon refers to.
        vertex: u32,
        /// The number of positions in the input.
        n_vertices: usize,
    },
    /// A position is infinite or not a number.
    #[error("the position of vertex {0} is not finite")]
    NotFinite(usize),
    /// The input is so large that the mesh could have more elements than there are ids.
    #[error(
        "the mesh could have up to {0} {1}, which is too many: the highest possible id is 2^32 - 2"
    )]
    TooLarge(usize, &'static str),
    /// The offsets do not divide the corners into polygons.
    #[error(
        "the offsets of the faces must be in ascending order, from 0 to the number of corners ({0})"
    )]
    BadOffsets(usize),
    /// The polygon with this index has fewer than three corners, or contains a vertex twice. Returned only if
    /// non-manifold input is refused.
    #[error(
        "the faces are not a manifold: face {0} has fewer than three corners, or contains a vertex twice"
    )]
    Degenerate(usize),
    /// More than two polygons have a side between these vertices, or the sides of two polygons run in
    /// the same direction. Returned only if non-manifold input is refused.
    #[error(
        "the faces are not a manifold: the edge {}-{} has more than two faces, or two faces that run along it in \
         the same direction",
        .0[0], .0[1]
    )]
    NonManifoldEdge([VertexId; 2]),
    /// The polygons around this vertex form several fans. Returned only if non-manifold input is refused.
    #[error("the faces are not a manifold: edges do not connect all faces around the vertex {0}")]
    NonManifoldVertex(VertexId),
}

/// How polygons that do not form a manifold are handled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NonManifold {
    /// Reverse polygons where this makes the orientation of neighbors consistent. Then split edges and vertices until
    /// the mesh is a manifold. The [`BuildReport`] lists all of these repairs.
    #[default]
    Split,
    /// Like [`Split`](Self::Split), but every polygon keeps its orientation. If two polygons run along their common
    /// edge in the same direction, the edge is split. Each of the two polygons gets its own copy of the edge, and the
    /// copies are not connected.
    SplitAsGiven,
    /// Reverse polygons where that makes the orientation consistent, and return an error if the result
    /// is not a manifold.
    Refuse,
    /// Keep the orientation of every polygon, and return an error if the polygons do not form a manifold.
    RefuseAsGiven,
}

/// A mesh built from polygons, and the maps from the corners and polygons of the input to the elements of the mesh.
#[derive(Clone, Debug)]
pub struct BuildOutput {
    /// The mesh that was built.
    pub mesh: Mesh,
    /// The repairs that made the mesh a manifold.
    pub report: BuildReport,
    /// For each corner of the input, a half-edge of the face that was made from the corner's polygon: the half-edge
    /// that leaves the corner's vertex. `NONE` if the polygon was dropped. On a reversed polygon, this half-edge runs
    /// along the side that ends at the corner in the input; see [`edges_of_sides`](Self::edges_of_sides).
    pub half_edge_of_corner: Vec<HalfEdgeId>,
    /// For each polygon of the input, its face; `NONE` if the polygon was dropped.
    pub face_of_polygon: Vec<FaceId>,
}

impl BuildOutput {
    /// Returns, for each corner of the input, the edge of the side that starts at this corner; `NONE` if the
    /// polygon was dropped. `offsets` must be the offsets of the input.
    ///
    /// # Panics
    ///
    /// Panics if `offsets` do not match the corners.
    pub fn edges_of_sides(&self, offsets: &[u32]) -> Vec<EdgeId> {
        let mut edges = Vec::with_capacity(self.half_edge_of_corner.len());
        for w in offsets.windows(2) {
            let half_edges = &self.half_edge_of_corner[w[0] as usize..w[1] as usize];
            let following = half_edges.iter().cycle().skip(1);
            edges.extend(half_edges.iter().zip(following).map(|(&h, &next)| {
                // A side joins two corners. The half-edge on the side starts at one of these two corners.
                match h.some() {
                    None => EdgeId::NONE,
                    Some(h) if self.mesh.next(h) == next => h.edge(),
                    Some(_) => next.edge(),
                }
            }));
        }
        edges
    }
}

impl Mesh {
    /// Builds a mesh from polygons, given as lists of vertex indices in counter-clockwise order.
    ///
    /// Polygons that have fewer than three corners, or that contain a vertex twice, are dropped. If none of the
    /// polygons 0 to i is dropped, polygon i becomes face i. The [module](mod@crate::build) documents how non-manifold
    /// input is repaired.
    ///
    /// # Errors
    ///
    /// Returns [`BuildError`] for an index out of range, a position that is not finite, or too many
    /// elements.
    ///
    /// # Examples
    ///
    /// ```
    /// use mesh::{DVec3, Mesh};
    ///
    /// let (mesh, report) = Mesh::from_polygons(
    ///     vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y],
    ///     &[vec![0, 1, 2], vec![0, 2, 3]],
    /// )?;
    /// assert_eq!((mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()), (4, 5, 2));
    /// assert!(report.is_clean());
    /// # Ok::<(), mesh::BuildError>(())
    /// ```
    pub fn from_polygons(
        positions: Vec<DVec3>,
        polygons: &[impl AsRef<[u32]> + Sync],
    ) -> Result<(Self, BuildReport), BuildError> {
        let (offsets, corners) = flatten(polygons)?;
        let built = build(positions, &offsets, &corners, NonManifold::Split)?;
        Ok((built.mesh, built.report))
    }
}

/// Builds a mesh from polygons: polygon i has the corners `corners[offsets[i]..offsets[i + 1]]`,
/// which are indices into `positions`, counter-clockwise.
///
/// # Errors
///
/// Returns an error in the same cases as [`Mesh::from_polygons`], and [`BuildError::BadOffsets`] if the offsets do not
/// divide the corners into polygons. If `non_manifold` refuses non-manifold input and the input is not a manifold,
/// returns [`BuildError::Degenerate`], [`BuildError::NonManifoldEdge`] or [`BuildError::NonManifoldVertex`].
pub fn build(
    positions: Vec<DVec3>,
    offsets: &[u32],
    corners: &[u32],
    non_manifold: NonManifold,
) -> Result<BuildOutput, BuildError> {
    // Building allocates at most this many bytes at the same time, not counting the input.
    crate::require_memory(32 * corners.len() + 16 * positions.len());
    let degenerate = check(&positions, offsets, corners)?;
    if degenerate.is_empty() {
        return build_clean(positions, offsets, corners, non_manifold);
    }
    if matches!(
        non_manifold,
        NonManifold::Refuse | NonManifold::RefuseAsGiven
    ) {
        return Err(BuildError::Degenerate(degenerate[0]));
    }
    build_without(positions, offsets, corners, degenerate, non_manifold)
}

/// Builds a mesh without the polygons listed in `dropped`. The maps of the result have `NONE` for these polygons and
/// for their corners.
fn build_without(
    positions: Vec<DVec3>,
    offsets: &[u32],
    corners: &[u32],
    dropped: Vec<usize>,
    non_manifold: NonManifold,
) -> Result<BuildOutput, BuildError> {
    let mut is_kept = vec![true; offsets.len() - 1];
    for &face in &dropped {
        is_kept[face] = false;
    }
    let kept: Vec<usize> = (0..is_kept.len()).filter(|&face| is_kept[face]).collect();
    let range = |face: usize| offsets[face] as usize..offsets[face + 1] as usize;
    let polygons: Vec<&[u32]> = kept.iter().map(|&face| &corners[range(face)]).collect();
    let (kept_offsets, kept_corners) = flatten(&polygons)?;
    let mut built = build_clean(positions, &kept_offsets, &kept_corners, non_manifold)?;

    let mut half_edge_of_corner = vec![HalfEdgeId::NONE; corners.len()];
    let mut face_of_polygon = vec![FaceId::NONE; is_kept.len()];
    for (i, &face) in kept.iter().enumerate() {
        let half_edges = kept_offsets[i] as usize..kept_offsets[i + 1] as usize;
        half_edge_of_corner[range(face)].copy_from_slice(&built.half_edge_of_corner[half_edges]);
        face_of_polygon[face] = built.face_of_polygon[i];
    }
    built.half_edge_of_corner = half_edge_of_corner;
    built.face_of_polygon = face_of_polygon;
    let report = &mut built.report;
    for face in report
        .reversed_faces
        .iter_mut()
        .chain(&mut report.unorientable)
    {
        *face = kept[*face];
    }
    report.dropped_faces = dropped;
    Ok(built)
}

/// Builds a mesh from polygons. Requires that each polygon has at least three corners and contains no vertex twice.
fn build_clean(
    mut positions: Vec<DVec3>,
    offsets: &[u32],
    corners: &[u32],
    non_manifold: NonManifold,
) -> Result<BuildOutput, BuildError> {
    let polygons = Polygons::new(offsets, corners);
    let buckets = Buckets::new(positions.len(), corners);
    let mut paired = pair(&polygons, &buckets);
    let as_given = match non_manifold {
        NonManifold::Split => NonManifold::SplitAsGiven,
        NonManifold::Refuse => NonManifold::RefuseAsGiven,
        as_given => as_given,
    };
    if paired.has_inconsistent_edge && non_manifold != as_given {
        drop(paired);
        let orientation = Orientation::of(&polygons, &buckets);
        return build_reoriented(positions, offsets, corners, orientation, as_given);
    }
    if as_given == NonManifold::RefuseAsGiven {
        check_manifold(&paired)?;
    }
    let split = split_vertices(&mut positions, &polygons, &buckets, &mut paired)?;
    drop(buckets);

    let edges = Edges::number(&paired.twin);
    let outgoing = paired.outgoing.par_iter();
    let vertex_half_edge = outgoing
        .map(|outgoing| outgoing.half_edge(&edges.half_edge_of_corner))
        .collect();
    let arrays = edges.arrays(&polygons, &paired.twin, &split.origins, vertex_half_edge);
    Ok(BuildOutput {
        mesh: Mesh::from_arrays(arrays, positions),
        report: BuildReport {
            split_edges: paired.non_manifold_edges,
            split_vertices: split.copies,
            ..<_>::default()
        },
        half_edge_of_corner: edges.half_edge_of_corner,
        face_of_polygon: (0..polygons.n()).into_par_iter().map(FaceId::new).collect(),
    })
}

fn check_manifold(paired: &PairedSides) -> Result<(), BuildError> {
    if let Some(&edge) = paired.non_manifold_edges.first() {
        return Err(BuildError::NonManifoldEdge(edge));
    }
    let pinched = paired.pinched.first().map(|&v| VertexId::new(v as usize));
    pinched.map_or(Ok(()), |v| Err(BuildError::NonManifoldVertex(v)))
}

/// Builds a mesh with some polygons reversed. In the result, the map from corners to half-edges numbers the corners as
/// before the reversal.
fn build_reoriented(
    positions: Vec<DVec3>,
    offsets: &[u32],
    corners: &[u32],
    orientation: Orientation,
    as_given: NonManifold,
) -> Result<BuildOutput, BuildError> {
    let mut reoriented = corners.to_vec();
    orientation.reverse(offsets, &mut reoriented);
    let mut built = build_clean(positions, offsets, &reoriented, as_given)?;
    orientation.reverse(offsets, &mut built.half_edge_of_corner);
    built.report.reversed_faces = orientation.reversed;
    built.report.unorientable = orientation.unorientable;
    Ok(built)
}

#[cfg(test)]
mod tests;
