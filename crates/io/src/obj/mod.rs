//! Wavefront OBJ: polygons, polylines, groups and materials as text.
//!
//! A file is one object. What its statements become:
//!
//! | statement | in the mesh |
//! | --- | --- |
//! | `v x y z` | position, and the order of the vertices is kept |
//! | `v x y z r g b` | vertex attribute `color` |
//! | `#MRGB` comments of `ZBrush` | vertex attribute `color`, if there is one for each vertex |
//! | `vt`, `f v/vt` | corner attribute `uv` |
//! | `vn`, `f v//vn` | `normal` of vertices if the corners of each agree, and otherwise of corners |
//! | `f` | a polygon of any degree, in order |
//! | `g a b` | face tags `a` and `b` |
//! | `o a` | face tag `o:a` |
//! | `s 1` | face attribute `smoothing` |
//! | `usemtl a`, `mtllib` | face attribute `material` and the object's materials |
//!
//! The writer takes the same table from right to left, so that what was read is written and what was
//! written is read.
//!
//! Where what is done:
//!
//! | | |
//! | --- | --- |
//! | `read` | from a file to polygons, with their attributes |
//! | `parse` | cuts the text into parts, which all threads read |
//! | `statement` | reads a statement: `face` for `f`, `vertex` for `v`, `group` for `g` ... |
//! | `usual` | reads the usual `v`, `vt`, `vn`, `f` faster |
//! | `corner` | reads a corner such as `1/2/3` |
//! | `part`, `join`, `file` | what a part holds, and all parts as one |
//! | `material`, `picture` | reads material libraries |
//! | `peek` | counts |
//! | `write`, `body`, `states`, `library` | writes: the file, a mesh, groups and materials of faces, the library |

mod body;
mod corner;
mod file;
mod join;
mod library;
mod material;
mod parse;
mod parser;
mod part;
mod peek;
mod picture;
mod read;
mod statement;
mod states;
mod usual;
mod write;

pub(crate) use peek::peek;
pub(crate) use read::read;
pub(crate) use write::write;
