//! Cameras: where a picture is seen from. [`Camera`] is what a recipe says, [`View`] what the rasteriser
//! needs.

mod fit;

use glam::{DVec2, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::PictureError;
use fit::Fit;
pub(crate) use fit::sphere;

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
    pub fn turned(mut self, degrees: f64) -> Self {
        match &mut self {
            Self::Fit { from, steady, .. } => {
                let [azimuth, elevation] = from.angles();
                let azimuth = azimuth + degrees;
                *from = Side::Angles { azimuth, elevation };
                *steady = true;
            }
            Self::LookAt { from, to, up, .. } => {
                let (sin, cos) = geometry::sin_cos_degrees(degrees);
                let [right, upwards, front] = up.axes();
                let d = DVec3::from(*from) - DVec3::from(*to);
                let [x, y, z] = [right, upwards, front].map(|axis| d.dot(axis));
                let d = right * (x * cos + z * sin) + upwards * y + front * (z * cos - x * sin);
                *from = (DVec3::from(*to) + d).into();
            }
        }
        self
    }

    /// The few of many points that decide what it shows in a picture of this size: a [`View`] of the points of many
    /// scenes is that of these of each. None if it shows the same whatever there is.
    ///
    /// # Errors
    ///
    /// As [`View::new`].
    pub fn decisive(
        &self,
        points: &impl Fn(&mut dyn FnMut(DVec3)),
        [width, height]: [u32; 2],
    ) -> Result<Vec<DVec3>, PictureError> {
        let size = DVec2::new(f64::from(width), f64::from(height));
        match *self {
            Self::Fit {
                from,
                up,
                projection,
                margin,
                steady,
            } => Ok(Fit::new(from, up, projection, margin, steady, size)?.decisive(points)),
            Self::LookAt { .. } => self.check().map(|()| Vec::new()),
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
        let (sin, cos) = geometry::sin_cos_degrees(azimuth);
        let (x, forth) = (right * cos - front * sin, front * cos + right * sin);
        let (sin, cos) = geometry::sin_cos_degrees(elevation);
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
    /// What is nearer than this is not seen; minus infinity without perspective.
    pub(crate) near: f64,
    /// The middle of the picture, in pixels.
    middle: DVec2,
}

/// A point seen by a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScreenPoint {
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
            } => Ok(Fit::new(from, up, projection, margin, steady, size)?.view(points)),
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
            near: tangent.map_or(f64::NEG_INFINITY, |_| 1e-3 * distance),
            middle: 0.5 * size,
        })
    }

    /// Where a point is seen; `None` if it is behind the camera.
    pub fn see(&self, p: DVec3) -> Option<ScreenPoint> {
        let v = self.turned(p);
        (v.z >= self.near).then(|| self.project(v))
    }

    /// Right, upwards and distance from the camera.
    pub(crate) fn turned(&self, p: DVec3) -> DVec3 {
        let [x, y, z] = self.axes;
        let p = p - self.eye;
        DVec3::new(p.dot(x), p.dot(y), -p.dot(z))
    }

    /// Whether something (as [`turned`](Self::turned) gives it) is on the inner side of a border: not
    /// negative inside, and linear in `v`. Border 0 is what is too near; the others are `far` pixels from
    /// the upper left corner, to each side.
    pub(crate) fn inside(&self, border: usize, far: f64, v: DVec3) -> f64 {
        let distance = if self.is_perspective { v.z } else { 1.0 };
        let (x, y) = (self.scale * v.x, -self.scale * v.y);
        match border {
            0 => v.z - self.near,
            1 => x + (far + self.middle.x) * distance,
            2 => (far - self.middle.x) * distance - x,
            3 => y + (far + self.middle.y) * distance,
            _ => (far - self.middle.y) * distance - y,
        }
    }

    /// Where something is seen that is not behind the camera.
    pub(crate) fn project(&self, v: DVec3) -> ScreenPoint {
        let (shrink, depth) = if self.is_perspective {
            (self.scale / v.z, -1.0 / v.z)
        } else {
            (self.scale, v.z)
        };
        ScreenPoint {
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

    /// The depth, in the sense of [`ScreenPoint::depth`], of the plane through `p` with the normal `n` at a place of
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

#[cfg(test)]
mod tests;
