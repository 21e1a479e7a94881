//! Cameras: where a picture is seen from. [`Camera`] is what a recipe says, [`View`] what the rasteriser
//! needs.

use glam::{DVec2, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::PictureError;

/// Where a picture is seen from.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Camera {
    /// From a side, at the distance from which everything is seen.
    Fit {
        /// The side.
        #[serde(default)]
        from: Side,
        /// The axis that points upwards.
        #[serde(default)]
        up: Up,
        /// How distance makes things smaller.
        #[serde(default)]
        projection: Projection,
        /// What stays free at each border, as a fraction of the picture.
        #[serde(default = "margin")]
        #[schemars(range(min = 0.0, max = 0.45))]
        margin: f64,
        /// Whether the same scale is taken from all sides, as a turntable needs it.
        #[serde(default)]
        steady: bool,
    },
    /// From one point to another.
    LookAt {
        /// Where the camera is: `(x, y, z)`, in scene units.
        from: [f64; 3],
        /// The point in the middle of the picture: `(x, y, z)`, in scene units.
        to: [f64; 3],
        /// The axis that points upwards.
        #[serde(default)]
        up: Up,
        /// How distance makes things smaller. Without perspective the picture shows as much as with one of 30
        /// degrees at the distance of `to`.
        #[serde(default)]
        projection: Projection,
    },
}

impl Default for Camera {
    fn default() -> Self {
        Self::Fit {
            from: Side::default(),
            up: Up::default(),
            projection: Projection::default(),
            margin: margin(),
            steady: false,
        }
    }
}

impl Camera {
    /// The camera after a turn to the right, around what it looks at, about the axis that points upwards. A camera
    /// that fits is then [steady](Self::Fit::steady).
    #[must_use]
    pub fn turned(self, degrees: f64) -> Self {
        match self {
            Self::Fit {
                from,
                up,
                projection,
                margin,
                ..
            } => {
                let [azimuth, elevation] = from.angles();
                Self::Fit {
                    from: Side::Angles {
                        azimuth: azimuth + degrees,
                        elevation,
                    },
                    up,
                    projection,
                    margin,
                    steady: true,
                }
            }
            Self::LookAt {
                from,
                to,
                up,
                projection,
            } => {
                let (sin, cos) = mesh::sin_cos_degrees(degrees);
                let [right, upwards, front] = up.axes();
                let d = DVec3::from(from) - DVec3::from(to);
                let [x, y, z] = [right, upwards, front].map(|axis| d.dot(axis));
                let d = right * (x * cos + z * sin) + upwards * y + front * (z * cos - x * sin);
                Self::LookAt {
                    from: (DVec3::from(to) + d).into(),
                    to,
                    up,
                    projection,
                }
            }
        }
    }

    /// Whether its numbers are in their ranges, whatever it is to see.
    ///
    /// # Errors
    ///
    /// As [`View::new`].
    pub fn check(&self) -> Result<(), PictureError> {
        View::new(self, &|_| {}, [1, 1]).map(drop)
    }
}

fn margin() -> f64 {
    0.05
}

/// A side that things are seen from. With y upwards the front is where z is large, as in glTF; with z upwards
/// where y is small, as on a map.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Side {
    /// From before.
    Front,
    /// From behind.
    Back,
    /// From its left, which is where x is small.
    Left,
    /// From its right, which is where x is large.
    Right,
    /// From above; the front is at the bottom of the picture.
    Top,
    /// From below; the front is at the top of the picture.
    Bottom,
    /// From before, above and right, so that the three axes are equally long.
    Isometric,
    /// From before, and somewhat from above and from the right.
    #[default]
    ThreeQuarter,
    /// From any direction.
    Angles {
        /// Degrees from the front towards the right.
        azimuth: f64,
        /// Degrees upwards.
        elevation: f64,
    },
}

/// The axis that points upwards.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Up {
    /// The y axis, as in glTF.
    #[default]
    Y,
    /// The z axis, as in most programs for construction.
    Z,
}

