//! Walking around faces and vertices, and finding the edge between two vertices.
//!
//! ```text
//!            c
//!          /   \            around face f, counter-clockwise:   h, next(h), next(next(h))
//!        /   f   \          around vertex a, clockwise:         h, next(twin(h)), ...
//!      a ---h---> b
//! ```

use crate::{EdgeId, FaceId, HalfEdgeId, Mesh, VertexId};

/// An iterator over the half-edges around a face, or over the outgoing half-edges of a vertex. Visits each
/// half-edge once.
///
/// `Orbit` is a named type without a destructor. Therefore, `if let Some(h) = mesh.vertex_half_edges(v).find(..)` does
/// not borrow the mesh in the block that follows.
#[derive(Clone, Debug)]
pub struct Orbit<'m> {
    mesh: &'m Mesh,
    start: Option<HalfEdgeId>,
    current: Option<HalfEdgeId>,
    around_vertex: bool,
}

impl Iterator for Orbit<'_> {
    type Item = HalfEdgeId;

    #[inline]
    fn next(&mut self) -> Option<HalfEdgeId> {
        let h = self.current?;
        let following = self
            .mesh
            .next(if self.around_vertex { h.twin() } else { h });
        self.current = Some(following).filter(|_| Some(following) != self.start);
        Some(h)
    }
}

