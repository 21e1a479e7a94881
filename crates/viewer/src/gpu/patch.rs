//! Local changes of a large mesh, such as a flip: only the triangles and normals that differ are uploaded.
//!
//! ```text
//!   old mesh --compare--> half-edges that differ --> faces --> vertices
//!   new mesh -----'                                  |          |
//!                                       triangles <--'          '--> normals
//! ```

use eframe::wgpu;
use mesh::{Domain, FaceId, Mesh, VertexId};
use rayon::prelude::*;
use scene::Geometry;

use super::geometry::{CHUNK, EDGE, encode_normal, narrow};
use super::objects::{Key, Uploaded};

/// The maximum number of half-edges that differ between the old and the new mesh. If more half-edges differ, the whole
/// object is converted.
const MAX_CHANGES: usize = 50_000;

/// Changes the buffers of an object to those of a new mesh. Returns false, and changes nothing, if the meshes differ by
/// more than the connectivity of a few triangles. The caller then converts the whole object again.
pub(super) fn patch(queue: &wgpu::Queue, uploaded: &Uploaded, new: &Key) -> bool {
    let (Some(simple), Some(old)) = (&uploaded.simple, &uploaded.key) else {
        return false;
    };
    let (Geometry::Mesh(a), Geometry::Mesh(b)) = (&old.geometry, &new.geometry) else {
        return false;
    };
    if !old.looks_like(new) {
        return false;
    }
    let Some(changed) = changed_faces(a, b) else {
        return false;
    };
    let has_positive_volume = || geometry::volume(b) > 0.0;
    if changed
        .iter()
        .any(|&f| has_sharp_edge(b, f, new.style.sharp))
        || (new.style.back.is_some() && simple.has_back == has_positive_volume())
    {
        return false;
    }
    for &f in &changed {
        let mut corners = [0; 3];
        for (corner, v) in corners.iter_mut().zip(b.face_vertices(f)) {
            *corner = index(v) | EDGE;
        }
        let Some(buffer) = simple.triangles.get(f.index() / CHUNK) else {
            continue;
        };
        let offset = size_of_val(&corners) * (f.index() % CHUNK);
        queue.write_buffer(buffer, offset as u64, bytemuck::cast_slice(&corners));
    }
    if let Some(buffer) = &simple.normals {
        for v in vertices([a, b], &changed) {
            let areas = b.vertex_faces(v).map(|f| b.area_vector(f));
            let normal: mesh::DVec3 = areas.sum();
            let word = encode_normal(narrow(normal.normalize_or_zero()));
            queue.write_buffer(buffer, 4 * v.index() as u64, bytemuck::bytes_of(&word));
        }
    }
    true
}

/// Returns the faces of those half-edges that differ between the two meshes. The faces are sorted by id. All returned
/// faces are triangles in both meshes. Returns `None` if the meshes differ in other ways.
fn changed_faces(a: &Mesh, b: &Mesh) -> Option<Vec<FaceId>> {
    let is_same_size = a.is_dense()
        && b.is_dense()
        && [Domain::Vertex, Domain::Corner, Domain::Face]
            .into_iter()
            .all(|domain| a.domain_len(domain) == b.domain_len(domain));
    if !is_same_size || [a, b].into_iter().any(has_attributes) {
        return None;
    }
    let same_positions = a.positions().par_iter().zip(b.positions());
    if !same_positions.all(|(p, q)| p == q) {
        return None;
    }
    let (old, new) = (a.connectivity(), b.connectivity());
    let changed: Vec<usize> = (0..new.next.len())
        .into_par_iter()
        .filter(|&h| {
            old.next[h] != new.next[h]
                || old.origin[h] != new.origin[h]
                || old.face[h] != new.face[h]
        })
        .collect();
    if changed.len() > MAX_CHANGES {
        return None;
    }
    let mut faces = Vec::with_capacity(2 * changed.len());
    for h in changed {
        faces.extend([old.face[h].some()?, new.face[h].some()?]);
    }
    faces.sort_unstable();
    faces.dedup();
    let are_triangles = faces.iter().all(|&f| a.is_triangle(f) && b.is_triangle(f));
    are_triangles.then_some(faces)
}

/// Whether a mesh has attributes that its picture depends on.
fn has_attributes(mesh: &Mesh) -> bool {
    mesh.get(mesh::COLOR).is_some()
        || mesh.get(mesh::CORNER_NORMAL).is_some()
        || mesh.get(mesh::VERTEX_NORMAL).is_some()
        || mesh.get(mesh::SMOOTHING).is_some()
        || mesh.get(mesh::CREASE).is_some()
        || mesh.get(mesh::MATERIAL).is_some()
}

/// Whether a face has a boundary edge or an edge that separates smooth parts. Vertices at these edges can have several
/// normals.
fn has_sharp_edge(mesh: &Mesh, f: FaceId, sharp: f64) -> bool {
    let limit = libm::cos(sharp.to_radians());
    let n = mesh.face_normal(f);
    mesh.face_half_edges(f).any(|h| {
        mesh.face(h.twin()).is_none_or(|g| {
            let m = mesh.face_normal(g);
            // An angle near the limit counts as sharp. The whole object is then converted, not only its changed faces.
            n.dot(m) <= limit + 1e-4
        })
    })
}

/// Returns the vertices that `faces` have in the first or the second mesh, sorted by id.
fn vertices(meshes: [&Mesh; 2], faces: &[FaceId]) -> Vec<VertexId> {
    let of_face = |&f: &FaceId| {
        meshes
            .into_iter()
            .flat_map(move |mesh| mesh.face_vertices(f))
    };
    let mut vertices: Vec<VertexId> = faces.iter().flat_map(of_face).collect();
    vertices.sort_unstable();
    vertices.dedup();
    vertices
}

fn index(v: VertexId) -> u32 {
    u32::try_from(v.index()).unwrap_or(!EDGE)
}
