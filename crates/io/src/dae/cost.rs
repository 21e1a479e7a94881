//! The approximate memory, in bytes, that the parts of a file need. These costs are subtracted from the memory budget
//! of the file.

/// The memory budget of a file, in bytes, is its size times this factor, but at least [`MIN_BUDGET`].
pub(super) const BUDGET_FACTOR: usize = 64;
/// The smallest memory budget of a file, in bytes.
pub(super) const MIN_BUDGET: usize = 1 << 24;
/// The approximate size in bytes of an object without faces. The next constants are the sizes of a material, a material
/// binding, a vertex, a corner, and an additional value of a corner.
pub(super) const OBJECT: usize = 1000;
pub(super) const MATERIAL: usize = 1000;
pub(super) const BOUND: usize = 50;
pub(super) const VERTEX: usize = 64;
pub(super) const CORNER: usize = 48;
pub(super) const VALUE: usize = 24;
/// The cost of reading a number. The cost is subtracted each time the number is read, so the memory budget also limits
/// the time for reading.
pub(super) const NUMBER: usize = 20;
