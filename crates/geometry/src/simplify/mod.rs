//! Simplification: fewer triangles for nearly the same surface.
//!
//! Edges are collapsed, those with the lowest cost first. Each vertex represents a part of the original surface. Before
//! the first collapse, this part is a third of the area of each triangle around the vertex. After a collapse, the new
//! vertex represents the parts of both ends of the edge. The main part of the cost of a collapse is the squared
//! distance from the new vertex to the planes of the original triangles that the vertex represents. This squared
//! distance is integrated over the represented area, and divided by the square root of this area. Source of the squared
//! distance: Garland, Heckbert, "Surface Simplification Using Quadric Error Metrics", 1997.
//!
//! The division by the square root of the area balances large and small details. Without any division, small details
//! would count too little. With a division by the area instead of its square root, small details would count too much.
//! For example, a model of a rocker arm was reduced to a tenth of its 20,088 triangles. Without any division, the
//! largest distance between the original and the simplified surface was 0.5 % of the diagonal of the bounding box. With
//! a division by the area or by the square root of the area, the largest distance was 0.3 % of this diagonal. With a
//! division by the square root of the area, the mean distance was 5 % smaller than with a division by the area itself.
//!
//! A small part of the cost is the squared distance from the new vertex to the centers of the original triangles that
//! the vertex represents. This part prevents thin triangles, similar to Trettner, Kobbelt, "Fast and Robust QEM
//! Simplification of Large Meshes Using Probabilistic Quadrics", 2020.
//!
//! Errors of interpolated attributes, such as texture coordinates, normals and colors, are also a part of the cost; see
//! `appearance.rs`.
//!
//! Lines of the mesh keep their places:
//!
//! ```text
//!     +-------+-------+            Boundaries, seams, borders of tags and materials, creases and chosen
//!     |  \    |    /  |            features are lines. A vertex on a line merges only with its neighbors
//!     |    \  |  /    |            along this line. A vertex that is not on a line merges with another such
//!     X=======+=======X            vertex, or into a vertex on a line (+). Where lines end or meet (X), the
//!     |    /  |  \    |            vertex keeps its position.
//! ```

mod appearance;
mod bound;
mod collapse;
mod collapser;
mod contact;
mod kept;
mod quadric;
mod queue;
mod target;

use mesh::{EdgeId, FaceId, Mesh, VertexId};
use progress::{Cancelled, Progress};

use collapser::Collapser;

/// The options of [`simplify`]: when it stops, and which edges and vertices it keeps.
#[derive(Clone, Copy, Debug, Default)]
pub struct Options<'a> {
    /// The number of faces at which simplification stops. The result has this number of faces, or one fewer if the last
    /// collapse removed two faces. The result has more faces if no further edge can be collapsed.
    pub faces: usize,
    /// The largest allowed Hausdorff distance between the original and the simplified surface, in scene units. If
    /// `None`, there is no limit. The distance is guaranteed not to exceed the limit. To guarantee this, each triangle
    /// has an upper bound on its distance to the original surface. For each collapse, an upper bound on the movement of
    /// the surface is added to the bounds of the triangles around the collapsed edge. These sums overestimate the
    /// distance: the true distance of the result is usually between a third of the limit and the limit.
    pub error: Option<f64>,
    /// Additional edges that are preserved as lines. Boundaries, seams, tagged edges and creases are always preserved.
    /// An edge is also always preserved if a tag, the material or another whole-number attribute differs between its
    /// two faces.
    pub features: &'a [EdgeId],
    /// Vertices that keep their positions.
    pub pinned: &'a [VertexId],
    /// Whether a collapse is refused if one of the triangles that it changes would intersect another triangle. The test
    /// is [`triangles_intersect`](crate::surface_index::triangles_intersect). If this option is true, faces that do not
    /// intersect before the simplification do not intersect afterwards.
    pub refuse_intersections: bool,
}

/// The result of [`simplify`].
#[derive(Clone, Debug)]
pub struct Simplified {
    /// The simplified mesh. The mesh is [dense](mesh::Mesh::is_dense): elements get new ids, in the order of their
    /// old ids.
    pub mesh: Mesh,
    /// Why the mesh has more faces than [`Options::faces`]: for each reason, the number of remaining edges that could
    /// not be collapsed.
    pub blocked: Vec<(Blocked, usize)>,
}

