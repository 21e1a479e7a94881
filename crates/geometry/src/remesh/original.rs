//! The original surface of a remesh: its charts (regions between lines), its lines, and the location of each vertex on
//! them.
//!
//! ```text
//!     X-------+-------+-------X      Lines divide the surface into charts. A chain (+) is the part of a line between
//!     |       |   chart 1     |      two corners (X), or a closed line without corners. A parameter of a chain is an
//!     |chart 0+               |      arc length from its start.
//!     |       |               |
//!     X-------X-------+-------X
//! ```

use mesh::{Connectivity, DVec3, parallel};
use mesh::{Domain, EdgeId, FaceId, HalfEdgeId, Mesh, VERTEX_SHARPNESS, Values, VertexId};
use progress::{Cancelled, Progress};

use super::Options;
use crate::lines::{Kind, inverse_power_of_two, kinds, labels, lines};
use crate::surface_index::SurfaceIndex;

/// Marks a face that has not been assigned to a chart yet.
const NONE: u32 = u32::MAX;

/// The cosine of 40°. A vertex on a line is a corner if the line turns by more than 40° at this vertex.
const STRAIGHT: f64 = 0.766_044_443_118_978;

pub(super) struct Original<'a> {
    /// The original mesh, which is [dense](mesh::Mesh::is_dense).
    pub(super) source: &'a Mesh,
    /// The mesh `source` without attributes, in coordinates relative to `center`, scaled by a power of two. In these
    /// coordinates, the size of the mesh does not matter: very small and very large meshes of the same shape give the
    /// same result.
    pub(super) mesh: Mesh,
    center: DVec3,
    pub(super) scale: f64,
    /// For each vertex, its location on the original surface.
    pub(super) places: Vec<Place>,
    /// For each vertex, its target valence. Flips change the number of edges at the vertex towards this number.
    pub(super) valences: Vec<u8>,
    /// For each edge, the chain that contains the edge. `None` if the edge is not a part of a line.
    pub(super) tracks: Vec<Option<Track>>,
    /// For each face, the index of its chart (a region between lines).
    pub(super) charts: Vec<u32>,
    pub(super) chains: Vec<Chain>,
    /// For each chart (a region between lines), the spatial index of its triangles.
    pub(super) indexes: Vec<SurfaceIndex>,
    /// For each face, the index of its triangle in the spatial index of its chart.
    pub(super) triangles: Vec<u32>,
}

/// Where a vertex lies on the original surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    /// At this vertex of the original mesh. A vertex at this place never moves.
    Corner(VertexId),
    /// On the line `chain`, at the arc length `at` from the start of the line.
    Line { chain: u32, at: f64 },
    /// Inside a chart, at the point of the chart that is nearest to the vertex. The value is the index of a triangle of
    /// the chart that is near this point.
    Inside(u32),
}

/// The chain that contains an edge, and the direction of the edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Track {
    pub(super) chain: u32,
    /// Whether the first half-edge of the edge has the direction of the chain.
    pub(super) is_along: bool,
}

/// A line between two corners, or a closed line without corners.
pub(super) struct Chain {
    /// The half-edges, in the direction of the chain.
    pub(super) half_edges: Vec<HalfEdgeId>,
    /// For each half-edge, the arc length from the start of the chain to the origin of the half-edge.
    starts: Vec<f64>,
    pub(super) length: f64,
    pub(super) is_closed: bool,
}

impl Chain {
    /// Returns the half-edge of the chain that contains the point at the arc length `at`. Also returns the position of
    /// this point along the half-edge: from 0 at its origin to 1 at its target.
    pub(super) fn locate(&self, at: f64) -> (HalfEdgeId, f64) {
        let i = self.starts.partition_point(|&start| start <= at).max(1) - 1;
        let end = self.starts.get(i + 1).map_or(self.length, |&end| end);
        let length = end - self.starts[i];
        let t = if length > 0.0 {
            ((at - self.starts[i]) / length).clamp(0.0, 1.0)
        } else {
            0.0
        };
        (self.half_edges[i], t)
    }

    /// Returns the arc length from one point of the chain to another, measured in the direction of the chain. Each
    /// point is given by its arc length from the start of the chain. If both points are equal, the result is 0, not the
    /// full length of a closed chain. No edge goes all the way around a closed chain, because the chain has at least
    /// three vertices.
    pub(super) fn way(&self, from: f64, to: f64) -> f64 {
        if self.is_closed && to < from {
            to - from + self.length
        } else {
            to - from
        }
    }

    /// Starts at the point `from`, moves along the chain by the arc length `way`, and returns the point that is
    /// reached. If `way` is negative, moves against the direction of the chain. Each point is given by its arc length
    /// from the start of the chain.
    pub(super) fn after(&self, from: f64, way: f64) -> f64 {
        let at = from + way;
        if self.is_closed && at >= self.length {
            at - self.length
        } else if self.is_closed && at < 0.0 {
            at + self.length
        } else {
            at
        }
    }
}

