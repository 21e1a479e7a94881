use std::collections::BTreeMap;

use glam::{DVec2, DVec3, DVec4};

use super::*;
use crate::{
    COLOR, CREASE, Column, Domain, FaceId, MATERIAL, Rule, UV, VERTEX_NORMAL, Values, shapes,
};

fn at(x: f64, y: f64) -> DVec3 {
    DVec3::new(x, y, 0.0)
}

fn of(positions: &[DVec3], polygons: &[&[u32]]) -> Mesh {
    let (mesh, report) = Mesh::from_polygons(positions.to_vec(), polygons).unwrap();
    assert!(report.is_clean());
    mesh
}

/// Polygons over vertices whose places do not matter.
fn over(n: usize, polygons: &[&[u32]]) -> Mesh {
    of(&vec![DVec3::ZERO; n], polygons)
}

fn edge(mesh: &Mesh, v: usize, w: usize) -> EdgeId {
    let [v, w] = [v, w].map(VertexId::new);
    mesh.find_half_edge(v, w)
        .expect("they share an edge")
        .edge()
}

/// The faces by id, each beginning at its lowest corner.
fn faces(mesh: &Mesh) -> Vec<(usize, Vec<usize>)> {
    let corners = |f| mesh.face_vertices(f).map(VertexId::index).collect();
    mesh.faces()
        .map(|f| (f.index(), lowest_first(corners(f))))
        .collect()
}

fn lowest_first(mut face: Vec<usize>) -> Vec<usize> {
    let low = (0..face.len()).min_by_key(|&i| face[i]).unwrap_or(0);
    face.rotate_left(low);
    face
}

/// The edit is refused for this reason, and every array stays as it was.
fn refused(mesh: &Mesh, e: EdgeId) -> EditError {
    let mut edited = mesh.clone();
    let reason = edited.collapse_edge(e).unwrap_err();
    assert_eq!(&edited, mesh);
    reason
}

/// Two triangles and what lies around them: a = 1, b = 5, c = 2, d = 3 of the picture, in a strip.
fn strip() -> Mesh {
    let positions = [
        at(-2., 0.),
        at(-1., 0.),
        at(0., 1.),
        at(0., -1.),
        at(2., 0.),
        at(1., 0.),
    ];
    let around: [&[u32]; 6] = [
        &[1, 5, 2],
        &[5, 1, 3],
        &[1, 2, 0],
        &[1, 0, 3],
        &[5, 4, 2],
        &[5, 3, 4],
    ];
    of(&positions, &around)
}

#[test]
fn two_triangles_vanish_and_ids_stay_as_documented() {
    let mut mesh = strip();
    let [e, bc, bd] = [(1, 5), (5, 2), (5, 3)].map(|(v, w)| edge(&mesh, v, w));
    let [ac, ad] = [(1, 2), (1, 3)].map(|(v, w)| edge(&mesh, v, w));
    assert_eq!(mesh.collapse_edge(e), Ok(VertexId::new(1)));
    assert_eq!(mesh.defects(), []);
    assert_eq!(mesh.position(VertexId::new(1)), at(0., 0.));
    assert!(!mesh.has_vertex(VertexId::new(5)));
    assert_eq!([e, bc, bd].map(|e| mesh.has_edge(e)), [false; 3]);
    assert_eq!([ac, ad].map(|e| mesh.has_edge(e)), [true; 2]);
    let left = [
        (2, vec![0, 1, 2]),
        (3, vec![0, 3, 1]),
        (4, vec![1, 4, 2]),
        (5, vec![1, 3, 4]),
    ];
    assert_eq!(faces(&mesh), left);
}

#[test]
fn the_lower_number_survives_whichever_end_it_is() {
    for turned in [false, true] {
        // The edge runs from 0 to 1 on the first face, or from 1 to 0.
        let polygons: [&[u32]; 2] = if turned {
            [&[1, 0, 2, 3], &[0, 1, 4]]
        } else {
            [&[0, 1, 2, 3], &[1, 0, 4]]
        };
        let mut mesh = over(5, &polygons);
        // The edge is inside and both ends are on the boundary: a face behind each makes one inner.
        let e = edge(&mesh, 0, 1);
        assert_eq!(refused(&mesh, e), EditError::JoinsBoundaries(e));
        let e = edge(&mesh, 1, 4);
        assert_eq!(mesh.collapse_edge(e), Ok(VertexId::new(1)));
        assert_eq!(mesh.defects(), []);
        assert_eq!(mesh.n_faces(), 1);
        assert!(mesh.has_edge(edge(&mesh, 0, 1)));
    }
}

