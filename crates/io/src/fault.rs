//! Errors in the content of a file, with their positions in the file.

use std::fmt;
use std::path::Path;

use crate::error::ReadError;

/// An error at one position of a file. The error does not contain the name of the file. The name is added later.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Fault {
    pub(crate) at: Location,
    /// What was expected and what was found.
    pub(crate) message: String,
}

/// A position in a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Location {
    /// A position in a text file, as line and column.
    Text(TextPosition),
    /// A position in a JSON document, as a JSON pointer.
    Json(String),
    /// A position in a binary file, as the number of bytes before it.
    Byte(usize),
}

impl Fault {
    pub(crate) fn json(pointer: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            at: Location::Json(pointer.into()),
            message: message.into(),
        }
    }

    pub(crate) fn byte(offset: usize, message: impl Into<String>) -> Self {
        Self {
            at: Location::Byte(offset),
            message: message.into(),
        }
    }

    pub(crate) fn in_file(self, path: &Path) -> ReadError {
        let Self { at, message } = self;
        let path = path.to_path_buf();
        match at {
            Location::Text(TextPosition { line, column }) => ReadError::Text {
                path,
                line,
                column,
                message,
            },
            Location::Json(pointer) => ReadError::Json {
                path,
                pointer,
                message,
            },
            Location::Byte(offset) => ReadError::Binary {
                path,
                offset,
                message,
            },
        }
    }
}

/// A position in a text file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TextPosition {
    /// The line, from 1.
    pub(crate) line: usize,
    /// The position within the line, in bytes, counted from 1.
    pub(crate) column: usize,
}

impl TextPosition {
    /// The position of the beginning of any text file.
    pub(crate) const START: Self = Self::of_line(1);

    /// The beginning of a line.
    pub(crate) const fn of_line(line: usize) -> Self {
        Self { line, column: 1 }
    }

    pub(crate) fn error(self, message: impl Into<String>) -> Fault {
        Fault {
            at: Location::Text(self),
            message: message.into(),
        }
    }

    /// Creates the error for an unexpected word at this position.
    pub(crate) fn expected(self, what: impl fmt::Display, found: &[u8]) -> Fault {
        self.error(format!("expected {what}, found {}", quoted(found)))
    }
}

/// Quotes a word of a file for a message, in backticks. A long word is shortened.
pub(crate) fn quoted(word: &[u8]) -> String {
    const LONGEST: usize = 40;
    if word.is_empty() {
        return "nothing".to_owned();
    }
    let text = name(&word[..word.len().min(LONGEST)]);
    let dots = if word.len() > LONGEST { "..." } else { "" };
    format!("`{}{dots}`", text.escape_debug())
}

/// Decodes a name in a file as UTF-8. If it is not valid UTF-8, decodes it as Latin-1, which accepts any bytes.
pub(crate) fn name(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}

#[cfg(test)]
impl Fault {
    /// Returns the line and the column of an error in a text file.
    pub(crate) fn place(&self) -> (usize, usize) {
        match self.at {
            Location::Text(TextPosition { line, column }) => (line, column),
            _ => panic!("{self:?} is not in a text file"),
        }
    }
}
