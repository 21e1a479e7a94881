//! Deserializes values into Rust types.
//!
//! Accepts the same values as the `ron` crate with its extension `IMPLICIT_SOME`: `Some(..)` can be omitted. The name
//! of a struct can precede its parentheses. The tree is neither changed nor copied. An error has the span of the
//! innermost value that caused it.

use std::fmt;
use std::slice;

use serde::de::value::BorrowedStrDeserializer;
use serde::de::{
    DeserializeOwned, DeserializeSeed, EnumAccess, MapAccess, SeqAccess, VariantAccess, Visitor,
};
use serde::{Deserializer, forward_to_deserialize_any};

use crate::diagnostic::Span;
use crate::parser::parse;
use crate::tree::{Field, Value, ValueKind};

/// Why a value could not be deserialized.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct Error {
    /// The message, in one line.
    pub message: String,
    /// The span of the value. `None` if the error is about the text as a whole.
    pub span: Option<Span>,
}

impl serde::de::Error for Error {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self {
            message: message.to_string(),
            span: None,
        }
    }
}

type Result<T> = std::result::Result<T, Error>;

/// Parses a source text and deserializes its value.
///
/// # Errors
///
/// Returns the first syntax error of the text. If there is none, returns an error that says why the value does not have
/// type `T`.
///
/// ```
/// #[derive(serde::Deserialize)]
/// struct Loop { levels: Option<u32> }
///
/// let step: Loop = ron_tree::from_str("(levels: 2)")?;
/// assert_eq!(step.levels, Some(2));
/// # Ok::<(), ron_tree::Error>(())
/// ```
pub fn from_str<T: DeserializeOwned>(source: &str) -> Result<T> {
    let parsed = parse(source);
    match parsed.diagnostics.into_iter().next() {
        Some(problem) => Err(Error {
            message: problem.message,
            span: problem.span,
        }),
        None => T::deserialize(&parsed.value),
    }
}

impl Value {
    fn expected<T>(&self, what: &str) -> Result<T> {
        Err(self.unexpected(what))
    }

    // Generic code is compiled for each type that is deserialized, so the generic functions here are short.

    #[cold]
    fn unexpected(&self, what: &str) -> Error {
        Error {
            message: format!("expected {what}, found {}", self.describe()),
            span: Some(self.span),
        }
    }

    /// If the result is an error without a span, gives the error the span of this value.
    fn locate<T>(&self, result: Result<T>) -> Result<T> {
        result.map_err(|error| self.located(error))
    }

    #[cold]
    fn located(&self, error: Error) -> Error {
        Error {
            span: error.span.or(Some(self.span)),
            ..error
        }
    }

    /// Deserializes the value into the type of `seed`.
    fn read<'de, T: DeserializeSeed<'de>>(&'de self, seed: T) -> Result<T::Value> {
        self.locate(seed.deserialize(self))
    }

    /// If the value is `name(..)`, returns the parentheses and their content. Otherwise, returns the value unchanged.
    fn without_name(&self, name: &str) -> &Self {
        match &self.kind {
            ValueKind::Call(call) if &*call.name.text == name => &call.body,
            _ => self,
        }
    }

    fn integer<T: TryFrom<i128>>(&self) -> Result<T> {
        match &self.kind {
            ValueKind::Number(number) if number.is_int() => {
                let value = number.to_int().and_then(|value| value.try_into().ok());
                value.map_or_else(|| self.expected("a whole number in the allowed range"), Ok)
            }
            _ => self.expected("a whole number"),
        }
    }

    fn visit_items<'de, V: Visitor<'de>>(
        &'de self,
        items: &'de [Self],
        visitor: V,
    ) -> Result<V::Value> {
        let mut items = Items(items.iter());
        let read = self.locate(visitor.visit_seq(&mut items))?;
        match items.0.next() {
            Some(more) => more.expected("no more values"),
            None => Ok(read),
        }
    }

    fn visit_fields<'de, V: Visitor<'de>>(&'de self, visitor: V) -> Result<V::Value> {
        let fields: &[Field] = match &self.kind {
            ValueKind::Struct(body) => &body.fields,
            ValueKind::Unit => &[],
            _ => return self.expected("named fields `(name: ..)`"),
        };
        self.locate(visitor.visit_map(Pairs::new(fields)))
    }
}

