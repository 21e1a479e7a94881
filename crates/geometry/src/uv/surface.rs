//! The surface that is unwrapped, and connected parts of this surface.

use mesh::{DVec3, FaceId, HalfEdgeId, Mesh};

use super::number;
use crate::merge::union_find::UnionFind;
use crate::tangent::triangles;

/// The area of a triangle counts as zero if twice the area is at most this fraction of the square of the longest side.
const MIN_HEIGHT: f64 = 1e-8;

/// A mesh, scaled so that its bounding box has a size of 1, with the triangles, normals and areas of its faces. Face
/// numbers are face ids.
pub(super) struct Surface<'a> {
    pub(super) mesh: &'a Mesh,
    /// The positions of the vertices.
    pub(super) positions: Vec<DVec3>,
    /// The triangles of all faces, in the order of the faces. Each triangle is given by its three corners.
    pub(super) triangles: Vec<[HalfEdgeId; 3]>,
    /// The triangles of face f have the indices from `starts[f]` up to but not including `starts[f + 1]`.
    starts: Vec<usize>,
    /// The unit normals of the faces; zero for faces with zero area.
    pub(super) normals: Vec<DVec3>,
    /// The areas of the faces. Faces with zero area belong to no chart.
    pub(super) areas: Vec<f64>,
    is_seam: Vec<bool>,
}

impl<'a> Surface<'a> {
    pub(super) fn new(mesh: &'a Mesh, is_seam: Vec<bool>) -> Self {
        let n = mesh.n_faces();
        let mut surface = Self {
            mesh,
            positions: unit_positions(mesh),
            triangles: triangles(mesh),
            starts: vec![0; n + 1],
            normals: vec![DVec3::ZERO; n],
            areas: vec![0.0; n],
            is_seam,
        };
        for &triangle in &surface.triangles {
            let Some(f) = mesh.face(triangle[0]) else {
                continue;
            };
            surface.starts[f.index() + 1] += 1;
            let [a, b, c] = triangle.map(|h| surface.positions[mesh.origin(h).index()]);
            let normal = (b - a).cross(c - a);
            surface.normals[f.index()] += normal;
            if is_solid([a, b, c]) {
                surface.areas[f.index()] += normal.length() / 2.0;
            }
        }
        for f in 0..n {
            surface.starts[f + 1] += surface.starts[f];
            surface.normals[f] = surface.normals[f].normalize_or_zero();
        }
        surface
    }

    pub(super) fn triangles_of(&self, f: u32) -> &[[HalfEdgeId; 3]] {
        &self.triangles[self.starts[f as usize]..self.starts[f as usize + 1]]
    }

    pub(super) fn half_edges(&self, f: u32) -> impl Iterator<Item = HalfEdgeId> + '_ {
        self.mesh.face_half_edges(FaceId::new(f as usize))
    }

    /// Returns the face on the other side of the edge of `h`. Returns `None` if the edge is a seam, if there is no face
    /// on the other side, or if the area of this face is zero.
    pub(super) fn across(&self, h: HalfEdgeId) -> Option<u32> {
        let f = self.mesh.face(h.twin())?;
        let is_joined = !self.is_seam[h.edge().index()] && self.areas[f.index()] > 0.0;
        is_joined.then(|| number(f.index()))
    }

    /// Calls [`Self::across`] for each half-edge of face `f`. Returns the faces that are found, each with the half-edge
    /// of `f`.
    pub(super) fn neighbors(&self, f: u32) -> impl Iterator<Item = (HalfEdgeId, u32)> + '_ {
        self.half_edges(f)
            .filter_map(|h| Some((h, self.across(h)?)))
    }

    pub(super) fn length(&self, h: HalfEdgeId) -> f64 {
        let [a, b] = [h, self.mesh.next(h)].map(|h| self.positions[self.mesh.origin(h).index()]);
        a.distance(b)
    }
}

