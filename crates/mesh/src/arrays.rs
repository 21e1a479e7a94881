//! Defines the mesh, with its arrays, its elements, and the functions that read them.

use glam::DVec3;

use crate::attribute::{
    Attribute, Attributes, CORNER_NORMAL, CORNER_TANGENT, Column, TANGENT, VERTEX_NORMAL, Value,
    Values, is_morph_direction,
};
use crate::journal::{Entry, Journal};
use crate::marks::Marks;
use crate::{Domain, EdgeId, FaceId, HalfEdgeId, Id, VertexId, parallel};

/// The five arrays that store how the elements of a mesh are connected. The crate's documentation lists the
/// invariants of these arrays.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Connectivity {
    /// For each half-edge, the half-edge that follows it around its face, or around its hole.
    pub next: Vec<HalfEdgeId>,
    /// For each half-edge, the vertex that it leaves.
    pub origin: Vec<VertexId>,
    /// For each half-edge, its face; [`FaceId::NONE`] on the boundary.
    pub face: Vec<FaceId>,
    /// For each vertex, one of its outgoing half-edges. At a boundary vertex, the entry is an outgoing half-edge
    /// without a face. For an isolated vertex, the entry is [`HalfEdgeId::NONE`].
    pub vertex_half_edge: Vec<HalfEdgeId>,
    /// For each face, one of its half-edges.
    pub face_half_edge: Vec<HalfEdgeId>,
}

impl Clone for Connectivity {
    fn clone(&self) -> Self {
        Self {
            next: parallel::copied(&self.next),
            origin: parallel::copied(&self.origin),
            face: parallel::copied(&self.face),
            vertex_half_edge: parallel::copied(&self.vertex_half_edge),
            face_half_edge: parallel::copied(&self.face_half_edge),
        }
    }
}

impl Connectivity {
    /// Appends the elements of `other`. The ids of these elements are increased by the number of elements of the same
    /// kind in `self`.
    pub fn append(&mut self, other: &Self) {
        fn push<I: Id + PartialEq>(all: &mut Vec<I>, more: &[I], by: usize) {
            let shifted = |&id: &I| {
                if id == I::NONE {
                    id
                } else {
                    I::new(id.index() + by)
                }
            };
            all.extend(more.iter().map(shifted));
        }
        let (h, v, f) = (
            self.next.len(),
            self.vertex_half_edge.len(),
            self.face_half_edge.len(),
        );
        push(&mut self.next, &other.next, h);
        push(&mut self.origin, &other.origin, v);
        push(&mut self.face, &other.face, f);
        push(&mut self.vertex_half_edge, &other.vertex_half_edge, h);
        push(&mut self.face_half_edge, &other.face_half_edge, h);
    }
}

/// A half-edge mesh of polygons in space, with attributes.
///
/// A removed element is dead: it is marked, but its entries stay in the arrays. Two meshes are equal if all their
/// arrays are equal, including the entries of dead elements. A clone has no open journal (the record with which edits
/// are undone). Edits of the clone are not recorded until [`Mesh::begin`] is called on the clone.
#[derive(Debug, Default)]
pub struct Mesh {
    pub(crate) connectivity: Connectivity,
    pub(crate) positions: Vec<DVec3>,
    pub(crate) attributes: Attributes,
    /// The dead (removed) elements of each domain. Corners are never marked: a corner is dead if its edge is dead.
    pub(crate) dead: [Marks; 4],
    /// The journal: the values that edits have overwritten since [`Mesh::begin`]. `None` if no journal is open.
    pub(crate) journal: Option<Box<Journal>>,
}

impl Clone for Mesh {
    fn clone(&self) -> Self {
        Self {
            connectivity: self.connectivity.clone(),
            positions: parallel::copied(&self.positions),
            attributes: self.attributes.clone(),
            dead: self.dead.clone(),
            journal: None,
        }
    }
}

impl PartialEq for Mesh {
    fn eq(&self, other: &Self) -> bool {
        self.connectivity == other.connectivity
            && self.positions == other.positions
            && self.attributes == other.attributes
            && self.dead == other.dead
    }
}

