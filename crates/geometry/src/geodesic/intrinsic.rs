//! A triangulation that is defined only by the side lengths of its triangles. The edges of this triangulation can be
//! flipped.
//!
//! ```text
//!          k                    k
//!        /   \                / | \        The two triangles at an edge are laid out in a plane. The edge i-j is
//!       i-----j      --->    i  |  j       replaced by k-l, whose length is measured in this plane. The flip
//!        \   /                \ | /        does not change the surface. The triangles have no position in space.
//!          l                    l
//! ```
//!
//! Sources: Bobenko, Springborn, "A Discrete Laplace-Beltrami Operator for Simplicial Surfaces", 2007; Sharp, Crane, "A
//! Laplacian for Nonmanifold Triangle Meshes", 2020, section 4.5, for degenerate triangles.

use mesh::{DVec3, Mesh, parallel};
use progress::{Cancelled, Progress};
use rayon::prelude::*;

use crate::triangulate::Cutter;

/// In the table `glued`, marks a side that is not glued to another side.
const NONE: u32 = u32::MAX;
/// In every triangle, the sum of any two sides must exceed the third side by at least this fraction of the mean side
/// length. If one triangle fails this test, all sides of all triangles are lengthened by the same length.
const SLACK: f64 = 1e-5;
/// The largest number of edge flips is this number times the number of sides of all triangles.
const MAX_FLIPS: usize = 100;

/// Triangles that are glued along their sides. Side k of a triangle joins its corners k and k + 1 (modulo 3). The index
/// of the side is three times the index of the triangle, plus k.
pub(super) struct Intrinsic {
    /// The vertices of each triangle.
    pub(super) corners: Vec<[u32; 3]>,
    /// The lengths of the sides.
    pub(super) lengths: Vec<[f64; 3]>,
    /// For each side, the index of the side to which it is glued. The entry of a side that is not glued is [`NONE`].
    glued: Vec<[u32; 3]>,
}

impl Intrinsic {
    /// Creates the triangulation of a mesh whose vertices have the given positions. Polygons are cut into triangles. If
    /// a triangle is degenerate or almost degenerate, the same small length is added to all sides of all triangles.
    /// After that, all triangles have a positive area.
    pub(super) fn new(mesh: &Mesh, points: &[DVec3]) -> Self {
        let mut corners = Vec::with_capacity(mesh.n_faces());
        // Sides with equal keys are glued: sides on the same edge of the mesh, or on the same diagonal of a face.
        let mut sides: Vec<([u32; 3], u32)> = Vec::with_capacity(3 * mesh.n_faces());
        let small = |i: usize| u32::try_from(i).expect("ids fit 32 bits");
        let mut cutter = Cutter::default();
        let (mut vertices, mut edges) = (Vec::new(), Vec::new());
        for f in mesh.faces() {
            vertices.clear();
            edges.clear();
            for h in mesh.face_half_edges(f) {
                vertices.push(small(mesh.origin(h).index()));
                edges.push(small(h.edge().index()));
            }
            let n = small(vertices.len());
            let mut add = |triangle: [u32; 3]| {
                let first = small(3 * corners.len());
                for k in 0..3 {
                    let (a, b) = (triangle[k as usize], triangle[(k as usize + 1) % 3]);
                    let key = if (a + 1) % n == b {
                        [NONE, edges[a as usize], 0]
                    } else {
                        [small(f.index()), a.min(b), a.max(b)]
                    };
                    sides.push((key, first + k));
                }
                corners.push(triangle.map(|i| vertices[i as usize]));
            };
            if n == 3 {
                add([0, 1, 2]);
            } else {
                cutter.cut(mesh, f).triangles().iter().for_each(|&t| add(t));
            }
        }
        sides.par_sort_unstable();
        let mut glued = vec![[NONE; 3]; corners.len()];
        for pair in sides.windows(2) {
            let [(key, a), (other, b)] = [pair[0], pair[1]];
            if key == other && glued[(a / 3) as usize][(a % 3) as usize] == NONE {
                glued[(a / 3) as usize][(a % 3) as usize] = b;
                glued[(b / 3) as usize][(b % 3) as usize] = a;
            }
        }
        let length = |a: u32, b: u32| points[a as usize].distance(points[b as usize]);
        let of = |&[a, b, c]: &[u32; 3]| [length(a, b), length(b, c), length(c, a)];
        let lengths = parallel::collect(corners.len(), |t| of(&corners[t]));
        let mut all = Self {
            corners,
            lengths,
            glued,
        };
        all.mollify();
        all
    }

