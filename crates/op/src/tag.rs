//! Helpers for operations that mark elements with a tag.

use mesh::{Column, Domain, Id, Mesh, Rule, Values};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{Context, OpError, Select};

/// The name of a tag. The name must not be empty and must not start or end with whitespace.
#[derive(Clone, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(try_from = "String", into = "String")]
#[schemars(inline)]
pub struct TagName(String);

/// An invalid name of a tag.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the name of a tag must not be empty and must not start or end with whitespace, found \"{0}\""
)]
pub struct BadTagName(String);

impl TagName {
    /// Returns the name.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Returns one flag for each element of a mesh. The flag says whether the element has the tag. If the tag does not
    /// exist, all flags are false.
    ///
    /// # Errors
    ///
    /// Returns [`OpError::Parameter`] if an attribute of a different type has this name.
    pub fn marks(&self, mesh: &Mesh, domain: Domain) -> Result<Vec<bool>, OpError> {
        let Self(name) = self;
        match mesh.attributes().column(domain, name).map(|c| &c.values) {
            None => Ok(vec![false; mesh.domain_len(domain)]),
            Some(Values::Tag(marks)) => Ok(marks.clone()),
            Some(other) => Err(OpError::Parameter(format!(
                "the {domain} attribute \"{name}\" is not a tag: its type is {}",
                other.type_name()
            ))),
        }
    }

    /// Adds the tag to the marked elements and removes it from all other elements.
    pub fn write(&self, mesh: &mut Mesh, domain: Domain, marks: Vec<bool>) {
        let (name, rule, values) = (self.0.clone(), Rule::Copy, Values::Tag(marks));
        mesh.insert_column(domain, Column { name, rule, values });
    }
}

impl TryFrom<String> for TagName {
    type Error = BadTagName;

    fn try_from(name: String) -> Result<Self, BadTagName> {
        if name.is_empty() || name.trim() != name {
            return Err(BadTagName(name));
        }
        Ok(Self(name))
    }
}

impl From<TagName> for String {
    fn from(name: TagName) -> Self {
        name.0
    }
}

/// Adds the tag to the selected elements and removes it from all other elements. Returns the number of elements that
/// gained or lost the tag.
///
/// # Errors
///
/// Returns the errors of [`Select::resolve`]. Returns [`OpError::Parameter`] if an attribute of a different type has
/// this name.
pub fn tag<S: Select>(
    mesh: &mut Mesh,
    name: &TagName,
    selection: &S,
    cx: &mut Context,
) -> Result<usize, OpError> {
    cx.advance("tag", 0, 1)?;
    let marks = selection.mask(mesh, cx)?;
    let old = name.marks(mesh, S::Id::DOMAIN)?;
    let changed = marks
        .iter()
        .zip(old)
        .filter(|&(&new, old)| new != old)
        .count();
    name.write(mesh, S::Id::DOMAIN, marks);
    cx.advance("tag", 1, 1)?;
    Ok(changed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn invalid_names_are_refused() {
        for name in ["", " a", "a "] {
            let refused = TagName::try_from(name.to_owned()).unwrap_err();
            assert!(refused.to_string().ends_with(&format!("\"{name}\"")));
        }
        assert_eq!(
            ron::from_str::<TagName>("\"two words\"").unwrap().as_str(),
            "two words"
        );
    }
}
