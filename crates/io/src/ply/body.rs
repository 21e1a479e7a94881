//! The values of a file, binary or text, as tables.
//!
//! The rows of a text are turned into binary rows first, with 64 bits for every floating-point value, so that
//! all that follows knows one form only.

use std::borrow::Cow;

use super::header::{Element, Encoding, Header, Property};
use super::table::Table;
use super::types::Type;
use crate::fault::{At, Fault};
use crate::note::Notes;
use crate::text::{Cursor, Place, is_not_finite, number, parsed};

/// The bytes of a file's values.
#[derive(Debug)]
pub(super) struct Body<'a> {
    file: &'a [u8],
    header: &'a Header,
    /// The elements with the types that [`bytes`](Self::bytes) has.
    elements: Vec<Element>,
    bytes: Cow<'a, [u8]>,
    /// Where the values begin in `bytes`.
    start: usize,
}

impl<'a> Body<'a> {
    /// Prepares the elements that are `wanted`; the others are passed over.
    ///
    /// # Errors
    ///
    /// In a text, the first place that breaks the rules of the format.
    pub(super) fn new(
        file: &'a [u8],
        header: &'a Header,
        wanted: impl Fn(&Element) -> bool,
        notes: &mut Notes,
    ) -> Result<Self, Fault> {
        let mut body = Self {
            file,
            header,
            elements: header.elements.clone(),
            bytes: Cow::Borrowed(file),
            start: header.length,
        };
        if header.encoding == Encoding::Text {
            for element in &mut body.elements {
                if !wanted(element) {
                    element.rows = 0;
                }
                for property in &mut element.properties {
                    property.value = stored(property.value);
                }
            }
            let bytes = transcoded(&file[header.length..], header, wanted, notes);
            body.bytes = Cow::Owned(bytes.map_err(|error| body.text_error(error))?);
            body.start = 0;
        }
        Ok(body)
    }

    /// The tables of the wanted elements, in the order of the header; of others those of a text are
    /// empty.
    ///
    /// # Errors
    ///
    /// If the file is too short or a list has a negative count. Bytes that are left are noted.
    pub(super) fn tables(&self, notes: &mut Notes) -> Result<Vec<Table<'_>>, Fault> {
        let mut at = self.start;
        let big = self.header.encoding == Encoding::BigEndian;
        let mut tables = Vec::with_capacity(self.elements.len());
        for element in &self.elements {
            let (table, end) = Table::locate(element, &self.bytes, at, big)?;
            tables.push(table);
            at = end;
        }
        let rest = self.bytes.len() - at;
        notes.left_out(rest, None, "bytes behind the last element left out");
        Ok(tables)
    }

    /// An error about a value: the line and column of a text, the byte of a binary file.
    pub(super) fn error(
        &self,
        tables: &[Table],
        (element, property, row, item): (usize, usize, usize, usize),
        message: String,
    ) -> Fault {
        let table = &tables[element];
        if self.header.encoding != Encoding::Text {
            let size = table.properties[property].value.size();
            let offset = table.start + table.at(property, row) + item * size;
            return Fault::byte(offset, message);
        }
        let rows: usize = self.header.elements[..element]
            .iter()
            .map(|e| if e.properties.is_empty() { 0 } else { e.rows })
            .sum();
        let words = table.properties[..property].iter().enumerate();
        let words = words.map(|(p, property)| match property.count {
            Some(_) => 1 + table.count(p, row),
            None => 1,
        });
        let own = usize::from(table.properties[property].count.is_some());
        let word = words.sum::<usize>() + own + item;
        let mut cursor = Cursor::new(&self.file[self.header.length..]);
        for _ in 0..rows + row {
            cursor.skip_empty_lines();
            cursor.skip_line();
        }
        cursor.skip_empty_lines();
        for _ in 0..word {
            cursor.argument();
        }
        cursor.skip_blanks();
        self.text_error(cursor.place().error(message))
    }

    fn text_error(&self, mut error: Fault) -> Fault {
        if let At::Text(place) = &mut error.at {
            place.line += self.header.lines;
        }
        error
    }
}

