//! Writes the text of one mesh: vertices, texture coordinates, normals and faces.

use std::ops::Range;
use std::sync::Arc;

use glam::{DVec2, DVec3, DVec4};
use mesh::{CORNER_NORMAL, Domain, FaceId, HalfEdgeId, Mesh, UV, VERTEX_NORMAL, VertexId};

use super::corner::Counts;
use super::file::NO_MATERIAL;
use super::library::{Library, push_name, push_values};
use super::states::{FaceState, FaceStates, TextState, one_word};
use crate::Format;
use crate::corners::CornerNumbers;
use crate::decimal::push_whole;
use crate::file_vertices::FileVertices;
use crate::loss::Losses;
use crate::save::Block;
use crate::writing::NOT_FINITE;
use mesh::parallel;

/// The number of vertices, values or faces in a block of the text.
const BLOCK: usize = 8192;

/// A mesh with the data that are needed to write it.
pub(super) struct MeshBody<'a> {
    mesh: &'a Mesh,
    library: &'a Library,
    before: TextState,
    colors: Option<&'a [DVec4]>,
    uvs: Option<(&'a [DVec2], CornerNumbers)>,
    normals: Option<(Normals<'a>, CornerNumbers)>,
    states: FaceStates<'a>,
    vertices: FileVertices,
}

/// The normals that are written: the corner normals of the mesh or, if it has none, its vertex normals.
#[derive(Clone, Copy)]
enum Normals<'a> {
    Vertices(&'a [DVec3]),
    Corners(&'a [DVec3]),
}

impl Normals<'_> {
    fn of(self, mesh: &Mesh, h: HalfEdgeId) -> DVec3 {
        match self {
            Self::Vertices(normals) => normals[mesh.origin(h).index()],
            Self::Corners(normals) => normals[h.index()],
        }
    }
}

impl<'a> MeshBody<'a> {
    pub(super) fn new(
        mesh: &'a Mesh,
        places: &'a [usize],
        several: bool,
        library: &'a Library,
        before: TextState,
        losses: &mut Losses,
    ) -> Self {
        let uvs = mesh.get(UV);
        let colors = mesh.get(mesh::COLOR);
        let normals = match (mesh.get(CORNER_NORMAL), mesh.get(VERTEX_NORMAL)) {
            (Some(normals), _) => Some(Normals::Corners(normals)),
            (None, normals) => normals.map(Normals::Vertices),
        };
        losses.add_columns(mesh, Format::Obj, |_, _| true);
        if let Some(colors) = colors {
            lost_colors(colors, losses);
        }
        let uvs = uvs.map(|uvs| {
            let value = |h: HalfEdgeId| uvs[h.index()].to_array();
            (uvs, numbers(mesh, value, "uv", losses))
        });
        let normals = normals.map(|normals| {
            let value = |h| normals.of(mesh, h).to_array();
            (normals, numbers(mesh, value, "normal", losses))
        });
        if let Some((Normals::Vertices(normals), _)) = normals {
            let isolated = parallel::count(mesh.n_vertices(), |v| {
                mesh.vertex_half_edge(VertexId::new(v)).is_none() && normals[v] != DVec3::ZERO
            });
            let reason =
                "OBJ stores normals at face corners, and isolated vertices have no corners";
            losses.add(Domain::Vertex, "normal", isolated, reason);
        }
        let states = FaceStates::new(mesh, places, several, losses);
        Self {
            mesh,
            library,
            before,
            colors,
            uvs,
            normals,
            states,
            vertices: FileVertices::of(mesh),
        }
    }

    /// Returns the [`TextState`] at the end of the text of this mesh.
    pub(super) fn after(&self) -> TextState {
        let mut after = self.before;
        for (k, n) in self.counts().into_iter().enumerate() {
            after.counts[k] += n;
        }
        if let Some(last) = self.last_face() {
            let state = self.states.of(last);
            (after.material, after.smoothing) = (state.material, state.smoothing);
        }
        after
    }

    fn counts(&self) -> Counts {
        let uvs = count(self.uvs.as_ref());
        [self.vertices.len(), uvs, count(self.normals.as_ref())]
    }

    fn last_face(&self) -> Option<FaceId> {
        self.mesh.n_faces().checked_sub(1).map(FaceId::new)
    }

    /// Adds the blocks of text for the mesh.
    pub(super) fn add_blocks(self, blocks: &mut Vec<Block<'a>>) {
        let [n_vertices, n_uvs, n_normals] = self.counts();
        let n_faces = self.mesh.n_faces();
        let body = Arc::new(self);
        let mut add = |n: usize, push: fn(&Self, &mut Vec<u8>, Range<usize>)| {
            for start in (0..n).step_by(BLOCK) {
                let body = Arc::clone(&body);
                let range = start..n.min(start + BLOCK);
                blocks.push(Box::new(move |out| push(&body, out, range.clone())));
            }
        };
        add(n_vertices, Self::push_vertices);
        add(n_uvs, Self::push_uvs);
        add(n_normals, Self::push_normals);
        add(n_faces, Self::push_faces);
        let last = body.last_face();
        if last.is_some_and(|last| body.states.is_grouped(last)) {
            blocks.push(Box::new(|out| out.extend_from_slice(b"g\n")));
        }
    }

    fn push_vertices(&self, out: &mut Vec<u8>, range: Range<usize>) {
        for v in range.map(|i| self.vertices.vertex(i)) {
            let p = self.mesh.positions()[v];
            match self.colors {
                None => push_values(out, "v", &p.to_array()),
                Some(colors) => {
                    let [r, g, b] = finite(colors[v].truncate().to_array());
                    push_values(out, "v", &[p.x, p.y, p.z, r, g, b]);
                }
            }
        }
    }

    fn push_uvs(&self, out: &mut Vec<u8>, range: Range<usize>) {
        let Some((uvs, numbers)) = &self.uvs else {
            return;
        };
        for h in &numbers.firsts()[range] {
            push_values(out, "vt", &finite(uvs[h.index()].to_array()));
        }
    }

    fn push_normals(&self, out: &mut Vec<u8>, range: Range<usize>) {
        let Some((normals, numbers)) = &self.normals else {
            return;
        };
        for &h in &numbers.firsts()[range] {
            push_values(out, "vn", &finite(normals.of(self.mesh, h).to_array()));
        }
    }

    fn push_faces(&self, out: &mut Vec<u8>, range: Range<usize>) {
        let [positions, uvs, normals] = self.before.counts;
        let mut before = range.start.checked_sub(1).map(FaceId::new);
        for f in range.map(FaceId::new) {
            if before.is_none_or(|before| !self.states.same(before, f)) {
                let from = before.map_or_else(
                    || FaceState {
                        material: self.before.material,
                        smoothing: self.before.smoothing,
                        ..FaceState::default()
                    },
                    |before| self.states.of(before),
                );
                push_change(out, &from, &self.states.of(f), self.library);
            }
            before = Some(f);
            out.push(b'f');
            for h in self.mesh.face_half_edges(f) {
                out.push(b' ');
                push_whole(
                    out,
                    positions + self.vertices.number(self.mesh.origin(h)) + 1,
                );
                if let Some((_, numbers)) = &self.uvs {
                    out.push(b'/');
                    push_whole(out, uvs + numbers.number(h) + 1);
                }
                if let Some((_, numbers)) = &self.normals {
                    let separator: &[u8] = if self.uvs.is_some() { b"/" } else { b"//" };
                    out.extend_from_slice(separator);
                    push_whole(out, normals + numbers.number(h) + 1);
                }
            }
            out.push(b'\n');
        }
    }
}

/// Appends the statements that change the face state (groups, object, material and smoothing group) from `from` to
/// `to`.
fn push_change(out: &mut Vec<u8>, from: &FaceState, to: &FaceState, library: &Library) {
    if let (true, Some(object)) = (to.object != from.object, to.object) {
        push_name(out, "o", object);
    }
    if to.groups != from.groups {
        out.push(b'g');
        for group in &to.groups {
            out.push(b' ');
            out.extend_from_slice(one_word(group).as_bytes());
        }
        out.push(b'\n');
    }
    if to.material != from.material {
        let name = to.material.map(|m| library.materials[m].name.as_bytes());
        out.extend_from_slice(b"usemtl ");
        out.extend_from_slice(name.unwrap_or(NO_MATERIAL));
        out.push(b'\n');
    }
    if to.smoothing != from.smoothing {
        out.extend_from_slice(b"s ");
        push_whole(out, usize::try_from(to.smoothing).unwrap_or(0));
        out.push(b'\n');
    }
}

fn lost_colors(colors: &[DVec4], losses: &mut Losses) {
    let n = colors.len();
    let translucent = parallel::count(n, |v| (colors[v].w - 1.0).abs() > 0.0);
    let broken = parallel::count(n, |v| !colors[v].truncate().is_finite());
    let domain = Domain::Vertex;
    losses.add(domain, "color", translucent, "OBJ cannot store alpha");
    losses.add(domain, "color", broken, NOT_FINITE);
}

/// The number of distinct values.
fn count<T>(values: Option<&(T, CornerNumbers)>) -> usize {
    values.map_or(0, |(_, numbers)| numbers.firsts().len())
}

/// Assigns numbers to the distinct values on the corners of each vertex. Adds a loss for the values that are not
/// finite.
fn numbers<const N: usize>(
    mesh: &Mesh,
    value: impl Fn(HalfEdgeId) -> [f64; N] + Sync,
    attribute: &str,
    losses: &mut Losses,
) -> CornerNumbers {
    let broken = parallel::count(mesh.n_half_edges(), |h| {
        let h = HalfEdgeId::new(h);
        mesh.face(h).is_some() && value(h).iter().any(|x| !x.is_finite())
    });
    losses.add(Domain::Corner, attribute, broken, NOT_FINITE);
    let bits = |h| finite(value(h)).map(f64::to_bits);
    CornerNumbers::new(mesh, |a, b| bits(a) == bits(b))
}

/// Returns the values unchanged if all of them are finite. Otherwise, returns only zeros.
fn finite<const N: usize>(values: [f64; N]) -> [f64; N] {
    let all = values.iter().all(|x| x.is_finite());
    if all { values } else { [0.0; N] }
}