/// How distance makes things smaller.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Projection {
    /// Not at all.
    Orthographic,
    /// As in a photograph.
    Perspective {
        /// The angle between the lower and the upper border of the picture, in degrees.
        #[schemars(range(min = 1.0, max = 150.0))]
        angle: f64,
    },
}

impl Default for Projection {
    fn default() -> Self {
        Self::Perspective { angle: USUAL_ANGLE }
    }
}

/// Degrees. Like a lens of 80 mm on a camera for 35 mm film, as for portraits.
const USUAL_ANGLE: f64 = 25.0;
/// Degrees: what `LookAt` shows without perspective.
const FLAT_ANGLE: f64 = 30.0;

impl Up {
    /// The directions to the right, upwards and to the front.
    fn axes(self) -> [DVec3; 3] {
        match self {
            Self::Y => [DVec3::X, DVec3::Y, DVec3::Z],
            Self::Z => [DVec3::X, DVec3::Z, DVec3::NEG_Y],
        }
    }
}

impl Side {
    /// Azimuth and elevation in degrees.
    fn angles(self) -> [f64; 2] {
        match self {
            Self::Front => [0.0, 0.0],
            Self::Back => [180.0, 0.0],
            Self::Left => [-90.0, 0.0],
            Self::Right => [90.0, 0.0],
            Self::Top => [0.0, 90.0],
            Self::Bottom => [0.0, -90.0],
            // The arc tangent of 1 / √2.
            Self::Isometric => [45.0, 35.264_389_682_754_654],
            Self::ThreeQuarter => [30.0, 22.0],
            Self::Angles { azimuth, elevation } => [azimuth, elevation],
        }
    }

    /// The directions of the picture: to its right, upwards, and towards the camera.
    fn axes(self, up: Up) -> [DVec3; 3] {
        let [right, up, front] = up.axes();
        let [azimuth, elevation] = self.angles();
        let (sin, cos) = mesh::sin_cos_degrees(azimuth);
        let (x, forth) = (right * cos - front * sin, front * cos + right * sin);
        let (sin, cos) = mesh::sin_cos_degrees(elevation);
        [x, up * cos - forth * sin, forth * cos + up * sin]
    }
}

/// A camera that knows its picture: takes points of the scene to pixels.
///
/// Pixels are counted from the upper left corner of the picture, to the right and downwards.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// Directions to the right, upwards, and towards the camera. Unit vectors at right angles.
    axes: [DVec3; 3],
    /// With perspective the camera, else a point in the middle of the picture.
    eye: DVec3,
    /// Pixels for a unit: at distance 1 with perspective, else everywhere.
    scale: f64,
    is_perspective: bool,
    /// What is nearer than this is not seen. Only with perspective.
    near: f64,
    /// The middle of the picture, in pixels.
    middle: DVec2,
}

/// A point seen by a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Pixels from the left and from the top.
    pub at: DVec2,
    /// Grows with distance, and is linear over the picture for points of a plane.
    pub depth: f64,
}

impl View {
    /// The view of a camera on these points, in a picture of this size.
    ///
    /// # Errors
    ///
    /// [`PictureError::Camera`] if a number of the camera is out of its range, or it looks nowhere.
    pub fn new(
        camera: &Camera,
        points: &impl Fn(&mut dyn FnMut(DVec3)),
        [width, height]: [u32; 2],
    ) -> Result<Self, PictureError> {
        let size = DVec2::new(f64::from(width), f64::from(height));
        match *camera {
            Camera::Fit {
                from,
                up,
                projection,
                margin,
                steady,
            } => {
                let [azimuth, elevation] = from.angles();
                if !(azimuth.is_finite() && elevation.is_finite()) {
                    let found =
                        format!("expected angles in degrees, found {azimuth} and {elevation}");
                    return Err(PictureError::Camera(found));
                }
                if !(0.0..=0.45).contains(&margin) {
                    let found = format!("expected a margin from 0 to 0.45, found {margin}");
                    return Err(PictureError::Camera(found));
                }
                let fit = Fit {
                    axes: from.axes(up),
                    tangent: projection.tangent()?,
                    margin,
                    steady,
                    size,
                };
                Ok(fit.view(points))
            }
            Camera::LookAt {
                from,
                to,
                up,
                projection,
            } => Self::look_at(from.into(), to.into(), up, projection, size),
        }
    }

