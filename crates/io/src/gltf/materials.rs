//! Converts materials of the document to materials of the scene.

use std::collections::BTreeMap;
use std::sync::Arc;

use scene::{AlphaMode, Image, Material, Sampler, Texture, TextureNames, TextureTransform};
use serde::Deserialize;
use serde_json::Value;

use super::buffers::data_uri;
use super::document::Document;
use super::reference::get;
use super::surface::{
    AlphaJson, Extensions, FILTERS, ImageJson, InfoJson, STRENGTH, SamplerJson, TRANSFORM,
    TransformJson, UNLIT, WRAPS,
};
use super::views::Reader;
use crate::fault::Fault;
use crate::images::sniffed;

/// Converts materials, and loads each image once.
pub(super) struct Materials<'a> {
    reader: &'a Reader<'a>,
    images: BTreeMap<usize, Option<Image>>,
    known: BTreeMap<usize, Material>,
}

impl<'a> Materials<'a> {
    pub(super) fn new(reader: &'a Reader<'a>) -> Self {
        Self {
            reader,
            images: BTreeMap::new(),
            known: BTreeMap::new(),
        }
    }

    /// Converts material `i` of the document. The material must exist.
    ///
    /// # Errors
    ///
    /// Returns an error if the material refers to a texture, image, sampler or bytes that do not exist, or if a value
    /// is invalid.
    pub(super) fn get(&mut self, i: usize) -> Result<Material, Fault> {
        if let Some(known) = self.known.get(&i) {
            return Ok(known.clone());
        }
        let reader = self.reader;
        let from = &reader.document.materials[i];
        let here = format!("/materials/{i}");
        let mut to = Material::new(material_name(reader.document, i));
        let pbr = from.pbr_metallic_roughness.clone().unwrap_or_default();
        to.base_color = pbr.base_color_factor.unwrap_or([1.0; 4]).map(unit);
        to.metallic = unit(pbr.metallic_factor.unwrap_or(1.0));
        to.roughness = unit(pbr.roughness_factor.unwrap_or(1.0));
        let mut texture = |info: &Option<InfoJson>, name: &str| match info {
            None => Ok(None),
            Some(info) => self.texture(info, &format!("{here}/{name}")),
        };
        let at = "pbrMetallicRoughness/baseColorTexture";
        to.base_color_texture = texture(&pbr.base_color_texture, at)?;
        let at = "pbrMetallicRoughness/metallicRoughnessTexture";
        to.metallic_roughness_texture = texture(&pbr.metallic_roughness_texture, at)?;
        to.normal_texture = texture(&from.normal_texture, "normalTexture")?;
        to.occlusion_texture = texture(&from.occlusion_texture, "occlusionTexture")?;
        to.emissive_texture = texture(&from.emissive_texture, "emissiveTexture")?;
        // The scale of a normal texture and the strength of an occlusion texture keep their defaults if the texture was
        // not read.
        if let (Some(info), Some(_)) = (&from.normal_texture, &to.normal_texture) {
            to.normal_scale = rounded(info.scale.unwrap_or(1.0));
        }
        if let (Some(info), Some(_)) = (&from.occlusion_texture, &to.occlusion_texture) {
            to.occlusion_strength = unit(info.strength.unwrap_or(1.0));
        }
        to.emissive = from.emissive_factor.unwrap_or([0.0; 3]).map(unit);
        if let Some(strength) = from.extensions.get(STRENGTH) {
            let strength = strength.get("emissiveStrength").and_then(Value::as_f64);
            to.emissive_strength = rounded(strength.unwrap_or(1.0).max(0.0));
        }
        to.alpha = match from.alpha_mode {
            None | Some(AlphaJson::Opaque) => AlphaMode::Opaque,
            Some(AlphaJson::Mask) => {
                AlphaMode::Mask(rounded(from.alpha_cutoff.unwrap_or(0.5).max(0.0)))
            }
            Some(AlphaJson::Blend) => AlphaMode::Blend,
        };
        to.double_sided = from.double_sided.unwrap_or_default();
        to.unlit = from.extensions.contains_key(UNLIT);
        to.extras = from.extras.as_ref().map(ToString::to_string);
        self.known.insert(i, to.clone());
        Ok(to)
    }

    fn texture(&mut self, info: &InfoJson, here: &str) -> Result<Option<Texture>, Fault> {
        let document = self.reader.document;
        let pointer = format_args!("{here}/index");
        let texture = get(&document.textures, info.index, pointer, "texture")?;
        let at = format!("/textures/{}", info.index);
        let mut names = TextureNames {
            texture: texture.name.clone(),
            ..TextureNames::default()
        };
        let image = match texture.source {
            None => None,
            Some(source) => {
                let pointer = format_args!("{at}/source");
                let image = get(&document.images, source, pointer, "image")?;
                names.image.clone_from(&image.name);
                if !self.images.contains_key(&source) {
                    let loaded = self.image(image, &format!("/images/{source}"))?;
                    self.images.insert(source, loaded);
                }
                self.images[&source].clone()
            }
        };
        let Some(image) = image else {
            return Ok(None);
        };
        let sampler = match texture.sampler {
            None => Sampler::default(),
            Some(sampler) => {
                let pointer = format_args!("{at}/sampler");
                let from = get(&document.samplers, sampler, pointer, "sampler")?;
                names.sampler.clone_from(&from.name);
                to_sampler(from, &format!("/samplers/{sampler}"))?
            }
        };
        let (transform, uv_set) = transform(&info.extensions, here)?;
        Ok(Some(Texture {
            image,
            uv_set: uv_set.or(info.tex_coord).unwrap_or(0),
            sampler,
            transform,
            names,
        }))
    }

