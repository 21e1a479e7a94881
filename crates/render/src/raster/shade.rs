//! Computes the color of a triangle at a point of the picture.
//!
//! The light comes from a key light at the upper left, a weak fill light at the right, and a bright sky over a darker
//! ground. The directions of the lights are relative to the camera, so that every view is lit alike.

use glam::{DVec2, DVec3};

use super::occlusion::Occlusion;
use crate::color::{mix, narrow};
use crate::drawing::{Drawing, Part, Surface};
use crate::style::{Look, Shading};
use crate::{PictureError, View};

/// The direction to the key light. Its components point to the right, upwards, and towards the camera. The vector is
/// not a unit vector.
pub(super) const KEY: DVec3 = DVec3::new(-0.45, 0.65, 0.75);
/// The direction to the fill light. The vector is not a unit vector.
pub(super) const FILL: DVec3 = DVec3::new(0.8, -0.05, 0.45);
/// The linear red, green and blue of the key light.
pub(super) const KEY_LIGHT: [f32; 3] = [0.84, 0.82, 0.78];
/// The linear red, green and blue of the fill light.
pub(super) const FILL_LIGHT: [f32; 3] = [0.09, 0.10, 0.115];
/// The linear red, green and blue of the light from straight above.
pub(super) const SKY: [f32; 3] = [0.42, 0.435, 0.46];
/// The linear red, green and blue of the light from straight below.
pub(super) const GROUND: [f32; 3] = [0.17, 0.16, 0.15];

/// Computes the colors of triangles and lines.
pub(super) struct Shader<'a> {
    pub(super) drawing: &'a Drawing<'a>,
    pub(super) view: &'a View,
    look: &'a Look,
    occlusion: Option<Occlusion>,
    /// The indices of the first triangle and the first face of each part.
    firsts: Vec<[u32; 2]>,
    /// Whether the drawing has a surface that is not opaque.
    pub(super) has_transparency: bool,
    key: DVec3,
    fill: DVec3,
}

/// A point of a surface, the normal there, and the openness: the fraction of the surroundings that is visible from the
/// point.
#[derive(Clone, Copy)]
struct OpennessSample {
    at: DVec3,
    normal: DVec3,
    openness: f32,
}

/// Results for the last point. They can be reused for the next point.
#[derive(Default)]
pub(super) struct ShadingCache {
    /// The triangle that was shaded last, and its data.
    triangle: Option<(u32, TriangleData)>,
    /// The openness that was computed last in the current pixel.
    openness: Option<OpennessSample>,
}

impl ShadingCache {
    /// Clears the results that are valid in one pixel only.
    pub(super) fn begin_pixel(&mut self) {
        self.openness = None;
    }
}

/// Data that all points of a triangle have in common.
#[derive(Clone, Copy)]
pub(super) struct TriangleData {
    /// The index of the part.
    part: usize,
    /// The index of the triangle in the part.
    triangle: usize,
    corners: [DVec3; 3],
    /// The unit normal; zero if the triangle is degenerate.
    normal: DVec3,
    /// The gradients of the barycentric coordinates of the second and the third corner.
    gradients: [DVec3; 2],
}

impl TriangleData {
    pub(super) fn new(part: usize, triangle: usize, corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners;
        let (u, v) = (b - a, c - a);
        let normal = unit_cross(u, v);
        let area = normal.dot(u.cross(v));
        Self {
            part,
            triangle,
            corners,
            normal,
            gradients: [v.cross(normal) / area, normal.cross(u) / area],
        }
    }

    /// Returns the barycentric coordinates of the point where a ray meets the plane of the triangle; `None` if the ray
    /// is parallel to the plane.
    pub(super) fn barycentric(&self, origin: DVec3, direction: DVec3) -> Option<[f64; 3]> {
        let a = self.corners[0] - origin;
        let p = direction * (self.normal.dot(a) / self.normal.dot(direction)) - a;
        let [s, t] = self.gradients.map(|g| g.dot(p));
        (s.is_finite() && t.is_finite()).then_some([1.0 - s - t, s, t])
    }
}

