//! Local refinement.

mod values;

use geometry::shapes;
use mesh::{COLOR, CREASE, DVec2, DVec3, DVec4, FaceId, MATERIAL, Mesh, UV, VERTEX_SHARPNESS};
use progress::NoProgress;

use crate::fixtures::{self, sheet};
use crate::{
    Boundary, Creasing, FaceVarying, LoopWeights, Rules, Scheme, Split, SubdivisionError,
    refine_faces, subdivide,
};

const LOOP: Rules = Rules::of(Scheme::Loop(LoopWeights::Warren));
const MIDPOINT: Rules = Rules::of(Scheme::Midpoint(Split::Triangles));
const CATMULL_CLARK: Rules = Rules::of(Scheme::CatmullClark);
const QUADS: Rules = Rules::of(Scheme::Midpoint(Split::Quads));

/// Refines some faces and checks the invariants of the result.
fn refined(mesh: &Mesh, faces: &[bool], rules: Rules, levels: u32) -> Mesh {
    let new = refine_faces(mesh, faces, rules, levels, u64::MAX, &NoProgress).unwrap();
    assert_eq!(new.defects(), [], "{:?} {faces:?}", rules.scheme);
    new
}

/// Chooses about one in `one_in` faces pseudo-randomly, depending on their ids and a seed.
fn some(mesh: &Mesh, one_in: u32, seed: u32) -> Vec<bool> {
    let number = |f: usize| u32::try_from(f).unwrap() + 1 + 1000 * seed;
    let is_chosen = |f: usize| (number(f).wrapping_mul(2_654_435_769) >> 16).is_multiple_of(one_in);
    (0..mesh.n_faces()).map(is_chosen).collect()
}

/// Returns meshes, each with flags of its chosen faces: about a half, a third or a seventh of the faces, or only the
/// first face.
fn cases() -> Vec<(&'static str, Mesh, Vec<bool>)> {
    let mut cases = Vec::new();
    for (name, mesh) in fixtures::all() {
        for (one_in, seed) in [(2, 0), (3, 1), (7, 2), (7, 3)] {
            cases.push((name, mesh.clone(), some(&mesh, one_in, seed)));
        }
        let first = (0..mesh.n_faces()).map(|f| f == 0).collect();
        cases.push((name, mesh, first));
    }
    cases
}

/// Adds attributes of vertices, corners, edges and faces to a mesh, with values that differ between elements.
fn with_attributes(mut mesh: Mesh) -> Mesh {
    let uvs = mesh.half_edges().map(|h| match mesh.face(h) {
        // Every fourth face has texture coordinates that differ from those of its neighbors, so its edges are seams.
        Some(f) if f.index() % 4 == 3 => DVec2::new(h.index() as f64, 10.0),
        Some(_) => mesh.position(mesh.origin(h)).truncate(),
        None => DVec2::ZERO,
    });
    mesh.set(UV, uvs.collect());
    let colors = mesh.positions().iter().map(|p| p.extend(1.0));
    mesh.set(COLOR, colors.collect::<Vec<DVec4>>());
    mesh.set(
        CREASE,
        (0..mesh.n_edges()).map(|e| (e % 4) as f64 * 0.9).collect(),
    );
    let corner = |v: usize| if v.is_multiple_of(5) { 1.5 } else { 0.0 };
    mesh.set(
        VERTEX_SHARPNESS,
        (0..mesh.n_vertices()).map(corner).collect(),
    );
    mesh.set(MATERIAL, (0..).take(mesh.n_faces()).collect());
    mesh
}

fn topology(m: &Mesh) -> (i64, usize, usize, usize) {
    (
        m.euler_characteristic(),
        geometry::n_components(m),
        m.n_boundary_loops(),
        m.n_isolated_vertices(),
    )
}

#[test]
fn topology_is_kept_and_triangles_stay_triangles() {
    for (name, mesh, faces) in cases() {
        for rules in [LOOP, MIDPOINT] {
            for levels in 1..=3 {
                let new = refined(&mesh, &faces, rules, levels);
                assert_eq!(topology(&new), topology(&mesh), "{name} {levels}");
                assert!(new.faces().all(|f| new.is_triangle(f)), "{name} {levels}");
                let n = faces.iter().filter(|&&c| c).count() << (2 * levels);
                assert!(new.n_faces() >= n, "{name} {levels}");
            }
        }
    }
}

