//! Stores facets, and compares the normal of each facet with its corners.

use std::ops::Range;

use glam::DVec3;

/// The facets of a file. `P` is the type of a position: binary files have numbers of 32 bits, and text files can have
/// numbers with more digits.
#[derive(Debug, Default)]
pub(super) struct Facets<P> {
    /// Three corners for each facet.
    pub(super) corners: Vec<P>,
    /// The number of facets with each [`Side`] (how the normal in the file relates to the computed normal).
    pub(super) sides: [usize; 3],
    /// The number of facets whose attribute bytes are not 0.
    pub(super) colored: usize,
    /// The name and the facets of each solid.
    pub(super) solids: Vec<(String, Range<usize>)>,
}

/// The difference between the normal of a facet and the normal that is computed from the corners of the facet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Same,
    /// The normals differ by more than a few degrees, but not by more than 90 degrees.
    Tilted,
    /// The normals differ by more than 90 degrees.
    Opposite,
}

/// Compares the normal of a facet with the normal that is computed from the corners of the facet. The two normals agree
/// if the angle between them is at most about 5.7 degrees (the sine of the angle is at most 1/10). They also agree if
/// the normal of the facet is zero or not finite, or if the area of the facet is zero. If the facet is so thin that its
/// area can be a result of rounding errors, the normals agree unless they are nearly opposite.
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
            Side::Opposite
        };
    }
    // The coordinates in the file have a precision of only 24 bits. Rounding errors can make the computed normal of a
    // sliver (a very thin triangle) wrong. Therefore, a sliver counts as a facet whose normals agree.
    let size = a.abs().max(b.abs()).max(c.abs()).max_element();
    let longest = (b - a).length_squared().max((c - a).length_squared());
    let rounding = 4.0 / f64::from(1 << 24) * size;
    if area.length_squared() <= 400.0 * rounding * rounding * longest {
        return Side::Same;
    }
    if along < 0.0 {
        Side::Opposite
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
            (DVec3::NEG_Z, Side::Opposite),
            (DVec3::new(1.0, 0.0, -0.1), Side::Opposite),
        ] {
            assert_eq!(compare(normal, corners), side, "{normal}");
        }
        assert_eq!(compare(DVec3::Z, [DVec3::ZERO; 3]), Side::Same);
    }

    #[test]
    fn the_rounding_error_of_a_sliver_is_ignored() {
        let far = DVec3::splat(100.0);
        let sliver = [far, far + 10.0 * DVec3::X, far + DVec3::new(5.0, 1e-5, 0.0)];
        assert_eq!(compare(DVec3::Y, sliver), Side::Same);
    }
}
