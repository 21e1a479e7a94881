//! Positions as keys of hash maps.

use glam::DVec3;

/// Returns the bits of a position, as a hash key.
pub(crate) fn bits(p: DVec3) -> [u64; 3] {
    // Adding zero turns -0 into 0, so that -0 and 0 have the same key.
    (p + DVec3::ZERO).to_array().map(f64::to_bits)
}
