//! Functions that write single entries of the mesh arrays. The edits of this crate use them. If a journal is open, each
//! write records the value that it overwrites. Edits must change connectivity only through these functions, so that
//! every edit can be undone.

use glam::DVec3;

use crate::attribute::Column;
use crate::journal::{Array, Entry};
use crate::{Domain, EdgeId, FaceId, HalfEdgeId, Id, Mesh, Values, VertexId};

impl Mesh {
    #[inline]
    pub(crate) fn set_next(&mut self, h: HalfEdgeId, next: HalfEdgeId) {
        self.write(Array::Next, h, next);
    }

    #[inline]
    pub(crate) fn set_origin(&mut self, h: HalfEdgeId, v: VertexId) {
        self.write(Array::Origin, h, v);
    }

    #[inline]
    pub(crate) fn set_face(&mut self, h: HalfEdgeId, f: Option<FaceId>) {
        self.write(Array::Face, h, f.unwrap_or(FaceId::NONE));
    }

    #[inline]
    pub(crate) fn set_vertex_half_edge(&mut self, v: VertexId, h: Option<HalfEdgeId>) {
        self.write(Array::VertexHalfEdge, v, h.unwrap_or(HalfEdgeId::NONE));
    }

    #[inline]
    pub(crate) fn set_face_half_edge(&mut self, f: FaceId, h: HalfEdgeId) {
        self.write(Array::FaceHalfEdge, f, h);
    }

    #[inline]
    fn write(&mut self, array: Array, at: impl Id, id: impl Id) {
        let slot = &mut self.connectivity.ids_mut(array)[at.index()];
        let old = std::mem::replace(slot, bytemuck::cast(id));
        if let Some(journal) = &mut self.journal {
            journal.record_link(array, at, old);
        }
    }

    pub(crate) fn push_vertex(&mut self, position: DVec3) -> VertexId {
        let v = VertexId::new(self.positions.len());
        self.positions.push(position);
        self.connectivity.vertex_half_edge.push(HalfEdgeId::NONE);
        self.attributes.grow(Domain::Vertex, v.index() + 1);
        v
    }

    /// Adds an edge between two vertices. All attribute values of the edge are zero. The caller must set `face` and
    /// `next` of both half-edges.
    pub(crate) fn push_edge(&mut self, origin: VertexId, target: VertexId) -> EdgeId {
        let e = EdgeId::new(self.connectivity.next.len() / 2);
        self.connectivity.next.extend([HalfEdgeId::NONE; 2]);
        self.connectivity.origin.extend([origin, target]);
        self.connectivity.face.extend([FaceId::NONE; 2]);
        self.attributes.grow(Domain::Edge, e.index() + 1);
        self.attributes.grow(Domain::Corner, 2 * e.index() + 2);
        e
    }

    /// Adds a face that stores `h` as its half-edge. All attribute values of the face are zero.
    pub(crate) fn push_face(&mut self, h: HalfEdgeId) -> FaceId {
        let f = FaceId::new(self.connectivity.face_half_edge.len());
        self.connectivity.face_half_edge.push(h);
        self.attributes.grow(Domain::Face, f.index() + 1);
        f
    }

    /// Marks a vertex, an edge or a face dead.
    pub(crate) fn kill<I: Id>(&mut self, id: I) {
        let dead = &mut self.dead[I::DOMAIN as usize];
        if !dead.has(id.index()) {
            dead.add(id.index());
            if let Some(journal) = &mut self.journal {
                journal.record(|| Entry::Mark(I::DOMAIN, id.index()));
            }
        }
    }

    /// Copies all attribute values of element `from` to element `to`, whatever the rules of the attributes are.
    #[inline]
    pub(crate) fn copy_values<I: Id>(&mut self, from: I, to: I) {
        self.edit_values(to, |column| column.values.copy(from.index(), to.index()));
    }

