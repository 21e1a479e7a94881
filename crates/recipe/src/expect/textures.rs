//! Measures of texture coordinates.

use geometry::uv;
use mesh::{DVec2, Domain, Mesh, Value};

use super::subject::{Subject, Violation};

/// Returns the meshes that have the texture coordinates `name`.
fn textured<'s>(
    subject: Subject<'s>,
    name: &str,
) -> Result<Vec<(&'s Mesh, &'s [DVec2])>, Violation> {
    let meshes = subject.meshes()?.into_iter();
    let textured = meshes.filter_map(|(_, mesh)| {
        let column = mesh.attributes().column(Domain::Corner, name)?;
        Some((mesh, DVec2::of(&column.values)?))
    });
    let textured: Vec<_> = textured.collect();
    if textured.is_empty() {
        let message = format!("expected texture coordinates \"{name}\", but no mesh has them");
        return Err(message.into());
    }
    Ok(textured)
}

/// Returns the largest stretch of the meshes; see [`uv::Stretch::aspect`].
pub(super) fn stretch(subject: Subject, name: &str) -> Result<f64, Violation> {
    let meshes = textured(subject, name)?.into_iter();
    let aspects = meshes.filter_map(|(mesh, uvs)| Some(uv::stretch(mesh, uvs)?.aspect));
    Ok(aspects.fold(1.0, f64::max))
}

/// Returns the number of faces that overlap another face of the same mesh.
pub(super) fn n_overlapping(subject: Subject, name: &str) -> Result<u64, Violation> {
    let mut n = 0;
    for (mesh, uvs) in textured(subject, name)? {
        let faces = uv::overlapping_faces(mesh, uvs, subject.progress);
        n += faces.map_err(|cancelled| cancelled.to_string())?.len() as u64;
    }
    Ok(n)
}