impl<'a> Original<'a> {
    /// Finds the charts and lines of a dense mesh of triangles.
    pub(super) fn new(
        source: &'a Mesh,
        options: &Options,
        progress: &dyn Progress,
    ) -> Result<Self, Cancelled> {
        let [min, max] = crate::bounds(source).unwrap_or_default();
        let center = 0.5 * min + 0.5 * max;
        let scale = inverse_power_of_two((max - min).max_element());
        let positions = source.positions().iter().map(|&p| (p - center) * scale);
        let connectivity: Connectivity = source.connectivity().clone();
        let mesh = Mesh::from_arrays(connectivity, positions.collect());
        let lines = lines(source, options.features);
        let kinds = fixed_kinds(source, &mesh, &lines, options.pinned);
        let mut this = Self {
            source,
            center,
            scale,
            valences: Vec::new(),
            places: kinds_to_places(&mesh, &kinds),
            tracks: vec![None; mesh.n_edges()],
            charts: Vec::new(),
            chains: Vec::new(),
            indexes: Vec::new(),
            triangles: Vec::new(),
            mesh,
        };
        this.add_chains(&lines, &kinds);
        this.valences = parallel::collect(this.mesh.n_vertices(), |v| {
            this.ideal_valence(VertexId::new(v))
        });
        this.add_charts(&lines, progress)?;
        for v in this.mesh.vertices() {
            let face = this.mesh.vertex_faces(v).next();
            if let (Place::Inside(hint), Some(f)) = (&mut this.places[v.index()], face) {
                *hint = this.triangles[f.index()];
            }
        }
        Ok(this)
    }

    /// Converts a point from scaled coordinates to the coordinates of `source`.
    pub(super) fn unscaled(&self, p: DVec3) -> DVec3 {
        p / self.scale + self.center
    }

    /// Returns the point at the arc length `at` from the start of a chain.
    pub(super) fn on_chain(&self, chain: u32, at: f64) -> DVec3 {
        let (h, t) = self.chains[chain as usize].locate(at);
        let [a, b] = [self.mesh.origin(h), self.mesh.target(h)].map(|v| self.mesh.position(v));
        a + t * (b - a)
    }

    fn add_chains(&mut self, lines: &[bool], kinds: &[Kind]) {
        let half_edges = |v: VertexId| {
            self.mesh
                .vertex_half_edges(v)
                .filter(|h| lines[h.edge().index()])
        };
        let mut is_taken = vec![false; lines.len()];
        let mut chains: Vec<Vec<HalfEdgeId>> = Vec::new();
        let mut walk = |first: HalfEdgeId, is_taken: &mut Vec<bool>| {
            let mut chain = Vec::new();
            let mut h = first;
            loop {
                chain.push(h);
                is_taken[h.edge().index()] = true;
                let v = self.mesh.target(h);
                let mut onwards = half_edges(v).filter(|g| g.edge() != h.edge());
                match onwards.next() {
                    Some(next) if kinds[v.index()] == Kind::Line && next != first => h = next,
                    _ => break,
                }
            }
            chains.push(chain);
        };
        let corners = self
            .mesh
            .vertices()
            .filter(|v| kinds[v.index()] == Kind::Fixed);
        for h in corners.flat_map(half_edges) {
            if !is_taken[h.edge().index()] {
                walk(h, &mut is_taken);
            }
        }
        for e in self.mesh.edges() {
            if lines[e.index()] && !is_taken[e.index()] {
                walk(e.half_edges()[0], &mut is_taken);
            }
        }
        for (number, half_edges) in (0..).zip(chains) {
            let mut length = 0.0;
            let mut starts = Vec::with_capacity(half_edges.len());
            for &h in &half_edges {
                let v = self.mesh.origin(h).index();
                starts.push(length);
                if kinds[v] == Kind::Line {
                    self.places[v] = Place::Line {
                        chain: number,
                        at: length,
                    };
                }
                self.tracks[h.edge().index()] = Some(Track {
                    chain: number,
                    is_along: h == h.edge().half_edges()[0],
                });
                length += self.mesh.length(h);
            }
            let start = self.mesh.origin(half_edges[0]);
            self.chains.push(Chain {
                is_closed: kinds[start.index()] == Kind::Line,
                half_edges,
                starts,
                length,
            });
        }
    }

