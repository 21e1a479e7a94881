//! The camera that sees everything.

use glam::{DVec2, DVec3};

use super::View;

/// Finds the camera that sees everything.
pub(super) struct Fit {
    pub(super) axes: [DVec3; 3],
    pub(super) tangent: Option<f64>,
    pub(super) margin: f64,
    pub(super) steady: bool,
    pub(super) size: DVec2,
}

impl Fit {
    pub(super) fn view(&self, points: &impl Fn(&mut dyn FnMut(DVec3))) -> View {
        let (center, radius) = sphere(points);
        // Everything below is seen from the center, so that places far from the origin lose no digits.
        let [x, y, z] = self.axes;
        let turned = |p: DVec3| {
            DVec3::new(
                (p - center).dot(x),
                (p - center).dot(y),
                (p - center).dot(z),
            )
        };
        let free = 1.0 - 2.0 * self.margin;
        let least = 1e-6 * radius;
        // Half the picture in units: at distance 1 with perspective, else in units of half its height.
        let half = free * self.size / self.size.y * self.tangent.unwrap_or(1.0);
        // The largest of ±x and ±y, with perspective of planes beside everything: a point is inside the
        // right border if x - cx <= tx (cz - z), which is x + tx z <= cx + tx cz, and so on.
        let slant = if self.tangent.is_some() {
            half
        } else {
            DVec2::ZERO
        };
        let (mut most, mut front) = ([f64::NEG_INFINITY; 4], f64::NEG_INFINITY);
        if self.steady {
            let grown = |t: f64| radius * (1.0 + t * t).sqrt();
            let [a, b] = [grown(slant.x), grown(slant.y)];
            (most, front) = ([a, a, b, b], radius);
        } else {
            points(&mut |p| {
                let p = turned(p);
                let (tx, ty) = (slant.x * p.z, slant.y * p.z);
                let sides = [p.x + tx, tx - p.x, p.y + ty, ty - p.y];
                for (most, side) in most.iter_mut().zip(sides) {
                    *most = most.max(side);
                }
                front = front.max(p.z);
            });
        }
        if front == f64::NEG_INFINITY {
            (most, front) = ([0.5; 4], 0.5);
        }
        let [right, left, top, bottom] = most;
        let middle = DVec2::new(right - left, top - bottom) * 0.5;
        let extent = DVec2::new(right + left, top + bottom) * 0.5;
        let away = (extent / half).max_element();
        if self.tangent.is_none() {
            let away = if away > least {
                away
            } else {
                radius.max(f64::MIN_POSITIVE)
            };
            return View {
                axes: self.axes,
                eye: center + x * middle.x + y * middle.y,
                scale: 0.5 * self.size.y / away,
                is_perspective: false,
                near: 0.0,
                middle: 0.5 * self.size,
            };
        }
        // Not inside of what is seen from its edge.
        let away = away.max(front + 0.05 * radius);
        View {
            axes: self.axes,
            eye: center + x * middle.x + y * middle.y + z * away,
            scale: 0.5 * self.size.y / self.tangent.unwrap_or(1.0),
            is_perspective: true,
            near: 1e-3 * radius,
            middle: 0.5 * self.size,
        }
    }
}

/// A sphere around all points: its center is the middle of their box. Of radius 1 if all are one point, or
/// there are none.
pub(crate) fn sphere(points: &impl Fn(&mut dyn FnMut(DVec3))) -> (DVec3, f64) {
    let mut bounds: Option<[DVec3; 2]> = None;
    points(&mut |p| {
        let [min, max] = bounds.unwrap_or([p; 2]);
        bounds = Some([min.min(p), max.max(p)]);
    });
    let Some([min, max]) = bounds else {
        return (DVec3::ZERO, 1.0);
    };
    // Halved first: the sum of two finite numbers may be none.
    let center = 0.5 * min + 0.5 * max;
    let mut radius = 0.0;
    points(&mut |p| radius = p.distance_squared(center).max(radius));
    let radius = radius.sqrt();
    // One point has no size: it is seen as if the size of its coordinates were 1.
    let size = center.abs().max_element();
    if radius > 1e-12 * size && radius.is_finite() {
        (center, radius)
    } else {
        (center, 1.0_f64.max(1e-3 * size))
    }
}
