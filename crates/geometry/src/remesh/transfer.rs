//! Computes the attributes and the exact positions of the result of remeshing.
//!
//! Each element of the result has a location on the original surface: a vertex inside a chart lies on a triangle, and a
//! vertex on a line lies on an edge. A corner at a line gets its values from the side of the line on which the corner
//! lies. Values are therefore never mixed across a seam.

use mesh::{
    Attributes, Column, DVec3, Domain, EdgeId, FaceId, HalfEdgeId, Mesh, Rule, VertexId, parallel,
};
use mesh::{VERTEX_SHARPNESS, Values};
use progress::{Cancelled, Progress};

use super::WHAT;
use super::original::{Original, Place, Track, along};
use super::work::Work;

/// Up to three elements of the original mesh from which a new element gets its values, with the weights of these
/// elements.
#[derive(Clone, Copy)]
struct Blend {
    from: [usize; 3],
    weights: [f64; 3],
}

impl Blend {
    const fn one(i: usize) -> Self {
        Self {
            from: [i; 3],
            weights: [1.0, 0.0, 0.0],
        }
    }

    fn add_to(&self, add: &mut dyn FnMut(usize, f64)) {
        for (&i, &weight) in self.from.iter().zip(&self.weights) {
            if weight != 0.0 {
                add(i, weight);
            }
        }
    }
}

/// A vertex can be slightly off the original surface because of rounding. A distance of at most this fraction of the
/// target length is treated as such an error.
const ROUNDING: f64 = 1e-9;

