//! The parameters of a recipe. A recipe declares each parameter with a type and a default value. The command line can
//! set parameters to other values.

use std::fmt::Display;
use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use store::Store;

use crate::source::{below, rebase_path};
use ron_tree::{Number, Span, Value, ValueKind, parse};

/// How to rewrite a relative path. A path relative to `from` becomes a path relative to `to` that leads to the same
/// file.
#[derive(Clone, Copy, Debug)]
pub struct Rebase<'a> {
    /// The folder to which the given path is relative.
    pub from: &'a Path,
    /// The folder to which the new path is relative.
    pub to: &'a Path,
    /// The store that contains both folders.
    pub store: &'a dyn Store,
}

/// A parameter that a recipe declares. A step uses the value of the parameter with `arg("name")`.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Param {
    /// A whole number.
    Int {
        /// The default value.
        default: i64,
        /// The minimum allowed value.
        min: Option<i64>,
        /// The maximum allowed value.
        max: Option<i64>,
        /// The description of the parameter.
        doc: Option<String>,
    },
    /// A number.
    Float {
        /// The default value.
        default: f64,
        /// The minimum allowed value.
        min: Option<f64>,
        /// The maximum allowed value.
        max: Option<f64>,
        /// The description of the parameter.
        doc: Option<String>,
    },
    /// `true` or `false`.
    Bool {
        /// The default value.
        default: bool,
        /// The description of the parameter.
        doc: Option<String>,
    },
    /// A string.
    Text {
        /// The default value.
        default: String,
        /// The description of the parameter.
        doc: Option<String>,
    },
    /// The path of an input file. The default value is relative to the recipe's folder. A path that is set on the
    /// command line is relative to the working directory. Output paths can contain `{p.stem}` and `{p.name}`, where `p`
    /// is the name of the parameter. `{p.stem}` stands for the file name of the path without its extension, and
    /// `{p.name}` for the file name with its extension.
    Path {
        /// The default value.
        default: String,
        /// The description of the parameter.
        doc: Option<String>,
    },
    /// One of several names, such as the variants of an operation's parameter.
    Choice {
        /// The default value.
        default: String,
        /// The allowed names.
        of: Vec<String>,
        /// The description of the parameter.
        doc: Option<String>,
    },
    /// Three numbers `(x, y, z)`.
    Vector {
        /// The default value.
        default: (f64, f64, f64),
        /// The description of the parameter.
        doc: Option<String>,
    },
}

impl Param {
    /// Returns the name of the parameter's type.
    pub fn type_name(&self) -> &'static str {
        self.words().0
    }

    fn expected(&self) -> &'static str {
        self.words().1
    }

    /// Returns the name of the parameter's type, and a description of its values.
    fn words(&self) -> (&'static str, &'static str) {
        match self {
            Self::Int { .. } => ("Int", "a whole number"),
            Self::Float { .. } => ("Float", "a number"),
            Self::Bool { .. } => ("Bool", "true or false"),
            Self::Text { .. } => ("Text", "a string in quotes"),
            Self::Path { .. } => ("Path", "a path in quotes"),
            Self::Choice { .. } => ("Choice", "one of the allowed names"),
            Self::Vector { .. } => ("Vector", "three numbers `(x, y, z)`"),
        }
    }

    /// Returns the description of the parameter, if it has one.
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

    /// Returns the default value in the form of a recipe value (`Value`).
    ///
    /// # Errors
    ///
    /// Returns an error if the parameter does not allow its own default value.
    pub fn default_value(&self) -> Result<Value, ParamError> {
        match self {
            Self::Int { default, .. } => self.allowed_int(*default),
            Self::Float { default, .. } => self.allowed_float(*default),
            Self::Bool { default, .. } => Ok(value(ValueKind::Bool(*default))),
            Self::Text { default, .. }
            | Self::Path { default, .. }
            | Self::Choice { default, .. } => self.value_of(default, None),
            Self::Vector {
                default: (x, y, z), ..
            } => vector([*x, *y, *z]),
        }
    }

    /// Converts a value that is written in a recipe to the form in which this parameter stores its values. For example,
    /// the number `1` becomes `1.0` for a `Float`. If `folders` is given, a relative path is rewritten: the new path is
    /// relative to the folder `folders.to`.
    ///
    /// # Errors
    ///
    /// Returns an error if the value does not have the type of the parameter, or if the parameter does not allow the
    /// value.
    pub fn value_from(
        &self,
        written: &Value,
        folders: Option<Rebase>,
    ) -> Result<Value, ParamError> {
        match (self, &written.kind) {
            (Self::Int { .. }, ValueKind::Number(number)) => {
                let int = number.to_int().and_then(|int| i64::try_from(int).ok());
                let other = || ParamError::new("a whole number", &format!("`{}`", number.text()));
                self.allowed_int(int.ok_or_else(other)?)
            }
            (Self::Float { .. }, ValueKind::Number(_)) => self.allowed_float(number(written)?),
            (Self::Bool { .. }, ValueKind::Bool(is)) => Ok(value(ValueKind::Bool(*is))),
            (Self::Text { .. }, ValueKind::String(text)) => {
                Ok(value(ValueKind::String(text.clone())))
            }
            (Self::Path { .. }, ValueKind::String(text)) => {
                // An absolute path inside the folder `f.to` becomes relative, too, so that absolute and relative paths
                // of the same file become equal.
                let rebased = |f: Rebase| {
                    let path = rebase_path(f.store, text, f.from, f.to);
                    below(&path, f.to).unwrap_or(path)
                };
                let path = folders.map_or_else(|| (&**text).into(), rebased);
                Ok(value(ValueKind::String(path.to_string_lossy().into())))
            }
            (Self::Choice { of, .. }, ValueKind::String(text) | ValueKind::Name(text)) => {
                let word = text.chars().all(|c| c.is_alphanumeric() || c == '_');
                // Names given on the command line are parsed as strings. The case of these names does not matter.
                let is_text = matches!(written.kind, ValueKind::String(_));
                let same = |choice: &&String| ***choice == **text;
                let similar = |choice: &&String| is_text && choice.eq_ignore_ascii_case(text);
                let found = of.iter().find(same).or_else(|| of.iter().find(similar));
                if let Some(found) = found.filter(|_| word) {
                    Ok(value(ValueKind::Name(found.as_str().into())))
                } else {
                    let expected = format!("one of {}", of.join(", "));
                    Err(ParamError::new(&expected, &format!("`{text}`")))
                }
            }
            (Self::Vector { .. }, ValueKind::Tuple(parts)) => {
                let parts: Vec<f64> = parts.iter().map(number).collect::<Result<_, _>>()?;
                let [x, y, z] = parts[..] else {
                    return Err(ParamError::new(self.expected(), &format!("`{written}`")));
                };
                vector([x, y, z])
            }
            _ => Err(ParamError::new(self.expected(), &written.describe())),
        }
    }

    /// Converts plain text, for example from the command line, to a value of this parameter. If `folders` is given, a
    /// relative path is rewritten: the new path is relative to the folder `folders.to`.
    ///
    /// # Errors
    ///
    /// Returns an error if the text is not a value of the parameter's type, or if the parameter does not allow the
    /// value.
    pub fn value_of(&self, text: &str, folders: Option<Rebase>) -> Result<Value, ParamError> {
        let parsed = match self {
            Self::Text { .. } | Self::Path { .. } | Self::Choice { .. } => {
                return self.value_from(&value(ValueKind::String(text.into())), folders);
            }
            Self::Vector { .. } if !text.contains('(') => parse(&format!("({text})")),
            _ => parse(text),
        };
        if parsed.diagnostics.is_empty() {
            self.value_from(&parsed.value, folders)
        } else {
            Err(ParamError::new(self.expected(), &format!("`{text}`")))
        }
    }

    fn allowed_int(&self, int: i64) -> Result<Value, ParamError> {
        if let Self::Int { min, max, .. } = self {
            within(int, *min, *max)?;
        }
        let number = Number::Int(int.to_string().into());
        Ok(value(ValueKind::Number(number)))
    }

    fn allowed_float(&self, x: f64) -> Result<Value, ParamError> {
        if let Self::Float { min, max, .. } = self {
            within(x, *min, *max)?;
        }
        float(x)
    }
}

