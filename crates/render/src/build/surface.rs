//! From materials to surfaces: colors, textures, and what alpha means.

use std::sync::Arc;

use super::Builder;
use crate::color::narrow;
use crate::drawing::Surface;
use crate::texture::{Alpha, Texture};

impl Builder<'_, '_> {
    /// How a material looks, and which texture coordinates it needs.
    pub(super) fn surface(&mut self, material: &scene::Material) -> Surface {
        let [r, g, b, base] = material.base_color.map(narrow);
        // glTF 2.0, 3.9.4: what alpha means, without a texture and in one.
        let (alpha, in_texture) = match material.alpha {
            scene::AlphaMode::Opaque => (1.0, Alpha::Ignored),
            scene::AlphaMode::Blend => (base, Alpha::Blended),
            scene::AlphaMode::Mask(cutoff) => {
                let cutoff = narrow(cutoff);
                let least = if cutoff > 0.0 { cutoff / base } else { 0.0 };
                (if least <= 1.0 { 1.0 } else { 0.0 }, Alpha::Cut(least))
            }
        };
        let strength = material.emissive_strength;
        let mut surface = Surface {
            color: [r, g, b, alpha],
            texture: None,
            uv_set: 0,
            unlit: material.unlit,
            roughness: narrow(material.roughness),
            emissive: material.emissive.map(|e| narrow(e * strength)),
        };
        if let (Some(texture), None) = (&material.base_color_texture, self.style.color) {
            match self.decoded(texture, in_texture) {
                Ok(decoded) => {
                    surface.texture = Some(Arc::new(decoded));
                    surface.uv_set = texture.uv_set as usize;
                }
                Err(why) => self.missing.push(why),
            }
        }
        surface
    }

    fn decoded(&mut self, texture: &scene::Texture, alpha: Alpha) -> Result<Texture, String> {
        let (name, bytes) = match &texture.image {
            scene::Image::File(path) => {
                let bytes = (self.images)(path).ok_or_else(|| format!("{path}: not found"))?;
                (path.as_str(), bytes)
            }
            scene::Image::Embedded { mime, bytes } => (mime.as_str(), bytes.to_vec()),
        };
        Texture::decode(&bytes, texture.sampler, texture.transform, alpha)
            .map_err(|why| format!("{name}: {why}"))
    }
}

#[cfg(test)]
mod tests {
    use geometry::shapes;
    use mesh::{Attribute, DVec2, DVec3, HalfEdgeId, Mesh, Rule};
    use scene::{AlphaMode, Filter, Image, Material, Object, Scene};

    use crate::{Background, Camera, Overlays, Projection, Shading, Style, Up, picture};

    const CLEAR: [u8; 4] = [0, 0, 0, 0];
    const WHITE: [u8; 4] = [255; 4];

    /// The bytes of a picture of `n` times `n` fields, of two colors in turn.
    fn checks(n: u32, colors: [[u8; 4]; 2]) -> Vec<u8> {
        let field = |i: u32| colors[((i % n + i / n) % 2) as usize];
        let image = crate::Image {
            width: n,
            height: n,
            pixels: (0..n * n).map(field).collect(),
        };
        image.to_png(&[]).unwrap()
    }

    fn material(image: Vec<u8>, alpha: AlphaMode, magnify: Filter) -> Material {
        let mut texture = scene::Texture::new(Image::Embedded {
            mime: "image/png".to_owned(),
            bytes: image.into(),
        });
        texture.sampler.magnify = Some(magnify);
        Material {
            base_color_texture: Some(texture),
            alpha,
            ..Material::new("checks")
        }
    }

    /// The unit square with its material.
    fn square(material: Material) -> Scene {
        let mut mesh: Mesh = shapes::square();
        let uvs = mesh.half_edges().map(|h| mesh.position(mesh.origin(h)));
        let uvs: Vec<DVec2> = uvs.map(DVec3::truncate).collect();
        // The second ones are as a material expects them, the first ones one place.
        if material
            .base_color_texture
            .as_ref()
            .is_some_and(|t| t.uv_set == 1)
        {
            mesh.set(mesh::UV, vec![DVec2::ZERO; uvs.len()]);
            mesh.set(
                Attribute::<HalfEdgeId, DVec2>::new("uv1", Rule::Interpolate),
                uvs,
            );
        } else {
            mesh.set(mesh::UV, uvs);
        }
        mesh.set(mesh::MATERIAL, vec![0]);
        let mut scene = Scene::new();
        scene
            .insert(Object {
                materials: vec![material],
                ..Object::mesh("a", mesh)
            })
            .unwrap();
        scene
    }

    /// The pixels of the unit square, `side` of them along each of its sides, seen from above.
    fn drawn(material: Material, side: u32) -> Vec<[u8; 4]> {
        // What `LookAt` shows without perspective, as its documentation says.
        let distance = 0.5 / libm::tan(15.0_f64.to_radians());
        let camera = Camera::LookAt {
            from: [0.5, 0.5, distance],
            to: [0.5, 0.5, 0.0],
            up: Up::Y,
            projection: Projection::Orthographic,
        };
        let style = Style {
            shading: Shading::Plain,
            background: Background::Transparent,
            ..Style::default()
        };
        let scene = square(material);
        let overlays = Overlays::default();
        let size = [side; 2];
        let (drawn, missing) = picture(
            &scene,
            &camera,
            &style,
            &overlays,
            size,
            1 << 30,
            &mut |_| None,
        )
        .unwrap();
        assert!(missing.is_empty(), "{missing:?}");
        drawn.image.pixels
    }

