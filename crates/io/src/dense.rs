//! Meshes without dead elements, as writers need them.

use std::borrow::Cow;

use mesh::Mesh;

/// The mesh, or a compact copy if it has dead elements.
pub(crate) fn dense(mesh: &Mesh) -> Cow<'_, Mesh> {
    if mesh.is_dense() {
        return Cow::Borrowed(mesh);
    }
    let mut copy = mesh.clone();
    copy.compact();
    Cow::Owned(copy)
}
