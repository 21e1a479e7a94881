//! Flips that bring a mesh nearer to a goal, until none does.
//!
//! A pass takes edges in order of their numbers. The next one takes those near a vertex whose edges
//! changed: only there can a flip have become an improvement, or legal, since an edge between the far
//! corners of another one ends at both. So the work follows the changes, and a pass without a flip is the
//! last. Refused edges are taken in every pass, so that the last one has them all.

use mesh::{EdgeId, EditError, FaceId, Mesh, VertexId};
use op::{Context, OpError, Report};

use crate::flip_edges::goal::{Goal, Quad};

/// Flips those of `edges` that bring the mesh nearer to `goal`, by `flip`, in at most so many passes.
///
/// # Errors
///
/// [`OpError::Cancelled`]. The mesh is then flipped in part.
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
    let mut to_judge = Vec::new();
    for &e in edges {
        match polygon_beside(mesh, e) {
            _ if mesh.is_boundary_edge(e) => {}
            None => to_judge.push(e),
            Some(f) => report.refuse(OpError::refused_edit(
                EditError::NotTriangle(f),
                mesh,
                &[e.into()],
            ))?,
        }
    }
    let mut near = Near::new(mesh, &to_judge);
    let mut refused = Vec::new();
    let mut done_passes = 0;
    let mut at_goal = false;
    while !at_goal && done_passes < passes {
        refused.clear();
        at_goal = true;
        let total = to_judge.len() as u64;
        for (done, &e) in (0..).zip(&to_judge) {
            if done % 4096 == 0 {
                cx.advance("flip", done, total)?;
            }
            let quad = Quad::beside(mesh, e);
            if !goal.is_nearer(mesh, &quad) {
                continue;
            }
            match flip(mesh, e) {
                Ok(()) => {
                    goal.flipped(&quad);
                    near.touch(&quad);
                    report.changed += 1;
                    at_goal = false;
                }
                Err(reason) => refused.push((e, reason)),
            }
        }
        done_passes += 1;
        to_judge = near.edges(mesh, refused.iter().map(|&(e, _)| e));
    }
    for (e, reason) in refused {
        report.refuse(OpError::refused_edit(reason, mesh, &[e.into()]))?;
    }
    Ok(report.note(if at_goal {
        format!("passes: {done_passes}; no flip that may be made would improve the mesh")
    } else {
        format!("passes: {done_passes}, all that `passes` allows; more may improve the mesh")
    }))
}

/// A face beside `e` that is not a triangle.
fn polygon_beside(mesh: &Mesh, e: EdgeId) -> Option<FaceId> {
    let beside = mesh.edge_faces(e).into_iter().flatten();
    beside.into_iter().find(|&f| !mesh.is_triangle(f))
}

/// Collects the edges near vertices whose edges changed.
struct Near {
    vertices: Vec<VertexId>,
    /// For each vertex whether it is among `vertices`.
    has_vertex: Vec<bool>,
    /// For each edge whether it may be flipped and is not collected yet.
    is_free: Vec<bool>,
}

impl Near {
    /// For a mesh in which these edges may be flipped.
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

    /// Notes that the edge between these triangles was flipped.
    fn touch(&mut self, quad: &Quad) {
        for v in [quad.a, quad.b, quad.c, quad.d] {
            if !std::mem::replace(&mut self.has_vertex[v.index()], true) {
                self.vertices.push(v);
            }
        }
    }

    /// The edges that end at those vertices or lie opposite them in a triangle, and `others`, in order
    /// of their numbers. Then begins anew.
    fn edges(&mut self, mesh: &Mesh, others: impl Iterator<Item = EdgeId>) -> Vec<EdgeId> {
        let mut edges = Vec::new();
        let mut collect = |e: EdgeId| {
            if std::mem::replace(&mut self.is_free[e.index()], false) {
                edges.push(e);
            }
        };
        others.for_each(&mut collect);
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
