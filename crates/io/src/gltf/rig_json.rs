//! Skins and animations in the JSON of a glTF file.

use serde::Deserialize;
use serde_json::Value;

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct SkinJson {
    pub(super) name: Option<String>,
    pub(super) joints: Vec<usize>,
    pub(super) inverse_bind_matrices: Option<usize>,
    pub(super) skeleton: Option<usize>,
    pub(super) extras: Option<Box<Value>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct AnimationJson {
    pub(super) name: Option<String>,
    pub(super) samplers: Vec<AnimationSamplerJson>,
    pub(super) channels: Vec<ChannelJson>,
    pub(super) extras: Option<Box<Value>>,
}

#[derive(Debug, Deserialize)]
pub(super) struct AnimationSamplerJson {
    pub(super) input: usize,
    pub(super) output: usize,
    pub(super) interpolation: Option<String>,
    pub(super) extras: Option<Box<Value>>,
}

#[derive(Debug, Deserialize)]
pub(super) struct ChannelJson {
    pub(super) sampler: usize,
    pub(super) target: TargetJson,
    pub(super) extras: Option<Box<Value>>,
}

#[derive(Debug, Deserialize)]
pub(super) struct TargetJson {
    pub(super) node: Option<usize>,
    pub(super) path: String,
}
