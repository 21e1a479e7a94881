//! Materials: from the scene to the document.

use std::sync::Arc;

use scene::{AlphaMode, Filter, Image, Material, Sampler, Texture, TextureTransform, Wrap};
use serde::Serialize;
use serde_json::{Map, Value, json};

use super::materials::{has_scheme, rounded};
use super::surface::{
    AlphaJson, Extensions, ImageJson, InfoJson, MaterialJson, PbrJson, STRENGTH, SamplerJson,
    TRANSFORM, TextureJson, TransformJson, UNLIT,
};
use super::write::percent_encoded;
use crate::loss::Losses;

/// The materials, textures, samplers and images of a document, each once.
#[derive(Default)]
pub(super) struct MaterialWriter {
    /// The scene's materials that `materials` stand for, with how many texture coordinates they need not
    /// more than.
    known: Vec<Material>,
    materials: Vec<MaterialJson>,
    textures: Vec<TextureJson>,
    samplers: Vec<SamplerJson>,
    known_images: Vec<Image>,
    images: Vec<ImageJson>,
    /// Pictures whose bytes have no view yet.
    pictures: Vec<(usize, Arc<[u8]>)>,
    extensions: [bool; 3],
}

impl MaterialWriter {
    /// The place of a material in the document, for a mesh with `n_uvs` sets of texture coordinates.
    /// Objects share it if all of it is the same.
    pub(super) fn place(&mut self, material: &Material, n_uvs: u32, losses: &mut Losses) -> usize {
        let mut material = material.clone();
        let reason = "the mesh has no such texture coordinates: the texture is not written";
        let dropped = drop_textures(&mut material, |texture| texture.uv_set < n_uvs);
        losses.add(None, &material.name, dropped, reason);
        let reason = "glTF holds PNG and JPEG: the texture is not written";
        let dropped = drop_textures(&mut material, |texture| match &texture.image {
            Image::File(_) => true,
            Image::Embedded { mime, .. } => matches!(mime.as_str(), "image/png" | "image/jpeg"),
        });
        losses.add(None, &material.name, dropped, reason);
        if material.unlit && material.emissive_strength != 1.0 {
            material.emissive_strength = 1.0;
            let reason = "an unlit material has no strength of its own light: not written";
            losses.add(None, &material.name, 1, reason);
        }
        if let Some(place) = self.known.iter().position(|known| *known == material) {
            return place;
        }
        let mut changed = 0;
        let json = self.json(&material, &mut changed);
        let reason = "values outside of what glTF allows: written as the nearest inside";
        losses.add(None, &material.name, changed, reason);
        self.materials.push(json);
        self.known.push(material);
        self.materials.len() - 1
    }

    /// Pictures that need a view: the place of each in the document, and its bytes.
    pub(super) fn take_pictures(&mut self) -> Vec<(usize, Arc<[u8]>)> {
        std::mem::take(&mut self.pictures)
    }

    /// Says where the bytes of a picture lie.
    pub(super) fn set_view(&mut self, image: usize, view: usize) {
        self.images[image].buffer_view = Some(view);
    }

    /// Adds everything to the document.
    pub(super) fn insert_into(self, document: &mut Map<String, Value>) {
        let mut insert = |key: &str, values: Vec<Value>| {
            if !values.is_empty() {
                document.insert(key.to_owned(), Value::Array(values));
            }
        };
        let names = [TRANSFORM, STRENGTH, UNLIT];
        let used = names.iter().zip(self.extensions).filter(|&(_, is)| is);
        insert(
            "extensionsUsed",
            used.map(|(name, _)| json!(name)).collect(),
        );
        insert("materials", values(&self.materials));
        insert("textures", values(&self.textures));
        insert("samplers", values(&self.samplers));
        insert("images", values(&self.images));
    }

    fn json(&mut self, material: &Material, changed: &mut usize) -> MaterialJson {
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
        let occlusion_strength = unit(material.occlusion_strength);
        let normal_scale = within(material.normal_scale, f64::MIN, f64::MAX, changed);
        let (alpha_mode, alpha_cutoff) = match material.alpha {
            AlphaMode::Opaque => (None, None),
            AlphaMode::Mask(cutoff) => {
                let cutoff = within(cutoff, 0.0, f64::MAX, changed);
                (Some(AlphaJson::Mask), Some(cutoff))
            }
            AlphaMode::Blend => (Some(AlphaJson::Blend), None),
        };
        MaterialJson {
            name: Some(material.name.clone()),
            pbr_metallic_roughness: Some(PbrJson {
                base_color_factor: (base_color != plain.base_color).then_some(base_color),
                base_color_texture: self.info(material.base_color_texture.as_ref()),
                // The default of glTF is metal.
                metallic_factor: Some(metallic),
                roughness_factor: Some(roughness),
                metallic_roughness_texture: self.info(material.metallic_roughness_texture.as_ref()),
            }),
            normal_texture: self
                .info(material.normal_texture.as_ref())
                .map(|info| InfoJson {
                    scale: (normal_scale != 1.0).then_some(normal_scale),
                    ..info
                }),
            occlusion_texture: self.info(material.occlusion_texture.as_ref()).map(|info| {
                InfoJson {
                    strength: (occlusion_strength != 1.0).then_some(occlusion_strength),
                    ..info
                }
            }),
            emissive_texture: self.info(material.emissive_texture.as_ref()),
            emissive_factor: (emissive != plain.emissive).then_some(emissive),
            alpha_mode,
            alpha_cutoff,
            double_sided: material.double_sided,
            extensions,
        }
    }

