//! The invariants of a mesh as functions: every broken one with its element, and whether there is none.

use glam::DVec3;
use rayon::prelude::*;

use crate::{Connectivity, Domain, EdgeId, Element, FaceId, HalfEdgeId, Id, Mesh, VertexId};

/// A broken invariant. The words are those of the crate's front page, in the same order.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Defect {
    /// An array has not one entry for each element.
    #[error("{0} has the wrong length")]
    Length(&'static str),
    /// There are more elements than ids.
    #[error("there are more elements than ids")]
    TooMany,
    /// An entry of an array names an element that does not exist or is dead.
    #[error("{array} of {element} names an element that is not there")]
    Dangling {
        /// The array.
        array: &'static str,
        /// The element whose entry it is.
        element: Element,
    },
    /// `next` leads here from no half-edge, or from several.
    #[error("{0} is not the next of exactly one half-edge")]
    NextNotPermutation(HalfEdgeId),
    /// `next` leads to another face.
    #[error("the next of {0} lies on another face")]
    NextOnOtherFace(HalfEdgeId),
    /// The origin of the next half-edge is not the target of this one.
    #[error("the next of {0} does not begin where {0} ends")]
    NextNotConnected(HalfEdgeId),
    /// An edge begins and ends at one vertex.
    #[error("{0} begins and ends at one vertex")]
    SelfLoop(EdgeId),
    /// An edge has no face on either side.
    #[error("{0} has no face on either side")]
    NoFace(EdgeId),
    /// A face has fewer than three corners.
    #[error("{0} has fewer than three corners")]
    FewCorners(FaceId),
    /// The half-edge of a face lies on another one, or the face's half-edges form several loops.
    #[error("the half-edges of {0} are not one loop")]
    FaceHalfEdge(FaceId),
    /// The half-edge of a vertex leaves another one, or the vertex is used and has none.
    #[error("the half-edge of {0} does not leave it")]
    VertexHalfEdge(VertexId),
    /// The half-edge of a boundary vertex is not the boundary one.
    #[error("the half-edge of {0} is not the boundary one")]
    NotBoundaryFirst(VertexId),
    /// The half-edges that leave a vertex are not all reached by walking around it, or there is more than
    /// one gap on the way.
    #[error("the faces around {0} are not one fan")]
    SeveralFans(VertexId),
    /// A position is infinite or not a number.
    #[error("the position of {0} is not finite")]
    NotFinite(VertexId),
    /// A column has not one value for each element of its domain.
    #[error("the {domain} attribute {name} has the wrong length")]
    ColumnLength {
        /// The domain.
        domain: Domain,
        /// The name of the column.
        name: String,
    },
}

/// Elements that one thread looks at in one go.
const BLOCK: usize = 1 << 14;

/// What to do with a broken invariant.
type Found<'a> = &'a mut dyn FnMut(Defect);

impl Mesh {
    /// A mesh of arrays from outside, without attributes. Takes time in proportion to their length.
    ///
    /// # Errors
    ///
    /// The first [`Defect`], if there is one.
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

    /// Every broken invariant with its element; empty for a valid mesh. Never panics, whatever the
    /// arrays hold. Takes time in proportion to the size of the mesh.
    ///
    /// Where entries dangle, only these are listed: the other invariants have no meaning then.
    pub fn defects(&self) -> Vec<Defect> {
        let mut defects = Vec::new();
        self.check_lengths(&mut |defect| defects.push(defect));
        if defects.is_empty() {
            let found: Found = &mut |defect| defects.push(defect);
            (self.half_edges()).for_each(|h| self.check_entries_of_half_edge(h, found));
            (self.vertices()).for_each(|v| self.check_entry_of_vertex(v, found));
            (self.faces()).for_each(|f| self.check_entry_of_face(f, found));
        }
        if defects.is_empty() {
            self.check_loops(&mut |defect| defects.push(defect));
        }
        (self.vertices()).for_each(|v| self.check_position(v, &mut |d| defects.push(d)));
        self.check_columns(&mut |defect| defects.push(defect));
        defects
    }

