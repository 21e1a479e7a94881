//! A tree of boxes over the triangles of a surface, to find the nearest point of the surface.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use mesh::{DVec3, FaceId, Mesh, VertexId};

use super::triangle::nearest_on_triangle;
use crate::triangulate::Cutter;

/// The triangles of a mesh in a tree.
pub(super) struct Surface {
    nodes: Vec<Node>,
    /// The triangles, in the order of the tree.
    triangles: Vec<Triangle>,
}

/// A triangle of a face.
#[derive(Clone, Copy)]
pub(super) struct Triangle {
    pub(super) at: [DVec3; 3],
    pub(super) vertices: [VertexId; 3],
    pub(super) face: FaceId,
}

/// The nearest point of a surface.
#[derive(Clone, Copy)]
pub(super) struct Hit {
    pub(super) distance: f64,
    /// A lower bound of the distance. It equals `distance`, except if the search was stopped early because too
    /// many triangles are almost equally near.
    pub(super) lower: f64,
    pub(super) point: DVec3,
    /// The index of the triangle that contains the point.
    pub(super) triangle: u32,
    /// The number of visited nodes.
    pub(super) visits: u32,
}

/// A box around the triangles `first..last`. An inner node has two children: the node that follows it in the
/// list, and the node with index `right`. In a leaf, `right` is 0.
struct Node {
    min: DVec3,
    max: DVec3,
    first: u32,
    last: u32,
    right: u32,
}

/// The maximum number of triangles of a leaf.
const LEAF: usize = 4;

/// A search for a nearest point accepts an inexact answer after it has visited this number of nodes.
/// A search usually visits at most a few hundred nodes.
const MAX_NODES: u32 = 1000;

/// Iterates over the triangles of the fan of a face.
pub(super) fn fan(mesh: &Mesh, face: FaceId) -> impl Iterator<Item = Triangle> {
    let mut corners = mesh.face_vertices(face);
    let first = corners.next();
    let mut last = corners.next();
    corners.filter_map(move |v| {
        let vertices = [first?, last.replace(v)?, v];
        Some(Triangle {
            at: vertices.map(|v| mesh.position(v)),
            vertices,
            face,
        })
    })
}

/// Appends the triangles of a face. A face with at most four corners is triangulated as a fan. A larger face is
/// triangulated by `cutter`: the triangles of a fan could lie on top of each other, and a point near the face would
/// be near all of them.
pub(super) fn triangulate(
    mesh: &Mesh,
    face: FaceId,
    cutter: &mut Cutter,
    triangles: &mut Vec<Triangle>,
) {
    if mesh.face_vertices(face).nth(4).is_none() {
        triangles.extend(fan(mesh, face));
        return;
    }
    let corners: Vec<VertexId> = mesh.face_vertices(face).collect();
    triangles.extend(cutter.cut(mesh, face).triangles().iter().map(|triangle| {
        let vertices = triangle.map(|i| corners[i as usize]);
        Triangle {
            at: vertices.map(|v| mesh.position(v)),
            vertices,
            face,
        }
    }));
}

impl Surface {
    /// Builds the surface of a mesh; `None` if the mesh has no faces.
    pub(super) fn new(mesh: &Mesh) -> Option<Self> {
        let mut surface = Self {
            nodes: Vec::new(),
            triangles: Vec::new(),
        };
        let mut cutter = Cutter::default();
        for f in mesh.faces() {
            triangulate(mesh, f, &mut cutter, &mut surface.triangles);
        }
        if surface.triangles.is_empty() {
            return None;
        }
        surface.build(0, surface.triangles.len());
        Some(surface)
    }

    pub(super) fn triangle(&self, i: u32) -> &Triangle {
        &self.triangles[i as usize]
    }

