//! Maps the points of a curve into a panel.

use bezier::Curve;
use glam::DVec2;

/// Converts points in the plane of a curve to pixels of a figure. The scale is the same in both axes. In the plane of
/// the curve, y points upwards.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// The center of the bounding box of all points.
    center: DVec2,
    /// Half the length of the longer side of the bounding box, in units of the curve.
    half: f64,
    /// The same length as `half`, but in pixels.
    pixels: f64,
    /// The height of the drawing in pixels.
    height: f64,
    /// The position of the center in the figure.
    position: DVec2,
}

/// The maximum height of a drawing, as a fraction of its width.
const MAX_HEIGHT: f64 = 0.85;

/// The minimum height of a drawing, as a fraction of its width.
const MIN_HEIGHT: f64 = 0.2;

impl Frame {
    /// Creates the frame for a drawing with a width of `inner` pixels. The drawing shows a curve and possibly its
    /// earlier state.
    pub(super) fn new(curve: &Curve<DVec2>, before: Option<&Curve<DVec2>>, inner: f64) -> Self {
        let before = before.map_or(&[][..], Curve::points);
        let points = curve.points().iter().chain(before);
        let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (low, high) = points.fold(empty, |(low, high), &p| (low.min(p), high.max(p)));
        // The numbers are halved first, because the sum and the difference of large numbers can overflow.
        let center = low / 2.0 + high / 2.0;
        let half_box = high / 2.0 - low / 2.0;
        let half = half_box.max_element();
        let is_point = half <= 0.0;
        let proportions = if is_point {
            DVec2::ZERO
        } else {
            half_box / half
        };
        let pixels = (inner / 2.0 / proportions.x).min(inner * MAX_HEIGHT / 2.0 / proportions.y);
        let pixels = if pixels.is_finite() { pixels } else { 0.0 };
        Self {
            center,
            half,
            pixels,
            height: (2.0 * pixels * proportions.y).max(inner * MIN_HEIGHT),
            position: DVec2::ZERO,
        }
    }

    /// Returns the height of the drawing in pixels.
    pub(super) fn height(&self) -> f64 {
        self.height
    }

    /// Returns this frame, but with its center moved to the middle of an area of the figure. The area is given by two
    /// opposite corners.
    pub(super) fn placed(&self, [corner, end]: [DVec2; 2]) -> Self {
        Self {
            position: (corner + end) / 2.0,
            ..*self
        }
    }

    /// Maps a point to the figure.
    pub(super) fn map(&self, p: DVec2) -> DVec2 {
        if self.half == 0.0 {
            return self.position;
        }
        let q = (p - self.center) / self.half * self.pixels;
        self.position + DVec2::new(q.x, -q.y)
    }

    /// Maps a curve to the figure by mapping its control points. The result is exact, because the map is affine, and
    /// Bezier curves are affinely invariant.
    pub(super) fn curve(&self, curve: &Curve<DVec2>) -> Curve<DVec2> {
        let points = curve.points().iter().map(|&p| self.map(p)).collect();
        Curve::new(points).expect("the number of points is the same, and mapped points are finite")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(points: &[[f64; 2]]) -> (Frame, Vec<DVec2>) {
        let points: Vec<DVec2> = points.iter().map(|&p| p.into()).collect();
        let curve = Curve::new(points.clone()).unwrap();
        (Frame::new(&curve, None, 400.0), points)
    }

    #[test]
    fn curves_of_any_size_are_inside_the_panel() {
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
            assert!(frame.height() <= 400.0 * MAX_HEIGHT + 1e-9);
            for p in points {
                assert!(frame.map(p).abs().cmple(limit).all(), "{p}");
            }
        }
    }

    #[test]
    fn both_axes_have_the_same_scale_and_y_points_upwards() {
        let (frame, _) = frame(&[[10.0, 10.0], [14.0, 12.0]]);
        let [a, b, c] = [[10.0, 10.0], [12.0, 10.0], [10.0, 12.0]].map(|p| frame.map(p.into()));
        assert!((a.distance(b) - a.distance(c)).abs() < 1e-9);
        assert!(c.y < a.y && b.x > a.x && (b.x - a.x - 200.0).abs() < 1e-9);
    }
}
