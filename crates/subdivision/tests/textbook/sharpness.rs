//! Computes the sharpness of edges and vertices on one level and on the next level.

use std::collections::BTreeMap;

use subdivision::{Boundary, Creasing};

use crate::polygons::{Adjacency, Edge, Polygons, edge};

/// A sharpness of at least this value does not decrease.
const INFINITE: f64 = 10.0;

/// The rule of a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rule {
    /// The vertex has no sharp edge.
    Smooth,
    /// The vertex has one sharp edge.
    Dart,
    /// The vertex has two sharp edges.
    Crease,
    /// The vertex has three or more sharp edges or is sharp itself.
    Corner,
}

/// Whether a sharpness is above 0 and decreases from level to level.
pub(crate) fn is_semi_sharp(s: f64) -> bool {
    s > 0.0 && s < INFINITE
}

/// Returns the sharpness on the next level by the uniform rule.
fn decreased(s: f64) -> f64 {
    if s >= INFINITE {
        INFINITE
    } else {
        (s - 1.0).max(0.0)
    }
}

/// The sharpness that the rules use, on one level and on the next level. Boundary edges are infinitely sharp.
#[derive(Debug)]
pub(crate) struct Sharpness {
    creasing: Creasing,
    /// The sharpness of each edge.
    edges: BTreeMap<Edge, f64>,
    /// For each edge, the sharpness that its two halves have on the next level: first the half at the first vertex,
    /// then the half at the second vertex.
    halves: BTreeMap<Edge, [f64; 2]>,
    /// The sharpness of each vertex.
    vertices: Vec<f64>,
    /// The sharpness of each vertex on the next level.
    children: Vec<f64>,
    /// The sharpness to store for the halves of each edge.
    pub(crate) stored_halves: BTreeMap<Edge, [f64; 2]>,
    /// The sharpness to store for the old vertices.
    pub(crate) stored_vertices: Vec<f64>,
}

impl Sharpness {
    /// Computes the sharpness of a mesh.
    pub(crate) fn new(
        mesh: &Polygons,
        adjacency: &Adjacency,
        boundary: Boundary,
        creasing: Creasing,
    ) -> Self {
        let is_fixed = |v: usize| match boundary {
            Boundary::EdgesOnly => false,
            Boundary::EdgesAndCorners => adjacency.corners[v].len() == 1,
            Boundary::Fixed => adjacency.is_boundary_vertex(v),
        };
        let stored = |e: &Edge| mesh.crease.get(e).copied().unwrap_or(0.0).max(0.0);
        let edges: BTreeMap<Edge, f64> = (adjacency.sides.keys())
            .map(|&e| {
                (
                    e,
                    if adjacency.is_boundary_edge(e) {
                        INFINITE
                    } else {
                        stored(&e)
                    },
                )
            })
            .collect();
        let vertices: Vec<f64> = (0..mesh.positions.len())
            .map(|v| {
                if is_fixed(v) {
                    INFINITE
                } else {
                    mesh.corner[v].max(0.0)
                }
            })
            .collect();
        let half = |e: Edge, v: usize, s: f64| {
            let others: Vec<f64> = (adjacency.neighbors[v].iter())
                .map(|&w| edge(v, w))
                .filter(|&other| other != e && is_semi_sharp(edges[&other]))
                .map(|other| edges[&other])
                .collect();
            if creasing == Creasing::Uniform || others.is_empty() || !is_semi_sharp(s) {
                decreased(s)
            } else {
                let mean = others.iter().sum::<f64>() / others.len() as f64;
                decreased(0.75 * s + 0.25 * mean)
            }
        };
        let halves_of = |s: &dyn Fn(&Edge) -> f64| {
            edges
                .keys()
                .map(|&e| (e, [half(e, e.0, s(&e)), half(e, e.1, s(&e))]))
                .collect()
        };
        let halves = halves_of(&|e| edges[e]);
        // The rules treat boundary edges as infinitely sharp, so their stored sharpness does not change the surface. On
        // each level, the stored sharpness decreases by the uniform rule.
        let mut stored_halves: BTreeMap<Edge, [f64; 2]> = halves_of(&stored);
        for (e, halves) in &mut stored_halves {
            if adjacency.is_boundary_edge(*e) {
                *halves = [decreased(stored(e)); 2];
            }
        }
        Self {
            creasing,
            halves,
            stored_halves,
            children: vertices.iter().map(|&s| decreased(s)).collect(),
            stored_vertices: mesh.corner.iter().map(|&s| decreased(s.max(0.0))).collect(),
            edges,
            vertices,
        }
    }

