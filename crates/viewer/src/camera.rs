//! The camera: it orbits around a point of the scene.

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4};

/// The vertical field of view with perspective, in degrees. The operation `Picture` has the same default field of view.
const FIELD_OF_VIEW: f64 = 25.0;
/// The largest angle above or below the horizontal plane, in degrees.
const MAX_PITCH: f64 = 90.0;

/// The axis that points upwards on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UpAxis {
    /// The y axis, as in glTF.
    #[default]
    Y,
    /// The z axis, as in most CAD programs.
    Z,
}

/// A side from which the camera looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// From the front, right and above.
    ThreeQuarter,
    /// From the front.
    Front,
    /// From the right.
    Right,
    /// From above.
    Top,
    /// From the back.
    Back,
    /// From the left.
    Left,
    /// From below.
    Bottom,
}

impl Side {
    /// All sides. The number key 1 shows the first side, the number key 2 shows the second side, and so on.
    pub const ALL: [Self; 7] = [
        Self::ThreeQuarter,
        Self::Front,
        Self::Right,
        Self::Top,
        Self::Back,
        Self::Left,
        Self::Bottom,
    ];

    /// Returns the name that is shown to the user.
    pub fn name(self) -> &'static str {
        match self {
            Self::ThreeQuarter => "Three-quarter",
            Self::Front => "Front",
            Self::Right => "Right",
            Self::Top => "Top",
            Self::Back => "Back",
            Self::Left => "Left",
            Self::Bottom => "Bottom",
        }
    }

    /// Returns the angle towards the right and the angle above the horizontal plane, in degrees.
    fn angles(self) -> [f64; 2] {
        match self {
            Self::ThreeQuarter => [30.0, 22.0],
            Self::Front => [0.0, 0.0],
            Self::Right => [90.0, 0.0],
            Self::Top => [0.0, 90.0],
            Self::Back => [180.0, 0.0],
            Self::Left => [-90.0, 0.0],
            Self::Bottom => [0.0, -90.0],
        }
    }
}

/// A camera that looks at a point of the scene. Its projection is either a perspective or a parallel projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The point in the middle of the picture, in scene units.
    pub target: DVec3,
    /// The distance from the target to the camera, in scene units.
    pub distance: f64,
    /// The angle from the front towards the right, in degrees.
    pub yaw: f64,
    /// The angle above the horizontal plane, in degrees, from -90 to 90.
    pub pitch: f64,
    /// The upward axis.
    pub up: UpAxis,
    /// Whether the camera has perspective, so that distant objects look smaller.
    pub is_perspective: bool,
}

impl Default for Camera {
    fn default() -> Self {
        let [yaw, pitch] = Side::ThreeQuarter.angles();
        Self {
            target: DVec3::ZERO,
            distance: 8.0,
            yaw,
            pitch,
            up: UpAxis::default(),
            is_perspective: true,
        }
    }
}

/// The tangent of half of the field of view.
fn tangent() -> f64 {
    libm::tan(0.5 * FIELD_OF_VIEW.to_radians())
}

impl Camera {
    /// Returns three orthogonal unit vectors: to the right in the picture, upwards in the picture, and towards the
    /// camera.
    pub fn axes(&self) -> [DVec3; 3] {
        let [right, up, front] = self.world_axes();
        let (sin, cos) = sin_cos(self.yaw);
        let (x, forward) = (right * cos - front * sin, front * cos + right * sin);
        let (sin, cos) = sin_cos(self.pitch);
        [x, up * cos - forward * sin, forward * cos + up * sin]
    }

    /// Returns three axes of the scene, as a viewer in front of the scene sees them: to the right, upwards, and towards
    /// the viewer.
    pub fn world_axes(&self) -> [DVec3; 3] {
        match self.up {
            UpAxis::Y => [DVec3::X, DVec3::Y, DVec3::Z],
            UpAxis::Z => [DVec3::X, DVec3::Z, DVec3::NEG_Y],
        }
    }

    /// Returns the position of the camera.
    pub fn eye(&self) -> DVec3 {
        self.target + self.axes()[2] * self.distance
    }

    /// Returns the size of a pixel in scene units at the distance of the target. `height` is the height of the picture
    /// in pixels.
    pub fn pixel_size(&self, height: f64) -> f64 {
        2.0 * tangent() * self.distance / height.max(1.0)
    }

    /// Returns the ray through a pixel: a point and a unit vector. `size` is the size of the picture in pixels.
    pub fn ray(&self, at: DVec2, size: DVec2) -> (DVec3, DVec3) {
        let [x, y, z] = self.axes();
        let d = (at - 0.5 * size) * self.pixel_size(size.y);
        let aside = x * d.x - y * d.y;
        if self.is_perspective {
            let direction = aside - z * self.distance;
            (self.eye(), direction.normalize())
        } else {
            // The ray begins far in front of everything that is visible.
            (self.target + aside + z * (100.0 * self.distance), -z)
        }
    }

