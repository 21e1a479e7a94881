//! The invariants of a mesh, as a function: every broken one, with its element.

use std::fmt;

use crate::{Domain, EdgeId, FaceId, HalfEdgeId, Mesh, VertexId};

/// A broken invariant. The words are those of the crate's front page, in the same order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Defect {
    /// An array has not one entry for each element.
    Length(&'static str),
    /// An entry of an array names an element that does not exist or is dead.
    Dangling {
        /// The array.
        array: &'static str,
        /// The element whose entry it is.
        element: String,
    },
    /// `next` leads here from no half-edge, or from several.
    NextNotPermutation(HalfEdgeId),
    /// `next` leads to another face.
    NextOnOtherFace(HalfEdgeId),
    /// The origin of the next half-edge is not the target of this one.
    NextNotConnected(HalfEdgeId),
    /// An edge begins and ends at one vertex.
    SelfLoop(EdgeId),
    /// An edge has no face on either side.
    NoFace(EdgeId),
    /// A face has fewer than three corners.
    FewCorners(FaceId),
    /// The half-edge of a face lies on another one, or the face's half-edges form several loops.
    FaceHalfEdge(FaceId),
    /// The half-edge of a vertex leaves another one, or the vertex is used and has none.
    VertexHalfEdge(VertexId),
    /// The half-edge of a boundary vertex is not the boundary one.
    NotBoundaryFirst(VertexId),
    /// The half-edges that leave a vertex are not all reached by walking around it, or there is more than
    /// one gap on the way.
    SeveralFans(VertexId),
    /// A position is infinite or not a number.
    NotFinite(VertexId),
    /// A column has not one value for each element of its domain.
    ColumnLength {
        /// The domain.
        domain: Domain,
        /// The name of the column.
        name: String,
    },
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length(array) => write!(f, "{array} has the wrong length"),
            Self::Dangling { array, element } => {
                write!(f, "{array} of {element} names an element that is not there")
            }
            Self::NextNotPermutation(h) => {
                write!(f, "{h} is not the next of exactly one half-edge")
            }
            Self::NextOnOtherFace(h) => write!(f, "the next of {h} lies on another face"),
            Self::NextNotConnected(h) => write!(f, "the next of {h} does not begin where {h} ends"),
            Self::SelfLoop(e) => write!(f, "{e} begins and ends at one vertex"),
            Self::NoFace(e) => write!(f, "{e} has no face on either side"),
            Self::FewCorners(face) => write!(f, "{face} has fewer than three corners"),
            Self::FaceHalfEdge(face) => write!(f, "the half-edges of {face} are not one loop"),
            Self::VertexHalfEdge(v) => write!(f, "the half-edge of {v} does not leave it"),
            Self::NotBoundaryFirst(v) => write!(f, "the half-edge of {v} is not the boundary one"),
            Self::SeveralFans(v) => write!(f, "the faces around {v} are not one fan"),
            Self::NotFinite(v) => write!(f, "the position of {v} is not finite"),
            Self::ColumnLength { domain, name } => {
                write!(f, "the {domain} attribute {name} has the wrong length")
            }
        }
    }
}

impl Mesh {
    /// Every broken invariant with its element; empty for a valid mesh. Never panics, whatever the
    /// arrays hold. Takes time in proportion to the size of the mesh.
    ///
    /// Where entries dangle, only these are listed: the other invariants have no meaning then.
    pub fn defects(&self) -> Vec<Defect> {
        let mut defects = self.wrong_lengths();
        if defects.is_empty() {
            defects = self.dangling();
        }
        if defects.is_empty() {
            self.check_half_edges(&mut defects);
            self.check_faces(&mut defects);
            self.check_vertices(&mut defects);
        }
        let wrong = self
            .attributes
            .iter()
            .filter(|(d, c)| c.values.len() != self.domain_len(*d));
        defects.extend(wrong.map(|(domain, c)| Defect::ColumnLength {
            domain,
            name: c.name.clone(),
        }));
        defects
    }

    fn wrong_lengths(&self) -> Vec<Defect> {
        let c = &self.connectivity;
        [
            ("next", c.next.len().is_multiple_of(2)),
            ("origin", c.origin.len() == c.next.len()),
            ("face", c.face.len() == c.next.len()),
            (
                "vertex_half_edge",
                c.vertex_half_edge.len() == self.positions.len(),
            ),
        ]
        .into_iter()
        .filter(|(_, right)| !right)
        .map(|(array, _)| Defect::Length(array))
        .collect()
    }

