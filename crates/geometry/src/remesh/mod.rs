//! Remeshing: replaces the triangles of a surface by nearly equilateral triangles of a given size.
//!
//! Remeshing repeats a pass of four steps: split long edges, collapse short edges, flip edges so that most vertices
//! have six edges, and move vertices along the surface. Source: Botsch, Kobbelt, "A Remeshing Approach to
//! Multiresolution Modeling", 2004. Each movement of a vertex ends on the original surface, at a point of the line or
//! chart (a region between lines) to which the vertex belongs. A split or a collapse can place a vertex off the
//! original surface. The first movement of this vertex puts it back on the surface. If all movements of this vertex are
//! refused, the vertex stays off the surface.
//!
//! ```text
//!     +---+-----------+            +-----+-----+
//!     |\ /       .  / |            |\   / \   /|       Boundaries, seams, borders of tags and materials, creases and
//!     | X     .    /  |            | \ /   \ / |       chosen features are lines. They divide the surface into charts.
//!     |/ \ .      /   |    -->     |  +-----+  |       Vertices on a line slide along it, and vertices inside a
//!     +---+------+----+            | / \   / \ |       chart stay in the chart. Corners of lines stay in place.
//!     |  / .      \   |            |/   \ /   \|
//!     +-+----------+--+            +-----+-----+
//! ```
//!
//! The target length is either the same everywhere, or shorter where the surface is curved. Source for lengths that
//! follow the curvature: Dunyach, Vanderhaeghe, Barthe, Botsch, "Adaptive Remeshing for Real-Time Mesh
//! Deformation", 2013.

mod collapse;
mod flip;
mod guard;
mod original;
mod size;
mod smooth;
mod split;
mod transfer;
mod work;

use mesh::{EdgeId, FaceId, Mesh, VertexId, readable};
use progress::{Cancelled, Progress};

use original::Original;
use size::Sizes;
use work::Work;

/// The text that progress reports show during remeshing.
const WHAT: &str = "remesh";

/// Remeshing stops after a pass that changes no edge and moves each vertex by less than this fraction of the target
/// length at the vertex.
const QUIET: f64 = 0.05;

/// The largest number of attempts. If the result is too far from the original, remeshing starts again with shorter
/// edges.
const ATTEMPTS: u32 = 4;

/// The target length of edges, in scene units. Most edges of the result are between 4/5 and 4/3 of this length. Almost
/// all other edges are shorter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Length {
    /// The same length everywhere. This length must be positive.
    Uniform(f64),
    /// Shorter edges where the surface is curved, longer edges where the surface is flat.
    Curvature {
        /// Target lengths are chosen so that the centers of the new triangles are at about this distance from the
        /// original surface. This distance must be positive.
        error: f64,
        /// The smallest target length, which must be positive.
        min: f64,
        /// The largest target length, which must not be below `min`.
        max: f64,
    },
}

/// The options of [`remesh`]: target lengths, limits, and what must be preserved.
#[derive(Clone, Copy, Debug)]
pub struct Options<'a> {
    /// The target length of edges.
    pub length: Length,
    /// The largest allowed Hausdorff distance between the original and the new surface, in scene units. If `None`,
    /// there is no limit. With a limit, target lengths are reduced where edges of the given length could deviate from
    /// the surface by more than the limit. Collapses, flips and movements that seem to exceed the limit are refused. At
    /// the end, the distance is measured in both directions. The measurement gives a guaranteed upper bound. If the
    /// bound is above the limit, remeshing starts again with shorter edges where the distance is too large. If the
    /// bound is still above the limit after four attempts, remeshing fails.
    pub error: Option<f64>,
    /// Additional edges that are preserved as lines. Boundaries, seams, tagged edges and creases are always preserved.
    /// An edge is also always preserved if a tag, the material or another whole-number attribute differs between its
    /// two faces.
    pub features: &'a [EdgeId],
    /// Vertices that keep their positions.
    pub pinned: &'a [VertexId],
    /// The largest number of passes. Ten passes are usually enough.
    pub passes: u32,
    /// The largest number of faces that the mesh is allowed to have at any time during remeshing.
    pub max_faces: usize,
}

/// The result of [`remesh`].
#[derive(Clone, Debug)]
pub struct Remeshed {
    /// The new mesh, which is [dense](mesh::Mesh::is_dense).
    pub mesh: Mesh,
    /// How many splits, collapses and flips were performed, and how many were refused.
    pub counts: Counts,
}