    /// Returns the mean length of the sides. Returns 0 if there are no sides.
    pub(super) fn mean_length(&self) -> f64 {
        let n = self.lengths.len();
        let sum = parallel::sum(n, |t| self.lengths[t].iter().sum::<f64>());
        if n == 0 { 0.0 } else { sum / (3 * n) as f64 }
    }

    /// Adds the same length to all sides of all triangles. After that, in every triangle, the sum of any two sides
    /// exceeds the third side by at least [`SLACK`] times the mean side length.
    fn mollify(&mut self) {
        let mean = self.mean_length();
        let slack = if mean > 0.0 { SLACK * mean } else { 1.0 };
        let missing = |&[a, b, c]: &[f64; 3]| slack - (a + b - c).min(b + c - a).min(c + a - b);
        let n = self.lengths.len();
        let more = parallel::fold(n, 0.0, |t| missing(&self.lengths[t]), f64::max);
        for sides in &mut self.lengths {
            *sides = sides.map(|length| length + more);
        }
    }

    /// Flips edges until all edges are Delaunay: the two angles opposite each edge add up to at most π. Stops when the
    /// number of flips reaches its limit; some edges are then not Delaunay.
    pub(super) fn flip_to_delaunay(&mut self, progress: &dyn Progress) -> Result<(), Cancelled> {
        let n = self.corners.len();
        let sides = (0..n).flat_map(|t| (0..3).map(move |k| 3 * t + k));
        let number = |s: usize| u32::try_from(s).unwrap_or(NONE);
        let mut stack: Vec<u32> = sides.map(number).collect();
        stack.reverse();
        let mut is_waiting = vec![true; 3 * n];
        let mut flips = 0;
        while let Some(side) = stack.pop() {
            is_waiting[side as usize] = false;
            if flips % 4096 == 0 {
                progress.report("flip edges", 0, 1)?;
            }
            if flips < MAX_FLIPS * 3 * n
                && let Some(outer) = self.flip_if_not_delaunay(side)
            {
                flips += 1;
                for side in outer {
                    if !std::mem::replace(&mut is_waiting[side as usize], true) {
                        stack.push(side);
                    }
                }
            }
        }
        Ok(())
    }

    /// Flips the edge that contains the given side, if the edge is not Delaunay. Returns the four other sides of the
    /// two triangles at the edge, which must be tested next. Returns `None` if the edge was not flipped.
    fn flip_if_not_delaunay(&mut self, side: u32) -> Option<[u32; 4]> {
        let (t, k) = place(side);
        let other = self.glued[t][k];
        if other == NONE {
            return None;
        }
        let (u, m) = place(other);
        if t == u {
            return None;
        }
        // The corners of the two triangles are i, j, k and j, i, l. The edge joins i and j.
        let turned = |of: [f64; 3], k: usize| [of[k], of[(k + 1) % 3], of[(k + 2) % 3]];
        let (a, b) = (turned(self.lengths[t], k), turned(self.lengths[u], m));
        let (cot, cut) = (cotangent(a), cotangent(b));
        if cot + cut >= -1e-9 * (1.0 + cot.abs() + cut.abs()) {
            return None;
        }
        let [ij, jk, ki] = a;
        let [_, il, lj] = b;
        let apex = |near: f64, far: f64| {
            let x = (ij * ij + near * near - far * far) / (2.0 * ij);
            (x, (near * near - x * x).max(0.0).sqrt())
        };
        let ((x, y), (v, w)) = (apex(ki, jk), apex(il, lj));
        let kl = ((x - v) * (x - v) + (y + w) * (y + w)).sqrt();
        let is_triangle = |[a, b, c]: [f64; 3]| a + b > c && b + c > a && c + a > b;
        let new = [[kl, lj, jk], [kl, ki, il]];
        if !new.into_iter().all(is_triangle) {
            return None;
        }
        let corner = |of: [u32; 3], k: usize| of[k % 3];
        let (i, j) = (self.corners[t][k], corner(self.corners[t], k + 1));
        let (top, low) = (
            corner(self.corners[t], k + 2),
            corner(self.corners[u], m + 2),
        );
        let number = |t: usize, k: usize| u32::try_from(3 * t + k % 3).unwrap_or(NONE);
        // For each of the sides lj, jk, ki and il: its index before the flip, and its index after the flip.
        let moved = [
            (number(u, m + 2), number(t, 1)),
            (number(t, k + 1), number(t, 2)),
            (number(t, k + 2), number(u, 1)),
            (number(u, m + 1), number(u, 2)),
        ];
        let now = |side: u32| {
            let found = moved.iter().find(|(old, _)| *old == side);
            found.map_or(side, |&(_, new)| new)
        };
        let outer = moved.map(|(old, _)| {
            let (t, k) = place(old);
            match self.glued[t][k] {
                NONE => NONE,
                side => now(side),
            }
        });
        (self.corners[t], self.corners[u]) = ([top, low, j], [low, top, i]);
        [self.lengths[t], self.lengths[u]] = new;
        self.glued[t][0] = number(u, 0);
        self.glued[u][0] = number(t, 0);
        for ((_, side), outer) in moved.into_iter().zip(outer) {
            let (t, k) = place(side);
            self.glued[t][k] = outer;
            if outer != NONE {
                let (u, m) = place(outer);
                self.glued[u][m] = side;
            }
        }
        Some(moved.map(|(_, side)| side))
    }
}

