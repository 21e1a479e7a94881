//! Colors as recipes write them, and conversion between sRGB and linear light.

use std::fmt;
use std::sync::LazyLock;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Serialize};

/// A color: `"#rrggbb"` or `"#rgb"` in sRGB, `"#rrggbbaa"` or `"#rgba"` with alpha, or one of the [`NAMES`].
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq, Serialize)]
#[serde(try_from = "String", into = "String")]
pub struct Color(pub [u8; 4]);

/// The named colors. Most color-blind people can distinguish the seven colors from `orange` to `pink` in this list.
/// These colors are from Okabe and Ito, "Color Universal Design", 2008.
pub const NAMES: [(&str, [u8; 3]); 11] = [
    ("black", [0, 0, 0]),
    ("white", [255, 255, 255]),
    ("gray", [128, 128, 128]),
    ("orange", [230, 159, 0]),
    ("sky", [86, 180, 233]),
    ("green", [0, 158, 115]),
    ("yellow", [240, 228, 66]),
    ("blue", [0, 114, 178]),
    ("red", [213, 94, 0]),
    ("pink", [204, 121, 167]),
    ("crimson", [190, 30, 60]),
];

/// The text is not a color.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("expected a color like \"#4477aa\" or one of {names}, found \"{0}\"", names = names())]
pub struct ParseColorError(String);

fn names() -> String {
    NAMES.map(|(name, _)| name).join(", ")
}

impl Color {
    /// Returns the opaque color with these sRGB values.
    pub const fn rgb(r: u8, g: u8, b: u8) -> Self {
        Self([r, g, b, 255])
    }

    /// Returns linear red, green, blue and alpha, from 0 to 1.
    pub fn linear(self) -> [f32; 4] {
        let [r, g, b, a] = self.0;
        let [r, g, b] = [r, g, b].map(to_linear);
        [r, g, b, f32::from(a) / 255.0]
    }
}

impl TryFrom<String> for Color {
    type Error = ParseColorError;

    fn try_from(text: String) -> Result<Self, ParseColorError> {
        if let Some((_, [r, g, b])) = NAMES.into_iter().find(|&(name, _)| name == text) {
            return Ok(Self::rgb(r, g, b));
        }
        let digits: Option<Vec<u8>> = text.strip_prefix('#').and_then(|digits| {
            let digit = |c: char| c.to_digit(16).and_then(|d| u8::try_from(d).ok());
            digits.chars().map(digit).collect()
        });
        match digits.as_deref() {
            Some(&[r, g, b]) => Ok(Self::rgb(17 * r, 17 * g, 17 * b)),
            Some(&[r, g, b, a]) => Ok(Self([17 * r, 17 * g, 17 * b, 17 * a])),
            Some(&[r, s, g, h, b, c]) => Ok(Self::rgb(16 * r + s, 16 * g + h, 16 * b + c)),
            Some(&[r, s, g, h, b, c, a, d]) => {
                Ok(Self([16 * r + s, 16 * g + h, 16 * b + c, 16 * a + d]))
            }
            _ => Err(ParseColorError(text)),
        }
    }
}

impl From<Color> for String {
    fn from(color: Color) -> Self {
        color.to_string()
    }
}

impl fmt::Display for Color {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [r, g, b, a] = self.0;
        write!(f, "#{r:02x}{g:02x}{b:02x}")?;
        if a == u8::MAX {
            Ok(())
        } else {
            write!(f, "{a:02x}")
        }
    }
}

impl JsonSchema for Color {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Color".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        schemars::json_schema!({
            "type": "string",
            "description": format!(
                "A color: \"#rrggbb\" or \"#rgb\" in sRGB, \"#rrggbbaa\" or \"#rgba\" with alpha, or one of {}.",
                names()
            ),
        })
    }
}

/// Returns the linear light of an sRGB value, from 0 to 1 (IEC 61966-2-1, 1999).
pub fn to_linear(value: u8) -> f32 {
    static TABLE: LazyLock<[f32; 256]> = LazyLock::new(|| {
        std::array::from_fn(|i| match i as f64 / 255.0 {
            s if s <= 0.04045 => narrow(s / 12.92),
            s => narrow(libm::pow((s + 0.055) / 1.055, 2.4)),
        })
    });
    TABLE[usize::from(value)]
}

/// Returns the sRGB value of linear light (IEC 61966-2-1, 1999). The light is clamped to the range from 0 to 1.
pub fn to_srgb(light: f32) -> u8 {
    /// The number of equal steps into which the table divides the range from 0 to 1. The steps are so small that
    /// rounding to a step hardly ever changes the sRGB value. Even where sRGB values rise most steeply, about 20
    /// consecutive entries of the table have the same sRGB value.
    const STEPS: usize = 1 << 16;
    static TABLE: LazyLock<Vec<u8>> = LazyLock::new(|| {
        let value = |i: usize| match i as f64 / STEPS as f64 {
            light if light <= 0.003_130_8 => 12.92 * light,
            light => 1.055 * libm::pow(light, 1.0 / 2.4) - 0.055,
        };
        (0..=STEPS).map(|i| byte(narrow(value(i)))).collect()
    });
    let light = light.clamp(0.0, 1.0);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the number is from 0 to 1, and NaN becomes 0"
    )]
    TABLE[(light * STEPS as f32 + 0.5) as usize]
}

/// Converts a value from 0 to 1 to the nearest byte; NaN becomes 0.
pub(crate) fn byte(value: f32) -> u8 {
    let nearest = whole_u32(f64::from(value.clamp(0.0, 1.0) * 255.0 + 0.5));
    u8::try_from(nearest).unwrap_or(u8::MAX)
}

/// Truncates to a whole number, clamped to the range of `usize`; NaN becomes 0.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the function truncates numbers"
)]
pub(crate) fn whole(value: f64) -> usize {
    value as usize
}

/// Truncates a number to a whole number of 32 bits. This is faster than [`whole`].
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the function truncates numbers"
)]
pub(crate) fn whole_u32(value: f64) -> u32 {
    value as u32
}

/// Rounds a number to the nearest `f32`.
#[expect(
    clippy::cast_possible_truncation,
    reason = "the function rounds numbers"
)]
pub(crate) fn narrow(value: f64) -> f32 {
    value as f32
}

/// Interpolates linearly from `a` (at `t = 0`) to `b` (at `t = 1`).
pub(crate) fn mix<const N: usize>(a: [f32; N], b: [f32; N], t: f32) -> [f32; N] {
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn converting_a_byte_to_linear_light_and_back_does_not_change_it() {
        for value in 0..=255 {
            assert_eq!(to_srgb(to_linear(value)), value);
        }
    }

    #[test]
    fn a_written_color_reads_back_the_same() {
        let read = |text: &str| Color::try_from(text.to_owned());
        assert_eq!(read("#4477aa"), Ok(Color::rgb(0x44, 0x77, 0xaa)));
        assert_eq!(read("#47a"), read("#4477aa"));
        assert_eq!(read("#47a8"), Ok(Color([0x44, 0x77, 0xaa, 0x88])));
        assert_eq!(read("white"), Ok(Color([255; 4])));
        for (name, [r, g, b]) in NAMES {
            let color = read(name).unwrap();
            assert_eq!(color, Color::rgb(r, g, b));
            assert_eq!(read(&color.to_string()), Ok(color));
        }
        for wrong in ["", "#", "#12", "#12345", "reddish", "#ggg", "4477aa", "#é"] {
            let message = read(wrong).unwrap_err().to_string();
            assert!(message.starts_with("expected a color like"), "{message}");
        }
    }
}
