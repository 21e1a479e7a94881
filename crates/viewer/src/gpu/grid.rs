//! The grid on the ground.

use glam::{DVec2, DVec3};

use super::Look;
use super::geometry::LineInstance;
use crate::camera::Camera;

/// Returns the lines of a grid on the ground, which fade with the distance from the center. The distance between
/// neighboring lines is 1, 2 or 5 times a power of ten.
pub(super) fn grid(
    bounds: [DVec3; 2],
    (center, radius): (DVec3, f64),
    camera: &Camera,
    look: &Look,
) -> Vec<LineInstance> {
    /// The maximum number of lines on each side of the center.
    const HALF: f64 = 26.0;
    const SEGMENTS: u32 = 12;
    let [x, up, front] = camera.world_axes();
    // The distance between neighboring lines of the grid is a power of ten, times 1, 2 or 5.
    let size = radius.max(1e-300) * 0.3;
    let power = libm::pow(10.0, libm::floor(libm::log10(size)));
    let step = power
        * if size >= 5.0 * power {
            5.0
        } else if size >= 2.0 * power {
            2.0
        } else {
            1.0
        };
    // The ground is as high as the lowest point of the scene.
    let level = bounds[0].dot(up).min(bounds[1].dot(up));
    let reach = 2.6 * radius;
    let n = libm::ceil(reach / step).min(HALF);
    let origin = |axis: DVec3| libm::round(center.dot(axis) / step);
    let (i0, j0) = (origin(x), origin(front));
    let gray = if look.is_dark {
        [150, 160, 178]
    } else {
        [120, 130, 148]
    };
    let mut lines = Vec::new();
    for (along, aside, along0, aside0) in [(x, front, i0, j0), (front, x, j0, i0)] {
        let mut k = -n;
        while k <= n {
            let number = aside0 + k;
            let is_axis = number == 0.0;
            let is_tenth = libm::fmod(number, 10.0) == 0.0;
            let point =
                |t: f64| along * ((along0 + t * n) * step) + aside * (number * step) + up * level;
            for s in 0..SEGMENTS {
                let [a, b] = [s, s + 1].map(|s| f64::from(2 * s) / f64::from(SEGMENTS) - 1.0);
                let middle = DVec2::new(0.5 * (a + b), k / n).length();
                let fade = (1.0 - middle).max(0.0);
                let strength = if is_axis {
                    0.75
                } else if is_tenth {
                    0.5
                } else {
                    0.26
                };
                let [r, g, b_] = if is_axis { axis_color(along) } else { gray };
                let alpha = alpha(strength * fade);
                if alpha > 3 {
                    let color = [r, g, b_, alpha];
                    let mut line = LineInstance::new([point(a), point(b)], center, 1.0, 0.0, color);
                    // This depth offset puts the grid behind surfaces that lie on the ground.
                    line.look[2] = -3.5;
                    lines.push(line);
                }
            }
            k += 1.0;
        }
    }
    lines
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the number is from 0 to 255"
)]
fn alpha(x: f64) -> u8 {
    (x.clamp(0.0, 1.0) * 255.0) as u8
}

/// Returns the color of an axis of the scene: red, green and blue for x, y and z.
pub fn axis_color(axis: DVec3) -> [u8; 3] {
    if axis.x != 0.0 {
        [224, 92, 92]
    } else if axis.y != 0.0 {
        [108, 190, 92]
    } else {
        [92, 140, 236]
    }
}
