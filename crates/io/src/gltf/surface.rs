//! Types that represent the JSON of glTF materials, textures, samplers and images.
//!
//! The reader and the writer share these types. A member that is `None` is missing in the document. The types in
//! `gltf_json` cannot be used, because they cannot store the transform of normal and occlusion textures.

use std::collections::BTreeMap;

use scene::{Filter, Wrap};
use serde::{Deserialize, Serialize};
use serde_json::Value;

pub(super) const TRANSFORM: &str = "KHR_texture_transform";
pub(super) const STRENGTH: &str = "KHR_materials_emissive_strength";
pub(super) const UNLIT: &str = "KHR_materials_unlit";

pub(super) type Extensions = BTreeMap<String, Value>;

#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct MaterialJson {
    pub(super) name: Option<String>,
    pub(super) pbr_metallic_roughness: Option<PbrJson>,
    pub(super) normal_texture: Option<InfoJson>,
    pub(super) occlusion_texture: Option<InfoJson>,
    pub(super) emissive_texture: Option<InfoJson>,
    pub(super) emissive_factor: Option<[f64; 3]>,
    pub(super) alpha_mode: Option<AlphaJson>,
    pub(super) alpha_cutoff: Option<f64>,
    pub(super) double_sided: Option<bool>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub(super) extensions: Extensions,
    pub(super) extras: Option<Box<Value>>,
}

impl MaterialJson {
    /// Returns the references to textures, in the order in which they are read.
    pub(super) fn textures(&self) -> impl Iterator<Item = &InfoJson> {
        let pbr = self.pbr_metallic_roughness.as_ref();
        let infos = [
            pbr.and_then(|pbr| pbr.base_color_texture.as_ref()),
            pbr.and_then(|pbr| pbr.metallic_roughness_texture.as_ref()),
            self.normal_texture.as_ref(),
            self.occlusion_texture.as_ref(),
            self.emissive_texture.as_ref(),
        ];
        infos.into_iter().flatten()
    }
}

#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
#[serde(rename_all = "UPPERCASE")]
pub(super) enum AlphaJson {
    Opaque,
    Mask,
    Blend,
}

#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct PbrJson {
    pub(super) base_color_factor: Option<[f64; 4]>,
    pub(super) base_color_texture: Option<InfoJson>,
    pub(super) metallic_factor: Option<f64>,
    pub(super) roughness_factor: Option<f64>,
    pub(super) metallic_roughness_texture: Option<InfoJson>,
}

/// A reference from a material to a texture.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct InfoJson {
    pub(super) index: usize,
    pub(super) tex_coord: Option<u32>,
    /// The scale of a normal texture.
    pub(super) scale: Option<f64>,
    /// The strength of an occlusion texture.
    pub(super) strength: Option<f64>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub(super) extensions: Extensions,
}

/// The extension `KHR_texture_transform` of an [`InfoJson`].
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct TransformJson {
    pub(super) offset: Option<[f64; 2]>,
    pub(super) rotation: Option<f64>,
    pub(super) scale: Option<[f64; 2]>,
    pub(super) tex_coord: Option<u32>,
}

#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(default)]
pub(super) struct TextureJson {
    pub(super) name: Option<String>,
    pub(super) sampler: Option<usize>,
    pub(super) source: Option<usize>,
}

#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct SamplerJson {
    pub(super) name: Option<String>,
    pub(super) mag_filter: Option<u32>,
    pub(super) min_filter: Option<u32>,
    pub(super) wrap_s: Option<u32>,
    pub(super) wrap_t: Option<u32>,
}

#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct ImageJson {
    pub(super) name: Option<String>,
    pub(super) uri: Option<String>,
    pub(super) mime_type: Option<String>,
    pub(super) buffer_view: Option<usize>,
}

type Filters = (Option<Filter>, Option<Filter>);

/// The codes of texture filters in glTF. Each code stands for two filters: one within a mipmap level, and one between
/// mipmap levels. Only the first two codes are valid for magnification.
pub(super) const FILTERS: [(u32, Filters); 6] = [
    (9728, (Some(Filter::Nearest), None)),
    (9729, (Some(Filter::Linear), None)),
    (9984, (Some(Filter::Nearest), Some(Filter::Nearest))),
    (9985, (Some(Filter::Linear), Some(Filter::Nearest))),
    (9986, (Some(Filter::Nearest), Some(Filter::Linear))),
    (9987, (Some(Filter::Linear), Some(Filter::Linear))),
];

/// The code of each wrap mode in glTF. The first mode is the default.
pub(super) const WRAPS: [(u32, Wrap); 3] = [
    (10497, Wrap::Repeat),
    (33648, Wrap::Mirror),
    (33071, Wrap::Clamp),
];
