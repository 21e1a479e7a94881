//! Cameras. A recipe describes a [`Camera`]; the rasterizer uses a [`View`], which is a camera fitted to a scene and a
//! picture size.

mod fit;

use glam::{DVec2, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::PictureError;
use fit::Fit;
pub(crate) use fit::sphere;

/// The position, direction and projection of the camera.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Camera {
    /// Looks at the scene from a given side. The distance of the camera is chosen so that the whole scene fits into the
    /// picture.
    Fit {
        /// The side from which the camera looks.
        #[serde(default)]
        from: Side,
        /// The axis that points upwards.
        #[serde(default)]
        up: Up,
        /// The projection.
        #[serde(default)]
        projection: Projection,
        /// The empty margin at each border of the picture, as a fraction of the width (left and right) or height (top
        /// and bottom).
        #[serde(default = "margin")]
        #[schemars(range(min = 0.0, max = 0.45))]
        margin: f64,
        /// Whether the picture has the same scale for every direction of the camera. Set this for an animation in which
        /// the camera turns around the scene.
        #[serde(default)]
        steady: bool,
    },
    /// Looks from one point to another point.
    LookAt {
        /// The position of the camera, `(x, y, z)`, in scene units.
        from: [f64; 3],
        /// The point in the middle of the picture, `(x, y, z)`, in scene units.
        to: [f64; 3],
        /// The axis that points upwards.
        #[serde(default)]
        up: Up,
        /// The projection. With `Orthographic`, the scale is the same as the scale at the point `to` in a perspective
        /// picture with a field of view of 30 degrees.
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
    /// Returns the camera rotated about the upward axis through the point that the camera looks at. A positive angle
    /// moves the camera to the right. A [`Self::Fit`] camera also becomes [steady](Self::Fit::steady): its pictures
    /// then have the same scale for every direction. `points` are the points of the scene. They determine the upward
    /// axis if it is [`Up::Auto`].
    #[must_use]
    pub fn turned(mut self, degrees: f64, points: &impl Fn(&mut dyn FnMut(DVec3))) -> Self {
        match &mut self {
            Self::Fit { from, steady, .. } => {
                let [azimuth, elevation] = from.angles();
                let azimuth = azimuth + degrees;
                *from = Side::Angles { azimuth, elevation };
                *steady = true;
            }
            Self::LookAt { from, to, up, .. } => {
                let (sin, cos) = geometry::sin_cos_degrees(degrees);
                *up = up.resolved(points);
                let [right, upwards, front] = up.axes();
                let d = DVec3::from(*from) - DVec3::from(*to);
                let [x, y, z] = [right, upwards, front].map(|axis| d.dot(axis));
                let d = right * (x * cos + z * sin) + upwards * y + front * (z * cos - x * sin);
                *from = (DVec3::from(*to) + d).into();
            }
        }
        self
    }

    /// Returns a small subset of `points` that gives the same view as all points, in a picture of this size.
    ///
    /// To compute a common [`View`] of several scenes, it is enough to know the extreme points of each scene. The view
    /// of [`Self::LookAt`] depends on points only if its upward axis is [`Up::Auto`].
    ///
    /// # Errors
    ///
    /// Returns the errors of [`View::new`].
    pub fn extreme_points(
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
            } => {
                let ups = match up {
                    Up::Auto => vec![Up::Y, Up::Z],
                    up => vec![up],
                };
                let fits = ups
                    .into_iter()
                    .map(|up| Fit::new(from, up, projection, margin, steady, size));
                let extreme = fits.map(|fit| Ok(fit?.extreme_points(points)));
                Ok(extreme.collect::<Result<Vec<_>, PictureError>>()?.concat())
            }
            Self::LookAt { up, .. } => {
                self.check()?;
                Ok(match up {
                    Up::Auto => fit::outermost(&[], points),
                    Up::Y | Up::Z => Vec::new(),
                })
            }
        }
    }

    /// Checks that all numbers of the camera are in their ranges. This check needs no scene.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`View::new`].
    pub fn check(&self) -> Result<(), PictureError> {
        View::new(self, &|_| {}, [1, 1]).map(drop)
    }
}

fn margin() -> f64 {
    0.05
}

/// The side from which the camera looks. If y points upwards, the front is the side where z is large, as in glTF. If z
/// points upwards, the front is the side where y is small (the south side on a map).
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Side {
    /// From the front. If y points upwards, the front is the side where z is large. If z points upwards, the front is
    /// the side where y is small.
    Front,
    /// From the back, which is opposite to the front.
    Back,
    /// From the side where x is small.
    Left,
    /// From the side where x is large.
    Right,
    /// From above. The front is at the bottom of the picture.
    Top,
    /// From below. The front is at the top of the picture.
    Bottom,
    /// From the front, right and above, so that the three axes are equally long in the picture.
    Isometric,
    /// From the front, but turned by 30 degrees towards the side where x is large, and raised by 22 degrees.
    #[default]
    ThreeQuarter,
    /// From the direction that the two angles give.
    Angles {
        /// The angle from the front towards the right, in degrees.
        azimuth: f64,
        /// The angle above the horizontal plane, in degrees.
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
    /// The z axis, as in most CAD programs.
    Z,
    /// The z axis if the scene stands on the plane z = 0 but not on the plane y = 0; else the y axis.
    Auto,
}

/// The projection of a camera.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Projection {
    /// Parallel projection: the size of an object does not depend on its distance.
    Orthographic,
    /// Perspective projection, as in a photograph.
    Perspective {
        /// The vertical field of view, in degrees.
        #[schemars(range(min = 1.0, max = 150.0))]
        angle: f64,
    },
}

