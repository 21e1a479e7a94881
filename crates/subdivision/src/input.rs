//! Preparation and checks of the input mesh.

use std::borrow::Cow;

use mesh::{FaceId, Mesh, VertexId};

use crate::error::SubdivisionError;
use crate::parallel::any;
use crate::rules::Scheme;

/// The largest absolute value of a coordinate that subdivision accepts. Each new position is a weighted sum of fewer
/// than 2^32 old positions, in which a position can occur several times. With this limit for coordinates, the sum stays
/// finite.
pub const MAX_COORDINATE: f64 = 1e290;

/// Returns the mesh without dead (deleted) elements. A mesh that has no dead elements (a dense mesh) is borrowed, not
/// copied.
pub(crate) fn dense(mesh: &Mesh) -> Cow<'_, Mesh> {
    if mesh.is_dense() {
        return Cow::Borrowed(mesh);
    }
    let mut dense = mesh.clone();
    dense.compact();
    Cow::Owned(dense)
}

/// Checks that a scheme can subdivide all faces and positions of a dense mesh, which has no deleted elements.
///
/// # Errors
///
/// Returns [`SubdivisionError::TooFar`] with the first vertex beyond [`MAX_COORDINATE`].
/// Returns [`SubdivisionError::NotTriangle`] with the first face that is not a triangle, if the scheme needs
/// triangles.
pub fn check_faces(mesh: &Mesh, scheme: Scheme) -> Result<(), SubdivisionError> {
    let is_far = |i: usize| mesh.positions()[i].abs().max_element() > MAX_COORDINATE;
    let n = mesh.positions().len();
    if any(n, is_far)
        && let Some(i) = (0..n).find(|&i| is_far(i))
    {
        let vertex = VertexId::new(i);
        return Err(SubdivisionError::TooFar { scheme, vertex });
    }
    let is_polygon = |i: usize| !mesh.is_triangle(FaceId::new(i));
    if !scheme.needs_triangles() || !any(mesh.n_faces(), is_polygon) {
        return Ok(());
    }
    let first = (0..mesh.n_faces()).find(|&i| is_polygon(i));
    let face = FaceId::new(first.expect("a polygon was found above"));
    Err(SubdivisionError::NotTriangle {
        scheme,
        face,
        degree: mesh.degree(face),
    })
}
