//! Properties of the connectivity and the positions after Loop subdivision.

use geometry::shapes;
use mesh::{DVec3, EdgeId, FaceId, HalfEdgeId, Mesh, VertexId};

use super::{is_corner, once, topology};
use crate::fixtures::{self, corners, sheet};

#[test]
fn all_levels_keep_the_invariants_and_the_topology() {
    for (name, mesh) in fixtures::all() {
        let mut new = mesh.clone();
        for _ in 0..3 {
            new = once(&new);
        }
        assert_eq!(topology(&new), topology(&mesh), "{name}");
        assert_eq!(new.n_faces(), 64 * mesh.n_faces(), "{name}");
    }
}

#[test]
fn elements_are_numbered_as_documented() {
    for (name, old) in fixtures::all() {
        let new = once(&old);
        let on = |h: HalfEdgeId| VertexId::new(old.n_vertices() + h.edge().index());
        for e in old.edges() {
            let [a, b] = old.edge_vertices(e);
            let m = on(e.half_edge());
            let halves = [2 * e.index(), 2 * e.index() + 1].map(EdgeId::new);
            let ends = halves.map(|e| new.edge_vertices(e));
            assert_eq!(ends, [[a, m], [m, b]], "{name} {e}");
        }
        for f in old.faces() {
            let h: Vec<HalfEdgeId> = old.face_half_edges(f).collect();
            for k in 0..3 {
                let part = corners(&new, FaceId::new(4 * f.index() + k));
                let before = h[(k + 2) % 3];
                let expected = [old.origin(h[k]), on(h[k]), on(before)].map(fixtures::number);
                assert_eq!(part, expected, "{name} {f}");
            }
        }
        for v in old.vertices() {
            assert_eq!(new.valence(v), old.valence(v), "{name} {v}");
        }
    }
}

#[test]
fn dead_elements_are_ignored() {
    let mut mesh = sheet(3, 3);
    mesh.delete_face(FaceId::new(4)).unwrap();
    mesh.delete_face(FaceId::new(9)).unwrap();
    let mut dense = mesh.clone();
    dense.compact();
    assert!(!mesh.is_dense());
    assert_eq!(once(&mesh), once(&dense));
}

#[test]
fn a_flat_regular_sheet_stays_on_its_grid() {
    let old = sheet(5, 4);
    let new = once(&old);
    let cut = |v: VertexId| old.has_vertex(v) && old.valence(v) <= 3 && is_corner(&old, v);
    for v in old.vertices().filter(|&v| !cut(v)) {
        assert_eq!(new.position(v), old.position(v), "{v}");
    }
    for e in old.edges() {
        let [a, b] = old.edge_vertices(e).map(|v| old.position(v));
        let m = VertexId::new(old.n_vertices() + e.index());
        assert_eq!(new.position(m), (a + b) / 2.0, "{e}");
    }
}

#[test]
fn nothing_leaves_the_convex_hull() {
    let directions = (0..50).map(|i| {
        let (sin, cos) = libm::sincos(2.4 * f64::from(i));
        DVec3::new(cos, sin, f64::from(i) / 25.0 - 1.0)
    });
    let directions: Vec<DVec3> = directions.collect();
    for (name, mesh) in fixtures::all() {
        let new = once(&mesh);
        for &d in &directions {
            let reach = |m: &Mesh| {
                let along = m.positions().iter().map(|p| p.dot(d));
                along.fold(f64::NEG_INFINITY, f64::max)
            };
            assert!(reach(&new) <= reach(&mesh) + 1e-14, "{name}");
        }
    }
}

#[test]
fn the_boundary_depends_on_the_boundary_only() {
    for (name, mesh) in fixtures::all() {
        let mut inside_moved = mesh.clone();
        for v in mesh.vertices().filter(|&v| !mesh.is_boundary_vertex(v)) {
            inside_moved.positions_mut()[v.index()] += DVec3::new(1.0, 2.0, 3.0);
        }
        let (new, moved) = (once(&once(&mesh)), once(&once(&inside_moved)));
        for v in new.vertices().filter(|&v| new.is_boundary_vertex(v)) {
            assert_eq!(new.position(v), moved.position(v), "{name} {v}");
        }
    }
}

#[test]
fn splitting_all_edges_at_a_vertex_halves_its_displacement() {
    for (name, mesh) in fixtures::all() {
        if name == "pillow" {
            continue; // The two edges at a vertex have the same faces.
        }
        let inside = mesh.vertices().filter(|&v| !mesh.is_boundary_vertex(v));
        for v in inside.filter(|&v| mesh.vertex_half_edge(v).is_some()) {
            let mut split = mesh.clone();
            for h in mesh.vertex_half_edges(v) {
                split.split_edge(h.edge(), 0.5).unwrap();
            }
            assert_eq!(split.valence(v), mesh.valence(v));
            let displacement = |m: &Mesh| once(m).position(v) - m.position(v);
            let far = displacement(&split).distance(0.5 * displacement(&mesh));
            assert!(far < 1e-12, "{name} {v} {far:e}");
        }
    }
}

#[test]
fn a_tetrahedron_shrinks_by_the_factor_of_the_mask() {
    // The positions of the neighbors of a vertex p sum to -p, so p becomes (7/16 - 3/16) p. The vertex on the edge
    // between a and b becomes 3/8 (a + b) + 1/8 (c + d) = 1/4 (a + b).
    let old = shapes::tetrahedron();
    let new = once(&old);
    for v in old.vertices() {
        assert_eq!(new.position(v), 0.25 * old.position(v));
    }
    let [a, b] = old.edge_vertices(EdgeId::new(0)).map(|v| old.position(v));
    assert_eq!(new.position(VertexId::new(4)), 0.25 * (a + b));
}
