//! Lists of polygons, and how long they are.
//!
//! ```text
//! offsets   0         4     7                the corners of face f are
//!           |         |     |                indices[offsets[f]..offsets[f + 1]]
//! indices   0 1 4 3   1 2 4 ...
//!           face 0    face 1
//! ```

use glam::{DVec2, DVec3};

use crate::BezierError;

/// Polygons made from patches.
#[derive(Clone, Debug, PartialEq)]
pub struct Tessellation {
    /// The position of every vertex.
    pub positions: Vec<DVec3>,
    /// The exact unit normal of the patch at every vertex; zero where the patch has none
    /// (see [`Patch::normal`](crate::Patch::normal)).
    pub normals: Vec<DVec3>,
    /// The parameters (u, v) of every vertex in its patch.
    pub uvs: Vec<DVec2>,
    /// Where the corners of each face begin in `indices`, and the end: one more than faces.
    pub offsets: Vec<u32>,
    /// The vertices of all faces, face after face, counter-clockwise.
    pub indices: Vec<u32>,
    /// How many patches were tessellated, with those that gave nothing.
    pub patches: u32,
    /// The patches that gave nothing because they have no area.
    pub empty_patches: Vec<u32>,
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
    /// How many faces there are.
    pub fn face_count(&self) -> usize {
        self.offsets.len() - 1
    }

    /// The vertices of the faces in order, each counter-clockwise.
    pub fn faces(&self) -> impl Iterator<Item = &[u32]> {
        self.offsets
            .windows(2)
            .map(|ends| &self.indices[ends[0] as usize..ends[1] as usize])
    }

    /// Makes room for `counts` more elements, so that filling them in cannot fail.
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

    /// What is there already.
    pub(crate) fn counts(&self) -> Counts {
        Counts {
            vertices: self.positions.len() as u64,
            faces: self.face_count() as u64,
            corners: self.indices.len() as u64,
        }
    }

    /// Adds a vertex and gives its id. The counts were checked against 32 bits before.
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

    /// Adds a face of the patch at hand, without corners that repeat the one before; nothing if
    /// fewer than three remain. The counts were checked against 32 bits before.
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

/// How many elements a tessellation has.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub struct Counts {
    /// Vertices.
    pub vertices: u64,
    /// Faces.
    pub faces: u64,
    /// Corners of faces: the sum of their degrees.
    pub corners: u64,
}

impl Counts {
    /// The sums, or the largest numbers that fit.
    pub(crate) fn plus(&self, more: &Self) -> Self {
        Self {
            vertices: self.vertices.saturating_add(more.vertices),
            faces: self.faces.saturating_add(more.faces),
            corners: self.corners.saturating_add(more.corners),
        }
    }

    /// Refuses counts that do not fit 32 bits.
    pub(crate) fn check(&self) -> Result<(), BezierError> {
        let most = self.vertices.max(self.faces).max(self.corners);
        if most > u64::from(u32::MAX) {
            return Err(BezierError::TooManyElements(*self));
        }
        Ok(())
    }
}
