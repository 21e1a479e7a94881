//! The lines that OBJ files mostly consist of, read without the detours that the others need.
//!
//! What is taken here is what [`super::statement`] would make of it; whatever is unusual about a line
//! leaves it to the general way, from the line's beginning.

use super::corner::Index;
use super::parser::Parser;
use crate::decimal::{leading_number, up_to_eight_digits};
use crate::fault::Fault;
use crate::text::{Place, is_blank};

impl Parser<'_> {
    /// Reads the line under the cursor if it is a usual `v`, `vt`, `vn` or `f`.
    #[inline]
    pub(super) fn usual_line(&mut self) -> bool {
        let line = self.cursor.ahead();
        let length = match line {
            [b'v', blank, ..] if is_blank(*blank) => self.usual_numbers(line, 1, Self::vertex),
            [b'f', blank, ..] if is_blank(*blank) => self.usual_face(line),
            [b'v', b't', blank, ..] if is_blank(*blank) => self.usual_numbers(line, 2, Self::uv),
            [b'v', b'n', blank, ..] if is_blank(*blank) => {
                self.usual_numbers(line, 2, Self::normal)
            }
            _ => None,
        };
        let Some(length) = length else { return false };
        self.cursor.pass_line(length);
        true
    }

    #[inline]
    fn usual_numbers<const N: usize>(
        &mut self,
        line: &[u8],
        at: usize,
        take: impl Fn(&mut Self, Place, [f64; N], usize) -> Result<(), Fault>,
    ) -> Option<usize> {
        let (values, n, length) = numbers(line, at)?;
        take(self, self.cursor.place(), values, n).ok()?;
        Some(length)
    }

    fn usual_face(&mut self, line: &[u8]) -> Option<usize> {
        let before = self.part.n_corners();
        let had = self.columns();
        let length = self.usual_corners(line);
        if length.is_none() || self.part.n_corners() - before < 3 {
            self.part.truncate_corners(before, had);
            return None;
        }
        self.end_face();
        length
    }

    /// Appends the corners of a face, some of them perhaps even if the line is not a usual one.
    #[inline]
    fn usual_corners(&mut self, line: &[u8]) -> Option<usize> {
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

/// The numbers from `at` to the end of the line, at most N, how many they are, and where the line ends.
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

/// An index of at most eight digits, and where it ends.
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

/// How many bytes the line end at `at` has, if there is one.
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
