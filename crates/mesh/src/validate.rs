//! Validation: [`Mesh::defects`] lists every broken invariant with its element. [`Mesh::is_valid`] is faster, but only
//! says whether any invariant is broken.

use glam::DVec3;
use rayon::prelude::*;

use crate::{Connectivity, Domain, EdgeId, Element, FaceId, HalfEdgeId, Id, Mesh, VertexId};

/// A broken invariant. The variants have the same order as the invariants in the crate's documentation.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Defect {
    /// The length of an array does not match the number of elements of its kind.
    #[error("the array `{0}` has the wrong length")]
    Length(&'static str),
    /// The mesh has more elements than there are ids.
    #[error("the mesh has more elements than there are 32-bit ids")]
    TooMany,
    /// An entry of an array refers to an element that does not exist or was removed.
    #[error(
        "the entry of the array `{array}` for {element} refers to an element that does not exist"
    )]
    Dangling {
        /// The name of the array.
        array: &'static str,
        /// The element whose array entry is invalid.
        element: Element,
    },
    /// The half-edge must be the `next` of exactly one half-edge, but it is the `next` of none or of several.
    #[error("the half-edge {0} must be the `next` of exactly one half-edge")]
    NextNotPermutation(HalfEdgeId),
    /// The half-edge and its `next` lie on different faces.
    #[error("the half-edge {0} and its `next` half-edge lie on different faces")]
    NextOnOtherFace(HalfEdgeId),
    /// The origin of `next` is not the target of the half-edge.
    #[error("the `next` half-edge of the half-edge {0} does not start where {0} ends")]
    NextNotConnected(HalfEdgeId),
    /// Both ends of an edge are the same vertex.
    #[error("the edge {0} starts and ends at the same vertex")]
    SelfLoop(EdgeId),
    /// An edge has no face on either side.
    #[error("the edge {0} has no face on either side")]
    NoFace(EdgeId),
    /// A face has fewer than three corners.
    #[error("the face {0} has fewer than three corners")]
    FewCorners(FaceId),
    /// The half-edge stored at a face lies on a different face, or the half-edges of the face form several loops.
    #[error(
        "the half-edges of the face {0} must form one loop, and the half-edge stored at {0} must be in this loop"
    )]
    FaceHalfEdge(FaceId),
    /// The half-edge stored at a vertex leaves a different vertex, or a vertex with edges stores no half-edge.
    #[error("the vertex {0} stores no half-edge, or stores one that does not start at {0}")]
    VertexHalfEdge(VertexId),
    /// The half-edge stored at a boundary vertex has a face.
    #[error(
        "the half-edge stored at the boundary vertex {0} must be a boundary half-edge, but it has a face"
    )]
    NotBoundaryFirst(VertexId),
    /// Walking around a vertex does not reach all of its outgoing half-edges, or meets more than one gap.
    #[error("the faces around the vertex {0} do not form a single fan")]
    SeveralFans(VertexId),
    /// A coordinate of a position is infinite or not a number.
    #[error("the position of the vertex {0} is not finite")]
    NotFinite(VertexId),
    /// The length of an attribute column differs from the number of elements in its domain (vertices, edges, faces or
    /// corners).
    #[error(
        "the {domain} attribute `{name}` must have one value for each {domain}, but has more or fewer"
    )]
    ColumnLength {
        /// The domain of the column.
        domain: Domain,
        /// The name of the column.
        name: String,
    },
}

/// The smallest number of elements that one parallel job checks.
const BLOCK: usize = 1 << 14;

/// A callback that receives each broken invariant.
type ReportDefect<'a> = &'a mut dyn FnMut(Defect);

impl Mesh {
    /// Creates a mesh from untrusted arrays, without attributes. Takes linear time.
    ///
    /// # Errors
    ///
    /// Returns the first [`Defect`], if the arrays are not a valid mesh.
    pub fn try_from_arrays(
        connectivity: Connectivity,
        positions: Vec<DVec3>,
    ) -> Result<Self, Defect> {
        let mesh = Self {
            connectivity,
            positions,
            ..Self::default()
        };
        if mesh.is_valid() {
            Ok(mesh)
        } else {
            Err(mesh.defects().swap_remove(0))
        }
    }

