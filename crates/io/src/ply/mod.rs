//! Stanford PLY: polygons with any properties, as text or as numbers of either byte order.
//!
//! A file is one object. What its elements and properties become:
//!
//! | in the file | in the mesh |
//! | --- | --- |
//! | `vertex`: `x y z` | position, and the order of the vertices is kept |
//! | `vertex`: `nx ny nz` | vertex attribute `normal` |
//! | `vertex`: `red green blue alpha`, `diffuse_red ..` or `r g b a` | vertex attribute `color`; whole numbers are 255ths (`ushort`: 65535ths) |
//! | `vertex`: `s t`, `u v`, `texture_u texture_v` or `texture_s texture_t` | corner attribute `uv` |
//! | `face`: `vertex_indices` or `vertex_index` | a polygon of any degree, in order |
//! | `face`: `texcoord` (u and v for each corner, as `MeshLab` writes them) | corner attribute `uv` |
//! | `face`: `red green blue alpha`, `nx ny nz` | face attributes `color` and `normal` |
//! | `tristrips`: `vertex_indices` with -1 between strips | triangles, if there are no faces |
//! | any other single value of `vertex` or `face` | an attribute of that name: whole numbers if they fit 32 bits |
//! | `comment meshwright ..` | says what kind of attribute some properties were, see `marks` |
//! | other lists, other elements (`edge`, `range_grid`, ..) | left out, with a note |
//! | other comments, `obj_info` | not kept |
//!
//! Floating-point properties of vertices are interpolated by edits, all others are copied. Values that are
//! not finite become 0 with a note, but positions that are not finite are refused.
//!
//! The writer takes the same table from right to left, with the lowest byte first. Positions and free
//! attributes are written with 64 bits; normals and texture coordinates with 32 if that is exact; colors as bytes if
//! each is a 255th, so that what was written is read as it was. Texture coordinates that agree around each
//! vertex are written as `s t`. Attributes of corners are lists of `face`. What it cannot hold: materials
//! and attributes of edges.

mod body;
mod columns;
mod header;
mod marks;
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
