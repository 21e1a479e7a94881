//! The syntax tree: the values of a recipe, each with its span in the text.

use super::literal::Number;
use crate::diagnostic::Span;
use std::fmt;

/// A value with its span.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Value {
    /// The span of the value in the text.
    pub span: Span,
    /// The kind and the content of the value.
    pub kind: ValueKind,
    /// The name of the recipe parameter, if this value was substituted for an `arg(..)`. The span of a substituted
    /// value is the span of the `arg(..)`.
    pub parameter: Option<Box<str>>,
}

/// The kinds of values in RON.
///
/// `Some(x)` is a call and `None` is a name, because only a schema can distinguish an option from an enumeration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ValueKind {
    /// `true` or `false`.
    Bool(bool),
    /// `7` or `0.5`.
    Number(Number),
    /// `"text"`, without its quotes and escapes.
    String(Box<str>),
    /// `'c'`.
    Char(char),
    /// A variant without parameters, such as `Area`, or `None`.
    Name(Box<str>),
    /// `()`.
    Unit,
    /// `(a: 1, b: 2)`.
    Struct(Struct),
    /// `(1, 2)`.
    Tuple(Vec<Value>),
    /// `[1, 2]`.
    List(Vec<Value>),
    /// `{"a": 1}`.
    Map(Vec<(Value, Value)>),
    /// `Name(..)`.
    Call(Box<Call>),
    /// A value that could not be read. A diagnostic gives the reason.
    Error,
}

/// The fields of a struct.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Struct {
    /// The fields in the order of the text.
    pub fields: Vec<Field>,
    /// Whether everything between the parentheses could be read. If this is `false`, a field that seems to be missing
    /// can be in the part that could not be read.
    pub complete: bool,
}

/// `name: value`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// The name.
    pub name: Name,
    /// The value.
    pub value: Value,
}

/// `Name(..)`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Call {
    /// The name.
    pub name: Name,
    /// The parentheses and their content: a unit, a struct or a tuple.
    pub body: Value,
}

/// A name with its span.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    /// The span, including the `r#` of a raw name.
    pub span: Span,
    /// The name without `r#`.
    pub text: Box<str>,
}

impl Value {
    /// Creates a value that is written in the text itself, not substituted for a parameter.
    pub fn new(span: Span, kind: ValueKind) -> Self {
        Self {
            span,
            kind,
            parameter: None,
        }
    }

    /// Returns the fields of `(a: 1, ..)` or `Name(a: 1, ..)`. The result is empty for all other values.
    pub fn fields(&self) -> &[Field] {
        match &self.kind {
            ValueKind::Struct(fields) => &fields.fields,
            ValueKind::Call(call) => call.body.fields(),
            _ => &[],
        }
    }

    /// Returns the value of the field with this name, if the field exists.
    pub fn field(&self, name: &str) -> Option<&Self> {
        self.fields()
            .iter()
            .find(|field| &*field.name.text == name)
            .map(|field| &field.value)
    }

    /// Returns a mutable reference to the value of the field with this name, if the field exists.
    pub fn field_mut(&mut self, name: &str) -> Option<&mut Self> {
        match &mut self.kind {
            ValueKind::Struct(body) => (body.fields.iter_mut())
                .find(|field| &*field.name.text == name)
                .map(|field| &mut field.value),
            ValueKind::Call(call) => call.body.field_mut(name),
            _ => None,
        }
    }

    /// Returns the name of `Name` or `Name(..)` with its span.
    pub fn name(&self) -> Option<(&str, Span)> {
        match &self.kind {
            ValueKind::Name(name) => Some((name, self.span)),
            ValueKind::Call(call) => Some((&call.name.text, call.name.span)),
            _ => None,
        }
    }

    /// Returns the text of a string.
    pub fn as_str(&self) -> Option<&str> {
        match &self.kind {
            ValueKind::String(text) => Some(text),
            _ => None,
        }
    }

    /// Returns the items of `[..]`.
    pub fn items(&self) -> Option<&[Self]> {
        match &self.kind {
            ValueKind::List(items) => Some(items),
            _ => None,
        }
    }

    /// Returns the x of `Some(x)`.
    pub fn some(&self) -> Option<&Self> {
        match &self.kind {
            ValueKind::Call(call) if &*call.name.text == "Some" => call.body.single(),
            _ => None,
        }
    }

    /// Returns the x of `(x)`.
    pub fn single(&self) -> Option<&Self> {
        match &self.kind {
            ValueKind::Tuple(items) if items.len() == 1 => items.first(),
            _ => None,
        }
    }

    /// Calls `change` for each direct child of this value, in the order of the text.
    pub fn for_each_part(&mut self, mut change: impl FnMut(&mut Self)) {
        match &mut self.kind {
            ValueKind::Call(call) => change(&mut call.body),
            ValueKind::Struct(body) => body.fields.iter_mut().for_each(|f| change(&mut f.value)),
            ValueKind::Tuple(items) | ValueKind::List(items) => items.iter_mut().for_each(change),
            ValueKind::Map(entries) => {
                for (key, value) in entries {
                    change(key);
                    change(value);
                }
            }
            _ => {}
        }
    }

