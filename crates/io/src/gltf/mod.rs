//! glTF 2.0, as JSON text (`.gltf`) and in one binary file (`.glb`).
//!
//! ```text
//! node --- node --- mesh --- primitive --- accessor --- buffer view --- buffer
//!  |  placement      |        |  attributes: POSITION, NORMAL, TEXCOORD_0, COLOR_0
//!  `- node           |        |  indices
//!                    |        `- material
//!                    `- primitive
//! ```
//!
//! Each node with a mesh is an object, with the placements of the nodes above it applied. glTF has a
//! vertex for each side of a seam: vertices of a mesh at exactly the same position become one vertex,
//! and each corner keeps its own texture coordinate, normal and color. The writer splits them again.
//!
//! Texture coordinates have v upwards in a mesh, as in OBJ, and downwards in glTF: v becomes 1 - v.
//!
//! What is repeated, such as a mesh that many nodes show, may take 64 times the size of the file, and 16 MiB in
//! any case.
//!
//! The JSON is deserialised piece by piece into the types of `gltf_json`, so that an error knows its
//! JSON pointer and what is not read cannot be in the way.

mod accessor;
mod budget;
mod buffers;
mod document;
mod faces;
mod fill;
mod materials;
mod names;
mod nodes;
mod peek;
mod pieces;
mod prepare;
mod primitives;
mod read;
mod split;
mod streams;
mod surface;
mod write;
mod write_document;
mod write_materials;

pub(crate) use peek::peek;
pub(crate) use read::read;
pub(crate) use write::write;

/// The shortest decimal number that is this one with 32 bits: 0.8 is written as 0.8.
fn decimal(x: f32) -> f64 {
    x.to_string().parse().unwrap_or(f64::from(x))
}

/// What is wrong at one place of the document, before the name of the file is known.
#[derive(Clone, Debug, PartialEq, Eq)]
struct JsonError {
    /// A JSON pointer.
    pointer: String,
    message: String,
}

impl JsonError {
    fn new(pointer: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            pointer: pointer.into(),
            message: message.into(),
        }
    }

    fn in_file(self, path: &std::path::Path) -> crate::ReadError {
        let Self { pointer, message } = self;
        crate::ReadError::Json {
            path: path.to_path_buf(),
            pointer,
            message,
        }
    }
}
