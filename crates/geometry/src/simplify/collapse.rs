//! The main loop of simplification, which collapses edges.
//!
//! The edges of a pass are visited in batches. Each batch has four stages. The first and the third stage compute in
//! parallel, without changing the mesh. The second and the fourth stage change the state, edge by edge in the order of
//! the batch. Therefore the result does not depend on the number of threads.
//!
//! 1. The cost of an edge is computed again if one of its ends has changed. An edge is a candidate under two conditions:
//!    its cost is not above the cost levels of the pass, and no edge near it was chosen in an earlier batch of this pass.
//! 2. A candidate is chosen if no edge near it was chosen before.
//! 3. For each chosen edge, the new position and values are computed, and the collapse is checked.
//! 4. The chosen edges are collapsed. The chosen edges are so far from each other that no collapse changes the results
//!    of the third stage for another chosen edge.
//!
//! Most of the time is spent waiting for memory. Therefore the memory for the next edges is prefetched, and the mesh is
//! compacted whenever half of its faces are gone.

use mesh::{DVec3, Domain, EdgeId, FaceId, HalfEdgeId, parallel, prefetch};
use progress::{Cancelled, Meter, Progress};

use crate::lines::Kind;

use super::Blocked;
use super::appearance::Merge;
use super::collapser::{Collapser, Node, State};
use super::queue::{Entry, Level, level_of};

/// The number of edges in a batch. With smaller batches, threads wait for each other more often: with 1024 edges, a
/// torus of 1,000,000 triangles takes 1.3 times as long on two processors.
const BATCH: usize = 65_536;

/// The memory of an edge is prefetched this number of edges before the cost of the edge is computed.
const AHEAD: usize = 8;

/// The number of edges of a batch that a thread visits at a time in the first stage. For a much smaller number of
/// edges, waking a thread would take longer than visiting the edges.
const PART: usize = 2048;

/// While the mesh has more than `FAR` times the requested number of faces, and more than [`LARGE`] faces, a pass visits
/// [`FAR_LEVELS`] levels of the queue. The exact order of these early collapses matters little, because later collapses
/// move the surface much farther. With an error limit, each pass visits one level. With four levels, up to a tenth more
/// triangles would remain for the same limit.
const FAR: usize = 2;

/// See [`FAR`]. Passes over single levels give slightly better results for meshes with fewer faces. A mesh with this
/// number of faces is simplified in about 30 ms.
const LARGE: usize = 30_000;

/// See [`FAR`]. A torus of 1,000,000 triangles is reduced to a sixteenth in 0.8 of the time that passes over single
/// levels take. Four models with 280,000 to 370,000 triangles were reduced to between 40 % and 0.5 % of their triangles.
/// On average, the RMS distance from the original stays the same, and the largest distance grows by 3 %. Single results
/// vary more: the RMS distance changes by factors from 0.96 to 1.02, and the largest distance by factors from 0.85 to
/// 1.56.
const FAR_LEVELS: usize = 4;

/// The data that is computed for an allowed collapse before the mesh changes.
struct Plan {
    /// The new position, in the coordinates of the mesh.
    point: DVec3,
    /// The faces around the edge that remain after the collapse, with new bounds on their distance to the original
    /// surface.
    errors: Vec<(FaceId, f64)>,
    values: Option<Merge>,
}

/// The edges of a part of a batch, divided into groups by the first stage.
#[derive(Default)]
struct Part {
    /// The edges that can be collapsed next.
    candidates: Vec<Entry>,
    /// The edges near an edge that was chosen for a collapse earlier in this pass.
    waiting: Vec<Entry>,
    /// The edges with a cost above the levels of the pass, and the edges that cannot be collapsed. Each edge has the
    /// level of its cost, or the reason why it cannot be collapsed.
    later: Vec<(EdgeId, Result<Level, Blocked>)>,
}