/// A point on a triangle.
struct SurfacePoint {
    at: DVec3,
    /// The barycentric coordinates.
    weights: [f32; 3],
    /// The unit normal of the triangle, on the side of the camera; zero if the triangle is degenerate.
    normal: DVec3,
    is_back: bool,
    /// The direction towards the camera.
    to_eye: DVec3,
}

impl<'a> Shader<'a> {
    /// Prepares shading, including the depth maps of ambient occlusion. When a depth map is complete, `map_done` is
    /// called with the total number of depth maps.
    pub(super) fn new(
        drawing: &'a Drawing<'a>,
        view: &'a View,
        size: [u32; 2],
        look: &'a Look,
        map_done: impl Fn(u64) -> Result<(), PictureError> + Sync,
    ) -> Result<Self, PictureError> {
        let mut next = [0_u32; 2];
        let mut firsts = Vec::new();
        for part in &drawing.parts {
            firsts.push(next);
            let n = u32::try_from(part.triangles.len()).unwrap_or(u32::MAX);
            next[0] = next[0].saturating_add(n);
            next[1] = next[1].saturating_add(part.n_faces);
        }
        let occlusion = (look.has_occlusion() && drawing.n_triangles() > 0)
            .then(|| Occlusion::new(drawing, size, map_done))
            .transpose()?;
        let surfaces = drawing.parts.iter().flat_map(|p| &p.materials);
        Ok(Self {
            drawing,
            view,
            look,
            occlusion,
            firsts,
            has_transparency: surfaces
                .into_iter()
                .any(|s| s.color[3] < 1.0 || s.texture.as_ref().is_some_and(|t| !t.is_opaque())),
            key: KEY.normalize(),
            fill: FILL.normalize(),
        })
    }

    /// Returns the index of the part that contains a triangle, and the index of the triangle within this part.
    pub(super) fn locate(&self, id: u32) -> (usize, usize) {
        let part = self.firsts.partition_point(|first| first[0] <= id) - 1;
        (part, (id - self.firsts[part][0]) as usize)
    }

    /// For a triangle, returns the index of its face (among the faces of all parts), one of its points, and its normal.
    /// The normal can have any length.
    pub(super) fn plane(&self, id: u32) -> (u32, DVec3, DVec3) {
        let (part, triangle) = self.locate(id);
        let p = &self.drawing.parts[part];
        let [a, b, c] = p.corners_at(triangle);
        let face = u32::try_from(p.face(triangle)).unwrap_or(0);
        let face = self.firsts[part][1].saturating_add(face);
        (face, a, (b - a).cross(c - a))
    }

    /// Returns the color of the line that an entry of `Tile::lines` refers to.
    pub(super) fn line_color(&self, entry: u32) -> [f32; 4] {
        let line = &self.drawing.lines[((entry - 2) / 2) as usize];
        let [r, g, b, a] = line.color;
        let opacity = if entry & 1 == 1 { line.hidden } else { 1.0 };
        [r, g, b, a * opacity]
    }

    /// Returns the linear light of a triangle at a point of the picture.
    pub(super) fn shade(&self, id: u32, at: DVec2, cache: &mut ShadingCache) -> [f32; 3] {
        let data = match cache.triangle {
            Some((last, data)) if last == id => data,
            _ => {
                let (part, triangle) = self.locate(id);
                let corners = self.drawing.parts[part].corners_at(triangle);
                let data = TriangleData::new(part, triangle, corners);
                cache.triangle = Some((id, data));
                data
            }
        };
        let part = &self.drawing.parts[data.part];
        let point = self.surface_point(&data, at);
        let (color, surface) = self.color(part, &data, &point, at);
        let is_plain = surface.is_some_and(|s| s.unlit) || self.look.shading == Shading::Plain;
        let light = if is_plain {
            color
        } else {
            let normal = normal(part, data.triangle, &point);
            let openness = self.openness(&point, &mut cache.openness);
            self.lit(color, normal, point.to_eye, openness, surface)
        };
        let emissive = surface.map_or([0.0; 3], |s| s.emissive);
        std::array::from_fn(|i| light[i] + emissive[i])
    }

