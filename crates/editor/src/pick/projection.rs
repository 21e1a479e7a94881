//! Converts points of the scene to pixels of the view, and back.

use glam::{DAffine3, DMat4};
use mesh::{DVec2, DVec3};

/// Converts points of the scene to pixels of the view, and back. Pixel coordinates start at the upper left corner of
/// the view, and y points down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// The matrix from scene space to clip space. In clip space, x and y run from -1 to 1, y points up, and z runs from
    /// 0 (near) to 1 (far).
    to_clip: DMat4,
    from_clip: DMat4,
    size: DVec2,
}

impl Projection {
    /// Creates a projection. `to_clip` is the matrix from scene space to clip space, and `size` is the size of the view
    /// in pixels. In clip space, x and y run from -1 to 1, and y points up. z runs from 0 at the near plane to 1 at the
    /// far plane.
    pub fn new(to_clip: DMat4, size: DVec2) -> Self {
        Self {
            to_clip,
            from_clip: to_clip.inverse(),
            size,
        }
    }

    /// Returns the size of the view in pixels.
    pub fn size(&self) -> DVec2 {
        self.size
    }

    /// Returns the projection for points in the space of an object. `placed` is the matrix from this space to the space
    /// of the scene.
    #[must_use]
    pub fn of_object(&self, placed: DAffine3) -> Self {
        Self::new(self.to_clip * DMat4::from(placed), self.size)
    }

    /// Returns the pixel at which a point is seen, and the depth of the point, from 0 (near) to 1 (far). Returns `None`
    /// if the point is not in front of the viewer.
    pub fn to_pixel(self, point: DVec3) -> Option<(DVec2, f64)> {
        let clip = self.to_clip * point.extend(1.0);
        let scene = clip.truncate() / clip.w;
        let pixel = DVec2::new(scene.x + 1.0, 1.0 - scene.y) * 0.5 * self.size;
        (clip.w > 0.0 && scene.z >= 0.0 && pixel.is_finite()).then_some((pixel, scene.z))
    }

    /// Returns the ray through a pixel: its start on the near plane, and the vector from this start to the far plane.
    pub fn ray(&self, pixel: DVec2) -> (DVec3, DVec3) {
        let near = self.point_at(pixel, 0.0);
        (near, self.point_at(pixel, 1.0) - near)
    }

    /// Returns the point that is seen at a pixel and has the given depth, from 0 (near) to 1 (far). All points with the
    /// same depth lie in a plane that is parallel to the picture.
    pub fn point_at(&self, pixel: DVec2, depth: f64) -> DVec3 {
        let flat = DVec2::new(
            2.0 * pixel.x / self.size.x - 1.0,
            1.0 - 2.0 * pixel.y / self.size.y,
        );
        let point = self.from_clip * flat.extend(depth).extend(1.0);
        point.truncate() / point.w
    }

    /// Returns the distance in pixels from a pixel to the line segment between two points, and the nearest point of the
    /// segment. The part of the segment behind the viewer is ignored. Returns `None` if no part of the segment is in
    /// front of the viewer.
    pub(crate) fn to_segment(self, pixel: DVec2, a: DVec3, b: DVec3) -> Option<(f64, DVec3)> {
        let (mut a, mut b) = (a, b);
        // Clips the segment to the near plane.
        let near = |p: DVec3| (self.to_clip * p.extend(1.0)).z;
        let (za, zb) = (near(a), near(b));
        if za < 0.0 && zb < 0.0 {
            return None;
        }
        if za < 0.0 {
            a = a.lerp(b, za / (za - zb) * (1.0 + 1e-12) + 1e-12);
        } else if zb < 0.0 {
            b = b.lerp(a, zb / (zb - za) * (1.0 + 1e-12) + 1e-12);
        }
        let (p, q) = (self.clip_pixel(a), self.clip_pixel(b));
        let along = q.0 - p.0;
        let squared = along.length_squared();
        let s = if squared > 0.0 {
            ((pixel - p.0).dot(along) / squared).clamp(0.0, 1.0)
        } else {
            0.0
        };
        // A point of the segment divides it in the picture at the fraction s, and in space at the fraction t. Under
        // perspective, s and t differ.
        let t = if p.1 > 0.0 && q.1 > 0.0 {
            let w = s / q.1;
            w / (w + (1.0 - s) / p.1)
        } else {
            s
        };
        let distance = pixel.distance(p.0 + along * s);
        (distance.is_finite()).then(|| (distance, a.lerp(b, t)))
    }

    fn clip_pixel(&self, point: DVec3) -> (DVec2, f64) {
        let clip = self.to_clip * point.extend(1.0);
        let flat = clip.truncate() / clip.w;
        (
            DVec2::new(flat.x + 1.0, 1.0 - flat.y) * 0.5 * self.size,
            clip.w,
        )
    }

    /// Returns the rectangle of pixels that contains the picture of a box in space. Returns `None` if the box reaches
    /// behind the viewer, because its picture is then not bounded.
    pub(crate) fn bounds(&self, min: DVec3, max: DVec3) -> Option<[DVec2; 2]> {
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for i in 0..8 {
            let pick = |bit: i32, a: f64, b: f64| if i & bit == 0 { a } else { b };
            let corner = DVec3::new(
                pick(1, min.x, max.x),
                pick(2, min.y, max.y),
                pick(4, min.z, max.z),
            );
            let (pixel, w) = self.clip_pixel(corner);
            if w <= 0.0 || !pixel.is_finite() {
                return None;
            }
            low = low.min(pixel);
            high = high.max(pixel);
        }
        Some([low, high])
    }
}
