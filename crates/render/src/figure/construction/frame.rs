//! How the points of a curve come into a panel.

use bezier::Curve;
use glam::DVec2;

use super::Panel;

/// The map from the plane of a curve to the pixels of a figure: the same scale in both directions, the second axis
/// up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// The middle of the box of all points.
    center: DVec2,
    /// Half of its longer side, in units of the curve.
    half: f64,
    /// The pixels of `half`.
    pixels: f64,
    /// The pixels of the box from top to bottom, or more where it is flat.
    height: f64,
    /// Where the middle stands in the figure.
    place: DVec2,
}

/// The height of the highest drawing, as a share of its width.
const TALLEST: f64 = 0.85;

/// The height of the flattest drawing, as a share of its width.
const FLATTEST: f64 = 0.2;

impl Frame {
    /// The frame of a panel whose drawing is `inner` pixels wide.
    pub(super) fn of(panel: &Panel, inner: f64) -> Self {
        let before = panel.before.map_or(&[][..], Curve::points);
        let points = panel.curve.points().iter().chain(before);
        let nothing = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (low, high) = points.fold(nothing, |(low, high), &p| (low.min(p), high.max(p)));
        // Halves first: the sum and the difference of large numbers may be none.
        let center = low / 2.0 + high / 2.0;
        let half_box = high / 2.0 - low / 2.0;
        let half = half_box.max_element();
        let is_point = half <= 0.0;
        let shares = if is_point {
            DVec2::ZERO
        } else {
            half_box / half
        };
        let pixels = (inner / 2.0 / shares.x).min(inner * TALLEST / 2.0 / shares.y);
        let pixels = if pixels.is_finite() { pixels } else { 0.0 };
        Self {
            center,
            half,
            pixels,
            height: (2.0 * pixels * shares.y).max(inner * FLATTEST),
            place: DVec2::ZERO,
        }
    }

    /// Pixels from top to bottom.
    pub(super) fn height(&self) -> f64 {
        self.height
    }

    /// The same in the middle of a part of the figure.
    pub(super) fn placed(&self, [corner, end]: [DVec2; 2]) -> Self {
        Self {
            place: (corner + end) / 2.0,
            ..*self
        }
    }

    /// The place of a point in the figure.
    pub(super) fn map(&self, p: DVec2) -> DVec2 {
        if self.half == 0.0 {
            return self.place;
        }
        let q = (p - self.center) / self.half * self.pixels;
        self.place + DVec2::new(q.x, -q.y)
    }

    /// The curve in the figure: the map is affine, so that it is the curve of the mapped control points.
    pub(super) fn curve(&self, curve: &Curve<DVec2>) -> Curve<DVec2> {
        let points = curve.points().iter().map(|&p| self.map(p)).collect();
        Curve::new(points).expect("as many points as before, and places in a figure are finite")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(points: &[[f64; 2]]) -> (Frame, Vec<DVec2>) {
        let points: Vec<DVec2> = points.iter().map(|&p| p.into()).collect();
        let curve = Curve::new(points.clone()).unwrap();
        let panel = Panel {
            curve: &curve,
            before: None,
            t: None,
            title: None,
        };
        (Frame::of(&panel, 400.0), points)
    }

    #[test]
    fn every_point_is_inside_however_large_or_small_the_curve_is() {
        let largest = f64::MAX;
        for points in [
            &[[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]][..],
            &[[1e300, -1e300], [-1e300, 1e300], [0.0, 5.0]],
            &[[largest, largest], [-largest, -largest]],
            &[[5e-324, 0.0], [0.0, 0.0]],
            &[[1e9, 1e9], [1e9 + 1e-6, 1e9]],
            &[[0.0, 0.0], [0.0, 7.0]],
            &[[3.0, 4.0]],
            &[[3.0, 4.0], [3.0, 4.0], [3.0, 4.0]],
        ] {
            let (frame, points) = frame(points);
            let limit = DVec2::new(200.0, frame.height() / 2.0) + DVec2::splat(1e-6);
            assert!(frame.height() <= 400.0 * TALLEST + 1e-9);
            for p in points {
                assert!(frame.map(p).abs().cmple(limit).all(), "{p}");
            }
        }
    }

    #[test]
    fn both_directions_have_the_same_scale_and_up_is_up() {
        let (frame, _) = frame(&[[10.0, 10.0], [14.0, 12.0]]);
        let [a, b, c] = [[10.0, 10.0], [12.0, 10.0], [10.0, 12.0]].map(|p| frame.map(p.into()));
        assert!((a.distance(b) - a.distance(c)).abs() < 1e-9);
        assert!(c.y < a.y && b.x > a.x && (b.x - a.x - 200.0).abs() < 1e-9);
    }
}
