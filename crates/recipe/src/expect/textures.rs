//! Measures of texture coordinates.

use std::collections::BTreeMap;

use geometry::uv;
use mesh::{DVec2, Domain, FaceId, Mesh, Value};
use op::Progress;

use super::subject::Subject;
use super::violation::Violation;

/// Returns the meshes that have the texture coordinates `name`.
fn textured<'s>(
    subject: Subject<'s>,
    name: &str,
) -> Result<Vec<(&'s Mesh, &'s [DVec2])>, Violation> {
    let meshes = subject.meshes()?.into_iter();
    let textured = meshes.filter_map(|(_, mesh)| Some((mesh, coordinates(mesh, name)?)));
    let textured: Vec<_> = textured.collect();
    if textured.is_empty() {
        let message = format!("expected texture coordinates \"{name}\", but no mesh has them");
        return Err(message.into());
    }
    Ok(textured)
}

/// Returns the texture coordinates with the name `name`: one pair (u, v) for each corner.
fn coordinates<'m>(mesh: &'m Mesh, name: &str) -> Option<&'m [DVec2]> {
    let column = mesh.attributes().column(Domain::Corner, name)?;
    DVec2::of(&column.values)
}

/// Returns the largest stretch of all meshes; see [`uv::Stretch::aspect`].
pub(super) fn stretch(subject: Subject, name: &str) -> Result<f64, Violation> {
    let meshes = textured(subject, name)?.into_iter();
    let aspects = meshes.filter_map(|(mesh, uvs)| Some(uv::stretch(mesh, uvs)?.aspect));
    Ok(aspects.fold(1.0, f64::max))
}

/// Returns the number of faces that, in the texture, overlap themselves or another face of the same mesh.
pub(super) fn n_overlapping(subject: Subject, name: &str) -> Result<u64, Violation> {
    let mut n = 0;
    for (mesh, uvs) in textured(subject, name)? {
        let faces = uv::overlapping_faces(mesh, uvs, subject.progress);
        n += faces.map_err(|cancelled| cancelled.to_string())?.len() as u64;
    }
    Ok(n)
}

/// Returns the faces with a stretch above `max`. The face with the largest stretch comes first.
pub(super) fn stretched_faces(mesh: &Mesh, name: &str, max: f64) -> Vec<FaceId> {
    let Some(uvs) = coordinates(mesh, name) else {
        return Vec::new();
    };
    let mut worst: BTreeMap<FaceId, f64> = BTreeMap::new();
    for (triangle, aspect) in uv::aspects(mesh, uvs) {
        if let Some(f) = mesh.face(triangle[0])
            && aspect > max
        {
            let worst = worst.entry(f).or_default();
            *worst = worst.max(aspect);
        }
    }
    let mut stretched: Vec<(FaceId, f64)> = worst.into_iter().collect();
    stretched.sort_by(|a, b| b.1.total_cmp(&a.1));
    stretched.into_iter().map(|(f, _)| f).collect()
}

/// Returns the faces that, in the texture, overlap themselves or another face of the mesh.
pub(super) fn overlapping_faces(mesh: &Mesh, name: &str, progress: &dyn Progress) -> Vec<FaceId> {
    let found = coordinates(mesh, name).map(|uvs| uv::overlapping_faces(mesh, uvs, progress));
    found.and_then(Result::ok).unwrap_or_default()
}
