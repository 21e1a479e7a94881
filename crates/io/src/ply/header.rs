//! Parses the header of a PLY file, which declares the elements of the file. An element is a table, such as `vertex` or
//! `face`. The columns of this table are called properties.

use std::fmt;

use super::types::Type;
use crate::fault::Fault;
use crate::text::{BYTE_ORDER_MARK, TextPosition, name, parsed, quoted};

/// The maximum number of properties of all elements together. Usual files have far fewer properties. The reader reads
/// the data once for each property, so the maximum limits the time for reading.
pub(super) const MAX_PROPERTIES: usize = 4096;
/// The maximum number of elements. Usual files have far fewer elements. The maximum limits the time for finding
/// elements by name.
const MAX_ELEMENTS: usize = 1024;

/// The encoding of the values of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// The content of a header.
#[derive(Clone, Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// The comments, without the word `comment`.
    pub(super) comments: Vec<String>,
    /// The length of the header in bytes. The values begin after the header.
    pub(super) length: usize,
    /// The number of lines of the header.
    pub(super) lines: usize,
}

/// An element of the file, which is a table with the same properties in each row.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) rows: usize,
    pub(super) properties: Vec<Property>,
    /// The position of the declaration.
    pub(super) place: TextPosition,
}

/// A property, which is a column of an element.
#[derive(Clone, Debug)]
pub(super) struct Property {
    pub(super) name: String,
    /// The type of the count, if the property is a list.
    pub(super) count: Option<Type>,
    /// The type of the value, or of the items of a list.
    pub(super) value: Type,
    /// The position of the declaration.
    pub(super) place: TextPosition,
}

impl Header {
    pub(super) fn element(&self, name: &str) -> Option<(usize, &Element)> {
        let mut all = self.elements.iter().enumerate();
        all.find(|(_, element)| element.name == name)
    }
}

impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "element `{}`", self.name.escape_debug())
    }
}

