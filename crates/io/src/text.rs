//! Reads words and numbers from the bytes of a text file, and tracks the line and the column.

use std::str::FromStr;

use crate::decimal::leading_number;
pub(crate) use crate::decimal::push_number;
use crate::fault::Fault;
pub(crate) use crate::fault::{TextPosition, name, quoted};

/// The byte order mark of UTF-8.
pub(crate) const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Reads the bytes of a text file sequentially. Lines end in LF, CR LF or CR.
#[derive(Clone, Debug)]
pub(crate) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
    line_start: usize,
}

impl<'a> Cursor<'a> {
    /// Creates a cursor at the first byte of `bytes`, after a byte order mark if there is one.
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        let start = if bytes.starts_with(BYTE_ORDER_MARK) {
            BYTE_ORDER_MARK.len()
        } else {
            0
        };
        Self {
            at: start,
            line_start: start,
            ..Self::inside(bytes)
        }
    }

    pub(crate) fn place(&self) -> TextPosition {
        TextPosition {
            line: self.line,
            column: self.at - self.line_start + 1,
        }
    }

    /// Creates a cursor for a part of a text file that begins after the start of the file. Unlike [`new`](Self::new),
    /// this function does not skip a byte order mark.
    pub(crate) fn inside(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            at: 0,
            line: 1,
            line_start: 0,
        }
    }

    /// The bytes from the cursor to the end.
    pub(crate) fn ahead(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    /// Skips `length` bytes, which must be the rest of a line including its end.
    pub(crate) fn pass_line(&mut self, length: usize) {
        self.at += length;
        self.line += 1;
        self.line_start = self.at;
    }

    /// The number of bytes from the cursor to the end.
    pub(crate) fn remaining(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// Whether the remaining bytes are enough for `n` items, each with `words_each` words. A word takes at least one
    /// byte, and all words except the last need a separator.
    pub(crate) fn has_room(&self, n: usize, words_each: usize) -> bool {
        let least = n.checked_mul(2 * words_each);
        least.is_some_and(|least| least <= self.remaining() + 1)
    }

    pub(crate) fn is_at_end(&self) -> bool {
        self.at >= self.bytes.len()
    }

    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    /// Skips blanks within the line, and line ends that are escaped by a backslash.
    pub(crate) fn skip_blanks(&mut self) {
        while let Some(byte) = self.peek() {
            if is_blank(byte) {
                self.at += 1;
            } else if byte != b'\\' || !self.skip_continuation() {
                return;
            }
        }
    }

    /// Skips blanks and line ends.
    pub(crate) fn skip_white(&mut self) {
        while let Some(byte) = self.peek() {
            if is_blank(byte) {
                self.at += 1;
            } else if !self.skip_line_end() {
                return;
            }
        }
    }

    /// Reads the next word. A word ends before a blank, a line end, a backslash that continues the line, or the end of
    /// the text. If the cursor is already at the end of a word, the word is empty.
    pub(crate) fn word(&mut self) -> &'a [u8] {
        let start = self.at;
        while let Some(byte) = self.peek() {
            if is_blank(byte) || is_line_end(byte) || (byte == b'\\' && self.continues()) {
                break;
            }
            self.at += 1;
        }
        &self.bytes[start..self.at]
    }

    /// Reads the next word of the line. Returns `None` at the end of the line and before a comment.
    pub(crate) fn argument(&mut self) -> Option<(TextPosition, &'a [u8])> {
        self.skip_blanks();
        let place = self.place();
        match self.peek() {
            None | Some(b'\n' | b'\r' | b'#') => None,
            Some(_) => Some((place, self.word())),
        }
    }

    /// Reads the next word of the line. Returns an empty word at the end of the line and before a comment.
    pub(crate) fn argument_or_nothing(&mut self) -> (TextPosition, &'a [u8]) {
        self.argument().unwrap_or((self.place(), b""))
    }

    /// Checks that the line has no more words. `why` is appended to "the end of the line" in the error message.
    ///
    /// # Errors
    ///
    /// Returns an error if there is another word.
    pub(crate) fn end_of_line(&mut self, why: &str) -> Result<(), Fault> {
        match self.argument() {
            None => Ok(()),
            Some((place, word)) => {
                Err(place.expected(format_args!("the end of the line{why}"), word))
            }
        }
    }

    /// Reads the next word, which can be on a later line. Returns an empty word at the end of the text.
    pub(crate) fn next_word(&mut self) -> (TextPosition, &'a [u8]) {
        self.skip_white();
        (self.place(), self.word())
    }

    /// Skips blanks, line ends and comments, up to the next word or the end of the text.
    pub(crate) fn skip_empty_lines(&mut self) {
        loop {
            self.skip_white();
            if self.is_at_end() || self.clone().argument().is_some() {
                return;
            }
            self.skip_line();
        }
    }

    /// Skips all remaining lines. Returns the number of lines that contain words, and the line number of the first of
    /// these lines.
    pub(crate) fn count_rest(&mut self) -> (usize, usize) {
        self.skip_empty_lines();
        let first = self.place().line;
        let mut lines = 0;
        while !self.is_at_end() {
            lines += 1;
            self.skip_line();
            self.skip_empty_lines();
        }
        (lines, first)
    }

    /// Reads the rest of the line without surrounding blanks. Continued lines are joined by a space.
    pub(crate) fn rest_of_line(&mut self) -> Vec<u8> {
        let mut rest = Vec::new();
        self.skip_blanks();
        while let Some(byte) = self.peek() {
            if is_line_end(byte) {
                break;
            }
            if byte == b'\\' && self.skip_continuation() {
                rest.push(b' ');
            } else {
                rest.push(byte);
                self.at += 1;
            }
        }
        rest.truncate(rest.trim_ascii_end().len());
        rest
    }

    /// Skips the rest of the line and its line end. A backslash continues a line, except in a comment.
    pub(crate) fn skip_line(&mut self) {
        let mut comment = false;
        while let Some(byte) = self.peek() {
            if is_line_end(byte) {
                self.skip_line_end();
                return;
            }
            comment |= byte == b'#';
            if comment || byte != b'\\' || !self.skip_continuation() {
                self.at += 1;
            }
        }
    }

    /// Whether a line end follows the byte at the cursor.
    fn continues(&self) -> bool {
        self.bytes
            .get(self.at + 1)
            .is_some_and(|&byte| is_line_end(byte))
    }

    fn skip_continuation(&mut self) -> bool {
        if !self.continues() {
            return false;
        }
        self.at += 1;
        self.skip_line_end()
    }

    fn skip_line_end(&mut self) -> bool {
        let length = match (self.peek(), self.bytes.get(self.at + 1)) {
            (Some(b'\r'), Some(b'\n')) => 2,
            (Some(b'\n' | b'\r'), _) => 1,
            _ => return false,
        };
        self.at += length;
        self.line += 1;
        self.line_start = self.at;
        true
    }
}

