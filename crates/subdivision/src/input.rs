//! What a mesh must be before it is subdivided.

use std::borrow::Cow;

use mesh::{FaceId, Mesh};
use rayon::prelude::*;

use crate::error::SubdivisionError;
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
    if !scheme.needs_triangles() {
        return Ok(());
    }
    let is_polygon = |i: usize| !mesh.is_triangle(FaceId::new(i));
    let faces = (0..mesh.n_faces()).into_par_iter();
    match faces.position_first(is_polygon).map(FaceId::new) {
        None => Ok(()),
        Some(face) => Err(SubdivisionError::NotTriangle {
            scheme,
            face,
            degree: mesh.degree(face),
        }),
    }
}
