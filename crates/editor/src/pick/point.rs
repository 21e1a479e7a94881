//! Finds the vertex, edge or face that is visible at a pixel of the view.
//!
//! ```text
//!   ray through the pixel --> first face of the spatial index --> vertices and edges of this and the neighboring faces
//!                         \-> nothing: all faces whose picture is near the pixel
//! ```
//!
//! If a vertex is within the pick radius of the pixel, the vertex is picked. If only an edge is within the pick radius,
//! the edge is picked. If neither a vertex nor an edge is within the pick radius, the face at the pixel is picked.

use std::sync::Arc;

use geometry::surface_index::{RayHit, SurfaceIndex};
use glam::DAffine3;
use mesh::{DVec2, DVec3, Element, FaceId, HalfEdgeId, Mesh};
use op::ElementKind;
use scene::Scene;

use super::{Indexes, Projection};

/// The largest distance in pixels from the cursor at which vertices and edges are picked.
pub const PICK_RADIUS: f64 = 8.0;

/// The maximum number of faces that are searched for vertices and edges near the cursor: the face under the cursor and
/// faces around it.
const MAX_FACES: usize = 64;

/// What a pick looks for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PickMode {
    /// A vertex if there is one within the radius, otherwise an edge within the radius, otherwise the face at the
    /// pixel.
    #[default]
    Any,
    /// A vertex.
    Vertex,
    /// An edge.
    Edge,
    /// A half-edge: the half of the nearest edge that is on the same side of the edge as the pixel.
    HalfEdge,
    /// A face.
    Face,
}

impl PickMode {
    /// Returns the kind of elements that a box, a lasso or a written selection picks.
    pub fn kind(self) -> ElementKind {
        match self {
            Self::Vertex => ElementKind::Vertices,
            Self::Edge | Self::HalfEdge => ElementKind::Edges,
            Self::Any | Self::Face => ElementKind::Faces,
        }
    }
}

/// An element under the cursor.
#[derive(Clone, Debug, PartialEq)]
pub struct Hit {
    /// The name of the object.
    pub object: String,
    /// The index of the instance in [`Scene::instances`].
    pub instance: usize,
    /// The element. If the mode is [`PickMode::HalfEdge`], the element is a half-edge.
    pub element: Element,
    /// The half-edge that belongs to the element. For an edge, this is the half-edge on the face under the cursor. For
    /// a face, this is the side of the face that is nearest to the pixel, as a half-edge. `None` if the element is a
    /// vertex that has no edges.
    pub half_edge: Option<HalfEdgeId>,
    /// The face under the cursor. `None` if no face is under the cursor.
    pub face: Option<FaceId>,
    /// The picked point in scene space: the vertex, the nearest point of the edge, or the point of the face under the
    /// cursor.
    pub point: DVec3,
}

/// Returns the element at a pixel. Returns `None` if there is no element at the pixel, or if the spatial index of the
/// mesh is not ready yet.
pub fn pick(
    scene: &Scene,
    indexes: &Indexes,
    view: &Projection,
    pixel: DVec2,
    mode: PickMode,
) -> Option<Hit> {
    let targets: Vec<Target> = Target::all(scene, indexes, view);
    let under = first_hit(&targets, pixel);
    let mut search = Search {
        targets: &targets,
        pixel,
        mode,
        found: Vec::new(),
    };
    match under {
        Some((i, hit)) => search.around(i, targets[i].face_of(&hit)),
        None if mode == PickMode::Face => return None,
        None => (0..targets.len()).for_each(|i| search.near(i)),
    }
    if let Some(hit) = search.best(under.map(|(i, hit)| targets[i].face_of(&hit))) {
        return Some(hit);
    }
    let (i, hit) = under?;
    let target = &targets[i];
    let face = target.face_of(&hit);
    let half_edge = target.nearest_side(face, pixel);
    let element = match mode {
        PickMode::Any | PickMode::Face => Element::Face(face),
        PickMode::HalfEdge => Element::HalfEdge(half_edge?),
        // No visible vertex or edge is within the pick radius, and faces are not picked in these modes.
        PickMode::Vertex | PickMode::Edge => return None,
    };
    Some(Hit {
        object: target.object.to_owned(),
        instance: target.instance,
        element,
        half_edge,
        face: Some(face),
        point: target.to_scene.transform_point3(hit.point),
    })
}

