//! Names of attributes that a step creates.

use mesh::is_rig_name;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The names of attributes that have a fixed meaning for operations and files.
const RESERVED: [&str; 9] = [
    "color",
    "corner",
    "crease",
    "material",
    "normal",
    "position",
    "smoothing",
    "tangent",
    "uv",
];

/// The name of a new attribute. The name must not be empty and must not start or end with whitespace. Names with a
/// fixed meaning, such as `uv`, `normal` and `color`, are not allowed.
#[derive(Clone, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(try_from = "String", into = "String")]
#[schemars(inline)]
pub struct AttributeName(String);

/// An invalid name of an attribute.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BadAttributeName {
    /// The name is empty, or starts or ends with whitespace.
    #[error(
        "the name of an attribute must not be empty and must not start or end with whitespace, found \"{0}\""
    )]
    Whitespace(String),
    /// This name has a fixed meaning.
    #[error(
        "the name \"{0}\" is reserved for attributes with a fixed meaning: choose another name"
    )]
    Reserved(String),
}

impl AttributeName {
    /// Returns the name.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl TryFrom<String> for AttributeName {
    type Error = BadAttributeName;

    fn try_from(name: String) -> Result<Self, BadAttributeName> {
        if name.is_empty() || name.trim() != name {
            return Err(BadAttributeName::Whitespace(name));
        }
        if is_rig_name(&name) || RESERVED.contains(&name.as_str()) {
            return Err(BadAttributeName::Reserved(name));
        }
        Ok(Self(name))
    }
}

impl From<AttributeName> for String {
    fn from(name: AttributeName) -> Self {
        name.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn invalid_and_reserved_names_are_refused() {
        for name in [
            "",
            " a",
            "a ",
            "uv",
            "normal",
            "joint:3",
            "morph:0",
            "morph_normal:0",
            "morph_uv:0",
        ] {
            assert!(AttributeName::try_from(name.to_owned()).is_err(), "{name}");
        }
        let name: AttributeName = ron::from_str("\"wall\"").unwrap();
        assert_eq!(name.as_str(), "wall");
    }
}
