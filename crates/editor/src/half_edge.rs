//! Walks from half-edge to half-edge, and collects the data that a panel shows about a half-edge.

use mesh::{Domain, EdgeId, FaceId, HalfEdgeId, Mesh, Values, VertexId};

/// One way to walk from a half-edge to another half-edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Walk {
    /// Walk to the next half-edge of the same face.
    Next,
    /// Walk to the other half-edge of the same edge.
    Twin,
    /// Walk to the previous half-edge of the same face.
    Previous,
    /// Walk clockwise to the next half-edge that leaves the same vertex.
    AroundVertex,
}

/// Walks one step from the half-edge `h`, and returns the half-edge that is reached.
///
/// # Panics
///
/// Panics if the mesh does not have the half-edge.
pub fn walk(mesh: &Mesh, h: HalfEdgeId, step: Walk) -> HalfEdgeId {
    match step {
        Walk::Next => mesh.next(h),
        Walk::Twin => h.twin(),
        Walk::Previous => mesh.prev(h),
        Walk::AroundVertex => mesh.next(h.twin()),
    }
}

/// The data that a panel shows about a half-edge.
#[derive(Clone, Debug, PartialEq)]
pub struct HalfEdgeInfo {
    /// The half-edge.
    pub id: HalfEdgeId,
    /// The next half-edge of the same face.
    pub next: HalfEdgeId,
    /// The other half of the edge.
    pub twin: HalfEdgeId,
    /// The previous half-edge of the same face.
    pub previous: HalfEdgeId,
    /// The edge.
    pub edge: EdgeId,
    /// The face of the half-edge. `None` if the half-edge is on the boundary.
    pub face: Option<FaceId>,
    /// The vertex that the half-edge leaves.
    pub origin: VertexId,
    /// The vertex that the half-edge leads to.
    pub target: VertexId,
    /// The number of edges at the origin of the half-edge.
    pub valence: usize,
    /// The number of corners of the half-edge's face. `None` if the half-edge is on the boundary.
    pub degree: Option<usize>,
    /// The length of the half-edge, in scene units.
    pub length: f64,
    /// The angle between the normals of the two faces at the edge, in degrees. `None` if the edge is on the boundary,
    /// or if the area of a face is zero.
    pub dihedral_angle: Option<f64>,
    /// The attributes of the half-edge's origin, corner, edge and face.
    pub attributes: Vec<AttributeInfo>,
}

/// A value of an attribute.
#[derive(Clone, Debug, PartialEq)]
pub struct AttributeInfo {
    /// The kind of the element that has the value.
    pub domain: Domain,
    /// The name of the attribute.
    pub name: String,
    /// The components of the value. The value of a tag is 1 if the element has the tag, and 0 otherwise.
    pub value: Vec<f64>,
    /// Whether the attribute is a tag.
    pub is_tag: bool,
}

impl HalfEdgeInfo {
    /// Returns the data that a panel shows about a half-edge. Returns `None` if the mesh does not have the half-edge.
    pub fn of(mesh: &Mesh, h: HalfEdgeId) -> Option<Self> {
        if !mesh.has_edge(h.edge()) {
            return None;
        }
        let (origin, face) = (mesh.origin(h), mesh.face(h));
        let mut attributes = of_element(mesh, Domain::Vertex, origin.index());
        if face.is_some() {
            attributes.extend(of_element(mesh, Domain::Corner, h.index()));
        }
        attributes.extend(of_element(mesh, Domain::Edge, h.edge().index()));
        if let Some(face) = face {
            attributes.extend(of_element(mesh, Domain::Face, face.index()));
        }
        Some(Self {
            id: h,
            next: mesh.next(h),
            twin: h.twin(),
            previous: mesh.prev(h),
            edge: h.edge(),
            face,
            origin,
            target: mesh.target(h),
            valence: mesh.valence(origin),
            degree: face.map(|f| mesh.degree(f)),
            length: mesh.length(h),
            dihedral_angle: mesh.dihedral_angle(h.edge()).map(f64::to_degrees),
            attributes,
        })
    }
}

/// Returns the attributes of one element.
pub fn of_element(mesh: &Mesh, domain: Domain, index: usize) -> Vec<AttributeInfo> {
    let columns = mesh.attributes().of(domain).iter();
    let columns = columns.filter(|column| index < column.values.len());
    columns
        .map(|column| AttributeInfo {
            domain,
            name: column.name.clone(),
            value: (0..column.values.n_components())
                .map(|c| column.values.component(index, c))
                .collect(),
            is_tag: matches!(column.values, Values::Tag(_)),
        })
        .collect()
}