    fn dangling(&self) -> Vec<Defect> {
        let mut defects = Vec::new();
        let mut ask = |array, element: &dyn fmt::Display, fine: bool| {
            if !fine {
                defects.push(Defect::Dangling {
                    array,
                    element: element.to_string(),
                });
            }
        };
        let has = |h: HalfEdgeId| self.has_edge(h.edge());
        for h in self.half_edges() {
            ask("next", &h, has(self.next(h)));
            ask("origin", &h, self.has_vertex(self.origin(h)));
            ask("face", &h, self.face(h).is_none_or(|f| self.has_face(f)));
        }
        for v in self.vertices() {
            ask(
                "vertex_half_edge",
                &v,
                self.vertex_half_edge(v).is_none_or(has),
            );
        }
        for f in self.faces() {
            ask("face_half_edge", &f, has(self.face_half_edge(f)));
        }
        defects
    }

    fn check_half_edges(&self, defects: &mut Vec<Defect>) {
        let mut reached = vec![0_u8; self.connectivity.next.len()];
        for h in self.half_edges() {
            let times = &mut reached[self.next(h).index()];
            *times = times.saturating_add(1);
        }
        for h in self.half_edges() {
            if reached[h.index()] != 1 {
                defects.push(Defect::NextNotPermutation(h));
            }
            if self.face(self.next(h)) != self.face(h) {
                defects.push(Defect::NextOnOtherFace(h));
            }
            if self.origin(self.next(h)) != self.target(h) {
                defects.push(Defect::NextNotConnected(h));
            }
        }
        for e in self.edges() {
            let [h, twin] = e.half_edges();
            if self.origin(h) == self.origin(twin) {
                defects.push(Defect::SelfLoop(e));
            }
            if self.face(h).is_none() && self.face(twin).is_none() {
                defects.push(Defect::NoFace(e));
            }
        }
    }

    fn check_faces(&self, defects: &mut Vec<Defect>) {
        let mut corners = vec![0_usize; self.connectivity.face_half_edge.len()];
        for f in self.half_edges().filter_map(|h| self.face(h)) {
            corners[f.index()] += 1;
        }
        for f in self.faces() {
            let first = self.face_half_edge(f);
            let mut h = first;
            let mut steps = 0;
            while self.face(h) == Some(f)
                && steps < corners[f.index()]
                && (steps == 0 || h != first)
            {
                h = self.next(h);
                steps += 1;
            }
            if h != first || steps != corners[f.index()] {
                defects.push(Defect::FaceHalfEdge(f));
            } else if steps < 3 {
                defects.push(Defect::FewCorners(f));
            }
        }
    }

    fn check_vertices(&self, defects: &mut Vec<Defect>) {
        let mut leaving = vec![0_usize; self.positions.len()];
        let mut gaps = vec![0_usize; self.positions.len()];
        for h in self.half_edges() {
            leaving[self.origin(h).index()] += 1;
            gaps[self.origin(h).index()] += usize::from(self.face(h).is_none());
        }
        for v in self.vertices() {
            if !self.position(v).is_finite() {
                defects.push(Defect::NotFinite(v));
            }
            let n = leaving[v.index()];
            let Some(first) = self.vertex_half_edge(v) else {
                if n > 0 {
                    defects.push(Defect::VertexHalfEdge(v));
                }
                continue;
            };
            if self.origin(first) != v {
                defects.push(Defect::VertexHalfEdge(v));
                continue;
            }
            if gaps[v.index()] > 0 && self.face(first).is_some() {
                defects.push(Defect::NotBoundaryFirst(v));
            }
            let mut h = first;
            let mut steps = 0;
            while steps < n && (steps == 0 || h != first) {
                h = self.next(h.twin());
                steps += 1;
            }
            // A walk around the vertex passes over gaps, so fans that are linked are seen by their number.
            if h != first || steps != n || gaps[v.index()] > 1 {
                defects.push(Defect::SeveralFans(v));
            }
        }
    }
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
        let dangling = |array, element: &str| Defect::Dangling {
            array,
            element: element.into(),
        };
        assert_eq!(
            after(|m| m.set_next(h(3), h(999))),
            [dangling("next", "h3")]
        );
        let far = VertexId::new(99);
        assert_eq!(
            after(|m| m.set_origin(h(5), far)),
            [dangling("origin", "h5")]
        );
        let far = Some(FaceId::new(99));
        assert_eq!(after(|m| m.set_face(h(4), far)), [dangling("face", "h4")]);
        let v = VertexId::new(2);
        let found = after(|m| m.set_vertex_half_edge(v, Some(h(999))));
        assert_eq!(found, [dangling("vertex_half_edge", "v2")]);
        let found = after(|m| m.set_face_half_edge(FaceId::new(1), h(999)));
        assert_eq!(found, [dangling("face_half_edge", "f1")]);
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
            mesh.dead_faces.add(f.index());
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
