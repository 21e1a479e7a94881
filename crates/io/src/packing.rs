//! Makes glTF files smaller by compression and quantization.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A lossless compression of glTF files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Compression {
    /// The extension `EXT_meshopt_compression`. Programs that do not support this extension cannot read the file.
    /// Vertices and triangles are reordered, and the corners of triangles can be rotated, for example from (a, b, c) to
    /// (b, c, a).
    Meshopt,
}

/// The precision of the attributes in quantized glTF files. Each field is a number of bits, from 8 to 16.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Quantization {
    /// The number of bits of each coordinate of a position. Positions are rounded to the points of a grid. The grid
    /// covers the bounding box of the object and has the same spacing along all axes. Along the longest side of the
    /// box, the grid has 2^bits - 1 steps. Positions of objects with joints or morph targets are not quantized.
    /// Defaults to 16.
    #[serde(default = "Bits::most")]
    pub position: Bits,
    /// The number of bits of each of the two numbers that represent a normal or a tangent. The two numbers locate a
    /// point on an octahedron. Defaults to 8.
    #[serde(default = "Bits::least")]
    pub normal: Bits,
    /// The number of bits of each texture coordinate. If one coordinate in a set of texture coordinates is outside the
    /// range from 0 to 1, the whole set is not quantized. Defaults to 16.
    #[serde(default = "Bits::most")]
    pub uv: Bits,
    /// The number of bits of each component of a color. Defaults to 8.
    #[serde(default = "Bits::least")]
    pub color: Bits,
}

impl Default for Quantization {
    fn default() -> Self {
        let (least, most) = (Bits::least(), Bits::most());
        Self {
            position: most,
            normal: least,
            uv: most,
            color: least,
        }
    }
}

/// How many bits a number has: at least 8 and at most 16.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(try_from = "u32", into = "u32")]
pub struct Bits(#[schemars(range(min = 8, max = 16))] u32);

impl Bits {
    fn least() -> Self {
        Self(8)
    }

    fn most() -> Self {
        Self(16)
    }

    /// The number.
    pub fn get(self) -> u32 {
        self.0
    }

    /// The largest integer with this number of bits.
    pub(crate) fn largest(self) -> u32 {
        (1 << self.0) - 1
    }

    /// Whether numbers with this number of bits are stored in one byte.
    pub(crate) fn is_byte(self) -> bool {
        self.0 == 8
    }
}

impl From<Bits> for u32 {
    fn from(bits: Bits) -> Self {
        bits.0
    }
}

/// The error for a bit count that is less than 8 or greater than 16.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected 8 to 16 bits, found {0}")]
pub struct BadBits(u32);

impl TryFrom<u32> for Bits {
    type Error = BadBits;

    fn try_from(bits: u32) -> Result<Self, BadBits> {
        if (8..=16).contains(&bits) {
            Ok(Self(bits))
        } else {
            Err(BadBits(bits))
        }
    }
}

/// The effects of compression and quantization on a file.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PackingReport {
    /// The size in bytes that the files would have without compression and quantization. Copied images are not counted,
    /// and compression with gzip is not considered.
    pub bytes_before: u64,
    /// The size in bytes of the same files with compression and quantization. As in `bytes_before`, copied images and
    /// gzip are not considered.
    pub bytes_after: u64,
    /// The largest distance between a position and its quantized position, in scene units. `None` if no positions are
    /// quantized. If the transform of a node has a shear, this value is an upper bound of the distance.
    pub position_error: Option<f64>,
    /// The largest angle between a normal or a tangent and its quantized direction, in degrees.
    pub normal_error: Option<f64>,
    /// The largest difference between a texture coordinate and its quantized value.
    pub uv_error: Option<f64>,
    /// The attributes that could not be quantized. Each entry consists of the object, the attribute and the reason.
    pub unquantized: Vec<(String, String, String)>,
}

impl fmt::Display for PackingReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            bytes_before,
            bytes_after,
            ..
        } = self;
        write!(f, "{bytes_after} bytes instead of {bytes_before}")?;
        let errors = [
            ("positions", self.position_error, ""),
            ("normals", self.normal_error, " degrees"),
            ("texture coordinates", self.uv_error, ""),
        ];
        let mut before = "; quantization moved";
        for (what, error, unit) in errors {
            if let Some(error) = error {
                write!(f, "{before} {what} by at most {error:.2e}{unit}")?;
                before = ",";
            }
        }
        for (object, attribute, reason) in &self.unquantized {
            write!(f, "; {object}: {attribute} not quantized: {reason}")?;
        }
        Ok(())
    }
}
