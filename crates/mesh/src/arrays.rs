//! The mesh: its arrays, its elements, and the accessors that read them.

use glam::DVec3;

use crate::attribute::{
    Attribute, Attributes, CORNER_NORMAL, Column, VERTEX_NORMAL, Value, Values,
};
use crate::journal::{Entry, Journal};
use crate::marks::Marks;
use crate::{Domain, EdgeId, FaceId, HalfEdgeId, Id, VertexId};

/// The five arrays that say how the elements of a mesh hang together. The crate's front page lists
/// what holds for them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Connectivity {
    /// For each half-edge the one that follows it around its face, or around its hole.
    pub next: Vec<HalfEdgeId>,
    /// For each half-edge the vertex that it leaves.
    pub origin: Vec<VertexId>,
    /// For each half-edge its face; [`FaceId::NONE`] on the boundary.
    pub face: Vec<FaceId>,
    /// For each vertex a half-edge that leaves it, the boundary one if there is one;
    /// [`HalfEdgeId::NONE`] for an isolated vertex.
    pub vertex_half_edge: Vec<HalfEdgeId>,
    /// For each face one of its half-edges.
    pub face_half_edge: Vec<HalfEdgeId>,
}

impl Connectivity {
    /// Puts the elements of `other` behind these: their ids are shifted by the counts of these.
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
/// Meshes are equal if all their arrays are, dead elements included.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub(crate) connectivity: Connectivity,
    pub(crate) positions: Vec<DVec3>,
    pub(crate) attributes: Attributes,
    /// The dead elements by domain. A corner lives with its edge and has no mark.
    pub(crate) dead: [Marks; 4],
    /// What the edits since [`Mesh::begin`] overwrote, while that is open.
    pub(crate) journal: Option<Box<Journal>>,
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
    /// A mesh of these arrays, without attributes, all elements living.
    ///
    /// For operations that compute a whole mesh in closed form. The invariants are the caller's duty:
    /// [`try_from_arrays`](Self::try_from_arrays) checks them.
    ///
    /// # Panics
    ///
    /// If arrays that belong together differ in length, the number of half-edges is odd, or there are more
    /// elements than ids.
    pub fn from_arrays(connectivity: Connectivity, positions: Vec<DVec3>) -> Self {
        let mesh = Self {
            connectivity,
            positions,
            ..Self::default()
        };
        mesh.check_lengths(&mut |defect| panic!("{defect}"));
        mesh
    }

    /// The arrays of the connectivity. Dead elements are still in them unless the mesh
    /// [is dense](Self::is_dense).
    #[inline]
    pub fn connectivity(&self) -> &Connectivity {
        &self.connectivity
    }

    // ---- Counts and elements -------------------------------------------------------------------

    /// The number of living vertices.
    pub fn n_vertices(&self) -> usize {
        self.n_living(Domain::Vertex)
    }

    /// The number of living half-edges: two for each edge.
    pub fn n_half_edges(&self) -> usize {
        2 * self.n_edges()
    }

    /// The number of living edges.
    pub fn n_edges(&self) -> usize {
        self.n_living(Domain::Edge)
    }

    /// The number of living faces.
    pub fn n_faces(&self) -> usize {
        self.n_living(Domain::Face)
    }

    /// The number of values that a column of this domain has: all elements, dead ones too.
    #[inline]
    pub fn domain_len(&self, domain: Domain) -> usize {
        match domain {
            Domain::Vertex => self.positions.len(),
            Domain::Corner => self.connectivity.next.len(),
            Domain::Edge => self.connectivity.next.len() / 2,
            Domain::Face => self.connectivity.face_half_edge.len(),
        }
    }

    /// Whether no element is dead, so that ids run from 0 without gaps.
    #[inline]
    pub fn is_dense(&self) -> bool {
        self.dead.iter().all(|marks| marks.count() == 0)
    }

