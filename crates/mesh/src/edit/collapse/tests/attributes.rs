//! Tests of attribute values after a collapse, and of undo.

use super::oracle::samples;
use super::*;

#[test]
fn values_follow_their_rules_and_a_crease_stays() {
    let mut mesh = strip();
    let [e, ac, bc, bd] = [(1, 5), (1, 2), (5, 2), (5, 3)].map(|(v, w)| edge(&mesh, v, w));
    let ad = edge(&mesh, 1, 3);
    mesh.set(COLOR, (0..6).map(|i| DVec4::splat(f64::from(i))).collect());
    mesh.set(VERTEX_NORMAL, vec![DVec3::X; 6]);
    mesh.set(MATERIAL, (0..6).collect());
    let mut creases = vec![0.0; mesh.n_edges()];
    (creases[ac.index()], creases[bc.index()]) = (1.0, 3.0);
    (creases[ad.index()], creases[e.index()]) = (2.0, 9.0);
    mesh.set(CREASE, creases);
    let mut is_tagged = vec![false; mesh.n_edges()];
    is_tagged[bd.index()] = true;
    let tag = Column {
        name: "tagged".into(),
        rule: Rule::Copy,
        values: Values::Tag(is_tagged),
    };
    mesh.insert_column(Domain::Edge, tag);

    let v = mesh.collapse_edge_to(e, point(0.5, 7.0)).unwrap();
    // The edge runs from x = -1 to x = 1; the nearest point on it is at t = 0.75.
    assert_eq!(mesh.position(v), point(0.5, 7.0));
    assert_eq!(mesh.get(COLOR).unwrap()[v.index()], DVec4::splat(4.0));
    assert_eq!(mesh.get(VERTEX_NORMAL).unwrap()[v.index()], DVec3::X);
    let crease = mesh.get(CREASE).unwrap();
    assert_eq!([crease[ac.index()], crease[ad.index()]], [3.0, 2.0]);
    let is_tagged = mesh.tag(Domain::Edge, "tagged").unwrap();
    assert_eq!([ac, ad].map(|e| is_tagged[e.index()]), [false, true]);
    assert_eq!(mesh.get(MATERIAL).unwrap(), [0, 1, 2, 3, 4, 5]);
}

#[test]
fn collapsing_to_a_point_beyond_an_end_gives_the_values_of_the_end() {
    for (x, color) in [(-9.0, 1.0), (9.0, 5.0)] {
        let mut mesh = strip();
        mesh.set(COLOR, (0..6).map(|i| DVec4::splat(f64::from(i))).collect());
        let e = edge(&mesh, 1, 5);
        let v = mesh.collapse_edge_to(e, point(x, 1.)).unwrap();
        assert_eq!(mesh.get(COLOR).unwrap()[v.index()], DVec4::splat(color));
    }
}

#[test]
fn linear_uvs_stay_linear() {
    let affine = |p: DVec3| DVec2::new(2.0 * p.x - p.y + 3.0, p.x + 0.5 * p.y);
    for shape in [shapes::grid(4, 4), shapes::fans(&shapes::grid(4, 4))] {
        for e in shape.edges() {
            for t in [0.0, 0.25, 0.5, 1.0] {
                let mut mesh = shape.clone();
                let uv = |h| affine(mesh.position(mesh.origin(h)));
                mesh.set(UV, mesh.half_edges().map(uv).collect());
                if mesh.collapse_edge_at(e, t).is_err() {
                    continue;
                }
                for h in mesh.half_edges().filter(|&h| mesh.face(h).is_some()) {
                    let expected = affine(mesh.position(mesh.origin(h)));
                    let actual = mesh.get(UV).unwrap()[h.index()];
                    assert!(actual.distance(expected) < 1e-12, "{e} {t} {h}");
                }
            }
        }
    }
}

#[test]
fn both_sides_of_a_seam_keep_their_values() {
    // The faces above the x axis and the left face (2) have separate charts.
    let mut mesh = strip();
    let chart = |f: FaceId| match f.index() {
        0 | 4 => 100.0,
        2 => 700.0,
        _ => 0.0,
    };
    let uv = |mesh: &Mesh, h| {
        let p = mesh.position(mesh.origin(h)).truncate();
        let shift = mesh.face(h).map_or(0.0, chart);
        p + DVec2::new(shift, 0.0)
    };
    mesh.set(UV, mesh.half_edges().map(|h| uv(&mesh, h)).collect());
    let v = mesh.collapse_edge_at(edge(&mesh, 1, 5), 0.75).unwrap();
    assert_eq!(mesh.position(v), point(0.5, 0.0));
    for h in mesh.half_edges().filter(|&h| mesh.face(h).is_some()) {
        // The left face has no value in common with either triangle, so it keeps its value at v.
        let is_unchanged = mesh.face(h) == Some(FaceId::new(2)) && mesh.origin(h) == v;
        let expected = if is_unchanged {
            DVec2::new(699.0, 0.0)
        } else {
            uv(&mesh, h)
        };
        assert_eq!(mesh.get(UV).unwrap()[h.index()], expected, "{h}");
    }
}

