//! Reads the literals that the lexer cut out: numbers, strings, characters, names.
//!
//! The rules are those of `ron`, save that numbers carry no type (`1u32`) and that only text is
//! text (no bytes).

use std::str::FromStr;

use crate::diagnostic::Span;

/// What is wrong with a literal, and where in it.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct BadLiteral {
    /// The bad part, counted from the start of the literal.
    pub(super) span: Span,
    /// What is wrong.
    pub(super) message: &'static str,
}

/// A number as it was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Number {
    /// A whole number, in any of the bases that RON has.
    Int(Box<str>),
    /// A number with a point, an exponent, `inf` or `NaN`.
    Float(Box<str>),
}

impl Number {
    /// Reads a number; `None` if it is none.
    pub fn parse(text: &str) -> Option<Self> {
        if parse_int(text).is_some() {
            Some(Self::Int(text.into()))
        } else if parse_float::<f64>(text).is_some() {
            Some(Self::Float(text.into()))
        } else {
            None
        }
    }

    /// The number as it was written.
    pub fn text(&self) -> &str {
        match self {
            Self::Int(text) | Self::Float(text) => text,
        }
    }

    /// The value of a whole number; `None` for others, and beyond 128 bits.
    pub fn to_int(&self) -> Option<i128> {
        match self {
            Self::Int(text) => parse_int(text)?.ok(),
            Self::Float(_) => None,
        }
    }

    /// Whether the number is whole.
    pub fn is_int(&self) -> bool {
        matches!(self, Self::Int(_))
    }

    /// The value, rounded to the nearest number of 64 bits.
    pub fn to_float(&self) -> f64 {
        let whole = || self.to_int().map(|int| int as f64);
        parse_float(self.text())
            .or_else(whole)
            .unwrap_or(f64::INFINITY)
    }

    /// The value, rounded to the nearest number of 32 bits.
    pub fn to_single(&self) -> f32 {
        let whole = || self.to_int().map(|int| int as f32);
        parse_float(self.text())
            .or_else(whole)
            .unwrap_or(f32::INFINITY)
    }

    /// Whether the number is whole and written with `0x`, `0o` or `0b`, as `ron` reads whole
    /// numbers only.
    pub fn has_base(&self) -> bool {
        matches!(self, Self::Int(text) if base(text.trim_start_matches(['+', '-'])).0 != 10)
    }
}

/// The value of a whole number, or that it is beyond 128 bits; `None` if the text is none.
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

/// The base of a whole number and its digits.
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
    // `ron` takes an underscore behind a digit or an exponent, not at the start or behind a point.
    let mut may_follow = false;
    let mut plain = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '_' if may_follow => continue,
            '0'..='9' | 'e' | 'E' => may_follow = true,
            '.' => may_follow = false,
            '+' | '-' => {}
            _ => return None,
        }
        plain.push(c);
    }
    plain.parse().ok()
}

/// The text of a `".."` literal.
pub(super) fn unescape_string(literal: &str) -> Result<String, BadLiteral> {
    let inside = &literal[1..literal.len() - 1];
    let mut text = String::with_capacity(inside.len());
    let mut at = 0;
    while let Some(found) = inside[at..].find('\\') {
        text.push_str(&inside[at..at + found]);
        at += found;
        let rest = &inside[at + 1..];
        let line_end = if rest.starts_with("\r\n") {
            2
        } else {
            usize::from(rest.starts_with('\n'))
        };
        if line_end > 0 {
            let spaces = rest[line_end..].trim_start_matches([' ', '\t', '\n', '\r']);
            at = inside.len() - spaces.len();
            continue;
        }
        let (c, length) =
            unescape(rest, false).map_err(|message| bad_escape(1 + at, rest, message))?;
        text.push(c);
        at += 1 + length;
    }
    text.push_str(&inside[at..]);
    Ok(text)
}