impl Mesh {
    /// Creates a mesh from these arrays, without attributes. No element is marked as deleted.
    ///
    /// Use this function in operations that compute the arrays of a whole mesh themselves. This function does not check
    /// the [invariants](crate#invariants): the caller must ensure that the arrays satisfy them.
    /// [`try_from_arrays`](Self::try_from_arrays) also checks the invariants.
    ///
    /// # Panics
    ///
    /// Panics if two arrays for the same kind of element have different lengths, or if the number of half-edges is odd.
    /// Also panics if the mesh has too many elements for 32-bit ids.
    pub fn from_arrays(connectivity: Connectivity, positions: Vec<DVec3>) -> Self {
        let mesh = Self {
            connectivity,
            positions,
            ..Self::default()
        };
        mesh.check_lengths(&mut |defect| panic!("{defect}"));
        mesh
    }

    /// Returns the arrays of the connectivity. The arrays include deleted (dead) elements unless the mesh [is
    /// dense](Self::is_dense).
    #[inline]
    pub fn connectivity(&self) -> &Connectivity {
        &self.connectivity
    }

    // ---- Counts and elements -------------------------------------------------------------------

    /// Returns the number of vertices, not counting deleted (dead) ones.
    pub fn n_vertices(&self) -> usize {
        self.n_living(Domain::Vertex)
    }

    /// Returns the number of half-edges, not counting deleted (dead) ones: two for each edge.
    pub fn n_half_edges(&self) -> usize {
        2 * self.n_edges()
    }

    /// Returns the number of edges, not counting deleted (dead) ones.
    pub fn n_edges(&self) -> usize {
        self.n_living(Domain::Edge)
    }

    /// Returns the number of faces, not counting deleted (dead) ones.
    pub fn n_faces(&self) -> usize {
        self.n_living(Domain::Face)
    }

    /// Returns the number of elements of this domain, including deleted (dead) ones. Each attribute column of the
    /// domain has this number of values.
    #[inline]
    pub fn domain_len(&self, domain: Domain) -> usize {
        match domain {
            Domain::Vertex => self.positions.len(),
            Domain::Corner => self.connectivity.next.len(),
            Domain::Edge => self.connectivity.next.len() / 2,
            Domain::Face => self.connectivity.face_half_edge.len(),
        }
    }

    /// Whether the mesh has no deleted (dead) elements. If it has none, the ids run from 0 without gaps.
    #[inline]
    pub fn is_dense(&self) -> bool {
        self.dead.iter().all(|marks| marks.count() == 0)
    }

