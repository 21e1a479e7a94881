//! A collapse on lists of polygons, which must agree with the real one.

use super::*;

/// Shapes of all kinds, small enough that everything is within reach of everything.
pub(super) fn samples() -> Vec<Mesh> {
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
            components: crate::geometry::n_components(&mesh),
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
                (
                    euler,
                    mesh.n_boundary_loops(),
                    crate::geometry::n_components(mesh),
                )
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
