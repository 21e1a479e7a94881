//! Finds the faces in which two states of a mesh differ.

use std::collections::HashSet;
use std::hash::{DefaultHasher, Hash, Hasher};

use mesh::{FaceId, Mesh};

use crate::position_bits::bits;

/// Returns one flag for each face of `mesh`. The flag is set if `other` has no face with the same corner positions in
/// the same cyclic order. If `other` is `None`, no flag is set.
pub fn changed_faces(mesh: &Mesh, other: Option<&Mesh>) -> Vec<bool> {
    let mut changed = vec![false; mesh.domain_len(mesh::Domain::Face)];
    if let Some(other) = other {
        let known: HashSet<u64> = other.faces().map(|f| fingerprint(other, f)).collect();
        for f in mesh.faces() {
            changed[f.index()] = !known.contains(&fingerprint(mesh, f));
        }
    }
    changed
}

/// Returns a hash of the corner positions of a face. The hash does not depend on the corner at which the face starts.
fn fingerprint(mesh: &Mesh, f: FaceId) -> u64 {
    let mut corners: Vec<[u64; 3]> = (mesh.face_vertices(f))
        .map(|v| bits(mesh.position(v)))
        .collect();
    let first = (0..corners.len()).min_by_key(|&i| corners[i]);
    corners.rotate_left(first.unwrap_or(0));
    let mut hasher = DefaultHasher::new();
    corners.hash(&mut hasher);
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use mesh::DVec3;

    #[test]
    fn faces_at_a_moved_vertex_have_changed() {
        let before = shapes::cube();
        let mut after = before.clone();
        let v = after.vertices().next().unwrap();
        after.positions_mut()[v.index()] *= 2.0;
        let at_vertex: Vec<bool> = (after.faces())
            .map(|f| after.face_vertices(f).any(|w| w == v))
            .collect();
        assert_eq!(changed_faces(&after, Some(&before)), at_vertex);
        assert_eq!(changed_faces(&before, Some(&after)), at_vertex);
        assert_eq!(changed_faces(&after, None), [false; 6]);
    }

    #[test]
    fn a_face_may_start_at_another_corner_but_not_be_reversed() {
        let square = |corners: [u32; 4]| {
            let points = [DVec3::ZERO, DVec3::X, DVec3::ONE, DVec3::Y];
            Mesh::from_polygons(points.to_vec(), &[corners]).unwrap().0
        };
        let plain = square([0, 1, 2, 3]);
        assert_eq!(changed_faces(&square([2, 3, 0, 1]), Some(&plain)), [false]);
        assert_eq!(changed_faces(&square([3, 2, 1, 0]), Some(&plain)), [true]);
    }
}
