//! Merges vertices that lie near each other.
//!
//! ```text
//!    +-----+ +-----+            +-----+-----+
//!    |     a b     |            |     |     |       a and b become the vertex with the lower
//!    |     | |     |    -->     |     |     |       id, and the two edges become one
//!    |     c d     |            |     |     |
//!    +-----+ +-----+            +-----+-----+
//! ```
//!
//! [`clusters`] finds the vertices that belong together. [`merge_clusters`] merges the vertices of each cluster
//! and rebuilds the mesh from its polygons.

mod cluster;
mod equal;
pub(crate) mod union_find;

use mesh::{
    BuildError, BuildOutput, BuildReport, CORNER_NORMAL, Domain, EdgeId, FaceId, HalfEdgeId, Mesh,
    NonManifold, Sources, VERTEX_NORMAL, VertexId, build,
};
use progress::{Cancelled, Progress};

pub use cluster::clusters;
pub use equal::first_equal;

/// The result of merging: counts of merged vertices and changed faces.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Merged {
    /// The number of vertices that disappeared, because they were merged into another vertex.
    pub vertices: usize,
    /// The number of faces that lost corners, but kept at least three corners.
    pub smaller_faces: usize,
    /// The changes that made the result a manifold. The field `dropped_faces` of the report lists the faces that
    /// disappeared.
    pub report: BuildReport,
}

/// Why vertices could not be merged. After this error, the mesh is unchanged.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MergeError {
    /// The distance is negative or not finite.
    #[error("`distance` must be a finite number of at least 0, found {0}")]
    Distance(f64),
    /// The computation was canceled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The result cannot be built as a mesh.
    #[error(transparent)]
    Build(#[from] BuildError),
}

/// Merges vertices that are at most `distance` apart. Also merges vertices that are further apart, if a chain of
/// vertices connects them in steps of at most `distance`.
///
/// Two vertices merge or stay separate regardless of the order of the vertices in the mesh. The result does not depend
/// on the number of threads. A distance of 0 merges only vertices with equal positions.
///
/// [`merge_clusters`] describes what happens to vertices, edges, faces and attributes. If no two vertices
/// merge, the mesh is unchanged.
///
/// # Errors
///
/// Returns [`MergeError::Distance`] if the distance is negative or not finite, and [`MergeError::Cancelled`] if the
/// computation was canceled. Also returns the errors of [`merge_clusters`]. After an error, the mesh is unchanged.
///
/// # Panics
///
/// Panics if the mesh is not dense.
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

/// Merges each cluster of vertices into one vertex. `lowest[v]` is the lowest vertex index in the cluster of vertex
/// `v`, as returned by [`clusters`]. The mesh must be [dense](mesh::Mesh::is_dense).
///
/// The merged vertex has the position and the values of the vertex with the lowest index in the cluster. The other
/// vertices of the cluster are removed. Ids are renumbered without gaps. Edges between the same two vertices become one
/// edge, which has the values of the edge with the lowest id. Faces keep their order and values. Corners keep their
/// values, so that seams are preserved. Attribute columns whose rule is [`Rule::Drop`](mesh::Rule::Drop) are removed.
///
/// A face loses each corner that merges with the next corner of the face. A face is dropped if fewer than three of its
/// corners are left, or if it would contain a vertex twice. After the merge, connected faces can have opposite
/// orientations. If all orientations can be made to agree, [`build()`] reverses the smaller group of faces, and stored
/// normals are removed. If the result is still not a manifold, `build` splits edges and vertices. For example, if three
/// faces share an edge, the third face gets a copy of the edge.
///
/// # Errors
///
/// Returns [`BuildError`] if a position is not finite, or if the result could have more vertices than 32-bit ids can
/// number. After an error, the mesh is unchanged.
///
/// # Panics
///
/// Panics if the mesh is not dense, if `lowest` does not have one entry for each vertex, or if an entry is not the
/// index of a vertex.
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

/// The faces of a mesh, with the vertices that remain after merging.
struct Polygons {
    /// For each vertex that remains, its old id.
    kept: Vec<VertexId>,
    offsets: Vec<u32>,
    corners: Vec<u32>,
    /// The old half-edge of each corner.
    half_edges: Vec<HalfEdgeId>,
    /// The number of faces that lost corners, but kept at least three corners.
    reduced: usize,
}

impl Polygons {
    /// Replaces the vertices of the faces by the merged vertices. `lowest[v]` is the lowest vertex index in the cluster
    /// of vertex `v`.
    fn of(mesh: &Mesh, lowest: &[u32]) -> Self {
        let mut kept = Vec::new();
        let mut number = vec![0; lowest.len()];
        for (v, (&low, i)) in lowest.iter().zip(0_u32..).enumerate() {
            // The vertex with the lowest index of a cluster comes first, so its new number is known when the other
            // vertices of the cluster follow.
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
                // A side that shrinks to a point is removed together with the corner at its origin.
                if v == w {
                    is_smaller = true;
                } else {
                    corners.push(v);
                    half_edges.push(h);
                }
            }
            reduced += usize::from(is_smaller && corners.len() - first >= 3);
            // The mesh has at most as many corners as before the merge, so 32-bit numbers are enough.
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

    /// Returns the built mesh, and copies the attributes of the old mesh to it.
    fn with_attributes(self, old: &Mesh, built: BuildOutput) -> Mesh {
        let edges_of_sides = built.edges_of_sides(&self.offsets);
        let has_reversed = !built.report.reversed_faces.is_empty();
        let mut mesh = built.mesh;
        let mut vertices = self.kept;
        // The copies of split vertices come after all other vertices, in the order of `split_vertices`.
        for (original, _) in &built.report.split_vertices {
            vertices.push(vertices[original.index()]);
        }
        let mut corners = vec![HalfEdgeId::NONE; mesh.n_half_edges()];
        let mut edges = vec![EdgeId::NONE; mesh.n_edges()];
        let sides = edges_of_sides.iter().zip(&built.half_edge_of_corner);
        for (&old_h, (&e, &h)) in self.half_edges.iter().zip(sides) {
            if h != HalfEdgeId::NONE {
                corners[h.index()] = old_h;
                // A merged edge gets the values of the old edge with the lowest id. `NONE` is greater than all ids, so
                // the first old edge always replaces `NONE`.
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
            // Stored normals would point to the wrong side of the reversed faces.
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
