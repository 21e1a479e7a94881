//! Sqrt3 subdivision.

use std::collections::HashMap;

use geometry::shapes;
use mesh::{DVec2, DVec3, HalfEdgeId, MATERIAL, Mesh, UV, VertexId};

use super::{level, levels};
use crate::Scheme;
use crate::fixtures::{self, number, sheet, triangles};

fn once(mesh: &Mesh) -> Mesh {
    level(Scheme::Sqrt3, mesh)
}

fn twice(mesh: &Mesh) -> Mesh {
    levels(Scheme::Sqrt3, 2, mesh)
}

#[test]
fn an_icosahedron_gets_three_triangles_for_each_old_one() {
    let new = once(&shapes::icosahedron());
    assert_eq!(
        (new.n_vertices(), new.n_edges(), new.n_faces()),
        (32, 90, 60)
    );
    assert_eq!(geometry::valences(&new)[5..], [12, 20]);
}

#[test]
fn a_level_equals_poking_all_faces_and_flipping_all_old_edges() {
    // The two faces of a pillow share all vertices, so some flips are refused.
    for (name, old) in fixtures::all().into_iter().filter(|(n, _)| *n != "pillow") {
        let mut expected = old.clone();
        for f in old.faces() {
            expected.poke_face(f).unwrap();
        }
        for e in old.edges().filter(|&e| !old.is_boundary_edge(e)) {
            expected.flip_edge(e).unwrap();
        }
        expected.compact();
        let new = once(&old);
        assert_eq!(triangles(&new), triangles(&expected), "{name}");
        for f in old.faces() {
            let m = new.position(VertexId::new(old.n_vertices() + f.index()));
            assert!(m.distance(old.face_center(f)) < 1e-15, "{name} {f}");
        }
    }
}

/// Computes the triangles of an odd level from a list of triangles.
fn odd_level(old: &Mesh) -> Vec<[u32; 3]> {
    let list: Vec<[u32; 3]> = old.faces().map(|f| fixtures::corners(old, f)).collect();
    let mut face_of_edge = HashMap::new();
    for (f, &[a, b, c]) in list.iter().enumerate() {
        for edge in [[a, b], [b, c], [c, a]] {
            assert_eq!(face_of_edge.insert(edge, f), None);
        }
    }
    let outer = old.half_edges().filter(|&h| old.face(h).is_none());
    let ends = outer.map(|h| [old.origin(h), old.origin(h.twin())].map(number));
    let ranks: HashMap<[u32; 2], usize> = ends.zip(0..).collect();
    let vertex = |i: usize| u32::try_from(old.n_vertices() + i).unwrap();
    // The new vertex that is the center of face `f`, or that replaces the center at the given edge.
    let center = |f: usize, edge: [u32; 2]| {
        let [a, b, c] = list[f];
        for [a, b, c] in [[a, b, c], [b, c, a], [c, a, b]] {
            if let Some(rank) = ranks.get(&[b, a]) {
                return match edge {
                    [v, w] if [v, w] == [c, a] => vertex(f),
                    [v, w] if [v, w] == [b, c] => vertex(list.len() + rank),
                    _ => panic!("{edge:?} of {:?}", list[f]),
                };
            }
        }
        vertex(f)
    };
    let mut new = Vec::new();
    for (f, &[a, b, c]) in list.iter().enumerate() {
        for [a, b, c] in [[a, b, c], [b, c, a], [c, a, b]] {
            match face_of_edge.get(&[b, a]) {
                Some(&g) => new.push([a, center(g, [b, a]), center(f, [a, b])]),
                None => new.push([center(f, [c, a]), center(f, [b, c]), c]),
            }
        }
    }
    for t in &mut new {
        while t[0] != *t.iter().min().unwrap() {
            t.rotate_left(1);
        }
    }
    new.sort_unstable();
    new
}

#[test]
fn an_odd_level_equals_subdividing_a_list_of_triangles() {
    for (name, mesh) in fixtures::all().into_iter().filter(|(n, _)| *n != "pillow") {
        // Tests two odd levels, because the second one starts from a different kind of mesh.
        for n in [1, 3] {
            let (old, new) = (
                levels(Scheme::Sqrt3, n, &mesh),
                levels(Scheme::Sqrt3, n + 1, &mesh),
            );
            assert_eq!(triangles(&new), odd_level(&old), "{name} {n}");
        }
    }
}

#[test]
fn two_levels_cut_every_edge_in_three() {
    for (name, old) in fixtures::all() {
        let new = twice(&old);
        let expected = old.n_vertices() + 2 * old.n_edges() + old.n_faces();
        assert_eq!(new.n_vertices(), expected, "{name}");
        assert_eq!(new.n_faces(), 9 * old.n_faces(), "{name}");
        let n_outer = |m: &Mesh| m.edges().filter(|&e| m.is_boundary_edge(e)).count();
        assert_eq!(n_outer(&new), 3 * n_outer(&old), "{name}");
        for v in old.vertices() {
            assert_eq!(new.valence(v), old.valence(v), "{name} {v}");
        }
    }
    let old = sheet(6, 5);
    let new = twice(&old);
    let is_deep = |&v: &VertexId| {
        let inner = |v| !old.is_boundary_vertex(v);
        inner(v) && old.vertex_neighbors(v).all(inner)
    };
    let deep: Vec<VertexId> = old.vertices().filter(is_deep).collect();
    assert!(deep.len() > 4);
    for &v in &deep {
        for w in old.vertex_neighbors(v) {
            let [a, b] = [v, w].map(|v| old.position(v));
            assert!(new.position(v).distance(a) < 1e-15, "{v}");
            let third = (2.0 * a + b) / 3.0;
            let near = |&w: &VertexId| new.position(w).distance(third) < 1e-14;
            assert!(new.vertex_neighbors(v).any(|w| near(&w)), "{v} {w}");
        }
    }
}

