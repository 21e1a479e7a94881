//! What a mesh must be before it is subdivided.

use std::borrow::Cow;

use mesh::{FaceId, Mesh};

use crate::error::SubdivisionError;
use crate::parallel::any;
use crate::rules::Scheme;

/// The mesh without dead elements.
pub(crate) fn dense(mesh: &Mesh) -> Cow<'_, Mesh> {
    if mesh.is_dense() {
        return Cow::Borrowed(mesh);
    }
    let mut dense = mesh.clone();
    dense.compact();
    Cow::Owned(dense)
}

/// Checks that a scheme takes all faces of a dense mesh.
///
/// # Errors
///
/// [`SubdivisionError::NotTriangle`] with the first face that it does not take.
pub fn check_faces(mesh: &Mesh, scheme: Scheme) -> Result<(), SubdivisionError> {
    let is_polygon = |i: usize| !mesh.is_triangle(FaceId::new(i));
    if !scheme.needs_triangles() || !any(mesh.n_faces(), is_polygon) {
        return Ok(());
    }
    let first = (0..mesh.n_faces()).find(|&i| is_polygon(i));
    let face = FaceId::new(first.expect("there is one"));
    Err(SubdivisionError::NotTriangle {
        scheme,
        face,
        degree: mesh.degree(face),
    })
}
