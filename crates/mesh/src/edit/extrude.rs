//! Moving faces out of the surface, with side faces between the old place and the new.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;

use super::{check_finite, sorted_unique};
use crate::{EditError, FaceId, HalfEdgeId, Mesh, VertexId};

impl Mesh {
    /// Moves faces by `offset` and joins them to their old place by side faces. Faces that share an
    /// edge move together.
    ///
    /// ```text
    ///                                  w'------ v'
    ///                                 /   f   / |          f has moved, v and w stayed
    ///        w ------- v             +------ +  v          h, which was on f, runs from v to w still
    ///       /    f    /     -->      |   s   | /           and lies on a side face (v, w, w', v')
    ///      +-------- +               +------ +
    /// ```
    ///
    /// The rim are the half-edges h of the faces whose other side has no face of them: one without a face
    /// counts too. V, E and F grow by n, 2n and n, the number of half-edges of the rim.
    ///
    /// **Ids.** The faces keep theirs and the order of their corners, so that the same ones can be moved
    /// again; so do the edges and vertices inside of them. The vertices and edges of the rim stay where
    /// they were, with the rest of the mesh: there the moved faces get new ones. New are, for each h in
    /// order of `faces` and counter-clockwise from their first half-edge: the vertex v', then the edges
    /// v'-w' and v-v' (those of the first h before those of the second), and the side face, which begins
    /// with h.
    ///
    /// Where only a vertex joins the faces, each fan of them gets its own copy of it. A sheet with all its
    /// faces becomes a box that is open where the sheet was. Of a closed part with all its faces there is
    /// no rim: it only moves. Two edges of the rim that join the same two vertices have two that do so in
    /// the new place.
    ///
    /// **Attributes.** New vertices and the new edges of the rim have the values of the old ones, edges
    /// along the sides zero values. A side face has the values of the face that it came from, and at both
    /// of its corners over v those that f had there, so that there is no seam between top and side.
    /// Normals stay as they are.
    ///
    /// Returns the side faces, in order of the rim.
    ///
    /// # Errors
    ///
    /// [`EditError::NoElements`] if no face is given, [`EditError::FaceListedTwice`], [`EditError::NoSuchFace`],
    /// [`EditError::BadNumber`] if a moved coordinate would not be finite, [`EditError::Full`]. The mesh
    /// is unchanged.
    ///
    /// # Examples
    ///
    /// ```
    /// use geometry::shapes;
    /// use mesh::{DVec3, FaceId};
    ///
    /// let mut mesh = shapes::cube();
    /// let top = FaceId::new(1);
    /// let sides = mesh.extrude_faces(&[top], DVec3::Z)?;
    /// assert_eq!(sides.len(), 4);
    /// assert_eq!(mesh.face_center(top), DVec3::new(0.0, 0.0, 2.0));
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    pub fn extrude_faces(
        &mut self,
        faces: &[FaceId],
        offset: DVec3,
    ) -> Result<Vec<FaceId>, EditError> {
        let rim = Rim::of(self, faces)?;
        self.check_room(4 * rim.bases.len())?;
        let corners = rim.half_edges.iter().map(|&h| self.origin(h));
        let places: Vec<DVec3> = corners.map(|v| self.position(v) + offset).collect();
        check_finite(&places)?;

        let sides = self.raise(&rim);
        for v in sorted_unique(faces.iter().flat_map(|&f| self.face_vertices(f))) {
            self.set_position(v, self.position(v) + offset);
        }
        Ok(sides)
    }