    fn add_charts(&mut self, lines: &[bool], progress: &dyn Progress) -> Result<(), Cancelled> {
        let mesh = &self.mesh;
        self.charts = vec![NONE; mesh.n_faces()];
        self.triangles = vec![0; mesh.n_faces()];
        let mut faces: Vec<FaceId> = Vec::new();
        for f in mesh.faces() {
            if self.charts[f.index()] != NONE {
                continue;
            }
            progress.report(super::WHAT, 0, 1)?;
            let chart = u32::try_from(self.indexes.len()).expect("fewer charts than faces");
            faces.clear();
            faces.push(f);
            self.charts[f.index()] = chart;
            let mut done = 0;
            while let Some(&f) = faces.get(done) {
                done += 1;
                for h in mesh.face_half_edges(f).filter(|h| !lines[h.edge().index()]) {
                    if let Some(g) = mesh.face(h.twin())
                        && self.charts[g.index()] == NONE
                    {
                        self.charts[g.index()] = chart;
                        faces.push(g);
                    }
                }
            }
            faces.sort_unstable();
            let index = SurfaceIndex::of_faces(mesh, faces.iter().copied(), progress)?;
            let index = index.expect("a chart has a face");
            for i in 0..u32::try_from(index.n_triangles()).expect("fewer than 2^32") {
                self.triangles[index.triangle(i).face.index()] = i;
            }
            self.indexes.push(index);
        }
        Ok(())
    }

    /// Returns the number of edges that a vertex should have, so that the angles between them are near 60°.
    fn ideal_valence(&self, v: VertexId) -> u8 {
        let is_boundary = self.mesh.is_boundary_vertex(v);
        match self.places[v.index()] {
            Place::Corner(_) => {
                let angles = self
                    .mesh
                    .vertex_half_edges(v)
                    .filter(|&h| self.mesh.face(h).is_some())
                    .map(|h| self.mesh.corner_angle(h));
                let n = (angles.sum::<f64>() / std::f64::consts::FRAC_PI_3).round();
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "a small number"
                )]
                let n = n.clamp(1.0, 100.0) as u8;
                n + u8::from(is_boundary)
            }
            _ if is_boundary => 4,
            _ => 6,
        }
    }
}

fn kinds_to_places(mesh: &Mesh, kinds: &[Kind]) -> Vec<Place> {
    let place = |v: VertexId| match kinds[v.index()] {
        Kind::Inside if mesh.vertex_half_edge(v).is_some() => Place::Inside(0),
        // Until the chains (lines between two corners) are built, all vertices on lines have the place `Corner`. Later,
        // the vertices between the ends of a chain get the place `Line` instead.
        _ => Place::Corner(v),
    };
    mesh.vertices().map(place).collect()
}

/// Returns how each vertex is allowed to move. In addition to the fixed vertices of [`kinds`], these vertices keep
/// their positions: corners of lines, vertices with sharpness, and vertices whose tags would be lost.
fn fixed_kinds(source: &Mesh, mesh: &Mesh, lines: &[bool], pinned: &[VertexId]) -> Vec<Kind> {
    let kinds = kinds(source, lines, pinned);
    let tags: Vec<&[bool]> = labels(source, Domain::Vertex)
        .filter_map(|column| match &column.values {
            Values::Tag(tag) => Some(tag.as_slice()),
            _ => None,
        })
        .collect();
    let sharpness = source.get(VERTEX_SHARPNESS);
    let beside = |v: VertexId| -> Vec<VertexId> {
        let half_edges = mesh.vertex_half_edges(v);
        let on_lines = half_edges.filter(|h| lines[h.edge().index()]);
        on_lines.map(|h| mesh.target(h)).collect()
    };
    let is_corner = |v: VertexId| {
        let [a, b] = beside(v)[..] else {
            return true;
        };
        let (x, y) = (
            mesh.position(v) - mesh.position(a),
            mesh.position(b) - mesh.position(v),
        );
        // An edge of length zero has no direction. At both ends of such an edge, the comparison is false, so these
        // vertices count as corners.
        let is_straight = x.dot(y) > STRAIGHT * (x.length_squared() * y.length_squared()).sqrt();
        !is_straight
    };
    // A new vertex gets a tag only if all original vertices around its location have the tag.
    let loses_tag = |v: VertexId, kind: Kind| {
        tags.iter().any(|tag| {
            tag[v.index()]
                && !(kind == Kind::Line && beside(v).iter().all(|w| tag[w.index()]))
                && !mesh
                    .vertex_faces(v)
                    .any(|f| mesh.face_vertices(f).all(|w| tag[w.index()]))
        })
    };
    let kind = |v: VertexId| {
        let kind = kinds[v.index()];
        let is_fixed = (kind == Kind::Line && is_corner(v))
            || sharpness.is_some_and(|sharpness| sharpness[v.index()] > 0.0)
            || loses_tag(v, kind);
        if is_fixed { Kind::Fixed } else { kind }
    };
    parallel::collect(mesh.n_vertices(), |v| kind(VertexId::new(v)))
}

/// Returns the half-edge of `e` that runs in the direction of its chain.
pub(super) fn along(e: EdgeId, track: Track) -> HalfEdgeId {
    e.half_edges()[usize::from(!track.is_along)]
}
