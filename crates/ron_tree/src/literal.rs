//! Reads the values of literals: numbers, strings, characters, names.
//!
//! The rules are the same as in `ron`, with three exceptions. Numbers cannot have a type suffix (`1u32`), a line feed
//! in single quotes must be written as `'\n'`, and byte strings are not supported.

use std::str::FromStr;

use ron::error::Position;
use serde::de::DeserializeOwned;

use crate::diagnostic::Span;

/// An error in a literal.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct BadLiteral {
    /// The span of the error, relative to the start of the literal.
    pub(super) span: Span,
    pub(super) message: &'static str,
}

/// A number as written in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Number {
    /// A whole number in base 2, 8, 10 or 16.
    Int(Box<str>),
    /// A number with a decimal point or an exponent, or `inf` or `NaN`.
    Float(Box<str>),
}

impl Number {
    /// Parses a number. `None` if the text is not a number.
    pub fn parse(text: &str) -> Option<Self> {
        if parse_int(text).is_some() {
            Some(Self::Int(text.into()))
        } else if parse_float::<f64>(text).is_some() {
            Some(Self::Float(text.into()))
        } else {
            None
        }
    }

    /// Returns the number as written in the text.
    pub fn text(&self) -> &str {
        match self {
            Self::Int(text) | Self::Float(text) => text,
        }
    }

    /// Returns the value of an [`Int`](Self::Int). `None` for a [`Float`](Self::Float), or if the value does not
    /// fit in 128 bits.
    pub fn to_int(&self) -> Option<i128> {
        match self {
            Self::Int(text) => parse_int(text)?.ok(),
            Self::Float(_) => None,
        }
    }

    /// Whether the number is an [`Int`](Self::Int).
    pub fn is_int(&self) -> bool {
        matches!(self, Self::Int(_))
    }

    /// Returns the value, rounded to the nearest 64-bit floating-point number.
    pub fn to_float(&self) -> f64 {
        let whole = || self.to_int().map(|int| int as f64);
        parse_float(self.text())
            .or_else(whole)
            .unwrap_or(f64::INFINITY)
    }

    /// Returns the value, rounded to the nearest 32-bit floating-point number.
    pub fn to_single(&self) -> f32 {
        let whole = || self.to_int().map(|int| int as f32);
        parse_float(self.text())
            .or_else(whole)
            .unwrap_or(f32::INFINITY)
    }

    /// Whether the number is written with `0x`, `0o` or `0b`. `ron` accepts these prefixes only for integer types.
    pub fn has_base(&self) -> bool {
        matches!(self, Self::Int(text) if base(text.trim_start_matches(['+', '-'])).0 != 10)
    }
}

/// Parses a whole number. `None` if the text is not a whole number, `Some(Err(()))` if the value does not fit in 128
/// bits.
fn parse_int(text: &str) -> Option<Result<i128, ()>> {
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
    let (base, digits) = base(unsigned);
    let is_digit = |c: char| c == '_' || c.is_digit(base);
    if !digits.starts_with(|c: char| c.is_digit(base)) || !digits.chars().all(is_digit) {
        return None;
    }
    let value = digits
        .chars()
        .filter_map(|c| c.to_digit(base))
        .try_fold(0_i128, |sum, digit| {
            sum.checked_mul(i128::from(base))?
                .checked_add(i128::from(digit))
        });
    Some(
        value
            .map(|v| if text.starts_with('-') { -v } else { v })
            .ok_or(()),
    )
}

/// Returns the base of a whole number, and its digits.
fn base(unsigned: &str) -> (u32, &str) {
    let prefixes = [("0x", 16), ("0o", 8), ("0b", 2)];
    let mut found = prefixes
        .iter()
        .filter_map(|&(p, base)| Some((base, unsigned.strip_prefix(p)?)));
    found.next().unwrap_or((10, unsigned))
}

fn parse_float<T: FromStr>(text: &str) -> Option<T> {
    if matches!(text.trim_start_matches(['+', '-']), "inf" | "NaN") {
        return text.parse().ok();
    }
    // `ron` accepts an underscore after a digit or after the `e` of an exponent, but not at the start or after the
    // decimal point.
    let mut allows_underscore = false;
    let mut plain = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '_' if allows_underscore => continue,
            '0'..='9' | 'e' | 'E' => allows_underscore = true,
            '.' => allows_underscore = false,
            '+' | '-' => {}
            _ => return None,
        }
        plain.push(c);
    }
    plain.parse().ok()
}

/// Returns the text of a `".."` literal.
pub(super) fn unescape_string(literal: &str) -> Result<String, BadLiteral> {
    if literal.contains('\\') {
        unescape(literal)
    } else {
        Ok(literal[1..literal.len() - 1].to_owned())
    }
}

/// Returns the character of a `'.'` literal.
pub(super) fn unescape_char(literal: &str) -> Result<char, BadLiteral> {
    unescape(literal)
}

