//! The scalar types of PLY files, and functions that decode their bytes.

use bytemuck::Pod;

/// The type of a property, of the count of a list, or of the items of a list.
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

/// Each type, with its old name, its new name and the size of a value in bytes.
const TYPES: [(Type, [&str; 2], usize); 8] = [
    (Type::Int8, ["char", "int8"], 1),
    (Type::UInt8, ["uchar", "uint8"], 1),
    (Type::Int16, ["short", "int16"], 2),
    (Type::UInt16, ["ushort", "uint16"], 2),
    (Type::Int32, ["int", "int32"], 4),
    (Type::UInt32, ["uint", "uint32"], 4),
    (Type::Float32, ["float", "float32"], 4),
    (Type::Float64, ["double", "float64"], 8),
];

impl Type {
    /// Parses the old or the new name of a type, such as `uchar` or `uint8`.
    pub(super) fn parse(word: &[u8]) -> Option<Self> {
        let is_it = |name: &&str| name.as_bytes() == word;
        let found = TYPES.iter().find(|(_, names, _)| names.iter().any(is_it));
        found.map(|&(kind, ..)| kind)
    }

    /// Returns the old name of the type. All readers accept the old names.
    pub(super) fn name(self) -> &'static str {
        TYPES[self as usize].1[0]
    }

    /// The size of a value in bytes.
    pub(super) fn size(self) -> usize {
        TYPES[self as usize].2
    }

    pub(super) fn is_float(self) -> bool {
        matches!(self, Self::Float32 | Self::Float64)
    }

    /// The smallest and the largest value of an integer type.
    pub(super) fn range(self) -> (i64, i64) {
        let all = 1 << (8 * self.size().min(4));
        match self {
            Self::Int8 | Self::Int16 | Self::Int32 => (-all / 2, all / 2 - 1),
            _ => (0, all - 1),
        }
    }

    /// A color component of this type is divided by this number to get a component from 0 to 1.
    pub(super) fn color_unit(self) -> f64 {
        match self {
            Self::Float32 | Self::Float64 => 1.0,
            Self::UInt16 => 65_535.0,
            _ => 255.0,
        }
    }
}

/// Evaluates `$body` with `$t` as the Rust type of the values.
macro_rules! with_type {
    ($type:expr, $t:ident => $body:expr) => {
        with_type!(@ $type, $t => $body;
            Int8 i8, UInt8 u8, Int16 i16, UInt16 u16, Int32 i32, UInt32 u32, Float32 f32, Float64 f64)
    };
    (@ $type:expr, $t:ident => $body:expr; $($kind:ident $own:ty),*) => {
        match $type {
            $($crate::ply::types::Type::$kind => {
                type $t = $own;
                $body
            })*
        }
    };
}
pub(super) use with_type;

/// Reads the value at the beginning of `bytes`, which must be long enough. `big` means big-endian.
#[inline]
pub(super) fn read<T: Pod + Into<f64>>(bytes: &[u8], big: bool) -> f64 {
    let mut value = T::zeroed();
    let own = bytemuck::bytes_of_mut(&mut value);
    own.copy_from_slice(&bytes[..size_of::<T>()]);
    if big != cfg!(target_endian = "big") {
        own.reverse();
    }
    value.into()
}

/// Reads values that are `stride` bytes apart. The first value is at the beginning of `bytes`.
pub(super) fn read_all(kind: Type, big: bool, bytes: &[u8], stride: usize, out: &mut [f64]) {
    with_type!(kind, T => {
        for (i, x) in out.iter_mut().enumerate() {
            *x = read::<T>(&bytes[i * stride..], big);
        }
    });
}

/// Reads the number at the beginning of `bytes`.
pub(super) fn number(kind: Type, big: bool, bytes: &[u8]) -> f64 {
    let mut number = [0.0];
    read_all(kind, big, bytes, 0, &mut number);
    number[0]
}

/// Reads the number at the beginning of `bytes` and truncates it to an integer.
#[expect(
    clippy::cast_possible_truncation,
    reason = "integers have at most 32 bits"
)]
pub(super) fn whole(kind: Type, big: bool, bytes: &[u8]) -> i64 {
    number(kind, big, bytes) as i64
}
