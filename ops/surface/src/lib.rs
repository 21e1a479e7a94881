//! Operations that simplify, remesh and smooth surfaces.

use op::Registry;

/// Adds the operations of this group, in the order of the reference.
pub fn register(registry: Registry) -> Registry {
    registry
}
