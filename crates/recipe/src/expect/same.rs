//! Checks whether two meshes differ only in the order of their elements.

use std::cmp::Ordering;
use std::ops::Range;

use mesh::{DVec3, Mesh, VertexId};

use super::violation::Violation;

/// An index for finding the vertices of a mesh by position. The list `tree` is a k-d tree. The vertex in the middle of
/// the list splits the other vertices by one coordinate. This is the coordinate in which the bounding box of all
/// vertices is longest. Each half of the list is split in the same way.
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

    /// Returns the free (not yet matched) vertex nearest to `p`, as its index in the tree. Returns `None` if no free
    /// vertex is within the tolerance. If several vertices have the same distance from `p`, returns the one with the
    /// lowest id.
    fn nearest(&self, p: DVec3, tolerance: f64, free: &FreeVertices) -> Option<usize> {
        let mut best = (tolerance, VertexId::NONE, 0);
        let all = 0..self.tree.len();
        let enter = |i, limit| free.distance(i, p) <= limit;
        self.visit(all, p, tolerance, &enter, &mut |i| {
            let v = self.tree[i].0;
            let distance = self.mesh.position(v).distance(p);
            if (distance < best.0 || distance == best.0 && v < best.1) && free.is_free[i] {
                best = (distance, v, i);
            }
            best.0
        });
        (best.1 != VertexId::NONE).then_some(best.2)
    }

    /// Whether the distance from any vertex to `p` is at most `tolerance`.
    pub(super) fn any_near(&self, p: DVec3, tolerance: f64) -> bool {
        let mut found = false;
        let all = 0..self.tree.len();
        self.visit(all, p, tolerance, &|_, _| true, &mut |i| {
            found |= self.mesh.position(self.tree[i].0).distance(p) <= tolerance;
            if found { -1.0 } else { tolerance }
        });
        found
    }

    /// Searches a part of the tree for the vertices with a distance of at most `limit` from `p`. Calls `at` with the
    /// index of each vertex that is found. `at` returns the new limit, which applies to the rest of the search. Before
    /// searching a part of the tree, calls `enter` with the index of the middle vertex of this part and with the
    /// current limit. If `enter` returns `false`, the part is skipped. Returns the last limit.
    fn visit(
        &self,
        part: Range<usize>,
        p: DVec3,
        mut limit: f64,
        enter: &impl Fn(usize, f64) -> bool,
        at: &mut impl FnMut(usize) -> f64,
    ) -> f64 {
        let middle = middle(&part);
        if part.is_empty() || !enter(middle, limit) {
            return limit;
        }
        let (v, axis) = self.tree[middle];
        limit = at(middle);
        let axis = usize::from(axis);
        let beyond = p[axis] - self.mesh.position(v)[axis];
        let (below, above) = (part.start..middle, middle + 1..part.end);
        let [near, far] = if beyond < 0.0 {
            [below, above]
        } else {
            [above, below]
        };
        limit = self.visit(near, p, limit, enter, at);
        if beyond.abs() <= limit {
            limit = self.visit(far, p, limit, enter, at);
        }
        limit
    }

    /// Matches the vertices of `other` with vertices of this mesh, in the order of ids. Each vertex v of `other` is
    /// matched with the vertex w that is nearest to the point `image(v)` and is not matched yet. The distance from w to
    /// `image(v)` must not exceed the tolerance. The item at index v of the returned list is the match of v. Returns
    /// `None` if the meshes have different numbers of vertices, or if a vertex has no match.
    pub(super) fn matching(
        &self,
        other: &Mesh,
        image: impl Fn(VertexId) -> DVec3,
        tolerance: f64,
    ) -> Option<Vec<VertexId>> {
        if other.n_vertices() != self.mesh.n_vertices() {
            return None;
        }
        let mut free = FreeVertices::all(self);
        let mut map = vec![VertexId::NONE; other.positions().len()];
        for v in other.vertices() {
            let found = self.nearest(image(v), tolerance, &free)?;
            free.take(self, found);
            map[v.index()] = self.tree[found].0;
        }
        Some(map)
    }
}

/// Returns the index of the vertex that splits this part of the tree.
fn middle(part: &Range<usize>) -> usize {
    part.start + part.len() / 2
}

/// The free vertices of a k-d tree: the vertices that are not matched yet.
struct FreeVertices {
    is_free: Vec<bool>,
    /// Each vertex of the tree splits a part of the tree. For each vertex, this list has the bounding box of all free
    /// vertices in the part that the vertex splits. With these boxes, a search can skip the parts that have no free
    /// vertices. Without these boxes, each search would visit the vertices that are already matched.
    boxes: Vec<[DVec3; 2]>,
}

impl FreeVertices {
    const EMPTY: [DVec3; 2] = [DVec3::INFINITY, DVec3::NEG_INFINITY];

