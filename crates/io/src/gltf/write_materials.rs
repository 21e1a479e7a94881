//! Converts materials of the scene to materials of the document.

use std::sync::Arc;

use scene::{AlphaMode, Filter, Image, Material, Sampler, Texture, TextureTransform};
use serde_json::json;

use super::extras::parsed;
use super::materials::{has_scheme, rounded};
use super::surface::{
    AlphaJson, Extensions, FILTERS, ImageJson, InfoJson, MaterialJson, PbrJson, STRENGTH,
    SamplerJson, TRANSFORM, TextureJson, TransformJson, UNLIT, WRAPS,
};
use crate::assets::percent_encoded;
use crate::error::Unwritable;
use crate::loss::Losses;

/// The materials, textures, samplers and images of a document, without duplicates.
#[derive(Default)]
pub(super) struct MaterialWriter {
    /// For each element of `materials`, the material of the scene from which it was made. Textures that are not written
    /// are removed from these materials.
    known: Vec<Material>,
    pub(super) materials: Vec<MaterialJson>,
    pub(super) textures: Vec<TextureJson>,
    pub(super) samplers: Vec<SamplerJson>,
    /// For each element of `images`, the image of the scene and its name.
    known_images: Vec<(Image, Option<String>)>,
    pub(super) images: Vec<ImageJson>,
    /// The images whose bytes do not have a view yet. Each entry consists of the index of an image and its bytes.
    pub(super) image_bytes: Vec<(usize, Arc<[u8]>)>,
    extensions: [bool; 3],
}

impl MaterialWriter {
    /// Returns the index of a material in the document, and adds the material if no equal material exists yet. `n_uvs`
    /// says how many sets of texture coordinates the mesh with this material has. Textures that need other sets are not
    /// written.
    ///
    /// # Errors
    ///
    /// Returns an error if the extras of the material are not JSON.
    pub(super) fn index_of(
        &mut self,
        material: &Material,
        n_uvs: u32,
        losses: &mut Losses,
    ) -> Result<usize, Unwritable> {
        let mut material = material.clone();
        let reason = "the mesh does not have the texture coordinates of this texture, so the texture is not written";
        let dropped = drop_textures(&mut material, |texture| texture.uv_set < n_uvs);
        losses.add(None, &material.name, dropped, reason);
        let reason = "glTF can embed only PNG and JPEG images, so the texture is not written";
        let dropped = drop_textures(&mut material, |texture| match &texture.image {
            Image::File(_) | Image::Loaded { .. } => true,
            Image::Embedded { mime, .. } => matches!(mime.as_str(), "image/png" | "image/jpeg"),
        });
        losses.add(None, &material.name, dropped, reason);
        if material.unlit && material.emissive_strength != 1.0 {
            material.emissive_strength = 1.0;
            let reason = "unlit materials cannot have an emissive strength, so it is not written";
            losses.add(None, &material.name, 1, reason);
        }
        if let Some(place) = self.known.iter().position(|known| *known == material) {
            return Ok(place);
        }
        let mut changed = 0;
        let json = self.json(&material, &mut changed)?;
        let reason = "values outside the range of glTF are clamped";
        losses.add(None, &material.name, changed, reason);
        self.materials.push(json);
        self.known.push(material);
        Ok(self.materials.len() - 1)
    }

