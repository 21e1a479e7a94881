//! Reads and writes STL: triangles for 3D printing, as text or binary.
//!
//! A file is one object. Its content is converted as follows:
//!
//! | in the file | in the mesh |
//! | --- | --- |
//! | facet | a triangle; triangles keep their order |
//! | corners of facets | vertices: corners at exactly the same position are merged (0 and -0 are equal) |
//! | facet normal | recomputed from the corners, so it is not counted as left out; a note counts nonzero normals that differ from the computed normals by more than a few degrees |
//! | `solid a`, if a text file has several solids | face tag `o:a` |
//! | header, `solid a` of the only solid | not kept |
//! | attribute bytes other than 0 (colors, in two dialects) | left out, with a note |
//!
//! If the size of a file matches the number of triangles that the file declares, the file is binary, even if its first
//! word is `solid`. Otherwise, a file that begins with `solid` is a text file, unless one of its first 512 bytes is
//! zero.
//!
//! The writer creates binary files with 32-bit coordinates. Polygons are triangulated. The header stores
//! [`provenance`](crate::WriteOptions::provenance). All attributes are lost.

mod binary;
mod facets;
mod read;
mod text;
mod write;

pub(crate) use read::{peek, read};
pub(crate) use write::write;
