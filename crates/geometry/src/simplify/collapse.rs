//! The main loop of simplification, which collapses edges.
//!
//! The edges of a pass are visited in batches. Each batch has four stages. The first and the third stage compute in
//! parallel, without changing the mesh. The second and the fourth stage change the state, edge by edge in the order of
//! the batch. Therefore the result does not depend on the number of threads.
//!
//! 1. The cost of an edge is computed again if one of its ends has changed.
//! 2. An edge is chosen under two conditions: its cost is not above the cost level of the pass, and no edge near it was
//!    chosen before in this pass.
//! 3. For each chosen edge, the new position and values are computed, and the collapse is checked.
//! 4. The chosen edges are collapsed. The chosen edges are so far from each other that no collapse changes the results
//!    of the third stage for another chosen edge.

use mesh::{DVec3, EdgeId, FaceId, HalfEdgeId, Mesh, VertexId, parallel};
use progress::{Cancelled, Meter, Progress};

use crate::lines::{Kind, inverse_power_of_two, kinds, lines};

use super::appearance::{Appearance, Around, Pair};
use super::contact::Contacts;
use super::quadric::{Quadric, Spread};
use super::queue::{Entry, Queue};
use super::target::Target;
use super::{Blocked, Options};

/// The number of edges in a batch. With smaller batches, threads wait for each other more often: with 1024 edges, a
/// torus of 1,000,000 triangles takes 1.3 times as long on two processors.
const BATCH: usize = 16_384;

/// The number of edges between two progress reports while the first costs are computed.
const REPORT: usize = 4096;

/// Whether an edge waits in the queue, or why it cannot be collapsed.
#[derive(Clone, Copy, PartialEq)]
enum State {
    Queued,
    Blocked(Blocked),
}

/// The properties of a vertex from which the costs of its edges are computed.
#[derive(Clone, Copy)]
pub(super) struct Node {
    /// The position, in scaled coordinates.
    pub(super) point: DVec3,
    pub(super) quadric: Quadric,
    pub(super) spread: Spread,
    pub(super) kind: Kind,
}

/// The passes in which a vertex or its surroundings last changed.
#[derive(Clone, Copy, Default)]
struct Mark {
    /// The last pass in which an edge at the vertex or at one of its neighbors was chosen for a collapse.
    touched: u32,
    /// The last pass in which an edge was collapsed to the vertex.
    changed: u32,
}

pub(super) struct Collapser<'a> {
    pub(super) mesh: Mesh,
    n_faces: usize,
    /// The interpolated attributes of vertices and corners, if there are any.
    pub(super) appearance: Option<Appearance>,
    /// Distances are computed in coordinates relative to `center`, which are scaled by a power of two. In these
    /// coordinates, the size of the mesh does not matter: very small and very large meshes of the same shape give the
    /// same result.
    center: DVec3,
    pub(super) scale: f64,
    /// For each vertex, the data from which the costs of its edges are computed.
    pub(super) nodes: Vec<Node>,
    /// For each vertex, the passes in which it last changed.
    marks: Vec<Mark>,
    /// For each face index, a bound on the distance between the face and the original surface. The list is empty if
    /// there is no error limit.
    pub(super) errors: Vec<f64>,
    /// For each edge index, whether the edge is a part of a preserved line.
    pub(super) lines: Vec<bool>,
    states: Vec<State>,
    queue: Queue,
    /// The tree of the boxes of the faces. `None` if collapses that cause intersections are allowed.
    contacts: Option<Contacts>,
    pub(super) options: &'a Options<'a>,
}

/// The faces around an edge before its collapse, and the pairs of wedges (groups of face corners at a vertex) that the
/// collapse merges, with their new values.
pub(super) type Values = (Around, Vec<(Pair, Vec<f64>)>);

/// The data that is computed for an allowed collapse before the mesh changes.
struct Plan {
    target: Target,
    /// The faces around the edge that remain after the collapse, with new bounds on their distance to the original
    /// surface.
    errors: Vec<(FaceId, f64)>,
    values: Option<Values>,
}

