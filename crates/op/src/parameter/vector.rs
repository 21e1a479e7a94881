//! Parameters of three numbers: points, directions, scale factors.

use std::borrow::Cow;

use glam::DVec3;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Serialize};

/// A point or a direction: `(x, y, z)`, in scene units.
#[derive(Deserialize, JsonSchema, Serialize)]
#[serde(rename = "Vector")]
struct Coordinates(f64, f64, f64);

/// The error for three numbers that are not a valid vector of the requested type, such as a direction of length 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected finite {0}")]
pub struct BadVector(&'static str);

macro_rules! vectors {
    ($($(#[$meta:meta])* $name:ident($x:ident, $y:ident, $z:ident): $good:expr, $expected:literal;)*) => {$(
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
        #[serde(try_from = "Coordinates", into = "Coordinates")]
        pub struct $name(DVec3);

        impl $name {
            /// Creates a value of this type.
            ///
            /// # Errors
            ///
            /// Returns an error if the numbers are not a valid value of this type.
            pub const fn new($x: f64, $y: f64, $z: f64) -> Result<Self, BadVector> {
                if $x.is_finite() && $y.is_finite() && $z.is_finite() && $good {
                    Ok(Self(DVec3::new($x, $y, $z)))
                } else {
                    Err(BadVector($expected))
                }
            }

            /// Creates a value of this type from literals in the source code.
            ///
            /// # Panics
            ///
            /// Panics if the numbers are not a valid value of this type.
            pub const fn literal(x: f64, y: f64, z: f64) -> Self {
                match Self::new(x, y, z) {
                    Ok(vector) => vector,
                    Err(_) => panic!("the numbers are not a valid vector"),
                }
            }

            /// Returns the three numbers.
            pub const fn get(self) -> DVec3 {
                self.0
            }
        }

        impl TryFrom<Coordinates> for $name {
            type Error = BadVector;

            fn try_from(Coordinates(x, y, z): Coordinates) -> Result<Self, BadVector> {
                Self::new(x, y, z)
            }
        }

        impl From<$name> for Coordinates {
            fn from($name(DVec3 { x, y, z }): $name) -> Self {
                Self(x, y, z)
            }
        }

        impl From<$name> for DVec3 {
            fn from(vector: $name) -> Self {
                vector.0
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                Coordinates::schema_name()
            }

            fn schema_id() -> Cow<'static, str> {
                Coordinates::schema_id()
            }

            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                Coordinates::json_schema(generator)
            }
        }
    )*};
}

vectors! {
    /// A point or a direction: `(x, y, z)`, in scene units.
    #[derive(Default)]
    Vector(x, y, z): true, "coordinates";
    /// A direction `(x, y, z)`. The length of the vector does not matter but must not be 0.
    Direction(x, y, z): x != 0.0 || y != 0.0 || z != 0.0, "coordinates that are not all 0";
    /// Scale factors along x, y and z. The factors must not be 0. A negative factor mirrors.
    Factors(x, y, z): x != 0.0 && y != 0.0 && z != 0.0, "factors that are not 0";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn invalid_vectors_are_refused() {
        assert_eq!(
            ron::from_str("(1, 0, 2)"),
            Ok(Vector::literal(1.0, 0.0, 2.0))
        );
        assert_eq!(
            ron::from_str("Vector(0, -1, 0)"),
            Ok(Direction::literal(0.0, -1.0, 0.0))
        );
        assert_eq!(
            ron::to_string(&Factors::literal(-1.0, 1.0, 0.5)).unwrap(),
            "(-1.0,1.0,0.5)"
        );
        let refused = |made: Result<(), BadVector>| made.unwrap_err().to_string();
        assert_eq!(
            refused(Vector::new(0.0, f64::NAN, 0.0).map(|_| ())),
            "expected finite coordinates"
        );
        assert_eq!(
            refused(Direction::new(0.0, -0.0, 0.0).map(|_| ())),
            "expected finite coordinates that are not all 0"
        );
        assert_eq!(
            refused(Factors::new(1.0, 0.0, 1.0).map(|_| ())),
            "expected finite factors that are not 0"
        );
    }
}
