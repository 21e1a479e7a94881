//! Errors that occur when a file is read or written.

use std::io;
use std::path::{Path, PathBuf};

use scene::Object;
use store::StoreError;

use crate::Format;

/// The reason why a file could not be read. After this error, no content of the file is available.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The requested file, or a file that it refers to, could not be opened or read.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The file name does not have the extension of a format that can be read.
    #[error("{}: expected a file name that ends in one of {known}", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
        /// The extensions of the formats that can be read.
        known: String,
    },
    /// A text file breaks the rules of its format.
    #[error("{}:{line}:{column}: {message}", path.display())]
    Text {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// The position within the line, in bytes, counted from 1.
        column: usize,
        /// What was expected and what was found.
        message: String,
    },
    /// A glTF file breaks the rules of its format.
    #[error("{}: {pointer}: {message}", path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// The location in the JSON document, as a JSON pointer (RFC 6901), such as `/accessors/3/count`.
        pointer: String,
        /// What was expected and what was found.
        message: String,
    },
    /// The polygons of the file do not form a valid mesh.
    #[error("{}: {source}", path.display())]
    Mesh {
        /// The file.
        path: PathBuf,
        /// The reason why the polygons do not form a valid mesh.
        source: mesh::BuildError,
    },
    /// Content would be left out, which [`ReadOptions::strict`](crate::ReadOptions::strict) forbids.
    #[error("{}: strict reading does not allow anything to be left out: {left_out}", path.display())]
    Strict {
        /// The file.
        path: PathBuf,
        /// What would be left out.
        left_out: String,
    },
    /// The content of a `.gz` file is damaged or exceeds the memory budget.
    #[error("{}: {message}", path.display())]
    Compressed {
        /// The file.
        path: PathBuf,
        /// What is wrong with the content.
        message: String,
    },
    /// A binary file breaks the rules of its format.
    #[error("{}: byte {offset}: {message}", path.display())]
    Binary {
        /// The file.
        path: PathBuf,
        /// The position in the file in bytes, from 0.
        offset: usize,
        /// What was expected and what was found.
        message: String,
    },
}

impl From<StoreError> for ReadError {
    fn from(error: StoreError) -> Self {
        Self::Io {
            path: error.path,
            source: error.error,
        }
    }
}

impl ReadError {
    /// The file that could not be read: the requested file or a file that it refers to.
    pub fn path(&self) -> &Path {
        match self {
            Self::Io { path, .. }
            | Self::UnknownFormat { path, .. }
            | Self::Mesh { path, .. }
            | Self::Strict { path, .. }
            | Self::Text { path, .. }
            | Self::Json { path, .. }
            | Self::Compressed { path, .. }
            | Self::Binary { path, .. } => path,
        }
    }
}

/// The reason why a scene could not be written. No file was changed, with one exception: if the system fails to rename
/// one of several files, the files before it have already been replaced.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The file could not be created or written.
    #[error("cannot write {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The file name does not have the extension of a format that can be written.
    #[error("{}: expected a file name that ends in one of {known}", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
        /// The extensions of the formats that can be written.
        known: String,
    },
    /// Content would be lost, which [`WriteOptions::strict`](crate::WriteOptions::strict) forbids.
    #[error("{}: strict writing does not allow any loss: {losses}", path.display())]
    Strict {
        /// The file.
        path: PathBuf,
        /// What would be lost.
        losses: String,
    },
    /// The format cannot store an object of the scene.
    #[error("{}: object `{object}`: {message}", path.display())]
    Object {
        /// The file.
        path: PathBuf,
        /// The name of the object.
        object: String,
        /// What the format can store and what was found.
        message: String,
    },
    /// The format cannot store the scene, for a reason that does not concern a single object.
    #[error("{}: {message}", path.display())]
    Scene {
        /// The file.
        path: PathBuf,
        /// What the format can store and what was found.
        message: String,
    },
}

impl From<StoreError> for WriteError {
    fn from(error: StoreError) -> Self {
        Self::Io {
            path: error.path,
            source: error.error,
        }
    }
}

/// The reason why a format cannot store a scene. The value does not contain the name of the file, which is added later.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Unwritable {
    /// The object that the format cannot store. `None` if the reason does not concern a single object.
    object: Option<String>,
    message: String,
}

impl Unwritable {
    pub(crate) fn scene(message: String) -> Self {
        let object = None;
        Self { object, message }
    }

    pub(crate) fn object(object: &str, message: String) -> Self {
        let object = Some(object.to_owned());
        Self { object, message }
    }

    /// Creates the error for an object of a kind that the format cannot store.
    pub(crate) fn kind(format: Format, object: &Object) -> Self {
        let message = format.refused_kind(object.geometry.kind());
        Self::object(&object.name, message.unwrap_or_default())
    }

    pub(crate) fn in_file(self, path: &Path) -> WriteError {
        let (path, message) = (path.to_path_buf(), self.message);
        match self.object {
            Some(object) => WriteError::Object {
                path,
                object,
                message,
            },
            None => WriteError::Scene { path, message },
        }
    }
}