/// The type in which a value of a text is stored.
fn stored(kind: Type) -> Type {
    if kind.is_float() { Type::Float64 } else { kind }
}

/// The rows of a text as little-endian rows.
fn transcoded(
    text: &[u8],
    header: &Header,
    wanted: impl Fn(&Element) -> bool,
    notes: &mut Notes,
) -> Result<Vec<u8>, Fault> {
    let mut out = Vec::new();
    let mut cursor = Cursor::new(text);
    for element in &header.elements {
        if element.properties.is_empty() {
            continue;
        }
        let rows = element.rows;
        if !cursor.has_room(rows, element.properties.len()) {
            let rest = cursor.remaining();
            let message = format!("expected {rows} lines of {element}, found {rest} bytes");
            return Err(cursor.place().error(message));
        }
        let wanted = wanted(element);
        for row in 0..rows {
            cursor.skip_empty_lines();
            if cursor.is_at_end() {
                let message = format!("expected {rows} lines of {element}, found {row}");
                return Err(cursor.place().error(message));
            }
            if wanted {
                push_row(&mut out, &mut cursor, element)?;
            }
            cursor.skip_line();
        }
    }
    let (lines, first) = cursor.count_rest();
    let first = first + header.lines;
    notes.left_out(lines, first, "lines behind the last element left out");
    Ok(out)
}

fn push_row(out: &mut Vec<u8>, cursor: &mut Cursor, element: &Element) -> Result<(), Fault> {
    for property in &element.properties {
        let n = match property.count {
            None => 1,
            Some(kind) => {
                let (place, word) = next(cursor, element, property)?;
                let count = push_value(out, kind, place, word)?;
                let room = cursor.remaining() / 2 + 1;
                match usize::try_from(count) {
                    Ok(n) if n <= room => n,
                    _ => return Err(place.expected("a count", word)),
                }
            }
        };
        for _ in 0..n {
            let (place, word) = next(cursor, element, property)?;
            push_value(out, property.value, place, word)?;
        }
    }
    cursor.end_of_line(&format!(": {element} has no more properties"))
}

fn next<'a>(
    cursor: &mut Cursor<'a>,
    element: &Element,
    property: &Property,
) -> Result<(Place, &'a [u8]), Fault> {
    cursor.argument().ok_or_else(|| {
        let message =
            format!("expected a value of {property} of {element}, found the end of the line");
        cursor.place().error(message)
    })
}

/// Puts a value behind `out`, and returns it if it is a whole number.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the range is checked"
)]
fn push_value(out: &mut Vec<u8>, kind: Type, place: Place, word: &[u8]) -> Result<i64, Fault> {
    if kind.is_float() {
        // What it means is decided where it is used.
        let x = if is_not_finite(word) {
            f64::NAN
        } else {
            number(place, word)?
        };
        out.extend_from_slice(&x.to_le_bytes());
        return Ok(0);
    }
    let (least, most) = kind.range();
    let value = whole(word).filter(|value| (least..=most).contains(value));
    let Some(value) = value else {
        let name = kind.name();
        let what = format_args!("a whole number from {least} to {most} ({name})");
        return Err(place.expected(what, word));
    };
    match kind.size() {
        1 => out.push(value as u8),
        2 => out.extend_from_slice(&(value as u16).to_le_bytes()),
        _ => out.extend_from_slice(&(value as u32).to_le_bytes()),
    }
    Ok(value)
}

fn whole(word: &[u8]) -> Option<i64> {
    if let [first, ..] = word
        && first.is_ascii_digit()
        && word.len() < 18
    {
        return word.iter().try_fold(0, |value, byte| {
            byte.is_ascii_digit()
                .then(|| value * 10 + i64::from(byte - b'0'))
        });
    }
    parsed(word)
}
