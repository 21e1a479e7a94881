//! STL: triangles for 3D printing, as text or binary.
//!
//! A file is one object. What it becomes:
//!
//! | in the file | in the mesh |
//! | --- | --- |
//! | facet | a triangle, in order |
//! | corners of facets | vertices: corners at exactly the same position are one; 0 and -0 are the same |
//! | facet normal | not kept: it follows from the corners. Noted where it is more than a few degrees off, unless zero |
//! | `solid a`, where a text has several | face tag `o:a` |
//! | header, `solid a` where there is one | not kept |
//! | attribute bytes other than 0 (colors, in two dialects) | left out, with a note |
//!
//! A file is binary if it is exactly as long as its count of triangles says, whatever its first word is; and
//! otherwise text if it begins with `solid`.
//!
//! The writer makes binary files: 32 bits for a coordinate. Polygons are cut into triangles. The header holds
//! [`provenance`](crate::WriteOptions::provenance). All attributes are lost.

mod binary;
mod facets;
mod read;
mod text;
mod write;

pub(crate) use read::{peek, read};
pub(crate) use write::write;
