//! The approximate costs in bytes of the parts of a file, for its memory budget.

/// The memory budget is this multiple of the size of the file, ...
pub(super) const BUDGET_FACTOR: usize = 64;
/// ... but at least this many bytes.
pub(super) const MIN_BUDGET: usize = 1 << 24;
/// The approximate sizes of an object without faces, a material, the binding of a material, a vertex, a corner, and
/// an additional value of a corner.
pub(super) const OBJECT: usize = 1000;
pub(super) const MATERIAL: usize = 1000;
pub(super) const BOUND: usize = 50;
pub(super) const VERTEX: usize = 64;
pub(super) const CORNER: usize = 48;
pub(super) const VALUE: usize = 24;
/// The cost of each time that a number is read. It limits time rather than memory.
pub(super) const NUMBER: usize = 20;