    /// Takes faces off the mesh along their rim and puts side faces between, without moving anything.
    pub(super) fn raise(&mut self, rim: &Rim) -> Vec<FaceId> {
        self.drop_columns_by_rule();
        let bases = rim.bases.iter();
        let raised: Vec<VertexId> = bases
            .map(|&h| self.push_copy_of_vertex(self.origin(h)))
            .collect();
        let mut edges = Vec::with_capacity(rim.bases.len());
        for (i, &h) in rim.bases.iter().enumerate() {
            let top = self.push_edge(raised[i], raised[rim.after[i]]);
            let upright = self.push_edge(self.origin(h), raised[i]);
            edges.push((top.half_edges(), upright.half_edges()));
        }

        // Values first, while each face still has all its corners.
        let mut sides = Vec::with_capacity(rim.bases.len());
        for (i, &h) in rim.bases.iter().enumerate() {
            let ([top, top_back], [_, down]) = edges[i];
            let (_, [up, _]) = edges[rim.after[i]];
            let (f, far) = (self.face(h).expect("on a face"), self.next(h));
            self.copy_values(h.edge(), top.edge());
            for copy in [top, down] {
                self.copy_values(h, copy);
            }
            for copy in [up, top_back] {
                self.copy_values(far, copy);
            }
            self.set_face(top, Some(f));
            self.replace_first_of_face(h, top);
            sides.push(self.push_copy_of_face(f, h));
        }

        // The faces turn to their new edges and vertices.
        let in_new_place = |h| rim.place.get(&h).map_or(h, |&i| edges[i].0[0]);
        let links: Vec<_> = rim
            .half_edges
            .iter()
            .map(|&h| (in_new_place(h), in_new_place(self.next(h))))
            .collect();
        for (h, next) in links {
            self.set_next(h, next);
        }
        for &(h, i) in &rim.inner {
            self.set_origin(h, raised[i]);
        }
        for (i, &h) in rim.bases.iter().enumerate() {
            let ([top, top_back], [_, down]) = edges[i];
            let (_, [up, _]) = edges[rim.after[i]];
            self.link_around(sides[i], &[h, up, top_back, down]);
            self.set_vertex_half_edge(raised[i], Some(top));
            let v = self.origin(h);
            if !self.is_boundary_vertex(v) {
                self.set_vertex_half_edge(v, Some(h));
            }
        }
        sides
    }
}

/// The half-edges of some faces, and which of them are the rim.
pub(super) struct Rim {
    /// All half-edges of the faces, in order.
    half_edges: Vec<HalfEdgeId>,
    /// Those whose other side has no face of them.
    pub(super) bases: Vec<HalfEdgeId>,
    /// The places in `bases`.
    place: BTreeMap<HalfEdgeId, usize>,
    /// For each base the place of the one that leaves its target in the same fan of the faces.
    after: Vec<usize>,
    /// The half-edges that leave the rim inwards, and the place of the base that leaves the same vertex
    /// in the same fan.
    inner: Vec<(HalfEdgeId, usize)>,
}

impl Rim {
    pub(super) fn of(mesh: &Mesh, faces: &[FaceId]) -> Result<Self, EditError> {
        if faces.is_empty() {
            return Err(EditError::NoElements);
        }
        let mut region = BTreeSet::new();
        for &f in faces {
            mesh.check_face(f)?;
            if !region.insert(f) {
                return Err(EditError::FaceListedTwice(f));
            }
        }
        let is_base = |h: &HalfEdgeId| mesh.face(h.twin()).is_none_or(|f| !region.contains(&f));
        let half_edges: Vec<_> = faces
            .iter()
            .flat_map(|&f| mesh.face_half_edges(f))
            .collect();
        let bases: Vec<_> = half_edges.iter().copied().filter(is_base).collect();
        let place: BTreeMap<_, _> = bases.iter().copied().zip(0..).collect();

        let mut after = Vec::with_capacity(bases.len());
        let mut inner = Vec::new();
        for &h in &bases {
            // Clockwise around the target of h: a fan that begins at the rim ends there.
            let first = inner.len();
            let mut leaving = mesh.next(h);
            let i = loop {
                if let Some(&i) = place.get(&leaving) {
                    break i;
                }
                inner.push((leaving, usize::MAX));
                leaving = mesh.next(leaving.twin());
            };
            inner[first..].iter_mut().for_each(|(_, place)| *place = i);
            after.push(i);
        }
        Ok(Self {
            half_edges,
            bases,
            place,
            after,
            inner,
        })
    }
}

#[cfg(test)]
pub(super) mod tests;