impl fmt::Display for Property {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}`", self.name.escape_debug())
    }
}

impl Element {
    /// Returns the index of the property with this name. The property must be a list if `is_list` is true, and a scalar
    /// otherwise.
    pub(super) fn find(&self, name: &str, is_list: bool) -> Option<usize> {
        let is_it = |p: &Property| p.count.is_some() == is_list && p.name == name;
        self.properties.iter().position(is_it)
    }

    /// The index of the scalar property with this name.
    pub(super) fn scalar(&self, name: &str) -> Option<usize> {
        self.find(name, false)
    }

    /// The index of the list property with this name.
    pub(super) fn list(&self, name: &str) -> Option<usize> {
        self.find(name, true)
    }
}

/// Parses the header.
///
/// # Errors
///
/// Returns an error for the first line that violates the format.
pub(super) fn parse(bytes: &[u8]) -> Result<Header, Fault> {
    let start = if bytes.starts_with(BYTE_ORDER_MARK) {
        BYTE_ORDER_MARK.len()
    } else {
        0
    };
    let mut encoding = None;
    let mut header = Header {
        encoding: Encoding::Text,
        elements: Vec::new(),
        comments: Vec::new(),
        length: start,
        lines: 0,
    };
    let end = line_end(bytes);
    let lines = bytes[start..].split_inclusive(|&byte| byte == end);
    for (line, bytes) in (1..).zip(lines) {
        (header.length, header.lines) = (header.length + bytes.len(), line);
        let start = TextPosition::of_line(line);
        let mut words = Words {
            rest: bytes.strip_suffix(&[end]).unwrap_or(bytes),
            place: start,
        };
        let (place, keyword) = words.next();
        match keyword {
            b"ply" if line == 1 => {}
            _ if line == 1 => return Err(place.expected("`ply`", keyword)),
            b"comment" => header.comments.push(name(words.rest.trim_ascii())),
            b"format" if encoding.is_some() => {
                return Err(place.error("expected one `format` line, found a second one"));
            }
            b"format" => encoding = Some(format(&mut words)?),
            b"element" => header.add_element(&mut words)?,
            b"property" => header.add_property(&mut words, place)?,
            b"end_header" => {
                let message = "expected a `format` line before the end of the header, found none";
                header.encoding = encoding.ok_or_else(|| start.error(message))?;
                return Ok(header);
            }
            b"" | b"obj_info" => {}
            other => return Err(place.expected("a line of a PLY header", other)),
        }
    }
    if header.lines == 0 {
        return Err(TextPosition::START.expected("`ply`", b""));
    }
    let message = "expected `end_header`, found the end of the file";
    Err(TextPosition::of_line(header.lines + 1).error(message))
}

/// Returns the byte value that ends each line of the header: CR if lines end in CR alone, otherwise LF. Only the first
/// line is examined, because data bytes after the header can look like line ends.
fn line_end(bytes: &[u8]) -> u8 {
    let end = bytes.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
    match end.map(|at| (bytes[at], bytes.get(at + 1))) {
        Some((b'\r', next)) if next != Some(&b'\n') => b'\r',
        _ => b'\n',
    }
}

fn format(words: &mut Words) -> Result<Encoding, Fault> {
    let encoding = match words.next() {
        (_, b"ascii") => Encoding::Text,
        (_, b"binary_little_endian") => Encoding::LittleEndian,
        (_, b"binary_big_endian") => Encoding::BigEndian,
        (place, other) => {
            let names = "ascii, binary_little_endian or binary_big_endian";
            return Err(place.expected(names, other));
        }
    };
    match words.next() {
        (_, b"1.0") => Ok(encoding),
        (place, other) => Err(place.expected("version 1.0", other)),
    }
}

impl Header {
    fn add_element(&mut self, words: &mut Words) -> Result<(), Fault> {
        let (place, word) = words.named("the name of an element")?;
        let (count_place, count) = words.next();
        let rows =
            parsed(count).ok_or_else(|| count_place.expected("the number of rows", count))?;
        words.end()?;
        let name = name(word);
        if self.element(&name).is_some() {
            return Err(place.error(format!("element {} is declared twice", quoted(word))));
        }
        if self.elements.len() == MAX_ELEMENTS {
            let message =
                format!("expected a header with at most {MAX_ELEMENTS} elements, found more");
            return Err(place.error(message));
        }
        self.elements.push(Element {
            name,
            rows,
            properties: Vec::new(),
            place,
        });
        Ok(())
    }

    fn add_property(&mut self, words: &mut Words, keyword: TextPosition) -> Result<(), Fault> {
        let n_properties: usize = self.elements.iter().map(|e| e.properties.len()).sum();
        let Some(element) = self.elements.last_mut() else {
            let message = "expected an element before its properties, found a property";
            return Err(keyword.error(message));
        };
        let first = words.next();
        let (count, value) = if first.1 == b"list" {
            let count = words.next();
            let count_type = scalar_type(count)?;
            if count_type.is_float() {
                return Err(count.0.expected("an integer type", count.1));
            }
            (Some(count_type), scalar_type(words.next())?)
        } else {
            (None, scalar_type(first)?)
        };
        let (place, word) = words.named("the name of a property")?;
        words.end()?;
        let name = name(word);
        if element.properties.iter().any(|p| p.name == name) {
            let element = element.name.escape_debug();
            let message = format!("property {} of `{element}` is declared twice", quoted(word));
            return Err(place.error(message));
        }
        if n_properties == MAX_PROPERTIES {
            let message =
                format!("expected a header with at most {MAX_PROPERTIES} properties, found more");
            return Err(place.error(message));
        }
        element.properties.push(Property {
            name,
            count,
            value,
            place,
        });
        Ok(())
    }
}

fn scalar_type((place, word): (TextPosition, &[u8])) -> Result<Type, Fault> {
    Type::parse(word).ok_or_else(|| place.expected("a type such as float, uchar or int32", word))
}

/// The words of a line.
struct Words<'a> {
    rest: &'a [u8],
    /// The position at which `rest` begins.
    place: TextPosition,
}

impl<'a> Words<'a> {
    /// Reads the next word. The word is empty at the end of the line.
    fn next(&mut self) -> (TextPosition, &'a [u8]) {
        let rest = self.rest.trim_ascii_start();
        self.place.column += self.rest.len() - rest.len();
        let place = self.place;
        let end = rest.iter().position(u8::is_ascii_whitespace);
        let (word, rest) = rest.split_at(end.unwrap_or(rest.len()));
        self.place.column += word.len();
        self.rest = rest;
        (place, word)
    }

    fn named(&mut self, what: &str) -> Result<(TextPosition, &'a [u8]), Fault> {
        let (place, word) = self.next();
        if word.is_empty() {
            return Err(place.expected(what, word));
        }
        Ok((place, word))
    }

    fn end(&mut self) -> Result<(), Fault> {
        match self.next() {
            (_, b"") => Ok(()),
            (place, word) => Err(place.expected("the end of the line", word)),
        }
    }
}