    /// Exchanges the attribute values of two elements, whatever the rules of the attributes are.
    pub(crate) fn swap_values<I: Id>(&mut self, a: I, b: I) {
        self.edit_values(b, |_| {});
        self.edit_values(a, |column| column.values.swap(a.index(), b.index()));
    }

    /// Negates the values of an element in all attribute columns that store normals.
    pub(crate) fn negate_normals<I: Id>(&mut self, element: I) {
        let i = element.index();
        self.edit_values(element, |column| column.negate_normals(i..i + 1));
    }

    /// Interpolates the attribute values of elements `a` and `b` at the parameter `t` (0 at `a`, 1 at `b`), and stores
    /// the result at element `to`. Only attributes whose rule interpolates are changed.
    #[inline]
    pub(crate) fn mix_values<I: Id>(&mut self, a: I, b: I, t: f64, to: I) {
        self.edit_values(to, |column| column.mix(a, b, t, to));
    }

    /// Sets the attribute values of element `to` to the mean of the values of the elements `from`. Only attributes
    /// whose rule interpolates are changed. `from` is allowed to contain `to`.
    pub(crate) fn average_values<I: Id>(&mut self, from: &[I], to: I) {
        self.edit_values(to, |column| column.average(from, to));
    }

    /// Merges the attribute values of edge `from` into edge `to`, when the two edges become one edge. Of two
    /// floating-point numbers, the larger is kept. A tag is set on `to` if it is set on either edge. Values of other
    /// types are not changed.
    pub(crate) fn merge_values(&mut self, from: EdgeId, to: EdgeId) {
        let (source, target) = (from.index(), to.index());
        self.edit_values(to, |column| match &mut column.values {
            Values::Float(v) if v[source] > v[target] => v[target] = v[source],
            Values::Tag(v) => v[target] |= v[source],
            _ => {}
        });
    }

    /// Updates the attribute values of corner `to` when an edge at its vertex collapses to a point. The parameter `t`
    /// of this point is 0 at the first end of the edge and 1 at the second end. `sides` has one entry for each side of
    /// the edge. For a side with a face, the entry contains the two corners of this face at the ends of the edge. `end`
    /// (0 or 1) is the end of the edge at which corner `to` lies. If one of the sides has a corner at this end with the
    /// same value as `to`, `to` follows this side: it gets the value interpolated between the two corners of the side.
    /// `to` must not be one of the corners in `sides`.
    pub(crate) fn follow_values(
        &mut self,
        sides: [Option<[HalfEdgeId; 2]>; 2],
        end: usize,
        t: f64,
        to: HalfEdgeId,
    ) {
        self.edit_values(to, |column| {
            let is_equal =
                |side: &&[HalfEdgeId; 2]| column.values.are_equal(side[end].index(), to.index());
            if let Some(&[a, b]) = sides.iter().flatten().find(is_equal) {
                column.mix(a, b, t, to);
            }
        });
    }

    pub(crate) fn has_corner_columns(&self) -> bool {
        !self.attributes.of(Domain::Corner).is_empty()
    }

    /// Changes the values of an element in all attribute columns. If a journal is open, first records the old values.
    #[inline]
    fn edit_values<I: Id>(&mut self, element: I, edit: impl Fn(&mut Column)) {
        let columns = self.attributes.of_mut(I::DOMAIN);
        if columns.is_empty() {
            return;
        }
        if let Some(journal) = &mut self.journal {
            journal.record_values(element, columns);
        }
        columns.iter_mut().for_each(edit);
    }

    /// Removes the attributes whose rule is [`Rule::Drop`](crate::Rule::Drop), and limits the size of the journal.
    /// Every edit of the connectivity calls this function before its first change.
    #[inline]
    pub(crate) fn drop_columns_by_rule(&mut self) {
        if self.journal.is_some() {
            self.bound_journal();
        }
        while let Some((domain, name)) = self.attributes.first_to_drop() {
            self.remove_column(domain, &name);
        }
    }
}