#[inline]
pub(crate) fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | 0x0b | 0x0c)
}

#[inline]
fn is_line_end(byte: u8) -> bool {
    matches!(byte, b'\n' | b'\r')
}

/// Parses a finite number, correctly rounded.
///
/// # Errors
///
/// Returns an error if the word is not a decimal number or is not finite.
pub(crate) fn number(place: TextPosition, word: &[u8]) -> Result<f64, Fault> {
    if let Some((x, length)) = leading_number(word)
        && length == word.len()
    {
        return Ok(x);
    }
    let text = std::str::from_utf8(word).unwrap_or_default();
    let parsed = text.parse::<f64>().or_else(|error| {
        // Fortran programs write `d` before the exponent of double-precision numbers.
        let (mantissa, exponent) = text.split_once(['d', 'D']).ok_or(error)?;
        format!("{mantissa}e{exponent}").parse()
    });
    match parsed {
        Ok(x) if x.is_finite() => Ok(x),
        Err(_) if !is_not_finite(word) => {
            let mut error = place.expected("a number", word);
            if word.contains(&b',') {
                error.message += " (use a decimal point instead of a comma)";
            }
            Err(error)
        }
        _ => Err(place.expected("a finite number", word)),
    }
}

/// Parses a word with [`FromStr`].
pub(crate) fn parsed<T: FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// Whether a word is a common spelling of infinity or not-a-number, for example `nan`, `-inf` or `1.#IND`.
pub(crate) fn is_not_finite(word: &[u8]) -> bool {
    let unsigned = word.strip_prefix(b"-").unwrap_or(word);
    let unsigned = unsigned.strip_prefix(b"+").unwrap_or(unsigned);
    let start = unsigned.get(..3).unwrap_or_default();
    ["nan", "inf", "1.#"]
        .iter()
        .any(|with| start.eq_ignore_ascii_case(with.as_bytes()))
}

