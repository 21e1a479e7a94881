//! Tests the textbook implementation itself with known results.

use std::collections::BTreeMap;

use mesh::DVec3;
use subdivision::{Boundary, Creasing, LoopWeights, Rules, Scheme, Split};

use crate::masks;
use crate::meshes::{self, Pattern, Random};
use crate::polygons::{Adjacency, Polygons, edge};
use crate::textbook;

const LOOP: Scheme = Scheme::Loop(LoopWeights::Loop);

/// Whether two points are equal up to rounding.
fn is_near(a: DVec3, b: DVec3) -> bool {
    (a - b).abs().max_element() < 1e-13
}

/// Panics unless a vertex is at the given point.
fn assert_has(mesh: &Polygons, p: [f64; 3]) {
    let p = DVec3::from(p);
    assert!(
        mesh.positions.iter().any(|&q| is_near(p, q)),
        "{p} in {:?}",
        mesh.positions
    );
}

fn one_level(mesh: &Polygons, scheme: Scheme) -> Polygons {
    textbook(mesh, Rules::of(scheme), 1)
}

/// Returns the cube from -1 to 1.
fn cube() -> Polygons {
    let sign = |bit: usize| if bit == 0 { -1.0 } else { 1.0 };
    let positions = (0..8)
        .map(|i| DVec3::new(sign(i & 1), sign(i & 2), sign(i & 4)))
        .collect();
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    Polygons::new(positions, faces.map(|face| face.to_vec()).to_vec())
}

/// Returns the tetrahedron on four corners of the [`cube`].
fn tetrahedron() -> Polygons {
    let positions = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
    let faces = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];
    Polygons::new(
        positions.map(|p| DVec3::from(p.map(f64::from))).to_vec(),
        faces.map(|face| face.to_vec()).to_vec(),
    )
}

/// Returns a flat sheet of 6 x 6 squares. If `of_triangles`, each square is cut into two triangles.
fn sheet(of_triangles: bool) -> Polygons {
    let positions = (0..49)
        .map(|i| DVec3::new(f64::from(i % 7), f64::from(i / 7), 0.0))
        .collect();
    let squares = (0..36)
        .map(|i| i % 6 + 7 * (i / 6))
        .map(|i| [i, i + 1, i + 8, i + 7]);
    let faces = squares.flat_map(|[a, b, c, d]| {
        if of_triangles {
            vec![vec![a, b, c], vec![a, c, d]]
        } else {
            vec![vec![a, b, c, d]]
        }
    });
    Polygons::new(positions, faces.collect())
}

#[test]
fn catmull_clark_of_a_cube() {
    let fine = one_level(&cube(), Scheme::CatmullClark);

    assert_eq!((fine.positions.len(), fine.faces.len()), (26, 24));
    assert_has(&fine, [5.0 / 9.0, 5.0 / 9.0, -5.0 / 9.0]);
    assert_has(&fine, [0.0, 0.75, -0.75]);
    assert_has(&fine, [0.0, 0.0, 1.0]);
}

#[test]
fn loop_of_a_tetrahedron() {
    let warren = one_level(&tetrahedron(), Scheme::Loop(LoopWeights::Warren));
    assert_eq!((warren.positions.len(), warren.faces.len()), (10, 16));
    assert_has(&warren, [0.25, 0.25, 0.25]);
    assert_has(&warren, [0.5, 0.0, 0.0]);

    // For three neighbors, both formulas for the weight of a neighbor give (5/8 - (3/8 - 1/8)^2) / 3 = 3/16.
    let loops = one_level(&tetrahedron(), LOOP);
    assert_has(&loops, [0.25, 0.25, 0.25]);
}

#[test]
fn weights_of_loop() {
    assert!((masks::loop_weight(LoopWeights::Loop, 4) - 31.0 / 256.0).abs() < 1e-15);
    assert_eq!(masks::loop_weight(LoopWeights::Warren, 4), 3.0 / 32.0);
    for weights in [LoopWeights::Loop, LoopWeights::Warren] {
        assert!((masks::loop_weight(weights, 6) - 1.0 / 16.0).abs() < 1e-15);
    }
}

#[test]
fn doo_sabin_of_a_cube() {
    let fine = one_level(&cube(), Scheme::DooSabin);

    assert_eq!((fine.positions.len(), fine.faces.len()), (24, 6 + 12 + 8));
    assert!(
        fine.positions
            .iter()
            .all(|p| is_near(p.abs(), [1.0, 0.5, 0.5].into())
                || is_near(p.abs(), [0.5, 1.0, 0.5].into())
                || is_near(p.abs(), [0.5, 0.5, 1.0].into()))
    );
}

