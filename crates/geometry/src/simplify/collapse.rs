//! The loop that collapses edges.

use mesh::{Column, DVec3, Domain, EdgeId, FaceId, HalfEdgeId, Mesh, VERTEX_SHARPNESS, VertexId};
use progress::{Cancelled, Progress};
use rayon::prelude::*;

use crate::lines::{Kind, inverse_power_of_two, kinds, labels, lines};

use super::appearance::{Appearance, Around, Pair};
use super::contact::Contacts;
use super::quadric::{Quadric, Spread};
use super::queue::Queue;
use super::{Blocked, Options};

/// The weight of the squared distance to the area of the original surface that a vertex represents. This weight
/// is used to compare costs, where the squared distance to the planes of that area has the weight 1. Without this
/// weight, triangles become thin where the surface is flat or curved in one direction. On a torus of 1,000,000
/// triangles reduced to a tenth, one percent of the triangles have an angle below 9° with the weight 1e-6, and
/// below 15° with 2e-5. The distance to the original is the same for both weights.
const ROUNDNESS: f64 = 2e-5;

/// The weight that replaces [`ROUNDNESS`] when the new position is chosen. This weight is so small that it
/// matters only if many positions have the same distance to the planes.
const FIRMNESS: f64 = 1e-8;

/// The smallest cosine of the angle by which a collapse may turn a triangle.
const TURN: f64 = 0.2;

/// The state of an edge in the queue.
#[derive(Clone, Copy, PartialEq)]
enum State {
    Queued,
    Blocked(Blocked),
}

pub(super) struct Collapser<'a> {
    pub(super) mesh: Mesh,
    n_faces: usize,
    /// The values of vertices and corners that are interpolated, if there are any.
    pub(super) appearance: Option<Appearance>,
    /// The distances are computed in coordinates around `center`, scaled by a power of two, so that very small and
    /// very large meshes give the same result.
    center: DVec3,
    pub(super) scale: f64,
    /// The quadric of each vertex, by index.
    quadrics: Vec<Quadric>,
    spreads: Vec<Spread>,
    kinds: Vec<Kind>,
    /// The pass in which a collapse changed the vertex or one of its neighbors.
    touched: Vec<u32>,
    /// If there is an error limit, a bound on the distance between each face and the original surface, by face
    /// index.
    pub(super) errors: Vec<f64>,
    /// Whether each edge belongs to a line, by index.
    lines: Vec<bool>,
    states: Vec<State>,
    queue: Queue,
    /// The boxes of the faces, if intersections are refused.
    contacts: Option<Contacts>,
    pub(super) options: &'a Options<'a>,
}

/// The position of the vertex to which an edge would collapse.
pub(super) struct Target {
    /// The position, in the scaled coordinates of the [`Collapser`].
    pub(super) point: DVec3,
    /// The end of the edge that keeps its position; `None` if both ends move.
    pub(super) end: Option<VertexId>,
    /// The place on the edge, from 0 at its first end to 1, whose values the vertex gets; `None` for the values with the
    /// least error.
    t: Option<f64>,
    /// The mean squared distance from the point to the planes of the original triangles that the vertex
    /// represents, plus the mean squared error of its values, plus the mean squared distance to these triangles, with a
    /// small weight.
    cost: f64,
}

/// The faces around an edge, and the wedges that become one with their values.
type Values = (Around, Vec<(Pair, Vec<f64>)>);

impl<'a> Collapser<'a> {
    /// Prepares the simplification of a dense mesh of triangles.
    pub(super) fn new(mut mesh: Mesh, options: &'a Options<'a>) -> Self {
        let [min, max] = crate::bounds(&mesh).unwrap_or_default();
        let center = 0.5 * min + 0.5 * max;
        let scale = inverse_power_of_two((max - min).max_element());
        let lines = lines(&mesh, options.features);
        let kinds = kinds(&mesh, &lines, options.pinned);
        let place = |mesh: &Mesh, v: VertexId| (mesh.position(v) - center) * scale;
        let mut this = Self {
            n_faces: mesh.n_faces(),
            appearance: Appearance::take(&mut mesh, &lines, place),
            center,
            scale,
            quadrics: Vec::new(),
            spreads: Vec::new(),
            kinds,
            touched: vec![0; mesh.n_vertices()],
            errors: vec![
                0.0;
                if options.error.is_some() {
                    mesh.n_faces()
                } else {
                    0
                }
            ],
            lines,
            states: vec![State::Queued; mesh.n_edges()],
            queue: Queue::new(),
            contacts: (options.refuse_intersections)
                .then(|| Contacts::new(&mesh))
                .flatten(),
            options,
            mesh,
        };
        (this.quadrics, this.spreads) = (0..this.mesh.n_vertices())
            .into_par_iter()
            .map(|v| this.measures_at(VertexId::new(v)))
            .unzip();
        let costs: Vec<Result<f64, Blocked>> = (0..this.mesh.n_edges())
            .into_par_iter()
            .map(|e| this.target(EdgeId::new(e)).map(|target| target.cost))
            .collect();
        for (e, cost) in costs.into_iter().enumerate() {
            this.enqueue(EdgeId::new(e), cost);
        }
        this
    }

