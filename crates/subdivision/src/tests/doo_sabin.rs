//! Doo-Sabin subdivision.

use geometry::shapes;
use mesh::{COLOR, Column, DVec2, DVec3, Domain, FaceId, HalfEdgeId, MATERIAL, Mesh, Rule, UV};
use mesh::{EdgeId, Values, VertexId};

use super::{level, levels};
use crate::Scheme;
use crate::fixtures;

fn once(mesh: &Mesh) -> Mesh {
    level(Scheme::DooSabin, mesh)
}

/// Returns meshes with polygons of all kinds, with and without a boundary.
fn polygons() -> Vec<(&'static str, Mesh)> {
    let mut meshes = fixtures::all();
    meshes.push(("cube", shapes::cube()));
    meshes.push(("grid", shapes::grid(3, 2)));
    meshes.push(("cylinder", shapes::cylinder(7, true)));
    let mut mixed = shapes::grid(3, 3);
    mixed.delete_face(FaceId::new(0)).unwrap();
    mixed.poke_face(FaceId::new(4)).unwrap();
    mixed.split_edge(EdgeId::new(5), 0.5).unwrap();
    mixed.compact();
    meshes.push(("mixed", mixed));
    meshes
}

#[test]
fn a_cube_gets_a_face_for_each_face_edge_and_vertex() {
    let old = shapes::cube();
    let new = once(&old);
    assert_eq!(
        (new.n_vertices(), new.n_edges(), new.n_faces()),
        (24, 48, 26)
    );
    let degrees = |of: std::ops::Range<usize>| -> Vec<usize> {
        of.map(|f| new.degree(FaceId::new(f))).collect()
    };
    assert_eq!(degrees(0..18), [4; 18]);
    assert_eq!(degrees(18..26), [3; 8]);
    // The new face that replaces an old face is half as wide as the old face, so its area is a quarter of the old area.
    let f = FaceId::new(0);
    let area = |m: &Mesh| m.face_area(f);
    assert!((area(&new) - area(&old) / 4.0).abs() < 1e-15);
}

#[test]
fn faces_and_edges_are_numbered_as_documented() {
    for (name, old) in polygons() {
        let new = once(&old);
        let corner = |h: HalfEdgeId| VertexId::new(h.index());
        for f in old.faces() {
            let expected: Vec<VertexId> = old.face_half_edges(f).map(corner).collect();
            let found: Vec<VertexId> = new.face_vertices(f).collect();
            assert_eq!(found, expected, "{name} {f}");
        }
        let far = |h: HalfEdgeId| {
            if old.face(h).is_some() {
                corner(old.next(h))
            } else {
                let outer = old.half_edges().filter(|&h| old.face(h).is_none());
                let rank = outer.filter(|&o| o < h).count();
                VertexId::new(old.n_half_edges() + rank)
            }
        };
        for e in old.edges() {
            let [h, t] = e.half_edges();
            let f = FaceId::new(old.n_faces() + e.index());
            let found: Vec<VertexId> = new.face_vertices(f).collect();
            assert_eq!(found, [far(h), corner(h), far(t), corner(t)], "{name} {e}");
            let along = |h: HalfEdgeId| new.edge_vertices(EdgeId::new(h.index()));
            assert_eq!(along(h), [corner(h), far(h)], "{name} {h}");
            assert_eq!(along(t), [corner(t), far(t)], "{name} {t}");
        }
        let mut f = old.n_faces() + old.n_edges();
        for v in old.vertices() {
            let n = old.valence(v);
            let inside = !old.is_boundary_vertex(v);
            if n == 0 || (n == 2 && inside) {
                continue;
            }
            let degree = if inside { n } else { n + 1 };
            assert_eq!(new.degree(FaceId::new(f)), degree, "{name} {v}");
            f += 1;
        }
        assert_eq!(new.n_faces(), f, "{name}");
    }
}

#[test]
fn polygons_keep_their_topology() {
    for (name, mesh) in polygons() {
        for n in 1..=3 {
            let new = levels(Scheme::DooSabin, n, &mesh);
            assert_eq!(super::topology(&new), super::topology(&mesh), "{name} {n}");
        }
    }
}

#[test]
fn a_regular_grid_becomes_the_biquadratic_b_spline_of_its_vertices() {
    // One level of subdivision equals Chaikin's rule along the rows, then along the columns. Chaikin's rule halves the
    // knot intervals of a quadratic B-spline.
    let (columns, rows) = (5, 4);
    let mut old = shapes::grid(columns, rows);
    let height = |i: u32, j: u32| f64::from((7 * i + 5 * j * j + i * j) % 11);
    for (k, p) in (0..).zip(old.positions_mut()) {
        p.z = height(k % (columns + 1), k / (columns + 1));
    }
    let new = once(&old);
    let chaikin = |p: &[DVec3]| -> Vec<DVec3> {
        let pairs = p.windows(2);
        let cut = pairs.flat_map(|p| [0.75 * p[0] + 0.25 * p[1], 0.25 * p[0] + 0.75 * p[1]]);
        cut.collect()
    };
    let lines: Vec<Vec<DVec3>> = old
        .positions()
        .chunks(columns as usize + 1)
        .map(chaikin)
        .collect();
    let mut expected = Vec::new();
    for i in 0..lines[0].len() {
        let line: Vec<DVec3> = lines.iter().map(|line| line[i]).collect();
        expected.extend(chaikin(&line));
    }
    // Only inner vertices are compared, because boundary vertices follow the rule for boundaries.
    let inside: Vec<DVec3> = (0..new.n_vertices())
        .map(VertexId::new)
        .filter(|&v| !new.is_boundary_vertex(v))
        .map(|v| new.position(v))
        .collect();
    assert_eq!(inside.len(), expected.len());
    for p in inside {
        let near = expected.iter().map(|q| q.distance(p));
        assert!(near.fold(f64::INFINITY, f64::min) < 1e-14);
    }
}

