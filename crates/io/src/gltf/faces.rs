//! Triangulates the faces of an object, and groups the triangles by material.

use std::collections::BTreeMap;

use geometry::triangulate::Cutter;
use mesh::{Domain, FaceId, Mesh};
use scene::Object;

use super::split::Split;
use crate::loss::Losses;
use mesh::parallel;

/// The triangles of one material, in the order of the faces that they are cut from.
pub(super) struct Faces {
    pub(super) n_triangles: usize,
    /// The corners of the triangles, as indices of glTF vertices. `None` if the mesh has only triangles and all of them
    /// have this material.
    pub(super) corners: Option<Vec<u32>>,
}

/// Groups the triangles of an object by the index of their material. The key -1 stands for triangles without a
/// material.
pub(super) fn faces_by_material(
    object: &Object,
    mesh: &Mesh,
    split: &Split,
    has_polygons: bool,
    losses: &mut Losses,
) -> BTreeMap<i32, Faces> {
    let materials = mesh.get(mesh::MATERIAL);
    let exists = |m: i32| usize::try_from(m).is_ok_and(|m| m < object.materials.len());
    let mut unknown = 0;
    let mut of_face = |m: i32| {
        unknown += usize::from(m != -1 && !exists(m));
        if exists(m) { m } else { -1 }
    };
    let mut lists: BTreeMap<i32, Vec<u32>> = BTreeMap::new();
    for (f, &material) in (0..).zip(materials.unwrap_or_default()) {
        lists.entry(of_face(material)).or_default().push(f);
    }
    let reason = "the object does not have a material with this index";
    losses.add(Domain::Face, "material", unknown, reason);
    for (i, material) in object.materials.iter().enumerate() {
        let used = i32::try_from(i).is_ok_and(|i| lists.contains_key(&i));
        let reason = "not used by any face";
        losses.add(None, &material.name, usize::from(!used), reason);
    }
    if materials.is_none() && mesh.n_faces() > 0 {
        let all = (0..mesh.n_faces()).map(|f| u32::try_from(f).unwrap_or(u32::MAX));
        lists.insert(
            -1,
            if has_polygons {
                all.collect()
            } else {
                Vec::new()
            },
        );
    }
    let is_whole = lists.len() == 1 && !has_polygons;
    let faces = lists.into_iter().map(|(material, list)| {
        let corners = (!is_whole).then(|| cut(mesh, split, &list));
        let n_corners = corners.as_ref().map(Vec::len);
        let n_triangles = n_corners.map_or(mesh.n_faces(), |n| n / 3);
        (
            material,
            Faces {
                n_triangles,
                corners,
            },
        )
    });
    faces.collect()
}

/// The corners of all triangles, as indices of glTF vertices, for a mesh that has only triangles.
pub(super) fn all_corners(mesh: &Mesh, split: &Split) -> Vec<u32> {
    let corners = parallel::collect(mesh.n_faces(), |f| corners(mesh, split, FaceId::new(f)));
    corners.into_flattened()
}

/// The corners of a triangle, as indices of glTF vertices.
pub(super) fn corners(mesh: &Mesh, split: &Split, f: FaceId) -> [u32; 3] {
    let mut corners = [0; 3];
    for (slot, h) in corners.iter_mut().zip(mesh.face_half_edges(f)) {
        *slot = split.vertex_of(mesh, h);
    }
    corners
}

fn cut(mesh: &Mesh, split: &Split, faces: &[u32]) -> Vec<u32> {
    let blocks = parallel::blocks(faces.len(), |block| {
        let faces = &faces[block];
        let mut cutter = Cutter::default();
        let mut corners = Vec::with_capacity(6);
        let mut indices = Vec::with_capacity(6 * faces.len());
        for f in faces.iter().map(|&f| FaceId::new(f as usize)) {
            corners.clear();
            corners.extend(mesh.face_half_edges(f).map(|h| split.vertex_of(mesh, h)));
            if let &[a, b, c] = corners.as_slice() {
                indices.extend([a, b, c]);
                continue;
            }
            for triangle in cutter.cut(mesh, f).triangles() {
                indices.extend(triangle.map(|k| corners[k as usize]));
            }
        }
        indices
    });
    blocks.concat()
}
