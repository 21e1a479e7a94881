//! Updates the recorded values of a recipe. If an expectation does not hold, its recorded value in the text of the
//! recipe is replaced by the actual value. The rest of the text stays unchanged.
//!
//! Recorded values are `eq`, `is`, the digest in `Digest`, the two corners in `Bounds`, and the reference file of
//! `Output`. Requirements are never changed: one-sided bounds such as `min` and `below`, and conditions such as
//! `Manifold`. Values that come from parameters are also never changed.

use std::collections::BTreeMap;
use std::path::PathBuf;

use crate::expect::ActualValue;
use crate::recipe::Recipe;
use crate::run::{Outcome, UnmetExpectation};
use ron_tree::{Diagnostic, LineIndex, Span, Value, ValueKind, string_literal};

/// A recipe with updated recorded values.
#[derive(Clone, Debug)]
pub struct Update {
    /// The new text of the recipe.
    pub text: String,
    /// The changes, in the order of the text.
    pub changes: Vec<Change>,
    /// The reference files to write, with their contents.
    pub files: BTreeMap<PathBuf, Vec<u8>>,
    /// The failures that the update does not fix, in the order of the run. If a failure is an expectation that does not
    /// hold, its help text says why the update does not fix the expectation.
    pub left: Vec<Diagnostic>,
}

/// A change of a recorded value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// The span of the expectation in the old text.
    pub span: Span,
    /// The line of the expectation in the old text, counted from 1.
    pub line: usize,
    /// The old expectation, in one line.
    pub was: String,
    /// The new value.
    pub found: String,
}

/// Updates the recorded values in the text of the recipe itself to the actual values of a run.
pub fn update(recipe: &Recipe, outcome: &Outcome) -> Update {
    let source: &str = recipe.sources.first().map_or("", |source| &source.text);
    let tree = ron_tree::parse(source).value;
    let lines = LineIndex::new(source);
    let (mut edits, mut changes, mut fixed) = (Vec::new(), Vec::new(), Vec::new());
    let mut left = outcome.failures.clone();
    let mut files = BTreeMap::new();
    for turns in unmet_in_text(recipe, outcome) {
        let fix = find_fix(&tree, recipe, &turns).and_then(|(value, fix)| {
            let is_conflict = |(path, bytes): &(PathBuf, Vec<u8>)| {
                files.get(path).is_some_and(|before| before != bytes)
            };
            match &fix.file {
                Some(file) if is_conflict(file) => {
                    Err("another expectation records a different file under this name".to_owned())
                }
                _ => Ok((value, fix)),
            }
        });
        match fix {
            Ok((value, fix)) => {
                changes.push(Change {
                    span: value.span,
                    line: lines.position(value.span.start).0,
                    was: value.to_string(),
                    found: fix.shown,
                });
                edits.extend(fix.edits);
                files.extend(fix.file);
                fixed.extend(turns.iter().flatten().map(|unmet| unmet.failure));
            }
            Err(why) => {
                for unmet in turns.iter().flatten() {
                    if let Some(failure) = left.get_mut(unmet.failure) {
                        failure.help.get_or_insert_with(|| why.clone());
                    }
                }
            }
        }
    }
    fixed.sort_unstable();
    changes.sort_by_key(|change| change.span);
    let mut number = 0..;
    left.retain(|_| {
        number
            .next()
            .is_some_and(|i| fixed.binary_search(&i).is_err())
    });
    // The edits cannot overlap, because neither expectations nor the values in them overlap.
    let text = ron_tree::replace(source, edits).unwrap_or_else(|_| source.to_owned());
    Update {
        text,
        changes,
        files,
        left,
    }
}

/// Finds the expectations that fail after one or more repetitions of the step to which they belong. For each of these
/// expectations, returns a list with one entry for each repetition. The entry is the failure of the expectation in this
/// repetition, or `None` if the expectation holds.
fn unmet_in_text<'o>(
    recipe: &Recipe,
    outcome: &'o Outcome,
) -> Vec<Vec<Option<&'o UnmetExpectation>>> {
    let mut unmet = vec![None; recipe.expectations.len()];
    for expectation in &outcome.unmet {
        if let Some(slot) = unmet.get_mut(expectation.expectation) {
            *slot = Some(expectation);
        }
    }
    let mut places: BTreeMap<_, Vec<Option<&UnmetExpectation>>> = BTreeMap::new();
    for (placed, unmet) in recipe.expectations.iter().zip(unmet) {
        if placed.after.is_none_or(|i| i < outcome.steps.len()) {
            let place = (placed.scope, placed.span);
            places.entry(place).or_default().push(unmet);
        }
    }
    places.retain(|_, turns| turns.iter().any(Option::is_some));
    places.into_values().collect()
}