/// Reads a literal with escapes as `ron` does. The error of an invalid escape has the span of that escape.
fn unescape<T: DeserializeOwned>(literal: &str) -> Result<T, BadLiteral> {
    ron::from_str(literal).map_err(|error| {
        if error.code == ron::Error::ExpectedChar {
            return BadLiteral {
                span: Span::new(0, literal.len()),
                message: "more than one character in single quotes",
            };
        }
        let Position { line, col } = error.span.end;
        let lines = literal.split_inclusive('\n').take(line - 1);
        let line_start: usize = lines.map(str::len).sum();
        let before = literal[line_start..].chars().take(col - 1);
        let end = line_start + before.map(char::len_utf8).sum::<usize>();
        let start = literal[..end].rfind('\\').unwrap_or(0);
        let escaped = literal[start..].chars().nth(1);
        BadLiteral {
            span: Span::new(start, start + 1 + escaped.map_or(0, char::len_utf8)),
            message: match escaped {
                Some('x') => {
                    "`\\x` must be followed by two hexadecimal digits that are part of valid UTF-8"
                }
                Some('u') => {
                    "`\\u` must be followed by the hexadecimal code of a character, as in `\\u{e9}`"
                }
                _ => "unknown escape: write a backslash as `\\\\`",
            },
        }
    })
}

/// Returns the text of a raw string literal (a literal that starts with `r`).
pub(super) fn raw_string(literal: &str) -> String {
    let hashes = literal[1..].find('"').unwrap_or(0);
    literal[2 + hashes..literal.len() - 1 - hashes].to_owned()
}

/// Returns a name without the `r#` of a raw name.
pub(super) fn name(text: &str) -> &str {
    text.strip_prefix("r#").unwrap_or(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn whole_numbers_are_read_in_every_base() {
        let value = |text: &str| Number::parse(text).and_then(|n| n.to_int());

        assert_eq!(value("1_000_000"), Some(1_000_000));
        assert_eq!(value("-0xFF"), Some(-255));
        assert_eq!(value("0b101"), Some(5));
        assert_eq!(value("0o17"), Some(15));
        assert_eq!(value("+7"), Some(7));
        assert_eq!(value("1.0"), None);
    }

    #[test]
    fn invalid_numbers_are_refused() {
        for text in [
            "1u32", "0x", "0b2", "_1", "1.2.3", "1..2", "1._5", "12abc", "1e", "-_1", "30deg",
        ] {
            assert_eq!(Number::parse(text), None, "{text}");
        }
    }

    #[test]
    fn a_huge_whole_number_is_still_a_number() {
        let number = Number::parse(&"9".repeat(60)).unwrap();

        assert_eq!(number.to_int(), None);
        assert!(number.to_float() > 1e59);
    }

    #[test]
    fn escapes_are_those_of_ron() {
        for literal in [
            r#""a\n\t\r\0\\\"\'b""#,
            r#""\x41\u{e9}\u{1F600}""#,
            r#""\xc3\xa9""#,
            "\"a\\\n    b\"",
            "\"a\\\r\n    b\"",
            "\"plain\nline\"",
        ] {
            assert_eq!(
                unescape_string(literal).ok(),
                ron::from_str(literal).ok(),
                "{literal}"
            );
            assert!(ron::from_str::<String>(literal).is_ok());
        }
    }

    #[test]
    fn an_invalid_escape_has_its_span() {
        let error = unescape_string(r#""C:\models""#).unwrap_err();

        assert_eq!(error.span, Span::new(3, 5));
        for literal in [
            r#""\x4""#,
            r#""\xff""#,
            r#""\u{}""#,
            r#""\u{d800}""#,
            r#""\u41""#,
            r#""\x+1""#,
        ] {
            assert!(unescape_string(literal).is_err(), "{literal}");
            assert!(ron::from_str::<String>(literal).is_err(), "{literal}");
        }
    }

    #[test]
    fn characters_are_read() {
        assert_eq!(unescape_char("'é'"), Ok('é'));
        assert_eq!(unescape_char(r"'\''"), Ok('\''));
        assert!(unescape_char(r"'\x41\x41'").is_err());
        assert_eq!(raw_string("r##\"a\"#b\"##"), "a\"#b");
    }

    proptest! {
        #[test]
        fn numbers_agree_with_ron(text in "[-+]?(0x|0b|0o)?[0-9a-f_]{1,4}([.][0-9_]{0,3})?(e[-+]?[0-9_]{1,2})?") {
            let number = Number::parse(&text);
            if let Ok(int) = ron::from_str::<i64>(&text) {
                prop_assert_eq!(number.as_ref().and_then(Number::to_int), Some(i128::from(int)));
            }
            match number {
                Some(Number::Int(_)) if !text.starts_with('-') || text == "-0" => {
                    prop_assert!(ron::from_str::<i64>(&text).is_ok());
                }
                Some(Number::Float(_)) => {
                    let value: f64 = ron::from_str(&text).unwrap();
                    prop_assert_eq!(value.to_bits(), number.unwrap().to_float().to_bits());
                }
                _ => {}
            }
        }
    }
}