/// How many passes, splits, collapses and flips [`remesh`] performed in its last attempt.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// The number of passes.
    pub passes: u64,
    /// The maximum number of passes.
    max_passes: u64,
    /// The number of edges that were split.
    pub split: usize,
    /// The number of edges that were collapsed.
    pub collapsed: usize,
    /// The number of edges that were flipped.
    pub flipped: usize,
    /// How many splits, collapses and flips were refused in the last pass: one number for each reason, in the order of
    /// [`Refused::ALL`].
    refused: [usize; 6],
}

impl Counts {
    /// Returns each reason for which splits, collapses or flips were refused in the last pass, with the number of
    /// refused steps. A flip that would not improve the mesh does not count as refused.
    pub fn refused(&self) -> impl Iterator<Item = (Refused, usize)> {
        let counts = Refused::ALL.into_iter().zip(self.refused);
        counts.filter(|&(_, count)| count > 0)
    }

    fn refuse(&mut self, reason: Refused) {
        self.refused[reason as usize] += 1;
    }
}

/// Why a split, a collapse or a flip was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Refused {
    /// The collapse would merge lines, move a vertex off its line, or move a corner of a line.
    Lines,
    /// The collapse, or a flip in the last pass, would make an edge that is longer than 4/3 of its target length.
    Long,
    /// A triangle would turn by more than 60° or become degenerate.
    Turned,
    /// A triangle would become thin.
    Thin,
    /// The topology of the surface would change.
    Topology,
    /// The surface would move too far: by more than a fraction of the target length, or by more than the allowed error.
    Far,
}

impl Refused {
    /// All reasons.
    pub const ALL: [Self; 6] = [
        Self::Lines,
        Self::Long,
        Self::Turned,
        Self::Thin,
        Self::Topology,
        Self::Far,
    ];
}

impl std::fmt::Display for Refused {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Lines => "would merge or move lines",
            Self::Long => "would make long edges",
            Self::Turned => "would turn a triangle by more than 60°",
            Self::Thin => "would make a thin triangle",
            Self::Topology => "would change the topology",
            Self::Far => "would move the surface too far",
        })
    }
}

/// Why a mesh cannot be remeshed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RemeshError {
    /// Only meshes of triangles can be remeshed.
    #[error("{0} is not a triangle")]
    NotTriangle(FaceId),
    /// The target length is so small, relative to the size of the mesh, that there would be too many faces.
    #[error(
        "remeshing needs up to about {} faces, but the mesh can have at most {max}; use a longer \
         target length", readable(*.needed)
    )]
    TooManyFaces {
        /// An estimate of the largest number of faces during remeshing.
        needed: f64,
        /// The largest allowed number of faces.
        max: usize,
    },
    /// The result would be too far from the original.
    #[error(
        "the distance between the original and the new surface could be as large as {}, which exceeds the allowed error of {}",
        readable(*.reached), readable(*.limit)
    )]
    TooFar {
        /// The upper bound of the distance in the last attempt, in scene units.
        reached: f64,
        /// The allowed error, in scene units.
        limit: f64,
    },
    /// The caller asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Remeshes a mesh of triangles: replaces its triangles by nearly equilateral triangles with edges of a target length.
