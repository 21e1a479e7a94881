//! How sharp edges and vertices are, in one level and the next.

use std::collections::BTreeMap;

use subdivision::{Boundary, Creasing};

use crate::polygons::{Around, Edge, Polygons, edge};

/// From here on sharpness never decreases.
const INFINITE: f64 = 10.0;

/// The four kinds of vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rule {
    /// No sharp edge.
    Smooth,
    /// One sharp edge ends here.
    Dart,
    /// A sharp line passes.
    Crease,
    /// Three sharp edges or more, or sharp itself.
    Corner,
}

/// Whether a sharpness is above 0 and decreases.
pub(crate) fn is_semi_sharp(s: f64) -> bool {
    s > 0.0 && s < INFINITE
}

/// One level less; more than infinite is infinite.
fn decreased(s: f64) -> f64 {
    if s >= INFINITE {
        INFINITE
    } else {
        (s - 1.0).max(0.0)
    }
}

/// The sharpness that counts, where the boundary is sharp, and that of the next level.
#[derive(Debug)]
pub(crate) struct Sharpness {
    creasing: Creasing,
    /// Of each edge.
    edges: BTreeMap<Edge, f64>,
    /// Of the half of each edge that ends at its first vertex and of the other one.
    halves: BTreeMap<Edge, [f64; 2]>,
    /// Of each vertex.
    vertices: Vec<f64>,
    /// Of each vertex, one level on.
    children: Vec<f64>,
    /// The numbers to store for the halves of each edge.
    pub(crate) stored_halves: BTreeMap<Edge, [f64; 2]>,
    /// The numbers to store for the old vertices.
    pub(crate) stored_vertices: Vec<f64>,
}

impl Sharpness {
    /// The sharpness of a mesh.
    pub(crate) fn new(
        mesh: &Polygons,
        around: &Around,
        boundary: Boundary,
        creasing: Creasing,
    ) -> Self {
        let is_fixed = |v: usize| match boundary {
            Boundary::EdgesOnly => false,
            Boundary::EdgesAndCorners => around.corners[v].len() == 1,
            Boundary::Fixed => around.is_boundary_vertex(v),
        };
        let stored = |e: &Edge| mesh.crease.get(e).copied().unwrap_or(0.0).max(0.0);
        let edges: BTreeMap<Edge, f64> = (around.sides.keys())
            .map(|&e| {
                (
                    e,
                    if around.is_boundary_edge(e) {
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
            let others: Vec<f64> = (around.neighbors[v].iter())
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
        // What is stored for the boundary does not matter and knows no neighbors.
        let mut stored_halves: BTreeMap<Edge, [f64; 2]> = halves_of(&stored);
        for (e, halves) in &mut stored_halves {
            if around.is_boundary_edge(*e) {
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

    /// Of the edge between two vertices.
    pub(crate) fn of_edge(&self, a: usize, b: usize) -> f64 {
        self.edges[&edge(a, b)]
    }

    /// Of the half at `v` of the edge from `v` to `w`.
    pub(crate) fn of_half(&self, v: usize, w: usize) -> f64 {
        self.halves[&edge(v, w)][usize::from(v > w)]
    }

    /// Of a vertex.
    pub(crate) fn of_vertex(&self, v: usize) -> f64 {
        self.vertices[v]
    }

    /// Of a vertex in the next level.
    pub(crate) fn of_child(&self, v: usize) -> f64 {
        self.children[v]
    }

    /// The neighbors to which sharp edges lead.
    pub(crate) fn sharp_neighbors(&self, v: usize, around: &Around) -> Vec<usize> {
        let is_sharp = |&w: &usize| self.of_edge(v, w) > 0.0;
        around.neighbors[v]
            .iter()
            .copied()
            .filter(is_sharp)
            .collect()
    }

    /// The neighbors towards which edges of the next level are sharp.
    pub(crate) fn sharp_in_child(&self, v: usize, around: &Around) -> Vec<usize> {
        let is_sharp = |&w: &usize| self.of_half(v, w) > 0.0;
        around.neighbors[v]
            .iter()
            .copied()
            .filter(is_sharp)
            .collect()
    }

    /// How much of the old kind of a vertex is left where it changes: the mean of what goes to 0, of the
    /// vertex itself and its edges to `neighbors`, at most 1.
    pub(crate) fn fraction(&self, v: usize, neighbors: &[usize]) -> f64 {
        let mut going = Vec::new();
        if self.vertices[v] > 0.0 && self.children[v] <= 0.0 {
            going.push(self.vertices[v]);
        }
        for &w in neighbors {
            let s = self.of_edge(v, w);
            let goes = match self.creasing {
                Creasing::Uniform => s <= 1.0,
                Creasing::Chaikin => self.of_half(v, w) <= 0.0,
            };
            if s > 0.0 && goes {
                going.push(s);
            }
        }
        if going.is_empty() {
            0.0
        } else {
            (going.iter().sum::<f64>() / going.len() as f64).min(1.0)
        }
    }

    /// How much of an edge's new vertex is its midpoint.
    pub(crate) fn of_new_vertex(&self, (a, b): Edge) -> f64 {
        let s = self.of_edge(a, b);
        let stays = self.creasing == Creasing::Chaikin
            && self.of_half(a, b) > 0.0
            && self.of_half(b, a) > 0.0;
        if stays { 1.0 } else { s.min(1.0) }
    }
}

/// The kind of a vertex.
pub(crate) fn rule(vertex: f64, n_sharp_edges: usize) -> Rule {
    match n_sharp_edges {
        _ if vertex > 0.0 => Rule::Corner,
        0 => Rule::Smooth,
        1 => Rule::Dart,
        2 => Rule::Crease,
        _ => Rule::Corner,
    }
}
