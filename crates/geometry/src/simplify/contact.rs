//! Tests whether a collapse would make faces intersect. The test uses a tree of boxes, which is updated when the mesh
//! changes.

use mesh::{DVec3, Domain, FaceId, Mesh, VertexId};
use progress::{Cancelled, Progress};

use crate::surface_index::{SurfaceIndex, triangles_intersect};

use super::kept::kept;

/// The corner of a box with the smallest coordinates and the corner with the largest coordinates. In an empty box, the
/// coordinates of the first corner exceed the coordinates of the second corner.
type Bounds = [DVec3; 2];

const EMPTY: Bounds = [DVec3::INFINITY, DVec3::NEG_INFINITY];

/// The bounding boxes of all faces, in a complete binary tree. A face stays in the same leaf during the whole
/// simplification. When a face changes, the boxes of its leaf and of the nodes above this leaf are updated.
pub(super) struct Contacts {
    /// The children of node i are 2 i and 2 i + 1. The second half of the nodes are the leaves.
    boxes: Vec<Bounds>,
    /// For each leaf, its face. Faces that are near each other in space are near each other in this list.
    faces: Vec<FaceId>,
    /// For each face, the index of its leaf in `boxes`.
    leaf_of_face: Vec<usize>,
}

impl Contacts {
    /// Builds the tree of a dense mesh of triangles. Returns `None` if the mesh has no faces.
    ///
    /// # Errors
    ///
    /// Returns [`Cancelled`] if `progress` asks to stop.
    pub(super) fn new(mesh: &Mesh, progress: &dyn Progress) -> Result<Option<Self>, Cancelled> {
        let Some(index) = SurfaceIndex::with_progress(mesh, progress)? else {
            return Ok(None);
        };
        let faces: Vec<FaceId> = (0..).map_while(|i| index.face(i)).collect();
        let first_leaf = faces.len().next_power_of_two();
        let mut leaf_of_face = vec![0; mesh.domain_len(Domain::Face)];
        let mut boxes = vec![EMPTY; 2 * first_leaf];
        for (i, &f) in faces.iter().enumerate() {
            leaf_of_face[f.index()] = first_leaf + i;
            boxes[first_leaf + i] = around(&corners(mesh, f));
        }
        for i in (1..first_leaf).rev() {
            boxes[i] = union(boxes[2 * i], boxes[2 * i + 1]);
        }
        Ok(Some(Self {
            boxes,
            faces,
            leaf_of_face,
        }))
    }

    /// Updates the box of a face that has changed or was removed.
    pub(super) fn update(&mut self, mesh: &Mesh, f: FaceId) {
        let mut i = self.leaf_of_face[f.index()];
        self.boxes[i] = if mesh.has_face(f) {
            around(&corners(mesh, f))
        } else {
            EMPTY
        };
        while i > 1 {
            i /= 2;
            let new = union(self.boxes[2 * i], self.boxes[2 * i + 1]);
            if self.boxes[i] == new {
                break;
            }
            self.boxes[i] = new;
        }
    }

    /// Updates the tree after the ids of faces have changed. `map` contains the new id of each face.
    pub(super) fn renumber(&mut self, map: &[FaceId]) {
        for f in &mut self.faces {
            *f = map.get(f.index()).copied().unwrap_or(FaceId::NONE);
        }
        self.leaf_of_face = kept(map)
            .into_iter()
            .map(|f| self.leaf_of_face[f])
            .collect();
    }

    /// Whether the faces around the vertices `a` and `b` would intersect each other or another face, if these two
    /// vertices were merged at `point`.
    pub(super) fn arise(&self, mesh: &Mesh, [a, b]: [VertexId; 2], point: DVec3) -> bool {
        let mut changed: Vec<FaceId> = Vec::new();
        let mut new: Vec<[DVec3; 3]> = Vec::new();
        for (v, other) in [(a, b), (b, a)] {
            for f in mesh.vertex_faces(v) {
                changed.push(f);
                if mesh.face_vertices(f).all(|w| w != other) {
                    let mut triangle = [DVec3::ZERO; 3];
                    for (p, w) in triangle.iter_mut().zip(mesh.face_vertices(f)) {
                        *p = if w == v { point } else { mesh.position(w) };
                    }
                    new.push(triangle);
                }
            }
        }
        let folds =
            |(i, s): (usize, &[DVec3; 3])| new[..i].iter().any(|t| triangles_intersect(s, t));
        new.iter().enumerate().any(folds) || new.iter().any(|s| self.meets(mesh, s, &changed))
    }

    /// Whether a triangle intersects a face that is not among `changed`.
    fn meets(&self, mesh: &Mesh, triangle: &[DVec3; 3], changed: &[FaceId]) -> bool {
        let first_leaf = self.boxes.len() / 2;
        let bounds = around(triangle);
        let mut waiting = vec![1];
        while let Some(i) = waiting.pop() {
            if !touch(bounds, self.boxes[i]) {
                continue;
            }
            if i < first_leaf {
                waiting.extend([2 * i + 1, 2 * i]);
                continue;
            }
            let f = self.faces[i - first_leaf];
            if !changed.contains(&f) && triangles_intersect(triangle, &corners(mesh, f)) {
                return true;
            }
        }
        false
    }
}

fn corners(mesh: &Mesh, f: FaceId) -> [DVec3; 3] {
    let h = mesh.face_half_edge(f);
    let next = mesh.next(h);
    [h, next, mesh.next(next)].map(|h| mesh.position(mesh.origin(h)))
}

fn around([a, b, c]: &[DVec3; 3]) -> Bounds {
    [a.min(*b).min(*c), a.max(*b).max(*c)]
}

fn union([min, max]: Bounds, [low, high]: Bounds) -> Bounds {
    [min.min(low), max.max(high)]
}

fn touch([min, max]: Bounds, [low, high]: Bounds) -> bool {
    min.cmple(high).all() && low.cmple(max).all()
}