/// Defines deserializer methods for types that accept one kind of value.
macro_rules! deserialize_kind {
    ($($method:ident, $visit:ident, $value:ident => $read:expr;)*) => {$(
        fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
            let $value = self;
            let read = $read;
            self.locate(visitor.$visit(read))
        }
    )*};
}

impl<'de> Deserializer<'de> for &'de Value {
    type Error = Error;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        match &self.kind {
            ValueKind::Bool(value) => self.locate(visitor.visit_bool(*value)),
            ValueKind::Number(number) => match number.to_int() {
                Some(int) => self.locate(match (i64::try_from(int), u64::try_from(int)) {
                    (Ok(int), _) => visitor.visit_i64(int),
                    (_, Ok(int)) => visitor.visit_u64(int),
                    _ => visitor.visit_i128(int),
                }),
                None => self.deserialize_f64(visitor),
            },
            ValueKind::String(_) => self.deserialize_str(visitor),
            ValueKind::Char(_) => self.deserialize_char(visitor),
            ValueKind::Name(name) if &**name == "None" => self.locate(visitor.visit_none()),
            ValueKind::Name(_) | ValueKind::Unit => self.locate(visitor.visit_unit()),
            ValueKind::Struct(_) => self.visit_fields(visitor),
            ValueKind::Tuple(items) | ValueKind::List(items) => self.visit_items(items, visitor),
            ValueKind::Map(_) => self.deserialize_map(visitor),
            ValueKind::Call(call) => match self.some() {
                Some(inner) => self.locate(visitor.visit_some(inner)),
                None => call.body.deserialize_any(visitor),
            },
            ValueKind::Error => self.expected("a value"),
        }
    }

    deserialize_kind! {
        deserialize_i8, visit_i8, value => value.integer()?;
        deserialize_i16, visit_i16, value => value.integer()?;
        deserialize_i32, visit_i32, value => value.integer()?;
        deserialize_i64, visit_i64, value => value.integer()?;
        deserialize_i128, visit_i128, value => value.integer()?;
        deserialize_u8, visit_u8, value => value.integer()?;
        deserialize_u16, visit_u16, value => value.integer()?;
        deserialize_u32, visit_u32, value => value.integer()?;
        deserialize_u64, visit_u64, value => value.integer()?;
        deserialize_u128, visit_u128, value => value.integer()?;
        deserialize_bool, visit_bool, value => match &value.kind {
            ValueKind::Bool(value) => *value,
            _ => return value.expected("`true` or `false`"),
        };
        deserialize_f32, visit_f32, value => match &value.kind {
            ValueKind::Number(number) if !number.has_base() => number.to_single(),
            _ => return value.expected("a number"),
        };
        deserialize_f64, visit_f64, value => match &value.kind {
            ValueKind::Number(number) if !number.has_base() => number.to_float(),
            _ => return value.expected("a number"),
        };
        deserialize_char, visit_char, value => match &value.kind {
            ValueKind::Char(value) => *value,
            _ => return value.expected("a character `'c'`"),
        };
        deserialize_str, visit_borrowed_str, value => match &value.kind {
            ValueKind::String(text) => text,
            _ => return value.expected("a string"),
        };
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        self.deserialize_str(visitor)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        self.locate(match &self.kind {
            ValueKind::Name(name) if &**name == "None" => visitor.visit_none(),
            _ => visitor.visit_some(self.some().unwrap_or(self)),
        })
    }

    fn deserialize_unit<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        match &self.kind {
            ValueKind::Unit => self.locate(visitor.visit_unit()),
            _ => self.expected("`()`"),
        }
    }

    fn deserialize_unit_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value> {
        match &self.kind {
            ValueKind::Name(found) if &**found == name => self.locate(visitor.visit_unit()),
            _ => self.deserialize_unit(visitor),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value> {
        match self.without_name(name).single() {
            Some(inner) => self.locate(visitor.visit_newtype_struct(inner)),
            None => self.expected("one value in brackets `(..)`"),
        }
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        match &self.kind {
            ValueKind::List(items) => self.visit_items(items, visitor),
            _ => self.expected("a list `[..]`"),
        }
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value> {
        match &self.kind {
            ValueKind::Tuple(items) => self.visit_items(items, visitor),
            ValueKind::Unit => self.visit_items(&[], visitor),
            _ => self.expected("values in brackets `(.., ..)`"),
        }
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        len: usize,
        visitor: V,
    ) -> Result<V::Value> {
        self.without_name(name).deserialize_tuple(len, visitor)
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        match &self.kind {
            ValueKind::Map(entries) => self.locate(visitor.visit_map(Pairs::new(entries))),
            _ => self.expected("a map `{..}`"),
        }
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        self.without_name(name).visit_fields(visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        match &self.kind {
            ValueKind::Name(_) | ValueKind::Call(_) => {
                self.locate(visitor.visit_enum(Variant(self)))
            }
            _ => self.expected("a variant"),
        }
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        self.locate(visitor.visit_unit())
    }

    forward_to_deserialize_any! { identifier bytes byte_buf }
}

/// The items of a list or tuple.
struct Items<'de>(slice::Iter<'de, Value>);

impl<'de> SeqAccess<'de> for &mut Items<'de> {
    type Error = Error;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>> {
        self.0.next().map(|item| item.read(seed)).transpose()
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.0.len())
    }
}