#[test]
fn butterfly_of_a_tetrahedron() {
    // Both ends of the edge have three neighbors, so the new vertex is the mean of two sums, one for each end. The
    // first sum is 3/4 a + 5/12 b - 1/12 (c + d); the second sum has a and b swapped. Because a + b + c + d = 0, this
    // mean is (7/12 + 1/12) (a + b).
    let fine = one_level(&tetrahedron(), Scheme::Butterfly);
    assert_has(&fine, [4.0 / 3.0, 0.0, 0.0]);
    assert_has(&fine, [1.0, 1.0, 1.0]);
}

#[test]
fn sqrt3_of_a_tetrahedron() {
    // The total weight of the neighbors is a = (4 + 1) / 9. So the vertex has the weight 4/9 and each neighbor 5/27.
    // The positions of the neighbors sum to minus the position of the vertex.
    let fine = one_level(&tetrahedron(), Scheme::Sqrt3);
    assert_eq!((fine.positions.len(), fine.faces.len()), (8, 12));
    assert_has(&fine, [7.0 / 27.0, 7.0 / 27.0, 7.0 / 27.0]);
    assert_has(&fine, [-1.0 / 3.0, -1.0 / 3.0, -1.0 / 3.0]);
}

#[test]
fn regular_flat_sheets_stay_regular() {
    for (scheme, of_triangles) in [
        (Scheme::CatmullClark, false),
        (LOOP, true),
        (Scheme::Loop(LoopWeights::Warren), true),
        (Scheme::Butterfly, true),
        (Scheme::Midpoint(Split::Quads), false),
        (Scheme::Midpoint(Split::Triangles), true),
    ] {
        let fine = one_level(&sheet(of_triangles), scheme);
        for p in &fine.positions {
            let is_inside = |t: f64| t > 0.75 && t < 5.25;
            let is_even = |t: f64| (2.0 * t - (2.0 * t).round()).abs() < 1e-13;
            assert!(
                !is_inside(p.x) || !is_inside(p.y) || is_even(p.x) && is_even(p.y),
                "{p}"
            );
        }
    }
}

#[test]
fn two_levels_of_sqrt3_divide_each_edge_of_a_regular_sheet_in_three() {
    let fine = textbook(&sheet(true), Rules::of(Scheme::Sqrt3), 2);

    assert_eq!(fine.faces.len(), 9 * 72);
    let is_third = |t: f64| (3.0 * t - (3.0 * t).round()).abs() < 1e-12;
    let is_away = |t: f64| t > 1.5 && t < 4.5;
    for p in fine
        .positions
        .iter()
        .filter(|p| is_away(p.x) && is_away(p.y))
    {
        assert!(is_third(p.x) && is_third(p.y), "{p}");
    }
}

#[test]
fn schemes_commute_with_affine_maps() {
    let map = |p: DVec3| {
        DVec3::new(
            2.0 * p.x - p.y + 3.0,
            p.x + p.y + p.z - 5.0,
            0.5 * p.z + p.x + 7.0,
        )
    };
    let mut random = Random(5);
    let (triangles, polygons) = (meshes::triangles(), meshes::polygons());
    for (scheme, meshes) in [
        (LOOP, &triangles),
        (Scheme::Loop(LoopWeights::Warren), &triangles),
        (Scheme::CatmullClark, &polygons),
        (Scheme::Midpoint(Split::Quads), &polygons),
        (Scheme::Butterfly, &triangles),
        (Scheme::Sqrt3, &triangles),
        (Scheme::DooSabin, &polygons),
    ] {
        for (name, mesh) in meshes {
            let mesh = Pattern::Mixed.on(mesh, &mut random);
            let mut moved = mesh.clone();
            moved.positions.iter_mut().for_each(|p| *p = map(*p));
            let rules = Rules {
                creasing: Creasing::Chaikin,
                ..Rules::of(scheme)
            };
            let (fine, moved) = (textbook(&mesh, rules, 2), textbook(&moved, rules, 2));
            for (&p, &q) in fine.positions.iter().zip(&moved.positions) {
                assert!((map(p) - q).length() < 1e-11, "{name}, {scheme:?}");
            }
        }
    }
}

#[test]
fn surfaces_keep_their_topology() {
    let euler = |name: &str, mesh: &Polygons| {
        let adjacency = Adjacency::new(mesh.positions.len(), &mesh.faces);
        let n_boundary = adjacency
            .sides
            .values()
            .filter(|sides| sides.len() == 1)
            .count();
        assert!(
            adjacency.sides.values().all(|sides| sides.len() <= 2),
            "{name}"
        );
        let n = |count: usize| i64::try_from(count).unwrap();
        (
            n(mesh.positions.len()) - n(adjacency.sides.len()) + n(mesh.faces.len()),
            n_boundary,
        )
    };
    let (triangles, polygons) = (meshes::triangles(), meshes::polygons());
    for (scheme, meshes, more_boundary) in [
        (LOOP, &triangles, 4),
        (Scheme::CatmullClark, &polygons, 4),
        (Scheme::Sqrt3, &triangles, 3),
    ] {
        for (name, mesh) in meshes {
            let fine = textbook(mesh, Rules::of(scheme), 2);
            let (sum, n_boundary) = euler(name, mesh);
            assert_eq!(
                euler(name, &fine),
                (sum, more_boundary * n_boundary),
                "{name}, {scheme:?}"
            );
        }
    }
    for (name, mesh) in &polygons {
        let (sum, n_boundary) = euler(name, mesh);
        assert_eq!(
            euler(name, &one_level(mesh, Scheme::DooSabin)),
            (sum, 2 * n_boundary),
            "{name}"
        );
    }
}