#[test]
fn larger_faces_lose_a_corner() {
    let mut mesh = shapes::cube();
    let e = edge(&mesh, 1, 5);
    mesh.collapse_edge(e).unwrap();
    assert_eq!(mesh.defects(), []);
    let mut degrees: Vec<_> = mesh.faces().map(|f| mesh.degree(f)).collect();
    degrees.sort_unstable();
    assert_eq!(degrees, [3, 3, 4, 4, 4, 4]);
    assert_eq!(mesh.euler_characteristic(), 2);
}

#[test]
fn a_boundary_edge_takes_its_triangle_along() {
    // The lowest three of a fan of triangles over a row of points.
    for gone in [0, 1, 2, 3] {
        let points: Vec<DVec3> = (0..5).map(|i| at(f64::from(i), 0.)).collect();
        let positions = [&points[..], &[at(2., 2.)]].concat();
        let mut mesh = of(
            &positions,
            &[&[0, 1, 5], &[1, 2, 5], &[2, 3, 5], &[3, 4, 5]],
        );
        let e = edge(&mesh, gone, gone + 1);
        let v = mesh.collapse_edge(e).unwrap();
        assert_eq!(v, VertexId::new(gone));
        assert_eq!(mesh.defects(), []);
        assert_eq!(
            (mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()),
            (5, 7, 3)
        );
        assert!(mesh.is_boundary_vertex(v));
    }
}

// ---- Refusals ------------------------------------------------------------------------------------

#[test]
fn nothing_is_folded_onto_itself_or_emptied() {
    let pillow = over(3, &[&[0, 1, 2], &[0, 2, 1]]);
    let triangle = over(3, &[&[0, 1, 2]]);
    // Two squares back to back would be left, and two triangles.
    let squares = over(5, &[&[0, 1, 2], &[1, 0, 3], &[0, 2, 4, 3], &[1, 3, 4, 2]]);
    let tent = over(4, &[&[0, 1, 2], &[1, 0, 2, 3], &[1, 3, 2]]);
    for mesh in [pillow, triangle, shapes::tetrahedron()] {
        for e in mesh.edges() {
            assert_eq!(refused(&mesh, e), EditError::Vanishes(e));
        }
    }
    for mesh in [squares, tent] {
        let e = edge(&mesh, 0, 1);
        assert_eq!(refused(&mesh, e), EditError::Vanishes(e));
    }
    // Faces that are back to back already only lose a corner.
    let mut pillow = over(4, &[&[0, 1, 2, 3], &[3, 2, 1, 0]]);
    pillow.collapse_edge(EdgeId::new(0)).unwrap();
    assert_eq!(pillow.defects(), []);
    assert_eq!(pillow.n_faces(), 2);
}

#[test]
fn a_neighbour_in_common_beyond_the_triangles_is_refused() {
    // The waist of two tetrahedra that share a face, which is not there.
    let mesh = over(
        5,
        &[
            &[0, 1, 3],
            &[1, 2, 3],
            &[2, 0, 3],
            &[1, 0, 4],
            &[2, 1, 4],
            &[0, 2, 4],
        ],
    );
    let e = edge(&mesh, 0, 1);
    assert_eq!(refused(&mesh, e), EditError::Link(e, VertexId::new(2)));
}

#[test]
fn a_neighbour_in_common_on_the_same_polygon_is_refused() {
    // 2 is the neighbour of 1 on the square and of 0 beyond it.
    let mesh = over(
        5,
        &[
            &[0, 1, 2, 3],
            &[1, 0, 4],
            &[2, 1, 4],
            &[0, 2, 4],
            &[0, 3, 2],
        ],
    );
    let e = edge(&mesh, 0, 1);
    assert_eq!(refused(&mesh, e), EditError::Link(e, VertexId::new(2)));
}