///
/// The topology is preserved: the Euler characteristic, the boundary loops and the graph that the lines form do not
/// change. No split, collapse, flip or movement turns a triangle by more than 60°. Isolated vertices are preserved.
/// These vertices keep their exact positions:
///
/// - the ends and meeting points of lines, and the corners of lines, where a line turns by more than 40°;
/// - vertices that join two edges of a line with different attributes;
/// - pinned vertices and vertices with sharpness;
/// - vertices with a tag, with two exceptions: a tagged vertex can move if all corners of an adjacent triangle also
///   have the tag, or if the vertex is on a line and both of its neighbors on the line also have the tag.
///
/// Each new element gets its attributes from the original surface at the location of the element, and never from the
/// other side of a line. Vertex and corner attributes are interpolated at this location. A new vertex has a tag if all
/// original vertices around its location have the tag. The whole-number attributes of a new vertex are copied from the
/// nearest of these original vertices. A new face gets the values of the original face at its center. A new edge on a
/// line gets the values of one original edge of this line: the edge at the midpoint of the new edge. Any other new edge
/// gets its values from the original triangle at the midpoint of the new edge. The values are copied from one edge of
/// this triangle: among the edges that are not on a line, the edge nearest to the midpoint. If all edges of the
/// original triangle are on lines, the values of the new edge are zero.
///
/// All elements get new ids.
///
/// # Errors
///
/// - [`RemeshError::NotTriangle`] for the first face that is not a triangle.
/// - [`RemeshError::TooManyFaces`] if an estimate of the number of faces is above [`Options::max_faces`].
/// - [`RemeshError::TooFar`] if the result could not be proved to be within [`Options::error`].
/// - [`RemeshError::Cancelled`] if `progress` asks to stop.
///
/// # Panics
///
/// Panics if the mesh is not dense (see [`Mesh::is_dense`]), or a feature or a pinned vertex does not exist.
///
/// # Examples
///
/// ```
/// use geometry::{remesh::{Length, Options, remesh}, shapes};
/// use progress::NoProgress;
/// let options = Options { length: Length::Uniform(0.3), ..Options::default() };
/// let sphere = remesh(&shapes::icosahedron(), &options, &NoProgress)?.mesh;
/// assert!(sphere.is_closed() && sphere.n_faces() > 200);
/// # Ok::<(), geometry::remesh::RemeshError>(())
/// ```
pub fn remesh(
    mesh: &Mesh,
    options: &Options,
    progress: &dyn Progress,
) -> Result<Remeshed, RemeshError> {
    assert!(mesh.is_dense(), "the mesh must be dense");
    if let Some(f) = mesh.first_non_triangle() {
        return Err(RemeshError::NotTriangle(f));
    }
    let original = Original::new(mesh, options, progress)?;
    let mut sizes = Sizes::new(&original, options.length, options.error);
    for attempt in 1.. {
        let (result, counts) = run(&original, &sizes, options, progress)?;
        let limit = options.error.unwrap_or(f64::INFINITY);
        match guard::excess(mesh, &result, limit, progress)? {
            None => {
                return Ok(Remeshed {
                    mesh: result,
                    counts,
                });
            }
            Some(reached) if attempt == ATTEMPTS => {
                return Err(RemeshError::TooFar { reached, limit });
            }
            Some(_) => guard::refine(&original, &mut sizes, &result, limit, progress)?,
        }
    }
    unreachable!("the last attempt returns")
}

/// Runs all passes of one attempt, with the given target lengths.
fn run(
    original: &Original,
    sizes: &Sizes,
    options: &Options,
    progress: &dyn Progress,
) -> Result<(Mesh, Counts), RemeshError> {
    let max_faces = options.max_faces.min(MAX_FACES);
    let needed = sizes.n_faces(original);
    // The estimate can be NaN if the target lengths are extreme. The comparison is then false, so an error is returned.
    let is_possible = needed <= max_faces as f64;
    if !is_possible {
        return Err(RemeshError::TooManyFaces {
            needed,
            max: max_faces,
        });
    }
    let mut work = Work::new(original, sizes, options.error.map(|e| e * original.scale));
    work.counts.max_passes = options.passes.into();
    let enough = ENOUGH * needed;
    for _ in 0..options.passes {
        work.counts.refused = [0; 6];
        let mut n_changes = work.split_long(max_faces, enough, progress)?;
        n_changes += work.collapse_short(progress)?;
        n_changes += work.flip_all(progress)?;
        work.compact();
        let moved = work.smooth(progress)?;
        work.counts.passes += 1;
        if n_changes == 0 && moved < QUIET {
            break;
        }
    }
    let counts = work.counts.clone();
    Ok((work.finish(progress)?, counts))
}

/// Edges are no longer split when the number of faces reaches the estimated number times this factor. This limit
/// ensures that splitting ends for every input.
const ENOUGH: f64 = 4.0;

/// The largest number of faces during remeshing. With this limit, 32-bit ids are enough for all half-edges, including
/// half-edges that are removed during a pass.
pub const MAX_FACES: usize = u32::MAX as usize / 12;

impl Default for Options<'_> {
    /// Returns options with ten passes, edges of length 1, no error limit and no limit on the number of faces.
    fn default() -> Self {
        Self {
            length: Length::Uniform(1.0),
            error: None,
            features: &[],
            pinned: &[],
            passes: 10,
            max_faces: usize::MAX,
        }
    }
}

#[cfg(test)]
mod tests;