/// Why a value does not fit a parameter: what was expected and what was found.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct ParamError(String);

impl ParamError {
    fn new(expected: &str, found: &str) -> Self {
        Self(format!("expected {expected}, found {found}"))
    }
}

/// Returns a value that has no position in a text.
fn value(kind: ValueKind) -> Value {
    Value::new(Span::default(), kind)
}

fn vector(parts: [f64; 3]) -> Result<Value, ParamError> {
    let parts = parts.into_iter().map(float).collect::<Result<_, _>>()?;
    Ok(value(ValueKind::Tuple(parts)))
}

/// Returns a number as a `Value`. The text of this `Value` has a decimal point or an exponent, and parsing the text
/// gives exactly the same number.
fn float(x: f64) -> Result<Value, ParamError> {
    if !x.is_finite() {
        return Err(ParamError::new("a number", &format!("`{x:?}`")));
    }
    let number = Number::Float(format!("{x:?}").into());
    Ok(value(ValueKind::Number(number)))
}

fn number(written: &Value) -> Result<f64, ParamError> {
    match &written.kind {
        ValueKind::Number(number) if !number.has_base() && number.to_float().is_finite() => {
            Ok(number.to_float())
        }
        _ => Err(ParamError::new("a number", &format!("`{written}`"))),
    }
}

fn within<T: Copy + PartialOrd + Display>(
    value: T,
    min: Option<T>,
    max: Option<T>,
) -> Result<(), ParamError> {
    let message = match (min, max) {
        (Some(min), _) if value < min => format!("{value} is below the minimum {min}"),
        (_, Some(max)) if value > max => format!("{value} is above the maximum {max}"),
        _ => return Ok(()),
    };
    Err(ParamError(message))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn param(text: &str) -> Param {
        ron_tree::from_str(text).unwrap()
    }

    #[test]
    fn values_of_every_type_become_literals() {
        let literal = |p: &str, text| {
            let value = param(p).value_of(text, None);
            value.map(|value| value.to_string())
        };
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
    fn values_that_are_not_allowed_are_refused_with_a_reason() {
        let refused = |p: &str, text| param(p).value_of(text, None).unwrap_err().to_string();
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
    fn text_is_escaped_so_that_it_cannot_add_fields() {
        let param = param("Text(default: \"\")");
        let text = "x\", on: [\"y";
        let value = param.value_of(text, None).unwrap();
        assert_eq!(value.as_str(), Some(text));
        assert_eq!(ron::from_str::<String>(&value.to_string()).unwrap(), text);
    }

    #[test]
    fn a_path_that_is_set_is_relative_to_the_working_directory() {
        let (from, to) = (Path::new("/work"), Path::new("/work/scenes"));
        let store = &store::Disk;
        let folders = Some(Rebase { from, to, store });
        let value = param("Path(default: \"a.obj\")").value_of("b.obj", folders);
        assert_eq!(value.unwrap().as_str(), Some("../b.obj"));
        let value = param("Path(default: \"a.obj\")").value_of("/work/scenes/b.obj", folders);
        assert_eq!(value.unwrap().as_str(), Some("b.obj"));
    }
}