    /// Builds the node over the triangles `first..last`, and its children. The triangles are split along the
    /// longest side of the box, and each child gets half of them.
    fn build(&mut self, first: usize, last: usize) {
        let corners = self.triangles[first..last].iter().flat_map(|t| t.at);
        let (min, max) = corners.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(min, max), p| {
            (min.min(p), max.max(p))
        });
        let node = self.nodes.len();
        self.nodes.push(Node {
            min,
            max,
            first: number(first),
            last: number(last),
            right: 0,
        });
        if last - first <= LEAF {
            return;
        }
        let axis = (max - min).max_position();
        let key = |t: &Triangle| t.at[0][axis] + t.at[1][axis] + t.at[2][axis];
        let middle = (last - first) / 2;
        self.triangles[first..last]
            .select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)));
        self.build(first, first + middle);
        self.nodes[node].right = number(self.nodes.len());
        self.build(first + middle, last);
    }

    /// Returns the point nearest to `p`. `hint` is the index of a triangle that is probably near `p`; a good
    /// hint saves time.
    ///
    /// If `p` is the center of a sphere, all triangles are equally near and the search would visit all of them.
    /// After [`MAX_NODES`] nodes it continues with [`nearly_nearest`](Self::nearly_nearest), which stops early.
    pub(super) fn nearest(&self, p: DVec3, hint: u32) -> Hit {
        let mut best = Best {
            squared: f64::INFINITY,
            point: p,
            triangle: hint,
        };
        self.try_triangle(p, hint, &mut best);
        // Each child has half of the triangles, so the depth of the tree is at most 32.
        let mut stack = [(0, 0.0); 64];
        let mut height = 1;
        stack[0] = (0, self.nodes[0].distance_squared(p));
        let mut visits = 0;
        while height > 0 {
            height -= 1;
            let (i, squared) = stack[height];
            if squared >= best.squared {
                continue;
            }
            visits += 1;
            if visits > MAX_NODES {
                return self.nearly_nearest(p, best);
            }
            let Some(mut children) = self.visit(p, i, &mut best) else {
                continue;
            };
            // The nearer child is visited first.
            if children[0].1 <= children[1].1 {
                children.swap(0, 1);
            }
            for child in children {
                if child.1 < best.squared {
                    stack[height] = child;
                    height += 1;
                }
            }
        }
        best.hit(None, visits)
    }

    /// Continues the search and visits the nodes in order of their distances from `p`. If the search stops
    /// early, this order gives the best lower bound.
    fn nearly_nearest(&self, p: DVec3, mut best: Best) -> Hit {
        // Squares are non-negative, so they have the same order as their bits.
        let mut waiting = BinaryHeap::from([Reverse((0_u64, 0_usize))]);
        let mut visits = MAX_NODES;
        while let Some(Reverse((bits, i))) = waiting.pop() {
            let squared = f64::from_bits(bits);
            if squared >= best.squared {
                break;
            }
            visits += 1;
            if visits > 3 * MAX_NODES {
                return best.hit(Some(squared), visits);
            }
            for (child, squared) in self.visit(p, i, &mut best).into_iter().flatten() {
                if squared < best.squared {
                    waiting.push(Reverse((squared.to_bits(), child)));
                }
            }
        }
        best.hit(None, visits)
    }

    /// Tries the triangles of a leaf, or returns the children of an inner node with their squared distances.
    fn visit(&self, p: DVec3, i: usize, best: &mut Best) -> Option<[(usize, f64); 2]> {
        let node = &self.nodes[i];
        if node.right == 0 {
            for i in node.first..node.last {
                self.try_triangle(p, i, best);
            }
            return None;
        }
        let children = [i + 1, node.right as usize];
        Some(children.map(|i| (i, self.nodes[i].distance_squared(p))))
    }

    fn try_triangle(&self, p: DVec3, i: u32, best: &mut Best) {
        let point = nearest_on_triangle(p, &self.triangle(i).at);
        let squared = p.distance_squared(point);
        if squared < best.squared {
            *best = Best {
                squared,
                point,
                triangle: i,
            };
        }
    }

    /// Returns the distance from `p` to one triangle.
    pub(super) fn to_triangle(&self, p: DVec3, i: u32) -> f64 {
        p.distance(nearest_on_triangle(p, &self.triangle(i).at))
    }

    /// Returns the edge that two triangles share, if they share exactly two vertices.
    pub(super) fn shared_edge(&self, i: u32, j: u32) -> Option<[DVec3; 2]> {
        let (s, t) = (self.triangle(i), self.triangle(j));
        let mut shared = (0..3).filter(|&k| t.vertices.contains(&s.vertices[k]));
        match (shared.next(), shared.next(), shared.next()) {
            (Some(k), Some(l), None) => Some([s.at[k], s.at[l]]),
            _ => None,
        }
    }
}

/// The nearest point found so far.
struct Best {
    squared: f64,
    point: DVec3,
    triangle: u32,
}

impl Best {
    /// Converts to a [`Hit`]. `lower` is the squared lower bound for the nodes that were not visited, if any.
    fn hit(self, lower: Option<f64>, visits: u32) -> Hit {
        Hit {
            distance: self.squared.sqrt(),
            lower: lower.unwrap_or(self.squared).sqrt(),
            point: self.point,
            triangle: self.triangle,
            visits,
        }
    }
}

impl Node {
    fn distance_squared(&self, p: DVec3) -> f64 {
        p.distance_squared(p.max(self.min).min(self.max))
    }
}

/// Converts an array index. A mesh has fewer than 2³² half-edges, and fewer triangles than half-edges.
fn number(i: usize) -> u32 {
    u32::try_from(i).expect("fewer than 2^32 triangles")
}
