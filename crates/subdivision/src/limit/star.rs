//! The star of a vertex: the neighborhood that determines its limit position.

use mesh::{DVec3, HalfEdgeId, Mesh, VertexId};

use crate::rules::{Creasing, LoopWeights, Rules, Scheme};
use crate::sharpness::{Blend, INFINITE, SemiSharp, Sharpness, VertexRule, decreased};

/// A vertex and its neighbors. For Catmull-Clark, also the opposite corners of the quads around the vertex. One level
/// of subdivision maps a star to a smaller star with the same connectivity.
#[derive(Clone, Debug, Default)]
pub(crate) struct Star {
    pub(crate) center: DVec3,
    /// The positions of the neighbors, in counter-clockwise order. At a boundary vertex, the first and the last
    /// neighbor are the two neighbors along the boundary.
    pub(crate) spokes: Vec<DVec3>,
    /// For Catmull-Clark, the positions of the quad corners opposite to the vertex. Corner i is in the quad between
    /// spokes i and i + 1.
    pub(crate) opposite: Vec<DVec3>,
    /// Whether the vertex is inside the mesh. Around an inner vertex, a face also lies between the last spoke and the
    /// first spoke.
    pub(crate) is_inner: bool,
    /// The sharpness of the spokes.
    pub(crate) spoke_sharpness: Vec<f64>,
    /// The sharpness of the vertex.
    pub(crate) vertex_sharpness: f64,
    creasing: Creasing,
    /// The weights of Loop subdivision; `None` for Catmull-Clark.
    pub(crate) loop_weights: Option<LoopWeights>,
    /// A buffer for the centers of faces.
    face_points: Vec<DVec3>,
}

impl Star {
    /// Replaces this star by the star of vertex `v`. `start` is the outgoing half-edge that the mesh stores for `v`. If
    /// `v` is on the boundary, this is a boundary half-edge. With Catmull-Clark, if a face around the vertex is not a
    /// quad, this star becomes the star of the vertex on the next level instead, which has the same limit.
    pub(crate) fn read(
        &mut self,
        mesh: &Mesh,
        sharpness: &Sharpness,
        rules: Rules,
        v: VertexId,
        start: HalfEdgeId,
    ) {
        self.center = mesh.position(v);
        self.is_inner = mesh.face(start).is_some();
        self.vertex_sharpness = sharpness.vertex(v, start);
        self.creasing = rules.creasing;
        self.loop_weights = match rules.scheme {
            Scheme::Loop(weights) => Some(weights),
            _ => None,
        };
        self.spokes.clear();
        self.spoke_sharpness.clear();
        for h in mesh.vertex_half_edges(v) {
            self.spokes.push(mesh.position(mesh.target(h)));
            self.spoke_sharpness.push(sharpness.edge(h.edge()));
        }
        self.spokes.reverse();
        self.spoke_sharpness.reverse();
        self.opposite.clear();
        if self.loop_weights.is_some() {
            return;
        }
        let opposite = |h: HalfEdgeId| mesh.next(mesh.next(h));
        let faces = mesh
            .vertex_half_edges(v)
            .filter(|&h| mesh.face(h).is_some());
        if faces
            .clone()
            .all(|h| opposite(opposite(h)) == h && opposite(h) != h)
        {
            self.opposite
                .extend(faces.map(|h| mesh.position(mesh.origin(opposite(h)))));
            self.opposite.reverse();
            return;
        }
        self.face_points.clear();
        for f in faces.filter_map(|h| mesh.face(h)) {
            let (mut sum, mut n) = (DVec3::ZERO, 0_u32);
            for w in mesh.face_vertices(f) {
                sum += mesh.position(w);
                n += 1;
            }
            self.face_points.push(sum / f64::from(n));
        }
        self.face_points.reverse();
        self.shrink();
    }