#[test]
fn sharpness_decreases_as_computed_by_hand() {
    let mut mesh = cube();
    mesh.crease = BTreeMap::from([(edge(0, 1), 3.0), (edge(1, 3), 1.5), (edge(1, 5), 10.0)]);
    mesh.corner[1] = 1.4;
    let of = |creasing| {
        let rules = Rules {
            creasing,
            ..Rules::of(Scheme::CatmullClark)
        };
        let fine = textbook(&mesh, rules, 1);
        let at = |v: usize, w: usize| {
            let adjacency = Adjacency::new(8, &mesh.faces);
            let rank = adjacency
                .sides
                .keys()
                .position(|&e| e == edge(v, w))
                .unwrap();
            fine.crease[&edge(v, 8 + rank)]
        };
        assert_eq!(fine.corner[1], 1.4 - 1.0);
        [
            at(0, 1),
            at(1, 0),
            at(1, 3),
            at(3, 1),
            at(1, 5),
            at(5, 1),
            at(0, 2),
        ]
    };
    assert_eq!(of(Creasing::Uniform), [2.0, 2.0, 0.5, 0.5, 10.0, 10.0, 0.0]);
    let chaikin = [
        2.0,
        0.75 * 3.0 + 0.25 * 1.5 - 1.0,
        0.75 * 1.5 + 0.25 * 3.0 - 1.0,
        0.5,
    ];
    assert_eq!(
        of(Creasing::Chaikin),
        [
            chaikin[0], chaikin[1], chaikin[2], chaikin[3], 10.0, 10.0, 0.0
        ]
    );
}

#[test]
fn fractional_sharpness_blends_the_rules() {
    let sharp = |s: f64| {
        let mut mesh = cube();
        mesh.crease = BTreeMap::from([(edge(0, 1), s), (edge(0, 2), s)]);
        one_level(&mesh, Scheme::CatmullClark).positions
    };
    let (smooth, half, full) = (sharp(0.0), sharp(0.5), sharp(1.0));
    for ((&a, &b), &c) in smooth.iter().zip(&half).zip(&full) {
        assert!(is_near(b, 0.5 * a + 0.5 * c));
    }
    // The crease mask is 3/4 of the vertex plus 1/8 of each of two neighbors.
    assert!(is_near(full[0], DVec3::new(-0.75, -0.75, -1.0)));
}

#[test]
fn subdivision_with_all_edges_sharp_is_linear() {
    let mut mesh = cube();
    let adjacency = Adjacency::new(8, &mesh.faces);
    let crease = adjacency.sides.keys().map(|&e| (e, 10.0)).collect();
    mesh.crease = crease;
    let [sharp, linear] = [Scheme::CatmullClark, Scheme::Midpoint(Split::Quads)]
        .map(|scheme| textbook(&mesh, Rules::of(scheme), 2));

    // The faces are flat and symmetric, so only vertices on edges and corners could differ.
    assert_eq!(sharp.positions, linear.positions);
}

#[test]
fn boundaries_are_splines_or_fixed() {
    let square = Polygons::new(
        [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]]
            .map(|p| DVec3::from(p.map(f64::from)))
            .to_vec(),
        vec![vec![0, 1, 2, 3]],
    );
    let rules = Rules::of(Scheme::CatmullClark);
    let smooth = textbook(&square, rules, 1);
    assert_has(&smooth, [0.5, 0.5, 0.0]);
    assert_has(&smooth, [2.0, 0.0, 0.0]);
    for boundary in [Boundary::EdgesAndCorners, Boundary::Fixed] {
        assert_has(&textbook(&square, Rules { boundary, ..rules }, 1), [0.0; 3]);
    }
    let doo_sabin = one_level(&square, Scheme::DooSabin);
    assert_has(&doo_sabin, [1.0, 0.0, 0.0]);
    assert_has(&doo_sabin, [1.0, 1.0, 0.0]);
    assert_eq!((doo_sabin.positions.len(), doo_sabin.faces.len()), (12, 9));
    // Each corner of the triangle moves by 4/27 of the sum of its two sides, as vectors from this corner.
    let triangle = Polygons::new(square.positions[..3].to_vec(), vec![vec![0, 1, 2]]);
    let fine = textbook(&triangle, Rules::of(Scheme::Sqrt3), 2);
    assert_has(&fine, [32.0 / 27.0, 16.0 / 27.0, 0.0]);
    assert_eq!(fine.faces.len(), 9);
}