    /// Returns the direct children of this value, in the order of the text.
    pub fn parts(&self) -> Box<dyn Iterator<Item = &Self> + '_> {
        match &self.kind {
            ValueKind::Call(call) => Box::new(std::iter::once(&call.body)),
            ValueKind::Struct(body) => Box::new(body.fields.iter().map(|field| &field.value)),
            ValueKind::Tuple(items) | ValueKind::List(items) => Box::new(items.iter()),
            ValueKind::Map(entries) => Box::new(entries.iter().flat_map(|(k, v)| [k, v])),
            _ => Box::new(std::iter::empty()),
        }
    }

    /// Whether a part of the value could not be read.
    pub fn has_errors(&self) -> bool {
        match &self.kind {
            ValueKind::Error => true,
            ValueKind::Struct(body) if !body.complete => true,
            _ => self.parts().any(Self::has_errors),
        }
    }

    /// Describes the value for a message, such as `1.5`, `a string` or ``a list `[..]` ``.
    pub fn describe(&self) -> String {
        match &self.kind {
            ValueKind::Bool(_) | ValueKind::Name(_) => format!("`{self}`"),
            ValueKind::Number(number) => number.text().to_owned(),
            ValueKind::String(text) if text.chars().count() <= 20 => format!("the string {self}"),
            ValueKind::String(_) => "a string".to_owned(),
            ValueKind::Char(_) => format!("the character {self}"),
            ValueKind::Unit => "`()`".to_owned(),
            ValueKind::Struct(_) => "named fields `(name: ..)`".to_owned(),
            ValueKind::Tuple(items) if items.len() == 1 => "a value in brackets `(..)`".to_owned(),
            ValueKind::Tuple(items) => format!("{} values in brackets `(.., ..)`", items.len()),
            ValueKind::List(_) => "a list `[..]`".to_owned(),
            ValueKind::Map(_) => "a map `{..}`".to_owned(),
            ValueKind::Call(call) => format!("`{}(..)`", call.name.text),
            ValueKind::Error => "a value that could not be read".to_owned(),
        }
    }
}

/// Writes the value in one line of RON that is parsed as the same value.
///
/// A value that could not be read is written as `_`.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.kind {
            ValueKind::Bool(value) => write!(f, "{value}"),
            ValueKind::Number(number) => f.write_str(number.text()),
            ValueKind::String(text) => write_string(f, text),
            ValueKind::Char('"') => f.write_str("'\"'"),
            ValueKind::Char(c) => write!(f, "'{}'", c.escape_debug()),
            ValueKind::Name(name) => write_name(f, name),
            ValueKind::Unit => f.write_str("()"),
            ValueKind::Struct(fields) => write_list(f, ["(", ")"], &fields.fields, |f, field| {
                write_name(f, &field.name.text)?;
                write!(f, ": {}", field.value)
            }),
            ValueKind::Tuple(items) => write_list(f, ["(", ")"], items, |f, v| write!(f, "{v}")),
            ValueKind::List(items) => write_list(f, ["[", "]"], items, |f, v| write!(f, "{v}")),
            ValueKind::Map(entries) => write_list(f, ["{", "}"], entries, |f, (key, value)| {
                write!(f, "{key}: {value}")
            }),
            ValueKind::Call(call) => {
                write_name(f, &call.name.text)?;
                write!(f, "{}", call.body)
            }
            ValueKind::Error => f.write_str("_"),
        }
    }
}

/// Returns `text` as a RON string literal.
///
/// ```
/// assert_eq!(ron_tree::string_literal("a \"b\"\n"), r#""a \"b\"\n""#);
/// ```
pub fn string_literal(text: &str) -> String {
    Value::new(Span::default(), ValueKind::String(text.into())).to_string()
}

fn write_string(f: &mut fmt::Formatter<'_>, text: &str) -> fmt::Result {
    f.write_str("\"")?;
    for c in text.chars() {
        match c {
            '\'' => f.write_str("'")?,
            c => write!(f, "{}", c.escape_debug())?,
        }
    }
    f.write_str("\"")
}

fn write_name(f: &mut fmt::Formatter<'_>, name: &str) -> fmt::Result {
    let plain = name.starts_with(|c: char| c == '_' || c.is_alphabetic())
        && name.chars().all(|c| c == '_' || c.is_alphanumeric());
    let reserved = matches!(name, "true" | "false" | "inf" | "NaN");
    write!(f, "{}{name}", if plain && !reserved { "" } else { "r#" })
}

fn write_list<T>(
    f: &mut fmt::Formatter<'_>,
    [open, close]: [&str; 2],
    items: &[T],
    mut write: impl FnMut(&mut fmt::Formatter<'_>, &T) -> fmt::Result,
) -> fmt::Result {
    f.write_str(open)?;
    for (i, item) in items.iter().enumerate() {
        if i > 0 {
            f.write_str(", ")?;
        }
        write(f, item)?;
    }
    f.write_str(close)
}