#[test]
fn a_hole_of_three_does_not_close() {
    let mut mesh = shapes::octahedron();
    mesh.delete_face(FaceId::new(0)).unwrap();
    let rim = mesh.half_edges().find(|&h| mesh.face(h).is_none()).unwrap();
    let opposite = mesh.target(mesh.next(rim));
    let e = rim.edge();
    assert_eq!(refused(&mesh, e), EditError::Link(e, opposite));
}

#[test]
fn a_face_that_touches_both_ends_elsewhere_is_refused() {
    // The square has 0 and 1 as opposite corners, and two triangles at their edge close it.
    let mesh = over(4, &[&[0, 2, 1, 3], &[0, 1, 2], &[1, 0, 3]]);
    let e = edge(&mesh, 0, 1);
    let twice = EditError::VisitsTwice(FaceId::new(0), VertexId::new(0));
    assert_eq!(refused(&mesh, e), twice);
}

#[test]
fn a_second_edge_between_the_ends_is_refused() {
    // A split where both triangles have the same corner opposite joins it twice.
    let mut mesh = over(3, &[&[0, 1, 2], &[0, 2, 1]]);
    let m = mesh.split_edge(edge(&mesh, 0, 1), 0.5).unwrap();
    let half = edge(&mesh, 0, m.index());
    assert_eq!(
        refused(&mesh, half),
        EditError::SameOpposite(half, VertexId::new(2))
    );
    for end in [0, 1] {
        mesh.split_edge(edge(&mesh, end, 2), 0.5).unwrap();
    }
    let twice = edge(&mesh, m.index(), 2);
    let [v, w] = mesh.edge_vertices(twice);
    assert_eq!(refused(&mesh, twice), EditError::DuplicateEdge(v, w));
}

#[test]
fn bad_places_and_edges_are_refused() {
    let mesh = shapes::octahedron();
    let mut edited = mesh.clone();
    let e = EdgeId::new(0);
    for t in [-0.1, 1.1, f64::NAN] {
        let refused = edited.collapse_edge_at(e, t);
        assert!(matches!(refused, Err(EditError::OutsideEdge(_))));
    }
    for x in [f64::NAN, f64::INFINITY] {
        let refused = edited.collapse_edge_to(e, DVec3::new(0.0, x, 0.0));
        assert!(matches!(refused, Err(EditError::BadNumber(_))));
    }
    assert_eq!(edited, mesh);
    for e in [EdgeId::new(99), EdgeId::NONE] {
        assert_eq!(refused(&mesh, e), EditError::NoSuchEdge(e));
    }
}

// ---- Attributes ----------------------------------------------------------------------------------

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
    let mut marks = vec![false; mesh.n_edges()];
    marks[bd.index()] = true;
    let tag = Column {
        name: "marked".into(),
        rule: Rule::Copy,
        values: Values::Tag(marks),
    };
    mesh.insert_column(Domain::Edge, tag);

    let v = mesh.collapse_edge_to(e, at(0.5, 7.0)).unwrap();
    // The nearest place on the edge from x = -1 to x = 1 is three quarters along it.
    assert_eq!(mesh.position(v), at(0.5, 7.0));
    assert_eq!(mesh.get(COLOR).unwrap()[v.index()], DVec4::splat(4.0));
    assert_eq!(mesh.get(VERTEX_NORMAL).unwrap()[v.index()], DVec3::X);
    let crease = mesh.get(CREASE).unwrap();
    assert_eq!([crease[ac.index()], crease[ad.index()]], [3.0, 2.0]);
    let marks = mesh.tag(Domain::Edge, "marked").unwrap();
    assert_eq!([marks[ac.index()], marks[ad.index()]], [false, true]);
    assert_eq!(mesh.get(MATERIAL).unwrap(), [0, 1, 2, 3, 4, 5]);
}

