//! A mesh as lists, and who is next to whom in them.

use std::collections::{BTreeMap, BTreeSet};

use mesh::DVec3;

use crate::charts::Charts;

/// The two vertices of an edge, the lower one first.
pub(crate) type Edge = (usize, usize);

/// The edge of two vertices.
pub(crate) fn edge(a: usize, b: usize) -> Edge {
    (a.min(b), a.max(b))
}

/// A mesh as lists: all that the textbook works on.
#[derive(Clone, Debug, Default)]
pub(crate) struct Polygons {
    /// Where the vertices are.
    pub(crate) positions: Vec<DVec3>,
    /// The corners of each face, counter-clockwise.
    pub(crate) faces: Vec<Vec<usize>>,
    /// The stored sharpness of edges; 0 for the others.
    pub(crate) crease: BTreeMap<Edge, f64>,
    /// The stored sharpness of each vertex.
    pub(crate) corner: Vec<f64>,
    /// Corner values, if there are any.
    pub(crate) charts: Option<Charts>,
}

impl Polygons {
    /// A mesh without sharpness and corner values.
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

/// The next place around a face with `n` corners.
pub(crate) fn ahead(i: usize, n: usize) -> usize {
    (i + 1) % n
}

/// The place before around a face with `n` corners.
pub(crate) fn behind(i: usize, n: usize) -> usize {
    (i + n - 1) % n
}

/// Who is next to whom, found by looking through all faces.
#[derive(Debug)]
pub(crate) struct Around<'a> {
    faces: &'a [Vec<usize>],
    /// For each edge the sides that lie on it: a face, and the corner where the side begins.
    pub(crate) sides: BTreeMap<Edge, Vec<(usize, usize)>>,
    /// For each vertex its corners: a face, and the place in it.
    pub(crate) corners: Vec<Vec<(usize, usize)>>,
    /// For each vertex those that an edge joins with it.
    pub(crate) neighbors: Vec<BTreeSet<usize>>,
}

impl<'a> Around<'a> {
    /// Looks through all faces.
    pub(crate) fn new(n_vertices: usize, faces: &'a [Vec<usize>]) -> Self {
        let mut around = Self {
            faces,
            sides: BTreeMap::new(),
            corners: vec![Vec::new(); n_vertices],
            neighbors: vec![BTreeSet::new(); n_vertices],
        };
        for (f, face) in faces.iter().enumerate() {
            for (i, &a) in face.iter().enumerate() {
                let b = face[ahead(i, face.len())];
                around.sides.entry(edge(a, b)).or_default().push((f, i));
                around.corners[a].push((f, i));
                around.neighbors[a].insert(b);
                around.neighbors[b].insert(a);
            }
        }
        around
    }

    /// Whether the edge has one face.
    pub(crate) fn is_boundary_edge(&self, e: Edge) -> bool {
        self.sides[&e].len() == 1
    }

    /// The neighbors of `v` along the boundary: two or none.
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

    /// The neighbor of `v` along the boundary that is not `w`.
    pub(crate) fn beyond(&self, w: usize, v: usize) -> usize {
        let along = self.along_boundary(v);
        if along[0] == w { along[1] } else { along[0] }
    }

    /// The vertex at corner `i + by` of a face.
    pub(crate) fn at(&self, (f, i): (usize, usize), by: usize) -> usize {
        let face = &self.faces[f];
        face[(i + by) % face.len()]
    }

    /// The vertex before a corner of a face.
    pub(crate) fn before(&self, (f, i): (usize, usize)) -> usize {
        let face = &self.faces[f];
        face[behind(i, face.len())]
    }

    /// The corners at `v` counter-clockwise, at the boundary from one end to the other.
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
