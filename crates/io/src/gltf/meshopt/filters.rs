//! Applies filters, which convert decoded attributes in place.
#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "values are already rounded, and casts saturate"
)]

use serde::Deserialize;

use mesh::parallel;

/// The number of bytes that a task processes.
const BLOCK: usize = 1 << 15;

/// The filter of a compressed view. Each variant describes the encoding of the elements before the filter is applied.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub(in super::super) enum Filter {
    /// No conversion: the elements are already the final values.
    #[default]
    None,
    /// Unit vectors as points of an octahedron.
    Octahedral,
    /// Unit quaternions without their largest component.
    Quaternion,
    /// Floats as a mantissa of 24 bits and an exponent of 8 bits.
    Exponential,
    /// Colors as luminance and two color differences.
    Color,
}

impl Filter {
    /// Whether the filter supports elements of `stride` bytes.
    pub(super) fn fits(self, stride: u64) -> bool {
        match self {
            Self::None => true,
            Self::Octahedral | Self::Color => stride == 4 || stride == 8,
            Self::Quaternion => stride == 8,
            Self::Exponential => stride.is_multiple_of(4),
        }
    }

    /// Decodes elements in place.
    pub(in super::super) fn apply(self, bytes: &mut [u8], stride: usize) {
        match (self, stride) {
            (Self::None, _) => {}
            (Self::Octahedral, 4) => each(bytes, |bytes: &mut [u8; 4]| {
                let [x, y, one, w] = *bytes;
                let input = [x, y, one].map(|x| f32::from(x.cast_signed()));
                let [x, y, z] = octahedral(input, 127.0).map(|x| (x as i8).cast_unsigned());
                *bytes = [x, y, z, w];
            }),
            (Self::Octahedral, _) => each(bytes, |bytes: &mut [u8; 8]| {
                let [x, y, one, w] = shorts(*bytes);
                let input = [x, y, one].map(|x| f32::from(x.cast_signed()));
                let [x, y, z] = octahedral(input, 32767.0).map(|x| (x as i16).cast_unsigned());
                *bytes = to_bytes([x, y, z, w]);
            }),
            (Self::Quaternion, _) => each(bytes, |bytes: &mut [u8; 8]| {
                let input = shorts(*bytes).map(u16::cast_signed);
                *bytes = to_bytes(quaternion(input).map(|x| (x as i16).cast_unsigned()));
            }),
            (Self::Exponential, _) => each(bytes, |bytes: &mut [u8; 4]| {
                *bytes = exponential(i32::from_le_bytes(*bytes)).to_le_bytes();
            }),
            (Self::Color, 4) => each(bytes, |bytes: &mut [u8; 4]| {
                let [y, co, cg, a] = *bytes;
                let signed = |x: u8| i32::from(x.cast_signed());
                let color = color(y.into(), signed(co), signed(cg), a.into(), 255.0);
                *bytes = color.map(|x| x as u8);
            }),
            (Self::Color, _) => each(bytes, |bytes: &mut [u8; 8]| {
                let [y, co, cg, a] = shorts(*bytes);
                let signed = |x: u16| i32::from(x.cast_signed());
                let color = color(y.into(), signed(co), signed(cg), a.into(), 65535.0);
                *bytes = to_bytes(color.map(|x| x as u16));
            }),
        }
    }
}

/// Applies `convert` to each group of N bytes, in parallel.
fn each<const N: usize>(bytes: &mut [u8], convert: impl Fn(&mut [u8; N]) + Sync) {
    parallel::consume(bytes.chunks_mut(BLOCK), |_, block| {
        block.as_chunks_mut().0.iter_mut().for_each(&convert);
    });
}

fn shorts(bytes: [u8; 8]) -> [u16; 4] {
    let [a, b, c, d, e, f, g, h] = bytes;
    [[a, b], [c, d], [e, f], [g, h]].map(u16::from_le_bytes)
}

fn to_bytes(values: [u16; 4]) -> [u8; 8] {
    let [[a, b], [c, d], [e, f], [g, h]] = values.map(u16::to_le_bytes);
    [a, b, c, d, e, f, g, h]
}

/// Returns the unit vector that the point (x, y) on the unfolded octahedron represents. The returned components are
/// multiplied by `largest` and rounded.
///
/// The argument `one` is the integer that represents 1. Source: Cigolle et al., "A Survey of Efficient Representations
/// for Independent Unit Vectors", 2014, section 3.3.
fn octahedral([x, y, one]: [f32; 3], largest: f32) -> [f32; 3] {
    let (x, y) = (x / one, y / one);
    let z = 1.0 - x.abs() - y.abs();
    // In the octahedral encoding, the lower half of the sphere is folded over the edges of the upper half.
    let fold = z.min(0.0);
    let (x, y) = (x - fold.copysign(x), y - fold.copysign(y));
    let length = (x * x + y * y + z * z).sqrt();
    [x, y, z].map(|x| (x / length * largest).round())
}

/// The encoding of a unit quaternion leaves out its largest component. Restores this component. Returns the quaternion,
/// multiplied by 32767 and rounded.
///
/// The argument `last` stores two numbers. Its lowest two bits are the index of the largest component. If both bits are
/// set to 1, the value of `last` is the integer that represents 1.
fn quaternion([x, y, z, last]: [i16; 4]) -> [f32; 4] {
    let one = f32::from(last | 3);
    let [x, y, z] = [x, y, z].map(|x| f32::from(x) / one * std::f32::consts::FRAC_1_SQRT_2);
    let w = (1.0 - x * x - y * y - z * z).max(0.0).sqrt();
    let mut quaternion = [w, x, y, z].map(|x| (x * 32767.0).round());
    quaternion.rotate_right(usize::from(last.cast_unsigned() & 3));
    quaternion
}

/// Returns m 2^e, where m is the mantissa in the lower 24 bits, and e is the exponent in the upper 8 bits. The result
/// is infinite if it exceeds the range of 32-bit floats.
fn exponential(bits: i32) -> f32 {
    let (exponent, mantissa) = (bits >> 24, bits << 8 >> 8);
    // The number is computed as a 64-bit float, because a 64-bit float can store it exactly for every exponent.
    libm::ldexp(f64::from(mantissa), exponent) as f32
}

/// Converts luminance and two color differences to red, green, blue and alpha, each rounded to an integer from 0 to
/// `largest`. The highest set bit of `a` determines the number of bits of the arguments.
fn color(y: i32, co: i32, cg: i32, a: i32, largest: f32) -> [f32; 4] {
    let bits = i32::BITS - a.leading_zeros();
    let all = (1 << bits) - 1;
    let alpha = a & (all >> 1);
    let alpha = (alpha << 1) | (alpha & 1);
    // If `a` is 0, the number of bits is unknown, and the divisor is 1.
    let scale = largest / (all.max(1) as f32);
    [y + co - cg, y + cg, y - co - cg, alpha].map(|x| (x as f32 * scale).round())
}
