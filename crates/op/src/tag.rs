//! Tags: what the operations share that mark elements.

use mesh::{Column, Domain, Id, Mesh, Rule, Values};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{Context, OpError, Select};

/// The name of a tag: not empty, and without blanks around it.
#[derive(Clone, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(try_from = "String", into = "String")]
#[schemars(inline)]
pub struct TagName(String);

/// A text that is no name of a tag.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a tag needs a name without blanks around it, not \"{0}\"")]
pub struct BadTagName(String);

impl TagName {
    /// The name as it is written.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Which elements of a mesh have the tag; none if there is no such tag.
    ///
    /// # Errors
    ///
    /// [`OpError::Parameter`] if the name is that of an attribute of another type.
    pub fn marks(&self, mesh: &Mesh, domain: Domain) -> Result<Vec<bool>, OpError> {
        let Self(name) = self;
        match mesh.attributes().column(domain, name).map(|c| &c.values) {
            None => Ok(vec![false; mesh.domain_len(domain)]),
            Some(Values::Tag(marks)) => Ok(marks.clone()),
            Some(other) => Err(OpError::Parameter(format!(
                "the {domain} attribute \"{name}\" is no tag: it holds {}",
                other.type_name()
            ))),
        }
    }

    /// Gives the tag to the marked elements, and to no others.
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

/// Marks the selected elements, and no others, with a tag. A tag of this name that is there already is
/// replaced. Returns how many elements are marked now and were not, or the other way round.
///
/// # Errors
///
/// As [`Select::resolve`]; [`OpError::Parameter`] if the name is that of an attribute of another type.
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
    fn names_that_no_tag_can_have_are_refused() {
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