    /// Whether no element of the star is semi-sharp. If this is true, the sharpness is the same on all further levels.
    pub(crate) fn is_settled(&self) -> bool {
        let settled = |s: f64| s <= 0.0 || s >= INFINITE;
        settled(self.vertex_sharpness) && self.spoke_sharpness.iter().all(|&s| settled(s))
    }

    /// Returns the rule of the vertex. If the star is settled (no element is semi-sharp), the rule is the same on all
    /// levels. The rule identifies spokes by their indices.
    pub(crate) fn rule(&self) -> VertexRule<usize> {
        VertexRule::of(
            self.vertex_sharpness,
            self.spoke_sharpness.iter().copied().enumerate(),
        )
    }

    /// Replaces this star by the star of the next level. (If an edge of the star has a sharpness below 1, Chaikin's
    /// rule can also need the sharpness of the edges at the far end of that edge. These edges are not in the star, so
    /// they are assumed to be as sharp as the edges at the center.)
    pub(crate) fn refine(&mut self) {
        self.face_points.clear();
        if self.loop_weights.is_none() {
            for (i, opposite) in self.opposite.iter().enumerate() {
                let next = self.spokes[(i + 1) % self.spokes.len()];
                let corners = self.center + self.spokes[i] + opposite + next;
                self.face_points.push(0.25 * corners);
            }
        }
        self.shrink();
    }

    /// Replaces this star by the star of the next level. With Catmull-Clark, `face_points` must already contain the
    /// centers of the faces around the vertex.
    fn shrink(&mut self) {
        let semi_sharp = SemiSharp::of(self.creasing, self.spoke_sharpness.iter().copied());
        let center = self.next_center(semi_sharp);
        let old = self.spokes.clone();
        let n = old.len();
        for (i, new) in self.spokes.iter_mut().enumerate() {
            let (s, end) = (self.spoke_sharpness[i], self.center + old[i]);
            let is_sharp =
                s >= 1.0 || self.creasing == Creasing::Chaikin && semi_sharp.half_of(s) > 0.0;
            let sharp = if is_sharp { 1.0 } else { s.max(0.0) };
            let smooth = || {
                let before = if i == 0 { n - 1 } else { i - 1 };
                match self.loop_weights {
                    Some(_) => 0.375 * end + 0.125 * (old[before] + old[(i + 1) % n]),
                    None => 0.25 * (end + self.face_points[before] + self.face_points[i]),
                }
            };
            *new = 0.5 * sharp * end;
            if sharp < 1.0 {
                *new += (1.0 - sharp) * smooth();
            }
        }
        self.center = center;
        std::mem::swap(&mut self.opposite, &mut self.face_points);
        self.vertex_sharpness = decreased(self.vertex_sharpness);
        for s in &mut self.spoke_sharpness {
            *s = semi_sharp.half_of(*s);
        }
    }

    fn next_center(&self, semi_sharp: SemiSharp) -> DVec3 {
        let edges = self
            .spoke_sharpness
            .iter()
            .map(|&s| [s, semi_sharp.half_of(s)]);
        let blend = Blend::of(
            [self.vertex_sharpness, decreased(self.vertex_sharpness)],
            edges.enumerate(),
        );
        let by_rule = |rule: VertexRule<usize>| match rule {
            VertexRule::Corner => self.center,
            VertexRule::Crease([i, j]) => {
                0.75 * self.center + 0.125 * (self.spokes[i] + self.spokes[j])
            }
            VertexRule::Smooth => {
                let n = self.spokes.len() as f64;
                let spokes: DVec3 = self.spokes.iter().sum();
                if let Some(weights) = self.loop_weights {
                    let u = weights.of(self.spokes.len());
                    return (1.0 - n * u) * self.center + u * spokes;
                }
                let face_points: DVec3 = self.face_points.iter().sum();
                (n - 2.0) / n * self.center + (spokes + face_points) / (n * n)
            }
        };
        match blend.next {
            None => by_rule(blend.now),
            Some((next, weight)) => weight * by_rule(blend.now) + (1.0 - weight) * by_rule(next),
        }
    }
}