#[test]
fn refining_all_triangles_equals_subdividing() {
    for (name, mesh) in fixtures::all() {
        let mesh = with_attributes(mesh);
        let all = vec![true; mesh.n_faces()];
        let options = [
            (Boundary::EdgesOnly, Creasing::Uniform, FaceVarying::All),
            (Boundary::Fixed, Creasing::Chaikin, FaceVarying::None),
            (
                Boundary::EdgesAndCorners,
                Creasing::Uniform,
                FaceVarying::CornersPlus1,
            ),
        ];
        for (boundary, creasing, face_varying) in options {
            for scheme in [LOOP, MIDPOINT].map(|r| r.scheme) {
                let rules = Rules {
                    scheme,
                    boundary,
                    creasing,
                    face_varying,
                };
                for levels in 0..=3 {
                    let expected = subdivide(&mesh, rules, levels, &NoProgress).unwrap();
                    let new = refined(&mesh, &all, rules, levels);
                    if all.is_empty() {
                        continue; // The mesh has no faces, so refining changes nothing.
                    }
                    assert!(new == expected, "{name} {rules:?} {levels}");
                }
            }
        }
    }
}

#[test]
fn refining_all_polygons_equals_subdividing() {
    for (name, mesh) in polygons() {
        let mesh = with_attributes(mesh);
        let all = vec![true; mesh.n_faces()];
        for rules in [CATMULL_CLARK, QUADS] {
            let expected = subdivide(&mesh, rules, 2, &NoProgress).unwrap();
            let new = refined(&mesh, &all, rules, 2);
            assert!(new == expected, "{name} {rules:?}");
        }
    }
}

fn polygons() -> Vec<(&'static str, Mesh)> {
    let mut meshes = fixtures::all();
    meshes.retain(|(_, mesh)| mesh.n_faces() > 0);
    meshes.push(("cube", shapes::cube()));
    meshes.push(("grid", shapes::grid(4, 3)));
    meshes.push(("cylinder", shapes::cylinder(7, true)));
    meshes
}

#[test]
fn midpoints_keep_the_shape() {
    for (name, mesh, faces) in cases() {
        let new = refined(&mesh, &faces, MIDPOINT, 3);
        let scale = geometry::area(&mesh).max(1.0);
        assert!(
            (geometry::area(&new) - geometry::area(&mesh)).abs() < 1e-13 * scale,
            "{name}"
        );
        assert!(
            (geometry::volume(&new) - geometry::volume(&mesh)).abs() < 1e-13 * scale,
            "{name}"
        );
        assert_eq!(
            new.positions()[..mesh.n_vertices()],
            *mesh.positions(),
            "{name}"
        );
    }
    // Every new triangle lies inside its old triangle, so the new triangles cover a flat sheet exactly once.
    let flat = sheet(4, 3);
    let new = refined(&flat, &some(&flat, 5, 4), MIDPOINT, 4);
    assert!(new.faces().all(|f| new.area_vector(f).z > 0.0));
    assert_eq!(geometry::area(&new), geometry::area(&flat));
}

/// Returns the largest cotangent of all angles.
fn largest_cotangent(mesh: &Mesh) -> f64 {
    let corners = mesh.half_edges().filter(|&h| mesh.face(h).is_some());
    let cotangents = corners.map(|h| {
        let [a, b, c] = [h, mesh.next(h), mesh.prev(h)].map(|h| mesh.position(mesh.origin(h)));
        (b - a).dot(c - a) / (b - a).cross(c - a).length()
    });
    cotangents.fold(0.0, f64::max)
}