/// Finds an expectation in the syntax tree of the recipe. `turns` has one entry for each repetition of the step: the
/// failure of the expectation, or `None` if the expectation holds. Returns the expectation and the edits that record
/// the actual value, or the reason why the expectation cannot be updated.
fn find_fix<'t>(
    tree: &'t Value,
    recipe: &Recipe,
    turns: &[Option<&UnmetExpectation>],
) -> Result<(&'t Value, Fix), String> {
    let unmet = turns.iter().flatten().next().ok_or(NOT_RECORDED)?;
    let placed = recipe
        .expectations
        .get(unmet.expectation)
        .ok_or(NOT_RECORDED)?;
    if recipe.source_of(placed.scope) != 0 {
        let help = "the expectation belongs to a called recipe, and expectations of called recipes are not updated";
        return Err(help.to_owned());
    }
    let value = expectation_at(tree, placed.span).ok_or(NOT_RECORDED)?;
    let fix = fix(value, unmet.found.as_ref())?;
    let is_same = |turn: &UnmetExpectation| turn.found == unmet.found;
    if !turns.iter().all(|turn| turn.is_some_and(is_same)) {
        let help =
            "the repetitions of the step give different values, so the expectation is not updated";
        return Err(help.to_owned());
    }
    Ok((value, fix))
}

const NOT_RECORDED: &str = "only recorded values (`eq`, `is`, `Bounds`, `Digest`, `Output`) are updated, and this is not one of them";

/// Returns the expectation at `span`.
fn expectation_at(tree: &Value, span: Span) -> Option<&Value> {
    let listed = tree.field("expect")?.items()?;
    listed
        .iter()
        .flat_map(|item| match (item.name(), item.field("that")) {
            (None, Some(that)) => that.items().unwrap_or(std::slice::from_ref(that)),
            _ => std::slice::from_ref(item),
        })
        .find(|item| item.span == span)
}

/// The changes that replace the recorded value of one expectation by the actual value.
struct Fix {
    /// The edits of the text.
    edits: Vec<(Span, String)>,
    /// The reference file to write, with its content.
    file: Option<(PathBuf, Vec<u8>)>,
    /// The new value, as shown to users.
    shown: String,
}

/// Returns the changes that replace the recorded value by the actual value, or the reason why this is not possible.
fn fix(expectation: &Value, found: Option<&ActualValue>) -> Result<Fix, String> {
    let found = found.ok_or(NOT_RECORDED)?;
    let recorded = |field: &str| -> Result<&Value, String> {
        let value = expectation.field(field).ok_or(NOT_RECORDED)?;
        Ok(value.some().unwrap_or(value))
    };
    match found {
        ActualValue::Count(n) => {
            let value = recorded("eq")?;
            let text = grouped_like(&n.to_string(), number_text(value)?);
            Ok(Fix::one(value, text))
        }
        ActualValue::Number(x) => {
            let value = recorded("eq")?;
            let text = float_like(*x, number_text(value)?)?;
            Ok(Fix::one(value, text))
        }
        ActualValue::Digest(digest) => {
            let ValueKind::Call(call) = &expectation.kind else {
                return Err(NOT_RECORDED.to_owned());
            };
            let value = call.body.single().ok_or(NOT_RECORDED)?;
            not_from_parameter(value)?;
            Ok(Fix::one(value, string_literal(digest)))
        }
        ActualValue::File { golden, bytes, .. } => Ok(Fix {
            edits: Vec::new(),
            file: Some((golden.clone(), bytes.clone())),
            shown: format!("{} is written", golden.display()),
        }),
        ActualValue::Position { at, tolerance } => {
            // If every coordinate deviates by at most half of the tolerance, the distance is within the tolerance.
            // Therefore, only a coordinate that deviates by more than half of the tolerance is edited.
            let edits = vector(recorded("is")?, at.to_array(), 0.5 * tolerance)?;
            Fix::several(edits, format!("({}, {}, {})", at.x, at.y, at.z))
        }
        ActualValue::Bounds {
            min,
            max,
            tolerance,
        } => {
            // The tolerance of `Bounds` applies to each coordinate separately.
            let mut edits = vector(recorded("min")?, min.to_array(), *tolerance)?;
            edits.extend(vector(recorded("max")?, max.to_array(), *tolerance)?);
            let corner = |p: &mesh::DVec3| format!("({}, {}, {})", p.x, p.y, p.z);
            Fix::several(edits, format!("{} to {}", corner(min), corner(max)))
        }
    }
}

