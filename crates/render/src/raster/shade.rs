//! The color of a triangle at a place of the picture.
//!
//! Light comes from where the photographer stands: a key light from above and from the left, a weak one
//! from the right, and a bright sky over a darker ground. Directions are those of the picture, so that every
//! view is lit alike.

use glam::{DVec2, DVec3};

use super::Look;
use super::occlusion::Occlusion;
use crate::color::{mix, narrow};
use crate::drawing::{Drawing, Part, Surface};
use crate::style::Shading;
use crate::{PictureError, View};

/// Where the key light comes from: right, upwards, towards the camera. Not of length 1.
pub(super) const KEY: DVec3 = DVec3::new(-0.45, 0.65, 0.75);
/// Where the weak light comes from.
pub(super) const FILL: DVec3 = DVec3::new(0.8, -0.05, 0.45);
/// Linear light of the key light on what faces it, of the weak one, of the sky and of the ground.
pub(super) const KEY_LIGHT: [f32; 3] = [0.84, 0.82, 0.78];
pub(super) const FILL_LIGHT: [f32; 3] = [0.09, 0.10, 0.115];
pub(super) const SKY: [f32; 3] = [0.42, 0.435, 0.46];
pub(super) const GROUND: [f32; 3] = [0.17, 0.16, 0.15];

/// What shading needs.
pub(super) struct Shader<'a> {
    pub(super) drawing: &'a Drawing<'a>,
    pub(super) view: &'a View,
    look: &'a Look,
    occlusion: Option<Occlusion>,
    /// The first triangle and the first face of each part.
    firsts: Vec<[u32; 2]>,
    /// Whether some surface is not opaque.
    pub(super) has_holes: bool,
    key: DVec3,
    fill: DVec3,
}

/// A place whose openness is known.
#[derive(Clone, Copy)]
struct Known {
    at: DVec3,
    normal: DVec3,
    open: f32,
}

/// What is remembered from one place of the picture to the next.
#[derive(Default)]
pub(super) struct Memory {
    /// The triangle that was shaded last.
    triangle: Option<(u32, Facts)>,
    /// Of the pixel that is being shaded.
    known: Option<Known>,
}

impl Memory {
    /// Forgets what only holds in one pixel.
    pub(super) fn begin_pixel(&mut self) {
        self.known = None;
    }
}

/// What is the same all over a triangle.
#[derive(Clone, Copy)]
pub(super) struct Facts {
    /// Its part, and its number in it.
    part: usize,
    triangle: usize,
    corners: [DVec3; 3],
    /// Of length 1 or 0.
    normal: DVec3,
    /// What the barycentric coordinates of the second and the third corner are products with.
    gradients: [DVec3; 2],
}

impl Facts {
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

    /// The barycentric coordinates of the place where a ray meets the plane of the triangle; `None` if it
    /// runs along the plane.
    pub(super) fn barycentric(&self, origin: DVec3, direction: DVec3) -> Option<[f64; 3]> {
        let a = self.corners[0] - origin;
        let p = direction * (self.normal.dot(a) / self.normal.dot(direction)) - a;
        let [s, t] = self.gradients.map(|g| g.dot(p));
        (s.is_finite() && t.is_finite()).then_some([1.0 - s - t, s, t])
    }
}

/// A place on a triangle.
struct Spot {
    at: DVec3,
    weights: [f32; 3],
    /// Of the triangle, on the side of the camera, of length 1 or 0.
    normal: DVec3,
    is_back: bool,
    /// Towards the camera.
    to_eye: DVec3,
}

