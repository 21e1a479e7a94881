//! The camera that sees everything.

use glam::{DVec2, DVec3};

use super::{Projection, Side, Up, View};
use crate::PictureError;

/// Finds the camera that sees everything.
pub(super) struct Fit {
    axes: [DVec3; 3],
    tangent: Option<f64>,
    steady: bool,
    size: DVec2,
    /// Half of what is seen, without the margin, in units: at distance 1 with perspective, else in units of half
    /// the height of the picture.
    half: DVec2,
}

impl Fit {
    /// The camera of these parameters, for a picture of this size in pixels.
    pub(super) fn new(
        from: Side,
        up: Up,
        projection: Projection,
        margin: f64,
        steady: bool,
        size: DVec2,
    ) -> Result<Self, PictureError> {
        let [azimuth, elevation] = from.angles();
        if !(azimuth.is_finite() && elevation.is_finite()) {
            let found = format!("expected angles in degrees, found {azimuth} and {elevation}");
            return Err(PictureError::Camera(found));
        }
        if !(0.0..=0.45).contains(&margin) {
            let found = format!("expected a margin from 0 to 0.45, found {margin}");
            return Err(PictureError::Camera(found));
        }
        let tangent = projection.tangent()?;
        let free = 1.0 - 2.0 * margin;
        Ok(Self {
            axes: from.axes(up),
            tangent,
            steady,
            size,
            half: free * size / size.y * tangent.unwrap_or(1.0),
        })
    }

    /// With perspective, how fast the right and the upper border of what is seen come nearer to its middle with
    /// the distance: the largest of ±x and ±y is that of planes beside everything. A point is inside the right
    /// border if x - cx <= tx (cz - z), which is x + tx z <= cx + tx cz, and so on.
    fn slant(&self) -> DVec2 {
        self.tangent.map_or(DVec2::ZERO, |_| self.half)
    }

    /// The few points that decide where the camera is: the outermost ones to each side that counts.
    pub(super) fn decisive(&self, points: &impl Fn(&mut dyn FnMut(DVec3))) -> Vec<DVec3> {
        let ([x, y, z], slant) = (self.axes, self.slant());
        let sides = [
            x + slant.x * z,
            slant.x * z - x,
            y + slant.y * z,
            slant.y * z - y,
            z,
        ];
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let sides: Vec<DVec3> = (sides.into_iter())
            .chain(axes.into_iter().flat_map(|axis| [axis, -axis]))
            .collect();
        // Seen from the first point, so that places far from the origin lose no digits.
        let mut first = None;
        let mut outermost: Vec<(f64, DVec3)> = Vec::new();
        points(&mut |p| {
            let start = *first.get_or_insert(p);
            outermost.resize(sides.len(), (0.0, start));
            for (side, most) in sides.iter().zip(&mut outermost) {
                let far = (p - start).dot(*side);
                if far > most.0 {
                    *most = (far, p);
                }
            }
        });
        let mut decisive: Vec<DVec3> = outermost.into_iter().map(|(_, p)| p).collect();
        // From all sides: whatever is in the box is in the sphere around it.
        if self.steady && !decisive.is_empty() {
            let [min, max] = decisive[1..]
                .iter()
                .fold([decisive[0]; 2], |[min, max], p| [min.min(*p), max.max(*p)]);
            decisive.extend([min, max]);
        }
        decisive
    }

    pub(super) fn view(&self, points: &impl Fn(&mut dyn FnMut(DVec3))) -> View {
        let (center, radius) = sphere(points);
        // Everything below is seen from the center, so that places far from the origin lose no digits.
        let [x, y, z] = self.axes;
        let least = 1e-6 * radius;
        let (half, slant) = (self.half, self.slant());
        let (mut most, mut front) = ([f64::NEG_INFINITY; 4], f64::NEG_INFINITY);
        if self.steady {
            let grown = |t: f64| radius * (1.0 + t * t).sqrt();
            let [a, b] = [grown(slant.x), grown(slant.y)];
            (most, front) = ([a, a, b, b], radius);
        } else {
            points(&mut |p| {
                let p = DVec3::from([x, y, z].map(|axis| (p - center).dot(axis)));
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
        let aside = center + x * middle.x + y * middle.y;
        let away = (extent / half).max_element();
        let (eye, scale, near) = match self.tangent {
            // Not inside of what is seen from its edge.
            Some(tangent) => {
                let eye = aside + z * away.max(front + 0.05 * radius);
                (eye, tangent, 1e-3 * radius)
            }
            None if away > least => (aside, away, f64::NEG_INFINITY),
            None => (aside, radius.max(f64::MIN_POSITIVE), f64::NEG_INFINITY),
        };
        View {
            axes: self.axes,
            eye,
            scale: 0.5 * self.size.y / scale,
            is_perspective: self.tangent.is_some(),
            near,
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