    /// Iterates over the vertices that were not deleted, in order of their ids.
    #[inline]
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + Clone + '_ {
        self.living()
    }

    /// Iterates over the edges that were not deleted, in order of their ids.
    #[inline]
    pub fn edges(&self) -> impl Iterator<Item = EdgeId> + Clone + '_ {
        self.living()
    }

    /// Iterates over the half-edges that were not deleted, in order of their ids.
    #[inline]
    pub fn half_edges(&self) -> impl Iterator<Item = HalfEdgeId> + Clone + '_ {
        self.edges().flat_map(EdgeId::half_edges)
    }

    /// Iterates over the faces that were not deleted, in order of their ids.
    #[inline]
    pub fn faces(&self) -> impl Iterator<Item = FaceId> + Clone + '_ {
        self.living()
    }

    #[inline]
    fn n_living(&self, domain: Domain) -> usize {
        self.domain_len(domain) - self.dead[domain as usize].count()
    }

    #[inline]
    pub(crate) fn is_living<I: Id>(&self, id: I) -> bool {
        id.index() < self.domain_len(I::DOMAIN) && !self.dead[I::DOMAIN as usize].has(id.index())
    }

    #[inline]
    fn living<I: Id>(&self) -> impl Iterator<Item = I> + Clone + '_ {
        let dead = &self.dead[I::DOMAIN as usize];
        (0..self.domain_len(I::DOMAIN))
            .filter(|&i| !dead.has(i))
            .map(I::new)
    }

    /// Whether the vertex `v` exists in this mesh and was not deleted.
    #[inline]
    pub fn has_vertex(&self, v: VertexId) -> bool {
        self.is_living(v)
    }

    /// Whether the edge `e` exists in this mesh and was not deleted.
    #[inline]
    pub fn has_edge(&self, e: EdgeId) -> bool {
        self.is_living(e)
    }

    /// Whether the face `f` exists in this mesh and was not deleted.
    #[inline]
    pub fn has_face(&self, f: FaceId) -> bool {
        self.is_living(f)
    }

    // ---- Reading the arrays --------------------------------------------------------------------

    /// Returns the half-edge that follows `h` around the face of `h`, or around a hole if `h` has no face.
    #[inline]
    pub fn next(&self, h: HalfEdgeId) -> HalfEdgeId {
        self.connectivity.next[h.index()]
    }

    /// Returns the vertex that `h` leaves.
    #[inline]
    pub fn origin(&self, h: HalfEdgeId) -> VertexId {
        self.connectivity.origin[h.index()]
    }

    /// Returns the vertex at which `h` ends.
    #[inline]
    pub fn target(&self, h: HalfEdgeId) -> VertexId {
        self.origin(h.twin())
    }

    /// Returns the face of `h`, which is to its left; `None` on the boundary.
    #[inline]
    pub fn face(&self, h: HalfEdgeId) -> Option<FaceId> {
        self.connectivity.face[h.index()].some()
    }

    /// Returns an outgoing half-edge of `v`. If `v` is on the boundary, returns the outgoing half-edge that has no
    /// face. Returns `None` if `v` is isolated.
    #[inline]
    pub fn vertex_half_edge(&self, v: VertexId) -> Option<HalfEdgeId> {
        self.connectivity.vertex_half_edge[v.index()].some()
    }

    /// Returns the half-edge of `f` that leaves the first corner of `f`.
    #[inline]
    pub fn face_half_edge(&self, f: FaceId) -> HalfEdgeId {
        self.connectivity.face_half_edge[f.index()]
    }

    /// Returns the position of `v`, in scene units.
    #[inline]
    pub fn position(&self, v: VertexId) -> DVec3 {
        self.positions[v.index()]
    }

    /// Returns the positions of all vertices, including deleted (dead) ones. Entry i is the position of the vertex with
    /// index i.
    #[inline]
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Returns the positions of all vertices mutably. If a [journal](Self::begin) is open, all positions are
    /// first copied to it. To move a single vertex, use [`set_position`](Self::set_position).
    pub fn positions_mut(&mut self) -> &mut [DVec3] {
        if let Some(journal) = &mut self.journal {
            journal.record(|| Entry::Positions(self.positions.clone().into()));
        }
        &mut self.positions
    }

    /// Sets the position of `v`.
    pub fn set_position(&mut self, v: VertexId, position: DVec3) {
        let old = std::mem::replace(&mut self.positions[v.index()], position);
        if let Some(journal) = &mut self.journal {
            journal.record_position(v, old);
        }
    }

    // ---- Attributes ----------------------------------------------------------------------------

    /// Returns all attributes of the mesh.
    pub fn attributes(&self) -> &Attributes {
        &self.attributes
    }

    /// Replaces all attributes of the mesh.
    ///
    /// # Panics
    ///
    /// Panics if the length of a column is not the number of elements of its domain (vertices, corners, edges or
    /// faces).
    pub fn set_attributes(&mut self, attributes: Attributes) {
        for (domain, column) in attributes.iter() {
            self.assert_length(domain, column);
        }
        let old = std::mem::replace(&mut self.attributes, attributes);
        if let Some(journal) = &mut self.journal {
            journal.record(|| Entry::Attributes(old.into()));
        }
    }

    /// Returns the values of an attribute, indexed by element; `None` if the mesh has no attribute with this name,
    /// domain and type.
    pub fn get<I: Id, T: Value>(&self, attribute: Attribute<I, T>) -> Option<&[T]> {
        self.attributes
            .column(I::DOMAIN, attribute.name)
            .and_then(|c| T::of(&c.values))
    }

    /// Returns the values of an attribute mutably; `None` if the mesh has no attribute with this name, domain and
    /// type. If a [journal](Self::begin) is open, all values are first copied to it.
    pub fn get_mut<I: Id, T: Value>(&mut self, attribute: Attribute<I, T>) -> Option<&mut [T]> {
        let column = self.attributes.column_mut(I::DOMAIN, attribute.name)?;
        if let Some(journal) = &mut self.journal {
            journal.record(|| Entry::Column(I::DOMAIN, column.clone().into()));
        }
        T::of_mut(&mut column.values)
    }

    /// Sets an attribute of the mesh. An existing attribute with the same name and domain is replaced.
    ///
    /// # Panics
    ///
    /// Panics if the number of values is not the number of elements of the domain.
    pub fn set<I: Id, T: Value>(&mut self, attribute: Attribute<I, T>, values: Vec<T>) {
        let name = attribute.name.to_owned();
        self.insert_column(
            I::DOMAIN,
            Column {
                name,
                rule: attribute.rule,
                values: T::wrap(values),
            },
        );
    }

    /// Inserts an attribute column. An existing column with the same name and domain is replaced.
    ///
    /// # Panics
    ///
    /// Panics if the number of values is not the number of elements of the domain.
    pub fn insert_column(&mut self, domain: Domain, column: Column) {
        self.assert_length(domain, &column);
        if let Some(journal) = &mut self.journal {
            journal.record(|| match self.attributes.column(domain, &column.name) {
                Some(old) => Entry::Column(domain, old.clone().into()),
                None => Entry::NoColumn(domain, column.name.clone().into()),
            });
        }
        self.attributes.insert(domain, column);
    }

    /// Removes a column and returns it; `None` if the domain has no column with this name.
    pub fn remove_column(&mut self, domain: Domain, name: &str) -> Option<Column> {
        let removed = self.attributes.remove(domain, name);
        if let (Some(journal), Some(column)) = (&mut self.journal, &removed) {
            journal.record(|| Entry::Column(domain, column.clone().into()));
        }
        removed
    }

    /// Removes the attributes that are wrong after the shape has changed: [`VERTEX_NORMAL`], [`CORNER_NORMAL`],
    /// [`TANGENT`], [`CORNER_TANGENT`], and the normals and tangents of morph targets ([`crate::morph_normal_name`],
    /// [`crate::morph_tangent_name`]).
    pub fn remove_normals(&mut self) {
        self.remove_column(Domain::Vertex, VERTEX_NORMAL.name);
        self.remove_column(Domain::Corner, CORNER_NORMAL.name);
        self.remove_column(Domain::Vertex, TANGENT.name);
        self.remove_column(Domain::Corner, CORNER_TANGENT.name);
        let columns = self.attributes.iter();
        let morphs = columns.filter(|(_, column)| is_morph_direction(&column.name));
        let morphs: Vec<_> = morphs.map(|(domain, c)| (domain, c.name.clone())).collect();
        for (domain, name) in morphs {
            self.remove_column(domain, &name);
        }
    }

    /// Returns the flags of a tag (a named selection), indexed by element; `None` if the mesh has no tag of this name
    /// in this domain.
    pub fn tag(&self, domain: Domain, name: &str) -> Option<&[bool]> {
        match &self.attributes.column(domain, name)?.values {
            Values::Tag(marks) => Some(marks),
            _ => None,
        }
    }

    fn assert_length(&self, domain: Domain, column: &Column) {
        assert_eq!(
            column.values.len(),
            self.domain_len(domain),
            "the attribute {} must have one value for each {domain}",
            column.name
        );
    }

    /// Returns the size of the connectivity, the positions and the attributes together, in bytes.
    pub fn bytes(&self) -> usize {
        let c = &self.connectivity;
        let attributes: usize = self.attributes.iter().map(|(_, c)| c.values.bytes()).sum();
        12 * c.next.len() + 4 * c.face_half_edge.len() + 28 * self.positions.len() + attributes
    }
}