    /// Whether there are no [`defects`](Self::defects), asked by all threads.
    pub fn is_valid(&self) -> bool {
        is_silent(|found| self.check_lengths(found))
            && is_silent(|found| self.check_columns(found))
            && self.all(|e: EdgeId, found| {
                (e.half_edges().iter()).for_each(|&h| self.check_entries_of_half_edge(h, found));
            })
            && self.all(|v: VertexId, found| {
                self.check_entry_of_vertex(v, found);
                self.check_position(v, found);
            })
            && self.all(|f: FaceId, found| self.check_entry_of_face(f, found))
            && {
                let (is_permutation, is_linked) = rayon::join(
                    || self.is_permutation(),
                    || {
                        self.all(|e: EdgeId, found| {
                            (e.half_edges().iter()).for_each(|&h| self.check_links(h, found));
                        })
                    },
                );
                is_permutation && is_linked
            }
            // `next` is a permutation that stays on its face, so every walk comes back to where it began, walks
            // of different faces meet nowhere, and they pass all corners if every face is one loop. The same
            // holds for the walks around vertices.
            && {
                let faces = |e| self.edge_faces(e).into_iter().flatten().count();
                self.sum(|f| self.loop_of_face(f, usize::MAX)) == self.sum(|e| Ok(faces(e)))
            }
            && self.sum(|v| self.fan_of_vertex(v, usize::MAX)) == Some(self.n_half_edges())
    }

    /// Whether a check finds nothing at any living element, asked by all threads.
    fn all<I: Id>(&self, check: impl Fn(I, Found) + Sync + Send) -> bool {
        numbers(self.domain_len(I::DOMAIN)).map(I::new).all(|id| {
            let is_clean = || is_silent(|found| check(id, found));
            !self.is_living(id) || is_clean()
        })
    }

    /// The sum over all living elements, by all threads; `None` if there is a defect.
    fn sum<I: Id>(&self, term: impl Fn(I) -> Result<usize, Defect> + Sync + Send) -> Option<usize> {
        let term = |id| {
            if self.is_living(id) {
                term(id).ok()
            } else {
                Some(0)
            }
        };
        let ids = numbers(self.domain_len(I::DOMAIN)).map(I::new);
        ids.map(term).sum()
    }

    // ---- The invariants, in the order of the crate's front page -------------------------------