/// Deserializes the name of a field or of a variant.
fn read_name<'de, T: DeserializeSeed<'de>>(
    name: &'de str,
    span: Span,
    seed: T,
) -> Result<T::Value> {
    let read = seed.deserialize(BorrowedStrDeserializer::<Error>::new(name));
    read.map_err(|Error { message, .. }| Error {
        message,
        span: Some(span),
    })
}

/// A field of a struct, or an entry of a map. Fields and entries have different types. With a common type, the code
/// that reads the name of a field would also contain code for keys of any kind. The code that reads names is the
/// largest part of the code that is generated for a struct.
trait Pair {
    fn read_key<'de, K: DeserializeSeed<'de>>(&'de self, seed: K) -> Result<K::Value>;
    fn value(&self) -> &Value;
}

impl Pair for Field {
    fn read_key<'de, K: DeserializeSeed<'de>>(&'de self, seed: K) -> Result<K::Value> {
        read_name(&self.name.text, self.name.span, seed)
    }

    fn value(&self) -> &Value {
        &self.value
    }
}

impl Pair for (Value, Value) {
    fn read_key<'de, K: DeserializeSeed<'de>>(&'de self, seed: K) -> Result<K::Value> {
        self.0.read(seed)
    }

    fn value(&self) -> &Value {
        &self.1
    }
}

/// The fields of a struct, or the entries of a map.
struct Pairs<'de, P> {
    pairs: slice::Iter<'de, P>,
    value: Option<&'de Value>,
}

impl<'de, P> Pairs<'de, P> {
    fn new(pairs: &'de [P]) -> Self {
        Self {
            pairs: pairs.iter(),
            value: None,
        }
    }
}

impl<'de, P: Pair> MapAccess<'de> for Pairs<'de, P> {
    type Error = Error;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>> {
        let Some(pair) = self.pairs.next() else {
            return Ok(None);
        };
        self.value = Some(pair.value());
        pair.read_key(seed).map(Some)
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value> {
        self.value.expect("a value follows its key").read(seed)
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.pairs.len())
    }
}

/// `Name` or `Name(..)`.
struct Variant<'de>(&'de Value);

impl<'de> EnumAccess<'de> for Variant<'de> {
    type Error = Error;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self)> {
        let Some((name, span)) = self.0.name() else {
            return self.0.expected("a variant");
        };
        let variant = read_name(name, span, seed)?;
        Ok((variant, self))
    }
}

impl<'de> Variant<'de> {
    /// Returns the parameters of the variant: the part in parentheses.
    fn body(&self) -> Result<&'de Value> {
        match &self.0.kind {
            ValueKind::Call(call) => Ok(&call.body),
            _ => self.0.expected("a variant with parameters"),
        }
    }
}

impl<'de> VariantAccess<'de> for Variant<'de> {
    type Error = Error;

    fn unit_variant(self) -> Result<()> {
        match &self.0.kind {
            ValueKind::Name(_) => Ok(()),
            _ => self.0.expected("a variant without parameters"),
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value> {
        let body = self.body()?;
        match body.single() {
            Some(inner) => inner.read(seed),
            None => body.expected("one value in brackets `(..)`"),
        }
    }

    fn tuple_variant<V: Visitor<'de>>(self, len: usize, visitor: V) -> Result<V::Value> {
        self.body()?.deserialize_tuple(len, visitor)
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        self.body()?.visit_fields(visitor)
    }
}