    fn look_at(
        from: DVec3,
        to: DVec3,
        up: Up,
        projection: Projection,
        size: DVec2,
    ) -> Result<Self, PictureError> {
        let towards = (from - to).normalize_or_zero();
        if towards == DVec3::ZERO || !(from - to).is_finite() {
            let found =
                "expected a camera that looks from one point to another, found no direction";
            return Err(PictureError::Camera(found.to_owned()));
        }
        let [_, upwards, front] = up.axes();
        // Straight from above the front is at the bottom of the picture.
        let mut right = upwards.cross(towards);
        if right.length() < 1e-9 {
            right = (front * -towards.dot(upwards).signum()).cross(towards);
        }
        let right = right.normalize();
        let axes = [right, towards.cross(right), towards];
        let tangent = projection.tangent()?;
        let distance = from.distance(to);
        let flat = tan_degrees(0.5 * FLAT_ANGLE) * distance;
        Ok(Self {
            axes,
            eye: from,
            scale: 0.5 * size.y / tangent.unwrap_or(flat),
            is_perspective: tangent.is_some(),
            near: 1e-3 * distance,
            middle: 0.5 * size,
        })
    }

    /// Where a point is seen; `None` if it is behind the camera.
    pub fn see(&self, p: DVec3) -> Option<Seen> {
        let v = self.turned(p);
        (!self.is_perspective || v.z >= self.near).then(|| self.project(v))
    }

    /// Right, upwards and distance from the camera.
    pub(crate) fn turned(&self, p: DVec3) -> DVec3 {
        let [x, y, z] = self.axes;
        let p = p - self.eye;
        DVec3::new(p.dot(x), p.dot(y), -p.dot(z))
    }

    /// The nearest distance that is seen; everything without perspective.
    pub(crate) fn near(&self) -> f64 {
        if self.is_perspective {
            self.near
        } else {
            f64::NEG_INFINITY
        }
    }

    /// Whether something (as [`turned`](Self::turned) gives it) is on the inner side of a border: not
    /// negative inside, and linear in `v`. Border 0 is what is too near; the others are `far` pixels from
    /// the upper left corner, to each side.
    pub(crate) fn inside(&self, border: usize, far: f64, v: DVec3) -> f64 {
        let distance = if self.is_perspective { v.z } else { 1.0 };
        let (x, y) = (self.scale * v.x, -self.scale * v.y);
        match border {
            0 if self.is_perspective => v.z - self.near,
            0 => 1.0,
            1 => x + (far + self.middle.x) * distance,
            2 => (far - self.middle.x) * distance - x,
            3 => y + (far + self.middle.y) * distance,
            _ => (far - self.middle.y) * distance - y,
        }
    }

    /// Where something is seen that is not behind the camera.
    pub(crate) fn project(&self, v: DVec3) -> Seen {
        let (shrink, depth) = if self.is_perspective {
            (self.scale / v.z, -1.0 / v.z)
        } else {
            (self.scale, v.z)
        };
        Seen {
            at: self.middle + DVec2::new(v.x * shrink, -v.y * shrink),
            depth,
        }
    }

    /// Origin and direction of the ray through a place of the picture, in scene units. The direction has
    /// length 1 along the axis of the camera.
    pub(crate) fn ray(&self, at: DVec2) -> (DVec3, DVec3) {
        let [x, y, z] = self.axes;
        let d = (at - self.middle) / self.scale;
        let aside = x * d.x - y * d.y;
        if self.is_perspective {
            (self.eye, aside - z)
        } else {
            (self.eye + aside, -z)
        }
    }

    /// The depth, in the sense of [`Seen::depth`], of the plane through `p` with the normal `n` at a place of
    /// the picture; `None` if the plane is seen from its edge.
    pub(crate) fn plane_depth(&self, p: DVec3, n: DVec3, at: DVec2) -> Option<f64> {
        let (origin, direction) = self.ray(at);
        let along = n.dot(direction);
        let distance = n.dot(p - origin);
        let depth = if self.is_perspective {
            -along / distance
        } else {
            distance / along
        };
        depth.is_finite().then_some(depth)
    }