#[test]
fn a_point_beyond_an_end_has_the_values_of_the_end() {
    for (x, color) in [(-9.0, 1.0), (9.0, 5.0)] {
        let mut mesh = strip();
        mesh.set(COLOR, (0..6).map(|i| DVec4::splat(f64::from(i))).collect());
        let v = mesh.collapse_edge_to(edge(&mesh, 1, 5), at(x, 1.)).unwrap();
        assert_eq!(mesh.get(COLOR).unwrap()[v.index()], DVec4::splat(color));
    }
}

#[test]
fn a_field_that_is_linear_stays_linear() {
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
                    let found = mesh.get(UV).unwrap()[h.index()];
                    assert!(found.distance(expected) < 1e-12, "{e} {t} {h}");
                }
            }
        }
    }
}

#[test]
fn both_sides_of_a_seam_keep_their_values() {
    // Above the x axis a chart of its own, and the face at the left of its own too.
    let mut mesh = strip();
    let chart = |f: FaceId| match f.index() {
        0 | 4 => 100.0,
        2 => 700.0,
        _ => 0.0,
    };
    let uv = |mesh: &Mesh, h| {
        let place = mesh.position(mesh.origin(h)).truncate();
        let shift = mesh.face(h).map_or(0.0, chart);
        place + DVec2::new(shift, 0.0)
    };
    mesh.set(UV, mesh.half_edges().map(|h| uv(&mesh, h)).collect());
    let v = mesh.collapse_edge_at(edge(&mesh, 1, 5), 0.75).unwrap();
    assert_eq!(mesh.position(v), at(0.5, 0.0));
    for h in mesh.half_edges().filter(|&h| mesh.face(h).is_some()) {
        // The left face is beside neither triangle in the texture: it keeps its value at v.
        let stays = mesh.face(h) == Some(FaceId::new(2)) && mesh.origin(h) == v;
        let expected = if stays {
            DVec2::new(699.0, 0.0)
        } else {
            uv(&mesh, h)
        };
        assert_eq!(mesh.get(UV).unwrap()[h.index()], expected, "{h}");
    }
}

#[test]
fn a_column_to_be_dropped_is_dropped() {
    let mut mesh = strip();
    let passing = Column {
        name: "passing".into(),
        rule: Rule::Drop,
        values: Values::Float(vec![0.0; 6]),
    };
    mesh.insert_column(Domain::Vertex, passing);
    mesh.collapse_edge(edge(&mesh, 1, 5)).unwrap();
    assert!(mesh.attributes().of(Domain::Vertex).is_empty());
}

// ---- Laws ----------------------------------------------------------------------------------------

