//! Building a mesh from polygons: without a hash map, the same for any number of threads.
//!
//! A corner c of a polygon stands for the directed side from its vertex a to the next vertex b. Its
//! twin is the corner of a side from b to a. The corners are sorted by their vertices; around each
//! vertex the sides that leave it are then paired with those that come to it, which also tells
//! whether its faces are one fan. Edges are numbered in the order in which the polygons first name
//! them, and the first half of an edge lies on the polygon that named it.
//!
//! ```text
//!    polygons --> buckets --> star, pair ----------------> assemble --> mesh
//!                               |  orient: once more from the start, polygons turned
//!                               |  split: copies of vertices
//! ```
//!
//! What is not a manifold is changed until it is, and everything that was done is listed in a
//! [`BuildReport`]:
//!
//! - Where neighbors run the same way along the edge between them, and turning some of the polygons
//!   round makes all neighbors agree, that is done: of polygons that hang together through edges with
//!   two sides, the minority is turned; of two halves the one without the first polygon. The first
//!   corner of a polygon stays the first. Parts that have no consistent orientation stay as they are.
//! - Of more than two sides between the same two vertices, or two that still run the same way, the
//!   k-th from a to b is paired with the k-th from b to a, in order of corners; the rest are boundary.
//! - Where the faces around a vertex form several fans that share no edge, the fan of the first
//!   corner keeps the vertex and each other fan gets a copy of it, behind all others.
//! - A polygon with fewer than three corners, or that visits a vertex twice, is left out.

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
use pair::{Paired, pair};
use polygons::{Polygons, check, flatten};
use split::split_vertices;

pub use report::{BuildReport, Elements, Repair};

/// Why polygons could not become a mesh.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BuildError {
    /// A polygon names a vertex that does not exist.
    #[error("face {face} refers to vertex {vertex}, but there are {n_vertices} vertices")]
    NoSuchVertex {
        /// The polygon, from 0.
        face: usize,
        /// What it names.
        vertex: u32,
        /// How many positions were given.
        n_vertices: usize,
    },
    /// A position is infinite or not a number.
    #[error("the position of vertex {0} is not finite")]
    NotFinite(usize),
    /// The ids would not fit.
    #[error("{0} {1} are more than a mesh can hold")]
    TooLarge(usize, &'static str),
    /// The offsets do not divide the corners into polygons.
    #[error("the offsets of the faces must rise from 0 to the number of corners, {0}")]
    BadOffsets(usize),
    /// This polygon has a vertex as a corner twice, and that was to be refused.
    #[error("the faces are not a manifold: face {0} visits a vertex twice")]
    VisitsTwice(usize),
    /// More than two polygons have a side between these vertices, or two that run the same way, and that was
    /// to be refused.
    #[error(
        "the faces are not a manifold: the edge {}-{} has more than two faces, or two that run the same way",
        .0[0], .0[1]
    )]
    CrowdedEdge([VertexId; 2]),
    /// The polygons around this vertex are several fans, and that was to be refused.
    #[error("the faces are not a manifold: {0} joins faces that share no edge")]
    PinchedVertex(VertexId),
}

/// What to do where polygons do not form a manifold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NonManifold {
    /// Turn polygons round where that makes neighbors agree, split edges and vertices until the rest
    /// is a manifold, and report it.
    #[default]
    Split,
    /// As [`Split`](Self::Split), but every polygon keeps its orientation: neighbors that run the same
    /// way along an edge are split there.
    SplitAsGiven,
    /// Turn polygons round where that makes neighbors agree, and refuse the polygons if
    /// the rest is no manifold.
    Refuse,
    /// Refuse the polygons unless they are a manifold as they are.
    RefuseAsGiven,
}

/// A mesh built from polygons, and where each corner and polygon went.
#[derive(Clone, Debug)]
pub struct Built {
    /// The mesh.
    pub mesh: Mesh,
    /// What was done to make it a manifold.
    pub report: BuildReport,
    /// For each corner of the input its half-edge: the one that leaves the corner's vertex on the
    /// face of its polygon. `NONE` if the polygon was left out. On polygons that were turned round it
    /// runs along the side before the corner; see [`edges_of_sides`](Self::edges_of_sides).
    pub half_edge_of_corner: Vec<HalfEdgeId>,
    /// For each polygon of the input its face; `NONE` if it was left out.
    pub face_of_polygon: Vec<FaceId>,
}