impl Fix {
    fn one(value: &Value, text: String) -> Self {
        Self {
            edits: vec![(value.span, text.clone())],
            file: None,
            shown: text,
        }
    }

    fn several(edits: Vec<(Span, String)>, shown: String) -> Result<Self, String> {
        if edits.is_empty() {
            return Err(NOT_RECORDED.to_owned());
        }
        Ok(Self {
            edits,
            file: None,
            shown,
        })
    }
}

/// Returns edits that replace coordinates of the vector `value` by those of `found`. A coordinate is replaced only if
/// the two values differ by more than `allowed`.
fn vector(value: &Value, found: [f64; 3], allowed: f64) -> Result<Vec<(Span, String)>, String> {
    not_from_parameter(value)?;
    let body = match &value.kind {
        ValueKind::Call(call) => &call.body,
        _ => value,
    };
    let ValueKind::Tuple(numbers) = &body.kind else {
        return Err(NOT_RECORDED.to_owned());
    };
    let mut edits = Vec::new();
    for (number, x) in numbers.iter().zip(found) {
        not_from_parameter(number)?;
        let ValueKind::Number(written) = &number.kind else {
            return Err(NOT_RECORDED.to_owned());
        };
        let is_near = (written.to_float() - x).abs() <= allowed;
        if !is_near {
            edits.push((number.span, float_like(x, written.text())?));
        }
    }
    Ok(edits)
}

fn number_text(value: &Value) -> Result<&str, String> {
    not_from_parameter(value)?;
    match &value.kind {
        ValueKind::Number(number) => Ok(number.text()),
        _ => Err(NOT_RECORDED.to_owned()),
    }
}

/// Returns an error if the value comes from a parameter. A value that comes from a parameter is not updated, because
/// other values possibly depend on the parameter.
fn not_from_parameter(value: &Value) -> Result<(), String> {
    match &value.kind {
        ValueKind::Call(call) if &*call.name.text == "arg" => Err(format!(
            "the expected value {value} comes from a parameter, so the expectation is not updated"
        )),
        _ => Ok(()),
    }
}

/// Formats a number as RON. `written` is the text of the number that is replaced, and determines the style. A whole
/// number is written with a decimal point only if `written` has a decimal point or an exponent. The digits are grouped
/// if `written` has digit groups.
fn float_like(x: f64, written: &str) -> Result<String, String> {
    if !x.is_finite() {
        return Err(format!("{x} cannot be recorded"));
    }
    // Adding 0 turns -0 into 0, so that -0 is never recorded.
    let text = format!("{:?}", x + 0.0);
    let is_whole = !written.contains(['.', 'e', 'E']);
    let text = match text.strip_suffix(".0") {
        Some(whole) if is_whole => whole,
        _ => &text,
    };
    Ok(grouped_like(text, written))
}

/// Writes the digits before the decimal point in groups of three, if `written` has digit groups.
fn grouped_like(text: &str, written: &str) -> String {
    if !written.contains('_') || text.contains('e') {
        return text.to_owned();
    }
    let (sign, digits) = text
        .strip_prefix('-')
        .map_or(("", text), |rest| ("-", rest));
    let (whole, rest) = digits.split_at(digits.find('.').unwrap_or(digits.len()));
    let mut grouped = sign.to_owned();
    for (i, digit) in whole.chars().enumerate() {
        if i > 0 && (whole.len() - i).is_multiple_of(3) {
            grouped.push('_');
        }
        grouped.push(digit);
    }
    grouped + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_in_the_style_of_those_that_they_replace() {
        let float = |x, written| float_like(x, written).unwrap();
        assert_eq!(float(24.0, "23"), "24");
        assert_eq!(float(24.0, "23.0"), "24.0");
        assert_eq!(float(0.1, "23"), "0.1");
        assert_eq!(float(-0.0, "1"), "0");
        assert_eq!(float(1e-7, "1"), "1e-7");
        assert_eq!(float(12_345.5, "1_000"), "12_345.5");
        assert_eq!(float(-1_234_567.0, "1_000.0"), "-1_234_567.0");
        assert!(float_like(f64::INFINITY, "1").is_err());
        assert_eq!(grouped_like("16224", "16_225"), "16_224");
        assert_eq!(grouped_like("224", "16_225"), "224");
        assert_eq!(grouped_like("16224", "7"), "16224");
    }
}