impl Default for Projection {
    fn default() -> Self {
        Self::Perspective {
            angle: DEFAULT_ANGLE,
        }
    }
}

/// The default field of view, in degrees. On 35 mm film in portrait format, a lens of 80 mm has nearly the same
/// vertical field of view.
const DEFAULT_ANGLE: f64 = 25.0;
/// The field of view, in degrees, that determines the scale of an orthographic `LookAt`.
const ORTHOGRAPHIC_ANGLE: f64 = 30.0;

impl Up {
    /// For `Auto`, returns the upward axis of a scene with these points. For the other axes, returns `self`.
    fn resolved(self, points: &impl Fn(&mut dyn FnMut(DVec3))) -> Self {
        /// A scene stands on a plane if its lowest point is near the plane, and its highest point is above the plane
        /// and not near it. A point is near if its distance is at most this fraction of the size of the scene.
        const TOLERANCE: f64 = 1e-3;
        if self != Self::Auto {
            return self;
        }
        let [mut min, mut max] = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        points(&mut |p| (min, max) = (min.min(p), max.max(p)));
        let tolerance = TOLERANCE * (max - min).max_element();
        let stands = |axis: usize| min[axis].abs() <= tolerance && max[axis] > tolerance;
        if stands(2) && !stands(1) {
            Self::Z
        } else {
            Self::Y
        }
    }

    /// Returns the axes of the scene for a viewer in front of it: the directions to the right, upwards, and towards
    /// this viewer.
    ///
    /// `Auto` must have been replaced by [`resolved`](Self::resolved). An `Auto` that was not replaced is treated like
    /// `Y`.
    fn axes(self) -> [DVec3; 3] {
        match self {
            Self::Y | Self::Auto => [DVec3::X, DVec3::Y, DVec3::Z],
            Self::Z => [DVec3::X, DVec3::Z, DVec3::NEG_Y],
        }
    }
}

impl Side {
    /// Returns the azimuth and the elevation, in degrees.
    fn angles(self) -> [f64; 2] {
        match self {
            Self::Front => [0.0, 0.0],
            Self::Back => [180.0, 0.0],
            Self::Left => [-90.0, 0.0],
            Self::Right => [90.0, 0.0],
            Self::Top => [0.0, 90.0],
            Self::Bottom => [0.0, -90.0],
            // The elevation of the isometric view is the arc tangent of 1 / √2.
            Self::Isometric => [45.0, 35.264_389_682_754_654],
            Self::ThreeQuarter => [30.0, 22.0],
            Self::Angles { azimuth, elevation } => [azimuth, elevation],
        }
    }

    /// Returns three directions in the scene: the directions that point to the right and upwards in the picture, and
    /// the direction towards the camera.
    fn axes(self, up: Up) -> [DVec3; 3] {
        let [right, up, front] = up.axes();
        let [azimuth, elevation] = self.angles();
        let (sin, cos) = geometry::sin_cos_degrees(azimuth);
        let (x, forward) = (right * cos - front * sin, front * cos + right * sin);
        let (sin, cos) = geometry::sin_cos_degrees(elevation);
        [x, up * cos - forward * sin, forward * cos + up * sin]
    }
}

/// A camera together with the size of its picture. It projects points of the scene to pixels.
///
/// Pixel coordinates start at the upper left corner of the picture and grow to the right and downwards.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The directions to the right, upwards, and towards the camera. The directions are orthogonal unit vectors.
    axes: [DVec3; 3],
    /// With perspective, the position of the camera; otherwise a point that is shown in the middle of the picture.
    eye: DVec3,
    /// The number of pixels per scene unit. With perspective, this number is valid at distance 1 from the camera.
    scale: f64,
    is_perspective: bool,
    /// The distance of the near plane from the camera. Points nearer to the camera are not visible. Without
    /// perspective, the distance is minus infinity.
    pub(crate) near: f64,
    /// The middle of the picture, in pixels.
    middle: DVec2,
}

/// A point of the scene, projected to the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScreenPoint {
    /// The distances from the left and the top of the picture, in pixels.
    pub at: DVec2,
    /// The depth, which grows with the distance from the camera. For points of a plane, the depth is a linear function
    /// of the position in the picture.
    pub depth: f64,
}