    fn all(index: &PositionIndex) -> Self {
        let n = index.tree.len();
        let mut free = Self {
            is_free: vec![true; n],
            boxes: vec![Self::EMPTY; n],
        };
        free.measure(index, 0..n);
        free
    }

    /// Computes the bounding boxes for a part of the tree and for all parts inside it.
    fn measure(&mut self, index: &PositionIndex, part: Range<usize>) {
        if !part.is_empty() {
            let middle = middle(&part);
            self.measure(index, part.start..middle);
            self.measure(index, middle + 1..part.end);
            self.update(index, part);
        }
    }

    /// Computes the bounding box for a part of the tree from the boxes of its two halves.
    fn update(&mut self, index: &PositionIndex, part: Range<usize>) {
        let middle = middle(&part);
        let own = if self.is_free[middle] {
            [index.mesh.position(index.tree[middle].0); 2]
        } else {
            Self::EMPTY
        };
        let halves = [part.start..middle, middle + 1..part.end];
        let halves = halves.iter().filter(|half| !half.is_empty());
        self.boxes[middle] = halves
            .map(|half| self.boxes[self::middle(half)])
            .fold(own, |a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    }

    /// The vertex at index `i` splits a part of the tree. Returns the distance from `p` to the bounding box of the free
    /// vertices in this part. The distance is infinite if no vertex of this part is free.
    fn distance(&self, i: usize, p: DVec3) -> f64 {
        let [min, max] = self.boxes[i];
        if min.x > max.x {
            return f64::INFINITY;
        }
        p.clamp(min, max).distance(p)
    }

    fn take(&mut self, index: &PositionIndex, i: usize) {
        self.is_free[i] = false;
        let mut parts = Vec::new();
        let mut part = 0..self.is_free.len();
        loop {
            let middle = middle(&part);
            parts.push(part.clone());
            match i.cmp(&middle) {
                Ordering::Less => part.end = middle,
                Ordering::Equal => break,
                Ordering::Greater => part.start = middle + 1,
            }
        }
        for part in parts.into_iter().rev() {
            self.update(index, part);
        }
    }
}

/// Orders vertices as a k-d tree. With each vertex, stores the index of the coordinate by which the vertex splits its
/// part of the tree.
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

/// Whether both meshes have the same faces after each vertex `v` of `other` is replaced by the vertex `map[v]` of
/// `mesh`. If `reversed` is set, the winding of the mapped faces is reversed before the comparison.
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

/// Checks that two meshes have the same vertices within the tolerance. If `connectivity` is set, also checks that they
/// have the same faces.
pub(super) fn check(
    mesh: &Mesh,
    other: &Mesh,
    tolerance: f64,
    connectivity: bool,
) -> Result<(), Violation> {
    let (n, m) = (mesh.n_vertices(), other.n_vertices());
    if n != m {
        let n = mesh::counted(n, "vertex");
        let message = format!("the mesh has {n}, the other mesh has {m}");
        return Err(Violation::unmet(message));
    }
    let Some(map) = PositionIndex::new(mesh).matching(other, |v| other.position(v), tolerance)
    else {
        return Err(Violation::unmet(format!(
            "the vertices of the two meshes are not at the same positions (tolerance: {tolerance})"
        )));
    };
    if connectivity && !same_faces(mesh, other, &map, false) {
        return Err(Violation::unmet(
            "the faces differ from those of the other mesh",
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn points(max: usize) -> impl Strategy<Value = Vec<DVec3>> {
        let coordinate = || (0_u8..5).prop_map(f64::from);
        let point = (coordinate(), coordinate(), coordinate());
        prop::collection::vec(point.prop_map(DVec3::from), 1..max)
    }

    fn mesh_of(points: Vec<DVec3>) -> Mesh {
        Mesh::from_polygons(points, &[] as &[[u32; 3]])
            .expect("vertices without faces are valid")
            .0
    }

    proptest! {
        #[test]
        fn the_matching_is_that_of_a_search_through_all_vertices(
            points in points(60),
            shift in (0_u8..3).prop_map(f64::from),
            tolerance in (0_u8..8).prop_map(f64::from),
        ) {
            let other = mesh_of(points.iter().rev().copied().collect());
            let mesh = mesh_of(points);
            let image = |v: VertexId| other.position(v) + DVec3::splat(shift);
            let mut free: Vec<VertexId> = mesh.vertices().collect();
            let expected: Option<Vec<VertexId>> = other
                .vertices()
                .map(|v| {
                    let distance = |w: VertexId| mesh.position(w).distance(image(v));
                    let near = free.iter().copied().filter(|&w| distance(w) <= tolerance);
                    let key = |w: &VertexId| (distance(*w), *w);
                    let found = near.min_by(|a, b| key(a).partial_cmp(&key(b)).expect("finite"))?;
                    free.retain(|&w| w != found);
                    Some(found)
                })
                .collect();
            let index = PositionIndex::new(&mesh);
            prop_assert_eq!(index.matching(&other, image, tolerance), expected);
        }
    }
}
