//! Writes a scene to the bytes of a binary STL file.

use geometry::triangulate::Cutter;
use glam::{DVec3, Vec3};
use mesh::{Domain, FaceId, Mesh, VertexId};
use scene::Scene;

use super::binary::{FACET, HEADER};
use crate::error::Unwritable;
use crate::joined::joined;
use crate::loss::Losses;
use crate::weld::n_merged;
use crate::{Format, SingleFile, WriteOptions};
use mesh::parallel;

/// Writes `scene`, and lists the content that the file does not store.
///
/// # Errors
///
/// Returns an error if an object is not a mesh, a position exceeds the range of 32-bit numbers, or there are at least
/// 2^32 triangles.
pub(crate) fn write(scene: &Scene, options: &WriteOptions) -> Result<SingleFile, Unwritable> {
    let mut joined = joined(scene, Format::Stl)?;
    let mesh = &*joined.mesh;
    let mut losses = Losses::of(&joined.name, &mut joined.losses);
    losses.add_columns(mesh, Format::Stl, |_, _| true);
    note_losses(mesh, &mut losses);
    let large = |&v: &VertexId| !mesh.position(v).as_vec3().is_finite();
    if let Some(v) = mesh.vertices().find(large) {
        let message = format!(
            "the position {} of the vertex {v} exceeds the range of the 32-bit floats of STL",
            mesh.position(v)
        );
        return Err(Unwritable::object(&joined.name, message));
    }
    let blocks = parallel::blocks(mesh.n_faces(), |faces| facets(mesh, faces));
    let n = blocks.iter().map(Vec::len).sum::<usize>() / FACET;
    let Ok(count) = u32::try_from(n) else {
        let message = format!("expected fewer than 2^32 triangles, found {n}");
        return Err(Unwritable::object(&joined.name, message));
    };
    let mut out = Vec::with_capacity(HEADER + 4 + n * FACET);
    out.extend_from_slice(&header(options));
    out.extend_from_slice(&count.to_le_bytes());
    for block in blocks {
        out.extend_from_slice(&block);
    }
    Ok((out, joined.losses))
}

fn note_losses(mesh: &Mesh, losses: &mut Losses) {
    let positions = mesh.positions();
    let is_rounded = |v: usize| positions[v].as_vec3().as_dvec3() != positions[v];
    let rounded = parallel::count(positions.len(), is_rounded);
    let reason = "rounded to the 32-bit numbers of STL";
    losses.add(Domain::Vertex, "position", rounded, reason);
    let isolated = mesh.n_isolated_vertices();
    let reason = "isolated vertices: STL stores only triangles";
    losses.add(Domain::Vertex, "position", isolated, reason);
    let reason = "coincident vertices, which readers of STL merge";
    losses.add(Domain::Vertex, "position", n_merged(mesh), reason);
    let is_polygon = |f: usize| !mesh.is_triangle(FaceId::new(f));
    let polygons = parallel::count(mesh.n_faces(), is_polygon);
    let reason = "STL stores only triangles, so polygons are triangulated";
    losses.add(Domain::Face, "polygon", polygons, reason);
}

/// Returns a header of 80 bytes with the name of the program and the provenance. The header never begins with `solid`.
fn header(options: &WriteOptions) -> [u8; HEADER] {
    let mut text = concat!("meshwright ", env!("CARGO_PKG_VERSION")).to_owned();
    if let Some(provenance) = &options.provenance {
        text += " ";
        text += provenance;
    }
    let mut header = [b' '; HEADER];
    // The last byte of the header is zero, because some readers recognize binary files by zero bytes.
    header[HEADER - 1] = 0;
    let room = &mut header[..HEADER - 1];
    let printable = text
        .bytes()
        .map(|b| if b.is_ascii_control() { b' ' } else { b });
    for (to, from) in room.iter_mut().zip(printable) {
        *to = from;
    }
    header
}

fn facets(mesh: &Mesh, faces: std::ops::Range<usize>) -> Vec<u8> {
    let mut out = Vec::with_capacity(faces.len() * FACET);
    let mut cutter = Cutter::default();
    let mut corners = Vec::new();
    for f in faces.map(FaceId::new) {
        corners.clear();
        corners.extend(mesh.face_vertices(f).map(|v| mesh.position(v)));
        if let &[a, b, c] = corners.as_slice() {
            push_facet(&mut out, [a, b, c]);
        } else {
            for triangle in cutter.cut(mesh, f).triangles() {
                push_facet(&mut out, triangle.map(|k| corners[k as usize]));
            }
        }
    }
    out
}

/// Appends a triangle with its unit normal. The normal is zero if the area of the rounded triangle is zero.
fn push_facet(out: &mut Vec<u8>, corners: [DVec3; 3]) {
    let rounded = corners.map(DVec3::as_vec3);
    let [a, b, c] = rounded.map(Vec3::as_dvec3);
    let normal = (b - a).cross(c - a).normalize_or_zero().as_vec3();
    for vector in [normal].iter().chain(&rounded) {
        for x in vector.to_array() {
            out.extend_from_slice(&x.to_le_bytes());
        }
    }
    out.extend_from_slice(&[0, 0]);
}