    /// What a pixel is at this depth, in scene units.
    pub(crate) fn pixel(&self, depth: f64) -> f64 {
        if self.is_perspective {
            -1.0 / (depth * self.scale)
        } else {
            1.0 / self.scale
        }
    }

    /// How much depth changes over a length in scene units, away from the camera.
    pub(crate) fn depth_of(&self, length: f64, depth: f64) -> f64 {
        if self.is_perspective {
            length * depth * depth
        } else {
            length
        }
    }

    /// Directions to the right, upwards, and towards the camera.
    pub fn axes(&self) -> [DVec3; 3] {
        self.axes
    }
}

impl Projection {
    /// The tangent of half the angle; `None` without perspective.
    fn tangent(self) -> Result<Option<f64>, PictureError> {
        match self {
            Self::Orthographic => Ok(None),
            Self::Perspective { angle } if (1.0..=150.0).contains(&angle) => {
                Ok(Some(tan_degrees(0.5 * angle)))
            }
            Self::Perspective { angle } => {
                let found = format!("expected an angle of 1 to 150 degrees, found {angle}");
                Err(PictureError::Camera(found))
            }
        }
    }
}

fn tan_degrees(angle: f64) -> f64 {
    libm::tan(angle.to_radians())
}

/// Finds the camera that sees everything.
struct Fit {
    axes: [DVec3; 3],
    tangent: Option<f64>,
    margin: f64,
    steady: bool,
    size: DVec2,
}

