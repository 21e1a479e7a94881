//! Merging vertices that lie near each other.
//!
//! ```text
//!    +-----+ +-----+            +-----+-----+
//!    |     a b     |            |     |     |       a, b become the one of the lower number,
//!    |     | |     |    -->     |     |     |       where that is; the two edges become one
//!    |     c d     |            |     |     |
//!    +-----+ +-----+            +-----+-----+
//! ```
//!
//! [`clusters`] finds which vertices belong together, [`merge_clusters`] makes them one and builds
//! the mesh again from its polygons.

mod cluster;
mod union_find;

use mesh::{
    BuildError, BuildOutput, BuildReport, CORNER_NORMAL, Domain, EdgeId, FaceId, HalfEdgeId, Mesh,
    NonManifold, Sources, VERTEX_NORMAL, VertexId, build,
};
use progress::{Cancelled, Progress};

pub use cluster::clusters;

/// What was merged, and what became of the faces.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Merged {
    /// How many vertices became part of another.
    pub vertices: usize,
    /// How many faces have fewer corners than before, but enough.
    pub smaller_faces: usize,
    /// What was done to make the result a manifold; its dropped faces are those that are gone.
    pub report: BuildReport,
}

/// Why vertices were not merged. The mesh is unchanged.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MergeError {
    /// The distance is negative or not finite.
    #[error("`distance` must be 0 or a positive number, not {0}")]
    Distance(f64),
    /// The computation was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The result is not a mesh.
    #[error(transparent)]
    Build(#[from] BuildError),
}

/// Merges vertices at most `distance` apart, and all that such steps connect.
///
/// Two vertices at 0.9 times the distance always merge, wherever they lie, and two at 1.1 times only
/// through others between them. Neither depends on the order of vertices or on the number of threads.
/// A distance of 0 merges equal positions.
///
/// [`merge_clusters`] tells what becomes of everything. If no two vertices merge, nothing changes at all.
///
/// # Errors
///
/// [`MergeError::Distance`] if the distance is negative or not finite, [`MergeError::Cancelled`], and those of
/// [`merge_clusters`]. The mesh is unchanged.
///
/// # Panics
///
/// If the mesh is not dense.
///
/// # Examples
///
/// ```
/// use mesh::{DVec3, Mesh};
///
/// let points = [0.0, 1.0, 2.0, 0.0, 1.0, 2.0].map(|x| DVec3::new(x, x * x, 0.0));
/// let (mut mesh, _) = Mesh::from_polygons(points.to_vec(), &[[0, 1, 2], [5, 4, 3]])?;
/// let merged = geometry::merge_vertices(&mut mesh, 0.0, &progress::NoProgress)?;
/// assert_eq!((merged.vertices, mesh.n_vertices()), (3, 3));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn merge_vertices(
    mesh: &mut Mesh,
    distance: f64,
    progress: &dyn Progress,
) -> Result<Merged, MergeError> {
    if !(distance >= 0.0 && distance.is_finite()) {
        return Err(MergeError::Distance(distance));
    }
    if let Some(v) = mesh.positions().iter().position(|p| !p.is_finite()) {
        return Err(BuildError::NotFinite(v).into());
    }
    let lowest = clusters(mesh.positions(), distance, progress)?;
    if (0..).zip(&lowest).all(|(v, &low): (u32, _)| v == low) {
        return Ok(Merged::default());
    }
    Ok(merge_clusters(mesh, &lowest)?)
}

/// Makes each cluster of vertices one: `lowest` has for each vertex the lowest of those it merges with,
/// its own number if it is that. The mesh must be dense.
///
/// The merged vertex has the position and the values of the lowest; the others go, and numbers close
/// up. Edges between the same two vertices become one, with the values of the first. Faces keep their
/// order and values, and corners theirs, so that seams are kept.
///
/// A face loses corners that merge with the next one around it, and goes if fewer than three are left
/// or if it would visit a vertex twice. Where faces that hang together then run different ways round,
/// the smaller number of them is reversed if that makes all agree, and normals are dropped. Where the
/// result would still not be a manifold it is split, as [`build()`] does: of three faces at one edge the
/// third gets its own.
///
/// # Errors
///
/// [`BuildError`] if a position is not finite, or if the result could have more vertices than ids can
/// number. The mesh is unchanged.
///
/// # Panics
///
/// If the mesh is not dense, or `lowest` has not one number for each vertex, or one names no vertex.
pub fn merge_clusters(mesh: &mut Mesh, lowest: &[u32]) -> Result<Merged, BuildError> {
    assert!(mesh.is_dense(), "the mesh must be dense");
    assert_eq!(
        lowest.len(),
        mesh.n_vertices(),
        "one number for each vertex"
    );
    let polygons = Polygons::of(mesh, lowest);
    let built = build(
        polygons.kept.iter().map(|&v| mesh.position(v)).collect(),
        &polygons.offsets,
        &polygons.corners,
        NonManifold::Split,
    )?;
    let merged = Merged {
        vertices: lowest.len() - polygons.kept.len(),
        smaller_faces: polygons.reduced,
        report: built.report.clone(),
    };
    mesh.replace(polygons.with_attributes(mesh, built));
    Ok(merged)
}

