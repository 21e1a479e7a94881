//! The camera that shows the whole scene.

use glam::{DVec2, DVec3};

use super::{Projection, Side, Up, View};
use crate::PictureError;

/// Returns the outermost points: one for each of `directions`, and two for each coordinate axis (one at each end). The
/// list is empty if there are no points.
pub(super) fn outermost(
    directions: &[DVec3],
    points: &impl Fn(&mut dyn FnMut(DVec3)),
) -> Vec<DVec3> {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let directions: Vec<DVec3> = (directions.iter().copied())
        .chain(axes.into_iter().flat_map(|axis| [axis, -axis]))
        .collect();
    // Positions are relative to the first point, so that coordinates far from the origin lose no precision.
    let mut first = None;
    let mut outermost: Vec<(f64, DVec3)> = Vec::new();
    points(&mut |p| {
        let start = *first.get_or_insert(p);
        outermost.resize(directions.len(), (0.0, start));
        for (direction, farthest) in directions.iter().zip(&mut outermost) {
            let distance = (p - start).dot(*direction);
            if distance > farthest.0 {
                *farthest = (distance, p);
            }
        }
    });
    outermost.into_iter().map(|(_, p)| p).collect()
}

/// Finds the camera that shows the whole scene.
pub(super) struct Fit {
    axes: [DVec3; 3],
    tangent: Option<f64>,
    steady: bool,
    size: DVec2,
    /// Half the width and half the height of the picture without its margins. With perspective, the unit of both
    /// lengths is the size of a scene unit at distance 1 from the camera. Otherwise, the unit is half the height of the
    /// picture.
    half: DVec2,
}

impl Fit {
    /// Creates a fit from the parameters of the camera, for a picture of this size in pixels.
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
            let message = format!(
                "expected finite camera angles in degrees, found the azimuth {azimuth} and the elevation {elevation}"
            );
            return Err(PictureError::Camera(message));
        }
        if !(0.0..=0.45).contains(&margin) {
            let message = format!(
                "expected a margin from 0 to 0.45 (a fraction of the picture), found {margin}"
            );
            return Err(PictureError::Camera(message));
        }
        let tangent = projection.tangent()?;
        let inner = 1.0 - 2.0 * margin;
        Ok(Self {
            axes: from.axes(up),
            tangent,
            steady,
            size,
            half: inner * size / size.y * tangent.unwrap_or(1.0),
        })
    }

    /// Returns the slopes of the right and the upper clipping plane; zero without perspective.
    ///
    /// Let the camera be at (cx, cy, cz) and the slope of the right plane be tx. A point (x, y, z) is inside of the
    /// right plane if x - cx <= tx (cz - z). This is equivalent to x + tx z <= cx + tx cz. Therefore the point with the
    /// largest value of x + tx z determines the right plane. The left, upper and lower planes are analogous.
    fn slant(&self) -> DVec2 {
        self.tangent.map_or(DVec2::ZERO, |_| self.half)
    }

    /// Returns the points that determine the camera: the points that are outermost towards a clipping plane, towards
    /// the camera, or along a coordinate axis.
    pub(super) fn extreme_points(&self, points: &impl Fn(&mut dyn FnMut(DVec3))) -> Vec<DVec3> {
        let ([x, y, z], slant) = (self.axes, self.slant());
        let directions = [
            x + slant.x * z,
            slant.x * z - x,
            y + slant.y * z,
            slant.y * z - y,
            z,
        ];
        let mut extreme = outermost(&directions, points);
        // A steady camera shows the whole bounding sphere of the bounding box. Therefore two opposite corners of the
        // box are added to the points.
        if self.steady && !extreme.is_empty() {
            let [min, max] = extreme[1..]
                .iter()
                .fold([extreme[0]; 2], |[min, max], p| [min.min(*p), max.max(*p)]);
            extreme.extend([min, max]);
        }
        extreme
    }

    /// Returns the view that shows all points.
    pub(super) fn view(&self, points: &impl Fn(&mut dyn FnMut(DVec3))) -> View {
        let (center, radius) = sphere(points);
        // Positions are relative to the center, so that coordinates far from the origin lose no precision.
        let [x, y, z] = self.axes;
        let min_size = 1e-6 * radius;
        let (half, slant) = (self.half, self.slant());
        let (mut borders, mut front) = ([f64::NEG_INFINITY; 4], f64::NEG_INFINITY);
        if self.steady {
            // Returns the maximum of x + t z over all points (x, y, z) of the bounding sphere. Here t is the slope of a
            // clipping plane.
            let border = |t: f64| radius * (1.0 + t * t).sqrt();
            let [a, b] = [border(slant.x), border(slant.y)];
            (borders, front) = ([a, a, b, b], radius);
        } else {
            points(&mut |p| {
                let p = DVec3::from([x, y, z].map(|axis| (p - center).dot(axis)));
                let (tx, ty) = (slant.x * p.z, slant.y * p.z);
                let offsets = [p.x + tx, tx - p.x, p.y + ty, ty - p.y];
                for (border, offset) in borders.iter_mut().zip(offsets) {
                    *border = border.max(offset);
                }
                front = front.max(p.z);
            });
        }
        if front == f64::NEG_INFINITY {
            (borders, front) = ([0.5; 4], 0.5);
        }
        let [right, left, top, bottom] = borders;
        let middle = DVec2::new(right - left, top - bottom) * 0.5;
        let extent = DVec2::new(right + left, top + bottom) * 0.5;
        let target = center + x * middle.x + y * middle.y;
        let distance = (extent / half).max_element();
        let (eye, scale, near) = match self.tangent {
            // A flat scene that is seen edge-on has almost no extent. Even then, the camera must be in front of the
            // scene.
            Some(tangent) => {
                let eye = target + z * distance.max(front + 0.05 * radius);
                (eye, tangent, 1e-3 * radius)
            }
            None if distance > min_size => (target, distance, f64::NEG_INFINITY),
            None => (target, radius.max(f64::MIN_POSITIVE), f64::NEG_INFINITY),
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

/// Returns the center and the radius of a sphere that contains all points. The center of the sphere is the center of
/// the bounding box of the points. If there are no points, the radius is 1. If all points are nearly equal, the radius
/// is the larger of two numbers: 1, and 0.001 times the largest absolute coordinate of the center.
pub(crate) fn sphere(points: &impl Fn(&mut dyn FnMut(DVec3))) -> (DVec3, f64) {
    let mut bounds: Option<[DVec3; 2]> = None;
    points(&mut |p| {
        let [min, max] = bounds.unwrap_or([p; 2]);
        bounds = Some([min.min(p), max.max(p)]);
    });
    let Some([min, max]) = bounds else {
        return (DVec3::ZERO, 1.0);
    };
    // The numbers are halved before they are added, because the sum of two finite numbers can overflow.
    let center = 0.5 * min + 0.5 * max;
    let mut radius = 0.0;
    points(&mut |p| radius = p.distance_squared(center).max(radius));
    let radius = radius.sqrt();
    let size = center.abs().max_element();
    if radius > 1e-12 * size && radius.is_finite() {
        (center, radius)
    } else {
        (center, 1.0_f64.max(1e-3 * size))
    }
}
