//! Collapsed sides of a patch, and the number of elements of its tessellation.
//!
//! ```text
//!     corner 3 --- side 2 --- corner 2        v
//!        |                       |            ^
//!      side 3                  side 1         |
//!        |                       |            +--> u
//!     corner 0 --- side 0 --- corner 1
//! ```
//!
//! To test whether a side of a patch is collapsed, the boundary curve of the side is sampled at i/m for i from 0 to m.
//! The number m is the number of segments or 3, whichever is smaller. The extent of a patch is the longest side of the
//! bounding box of its control points. A side is collapsed if the coordinates of every sample differ from the
//! coordinates of the first sample by at most 1e-12 times the extent of the patch. With three or more segments, a
//! collapsed side is one point, because a cubic that has the same value at four parameters is constant. With one or two
//! segments, a collapsed side can also be a loop whose samples coincide.

use glam::DVec3;

use crate::normal::size;
use crate::patch::cubic;
use crate::weights::Weights;
use crate::{Counts, Faces, Patch};

/// Two points coincide if they differ in each coordinate by at most this fraction of the extent of the patch. (The
/// extent is the longest side of the bounding box of the control points.)
const TOLERANCE: f64 = 1e-12;

/// The collapsed sides of a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sides {
    /// Whether each side is collapsed. The sides are numbered as in the picture at the top of the file.
    pub(crate) collapsed: [bool; 4],
    /// Whether all rows of control points are the same within the tolerance, or all columns are. In both cases, the
    /// patch is a curve or a point.
    has_no_area: bool,
}

impl Sides {
    /// Finds the collapsed sides of `patch` for a tessellation into `segments` by `segments` cells. `segments` must not
    /// be 0.
    pub(crate) fn of(patch: &Patch, segments: u32) -> Self {
        let p = patch.points();
        let all = p.as_flattened();
        let low = all.iter().copied().reduce(DVec3::min).unwrap_or_default();
        let high = all.iter().copied().reduce(DVec3::max).unwrap_or_default();
        let tolerance = TOLERANCE * size(high - low);

        let column = |c: usize| [p[0][c], p[1][c], p[2][c], p[3][c]];
        let is_collapsed = |side: [DVec3; 4]| {
            // The first point of the side is subtracted before the samples are computed, so that a patch far from the
            // origin does not lose precision.
            let side = side.map(|q| q - side[0]);
            let m = segments.min(3);
            (1..=m).all(|i| size(cubic(side, Weights::ratio(i, m))) <= tolerance)
        };
        let max_steps = patch.max_steps();
        Self {
            collapsed: [p[0], column(3), p[3], column(0)].map(is_collapsed),
            has_no_area: max_steps.x <= tolerance || max_steps.y <= tolerance,
        }
    }

    /// Returns, for each collapsed side, the side with the lowest index in its chain. A chain is a set of
    /// adjacent collapsed sides, which together become one vertex. For a side that is not collapsed, returns
    /// the side itself.
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

    /// Returns exactly how many elements the tessellation of a patch with these collapsed sides has. All counts are
    /// zero if the tessellation has no face.
    ///
    /// A count that exceeds 64 bits is replaced by the largest 64-bit number.
    pub(crate) fn counts(self, segments: u32, faces: Faces) -> Counts {
        let n = u64::from(segments);
        let square = |x: u64| x.saturating_mul(x);
        let collapsed = self.collapsed.iter().filter(|&&side| side).count() as u64;
        // The number of patch corners at which two collapsed sides meet.
        let corners = (0..4)
            .filter(|&a| self.collapsed[a] && self.collapsed[(a + 1) % 4])
            .count();
        let corners = corners as u64;

        // A cell with one collapsed side becomes a triangle; a cell with more collapsed sides has zero area.
        let (n_lost, triangles) = match (n, collapsed) {
            (1, 0 | 1) => (0, collapsed),
            (1, _) => (1, 0),
            _ => (corners, n * collapsed - 2 * corners),
        };
        let cells = if self.has_no_area {
            0
        } else {
            square(n) - n_lost
        };
        if cells == 0 || (n == 2 && collapsed == 4) {
            return Counts::default();
        }
        // All samples on a chain of collapsed sides become one vertex. With n segments per side, a chain of k sides has
        // k n + 1 samples. If the chain has all four sides, it is closed and has 4 n samples.
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
    fn a_loop_is_collapsed_only_if_its_samples_coincide() {
        let mut points = *Lcg::new(31).patch().points();
        points[0][3] = points[0][0];
        assert!(Sides::of(&Patch::new(points).unwrap(), 1).collapsed[0]);
        assert!(!Sides::of(&Patch::new(points).unwrap(), 2).collapsed[0]);
        // The side becomes a figure eight, whose start, middle (t = 0.5) and end are the same point. Therefore, with
        // two segments, all samples of the side coincide.
        points[0][2] = points[0][0] * 2.0 - points[0][1];
        assert!(Sides::of(&Patch::new(points).unwrap(), 2).collapsed[0]);
        assert!(!Sides::of(&Patch::new(points).unwrap(), 3).collapsed[0]);
    }

    #[test]
    fn a_pole_far_from_the_origin_or_with_rounding_errors_is_collapsed() {
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
    fn adjacent_collapsed_sides_are_one_chain() {
        let chains = |collapsed| {
            Sides {
                collapsed,
                has_no_area: false,
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