impl<'a> Shader<'a> {
    /// `map_done` is told how many depth maps there are whenever one of them is done.
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
            has_holes: surfaces
                .into_iter()
                .any(|s| s.color[3] < 1.0 || s.texture.as_ref().is_some_and(|t| !t.is_opaque())),
            key: KEY.normalize(),
            fill: FILL.normalize(),
        })
    }

    /// The part of a triangle, and its number in it.
    pub(super) fn find(&self, id: u32) -> (usize, usize) {
        let part = self.firsts.partition_point(|first| first[0] <= id) - 1;
        (part, (id - self.firsts[part][0]) as usize)
    }

    /// The face of a triangle over all parts, one of its points, and its normal of any length.
    pub(super) fn plane(&self, id: u32) -> (u32, DVec3, DVec3) {
        let (part, triangle) = self.find(id);
        let p = &self.drawing.parts[part];
        let [a, b, c] = p.corners_at(triangle);
        let face = u32::try_from(p.face(triangle)).unwrap_or(0);
        let face = self.firsts[part][1].saturating_add(face);
        (face, a, (b - a).cross(c - a))
    }

    /// The color of a line as the tile has noted it.
    pub(super) fn line_color(&self, over: u32) -> [f32; 4] {
        let line = &self.drawing.lines[((over - 2) / 2) as usize];
        let [r, g, b, a] = line.color;
        let seen = if over & 1 == 1 { line.hidden } else { 1.0 };
        [r, g, b, a * seen]
    }

    /// Linear light of a triangle at a place of the picture.
    pub(super) fn shade(&self, id: u32, at: DVec2, memory: &mut Memory) -> [f32; 3] {
        let facts = match memory.triangle {
            Some((last, facts)) if last == id => facts,
            _ => {
                let (part, triangle) = self.find(id);
                let corners = self.drawing.parts[part].corners_at(triangle);
                let facts = Facts::new(part, triangle, corners);
                memory.triangle = Some((id, facts));
                facts
            }
        };
        let part = &self.drawing.parts[facts.part];
        let spot = self.spot(&facts, at);
        let (color, surface) = self.color(part, &facts, &spot, at);
        let is_plain = surface.is_some_and(|s| s.unlit) || self.look.shading == Shading::Plain;
        let light = if is_plain {
            color
        } else {
            let normal = normal(part, facts.triangle, &spot);
            let open = self.open(&spot, &mut memory.known);
            self.lit(color, normal, spot.to_eye, open, surface)
        };
        let emissive = surface.map_or([0.0; 3], |s| s.emissive);
        std::array::from_fn(|i| light[i] + emissive[i])
    }

    /// Where the ray through a place of the picture meets a triangle, or the nearest place in it.
    fn spot(&self, facts: &Facts, at: DVec2) -> Spot {
        let (origin, direction) = self.view.ray(at);
        let weights = facts.barycentric(origin, direction);
        let weights = weights.map_or([1.0 / 3.0; 3], |w| {
            let w = w.map(|w| w.max(0.0));
            let sum = w[0] + w[1] + w[2];
            w.map(|w| w / sum)
        });
        let [a, b, c] = facts.corners;
        let to_eye = -direction.normalize();
        let is_back = facts.normal.dot(to_eye) < 0.0;
        Spot {
            at: a * weights[0] + b * weights[1] + c * weights[2],
            weights: weights.map(narrow),
            normal: if is_back { -facts.normal } else { facts.normal },
            is_back,
            to_eye,
        }
    }

    /// How much a place sees of its surroundings, as far as the style wants it.
    fn open(&self, spot: &Spot, known: &mut Option<Known>) -> f32 {
        let Some(occlusion) = &self.occlusion else {
            return 1.0;
        };
        // The samples of a pixel are near to each other, unless one surface ends before another.
        let near = known.filter(|k| {
            let seen = self
                .view
                .see(spot.at)
                .map_or(0.0, |s| self.view.pixel(s.depth));
            k.at.distance_squared(spot.at) < 4.0 * seen * seen && k.normal.dot(spot.normal) > 0.8
        });
        let open = near.map_or_else(|| occlusion.open(spot.at, spot.normal), |k| k.open);
        *known = Some(Known {
            at: spot.at,
            normal: spot.normal,
            open,
        });
        1.0 - self.look.occlusion * (1.0 - open)
    }

    /// The color without light, and the surface.
    fn color(
        &self,
        part: &'a Part,
        facts: &Facts,
        spot: &Spot,
        at: DVec2,
    ) -> ([f32; 3], Option<&'a Surface>) {
        let triangle = facts.triangle;
        let surface = part.materials.get(surface_place(part, triangle));
        let mut color = part.colors.at(part, triangle, spot.weights);
        if let Some(s) = surface {
            color = std::array::from_fn(|i| color[i] * s.color[i]);
            if let (Some(texture), Some(uvs)) = (&s.texture, part.uvs.get(s.uv_set)) {
                let uvs = part.corners[triangle].map(|c| uvs[c as usize]);
                let place = |w: [f64; 3]| uvs[0] * w[0] + uvs[1] * w[1] + uvs[2] * w[2];
                let here = place(spot.weights.map(f64::from));
                let beside = [DVec2::X, DVec2::Y].map(|step| {
                    let (origin, direction) = self.view.ray(at + step);
                    let weights = facts.barycentric(origin, direction);
                    weights.map_or(DVec2::ZERO, |w| place(w) - here)
                });
                let texel = texture.at(here, beside);
                color = std::array::from_fn(|i| color[i] * texel[i]);
            }
        }
        if let (true, Some(back)) = (spot.is_back, part.back) {
            color = back;
        }
        if let Some(&[r, g, b, a]) = part.marks.get(part.face(triangle)) {
            color = mix(color, [r, g, b], a);
        }
        (color, surface)
    }

    /// What a surface of this color sends to the camera.
    fn lit(
        &self,
        color: [f32; 3],
        normal: DVec3,
        to_eye: DVec3,
        open: f32,
        surface: Option<&Surface>,
    ) -> [f32; 3] {
        let [x, y, z] = self.view.axes();
        let seen = |v: DVec3| DVec3::new(v.dot(x), v.dot(y), v.dot(z));
        let n = seen(normal);
        if self.look.shading == Shading::Matcap {
            return matcap(color, n, open);
        }
        let key = narrow(n.dot(self.key).max(0.0));
        let fill = narrow(n.dot(self.fill).max(0.0));
        let sky = mix(GROUND, SKY, narrow(0.5 + 0.5 * n.y));
        // Hollows are darker in the direct light too, but less: it casts no shadows.
        let direct = 0.4 + 0.6 * open;
        let light: [f32; 3] = std::array::from_fn(|i| {
            color[i] * (sky[i] * open + direct * (KEY_LIGHT[i] * key + FILL_LIGHT[i] * fill))
        });
        if self.look.shading != Shading::Phong {
            return light;
        }
        // Blinn, "Models of Light Reflection for Computer Synthesized Pictures", 1977.
        let roughness = surface.map_or(1.0, |s| s.roughness).clamp(0.0, 1.0);
        let exponent = 24.0 + 200.0 * (1.0 - roughness);
        let strength = 0.22 + 0.4 * (1.0 - roughness);
        let half = (self.key + seen(to_eye)).normalize_or_zero();
        let glint = libm::powf(narrow(n.dot(half).max(0.0)), exponent) * strength * direct;
        light.map(|c| c + glint)
    }
}

