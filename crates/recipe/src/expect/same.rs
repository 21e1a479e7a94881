//! Checks whether two meshes are the same up to the order of their elements.

use mesh::{DVec3, Mesh, VertexId};

use super::subject::counted;

/// The vertices of a mesh, for searches by position. The list is a k-d tree: the vertex in the middle of the list
/// splits the other vertices by the coordinate in which they extend most. Both halves of the list are split in the same
/// way.
pub(super) struct PositionIndex<'m> {
    mesh: &'m Mesh,
    tree: Vec<(VertexId, u8)>,
}

impl<'m> PositionIndex<'m> {
    pub(super) fn new(mesh: &'m Mesh) -> Self {
        let mut tree: Vec<(VertexId, u8)> = mesh.vertices().map(|v| (v, 0)).collect();
        split(mesh, &mut tree);
        Self { mesh, tree }
    }

    /// Returns the `free` vertex nearest to `p`, if there is one within the tolerance. If several vertices are equally
    /// near, returns the vertex with the lowest id.
    fn nearest(
        &self,
        p: DVec3,
        tolerance: f64,
        free: impl Fn(VertexId) -> bool,
    ) -> Option<VertexId> {
        let mut best = (tolerance, VertexId::NONE);
        self.visit(&self.tree, p, tolerance, &mut |v| {
            let found = (self.mesh.position(v).distance(p), v);
            if found.0 < best.0 || found.0 == best.0 && v < best.1 {
                if !free(v) {
                    return best.0;
                }
                best = found;
            }
            best.0
        });
        (best.1 != VertexId::NONE).then_some(best.1)
    }

    /// Whether any vertex is near `p`: at a distance of at most the tolerance.
    pub(super) fn any_near(&self, p: DVec3, tolerance: f64) -> bool {
        let mut found = false;
        self.visit(&self.tree, p, tolerance, &mut |v| {
            found |= self.mesh.position(v).distance(p) <= tolerance;
            if found { -1.0 } else { tolerance }
        });
        found
    }

    /// Calls `at` for the vertices in a part of the tree that can be within a distance of `p`. The distance is `limit`
    /// at first, and then the last value that `at` returned. Returns the final distance.
    fn visit(
        &self,
        tree: &[(VertexId, u8)],
        p: DVec3,
        mut limit: f64,
        at: &mut impl FnMut(VertexId) -> f64,
    ) -> f64 {
        let middle = tree.len() / 2;
        let Some(&(v, axis)) = tree.get(middle) else {
            return limit;
        };
        limit = at(v);
        let axis = usize::from(axis);
        let beyond = p[axis] - self.mesh.position(v)[axis];
        let (below, above) = (&tree[..middle], &tree[middle + 1..]);
        let [near, far] = if beyond < 0.0 {
            [below, above]
        } else {
            [above, below]
        };
        limit = self.visit(near, p, limit, at);
        if beyond.abs() <= limit {
            limit = self.visit(far, p, limit, at);
        }
        limit
    }

    /// Returns, for each vertex of `other` (by index), the vertex that is within the tolerance of the vertex's image.
    /// `None` if the vertices do not match one to one.
    pub(super) fn matching(
        &self,
        other: &Mesh,
        image: impl Fn(VertexId) -> DVec3,
        tolerance: f64,
    ) -> Option<Vec<VertexId>> {
        if other.n_vertices() != self.mesh.n_vertices() {
            return None;
        }
        let mut taken = vec![false; self.mesh.positions().len()];
        let mut map = vec![VertexId::NONE; other.positions().len()];
        for v in other.vertices() {
            let found = self.nearest(image(v), tolerance, |v| !taken[v.index()])?;
            taken[found.index()] = true;
            map[v.index()] = found;
        }
        Some(map)
    }
}

/// Orders vertices as a k-d tree. Stores with each vertex the coordinate by which the vertex splits its part of the
/// tree.
fn split(mesh: &Mesh, tree: &mut [(VertexId, u8)]) {
    let positions = tree.iter().map(|&(v, _)| mesh.position(v));
    let Some((min, max)) = positions
        .map(|p| (p, p))
        .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    else {
        return;
    };
    let axis = (max - min).max_position();
    let middle = tree.len() / 2;
    let x = |v: VertexId| mesh.position(v)[axis];
    tree.select_nth_unstable_by(middle, |a, b| x(a.0).total_cmp(&x(b.0)));
    tree[middle].1 = u8::try_from(axis).unwrap_or(0);
    let (below, above) = tree.split_at_mut(middle);
    split(mesh, below);
    split(mesh, &mut above[1..]);
}

/// Whether the faces of `other`, with their vertices mapped by `map`, are the faces of `mesh`. If `reversed`, the
/// winding of the mapped faces is reversed first.
pub(crate) fn same_faces(mesh: &Mesh, other: &Mesh, map: &[VertexId], reversed: bool) -> bool {
    let canonical = |mut corners: Vec<VertexId>| {
        let lowest = corners
            .iter()
            .enumerate()
            .min_by_key(|(_, v)| **v)
            .map_or(0, |(i, _)| i);
        corners.rotate_left(lowest);
        corners
    };
    let mut faces: Vec<_> = mesh
        .faces()
        .map(|f| canonical(mesh.face_vertices(f).collect()))
        .collect();
    let mut others: Vec<_> = other
        .faces()
        .map(|f| {
            let mut corners: Vec<_> = other.face_vertices(f).map(|v| map[v.index()]).collect();
            if reversed {
                corners.reverse();
            }
            canonical(corners)
        })
        .collect();
    faces.sort_unstable();
    others.sort_unstable();
    faces == others
}

/// Checks that two meshes have the same vertices within the tolerance and, if `connectivity` is set, the same faces.
pub(super) fn check(
    mesh: &Mesh,
    other: &Mesh,
    tolerance: f64,
    connectivity: bool,
) -> Result<(), String> {
    let (n, m) = (mesh.n_vertices(), other.n_vertices());
    if n != m {
        return Err(format!(
            "the mesh has {}, the other mesh {m}",
            counted(n, "vertices")
        ));
    }
    let Some(map) = PositionIndex::new(mesh).matching(other, |v| other.position(v), tolerance)
    else {
        return Err(format!(
            "the vertices do not match those of the other mesh (tolerance: {tolerance})"
        ));
    };
    if connectivity && !same_faces(mesh, other, &map, false) {
        return Err("the faces differ from those of the other mesh".to_owned());
    }
    Ok(())
}