#[test]
fn the_cotangent_of_the_smallest_angle_is_at_most_three_times_the_old_one() {
    for (name, mesh, faces) in cases() {
        let old = largest_cotangent(&mesh);
        for levels in 1..=5 {
            let new = largest_cotangent(&refined(&mesh, &faces, MIDPOINT, levels));
            assert!(
                new <= 3.0 * old * (1.0 + 1e-9),
                "{name} {levels} {new} {old}"
            );
        }
    }
    // Refining equilateral triangles makes no angle below 30 degrees (half of 60 degrees) on any level.
    let mesh = shapes::icosahedron();
    let faces = some(&mesh, 4, 0);
    for levels in 1..=6 {
        let cotangent = largest_cotangent(&refined(&mesh, &faces, MIDPOINT, levels));
        assert!(
            (cotangent - 3.0_f64.sqrt()).abs() < 1e-9,
            "{levels} {cotangent}"
        );
    }
}

#[test]
fn nothing_moves_outside_of_the_chosen_faces() {
    for (name, mesh, faces) in cases() {
        // At a vertex with a face that is not chosen, Loop and midpoint subdivision give the same position.
        let smooth = refined(&mesh, &faces, LOOP, 3);
        let linear = refined(&mesh, &faces, MIDPOINT, 3);
        assert_eq!(smooth.connectivity(), linear.connectivity(), "{name}");
        let mesh = with_faces_numbered(mesh);
        let new = refined(&mesh, &faces, LOOP, 3);
        let material = new.get(MATERIAL).unwrap();
        for v in new.vertices() {
            let mut around = new.vertex_faces(v);
            let is_inside = |f: FaceId| faces[usize::try_from(material[f.index()]).unwrap()];
            if !around.all(is_inside) {
                assert_eq!(smooth.position(v), linear.position(v), "{name} {v}");
            }
        }
    }
}

fn with_faces_numbered(mut mesh: Mesh) -> Mesh {
    mesh.set(MATERIAL, (0..).take(mesh.n_faces()).collect());
    mesh
}

#[test]
fn far_inside_the_chosen_faces_the_surface_equals_subdivision() {
    // Refines a disk in the middle of a large sheet with bumps, and compares the vertices near the center of the disk.
    let mut mesh = sheet(12, 12);
    for p in mesh.positions_mut() {
        p.z = libm::sin(3.0 * p.x) * libm::cos(2.0 * p.y);
    }
    let far = |f: FaceId| mesh.face_center(f).length();
    let faces: Vec<bool> = mesh.faces().map(|f| far(f) < 4.5).collect();
    let local = refined(&mesh, &faces, LOOP, 2);
    let whole = subdivide(&mesh, LOOP, 2, &NoProgress).unwrap();
    // Old vertices keep their ids. The border of the chosen faces does not affect vertices that are two or more rings
    // away from it.
    let mut n = 0;
    for v in mesh.vertices().filter(|&v| mesh.position(v).length() < 2.0) {
        assert!(local.position(v).distance(whole.position(v)) < 1e-14, "{v}");
        n += 1;
    }
    assert!(n > 5, "{n}");
    assert!(local.n_faces() < whole.n_faces());
}

#[test]
fn neighbors_differ_by_one_level_at_most() {
    // The level of a triangle follows from its area. A green triangle has half the area of an ordinary triangle of the
    // same level, so its computed level is higher by one half.
    let mesh = sheet(8, 8);
    let first: Vec<bool> = (0..mesh.n_faces()).map(|f| f == 60).collect();
    let new = refined(&mesh, &first, MIDPOINT, 5);
    let level = |f: FaceId| -libm::log2(2.0 * new.face_area(f)) / 2.0;
    for e in new.edges() {
        if let [Some(f), Some(g)] = new.edge_faces(e) {
            let step = (level(f) - level(g)).abs();
            assert!(step < 1.01, "{e} {step}");
        }
    }
    // The levels decrease quickly away from the first triangle. Therefore the whole result has fewer triangles than
    // four old triangles would give if all their parts were refined (4^5 each).
    assert!(new.n_faces() < 4 * 1024, "{}", new.n_faces());
}

#[test]
fn refined_meshes_can_be_refined_again() {
    for (name, mesh, faces) in cases() {
        let once = refined(&mesh, &faces, LOOP, 1);
        let twice = refined(&once, &some(&once, 3, 9), LOOP, 2);
        assert_eq!(topology(&twice), topology(&mesh), "{name}");
    }
}