/// The normal that light falls on, of length 1.
fn normal(part: &Part, triangle: usize, spot: &Spot) -> DVec3 {
    let given = part.normals.at(part, triangle, spot.weights);
    if given == [0.0; 3] {
        return spot.normal;
    }
    let given = DVec3::from(given.map(f64::from)).normalize_or_zero();
    if given == DVec3::ZERO {
        return spot.normal;
    }
    let n = if spot.is_back { -given } else { given };
    // A smooth normal may point away from the camera where the triangle does not.
    let facing = n.dot(spot.to_eye);
    if facing < 0.0 {
        (n - spot.to_eye * facing).normalize_or(spot.normal)
    } else {
        n
    }
}

/// The color of a ball of clay in a studio where its normal is `n`: broad light from the upper left, a bright
/// border, a soft highlight.
fn matcap(color: [f32; 3], n: DVec3, open: f32) -> [f32; 3] {
    let wrapped = narrow(n.dot(KEY.normalize())) * 0.5 + 0.5;
    let broad = 0.16 + 0.84 * wrapped * wrapped;
    let border = 1.0 - narrow(n.z.clamp(0.0, 1.0));
    let border = border * border * border * 0.35;
    let high = narrow(n.dot(DVec3::new(-0.28, 0.42, 0.86).normalize()).max(0.0));
    let high = libm::powf(high, 30.0) * 0.16;
    // Light that falls into hollows comes out warmer.
    let tint = [1.0, 0.97, 0.94];
    std::array::from_fn(|i| {
        let shade = open + (1.0 - open) * color[i] * tint[i] * 0.5;
        (color[i] * broad + border * (0.35 + 0.65 * color[i])) * shade + high
    })
}

/// The place of a triangle's surface in the list of its part.
pub(super) fn surface_place(part: &Part, triangle: usize) -> usize {
    let place = part.material_of_face.get(part.face(triangle));
    place.map_or(0, |&m| m as usize)
}

/// The direction of the cross product, of length 1 or 0, also for vectors whose product is too small or too
/// large for a number.
fn unit_cross(u: DVec3, v: DVec3) -> DVec3 {
    let scaled = |w: DVec3| {
        let size = w.abs().max_element();
        if size > 0.0 { w / size } else { w }
    };
    scaled(u).cross(scaled(v)).normalize_or_zero()
}