/// The text of a raw string literal, which starts with `r`.
pub(super) fn raw_string(literal: &str) -> String {
    let hashes = literal[1..].find('"').unwrap_or(0);
    literal[2 + hashes..literal.len() - 1 - hashes].to_owned()
}

/// The character of a `'.'` literal.
pub(super) fn unescape_char(literal: &str) -> Result<char, BadLiteral> {
    let inside = &literal[1..literal.len() - 1];
    let whole = |message| BadLiteral {
        span: Span::new(0, literal.len()),
        message,
    };
    let Some(rest) = inside.strip_prefix('\\') else {
        return inside.chars().next().ok_or(whole("a character is missing"));
    };
    let (c, length) = unescape(rest, true).map_err(|message| bad_escape(1, rest, message))?;
    if length == rest.len() {
        Ok(c)
    } else {
        Err(whole("more than one character"))
    }
}

/// A name without the `r#` of raw ones.
pub(super) fn name(text: &str) -> &str {
    text.strip_prefix("r#").unwrap_or(text)
}

fn bad_escape(at: usize, rest: &str, message: &'static str) -> BadLiteral {
    let length = 1 + rest.chars().next().map_or(0, char::len_utf8);
    BadLiteral {
        span: Span::new(at, at + length),
        message,
    }
}

/// The character of the escape whose backslash stands before `text`, and the length of the rest.
fn unescape(text: &str, is_char: bool) -> Result<(char, usize), &'static str> {
    let c = match text.chars().next() {
        Some(c @ ('\'' | '"' | '\\')) => c,
        Some('n') => '\n',
        Some('r') => '\r',
        Some('t') => '\t',
        Some('0') => '\0',
        Some('x') => return unescape_bytes(text, is_char),
        Some('u') => return unescape_unicode(text),
        _ => return Err("unknown escape in a string: a backslash is written `\\\\`"),
    };
    Ok((c, 1))
}

/// `\x41`, or several of them that make one character of UTF-8.
fn unescape_bytes(text: &str, is_char: bool) -> Result<(char, usize), &'static str> {
    const BAD: &str = "`\\x` is followed by two hexadecimal digits of a character in UTF-8";
    let mut bytes = Vec::with_capacity(4);
    let mut at = 0;
    while bytes.len() < if is_char { 1 } else { 4 } {
        // The first backslash was taken off by the caller.
        let prefix = if at == 0 { "x" } else { "\\x" };
        let digits = text[at..]
            .strip_prefix(prefix)
            .and_then(|rest| rest.get(..2))
            .ok_or(BAD)?;
        let hexadecimal = digits.bytes().all(|b| b.is_ascii_hexdigit());
        let byte = u8::from_str_radix(digits, 16)
            .ok()
            .filter(|_| hexadecimal)
            .ok_or(BAD)?;
        bytes.push(byte);
        at += prefix.len() + 2;
        if let Some(c) = std::str::from_utf8(&bytes)
            .ok()
            .and_then(|s| s.chars().next())
        {
            return Ok((c, at));
        }
    }
    Err(BAD)
}

/// `\u{1F600}`.
fn unescape_unicode(text: &str) -> Result<(char, usize), &'static str> {
    const BAD: &str = "`\\u` is followed by the hexadecimal number of a character, as `\\u{e9}`";
    let inside = text.strip_prefix("u{").ok_or(BAD)?;
    let end = inside
        .find('}')
        .filter(|end| (1..=6).contains(end))
        .ok_or(BAD)?;
    let digits = &inside[..end];
    let hexadecimal = digits.bytes().all(|b| b.is_ascii_hexdigit());
    let number = u32::from_str_radix(digits, 16)
        .ok()
        .filter(|_| hexadecimal)
        .ok_or(BAD)?;
    Ok((char::from_u32(number).ok_or(BAD)?, end + 3))
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
    fn what_is_no_number_is_refused() {
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
    fn a_bad_escape_is_pointed_at() {
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
