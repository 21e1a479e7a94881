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
//! The JSON is deserialised piece by piece into the types of `gltf_json`, so that an error knows its
//! JSON pointer and what is not read cannot be in the way.

mod accessor;
mod buffers;
mod document;
mod nodes;
mod peek;
mod primitives;
mod read;
mod split;
mod write;

pub(crate) use peek::peek;
pub(crate) use read::read;
pub(crate) use write::write;

use glam::DVec4;
use mesh::{Attribute, HalfEdgeId, Rule};

/// Colors of corners: colors that differ between the faces around a vertex.
const CORNER_COLOR: Attribute<HalfEdgeId, DVec4> = Attribute::new("color", Rule::Interpolate);

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
