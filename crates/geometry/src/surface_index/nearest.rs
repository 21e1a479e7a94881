//! Searches for the points of a surface that are nearest to given points.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use mesh::{DVec3, Domain, Mesh, VertexId, parallel};
use progress::{Cancelled, Meter, Progress};

use super::triangle::nearest_on_triangle;
use super::{Node, SurfaceIndex};

/// The point of a surface that is nearest to a given point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// The distance between the two points, in scene units.
    pub distance: f64,
    /// A lower bound of the distance from the given point to the surface. The bound equals `distance`, unless the
    /// search stopped early because too many triangles are almost equally near.
    pub lower: f64,
    /// The nearest point.
    pub point: DVec3,
    /// The index of the triangle that contains the point. [`SurfaceIndex::triangle`] returns the triangle with this
    /// index.
    pub triangle: u32,
    /// The number of nodes of the tree that the search visited.
    pub(crate) visits: u32,
}

/// After this number of visited nodes, a search for a nearest point starts again, and then visits the nearest nodes
/// first. When both searches together have visited three times this number of nodes, an inexact answer is accepted. A
/// search usually visits at most a few hundred nodes.
const MAX_NODES: u32 = 1000;

/// After this number of visited nodes, a search uses the slabs of nodes in addition to their boxes. Most searches end
/// before they have visited this number of nodes.
const BOXES_ONLY: u32 = 64;

/// The number of points in a block. One thread searches for all points of a block. The search for the first point of a
/// block has no hint from a previous search.
const BLOCK: usize = 1024;

/// The text that progress reports show for the search.
const WHAT: &str = "find the nearest points";

impl SurfaceIndex {
    /// Returns the point of the surface nearest to `p`. If several triangles are equally near, the answer is one of
    /// them. `hint` is the index of a triangle that is probably near `p`, for example the result of the previous
    /// search. A good hint saves time. A hint that is out of range counts as 0.
    ///
    /// If `p` is the center of a sphere, all triangles are almost equally near, and a complete search would visit all
    /// of them. Therefore the search stops after a few thousand nodes and returns the nearest point found so far.
    /// [`Nearest::lower`] is then a lower bound of the distance to the true nearest point.
    ///
    /// The returned distance is infinite or NaN if `p` is not finite, or if squared coordinates are too large for an
    /// `f64`.
    pub fn nearest(&self, p: DVec3, hint: u32) -> Nearest {
        let (best, lower, visits) = self.nearest_below(p, hint, f64::INFINITY, 0.0);
        best.found(lower, visits)
    }

    /// Whether a triangle is at most `radius` away from `p`. `hint` has the same meaning as for
    /// [`nearest`](Self::nearest). If a triangle is found within `radius`, `hint` is set to its index. This test is
    /// faster than the search for the nearest point, because the test ends at the first triangle within `radius`.
    pub(crate) fn is_within(&self, p: DVec3, radius: f64, hint: &mut u32) -> bool {
        let squared = radius * radius;
        let (best, ..) = self.nearest_below(p, *hint, squared.next_up(), squared);
        let is_within = best.squared <= squared;
        if is_within {
            *hint = best.triangle;
        }
        is_within
    }

    /// Searches for the point of the surface nearest to `p` among the points whose squared distance is less than
    /// `limit`. Stops as soon as it finds a point whose squared distance is at most `enough`. Returns the nearest point
    /// found, the number of visited nodes, and, if the search was stopped early, the square of [`Nearest::lower`]. If
    /// the squared distance of every point is at least `limit`, the squared distance of the result is `limit`.
    fn nearest_below(
        &self,
        p: DVec3,
        hint: u32,
        limit: f64,
        enough: f64,
    ) -> (Best, Option<f64>, u32) {
        let hint = if (hint as usize) < self.n_triangles() {
            hint
        } else {
            0
        };
        let mut best = Best {
            squared: limit,
            point: p,
            triangle: hint,
        };
        self.try_triangle(p, hint, &mut best);
        // Each child has half of the triangles of its parent, and there are fewer than 2^32 triangles, so the depth of
        // the tree is at most 32.
        let mut stack = [(0, 0.0); 64];
        let mut height = 1;
        stack[0] = (0, self.nodes[0].distance_squared(p));
        let mut visits = 0;
        while height > 0 && best.squared > enough {
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
            if self.has_thin_triangles() {
                children = children.map(|child| self.tighter(p, child));
            }
            // The nearer child is visited first, because a near point found there makes it possible to skip the other
            // child.
            if children[0].1 <= children[1].1 {
                children.swap(0, 1);
            }
            for mut child in children {
                if visits > BOXES_ONLY && child.1 < best.squared && !self.has_thin_triangles() {
                    child = self.tighter(p, child);
                }
                if child.1 < best.squared {
                    stack[height] = child;
                    height += 1;
                }
            }
        }
        (best, None, visits)
    }

