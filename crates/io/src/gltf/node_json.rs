//! A node in the JSON of a glTF file.

use std::collections::BTreeMap;

use scene::Placement;
use serde::Deserialize;
use serde_json::Value;

use crate::fault::Fault;

/// The extension for lights.
pub(super) const LIGHTS: &str = "KHR_lights_punctual";

/// A node. Its numbers, such as its translation, are not rounded to 32 bits.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct NodeJson {
    pub(super) name: Option<String>,
    pub(super) children: Vec<usize>,
    pub(super) mesh: Option<usize>,
    pub(super) camera: Option<usize>,
    pub(super) skin: Option<usize>,
    pub(super) weights: Vec<f64>,
    pub(super) extras: Option<Box<Value>>,
    extensions: Option<BTreeMap<String, Value>>,
    matrix: Option<Box<[f64; 16]>>,
    translation: Option<[f64; 3]>,
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
}

impl NodeJson {
    /// Returns the index of the light. Returns `None` if the node has no light.
    ///
    /// # Errors
    ///
    /// Returns an error if the JSON of the light is not an index. `here` is the location of the node.
    pub(super) fn light(&self, here: &str) -> Result<Option<usize>, Fault> {
        let Some(extension) = self.extensions.as_ref().and_then(|all| all.get(LIGHTS)) else {
            return Ok(None);
        };
        let light = extension.get("light").and_then(Value::as_u64);
        let light = light.and_then(|light| usize::try_from(light).ok());
        let pointer = format!("{here}/extensions/{LIGHTS}/light");
        light
            .map(Some)
            .ok_or_else(|| Fault::json(pointer, "expected the index of a light"))
    }

    /// Returns the placement (transform) of the node in the space of its parent.
    ///
    /// # Errors
    ///
    /// Returns an error if the matrix is not affine, or the length of the rotation is zero or not finite. `here` is the
    /// location of the node.
    pub(super) fn placement(&self, here: &str) -> Result<Placement, Fault> {
        if let Some(matrix) = &self.matrix {
            let last_row = [3, 7, 11, 15].map(|i| matrix[i].to_bits());
            if last_row != [0.0, 0.0, 0.0, 1.0].map(f64::to_bits) {
                let message = "expected 0, 0, 0, 1 as the last row of the matrix";
                return Err(Fault::json(format!("{here}/matrix"), message));
            }
            return Ok(Placement::Matrix(**matrix));
        }
        let rotation = self.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
        let length = rotation.iter().map(|x| x * x).sum::<f64>();
        if length == 0.0 || !length.is_finite() {
            let pointer = format!("{here}/rotation");
            return Err(Fault::json(pointer, "expected a unit quaternion"));
        }
        Ok(Placement::Parts {
            translation: self.translation.unwrap_or_default(),
            rotation,
            scale: self.scale.unwrap_or([1.0; 3]),
        })
    }
}
