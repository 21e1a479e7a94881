//! Reads and writes Wavefront OBJ, a text format for polygons, polylines, groups and materials.
//!
//! A file is one object. Its statements are converted as follows:
//!
//! | statement | in the mesh |
//! | --- | --- |
//! | `v x y z` | position of a vertex; vertices keep their order |
//! | `v x y z r g b` or `v x y z r g b a` | vertex attribute `color` |
//! | `#MRGB` comments of `ZBrush` | vertex attribute `color`, if there is one for each vertex |
//! | `vt`, `f v/vt` | corner attribute `uv` |
//! | `vn`, `f v//vn` | vertex attribute `normal` if the corners of each vertex agree, otherwise corner attribute |
//! | `f` | a polygon with any number of corners; polygons keep their order |
//! | `g a b` | face tags `a` and `b` |
//! | `o a` | face tag `o:a` |
//! | `s 1` | face attribute `smoothing` |
//! | `usemtl a`, `mtllib` | face attribute `material`, and materials of the object |
//! | `l` | a polyline, if the file has no faces; otherwise left out, with a note |
//! | other statements | left out, with a note |
//!
//! The writer uses the table above from right to left: it writes the content in the second column as the statements in
//! the first column. Therefore, the content in the table is preserved if a mesh is written and read again, or if a file
//! is read and written again.
//!
//! Modules:
//!
//! | module | purpose |
//! | --- | --- |
//! | `read` | reads a file into polygons with attributes |
//! | `parse` | cuts the text into parts, which are parsed on all threads |
//! | `statement` | parses a statement: `face` for `f`, `vertex` for `v`, `group` for `g` and so on |
//! | `fast_path` | parses common forms of `v`, `vt`, `vn` and `f` faster |
//! | `corner` | parses a corner such as `1/2/3` |
//! | `part`, `join`, `file` | store the content of a part, join the parts, store the content of the file |
//! | `material`, `picture` | read material libraries |
//! | `peek` | counts the elements of a file |
//! | `write`, `body`, `states`, `library` | write the file, a mesh, the groups and materials of faces, and the material library |

mod body;
mod corner;
mod fast_path;
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
mod write;

pub(crate) use peek::peek;
pub(crate) use read::read;
pub(crate) use write::write;
