//! The list of built-in operations, one line per group.

use op::Registry;

/// Returns a registry of all built-in operations. The list in `ops/README.md` has the same order.
#[rustfmt::skip]
pub fn registry() -> Registry {
    Registry::new()
        .with_group(ops_files::register)
        .with_group(ops_shapes::register)
        .with_group(ops_curves::register)
        .with_group(ops_objects::register)
        .with_group(ops_cleaning::register)
        .with_group(ops_edges::register)
        .with_group(ops_faces::register)
        .with_group(ops_vertices::register)
        .with_group(ops_holes::register)
        .with_group(ops_tags::register)
        .with_group(ops_subdivide::register)
        .with_group(ops_solids::register)
        .with_group(ops_surface::register)
        .with_group(ops_deform::register)
        .with_group(ops_measure::register)
        .with_group(ops_uv::register)
        .with_group(ops_pictures::register)
}
