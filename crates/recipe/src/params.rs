//! The parameters of a recipe: declared with a type and a default, set from the command line.

use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::source::seen_from;
use crate::syntax::{Value, ValueKind, string_literal};

/// Two folders: a relative path is seen from the one, and is to mean the same seen from the other.
#[derive(Clone, Copy, Debug)]
pub struct Move<'a> {
    /// Where the path is seen from.
    pub from: &'a Path,
    /// Where it will be seen from.
    pub to: &'a Path,
}

/// A parameter that a recipe declares. A step takes its value with `arg("name")`.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Param {
    /// A whole number.
    Int {
        /// The value unless another is set.
        default: i64,
        /// The lowest that is allowed.
        min: Option<i64>,
        /// The highest that is allowed.
        max: Option<i64>,
        /// What it is for.
        doc: Option<String>,
    },
    /// A number.
    Float {
        /// The value unless another is set.
        default: f64,
        /// The lowest that is allowed.
        min: Option<f64>,
        /// The highest that is allowed.
        max: Option<f64>,
        /// What it is for.
        doc: Option<String>,
    },
    /// `true` or `false`.
    Bool {
        /// The value unless another is set.
        default: bool,
        /// What it is for.
        doc: Option<String>,
    },
    /// A text.
    Text {
        /// The value unless another is set.
        default: String,
        /// What it is for.
        doc: Option<String>,
    },
    /// The path of a file that is read. The default is seen from the recipe's folder, a path that is
    /// set from the working directory. Output paths can use `{name.stem}` and `{name.name}`.
    Path {
        /// The value unless another is set.
        default: String,
        /// What it is for.
        doc: Option<String>,
    },
    /// One of several words, such as the variants of an operation's parameter.
    Choice {
        /// The value unless another is set.
        default: String,
        /// The words that are allowed.
        of: Vec<String>,
        /// What it is for.
        doc: Option<String>,
    },
    /// Three numbers `(x, y, z)`.
    Vector {
        /// The value unless another is set.
        default: (f64, f64, f64),
        /// What it is for.
        doc: Option<String>,
    },
}

impl Param {
    /// The name of its type.
    pub fn type_name(&self) -> &'static str {
        match self {
            Self::Int { .. } => "Int",
            Self::Float { .. } => "Float",
            Self::Bool { .. } => "Bool",
            Self::Text { .. } => "Text",
            Self::Path { .. } => "Path",
            Self::Choice { .. } => "Choice",
            Self::Vector { .. } => "Vector",
        }
    }

    /// What it is for, if the recipe says.
    pub fn doc(&self) -> Option<&str> {
        match self {
            Self::Int { doc, .. }
            | Self::Float { doc, .. }
            | Self::Bool { doc, .. }
            | Self::Text { doc, .. }
            | Self::Path { doc, .. }
            | Self::Choice { doc, .. }
            | Self::Vector { doc, .. } => doc.as_deref(),
        }
    }

    /// The default as RON.
    ///
    /// # Errors
    ///
    /// If the parameter does not allow its own default.
    pub fn default_literal(&self) -> Result<String, String> {
        match self {
            Self::Int { default, .. } => self.literal(&default.to_string(), None),
            Self::Float { default, .. } => self.literal(&float(*default), None),
            Self::Bool { default, .. } => self.literal(&default.to_string(), None),
            Self::Text { default, .. }
            | Self::Path { default, .. }
            | Self::Choice { default, .. } => self.literal(default, None),
            Self::Vector {
                default: (x, y, z), ..
            } => self.literal(
                &format!("({}, {}, {})", float(*x), float(*y), float(*z)),
                None,
            ),
        }
    }

    /// The RON literal of a value of a recipe, in another form than the parameter's own declaration has.
    /// A relative path is led from one folder to another, if they are given.
    ///
    /// # Errors
    ///
    /// What was expected and what was there, if it is no value of this type or not allowed.
    pub fn literal_of(&self, value: &Value, folders: Option<Move>) -> Result<String, String> {
        let text = match (self, &value.kind) {
            (Self::Int { .. }, ValueKind::Number(number)) => match number.to_int() {
                Some(int) => int.to_string(),
                None => number.text().to_owned(),
            },
            (Self::Float { .. }, ValueKind::Number(number)) => number.text().to_owned(),
            (Self::Bool { .. }, ValueKind::Bool(value)) => value.to_string(),
            (
                Self::Text { .. } | Self::Path { .. } | Self::Choice { .. },
                ValueKind::String(text),
            )
            | (Self::Choice { .. }, ValueKind::Name(text)) => text.to_string(),
            (Self::Vector { .. }, ValueKind::Tuple(_)) => value.to_string(),
            _ => {
                let (expected, found) = (self.expected(), value.describe());
                return Err(format!("expected {expected}, found {found}"));
            }
        };
        self.literal(&text, folders)
    }

    fn expected(&self) -> &'static str {
        match self {
            Self::Int { .. } => "a whole number",
            Self::Float { .. } => "a number",
            Self::Bool { .. } => "true or false",
            Self::Text { .. } => "a text in quotes",
            Self::Path { .. } => "a path in quotes",
            Self::Choice { .. } => "one of its words",
            Self::Vector { .. } => "three numbers `(x, y, z)`",
        }
    }

    /// The RON literal of a value given as plain text, as on the command line. A relative path is led from
    /// one folder to another, if they are given.
    ///
    /// # Errors
    ///
    /// What was expected and what was there, if the text is no value of this type or not allowed.
    pub fn literal(&self, text: &str, folders: Option<Move>) -> Result<String, String> {
        match self {
            Self::Int { min, max, .. } => {
                let plain = text.replace('_', "");
                let value: i64 = plain
                    .parse()
                    .map_err(|_| format!("expected a whole number, found `{text}`"))?;
                within(value, *min, *max)?;
                Ok(value.to_string())
            }
            Self::Float { min, max, .. } => {
                let value = number(text)?;
                within(value, *min, *max)?;
                Ok(float(value))
            }
            Self::Bool { .. } => match text {
                "true" | "false" => Ok(text.to_owned()),
                _ => Err(format!("expected true or false, found `{text}`")),
            },
            Self::Text { .. } => Ok(string_literal(text)),
            Self::Path { .. } => {
                let path = folders.map_or_else(|| text.into(), |f| seen_from(text, f.from, f.to));
                Ok(string_literal(&path.to_string_lossy()))
            }
            Self::Choice { of, .. } => {
                let word = text.chars().all(|c| c.is_alphanumeric() || c == '_');
                if of.iter().any(|choice| choice == text) && word {
                    Ok(text.to_owned())
                } else {
                    Err(format!("expected one of {}, found `{text}`", of.join(", ")))
                }
            }
            Self::Vector { .. } => {
                let inner = text.trim().trim_start_matches('(').trim_end_matches(')');
                let parts: Vec<f64> = inner
                    .split(',')
                    .map(|part| number(part.trim()))
                    .collect::<Result<_, _>>()?;
                match parts[..] {
                    [x, y, z] => Ok(format!("({}, {}, {})", float(x), float(y), float(z))),
                    _ => Err(format!(
                        "expected three numbers `(x, y, z)`, found `{text}`"
                    )),
                }
            }
        }
    }
}

