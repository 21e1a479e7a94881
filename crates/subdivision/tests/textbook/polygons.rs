//! A mesh as polygon lists, and the adjacency of its elements.

use std::collections::{BTreeMap, BTreeSet};

use mesh::DVec3;

use crate::charts::Charts;

/// The two vertices of an edge, the lower one first.
pub(crate) type Edge = (usize, usize);

/// Returns the edge of two vertices.
pub(crate) fn edge(a: usize, b: usize) -> Edge {
    (a.min(b), a.max(b))
}

/// A mesh as polygon lists, the only input of the textbook implementation.
#[derive(Clone, Debug, Default)]
pub(crate) struct Polygons {
    /// The positions of the vertices.
    pub(crate) positions: Vec<DVec3>,
    /// The corners of each face, counter-clockwise.
    pub(crate) faces: Vec<Vec<usize>>,
    /// The stored sharpness of edges; edges without an entry have 0.
    pub(crate) crease: BTreeMap<Edge, f64>,
    /// The stored sharpness of each vertex.
    pub(crate) corner: Vec<f64>,
    /// The corner values, if any.
    pub(crate) charts: Option<Charts>,
}

impl Polygons {
    /// Creates a mesh without sharpness and corner values.
    pub(crate) fn new(positions: Vec<DVec3>, faces: Vec<Vec<usize>>) -> Self {
        let corner = vec![0.0; positions.len()];
        Self {
            positions,
            faces,
            corner,
            ..Self::default()
        }
    }
}

/// Returns the index of the next corner of a face with `n` corners.
pub(crate) fn ahead(i: usize, n: usize) -> usize {
    (i + 1) % n
}

/// Returns the index of the previous corner of a face with `n` corners.
pub(crate) fn behind(i: usize, n: usize) -> usize {
    (i + n - 1) % n
}

/// The adjacency of elements, computed from all faces.
#[derive(Debug)]
pub(crate) struct Adjacency<'a> {
    faces: &'a [Vec<usize>],
    /// For each edge, its sides. A side is given by its face and the index of the corner where it starts.
    pub(crate) sides: BTreeMap<Edge, Vec<(usize, usize)>>,
    /// For each vertex, its corners. A corner is given by its face and its index in the face.
    pub(crate) corners: Vec<Vec<(usize, usize)>>,
    /// The neighbors of each vertex.
    pub(crate) neighbors: Vec<BTreeSet<usize>>,
}

impl<'a> Adjacency<'a> {
    /// Computes the adjacency of all faces.
    pub(crate) fn new(n_vertices: usize, faces: &'a [Vec<usize>]) -> Self {
        let mut adjacency = Self {
            faces,
            sides: BTreeMap::new(),
            corners: vec![Vec::new(); n_vertices],
            neighbors: vec![BTreeSet::new(); n_vertices],
        };
        for (f, face) in faces.iter().enumerate() {
            for (i, &a) in face.iter().enumerate() {
                let b = face[ahead(i, face.len())];
                adjacency.sides.entry(edge(a, b)).or_default().push((f, i));
                adjacency.corners[a].push((f, i));
                adjacency.neighbors[a].insert(b);
                adjacency.neighbors[b].insert(a);
            }
        }
        adjacency
    }

    /// Whether the edge has only one face.
    pub(crate) fn is_boundary_edge(&self, e: Edge) -> bool {
        self.sides[&e].len() == 1
    }

    /// Returns the neighbors of `v` along the boundary: two or none.
    pub(crate) fn along_boundary(&self, v: usize) -> Vec<usize> {
        let is_boundary = |&w: &usize| self.is_boundary_edge(edge(v, w));
        self.neighbors[v]
            .iter()
            .copied()
            .filter(is_boundary)
            .collect()
    }

    /// Whether `v` lies on the boundary.
    pub(crate) fn is_boundary_vertex(&self, v: usize) -> bool {
        !self.along_boundary(v).is_empty()
    }

    /// Of the two neighbors of `v` along the boundary, returns the one that is not `w`.
    pub(crate) fn beyond(&self, w: usize, v: usize) -> usize {
        let along = self.along_boundary(v);
        if along[0] == w { along[1] } else { along[0] }
    }

    /// Returns the vertex at corner `i + by` of a face.
    pub(crate) fn at(&self, (f, i): (usize, usize), by: usize) -> usize {
        let face = &self.faces[f];
        face[(i + by) % face.len()]
    }

    /// Returns the vertex before a corner of a face.
    pub(crate) fn before(&self, (f, i): (usize, usize)) -> usize {
        let face = &self.faces[f];
        face[behind(i, face.len())]
    }

    /// Returns the corners at `v` counter-clockwise; on the boundary, from one boundary edge to the other.
    pub(crate) fn fan(&self, v: usize) -> Vec<(usize, usize)> {
        let corners = &self.corners[v];
        let leaves_boundary = |&&c: &&(usize, usize)| self.is_boundary_edge(edge(v, self.at(c, 1)));
        let mut fan: Vec<(usize, usize)> = corners
            .iter()
            .find(leaves_boundary)
            .or(corners.first())
            .copied()
            .into_iter()
            .collect();
        while fan.len() < corners.len() {
            let arrives = self.before(fan[fan.len() - 1]);
            let next = corners.iter().find(|&&c| self.at(c, 1) == arrives);
            fan.push(*next.expect("the faces around a vertex are one fan"));
        }
        fan
    }
}
