//! Butterfly subdivision.

use geometry::shapes;
use mesh::{DVec3, EdgeId, Mesh, VertexId};

use super::{is_corner, level};
use crate::Scheme;
use crate::fixtures::{self, sheet, triangles};
use crate::{LoopWeights, Split};

fn once(mesh: &Mesh) -> Mesh {
    level(Scheme::Butterfly, mesh)
}

/// Returns the edges of a sheet, without the boundary edges at the four corners of the sheet. At the corners, the
/// boundary curve turns.
fn away_from_corners(mesh: &Mesh) -> Vec<EdgeId> {
    let turns = |e: EdgeId| {
        mesh.is_boundary_edge(e) && mesh.edge_vertices(e).iter().any(|&v| is_corner(mesh, v))
    };
    mesh.edges().filter(|&e| !turns(e)).collect()
}

fn on(mesh: &Mesh, e: EdgeId) -> VertexId {
    VertexId::new(mesh.n_vertices() + e.index())
}

#[test]
fn a_flat_regular_sheet_stays_on_its_grid() {
    let old = sheet(5, 4);
    let new = once(&old);
    for e in away_from_corners(&old) {
        let [a, b] = old.edge_vertices(e).map(|v| old.position(v));
        let far = new.position(on(&old, e)).distance((a + b) / 2.0);
        assert!(far < 1e-15, "{e} {far:e}");
    }
}

#[test]
fn cubic_functions_over_a_regular_sheet_are_reproduced_inside() {
    let f = |p: DVec3| {
        let (x, y) = (p.x, p.y);
        x * x * x - 2.0 * x * x * y + 0.5 * x * y * y + y * y * y - x * y + 3.0 * y - 1.0
    };
    let mut old = sheet(6, 6);
    for p in old.positions_mut() {
        p.z = f(*p);
    }
    let new = once(&old);
    let inner = |v: VertexId| !old.is_boundary_vertex(v);
    let is_inside = |&e: &EdgeId| {
        // Inside the sheet, none of the eight vertices of the regular mask lies beyond the boundary.
        let ends = old.edge_vertices(e);
        ends.iter()
            .all(|&v| inner(v) && old.vertex_neighbors(v).all(inner))
    };
    let edges: Vec<EdgeId> = old.edges().filter(is_inside).collect();
    assert!(edges.len() > 10);
    for e in edges {
        let p = new.position(on(&old, e));
        assert!((p.z - f(p)).abs() < 1e-13, "{e}");
    }
}

#[test]
fn a_tetrahedron_has_the_masks_of_valence_three() {
    // The new vertex on the edge from a to b is the mean of two sums, one for each end of the edge. The first sum is
    // 3/4 a + 5/12 b - 1/12 (c + d); the second sum has a and b swapped. Because c + d = -(a + b), this mean is 7/12
    // (a + b) + 1/12 (a + b).
    let old = shapes::tetrahedron();
    let new = once(&old);
    for e in old.edges() {
        let [a, b] = old.edge_vertices(e).map(|v| old.position(v));
        let far = new.position(on(&old, e)).distance(2.0 / 3.0 * (a + b));
        assert!(far < 1e-15, "{e} {far:e}");
    }
}

#[test]
fn a_boundary_is_the_four_point_curve_of_boundary_vertices() {
    for (name, mesh) in fixtures::all() {
        let new = once(&mesh);
        for h in mesh.half_edges().filter(|&h| mesh.face(h).is_none()) {
            let at = |h| mesh.position(mesh.origin(h));
            let [b, c] = [at(h), at(h.twin())];
            let [a, d] = [at(mesh.prev(h)), at(mesh.next(h).twin())];
            let expected = (9.0 * (b + c) - a - d) / 16.0;
            let far = new.position(on(&mesh, h.edge())).distance(expected);
            assert!(far < 1e-14, "{name} {h} {far:e}");
        }
    }
}

#[test]
fn triangles_are_split_as_in_loop_subdivision() {
    for (name, mesh) in fixtures::all() {
        let expected = triangles(&level(Scheme::Loop(LoopWeights::Warren), &mesh));
        assert_eq!(triangles(&once(&mesh)), expected, "{name}");
        let linear = triangles(&level(Scheme::Midpoint(Split::Triangles), &mesh));
        assert_eq!(linear, expected, "{name}");
    }
}
