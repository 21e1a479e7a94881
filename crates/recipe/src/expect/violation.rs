//! Violations of expectations, and the comparisons of values that report them.

use std::borrow::Cow;
use std::fmt;
use std::path::PathBuf;

use mesh::DVec3;

/// Why an expectation does not hold, or why an expectation or a metric cannot be evaluated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct Violation {
    /// The expected and the actual value, or the reason why the evaluation failed, in one line.
    pub message: String,
    /// The actual value. If it replaces the expected value in the recipe, the expectation holds. `None` if no
    /// replacement is possible.
    pub found: Option<ActualValue>,
    /// Whether the expectation could not be checked, for example because a file cannot be read. In this case, `Not(..)`
    /// of the expectation does not hold either.
    pub(super) is_unknown: bool,
}

impl Violation {
    /// Creates a violation without an actual value, so that `meshwright test --update` does not change the expectation.
    pub(super) fn unmet(message: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            found: None,
            is_unknown: false,
        }
    }

    /// Creates a violation with the actual value, which can replace the expected value in the recipe.
    pub(super) fn with_actual(message: String, found: ActualValue) -> Self {
        Self {
            found: Some(found),
            ..Self::unmet(message)
        }
    }
}

/// Creates a violation for an expectation or a metric that cannot be evaluated.
impl From<String> for Violation {
    fn from(message: String) -> Self {
        Self {
            is_unknown: true,
            ..Self::unmet(message)
        }
    }
}

impl From<&str> for Violation {
    fn from(message: &str) -> Self {
        message.to_owned().into()
    }
}

/// The actual value of an expectation. It can replace the expected value in the recipe.
#[derive(Clone, Debug, PartialEq)]
pub enum ActualValue {
    /// An integer, which can replace the value of `eq`.
    Count(i128),
    /// A number, which can replace the value of `eq`.
    Number(f64),
    /// The digest of the scene.
    Digest(String),
    /// A reference file beside the recipe.
    File {
        /// The path of the reference file.
        golden: PathBuf,
        /// The contents of the file that the step has written.
        bytes: Vec<u8>,
        /// The allowed difference between the colors of two pictures, in steps of 1/255.
        tolerance: u8,
    },
    /// A position, which can replace the value of `is`.
    Position {
        /// The actual position.
        at: DVec3,
        /// The allowed distance from the expected position.
        tolerance: f64,
    },
    /// A bounding box, which can replace the two corners in `Bounds`.
    Bounds {
        /// The lowest coordinates.
        min: DVec3,
        /// The highest coordinates.
        max: DVec3,
        /// The allowed deviation of each coordinate.
        tolerance: f64,
    },
}

pub(super) fn check_position(
    at: DVec3,
    is: DVec3,
    tolerance: f64,
    what: impl FnOnce() -> String,
) -> Result<(), Violation> {
    if at.distance(is) <= tolerance {
        return Ok(());
    }
    let message = format!("expected {} at {is}, found it at {at}", what());
    Err(Violation::with_actual(
        message,
        ActualValue::Position { at, tolerance },
    ))
}

pub(super) fn fails_unless(holds: bool, message: impl FnOnce() -> String) -> Result<(), Violation> {
    if holds {
        Ok(())
    } else {
        Err(Violation::unmet(message()))
    }
}

/// Checks a count against `eq`, `min` and `max`. `what` is a noun in the plural, such as "faces".
pub(super) fn check_count(
    what: impl fmt::Display,
    found: u64,
    bounds: [Option<u64>; 3],
) -> Result<(), Violation> {
    check_exact(found, bounds, |word, n| {
        let what = what.to_string();
        let what = singular_if_one(n, &what);
        format!("expected {word}{n} {what}, found {found}")
    })
}

/// Checks an integer against `eq`, `min` and `max`. `what` is a noun with its article, such as "a genus".
pub(super) fn check_integer(
    what: &str,
    found: i64,
    bounds: [Option<i64>; 3],
) -> Result<(), Violation> {
    check_exact(found, bounds, |word, n| {
        format!("expected {what} of {word}{n}, found {found}")
    })
}

fn check_exact<T: PartialOrd + Copy + Into<i128>>(
    found: T,
    bounds: [Option<T>; 3],
    message: impl Fn(&str, T) -> String,
) -> Result<(), Violation> {
    let is_equal = bounds[0].is_none_or(|n| found == n);
    let actual = ActualValue::Count(found.into());
    check_bounds(found, bounds, is_equal, actual, message)
}

/// Returns `what`, a noun in the plural, or its singular if `n` is 1.
fn singular_if_one(n: u64, what: &str) -> Cow<'_, str> {
    if n != 1 {
        Cow::Borrowed(what)
    } else if let Some(stem) = what.strip_suffix("vertices") {
        Cow::Owned(format!("{stem}vertex"))
    } else if let Some(stem) = what.strip_suffix("ies") {
        Cow::Owned(format!("{stem}y"))
    } else {
        Cow::Borrowed(what.strip_suffix('s').unwrap_or(what))
    }
}

/// Checks a number against `eq` (within the tolerance), `min` and `max`. `what` follows the word "expected" in the
/// error message, for example "an area" or "v3 to have a thickness".
pub(super) fn check_number(
    what: impl fmt::Display,
    found: f64,
    bounds: [Option<f64>; 3],
    tolerance: f64,
) -> Result<(), Violation> {
    let is_equal = bounds[0].is_none_or(|x| (found - x).abs() <= tolerance);
    check_bounds(
        found,
        bounds,
        is_equal,
        ActualValue::Number(found),
        |word, x| {
            let found = if word.is_empty() {
                found.to_string()
            } else {
                rounded(found, x)
            };
            format!("expected {what} of {word}{x}, found {found}")
        },
    )
}

/// Formats a number that violates a limit, with six significant digits. If the rounded number would appear to satisfy
/// the limit, keeps all digits.
pub(super) fn rounded(found: f64, limit: f64) -> String {
    let short = mesh::readable(found);
    let order = short.parse::<f64>().ok().map(|x| x.total_cmp(&limit));
    if order == Some(found.total_cmp(&limit)) {
        short
    } else {
        found.to_string()
    }
}

/// Checks the bounds `eq`, `min` and `max` in this order, and returns the first violation. The violation contains the
/// actual value only if `eq` does not hold but `min` and `max` do. If `min` or `max` does not hold, the expectation
/// would still fail with the actual value as `eq`.
fn check_bounds<T: PartialOrd + Copy>(
    found: T,
    [eq, min, max]: [Option<T>; 3],
    is_equal: bool,
    actual: ActualValue,
    message: impl Fn(&str, T) -> String,
) -> Result<(), Violation> {
    let is_high_enough = min.is_none_or(|min| found >= min);
    let is_low_enough = max.is_none_or(|max| found <= max);
    match (eq, min, max) {
        (Some(eq), ..) if !is_equal => Err(Violation {
            found: (is_high_enough && is_low_enough).then_some(actual),
            ..Violation::unmet(message("", eq))
        }),
        (_, Some(min), _) if !is_high_enough => Err(Violation::unmet(message("at least ", min))),
        (.., Some(max)) if !is_low_enough => Err(Violation::unmet(message("at most ", max))),
        _ => Ok(()),
    }
}