/// An instance of a mesh, with the spatial index of the mesh.
pub(super) struct Target<'s> {
    pub(super) object: &'s str,
    pub(super) instance: usize,
    pub(super) mesh: &'s Arc<Mesh>,
    pub(super) index: Arc<SurfaceIndex>,
    pub(super) to_scene: DAffine3,
    pub(super) view: Projection,
}

impl<'s> Target<'s> {
    pub(super) fn all(scene: &'s Scene, indexes: &Indexes, view: &Projection) -> Vec<Self> {
        let instances = scene.instances().into_iter().enumerate();
        instances
            .filter_map(|(instance, placed)| {
                let mesh = placed.object.as_mesh()?;
                Some(Self {
                    object: &placed.object.name,
                    instance,
                    mesh,
                    index: indexes.get(mesh)?,
                    to_scene: placed.to_scene,
                    view: view.of_object(placed.to_scene),
                })
            })
            .collect()
    }

    fn face_of(&self, hit: &RayHit) -> FaceId {
        self.index.triangle(hit.triangle).face
    }

    /// Finds the side of a face that is nearest to a pixel of the view, and returns the half-edge of this side.
    fn nearest_side(&self, face: FaceId, pixel: DVec2) -> Option<HalfEdgeId> {
        let sides = self
            .mesh
            .face_half_edges(face)
            .filter_map(|h| Some((self.distance(h, pixel)?.0, h)));
        sides.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, h)| h)
    }

    fn distance(&self, h: HalfEdgeId, pixel: DVec2) -> Option<(f64, DVec3)> {
        let ends = [self.mesh.origin(h), self.mesh.target(h)].map(|v| self.mesh.position(v));
        self.view.to_segment(pixel, ends[0], ends[1])
    }
}

/// Among the surface points under a pixel, finds the point that is nearest to the viewer. Returns this point, and the
/// mesh instance that contains it (as an index into `targets`).
pub(super) fn first_hit(targets: &[Target], pixel: DVec2) -> Option<(usize, RayHit)> {
    let hits = targets.iter().enumerate().filter_map(|(i, target)| {
        let (origin, direction) = target.view.ray(pixel);
        Some((i, target.index.ray(origin, direction)?))
    });
    // A point of the ray has the same parameter `t` in the spaces of all objects, so hits on different objects can be
    // compared.
    hits.min_by(|a, b| a.1.t.total_cmp(&b.1.t))
}

/// A vertex or an edge near the pixel.
struct Candidate {
    /// 0 for a vertex and 1 for an edge, because vertices are preferred.
    rank: u8,
    distance: f64,
    target: usize,
    element: Element,
    half_edge: HalfEdgeId,
    point: DVec3,
}

struct Search<'a, 's> {
    targets: &'a [Target<'s>],
    pixel: DVec2,
    mode: PickMode,
    found: Vec<Candidate>,
}

impl Search<'_, '_> {
    /// Looks at a face and the faces around it. Adds those vertices and edges of these faces that are near the pixel.
    /// If the viewer sees the front of the given face, skips faces that are seen from behind. If the viewer sees the
    /// back of the given face, skips faces that are seen from the front.
    fn around(&mut self, at: usize, face: FaceId) {
        let target = &self.targets[at];
        let (_, direction) = target.view.ray(self.pixel);
        let side = |f: FaceId| target.mesh.area_vector(f).dot(direction) > 0.0;
        let is_back = side(face);
        let mut faces = vec![face];
        let mut done = 0;
        while let Some(&f) = faces.get(done) {
            done += 1;
            for h in target.mesh.face_half_edges(f) {
                if !self.add(at, h) || faces.len() >= MAX_FACES {
                    continue;
                }
                if let Some(other) = target.mesh.face(h.twin())
                    && !faces.contains(&other)
                    && side(other) == is_back
                {
                    faces.push(other);
                }
            }
        }
    }

