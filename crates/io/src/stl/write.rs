//! From a scene to the bytes of a binary STL file.

use geometry::triangulate::Cutter;
use glam::{DVec3, Vec3};
use mesh::{Domain, FaceId, Mesh, VertexId};
use scene::Scene;

use super::binary::{FACET, HEADER};
use crate::error::Unwritable;
use crate::joined::joined;
use crate::loss::Losses;
use crate::parallel;
use crate::weld::n_merged;
use crate::{One, WriteOptions};

/// The file that holds `scene`, and what it does not hold.
///
/// # Errors
///
/// If an object is no mesh, a position is too large for 32 bits, or there are 2^32 triangles.
pub(crate) fn write(scene: &Scene, options: &WriteOptions) -> Result<One, Unwritable> {
    let mut joined = joined(scene, "STL", false)?;
    let mesh = &*joined.mesh;
    let mut losses = Losses::of(&joined.name, &mut joined.losses);
    losses.add_columns(mesh, "STL", |_, _| false);
    note_losses(mesh, &mut losses);
    let large = |&v: &VertexId| !mesh.position(v).as_vec3().is_finite();
    if let Some(v) = mesh.vertices().find(large) {
        let message = format!(
            "the position of {v}, {}, is too large for the 32 bits of STL",
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
    let reason = "rounded to the 32 bits of STL";
    losses.add(Domain::Vertex, "position", rounded, reason);
    let isolated = mesh.n_isolated_vertices();
    let reason = "isolated vertices: STL holds triangles";
    losses.add(Domain::Vertex, "position", isolated, reason);
    let reason = "vertices at the place of another: readers of STL see one";
    losses.add(Domain::Vertex, "position", n_merged(mesh), reason);
    let is_polygon = |f: usize| !mesh.is_triangle(FaceId::new(f));
    let polygons = parallel::count(mesh.n_faces(), is_polygon);
    let reason = "STL holds triangles: the polygons are cut";
    losses.add(Domain::Face, "polygon", polygons, reason);
}

/// 80 bytes: the program and where the content comes from. They never begin with `solid`.
fn header(options: &WriteOptions) -> [u8; HEADER] {
    let mut text = concat!("meshwright ", env!("CARGO_PKG_VERSION")).to_owned();
    if let Some(provenance) = &options.provenance {
        text += " ";
        text += provenance;
    }
    let mut header = [b' '; HEADER];
    // Readers that look for bytes 0 tell binary files by them.
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

/// A triangle with its unit normal; zero if it has no area once it is rounded.
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
