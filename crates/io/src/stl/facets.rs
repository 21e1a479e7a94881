//! Facets, and how their normals agree with their corners.

use std::ops::Range;

use glam::DVec3;

/// Facets as they stand in a file.
#[derive(Debug, Default)]
pub(super) struct Facets {
    /// Three for each facet.
    pub(super) corners: Vec<DVec3>,
    /// How many facet normals agree with their corners in each way.
    pub(super) sides: [usize; 3],
    /// How many facets have attribute bytes.
    pub(super) colored: usize,
    /// The names of solids, and which facets each has.
    pub(super) solids: Vec<(String, Range<usize>)>,
}

/// How a facet normal agrees with the corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Same,
    /// More than a few degrees away from the normal of the corners.
    Tilted,
    /// Nearer to the other side.
    Turned,
}

/// Compares a facet normal with that of its corners. They agree if the sine of the angle between them is
/// at most 1/10 (6 degrees), which is more than the rounding of a sliver explains; a normal that is zero or
/// not finite, or a facet without area, says nothing.
#[inline]
pub(super) fn compare(normal: DVec3, [a, b, c]: [DVec3; 3]) -> Side {
    let area = (b - a).cross(c - a);
    let scale = area.length_squared() * normal.length_squared();
    if !(scale > 0.0 && scale.is_finite()) {
        return Side::Same;
    }
    let along = area.dot(normal);
    if along * along >= 0.99 * scale {
        return if along > 0.0 {
            Side::Same
        } else {
            Side::Turned
        };
    }
    // A sliver: its corners are rounded to 24 bits, and the area may be nothing but that.
    let size = a.abs().max(b.abs()).max(c.abs()).max_element();
    let longest = (b - a).length_squared().max((c - a).length_squared());
    let rounding = 4.0 / f64::from(1 << 24) * size;
    if area.length_squared() <= 400.0 * rounding * rounding * longest {
        return Side::Same;
    }
    if along < 0.0 {
        Side::Turned
    } else {
        Side::Tilted
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_agree_within_a_few_degrees() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
        for (normal, side) in [
            (DVec3::Z, Side::Same),
            (DVec3::new(0.05, 0.0, 1.0), Side::Same),
            (DVec3::new(0.0, 0.0, 1e-9), Side::Same),
            (DVec3::ZERO, Side::Same),
            (DVec3::NAN, Side::Same),
            (DVec3::new(0.5, 0.0, 1.0), Side::Tilted),
            (DVec3::NEG_Z, Side::Turned),
            (DVec3::new(1.0, 0.0, -0.1), Side::Turned),
        ] {
            assert_eq!(compare(normal, corners), side, "{normal}");
        }
        assert_eq!(compare(DVec3::Z, [DVec3::ZERO; 3]), Side::Same);
    }

    #[test]
    fn the_rounding_of_a_sliver_does_not_tilt_it() {
        let far = DVec3::splat(100.0);
        let sliver = [far, far + 10.0 * DVec3::X, far + DVec3::new(5.0, 1e-5, 0.0)];
        assert_eq!(compare(DVec3::Y, sliver), Side::Same);
    }
}