#[test]
fn the_boundary_follows_chaikins_rule() {
    for (name, old) in polygons() {
        let new = once(&old);
        for h in old.half_edges().filter(|&h| old.face(h).is_none()) {
            let [a, b] = [h, h.twin()].map(|h| old.position(old.origin(h)));
            let along = HalfEdgeId::new(2 * h.index());
            assert_eq!(new.face(along), None);
            let ends = [along, along.twin()].map(|h| new.position(new.origin(h)));
            let expected = [0.75 * a + 0.25 * b, 0.25 * a + 0.75 * b];
            for (end, expected) in ends.iter().zip(expected) {
                assert!(end.distance(expected) < 1e-15, "{name} {h}");
            }
        }
    }
}

#[test]
fn after_one_level_all_inner_vertices_have_valence_four() {
    for (name, mesh) in polygons().into_iter().filter(|(n, _)| *n != "pillow") {
        let has_no_valence_2 = mesh
            .vertices()
            .all(|v| mesh.is_boundary_vertex(v) || mesh.valence(v) != 2);
        let new = once(&mesh);
        for v in new.vertices().filter(|_| has_no_valence_2) {
            let expected = match new.valence(v) {
                0 => 0,
                _ if new.is_boundary_vertex(v) => 3,
                _ => 4,
            };
            assert_eq!(new.valence(v), expected, "{name} {v}");
        }
    }
}

#[test]
fn affine_corner_values_stay_affine() {
    for (name, mut mesh) in polygons() {
        let affine = |p: DVec3| DVec2::new(p.x - 2.0 * p.y + 0.5, p.z + 0.25 * p.y);
        let values = |m: &Mesh| -> Vec<DVec2> {
            let value = |h| affine(m.position(m.origin(h)));
            m.half_edges()
                .map(|h| m.face(h).map_or(DVec2::ZERO, |_| value(h)))
                .collect()
        };
        mesh.set(UV, values(&mesh));
        let new = once(&mesh);
        for (found, expected) in new.get(UV).unwrap().iter().zip(values(&new)) {
            assert!(found.distance(expected) < 1e-14, "{name}");
        }
    }
}

#[test]
fn parts_inherit_the_values_of_faces_edges_and_vertices() {
    for (name, mut old) in polygons() {
        old.set(MATERIAL, (0..).take(old.n_faces()).collect());
        for (domain, column) in [(Domain::Edge, "edges"), (Domain::Vertex, "vertices")] {
            let values = Values::Int((1..).take(old.domain_len(domain)).collect());
            let (name, rule) = (column.to_owned(), Rule::Copy);
            old.insert_column(domain, Column { name, rule, values });
        }
        let colors = old.positions().iter().map(|p| p.extend(1.0)).collect();
        old.set(COLOR, colors);
        let new = once(&old);
        let ints = |domain, name: &str| -> Vec<i32> {
            let mut columns = new.attributes().of(domain).iter();
            match &columns.find(|c| c.name == name).unwrap().values {
                Values::Int(ints) => ints.clone(),
                other => panic!("{other:?}"),
            }
        };
        for (e, value) in ints(Domain::Edge, "edges").into_iter().enumerate() {
            let expected = if e < old.n_half_edges() { e / 2 + 1 } else { 0 };
            assert_eq!(value, i32::try_from(expected).unwrap(), "{name} e{e}");
        }
        // The column keeps only the values of isolated vertices, because all other old vertices are replaced.
        let kept: Vec<i32> = ints(Domain::Vertex, "vertices");
        let kept: Vec<i32> = kept.into_iter().filter(|&i| i != 0).collect();
        let isolated = old.vertices().filter(|&v| old.valence(v) == 0);
        let isolated: Vec<i32> = isolated
            .map(|v| i32::try_from(v.index()).unwrap() + 1)
            .collect();
        assert_eq!(kept, isolated, "{name}");
        let materials = new.get(MATERIAL).unwrap();
        for f in old.faces() {
            assert_eq!(materials[f.index()], i32::try_from(f.index()).unwrap());
        }
        for e in old.edges() {
            let [left, right] = old.edge_faces(e);
            let f = left.or(right).unwrap().index();
            let found = materials[old.n_faces() + e.index()];
            assert_eq!(found, i32::try_from(f).unwrap(), "{name} {e}");
        }
        for (color, p) in new.get(COLOR).unwrap().iter().zip(new.positions()) {
            assert_eq!(color.truncate(), *p, "{name}");
        }
    }
}
