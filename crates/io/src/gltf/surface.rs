//! Materials, textures, samplers and images as the JSON of glTF has them.
//!
//! The types of `gltf_json` have no place for the transform of normal and occlusion textures.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

pub(super) const TRANSFORM: &str = "KHR_texture_transform";
pub(super) const STRENGTH: &str = "KHR_materials_emissive_strength";
pub(super) const UNLIT: &str = "KHR_materials_unlit";

pub(super) type Extensions = BTreeMap<String, Value>;

#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct MaterialJson {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) name: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) pbr_metallic_roughness: Option<PbrJson>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) normal_texture: Option<InfoJson>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) occlusion_texture: Option<InfoJson>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) emissive_texture: Option<InfoJson>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) emissive_factor: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) alpha_mode: Option<AlphaJson>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) alpha_cutoff: Option<f64>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(super) double_sided: bool,
    #[serde(skip_serializing_if = "Extensions::is_empty")]
    pub(super) extensions: Extensions,
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
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) base_color_factor: Option<[f64; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) base_color_texture: Option<InfoJson>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) metallic_factor: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) roughness_factor: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) metallic_roughness_texture: Option<InfoJson>,
}

/// How a material refers to a texture.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct InfoJson {
    pub(super) index: usize,
    #[serde(default, skip_serializing_if = "is_zero")]
    pub(super) tex_coord: u32,
    /// Of a normal texture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) scale: Option<f64>,
    /// Of an occlusion texture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) strength: Option<f64>,
    #[serde(default, skip_serializing_if = "Extensions::is_empty")]
    pub(super) extensions: Extensions,
}

/// The extension of an [`InfoJson`].
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct TransformJson {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) offset: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) rotation: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) scale: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) tex_coord: Option<u32>,
}

#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(default)]
pub(super) struct TextureJson {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) sampler: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) source: Option<usize>,
}

#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct SamplerJson {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) mag_filter: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) min_filter: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) wrap_s: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) wrap_t: Option<u32>,
}

#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct ImageJson {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) uri: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) mime_type: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) buffer_view: Option<usize>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks so")]
fn is_zero(x: &u32) -> bool {
    *x == 0
}
