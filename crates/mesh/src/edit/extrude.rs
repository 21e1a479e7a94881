//! Extruding faces.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;

use super::{check_finite, sorted_unique};
use crate::{EditError, FaceId, HalfEdgeId, Mesh, VertexId};

impl Mesh {
    /// Extrudes faces: moves them by `offset` and connects them to their old boundary by side faces. Faces
    /// that share an edge move together.
    ///
    /// ```text
    ///                                  w'------ v'
    ///                                 /   f   / |          f has moved, v and w have not.
    ///        w ------- v             +------ +  v          h, which was on f, still runs from v to w,
    ///       /    f    /     -->      |   s   | /           and now lies on a side face (v, w, w', v')
    ///      +-------- +               +------ +
    /// ```
    ///
    /// The rim consists of the half-edges h of `faces` whose twin has no face, or has a face that is not listed in
    /// `faces`. If the rim has n half-edges, the numbers of vertices, edges and faces grow by n, 2n and n.
    ///
    /// **Ids.** The extruded faces keep their ids and the order of their corners. Therefore, the same faces can be
    /// extruded again. The edges and vertices inside the faces keep their ids too. The vertices and edges of the rim
    /// stay in place with the rest of the mesh, and the moved faces get new vertices and edges. The new elements are
    /// numbered in the order of the half-edges h: in order of `faces`, and counter-clockwise from the first half-edge
    /// of each face. Let h be a half-edge of the rim from v to w, and v' and w' the copies of v and w. For this h, the
    /// edit adds the vertex v', the edges v'-w' and v-v' in this order, and a side face, which stores h as its
    /// half-edge.
    ///
    /// If faces meet only at a vertex, each of their fans gets a separate copy of the vertex. If all faces of an open
    /// sheet are extruded, the sheet becomes a box without a bottom, because no face remains where the sheet was. If
    /// all faces of a closed component are extruded, there is no rim, and the component only moves. If two edges of the
    /// rim are parallel (they join the same two vertices), their copies are parallel too.
    ///
    /// **Attributes.** The copies of the vertices and edges of the rim have the values of the originals. The attribute
    /// values of the new edges that join a vertex v to its copy v' are zero. A side face has the values of the extruded
    /// face f that shares an edge with it. At v and v', the corners of the side face have the values of the old corner
    /// of f at v. Therefore, there is no seam between f and the side face. Normals do not change.
    ///
    /// Returns the side faces, in the order of the half-edges of the rim.
    ///
    /// # Errors
    ///
    /// Returns [`EditError::NoElements`] if `faces` is empty, and [`EditError::FaceListedTwice`] or
    /// [`EditError::NoSuchFace`] if a face is listed twice or does not exist. Returns [`EditError::BadNumber`] if a
    /// moved coordinate would not be finite, and [`EditError::Full`] if there are not enough ids for the new elements.
    /// After an error, the mesh is unchanged.
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

    /// Separates faces from the mesh along their rim and adds side faces in between, without changing
    /// positions.
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

        // Attribute values are copied before the faces are linked to the new edges, while each face still has its old
        // corners.
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

        // Link the faces to their new edges and vertices.
        let raised_half_edge = |h| rim.index_of_base.get(&h).map_or(h, |&i| edges[i].0[0]);
        let links: Vec<_> = rim
            .half_edges
            .iter()
            .map(|&h| (raised_half_edge(h), raised_half_edge(self.next(h))))
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

/// The half-edges of a set of faces, and their rim.
pub(super) struct Rim {
    /// The half-edges of all faces of the set, face by face.
    half_edges: Vec<HalfEdgeId>,
    /// The half-edges of the rim, in the order of `half_edges`. A half-edge of the rim is called a base, because a side
    /// face stands on it. The twin of a base has no face, or has a face outside of the set.
    pub(super) bases: Vec<HalfEdgeId>,
    /// For each base (a half-edge of the rim), its index in `bases`.
    index_of_base: BTreeMap<HalfEdgeId, usize>,
    /// For each base, the index of the base that starts where this base ends, in the same fan of faces.
    after: Vec<usize>,
    /// The half-edges that lead from a vertex of the rim into the set. Each entry also has the index, in `bases`, of
    /// the base that leaves the same vertex in the same fan of faces.
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
        let index_of_base: BTreeMap<_, _> = bases.iter().copied().zip(0..).collect();

        let mut after = Vec::with_capacity(bases.len());
        let mut inner = Vec::new();
        for &h in &bases {
            // Walks clockwise around the target of h. A fan that starts at the rim also ends at the rim.
            let first = inner.len();
            let mut outgoing = mesh.next(h);
            let i = loop {
                if let Some(&i) = index_of_base.get(&outgoing) {
                    break i;
                }
                inner.push((outgoing, usize::MAX));
                outgoing = mesh.next(outgoing.twin());
            };
            inner[first..].iter_mut().for_each(|(_, base)| *base = i);
            after.push(i);
        }
        Ok(Self {
            half_edges,
            bases,
            index_of_base,
            after,
            inner,
        })
    }
}

#[cfg(test)]
pub(super) mod tests;