fn number(text: &str) -> Result<f64, String> {
    let value: Result<f64, _> = text.replace('_', "").parse();
    value
        .ok()
        .filter(|value| value.is_finite())
        .ok_or_else(|| format!("expected a number, found `{text}`"))
}

/// A number as RON that reads back the same, and as a number with a point.
fn float(x: f64) -> String {
    format!("{x:?}")
}

fn within<T: PartialOrd + std::fmt::Display + Copy>(
    value: T,
    min: Option<T>,
    max: Option<T>,
) -> Result<(), String> {
    match (min, max) {
        (Some(min), _) if value < min => Err(format!("{value} is below the minimum {min}")),
        (_, Some(max)) if value > max => Err(format!("{value} is above the maximum {max}")),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn param(text: &str) -> Param {
        crate::syntax::ron_options().from_str(text).unwrap()
    }

    #[test]
    fn values_of_every_type_become_literals() {
        let literal = |p: &str, text| param(p).literal(text, None);
        assert_eq!(literal("Int(default: 1)", "1_000"), Ok("1000".into()));
        assert_eq!(literal("Float(default: 1)", "2"), Ok("2.0".into()));
        assert_eq!(literal("Bool(default: true)", "false"), Ok("false".into()));
        assert_eq!(
            literal("Text(default: \"\")", "a\"b"),
            Ok("\"a\\\"b\"".into())
        );
        assert_eq!(
            literal("Choice(default: \"A\", of: [\"A\", \"B\"])", "B"),
            Ok("B".into())
        );
        assert_eq!(
            literal("Vector(default: (0, 0, 0))", "1, 2, 3"),
            Ok("(1.0, 2.0, 3.0)".into())
        );
    }

    #[test]
    fn values_that_are_not_allowed_say_why() {
        let refused = |p: &str, text| param(p).literal(text, None).unwrap_err();
        assert_eq!(
            refused("Int(default: 1)", "1.5"),
            "expected a whole number, found `1.5`"
        );
        assert_eq!(
            refused("Int(default: 1, max: 5)", "6"),
            "6 is above the maximum 5"
        );
        assert_eq!(
            refused("Float(default: 1)", "nan"),
            "expected a number, found `nan`"
        );
        assert_eq!(
            refused("Choice(default: \"A\", of: [\"A\", \"B\"])", "C"),
            "expected one of A, B, found `C`"
        );
    }

    #[test]
    fn a_text_cannot_smuggle_in_another_field() {
        let literal = param("Text(default: \"\")")
            .literal("x\", on: [\"y", None)
            .unwrap();
        let back: String = ron::from_str(&literal).unwrap();
        assert_eq!(back, "x\", on: [\"y");
    }

    #[test]
    fn a_path_that_is_set_is_seen_from_the_working_directory() {
        let (from, to) = (Path::new("/work"), Path::new("/work/scenes"));
        let literal = param("Path(default: \"a.obj\")").literal("b.obj", Some(Move { from, to }));
        assert_eq!(literal, Ok("\"../b.obj\"".into()));
    }
}