    /// 1.
    pub(crate) fn check_lengths(&self, found: Found) {
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
                found(Defect::Length(array));
            }
        }
        if n.max(self.positions.len()).max(c.face_half_edge.len()) >= u32::MAX as usize {
            found(Defect::TooMany);
        }
    }

    /// 2.
    fn check_entries_of_half_edge(&self, h: HalfEdgeId, found: Found) {
        let has_face = self.face(h).is_none_or(|f| self.has_face(f));
        check_entry("next", h, self.has_edge(self.next(h).edge()), found);
        check_entry("origin", h, self.has_vertex(self.origin(h)), found);
        check_entry("face", h, has_face, found);
    }

    fn check_entry_of_vertex(&self, v: VertexId, found: Found) {
        let first = self.vertex_half_edge(v);
        let has_edge = first.is_none_or(|h| self.has_edge(h.edge()));
        check_entry("vertex_half_edge", v, has_edge, found);
    }

    fn check_entry_of_face(&self, f: FaceId, found: Found) {
        let has_edge = self.has_edge(self.face_half_edge(f).edge());
        check_entry("face_half_edge", f, has_edge, found);
    }

    /// 3 and 4, but for whether `next` is a permutation.
    fn check_links(&self, h: HalfEdgeId, found: Found) {
        let (next, twin) = (self.next(h), h.twin());
        if self.face(next) != self.face(h) {
            found(Defect::NextOnOtherFace(h));
        }
        if self.origin(next) != self.origin(twin) {
            found(Defect::NextNotConnected(h));
        }
        // Of both halves the first one tells.
        if h < twin && self.origin(h) == self.origin(twin) {
            found(Defect::SelfLoop(h.edge()));
        }
        if h < twin && self.face(h).is_none() && self.face(twin).is_none() {
            found(Defect::NoFace(h.edge()));
        }
    }

    /// 3 to 7, where no entry dangles.
    fn check_loops(&self, found: Found) {
        let mut reached = vec![0_u8; self.domain_len(Domain::Corner)];
        let mut corners = vec![0_usize; self.domain_len(Domain::Face)];
        let mut leaving = vec![0_usize; self.domain_len(Domain::Vertex)];
        for h in self.half_edges() {
            let times = &mut reached[self.next(h).index()];
            *times = times.saturating_add(1);
            leaving[self.origin(h).index()] += 1;
            if let Some(f) = self.face(h) {
                corners[f.index()] += 1;
            }
        }
        for h in self.half_edges() {
            if reached[h.index()] != 1 {
                found(Defect::NextNotPermutation(h));
            }
            self.check_links(h, found);
        }
        for f in self.faces() {
            match self.loop_of_face(f, corners[f.index()]) {
                Ok(n) if n == corners[f.index()] => {}
                Ok(_) => found(Defect::FaceHalfEdge(f)),
                Err(defect) => found(defect),
            }
        }
        for v in self.vertices() {
            match self.fan_of_vertex(v, leaving[v.index()]) {
                Ok(n) if n == leaving[v.index()] => {}
                Ok(0) => found(Defect::VertexHalfEdge(v)),
                Ok(_) => found(Defect::SeveralFans(v)),
                Err(defect) => found(defect),
            }
        }
    }

    fn is_permutation(&self) -> bool {
        let mut reached = vec![0_u64; self.domain_len(Domain::Corner).div_ceil(64)];
        self.half_edges().all(|h| {
            let next = self.next(h).index();
            let (word, bit) = (&mut reached[next / 64], 1 << (next % 64));
            let is_new = *word & bit == 0;
            *word |= bit;
            is_new
        })
    }

    /// 5: the number of corners of a face, or one more than `most`.
    fn loop_of_face(&self, f: FaceId, most: usize) -> Result<usize, Defect> {
        let first = self.face_half_edge(f);
        if self.face(first) != Some(f) {
            return Err(Defect::FaceHalfEdge(f));
        }
        let mut h = self.next(first);
        let mut n = 1;
        while h != first && n <= most {
            h = self.next(h);
            n += 1;
        }
        if n < 3 {
            Err(Defect::FewCorners(f))
        } else {
            Ok(n)
        }
    }

    /// 6 and 7: the number of half-edges that leave a vertex, or one more than `most`.
    fn fan_of_vertex(&self, v: VertexId, most: usize) -> Result<usize, Defect> {
        let Some(first) = self.vertex_half_edge(v) else {
            return Ok(0);
        };
        if self.origin(first) != v {
            return Err(Defect::VertexHalfEdge(v));
        }
        let mut h = self.next(first.twin());
        let mut n = 1;
        while h != first && n <= most {
            // The one gap that there may be is where the vertex begins.
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

    /// 8.
    fn check_position(&self, v: VertexId, found: Found) {
        if !self.position(v).is_finite() {
            found(Defect::NotFinite(v));
        }
    }

    /// 9.
    fn check_columns(&self, found: Found) {
        for (domain, column) in self.attributes.iter() {
            if column.values.len() != self.domain_len(domain) {
                let name = column.name.clone();
                found(Defect::ColumnLength { domain, name });
            }
        }
    }
}

/// Tells of the entry of an element in an array, unless what it names is there.
#[inline]
fn check_entry(array: &'static str, element: impl Into<Element>, is_there: bool, found: Found) {
    if !is_there {
        let element = element.into();
        found(Defect::Dangling { array, element });
    }
}

/// Whether a check finds nothing.
fn is_silent(check: impl FnOnce(Found)) -> bool {
    let mut is_silent = true;
    check(&mut |_| is_silent = false);
    is_silent
}

fn numbers(n: usize) -> impl IndexedParallelIterator<Item = usize> {
    (0..n).into_par_iter().with_min_len(BLOCK)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Column, Rule, Values, shapes};
    use glam::DVec3;

    /// The defects of a grid of 2 x 2 squares in which `corrupt` changed one thing.
    fn after(corrupt: impl FnOnce(&mut Mesh)) -> Vec<Defect> {
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
            after(|m| assert!(m.connectivity.origin.pop().is_some())),
            [Defect::Length("origin")]
        );
        assert_eq!(
            after(|m| assert!(m.connectivity.face.pop().is_some())),
            [Defect::Length("face")]
        );
        assert_eq!(
            after(|m| assert!(m.positions.pop().is_some())),
            [Defect::Length("vertex_half_edge")]
        );
    }

    #[test]
    fn a_dangling_entry_is_named_with_its_element() {
        let dangling = |array, element: Element| Defect::Dangling { array, element };
        assert_eq!(
            after(|m| m.set_next(h(3), h(999))),
            [dangling("next", h(3).into())]
        );
        let far = VertexId::new(99);
        assert_eq!(
            after(|m| m.set_origin(h(5), far)),
            [dangling("origin", h(5).into())]
        );
        let far = Some(FaceId::new(99));
        assert_eq!(
            after(|m| m.set_face(h(4), far)),
            [dangling("face", h(4).into())]
        );
        let v = VertexId::new(2);
        let found = after(|m| m.set_vertex_half_edge(v, Some(h(999))));
        assert_eq!(found, [dangling("vertex_half_edge", v.into())]);
        let found = after(|m| m.set_face_half_edge(FaceId::new(1), h(999)));
        assert_eq!(found, [dangling("face_half_edge", FaceId::new(1).into())]);
    }

    #[test]
    fn a_next_that_is_no_permutation_is_found() {
        let found = after(|m| m.set_next(h(0), m.next(h(2))));
        assert!(
            found.contains(&Defect::NextNotPermutation(h(2))),
            "{found:?}"
        );
    }

    #[test]
    fn a_next_on_another_face_is_found() {
        let mesh = shapes::grid(2, 2);
        let inner = mesh
            .half_edges()
            .find(|&h| !mesh.is_boundary_edge(h.edge()))
            .unwrap();
        let found = after(|m| m.set_face(inner, Some(FaceId::new(3))));
        assert!(found.contains(&Defect::NextOnOtherFace(inner)), "{found:?}");
    }

    #[test]
    fn a_next_that_does_not_begin_where_the_half_edge_ends_is_found() {
        let found = after(|m| m.set_origin(m.next(h(0)), VertexId::new(8)));
        assert!(found.contains(&Defect::NextNotConnected(h(0))), "{found:?}");
    }

    #[test]
    fn an_edge_from_a_vertex_to_itself_is_found() {
        let found = after(|m| m.set_origin(h(1), m.origin(h(0))));
        assert!(
            found.contains(&Defect::SelfLoop(EdgeId::new(0))),
            "{found:?}"
        );
    }

    #[test]
    fn an_edge_without_faces_is_found() {
        let mesh = shapes::grid(2, 2);
        let rim = mesh.half_edges().find(|&h| mesh.face(h).is_none()).unwrap();
        let found = after(|m| m.set_face(rim.twin(), None));
        assert!(found.contains(&Defect::NoFace(rim.edge())), "{found:?}");
    }

    #[test]
    fn a_face_of_two_corners_is_found() {
        // Two half-edges that follow each other on one face: a lens.
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
    fn a_face_whose_half_edge_lies_elsewhere_is_found() {
        let f = FaceId::new(1);
        let found = after(|m| m.set_face_half_edge(f, m.face_half_edge(FaceId::new(0))));
        assert_eq!(found, [Defect::FaceHalfEdge(f)]);
    }

    #[test]
    fn a_vertex_whose_half_edge_leaves_another_is_found() {
        let v = VertexId::new(4);
        let other = after(|m| {
            let h = m.vertex_half_edge(v).unwrap();
            m.set_vertex_half_edge(v, Some(h.twin()));
        });
        assert_eq!(other, [Defect::VertexHalfEdge(v)]);
        assert_eq!(
            after(|m| m.set_vertex_half_edge(v, None)),
            [Defect::VertexHalfEdge(v)]
        );
    }

    #[test]
    fn a_boundary_vertex_that_does_not_begin_on_the_boundary_is_found() {
        let v = VertexId::new(1);
        let found = after(|m| {
            let inner = m.vertex_half_edges(v).nth(1).unwrap();
            m.set_vertex_half_edge(v, Some(inner));
        });
        assert_eq!(found, [Defect::NotBoundaryFirst(v)]);
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
        let leaving: Vec<_> = mesh.vertex_half_edges(VertexId::new(3)).collect();
        for h in leaving {
            mesh.set_origin(h, v);
        }
        mesh.set_vertex_half_edge(VertexId::new(3), None);
        assert_eq!(mesh.defects(), [Defect::SeveralFans(v)]);
    }

    #[test]
    fn a_vertex_between_two_fans_that_are_linked_is_found() {
        // The middle of a 2 x 2 grid without two faces that lie across from each other.
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
    fn a_position_that_is_no_number_is_found() {
        let v = VertexId::new(7);
        assert_eq!(
            after(|m| m.positions[7].z = f64::NAN),
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
        let found = after(|m| m.attributes.insert(Domain::Face, column));
        assert_eq!(
            found,
            [Defect::ColumnLength {
                domain: Domain::Face,
                name: "w".into()
            }]
        );
    }
}