    /// Returns every broken invariant with its element; an empty list for a valid mesh. Never panics,
    /// whatever the arrays contain. Takes linear time.
    ///
    /// If an array has the wrong length, or an entry refers to a missing element, then the invariants that need this
    /// array or entry are not checked.
    pub fn defects(&self) -> Vec<Defect> {
        let mut defects = Vec::new();
        self.check_lengths(&mut |defect| defects.push(defect));
        if defects.is_empty() {
            let report: ReportDefect = &mut |defect| defects.push(defect);
            (self.half_edges()).for_each(|h| self.check_entries_of_half_edge(h, report));
            (self.vertices()).for_each(|v| self.check_entry_of_vertex(v, report));
            (self.faces()).for_each(|f| self.check_entry_of_face(f, report));
        }
        if defects.is_empty() {
            self.check_loops(&mut |defect| defects.push(defect));
        }
        (self.vertices()).for_each(|v| self.check_position(v, &mut |d| defects.push(d)));
        self.check_columns(&mut |defect| defects.push(defect));
        defects
    }

    /// Whether the mesh has no [`defects`](Self::defects). Checks in parallel.
    pub fn is_valid(&self) -> bool {
        finds_no_defect(|report| self.check_lengths(report))
            && finds_no_defect(|report| self.check_columns(report))
            && self.all(|e: EdgeId, report| {
                (e.half_edges().iter()).for_each(|&h| self.check_entries_of_half_edge(h, report));
            })
            && self.all(|v: VertexId, report| {
                self.check_entry_of_vertex(v, report);
                self.check_position(v, report);
            })
            && self.all(|f: FaceId, report| self.check_entry_of_face(f, report))
            && {
                let (is_permutation, is_linked) = rayon::join(
                    || self.is_permutation(),
                    || {
                        self.all(|e: EdgeId, report| {
                            (e.half_edges().iter()).for_each(|&h| self.check_links(h, report));
                        })
                    },
                );
                is_permutation && is_linked
            }
            // `next` is a permutation of the half-edges, and it leads to a half-edge of the same face. Therefore a walk
            // around a face returns to its start, and the walks around different faces are disjoint. Together, the
            // walks around all faces visit all corners only if the half-edges of each face form a single loop. The
            // walks around vertices are checked in the same way.
            && {
                let faces = |e| self.edge_faces(e).into_iter().flatten().count();
                self.sum(|f| self.loop_of_face(f, usize::MAX)) == self.sum(|e| Ok(faces(e)))
            }
            && self.sum(|v| self.fan_of_vertex(v, usize::MAX)) == Some(self.n_half_edges())
    }

    /// Whether a check finds no defect at any living (not deleted) element. Runs in parallel.
    fn all<I: Id>(&self, check: impl Fn(I, ReportDefect) + Sync + Send) -> bool {
        indices(self.domain_len(I::DOMAIN)).map(I::new).all(|id| {
            let is_clean = || finds_no_defect(|report| check(id, report));
            !self.is_living(id) || is_clean()
        })
    }

    /// Returns the sum of `term` over all living (not deleted) elements, computed in parallel; `None` if `term` returns
    /// a defect.
    fn sum<I: Id>(&self, term: impl Fn(I) -> Result<usize, Defect> + Sync + Send) -> Option<usize> {
        let term = |id| {
            if self.is_living(id) {
                term(id).ok()
            } else {
                Some(0)
            }
        };
        let ids = indices(self.domain_len(I::DOMAIN)).map(I::new);
        ids.map(term).sum()
    }

    // ---- The invariants, in the order of the crate's documentation ----------------------------