    /// Collapses edges until the mesh has at most the requested number of faces, or no remaining edge may be
    /// collapsed.
    pub(super) fn run(&mut self, progress: &dyn Progress) -> Result<(), Cancelled> {
        let start = self.n_faces;
        let mut visits = 0_u32;
        while self.n_faces > self.options.faces {
            if visits.is_multiple_of(1024) {
                let (done, total) = (start - self.n_faces, start - self.options.faces);
                progress.report("simplify", done as u64, total as u64)?;
            }
            visits = visits.wrapping_add(1);
            let Some(e) = self.queue.pop() else {
                break;
            };
            if self.mesh.has_edge(e) {
                self.visit(e);
            }
        }
        Ok(())
    }

    /// Returns the number of blocked edges for each reason.
    pub(super) fn blocked(&self) -> Vec<(Blocked, usize)> {
        let blocked = |e: EdgeId| match self.states[e.index()] {
            State::Blocked(reason) => Some(reason),
            State::Queued => None,
        };
        let count = |reason| {
            self.mesh
                .edges()
                .filter(|&e| blocked(e) == Some(reason))
                .count()
        };
        let counts = Blocked::ALL
            .into_iter()
            .map(|reason| (reason, count(reason)));
        counts.filter(|&(_, count)| count > 0).collect()
    }

    fn visit(&mut self, e: EdgeId) {
        let target = match self.target(e) {
            Ok(target) => target,
            Err(reason) => return self.enqueue(e, Err(reason)),
        };
        let ends = self.mesh.edge_vertices(e);
        let pass = self.queue.pass();
        // The cost of an edge grows when its neighbors collapse. Edges near a collapse wait for the next pass, so that
        // the collapses of a pass are spread over the surface.
        if self.queue.is_later(target.cost) || ends.iter().any(|v| self.touched[v.index()] == pass)
        {
            return self.enqueue(e, Ok(target.cost));
        }
        match self.collapse(e, &target) {
            Err(reason) => self.enqueue(e, Err(reason)),
            Ok(v) => {
                self.touched[v.index()] = pass;
                for w in self.mesh.vertex_neighbors(v) {
                    self.touched[w.index()] = pass;
                }
                // The collapse can make it possible to collapse edges that were blocked.
                let around: Vec<EdgeId> = self
                    .mesh
                    .vertex_half_edges(v)
                    .map(HalfEdgeId::edge)
                    .collect();
                for e in around {
                    if self.states[e.index()] != State::Queued {
                        self.enqueue(e, self.target(e).map(|target| target.cost));
                    }
                }
            }
        }
    }

    fn enqueue(&mut self, e: EdgeId, cost: Result<f64, Blocked>) {
        self.states[e.index()] = match cost {
            Ok(cost) => {
                self.queue.push(e, cost);
                State::Queued
            }
            Err(reason) => State::Blocked(reason),
        };
    }

