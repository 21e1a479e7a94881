//! What is wrong with a file, and where.

use std::fmt;
use std::path::Path;

use crate::error::ReadError;

/// What is wrong at one place of a file, before the name of the file is known.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Fault {
    pub(crate) at: At,
    /// What was expected and what was there.
    pub(crate) message: String,
}

/// A place in a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum At {
    /// Of a text.
    Text(Place),
    /// Of a JSON document, as a JSON pointer.
    Json(String),
    /// In a binary file: the offset in bytes from its beginning.
    Byte(usize),
}

impl Fault {
    pub(crate) fn json(pointer: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            at: At::Json(pointer.into()),
            message: message.into(),
        }
    }

    pub(crate) fn byte(offset: usize, message: impl Into<String>) -> Self {
        Self {
            at: At::Byte(offset),
            message: message.into(),
        }
    }

    pub(crate) fn in_file(self, path: &Path) -> ReadError {
        let Self { at, message } = self;
        let path = path.to_path_buf();
        match at {
            At::Text(Place { line, column }) => ReadError::Text {
                path,
                line,
                column,
                message,
            },
            At::Json(pointer) => ReadError::Json {
                path,
                pointer,
                message,
            },
            At::Byte(offset) => ReadError::Binary {
                path,
                offset,
                message,
            },
        }
    }
}

/// A place in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    /// The line, from 1.
    pub(crate) line: usize,
    /// The byte in the line, from 1.
    pub(crate) column: usize,
}

impl Place {
    /// Where every text begins.
    pub(crate) const START: Self = Self::of_line(1);

    /// The beginning of a line.
    pub(crate) const fn of_line(line: usize) -> Self {
        Self { line, column: 1 }
    }

    pub(crate) fn error(self, message: impl Into<String>) -> Fault {
        Fault {
            at: At::Text(self),
            message: message.into(),
        }
    }

    /// The error that a word is not what is expected.
    pub(crate) fn expected(self, what: impl fmt::Display, found: &[u8]) -> Fault {
        self.error(format!("expected {what}, found {}", quoted(found)))
    }
}

/// A word of a file for a message: between backticks, cut if it is long.
pub(crate) fn quoted(word: &[u8]) -> String {
    const LONGEST: usize = 40;
    if word.is_empty() {
        return "nothing".to_owned();
    }
    let text = name(&word[..word.len().min(LONGEST)]);
    let dots = if word.len() > LONGEST { "..." } else { "" };
    format!("`{}{dots}`", text.escape_debug())
}

/// A name in a file: UTF-8 if it is that, and otherwise Latin-1, in which any bytes are text.
pub(crate) fn name(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}

#[cfg(test)]
impl Fault {
    /// The line and the column of an error in a text.
    pub(crate) fn place(&self) -> (usize, usize) {
        match self.at {
            At::Text(Place { line, column }) => (line, column),
            _ => panic!("{self:?} is in no text"),
        }
    }
}