#[test]
fn neighbors_of_chosen_polygons_get_additional_corners() {
    let mesh = shapes::grid(3, 3);
    let middle: Vec<bool> = (0..9).map(|f| f == 4).collect();
    let new = refined(&mesh, &middle, QUADS, 2);
    let mut degrees: Vec<usize> = new.faces().map(|f| new.degree(f)).collect();
    degrees.sort_unstable();
    assert_eq!(degrees, [[4; 20].as_slice(), &[7; 4]].concat());
    for (name, mesh) in polygons() {
        for (one_in, seed) in [(2, 0), (3, 5), (5, 6)] {
            let faces = some(&mesh, one_in, seed);
            for rules in [CATMULL_CLARK, QUADS] {
                let new = refined(&with_attributes(mesh.clone()), &faces, rules, 3);
                assert_eq!(topology(&new), topology(&mesh), "{name}");
                let scale = geometry::area(&mesh).max(1.0);
                if rules == QUADS && mesh.faces().all(|f| mesh.is_triangle(f)) {
                    assert!(
                        (geometry::area(&new) - geometry::area(&mesh)).abs() < 1e-13 * scale,
                        "{name}"
                    );
                }
            }
        }
    }
}

#[test]
fn no_chosen_faces_or_no_levels_change_nothing() {
    let mut mesh = sheet(3, 2);
    mesh.set(mesh::VERTEX_NORMAL, vec![DVec3::Z; mesh.n_vertices()]);
    let n = mesh.n_faces();
    assert!(refined(&mesh, &vec![false; n], LOOP, 3) == mesh);
    assert!(refined(&mesh, &vec![true; n], LOOP, 0) == mesh);
}

#[test]
fn flags_of_dead_faces_are_ignored() {
    let mut mesh = sheet(3, 3);
    mesh.delete_face(FaceId::new(4)).unwrap();
    let faces = some(&mesh, 3, 0);
    let faces: Vec<bool> = (0..18)
        .map(|f| faces.get(f) == Some(&true) || f == 17)
        .collect();
    let mut dense = mesh.clone();
    dense.compact();
    let mut kept = faces.clone();
    kept.remove(4);
    assert!(refined(&mesh, &faces, LOOP, 2) == refined(&dense, &kept, LOOP, 2));
}

#[test]
fn the_bytes_are_the_same_for_any_number_of_threads() {
    let mesh = with_attributes(fixtures::triangulated(&shapes::torus(60, 40, 2.0, 1.0)));
    let faces = some(&mesh, 3, 0);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build()
            .unwrap()
            .install(|| refined(&mesh, &faces, LOOP, 2))
    };
    let one = with(1);
    assert!(one.n_faces() > 40_000, "{}", one.n_faces());
    assert!(with(2) == one && with(5) == one);
}

#[test]
fn invalid_input_and_large_results_return_errors() {
    let refine = |mesh: &Mesh, n: usize, rules| {
        refine_faces(mesh, &vec![true; n], rules, 1, u64::MAX, &NoProgress).unwrap_err()
    };
    let cube = shapes::cube();
    let errors = [
        (
            refine(&cube, 6, LOOP),
            "Loop subdivision needs triangles, but f0 has 4 corners",
        ),
        (
            refine(&cube, 6, Rules::of(Scheme::Sqrt3)),
            "Sqrt3 subdivision can only refine all faces, not a part of them",
        ),
        (
            refine(&cube, 5, QUADS),
            "expected one flag for each of the 6 faces, found 5 flags",
        ),
    ];
    for (error, message) in errors {
        assert_eq!(error.to_string(), message);
    }
    let within = |budget| {
        let ico = shapes::icosahedron();
        let faces = some(&ico, 3, 0);
        refine_faces(&ico, &faces, LOOP, 2, budget, &NoProgress)
    };
    let bytes = within(u64::MAX).unwrap().bytes() as u64;
    assert!(within(bytes).is_ok());
    assert!(matches!(
        within(bytes - 1),
        Err(SubdivisionError::TooLarge(_))
    ));
}
