//! Parses the parts of a scene that are stored as JSON text.

use serde_json::Value;

use crate::error::Unwritable;

/// Parses a part of the scene as JSON.
pub(super) fn parsed(text: &str) -> Result<Value, Unwritable> {
    serde_json::from_str(text).map_err(|why| {
        Unwritable::scene(format!(
            "expected the glTF data in the scene (such as extras or cameras) to be valid JSON: {why}"
        ))
    })
}

/// Parses an optional part of the scene. Returns JSON null if the part is `None`.
pub(super) fn optional_json(text: Option<&str>) -> Result<Value, Unwritable> {
    text.map_or(Ok(Value::Null), parsed)
}