/// The faces of a mesh over the vertices that are left.
struct Polygons {
    /// The vertices that are left, by their old numbers.
    kept: Vec<VertexId>,
    offsets: Vec<u32>,
    corners: Vec<u32>,
    /// For each corner the half-edge that it was.
    half_edges: Vec<HalfEdgeId>,
    /// How many faces have fewer corners than before, but enough.
    reduced: usize,
}

impl Polygons {
    /// `lowest` has for each vertex the lowest number of those that it merges with.
    fn of(mesh: &Mesh, lowest: &[u32]) -> Self {
        let mut kept = Vec::new();
        let mut number = vec![0; lowest.len()];
        for (v, (&low, i)) in lowest.iter().zip(0_u32..).enumerate() {
            // The lowest one comes before all others of its cluster.
            if low == i {
                number[v] = to_u32(kept.len());
                kept.push(VertexId::new(v));
            } else {
                number[v] = number[low as usize];
            }
        }
        let mut offsets = vec![0];
        let (mut corners, mut half_edges) = (Vec::new(), Vec::new());
        let mut reduced = 0;
        for f in mesh.faces() {
            let first = corners.len();
            let mut is_smaller = false;
            for h in mesh.face_half_edges(f) {
                let [v, w] = [mesh.origin(h), mesh.target(h)].map(|v| number[v.index()]);
                // A side that shrinks to a point goes, and the corner at its origin with it.
                if v == w {
                    is_smaller = true;
                } else {
                    corners.push(v);
                    half_edges.push(h);
                }
            }
            reduced += usize::from(is_smaller && corners.len() - first >= 3);
            // No more corners than before, and those had ids.
            offsets.push(to_u32(corners.len()));
        }
        Self {
            kept,
            offsets,
            corners,
            half_edges,
            reduced,
        }
    }

    /// The built mesh with the attributes of the old one.
    fn with_attributes(self, old: &Mesh, built: BuildOutput) -> Mesh {
        let edges_of_sides = built.edges_of_sides(&self.offsets);
        let has_reversed = !built.report.reversed_faces.is_empty();
        let mut mesh = built.mesh;
        let mut vertices = self.kept;
        // Copies stand behind all others, in this order.
        for (original, _) in &built.report.split_vertices {
            vertices.push(vertices[original.index()]);
        }
        let mut corners = vec![HalfEdgeId::NONE; mesh.n_half_edges()];
        let mut edges = vec![EdgeId::NONE; mesh.n_edges()];
        let sides = edges_of_sides.iter().zip(&built.half_edge_of_corner);
        for (&old_h, (&e, &h)) in self.half_edges.iter().zip(sides) {
            if h != HalfEdgeId::NONE {
                corners[h.index()] = old_h;
                // `NONE` is above all ids.
                let edge = &mut edges[e.index()];
                *edge = old_h.edge().min(*edge);
            }
        }
        let faces: Vec<FaceId> = old
            .faces()
            .zip(&built.face_of_polygon)
            .filter(|&(_, &f)| f != FaceId::NONE)
            .map(|(old_f, _)| old_f)
            .collect();
        let mut attributes = old.attributes().gathered(Sources {
            vertices: &vertices,
            corners: &corners,
            edges: &edges,
            faces: &faces,
        });
        attributes.drop_by_rule();
        if has_reversed {
            // They would point to the other side of the faces that were reversed.
            attributes.remove(Domain::Vertex, VERTEX_NORMAL.name);
            attributes.remove(Domain::Corner, CORNER_NORMAL.name);
        }
        mesh.set_attributes(attributes);
        mesh
    }
}

fn to_u32(n: usize) -> u32 {
    u32::try_from(n).expect("ids of a mesh fit 32 bits")
}
