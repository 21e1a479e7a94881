//! Reads and writes OFF, the text format of Geomview for polygons.
//!
//! A file is one object. Its content is converted as follows:
//!
//! | in the file | in the mesh |
//! | --- | --- |
//! | `x y z` | position; vertices keep their order |
//! | `NOFF`: `nx ny nz` | vertex attribute `normal` |
//! | `COFF`: `r g b` or `r g b a` | vertex attribute `color` |
//! | `STOFF`: `s t` | corner attribute `uv` |
//! | `n v0 v1 ..` | a polygon with any number of corners; polygons keep their order |
//! | `n v0 v1 .. r g b` or `.. r g b a` | face attribute `color`; if only some faces have a color, the others get gray (2/3) |
//! | `n v0 v1 .. i` | face attribute `color_index`; if only some faces have an index, the others get -1; color maps are not supported |
//! | comments, the number of edges | not kept |
//!
//! The letters before `OFF` can be combined, as in `STCNOFF`. The line of a vertex then has its position, normal, color
//! and texture coordinates, in this order. The keyword in the first line can be missing. If all color components of the
//! vertices are integers, and at least one of them is greater than 1, all components are divided by 255. Otherwise,
//! they are used unchanged. The same rule applies separately to the colors of the faces. Binary files are refused.
//! Files whose vertices do not have three coordinates (`4OFF`, `nOFF`) are also refused.
//!
//! The writer uses the table above from right to left: it writes the content in the second column as shown in the first
//! column. Texture coordinates are written only if they are equal at all corners of each vertex.

mod read;
mod write;

pub(crate) use read::{COLOR_INDEX, peek, read};
pub(crate) use write::write;
