//! Numbers with a range.

use std::borrow::Cow;
use std::fmt;
use std::ops::Bound::{self, Excluded, Included, Unbounded};

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Serialize};

/// The error for a number that is not finite or is outside the range of its type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutOfRange {
    value: f64,
    limits: Limits,
}

impl std::error::Error for OutOfRange {}

impl fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { value, limits } = self;
        if !value.is_finite() {
            return write!(f, "expected a finite number, found {value}");
        }
        f.write_str("expected ")?;
        match (limits.min, limits.max) {
            (Included(min), _) if *value < min => write!(f, "at least {min}"),
            (Excluded(min), _) if *value <= min => write!(f, "more than {min}"),
            (_, Included(max)) => write!(f, "at most {max}"),
            (_, Excluded(max)) => write!(f, "less than {max}"),
            (_, Unbounded) => write!(f, "a different number"),
        }?;
        write!(f, ", found {value}")
    }
}

/// The range of a number. The number must also be finite.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Limits {
    min: Bound<f64>,
    max: Bound<f64>,
}

impl Limits {
    const fn check(self, value: f64) -> Result<f64, OutOfRange> {
        let above = match self.min {
            Included(min) => value >= min,
            Excluded(min) => value > min,
            Unbounded => true,
        };
        let below = match self.max {
            Included(max) => value <= max,
            Excluded(max) => value < max,
            Unbounded => true,
        };
        if above && below && value.is_finite() {
            Ok(value)
        } else {
            let limits = self;
            Err(OutOfRange { value, limits })
        }
    }

    fn describe(self, schema: &mut Schema) {
        for (limit, inclusive, exclusive) in [
            (self.min, "minimum", "exclusiveMinimum"),
            (self.max, "maximum", "exclusiveMaximum"),
        ] {
            match limit {
                Included(limit) => schema.insert(inclusive.to_owned(), limit.into()),
                Excluded(limit) => schema.insert(exclusive.to_owned(), limit.into()),
                Unbounded => None,
            };
        }
    }
}

macro_rules! numbers {
    ($($(#[$meta:meta])* $name:ident: $min:expr, $max:expr;)*) => {$(
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, Deserialize, PartialEq, PartialOrd, Serialize)]
        #[serde(try_from = "f64", into = "f64")]
        pub struct $name(f64);

        impl $name {
            const LIMITS: Limits = Limits { min: $min, max: $max };

            /// Creates a value of this type.
            ///
            /// # Errors
            ///
            /// Returns an error if the number is outside the range or not finite.
            pub const fn new(value: f64) -> Result<Self, OutOfRange> {
                match Self::LIMITS.check(value) {
                    Ok(value) => Ok(Self(value)),
                    Err(error) => Err(error),
                }
            }

            /// Creates a value of this type from a literal in the source code.
            ///
            /// # Panics
            ///
            /// Panics if the number is outside the range or not finite.
            pub const fn literal(value: f64) -> Self {
                match Self::new(value) {
                    Ok(number) => number,
                    Err(_) => panic!("the number is outside the range of its type"),
                }
            }

            /// Returns the number.
            pub const fn get(self) -> f64 {
                self.0
            }
        }

        impl TryFrom<f64> for $name {
            type Error = OutOfRange;

            fn try_from(value: f64) -> Result<Self, OutOfRange> {
                Self::new(value)
            }
        }

        impl From<$name> for f64 {
            fn from(number: $name) -> Self {
                number.0
            }
        }

        impl JsonSchema for $name {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                let mut schema = f64::json_schema(generator);
                Self::LIMITS.describe(&mut schema);
                schema
            }
        }
    )*};
}

numbers! {
    /// A fraction from 0 to 1, exclusive.
    Fraction: Excluded(0.0), Excluded(1.0);
    /// A fraction from 0 to 1, inclusive.
    ClosedFraction: Included(0.0), Included(1.0);
    /// A length in scene units, at least 0.
    #[derive(Default)]
    Length: Included(0.0), Unbounded;
    /// A length in scene units, above 0.
    PositiveLength: Excluded(0.0), Unbounded;
    /// The number of subdivision levels for which an edge or a vertex stays sharp: from 0 to 10. With 10, the edge
    /// or vertex stays sharp at every level.
    #[derive(Default)]
    Sharpness: Included(0.0), Included(10.0);
    /// The duration of an animation, in seconds: from 0.1 to 600.
    Seconds: Included(0.1), Included(600.0);
    /// A factor above 0.
    PositiveFactor: Excluded(0.0), Unbounded;
    /// A finite number.
    #[derive(Default)]
    Number: Unbounded, Unbounded;
    /// A distance along a direction, in scene units. A negative distance goes in the opposite direction.
    #[derive(Default)]
    Distance: Unbounded, Unbounded;
    /// An angle in degrees. Can be more than a full turn.
    #[derive(Default)]
    Angle: Unbounded, Unbounded;
    /// An angle between two directions, in degrees: from 0 to 180.
    #[derive(Default)]
    AngleBetween: Included(0.0), Included(180.0);
}

