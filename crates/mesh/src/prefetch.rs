//! Prefetching memory for later edits.
//!
//! If the edges of a large mesh are edited in random order, each edit waits for memory several times. It waits first
//! for the half-edges of the edge, then for the neighboring half-edges, then for the vertices and faces of these
//! half-edges. Each address depends on the previous one, but the memory for later edits can be prefetched during the
//! current edit. Flipping all edges of a mesh with 1 M triangles and an open journal took 1.0 s with prefetching and
//! 1.5 s without. In this measurement, the elements were in random order in memory. Prefetching saves no time if edges
//! are flipped in order of ids and neighboring elements are near each other in memory. Successive edits then use the
//! same cache lines.

use crate::{EdgeId, HalfEdgeId, Mesh};

/// [`Mesh::fetch_ahead`] prefetches the memory for an edit in four steps, because each step reads addresses from memory
/// that an earlier step has prefetched. During edit i, step k prefetches memory for edit i + `STEPS[k]`.
const STEPS: [usize; 4] = [32, 24, 16, 8];

impl Mesh {
    /// Asks the processor to prefetch memory for later edits. The current edit changes the edge `edges[at]`; later
    /// edits change the edges after it. The caller must edit the edges in the order of this list. The call is only a
    /// hint: the mesh does not change. `edges` is allowed to contain ids of elements that are dead or do not exist.
    ///
    /// # Examples
    ///
    /// ```
    /// let mut mesh = geometry::shapes::torus(100, 100, 2.0, 1.0);
    /// let queue: Vec<mesh::EdgeId> = mesh.edges().step_by(7).collect();
    /// for (i, &e) in queue.iter().enumerate() {
    ///     mesh.fetch_ahead(&queue, i);
    ///     mesh.split_edge(e, 0.5)?;
    /// }
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    #[inline]
    pub fn fetch_ahead(&self, edges: &[EdgeId], at: usize) {
        let halves = |step: usize| {
            let e = edges.get(at + STEPS[step]).copied();
            e.into_iter().flat_map(EdgeId::half_edges)
        };
        // The two half-edges of an edge are adjacent in memory, so only the first one is prefetched.
        if let Some(h) = halves(0).next() {
            self.fetch(h);
        }
        for h in halves(1) {
            self.fetch(self.next_or_none(h));
        }
        for h in halves(2) {
            self.fetch(self.next_or_none(self.next_or_none(h)));
            if let Some(v) = self.connectivity.origin.get(h.index()) {
                prefetch(&self.connectivity.vertex_half_edge, v.index());
                prefetch(&self.positions, v.index());
            }
            if let Some(f) = self.connectivity.face.get(h.index()) {
                prefetch(&self.connectivity.face_half_edge, f.index());
            }
        }
        for h in halves(3) {
            let opposite = self.next_or_none(self.next_or_none(h));
            self.fetch(opposite.twin());
        }
    }

    #[inline]
    fn fetch(&self, h: HalfEdgeId) {
        let c = &self.connectivity;
        prefetch(&c.next, h.index());
        prefetch(&c.origin, h.index());
        prefetch(&c.face, h.index());
    }

    #[inline]
    fn next_or_none(&self, h: HalfEdgeId) -> HalfEdgeId {
        let next = self.connectivity.next.get(h.index());
        next.copied().unwrap_or(HalfEdgeId::NONE)
    }
}

/// The number of bytes that the processor loads from memory at a time.
#[cfg(target_arch = "x86_64")]
const CACHE_LINE: usize = 64;

/// Asks the processor to prefetch the memory of element `i` of an array. The call is only a hint, and does nothing on
/// processors other than x86-64. `i` is allowed to exceed the length of the array.
#[inline]
pub fn prefetch<T>(array: &[T], i: usize) {
    #[cfg(target_arch = "x86_64")]
    #[expect(
        unsafe_code,
        reason = "the standard library has no safe prefetch; prefetching makes random splits 2.6 times as fast"
    )]
    // SAFETY: a prefetch has no visible effect and does not fault, for any address. `wrapping_add` does
    // not require that the pointer stays inside the array.
    unsafe {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        let first: *const i8 = array.as_ptr().wrapping_add(i).cast();
        for offset in (0..size_of::<T>()).step_by(CACHE_LINE) {
            _mm_prefetch::<_MM_HINT_T0>(first.wrapping_add(offset));
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (array, i);
}

#[cfg(test)]
mod tests {
    use crate::{EdgeId, shapes};

    #[test]
    fn fetching_any_ids_changes_nothing() {
        let mut mesh = shapes::grid(4, 4);
        mesh.delete_face(crate::FaceId::new(0)).unwrap();
        let before = mesh.clone();
        let mut edges: Vec<EdgeId> = (0..100).map(EdgeId::new).collect();
        edges.push(EdgeId::NONE);
        edges.push(EdgeId::new(u32::MAX as usize - 1));
        for i in 0..=edges.len() {
            mesh.fetch_ahead(&edges, i);
        }
        assert_eq!(mesh, before);
    }
}
