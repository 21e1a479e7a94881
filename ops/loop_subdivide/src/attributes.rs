//! The attributes of the next level.

use mesh::{Attributes, Column, Domain, HalfEdgeId, Mesh, Rule, Values};
use op::OpError;

use crate::meter::Meter;
use crate::positions;

/// The columns of the next level, by their rules:
///
/// - vertices: [`Rule::Interpolate`] with the weights of the positions; [`Rule::Copy`] keeps the values
///   of old vertices, new ones have zero;
/// - corners: likewise, but linearly within their own triangle, so both sides of a seam stay apart;
/// - edges: both halves as the whole, edges inside old faces zero;
/// - faces: all four as the whole.
///
/// Columns of [`Rule::Normal`] and [`Rule::Drop`] are left out.
pub(crate) fn finer(mesh: &Mesh, meter: &Meter) -> Result<Attributes, OpError> {
    let mut new = Attributes::default();
    for (domain, column) in mesh.attributes().iter().filter(|(_, c)| is_carried(c)) {
        // Asks whether to go on.
        meter.add(0)?;
        let values = match domain {
            Domain::Vertex => vertex_values(mesh, column),
            Domain::Corner => corner_values(mesh, column),
            Domain::Edge => edge_values(mesh, column),
            Domain::Face => column.values.gather(4 * mesh.n_faces(), |i| Some(i / 4)),
        };
        let name = column.name.clone();
        let rule = column.rule;
        new.insert(domain, Column { name, rule, values });
    }
    Ok(new)
}

/// Whether the next level has this column too.
pub(crate) fn is_carried(column: &Column) -> bool {
    matches!(column.rule, Rule::Interpolate | Rule::Copy)
}

fn vertex_values(mesh: &Mesh, column: &Column) -> Values {
    let n = mesh.n_vertices() + mesh.n_edges();
    if column.rule == Rule::Interpolate {
        let weights = |i: usize, add: &mut dyn FnMut(usize, f64)| positions::weights(mesh, i, add);
        column.values.blend(n, weights)
    } else {
        column
            .values
            .gather(n, |i| (i < mesh.n_vertices()).then_some(i))
    }
}

fn edge_values(mesh: &Mesh, column: &Column) -> Values {
    let n_halves = 2 * mesh.n_edges();
    column.values.gather(n_halves + 3 * mesh.n_faces(), |i| {
        (i < n_halves).then_some(i / 2)
    })
}

fn corner_values(mesh: &Mesh, column: &Column) -> Values {
    let n = 4 * mesh.n_edges() + 6 * mesh.n_faces();
    if column.rule == Rule::Interpolate {
        column.values.blend(n, |i, add| match corner(mesh, i) {
            Corner::At(h) => add(h.index(), 1.0),
            Corner::On(h) => {
                add(h.index(), 0.5);
                add(mesh.next(h).index(), 0.5);
            }
            Corner::Outside => {}
        })
    } else {
        column.values.gather(n, |i| match corner(mesh, i) {
            Corner::At(h) => Some(h.index()),
            Corner::On(_) | Corner::Outside => None,
        })
    }
}

/// Where a corner of the next level lies in an old triangle.
enum Corner {
    /// At the origin of this half-edge.
    At(HalfEdgeId),
    /// In the middle of this half-edge.
    On(HalfEdgeId),
    /// Nowhere: the half-edge is on the boundary.
    Outside,
}

/// The corner of new half-edge `i`. The numbers are those of module `topology`.
fn corner(mesh: &Mesh, i: usize) -> Corner {
    let n_halves = 4 * mesh.n_edges();
    if i < n_halves {
        // Of the four parts of an edge 0 and 2 belong to its first half, 1 and 3 to its second, and
        // 0 and 3 are the first parts.
        let h = HalfEdgeId::new(i / 4 * 2 + i % 2);
        if mesh.face(h).is_none() {
            Corner::Outside
        } else if matches!(i % 4, 0 | 3) {
            Corner::At(h)
        } else {
            Corner::On(h)
        }
    } else {
        // Cut k runs from the middle of half-edge k to that of half-edge k - 1.
        let (f, i) = ((i - n_halves) / 6, (i - n_halves) % 6);
        let start = mesh.connectivity().face_half_edge[f];
        let k = (i / 2 + if i % 2 == 0 { 0 } else { 2 }) % 3;
        Corner::On((0..k).fold(start, |h, _| mesh.next(h)))
    }
}