    /// The living vertices in order of their ids.
    #[inline]
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + Clone + '_ {
        self.living()
    }

    /// The living edges in order of their ids.
    #[inline]
    pub fn edges(&self) -> impl Iterator<Item = EdgeId> + Clone + '_ {
        self.living()
    }

    /// The living half-edges in order of their ids.
    #[inline]
    pub fn half_edges(&self) -> impl Iterator<Item = HalfEdgeId> + Clone + '_ {
        self.edges().flat_map(EdgeId::half_edges)
    }

    /// The living faces in order of their ids.
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

    /// Whether `v` is a living vertex of this mesh.
    #[inline]
    pub fn has_vertex(&self, v: VertexId) -> bool {
        self.is_living(v)
    }

    /// Whether `e` is a living edge of this mesh.
    #[inline]
    pub fn has_edge(&self, e: EdgeId) -> bool {
        self.is_living(e)
    }

    /// Whether `f` is a living face of this mesh.
    #[inline]
    pub fn has_face(&self, f: FaceId) -> bool {
        self.is_living(f)
    }

    // ---- Reading the arrays --------------------------------------------------------------------

    /// The half-edge after `h` around its face, or around its hole.
    #[inline]
    pub fn next(&self, h: HalfEdgeId) -> HalfEdgeId {
        self.connectivity.next[h.index()]
    }

    /// The vertex that `h` leaves.
    #[inline]
    pub fn origin(&self, h: HalfEdgeId) -> VertexId {
        self.connectivity.origin[h.index()]
    }

    /// The vertex that `h` goes to.
    #[inline]
    pub fn target(&self, h: HalfEdgeId) -> VertexId {
        self.origin(h.twin())
    }

    /// The face of `h`, to its left; `None` on the boundary.
    #[inline]
    pub fn face(&self, h: HalfEdgeId) -> Option<FaceId> {
        self.connectivity.face[h.index()].some()
    }

    /// A half-edge that leaves `v`, the boundary one if there is one; `None` if `v` is isolated.
    #[inline]
    pub fn vertex_half_edge(&self, v: VertexId) -> Option<HalfEdgeId> {
        self.connectivity.vertex_half_edge[v.index()].some()
    }

    /// A half-edge of `f`.
    #[inline]
    pub fn face_half_edge(&self, f: FaceId) -> HalfEdgeId {
        self.connectivity.face_half_edge[f.index()]
    }

    /// The position of `v`, in scene units.
    #[inline]
    pub fn position(&self, v: VertexId) -> DVec3 {
        self.positions[v.index()]
    }

    /// The positions of all vertices, dead ones too, by index.
    #[inline]
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// The positions of all vertices, to be moved. An open [journal](Self::begin) copies all of them
    /// first; [`set_position`](Self::set_position) moves one.
    pub fn positions_mut(&mut self) -> &mut [DVec3] {
        if let Some(journal) = &mut self.journal {
            journal.note(|| Entry::Positions(self.positions.clone().into()));
        }
        &mut self.positions
    }

    /// Moves `v`.
    pub fn set_position(&mut self, v: VertexId, position: DVec3) {
        let old = std::mem::replace(&mut self.positions[v.index()], position);
        if let Some(journal) = &mut self.journal {
            journal.position(v, old);
        }
    }

    // ---- Attributes ----------------------------------------------------------------------------

    /// All attributes.
    pub fn attributes(&self) -> &Attributes {
        &self.attributes
    }

    /// Replaces all attributes.
    ///
    /// # Panics
    ///
    /// If a column has not one value for each element of its domain.
    pub fn set_attributes(&mut self, attributes: Attributes) {
        for (domain, column) in attributes.iter() {
            self.assert_length(domain, column);
        }
        let old = std::mem::replace(&mut self.attributes, attributes);
        if let Some(journal) = &mut self.journal {
            journal.note(|| Entry::Attributes(old.into()));
        }
    }

    /// The values of an attribute by index of its elements, if the mesh has it with this type.
    pub fn get<I: Id, T: Value>(&self, attribute: Attribute<I, T>) -> Option<&[T]> {
        self.attributes
            .column(I::DOMAIN, attribute.name)
            .and_then(|c| T::of(&c.values))
    }

    /// The values of an attribute, to be changed. An open [journal](Self::begin) copies all of them
    /// first.
    pub fn get_mut<I: Id, T: Value>(&mut self, attribute: Attribute<I, T>) -> Option<&mut [T]> {
        let column = self.attributes.column_mut(I::DOMAIN, attribute.name)?;
        if let Some(journal) = &mut self.journal {
            journal.note(|| Entry::Column(I::DOMAIN, column.clone().into()));
        }
        T::of_mut(&mut column.values)
    }

    /// Gives the mesh an attribute, in place of one of the same name and domain.
    ///
    /// # Panics
    ///
    /// If there is not one value for each element of the domain.
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

    /// Gives the mesh a column, in place of one of the same name and domain.
    ///
    /// # Panics
    ///
    /// If there is not one value for each element of the domain.
    pub fn insert_column(&mut self, domain: Domain, column: Column) {
        self.assert_length(domain, &column);
        if let Some(journal) = &mut self.journal {
            journal.note(|| match self.attributes.column(domain, &column.name) {
                Some(old) => Entry::Column(domain, old.clone().into()),
                None => Entry::NoColumn(domain, column.name.clone().into()),
            });
        }
        self.attributes.insert(domain, column);
    }

    /// Takes a column away and returns it.
    pub fn remove_column(&mut self, domain: Domain, name: &str) -> Option<Column> {
        let removed = self.attributes.remove(domain, name);
        if let (Some(journal), Some(column)) = (&mut self.journal, &removed) {
            journal.note(|| Entry::Column(domain, column.clone().into()));
        }
        removed
    }

    /// Takes the normals of vertices and corners away: they are wrong where the shape has changed.
    pub fn remove_normals(&mut self) {
        self.remove_column(Domain::Vertex, VERTEX_NORMAL.name);
        self.remove_column(Domain::Corner, CORNER_NORMAL.name);
    }

    /// The marks of a tag, by index of its elements.
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
            "attribute {} needs one value for each {domain}",
            column.name
        );
    }

    /// The bytes that the arrays of the mesh take.
    pub fn bytes(&self) -> usize {
        let c = &self.connectivity;
        let attributes: usize = self.attributes.iter().map(|(_, c)| c.values.bytes()).sum();
        12 * c.next.len() + 4 * c.face_half_edge.len() + 28 * self.positions.len() + attributes
    }
}
