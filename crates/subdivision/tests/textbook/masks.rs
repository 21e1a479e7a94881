//! The weights of Loop, Catmull-Clark and linear subdivision.

use std::collections::BTreeMap;

use subdivision::{LoopWeights, Rules, Scheme};

use crate::polygons::{Adjacency, Edge};
use crate::sharpness::{Rule, Sharpness, rule};

/// The mask of an old vertex: the weights of the vertex, of its neighbors, and of the centers of faces.
#[derive(Clone, Debug, Default)]
pub(crate) struct VertexMask {
    pub(crate) own: f64,
    pub(crate) neighbors: BTreeMap<usize, f64>,
    pub(crate) centers: BTreeMap<usize, f64>,
}

impl VertexMask {
    /// The mask of a vertex that stays in place.
    pub(crate) fn corner() -> Self {
        Self {
            own: 1.0,
            ..Self::default()
        }
    }

    /// The mask of a vertex on a crease: the weights of cubic B-spline subdivision, for the vertex and its two
    /// neighbors on the crease.
    fn crease(ends: &[usize]) -> Self {
        let neighbors = ends.iter().map(|&w| (w, 1.0 / 8.0)).collect();
        Self {
            own: 3.0 / 4.0,
            neighbors,
            ..Self::default()
        }
    }

    /// Adds the weights of `other`, multiplied by `t`.
    fn add(&mut self, t: f64, other: &Self) {
        self.own += t * other.own;
        for (&w, weight) in &other.neighbors {
            *self.neighbors.entry(w).or_default() += t * weight;
        }
        for (&f, weight) in &other.centers {
            *self.centers.entry(f).or_default() += t * weight;
        }
    }
}

/// The mask of the new vertex on an edge: the weight of each end of the edge, and the weight of one point of each face
/// beside the edge. For Catmull-Clark, this point is the center of the face; for Loop, it is the third corner.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeMask {
    pub(crate) end: f64,
    pub(crate) side: f64,
}

impl EdgeMask {
    /// The mask of the midpoint.
    pub(crate) const MIDPOINT: Self = Self {
        end: 0.5,
        side: 0.0,
    };
}

/// Returns the weight of each of n neighbors in Loop subdivision.
pub(crate) fn loop_weight(weights: LoopWeights, n: usize) -> f64 {
    let count = n as f64;
    match weights {
        LoopWeights::Warren if n == 3 => 3.0 / 16.0,
        LoopWeights::Warren => 3.0 / (8.0 * count),
        LoopWeights::Loop => {
            let t = 3.0 / 8.0 + libm::cos(std::f64::consts::TAU / count) / 4.0;
            (5.0 / 8.0 - t * t) / count
        }
    }
}

/// Returns the mask of an inner vertex without sharp edges.
fn smooth(v: usize, scheme: Scheme, adjacency: &Adjacency) -> VertexMask {
    let neighbors = &adjacency.neighbors[v];
    let n = neighbors.len() as f64;
    let all = |weight: f64| neighbors.iter().map(|&w| (w, weight)).collect();
    match scheme {
        Scheme::Loop(weights) => {
            let u = loop_weight(weights, neighbors.len());
            VertexMask {
                own: 1.0 - n * u,
                neighbors: all(u),
                ..VertexMask::default()
            }
        }
        _ => VertexMask {
            own: (n - 2.0) / n,
            neighbors: all(1.0 / (n * n)),
            centers: adjacency.corners[v]
                .iter()
                .map(|&(f, _)| (f, 1.0 / (n * n)))
                .collect(),
        },
    }
}

/// Returns the mask of the old vertex `v`.
pub(crate) fn of_vertex(
    v: usize,
    rules: Rules,
    adjacency: &Adjacency,
    sharpness: &Sharpness,
) -> VertexMask {
    if matches!(rules.scheme, Scheme::Midpoint(_)) || adjacency.neighbors[v].is_empty() {
        return VertexMask::corner();
    }
    let mask = |rule: Rule, sharp: &[usize]| match rule {
        Rule::Smooth | Rule::Dart => smooth(v, rules.scheme, adjacency),
        Rule::Crease => VertexMask::crease(sharp),
        Rule::Corner => VertexMask::corner(),
    };
    let sharp = sharpness.sharp_neighbors(v, adjacency);
    let parent = rule(sharpness.of_vertex(v), sharp.len());
    let still_sharp = sharpness.sharp_in_child(v, adjacency);
    let child = rule(sharpness.of_child(v), still_sharp.len());

    if parent == child || matches!(parent, Rule::Smooth | Rule::Dart) {
        return mask(parent, &sharp);
    }
    let neighbors: Vec<usize> = adjacency.neighbors[v].iter().copied().collect();
    let w = sharpness.fraction(v, &neighbors);
    let mut blend = VertexMask::default();
    blend.add(w, &mask(parent, &sharp));
    blend.add(1.0 - w, &mask(child, &still_sharp));
    blend
}

/// Returns the mask of the new vertex on an edge.
pub(crate) fn of_edge(e: Edge, rules: Rules, sharpness: &Sharpness) -> EdgeMask {
    let smooth = match rules.scheme {
        Scheme::Loop(_) => EdgeMask {
            end: 3.0 / 8.0,
            side: 1.0 / 8.0,
        },
        Scheme::CatmullClark => EdgeMask {
            end: 1.0 / 4.0,
            side: 1.0 / 4.0,
        },
        _ => return EdgeMask::MIDPOINT,
    };
    let t = sharpness.of_new_vertex(e);
    EdgeMask {
        end: t * 0.5 + (1.0 - t) * smooth.end,
        side: (1.0 - t) * smooth.side,
    }
}
