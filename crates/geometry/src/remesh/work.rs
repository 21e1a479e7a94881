//! The mesh while it is remeshed, and the location of each of its elements on the original surface.

use mesh::{DVec3, EdgeId, FaceId, HalfEdgeId, Mesh, VertexId};

use super::Counts;
use super::original::{Original, Place, Track};
use super::size::Sizes;

/// The cosine of 60°. One step (a split, a collapse, a flip or a movement) is allowed to turn a triangle by at most
/// 60°.
pub(super) const TURN: f64 = 0.5;

/// The state of the mesh between two steps of remeshing.
pub(super) struct Work<'a> {
    pub(super) original: &'a Original<'a>,
    /// The mesh without attributes, in the scaled coordinates of [`Original::mesh`].
    pub(super) mesh: Mesh,
    pub(super) target: &'a Sizes,
    pub(super) limit: Option<f64>,
    /// For each vertex, its location on the original surface.
    pub(super) places: Vec<Place>,
    /// For each vertex, the target length of the edges around it.
    pub(super) sizes: Vec<f64>,
    /// For each vertex, its target valence. Flips change the number of edges at the vertex towards this number.
    pub(super) valences: Vec<u8>,
    /// For each vertex, whether the vertex can lie off the original surface. This is true for a vertex that was placed
    /// by a split or a collapse and has not moved since then.
    pub(super) is_off: Vec<bool>,
    /// For each edge that is a part of a line, its location on a chain (a line between two corners).
    pub(super) tracks: Vec<Option<Track>>,
    /// For each face, the index of its chart (a region between lines).
    pub(super) charts: Vec<u32>,
    pub(super) counts: Counts,
}

impl<'a> Work<'a> {
    pub(super) fn new(original: &'a Original<'a>, target: &'a Sizes, limit: Option<f64>) -> Self {
        let n = original.mesh.n_vertices();
        Self {
            original,
            mesh: original.mesh.clone(),
            target,
            limit,
            places: original.places.clone(),
            sizes: (0..n).map(|v| target.at_vertex(VertexId::new(v))).collect(),
            valences: original.valences.clone(),
            is_off: vec![false; n],
            tracks: original.tracks.clone(),
            charts: original.charts.clone(),
            counts: Counts::default(),
        }
    }

    /// Removes the gaps that deleted elements have left in the lists.
    pub(super) fn compact(&mut self) {
        fn kept<I: mesh::Id + PartialEq, T: Copy>(new: &[I], values: &mut Vec<T>) {
            let mut alive = new.iter().map(|&id| id != I::NONE);
            values.retain(|_| alive.next() == Some(true));
        }
        if let Some(map) = self.mesh.compact() {
            kept(&map.vertices, &mut self.places);
            kept(&map.vertices, &mut self.sizes);
            kept(&map.vertices, &mut self.valences);
            kept(&map.vertices, &mut self.is_off);
            kept(&map.edges, &mut self.tracks);
            kept(&map.faces, &mut self.charts);
        }
    }

    pub(super) fn is_line(&self, e: EdgeId) -> bool {
        self.tracks[e.index()].is_some()
    }

    /// Returns the length of an edge, divided by the smaller of the target lengths at its two ends.
    pub(super) fn relative_length(&self, e: EdgeId) -> f64 {
        let [a, b] = self.mesh.edge_vertices(e);
        self.relative_distance(a, b)
    }

    /// Returns the distance between two vertices, divided by the smaller of the target lengths at the two vertices.
    pub(super) fn relative_distance(&self, a: VertexId, b: VertexId) -> f64 {
        let size = self.sizes[a.index()].min(self.sizes[b.index()]);
        self.mesh.position(a).distance(self.mesh.position(b)) / size
    }

    /// Returns the line that contains the edge of `h`, and whether `h` runs in the direction of this line. Returns
    /// `None` if no line contains the edge.
    pub(super) fn track_of(&self, h: HalfEdgeId) -> Option<Track> {
        let track = self.tracks[h.edge().index()]?;
        Some(Track {
            is_along: track.is_along == (h == h.edge().half_edges()[0]),
            ..track
        })
    }

    /// Returns the position of the origin of `h` on its chain: the arc length from the start of the chain.
    pub(super) fn start(&self, h: HalfEdgeId, track: Track) -> f64 {
        match self.places[self.mesh.origin(h).index()] {
            Place::Line { at, .. } => at,
            _ if track.is_along => 0.0,
            _ => self.original.chains[track.chain as usize].length,
        }
    }

    /// Returns the arc length from the origin of `h` to its target, measured along the chain. The result is negative if
    /// `h` runs against the direction of the chain.
    pub(super) fn way(&self, h: HalfEdgeId, track: Track) -> f64 {
        let chain = &self.original.chains[track.chain as usize];
        let back = Track {
            is_along: !track.is_along,
            ..track
        };
        let (from, to) = (self.start(h, track), self.start(h.twin(), back));
        if track.is_along {
            chain.way(from, to)
        } else {
            -chain.way(to, from)
        }
    }

    /// Returns the positions of the corners of the triangle of `h`, beginning at the origin of `h`.
    pub(super) fn triangle(&self, h: HalfEdgeId) -> [DVec3; 3] {
        let next = self.mesh.next(h);
        [h, next, self.mesh.next(next)].map(|h| self.mesh.position(self.mesh.origin(h)))
    }

    /// Returns the chart of a vertex that is inside a chart.
    pub(super) fn chart_at(&self, v: VertexId) -> Option<u32> {
        let h = self.mesh.vertex_half_edge(v)?;
        self.mesh.face(h).map(|f| self.charts[f.index()])
    }

    pub(super) fn chart(&self, f: FaceId) -> u32 {
        self.charts[f.index()]
    }
}

/// Returns a vector in the direction of the normal of a triangle. The length of the vector is twice the area of the
/// triangle.
pub(super) fn cross([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// Whether a step turns a triangle too far or makes it degenerate. The arguments are the [`cross`] products of the
/// triangle before and after the step.
pub(super) fn is_turned(before: DVec3, after: DVec3) -> bool {
    let cosine = TURN * (before.length_squared() * after.length_squared()).sqrt();
    let is_kept = after.dot(before) > cosine;
    before != DVec3::ZERO && !is_kept
}

/// The cosine of 20°. If the angle between the normals of two triangles is larger than 20°, the surface counts as bent
/// between them. Where the surface is bent, the distance between new triangles and the original surface is checked.
/// With the limit 20°, a remeshed rocker arm is at most 0.21 % of the diagonal of its bounding box away from the
/// original. With the limit 37°, this distance is 0.31 %.
const BENT: f64 = 0.94;

/// Whether the surface is bent between two triangles; see [`BENT`]. The arguments are the [`cross`] products of the
/// triangles.
pub(super) fn is_bent(a: DVec3, b: DVec3) -> bool {
    a.dot(b) < BENT * (a.length_squared() * b.length_squared()).sqrt()
}

/// Returns the quality of a triangle, from 0 (degenerate) to 1 (equilateral).
pub(super) fn quality([a, b, c]: [DVec3; 3]) -> f64 {
    let sides = (b - a).length_squared() + (c - b).length_squared() + (a - c).length_squared();
    let area = cross([a, b, c]).length();
    if sides > 0.0 {
        // Twice the area of an equilateral triangle with sides of length 1 is √3 / 2, and the sum of its squared sides
        // is 3. So its quality is 1.
        2.0 * 3.0_f64.sqrt() * area / sides
    } else {
        0.0
    }
}
