//! The values that a sweep gives to a parameter.

use std::path::Path;

use schemars::JsonSchema;
use serde::Deserialize;

use super::{MAX_CELLS, Setting};
use crate::params::Param;
use crate::schema;
use crate::shape;
use ron_tree::{Diagnostic, Span, Value, ValueKind};

/// Values that are not listed one by one.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
enum Values {
    /// Numbers at equal distances.
    Range {
        /// The first.
        from: f64,
        /// The last.
        to: f64,
        /// How many numbers, the first and the last included.
        #[schemars(range(min = 1))]
        steps: u32,
    },
}

/// The values of `[..]` or `Range(..)` for a parameter.
pub(super) fn settings(
    param: &Param,
    value: &Value,
    folder: &Path,
) -> Result<Vec<Setting>, Vec<Diagnostic>> {
    if let ValueKind::List(items) = &value.kind {
        if items.is_empty() {
            let message = "expected a value, found none";
            return Err(vec![Diagnostic::error(value.span, message)]);
        }
        return together(items.iter().map(|item| setting(param, item, folder)));
    }
    if !matches!(value.kind, ValueKind::Call(_)) {
        let message = format!(
            "expected a list of values `[..]` or `Range(from: .., to: .., steps: ..)`, found {}",
            value.describe()
        );
        return Err(vec![Diagnostic::error(value.span, message)]);
    }
    let Values::Range { from, to, steps } = shape::typed(value, &schema::of::<Values>())?;
    range(param, [from, to], steps, value.span)
}

/// All of them, or everything that is wrong.
fn together(
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
    steps: u32,
    span: Span,
) -> Result<Vec<Setting>, Vec<Diagnostic>> {
    let problem = |message: String| vec![Diagnostic::error(span, message)];
    let whole = match param {
        Param::Int { .. } => true,
        Param::Float { .. } => false,
        _ => {
            let kind = param.type_name();
            let message = format!(
                "expected a list of values `[..]`: the parameter is of type {kind}, and a range is for numbers"
            );
            return Err(problem(message));
        }
    };
    if steps as usize > MAX_CELLS {
        let message = format!("`steps` is {steps}, expected at most {MAX_CELLS}");
        return Err(problem(message));
    }
    if steps == 1 && from != to {
        let message = format!("one step has one value, and the range has {from} and {to}");
        return Err(problem(message));
    }
    let last = f64::from(steps.max(2) - 1);
    let each = (0..steps).map(|i| {
        // Both ends weighed, so that 0.1 to 0.5 has 0.3 in its middle, and no rounding of a sum.
        let i = f64::from(i);
        let x = (from * (last - i) + to * i) / last;
        if whole && x.fract() != 0.0 {
            let message = format!("expected whole numbers, and {x} is in this range");
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
    let settings = together(each);
    // The first of them says it.
    settings.map_err(|mut wrong| {
        wrong.truncate(1);
        wrong
    })
}

/// One value for a parameter.
pub(super) fn setting(
    param: &Param,
    value: &Value,
    folder: &Path,
) -> Result<Setting, Vec<Diagnostic>> {
    if value.has_errors() {
        // What could not be read was reported.
        return Err(Vec::new());
    }
    let held = param
        .value_from(value, None)
        .map_err(|error| vec![Diagnostic::error(value.span, error.to_string())])?;
    // As plain text: what stands in quotes is without them, and all else is as RON has it.
    let text = match (param, value.as_str()) {
        (Param::Path { .. }, Some(path)) => folder.join(path).to_string_lossy().into_owned(),
        (_, Some(text)) => text.to_owned(),
        (_, None) => held.to_string(),
    };
    Ok(Setting { text, value: held })
}
