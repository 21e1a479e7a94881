//! Computes the position to which an edge collapses and the cost of this collapse, and checks whether the collapse is
//! allowed.

use mesh::{Column, DVec3, Domain, EdgeId, HalfEdgeId, VERTEX_SHARPNESS, VertexId};

use crate::lines::{Kind, labels};
use crate::surface_index::triangle::nearest_on_segment;

use super::Blocked;
use super::appearance::{Merge, Pair};
use super::collapser::Collapser;
use super::quadric::Quadric;

/// The weight of one term in the cost of a collapse: the squared distance from the vertex to the centers of the
/// original triangles that the vertex represents. For comparison, the squared distance to the planes of these triangles
/// has the weight 1. If `ROUNDNESS` were 0, triangles would become thin where the surface is flat or curved in one
/// direction only. As an example, a torus of 1,000,000 triangles was reduced to a tenth of its triangles. With the
/// weight 1e-6, one percent of the triangles have an angle below 9°. With the weight 2e-5, one percent of the triangles
/// have an angle below 14°. The distance between the original and the simplified surface is the same for both weights.
const ROUNDNESS: f64 = 2e-5;

/// The weight that is used instead of [`ROUNDNESS`] when the new position of a vertex is chosen. This weight is so
/// small that it matters only if many positions have nearly the same distance to the planes, for example on a flat
/// surface.
const FIRMNESS: f64 = 1e-8;

/// A collapse is allowed to turn a triangle by at most 78°, the angle with this cosine.
const TURN: f64 = 0.2;

/// The vertex to which an edge would collapse: its position, its values and the cost.
pub(super) struct Target {
    /// The position, in the scaled coordinates of the [`Collapser`].
    pub(super) point: DVec3,
    /// The end of the edge that keeps its position. `None` if both ends move.
    pub(super) end: Option<VertexId>,
    /// The position, along the edge, of the point whose values the vertex gets: from 0 at the first end of the edge to
    /// 1 at its second end. If `None`, the vertex gets the values with the least error.
    t: Option<f64>,
    /// The cost of the collapse: the sum of these terms, divided by the square root of the area of the original
    /// triangles that the vertex represents:
    ///
    /// - the integral of the squared distance from the vertex to the planes of these triangles;
    /// - the integral of the squared error of the values of the vertex;
    /// - the [error of the line](Collapser::line_error), if the edge is on a line;
    /// - [`ROUNDNESS`] times the integral of the squared distance from the vertex to the centers of these triangles.
    pub(super) cost: f64,
}

