//! The header of a PLY file: which elements it has, how many and with which properties.

use std::collections::BTreeSet;
use std::fmt;

use super::types::Type;
use crate::fault::Fault;
use crate::text::{MARK, Place, name, parsed, quoted};

/// More properties than any program writes; it bounds the passes over the data.
pub(super) const MOST_PROPERTIES: usize = 4096;
/// More elements than any program writes; they are looked for by their names.
const MOST_ELEMENTS: usize = 1024;

/// How the values of a file are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// What stands before the values.
#[derive(Clone, Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// The comments without the word `comment`.
    pub(super) comments: Vec<String>,
    /// Where the values begin.
    pub(super) length: usize,
    /// How many lines the header has.
    pub(super) lines: usize,
}

/// A table of the file: so many rows of the same properties.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) rows: usize,
    pub(super) properties: Vec<Property>,
    /// Where it is declared.
    pub(super) place: Place,
}

/// A column of an element.
#[derive(Clone, Debug)]
pub(super) struct Property {
    pub(super) name: String,
    /// The type of the count, if it is a list.
    pub(super) count: Option<Type>,
    /// The type of the value, or of the items of a list.
    pub(super) value: Type,
    /// Where it is declared.
    pub(super) place: Place,
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
    /// The place of the scalar property of this name.
    pub(super) fn scalar(&self, name: &str) -> Option<usize> {
        let is_it = |p: &Property| p.count.is_none() && p.name == name;
        self.properties.iter().position(is_it)
    }

    /// The place of the list property of this name.
    pub(super) fn list(&self, name: &str) -> Option<usize> {
        let is_it = |p: &Property| p.count.is_some() && p.name == name;
        self.properties.iter().position(is_it)
    }
}

/// Reads the header.
///
/// # Errors
///
/// The first line that breaks the rules of the format.
pub(super) fn parse(bytes: &[u8]) -> Result<Header, Fault> {
    let mut lines = Lines::new(bytes);
    let (place, first) = lines.next().unwrap_or_default().next();
    if first != b"ply" {
        return Err(place.expected("`ply`", first));
    }
    let mut encoding = None;
    let mut header = Header {
        encoding: Encoding::Text,
        elements: Vec::new(),
        comments: Vec::new(),
        length: 0,
        lines: 0,
    };
    let mut names = Names::default();
    loop {
        let Some(mut words) = lines.next() else {
            let message = "expected `end_header`, found the end of the file";
            return Err(lines.place().error(message));
        };
        let (place, keyword) = words.next();
        match keyword {
            b"comment" => header.comments.push(name(words.rest())),
            b"format" if encoding.is_some() => {
                return Err(place.error("expected one line `format`, found a second"));
            }
            b"format" => encoding = Some(format(&mut words)?),
            b"element" => names.element(&mut header, &mut words)?,
            b"property" => names.property(&mut header, &mut words, place)?,
            b"end_header" => break,
            b"" | b"obj_info" => {}
            other => return Err(place.expected("a line of a PLY header", other)),
        }
    }
    let Some(encoding) = encoding else {
        let message = "expected a line `format` before the end of the header, found none";
        return Err(lines.place().error(message));
    };
    header.encoding = encoding;
    header.length = lines.next;
    header.lines = lines.number;
    Ok(header)
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

/// The names that are taken.
#[derive(Default)]
struct Names {
    elements: BTreeSet<String>,
    properties: BTreeSet<String>,
    n_properties: usize,
}

impl Names {
    fn element(&mut self, header: &mut Header, words: &mut Words) -> Result<(), Fault> {
        let (place, word) = words.named("the name of an element")?;
        let (count_place, count) = words.next();
        let rows =
            parsed(count).ok_or_else(|| count_place.expected("how many there are", count))?;
        words.end()?;
        if !self.elements.insert(name(word)) {
            return Err(place.error(format!("element {} is there already", quoted(word))));
        }
        if self.elements.len() > MOST_ELEMENTS {
            let message = format!("expected at most {MOST_ELEMENTS} elements, found more");
            return Err(place.error(message));
        }
        self.properties.clear();
        header.elements.push(Element {
            name: name(word),
            rows,
            properties: Vec::new(),
            place,
        });
        Ok(())
    }

    fn property(
        &mut self,
        header: &mut Header,
        words: &mut Words,
        keyword: Place,
    ) -> Result<(), Fault> {
        let Some(element) = header.elements.last_mut() else {
            let message = "expected an element before its properties, found a property";
            return Err(keyword.error(message));
        };
        let first = words.next();
        let (count, value) = if first.1 == b"list" {
            let count = words.next();
            let count_type = scalar_type(count)?;
            if count_type.is_float() {
                return Err(count.0.expected("a whole-number type", count.1));
            }
            (Some(count_type), scalar_type(words.next())?)
        } else {
            (None, scalar_type(first)?)
        };
        let (place, word) = words.named("the name of a property")?;
        words.end()?;
        if !self.properties.insert(name(word)) {
            let element = element.name.escape_debug();
            let message = format!("property {} of `{element}` is there already", quoted(word));
            return Err(place.error(message));
        }
        self.n_properties += 1;
        if self.n_properties > MOST_PROPERTIES {
            let message = format!("expected at most {MOST_PROPERTIES} properties, found more");
            return Err(place.error(message));
        }
        element.properties.push(Property {
            name: name(word),
            count,
            value,
            place,
        });
        Ok(())
    }
}

fn scalar_type((place, word): (Place, &[u8])) -> Result<Type, Fault> {
    Type::parse(word).ok_or_else(|| place.expected("a type such as float, uchar or int32", word))
}

/// The lines of a header. The end of the first line shows how the others end: bytes of the data behind the
/// header may look like ends of lines.
struct Lines<'a> {
    bytes: &'a [u8],
    /// Where the next line begins.
    next: usize,
    /// The number of the line in hand, from 1.
    number: usize,
    /// What a line ends in.
    end: u8,
}

