//! Sides of a patch that are one point, and how many elements they take from a tessellation.
//!
//! ```text
//!     corner 3 --- side 2 --- corner 2        v
//!        |                       |            ^
//!      side 3                  side 1         |
//!        |                       |            +--> u
//!     corner 0 --- side 0 --- corner 1
//! ```
//!
//! A side is collapsed if its boundary curve, sampled at 0, 1/m, ... 1 with m the smaller of 3 and
//! the number of segments, stays within 1e-12 of the patch's extent of its first point in every
//! coordinate. (A cubic that has the same value at four parameters is constant: with
//! three segments or more this says that the side is one point. With fewer it also finds a side
//! that runs in a loop and would be sampled only where it returns.)

use glam::DVec3;

use crate::patch::{cubic, size};
use crate::weights::Weights;
use crate::{Counts, Faces, Patch};

/// The part of the extent of a patch below which points coincide.
const TOLERANCE: f64 = 1e-12;

/// Which sides of a patch are one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sides {
    /// In the order of the picture.
    pub(crate) collapsed: [bool; 4],
    /// Whether all rows or all columns coincide: the patch is a curve or a point.
    flat: bool,
}

impl Sides {
    /// Looks at the sides of `patch` when cut into `segments`, which is not 0.
    pub(crate) fn of(patch: &Patch, segments: u32) -> Self {
        let p = patch.points();
        let all = p.as_flattened();
        let low = all.iter().copied().reduce(DVec3::min).unwrap_or_default();
        let high = all.iter().copied().reduce(DVec3::max).unwrap_or_default();
        let tolerance = TOLERANCE * size(high - low);

        let column = |c: usize| [p[0][c], p[1][c], p[2][c], p[3][c]];
        let is_point = |side: [DVec3; 4]| {
            // Differences first: a patch far from the origin loses nothing to rounding.
            let side = side.map(|q| q - side[0]);
            let m = segments.min(3);
            (1..=m).all(|i| size(cubic(side, Weights::ratio(i, m))) <= tolerance)
        };
        let reach = patch.reach();
        Self {
            collapsed: [p[0], column(3), p[3], column(0)].map(is_point),
            flat: reach.x <= tolerance || reach.y <= tolerance,
        }
    }

    /// For every collapsed side the first side of the chain of collapsed sides it belongs to:
    /// the points of a chain are one point. Its own number for the other sides.
    pub(crate) fn chains(self) -> [usize; 4] {
        let mut chain = [0, 1, 2, 3];
        for a in 0..4 {
            let b = (a + 1) % 4;
            if self.collapsed[a] && self.collapsed[b] {
                let (keep, drop) = (chain[a].min(chain[b]), chain[a].max(chain[b]));
                chain
                    .iter_mut()
                    .filter(|c| **c == drop)
                    .for_each(|c| *c = keep);
            }
        }
        chain
    }

    /// What a patch with these sides gives, exactly: nothing at all if it gives no face.
    ///
    /// Numbers beyond 64 bits stay at the largest that fits.
    pub(crate) fn counts(self, segments: u32, faces: Faces) -> Counts {
        let n = u64::from(segments);
        let square = |x: u64| x.saturating_mul(x);
        let collapsed = self.collapsed.iter().filter(|&&side| side).count() as u64;
        let corners = (0..4)
            .filter(|&a| self.collapsed[a] && self.collapsed[(a + 1) % 4])
            .count();
        let corners = corners as u64;

        // A cell with one collapsed side is a triangle, one with more has no area.
        let (lost, triangles) = match (n, collapsed) {
            (1, 0 | 1) => (0, collapsed),
            (1, _) => (1, 0),
            _ => (corners, n * collapsed - 2 * corners),
        };
        let cells = if self.flat { 0 } else { square(n) - lost };
        if cells == 0 || (n == 2 && collapsed == 4) {
            return Counts::default();
        }
        // A chain of k sides has k n + 1 points, all four sides have 4 n: each becomes one.
        let merged = n * collapsed - u64::from(collapsed == 4);
        let vertices = square(n.saturating_add(1)) - merged;
        match faces {
            Faces::Quads => Counts {
                vertices,
                faces: cells,
                corners: cells.saturating_mul(4) - triangles,
            },
            Faces::Triangles => {
                let faces = cells.saturating_mul(2) - triangles;
                Counts {
                    vertices,
                    faces,
                    corners: faces.saturating_mul(3),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{Lcg, octant};

    #[test]
    fn only_the_pole_of_an_octant_is_collapsed() {
        for n in [1, 2, 3, 100] {
            assert_eq!(
                Sides::of(&octant(), n).collapsed,
                [false, false, true, false]
            );
        }
        assert_eq!(
            Sides::of(&octant().transposed(), 8).collapsed,
            [false, true, false, false]
        );
    }

    #[test]
    fn a_loop_is_collapsed_only_where_its_samples_coincide() {
        let mut points = *Lcg::new(31).patch().points();
        points[0][3] = points[0][0];
        assert!(Sides::of(&Patch::new(points).unwrap(), 1).collapsed[0]);
        assert!(!Sides::of(&Patch::new(points).unwrap(), 2).collapsed[0]);
        // A figure eight passes its end in the middle.
        points[0][2] = points[0][0] * 2.0 - points[0][1];
        assert!(Sides::of(&Patch::new(points).unwrap(), 2).collapsed[0]);
        assert!(!Sides::of(&Patch::new(points).unwrap(), 3).collapsed[0]);
    }

    #[test]
    fn a_pole_far_from_the_origin_or_within_rounding_is_collapsed() {
        let mut random = Lcg::new(32);
        let far = octant()
            .points()
            .map(|row| row.map(|p| p + DVec3::splat(1e9)));
        assert!(Sides::of(&Patch::new(far).unwrap(), 3).collapsed[2]);

        let mut points = *octant().points();
        points[3]
            .iter_mut()
            .for_each(|p| *p += random.point() * 1e-13);
        assert!(Sides::of(&Patch::new(points).unwrap(), 3).collapsed[2]);
        points[3][1] += DVec3::X * 1e-11;
        assert!(!Sides::of(&Patch::new(points).unwrap(), 3).collapsed[2]);
    }

    #[test]
    fn neighboring_collapsed_sides_are_one_chain() {
        let chains = |collapsed| {
            Sides {
                collapsed,
                flat: false,
            }
            .chains()
        };
        assert_eq!(chains([true, false, true, false]), [0, 1, 2, 3]);
        assert_eq!(chains([true, false, false, true]), [0, 1, 2, 0]);
        assert_eq!(chains([false, true, true, true]), [0, 1, 1, 1]);
        assert_eq!(chains([true, false, true, true]), [0, 1, 0, 0]);
        assert_eq!(chains([true; 4]), [0; 4]);
    }
}