    /// The names of the extensions that the materials use.
    pub(super) fn extensions(&self) -> Vec<&'static str> {
        let all = [TRANSFORM, STRENGTH, UNLIT]
            .into_iter()
            .zip(self.extensions);
        all.filter(|&(_, is)| is).map(|(name, _)| name).collect()
    }

    fn json(
        &mut self,
        material: &Material,
        changed: &mut usize,
    ) -> Result<MaterialJson, Unwritable> {
        let plain = Material::new("");
        let mut extensions = Extensions::new();
        let strength = within(material.emissive_strength, 0.0, f64::MAX, changed);
        if strength != plain.emissive_strength {
            extensions.insert(STRENGTH.to_owned(), json!({ "emissiveStrength": strength }));
            self.extensions[1] = true;
        }
        if material.unlit {
            extensions.insert(UNLIT.to_owned(), json!({}));
            self.extensions[2] = true;
        }
        let mut unit = |x: f64| within(x, 0.0, 1.0, changed);
        let base_color = material.base_color.map(&mut unit);
        let emissive = material.emissive.map(&mut unit);
        let [metallic, roughness] = [material.metallic, material.roughness].map(&mut unit);
        let strength = unit(material.occlusion_strength);
        let scale = within(material.normal_scale, f64::MIN, f64::MAX, changed);
        let (alpha_mode, alpha_cutoff) = match material.alpha {
            AlphaMode::Opaque => (None, None),
            AlphaMode::Mask(cutoff) => {
                let cutoff = within(cutoff, 0.0, f64::MAX, changed);
                (Some(AlphaJson::Mask), Some(cutoff))
            }
            AlphaMode::Blend => (Some(AlphaJson::Blend), None),
        };
        let mut texture = |texture: &Option<Texture>| texture.as_ref().map(|t| self.info(t));
        let pbr = PbrJson {
            base_color_factor: (base_color != plain.base_color).then_some(base_color),
            base_color_texture: texture(&material.base_color_texture),
            // The metallic factor is always written, because its default in glTF is 1.
            metallic_factor: Some(metallic),
            roughness_factor: Some(roughness),
            metallic_roughness_texture: texture(&material.metallic_roughness_texture),
        };
        let extras = material.extras.as_deref().map(parsed).transpose()?;
        Ok(MaterialJson {
            name: Some(material.name.clone()),
            pbr_metallic_roughness: Some(pbr),
            normal_texture: texture(&material.normal_texture).map(|info| InfoJson {
                scale: (scale != 1.0).then_some(scale),
                ..info
            }),
            occlusion_texture: texture(&material.occlusion_texture).map(|info| InfoJson {
                strength: (strength != 1.0).then_some(strength),
                ..info
            }),
            emissive_texture: texture(&material.emissive_texture),
            emissive_factor: (emissive != plain.emissive).then_some(emissive),
            alpha_mode,
            alpha_cutoff,
            double_sided: material.double_sided.then_some(true),
            extensions,
            extras: extras.map(Box::new),
        })
    }

    /// Returns the reference from a material to a texture.
    fn info(&mut self, texture: &Texture) -> InfoJson {
        let TextureTransform {
            offset,
            rotation,
            scale,
        } = texture.transform;
        let mut extensions = Extensions::new();
        if texture.transform != TextureTransform::default() {
            let finite = |x: f64| if x.is_nan() { 0.0 } else { rounded(x) };
            let transform = TransformJson {
                offset: (offset != [0.0; 2]).then(|| offset.map(finite)),
                rotation: (rotation != 0.0).then(|| finite(rotation)),
                scale: (scale != [1.0; 2]).then(|| scale.map(finite)),
                tex_coord: None,
            };
            extensions.insert(TRANSFORM.to_owned(), json!(transform));
            self.extensions[0] = true;
        }
        let names = &texture.names;
        let sampler = SamplerJson {
            name: names.sampler.clone(),
            ..sampler(texture.sampler)
        };
        let json = TextureJson {
            name: names.texture.clone(),
            sampler: (sampler != SamplerJson::default())
                .then(|| place_of(&mut self.samplers, sampler)),
            source: Some(self.image(&texture.image, names.image.as_ref())),
        };
        InfoJson {
            index: place_of(&mut self.textures, json),
            tex_coord: Some(texture.uv_set).filter(|&set| set != 0),
            extensions,
            ..InfoJson::default()
        }
    }

    fn image(&mut self, image: &Image, name: Option<&String>) -> usize {
        let mut known = self.known_images.iter();
        let is_it = |(other, other_name): &(Image, Option<String>)| {
            other_name.as_ref() == name && same(other, image)
        };
        if let Some(place) = known.position(is_it) {
            return place;
        }
        let place = self.images.len();
        self.known_images.push((image.clone(), name.cloned()));
        let mut json = ImageJson {
            name: name.cloned(),
            ..ImageJson::default()
        };
        match image {
            Image::File(path) | Image::Loaded { path, .. } => json.uri = Some(uri(path)),
            Image::Embedded { mime, bytes } => {
                self.image_bytes.push((place, bytes.clone()));
                json.mime_type = Some(mime.clone());
            }
        }
        self.images.push(json);
        place
    }
}

/// Removes the textures for which `keep` returns false, and returns the number of removed textures.
fn drop_textures(material: &mut Material, keep: impl Fn(&Texture) -> bool) -> usize {
    let textures = [
        &mut material.base_color_texture,
        &mut material.metallic_roughness_texture,
        &mut material.normal_texture,
        &mut material.occlusion_texture,
        &mut material.emissive_texture,
    ];
    let drop = |texture: &mut Option<Texture>| {
        let is = texture.as_ref().is_some_and(|texture| !keep(texture));
        if is {
            *texture = None;
        }
        usize::from(is)
    };
    textures.map(drop).iter().sum()
}

/// Whether two images are equal. If both images share their bytes in memory, the bytes are not compared.
fn same(a: &Image, b: &Image) -> bool {
    match (a, b) {
        (Image::Embedded { mime: s, bytes: a }, Image::Embedded { mime: t, bytes: b }) => {
            s == t && (Arc::ptr_eq(a, b) || a == b)
        }
        _ => a == b,
    }
}

fn sampler(sampler: Sampler) -> SamplerJson {
    let filter = |pair| FILTERS.iter().find(|(_, known)| *known == pair);
    let wrap = |wrap| WRAPS[1..].iter().find(|(_, known)| *known == wrap);
    let minify = sampler.minify.or(sampler.mipmap.and(Some(Filter::Linear)));
    SamplerJson {
        name: None,
        mag_filter: filter((sampler.magnify, None)).map(|&(number, _)| number),
        min_filter: filter((minify, sampler.mipmap)).map(|&(number, _)| number),
        wrap_s: wrap(sampler.wrap[0]).map(|&(number, _)| number),
        wrap_t: wrap(sampler.wrap[1]).map(|&(number, _)| number),
    }
}

/// The URI of an image file. A path with a scheme is already a URI.
fn uri(path: &str) -> String {
    if has_scheme(path) {
        return path.to_owned();
    }
    let parts: Vec<String> = path.split(['/', '\\']).map(percent_encoded).collect();
    parts.join("/")
}

/// Clamps `x` to a range and rounds it to 32 bits. If `x` is outside the range, increases `changed` by 1.
fn within(x: f64, low: f64, high: f64, changed: &mut usize) -> f64 {
    let inside = if x.is_nan() {
        high.min(1.0)
    } else {
        x.clamp(low, high)
    };
    *changed += usize::from(inside != x);
    rounded(inside)
}

fn place_of<T: PartialEq>(all: &mut Vec<T>, one: T) -> usize {
    all.iter()
        .position(|known| *known == one)
        .unwrap_or_else(|| {
            all.push(one);
            all.len() - 1
        })
}