#[test]
fn a_column_with_the_rule_drop_is_dropped() {
    let mut mesh = strip();
    let dropped = Column {
        name: "dropped".into(),
        rule: Rule::Drop,
        values: Values::Float(vec![0.0; 6]),
    };
    mesh.insert_column(Domain::Vertex, dropped);
    mesh.collapse_edge(edge(&mesh, 1, 5)).unwrap();
    assert!(mesh.attributes().of(Domain::Vertex).is_empty());
}

#[test]
fn a_collapse_undoes_a_split() {
    for shape in [
        shapes::fans(&shapes::grid(3, 3)),
        shapes::icosahedron(),
        shapes::cube(),
        shapes::cylinder(5, false),
    ] {
        for e in shape.edges() {
            let mut mesh = shape.clone();
            let m = mesh.split_edge(e, 0.25).unwrap();
            let ends = shape.edge_vertices(e);
            // Each end of e has a lower id than m. Therefore, if the edge between m and an end collapses, this end
            // remains.
            for v in ends {
                let mut mesh = mesh.clone();
                let half = edge(&mesh, v.index(), m.index());
                mesh.collapse_edge_to(half, shape.position(v)).unwrap();
                assert_eq!(mesh.defects(), []);
                let sorted = |mesh: &Mesh| {
                    let mut corners: Vec<_> = faces(mesh).into_iter().map(|(_, c)| c).collect();
                    corners.sort();
                    corners
                };
                assert_eq!(sorted(&mesh), sorted(&shape));
                assert_eq!(&mesh.positions()[..m.index()], shape.positions());
            }
        }
    }
}

#[test]
fn a_collapse_can_be_undone_and_redone() {
    for mut shape in samples() {
        let n = shape.n_half_edges();
        shape.set(UV, (0..n).map(|i| DVec2::splat(i as f64)).collect());
        shape.set(CREASE, vec![1.0; n / 2]);
        for e in shape.edges() {
            let mut mesh = shape.clone();
            mesh.begin();
            let result = mesh.collapse_edge_at(e, 0.25);
            let after = mesh.clone();
            mesh.rollback();
            assert_eq!(mesh, shape);
            if result.is_err() {
                continue;
            }
            mesh.begin();
            mesh.collapse_edge_at(e, 0.25).unwrap();
            let change = mesh.commit().unwrap();
            let redo = mesh.revert(change);
            assert_eq!(mesh, shape);
            mesh.revert(redo);
            assert_eq!(mesh, after);
        }
    }
}

#[test]
fn the_link_condition_also_works_for_ends_with_many_edges() {
    // Two fans of 40 triangles around 0 and 1, joined by two triangles at the edge 0-1. The rims (the outer edges) of
    // the fans form one loop. The two rims meet at the vertices c and d, the third corners of the two triangles.
    let n = 40;
    let rim: Vec<u32> = (2..2 + 2 * n).collect();
    let fan = |(i, &v): (u32, &u32)| {
        let w = rim[(i as usize + 1) % rim.len()];
        vec![u32::from(i >= n), v, w]
    };
    let mut polygons: Vec<Vec<u32>> = (0..).zip(&rim).map(fan).collect();
    let (c, d) = (rim[n as usize], rim[0]);
    polygons.extend([vec![0, c, 1], vec![1, d, 0]]);
    let mesh = |polygons: &[Vec<u32>]| {
        let polygons: Vec<&[u32]> = polygons.iter().map(Vec::as_slice).collect();
        topology(2 + 2 * n as usize, &polygons)
    };
    let mut open = mesh(&polygons);
    let v = open.collapse_edge(edge(&open, 0, 1)).unwrap();
    assert_eq!(open.defects(), []);
    assert_eq!(open.valence(v), 2 * n as usize);

    // Merge a vertex of one rim with a vertex of the other rim, and fill both halves of the loop. After this
    // merge, the merged vertex is a neighbor of both 0 and 1.
    let (x, y) = (rim[5], rim[n as usize + 5]);
    for v in polygons.iter_mut().flatten() {
        *v = if *v == y { x } else { *v };
    }
    let [left, right] = [
        &rim[6..n as usize + 5],
        &[&rim[n as usize + 6..], &rim[..5]].concat(),
    ];
    for half in [left, right] {
        polygons.push(half.iter().copied().chain([x]).rev().collect());
    }
    let closed = mesh(&polygons);
    let e = edge(&closed, 0, 1);
    assert_eq!(
        refused(&closed, e),
        EditError::Link(e, VertexId::new(x as usize))
    );
}