    fn collapse(&mut self, e: EdgeId, target: &Target) -> Result<VertexId, Blocked> {
        let [a, b] = self.mesh.edge_vertices(e);
        if self.labels_differ(a, b) {
            return Err(Blocked::Labels);
        }
        if self.turns(a, b, target.point) || self.turns(b, a, target.point) {
            return Err(Blocked::Turned);
        }
        let mut merged = [None; 2];
        let mut n_removed = 0;
        for (h, merged) in e.half_edges().into_iter().zip(&mut merged) {
            if self.mesh.face(h).is_some() {
                let next = self.mesh.next(h);
                let edges = [next, self.mesh.next(next)].map(HalfEdgeId::edge);
                let lines = edges.map(|e| self.lines[e.index()]);
                if lines == [true; 2] {
                    return Err(Blocked::Lines);
                }
                *merged = Some((edges, lines.contains(&true)));
                n_removed += 1;
            }
        }
        let errors = self.errors_after(e, target)?;
        let point = match target.end {
            Some(v) => self.mesh.position(v),
            None => target.point / self.scale + self.center,
        };
        let mut around: Vec<FaceId> = Vec::new();
        if let Some(contacts) = &self.contacts {
            if contacts.arise(&self.mesh, [a, b], point) {
                return Err(Blocked::Intersections);
            }
            around.extend([a, b].into_iter().flat_map(|v| self.mesh.vertex_faces(v)));
        }
        let values = self.values_after(e, target)?;
        let v = self.mesh.collapse_edge_to(e, point);
        let v = v.map_err(|_| Blocked::Topology)?;
        if let (Some(appearance), Some((around, merged))) = (&mut self.appearance, values) {
            appearance.merge(&self.mesh, [a, b], v, &around, merged);
        }
        self.n_faces -= n_removed;
        if let Some(contacts) = &mut self.contacts {
            for f in around {
                contacts.update(&self.mesh, f);
            }
        }
        for (f, error) in errors {
            self.errors[f.index()] = error;
        }
        for (edges, is_line) in merged.into_iter().flatten() {
            for e in edges {
                self.lines[e.index()] = is_line;
            }
        }
        let [i, j] = [a, b].map(VertexId::index);
        self.quadrics[v.index()] = self.quadrics[i] + self.quadrics[j];
        self.spreads[v.index()] = self.spreads[i] + self.spreads[j];
        self.kinds[v.index()] = match [self.kinds[i], self.kinds[j]] {
            kinds if kinds.contains(&Kind::Fixed) => Kind::Fixed,
            kinds if kinds.contains(&Kind::Line) => Kind::Line,
            _ => Kind::Inside,
        };
        Ok(v)
    }

    fn target(&self, e: EdgeId) -> Result<Target, Blocked> {
        let ends = self.mesh.edge_vertices(e);
        let [a, b] = ends.map(VertexId::index);
        let end = match [self.kinds[a], self.kinds[b]] {
            [Kind::Inside, Kind::Inside] => None,
            [Kind::Inside, _] => Some(1),
            [_, Kind::Inside] => Some(0),
            _ if !self.lines[e.index()] => return Err(Blocked::Lines),
            [Kind::Line, Kind::Line] => None,
            [Kind::Line, Kind::Fixed] => Some(1),
            [Kind::Fixed, Kind::Line] => Some(0),
            [Kind::Fixed, Kind::Fixed] => return Err(Blocked::Lines),
        };
        let planes = self.quadrics[a] + self.quadrics[b];
        let spread = self.spreads[a] + self.spreads[b];
        let mut sum = planes + spread.quadric(FIRMNESS);
        let is_line = self.lines[e.index()];
        let pairs = self.appearance.as_ref().map(|appearance| {
            let pairs = appearance.pairs(&self.mesh, e, is_line);
            (appearance, pairs.into_iter().flatten())
        });
        if let (Some((appearance, pairs)), None, false) = (&pairs, end, is_line) {
            sum = pairs
                .clone()
                .fold(sum, |sum, pair| sum + appearance.quadric(pair));
        }
        let points = ends.map(|v| self.position(v));
        // The bound on the distance needs a boundary vertex that is not moved.
        let end = end.or_else(|| {
            let is_bounded = self.options.error.is_some() && self.mesh.is_boundary_edge(e);
            is_bounded.then(|| usize::from(sum.at(points[1]) < sum.at(points[0])))
        });
        let point = end.map_or_else(|| lowest_near(&sum, points), |i| points[i]);
        let per_area = if spread.area > 0.0 {
            1.0 / spread.area
        } else {
            1.0
        };
        let deviation = per_area * planes.at(point);
        let t = match end {
            Some(i) => Some([0.0, 1.0][i]),
            None => is_line.then(|| along(points, point)),
        };
        let error = pairs.map_or(0.0, |(appearance, pairs)| {
            let error = |pair| match t {
                Some(t) => appearance.error(pair, point, t),
                None => appearance.least_error(pair, point),
            };
            pairs.map(error).sum()
        });
        let cost = deviation + per_area * (error + ROUNDNESS * spread.at(point));
        Ok(Target {
            point,
            t,
            end: end.map(|i| ends[i]),
            cost,
        })
    }

    /// Returns the faces around an edge, and the wedges that its collapse merges with their new values.
    fn values_after(&self, e: EdgeId, target: &Target) -> Result<Option<Values>, Blocked> {
        let Some(appearance) = &self.appearance else {
            return Ok(None);
        };
        let ends = self.mesh.edge_vertices(e);
        let around = appearance.around(&self.mesh, ends);
        let pairs = appearance.pairs(&self.mesh, e, self.lines[e.index()]);
        let merged = pairs.into_iter().flatten().map(|pair| {
            let values = match target.t {
                Some(t) => appearance.mixed(pair, t),
                None => appearance.best(pair, &around, target.point),
            };
            (pair, values)
        });
        let merged: Vec<(Pair, Vec<f64>)> = merged.collect();
        if appearance.turns(&around, &merged) {
            return Err(Blocked::Turned);
        }
        Ok(Some((around, merged)))
    }

