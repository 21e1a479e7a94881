//! Provides the values of a PLY file as tables. The file can be binary or text.
//!
//! The rows of a text file are first converted to binary rows, so the other modules handle only binary rows.
//! Floating-point values of a text file are converted to 64 bits.

use std::borrow::Cow;

use super::header::{Element, Encoding, Header, Property};
use super::table::Table;
use super::types::Type;
use crate::fault::{Fault, Location};
use crate::note::Notes;
use crate::text::{Cursor, TextPosition, is_not_finite, number, parsed};
use mesh::counted;

/// The values of a file as bytes.
#[derive(Debug)]
pub(super) struct Body<'a> {
    file: &'a [u8],
    header: &'a Header,
    /// The elements of the header. For a text file, the property types in this list are changed to the types of the
    /// values in [`bytes`](Self::bytes).
    elements: Vec<Element>,
    bytes: Cow<'a, [u8]>,
    /// The position in `bytes` at which the values begin.
    start: usize,
}

impl<'a> Body<'a> {
    /// Prepares the values of the elements. In a text file, the rows of elements for which `wanted` returns false are
    /// skipped.
    ///
    /// # Errors
    ///
    /// Returns an error for the first position in a text file that violates the format.
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

    /// Returns the tables of all elements, in the order of the header. In a text file, the tables of skipped elements
    /// are empty.
    ///
    /// # Errors
    ///
    /// Returns an error if the file is too short or a list has a negative count. If bytes are left at the end of the
    /// file, adds a note instead.
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
        notes.left_out(
            "extra-content",
            rest,
            None,
            "bytes left out after the last element",
        );
        Ok(tables)
    }

    /// Creates an error at the position of a value: the line and column in a text file, or the byte offset in a binary
    /// file.
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
        let list_count = usize::from(table.properties[property].count.is_some());
        let word = words.sum::<usize>() + list_count + item;
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
        if let Location::Text(place) = &mut error.at {
            place.line += self.header.lines;
        }
        error
    }
}

/// Returns the binary type to which a value of a text file is converted.
fn stored(kind: Type) -> Type {
    if kind.is_float() { Type::Float64 } else { kind }
}

/// Converts the rows of a text file to little-endian binary rows.
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
            let (lines, rest) = (counted(rows, "line"), cursor.remaining());
            let message = format!(
                "the rest of the file is too short for {lines} of {element} (bytes left: {rest})"
            );
            return Err(cursor.place().error(message));
        }
        let wanted = wanted(element);
        for row in 0..rows {
            cursor.skip_empty_lines();
            if cursor.is_at_end() {
                let lines = counted(rows, "line");
                let message = format!("expected {lines} of {element}, found {row}");
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
    notes.left_out(
        "extra-content",
        lines,
        first,
        "lines left out after the last element",
    );
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
                    _ => return Err(place.expected("a valid list count", word)),
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
) -> Result<(TextPosition, &'a [u8]), Fault> {
    cursor.argument().ok_or_else(|| {
        let message = format!(
            "expected a value of the property {property} of {element}, found the end of the line"
        );
        cursor.place().error(message)
    })
}

/// Appends a value to `out`. Returns the value if its type is an integer type, otherwise 0.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the range of the integer is checked"
)]
fn push_value(
    out: &mut Vec<u8>,
    kind: Type,
    place: TextPosition,
    word: &[u8],
) -> Result<i64, Fault> {
    if kind.is_float() {
        // Non-finite values are accepted here. The code that uses a value decides whether non-finite values are
        // allowed.
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
        let what = format_args!("an integer from {least} to {most} ({name})");
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
