//! Formats an expectation in the form in which it is written in a recipe.

use ron_tree::{Value, ValueKind, parse};

use super::Expectation;

impl Expectation {
    /// Returns the expectation as it is written in a recipe, in one line. Optional values are written without
    /// `Some(..)`, and fields with default values are omitted.
    pub(super) fn as_written(&self) -> String {
        let canonical = self.to_string();
        let mut value = parse(&canonical).value;
        unwrap_options(&mut value);
        for i in (0..n_fields(&value)).rev() {
            let mut shorter = value.clone();
            remove_field(&mut shorter, &mut { i });
            let read: Result<Self, _> = ron_tree::from_str(&shorter.to_string());
            if read.is_ok_and(|read| read == *self) {
                value = shorter;
            }
        }
        value.to_string()
    }
}

/// Replaces each `Some(x)` by `x`.
fn unwrap_options(value: &mut Value) {
    if let Some(inner) = value.some() {
        *value = inner.clone();
    }
    value.for_each_part(unwrap_options);
}

/// Returns the total number of fields of all structs in the value.
fn n_fields(value: &Value) -> usize {
    let own = match &value.kind {
        ValueKind::Struct(body) => body.fields.len(),
        _ => 0,
    };
    own + value.parts().map(n_fields).sum::<usize>()
}

/// Removes the field with the number `number`. Fields are numbered in the order in which [`n_fields`] counts them: the
/// fields of a struct come before the fields of its values. If the value has too few fields, `number` is reduced by the
/// count of these fields, so that the search can continue in the next value. After the removal, `number` is
/// [`usize::MAX`].
fn remove_field(value: &mut Value, number: &mut usize) {
    if let ValueKind::Struct(body) = &mut value.kind {
        if *number < body.fields.len() {
            body.fields.remove(*number);
            *number = usize::MAX;
            return;
        }
        *number -= body.fields.len();
    }
    value.for_each_part(|part| {
        if *number != usize::MAX {
            remove_field(part, number);
        }
    });
}