/// Why an edge was not collapsed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Blocked {
    /// After the collapse, the distance between the surface and the original could exceed the allowed error.
    Error,
    /// The collapse would merge preserved lines, or move a pinned vertex or the end of a preserved line.
    Lines,
    /// The two ends of the edge differ in a tag, in a whole-number attribute or in sharpness.
    Labels,
    /// A triangle would turn by more than 78° on the surface, turn over in a texture, or become degenerate.
    Turned,
    /// The topology of the surface would change.
    Topology,
    /// A triangle that the collapse changes would intersect another triangle.
    Intersections,
}

impl Blocked {
    const ALL: [Self; 6] = [
        Self::Error,
        Self::Lines,
        Self::Labels,
        Self::Turned,
        Self::Topology,
        Self::Intersections,
    ];
}

impl std::fmt::Display for Blocked {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Error => "could exceed the allowed error",
            Self::Lines => {
                "would merge preserved lines, such as seams, or move the end of a preserved line"
            }
            Self::Labels => "join vertices with different tags or sharpness",
            Self::Turned => "would turn a triangle over",
            Self::Topology => "would change the topology",
            Self::Intersections => "would make triangles intersect",
        })
    }
}

/// Why a mesh cannot be simplified.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SimplifyError {
    /// Only meshes of triangles can be simplified.
    #[error("{0} is not a triangle")]
    NotTriangle(FaceId),
    /// The caller asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Simplifies a mesh of triangles by collapsing edges. A mesh that has at most [`Options::faces`] faces is returned
/// unchanged.
///
/// The topology is preserved: the Euler characteristic, the boundary loops and the graph that the lines form do not
/// change. No collapse turns a triangle by more than 78° on the surface, or turns a triangle over in the texture. The
/// vertices that remain can move, with these exceptions: pinned vertices, the ends and meeting points of lines, and
/// vertices that join two edges of a line with different attributes.
///
/// Errors of interpolated attributes of vertices and corners, including normals, are a part of the cost of a collapse.
/// A vertex to which an edge is collapsed gets new values. If the edge is on a line, or if one of its ends keeps its
/// position, the values are interpolated along the edge, at the point nearest to the vertex. In all other cases, the
/// vertex gets the values with the least error, limited to the range of the values around the edge. Each side of a seam
/// gets its values separately. Isolated vertices are preserved.
///
/// # Errors
///
/// - [`SimplifyError::NotTriangle`] for the first face that is not a triangle.
/// - [`SimplifyError::Cancelled`] if `progress` asks to stop.
///
/// # Panics
///
/// Panics if the mesh is not dense (see [`Mesh::is_dense`]). Also panics if a feature or a pinned vertex does not exist,
/// unless the mesh is returned unchanged.
///
/// # Examples
///
/// ```
/// use geometry::{shapes, simplify::{Options, simplify}};
/// use progress::NoProgress;
/// # let sphere = shapes::icosahedron();
/// let options = Options { faces: 12, ..Options::default() };
/// let simple = simplify(&sphere, &options, &NoProgress)?;
/// assert_eq!(simple.mesh.n_faces(), 12);
/// # Ok::<(), geometry::simplify::SimplifyError>(())
/// ```
pub fn simplify(
    mesh: &Mesh,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Simplified, SimplifyError> {
    assert!(mesh.is_dense(), "the mesh must be dense");
    if let Some(f) = mesh.first_non_triangle() {
        return Err(SimplifyError::NotTriangle(f));
    }
    if mesh.n_faces() <= options.faces {
        return Ok(Simplified {
            mesh: mesh.clone(),
            blocked: Vec::new(),
        });
    }
    // The whole simplification runs in a thread of the thread pool, because such a thread can start a parallel loop
    // without waiting for another thread.
    let collapser = rayon::scope(|_| {
        let mut collapser = Collapser::new(mesh.clone(), options, progress)?;
        collapser.run(progress).map(|()| collapser)
    })?;
    let mut blocked = Vec::new();
    if collapser.mesh.n_faces() > options.faces {
        blocked = collapser.blocked();
    }
    let mut mesh = collapser.mesh;
    if let Some(appearance) = collapser.appearance {
        appearance.put_back(&mut mesh);
    }
    mesh.compact();
    Ok(Simplified { mesh, blocked })
}

#[cfg(test)]
pub(crate) mod tests;
