//! Reads and writes Stanford PLY: polygons with any properties, as text or as binary numbers in either byte order.
//!
//! A file is one object. Its elements and properties are converted as follows:
//!
//! | in the file | in the mesh |
//! | --- | --- |
//! | `vertex`: `x y z` | position; vertices keep their order |
//! | `vertex`: `nx ny nz` | vertex attribute `normal` |
//! | `vertex`: `red green blue alpha`, `diffuse_red ..` or `r g b a` | vertex attribute `color`; integers are divided by 255 (`ushort`: by 65535) |
//! | `vertex`: `s t`, `u v`, `texture_u texture_v` or `texture_s texture_t` | corner attribute `uv` |
//! | `face`: `vertex_indices` or `vertex_index` | a polygon with any number of corners; polygons keep their order |
//! | `face`: `texcoord` (u and v for each corner, as in files of `MeshLab`) | corner attribute `uv` |
//! | `face`: `red green blue alpha`, `nx ny nz` | face attributes `color` and `normal` |
//! | `tristrips`: `vertex_indices` with -1 between strips | triangles, if there are no faces |
//! | other scalars of `vertex` or `face` | an attribute with the same name: of signed 32-bit integers if the scalar has an integer type and all its values fit, otherwise of floating-point numbers |
//! | `comment meshwright ..` | describes the attribute that some properties store; see `attribute_comments` |
//! | other lists, other elements (`edge`, `range_grid` and so on) | left out, with a note |
//! | `comment TextureFile ..` | left out, with a note |
//! | other comments, `obj_info` | not kept |
//!
//! When an edit creates elements, the values of custom floating-point properties of `vertex` are interpolated, and the
//! values of all other custom properties are copied. Non-finite positions are an error. Other non-finite values become
//! 0, with a note.
//!
//! The writer uses the table above from right to left: it writes the content in the second column as shown in the first
//! column. It writes little-endian binary files. Reading such a file restores all finite values exactly. Positions and
//! custom floating-point attributes are written with 64 bits. Normals and texture coordinates are written with 32 bits
//! if this loses nothing, otherwise with 64 bits. Colors are written as bytes if every component is a multiple of
//! 1/255. If texture coordinates are equal at all corners of each vertex, they are written as the properties `s` and
//! `t` of `vertex`. Corner attributes are written as list properties of `face`. Materials and edge attributes cannot be
//! stored.

mod attribute_comments;
mod body;
mod columns;
mod header;
mod peek;
mod read;
mod roles;
mod strips;
mod table;
mod types;
mod write;

pub(crate) use peek::peek;
pub(crate) use read::read;
pub(crate) use write::write;