/// What the first stage of a batch finds out about an edge.
#[derive(Clone, Copy)]
enum Cost {
    /// An earlier collapse has removed the edge.
    Gone,
    /// The edge is near an edge that was chosen for a collapse earlier in this pass.
    Touched,
    Unchanged,
    New(Result<f64, Blocked>),
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
        let meter = Meter::new(progress, "prepare", mesh.n_edges() as u64);
        meter.add(0)?;
        let per_vertex = size_of::<Node>() + size_of::<Mark>();
        let per_edge =
            size_of::<State>() + size_of::<Result<f64, Blocked>>() + 2 * size_of::<Entry>();
        mesh::require_memory(per_vertex * mesh.n_vertices() + per_edge * mesh.n_edges());
        let [min, max] = crate::bounds(&mesh).unwrap_or_default();
        let center = 0.5 * min + 0.5 * max;
        let scale = inverse_power_of_two((max - min).max_element());
        let lines = lines(&mesh, options.features);
        let place = |mesh: &Mesh, v: VertexId| (mesh.position(v) - center) * scale;
        let nodes = nodes(&mesh, &lines, options.pinned, |v| place(&mesh, v));
        let n_errors = options.error.map_or(0, |_| mesh.n_faces());
        let mut this = Self {
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
        };
        meter.add(0)?;
        let mut costs = vec![Ok(0.0); this.mesh.n_edges()];
        let done = parallel::consume(costs.chunks_mut(REPORT), |i, costs| {
            for (e, cost) in (i * REPORT..).zip(&mut *costs) {
                *cost = this.target(EdgeId::new(e)).map(|target| target.cost);
            }
            meter.add(costs.len())
        });
        done.into_iter().collect::<Result<(), Cancelled>>()?;
        for (e, cost) in costs.into_iter().enumerate() {
            this.enqueue(EdgeId::new(e), cost);
        }
        Ok(this)
    }

    /// Collapses edges until the mesh has at most the requested number of faces, or until no remaining edge can be
    /// collapsed.
    pub(super) fn run(&mut self, progress: &dyn Progress) -> Result<(), Cancelled> {
        let start = self.n_faces;
        let mut edges: Vec<Entry> = Vec::new();
        while self.n_faces > self.options.faces && self.queue.next_pass(&mut edges) {
            // Edges with near ids are often near in memory too, so visiting them in this order is faster.
            edges.sort_by_key(|entry| entry.edge);
            for batch in edges.chunks(BATCH) {
                if self.n_faces <= self.options.faces {
                    break;
                }
                let (done, total) = (start - self.n_faces, start - self.options.faces);
                progress.report("simplify", done as u64, total as u64)?;
                self.visit(batch);
            }
        }
        Ok(())
    }

    /// Returns, for each reason, the number of edges that cannot be collapsed for this reason. Reasons without edges
    /// are left out.
    pub(super) fn blocked(&self) -> Vec<(Blocked, usize)> {
        let blocked = |e: EdgeId| match self.states[e.index()] {
            State::Blocked(reason) => Some(reason),
            State::Queued => None,
        };
        let count = |reason| {
            self.mesh
                .edges()
                .filter(|&e| blocked(e) == Some(reason))
                .count()
        };
        let counts = Blocked::ALL
            .into_iter()
            .map(|reason| (reason, count(reason)));
        counts.filter(|&(_, count)| count > 0).collect()
    }

    fn visit(&mut self, batch: &[Entry]) {
        let costs = parallel::collect(batch.len(), |i| self.cost(batch[i]));
        let chosen = self.choose(batch, &costs);
        let plans = parallel::collect(chosen.len(), |i| self.plan(chosen[i]));
        for (e, plan) in chosen.into_iter().zip(plans) {
            if self.n_faces <= self.options.faces {
                break;
            }
            if let Err(reason) = plan.and_then(|plan| self.collapse(e, plan)) {
                self.enqueue(e, Err(reason));
            }
        }
    }

    fn cost(&self, Entry { edge, computed }: Entry) -> Cost {
        if !self.mesh.has_edge(edge) {
            return Cost::Gone;
        }
        let ends = self.mesh.edge_vertices(edge);
        let marks = ends.map(|v| self.marks[v.index()]);
        if marks.iter().any(|mark| mark.touched == self.queue.pass()) {
            return Cost::Touched;
        }
        // The cost of an edge on a line also depends on the vertices of the line just before and just after the edge.
        // Therefore this cost is always computed again.
        let is_line = self.lines[edge.index()];
        if !is_line && marks.iter().all(|mark| mark.changed < computed) {
            return Cost::Unchanged;
        }
        Cost::New(self.target(edge).map(|target| target.cost))
    }

    /// Returns the edges of a batch that are collapsed next. Puts the other edges of the batch back into the queue.
    fn choose(&mut self, batch: &[Entry], costs: &[Cost]) -> Vec<EdgeId> {
        let pass = self.queue.pass();
        let mut chosen = Vec::new();
        for (&entry, &cost) in batch.iter().zip(costs) {
            let e = entry.edge;
            match cost {
                Cost::Gone => continue,
                Cost::Touched => {
                    self.queue.push_again(entry);
                    continue;
                }
                Cost::New(cost) if cost.is_err() || cost.is_ok_and(|c| self.queue.is_later(c)) => {
                    self.enqueue(e, cost);
                    continue;
                }
                Cost::New(_) | Cost::Unchanged => {}
            }
            let ends = self.mesh.edge_vertices(e);
            // The cost of an edge usually grows when edges near it collapse. Edges near a collapse wait for the next
            // pass, so that the collapses of a pass are spread over the surface.
            if ends.iter().any(|v| self.marks[v.index()].touched == pass) {
                let computed = match cost {
                    Cost::New(_) => pass,
                    _ => entry.computed,
                };
                self.queue.push_again(Entry { edge: e, computed });
                continue;
            }
            for v in ends {
                for w in self.mesh.vertex_neighbors(v) {
                    self.marks[w.index()].touched = pass;
                }
            }
            chosen.push(e);
        }
        chosen
    }

    fn enqueue(&mut self, edge: EdgeId, cost: Result<f64, Blocked>) {
        self.states[edge.index()] = match cost {
            Ok(cost) => {
                let computed = self.queue.pass();
                self.queue.push(Entry { edge, computed }, cost);
                State::Queued
            }
            Err(reason) => State::Blocked(reason),
        };
    }

    /// Checks whether the collapse of an edge is allowed, and computes the data for the collapse. Topology and
    /// intersections are checked later, in `collapse`.
    fn plan(&self, e: EdgeId) -> Result<Plan, Blocked> {
        let target = self.target(e)?;
        self.check(e, &target)?;
        Ok(Plan {
            errors: self.errors_after(e, &target)?,
            values: self.values_after(e, &target)?,
            target,
        })
    }

    fn collapse(&mut self, e: EdgeId, plan: Plan) -> Result<(), Blocked> {
        let [a, b] = self.mesh.edge_vertices(e);
        let point = match plan.target.end {
            Some(v) => self.mesh.position(v),
            None => plan.target.point / self.scale + self.center,
        };
        let mut around: Vec<FaceId> = Vec::new();
        if let Some(contacts) = &self.contacts {
            if contacts.arise(&self.mesh, [a, b], point) {
                return Err(Blocked::Intersections);
            }
            around.extend([a, b].into_iter().flat_map(|v| self.mesh.vertex_faces(v)));
        }
        let sides = e.half_edges().map(|h| {
            let next = self.mesh.next(h);
            let edges = [next, self.mesh.next(next)].map(HalfEdgeId::edge);
            let is_line = edges.iter().any(|e| self.lines[e.index()]);
            self.mesh.face(h).map(|_| (edges, is_line))
        });
        let v = self.mesh.collapse_edge_to(e, point);
        let v = v.map_err(|_| Blocked::Topology)?;
        if let (Some(appearance), Some((around, merged))) = (&mut self.appearance, plan.values) {
            appearance.merge(&self.mesh, [a, b], v, &around, merged);
        }
        if let Some(contacts) = &mut self.contacts {
            for f in around {
                contacts.update(&self.mesh, f);
            }
        }
        for (f, error) in plan.errors {
            self.errors[f.index()] = error;
        }
        for (edges, is_line) in sides.into_iter().flatten() {
            self.n_faces -= 1;
            for e in edges {
                self.lines[e.index()] = is_line;
            }
        }
        let [from, to] = [&self.nodes[a.index()], &self.nodes[b.index()]];
        self.nodes[v.index()] = Node {
            point: (self.mesh.position(v) - self.center) * self.scale,
            quadric: from.quadric + to.quadric,
            spread: from.spread + to.spread,
            kind: match [from.kind, to.kind] {
                kinds if kinds.contains(&Kind::Fixed) => Kind::Fixed,
                kinds if kinds.contains(&Kind::Line) => Kind::Line,
                _ => Kind::Inside,
            },
        };
        self.marks[v.index()].changed = self.queue.pass();
        // Edges at the vertex that were blocked before can possibly be collapsed now, so they are queued again.
        for e in self.mesh.vertex_half_edges(v).map(HalfEdgeId::edge) {
            let state = &mut self.states[e.index()];
            if *state != State::Queued {
                *state = State::Queued;
                self.queue.push_again(Entry {
                    edge: e,
                    computed: 0,
                });
            }
        }
        Ok(())
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
            point: place(v),
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