impl Work<'_> {
    /// Returns the remeshed mesh in the coordinates of the original mesh, with attributes. The mesh must be
    /// [dense](mesh::Mesh::is_dense).
    pub(super) fn finish(self, progress: &dyn Progress) -> Result<Mesh, Cancelled> {
        progress.report(WHAT, self.counts.passes, self.counts.max_passes)?;
        let old = self.original.source.attributes();
        let vertices: Vec<(DVec3, Blend)> =
            parallel::collect(self.mesh.n_vertices(), |v| self.vertex(VertexId::new(v)));
        let mut new = Attributes::default();
        for column in old.of(Domain::Vertex) {
            let values = self.vertex_values(column, &vertices);
            new.insert(Domain::Vertex, column.with_values(values));
        }
        if !old.of(Domain::Corner).is_empty() {
            progress.report(WHAT, self.counts.passes, self.counts.max_passes)?;
            let corners: Vec<Option<Blend>> = parallel::collect(self.mesh.n_half_edges(), |h| {
                self.corner(HalfEdgeId::new(h), &vertices)
            });
            for column in old.of(Domain::Corner) {
                let values = column.values.blend(corners.len(), |i, add| {
                    if let Some(blend) = corners[i] {
                        blend.add_to(add);
                    }
                });
                new.insert(Domain::Corner, normalized(column, values));
            }
        }
        if !old.of(Domain::Edge).is_empty() {
            let edges: Vec<Option<usize>> = parallel::collect(self.mesh.n_edges(), |e| {
                self.edge(EdgeId::new(e)).map(EdgeId::index)
            });
            for column in old.of(Domain::Edge) {
                let values = column.values.gather(edges.len(), |i| edges[i]);
                new.insert(Domain::Edge, column.with_values(values));
            }
        }
        if !old.of(Domain::Face).is_empty() {
            progress.report(WHAT, self.counts.passes, self.counts.max_passes)?;
            let faces: Vec<usize> =
                parallel::collect(self.mesh.n_faces(), |f| self.face(FaceId::new(f)).index());
            for column in old.of(Domain::Face) {
                let values = column.values.gather(faces.len(), |i| Some(faces[i]));
                new.insert(Domain::Face, column.with_values(values));
            }
        }
        let mut mesh = self.mesh;
        for (position, (point, _)) in mesh.positions_mut().iter_mut().zip(&vertices) {
            *position = *point;
        }
        new.drop_by_rule();
        mesh.set_attributes(new);
        Ok(mesh)
    }

    /// Returns the position of a vertex in the coordinates of the original mesh. Also returns the vertices of the
    /// original mesh around this position, with their weights.
    fn vertex(&self, v: VertexId) -> (DVec3, Blend) {
        let Original { source, mesh, .. } = self.original;
        match self.places[v.index()] {
            Place::Corner(v) => (source.position(v), Blend::one(v.index())),
            Place::Line { chain, at } => {
                let (h, t) = self.original.chains[chain as usize].locate(at);
                let ends = [mesh.origin(h), mesh.target(h)];
                let [a, b] = ends.map(|v| source.position(v));
                let position = if t < 1.0 { a + t * (b - a) } else { b };
                let [a, b] = ends.map(VertexId::index);
                let blend = Blend {
                    from: [a, b, b],
                    weights: [1.0 - t, t, 0.0],
                };
                (position, blend)
            }
            Place::Inside(hint) => {
                let p = self.mesh.position(v);
                let chart = self.chart_at(v).expect("a vertex inside a chart has faces");
                let index = &self.original.indexes[chart as usize];
                let nearest = index.nearest(p, hint);
                let triangle = index.triangle(nearest.triangle);
                let weights = triangle.barycentric(p);
                let same = triangle
                    .vertices
                    .into_iter()
                    .find(|&v| mesh.position(v) == p);
                let position = if let Some(v) = same {
                    source.position(v)
                } else if nearest.distance <= ROUNDING * self.sizes[v.index()] {
                    let [a, b, c] = triangle.vertices.map(|v| source.position(v));
                    // If the plane of the triangle is perpendicular to an axis, this formula gives a position that is
                    // exactly in the plane.
                    a + weights[1] * (b - a) + weights[2] * (c - a)
                } else {
                    self.original.unscaled(p)
                };
                let blend = Blend {
                    from: triangle.vertices.map(VertexId::index),
                    weights,
                };
                (position, blend)
            }
        }
    }

    /// Returns the values that the new vertices have in a vertex attribute column. A new vertex has a tag if all
    /// original vertices around its location have the tag.
    fn vertex_values(&self, column: &Column, vertices: &[(DVec3, Blend)]) -> Values {
        let n = vertices.len();
        let is_corner = |i: usize| match self.places[i] {
            Place::Corner(v) => Some(v.index()),
            _ => None,
        };
        match &column.values {
            Values::Tag(tag) => {
                let has_tag = |(_, blend): &(DVec3, Blend)| {
                    let mut all = true;
                    blend.add_to(&mut |i, _| all &= tag[i]);
                    all
                };
                Values::Tag(vertices.iter().map(has_tag).collect())
            }
            _ if column.name == VERTEX_SHARPNESS.name => column.values.gather(n, is_corner),
            values => {
                let blend = values.blend(n, |i, add| vertices[i].1.add_to(add));
                normalized(column, blend).values
            }
        }
    }

    /// Returns the corners of the original mesh from which the new corner of `h` gets its values, with their weights.
    /// Returns `None` if the half-edge has no face.
    fn corner(&self, h: HalfEdgeId, vertices: &[(DVec3, Blend)]) -> Option<Blend> {
        self.mesh.face(h)?;
        let v = self.mesh.origin(h);
        let source = &self.original.mesh;
        let place = self.places[v.index()];
        if let Place::Inside(hint) = place {
            let chart = self.chart_at(v)?;
            let index = &self.original.indexes[chart as usize];
            let nearest = index.nearest(self.mesh.position(v), hint);
            let corners = index.triangle(nearest.triangle).corners;
            return Some(Blend {
                from: corners.map(HalfEdgeId::index),
                weights: vertices[v.index()].1.weights,
            });
        }
        // The corner lies in a sector between two lines around the vertex. The loop turns clockwise around the vertex
        // from `h` to the first line that it meets.
        let mut first = h;
        let track: Option<Track> = loop {
            if let Some(track) = self.track_of(first) {
                break Some(track);
            }
            first = self.mesh.next(first.twin());
            if first == h {
                break None;
            }
        };
        match (place, track) {
            (Place::Corner(v), None) => {
                let mut corners = source.vertex_half_edges(v);
                let corner = corners.find(|&h| source.face(h).is_some())?;
                Some(Blend::one(corner.index()))
            }
            (Place::Corner(_), Some(track)) => {
                let half_edges = &self.original.chains[track.chain as usize].half_edges;
                let first = if track.is_along {
                    half_edges[0]
                } else {
                    half_edges[half_edges.len() - 1].twin()
                };
                Some(Blend::one(first.index()))
            }
            (Place::Line { at, .. }, Some(track)) => {
                let (g, t) = self.original.chains[track.chain as usize].locate(at);
                // `g` is the half-edge of the original mesh on which the new vertex lies. The result is a blend of the
                // corners at the two ends of `g`. These corners are on the same side of the line as the new corner `h`.
                let (near, far, t) = if track.is_along {
                    (g, source.next(g), t)
                } else {
                    (g.twin(), source.next(g.twin()), 1.0 - t)
                };
                Some(Blend {
                    from: [near.index(), far.index(), far.index()],
                    weights: [1.0 - t, t, 0.0],
                })
            }
            (Place::Inside(_) | Place::Line { .. }, _) => None,
        }
    }

    /// Returns the edge of the original mesh from which a new edge gets its values. For a new edge on a line, the
    /// result is an edge of the line. For any other new edge, the original triangle nearest to the midpoint of the new
    /// edge is found, and the result is an edge of this triangle. If several of its edges are not on a line, the result
    /// is the one nearest to the midpoint. Returns `None` if all three edges of the triangle are on lines.
    fn edge(&self, e: EdgeId) -> Option<EdgeId> {
        if let Some(track) = self.tracks[e.index()] {
            let h = along(e, track);
            let forth = Track {
                is_along: true,
                ..track
            };
            let chain = &self.original.chains[track.chain as usize];
            let middle = chain.after(self.start(h, forth), 0.5 * self.way(h, forth));
            return Some(chain.locate(middle).0.edge());
        }
        let f = self.mesh.face(e.half_edges()[0])?;
        let [a, b] = self.mesh.edge_vertices(e).map(|v| self.mesh.position(v));
        let middle = 0.5 * (a + b);
        let index = &self.original.indexes[self.chart(f) as usize];
        let nearest = index.nearest(middle, self.hint_of(f));
        let triangle = index.triangle(nearest.triangle);
        let weights = triangle.barycentric(middle);
        // The barycentric weight of a corner is a ratio of two distances from the opposite side: the distance of the
        // point, divided by the distance of the corner.
        let side = |i: usize| (weights[(i + 2) % 3], triangle.corners[i].edge());
        (0..3)
            .map(side)
            .filter(|&(_, e)| self.original.tracks[e.index()].is_none())
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, e)| e)
    }

    /// Returns the face of the original mesh that is nearest to the center of the new face `f`.
    fn face(&self, f: FaceId) -> FaceId {
        let [a, b, c] = self.triangle(self.mesh.face_half_edge(f));
        let center = a / 3.0 + b / 3.0 + c / 3.0;
        let index = &self.original.indexes[self.chart(f) as usize];
        let nearest = index.nearest(center, self.hint_of(f));
        index.triangle(nearest.triangle).face
    }

    /// Returns the index of a triangle of the original surface that is near the face `f`. Returns 0, a valid index, if
    /// no such triangle is known.
    pub(super) fn hint_of(&self, f: FaceId) -> u32 {
        let hint = |v: VertexId| match self.places[v.index()] {
            Place::Inside(hint) => Some(hint),
            _ => None,
        };
        self.mesh.face_vertices(f).find_map(hint).unwrap_or(0)
    }
}

/// Returns a copy of an attribute column with the given values. If the values are normals, they are scaled to length 1.
fn normalized(column: &Column, mut values: Values) -> Column {
    if let (Rule::Normal, Values::Vec3(normals)) = (column.rule, &mut values) {
        for normal in normals {
            *normal = normal.normalize_or_zero();
        }
    }
    column.with_values(values)
}