    /// Adds those vertices and edges of the mesh that are near the pixel in the view.
    fn near(&mut self, at: usize) {
        let target = &self.targets[at];
        let (view, pixel) = (target.view, self.pixel);
        let mut faces = Vec::new();
        let mut enters = |min, max| match view.bounds(min, max) {
            Some([low, high]) => pixel.distance(pixel.clamp(low, high)) <= PICK_RADIUS,
            None => true,
        };
        target.index.visit_boxes(&mut enters, &mut |i| {
            faces.push(target.index.triangle(i).corners);
        });
        for corners in faces {
            for (k, h) in corners.into_iter().enumerate() {
                // Some sides of triangles are diagonals inside a face, not edges of the mesh. They are skipped.
                if target.mesh.next(h) == corners[(k + 1) % 3] {
                    self.add(at, h);
                }
            }
        }
    }

    /// Adds the edge of a half-edge and the two ends of the edge. Each of the three is added only if it is near the
    /// pixel. Returns whether the edge is near the pixel.
    fn add(&mut self, at: usize, h: HalfEdgeId) -> bool {
        let target = &self.targets[at];
        let Some((distance, point)) = target
            .distance(h, self.pixel)
            .filter(|near| near.0 <= PICK_RADIUS)
        else {
            return false;
        };
        if self.mode != PickMode::Vertex && self.mode != PickMode::Face {
            let element = match self.mode {
                PickMode::HalfEdge => Element::HalfEdge(h),
                _ => Element::Edge(h.edge()),
            };
            self.found.push(Candidate {
                rank: 1,
                distance,
                target: at,
                element,
                half_edge: h,
                point,
            });
        }
        if matches!(self.mode, PickMode::Any | PickMode::Vertex) {
            for (v, half_edge) in [
                (target.mesh.origin(h), h),
                (target.mesh.target(h), target.mesh.next(h)),
            ] {
                let point = target.mesh.position(v);
                let Some((pixel, _)) = target.view.to_pixel(point) else {
                    continue;
                };
                let distance = pixel.distance(self.pixel);
                if distance <= PICK_RADIUS {
                    let element = Element::Vertex(v);
                    self.found.push(Candidate {
                        rank: 0,
                        distance,
                        target: at,
                        element,
                        half_edge,
                        point,
                    });
                }
            }
        }
        true
    }

    /// Returns the best visible candidate: the nearest visible vertex or, if there is none, the nearest visible edge.
    /// `under` is the face under the cursor.
    fn best(mut self, under: Option<FaceId>) -> Option<Hit> {
        let key = |c: &Candidate| (c.rank, c.distance);
        // Of the two halves of an edge, the half on the face under the cursor comes first, because it was added first.
        self.found.sort_by(|a, b| {
            let ((ra, da), (rb, db)) = (key(a), key(b));
            ra.cmp(&rb).then(da.total_cmp(&db))
        });
        self.found
            .dedup_by(|a, b| a.element == b.element && a.target == b.target);
        let best = self
            .found
            .iter()
            .find(|candidate| self.is_visible(candidate))?;
        let target = &self.targets[best.target];
        Some(Hit {
            object: target.object.to_owned(),
            instance: target.instance,
            element: best.element,
            half_edge: Some(best.half_edge),
            face: under,
            point: target.to_scene.transform_point3(best.point),
        })
    }

    /// Whether the point of a candidate is visible: no face of the scene hides it.
    fn is_visible(&self, candidate: &Candidate) -> bool {
        let target = &self.targets[candidate.target];
        let Some((pixel, _)) = target.view.to_pixel(candidate.point) else {
            return false;
        };
        let Some((i, hit)) = first_hit(self.targets, pixel) else {
            return true;
        };
        if i == candidate.target {
            let ends = [
                target.mesh.origin(candidate.half_edge),
                target.mesh.target(candidate.half_edge),
            ];
            let vertices = target.index.triangle(hit.triangle).vertices;
            let is_at = match candidate.element {
                Element::Vertex(v) => vertices.contains(&v),
                _ => ends.iter().all(|v| vertices.contains(v)),
            };
            if is_at {
                return true;
            }
        }
        let (origin, direction) = target.view.ray(pixel);
        let t = (candidate.point - origin).dot(direction) / direction.length_squared();
        hit.t >= t * (1.0 - 1e-7)
    }
}