impl Collapser<'_> {
    /// Collapses edges until the mesh has at most the requested number of faces, or until no remaining edge can be
    /// collapsed.
    ///
    /// # Errors
    ///
    /// Returns [`Cancelled`] if `progress` asks to stop.
    pub(super) fn run(&mut self, progress: &dyn Progress) -> Result<(), Cancelled> {
        self.fill_queue(progress)?;
        let start = self.n_faces;
        let mut edges: Vec<Entry> = Vec::new();
        while self.n_faces > self.options.faces {
            if self.mesh.domain_len(Domain::Face) > 2 * self.n_faces {
                self.compact();
            }
            let is_far = self.n_faces > LARGE && self.n_faces / FAR > self.options.faces;
            let is_coarse = is_far && self.options.error.is_none();
            let n_levels = if is_coarse { FAR_LEVELS } else { 1 };
            if !self.queue.next_pass(n_levels, &mut edges) {
                break;
            }
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

    /// Computes the costs of all edges, and adds the edges to the queue.
    fn fill_queue(&mut self, progress: &dyn Progress) -> Result<(), Cancelled> {
        let meter = Meter::new(progress, "prepare", self.mesh.n_edges() as u64);
        let blocks = parallel::blocks(self.mesh.n_edges(), |block| {
            meter.add(block.len())?;
            let level = |e| {
                if e + AHEAD < block.end {
                    self.fetch(EdgeId::new(e + AHEAD));
                }
                self.level(EdgeId::new(e))
            };
            Ok(block.clone().map(level).collect::<Vec<_>>())
        });
        let blocks = blocks.into_iter().collect::<Result<Vec<_>, _>>()?;
        for (e, level) in blocks.into_iter().flatten().enumerate() {
            self.enqueue(EdgeId::new(e), level);
        }
        Ok(())
    }

    fn visit(&mut self, batch: &[Entry]) {
        let parts: Vec<&[Entry]> = batch.chunks(PART).collect();
        let parts = parallel::map(parts.len(), |i| self.sort_out(parts[i]));
        let mut candidates = Vec::new();
        for part in parts {
            for (e, level) in part.later {
                self.enqueue(e, level);
            }
            for entry in part.waiting {
                self.queue.push_again(entry);
            }
            candidates.extend(part.candidates);
        }
        let chosen = self.choose(&candidates);
        let plans = parallel::collect(chosen.len(), |i| {
            self.mesh.fetch_ahead(&chosen, i);
            if let Some(&later) = chosen.get(i + AHEAD) {
                self.fetch(later);
            }
            self.plan(chosen[i])
        });
        for (i, (&e, plan)) in chosen.iter().zip(plans).enumerate() {
            self.mesh.fetch_ahead(&chosen, i);
            if self.n_faces <= self.options.faces {
                break;
            }
            if let Err(reason) = plan.and_then(|plan| self.collapse(e, plan)) {
                self.enqueue(e, Err(reason));
            }
        }
    }

    /// Asks the processor to prefetch the memory that the cost of an edge needs.
    fn fetch(&self, e: EdgeId) {
        for v in self.mesh.edge_vertices(e) {
            prefetch(self.mesh.positions(), v.index());
            prefetch(&self.nodes, v.index());
            prefetch(&self.marks, v.index());
        }
    }

    /// Divides edges into the groups of [`Part`]. For this, computes the cost of an edge again if one of its ends has
    /// changed.
    fn sort_out(&self, entries: &[Entry]) -> Part {
        let pass = self.queue.pass();
        let mut part = Part::default();
        for (i, &entry) in entries.iter().enumerate() {
            if let Some(later) = entries.get(i + AHEAD) {
                self.fetch(later.edge);
            }
            let e = entry.edge;
            // An earlier collapse can have removed the edge.
            if !self.mesh.has_edge(e) {
                continue;
            }
            let ends = self.mesh.edge_vertices(e);
            let marks = ends.map(|v| self.marks[v.index()]);
            if marks.iter().any(|mark| mark.touched == pass) {
                part.waiting.push(entry);
                continue;
            }
            // The cost of an edge on a line also depends on the vertices of the line just before and just after the
            // edge. Therefore this cost is always computed again.
            let is_line = self.lines[e.index()];
            if !is_line && marks.iter().all(|mark| mark.changed < entry.computed) {
                part.candidates.push(entry);
                continue;
            }
            match self.level(e) {
                Ok(level) if !self.queue.is_later(level) => {
                    let computed = pass;
                    part.candidates.push(Entry { edge: e, computed });
                }
                level => part.later.push((e, level)),
            }
        }
        part
    }

    /// Returns the edges that are collapsed next. Puts the other candidates back into the queue.
    fn choose(&mut self, candidates: &[Entry]) -> Vec<EdgeId> {
        let pass = self.queue.pass();
        let mut chosen = Vec::new();
        for &entry in candidates {
            let ends = self.mesh.edge_vertices(entry.edge);
            // The cost of an edge usually grows when edges near it collapse. Edges near a collapse wait for the next
            // pass, so that the collapses of a pass are spread over the surface.
            if ends.iter().any(|v| self.marks[v.index()].touched == pass) {
                self.queue.push_again(entry);
                continue;
            }
            for v in ends {
                for w in self.mesh.vertex_neighbors(v) {
                    self.marks[w.index()].touched = pass;
                }
            }
            chosen.push(entry.edge);
        }
        chosen
    }

    /// Returns the level of the cost of an edge.
    fn level(&self, e: EdgeId) -> Result<Level, Blocked> {
        self.target(e).map(|target| level_of(target.cost))
    }

    fn enqueue(&mut self, edge: EdgeId, level: Result<Level, Blocked>) {
        match level {
            Ok(level) => {
                let computed = self.queue.pass();
                self.queue.push(Entry { edge, computed }, level);
            }
            Err(reason) => self.states[edge.index()] = State::Blocked(reason),
        }
    }

    /// Checks whether the collapse of an edge is allowed, and computes the data for the collapse. Intersections are
    /// checked later, in `collapse`.
    fn plan(&self, e: EdgeId) -> Result<Plan, Blocked> {
        let target = self.target(e)?;
        self.check(e, &target)?;
        let plan = Plan {
            point: match target.end {
                Some(v) => self.mesh.position(v),
                None => target.point / self.scale + self.center,
            },
            errors: self.errors_after(e, &target)?,
            values: self.values_after(e, &target)?,
        };
        let topology = self.mesh.check_collapse_to(e, plan.point);
        topology.map_err(|_| Blocked::Topology).map(|()| plan)
    }

    fn collapse(&mut self, e: EdgeId, plan: Plan) -> Result<(), Blocked> {
        let [a, b] = self.mesh.edge_vertices(e);
        let mut around: Vec<FaceId> = Vec::new();
        if let Some(contacts) = &self.contacts {
            if contacts.arise(&self.mesh, [a, b], plan.point) {
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
        let v = self.mesh.collapse_checked_edge_to(e, plan.point);
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