    fn info(&mut self, texture: Option<&Texture>) -> Option<InfoJson> {
        let texture = texture?;
        let mut extensions = Extensions::new();
        if texture.transform != TextureTransform::default() {
            let TextureTransform {
                offset,
                rotation,
                scale,
            } = texture.transform;
            let finite = |x: f64| if x.is_nan() { 0.0 } else { rounded(x) };
            let json = TransformJson {
                offset: (offset != [0.0; 2]).then_some(offset.map(finite)),
                rotation: (rotation != 0.0).then_some(finite(rotation)),
                scale: (scale != [1.0; 2]).then_some(scale.map(finite)),
                tex_coord: None,
            };
            extensions.insert(TRANSFORM.to_owned(), value(&json));
            self.extensions[0] = true;
        }
        let sampler = (texture.sampler != Sampler::default()).then(|| {
            let json = sampler(texture.sampler);
            place_of(&mut self.samplers, json)
        });
        let source = Some(self.image(&texture.image));
        Some(InfoJson {
            index: place_of(&mut self.textures, TextureJson { sampler, source }),
            tex_coord: texture.uv_set,
            extensions,
            ..InfoJson::default()
        })
    }

    fn image(&mut self, image: &Image) -> usize {
        if let Some(place) = self
            .known_images
            .iter()
            .position(|known| same(known, image))
        {
            return place;
        }
        let place = self.images.len();
        self.known_images.push(image.clone());
        self.images.push(match image {
            Image::File(path) => ImageJson {
                uri: Some(uri(path)),
                ..ImageJson::default()
            },
            Image::Embedded { mime, bytes } => {
                self.pictures.push((place, bytes.clone()));
                ImageJson {
                    mime_type: Some(mime.clone()),
                    ..ImageJson::default()
                }
            }
        });
        place
    }
}

/// Takes away the textures that are not to be kept; returns how many.
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

/// Whether two pictures are the same, without a look at bytes that are shared.
fn same(a: &Image, b: &Image) -> bool {
    match (a, b) {
        (Image::Embedded { mime: s, bytes: a }, Image::Embedded { mime: t, bytes: b }) => {
            s == t && (Arc::ptr_eq(a, b) || a == b)
        }
        _ => a == b,
    }
}

fn sampler(sampler: Sampler) -> SamplerJson {
    use Filter::{Linear, Nearest};
    let wrap = |wrap| match wrap {
        Wrap::Repeat => None,
        Wrap::Mirror => Some(33648),
        Wrap::Clamp => Some(33071),
    };
    let [wrap_s, wrap_t] = sampler.wrap.map(wrap);
    SamplerJson {
        mag_filter: sampler.magnify.map(|filter| match filter {
            Nearest => 9728,
            Linear => 9729,
        }),
        min_filter: match (sampler.minify, sampler.mipmap) {
            (None, None) => None,
            (Some(Nearest), None) => Some(9728),
            (Some(Linear), None) => Some(9729),
            (Some(Nearest), Some(Nearest)) => Some(9984),
            (Some(Linear) | None, Some(Nearest)) => Some(9985),
            (Some(Nearest), Some(Linear)) => Some(9986),
            (Some(Linear) | None, Some(Linear)) => Some(9987),
        },
        wrap_s,
        wrap_t,
    }
}

/// The URI of a picture; one with a scheme is one already.
fn uri(path: &str) -> String {
    if has_scheme(path) {
        return path.to_owned();
    }
    let parts: Vec<String> = path.split(['/', '\\']).map(percent_encoded).collect();
    parts.join("/")
}

/// `x` between two numbers, with 32 bits; `changed` counts what is not there already.
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

fn values<T: Serialize>(all: &[T]) -> Vec<Value> {
    all.iter().map(value).collect()
}

fn value<T: Serialize>(x: &T) -> Value {
    serde_json::to_value(x).unwrap_or_default()
}
