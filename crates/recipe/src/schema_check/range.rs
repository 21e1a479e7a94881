//! Checks numbers and their ranges.

use super::schema::Schema;
use super::{Checker, Place};
use ron_tree::{Number, Value};

impl Checker {
    pub(super) fn check_integer(
        &mut self,
        value: &Value,
        number: &Number,
        schema: &Schema,
        place: Place,
    ) {
        if matches!(number, Number::Float(_)) {
            return self.mismatch(value, &schema.expectation(), place, None);
        }
        let (least, most) = integer_range(schema);
        // A number that does not fit into 128 bits is out of every range.
        let out_of_range = if number.text().starts_with('-') {
            i128::MIN
        } else {
            i128::MAX
        };
        let int = number.to_int().unwrap_or(out_of_range);
        let limit = if int < least {
            format!("at least {least}")
        } else if int > most {
            format!("at most {most}")
        } else {
            return;
        };
        let message = format!("{} is {}, expected {limit}", place.subject(), number.text());
        self.report(
            value,
            value.span,
            message,
            Some(format!("allowed: {least} to {most}")),
        );
    }

    pub(super) fn check_number(
        &mut self,
        value: &Value,
        number: &Number,
        schema: &Schema,
        place: Place,
    ) {
        if number.has_base() {
            let help = "numbers that begin with `0x`, `0o` or `0b` are allowed only where a whole number is required";
            return self.mismatch(value, "a decimal number", place, Some(help.to_owned()));
        }
        let float = number.to_float();
        let single = schema.format() == Some("float");
        let largest = if single {
            f64::from(f32::MAX)
        } else {
            f64::MAX
        };
        if !float.is_finite() || single && is_infinite_single(float) {
            let text = number.text();
            let named = text.ends_with("inf") || text.ends_with("NaN");
            let message = format!("expected a finite number{}, found {text}", place.of());
            let help = (!named).then(|| format!("the largest number is {largest:e}"));
            return self.report(value, value.span, message, help);
        }
        let bounds = Bounds::of(schema);
        if let Some(limit) = bounds.violated_by(float) {
            let message = format!("{} is {}, expected {limit}", place.subject(), number.text());
            self.report(
                value,
                value.span,
                message,
                Some(format!("allowed: {}", bounds.describe())),
            );
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the conversion to 32 bits shows whether the value is too large"
)]
fn is_infinite_single(value: f64) -> bool {
    (value as f32).is_infinite()
}

/// Returns the smallest and the largest whole number that both the schema and its Rust type allow.
fn integer_range(schema: &Schema) -> (i128, i128) {
    let (mut least, mut most) = match schema.format() {
        Some("int8") => (i8::MIN.into(), i8::MAX.into()),
        Some("int16") => (i16::MIN.into(), i16::MAX.into()),
        Some("int32") => (i32::MIN.into(), i32::MAX.into()),
        Some("int64" | "int") => (i64::MIN.into(), i64::MAX.into()),
        Some("uint8") => (0, u8::MAX.into()),
        Some("uint16") => (0, u16::MAX.into()),
        Some("uint32") => (0, u32::MAX.into()),
        Some("uint64" | "uint") => (0, u64::MAX.into()),
        _ => (i128::MIN + 1, i128::MAX - 1),
    };
    for limit in schema.numbers("minimum") {
        least = least.max(to_int(limit, f64::ceil));
    }
    for limit in schema.numbers("exclusiveMinimum") {
        least = least.max(to_int(limit, f64::floor).saturating_add(1));
    }
    for limit in schema.numbers("maximum") {
        most = most.min(to_int(limit, f64::floor));
    }
    for limit in schema.numbers("exclusiveMaximum") {
        most = most.min(to_int(limit, f64::ceil).saturating_sub(1));
    }
    (least, most)
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "casts of floating-point numbers saturate"
)]
fn to_int(limit: &serde_json::Number, round: fn(f64) -> f64) -> i128 {
    limit
        .as_i128()
        .unwrap_or_else(|| round(limit.as_f64().unwrap_or(0.0)) as i128)
}

/// A range of numbers. Each limit is stored with a flag that is true if the limit is exclusive.
struct Bounds {
    least: Option<(f64, bool)>,
    most: Option<(f64, bool)>,
}

impl Bounds {
    fn of(schema: &Schema) -> Self {
        let limits = |keyword, is_exclusive| {
            let numbers = schema
                .numbers(keyword)
                .filter_map(serde_json::Number::as_f64);
            numbers.map(move |limit| (limit, is_exclusive))
        };
        let lower = limits("minimum", false).chain(limits("exclusiveMinimum", true));
        let upper = limits("maximum", false).chain(limits("exclusiveMaximum", true));
        Self {
            least: lower.max_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))),
            most: upper.min_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1))),
        }
    }

    /// If `value` violates a limit, returns a description of this limit.
    fn violated_by(&self, value: f64) -> Option<String> {
        let below = |&(limit, open): &(f64, bool)| value < limit || open && value <= limit;
        let above = |&(limit, open): &(f64, bool)| value > limit || open && value >= limit;
        let lower = self.least.filter(below).map(lower_limit);
        lower.or_else(|| self.most.filter(above).map(upper_limit))
    }

    fn describe(&self) -> String {
        match (self.least, self.most) {
            (Some((least, false)), Some((most, false))) => format!("{least} to {most}"),
            (least, most) => {
                let limits = [least.map(lower_limit), most.map(upper_limit)];
                limits
                    .into_iter()
                    .flatten()
                    .collect::<Vec<_>>()
                    .join(" and ")
            }
        }
    }
}

fn lower_limit((limit, open): (f64, bool)) -> String {
    format!("{} {limit}", if open { "more than" } else { "at least" })
}

fn upper_limit((limit, open): (f64, bool)) -> String {
    format!("{} {limit}", if open { "less than" } else { "at most" })
}
