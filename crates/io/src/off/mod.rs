//! OFF: polygons as text, as Geomview defines it.
//!
//! A file is one object. What it becomes:
//!
//! | in the file | in the mesh |
//! | --- | --- |
//! | `x y z` | position, and the order of the vertices is kept |
//! | `NOFF`: `nx ny nz` | vertex attribute `normal` |
//! | `COFF`: `r g b` or `r g b a` | vertex attribute `color` |
//! | `STOFF`: `s t` | corner attribute `uv` |
//! | `n v0 v1 ..` | a polygon of any degree, in order |
//! | `n v0 v1 .. r g b` or `.. r g b a` | face attribute `color`, gray (2/3) where others have one |
//! | `n v0 v1 .. i` | face attribute `color_index`, -1 where others have one: there is no map of colors |
//! | comments, the count of edges | not kept |
//!
//! The letters may be combined, as in `STCNOFF`; then a line has position, normal, color and texture
//! coordinates, in this order. The word may be missing. Colors that are all whole numbers, one of them greater than 1,
//! are 255ths; any others are parts of 1. Files with four or any number of coordinates (`4OFF`,
//! `nOFF`) and binary ones are refused.
//!
//! The writer takes the same table from right to left. Texture coordinates are written if they agree around
//! each vertex.

mod read;
mod write;

pub(crate) use read::{peek, read};
pub(crate) use write::write;