/// Whether the area of a triangle counts as nonzero.
pub(super) fn is_solid([a, b, c]: [DVec3; 3]) -> bool {
    let sides = [a - b, b - c, c - a].map(DVec3::length_squared);
    let longest = sides[0].max(sides[1]).max(sides[2]);
    (b - a).cross(c - a).length() > MIN_HEIGHT * longest
}

/// Returns the positions of all vertices, moved and scaled so that the bounding box has a size of 1.
pub(super) fn unit_positions(mesh: &Mesh) -> Vec<DVec3> {
    // First divides all coordinates by the largest absolute coordinate, so that later computations cannot overflow.
    let largest = |p: &DVec3| p.abs().max_element();
    let size = mesh.positions().iter().map(largest).fold(0.0, f64::max);
    let size = if size > 0.0 { size } else { 1.0 };
    let unit = |p: &DVec3| *p / size;
    let mut points = mesh.positions().iter().map(unit);
    let first = points.next().unwrap_or_default();
    let (low, high) = points.fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
    let (middle, extent) = ((low + high) / 2.0, (high - low).max_element());
    let extent = if extent > 0.0 { extent } else { 1.0 };
    let points = mesh.positions().iter();
    points.map(|p| (unit(p) - middle) / extent).collect()
}

/// A part of the surface: a connected set of faces that is cut open along its border and along the seams inside it.
/// Face corners at the same point become one vertex of the part only if their faces are connected across uncut edges.
/// Therefore the two sides of a cut have different vertices.
pub(super) struct Part {
    /// The faces, in ascending order.
    pub(super) faces: Vec<u32>,
    /// The corners of the faces, in the order of the faces.
    pub(super) corners: Vec<HalfEdgeId>,
    /// For each corner, the index of its vertex in this part.
    pub(super) vertices: Vec<u32>,
    /// The positions of the vertices.
    pub(super) points: Vec<DVec3>,
    /// For each triangle, its three vertices in this part.
    pub(super) triangles: Vec<[u32; 3]>,
    /// For each triangle, the face that contains it.
    pub(super) face_of: Vec<u32>,
}

impl Part {
    /// Creates the part that consists of the given faces. `faces` must be in ascending order.
    pub(super) fn new(surface: &Surface, faces: Vec<u32>) -> Self {
        let mut corners = Vec::new();
        let mut starts = Vec::with_capacity(faces.len());
        for &f in &faces {
            starts.push(corners.len());
            corners.extend(surface.half_edges(f));
        }
        let corner = |h: HalfEdgeId| {
            let f = surface.mesh.face(h)?;
            let start = starts[faces.binary_search(&number(f.index())).ok()?];
            let at = corners[start..].iter().position(|&c| c == h)?;
            Some(number(start + at))
        };
        let sets = UnionFind::new(number(corners.len()));
        for &h in &corners {
            let twin = h.twin();
            if h.index() < twin.index() && surface.across(h).is_some() {
                let ends = [h, surface.mesh.next(h)].map(corner);
                let opposite = [surface.mesh.next(twin), twin].map(corner);
                for (a, b) in ends.iter().zip(opposite) {
                    if let (Some(a), Some(b)) = (*a, b) {
                        sets.join(a, b);
                    }
                }
            }
        }
        let lowest = sets.into_lowest();
        let mut vertices: Vec<u32> = Vec::with_capacity(corners.len());
        let mut points = Vec::new();
        for (c, &first) in lowest.iter().enumerate() {
            if first as usize == c {
                vertices.push(number(points.len()));
                points.push(surface.positions[surface.mesh.origin(corners[c]).index()]);
            } else {
                vertices.push(vertices[first as usize]);
            }
        }
        let (mut triangles, mut face_of) = (Vec::new(), Vec::new());
        for (&f, &start) in faces.iter().zip(&starts) {
            for triangle in surface.triangles_of(f) {
                let at = triangle.map(|h| {
                    let found = corners[start..].iter().position(|&c| c == h);
                    vertices[start + found.expect("a triangle has corners of its face")]
                });
                triangles.push(at);
                face_of.push(f);
            }
        }
        Self {
            faces,
            corners,
            vertices,
            points,
            triangles,
            face_of,
        }
    }
}