    /// Returns the point where the ray through a point of the picture meets a triangle. If the ray misses the triangle,
    /// returns a point of the triangle near the ray. If the triangle is seen edge-on, returns its middle.
    fn surface_point(&self, data: &TriangleData, at: DVec2) -> SurfacePoint {
        let (origin, direction) = self.view.ray(at);
        let weights = data.barycentric(origin, direction);
        let weights = weights.map_or([1.0 / 3.0; 3], |w| {
            let w = w.map(|w| w.max(0.0));
            let sum = w[0] + w[1] + w[2];
            w.map(|w| w / sum)
        });
        let [a, b, c] = data.corners;
        let to_eye = -direction.normalize();
        let is_back = data.normal.dot(to_eye) < 0.0;
        SurfacePoint {
            at: a * weights[0] + b * weights[1] + c * weights[2],
            weights: weights.map(narrow),
            normal: if is_back { -data.normal } else { data.normal },
            is_back,
            to_eye,
        }
    }

    /// Returns the openness of a point: the fraction of its surroundings that is visible from the point. If the ambient
    /// occlusion of the style is weak, the result is nearer to 1, as if more of the surroundings were visible.
    fn openness(&self, point: &SurfacePoint, last: &mut Option<OpennessSample>) -> f32 {
        let Some(occlusion) = &self.occlusion else {
            return 1.0;
        };
        // If the previous point in this pixel is near and has a similar normal, both points have nearly the same
        // openness. Then the openness of the previous point is reused.
        let near = last.filter(|k| {
            let pixel = self
                .view
                .screen_point(point.at)
                .map_or(0.0, |s| self.view.pixel_size(s.depth));
            k.at.distance_squared(point.at) < 4.0 * pixel * pixel
                && k.normal.dot(point.normal) > 0.8
        });
        let openness = near.map_or_else(
            || occlusion.openness(point.at, point.normal),
            |k| k.openness,
        );
        *last = Some(OpennessSample {
            at: point.at,
            normal: point.normal,
            openness,
        });
        1.0 - self.look.occlusion * (1.0 - openness)
    }

    /// Returns the color of a point without lighting, and the surface that the point belongs to.
    fn color(
        &self,
        part: &'a Part,
        data: &TriangleData,
        point: &SurfacePoint,
        at: DVec2,
    ) -> ([f32; 3], Option<&'a Surface>) {
        let triangle = data.triangle;
        let surface = part.materials.get(part.surface_index(triangle));
        let mut color = part.colors.at(part, triangle, point.weights);
        if let Some(s) = surface {
            color = std::array::from_fn(|i| color[i] * s.color[i]);
            if let (Some(texture), Some(uvs)) = (&s.texture, part.uvs.get(s.uv_set)) {
                let uvs = part.corners[triangle].map(|c| uvs[c as usize]);
                let uv = |w: [f64; 3]| uvs[0] * w[0] + uvs[1] * w[1] + uvs[2] * w[2];
                let here = uv(point.weights.map(f64::from));
                let steps = [DVec2::X, DVec2::Y].map(|step| {
                    let (origin, direction) = self.view.ray(at + step);
                    let weights = data.barycentric(origin, direction);
                    weights.map_or(DVec2::ZERO, |w| uv(w) - here)
                });
                let texel = texture.at(here, steps);
                color = std::array::from_fn(|i| color[i] * texel[i]);
            }
        }
        if let (true, Some(back)) = (point.is_back, part.back) {
            color = back;
        }
        if let Some(&[r, g, b, a]) = part.highlights.get(part.face(triangle)) {
            color = mix(color, [r, g, b], a);
        }
        (color, surface)
    }