    /// Projects a point to pixels. Returns `None` if the point is behind the camera.
    pub fn project(&self, p: DVec3, size: DVec2) -> Option<DVec2> {
        let [x, y, z] = self.axes();
        let v = p - self.target;
        let depth = if self.is_perspective {
            let depth = self.distance - v.dot(z);
            (depth > 1e-6 * self.distance).then_some(depth)?
        } else {
            self.distance
        };
        let scale = self.distance / (depth * self.pixel_size(size.y));
        Some(0.5 * size + DVec2::new(v.dot(x), -v.dot(y)) * scale)
    }

    /// Turns the camera around the target. `pixels` is the distance that the mouse was dragged.
    pub fn orbit(&mut self, pixels: DVec2) {
        const DEGREES_PER_PIXEL: f64 = 0.4;
        self.yaw = (self.yaw - pixels.x * DEGREES_PER_PIXEL).rem_euclid(360.0);
        let pitch = self.pitch + pixels.y * DEGREES_PER_PIXEL;
        self.pitch = pitch.clamp(-MAX_PITCH, MAX_PITCH);
    }

    /// Moves the camera sideways, so that the target moves by this many pixels.
    pub fn pan(&mut self, pixels: DVec2, size: DVec2) {
        let [x, y, _] = self.axes();
        self.target -= (x * pixels.x - y * pixels.y) * self.pixel_size(size.y);
    }

    /// Multiplies the distance to the target by `factor`. The point that is visible at the pixel `at` stays there if it
    /// has the same depth as the target.
    pub fn zoom(&mut self, factor: f64, at: DVec2, size: DVec2) {
        let [x, y, _] = self.axes();
        let d = (at - 0.5 * size) * self.pixel_size(size.y);
        let distance = (self.distance * factor).clamp(1e-12, 1e15);
        self.target += (x * d.x - y * d.y) * (1.0 - distance / self.distance);
        self.distance = distance;
    }

    /// Moves the camera so that a sphere fills the picture.
    pub fn fit(&mut self, center: DVec3, radius: f64, size: DVec2) {
        let aspect = (size.x / size.y.max(1.0)).clamp(0.05, 1.0);
        self.target = center;
        // The factor 1.06 leaves a margin, so that the sphere does not reach the toolbar and the drawn axes.
        let sine = libm::sin(libm::atan(tangent() * aspect));
        self.distance = 1.06 * radius.max(1e-12) / sine;
    }

    /// Turns the camera to a side.
    pub fn look_from(&mut self, side: Side) {
        [self.yaw, self.pitch] = side.angles();
    }

    /// Returns the rotation to camera space, and the projection. A point `p` has the camera coordinates
    /// `rotation * (p - target) - (0, 0, distance)`. Everything that is drawn must be inside the sphere with this
    /// `center` and `radius`.
    pub fn matrices(&self, size: DVec2, center: DVec3, radius: f64) -> (DMat4, DMat4) {
        let [x, y, z] = self.axes();
        let rotation = DMat4::from_mat3(DMat3::from_cols(x, y, z).transpose());
        let depth = self.distance - (center - self.target).dot(z);
        let aspect = size.x / size.y.max(1.0);
        let far = (depth + 1.05 * radius).max(1e-3 * self.distance);
        let projection = if self.is_perspective {
            let near = (depth - 1.05 * radius)
                .max(1e-3 * self.distance)
                .min(0.9 * far);
            perspective(aspect, near, far)
        } else {
            let y = tangent() * self.distance;
            let x = y * aspect;
            let near = depth - 1.05 * radius;
            orthographic(x, y, near, far.max(near + 1e-3 * self.distance))
        };
        (rotation, projection)
    }

    /// Returns the matrix from scene coordinates to clip space, where x and y run from -1 to 1 and z from 0 to 1.
    pub fn clip_matrix(&self, size: DVec2, center: DVec3, radius: f64) -> DMat4 {
        let (rotation, projection) = self.matrices(size, center, radius);
        let away = DMat4::from_translation(DVec3::new(0.0, 0.0, -self.distance));
        projection * away * rotation * DMat4::from_translation(-self.target)
    }

    /// Returns the number of pixels per scene unit. With perspective, this is the number at distance 1 from the camera.
    /// Without perspective, the number is the same at all distances.
    pub fn scale(&self, height: f64) -> f64 {
        if self.is_perspective {
            0.5 * height / tangent()
        } else {
            1.0 / self.pixel_size(height)
        }
    }
}

/// Returns the matrix of a perspective projection. The visible depths are mapped to the range from 0 to 1.
fn perspective(aspect: f64, near: f64, far: f64) -> DMat4 {
    let scale = 1.0 / tangent();
    let depth = far / (near - far);
    DMat4::from_cols(
        DVec4::new(scale / aspect, 0.0, 0.0, 0.0),
        DVec4::new(0.0, scale, 0.0, 0.0),
        DVec4::new(0.0, 0.0, depth, -1.0),
        DVec4::new(0.0, 0.0, near * depth, 0.0),
    )
}