    /// Checks invariant 1 of the crate's documentation: the lengths of the arrays.
    pub(crate) fn check_lengths(&self, report: ReportDefect) {
        let c = &self.connectivity;
        let n = c.next.len();
        for (array, is_right) in [
            ("next", n.is_multiple_of(2)),
            ("origin", c.origin.len() == n),
            ("face", c.face.len() == n),
            (
                "vertex_half_edge",
                c.vertex_half_edge.len() == self.positions.len(),
            ),
        ] {
            if !is_right {
                report(Defect::Length(array));
            }
        }
        if n.max(self.positions.len()).max(c.face_half_edge.len()) >= u32::MAX as usize {
            report(Defect::TooMany);
        }
    }

    /// Checks invariant 2 of the crate's documentation: the ids that are stored for a half-edge.
    fn check_entries_of_half_edge(&self, h: HalfEdgeId, report: ReportDefect) {
        let has_face = self.face(h).is_none_or(|f| self.has_face(f));
        check_entry("next", h, self.has_edge(self.next(h).edge()), report);
        check_entry("origin", h, self.has_vertex(self.origin(h)), report);
        check_entry("face", h, has_face, report);
    }

    fn check_entry_of_vertex(&self, v: VertexId, report: ReportDefect) {
        let first = self.vertex_half_edge(v);
        let has_edge = first.is_none_or(|h| self.has_edge(h.edge()));
        check_entry("vertex_half_edge", v, has_edge, report);
    }

    fn check_entry_of_face(&self, f: FaceId, report: ReportDefect) {
        let has_edge = self.has_edge(self.face_half_edge(f).edge());
        check_entry("face_half_edge", f, has_edge, report);
    }

    /// Checks invariants 3 and 4 of the crate's documentation at one half-edge, but not whether `next` is a
    /// permutation.
    fn check_links(&self, h: HalfEdgeId, report: ReportDefect) {
        let (next, twin) = (self.next(h), h.twin());
        if self.face(next) != self.face(h) {
            report(Defect::NextOnOtherFace(h));
        }
        if self.origin(next) != self.origin(twin) {
            report(Defect::NextNotConnected(h));
        }
        // Each edge is reported once, at its first half-edge.
        if h < twin && self.origin(h) == self.origin(twin) {
            report(Defect::SelfLoop(h.edge()));
        }
        if h < twin && self.face(h).is_none() && self.face(twin).is_none() {
            report(Defect::NoFace(h.edge()));
        }
    }

    /// Checks invariants 3 to 7 of the crate's documentation. Every entry of the arrays must refer to an existing
    /// element.
    fn check_loops(&self, report: ReportDefect) {
        let mut n_reached = vec![0_u8; self.domain_len(Domain::Corner)];
        let mut corners = vec![0_usize; self.domain_len(Domain::Face)];
        let mut n_outgoing = vec![0_usize; self.domain_len(Domain::Vertex)];
        for h in self.half_edges() {
            let times = &mut n_reached[self.next(h).index()];
            *times = times.saturating_add(1);
            n_outgoing[self.origin(h).index()] += 1;
            if let Some(f) = self.face(h) {
                corners[f.index()] += 1;
            }
        }
        for h in self.half_edges() {
            if n_reached[h.index()] != 1 {
                report(Defect::NextNotPermutation(h));
            }
            self.check_links(h, report);
        }
        for f in self.faces() {
            match self.loop_of_face(f, corners[f.index()]) {
                Ok(n) if n == corners[f.index()] => {}
                Ok(_) => report(Defect::FaceHalfEdge(f)),
                Err(defect) => report(defect),
            }
        }
        for v in self.vertices() {
            match self.fan_of_vertex(v, n_outgoing[v.index()]) {
                Ok(n) if n == n_outgoing[v.index()] => {}
                Ok(0) => report(Defect::VertexHalfEdge(v)),
                Ok(_) => report(Defect::SeveralFans(v)),
                Err(defect) => report(defect),
            }
        }
    }

