//! The plan of a mesh: the facts that are known before the run, such as the counts of elements, the attributes, and the
//! size in bytes.

use mesh::{
    CORNER_NORMAL, CORNER_TANGENT, DVec3, Domain, Rule, TANGENT, VERTEX_NORMAL, is_morph_direction,
    joint_of, morph_of,
};

use crate::Range;

/// The plan of an attribute: the facts about the attribute that are known before the run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlannedAttribute {
    /// The domain of the attribute.
    pub domain: Domain,
    /// The name.
    pub name: String,
    /// Whether the attribute certainly exists.
    pub certain: bool,
}

/// The plan of a mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshPlan {
    /// The number of vertices.
    pub vertices: Range,
    /// The number of edges.
    pub edges: Range,
    /// The number of faces.
    pub faces: Range,
    /// The lowest and the highest possible degree of a face. The degree of a face is its number of corners.
    pub degrees: Range,
    /// The known attributes.
    pub attributes: Vec<PlannedAttribute>,
    /// Whether the mesh can have attributes that are not in `attributes`. A mesh from a file can have such attributes.
    pub has_unlisted_attributes: bool,
    /// The names of the materials; `None` if they are unknown.
    pub materials: Option<Vec<String>>,
}

/// The size of one attribute value, in bytes: from 1 (a tag) to 32 (a vector of four numbers).
const ATTRIBUTE_VALUE_BYTES: Range = Range { min: 1, max: 32 };

impl MeshPlan {
    /// Creates the plan of a mesh about which nothing is known.
    pub const fn unknown() -> Self {
        Self {
            vertices: Range::ANY,
            edges: Range::ANY,
            faces: Range::ANY,
            degrees: Range::between(3, u64::MAX),
            attributes: Vec::new(),
            has_unlisted_attributes: true,
            materials: None,
        }
    }

    /// Creates the plan of a mesh with these counts, without attributes and materials.
    pub const fn counted(vertices: u64, edges: u64, faces: u64, degrees: Range) -> Self {
        Self {
            vertices: Range::exactly(vertices),
            edges: Range::exactly(edges),
            faces: Range::exactly(faces),
            degrees,
            attributes: Vec::new(),
            has_unlisted_attributes: false,
            materials: Some(Vec::new()),
        }
    }

    /// Creates the plan of an existing mesh, with the exact numbers of vertices, edges and faces. The materials are
    /// unknown.
    pub fn of(mesh: &mesh::Mesh) -> Self {
        let degrees = mesh.faces().map(|f| mesh.degree(f) as u64);
        let degrees = degrees
            .map(Range::exactly)
            .reduce(Range::or)
            .unwrap_or(Range::exactly(3));
        Self {
            vertices: Range::exactly(mesh.n_vertices() as u64),
            edges: Range::exactly(mesh.n_edges() as u64),
            faces: Range::exactly(mesh.n_faces() as u64),
            degrees,
            attributes: mesh
                .attributes()
                .iter()
                .map(|(domain, c)| PlannedAttribute {
                    domain,
                    name: c.name.clone(),
                    // Attributes with the rule `Drop` are removed by the first edit that changes the connectivity.
                    certain: c.rule != Rule::Drop,
                })
                .collect(),
            has_unlisted_attributes: false,
            materials: None,
        }
    }

    /// Whether all faces are certainly triangles.
    pub fn is_triangles(&self) -> bool {
        self.degrees == Range::exactly(3)
    }

    /// Returns how many corners a group of faces has in total, as a range. `faces` is the number of these faces. The
    /// total is at most twice the number of edges of the mesh.
    pub fn corners_of(&self, faces: Range) -> Range {
        faces.times(self.degrees).capped(self.edges.by(2).max)
    }

    /// Adds `vertices`, `edges` and `faces` to the counts of the plan.
    pub fn grow(&mut self, vertices: Range, edges: Range, faces: Range) {
        self.vertices = self.vertices.plus(vertices);
        self.edges = self.edges.plus(edges);
        self.faces = self.faces.plus(faces);
    }