/// Returns the matrix of a parallel projection. `x` and `y` are half of the width and height in scene units.
fn orthographic(x: f64, y: f64, near: f64, far: f64) -> DMat4 {
    let depth = 1.0 / (near - far);
    DMat4::from_cols(
        DVec4::new(1.0 / x, 0.0, 0.0, 0.0),
        DVec4::new(0.0, 1.0 / y, 0.0, 0.0),
        DVec4::new(0.0, 0.0, depth, 0.0),
        DVec4::new(0.0, 0.0, near * depth, 1.0),
    )
}

fn sin_cos(degrees: f64) -> (f64, f64) {
    // The result is exact for multiples of 90 degrees, as in the views that the number keys select.
    let quarter = degrees / 90.0;
    if quarter.fract() == 0.0 {
        return match quarter.rem_euclid(4.0) {
            0.0 => (0.0, 1.0),
            1.0 => (1.0, 0.0),
            2.0 => (0.0, -1.0),
            _ => (-1.0, 0.0),
        };
    }
    libm::sincos(degrees.to_radians())
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: DVec2 = DVec2::new(640.0, 480.0);

    fn cameras() -> Vec<Camera> {
        let mut cameras = Vec::new();
        for up in [UpAxis::Y, UpAxis::Z] {
            for is_perspective in [true, false] {
                for side in Side::ALL {
                    let mut camera = Camera {
                        up,
                        is_perspective,
                        target: DVec3::new(3.0, -2.0, 5.0),
                        ..Camera::default()
                    };
                    camera.look_from(side);
                    cameras.push(camera);
                }
            }
        }
        cameras
    }

    #[test]
    fn the_ray_through_the_projection_of_a_point_meets_the_point() {
        for camera in cameras() {
            for offset in [
                DVec3::ZERO,
                DVec3::new(0.3, -0.5, 0.8),
                DVec3::new(-1.0, 0.7, 0.1),
            ] {
                let p = camera.target + offset;
                let at = camera
                    .project(p, SIZE)
                    .expect("the point is in front of the camera");
                let (origin, direction) = camera.ray(at, SIZE);
                let distance = (p - origin).cross(direction).length();
                assert!(distance < 1e-9, "{camera:?}: {distance}");
            }
        }
    }

    #[test]
    fn the_matrix_to_clip_space_agrees_with_the_projection() {
        for camera in cameras() {
            let p = camera.target + DVec3::new(0.3, -0.5, 0.8);
            let clip = camera.clip_matrix(SIZE, camera.target, 2.0) * p.extend(1.0);
            let flat = clip.truncate() / clip.w;
            let at = DVec2::new(flat.x + 1.0, 1.0 - flat.y) * 0.5 * SIZE;
            assert!(at.distance(camera.project(p, SIZE).unwrap()) < 1e-6);
            assert!((0.0..=1.0).contains(&flat.z), "{flat}");
        }
    }

    #[test]
    fn the_point_under_the_cursor_stays_when_zooming() {
        for mut camera in cameras() {
            let at = DVec2::new(100.0, 400.0);
            let [x, y, _] = camera.axes();
            let d = (at - 0.5 * SIZE) * camera.pixel_size(SIZE.y);
            let p = camera.target + x * d.x - y * d.y;
            camera.zoom(0.4, at, SIZE);
            let found = camera.project(p, SIZE).unwrap();
            assert!(found.distance(at) < 1e-6, "{found}");
        }
    }

    #[test]
    fn panning_moves_the_target_by_the_pixels_of_the_drag() {
        for mut camera in cameras() {
            let before = camera.target;
            camera.pan(DVec2::new(30.0, -20.0), SIZE);
            let moved = camera.project(before, SIZE).unwrap() - 0.5 * SIZE;
            assert!(moved.distance(DVec2::new(30.0, -20.0)) < 1e-6, "{moved}");
        }
    }

    #[test]
    fn a_fitted_sphere_is_inside_of_the_picture_and_fills_it() {
        for size in [SIZE, DVec2::new(300.0, 800.0)] {
            for mut camera in cameras() {
                let (center, radius) = (DVec3::new(1.0, 2.0, 3.0), 7.0);
                camera.fit(center, radius, size);
                let [x, y, _] = camera.axes();
                for direction in [x, y, -x, -y] {
                    let at = camera.project(center + direction * radius, size).unwrap();
                    let inside = at.cmpge(DVec2::ZERO).all() && at.cmple(size).all();
                    assert!(inside, "{camera:?} {at}");
                }
                let at = camera.project(center + x * radius, size).unwrap();
                assert!((at.x - 0.5 * size.x) / size.min_element() > 0.4, "{at}");
            }
        }
    }
}