impl<'a> Lines<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        let end = bytes.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
        let is_return = |end: usize| bytes[end] == b'\r' && bytes.get(end + 1) != Some(&b'\n');
        Self {
            bytes,
            next: if bytes.starts_with(MARK) {
                MARK.len()
            } else {
                0
            },
            number: 0,
            end: if end.is_some_and(is_return) {
                b'\r'
            } else {
                b'\n'
            },
        }
    }

    /// The words of the next line; `None` at the end of the file.
    fn next(&mut self) -> Option<Words<'a>> {
        self.number += 1;
        let rest = &self.bytes[self.next..];
        if rest.is_empty() {
            return None;
        }
        let line = rest
            .split(|&byte| byte == self.end)
            .next()
            .unwrap_or_default();
        self.next = self.bytes.len().min(self.next + line.len() + 1);
        Some(Words {
            line,
            number: self.number,
            at: 0,
        })
    }

    fn place(&self) -> Place {
        Place {
            line: self.number,
            column: 1,
        }
    }
}

#[derive(Default)]
struct Words<'a> {
    line: &'a [u8],
    number: usize,
    at: usize,
}

impl<'a> Words<'a> {
    /// The next word, empty at the end of the line.
    fn next(&mut self) -> (Place, &'a [u8]) {
        let rest = self.line[self.at..].trim_ascii_start();
        let word = rest
            .split(u8::is_ascii_whitespace)
            .next()
            .unwrap_or_default();
        let start = self.line.len() - rest.len();
        self.at = start + word.len();
        let place = Place {
            line: self.number.max(1),
            column: start + 1,
        };
        (place, word)
    }

    fn rest(&self) -> &'a [u8] {
        self.line[self.at..].trim_ascii()
    }

    fn named(&mut self, what: &str) -> Result<(Place, &'a [u8]), Fault> {
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