impl View {
    /// Creates the view of a scene with these points, in a picture of this size.
    ///
    /// # Errors
    ///
    /// Returns [`PictureError::Camera`] if a number of the camera is out of its range or not finite. Returns the same
    /// error if `from` and `to` are equal, because the camera then has no direction.
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
                let up = up.resolved(points);
                Ok(Fit::new(from, up, projection, margin, steady, size)?.view(points))
            }
            Camera::LookAt {
                from,
                to,
                up,
                projection,
            } => {
                let up = up.resolved(points);
                Self::look_at(from.into(), to.into(), up, projection, size)
            }
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
            let message =
                "expected `from` and `to` of the camera to be two different finite points";
            return Err(PictureError::Camera(message.to_owned()));
        }
        let [_, upwards, front] = up.axes();
        // If the camera looks straight down, the front of the scene is at the bottom of the picture.
        let mut right = upwards.cross(towards);
        if right.length() < 1e-9 {
            right = (front * -towards.dot(upwards).signum()).cross(towards);
        }
        let right = right.normalize();
        let axes = [right, towards.cross(right), towards];
        let tangent = projection.tangent()?;
        let distance = from.distance(to);
        let half_height = tan_degrees(0.5 * ORTHOGRAPHIC_ANGLE) * distance;
        Ok(Self {
            axes,
            eye: from,
            scale: 0.5 * size.y / tangent.unwrap_or(half_height),
            is_perspective: tangent.is_some(),
            near: tangent.map_or(f64::NEG_INFINITY, |_| 1e-3 * distance),
            middle: 0.5 * size,
        })
    }

    /// Projects a point. Returns `None` if the point is behind the camera or nearer than the near plane.
    pub fn screen_point(&self, p: DVec3) -> Option<ScreenPoint> {
        let v = self.camera_space(p);
        (v.z >= self.near).then(|| self.project(v))
    }

    /// Converts a point to camera coordinates. The first axis points to the right, the second points upwards, and the
    /// third coordinate is the distance from the camera.
    pub(crate) fn camera_space(&self, p: DVec3) -> DVec3 {
        let [x, y, z] = self.axes;
        let p = p - self.eye;
        DVec3::new(p.dot(x), p.dot(y), -p.dot(z))
    }

    /// Returns a number that says whether the point `v` is on the visible side of a clipping plane. The number is at
    /// least 0 on the visible side, and it is linear in `v`. `v` is in [camera coordinates](Self::camera_space).
    ///
    /// Plane 0 is the near plane. Planes 1 to 4 bound the visible region on the left, on the right, above and below. In
    /// the picture, each of these four planes appears as a line, `far` pixels away from the upper left corner.
    pub(crate) fn clip_distance(&self, plane: usize, far: f64, v: DVec3) -> f64 {
        let distance = if self.is_perspective { v.z } else { 1.0 };
        let (x, y) = (self.scale * v.x, -self.scale * v.y);
        match plane {
            0 => v.z - self.near,
            1 => x + (far + self.middle.x) * distance,
            2 => (far - self.middle.x) * distance - x,
            3 => y + (far + self.middle.y) * distance,
            _ => (far - self.middle.y) * distance - y,
        }
    }

    /// Projects a point in [camera coordinates](Self::camera_space) that is not behind the camera.
    pub(crate) fn project(&self, v: DVec3) -> ScreenPoint {
        let (scale, depth) = if self.is_perspective {
            (self.scale / v.z, -1.0 / v.z)
        } else {
            (self.scale, v.z)
        };
        ScreenPoint {
            at: self.middle + DVec2::new(v.x * scale, -v.y * scale),
            depth,
        }
    }

    /// Returns the origin and the direction of the ray through a point of the picture, in scene units. The length of
    /// the direction vector is chosen so that its component along the axis of the camera is 1.
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

    /// Returns the [depth](ScreenPoint::depth) of a plane at a point of the picture. The plane passes through `p` and
    /// has the normal `n`. Returns `None` if the plane is seen edge-on.
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

    /// Returns the size of a pixel at this depth, in scene units.
    pub(crate) fn pixel_size(&self, depth: f64) -> f64 {
        if self.is_perspective {
            -1.0 / (depth * self.scale)
        } else {
            1.0 / self.scale
        }
    }

    /// Returns how much the depth changes if a point at `depth` moves away from the camera by `length` scene units.
    pub(crate) fn depth_change(&self, length: f64, depth: f64) -> f64 {
        if self.is_perspective {
            length * depth * depth
        } else {
            length
        }
    }

    /// Returns the directions to the right, upwards, and towards the camera.
    pub fn axes(&self) -> [DVec3; 3] {
        self.axes
    }
}

impl Projection {
    /// Returns the tangent of half the field of view; `None` without perspective.
    fn tangent(self) -> Result<Option<f64>, PictureError> {
        match self {
            Self::Orthographic => Ok(None),
            Self::Perspective { angle } if (1.0..=150.0).contains(&angle) => {
                Ok(Some(tan_degrees(0.5 * angle)))
            }
            Self::Perspective { angle } => {
                let message =
                    format!("expected a perspective angle from 1 to 150 degrees, found {angle}");
                Err(PictureError::Camera(message))
            }
        }
    }
}

fn tan_degrees(angle: f64) -> f64 {
    libm::tan(angle.to_radians())
}

#[cfg(test)]
mod tests;