    fn is_permutation(&self) -> bool {
        let mut is_target = vec![0_u64; self.domain_len(Domain::Corner).div_ceil(64)];
        self.half_edges().all(|h| {
            let next = self.next(h).index();
            let (word, bit) = (&mut is_target[next / 64], 1 << (next % 64));
            let is_new = *word & bit == 0;
            *word |= bit;
            is_new
        })
    }

    /// Checks invariant 5 of the crate's documentation: the loop of a face. Returns the number of corners of a face, or
    /// `max + 1` if the face has more than `max` corners.
    fn loop_of_face(&self, f: FaceId, max: usize) -> Result<usize, Defect> {
        let first = self.face_half_edge(f);
        if self.face(first) != Some(f) {
            return Err(Defect::FaceHalfEdge(f));
        }
        let mut h = self.next(first);
        let mut n = 1;
        while h != first && n <= max {
            h = self.next(h);
            n += 1;
        }
        if n < 3 {
            Err(Defect::FewCorners(f))
        } else {
            Ok(n)
        }
    }

    /// Checks invariants 6 and 7 of the crate's documentation: the half-edges around a vertex. Returns the number of
    /// outgoing half-edges of a vertex, or `max + 1` if there are more than `max`.
    fn fan_of_vertex(&self, v: VertexId, max: usize) -> Result<usize, Defect> {
        let Some(first) = self.vertex_half_edge(v) else {
            return Ok(0);
        };
        if self.origin(first) != v {
            return Err(Defect::VertexHalfEdge(v));
        }
        let mut h = self.next(first.twin());
        let mut n = 1;
        while h != first && n <= max {
            // A fan has at most one gap (a half-edge without a face), which must be at the first half-edge.
            if self.face(h).is_none() {
                return Err(if self.face(first).is_none() {
                    Defect::SeveralFans(v)
                } else {
                    Defect::NotBoundaryFirst(v)
                });
            }
            h = self.next(h.twin());
            n += 1;
        }
        Ok(n)
    }

    /// Checks invariant 8 of the crate's documentation: positions are finite.
    fn check_position(&self, v: VertexId, report: ReportDefect) {
        if !self.position(v).is_finite() {
            report(Defect::NotFinite(v));
        }
    }

    /// Checks invariant 9 of the crate's documentation: the lengths of the attribute columns.
    fn check_columns(&self, report: ReportDefect) {
        for (domain, column) in self.attributes.iter() {
            if column.values.len() != self.domain_len(domain) {
                let name = column.name.clone();
                report(Defect::ColumnLength { domain, name });
            }
        }
    }
}

/// Reports a defect if the entry of `element` in `array` refers to an element that does not exist.
#[inline]
fn check_entry(
    array: &'static str,
    element: impl Into<Element>,
    exists: bool,
    report: ReportDefect,
) {
    if !exists {
        let element = element.into();
        report(Defect::Dangling { array, element });
    }
}

/// Whether `check` reports no defect.
fn finds_no_defect(check: impl FnOnce(ReportDefect)) -> bool {
    let mut finds_no_defect = true;
    check(&mut |_| finds_no_defect = false);
    finds_no_defect
}

