//! Checks whether two meshes are the same up to the order of their elements.

use mesh::{DVec3, Mesh, VertexId};

use super::subject::counted;

/// The vertices of a mesh sorted by x, for searches by position.
pub(super) struct PositionIndex<'m> {
    mesh: &'m Mesh,
    by_x: Vec<VertexId>,
}

impl<'m> PositionIndex<'m> {
    pub(super) fn new(mesh: &'m Mesh) -> Self {
        let mut by_x: Vec<VertexId> = mesh.vertices().collect();
        by_x.sort_by(|&v, &w| mesh.position(v).x.total_cmp(&mesh.position(w).x));
        Self { mesh, by_x }
    }

    /// Returns the `free` vertex nearest to `p`, if there is one within the tolerance. If several vertices are equally
    /// near, returns the vertex with the lowest id.
    fn nearest(
        &self,
        p: DVec3,
        tolerance: f64,
        free: impl Fn(VertexId) -> bool,
    ) -> Option<VertexId> {
        self.near(p, tolerance)
            .map(|v| (self.mesh.position(v).distance(p), v))
            .filter(|&(distance, v)| distance <= tolerance && free(v))
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
            .map(|(_, v)| v)
    }

    /// Returns the vertices whose x differs from that of `p` by at most the tolerance.
    fn near(&self, p: DVec3, tolerance: f64) -> impl Iterator<Item = VertexId> {
        let x = |v: VertexId| self.mesh.position(v).x;
        let start = self.by_x.partition_point(|&v| x(v) < p.x - tolerance);
        let rest = self.by_x[start..].iter().copied();
        rest.take_while(move |&v| x(v) <= p.x + tolerance)
    }

    /// Whether any vertex is near `p`: at a distance of at most the tolerance.
    pub(super) fn any_near(&self, p: DVec3, tolerance: f64) -> bool {
        self.near(p, tolerance)
            .any(|v| self.mesh.position(v).distance(p) <= tolerance)
    }

    /// Returns, for each vertex of `other` (by index), the vertex within the tolerance of its image. `None` if the
    /// vertices do not match one to one.
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