    /// Returns an error message if the mesh certainly has no vertex with this id.
    pub fn missing_vertex_message(&self, number: u32) -> Option<String> {
        missing_element_message(u64::from(number), self.vertices, "vertex")
    }

    /// Returns an error message if the mesh certainly has no face with this id.
    pub fn missing_face_message(&self, number: u32) -> Option<String> {
        missing_element_message(u64::from(number), self.faces, "face")
    }

    /// Adds an attribute that certainly exists.
    pub fn provide(&mut self, domain: Domain, name: &str) {
        self.drop_attribute(domain, name);
        self.attributes.push(PlannedAttribute {
            domain,
            name: name.to_owned(),
            certain: true,
        });
    }

    /// Removes an attribute.
    pub fn drop_attribute(&mut self, domain: Domain, name: &str) {
        self.attributes
            .retain(|a| a.domain != domain || a.name != name);
    }

    /// Removes the normals and tangents of vertices, corners and morph targets. Operations that change the shape of the
    /// mesh call this method.
    pub fn drop_normals(&mut self) {
        self.drop_attribute(Domain::Vertex, VERTEX_NORMAL.name);
        self.drop_attribute(Domain::Corner, CORNER_NORMAL.name);
        self.drop_attribute(Domain::Vertex, TANGENT.name);
        self.drop_attribute(Domain::Corner, CORNER_TANGENT.name);
        (self.attributes).retain(|attribute| !is_morph_direction(&attribute.name));
    }

    /// Whether one of the known attributes stores the weights of a joint.
    pub fn has_joints(&self) -> bool {
        let is_joint = |a: &PlannedAttribute| joint_of(&a.name).is_some();
        (self.attributes.iter()).any(|a| a.domain == Domain::Vertex && is_joint(a))
    }

    /// Returns the number of morph targets among the known attributes.
    pub fn n_morphs(&self) -> usize {
        let is_morph = |a: &&PlannedAttribute| morph_of(&a.name).is_some();
        (self.attributes.iter())
            .filter(|a| a.domain == Domain::Vertex && is_morph(a))
            .count()
    }

    /// Returns the smallest and the largest possible size of the mesh, in bytes. The size does not include attributes
    /// that are missing from the plan.
    pub fn bytes(&self) -> Range {
        let count = |domain| match domain {
            Domain::Vertex => self.vertices,
            Domain::Corner => self.edges.by(2),
            Domain::Edge => self.edges,
            Domain::Face => self.faces,
        };
        let connectivity = self
            .vertices
            .by(28)
            .plus(self.edges.by(24))
            .plus(self.faces.by(4));
        self.attributes.iter().fold(connectivity, |sum, a| {
            sum.plus(count(a.domain).times(value_bytes(a)))
        })
    }
}

fn missing_element_message(number: u64, count: Range, noun: &str) -> Option<String> {
    let limit = if count.is_exact() { "" } else { "at most " };
    let n = mesh::counted(count.max, noun);
    let message = || format!("{noun} {number} does not exist: the mesh has {limit}{n}");
    (number >= count.max).then(message)
}

/// Returns the smallest and the largest possible size of one value of an attribute, in bytes. The smallest size is 0 if
/// it is not certain that the attribute exists.
fn value_bytes(attribute: &PlannedAttribute) -> Range {
    let name = &attribute.name;
    let exactly = |bytes: usize| Range::exactly(bytes as u64);
    let size = match attribute.domain {
        Domain::Vertex if joint_of(name).is_some() => exactly(size_of::<f64>()),
        Domain::Vertex if morph_of(name).is_some() => exactly(size_of::<DVec3>()),
        _ => ATTRIBUTE_VALUE_BYTES,
    };
    if attribute.certain {
        size
    } else {
        size.or_less()
    }
}

#[cfg(test)]
mod tests;