    /// How much of the picture is covered, from 0 to 1.
    fn coverage(pixels: &[[u8; 4]]) -> f64 {
        let sum: f64 = pixels.iter().map(|p| f64::from(p[3]) / 255.0).sum();
        sum / pixels.len() as f64
    }

    const MODES: [AlphaMode; 2] = [AlphaMode::Mask(0.5), AlphaMode::Blend];

    #[test]
    fn of_a_square_with_every_other_field_cut_out_half_the_pixels_are_background() {
        for mode in MODES {
            // Fields of 8 pixels: each is there, or is not.
            let pixels = drawn(
                material(checks(8, [WHITE, CLEAR]), mode, Filter::Nearest),
                64,
            );
            for (i, pixel) in pixels.iter().enumerate() {
                let is_there = (i / 8 % 8 + i / 512) % 2 == 0;
                assert_eq!(
                    *pixel,
                    if is_there { WHITE } else { CLEAR },
                    "{mode:?}, pixel {i}"
                );
            }
            // Soft, about as large as a pixel, smaller, much smaller.
            for n in [8, 50, 64, 100, 400, 1000] {
                for filter in [Filter::Nearest, Filter::Linear] {
                    let found = coverage(&drawn(
                        material(checks(n, [WHITE, CLEAR]), mode, filter),
                        64,
                    ));
                    assert!((found - 0.5).abs() < 0.015, "{mode:?}, {n}: {found}");
                }
            }
        }
    }

    #[test]
    fn from_far_away_each_pixel_is_covered_by_half() {
        for mode in MODES {
            let pixels = drawn(
                material(checks(512, [WHITE, CLEAR]), mode, Filter::Linear),
                16,
            );
            assert!(pixels.iter().all(|p| p[3] == 128), "{mode:?}: {pixels:?}");
        }
    }

    #[test]
    fn opaque_materials_ignore_alpha() {
        let see_through = [255, 255, 255, 9];
        let mut opaque = material(
            checks(8, [WHITE, see_through]),
            AlphaMode::Opaque,
            Filter::Linear,
        );
        opaque.base_color[3] = 0.2;
        assert!(drawn(opaque, 32).iter().all(|p| *p == WHITE));
    }

    #[test]
    fn alpha_at_the_cutoff_is_there_and_below_it_is_not() {
        let of = |alpha: u8, base: f64, cutoff: f64| {
            let image = checks(2, [[255, 255, 255, alpha], CLEAR]);
            let mut cut = material(image, AlphaMode::Mask(cutoff), Filter::Nearest);
            cut.base_color[3] = base;
            coverage(&drawn(cut, 32))
        };
        let byte = |b: u8| f64::from(b) / 255.0;
        for b in [1, 77, 128, 254] {
            assert_eq!(of(b, 1.0, byte(b)), 0.5, "{b}");
            assert_eq!(of(b, 1.0, byte(b + 1)), 0.0, "{b}");
        }
        // The alpha of the material multiplies that of the texture.
        assert_eq!(of(200, 0.5, byte(99)), 0.5);
        assert_eq!(of(200, 0.5, byte(101)), 0.0);
        assert_eq!(of(255, 0.4, 0.5), 0.0);
        assert_eq!(of(255, 1.0, 1.1), 0.0);
        // Everything is at least 0.
        assert_eq!(of(200, 0.0, 0.0), 1.0);
        // Without a texture.
        for (base, expected) in [(0.49, 0.0), (0.5, 1.0), (0.9, 1.0)] {
            let mut cut = Material::new("cut");
            cut.alpha = AlphaMode::Mask(0.5);
            cut.base_color[3] = base;
            assert_eq!(coverage(&drawn(cut, 8)), expected, "{base}");
        }
    }

    #[test]
    fn blended_alphas_are_multiplied() {
        let mut half = material(
            checks(2, [[255, 255, 255, 128], WHITE]),
            AlphaMode::Blend,
            Filter::Nearest,
        );
        half.base_color[3] = 0.5;
        let pixels = drawn(half, 32);
        // 4 of 16 samples, and 8 of them.
        for (i, pixel) in pixels.iter().enumerate() {
            let is_first = (i / 16 % 2 + i / 512) % 2 == 0;
            assert_eq!(pixel[3], if is_first { 64 } else { 128 }, "pixel {i}");
        }
    }

    #[test]
    fn the_color_of_what_is_cut_out_does_not_bleed_into_the_rest() {
        for mode in MODES {
            for n in [8, 50, 100, 400] {
                let pixels = drawn(
                    material(checks(n, [WHITE, CLEAR]), mode, Filter::Linear),
                    64,
                );
                let seen = pixels.iter().filter(|p| p[3] > 0);
                let darkest = seen.map(|p| p[0]).min();
                assert!(darkest > Some(230), "{mode:?}, {n}: {darkest:?}");
            }
        }
    }

    #[test]
    fn a_texture_lies_on_the_texture_coordinates_that_it_names() {
        let mut second = material(checks(4, [WHITE, CLEAR]), AlphaMode::Blend, Filter::Nearest);
        let on_first = drawn(second.clone(), 32);
        if let Some(texture) = &mut second.base_color_texture {
            texture.uv_set = 1;
        }
        assert_eq!(drawn(second, 32), on_first);
    }
}
