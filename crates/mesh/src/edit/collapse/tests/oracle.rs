//! A second implementation of the collapse, on lists of polygons. Both implementations must give the same
//! result.

use super::*;

/// Returns small shapes of all kinds. On small shapes, refusals are frequent.
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
        topology(3, &[&[0, 1, 2]]),
        topology(4, &[&[0, 1, 2, 3], &[3, 2, 1, 0]]),
        topology(4, &[&[0, 1, 3], &[1, 2, 3], &[2, 0, 3]]),
        topology(6, &[&[0, 1, 2, 3, 4, 5]]),
        topology(
            8,
            &[&[0, 1, 2, 3, 4], &[1, 0, 5], &[2, 1, 5, 6], &[4, 7, 5, 0]],
        ),
    ]
}

/// Topological counts of a list of polygons.
#[derive(Debug, PartialEq)]
struct Topology {
    euler: i64,
    edges: usize,
    loops: usize,
    components: usize,
    isolated: usize,
    /// The number of faces that lie back to back with another face.
    folded: usize,
}

impl Topology {
    /// Returns the counts, or `None` if the polygons are not a manifold.
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

/// Collapses an edge on a list of polygons: replaces the removed end in all polygons, and removes triangles
/// with both ends. Returns `None` if the result is not a manifold of the same topology.
fn naive(mesh: &Mesh, before: &Topology, e: EdgeId) -> Option<Vec<(usize, Vec<usize>)>> {
    let [a, b] = mesh.edge_vertices(e).map(VertexId::index);
    let (v, removed) = (a.min(b), a.max(b));
    let mut remaining = Vec::new();
    let mut n_vanished = 0;
    for (f, mut corners) in faces(mesh) {
        let is_triangle = corners.len() == 3;
        for corner in &mut corners {
            *corner = if *corner == removed { v } else { *corner };
        }
        corners.dedup();
        if corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        if corners.len() > 2 {
            remaining.push((f, lowest_first(corners)));
        } else {
            assert!(is_triangle);
            n_vanished += 1;
        }
    }
    let n = mesh.domain_len(Domain::Vertex);
    let after = Topology::of(n, &remaining)?;
    // `n` still counts the removed vertex, which no polygon uses, so there is one more isolated vertex.
    let expected = Topology {
        euler: before.euler + 1,
        edges: before.edges - 1 - n_vanished,
        components: before.components + 1,
        isolated: before.isolated + 1,
        folded: after.folded.min(before.folded),
        ..*before
    };
    (after == expected).then_some(remaining)
}

/// Whether a list of polygons can represent the mesh: it has no parallel edges, and no face contains a vertex twice.
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

/// A linear congruential random number generator.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % n
    }
}

/// Applies a random edit. Ignores refusals.
fn random_edit(mesh: &mut Mesh, random: &mut Random) {
    let half_edges: Vec<_> = mesh.half_edges().collect();
    let h = half_edges[random.below(half_edges.len())];
    match random.below(8) {
        0..=2 => drop(mesh.flip_edge(h.edge())),
        3 => drop(mesh.split_edge(h.edge(), 0.5)),
        4 if mesh.n_faces() > 1 => drop(mesh.face(h).map(|f| mesh.delete_face(f))),
        // Joins two corners even if they already share an edge outside the face.
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
fn both_implementations_agree_on_random_meshes() {
    let mut outcomes = BTreeMap::new();
    let mut random = Random(7);
    for round in 0..40 {
        for mut mesh in samples() {
            for _ in 0..round % 8 {
                random_edit(&mut mesh, &mut random);
            }
            assert_eq!(mesh.defects(), []);
            mesh.delete_isolated_vertices();
            let topology = is_simple(&mesh)
                .then(|| Topology::of(mesh.domain_len(Domain::Vertex), &faces(&mesh)))
                .map(|topology| topology.expect("a simple mesh is a manifold list of polygons"));
            for e in mesh.edges() {
                let outcome = compare(&mesh, topology.as_ref(), e);
                *outcomes.entry(outcome).or_insert(0) += 1;
            }
        }
    }
    // Each outcome must have occurred.
    let names: Vec<_> = outcomes.keys().map(String::as_str).collect();
    let expected = [
        "DuplicateEdge",
        "JoinsBoundaries",
        "Link",
        "SameOpposite",
        "Vanishes",
        "VisitsTwice",
        "done",
    ];
    assert_eq!(names, expected, "{outcomes:?}");
    assert!(outcomes["done"] > 3000, "{outcomes:?}");
}

#[test]
fn a_collapse_does_not_change_whether_far_edges_of_triangle_meshes_can_be_collapsed() {
    let mut random = Random(3);
    let (mut n_pairs, mut n_refused) = (0, 0);
    for _ in 0..40 {
        for mesh in samples() {
            let mut mesh = shapes::fans(&mesh);
            for _ in 0..6 {
                random_edit(&mut mesh, &mut random);
            }
            if !mesh.faces().all(|f| mesh.is_triangle(f)) {
                continue;
            }
            let can_collapse = |mesh: &Mesh, e| mesh.check_collapse_to(e, DVec3::ZERO).is_ok();
            for e in mesh.edges().filter(|&e| can_collapse(&mesh, e)) {
                let mut near: Vec<_> = mesh.edge_vertices(e).into();
                near.extend(
                    mesh.edge_vertices(e)
                        .iter()
                        .flat_map(|&v| mesh.vertex_neighbors(v)),
                );
                let mut edited = mesh.clone();
                edited.collapse_checked_edge_to(e, DVec3::ZERO);
                let is_far = |&e: &EdgeId| !mesh.edge_vertices(e).iter().any(|v| near.contains(v));
                for far in mesh.edges().filter(is_far) {
                    let is_possible = can_collapse(&mesh, far);
                    assert_eq!(can_collapse(&edited, far), is_possible, "{e} {far}");
                    n_pairs += 1;
                    n_refused += usize::from(!is_possible);
                }
            }
        }
    }
    assert!(n_pairs > 1000 && n_refused > 100, "{n_pairs} {n_refused}");
}

/// Collapses an edge with both implementations and compares the results. Returns the name of the outcome.
fn compare(mesh: &Mesh, topology: Option<&Topology>, e: EdgeId) -> String {
    let mut edited = mesh.clone();
    let result = edited.collapse_edge(e);
    assert_eq!(edited.defects(), [], "{e}: {result:?}");
    if let Some(topology) = topology {
        let expected = naive(mesh, topology, e);
        assert_eq!(
            result.is_ok(),
            expected.is_some(),
            "{e} {:?}: {result:?}\n{:?}",
            mesh.edge_vertices(e),
            faces(mesh)
        );
        if let Some(expected) = expected {
            assert_eq!(faces(&edited), expected);
        }
    }
    match result {
        Ok(_) => {
            let counts = |mesh: &Mesh| {
                let euler = mesh.euler_characteristic();
                (
                    euler,
                    mesh.n_boundary_loops(),
                    crate::geometry::n_components(mesh),
                )
            };
            assert_eq!(counts(&edited), counts(mesh));
            "done".to_owned()
        }
        Err(reason) => {
            assert_eq!(&edited, mesh);
            let name = format!("{reason:?}");
            name.split('(').next().unwrap_or_default().to_owned()
        }
    }
}