/// Checks that the text is not in UTF-16 or UTF-32.
///
/// # Errors
///
/// Returns an error if the text is in UTF-16 or UTF-32. The error is at the beginning of the text, and its message
/// contains the name of the encoding.
pub(crate) fn check_encoding(bytes: &[u8]) -> Result<(), Fault> {
    let is_wide = |first: usize| {
        let mut pairs = bytes.chunks_exact(2).take(16);
        bytes.len() >= 8 && pairs.all(|pair| pair[first] != 0 && pair[1 - first] == 0)
    };
    let encoding = match bytes {
        [0xff, 0xfe, 0, 0, ..] | [0, 0, 0xfe, 0xff, ..] => "UTF-32",
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => "UTF-16",
        _ if is_wide(0) || is_wide(1) => "UTF-16",
        _ => return Ok(()),
    };
    let message = format!("expected text in UTF-8 or ASCII, found {encoding}");
    Err(TextPosition::START.error(message))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const HERE: TextPosition = TextPosition { line: 1, column: 1 };

    fn written(x: f64) -> String {
        let mut out = Vec::new();
        push_number(&mut out, x);
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn common_spellings_of_numbers_are_read() {
        for (text, x) in [
            ("1", 1.0),
            ("+1.5", 1.5),
            ("-.25", -0.25),
            ("5.", 5.0),
            ("1e-3", 1e-3),
            ("2.5E+2", 250.0),
            ("0.1", 0.1),
            ("1d5", 1e5),
            ("-2.5D-03", -0.0025),
            ("123456789012345678901234567890", 1.234_567_890_123_456_8e29),
        ] {
            assert_eq!(number(HERE, text.as_bytes()), Ok(x), "{text}");
        }
    }

    #[test]
    fn words_other_than_finite_numbers_are_refused() {
        for text in [
            "",
            "abc",
            "1.2.3",
            "1,5",
            "-",
            ".",
            "nan",
            "inf",
            "-infinity",
            "1.#IND",
            "-1.#QNAN00",
            "d5",
            "1d",
            "1d1d1",
            "1e999",
            "0x10",
        ] {
            assert!(number(HERE, text.as_bytes()).is_err(), "{text}");
        }
    }

    #[test]
    fn the_sign_of_zero_is_preserved() {
        assert_eq!(written(-0.0), "-0");
        assert!(number(HERE, b"-0").unwrap().is_sign_negative());
    }

    #[test]
    fn lines_end_in_three_ways_and_positions_start_at_one() {
        let mut cursor = Cursor::new(b"a\r\nb\rc\n  d");
        let mut lines = Vec::new();
        while !cursor.is_at_end() {
            cursor.skip_white();
            lines.push((cursor.place().line, cursor.place().column, cursor.word()));
        }
        assert_eq!(
            lines,
            [(1, 1, &b"a"[..]), (2, 1, b"b"), (3, 1, b"c"), (4, 3, b"d")]
        );
    }

    #[test]
    fn a_backslash_continues_a_line_but_not_a_comment() {
        let mut cursor = Cursor::new(b"f 1 \\\n 2\\\n3\n# art \\\nv");
        let words: Vec<_> = std::iter::from_fn(|| cursor.argument())
            .map(|(_, w)| w)
            .collect();
        assert_eq!(words, [b"f", b"1", b"2", b"3"]);
        cursor.skip_line();
        cursor.skip_line();
        assert_eq!(cursor.word(), b"v");
        assert_eq!(cursor.place().line, 5);
    }

    #[test]
    fn names_that_are_not_utf8_are_latin1() {
        assert_eq!(name(b"caf\xe9"), "café");
        assert_eq!(name("café".as_bytes()), "café");
    }

    proptest! {
        #[test]
        fn written_numbers_read_back_the_same_bits(bits: u64) {
            let x = f64::from_bits(bits);
            prop_assume!(x.is_finite());
            prop_assert_eq!(number(HERE, written(x).as_bytes()).unwrap().to_bits(), bits);
        }

        #[test]
        fn numbers_equal_those_of_the_standard_library(text in "[-+]?[0-9]{0,12}\\.?[0-9]{0,10}") {
            let expected = text.parse::<f64>().ok().map(f64::to_bits);
            prop_assert_eq!(number(HERE, text.as_bytes()).ok().map(f64::to_bits), expected);
        }
    }
}