#[test]
fn the_boundary_is_a_cubic_b_spline_that_two_levels_cut_in_three() {
    for (name, old) in fixtures::all() {
        let (new, between) = (twice(&old), once(&old));
        for h in old.half_edges().filter(|&h| old.face(h).is_none()) {
            let at = |m: &Mesh, h: HalfEdgeId| m.position(m.origin(h));
            assert_eq!(at(&between, h), at(&old, h), "{name} {h}");
            let [a, b] = [old.prev(h), h].map(|h| at(&old, h));
            let [c, d] = [old.next(h), old.next(old.next(h))].map(|h| at(&old, h));
            // Walks along the boundary from b.
            let b_new = new.vertex_half_edge(old.origin(h)).unwrap();
            let [x, y] = [new.next(b_new), new.next(new.next(b_new))].map(|h| at(&new, h));
            assert!(at(&new, b_new).distance((4.0 * a + 19.0 * b + 4.0 * c) / 27.0) < 1e-15);
            assert!(
                x.distance((a + 16.0 * b + 10.0 * c) / 27.0) < 1e-15,
                "{name}"
            );
            assert!(
                y.distance((10.0 * b + 16.0 * c + d) / 27.0) < 1e-15,
                "{name}"
            );
        }
    }
}

#[test]
fn an_octahedron_shrinks_by_the_factor_of_the_mask() {
    // The positions of the four neighbors of a vertex p sum to 0, and the weight of p is 1 - 4/9.
    let old = shapes::octahedron();
    let new = once(&old);
    for v in old.vertices() {
        let expected = 5.0 / 9.0 * old.position(v);
        assert!(new.position(v).distance(expected) < 1e-15);
    }
}

#[test]
fn parts_inherit_the_values_of_faces_and_boundary_edges() {
    for (name, mut old) in fixtures::all() {
        old.set(MATERIAL, (0..).take(old.n_faces()).collect());
        let creases = (1_u32..).take(old.n_edges()).map(f64::from);
        old.set(mesh::CREASE, creases.collect());
        let new = twice(&old);
        for (f, &material) in new.get(MATERIAL).unwrap().iter().enumerate() {
            assert_eq!(material, i32::try_from(f / 9).unwrap(), "{name} f{f}");
        }
        let creases = new.get(mesh::CREASE).unwrap();
        for h in old.half_edges().filter(|&h| old.face(h).is_none()) {
            let mut part = new.vertex_half_edge(old.origin(h)).unwrap();
            for _ in 0..3 {
                let crease = creases[part.edge().index()];
                assert_eq!(crease, (h.edge().index() + 1) as f64, "{name} {h}");
                part = new.next(part);
            }
        }
        let kept = creases.iter().filter(|&&c| c != 0.0).count();
        let boundary = new.edges().filter(|&e| new.is_boundary_edge(e)).count();
        assert_eq!(kept, boundary, "{name}");
    }
}

#[test]
fn affine_corner_values_stay_affine_on_a_flat_sheet() {
    let affine = |p: DVec3| DVec2::new(0.5 * p.x + 1.0, p.y - 0.25 * p.x);
    let mut mesh = sheet(4, 3);
    let uvs = mesh
        .half_edges()
        .map(|h| affine(mesh.position(mesh.origin(h))));
    mesh.set(UV, uvs.collect());
    let (one, two) = (once(&mesh), twice(&mesh));
    let inside = |m: &Mesh| -> Vec<(HalfEdgeId, DVec2)> {
        let uvs = m.get(UV).unwrap();
        let halves = m.half_edges().filter(|&h| m.face(h).is_some());
        halves.map(|h| (h, uvs[h.index()])).collect()
    };
    for (h, uv) in inside(&one) {
        let expected = affine(one.position(one.origin(h)));
        assert!(uv.distance(expected) < 1e-15, "{h}");
    }
    // Corner values are linear: they do not follow boundary vertices or extraordinary vertices, which move.
    let linear = |v: VertexId| -> DVec3 {
        let at = |h: HalfEdgeId| one.position(one.origin(h));
        let third = |h: HalfEdgeId| (2.0 * at(h) + at(h.twin())) / 3.0;
        let n = one.n_vertices();
        match v.index().checked_sub(n) {
            None => one.position(v),
            Some(f) if f < one.n_faces() => {
                let f = mesh::FaceId::new(f);
                let outer = |h: &HalfEdgeId| one.face(h.twin()).is_none();
                let cut = one.face_half_edges(f).find(outer);
                cut.map_or(one.face_center(f), third)
            }
            Some(r) => {
                let mut outer = one.half_edges().filter(|&h| one.face(h).is_none());
                third(outer.nth(r - one.n_faces()).unwrap())
            }
        }
    };
    for (h, uv) in inside(&two) {
        assert!(uv.distance(affine(linear(two.origin(h)))) < 1e-15, "{h}");
    }
}
