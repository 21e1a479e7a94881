//! The result of a tessellation: lists of polygons, and their sizes.
//!
//! ```text
//! offsets   0         4     7                the corners of face f are
//!           |         |     |                indices[offsets[f]..offsets[f + 1]]
//! indices   0 1 4 3   1 2 4 ...
//!           face 0    face 1
//! ```

use glam::{DVec2, DVec3};

use crate::BezierError;

/// Polygons that approximate patches.
#[derive(Clone, Debug, PartialEq)]
pub struct Tessellation {
    /// The position of every vertex.
    pub positions: Vec<DVec3>,
    /// The exact unit normal of the patch at every vertex; zero where the patch has no normal
    /// (see [`Patch::normal`](crate::Patch::normal)).
    pub normals: Vec<DVec3>,
    /// The parameters (u, v) of every vertex in its patch.
    pub uvs: Vec<DVec2>,
    /// For each face, the index of its first corner in `indices`. The last entry is the length of `indices`.
    pub offsets: Vec<u32>,
    /// The vertices of all faces, face after face, counter-clockwise.
    pub indices: Vec<u32>,
    /// The number of tessellated patches, including the patches that have no vertices and no faces in the tessellation.
    pub patches: u32,
    /// The indices of the patches that have no vertices and no faces in the tessellation.
    pub empty_patches: Vec<u32>,
}

/// How each cell of a patch becomes faces. A cell is the part of the patch between neighboring samples in u and in v.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Faces {
    /// Two triangles, divided by the diagonal from corner (i, j) to corner (i + 1, j + 1).
    Triangles,
    /// One quad.
    Quads,
}

impl Default for Tessellation {
    fn default() -> Self {
        Self {
            positions: Vec::new(),
            normals: Vec::new(),
            uvs: Vec::new(),
            offsets: vec![0],
            indices: Vec::new(),
            patches: 0,
            empty_patches: Vec::new(),
        }
    }
}

impl Tessellation {
    /// Returns the number of faces.
    pub fn face_count(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Iterates over the faces in order; each is a list of vertices, counter-clockwise.
    pub fn faces(&self) -> impl Iterator<Item = &[u32]> {
        self.offsets
            .windows(2)
            .map(|ends| &self.indices[ends[0] as usize..ends[1] as usize])
    }

    /// Reserves memory for `counts` additional elements. Adding these elements then needs no further memory, and cannot
    /// fail.
    pub(crate) fn reserve(&mut self, counts: Counts) -> Result<(), BezierError> {
        let all = [counts.vertices, counts.faces, counts.corners];
        let [vertices, faces, corners] = all.map(|n| usize::try_from(n).unwrap_or(usize::MAX));
        self.positions
            .try_reserve(vertices)
            .and_then(|()| self.normals.try_reserve(vertices))
            .and_then(|()| self.uvs.try_reserve(vertices))
            .and_then(|()| self.offsets.try_reserve(faces))
            .and_then(|()| self.indices.try_reserve(corners))
            .map_err(|_| BezierError::OutOfMemory(counts))
    }

    pub(crate) fn counts(&self) -> Counts {
        Counts {
            vertices: self.positions.len() as u64,
            faces: self.face_count() as u64,
            corners: self.indices.len() as u64,
        }
    }

    /// Adds a vertex and returns its id. The caller must have checked that the counts of vertices, faces and corners
    /// fit 32 bits.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "checked by tessellate_patch"
    )]
    pub(crate) fn push_vertex(&mut self, position: DVec3, normal: DVec3, uv: DVec2) -> u32 {
        self.positions.push(position);
        self.normals.push(normal);
        self.uvs.push(uv);
        (self.positions.len() - 1) as u32
    }

    /// Adds a face. A corner is left out if the next corner has the same vertex. If fewer than three corners remain, no
    /// face is added. The caller must have checked that the counts of vertices, faces and corners fit 32 bits.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "checked by tessellate_patch"
    )]
    pub(crate) fn push_face<const N: usize>(&mut self, face: [u32; N]) {
        let distinct = (0..N).filter(|&k| face[k] != face[(k + 1) % N]);
        if distinct.clone().count() >= 3 {
            self.indices.extend(distinct.map(|k| face[k]));
            self.offsets.push(self.indices.len() as u32);
        }
    }
}

/// The number of elements of a tessellation.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub struct Counts {
    /// The number of vertices.
    pub vertices: u64,
    /// The number of faces.
    pub faces: u64,
    /// The number of face corners: the sum of the degrees of all faces.
    pub corners: u64,
}

impl Counts {
    /// Returns the sums of the counts of `self` and `other`. A sum that exceeds 64 bits is replaced by the largest
    /// 64-bit number.
    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self {
            vertices: self.vertices.saturating_add(other.vertices),
            faces: self.faces.saturating_add(other.faces),
            corners: self.corners.saturating_add(other.corners),
        }
    }

    /// Checks that the counts fit 32 bits.
    pub(crate) fn check(&self) -> Result<(), BezierError> {
        let max = self.vertices.max(self.faces).max(self.corners);
        if max > u64::from(u32::MAX) {
            return Err(BezierError::TooManyElements(*self));
        }
        Ok(())
    }
}