impl Built {
    /// For each corner of the input the edge that became of the side from it to the next corner of
    /// its polygon; `NONE` if the polygon was left out. `offsets` are those of the input.
    ///
    /// # Panics
    ///
    /// If `offsets` do not divide the corners.
    pub fn edges_of_sides(&self, offsets: &[u32]) -> Vec<EdgeId> {
        let mut edges = Vec::with_capacity(self.half_edge_of_corner.len());
        for w in offsets.windows(2) {
            let half_edges = &self.half_edge_of_corner[w[0] as usize..w[1] as usize];
            let ahead = half_edges.iter().cycle().skip(1);
            edges.extend(half_edges.iter().zip(ahead).map(|(&h, &next)| {
                // The half-edge of one of the two corners lies on their side.
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
    /// A mesh of polygons given as lists of vertex indices, counter-clockwise.
    ///
    /// Polygon i becomes face i unless a degenerate one before it was left out. For input that is not
    /// a manifold see the [module](mod@crate::build).
    ///
    /// # Errors
    ///
    /// [`BuildError`] for an index out of range, a position that is not finite, too many elements.
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
/// indices of `positions`, counter-clockwise.
///
/// # Errors
///
/// As [`Mesh::from_polygons`], and [`BuildError::VisitsTwice`], [`BuildError::CrowdedEdge`] or
/// [`BuildError::PinchedVertex`] if what is not a manifold is to be refused.
pub fn build(
    positions: Vec<DVec3>,
    offsets: &[u32],
    corners: &[u32],
    non_manifold: NonManifold,
) -> Result<Built, BuildError> {
    let degenerate = check(&positions, offsets, corners)?;
    if degenerate.is_empty() {
        return build_clean(positions, offsets, corners, non_manifold);
    }
    if matches!(
        non_manifold,
        NonManifold::Refuse | NonManifold::RefuseAsGiven
    ) {
        return Err(BuildError::VisitsTwice(degenerate[0]));
    }
    build_without(positions, offsets, corners, degenerate, non_manifold)
}

/// Builds without the polygons listed in `dropped` and puts gaps into the maps of the result.
fn build_without(
    positions: Vec<DVec3>,
    offsets: &[u32],
    corners: &[u32],
    dropped: Vec<usize>,
    non_manifold: NonManifold,
) -> Result<Built, BuildError> {
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

/// Builds from polygons of which none is degenerate.
fn build_clean(
    mut positions: Vec<DVec3>,
    offsets: &[u32],
    corners: &[u32],
    non_manifold: NonManifold,
) -> Result<Built, BuildError> {
    let polygons = Polygons::new(offsets, corners);
    let buckets = Buckets::new(positions.len(), corners);
    let mut paired = pair(&polygons, &buckets);
    let as_given = match non_manifold {
        NonManifold::Split => NonManifold::SplitAsGiven,
        NonManifold::Refuse => NonManifold::RefuseAsGiven,
        as_given => as_given,
    };
    if paired.has_turned && non_manifold != as_given {
        drop(paired);
        let orientation = Orientation::of(&polygons, &buckets);
        return build_turned(positions, offsets, corners, orientation, as_given);
    }
    if as_given == NonManifold::RefuseAsGiven {
        refuse(&paired)?;
    }
    let split = split_vertices(&mut positions, &polygons, &buckets, &mut paired)?;
    drop(buckets);

    let edges = Edges::number(&paired.twin);
    let leaving = paired.leaving.par_iter();
    let vertex_half_edge = leaving
        .map(|leaving| leaving.half_edge(&edges.half_edge_of_corner))
        .collect();
    let arrays = edges.arrays(&polygons, &paired.twin, &split.origins, vertex_half_edge);
    Ok(Built {
        mesh: Mesh::from_arrays(arrays, positions),
        report: BuildReport {
            split_edges: paired.crowded,
            split_vertices: split.copies,
            ..<_>::default()
        },
        half_edge_of_corner: edges.half_edge_of_corner,
        face_of_polygon: (0..polygons.n()).into_par_iter().map(FaceId::new).collect(),
    })
}

fn refuse(paired: &Paired) -> Result<(), BuildError> {
    if let Some(&edge) = paired.crowded.first() {
        return Err(BuildError::CrowdedEdge(edge));
    }
    let pinched = paired.pinched.first().map(|&v| VertexId::new(v as usize));
    pinched.map_or(Ok(()), |v| Err(BuildError::PinchedVertex(v)))
}

/// Builds with some polygons turned round, in a corner map as if they were not.
fn build_turned(
    positions: Vec<DVec3>,
    offsets: &[u32],
    corners: &[u32],
    orientation: Orientation,
    as_given: NonManifold,
) -> Result<Built, BuildError> {
    let mut turned = corners.to_vec();
    orientation.reverse(offsets, &mut turned);
    let mut built = build_clean(positions, offsets, &turned, as_given)?;
    orientation.reverse(offsets, &mut built.half_edge_of_corner);
    built.report.reversed_faces = orientation.reversed;
    built.report.unorientable = orientation.unorientable;
    Ok(built)
}

#[cfg(test)]
mod tests;
