//! Converts the colors, textures and alpha of materials to surfaces of the rasterizer.

use std::sync::Arc;

use super::Builder;
use crate::color::narrow;
use crate::drawing::Surface;
use crate::texture::{Alpha, Texture};
use crate::{Image, PictureError};

impl Builder<'_, '_> {
    /// Converts a material to a surface. If the texture cannot be read, the surface has no texture, and a message is
    /// added to `missing`.
    ///
    /// # Errors
    ///
    /// Returns [`PictureError::Budget`] if the texture needs too much memory.
    pub(super) fn surface(&mut self, material: &scene::Material) -> Result<Surface, PictureError> {
        let [r, g, b, base] = material.base_color.map(narrow);
        // The factor for alpha, and the rule for the alpha of the texture (glTF 2.0 specification, 3.9.4).
        let (alpha, texture_alpha) = match material.alpha {
            scene::AlphaMode::Opaque => (1.0, Alpha::Ignored),
            scene::AlphaMode::Blend => (base, Alpha::Blended),
            scene::AlphaMode::Mask(cutoff) => {
                let cutoff = narrow(cutoff);
                let cutoff = if cutoff > 0.0 { cutoff / base } else { 0.0 };
                (if cutoff <= 1.0 { 1.0 } else { 0.0 }, Alpha::Cut(cutoff))
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
            match self.decode(texture, texture_alpha)? {
                Ok(decoded) => {
                    surface.texture = Some(decoded);
                    surface.uv_set = texture.uv_set as usize;
                }
                Err(why) => self.missing.push(why),
            }
        }
        Ok(surface)
    }

    /// Decodes a texture. The inner error is the reason why the texture cannot be read.
    fn decode(
        &mut self,
        texture: &scene::Texture,
        alpha: Alpha,
    ) -> Result<Result<Arc<Texture>, String>, PictureError> {
        if let Some(known) = self.textures.get(texture, alpha) {
            return Ok(Ok(known));
        }
        let (name, bytes) = match &texture.image {
            scene::Image::File(path) => match (self.images)(path) {
                Some(bytes) => (path.as_str(), bytes),
                None => return Ok(Err(format!("{path}: not found"))),
            },
            scene::Image::Loaded { path: name, bytes }
            | scene::Image::Embedded { mime: name, bytes } => (name.as_str(), bytes.to_vec()),
        };
        if let Ok([width, height]) = Image::size(&bytes) {
            let n = u64::from(width) * u64::from(height);
            let needed = self.texture_bytes + Texture::DECODING_BYTES * n;
            PictureError::check_budget(needed, self.budget)?;
            self.texture_bytes += Texture::BYTES * n;
        }
        let decoded = Texture::decode(&bytes, texture.sampler, texture.transform, alpha);
        let decoded = decoded.map(|decoded| self.textures.insert(texture, alpha, decoded));
        Ok(decoded.map_err(|why| format!("{name}: {why}")))
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

    /// Encodes a checkerboard of `n` times `n` pixels.
    fn checkerboard(n: u32, colors: [[u8; 4]; 2]) -> Vec<u8> {
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

    /// Returns a scene that contains the unit square with this material.
    fn square(material: Material) -> Scene {
        let mut mesh: Mesh = shapes::square();
        let uvs = mesh.half_edges().map(|h| mesh.position(mesh.origin(h)));
        let uvs: Vec<DVec2> = uvs.map(DVec3::truncate).collect();
        // If the material uses the second set of texture coordinates, all coordinates in the first set are 0. Then a
        // picture that uses the wrong set differs from the expected picture.
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

    /// Draws the unit square, seen from above, so that it fills a picture of `side` times `side` pixels.
    fn draw(material: Material, side: u32) -> Vec<[u8; 4]> {
        // The height that an orthographic picture shows is 2 tan(15 degrees) times the distance of the camera. If the
        // camera is at `distance`, this height is 1 unit.
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
        let (picture, missing) = picture(
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
        picture.image.pixels
    }

    /// Returns the fraction of the picture that is covered, from 0 to 1.
    fn coverage(pixels: &[[u8; 4]]) -> f64 {
        let sum: f64 = pixels.iter().map(|p| f64::from(p[3]) / 255.0).sum();
        sum / pixels.len() as f64
    }

    const MODES: [AlphaMode; 2] = [AlphaMode::Mask(0.5), AlphaMode::Blend];

    #[test]
    fn a_checkerboard_of_opaque_and_transparent_squares_covers_half_of_the_picture() {
        for mode in MODES {
            // In this picture, each square of the checkerboard has 8 x 8 pixels and sharp edges.
            let pixels = draw(
                material(checkerboard(8, [WHITE, CLEAR]), mode, Filter::Nearest),
                64,
            );
            for (i, pixel) in pixels.iter().enumerate() {
                let is_opaque = (i / 8 % 8 + i / 512) % 2 == 0;
                assert_eq!(
                    *pixel,
                    if is_opaque { WHITE } else { CLEAR },
                    "{mode:?}, pixel {i}"
                );
            }
            // Checkerboards of n times n squares, with sharp or blurred edges. The picture has 64 x 64 pixels, so if n
            // is 64 or more, a square is at most as large as a pixel.
            for n in [8, 50, 64, 100, 400, 1000] {
                for filter in [Filter::Nearest, Filter::Linear] {
                    let found = coverage(&draw(
                        material(checkerboard(n, [WHITE, CLEAR]), mode, filter),
                        64,
                    ));
                    assert!((found - 0.5).abs() < 0.015, "{mode:?}, {n}: {found}");
                }
            }
        }
    }

    #[test]
    fn squares_much_smaller_than_pixels_cover_half_of_each_pixel() {
        for mode in MODES {
            let pixels = draw(
                material(checkerboard(512, [WHITE, CLEAR]), mode, Filter::Linear),
                16,
            );
            assert!(pixels.iter().all(|p| p[3] == 128), "{mode:?}: {pixels:?}");
        }
    }

    #[test]
    fn opaque_materials_ignore_alpha() {
        let transparent = [255, 255, 255, 9];
        let mut opaque = material(
            checkerboard(8, [WHITE, transparent]),
            AlphaMode::Opaque,
            Filter::Linear,
        );
        opaque.base_color[3] = 0.2;
        assert!(draw(opaque, 32).iter().all(|p| *p == WHITE));
    }

    #[test]
    fn alpha_at_the_cutoff_is_opaque_and_alpha_below_it_is_invisible() {
        let coverage_of = |alpha: u8, base: f64, cutoff: f64| {
            let image = checkerboard(2, [[255, 255, 255, alpha], CLEAR]);
            let mut cut = material(image, AlphaMode::Mask(cutoff), Filter::Nearest);
            cut.base_color[3] = base;
            coverage(&draw(cut, 32))
        };
        let unit = |byte: u8| f64::from(byte) / 255.0;
        for b in [1, 77, 128, 254] {
            assert_eq!(coverage_of(b, 1.0, unit(b)), 0.5, "{b}");
            assert_eq!(coverage_of(b, 1.0, unit(b + 1)), 0.0, "{b}");
        }
        // The alpha of the material multiplies the alpha of the texture.
        assert_eq!(coverage_of(200, 0.5, unit(99)), 0.5);
        assert_eq!(coverage_of(200, 0.5, unit(101)), 0.0);
        assert_eq!(coverage_of(255, 0.4, 0.5), 0.0);
        assert_eq!(coverage_of(255, 1.0, 1.1), 0.0);
        // With a cutoff of 0, the surface is opaque for every alpha.
        assert_eq!(coverage_of(200, 0.0, 0.0), 1.0);
        // Without a texture, the alpha of the material is compared with the cutoff.
        for (base, expected) in [(0.49, 0.0), (0.5, 1.0), (0.9, 1.0)] {
            let mut cut = Material::new("cut");
            cut.alpha = AlphaMode::Mask(0.5);
            cut.base_color[3] = base;
            assert_eq!(coverage(&draw(cut, 8)), expected, "{base}");
        }
    }

    #[test]
    fn blended_alphas_are_multiplied() {
        let mut half = material(
            checkerboard(2, [[255, 255, 255, 128], WHITE]),
            AlphaMode::Blend,
            Filter::Nearest,
        );
        half.base_color[3] = 0.5;
        let pixels = draw(half, 32);
        // The products of the alphas are 1/4 and 1/2, so 4 or 8 of the 16 samples of each pixel are covered.
        for (i, pixel) in pixels.iter().enumerate() {
            let is_first = (i / 16 % 2 + i / 512) % 2 == 0;
            assert_eq!(pixel[3], if is_first { 64 } else { 128 }, "pixel {i}");
        }
    }

    #[test]
    fn the_color_of_invisible_pixels_does_not_bleed_into_visible_ones() {
        for mode in MODES {
            for n in [8, 50, 100, 400] {
                let pixels = draw(
                    material(checkerboard(n, [WHITE, CLEAR]), mode, Filter::Linear),
                    64,
                );
                let visible = pixels.iter().filter(|p| p[3] > 0);
                let darkest = visible.map(|p| p[0]).min();
                assert!(darkest > Some(230), "{mode:?}, {n}: {darkest:?}");
            }
        }
    }

    #[test]
    fn a_texture_is_decoded_once_for_several_drawings() {
        let scene = square(material(
            checkerboard(4, [WHITE, CLEAR]),
            AlphaMode::Blend,
            Filter::Nearest,
        ));
        let (style, overlays) = (Style::default(), Overlays::default());
        let mut textures = crate::TextureCache::default();
        let mut drawn = || {
            let images = &mut |_: &str| None;
            let built =
                crate::build_within(&scene, &style, &overlays, 1 << 20, &mut textures, images);
            built.unwrap().0.parts[0].materials[0]
                .texture
                .clone()
                .unwrap()
        };
        let [first, second] = [drawn(), drawn()];
        assert!(std::sync::Arc::ptr_eq(&first, &second));
    }

    #[test]
    fn a_texture_can_use_the_second_set_of_texture_coordinates() {
        let image = checkerboard(4, [WHITE, CLEAR]);
        let mut material = material(image, AlphaMode::Blend, Filter::Nearest);
        let with_first_set = draw(material.clone(), 32);
        if let Some(texture) = &mut material.base_color_texture {
            texture.uv_set = 1;
        }
        assert_eq!(draw(material, 32), with_first_set);
    }
}
