//! Oriented boxes around the triangles of the nodes, for surfaces with thin triangles.
//!
//! ```text
//!   +---------+      The bounding boxes of long, thin triangles that are not parallel to an axis overlap, so a point is
//!   |      //||      inside the boxes of many nodes. A box whose sides are parallel to the normal and to the longest
//!   |    // //|      sides of the triangles fits them tightly.
//!   |  // //  |
//!   |// //    |
//!   +---------+
//! ```

use mesh::DVec3;

use super::SurfaceIndex;

/// A node with more than this number of triangles gets no oriented box. In a larger node, the triangles usually have
/// different directions. An oriented box would then not be smaller than the axis-aligned box.
const MOST: usize = 512;

/// A triangle is thin if the length of its longest side is at least this number times the height over this side.
const THIN: f64 = 16.0;

/// A surface has oriented boxes if the fraction of thin triangles is at least 1 / n, where n is this number.
const SHARE: usize = 64;

/// A box around triangles. Its sides are parallel to `normal`, to `along` and to the cross product of these two
/// perpendicular unit vectors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Oriented {
    normal: DVec3,
    along: DVec3,
    /// The smallest and the largest coordinates of the triangles along the three directions.
    low: DVec3,
    high: DVec3,
}

impl Oriented {
    /// A box that contains all of space, for nodes without an oriented box.
    pub(super) const EVERYTHING: Self = Self {
        normal: DVec3::Z,
        along: DVec3::X,
        low: DVec3::NEG_INFINITY,
        high: DVec3::INFINITY,
    };

    /// Returns the oriented box of `n` triangles. `normal` is the sum of the area vectors of the triangles, or a
    /// multiple of this sum. `along` is the sum of the longest sides of the triangles, computed with [`sum`].
    pub(super) fn of<'a>(
        triangles: impl Iterator<Item = &'a [DVec3; 3]>,
        n: usize,
        normal: DVec3,
        along: DVec3,
    ) -> Self {
        let Some(along) = along.try_normalize().filter(|_| n <= MOST) else {
            return Self::EVERYTHING;
        };
        // The normal is made perpendicular to `along` twice, because the first result has large rounding errors if it
        // is short.
        let perpendicular = |v: DVec3| (v - along.dot(v) * along).try_normalize();
        let normal = normal.try_normalize().and_then(perpendicular);
        let normal = normal.and_then(perpendicular);
        let mut oriented = Self {
            normal: normal.unwrap_or_else(|| along.any_orthonormal_vector()),
            along,
            ..Self::EVERYTHING
        };
        let points = triangles.flatten().map(|&p| oriented.coordinates(p));
        let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        (oriented.low, oriented.high) =
            points.fold(empty, |(low, high), p| (low.min(p), high.max(p)));
        oriented
    }

    fn coordinates(&self, p: DVec3) -> DVec3 {
        let across = self.normal.cross(self.along);
        DVec3::new(self.normal.dot(p), self.along.dot(p), across.dot(p))
    }

    /// Returns a lower bound on the squared distance from `p` to the triangles in the box.
    fn distance_squared(&self, p: DVec3) -> f64 {
        let at = self.coordinates(p);
        let nearest = at.max(self.low).min(self.high);
        // This margin is subtracted so that rounding errors of the coordinates cannot make the bound too large.
        let rounding = 4e-15 * (p.abs().element_sum() + nearest.abs().element_sum());
        let gap = (at - nearest).abs() - DVec3::splat(rounding);
        gap.max(DVec3::ZERO).length_squared() * (1.0 - 1e-14)
    }
}

impl SurfaceIndex {
    /// Whether many triangles of the surface are thin, so that the nodes have oriented boxes.
    pub(super) fn has_thin_triangles(&self) -> bool {
        !self.oriented.is_empty()
    }

    /// Returns a lower bound on the squared distance from `p` to the triangles of a node. `squared` is the squared
    /// distance to the box of the node. The index must have oriented boxes.
    pub(super) fn oriented_distance_squared(&self, p: DVec3, i: usize, squared: f64) -> f64 {
        self.oriented[i].distance_squared(p).max(squared)
    }
}

/// Whether at least `n` / [`SHARE`] of the `n` triangles are thin.
pub(super) fn are_thin<'a>(n: usize, triangles: impl Iterator<Item = &'a [DVec3; 3]>) -> bool {
    let is_thin = |t: &&[DVec3; 3]| {
        let [a, b, c] = **t;
        longest_side(t).length_squared() >= THIN * (b - a).cross(c - a).length()
    };
    triangles.filter(is_thin).count() * SHARE >= n
}

/// Returns the longest side of a triangle as a vector. The vector has the direction in which the boundary of the
/// triangle runs along this side.
pub(super) fn longest_side([a, b, c]: &[DVec3; 3]) -> DVec3 {
    let sides = [b - a, c - b, a - c];
    let longer = |s: DVec3, t: DVec3| {
        if t.length_squared() > s.length_squared() {
            t
        } else {
            s
        }
    };
    sides.into_iter().fold(DVec3::ZERO, longer)
}

/// Adds two sums of longest sides. If the angle between the two vectors is above 90°, the second vector is reversed
/// first.
pub(super) fn sum(a: DVec3, b: DVec3) -> DVec3 {
    if a.dot(b) < 0.0 { a - b } else { a + b }
}
