//! Counts the content of a file without building its objects. The counts are used to estimate a run before it starts.

use mesh::{COLOR, CORNER_NORMAL, Domain, MATERIAL, Mesh, UV, VERTEX_NORMAL};
use scene::{Geometry, Graph, Material};

use crate::{Format, Note};

/// The content of a file: its objects with their counts.
#[derive(Clone, Debug, PartialEq)]
pub struct Peek {
    /// The format of the file.
    pub format: Format,
    /// The objects that reading the file would give, in order and with their names.
    pub objects: Vec<PeekObject>,
    /// The nodes, skins and animations, but not the arrays of numbers: all skins are without inverse bind matrices, and the
    /// numbers of samplers have no meaning. In `.mws` files, the arrays are there too.
    pub graph: Graph,
    /// The content that reading would leave out, as far as it is known without building the objects. Examples are
    /// unused elements of a PLY file, statements of an OBJ file that do not describe polygons, and missing images and
    /// material libraries. Reading can leave out more content.
    pub left_out: Vec<Note>,
}

/// An object that reading a file would give.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PeekObject {
    /// The name of the object.
    pub name: String,
    /// The kind and the counts of its geometry.
    pub geometry: PeekGeometry,
    /// The names of the materials of the object. `None` if the names are known only after reading.
    pub materials: Option<Vec<String>>,
}

impl PeekObject {
    /// Creates an object whose materials are unknown.
    pub(crate) fn new(name: String, geometry: PeekGeometry) -> Self {
        Self {
            name,
            geometry,
            materials: None,
        }
    }

    /// Sets the materials.
    pub(crate) fn with_materials(self, materials: &[Material]) -> Self {
        Self {
            materials: Some(materials.iter().map(|m| m.name.clone()).collect()),
            ..self
        }
    }
}

/// The kind and the counts of the geometry of an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PeekGeometry {
    /// A mesh.
    Mesh(PeekMesh),
    /// Bezier patches.
    Patches {
        /// The number of patches.
        patches: u64,
    },
    /// A Bezier curve.
    Curve {
        /// The number of control points.
        points: u64,
    },
    /// Open polylines.
    Polylines {
        /// The number of polylines.
        lines: u64,
        /// The total number of points.
        points: u64,
    },
}

impl PeekGeometry {
    pub(crate) fn of(geometry: &Geometry) -> Self {
        match geometry {
            Geometry::Mesh(mesh) => Self::Mesh(PeekMesh::of(mesh)),
            Geometry::Patches(patches) => Self::Patches {
                patches: patches.len() as u64,
            },
            Geometry::Curve(curve) => Self::Curve {
                points: curve.points().len() as u64,
            },
            Geometry::Polylines(lines) => Self::Polylines {
                lines: lines.len() as u64,
                points: lines.iter().map(|line| line.len() as u64).sum(),
            },
        }
    }
}

/// The counts and attributes of a mesh according to its file.
///
/// Reading never gives more faces or corners than these counts. Reading can give more vertices, because non-manifold
/// vertices and edges are split. Reading can also give fewer vertices, for example because a glTF file has a separate
/// vertex for each side of a seam.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "the flags are independent of each other"
)]
pub struct PeekMesh {
    /// The number of vertices.
    pub vertices: u64,
    /// The number of faces.
    pub faces: u64,
    /// The number of corners of all faces.
    pub corners: u64,
    /// The smallest number of corners of a face, or 0 if there are no faces.
    pub min_degree: u64,
    /// The largest number of corners of a face, or 0 if there are no faces.
    pub max_degree: u64,
    /// Whether corners have texture coordinates.
    pub uvs: bool,
    /// Whether vertices or corners have normals.
    pub normals: bool,
    /// Whether vertices have colors.
    pub colors: bool,
    /// Whether faces have materials.
    pub materials: bool,
    /// The largest number of joints that can have weights at vertices.
    pub joints: u64,
    /// The number of morph targets.
    pub targets: u64,
}

impl PeekMesh {
    fn of(mesh: &Mesh) -> Self {
        let has = |domain, name| mesh.attributes().column(domain, name).is_some();
        let mut peek = Self {
            vertices: mesh.n_vertices() as u64,
            uvs: has(Domain::Corner, UV.name),
            normals: has(Domain::Vertex, VERTEX_NORMAL.name)
                || has(Domain::Corner, CORNER_NORMAL.name),
            colors: has(Domain::Vertex, COLOR.name),
            materials: has(Domain::Face, MATERIAL.name),
            joints: mesh.attributes().joints().len() as u64,
            targets: mesh.attributes().morphs().len() as u64,
            ..Self::default()
        };
        for f in mesh.faces() {
            peek.add_faces(1, mesh.degree(f) as u64);
        }
        peek
    }

    /// Adds the counts of faces and corners of `other`, and extends the range of degrees.
    pub(crate) fn add(&mut self, other: &Self) {
        if other.faces == 0 {
            return;
        }
        let least = if self.faces == 0 {
            u64::MAX
        } else {
            self.min_degree
        };
        self.min_degree = least.min(other.min_degree);
        self.max_degree = self.max_degree.max(other.max_degree);
        self.faces = self.faces.saturating_add(other.faces);
        self.corners = self.corners.saturating_add(other.corners);
    }

    /// Adds `n` faces with `degree` corners each to the counts.
    pub(crate) fn add_faces(&mut self, n: u64, degree: u64) {
        self.add(&Self {
            faces: n,
            corners: n.saturating_mul(degree),
            min_degree: degree,
            max_degree: degree,
            ..Self::default()
        });
    }
}
