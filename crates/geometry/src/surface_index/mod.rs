//! A spatial index of the triangles of a surface: nearest points, rays, overlapping triangles, winding numbers.
//!
//! ```
//! use geometry::{shapes, surface_index::SurfaceIndex};
//! use mesh::DVec3;
//!
//! let cube = shapes::cube();
//! let index = SurfaceIndex::new(&cube).expect("the cube has faces");
//! let nearest = index.nearest(DVec3::new(2.0, 0.25, 0.0), 0);
//! assert_eq!(nearest.point, DVec3::new(1.0, 0.25, 0.0));
//! assert_eq!(nearest.distance, 1.0);
//! ```
//!
//! The index is a binary tree of axis-aligned boxes. The triangles of a node are sorted by their centers, along the
//! longest side of the bounding box of the centers. Each child gets half of the triangles. A node also has a slab: two
//! parallel planes with its triangles between them. If many triangles of the surface are thin, nodes also have oriented
//! boxes, whose sides do not have to be parallel to the axes. The tree depends only on the mesh, not on the number of
//! threads.
//!
//! A face with four corners is divided into a fan of two triangles. A face with more corners is divided by
//! [`triangulate`](mod@crate::triangulate).

mod build;
mod intersect;
mod nearest;
mod oriented;
mod pairs;
mod ray;
mod slab;
pub(crate) mod triangle;
mod winding;

use mesh::{DVec3, FaceId, HalfEdgeId, Mesh, VertexId};
use progress::{Cancelled, NoProgress, Progress};

pub(crate) use build::triangulate;
pub use intersect::{self_intersecting_faces, triangles_intersect};
pub use nearest::Nearest;
use oriented::Oriented;
pub use ray::RayHit;
use slab::Slab;
pub use triangle::{nearest_on_triangle, triangle_distance};
pub use winding::Winding;

/// The triangles of a surface, sorted into a tree of boxes. The index copies the triangles, so later changes of the
/// mesh do not affect it.
#[derive(Clone, Debug)]
pub struct SurfaceIndex {
    nodes: Vec<Node>,
    /// The slab of each node.
    slabs: Vec<Slab>,
    /// The oriented box of each node. The list is empty if the surface has few or no thin triangles.
    oriented: Vec<Oriented>,
    /// The corners of the triangles, in the order of the tree.
    positions: Vec<[DVec3; 3]>,
    origins: Vec<Origin>,
}

/// One of the triangles into which a face is divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// The positions of the three corners, in the order of the face.
    pub positions: [DVec3; 3],
    /// The vertices at the corners.
    pub vertices: [VertexId; 3],
    /// The corners of the face: the half-edges of the face that start at the vertices.
    pub corners: [HalfEdgeId; 3],
    /// The face that contains the triangle.
    pub face: FaceId,
}

/// The elements of a mesh that a triangle comes from.
#[derive(Clone, Copy, Debug)]
struct Origin {
    vertices: [VertexId; 3],
    corners: [HalfEdgeId; 3],
    face: FaceId,
}

/// A node of the tree: a box around the triangles with the indices `first..last`. An inner node has two children: the
/// node that follows it in the list of nodes, and the node with the index `right`. In a leaf, `right` is 0.
#[derive(Clone, Copy, Debug)]
struct Node {
    min: DVec3,
    max: DVec3,
    first: u32,
    last: u32,
    right: u32,
}

impl SurfaceIndex {
    /// Builds the index of all faces of a mesh. Returns `None` if the mesh has no faces.
    pub fn new(mesh: &Mesh) -> Option<Self> {
        Self::with_progress(mesh, &NoProgress).expect("never canceled")
    }

    /// Builds the index like [`new`](Self::new), and reports progress.
    ///
    /// # Errors
    ///
    /// Returns [`Cancelled`] if `progress` asks to stop.
    pub fn with_progress(mesh: &Mesh, progress: &dyn Progress) -> Result<Option<Self>, Cancelled> {
        Self::build(mesh, mesh.faces(), progress)
    }

