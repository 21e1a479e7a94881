//! What parts of a file take in memory, about, in bytes.

/// A file may become this many times its size in memory, ...
pub(super) const TIMES: usize = 64;
/// ... and this many bytes in any case.
pub(super) const FREE: usize = 1 << 24;
/// How many bytes an object without faces takes, a material of it and what binds it, a vertex, a corner and a
/// further value of a corner, about.
pub(super) const OBJECT: usize = 1000;
pub(super) const MATERIAL: usize = 1000;
pub(super) const BOUND: usize = 50;
pub(super) const VERTEX: usize = 64;
pub(super) const CORNER: usize = 48;
pub(super) const VALUE: usize = 24;
/// What reading a number costs each time that it is read: time rather than memory.
pub(super) const NUMBER: usize = 20;