impl Fit {
    fn view(&self, points: &impl Fn(&mut dyn FnMut(DVec3))) -> View {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The corners of a box.
    fn corners(each: &mut dyn FnMut(DVec3)) {
        for i in 0..8 {
            let side = |bit: u8, low: f64, high: f64| if i >> bit & 1 == 0 { low } else { high };
            each(DVec3::new(
                side(0, -1.0, 3.0),
                side(1, 0.0, 1.0),
                side(2, 7.0, 9.0),
            ));
        }
    }

    fn fit(from: Side, up: Up, projection: Projection, margin: f64, steady: bool) -> Camera {
        Camera::Fit {
            from,
            up,
            projection,
            margin,
            steady,
        }
    }

    const PROJECTIONS: [Projection; 3] = [
        Projection::Orthographic,
        Projection::Perspective { angle: 25.0 },
        Projection::Perspective { angle: 90.0 },
    ];

    #[test]
    fn a_fitted_camera_sees_everything_up_to_its_margin() {
        let size = [200, 100];
        for projection in PROJECTIONS {
            for from in [Side::Front, Side::Isometric, Side::Top, Side::ThreeQuarter] {
                let camera = fit(from, Up::Z, projection, 0.1, false);
                let view = View::new(&camera, &corners, size).unwrap();
                let (mut min, mut max) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
                corners(&mut |p| {
                    let seen = view.see(p).unwrap();
                    (min, max) = (min.min(seen.at), max.max(seen.at));
                });
                // In one direction both borders are touched, in the other none is crossed.
                let free = DVec2::new(20.0, 10.0);
                let (before, behind) = (min - free, DVec2::new(200.0, 100.0) - free - max);
                assert!(before.min_element() > -1e-6 && behind.min_element() > -1e-6);
                let touched = (before + behind).min_element();
                assert!(touched < 1e-6, "{from:?} {projection:?}: {before} {behind}");
            }
        }
    }

    #[test]
    fn a_steady_camera_sees_the_sphere_around_everything_from_all_sides() {
        let (center, radius) = sphere(&corners);
        for projection in PROJECTIONS {
            let mut scales = Vec::new();
            for azimuth in [0.0, 33.0, 180.0] {
                let from = Side::Angles {
                    azimuth,
                    elevation: 20.0,
                };
                let camera = fit(from, Up::Y, projection, 0.0, true);
                let view = View::new(&camera, &corners, [100, 100]).unwrap();
                let [x, _, _] = view.axes();
                let middle = view.see(center).unwrap();
                assert!((middle.at - 50.0).length() < 1e-6);
                scales.push(view.see(center + x * radius).unwrap().at.x);
            }
            assert!(
                scales
                    .iter()
                    .all(|s| (s - scales[0]).abs() < 1e-6 && *s < 100.001)
            );
        }
    }

    #[test]
    fn sides_look_where_their_names_say() {
        for (up, side, right, above) in [
            (Up::Y, Side::Front, DVec3::X, DVec3::Y),
            (Up::Y, Side::Back, DVec3::NEG_X, DVec3::Y),
            (Up::Y, Side::Right, DVec3::NEG_Z, DVec3::Y),
            (Up::Y, Side::Left, DVec3::Z, DVec3::Y),
            (Up::Y, Side::Top, DVec3::X, DVec3::NEG_Z),
            (Up::Y, Side::Bottom, DVec3::X, DVec3::Z),
            (Up::Z, Side::Front, DVec3::X, DVec3::Z),
            (Up::Z, Side::Right, DVec3::Y, DVec3::Z),
            (Up::Z, Side::Top, DVec3::X, DVec3::Y),
        ] {
            let [x, y, z] = side.axes(up);
            assert_eq!((x, y), (right, above), "{side:?} with {up:?} upwards");
            assert_eq!(z, x.cross(y));
        }
        let [_, _, towards] = Side::Isometric.axes(Up::Y);
        assert!((towards - DVec3::ONE.normalize()).length() < 1e-12);
    }

    #[test]
    fn a_camera_straight_above_has_the_front_at_the_bottom() {
        for (up, from, front) in [
            (Up::Y, [0.0, 5.0, 0.0], DVec3::Z),
            (Up::Z, [0.0, 0.0, 5.0], DVec3::NEG_Y),
        ] {
            let camera = Camera::LookAt {
                from,
                to: [0.0; 3],
                up,
                projection: Projection::default(),
            };
            let view = View::new(&camera, &|_| {}, [10, 10]).unwrap();
            let seen = view.see(front).unwrap().at;
            assert!(seen.y > 6.0 && (seen.x - 5.0).abs() < 1e-9, "{seen}");
        }
    }

    #[test]
    fn the_ray_through_a_point_of_the_picture_meets_what_is_seen_there() {
        for projection in PROJECTIONS {
            let camera = fit(Side::ThreeQuarter, Up::Y, projection, 0.05, false);
            let view = View::new(&camera, &corners, [64, 48]).unwrap();
            let p = DVec3::new(0.3, 0.8, 8.1);
            let seen = view.see(p).unwrap();
            let (origin, direction) = view.ray(seen.at);
            let aside = (p - origin).cross(direction).length();
            assert!(aside < 1e-9, "{aside}");
            let depth = view
                .plane_depth(p, DVec3::new(0.1, 0.2, 0.9), seen.at)
                .unwrap();
            assert!((depth - seen.depth).abs() < 1e-9);
        }
    }

    #[test]
    fn cameras_that_see_nothing_are_refused() {
        let look_at = |from, to| Camera::LookAt {
            from,
            to,
            up: Up::Y,
            projection: Projection::default(),
        };
        let angle = |angle| Projection::Perspective { angle };
        let side = Side::Angles {
            azimuth: f64::NAN,
            elevation: 0.0,
        };
        for camera in [
            look_at([1.0; 3], [1.0; 3]),
            look_at([f64::INFINITY; 3], [1.0; 3]),
            fit(Side::Front, Up::Y, angle(0.0), 0.0, false),
            fit(Side::Front, Up::Y, angle(180.0), 0.0, false),
            fit(Side::Front, Up::Y, Projection::Orthographic, 0.5, false),
            fit(side, Up::Y, Projection::Orthographic, 0.0, false),
        ] {
            let refused = View::new(&camera, &corners, [10, 10]);
            assert!(
                matches!(refused, Err(PictureError::Camera(_))),
                "{camera:?}"
            );
        }
    }
}