fn indices(n: usize) -> impl IndexedParallelIterator<Item = usize> {
    (0..n).into_par_iter().with_min_len(BLOCK)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Column, Rule, Values, shapes};
    use glam::DVec3;

    /// Returns the defects of a grid of 2 x 2 squares after `corrupt` has changed it.
    fn defects_of_corrupted(corrupt: impl FnOnce(&mut Mesh)) -> Vec<Defect> {
        let mut mesh = shapes::grid(2, 2);
        assert_eq!(mesh.defects(), []);
        corrupt(&mut mesh);
        mesh.defects()
    }

    fn h(i: usize) -> HalfEdgeId {
        HalfEdgeId::new(i)
    }

    #[test]
    fn an_array_of_the_wrong_length_is_named() {
        assert_eq!(
            defects_of_corrupted(|m| assert!(m.connectivity.origin.pop().is_some())),
            [Defect::Length("origin")]
        );
        assert_eq!(
            defects_of_corrupted(|m| assert!(m.connectivity.face.pop().is_some())),
            [Defect::Length("face")]
        );
        assert_eq!(
            defects_of_corrupted(|m| assert!(m.positions.pop().is_some())),
            [Defect::Length("vertex_half_edge")]
        );
    }

    #[test]
    fn a_dangling_entry_is_named_with_its_element() {
        let dangling = |array, element: Element| Defect::Dangling { array, element };
        assert_eq!(
            defects_of_corrupted(|m| m.set_next(h(3), h(999))),
            [dangling("next", h(3).into())]
        );
        let far = VertexId::new(99);
        assert_eq!(
            defects_of_corrupted(|m| m.set_origin(h(5), far)),
            [dangling("origin", h(5).into())]
        );
        let far = Some(FaceId::new(99));
        assert_eq!(
            defects_of_corrupted(|m| m.set_face(h(4), far)),
            [dangling("face", h(4).into())]
        );
        let v = VertexId::new(2);
        let defects = defects_of_corrupted(|m| m.set_vertex_half_edge(v, Some(h(999))));
        assert_eq!(defects, [dangling("vertex_half_edge", v.into())]);
        let defects = defects_of_corrupted(|m| m.set_face_half_edge(FaceId::new(1), h(999)));
        assert_eq!(defects, [dangling("face_half_edge", FaceId::new(1).into())]);
    }

    #[test]
    fn a_next_that_is_not_a_permutation_is_found() {
        let defects = defects_of_corrupted(|m| m.set_next(h(0), m.next(h(2))));
        assert!(
            defects.contains(&Defect::NextNotPermutation(h(2))),
            "{defects:?}"
        );
    }

    #[test]
    fn a_next_on_another_face_is_found() {
        let mesh = shapes::grid(2, 2);
        let inner = mesh
            .half_edges()
            .find(|&h| !mesh.is_boundary_edge(h.edge()))
            .unwrap();
        let defects = defects_of_corrupted(|m| m.set_face(inner, Some(FaceId::new(3))));
        assert!(
            defects.contains(&Defect::NextOnOtherFace(inner)),
            "{defects:?}"
        );
    }

    #[test]
    fn a_next_that_does_not_start_where_the_half_edge_ends_is_found() {
        let defects = defects_of_corrupted(|m| m.set_origin(m.next(h(0)), VertexId::new(8)));
        assert!(
            defects.contains(&Defect::NextNotConnected(h(0))),
            "{defects:?}"
        );
    }

    #[test]
    fn an_edge_from_a_vertex_to_itself_is_found() {
        let defects = defects_of_corrupted(|m| m.set_origin(h(1), m.origin(h(0))));
        assert!(
            defects.contains(&Defect::SelfLoop(EdgeId::new(0))),
            "{defects:?}"
        );
    }

    #[test]
    fn an_edge_without_faces_is_found() {
        let mesh = shapes::grid(2, 2);
        let rim = mesh.half_edges().find(|&h| mesh.face(h).is_none()).unwrap();
        let defects = defects_of_corrupted(|m| m.set_face(rim.twin(), None));
        assert!(defects.contains(&Defect::NoFace(rim.edge())), "{defects:?}");
    }

    #[test]
    fn a_face_of_two_corners_is_found() {
        // The mesh has a face with only two half-edges, which lies between two edges with the same ends.
        let mut mesh = Mesh::default();
        let (a, b) = (mesh.push_vertex(DVec3::ZERO), mesh.push_vertex(DVec3::X));
        let e = mesh.push_edge(a, b);
        let twin = mesh.push_edge(a, b);
        let f = mesh.push_face(h(0));
        for (from, to) in [(0, 3), (3, 0), (1, 2), (2, 1)] {
            mesh.set_next(h(from), h(to));
        }
        mesh.set_face(e.half_edge(), Some(f));
        mesh.set_face(twin.half_edge().twin(), Some(f));
        mesh.set_vertex_half_edge(a, Some(h(2)));
        mesh.set_vertex_half_edge(b, Some(h(1)));
        assert_eq!(mesh.defects(), [Defect::FewCorners(f)]);
    }

    #[test]
    fn a_face_whose_half_edge_lies_on_another_face_is_found() {
        let f = FaceId::new(1);
        let defects =
            defects_of_corrupted(|m| m.set_face_half_edge(f, m.face_half_edge(FaceId::new(0))));
        assert_eq!(defects, [Defect::FaceHalfEdge(f)]);
    }

    #[test]
    fn a_vertex_whose_half_edge_leaves_another_vertex_is_found() {
        let v = VertexId::new(4);
        let defects = defects_of_corrupted(|m| {
            let h = m.vertex_half_edge(v).unwrap();
            m.set_vertex_half_edge(v, Some(h.twin()));
        });
        assert_eq!(defects, [Defect::VertexHalfEdge(v)]);
        assert_eq!(
            defects_of_corrupted(|m| m.set_vertex_half_edge(v, None)),
            [Defect::VertexHalfEdge(v)]
        );
    }

    #[test]
    fn a_boundary_vertex_whose_half_edge_has_a_face_is_found() {
        let v = VertexId::new(1);
        let defects = defects_of_corrupted(|m| {
            let inner = m.vertex_half_edges(v).nth(1).unwrap();
            m.set_vertex_half_edge(v, Some(inner));
        });
        assert_eq!(defects, [Defect::NotBoundaryFirst(v)]);
    }

    #[test]
    fn a_vertex_between_two_fans_is_found() {
        let (mut mesh, _) = Mesh::from_polygons(
            vec![
                DVec3::ZERO,
                DVec3::X,
                DVec3::Y,
                DVec3::ZERO,
                -DVec3::X,
                -DVec3::Y,
            ],
            &[[0, 1, 2], [3, 4, 5]],
        )
        .unwrap();
        let v = VertexId::new(0);
        let outgoing: Vec<_> = mesh.vertex_half_edges(VertexId::new(3)).collect();
        for h in outgoing {
            mesh.set_origin(h, v);
        }
        mesh.set_vertex_half_edge(VertexId::new(3), None);
        assert_eq!(mesh.defects(), [Defect::SeveralFans(v)]);
    }

    #[test]
    fn a_vertex_between_two_fans_that_are_linked_is_found() {
        // If two opposite faces of a 2 x 2 grid are removed, two fans are left at the middle vertex.
        let mut mesh = shapes::grid(2, 2);
        let v = VertexId::new(4);
        let around: Vec<_> = mesh.vertex_half_edges(v).collect();
        for h in [around[0], around[2]] {
            let f = mesh.face(h).unwrap();
            mesh.dead[Domain::Face as usize].add(f.index());
            let sides: Vec<_> = mesh.face_half_edges(f).collect();
            for side in sides {
                mesh.set_face(side, None);
            }
        }
        mesh.set_vertex_half_edge(v, Some(around[0]));
        assert!(mesh.defects().contains(&Defect::SeveralFans(v)));
    }

    #[test]
    fn a_position_that_is_not_a_number_is_found() {
        let v = VertexId::new(7);
        assert_eq!(
            defects_of_corrupted(|m| m.positions[7].z = f64::NAN),
            [Defect::NotFinite(v)]
        );
    }

    #[test]
    fn a_column_of_the_wrong_length_is_found() {
        let column = Column {
            name: "w".into(),
            rule: Rule::Copy,
            values: Values::Int(vec![1]),
        };
        let defects = defects_of_corrupted(|m| m.attributes.insert(Domain::Face, column));
        assert_eq!(
            defects,
            [Defect::ColumnLength {
                domain: Domain::Face,
                name: "w".into()
            }]
        );
    }
}
