//! The extension `KHR_draco_mesh_compression` in the JSON of a glTF file.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

use crate::fault::Fault;

/// The name of the extension.
pub(super) const DRACO: &str = "KHR_draco_mesh_compression";

/// A compressed primitive.
#[derive(Debug)]
pub(super) struct Compressed {
    pub(super) mesh: usize,
    pub(super) primitive: usize,
    pub(super) extension: Extension,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Extension {
    pub(super) buffer_view: usize,
    pub(super) attributes: BTreeMap<String, u32>,
}

impl Compressed {
    /// The JSON pointer to the extension.
    pub(super) fn pointer(&self) -> String {
        let Self {
            mesh, primitive, ..
        } = self;
        format!("/meshes/{mesh}/primitives/{primitive}/extensions/{DRACO}")
    }
}

/// Lists the compressed primitives. A primitive is left out if all of its accessors also have uncompressed data.
///
/// # Errors
///
/// Returns an error for the first invalid extension.
pub(super) fn compressed(meshes: &[Value], accessors: &[Value]) -> Result<Vec<Compressed>, Fault> {
    let has_data = |accessor: &Value| {
        let accessor = accessor.as_u64().and_then(|i| usize::try_from(i).ok());
        // If the accessor does not exist, it is treated as if it had data, and the code that reads it later reports the
        // error.
        let accessor = accessor.and_then(|i| accessors.get(i));
        accessor.is_none_or(|a| a.get("bufferView").is_some() || a.get("sparse").is_some())
    };
    let mut found = Vec::new();
    for (mesh, json) in meshes.iter().enumerate() {
        let primitives = json.get("primitives").and_then(Value::as_array);
        for (primitive, json) in primitives.into_iter().flatten().enumerate() {
            let Some(extension) = json.get("extensions").and_then(|e| e.get(DRACO)) else {
                continue;
            };
            let attributes = json.get("attributes").and_then(Value::as_object);
            let mut used = attributes.into_iter().flatten().map(|(_, a)| a);
            if json.get("indices").is_none_or(has_data) && used.all(has_data) {
                continue;
            }
            let extension = Extension::deserialize(extension).map_err(|e| {
                let at = format!("/meshes/{mesh}/primitives/{primitive}/extensions/{DRACO}");
                Fault::json(at, e.to_string())
            })?;
            found.push(Compressed {
                mesh,
                primitive,
                extension,
            });
        }
    }
    Ok(found)
}