    /// Builds the index of the given faces of a mesh. Returns `None` if no faces are given.
    ///
    /// # Errors
    ///
    /// Returns [`Cancelled`] if `progress` asks to stop.
    pub fn of_faces(
        mesh: &Mesh,
        faces: impl IntoIterator<Item = FaceId>,
        progress: &dyn Progress,
    ) -> Result<Option<Self>, Cancelled> {
        Self::build(mesh, faces.into_iter(), progress)
    }

    /// Returns the number of triangles. Triangle indices start at 0 and follow the order of the tree, not the order of
    /// the faces.
    pub fn n_triangles(&self) -> usize {
        self.positions.len()
    }

    /// Returns the triangle with the index `i`.
    ///
    /// # Panics
    ///
    /// Panics if the index is not below [`n_triangles`](Self::n_triangles).
    #[inline]
    pub fn triangle(&self, i: u32) -> Triangle {
        let Origin {
            vertices,
            corners,
            face,
        } = self.origins[i as usize];
        Triangle {
            positions: self.positions[i as usize],
            vertices,
            corners,
            face,
        }
    }

    /// Returns the face that contains the triangle with the index `i`. Returns `None` if there is no such triangle.
    pub fn face(&self, i: u32) -> Option<FaceId> {
        self.origins.get(i as usize).map(|origin| origin.face)
    }

    /// Returns two corners of the bounding box of all triangles: the corner with the smallest coordinates and the
    /// corner with the largest coordinates.
    pub fn bounds(&self) -> [DVec3; 2] {
        [self.nodes[0].min, self.nodes[0].max]
    }

    /// Visits the tree from the root. `enters` decides whether a box is visited; its arguments are the corners of the
    /// box with the smallest and with the largest coordinates. Boxes inside a rejected box are skipped. If a visited
    /// box contains no smaller boxes, `found` is called with the index of each triangle in the box. The bounding boxes
    /// of single triangles are not tested.
    pub fn visit_boxes(
        &self,
        enters: &mut dyn FnMut(DVec3, DVec3) -> bool,
        found: &mut dyn FnMut(u32),
    ) {
        let mut stack = vec![0_usize];
        while let Some(i) = stack.pop() {
            let node = &self.nodes[i];
            if !enters(node.min, node.max) {
                continue;
            }
            if node.right == 0 {
                (node.first..node.last).for_each(&mut *found);
            } else {
                stack.extend([node.right as usize, i + 1]);
            }
        }
    }

    /// Returns the corners of the triangles of a node.
    fn triangles_of(&self, node: &Node) -> &[[DVec3; 3]] {
        &self.positions[node.first as usize..node.last as usize]
    }

    /// Returns the two ends of the edge that two triangles share. Returns `None` if the triangles do not share exactly
    /// two vertices.
    pub(crate) fn shared_edge(&self, i: u32, j: u32) -> Option<[DVec3; 2]> {
        let (s, t) = (self.triangle(i), self.triangle(j));
        let mut shared = (0..3).filter(|&k| t.vertices.contains(&s.vertices[k]));
        match (shared.next(), shared.next(), shared.next()) {
            (Some(k), Some(l), None) => Some([s.positions[k], s.positions[l]]),
            _ => None,
        }
    }
}

impl Triangle {
    /// Returns the barycentric coordinates of the point nearest to `p` on the triangle. The coordinates are the weights
    /// of the three corners. They are not negative, and add up to 1, up to rounding. The weight of a corner is exactly
    /// 0 if the nearest point was found on the side opposite this corner. In a zero-area triangle, at most two of the
    /// weights differ from 0: the point lies on one of the sides.
    pub fn barycentric(&self, p: DVec3) -> [f64; 3] {
        triangle::nearest_weights(p, &self.positions)
    }

    /// Returns the point with the given barycentric coordinates.
    pub fn point(&self, [a, b, c]: [f64; 3]) -> DVec3 {
        a * self.positions[0] + b * self.positions[1] + c * self.positions[2]
    }
}

/// Returns a power of two; `largest` times this power is near 1. Scaling by a power of two causes no rounding errors.
fn unit_scale(largest: f64) -> f64 {
    f64::from_bits((2046 - (largest.to_bits() >> 52).clamp(1, 2045)) << 52)
}

#[cfg(test)]
mod tests;
