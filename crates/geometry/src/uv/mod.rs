//! Texture coordinates: charts, unwrapping, packing, stretch and overlaps.
//!
//! ```text
//!        +---+               +---+
//!       /   /|               |   |        A chart is a set of faces that are connected in the texture. Edges at
//!      +---+ +           +---+---+---+    which charts meet are seams: each of their two sides has its own
//!      |   |/     -->    |   |   |   |    texture coordinates.
//!      +---+             +---+---+---+
//! ```
//!
//! Texture coordinates are values of half-edges, which represent the corners of faces. There is one [`DVec2`] for
//! each half-edge, in the order of the half-edge ids. `v` points upwards.

mod chart;
mod cut;
mod dissolve;
mod flatten;
mod grow;
mod measure;
mod overlap;
mod pack;
mod surface;
mod unwrap;

use mesh::{DVec2, HalfEdgeId, Mesh};
use progress::Cancelled;

use crate::merge::union_find::UnionFind;

pub use measure::{Stretch, aspects, stretch};
pub use overlap::overlapping_faces;
pub use pack::{Packed, pack};
pub use unwrap::{UnwrapOptions, Unwrapped, unwrap};

/// The page into which charts are packed: a square texture.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct Page {
    /// The width of the page, in texels. The height is the same.
    pub size: u32,
    /// The number of empty texels around each chart. The distance between two charts is at least twice the padding.
    pub padding: u32,
}

/// Why the charts of a texture could not be made or packed.
#[derive(Clone, Debug, Eq, PartialEq, thiserror::Error)]
pub enum UvError {
    /// The computation was canceled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The charts with their padding do not fit into one page of the given size.
    #[error(
        "the charts do not fit into a page of {size} texels with a padding of {padding} texels",
        size = .0.size,
        padding = .0.padding
    )]
    PageTooSmall(Page),
    /// The computation failed for another reason, for example because an option is out of its range.
    #[error("the texture coordinates could not be computed: {0}")]
    Limit(String),
}

impl UvError {
    fn from_crate(error: &uvunwrap::Error, page: Page) -> Self {
        match error {
            uvunwrap::Error::Cancelled => Self::Cancelled(Cancelled),
            uvunwrap::Error::ChartTooLarge { .. }
            | uvunwrap::Error::AtlasTooLarge { .. }
            | uvunwrap::Error::InvalidOption {
                option: "density.page_size",
                ..
            } => Self::PageTooSmall(page),
            other => Self::Limit(other.to_string()),
        }
    }
}

/// The charts of a mesh with texture coordinates: sets of faces that are connected in the texture.
#[derive(Clone, Debug, Eq, PartialEq)]
pub struct Charts {
    /// For each face, the index of its chart; `u32::MAX` for removed faces. Charts are numbered in the order of their
    /// lowest face ids.
    pub of_face: Vec<u32>,
    /// The number of charts.
    pub n: usize,
}

/// Returns the charts of a mesh with the texture coordinates `uvs`. Two faces are in the same chart if a path of
/// neighboring faces connects them. Each edge that the path crosses must have the same texture coordinates on both
/// sides.
pub fn charts(mesh: &Mesh, uvs: &[DVec2]) -> Charts {
    let n_faces = mesh.domain_len(mesh::Domain::Face);
    let sets = UnionFind::new(number(n_faces));
    for e in mesh.edges() {
        if let [Some(f), Some(g)] = mesh.edge_faces(e)
            && !is_border(mesh, uvs, e.half_edge())
        {
            sets.join(number(f.index()), number(g.index()));
        }
    }
    let lowest = sets.into_lowest();
    let mut of_face = vec![u32::MAX; n_faces];
    let mut n = 0;
    for f in mesh.faces() {
        let first = lowest[f.index()] as usize;
        // The faces are visited in the order of their ids. Each chart gets its number when its first face is visited.
        if first == f.index() {
            of_face[first] = n;
            n += 1;
        }
        of_face[f.index()] = of_face[first];
    }
    Charts {
        of_face,
        n: n as usize,
    }
}

/// Converts the index of an element to 32 bits.
fn number(index: usize) -> u32 {
    u32::try_from(index).expect("elements have 32-bit ids")
}

/// Whether the edge of a half-edge is at the border of a chart. An edge is at the border of a chart if it is a boundary
/// edge of the mesh, or if its texture coordinates differ between its two sides.
pub fn is_border(mesh: &Mesh, uvs: &[DVec2], h: HalfEdgeId) -> bool {
    let twin = h.twin();
    if mesh.face(h).is_none() || mesh.face(twin).is_none() {
        return true;
    }
    let at = |h: HalfEdgeId| uvs[h.index()];
    at(h) != at(mesh.next(twin)) || at(mesh.next(h)) != at(twin)
}

#[cfg(test)]
mod tests;