fn place(side: u32) -> (usize, usize) {
    ((side / 3) as usize, (side % 3) as usize)
}

/// Returns the area of a triangle with these side lengths, by Heron's formula.
pub(super) fn area([a, b, c]: [f64; 3]) -> f64 {
    0.25 * ((a + b + c) * (b + c - a) * (c + a - b) * (a + b - c))
        .max(0.0)
        .sqrt()
}

/// Returns the cotangent of the angle opposite the first side of a triangle with these side lengths.
pub(super) fn cotangent([a, b, c]: [f64; 3]) -> f64 {
    (b * b + c * c - a * a) / (4.0 * area([a, b, c]))
}

/// Returns the positions of all vertices of a mesh, multiplied by 2 to the power of `exponent`.
pub(super) fn scaled_points(mesh: &Mesh, exponent: i32) -> Vec<DVec3> {
    let points = mesh.positions();
    parallel::collect(points.len(), |v| {
        crate::laplacian::scaled(points[v], exponent)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;
    use progress::NoProgress;

    /// Returns the number of edges that are not Delaunay, and checks that sides are glued in pairs of equal lengths.
    fn not_delaunay(all: &Intrinsic) -> usize {
        let mut n = 0;
        for t in 0..all.corners.len() {
            for k in 0..3 {
                if all.glued[t][k] == NONE {
                    continue;
                }
                let (u, m) = place(all.glued[t][k]);
                assert_eq!(place(all.glued[u][m]), (t, k));
                let (a, b) = (all.lengths[t][k], all.lengths[u][m]);
                assert!((a - b).abs() < 1e-9, "{a} {b}");
                assert_eq!(all.corners[t][k], all.corners[u][(m + 1) % 3]);
                assert_eq!(all.corners[u][m], all.corners[t][(k + 1) % 3]);
                let turn = |of: [f64; 3], k: usize| [of[k], of[(k + 1) % 3], of[(k + 2) % 3]];
                let sum = cotangent(turn(all.lengths[t], k)) + cotangent(turn(all.lengths[u], m));
                n += usize::from(sum < -1e-6);
            }
        }
        n
    }

    #[test]
    fn flips_make_all_edges_delaunay_and_keep_the_area() {
        let mut stretched = shapes::torus(24, 9, 2.0, 0.5);
        for p in stretched.positions_mut() {
            p.z *= 20.0;
        }
        for mesh in [
            stretched,
            shapes::cube(),
            shapes::cylinder(40, true),
            shapes::grid(5, 3),
        ] {
            let points = scaled_points(&mesh, 0);
            let mut all = Intrinsic::new(&mesh, &points);
            let sum = |all: &Intrinsic| all.lengths.iter().map(|&l| area(l)).sum::<f64>();
            let before = sum(&all);
            assert_eq!(
                all.corners.len() + mesh.n_faces(),
                mesh.half_edges()
                    .filter(|&h| mesh.face(h).is_some())
                    .count()
                    - mesh.n_faces()
            );
            all.flip_to_delaunay(&NoProgress).unwrap();
            assert_eq!(not_delaunay(&all), 0);
            assert!((sum(&all) - before).abs() < 1e-9 * before);
        }
    }

    #[test]
    fn degenerate_triangles_get_an_area() {
        let mut mesh = shapes::icosahedron();
        let points = vec![DVec3::ONE; 12];
        assert!(
            Intrinsic::new(&mesh, &points)
                .lengths
                .iter()
                .all(|&l| area(l) > 0.0)
        );
        for p in mesh.positions_mut() {
            *p = DVec3::X * p.x;
        }
        let mut all = Intrinsic::new(&mesh, mesh.positions());
        assert!(all.lengths.iter().all(|&l| area(l) > 0.0));
        all.flip_to_delaunay(&NoProgress).unwrap();
        assert!(all.lengths.iter().all(|&l| area(l) > 0.0));
    }
}
