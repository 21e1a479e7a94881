//! The state of a simplification: the mesh, and what is known about its vertices, edges and faces.

use mesh::{DVec3, HalfEdgeId, Mesh, VertexId, parallel};
use progress::{Cancelled, Progress};

use crate::lines::{Kind, inverse_power_of_two, kinds, lines};

use super::appearance::Appearance;
use super::contact::Contacts;
use super::kept::{keep, kept};
use super::quadric::{Quadric, Spread};
use super::queue::{Entry, Level, Queue};
use super::{Blocked, Options};

/// Whether an edge waits in the queue, or why it cannot be collapsed.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum State {
    Queued,
    Blocked(Blocked),
}

/// The properties of a vertex from which the costs of its edges are computed.
#[derive(Clone, Copy)]
pub(super) struct Node {
    pub(super) quadric: Quadric,
    pub(super) spread: Spread,
    pub(super) kind: Kind,
}

/// When a vertex or its surroundings last changed: numbers of passes.
#[derive(Clone, Copy, Default)]
pub(super) struct Mark {
    /// The last pass in which an edge at the vertex or at one of its neighbors was chosen for a collapse.
    pub(super) touched: u32,
    /// The last pass in which an edge was collapsed to the vertex.
    pub(super) changed: u32,
}

pub(super) struct Collapser<'a> {
    pub(super) mesh: Mesh,
    pub(super) n_faces: usize,
    /// The interpolated attributes of vertices and corners, if there are any.
    pub(super) appearance: Option<Appearance>,
    /// Distances are computed in coordinates relative to `center`, which are scaled by a power of two. In these
    /// coordinates, the size of the mesh does not matter: very small and very large meshes of the same shape give the
    /// same result.
    pub(super) center: DVec3,
    pub(super) scale: f64,
    /// For each vertex, the data from which the costs of its edges are computed.
    pub(super) nodes: Vec<Node>,
    /// For each vertex, when it or its surroundings last changed.
    pub(super) marks: Vec<Mark>,
    /// For each face index, a bound on the distance between the face and the original surface. The list is empty if
    /// there is no error limit.
    pub(super) errors: Vec<f64>,
    /// For each edge index, whether the edge is a part of a preserved line.
    pub(super) lines: Vec<bool>,
    pub(super) states: Vec<State>,
    pub(super) queue: Queue,
    /// The tree of the bounding boxes of all faces, with which intersections are found. `None` if collapses that cause
    /// intersections are allowed.
    pub(super) contacts: Option<Contacts>,
    pub(super) options: &'a Options<'a>,
}

impl<'a> Collapser<'a> {
    /// Prepares the simplification of a dense mesh of triangles.
    ///
    /// # Errors
    ///
    /// Returns [`Cancelled`] if `progress` asks to stop.
    pub(super) fn new(
        mut mesh: Mesh,
        options: &'a Options<'a>,
        progress: &dyn Progress,
    ) -> Result<Self, Cancelled> {
        let per_vertex = size_of::<Node>() + size_of::<Mark>();
        let per_edge =
            size_of::<State>() + size_of::<Result<Level, Blocked>>() + 2 * size_of::<Entry>();
        mesh::require_memory(per_vertex * mesh.n_vertices() + per_edge * mesh.n_edges());
        let [min, max] = crate::bounds(&mesh).unwrap_or_default();
        let center = 0.5 * min + 0.5 * max;
        let scale = inverse_power_of_two((max - min).max_element());
        let lines = lines(&mesh, options.features);
        let place = |mesh: &Mesh, v: VertexId| (mesh.position(v) - center) * scale;
        let nodes = nodes(&mesh, &lines, options.pinned, |v| place(&mesh, v));
        let n_errors = options.error.map_or(0, |_| mesh.n_faces());
        Ok(Self {
            n_faces: mesh.n_faces(),
            appearance: Appearance::take(&mut mesh, &lines, place),
            center,
            scale,
            nodes,
            marks: vec![Mark::default(); mesh.n_vertices()],
            errors: vec![0.0; n_errors],
            lines,
            states: vec![State::Queued; mesh.n_edges()],
            queue: Queue::new(),
            contacts: if options.refuse_intersections {
                Contacts::new(&mesh, progress)?
            } else {
                None
            },
            options,
            mesh,
        })
    }

    /// Returns the position of a vertex, in scaled coordinates.
    pub(super) fn position(&self, v: VertexId) -> DVec3 {
        (self.mesh.position(v) - self.center) * self.scale
    }

    /// Removes the gaps that removed elements have left in the mesh and in all lists. Smaller lists fit better into the
    /// caches of the processor. The order of the elements does not change.
    pub(super) fn compact(&mut self) {
        let Some(map) = self.mesh.compact() else {
            return;
        };
        let vertices = kept(&map.vertices);
        keep(&mut self.nodes, &vertices);
        keep(&mut self.marks, &vertices);
        let edges = kept(&map.edges);
        keep(&mut self.lines, &edges);
        keep(&mut self.states, &edges);
        self.queue.renumber(&map.edges);
        if self.options.error.is_some() {
            keep(&mut self.errors, &kept(&map.faces));
        }
        if let Some(contacts) = &mut self.contacts {
            contacts.renumber(&map.faces);
        }
        if let Some(appearance) = &mut self.appearance {
            appearance.renumber(&map);
        }
    }
}

/// Returns the [`Node`] of each vertex. `place` returns the scaled position of a vertex.
fn nodes(
    mesh: &Mesh,
    lines: &[bool],
    pinned: &[VertexId],
    place: impl Fn(VertexId) -> DVec3 + Sync,
) -> Vec<Node> {
    let triangle = |h: HalfEdgeId| {
        let next = mesh.next(h);
        [h, next, mesh.next(next)].map(|h| place(mesh.origin(h)))
    };
    let kinds = kinds(mesh, lines, pinned);
    parallel::collect(mesh.n_vertices(), |v| {
        let (v, kind) = (VertexId::new(v), kinds[v]);
        let (mut quadric, mut spread) = (Quadric::default(), Spread::default());
        for h in mesh.vertex_half_edges(v) {
            // Each triangle contributes a third of its area to each of its vertices.
            if mesh.face(h).is_some() {
                let [a, b, c] = triangle(h);
                let cross = (b - a).cross(c - a);
                let length = cross.length();
                if length > 0.0 {
                    let area = length / 6.0;
                    quadric = quadric + Quadric::plane(cross / length, a, area);
                    spread = spread + Spread::at_point((a + b + c) / 3.0, area);
                }
            }
            if lines[h.edge().index()] {
                for h in h.edge().half_edges() {
                    if mesh.face(h).is_some() {
                        quadric = quadric + across_line(triangle(h));
                    }
                }
            }
        }
        Node {
            quadric,
            spread,
            kind,
        }
    })
}

/// Returns a quadric: the squared distance to a plane, times the squared length of the side from `a` to `b` of a
/// triangle. The plane contains this side and is perpendicular to the triangle. The returned quadric keeps the vertices
/// of a line near the line.
fn across_line([a, b, c]: [DVec3; 3]) -> Quadric {
    let along = b - a;
    let across = along.cross(c - a).cross(along).try_normalize();
    across.map_or_else(Quadric::default, |across| {
        Quadric::plane(across, a, along.length_squared())
    })
}