/// A whole number from `MIN` to `MAX`.
#[derive(Clone, Copy, Debug, Deserialize, Eq, Ord, PartialEq, PartialOrd, Serialize)]
#[serde(try_from = "u32", into = "u32")]
pub struct Count<const MIN: u32, const MAX: u32 = { u32::MAX }>(u32);

/// A number of subdivision levels.
pub type Levels = Count<0, 16>;

impl<const MIN: u32, const MAX: u32> Count<MIN, MAX> {
    /// The highest value.
    pub const HIGHEST: Self = Self(MAX);

    const LIMITS: Limits = Limits {
        min: Included(MIN as f64),
        max: Included(MAX as f64),
    };

    /// Creates a value of this type.
    ///
    /// # Errors
    ///
    /// Returns an error if the number is outside the range.
    pub const fn new(value: u32) -> Result<Self, OutOfRange> {
        match Self::LIMITS.check(value as f64) {
            Ok(_) => Ok(Self(value)),
            Err(error) => Err(error),
        }
    }

    /// Creates a value of this type from a literal in the source code.
    ///
    /// # Panics
    ///
    /// Panics if the number is outside the range.
    pub const fn literal(value: u32) -> Self {
        match Self::new(value) {
            Ok(number) => number,
            Err(_) => panic!("the number is outside the range of its type"),
        }
    }

    /// Returns the number.
    pub const fn get(self) -> u32 {
        self.0
    }
}

impl<const MIN: u32, const MAX: u32> TryFrom<u32> for Count<MIN, MAX> {
    type Error = OutOfRange;

    fn try_from(value: u32) -> Result<Self, OutOfRange> {
        Self::new(value)
    }
}

impl<const MIN: u32, const MAX: u32> From<Count<MIN, MAX>> for u32 {
    fn from(number: Count<MIN, MAX>) -> Self {
        number.0
    }
}

impl<const MIN: u32, const MAX: u32> JsonSchema for Count<MIN, MAX> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("Count{MIN}To{MAX}").into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = u32::json_schema(generator);
        schema.insert("minimum".to_owned(), MIN.into());
        if MAX < u32::MAX {
            schema.insert("maximum".to_owned(), MAX.into());
        }
        schema
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message<T, E: fmt::Display>(made: Result<T, E>) -> String {
        made.err().map_or("good".to_owned(), |e| e.to_string())
    }

    #[test]
    fn numbers_outside_of_the_range_are_refused() {
        for (made, expected) in [
            (message(Fraction::new(0.5)), "good"),
            (message(Fraction::new(0.0)), "expected more than 0, found 0"),
            (message(Fraction::new(1.0)), "expected less than 1, found 1"),
            (message(ClosedFraction::new(0.0)), "good"),
            (message(ClosedFraction::new(1.0)), "good"),
            (
                message(ClosedFraction::new(1.5)),
                "expected at most 1, found 1.5",
            ),
            (message(Length::new(0.0)), "good"),
            (message(Length::new(-1.0)), "expected at least 0, found -1"),
            (
                message(PositiveLength::new(0.0)),
                "expected more than 0, found 0",
            ),
            (
                message(PositiveFactor::new(f64::INFINITY)),
                "expected a finite number, found inf",
            ),
            (
                message(Distance::new(f64::NAN)),
                "expected a finite number, found NaN",
            ),
            (message(Distance::new(-3.0)), "good"),
            (
                message(AngleBetween::new(181.0)),
                "expected at most 180, found 181",
            ),
            (message(Levels::new(16)), "good"),
            (message(Levels::new(17)), "expected at most 16, found 17"),
            (message(Count::<3>::new(2)), "expected at least 3, found 2"),
            (message(Count::<3>::new(u32::MAX)), "good"),
        ] {
            assert_eq!(made, expected);
        }
    }

    #[test]
    fn numbers_are_read_and_written_without_their_type() {
        assert_eq!(ron::from_str("0.25"), Ok(Fraction::literal(0.25)));
        assert_eq!(ron::from_str("2"), Ok(PositiveLength::literal(2.0)));
        assert_eq!(ron::from_str("Some(3)"), Ok(Some(Count::<1>::literal(3))));
        assert_eq!(ron::to_string(&Fraction::literal(0.25)).unwrap(), "0.25");
        assert_eq!(ron::to_string(&Levels::literal(2)).unwrap(), "2");
        let refused = ron::from_str::<Count<3>>("2").unwrap_err();
        assert_eq!(refused.code.to_string(), "expected at least 3, found 2");
    }

    #[test]
    fn the_schema_contains_the_range() {
        let schema = |schema: Schema| {
            let mut json = schema.to_value();
            json.as_object_mut()
                .unwrap()
                .retain(|key, _| !key.starts_with('$') && key != "title");
            json.to_string()
        };
        assert_eq!(
            schema(schemars::schema_for!(Fraction)),
            r#"{"type":"number","format":"double","exclusiveMinimum":0.0,"exclusiveMaximum":1.0}"#
        );
        assert_eq!(
            schema(schemars::schema_for!(Option<Levels>)),
            r#"{"type":["integer","null"],"format":"uint32","minimum":0,"maximum":16}"#
        );
        assert_eq!(
            schema(schemars::schema_for!(Count<3>)),
            r#"{"type":"integer","format":"uint32","minimum":3}"#
        );
    }
}
