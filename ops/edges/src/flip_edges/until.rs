//! Flips edges until no flip improves the mesh, or until the limit of passes is reached.
//!
//! A pass checks edges in order of their ids. The first pass checks all edges. A flip changes the edges at four
//! vertices. Each later pass checks the edges near the vertices that the previous pass changed in this way, and the
//! edges whose flip the previous pass refused. For all other edges, the result of the check would be the same as in the
//! previous pass. (A flip is refused if an edge already joins the two opposite corners. If this joining edge is
//! flipped, both of its former ends count as changed vertices.) A pass that flips no edge is the last pass. Every pass
//! again checks all edges whose flip the previous pass refused, so the report counts only the refusals of the last
//! pass.

use mesh::{EdgeId, EditError, FaceId, Mesh, VertexId};
use op::{Context, OpError, Report};

use crate::flip_edges::goal::{Goal, Quad};

/// Calls `flip` for each edge in `edges` whose flip improves the mesh according to `goal`. `passes` is the largest
/// number of passes over the edges.
///
/// # Errors
///
/// Returns [`OpError::Cancelled`] if the run was canceled. Edges that were flipped before the cancellation stay
/// flipped.
pub(crate) fn flip_until(
    mesh: &mut Mesh,
    edges: &[EdgeId],
    mut goal: Goal,
    passes: u32,
    cx: &Context,
    mut flip: impl FnMut(&mut Mesh, EdgeId) -> Result<(), EditError>,
) -> Result<Report, OpError> {
    let mut report = Report::default();
    if edges.is_empty() {
        report.notes.push("nothing was selected".to_owned());
    }
    let mut to_check = Vec::new();
    for &e in edges {
        match polygon_beside(mesh, e) {
            _ if mesh.is_boundary_edge(e) => {}
            None => to_check.push(e),
            Some(f) => report.refuse(OpError::refused_edit(
                EditError::NotTriangle(f),
                mesh,
                &[e.into()],
            ))?,
        }
    }
    let mut changed = ChangedNeighborhood::new(mesh, &to_check);
    let mut refused = Vec::new();
    let mut done_passes = 0;
    let mut at_goal = false;
    while !at_goal && done_passes < passes {
        refused.clear();
        at_goal = true;
        let total = to_check.len() as u64;
        for (done, &e) in (0..).zip(&to_check) {
            if done % 4096 == 0 {
                cx.advance("flip", done, total)?;
            }
            let quad = Quad::beside(mesh, e);
            if !goal.is_improvement(mesh, &quad) {
                continue;
            }
            match flip(mesh, e) {
                Ok(()) => {
                    goal.flipped(&quad);
                    changed.add(&quad);
                    report.changed += 1;
                    at_goal = false;
                }
                Err(reason) => refused.push((e, reason)),
            }
        }
        done_passes += 1;
        to_check = changed.take_edges(mesh, refused.iter().map(|&(e, _)| e));
    }
    for (e, reason) in refused {
        report.refuse(OpError::refused_edit(reason, mesh, &[e.into()]))?;
    }
    Ok(report.note(if at_goal {
        format!("passes: {done_passes}; no further flip that is allowed would improve the mesh")
    } else {
        format!(
            "passes: {done_passes}, which is the limit set by `passes`; with a higher limit, the mesh could improve further"
        )
    }))
}

/// Returns a face beside `e` that is not a triangle, if one exists.
fn polygon_beside(mesh: &Mesh, e: EdgeId) -> Option<FaceId> {
    let beside = mesh.edge_faces(e).into_iter().flatten();
    beside.into_iter().find(|&f| !mesh.is_triangle(f))
}

/// Collects the edges near the vertices at which a flip added or removed an edge.
struct ChangedNeighborhood {
    vertices: Vec<VertexId>,
    /// For each vertex, whether it is in `vertices`.
    has_vertex: Vec<bool>,
    /// For each edge, whether the edge is allowed to be flipped and is not yet collected.
    is_free: Vec<bool>,
}

impl ChangedNeighborhood {
    /// Creates a collector without vertices. Only `edges` are allowed to be flipped.
    fn new(mesh: &Mesh, edges: &[EdgeId]) -> Self {
        let mut is_free = vec![false; mesh.domain_len(mesh::Domain::Edge)];
        for e in edges {
            is_free[e.index()] = true;
        }
        Self {
            vertices: Vec::new(),
            has_vertex: vec![false; mesh.positions().len()],
            is_free,
        }
    }

    /// Adds the corners of two triangles whose common edge was flipped.
    fn add(&mut self, quad: &Quad) {
        for v in [quad.a, quad.b, quad.c, quad.d] {
            if !std::mem::replace(&mut self.has_vertex[v.index()], true) {
                self.vertices.push(v);
            }
        }
    }

    /// Returns edges that are allowed to be flipped, in order of their ids: the edges of all triangles around the
    /// collected vertices, and the edges in `additional`. Removes the collected vertices from the collector.
    fn take_edges(&mut self, mesh: &Mesh, additional: impl Iterator<Item = EdgeId>) -> Vec<EdgeId> {
        let mut edges = Vec::new();
        let mut collect = |e: EdgeId| {
            if std::mem::replace(&mut self.is_free[e.index()], false) {
                edges.push(e);
            }
        };
        additional.for_each(&mut collect);
        for v in self.vertices.drain(..) {
            self.has_vertex[v.index()] = false;
            for h in mesh.vertex_half_edges(v) {
                collect(h.edge());
                collect(mesh.next(h).edge());
            }
        }
        edges.sort_unstable();
        for e in &edges {
            self.is_free[e.index()] = true;
        }
        edges
    }
}
