//! Sets and removes fields of a value. A field is given by its path.

use ron_tree::{Span, Value, ValueKind};

use super::entries::{insert_entry, remove_entry};
use super::{Edits, TextError};

/// Returns the value at a path. The form of paths is described at [`set_field`]. Returns `None` if the text has no
/// value at this path.
pub(crate) fn field_value<'v>(value: &'v Value, path: &[String]) -> Option<&'v Value> {
    let mut place = Place::of(value);
    for item in path {
        place = place.into_item(item)?;
    }
    Some(place.value)
}

/// Sets the value at a path to `new`. If `new` is `None`, removes the field from the text. The field then has its
/// default value.
///
/// A path leads into a value from the outside, for example `["edges", "Random", "count"]`. Each entry is the name of a
/// field or a variant, a key of a map, or the index of an item. If the text does not have the field yet, the field is
/// added, together with the missing fields that contain it.
///
/// # Errors
///
/// Returns [`TextError::NoPlace`] if the path leads into a value that has no fields, or to an item that does not exist.
pub(crate) fn set_field(
    text: &str,
    value: &Value,
    path: &[String],
    new: Option<&str>,
) -> Result<Edits, TextError> {
    let no_place = || TextError::NoPlace(path.join("."));
    let mut place = Place::of(value);
    for (i, item) in path.iter().enumerate() {
        if let Some(next) = place.into_item(item) {
            place = next;
            continue;
        }
        let Some(new) = new else {
            return Ok(Vec::new());
        };
        let entry = written(&path[i..], new).ok_or_else(no_place)?;
        return add_field(text, place.value, &entry).ok_or_else(no_place);
    }
    let span = place.value.span;
    let name = path.last().map_or("", String::as_str);
    match (new, place.holder) {
        (Some(new), _) => Ok(vec![(span, new.to_owned())]),
        (None, Some(holder)) => remove_field(text, holder, name).ok_or_else(no_place),
        (None, None) => Err(no_place()),
    }
}

/// A value on the path. `in_variant` says whether the path has already named the variant of the value.
#[derive(Clone, Copy)]
struct Place<'v> {
    value: &'v Value,
    in_variant: bool,
    /// The struct that contains the value, if the value belongs to a field of a struct.
    holder: Option<&'v Value>,
}

impl<'v> Place<'v> {
    fn of(value: &'v Value) -> Self {
        Self {
            value,
            in_variant: false,
            holder: None,
        }
    }

    fn into_item(self, item: &str) -> Option<Self> {
        let value = self.value;
        if let Some(inner) = value.some() {
            return Self::of(inner).into_item(item);
        }
        let is_name = value.name().is_some_and(|(name, _)| name == item);
        if is_name && !self.in_variant {
            return Some(Self {
                value,
                in_variant: true,
                holder: None,
            });
        }
        match &value.kind {
            ValueKind::Call(call) => {
                let body = Self {
                    value: &call.body,
                    in_variant: true,
                    holder: None,
                };
                match call.body.single() {
                    Some(single) if item.parse::<usize>().is_err() => {
                        Self::of(single).into_item(item)
                    }
                    _ => body.into_item(item),
                }
            }
            ValueKind::Struct(_) => {
                let found = value.field(item)?;
                Some(Self {
                    holder: Some(value),
                    ..Self::of(found)
                })
            }
            ValueKind::Map(entries) => {
                let found = entries.iter().find(|(key, _)| key.as_str() == Some(item));
                found.map(|(_, value)| Self::of(value))
            }
            ValueKind::Tuple(items) | ValueKind::List(items) => {
                items.get(item.parse::<usize>().ok()?).map(Self::of)
            }
            _ => None,
        }
    }
}

/// Returns the text of a new entry for the part of a path that does not exist in the text yet. For example,
/// `["style", "wireframe"]` becomes `style: (wireframe: new)`.
fn written(path: &[String], new: &str) -> Option<String> {
    let mut text = new.to_owned();
    for (i, item) in path.iter().enumerate().rev() {
        let is_word = item.starts_with(|c: char| c.is_alphabetic() || c == '_')
            && item.chars().all(|c| c == '_' || c.is_alphanumeric());
        if !is_word {
            return None;
        }
        text = if i == 0 {
            format!("{item}: {text}")
        } else {
            format!("({item}: {text})")
        };
    }
    Some(text)
}

/// Adds a field after the last field of a value. Returns `None` if the value cannot have fields.
fn add_field(text: &str, value: &Value, entry: &str) -> Option<Edits> {
    let spans = entry_spans(value);
    match &value.kind {
        ValueKind::Name(_) => {
            let end = value.span.end;
            Some(vec![(Span::new(end, end), format!("({entry})"))])
        }
        ValueKind::Call(call) => add_field(text, &call.body, entry),
        ValueKind::Unit => Some(insert_entry(text, value.span, &[], 0, entry)),
        ValueKind::Struct(_) => Some(insert_entry(text, value.span, &spans, spans.len(), entry)),
        _ => None,
    }
}

fn remove_field(text: &str, parent: &Value, name: &str) -> Option<Edits> {
    let at = parent
        .fields()
        .iter()
        .position(|field| &*field.name.text == name)?;
    Some(remove_entry(text, &entry_spans(parent), at))
}

/// Returns the spans of the fields of a value. The span of a field contains both its name and its value: `name: value`.
pub(super) fn entry_spans(value: &Value) -> Vec<Span> {
    let fields = value.fields().iter();
    fields
        .map(|field| field.name.span.to(field.value.span))
        .collect()
}
