//! A fast path for the common forms of `v`, `vt`, `vn` and `f` lines.
//!
//! The fast path gives the same result as [`super::statement`]. If a line has a less common form, [`super::statement`]
//! parses the line again from its beginning.

use super::corner::Index;
use super::parser::Parser;
use crate::decimal::{leading_number, up_to_eight_digits};
use crate::fault::Fault;
use crate::text::{TextPosition, is_blank};

impl Parser<'_> {
    /// Parses the line at the cursor if it has the common form of `v`, `vt`, `vn` or `f`.
    #[inline]
    pub(super) fn fast_line(&mut self) -> bool {
        let line = self.cursor.ahead();
        let length = match line {
            [b'v', blank, ..] if is_blank(*blank) => self.fast_numbers(line, 1, Self::vertex),
            [b'f', blank, ..] if is_blank(*blank) => self.fast_face(line),
            [b'v', b't', blank, ..] if is_blank(*blank) => self.fast_numbers(line, 2, Self::uv),
            [b'v', b'n', blank, ..] if is_blank(*blank) => self.fast_numbers(line, 2, Self::normal),
            _ => None,
        };
        let Some(length) = length else { return false };
        self.cursor.pass_line(length);
        true
    }

    #[inline]
    fn fast_numbers<const N: usize>(
        &mut self,
        line: &[u8],
        at: usize,
        add: impl Fn(&mut Self, TextPosition, [f64; N], usize) -> Result<(), Fault>,
    ) -> Option<usize> {
        let (values, n, length) = numbers(line, at)?;
        add(self, self.cursor.place(), values, n).ok()?;
        Some(length)
    }

    fn fast_face(&mut self, line: &[u8]) -> Option<usize> {
        let before = self.part.n_corners();
        let had = self.columns();
        let length = self.fast_corners(line);
        if length.is_none() || self.part.n_corners() - before < 3 {
            self.part.truncate_corners(before, had);
            return None;
        }
        self.end_face();
        length
    }

    /// Appends the corners of a face. Returns `None` if the line does not have the common form. In this case, the
    /// caller must remove the corners that were already appended.
    #[inline]
    fn fast_corners(&mut self, line: &[u8]) -> Option<usize> {
        let now = self.part.counts();
        let mut at = 1;
        loop {
            at = skip_blanks(line, at);
            if let Some(length) = line_end(line, at) {
                return Some(at + length);
            }
            let mut corner = [None; 3];
            for (k, slot) in corner.iter_mut().enumerate() {
                if k > 0 {
                    if line.get(at) != Some(&b'/') {
                        break;
                    }
                    at += 1;
                    if k == 1 && line.get(at) == Some(&b'/') {
                        continue;
                    }
                }
                let (index, next) = index(line, at, now[k])?;
                (*slot, at) = (Some(index), next);
            }
            if !ends_word(line, at) {
                return None;
            }
            self.part.push_corner(corner);
        }
    }
}

/// Parses at most N numbers from `at` to the end of the line. Returns an array with the numbers, the count of the
/// numbers, and the offset after the line end.
#[inline]
fn numbers<const N: usize>(line: &[u8], mut at: usize) -> Option<([f64; N], usize, usize)> {
    let mut values = [0.0; N];
    let mut n = 0;
    loop {
        at = skip_blanks(line, at);
        if let Some(length) = line_end(line, at) {
            return Some((values, n, at + length));
        }
        let value = values.get_mut(n)?;
        let (x, length) = leading_number(line.get(at..)?)?;
        *value = x;
        n += 1;
        at += length;
        if !ends_word(line, at) {
            return None;
        }
    }
}

/// Parses an index of at most eight digits. Returns the index and the position after it.
#[inline]
fn index(line: &[u8], at: usize, count: usize) -> Option<(Index, usize)> {
    let negative = line.get(at) == Some(&b'-');
    let start = at + usize::from(negative);
    let (value, n) = up_to_eight_digits(line, start);
    let end = start + n;
    if value == 0 || (n == 8 && line.get(end).is_some_and(u8::is_ascii_digit)) {
        return None;
    }
    let index = if negative {
        Index::Relative(i64::try_from(count).ok()? - i64::try_from(value).ok()?)
    } else {
        Index::Absolute(u32::try_from(value - 1).ok()?)
    };
    Some((index, end))
}

#[inline]
fn skip_blanks(line: &[u8], mut at: usize) -> usize {
    while line.get(at).is_some_and(|&byte| is_blank(byte)) {
        at += 1;
    }
    at
}

/// Returns the length of the line end at `at`, or `None` if there is no line end.
#[inline]
fn line_end(line: &[u8], at: usize) -> Option<usize> {
    match line.get(at)? {
        b'\n' => Some(1),
        b'\r' => Some(1 + usize::from(line.get(at + 1) == Some(&b'\n'))),
        _ => None,
    }
}

#[inline]
fn ends_word(line: &[u8], at: usize) -> bool {
    line.get(at)
        .is_some_and(|&byte| is_blank(byte) || matches!(byte, b'\n' | b'\r'))
}
