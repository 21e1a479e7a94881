//! Reads the values that a sweep has for a parameter.

use std::path::Path;

use schemars::JsonSchema;
use serde::Deserialize;

use super::{MAX_CELLS, Setting};
use crate::params::Param;
use crate::schema;
use crate::schema_check;
use ron_tree::{Diagnostic, Span, Value, ValueKind};

/// A short form that stands for a list of values.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
enum Values {
    /// Evenly spaced numbers.
    Range {
        /// The first number.
        from: f64,
        /// The last number.
        to: f64,
        /// The number of values, including the first and the last. If omitted, the values are all whole numbers from
        /// the first to the last.
        #[serde(default)]
        #[schemars(range(min = 1))]
        steps: Option<u32>,
    },
}

/// Reads the values of a parameter. They are written as `[..]` or `Range(..)`.
pub(super) fn settings(
    param: &Param,
    value: &Value,
    folder: &Path,
) -> Result<Vec<Setting>, Vec<Diagnostic>> {
    if let ValueKind::List(items) = &value.kind {
        if items.is_empty() {
            let message = "expected at least one value, found an empty list";
            return Err(vec![Diagnostic::error(value.span, message)]);
        }
        return collect(items.iter().map(|item| setting(param, item, folder)));
    }
    if !matches!(value.kind, ValueKind::Call(_)) {
        let message = format!(
            "expected a list of values `[..]` or `Range(from: .., to: .., steps: ..)`, found {}",
            value.describe()
        );
        return Err(vec![Diagnostic::error(value.span, message)]);
    }
    let Values::Range { from, to, steps } = schema_check::typed(value, &schema::of::<Values>())?;
    range(param, [from, to], steps, value.span)
}

/// Returns all values, or all errors if there are any.
fn collect(
    each: impl Iterator<Item = Result<Setting, Vec<Diagnostic>>>,
) -> Result<Vec<Setting>, Vec<Diagnostic>> {
    let (mut settings, mut wrong) = (Vec::new(), Vec::new());
    for one in each {
        match one {
            Ok(setting) => settings.push(setting),
            Err(more) => wrong.extend(more),
        }
    }
    if wrong.is_empty() {
        Ok(settings)
    } else {
        Err(wrong)
    }
}

fn range(
    param: &Param,
    [from, to]: [f64; 2],
    steps: Option<u32>,
    span: Span,
) -> Result<Vec<Setting>, Vec<Diagnostic>> {
    let problem = |message: String| vec![Diagnostic::error(span, message)];
    let whole = match param {
        Param::Int { .. } => true,
        Param::Float { .. } => false,
        _ => {
            let kind = param.type_name();
            let message = format!(
                "expected a list of values `[..]`: `Range` is for numbers, but the parameter has the type {kind}"
            );
            return Err(problem(message));
        }
    };
    let steps = match steps {
        Some(steps) => steps,
        None if whole => whole_numbers(from, to),
        None => {
            let message = "`Range` needs `steps` for a parameter that is not a whole number";
            return Err(problem(message.to_owned()));
        }
    };
    if steps as usize > MAX_CELLS {
        let message = format!("`steps` is {steps}, expected at most {MAX_CELLS}");
        return Err(problem(message));
    }
    if steps == 1 && from != to {
        let message =
            format!("`from` and `to` must be equal if `steps` is 1, found {from} and {to}");
        return Err(problem(message));
    }
    let last = f64::from(steps.max(2) - 1);
    let each = (0..steps).map(|i| {
        // A weighted mean of both ends has less rounding error than a repeated sum. For example, the middle of the
        // range from 0.1 to 0.5 is exactly 0.3.
        let i = f64::from(i);
        let x = (from * (last - i) + to * i) / last;
        if whole && x.fract() != 0.0 {
            let message = format!("expected whole numbers, but this range contains {x}");
            return Err(problem(message));
        }
        let text = if whole {
            format!("{x:.0}")
        } else {
            format!("{x:?}")
        };
        match param.value_of(&text, None) {
            Ok(value) => Ok(Setting { text, value }),
            Err(error) => Err(problem(error.to_string())),
        }
    });
    let settings = collect(each);
    // All errors are about the same range, so the first one is enough.
    settings.map_err(|mut wrong| {
        wrong.truncate(1);
        wrong
    })
}

/// Returns how many whole numbers there are from one number to another, including both. The result is at most
/// [`u32::MAX`].
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "numbers that are too large become the maximum"
)]
fn whole_numbers(from: f64, to: f64) -> u32 {
    ((to - from).abs() + 1.0) as u32
}

/// Reads one value of a parameter.
pub(super) fn setting(
    param: &Param,
    value: &Value,
    folder: &Path,
) -> Result<Setting, Vec<Diagnostic>> {
    if value.has_errors() {
        // The parser has reported the error.
        return Err(Vec::new());
    }
    let checked = param
        .value_from(value, None)
        .map_err(|error| vec![Diagnostic::error(value.span, error.to_string())])?;
    // The plain text of a string has no quotes. All other values are written as RON.
    let text = match (param, value.as_str()) {
        (Param::Path { .. }, Some(path)) => folder.join(path).to_string_lossy().into_owned(),
        (_, Some(text)) => text.to_owned(),
        (_, None) => checked.to_string(),
    };
    Ok(Setting {
        text,
        value: checked,
    })
}