impl Collapser<'_> {
    /// Returns the position to which an edge would collapse, and the cost of this collapse.
    pub(super) fn target(&self, e: EdgeId) -> Result<Target, Blocked> {
        let ends = self.mesh.edge_vertices(e);
        let [a, b] = ends.map(VertexId::index);
        let [from, to] = [&self.nodes[a], &self.nodes[b]];
        let end = match [from.kind, to.kind] {
            [Kind::Inside, Kind::Inside] => None,
            [Kind::Inside, _] => Some(1),
            [_, Kind::Inside] => Some(0),
            _ if !self.lines[e.index()] => return Err(Blocked::Lines),
            [Kind::Line, Kind::Line] => None,
            [Kind::Line, Kind::Fixed] => Some(1),
            [Kind::Fixed, Kind::Line] => Some(0),
            [Kind::Fixed, Kind::Fixed] => return Err(Blocked::Lines),
        };
        let planes = from.quadric + to.quadric;
        let spread = from.spread + to.spread;
        let mut placing = planes;
        let is_line = self.lines[e.index()];
        let pairs = self.appearance.as_ref().map(|appearance| {
            let pairs = appearance.pairs(&self.mesh, e, is_line);
            (appearance, pairs.into_iter().flatten())
        });
        if let (Some((appearance, pairs)), None, false) = (&pairs, end, is_line) {
            placing = pairs
                .clone()
                .fold(placing, |sum, pair| sum + appearance.placing(pair));
        }
        let weak = spread.quadric(FIRMNESS);
        let points = ends.map(|v| self.position(v));
        // If there is an error limit, a boundary edge must collapse to one of its ends. A bound on the distance is
        // known only for these two points.
        let end = end.or_else(|| {
            let is_bounded = self.options.error.is_some() && self.mesh.is_boundary_edge(e);
            let sum = placing + weak;
            is_bounded.then(|| usize::from(sum.at(points[1]) < sum.at(points[0])))
        });
        let point = end.map_or_else(|| lowest_near(&placing, &weak, points), |i| points[i]);
        let factor = if spread.area > 0.0 {
            1.0 / spread.area.sqrt()
        } else {
            1.0
        };
        let deviation = factor * planes.at(point);
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
        let line = if is_line {
            self.line_error(e, point)
        } else {
            0.0
        };
        let cost = deviation + factor * (error + line + ROUNDNESS * spread.at(point));
        Ok(Target {
            point,
            t,
            end: end.map(|i| ends[i]),
            cost,
        })
    }

    /// Returns the error of the line that contains `e`, after `e` is collapsed to `point`. The error is d times s. Here
    /// d is the largest squared distance from an end of `e` to the line after the collapse. The collapse changes the
    /// edges of the line just before and just after `e`; s is the sum of their squared lengths after the collapse. This
    /// term of the cost is needed if a short edge joins two long edges of different directions. Without this term, each
    /// end of the short edge could leave one of the long edges at no cost.
    fn line_error(&self, e: EdgeId, point: DVec3) -> f64 {
        let ends = self.mesh.edge_vertices(e);
        let neighbors = ends.map(|v| {
            let is_next = |h: &HalfEdgeId| h.edge() != e && self.lines[h.edge().index()];
            let next = self.mesh.vertex_half_edges(v).find(is_next);
            let is_end = self.nodes[v.index()].kind == Kind::Fixed;
            next.filter(|_| !is_end)
                .map_or(point, |h| self.position(self.mesh.target(h)))
        });
        let distances = ends.map(|v| {
            let p = self.position(v);
            let [x, y] = neighbors.map(|w| p.distance_squared(nearest_on_segment(p, w, point)));
            if x < y { x } else { y }
        });
        let largest = if distances[0] > distances[1] {
            distances[0]
        } else {
            distances[1]
        };
        let lengths = neighbors.map(|w| w.distance_squared(point));
        largest * (lengths[0] + lengths[1])
    }

    /// Returns the faces around an edge, and the pairs of wedges that the collapse of the edge merges, with their new
    /// values. A wedge is the set of face corners at a vertex that lie between two lines.
    pub(super) fn values_after(
        &self,
        e: EdgeId,
        target: &Target,
    ) -> Result<Option<Merge>, Blocked> {
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

    /// Checks whether an edge can be collapsed. Returns an error if its ends differ in a tag, a whole number or
    /// sharpness, if a triangle would turn too far, or if two edges of lines would merge.
    pub(super) fn check(&self, e: EdgeId, target: &Target) -> Result<(), Blocked> {
        let [a, b] = self.mesh.edge_vertices(e);
        if self.labels_differ(a, b) {
            return Err(Blocked::Labels);
        }
        if self.turns(a, b, target.point) || self.turns(b, a, target.point) {
            return Err(Blocked::Turned);
        }
        for h in e.half_edges() {
            let next = self.mesh.next(h);
            let edges = [next, self.mesh.next(next)].map(HalfEdgeId::edge);
            if self.mesh.face(h).is_some() && edges.iter().all(|e| self.lines[e.index()]) {
                return Err(Blocked::Lines);
            }
        }
        Ok(())
    }

    /// Whether two vertices differ in a tag, in a whole-number attribute or in sharpness.
    fn labels_differ(&self, a: VertexId, b: VertexId) -> bool {
        let differ = |column: &Column| !column.values.are_equal(a.index(), b.index());
        let sharpness = self.mesh.get(VERTEX_SHARPNESS);
        labels(&self.mesh, Domain::Vertex).any(differ)
            || sharpness.is_some_and(|sharpness| sharpness[a.index()] != sharpness[b.index()])
    }

    /// Whether a triangle at `v`, but not at `other`, would turn by more than 78° or become degenerate if `v` moved to
    /// `point`.
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

    pub(super) fn triangle(&self, h: HalfEdgeId) -> [DVec3; 3] {
        let next = self.mesh.next(h);
        [h, next, self.mesh.next(next)].map(|h| self.position(self.mesh.origin(h)))
    }
}

/// Finds the point of an edge that is nearest to `point`. Returns the position of this point along the edge: from 0 at
/// the first end to 1 at the second end.
fn along([a, b]: [DVec3; 2], point: DVec3) -> f64 {
    let t = (point - a).dot(b - a) / (b - a).length_squared();
    if t.is_nan() { 0.5 } else { t.clamp(0.0, 1.0) }
}

/// Returns the point where `quadric` is lowest; `weak` decides between points with nearly the same value. If there is
/// no single lowest point, or if this point is far from the edge between `ends`, only three points are compared: the
/// two ends and the midpoint of the edge. The result is the point with the lowest sum of `quadric` and `weak`.
fn lowest_near(quadric: &Quadric, weak: &Quadric, ends: [DVec3; 2]) -> DVec3 {
    let [a, b] = ends;
    let middle = 0.5 * (a + b);
    let is_near = |p: &DVec3| p.distance_squared(middle) <= 4.0 * a.distance_squared(b);
    quadric.lowest(weak).filter(is_near).unwrap_or_else(|| {
        let value = |p: &DVec3| quadric.at(*p) + weak.at(*p);
        [a, b].into_iter().fold(
            middle,
            |best, p| if value(&p) < value(&best) { p } else { best },
        )
    })
}

#[cfg(test)]
mod tests {
    use super::super::Options;
    use super::super::tests::{middle, square};
    use super::*;

    #[test]
    fn a_line_that_leaves_a_corner_has_an_error() {
        let mut mesh = square(2);
        let features = middle(&mesh);
        let corner = mesh.vertices().find(|&v| !mesh.is_boundary_vertex(v));
        mesh.set_position(corner.unwrap(), DVec3::new(0.6, 0.5, 0.0));
        let options = Options {
            features: &features,
            ..Options::default()
        };
        let collapser = Collapser::new(mesh, &options, &progress::NoProgress).unwrap();
        for &e in &features {
            // The other two vertices of the line are on the boundary, and keep their positions.
            let target = collapser.target(e).unwrap();
            assert!(target.end.is_some());
            let error = collapser.line_error(e, target.point);
            assert!((error - 0.01).abs() < 1e-12, "{error}");
        }
    }
}
