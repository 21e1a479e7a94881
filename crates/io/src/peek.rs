//! Counts the content of a file without building its objects. The program uses the counts to estimate the time and
//! memory of a recipe before it runs the recipe.

use std::ops::RangeInclusive;

use mesh::{COLOR, CORNER_NORMAL, Domain, MATERIAL, Mesh, UV, VERTEX_NORMAL};
use scene::{Geometry, Graph, Material};

use crate::{CleanupPolicy, Format, NonManifold, Note, Policies};

/// The content of a file: its objects with their element counts.
#[derive(Clone, Debug, PartialEq)]
pub struct Peek {
    /// The format of the file.
    pub format: Format,
    /// The objects that would be read from the file, in order and with their names.
    pub objects: Vec<PeekObject>,
    /// The nodes, skins and animations. The arrays of numbers are present only for `.mws` files. For all other files,
    /// skins have no inverse bind matrices, and the inputs and outputs of samplers are not valid.
    pub graph: Graph,
    /// Content that reading would leave out, as far as this is known without building the objects. Examples are unused
    /// elements of a PLY file, statements of an OBJ file that do not describe polygons, and missing images and material
    /// libraries. Reading can leave out content that is not listed here.
    pub left_out: Vec<Note>,
}

/// An object that would be read from a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PeekObject {
    /// The name of the object.
    pub name: String,
    /// The kind of the geometry of the object, and its element counts.
    pub geometry: PeekGeometry,
    /// The names of the materials of the object. `None` if the names are known only after reading.
    pub materials: Option<Vec<String>>,
    /// The attributes that the mesh can have, except those that the flags of [`PeekMesh`] describe. If
    /// [`PeekMesh::is_exact`] is set, the list contains all attributes of the mesh. `None` if the attributes are known
    /// only after reading.
    pub attributes: Option<Vec<(Domain, String)>>,
}

impl PeekObject {
    /// Creates an object whose materials are unknown.
    pub(crate) fn new(name: String, geometry: PeekGeometry) -> Self {
        Self {
            name,
            geometry,
            materials: None,
            attributes: None,
        }
    }

    /// Sets the attributes that the flags of [`PeekMesh`] do not describe.
    pub(crate) fn with_attributes(self, attributes: Vec<(Domain, String)>) -> Self {
        Self {
            attributes: Some(attributes),
            ..self
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

/// The kind of the geometry of an object, and its element counts.
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

/// The attributes and the element counts of a mesh, according to its file.
///
/// Reading never gives more faces or corners than these counts. The mesh can have more vertices than counted here,
/// because non-manifold vertices and edges are split. Reading can also give fewer vertices, for example because a glTF
/// file has a separate vertex for each side of a seam. [`ranges`](Self::ranges) returns the ranges of the possible
/// element counts.
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
    /// The maximum number of joints that have weights in the mesh.
    pub joints: u64,
    /// The number of morph targets.
    pub targets: u64,
    /// The number of faces that certainly do not use any vertex twice. Reading keeps the counted faces, unless a policy
    /// drops them. In OBJ, OFF, PLY and binary STL files, a face without repeated vertices is counted if it has at most
    /// 16 corners. In `.mws` files, all faces are counted. In other formats, the number is 0, because the vertices of
    /// faces are not examined.
    pub simple_faces: u64,
    /// The number of corners of the faces that `simple_faces` counts.
    pub simple_corners: u64,
    /// Whether reading keeps all vertices of the file. Reading can still split some of them.
    pub keeps_vertices: bool,
    /// True if reading does not change the mesh at all. This is the case for `.mws` files.
    pub is_exact: bool,
}

/// The possible element counts of a mesh after its file is read, as ranges.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PeekRanges {
    /// The number of vertices.
    pub vertices: RangeInclusive<u64>,
    /// The number of edges.
    pub edges: RangeInclusive<u64>,
    /// The number of faces.
    pub faces: RangeInclusive<u64>,
    /// The number of corners of each face.
    pub degrees: RangeInclusive<u64>,
}

/// A face is checked for repeated vertices only if it has at most this number of corners.
pub(crate) const MAX_COMPARED: usize = 16;

/// Returns true if the words are indices that certainly refer to different elements. The words must be different, must
/// be all positive or all negative, and must not have leading zeros.
pub(crate) fn are_different(words: &[&[u8]]) -> bool {
    let is_index = |digits: &[u8]| {
        digits.first().is_some_and(|&first| first != b'0') && digits.iter().all(u8::is_ascii_digit)
    };
    let is_whole = |word: &&[u8]| is_index(word);
    let is_negative = |word: &&[u8]| word.strip_prefix(b"-").is_some_and(is_index);
    (words.iter().all(is_whole) || words.iter().all(is_negative)) && differ(words)
}

/// Whether no two items are equal. Returns false for more than [`MAX_COMPARED`] items.
pub(crate) fn differ<T: PartialEq>(items: &[T]) -> bool {
    let is_new = |i: usize| !items[..i].contains(&items[i]);
    items.len() <= MAX_COMPARED && (1..items.len()).all(is_new)
}

impl PeekMesh {
    /// Predicts how many vertices, edges and faces the mesh has after the file is read with these policies. Each
    /// prediction is a range of possible numbers.
    pub fn ranges(&self, policies: Policies) -> PeekRanges {
        let drops = |policy| policy == CleanupPolicy::Drop && !self.is_exact;
        let faces = match self.simple_faces {
            _ if drops(policies.degenerate) => 0,
            n if drops(policies.duplicates) => n.min(1),
            n => n,
        };
        // An edge of a mesh has at most two faces, so the number of edges is at least half the number of corners.
        let edges = match self.simple_corners {
            _ if faces < self.simple_faces => 3 * faces,
            corners => corners.div_ceil(2),
        };
        let vertices = if self.keeps_vertices && !drops(policies.isolated) {
            self.vertices
        } else {
            3 * faces.min(1)
        };
        let splits = policies.non_manifold == NonManifold::Split && !self.is_exact;
        let copies = if splits { self.corners } else { 0 };
        let degrees = if faces == self.faces && faces > 0 {
            self.min_degree..=self.max_degree
        } else {
            3..=self.max_degree.max(3)
        };
        PeekRanges {
            vertices: vertices..=self.vertices.saturating_add(copies),
            edges: edges..=self.corners,
            faces: faces..=self.faces,
            degrees,
        }
    }

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
        peek.simple_faces = peek.faces;
        peek.simple_corners = peek.corners;
        peek.keeps_vertices = true;
        peek.is_exact = true;
        peek
    }

    /// Adds `n` faces with `degree` corners each to `simple_faces` and `simple_corners`.
    pub(crate) fn add_simple(&mut self, n: u64, degree: u64) {
        self.simple_faces = self.simple_faces.saturating_add(n);
        self.simple_corners = self.simple_corners.saturating_add(n.saturating_mul(degree));
    }

    /// Adds the counts of faces and corners of `other`, and updates the smallest and the largest number of corners of a
    /// face.
    pub(crate) fn add(&mut self, other: &Self) {
        self.simple_faces = self.simple_faces.saturating_add(other.simple_faces);
        self.simple_corners = self.simple_corners.saturating_add(other.simple_corners);
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