impl Mesh {
    /// Iterates over the half-edges of `f`, counter-clockwise, starting with [`Mesh::face_half_edge`].
    #[inline]
    pub fn face_half_edges(&self, f: FaceId) -> Orbit<'_> {
        self.loop_half_edges(self.face_half_edge(f))
    }

    /// Iterates over the half-edges around the face, or the hole, of `h`, starting with `h`.
    #[inline]
    pub fn loop_half_edges(&self, h: HalfEdgeId) -> Orbit<'_> {
        self.orbit(Some(h), false)
    }

    #[inline]
    fn orbit(&self, start: Option<HalfEdgeId>, around_vertex: bool) -> Orbit<'_> {
        Orbit {
            mesh: self,
            start,
            current: start,
            around_vertex,
        }
    }

    /// Iterates over the outgoing half-edges of `v`, clockwise. If `v` is on the boundary, the first half-edge
    /// has no face, and the twin of the last half-edge has no face.
    #[inline]
    pub fn vertex_half_edges(&self, v: VertexId) -> Orbit<'_> {
        self.orbit(self.vertex_half_edge(v), true)
    }

    /// Iterates over the vertices at the corners of `f`, counter-clockwise.
    #[inline]
    pub fn face_vertices(&self, f: FaceId) -> impl Iterator<Item = VertexId> + Clone + '_ {
        self.face_half_edges(f).map(|h| self.origin(h))
    }

    /// Iterates over the vertices that share an edge with `v`, clockwise.
    #[inline]
    pub fn vertex_neighbors(&self, v: VertexId) -> impl Iterator<Item = VertexId> + Clone + '_ {
        self.vertex_half_edges(v).map(|h| self.target(h))
    }

    /// Iterates over the faces around `v`, clockwise.
    #[inline]
    pub fn vertex_faces(&self, v: VertexId) -> impl Iterator<Item = FaceId> + Clone + '_ {
        self.vertex_half_edges(v).filter_map(|h| self.face(h))
    }

    /// Returns the two vertices of `e`: the origin and the target of its first half-edge.
    #[inline]
    pub fn edge_vertices(&self, e: EdgeId) -> [VertexId; 2] {
        e.half_edges().map(|h| self.origin(h))
    }

    /// Returns the faces at `e`: the face of its first half-edge and the face of its second half-edge.
    #[inline]
    pub fn edge_faces(&self, e: EdgeId) -> [Option<FaceId>; 2] {
        e.half_edges().map(|h| self.face(h))
    }

    /// Returns the half-edge whose `next` is `h`. Walks around the face of `h` and around the origin of `h` at the same
    /// time. The time is proportional to the smaller of two numbers: the number of corners of the face, and the valence
    /// of the origin.
    #[inline]
    pub fn prev(&self, h: HalfEdgeId) -> HalfEdgeId {
        // The walk around the face starts two half-edges after `h`, so in a triangle it ends at once.
        let (mut in_face, mut around) = (self.next(self.next(h)), h);
        loop {
            let next = self.next(in_face);
            if next == h {
                return in_face;
            }
            in_face = next;
            let before = around.twin();
            around = self.next(before);
            if around == h {
                return before;
            }
        }
    }

    /// Returns the same half-edge as [`prev`](Self::prev), but does not walk around the origin of `h` if `h` has a
    /// face. Therefore, an edit can call this function while the links around the origin of `h` are incomplete.
    pub(crate) fn prev_in_face(&self, h: HalfEdgeId) -> HalfEdgeId {
        let prev = if self.face(h).is_some() {
            self.orbit(Some(h), false).last()
        } else {
            self.orbit(Some(h), true).last().map(HalfEdgeId::twin)
        };
        prev.expect("an orbit contains its start")
    }

    /// Returns the half-edge from `v` to `w`, if they share an edge. If several edges join `v` and `w`, returns the
    /// first half-edge in the order of [`vertex_half_edges`](Self::vertex_half_edges).
    pub fn find_half_edge(&self, v: VertexId, w: VertexId) -> Option<HalfEdgeId> {
        self.vertex_half_edges(v).find(|&h| self.target(h) == w)
    }

    /// Whether the origins of `x` and `y` share an edge. Walks around both vertices at the same time, so the time is
    /// proportional to the smaller of the two valences.
    #[inline]
    pub(crate) fn share_an_edge(&self, x: HalfEdgeId, y: HalfEdgeId) -> bool {
        let (v, w) = (self.origin(x), self.origin(y));
        let (mut a, mut b) = (x, y);
        loop {
            if self.target(a) == w || self.target(b) == v {
                return true;
            }
            a = self.next(a.twin());
            b = self.next(b.twin());
            if a == x || b == y {
                return false;
            }
        }
    }

    /// Returns the number of edges at `v`.
    #[inline]
    pub fn valence(&self, v: VertexId) -> usize {
        self.vertex_half_edges(v).count()
    }

    /// Returns the number of corners of `f`.
    #[inline]
    pub fn degree(&self, f: FaceId) -> usize {
        self.face_half_edges(f).count()
    }

    /// Whether `f` has three corners.
    #[inline]
    pub fn is_triangle(&self, f: FaceId) -> bool {
        let h = self.face_half_edge(f);
        self.next(self.next(self.next(h))) == h
    }

    /// Whether `e` has a face on only one side.
    #[inline]
    pub fn is_boundary_edge(&self, e: EdgeId) -> bool {
        self.edge_faces(e).contains(&None)
    }

    /// Whether `v` has a boundary edge.
    #[inline]
    pub fn is_boundary_vertex(&self, v: VertexId) -> bool {
        self.vertex_half_edge(v)
            .is_some_and(|h| self.face(h).is_none())
    }

    /// Whether any corner attribute differs between the two sides of `e`, at one end of `e` or at both. A boundary edge
    /// is not a seam.
    pub fn is_seam(&self, e: EdgeId) -> bool {
        let [h, twin] = e.half_edges();
        self.face(h).is_some()
            && self.face(twin).is_some()
            && (self.attributes.corners_differ(h, self.next(twin))
                || self.attributes.corners_differ(self.next(h), twin))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    /// Returns a fan of three triangles around vertex 0. The outer vertices, counter-clockwise: 1 east,
    /// 2 north-east, 3 north-west, 4 west.
    fn fan() -> Mesh {
        let p = |x: f64, y: f64| glam::DVec3::new(x, y, 0.0);
        let positions = vec![p(0., 0.), p(2., 0.), p(1., 2.), p(-1., 2.), p(-2., 0.)];
        Mesh::from_polygons(positions, &[[0, 1, 2], [0, 2, 3], [0, 3, 4]])
            .unwrap()
            .0
    }

    #[test]
    fn a_vertex_is_walked_around_clockwise_from_its_boundary() {
        let mesh = fan();
        let around: Vec<_> = mesh
            .vertex_neighbors(VertexId::new(0))
            .map(VertexId::index)
            .collect();
        assert_eq!(around, [4, 3, 2, 1]);
    }

    #[test]
    fn a_face_is_walked_around_counter_clockwise() {
        let mesh = fan();
        let around: Vec<_> = mesh
            .face_vertices(FaceId::new(1))
            .map(VertexId::index)
            .collect();
        assert_eq!(around, [0, 2, 3]);
    }

    #[test]
    fn prev_is_the_inverse_of_next() {
        for mesh in [
            fan(),
            shapes::cube(),
            shapes::grid(3, 2),
            shapes::cylinder(100, true),
            shapes::uv_sphere(100, 2),
        ] {
            assert!(mesh.half_edges().all(|h| mesh.prev(mesh.next(h)) == h));
            assert!(
                mesh.half_edges()
                    .all(|h| mesh.prev_in_face(mesh.next(h)) == h)
            );
        }
    }

    #[test]
    fn a_half_edge_is_found_only_between_vertices_that_share_an_edge() {
        let mesh = fan();
        let h = mesh
            .find_half_edge(VertexId::new(2), VertexId::new(0))
            .unwrap();
        assert_eq!(mesh.origin(h), VertexId::new(2));
        assert_eq!(mesh.target(h), VertexId::new(0));
        assert_eq!(
            mesh.find_half_edge(VertexId::new(1), VertexId::new(3)),
            None
        );
    }
}
