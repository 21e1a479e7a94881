//! The scalar types of PLY files and how their bytes become numbers.

use std::marker::PhantomData;

/// The type of a property, of a list's count or of its items.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Type {
    Int8,
    UInt8,
    Int16,
    UInt16,
    Int32,
    UInt32,
    Float32,
    Float64,
}

impl Type {
    /// The type of this name, of either family: `uchar` or `uint8`.
    pub(super) fn parse(word: &[u8]) -> Option<Self> {
        Some(match word {
            b"char" | b"int8" => Self::Int8,
            b"uchar" | b"uint8" => Self::UInt8,
            b"short" | b"int16" => Self::Int16,
            b"ushort" | b"uint16" => Self::UInt16,
            b"int" | b"int32" => Self::Int32,
            b"uint" | b"uint32" => Self::UInt32,
            b"float" | b"float32" => Self::Float32,
            b"double" | b"float64" => Self::Float64,
            _ => return None,
        })
    }

    /// The name that the oldest readers know too.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Int8 => "char",
            Self::UInt8 => "uchar",
            Self::Int16 => "short",
            Self::UInt16 => "ushort",
            Self::Int32 => "int",
            Self::UInt32 => "uint",
            Self::Float32 => "float",
            Self::Float64 => "double",
        }
    }

    /// How many bytes a value takes.
    pub(super) fn size(self) -> usize {
        match self {
            Self::Int8 | Self::UInt8 => 1,
            Self::Int16 | Self::UInt16 => 2,
            Self::Int32 | Self::UInt32 | Self::Float32 => 4,
            Self::Float64 => 8,
        }
    }

    pub(super) fn is_float(self) -> bool {
        matches!(self, Self::Float32 | Self::Float64)
    }

    /// The least and the greatest value of a whole-number type.
    pub(super) fn range(self) -> (i64, i64) {
        match self {
            Self::Int8 => (-0x80, 0x7f),
            Self::UInt8 => (0, 0xff),
            Self::Int16 => (-0x8000, 0x7fff),
            Self::UInt16 => (0, 0xffff),
            Self::Int32 => (i32::MIN.into(), i32::MAX.into()),
            Self::UInt32 | Self::Float32 | Self::Float64 => (0, u32::MAX.into()),
        }
    }

    /// What a number of this type is divided by to become a part of a color from 0 to 1.
    pub(super) fn color_unit(self) -> f64 {
        match self {
            Self::Float32 | Self::Float64 => 1.0,
            Self::UInt16 => 65_535.0,
            _ => 255.0,
        }
    }
}

/// Reads one value from the front of some bytes, which are enough.
pub(super) trait Scalar: Send + Sync {
    const SIZE: usize;

    fn number(bytes: &[u8]) -> f64;

    /// The whole number; for floating-point types, which no caller asks for, cut to one.
    fn whole(bytes: &[u8]) -> i64;
}

/// A number whose lowest byte comes first.
pub(super) struct Little<T>(PhantomData<T>);

/// A number whose highest byte comes first.
pub(super) struct Big<T>(PhantomData<T>);

macro_rules! scalar {
    ($type:ty, $whole:expr) => {
        scalar!(Little<$type>, $type, from_le_bytes, $whole);
        scalar!(Big<$type>, $type, from_be_bytes, $whole);
    };
    ($marker:ty, $type:ty, $from:ident, $whole:expr) => {
        impl Scalar for $marker {
            const SIZE: usize = size_of::<$type>();

            #[inline]
            fn number(bytes: &[u8]) -> f64 {
                let bytes = bytes.first_chunk().expect("the caller gives enough");
                <$type>::$from(*bytes).into()
            }

            #[inline]
            fn whole(bytes: &[u8]) -> i64 {
                let bytes = bytes.first_chunk().expect("the caller gives enough");
                $whole(<$type>::$from(*bytes))
            }
        }
    };
}
scalar!(i8, i64::from);
scalar!(u8, i64::from);
scalar!(i16, i64::from);
scalar!(u16, i64::from);
scalar!(i32, i64::from);
scalar!(u32, i64::from);
scalar!(f32, |x| cut(f64::from(x)));
scalar!(f64, cut);

#[expect(clippy::cast_possible_truncation, reason = "that is what it is for")]
fn cut(x: f64) -> i64 {
    x as i64
}

/// Runs `$body` with `$scalar` standing for the [`Scalar`] of a type and a byte order.
macro_rules! with_scalar {
    ($type:expr, $big:expr, $scalar:ident => $body:expr) => {
        with_scalar!(@ $type, $big, $scalar => $body;
            Int8 i8, UInt8 u8, Int16 i16, UInt16 u16, Int32 i32, UInt32 u32, Float32 f32, Float64 f64)
    };
    (@ $type:expr, $big:expr, $scalar:ident => $body:expr; $($kind:ident $t:ty),*) => {
        match ($type, $big) {
            $(
                ($crate::ply::types::Type::$kind, false) => {
                    type $scalar = $crate::ply::types::Little<$t>;
                    $body
                }
                ($crate::ply::types::Type::$kind, true) => {
                    type $scalar = $crate::ply::types::Big<$t>;
                    $body
                }
            )*
        }
    };
}
pub(super) use with_scalar;

/// The number at the front of `bytes`, for places where speed does not matter.
pub(super) fn number(kind: Type, big: bool, bytes: &[u8]) -> f64 {
    with_scalar!(kind, big, S => S::number(bytes))
}

/// The whole number at the front of `bytes`.
#[inline]
pub(super) fn whole(kind: Type, big: bool, bytes: &[u8]) -> i64 {
    with_scalar!(kind, big, S => S::whole(bytes))
}
