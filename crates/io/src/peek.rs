//! What a file holds, found out without building it: for a forecast before anything runs.

use mesh::{COLOR, CORNER_NORMAL, Domain, MATERIAL, Mesh, UV, VERTEX_NORMAL};
use scene::Geometry;

use crate::Format;

/// What a file holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Peek {
    /// The format of the file.
    pub format: Format,
    /// The objects that reading would give, in their order and with their names.
    pub objects: Vec<PeekObject>,
}

/// What an object of a file will be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PeekObject {
    /// The name that it will have.
    pub name: String,
    /// The kind of its geometry and its counts.
    pub geometry: PeekGeometry,
}

/// The kind of geometry of an object, and how large it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PeekGeometry {
    /// A mesh.
    Mesh(PeekMesh),
    /// Bezier patches.
    Patches {
        /// How many.
        patches: u64,
    },
    /// A Bezier curve.
    Curve {
        /// How many control points.
        points: u64,
    },
    /// Open chains of points.
    Polylines {
        /// How many chains.
        lines: u64,
        /// How many points in all of them.
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

/// The counts and attributes of a mesh as its file states them.
///
/// The mesh that is read has no more faces and corners. It may have more vertices where the faces are
/// no manifold, by the split copies, and fewer where a glTF file has one for each side of a seam.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "attributes do not depend on each other"
)]
pub struct PeekMesh {
    /// How many vertices.
    pub vertices: u64,
    /// How many faces.
    pub faces: u64,
    /// How many corners all faces have together.
    pub corners: u64,
    /// The fewest corners of a face; 0 without faces.
    pub min_degree: u64,
    /// The most corners of a face; 0 without faces.
    pub max_degree: u64,
    /// Whether corners have texture coordinates.
    pub uvs: bool,
    /// Whether vertices or corners have normals.
    pub normals: bool,
    /// Whether vertices have colors.
    pub colors: bool,
    /// Whether faces have materials.
    pub materials: bool,
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
            ..Self::default()
        };
        for f in mesh.faces() {
            peek.add_faces(1, mesh.degree(f) as u64);
        }
        peek
    }

    /// Adds the faces of another.
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

    /// Counts `n` more faces of `degree` corners.
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
