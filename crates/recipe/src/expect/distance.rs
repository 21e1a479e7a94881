//! The distance between two surfaces.

use mesh::{DVec3, EdgeId, FaceId, Mesh};
use rayon::prelude::*;

/// The largest distance from the vertices and the middles of edges and faces of each mesh to the
/// surface of the other: a lower bound of the Hausdorff distance that gets close for small faces.
/// Infinite if one of them has no faces.
pub(super) fn largest(a: &Mesh, b: &Mesh) -> f64 {
    one_way(a, b).max(one_way(b, a))
}

fn one_way(from: &Mesh, to: &Mesh) -> f64 {
    let tree = Tree::new(to);
    let edge_middle = |e: EdgeId| {
        let [v, w] = from.edge_vertices(e);
        0.5 * (from.position(v) + from.position(w))
    };
    let samples: Vec<DVec3> = from
        .vertices()
        .map(|v| from.position(v))
        .chain(from.edges().map(edge_middle))
        .chain(from.faces().map(|f| from.face_center(f)))
        .collect();
    if samples.is_empty() {
        return f64::INFINITY;
    }
    samples
        .par_iter()
        .map(|&p| tree.distance_squared(p))
        .reduce(|| 0.0, f64::max)
        .sqrt()
}

/// A bounding volume hierarchy over the triangles of fans of the faces.
struct Tree {
    nodes: Vec<Node>,
    triangles: Vec<[DVec3; 3]>,
}

/// A box around triangles `first..last`; an inner node's children are the next node and `right`.
struct Node {
    min: DVec3,
    max: DVec3,
    first: usize,
    last: usize,
    right: usize,
}

const LEAF: usize = 8;

impl Tree {
    fn new(mesh: &Mesh) -> Self {
        let fan = |f: FaceId| {
            let corners: Vec<DVec3> = mesh.face_vertices(f).map(|v| mesh.position(v)).collect();
            (1..corners.len() - 1).map(move |i| [corners[0], corners[i], corners[i + 1]])
        };
        let mut tree = Self {
            nodes: Vec::new(),
            triangles: mesh.faces().flat_map(fan).collect(),
        };
        if !tree.triangles.is_empty() {
            tree.build(0, tree.triangles.len());
        }
        tree
    }

    /// Builds the node over these triangles, cut in half across its longest side.
    fn build(&mut self, first: usize, last: usize) {
        let corners = self.triangles[first..last].iter().flatten();
        let (min, max) = corners.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(min, max), &p| {
            (min.min(p), max.max(p))
        });
        let node = self.nodes.len();
        self.nodes.push(Node {
            min,
            max,
            first,
            last,
            right: 0,
        });
        if last - first <= LEAF {
            return;
        }
        let extent = max - min;
        let axis = if extent.x >= extent.y && extent.x >= extent.z {
            DVec3::X
        } else if extent.y >= extent.z {
            DVec3::Y
        } else {
            DVec3::Z
        };
        let key = |t: &[DVec3; 3]| (t[0] + t[1] + t[2]).dot(axis);
        let middle = (last - first) / 2;
        self.triangles[first..last]
            .select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)));
        self.build(first, first + middle);
        self.nodes[node].right = self.nodes.len();
        self.build(first + middle, last);
    }

    fn distance_squared(&self, p: DVec3) -> f64 {
        let mut best = f64::INFINITY;
        let mut stack = Vec::new();
        if !self.nodes.is_empty() {
            stack.push(0);
        }
        while let Some(i) = stack.pop() {
            let node = &self.nodes[i];
            if p.distance_squared(p.clamp(node.min, node.max)) >= best {
                continue;
            }
            if node.right == 0 {
                for t in &self.triangles[node.first..node.last] {
                    best = best.min(p.distance_squared(nearest_on_triangle(p, t)));
                }
            } else {
                stack.extend([node.right, i + 1]);
            }
        }
        best
    }
}

/// The point of a triangle nearest to `p`, by the region that `p` lies over.
///
/// Ericson, "Real-Time Collision Detection", 2005, §5.1.5.
fn nearest_on_triangle(p: DVec3, &[a, b, c]: &[DVec3; 3]) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    let (d1, d2) = (ab.dot(p - a), ac.dot(p - a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let (d3, d4) = (ab.dot(p - b), ac.dot(p - b));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let (d5, d6) = (ab.dot(p - c), ac.dot(p - c));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    a + ab * (vb / (va + vb + vc)) + ac * (vc / (va + vb + vc))
}

#[cfg(test)]
mod tests {
    use super::*;
    use mesh::shapes;

    #[test]
    fn a_mesh_has_no_distance_to_itself() {
        assert!(largest(&shapes::icosahedron(), &shapes::icosahedron()) < 1e-15);
    }

    #[test]
    fn shifted_squares_are_as_far_apart_as_the_shift() {
        let mut shifted = shapes::grid(9, 7);
        for p in shifted.positions_mut() {
            p.z += 0.25;
        }
        assert_eq!(largest(&shapes::grid(9, 7), &shifted), 0.25);
    }

    #[test]
    fn the_nearest_point_agrees_with_many_samples_of_the_triangle() {
        let t = [
            DVec3::ZERO,
            DVec3::new(3.0, 0.5, 0.0),
            DVec3::new(1.0, 2.0, 1.0),
        ];
        for i in 0..200 {
            let p = DVec3::new(
                f64::from(i % 7) - 2.0,
                f64::from(i % 5) - 1.0,
                f64::from(i % 3) - 1.0,
            );
            let found = p.distance(nearest_on_triangle(p, &t));
            let sampled = (0..=60)
                .flat_map(|a| (0..=60 - a).map(move |b| (f64::from(a) / 60.0, f64::from(b) / 60.0)))
                .map(|(u, v)| p.distance(t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0])))
                .fold(f64::INFINITY, f64::min);
            assert!(
                found <= sampled + 1e-12 && sampled < found + 0.06,
                "{p}: {found} {sampled}"
            );
        }
    }
}
