//! Which faces and edges a level cuts.

use mesh::{EdgeId, FaceId, HalfEdgeId, Mesh};
use progress::{Cancelled, Meter};

use super::sides;
use crate::parallel::BLOCK;

/// What becomes of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cut {
    /// It stays one, with new vertices on its sides as additional corners.
    Whole,
    /// A triangle stays one; a vertex hangs on it from now on, at which it begins.
    Hung,
    /// A triangle becomes two, from its hanging vertex to the opposite corner.
    Two,
    /// A triangle becomes four.
    Four,
    /// A polygon becomes so many quads around its center.
    Quads(u32),
}

impl Cut {
    /// How many vertices lie inside, how many edges, and how many faces it becomes.
    pub(super) const fn counts(self) -> [u32; 3] {
        match self {
            Self::Whole | Self::Hung => [0, 0, 1],
            Self::Two => [0, 1, 2],
            Self::Four => [0, 3, 4],
            Self::Quads(n) => [1, n, n],
        }
    }
}

/// The cuts of a level.
pub(super) struct Cuts {
    /// What becomes of each face.
    pub(super) faces: Vec<Cut>,
    /// Whether each edge is cut in two.
    pub(super) edges: Vec<bool>,
}

impl Cuts {
    /// Cuts the chosen triangles into four, and others as long as a second vertex would hang on them. The
    /// result does not depend on the order in which they are found.
    ///
    /// Faces with four corners are triangles with a hanging vertex.
    pub(super) fn of_triangles(
        mesh: &Mesh,
        chosen: &[bool],
        meter: &Meter,
    ) -> Result<Self, Cancelled> {
        let mut faces = vec![Cut::Whole; mesh.n_faces()];
        let mut edges = vec![false; mesh.n_edges()];
        // Whether another vertex would be one too many.
        let mut is_full: Vec<bool> = mesh.faces().map(|f| !mesh.is_triangle(f)).collect();
        let mut open: Vec<usize> = (0..chosen.len()).filter(|&f| chosen[f]).collect();
        for &f in &open {
            faces[f] = Cut::Four;
        }
        let mut done = 0;
        while let Some(f) = open.pop() {
            done += 1;
            if done % BLOCK == 0 {
                meter.add(0)?;
            }
            for h in whole_sides(mesh, f) {
                if std::mem::replace(&mut edges[h.edge().index()], true) {
                    continue;
                }
                let Some(beside) = mesh.face(h.twin()).map(FaceId::index) else {
                    continue;
                };
                if faces[beside] == Cut::Whole && std::mem::replace(&mut is_full[beside], true) {
                    faces[beside] = Cut::Four;
                    open.push(beside);
                }
            }
        }
        for (f, cut) in faces.iter_mut().enumerate() {
            if *cut == Cut::Whole && is_full[f] && mesh.is_triangle(FaceId::new(f)) {
                *cut = Cut::Hung;
            }
        }
        Ok(Self { faces, edges })
    }

    /// Cuts triangles with a hanging vertex in two.
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

    /// Cuts the chosen faces into quads.
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

    /// How many vertices, edges and faces the next level has.
    pub(super) fn counts_after(&self, mesh: &Mesh) -> [u64; 3] {
        let cut = self.edges.iter().filter(|&&cut| cut).count();
        let start = [mesh.n_vertices() + cut, mesh.n_edges() + cut, 0].map(|n| n as u64);
        self.faces.iter().fold(start, |[v, e, f], cut| {
            let [vertices, edges, faces] = cut.counts().map(u64::from);
            [v + vertices, e + edges, f + faces]
        })
    }
}

/// The sides of a triangle without a hanging vertex.
fn whole_sides(mesh: &Mesh, f: usize) -> impl Iterator<Item = HalfEdgeId> {
    // A face with a hanging vertex begins there.
    let is_triangle = mesh.is_triangle(FaceId::new(f));
    let (skip, take) = if is_triangle { (0, 3) } else { (1, 2) };
    sides(mesh, f).skip(skip).take(take)
}