    /// Returns the light that a surface of this color reflects to the camera.
    fn lit(
        &self,
        color: [f32; 3],
        normal: DVec3,
        to_eye: DVec3,
        openness: f32,
        surface: Option<&Surface>,
    ) -> [f32; 3] {
        let [x, y, z] = self.view.axes();
        let relative_to_camera = |v: DVec3| DVec3::new(v.dot(x), v.dot(y), v.dot(z));
        let n = relative_to_camera(normal);
        if self.look.shading == Shading::Matcap {
            return matcap(color, n, openness);
        }
        let key = narrow(n.dot(self.key).max(0.0));
        let fill = narrow(n.dot(self.fill).max(0.0));
        let sky = mix(GROUND, SKY, narrow(0.5 + 0.5 * n.y));
        // The lights cast no shadows. Instead, ambient occlusion also darkens direct light, but less than the light
        // from the sky.
        let direct = 0.4 + 0.6 * openness;
        let light: [f32; 3] = std::array::from_fn(|i| {
            color[i] * (sky[i] * openness + direct * (KEY_LIGHT[i] * key + FILL_LIGHT[i] * fill))
        });
        if self.look.shading != Shading::Phong {
            return light;
        }
        // The formula for the highlight is from Blinn, "Models of Light Reflection for Computer Synthesized Pictures",
        // 1977.
        let roughness = surface.map_or(1.0, |s| s.roughness).clamp(0.0, 1.0);
        let exponent = 40.0 + 200.0 * (1.0 - roughness);
        let strength = 0.45 + 0.4 * (1.0 - roughness);
        let half = (self.key + relative_to_camera(to_eye)).normalize_or_zero();
        let glint = libm::powf(narrow(n.dot(half).max(0.0)), exponent) * strength * direct;
        light.map(|c| c + glint)
    }
}

/// Returns the unit normal for lighting.
fn normal(part: &Part, triangle: usize, point: &SurfacePoint) -> DVec3 {
    let normal = part.normals.at(part, triangle, point.weights);
    if normal == [0.0; 3] {
        return point.normal;
    }
    let normal = DVec3::from(normal.map(f64::from)).normalize_or_zero();
    if normal == DVec3::ZERO {
        return point.normal;
    }
    let n = if point.is_back { -normal } else { normal };
    // An interpolated normal can point away from the camera although the triangle faces the camera. In this case, the
    // normal is made perpendicular to the direction towards the camera.
    let facing = n.dot(point.to_eye);
    if facing < 0.0 {
        (n - point.to_eye * facing).normalize_or(point.normal)
    } else {
        n
    }
}

/// Returns the color of clay in a studio, with broad light from the upper left, a bright border, and a soft highlight.
/// `n` is the normal relative to the camera.
fn matcap(color: [f32; 3], n: DVec3, openness: f32) -> [f32; 3] {
    let wrapped = narrow(n.dot(KEY.normalize())) * 0.5 + 0.5;
    let broad = 0.16 + 0.84 * wrapped * wrapped;
    let border = 1.0 - narrow(n.z.clamp(0.0, 1.0));
    let border = border * border * border * 0.35;
    let high = narrow(n.dot(DVec3::new(-0.28, 0.42, 0.86).normalize()).max(0.0));
    let high = libm::powf(high, 30.0) * 0.16;
    // Where ambient occlusion is strong, the color is warmer, like light that is reflected several times.
    let tint = [1.0, 0.97, 0.94];
    std::array::from_fn(|i| {
        let shade = openness + (1.0 - openness) * color[i] * tint[i] * 0.5;
        (color[i] * broad + border * (0.35 + 0.65 * color[i])) * shade + high
    })
}

/// Returns the unit vector in the direction of the cross product, or zero. Scales the vectors first, so that the
/// product neither overflows nor underflows.
fn unit_cross(u: DVec3, v: DVec3) -> DVec3 {
    let scaled = |w: DVec3| {
        let size = w.abs().max_element();
        if size > 0.0 { w / size } else { w }
    };
    scaled(u).cross(scaled(v)).normalize_or_zero()
}
