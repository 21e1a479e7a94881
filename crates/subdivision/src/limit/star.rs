//! The neighborhood of one vertex, which decides where its limit lies.

use mesh::{DVec3, HalfEdgeId, Mesh, VertexId};

use crate::rules::{Creasing, LoopWeights, Rules, Scheme};
use crate::sharpness::{Blend, INFINITE, SemiSharp, Sharpness, VertexRule, decreased};

/// A vertex, its neighbors, and for Catmull-Clark the corners opposite to it in the quads around it. One
/// level turns a star into a smaller one of the same shape.
#[derive(Clone, Debug, Default)]
pub(crate) struct Star {
    pub(crate) center: DVec3,
    /// The neighbors, counter-clockwise; at the boundary from one end to the other.
    pub(crate) spokes: Vec<DVec3>,
    /// For Catmull-Clark the opposite corners: number i lies between spokes i and i + 1.
    pub(crate) opposite: Vec<DVec3>,
    /// Whether there is a face between all spokes.
    pub(crate) is_inner: bool,
    /// The sharpness of the spokes.
    pub(crate) sharp: Vec<f64>,
    /// The sharpness of the vertex.
    pub(crate) at: f64,
    creasing: Creasing,
    /// `None` for Catmull-Clark.
    pub(crate) loop_weights: Option<LoopWeights>,
    /// Room for the middles of faces.
    middles: Vec<DVec3>,
}

impl Star {
    /// Becomes the star of a vertex that half-edge `start` leaves, the boundary one if there is one. Around
    /// polygons that are no quads that is the star of the next level, whose limit is the same.
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
        self.at = sharpness.vertex(v, start);
        self.creasing = rules.creasing;
        self.loop_weights = match rules.scheme {
            Scheme::Loop(weights) => Some(weights),
            _ => None,
        };
        self.spokes.clear();
        self.sharp.clear();
        for h in mesh.vertex_half_edges(v) {
            self.spokes.push(mesh.position(mesh.target(h)));
            self.sharp.push(sharpness.edge(h.edge()));
        }
        self.spokes.reverse();
        self.sharp.reverse();
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
        self.middles.clear();
        for f in faces.filter_map(|h| mesh.face(h)) {
            let (mut sum, mut n) = (DVec3::ZERO, 0_u32);
            for w in mesh.face_vertices(f) {
                sum += mesh.position(w);
                n += 1;
            }
            self.middles.push(sum / f64::from(n));
        }
        self.middles.reverse();
        self.shrink();
    }

    /// Whether no sharpness ends on a later level.
    pub(crate) fn is_settled(&self) -> bool {
        let settled = |s: f64| s <= 0.0 || s >= INFINITE;
        settled(self.at) && self.sharp.iter().all(|&s| settled(s))
    }

    /// The rule of the vertex; in a settled star that of all levels. Spokes are named by their numbers.
    pub(crate) fn rule(&self) -> VertexRule<usize> {
        VertexRule::of(self.at, self.sharp.iter().copied().enumerate())
    }

    /// Becomes the star of the next level. (Where Chaikin's rule asks for the other end of an edge whose
    /// sharpness is below 1, that end is taken to be like this one.)
    pub(crate) fn refine(&mut self) {
        self.middles.clear();
        if self.loop_weights.is_none() {
            for (i, opposite) in self.opposite.iter().enumerate() {
                let next = self.spokes[(i + 1) % self.spokes.len()];
                let corners = self.center + self.spokes[i] + opposite + next;
                self.middles.push(0.25 * corners);
            }
        }
        self.shrink();
    }

    /// Becomes the star of the next level, whose face points are in `middles`.
    fn shrink(&mut self) {
        let semi_sharp = SemiSharp::of(self.creasing, self.sharp.iter().copied());
        let center = self.next_center(semi_sharp);
        let old = self.spokes.clone();
        let n = old.len();
        for (i, new) in self.spokes.iter_mut().enumerate() {
            let (s, end) = (self.sharp[i], self.center + old[i]);
            let is_sharp =
                s >= 1.0 || self.creasing == Creasing::Chaikin && semi_sharp.half_of(s) > 0.0;
            let sharp = if is_sharp { 1.0 } else { s.max(0.0) };
            let smooth = || {
                let before = if i == 0 { n - 1 } else { i - 1 };
                match self.loop_weights {
                    Some(_) => 0.375 * end + 0.125 * (old[before] + old[(i + 1) % n]),
                    None => 0.25 * (end + self.middles[before] + self.middles[i]),
                }
            };
            *new = 0.5 * sharp * end;
            if sharp < 1.0 {
                *new += (1.0 - sharp) * smooth();
            }
        }
        self.center = center;
        std::mem::swap(&mut self.opposite, &mut self.middles);
        self.at = decreased(self.at);
        for s in &mut self.sharp {
            *s = semi_sharp.half_of(*s);
        }
    }

    fn next_center(&self, semi_sharp: SemiSharp) -> DVec3 {
        let edges = self.sharp.iter().map(|&s| [s, semi_sharp.half_of(s)]);
        let blend = Blend::of([self.at, decreased(self.at)], edges.enumerate());
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
                let middles: DVec3 = self.middles.iter().sum();
                (n - 2.0) / n * self.center + (spokes + middles) / (n * n)
            }
        };
        match blend.next {
            None => by_rule(blend.now),
            Some((next, weight)) => weight * by_rule(blend.now) + (1.0 - weight) * by_rule(next),
        }
    }
}