    pub(super) fn position(&self, v: VertexId) -> DVec3 {
        (self.mesh.position(v) - self.center) * self.scale
    }

    /// Whether two vertices have different tags, whole numbers or sharpness.
    fn labels_differ(&self, a: VertexId, b: VertexId) -> bool {
        let differ = |column: &Column| !column.values.are_equal(a.index(), b.index());
        let sharpness = self.mesh.get(VERTEX_SHARPNESS);
        labels(&self.mesh, Domain::Vertex).any(differ)
            || sharpness.is_some_and(|sharpness| sharpness[a.index()] != sharpness[b.index()])
    }

    /// Whether a triangle at `v`, but not at `other`, would turn over or become degenerate if `v` moved to `point`.
    fn turns(&self, v: VertexId, other: VertexId, point: DVec3) -> bool {
        let old = self.position(v);
        self.mesh.vertex_half_edges(v).any(|h| {
            let next = self.mesh.next(h);
            let ends = [self.mesh.origin(next), self.mesh.target(next)];
            if self.mesh.face(h).is_none() || ends.contains(&other) {
                return false;
            }
            let [x, y] = ends.map(|w| self.position(w));
            let before = (x - old).cross(y - old);
            let after = (x - point).cross(y - point);
            let is_kept = after.dot(before)
                > TURN * (after.length_squared() * before.length_squared()).sqrt();
            !is_kept && before != DVec3::ZERO
        })
    }

    /// Returns the quadric and the area of a vertex. Each triangle contributes a third to each of its vertices.
    fn measures_at(&self, v: VertexId) -> (Quadric, Spread) {
        let (mut quadric, mut spread) = (Quadric::default(), Spread::default());
        for h in self.mesh.vertex_half_edges(v) {
            if self.mesh.face(h).is_some() {
                let [a, b, c] = self.triangle(h);
                let cross = (b - a).cross(c - a);
                let length = cross.length();
                if length > 0.0 {
                    let area = length / 6.0;
                    quadric = quadric + Quadric::plane(cross / length, a, area);
                    spread = spread + Spread::at_point((a + b + c) / 3.0, area);
                }
            }
            if self.lines[h.edge().index()] {
                quadric = quadric + self.line_quadric(h.edge());
            }
        }
        (quadric, spread)
    }

    /// Returns the sum of the squared distances to the planes that contain the edge and are perpendicular to
    /// one of its faces. This quadric keeps vertices near the line.
    fn line_quadric(&self, e: EdgeId) -> Quadric {
        let mut sum = Quadric::default();
        for h in e.half_edges() {
            if self.mesh.face(h).is_some() {
                let [a, b, c] = self.triangle(h);
                let along = b - a;
                if let Some(across) = along.cross(c - a).cross(along).try_normalize() {
                    sum = sum + Quadric::plane(across, a, along.length_squared());
                }
            }
        }
        sum
    }

    pub(super) fn triangle(&self, h: HalfEdgeId) -> [DVec3; 3] {
        let next = self.mesh.next(h);
        [h, next, self.mesh.next(next)].map(|h| self.position(self.mesh.origin(h)))
    }
}

/// Returns the place on an edge that is nearest to `point`, from 0 to 1.
fn along([a, b]: [DVec3; 2], point: DVec3) -> f64 {
    let t = (point - a).dot(b - a) / (b - a).length_squared();
    if t.is_nan() { 0.5 } else { t.clamp(0.0, 1.0) }
}

/// Returns the point where `quadric` is lowest. If there is no single lowest point, or if it is far from the
/// edge between `ends`, returns the lowest of three points: the two ends and their middle.
fn lowest_near(quadric: &Quadric, ends: [DVec3; 2]) -> DVec3 {
    let [a, b] = ends;
    let middle = 0.5 * (a + b);
    let is_near = |p: &DVec3| p.distance_squared(middle) <= 4.0 * a.distance_squared(b);
    quadric.lowest().filter(is_near).unwrap_or_else(|| {
        let value = |p: &DVec3| quadric.at(*p);
        [a, b].into_iter().fold(
            middle,
            |best, p| if value(&p) < value(&best) { p } else { best },
        )
    })
}