    /// Returns, for each of the given points, the nearest point of the surface, in the order of the given points. Runs
    /// in parallel; the result does not depend on the number of threads. The search is fastest if consecutive points
    /// are near each other.
    ///
    /// # Errors
    ///
    /// Returns [`Cancelled`] if `progress` asks to stop.
    pub fn nearest_to_points(
        &self,
        points: &[DVec3],
        progress: &dyn Progress,
    ) -> Result<Vec<Nearest>, Cancelled> {
        let meter = Meter::new(progress, WHAT, points.len() as u64);
        let found = self.nearest_to_all(points.len(), |i| Some(points[i]), &|n| meter.add(n))?;
        Ok(found.into_iter().flatten().collect())
    }

    /// Returns, for each vertex of a mesh, the nearest point of the surface. Entry i belongs to the vertex with the
    /// index i. The entry of a dead (removed) vertex is `None`. Runs in parallel; the result does not depend on the
    /// number of threads.
    ///
    /// # Errors
    ///
    /// Returns [`Cancelled`] if `progress` asks to stop.
    pub fn nearest_to_vertices(
        &self,
        mesh: &Mesh,
        progress: &dyn Progress,
    ) -> Result<Vec<Option<Nearest>>, Cancelled> {
        let position = |i| {
            let v = VertexId::new(i);
            mesh.has_vertex(v).then(|| mesh.position(v))
        };
        let n = mesh.domain_len(Domain::Vertex);
        let meter = Meter::new(progress, WHAT, n as u64);
        self.nearest_to_all(n, position, &|n| meter.add(n))
    }

    /// Returns, for each of the points `point(0)` to `point(n - 1)`, the nearest point of the surface. Where `point`
    /// returns `None`, the entry is also `None`. After each group of at most 128 points, calls `done` with the number
    /// of points in the group. Stops if `done` returns an error.
    pub(crate) fn nearest_to_all(
        &self,
        n: usize,
        point: impl Fn(usize) -> Option<DVec3> + Sync,
        done: &(dyn Fn(usize) -> Result<(), Cancelled> + Sync),
    ) -> Result<Vec<Option<Nearest>>, Cancelled> {
        let mut found = vec![None; n];
        let blocks = parallel::consume(found.chunks_mut(BLOCK), |b, block| {
            // Consecutive points are often near each other, so the triangle nearest to the previous point is a good
            // hint.
            let mut hint = 0;
            for (part, slots) in block.chunks_mut(128).enumerate() {
                for (i, slot) in slots.iter_mut().enumerate() {
                    *slot = point(b * BLOCK + part * 128 + i).map(|p| self.nearest(p, hint));
                    hint = slot.map_or(hint, |nearest| nearest.triangle);
                }
                done(slots.len())?;
            }
            Ok(())
        });
        blocks.into_iter().collect::<Result<(), Cancelled>>()?;
        Ok(found)
    }

    /// Searches again from the root of the tree. `best` is the nearest point that the first search found. The nodes are
    /// visited in order of their distances from `p`, because this order gives the best lower bound if the search stops
    /// early.
    fn nearly_nearest(&self, p: DVec3, mut best: Best) -> (Best, Option<f64>, u32) {
        // The heap compares the bits of `f64` numbers. For non-negative numbers, the bits (read as an integer) have the
        // same order as the numbers.
        let mut waiting = BinaryHeap::from([Reverse((0_u64, 0_usize))]);
        let mut visits = MAX_NODES;
        while let Some(Reverse((bits, i))) = waiting.pop() {
            let squared = f64::from_bits(bits);
            if squared >= best.squared {
                break;
            }
            visits += 1;
            if visits > 3 * MAX_NODES {
                return (best, Some(squared), visits);
            }
            for child in self.visit(p, i, &mut best).into_iter().flatten() {
                let (child, squared) = self.tighter(p, child);
                if squared < best.squared {
                    waiting.push(Reverse((squared.to_bits(), child)));
                }
            }
        }
        (best, None, visits)
    }

    /// Improves a lower bound on the squared distance from `p` to the triangles of a child node. The given bound,
    /// `squared`, is the squared distance to the box of the child. Returns the child with a bound that is at least as
    /// large.
    fn tighter(&self, p: DVec3, (child, squared): (usize, f64)) -> (usize, f64) {
        let bound = if self.has_thin_triangles() {
            self.oriented_distance_squared(p, child, squared)
        } else {
            self.slab_distance_squared(p, child, squared)
        };
        (child, bound)
    }

    /// In a leaf, tests all triangles and updates `best`. For an inner node, returns the two children with the squared
    /// distances from `p` to their boxes.
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
        let point = nearest_on_triangle(p, &self.positions[i as usize]);
        let squared = p.distance_squared(point);
        if squared < best.squared {
            *best = Best {
                squared,
                point,
                triangle: i,
            };
        }
    }

    /// Returns the distance from `p` to the triangle with the index `i`.
    pub(crate) fn to_triangle(&self, p: DVec3, i: u32) -> f64 {
        p.distance(nearest_on_triangle(p, &self.positions[i as usize]))
    }
}

/// The nearest point found so far.
struct Best {
    squared: f64,
    point: DVec3,
    triangle: u32,
}

impl Best {
    /// Converts this point to the result of a search. If the search did not visit some nodes, `lower` is a lower bound
    /// of the squared distances to the triangles of these nodes.
    fn found(self, lower: Option<f64>, visits: u32) -> Nearest {
        Nearest {
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
