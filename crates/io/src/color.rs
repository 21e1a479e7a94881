//! Parts of colors, from 0 to 1, as bytes.

/// The nearest number of 255ths.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a cast ends at the lowest and the highest byte"
)]
pub(crate) fn to_byte(x: f64) -> u8 {
    (x * 255.0).round() as u8
}

/// Whether a part of a color is exactly a number of 255ths.
pub(crate) fn is_byte(x: f64) -> bool {
    (f64::from(to_byte(x)) / 255.0).to_bits() == x.to_bits()
}