#[test]
fn a_split_edge_collapses_to_what_it_was() {
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
            // m has the highest number, so both ends survive it.
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
fn a_collapse_can_be_taken_back_and_done_again() {
    for mut shape in samples() {
        let n = shape.n_half_edges();
        shape.set(UV, (0..n).map(|i| DVec2::splat(i as f64)).collect());
        shape.set(CREASE, vec![1.0; n / 2]);
        for e in shape.edges() {
            let mut mesh = shape.clone();
            mesh.begin();
            let done = mesh.collapse_edge_at(e, 0.25);
            let after = mesh.clone();
            mesh.rollback();
            assert_eq!(mesh, shape);
            if done.is_err() {
                continue;
            }
            mesh.begin();
            mesh.collapse_edge_at(e, 0.25).unwrap();
            let change = mesh.commit().unwrap();
            let again = mesh.revert(change);
            assert_eq!(mesh, shape);
            mesh.revert(again);
            assert_eq!(mesh, after);
        }
    }
}

#[test]
fn ends_of_many_edges_are_judged_as_others_are() {
    // Two fans of 40 triangles around 0 and 1, joined by two triangles at the edge 0-1. Their rims are
    // one loop; c and d, where they meet, are the third corners of the two.
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
        over(2 + 2 * n as usize, &polygons)
    };
    let mut open = mesh(&polygons);
    let v = open.collapse_edge(edge(&open, 0, 1)).unwrap();
    assert_eq!(open.defects(), []);
    assert_eq!(open.valence(v), 2 * n as usize);

    // With a vertex of each rim made one, and the two halves of the loop filled, that is in common.
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

// ---- The oracle ----------------------------------------------------------------------------------

/// Shapes of all kinds, small enough that everything is within reach of everything.
fn samples() -> Vec<Mesh> {
    let fans = |mesh: Mesh| shapes::fans(&mesh);
    vec![
        shapes::square(),
        shapes::grid(2, 1),
        shapes::grid(2, 2),
        shapes::grid(3, 3),
        fans(shapes::grid(2, 2)),
        fans(shapes::grid(3, 3)),
        shapes::cube(),
        fans(shapes::cube()),
        shapes::tetrahedron(),
        shapes::octahedron(),
        shapes::icosahedron(),
        shapes::torus(3, 3, 2.0, 1.0),
        fans(shapes::torus(3, 3, 2.0, 1.0)),
        fans(shapes::torus(4, 3, 2.0, 1.0)),
        shapes::cylinder(3, true),
        shapes::cylinder(3, false),
        fans(shapes::cylinder(3, false)),
        shapes::cylinder(5, true),
        shapes::uv_sphere(3, 2),
        over(3, &[&[0, 1, 2]]),
        over(4, &[&[0, 1, 2, 3], &[3, 2, 1, 0]]),
        over(4, &[&[0, 1, 3], &[1, 2, 3], &[2, 0, 3]]),
        over(6, &[&[0, 1, 2, 3, 4, 5]]),
        over(
            8,
            &[&[0, 1, 2, 3, 4], &[1, 0, 5], &[2, 1, 5, 6], &[4, 7, 5, 0]],
        ),
    ]
}

/// What a mesh is like, counted on its list of polygons.
#[derive(Debug, PartialEq)]
struct Shape {
    euler: i64,
    edges: usize,
    loops: usize,
    components: usize,
    isolated: usize,
    /// Pairs of faces that lie back to back.
    folded: usize,
}

impl Shape {
    /// `None` if the polygons are not a manifold.
    fn of(n: usize, faces: &[(usize, Vec<usize>)]) -> Option<Self> {
        let number = |&v: &usize| u32::try_from(v).unwrap();
        let polygons: Vec<Vec<u32>> = faces
            .iter()
            .map(|(_, p)| p.iter().map(number).collect())
            .collect();
        let (mesh, report) = Mesh::from_polygons(vec![DVec3::ZERO; n], &polygons).unwrap();
        let backs = faces
            .iter()
            .map(|(_, p)| lowest_first(p.iter().rev().copied().collect()));
        let folded = backs
            .map(|back| faces.iter().filter(|(_, front)| *front == back).count())
            .sum();
        report.is_clean().then(|| Self {
            euler: mesh.euler_characteristic(),
            edges: mesh.n_edges(),
            loops: mesh.n_boundary_loops(),
            components: mesh.n_components(),
            isolated: mesh.n_isolated_vertices(),
            folded,
        })
    }
}

/// The collapse on a list of polygons: the corner goes, and triangles with both ends. `None` if the
/// result is not a manifold of the same shape.
fn naive(mesh: &Mesh, before: &Shape, e: EdgeId) -> Option<Vec<(usize, Vec<usize>)>> {
    let [a, b] = mesh.edge_vertices(e).map(VertexId::index);
    let (v, gone) = (a.min(b), a.max(b));
    let mut left = Vec::new();
    let mut vanished = 0;
    for (f, mut corners) in faces(mesh) {
        let is_triangle = corners.len() == 3;
        for corner in &mut corners {
            *corner = if *corner == gone { v } else { *corner };
        }
        corners.dedup();
        if corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        if corners.len() > 2 {
            left.push((f, lowest_first(corners)));
        } else {
            assert!(is_triangle);
            vanished += 1;
        }
    }
    let n = mesh.domain_len(Domain::Vertex);
    let after = Shape::of(n, &left)?;
    // The vertex that is gone is an isolated one of the list.
    let expected = Shape {
        euler: before.euler + 1,
        edges: before.edges - 1 - vanished,
        components: before.components + 1,
        isolated: before.isolated + 1,
        folded: after.folded.min(before.folded),
        ..*before
    };
    (after == expected).then_some(left)
}

/// Whether a list of polygons says all of the mesh.
fn is_simple(mesh: &Mesh) -> bool {
    let mut ends: Vec<_> = mesh
        .edges()
        .map(|e| {
            let [v, w] = mesh.edge_vertices(e);
            [v.min(w), v.max(w)]
        })
        .collect();
    ends.sort_unstable();
    let visits_once = |f| {
        let mut corners: Vec<_> = mesh.face_vertices(f).collect();
        corners.sort_unstable();
        corners.windows(2).all(|pair| pair[0] != pair[1])
    };
    ends.windows(2).all(|pair| pair[0] != pair[1]) && mesh.faces().all(visits_once)
}

/// Numbers that look random: a linear congruence.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % n
    }
}

