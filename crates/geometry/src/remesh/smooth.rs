//! Moves vertices along the surface, so that triangles become nearly equilateral.

use mesh::{DVec3, VertexId, parallel};
use progress::{Cancelled, Progress};

use super::WHAT;
use super::original::Place;
use super::work::{Work, cross, is_bent, is_turned};

/// A vertex that would move by less than this fraction of its target length is not moved. A vertex that possibly lies
/// off the original surface is moved in any case.
const STILL: f64 = 1e-2;

/// The movement of a vertex.
#[derive(Clone, Copy)]
struct Step {
    point: DVec3,
    place: Place,
    size: f64,
}

/// The number of values in a block. One thread computes all values of a block.
const BLOCK: usize = 256;

/// Sets the entry i of `values` to `value(i)`, for each index i. Calls `ask` for each block of values.
fn fill<T: Send>(
    values: &mut [T],
    ask: &(dyn Fn() -> Result<(), Cancelled> + Sync),
    value: impl Fn(usize) -> T + Sync,
) -> Result<(), Cancelled> {
    let blocks = parallel::consume(values.chunks_mut(BLOCK), |block, values| {
        ask()?;
        for (i, slot) in (block * BLOCK..).zip(values) {
            *slot = value(i);
        }
        Ok(())
    });
    blocks.into_iter().collect()
}

impl Work<'_> {
    /// Moves all vertices once. A vertex inside a chart first moves within its tangent plane. To find its goal there,
    /// the weighted mean of the centers of the triangles around it is projected onto this plane. The vertex then moves
    /// from the tangent plane to the nearest point of the original surface. A vertex on a line moves halfway towards
    /// the middle between its neighbors on the line. Movements that turn a triangle too far or move the surface too far
    /// are undone. For each vertex, the length of the movement is divided by the target length of the vertex; returns
    /// the largest of these numbers.
    pub(super) fn smooth(&mut self, progress: &dyn Progress) -> Result<f64, Cancelled> {
        progress.report(WHAT, self.counts.passes, self.counts.max_passes)?;
        let n = self.places.len();
        let ask = || progress.report(WHAT, self.counts.passes, self.counts.max_passes);
        let mut steps: Vec<Option<Step>> = vec![None; n];
        fill(&mut steps, &ask, |v| self.step(VertexId::new(v)))?;
        // Undoing the movement of a vertex can turn another triangle too far, so the test is repeated. The loop ends
        // because each round undoes at least one movement.
        let mut is_changed = vec![true; n];
        loop {
            let position = |v: VertexId| {
                steps[v.index()].map_or(self.mesh.position(v), |step: Step| step.point)
            };
            let mut turned = vec![false; self.charts.len()];
            fill(&mut turned, &ask, |f| {
                let f = mesh::FaceId::new(f);
                if !self.mesh.has_face(f) {
                    return false;
                }
                let h = self.mesh.face_half_edge(f);
                let next = self.mesh.next(h);
                let corners = [h, next, self.mesh.next(next)].map(|h| self.mesh.origin(h));
                if !corners.iter().any(|v| is_changed[v.index()]) {
                    return false;
                }
                let before = corners.map(|v| self.mesh.position(v));
                let after = corners.map(position);
                let own = cross(after);
                let beside = |h: mesh::HalfEdgeId| {
                    let h = h.twin();
                    let next = self.mesh.next(h);
                    let corners = [h, next, self.mesh.next(next)];
                    cross(corners.map(|h| position(self.mesh.origin(h))))
                };
                let is_bent = || {
                    let sides = [h, next, self.mesh.next(next)].into_iter();
                    let mut inner = sides.filter(|h| self.mesh.face(h.twin()).is_some());
                    inner.any(|h| is_bent(own, beside(h)))
                };
                before != after
                    && (is_turned(cross(before), own)
                        || ((self.limit.is_some() || is_bent()) && self.is_far(&[(f, after)], &[])))
            })?;
            if !turned.contains(&true) {
                break;
            }
            let taken_back = parallel::filter(n, |v| {
                let mut faces = self.mesh.vertex_faces(VertexId::new(v));
                steps[v].is_some() && faces.any(|f| turned[f.index()])
            });
            if taken_back.is_empty() {
                break;
            }
            is_changed.fill(false);
            for v in taken_back {
                steps[v] = None;
                is_changed[v] = true;
            }
        }
        let mut largest = 0.0_f64;
        for (v, step) in steps.into_iter().enumerate() {
            if let Some(step) = step {
                let id = VertexId::new(v);
                let moved = step.point.distance(self.mesh.position(id)) / step.size;
                largest = largest.max(moved);
                self.mesh.set_position(id, step.point);
                self.places[v] = step.place;
                self.sizes[v] = step.size;
                self.is_off[v] = false;
            }
        }
        Ok(largest)
    }

    fn step(&self, v: VertexId) -> Option<Step> {
        if !self.mesh.has_vertex(v) {
            return None;
        }
        match self.places[v.index()] {
            Place::Corner(_) => None,
            Place::Line { chain, at } => self.step_on_line(v, chain, at),
            Place::Inside(hint) => self.step_inside(v, hint),
        }
    }

    fn step_on_line(&self, v: VertexId, chain: u32, at: f64) -> Option<Step> {
        let half_edges = self.mesh.vertex_half_edges(v);
        let (mut sum, mut n) = (0.0, 0);
        for h in half_edges {
            if let Some(track) = self.track_of(h) {
                sum += self.way(h, track);
                n += 1;
            }
        }
        let size = self.sizes[v.index()];
        // `sum` is the sum of the signed arc lengths from the vertex to its two neighbors on the line. The middle
        // between these neighbors is at half of `sum`, so a quarter of `sum` is half the way. If all vertices moved the
        // whole way at the same time, they would oscillate.
        let way = 0.25 * sum;
        if n != 2 || way.abs() < STILL * size {
            return None;
        }
        let at = self.original.chains[chain as usize].after(at, way);
        Some(Step {
            point: self.original.on_chain(chain, at),
            place: Place::Line { chain, at },
            size: self.target.on_chain(self.original, chain, at),
        })
    }

    fn step_inside(&self, v: VertexId, hint: u32) -> Option<Step> {
        let p = self.mesh.position(v);
        let (mut sum, mut weight, mut normal) = (DVec3::ZERO, 0.0, DVec3::ZERO);
        for h in self.mesh.vertex_half_edges(v) {
            let [a, b, c] = self.triangle(h);
            let cross = cross([a, b, c]);
            // The center of each triangle has a weight: the area of the triangle times the sum of the target lengths at
            // the two corners other than `v`.
            let size = self.sizes[self.mesh.target(h).index()]
                + self.sizes[self.mesh.target(self.mesh.next(h)).index()];
            let area = cross.length() * size;
            normal += cross;
            sum += area * (b + c - 2.0 * p);
            weight += area;
        }
        let normal = normal.try_normalize()?;
        let way = sum / (3.0 * weight);
        let along = way - normal.dot(way) * normal;
        let size = self.sizes[v.index()];
        if !self.is_off[v.index()] && along.length() < STILL * size {
            return None;
        }
        let chart = self.chart_at(v)?;
        let nearest = self.original.indexes[chart as usize].nearest(p + along, hint);
        Some(Step {
            point: nearest.point,
            place: Place::Inside(nearest.triangle),
            size: self
                .target
                .at(self.original, chart, nearest.triangle, nearest.point),
        })
    }
}
