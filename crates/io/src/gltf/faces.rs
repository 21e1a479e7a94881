//! The faces of an object by material, cut into triangles.

use std::collections::BTreeMap;

use geometry::triangulate::Cutter;
use mesh::{Domain, FaceId, Mesh};
use scene::Object;

use super::split::Split;
use crate::loss::Losses;
use crate::parallel;

/// Triangles in the order of the faces.
pub(super) enum Faces {
    /// All faces of a mesh of so many triangles.
    All(usize),
    /// These faces, which are triangles.
    Triangles(Vec<u32>),
    /// The corners of triangles that faces were cut into, as vertices of glTF.
    Cut(Vec<u32>),
}

impl Faces {
    pub(super) fn n_triangles(&self) -> usize {
        match self {
            Self::All(n) => *n,
            Self::Triangles(faces) => faces.len(),
            Self::Cut(corners) => corners.len() / 3,
        }
    }
}

/// The triangles of each material, -1 for none.
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
    match materials {
        None if !has_polygons || mesh.n_faces() == 0 => {}
        None => {
            let all = (0..mesh.n_faces()).map(|f| u32::try_from(f).unwrap_or(u32::MAX));
            lists.insert(-1, all.collect());
        }
        Some(materials) => {
            for (f, &material) in (0..).zip(materials) {
                lists.entry(of_face(material)).or_default().push(f);
            }
        }
    }
    let reason = "the object has no such material";
    losses.add(Domain::Face, "material", unknown, reason);
    for (i, material) in object.materials.iter().enumerate() {
        let used = i32::try_from(i).is_ok_and(|i| lists.contains_key(&i));
        let reason = "no face has this material";
        losses.add(None, &material.name, usize::from(!used), reason);
    }
    if lists.is_empty() && mesh.n_faces() > 0 {
        return BTreeMap::from([(-1, Faces::All(mesh.n_faces()))]);
    }
    let faces = lists.into_iter().map(|(material, list)| {
        let cut = || Faces::Cut(cut(mesh, split, &list));
        (
            material,
            if has_polygons {
                cut()
            } else {
                Faces::Triangles(list)
            },
        )
    });
    faces.collect()
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