/// Some edit, refused or not.
fn edit_somewhere(mesh: &mut Mesh, numbers: &mut Numbers) {
    let half_edges: Vec<_> = mesh.half_edges().collect();
    let h = half_edges[numbers.below(half_edges.len())];
    match numbers.below(8) {
        0..=2 => drop(mesh.flip_edge(h.edge())),
        3 => drop(mesh.split_edge(h.edge(), 0.5)),
        4 if mesh.n_faces() > 1 => drop(mesh.face(h).map(|f| mesh.delete_face(f))),
        // Joins corners whether they are joined outside the face or not.
        5 if mesh.face(h).is_some_and(|f| mesh.degree(f) > 3) => {
            let opposite = mesh.next(mesh.next(h));
            if mesh.origin(h) != mesh.origin(opposite) {
                mesh.insert_edge(h, opposite, h);
            }
        }
        _ => drop(mesh.collapse_edge(h.edge())),
    }
}

#[test]
fn the_verdict_is_that_of_a_list_of_polygons() {
    let mut verdicts = BTreeMap::new();
    let mut numbers = Numbers(7);
    for round in 0..40 {
        for mut mesh in samples() {
            for _ in 0..round % 8 {
                edit_somewhere(&mut mesh, &mut numbers);
            }
            assert_eq!(mesh.defects(), []);
            mesh.delete_isolated_vertices();
            let shape = is_simple(&mesh)
                .then(|| Shape::of(mesh.domain_len(Domain::Vertex), &faces(&mesh)))
                .map(|shape| shape.expect("a list of polygons says all of it"));
            for e in mesh.edges() {
                let verdict = compare(&mesh, shape.as_ref(), e);
                *verdicts.entry(verdict).or_insert(0) += 1;
            }
        }
    }
    // Every reason has been seen, and often enough that it means something.
    let seen: Vec<_> = verdicts.keys().map(String::as_str).collect();
    let expected = [
        "DuplicateEdge",
        "JoinsBoundaries",
        "Link",
        "SameOpposite",
        "Vanishes",
        "VisitsTwice",
        "done",
    ];
    assert_eq!(seen, expected, "{verdicts:?}");
    assert!(verdicts["done"] > 3000, "{verdicts:?}");
}

/// Collapses an edge on both; the name of the verdict.
fn compare(mesh: &Mesh, shape: Option<&Shape>, e: EdgeId) -> String {
    let mut edited = mesh.clone();
    let done = edited.collapse_edge(e);
    assert_eq!(edited.defects(), [], "{e}: {done:?}");
    if let Some(shape) = shape {
        let expected = naive(mesh, shape, e);
        assert_eq!(
            done.is_ok(),
            expected.is_some(),
            "{e} {:?}: {done:?}\n{:?}",
            mesh.edge_vertices(e),
            faces(mesh)
        );
        if let Some(expected) = expected {
            assert_eq!(faces(&edited), expected);
        }
    }
    match done {
        Ok(_) => {
            let shape = |mesh: &Mesh| {
                let euler = mesh.euler_characteristic();
                (euler, mesh.n_boundary_loops(), mesh.n_components())
            };
            assert_eq!(shape(&edited), shape(mesh));
            "done".to_owned()
        }
        Err(reason) => {
            assert_eq!(&edited, mesh);
            let name = format!("{reason:?}");
            name.split('(').next().unwrap_or_default().to_owned()
        }
    }
}
