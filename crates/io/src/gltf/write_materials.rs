//! Materials: from the scene to the document.

use std::sync::Arc;

use scene::{AlphaMode, Filter, Image, Material, Sampler, Texture, TextureTransform, Wrap};
use serde_json::{Map, Value, json};

use super::materials::{has_scheme, rounded};
use super::surface::{STRENGTH, TRANSFORM, UNLIT};
use crate::assets::percent_encoded;
use crate::loss::Losses;

/// The materials, textures, samplers and images of a document, each once.
#[derive(Default)]
pub(super) struct MaterialWriter {
    /// The scene's materials that `materials` stand for, with how many texture coordinates they need not
    /// more than.
    known: Vec<Material>,
    materials: Vec<Value>,
    textures: Vec<Value>,
    samplers: Vec<Value>,
    known_images: Vec<Image>,
    images: Vec<Value>,
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
        self.images[image]["bufferView"] = view.into();
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
        insert("materials", self.materials);
        insert("textures", self.textures);
        insert("samplers", self.samplers);
        insert("images", self.images);
    }

    fn json(&mut self, material: &Material, changed: &mut usize) -> Value {
        let plain = Material::new("");
        let mut extensions = Map::new();
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
            AlphaMode::Mask(cutoff) => (Some("MASK"), Some(within(cutoff, 0.0, f64::MAX, changed))),
            AlphaMode::Blend => (Some("BLEND"), None),
        };
        let mut texture = |texture: &Option<Texture>, number: &str, value: f64| {
            let number = (number, (value != 1.0).then(|| value.into()));
            texture.as_ref().map(|texture| self.info(texture, number))
        };
        let pbr = object([
            (
                "baseColorFactor",
                (base_color != plain.base_color).then(|| json!(base_color)),
            ),
            (
                "baseColorTexture",
                texture(&material.base_color_texture, "", 1.0),
            ),
            // The default of glTF is metal.
            ("metallicFactor", Some(metallic.into())),
            ("roughnessFactor", Some(roughness.into())),
            (
                "metallicRoughnessTexture",
                texture(&material.metallic_roughness_texture, "", 1.0),
            ),
        ]);
        object([
            ("name", Some(json!(material.name))),
            ("pbrMetallicRoughness", Some(pbr)),
            (
                "normalTexture",
                texture(&material.normal_texture, "scale", scale),
            ),
            (
                "occlusionTexture",
                texture(&material.occlusion_texture, "strength", strength),
            ),
            (
                "emissiveTexture",
                texture(&material.emissive_texture, "", 1.0),
            ),
            (
                "emissiveFactor",
                (emissive != plain.emissive).then(|| json!(emissive)),
            ),
            ("alphaMode", alpha_mode.map(Value::from)),
            ("alphaCutoff", alpha_cutoff.map(Value::from)),
            ("doubleSided", material.double_sided.then_some(true.into())),
            (
                "extensions",
                (!extensions.is_empty()).then_some(extensions.into()),
            ),
        ])
    }

    /// What a material says of a texture, with a number of its own.
    fn info(&mut self, texture: &Texture, number: (&str, Option<Value>)) -> Value {
        let transform = texture.transform;
        let extensions = (transform != TextureTransform::default()).then(|| {
            let TextureTransform {
                offset,
                rotation,
                scale,
            } = transform;
            let finite = |x: f64| if x.is_nan() { 0.0 } else { rounded(x) };
            self.extensions[0] = true;
            let json = object([
                (
                    "offset",
                    (offset != [0.0; 2]).then(|| json!(offset.map(finite))),
                ),
                (
                    "rotation",
                    (rotation != 0.0).then(|| finite(rotation).into()),
                ),
                (
                    "scale",
                    (scale != [1.0; 2]).then(|| json!(scale.map(finite))),
                ),
            ]);
            json!({ TRANSFORM: json })
        });
        let sampler = (texture.sampler != Sampler::default())
            .then(|| place_of(&mut self.samplers, sampler(texture.sampler)));
        let source = self.image(&texture.image);
        let json = object([
            ("sampler", sampler.map(Value::from)),
            ("source", Some(source.into())),
        ]);
        object([
            ("index", Some(place_of(&mut self.textures, json).into())),
            (
                "texCoord",
                (texture.uv_set != 0).then(|| texture.uv_set.into()),
            ),
            number,
            ("extensions", extensions),
        ])
    }

    fn image(&mut self, image: &Image) -> usize {
        let mut known = self.known_images.iter();
        if let Some(place) = known.position(|known| same(known, image)) {
            return place;
        }
        let place = self.images.len();
        self.known_images.push(image.clone());
        self.images.push(match image {
            Image::File(path) => json!({ "uri": uri(path) }),
            Image::Embedded { mime, bytes } => {
                self.pictures.push((place, bytes.clone()));
                json!({ "mimeType": mime })
            }
        });
        place
    }
}

/// A JSON object with the members that have a value.
fn object<const N: usize>(members: [(&str, Option<Value>); N]) -> Value {
    let there = members
        .into_iter()
        .filter_map(|(key, value)| Some((key.to_owned(), value?)));
    Value::Object(there.collect())
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

fn sampler(sampler: Sampler) -> Value {
    use Filter::{Linear, Nearest};
    let wrap = |wrap| match wrap {
        Wrap::Repeat => None,
        Wrap::Mirror => Some(33648.into()),
        Wrap::Clamp => Some(33071.into()),
    };
    let [wrap_s, wrap_t] = sampler.wrap.map(wrap);
    let magnify = sampler.magnify.map(|filter| match filter {
        Nearest => 9728,
        Linear => 9729,
    });
    let minify = match (sampler.minify, sampler.mipmap) {
        (None, None) => None,
        (Some(Nearest), None) => Some(9728),
        (Some(Linear), None) => Some(9729),
        (Some(Nearest), Some(Nearest)) => Some(9984),
        (Some(Linear) | None, Some(Nearest)) => Some(9985),
        (Some(Nearest), Some(Linear)) => Some(9986),
        (Some(Linear) | None, Some(Linear)) => Some(9987),
    };
    object([
        ("magFilter", magnify.map(Value::from)),
        ("minFilter", minify.map(Value::from)),
        ("wrapS", wrap_s),
        ("wrapT", wrap_t),
    ])
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

fn place_of(all: &mut Vec<Value>, one: Value) -> usize {
    all.iter()
        .position(|known| *known == one)
        .unwrap_or_else(|| {
            all.push(one);
            all.len() - 1
        })
}