    /// Returns the sharpness of the edge between two vertices.
    pub(crate) fn of_edge(&self, a: usize, b: usize) -> f64 {
        self.edges[&edge(a, b)]
    }

    /// The next level divides the edge between `v` and `w` into two halves. Returns the sharpness of the half of this
    /// edge at `v`.
    pub(crate) fn of_half(&self, v: usize, w: usize) -> f64 {
        self.halves[&edge(v, w)][usize::from(v > w)]
    }

    /// Returns the sharpness of a vertex.
    pub(crate) fn of_vertex(&self, v: usize) -> f64 {
        self.vertices[v]
    }

    /// Returns the sharpness of a vertex on the next level.
    pub(crate) fn of_child(&self, v: usize) -> f64 {
        self.children[v]
    }

    /// Returns the neighbors along sharp edges.
    pub(crate) fn sharp_neighbors(&self, v: usize, adjacency: &Adjacency) -> Vec<usize> {
        let is_sharp = |&w: &usize| self.of_edge(v, w) > 0.0;
        adjacency.neighbors[v]
            .iter()
            .copied()
            .filter(is_sharp)
            .collect()
    }

    /// Returns the neighbors along edges that are sharp on the next level.
    pub(crate) fn sharp_in_child(&self, v: usize, adjacency: &Adjacency) -> Vec<usize> {
        let is_sharp = |&w: &usize| self.of_half(v, w) > 0.0;
        adjacency.neighbors[v]
            .iter()
            .copied()
            .filter(is_sharp)
            .collect()
    }

    /// If the rule of a vertex changes on the next level, the two rules are blended. Returns the weight of the current
    /// rule. The weight is computed from the vertex and its edges to `neighbors`: it is the mean sharpness of those
    /// elements that become smooth, limited to 1.
    pub(crate) fn fraction(&self, v: usize, neighbors: &[usize]) -> f64 {
        let mut ending = Vec::new();
        if self.vertices[v] > 0.0 && self.children[v] <= 0.0 {
            ending.push(self.vertices[v]);
        }
        for &w in neighbors {
            let s = self.of_edge(v, w);
            let ends = match self.creasing {
                Creasing::Uniform => s <= 1.0,
                Creasing::Chaikin => self.of_half(v, w) <= 0.0,
            };
            if s > 0.0 && ends {
                ending.push(s);
            }
        }
        if ending.is_empty() {
            0.0
        } else {
            (ending.iter().sum::<f64>() / ending.len() as f64).min(1.0)
        }
    }

    /// The new vertex on an edge is a blend of the midpoint and the smooth point. Returns the weight of the midpoint.
    pub(crate) fn of_new_vertex(&self, (a, b): Edge) -> f64 {
        let s = self.of_edge(a, b);
        let stays = self.creasing == Creasing::Chaikin
            && self.of_half(a, b) > 0.0
            && self.of_half(b, a) > 0.0;
        if stays { 1.0 } else { s.min(1.0) }
    }
}

/// Returns the rule of a vertex.
pub(crate) fn rule(vertex: f64, n_sharp_edges: usize) -> Rule {
    match n_sharp_edges {
        _ if vertex > 0.0 => Rule::Corner,
        0 => Rule::Smooth,
        1 => Rule::Dart,
        2 => Rule::Crease,
        _ => Rule::Corner,
    }
}
