//! Decides which faces and edges a level cuts. A hanging vertex lies in the middle of a straight side of a
//! face.

use mesh::{EdgeId, FaceId, HalfEdgeId, Mesh};
use progress::{Cancelled, Meter};

use super::sides;
use crate::parallel::BLOCK;

/// How a face is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    /// The face is not cut. New vertices on the sides of the face become additional corners of the face.
    Whole,
    /// A triangle is not cut but gets a hanging vertex. The first half-edge of the new face starts at the hanging
    /// vertex.
    Hanging,
    /// A triangle becomes two. The cut runs from its hanging vertex to the opposite corner.
    Two,
    /// A triangle becomes four.
    Four,
    /// A polygon becomes this number of quads around its center.
    Quads(u32),
}

impl Cut {
    /// Returns three numbers: how many new vertices lie inside the face, how many new edges lie inside it, and how many
    /// parts it has.
    pub(super) const fn counts(self) -> [u32; 3] {
        match self {
            Self::Whole | Self::Hanging => [0, 0, 1],
            Self::Two => [0, 1, 2],
            Self::Four => [0, 3, 4],
            Self::Quads(n) => [1, n, n],
        }
    }
}

/// The cuts of a level.
pub(super) struct Cuts {
    /// How each face is cut.
    pub(super) faces: Vec<Cut>,
    /// Whether each edge is cut in two.
    pub(super) edges: Vec<bool>,
}

impl Cuts {
    /// Returns the cuts of a level that cuts the chosen triangles into four. If another triangle would get a second
    /// hanging vertex, the level cuts this triangle into four, too. This is repeated until no triangle would have two
    /// hanging vertices. The result does not depend on the order in which triangles are visited.
    ///
    /// In `mesh`, a face with four corners stands for a triangle with a hanging vertex.
    pub(super) fn of_triangles(
        mesh: &Mesh,
        chosen: &[bool],
        meter: &Meter,
    ) -> Result<Self, Cancelled> {
        let mut faces = vec![Cut::Whole; mesh.n_faces()];
        let mut edges = vec![false; mesh.n_edges()];
        // For each face: whether it has a hanging vertex.
        let mut has_hanging: Vec<bool> = mesh.faces().map(|f| !mesh.is_triangle(f)).collect();
        let mut queue: Vec<usize> = (0..chosen.len()).filter(|&f| chosen[f]).collect();
        for &f in &queue {
            faces[f] = Cut::Four;
        }
        let mut n_visited = 0;
        while let Some(f) = queue.pop() {
            n_visited += 1;
            if n_visited % BLOCK == 0 {
                meter.add(0)?;
            }
            for h in whole_sides(mesh, f) {
                if std::mem::replace(&mut edges[h.edge().index()], true) {
                    continue;
                }
                let Some(neighbor) = mesh.face(h.twin()).map(FaceId::index) else {
                    continue;
                };
                if faces[neighbor] == Cut::Whole
                    && std::mem::replace(&mut has_hanging[neighbor], true)
                {
                    faces[neighbor] = Cut::Four;
                    queue.push(neighbor);
                }
            }
        }
        for (f, cut) in faces.iter_mut().enumerate() {
            if *cut == Cut::Whole && has_hanging[f] && mesh.is_triangle(FaceId::new(f)) {
                *cut = Cut::Hanging;
            }
        }
        Ok(Self { faces, edges })
    }

    /// Returns the cuts of a level that cuts each triangle with a hanging vertex in two.
    pub(super) fn in_two(mesh: &Mesh) -> Self {
        let cut = |f| {
            if mesh.is_triangle(f) {
                Cut::Whole
            } else {
                Cut::Two
            }
        };
        Self {
            faces: mesh.faces().map(cut).collect(),
            edges: vec![false; mesh.n_edges()],
        }
    }

    /// Returns the cuts of a level that cuts the chosen faces into quads.
    pub(super) fn of_polygons(mesh: &Mesh, chosen: &[bool]) -> Self {
        let cut = |f: FaceId| {
            if chosen[f.index()] {
                let n = mesh.degree(f);
                Cut::Quads(u32::try_from(n).expect("half-edges have 32 bits"))
            } else {
                Cut::Whole
            }
        };
        let is_chosen = |f: Option<FaceId>| f.is_some_and(|f| chosen[f.index()]);
        let is_cut = |e: EdgeId| mesh.edge_faces(e).into_iter().any(is_chosen);
        Self {
            faces: mesh.faces().map(cut).collect(),
            edges: mesh.edges().map(is_cut).collect(),
        }
    }

    /// Returns how many vertices, edges and faces the next level has.
    pub(super) fn counts_after(&self, mesh: &Mesh) -> [u64; 3] {
        let cut = self.edges.iter().filter(|&&cut| cut).count();
        let start = [mesh.n_vertices() + cut, mesh.n_edges() + cut, 0].map(|n| n as u64);
        self.faces.iter().fold(start, |[v, e, f], cut| {
            let [vertices, edges, faces] = cut.counts().map(u64::from);
            [v + vertices, e + edges, f + faces]
        })
    }
}

/// Iterates over the sides of a triangle that have no hanging vertex.
fn whole_sides(mesh: &Mesh, f: usize) -> impl Iterator<Item = HalfEdgeId> {
    // The first half-edge of a face with a hanging vertex starts at that vertex.
    let is_triangle = mesh.is_triangle(FaceId::new(f));
    let (skip, take) = if is_triangle { (0, 3) } else { (1, 2) };
    sides(mesh, f).skip(skip).take(take)
}