    fn image(&self, from: &ImageJson, here: &str) -> Result<Option<Image>, Fault> {
        let (given, bytes): (Option<&str>, Arc<[u8]>) = match (&from.uri, from.buffer_view) {
            (Some(uri), _) => match uri.strip_prefix("data:") {
                None => return Ok(Some(Image::File(decoded(uri)))),
                Some(data) => {
                    let (mime, bytes) = data_uri(data, &format!("{here}/uri"))?;
                    (Some(mime), bytes.into())
                }
            },
            (None, Some(view)) => {
                let bytes = self.reader.view(view, format_args!("{here}/bufferView"))?;
                self.reader.budget.spend(bytes.len() as u64, here)?;
                (None, bytes.into())
            }
            (None, None) => return Ok(None),
        };
        let mime = from.mime_type.as_deref().or(given);
        let mime = mime.filter(|mime| !mime.is_empty());
        let unknown = "application/octet-stream";
        let mime = mime
            .or_else(|| sniffed(&bytes))
            .unwrap_or(unknown)
            .to_owned();
        Ok(Some(Image::Embedded { mime, bytes }))
    }
}

/// The name of material `i` of the document. The material must exist.
pub(super) fn material_name(document: &Document, i: usize) -> String {
    let name = document.materials[i].name.clone();
    name.unwrap_or_else(|| format!("material {i}"))
}

/// Returns the paths of the image files that material `i` of the document refers to, in the order in which the reader
/// reads them.
pub(super) fn image_paths(document: &Document, i: usize) -> Vec<String> {
    let path = |info: &InfoJson| {
        let source = document.textures.get(info.index)?.source?;
        let uri = document.images.get(source)?.uri.as_deref()?;
        (!uri.starts_with("data:")).then(|| decoded(uri))
    };
    document.materials[i].textures().filter_map(path).collect()
}

/// Decodes a URI reference to a path. A URI with a scheme is returned unchanged.
fn decoded(uri: &str) -> String {
    if has_scheme(uri) {
        return uri.to_owned();
    }
    crate::assets::percent_decoded(uri).unwrap_or_else(|| uri.to_owned())
}

/// Whether a string begins with the scheme of a URI. A single letter before a colon is a Windows drive, not a scheme.
pub(super) fn has_scheme(uri: &str) -> bool {
    uri.split_once(':').is_some_and(|(scheme, _)| {
        let is_fine = |c: char| c.is_ascii_alphanumeric() || "+-.".contains(c);
        let begins = scheme.starts_with(|c: char| c.is_ascii_alphabetic());
        scheme.len() > 1 && begins && scheme.chars().all(is_fine)
    })
}

fn to_sampler(from: &SamplerJson, here: &str) -> Result<Sampler, Fault> {
    fn known<T: Copy>(list: &[(u32, T)], number: u32, pointer: String) -> Result<T, Fault> {
        let found = list.iter().find(|(known, _)| *known == number);
        found.map(|&(_, value)| value).ok_or_else(|| {
            let message = format!("unknown value {number}");
            Fault::json(pointer, message)
        })
    }
    let filter = |number: Option<u32>, list: &[_], name: &str| match number {
        None => Ok((None, None)),
        Some(number) => known(list, number, format!("{here}/{name}")),
    };
    let wrap = |number: Option<u32>, name: &str| {
        known(
            &WRAPS,
            number.unwrap_or(WRAPS[0].0),
            format!("{here}/{name}"),
        )
    };
    let (minify, mipmap) = filter(from.min_filter, &FILTERS, "minFilter")?;
    let (magnify, _) = filter(from.mag_filter, &FILTERS[..2], "magFilter")?;
    Ok(Sampler {
        wrap: [wrap(from.wrap_s, "wrapS")?, wrap(from.wrap_t, "wrapT")?],
        magnify,
        minify,
        mipmap,
    })
}

/// Returns the transform of a texture according to the extension. Also returns the index of the texture coordinate set
/// that the extension selects, or `None` if it selects no set.
fn transform(
    extensions: &Extensions,
    here: &str,
) -> Result<(TextureTransform, Option<u32>), Fault> {
    let Some(json) = extensions.get(TRANSFORM) else {
        return Ok((TextureTransform::default(), None));
    };
    let json = TransformJson::deserialize(json)
        .map_err(|e| Fault::json(format!("{here}/extensions/{TRANSFORM}"), e.to_string()))?;
    let transform = TextureTransform {
        offset: json.offset.unwrap_or([0.0; 2]).map(rounded),
        rotation: rounded(json.rotation.unwrap_or(0.0)),
        scale: json.scale.unwrap_or([1.0; 2]).map(rounded),
    };
    Ok((transform, json.tex_coord))
}

fn unit(x: f64) -> f64 {
    rounded(x).clamp(0.0, 1.0)
}

/// Clamps a number to the range of 32-bit floats, rounds it to 32 bits, and returns the shortest decimal number that
/// has this 32-bit value.
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounding to 32 bits is intended"
)]
pub(super) fn rounded(x: f64) -> f64 {
    let x = (x as f32).clamp(f32::MIN, f32::MAX);
    // The shortest decimal form of the 32-bit number is parsed as a 64-bit number. For example, 0.8 stays 0.8 instead
    // of becoming 0.800000011920929.
    x.to_string().parse().unwrap_or(f64::from(x))
}
