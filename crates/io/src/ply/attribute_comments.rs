//! Reads and writes comments that describe attributes of a mesh. The writer adds a comment for each attribute that a
//! reader cannot restore from the names and types of its properties.
//!
//! For example, `comment meshwright vertex vec3 normal tangent_x "tangent"` declares an attribute `tangent`, whose name
//! is written as a JSON string. Its values are unit vectors, and its components are three properties of `vertex`,
//! beginning with `tangent_x`. Programs that do not know these comments read three unrelated properties.

use mesh::{Domain, Rule};

use super::columns::Kind;

const WORD: &str = "meshwright";

/// A comment that describes an attribute and the properties that store it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct AttributeComment {
    pub(super) domain: Domain,
    pub(super) kind: Kind,
    pub(super) rule: Rule,
    /// The name of the first property.
    pub(super) property: String,
    /// The name of the attribute.
    pub(super) name: String,
}

const RULES: [(Rule, &str); 4] = [
    (Rule::Interpolate, "interpolate"),
    (Rule::Normal, "normal"),
    (Rule::Copy, "copy"),
    (Rule::Drop, "drop"),
];

impl AttributeComment {
    /// Parses a comment. Returns `None` if it does not describe an attribute.
    pub(super) fn parse(comment: &str) -> Option<Self> {
        let mut words = comment.splitn(6, ' ');
        if words.next() != Some(WORD) {
            return None;
        }
        let domain = words.next()?;
        let domain = Domain::ALL.into_iter().find(|d| d.to_string() == domain)?;
        let kind = Kind::parse(words.next()?)?;
        let rule = words.next()?;
        let (rule, _) = RULES.into_iter().find(|(_, word)| *word == rule)?;
        let fits = rule != Rule::Normal || kind == Kind::Vec3;
        let property = words.next()?.to_owned();
        let name = serde_json::from_str(words.next()?).ok()?;
        fits.then_some(Self {
            domain,
            kind,
            rule,
            property,
            name,
        })
    }

    /// The text of the comment, without the word `comment`.
    pub(super) fn text(&self) -> String {
        let rule = RULES.iter().find(|(rule, _)| *rule == self.rule);
        format!(
            "{WORD} {} {} {} {} {}",
            self.domain,
            self.kind.word(),
            rule.map_or("", |(_, word)| word),
            self.property,
            serde_json::Value::from(self.name.as_str())
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn written_comments_are_parsed_unchanged() {
        for name in ["tangent", "", "a \"b\"\n\\c", "žluť "] {
            let comment = AttributeComment {
                domain: Domain::Corner,
                kind: Kind::Vec3,
                rule: Rule::Normal,
                property: "p_0".to_owned(),
                name: name.to_owned(),
            };
            assert!(!comment.text().contains('\n'));
            assert_eq!(AttributeComment::parse(&comment.text()), Some(comment));
        }
    }

    #[test]
    fn other_comments_are_ignored() {
        for text in [
            "",
            "made by hand",
            "meshwright vertex",
            "meshwright vertex int normal a \"a\"",
        ] {
            assert_eq!(AttributeComment::parse(text), None);
        }
    }
}
