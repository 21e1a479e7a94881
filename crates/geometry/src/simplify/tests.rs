use super::*;
use crate::distance::{Distance, diagonal};
use crate::shapes;
use crate::surface_index::self_intersecting_faces;
use mesh::{
    CREASE, Column, DVec2, DVec3, Domain, HalfEdgeId, MATERIAL, Rule, UV, VERTEX_NORMAL, Values,
};
use progress::NoProgress;
use proptest::prelude::*;

fn to(faces: usize) -> Options<'static> {
    Options {
        faces,
        ..Options::default()
    }
}

fn simplified(mesh: &Mesh, options: &Options) -> Simplified {
    let simplified = simplify(mesh, options, &NoProgress).unwrap();
    assert_eq!(simplified.mesh.defects(), []);
    assert_eq!(
        simplified.mesh.euler_characteristic(),
        mesh.euler_characteristic()
    );
    assert_eq!(simplified.mesh.n_boundary_loops(), mesh.n_boundary_loops());
    simplified
}

/// Returns a mesh whose quadrilaterals are cut in two.
pub(crate) fn triangles(mesh: &Mesh) -> Mesh {
    let polygons: Vec<[u32; 3]> = mesh
        .faces()
        .flat_map(|f| {
            let v: Vec<u32> = mesh
                .face_vertices(f)
                .map(|v| u32::try_from(v.index()).unwrap())
                .collect();
            (2..v.len())
                .map(move |k| [v[0], v[k - 1], v[k]])
                .collect::<Vec<_>>()
        })
        .collect();
    Mesh::from_polygons(mesh.positions().to_vec(), &polygons)
        .unwrap()
        .0
}

pub(crate) fn torus() -> Mesh {
    triangles(&shapes::torus(60, 30, 1.0, 0.4))
}

/// Returns a square of n × n cells in the plane z = 0, from 0 to 1.
pub(crate) fn square(n: u32) -> Mesh {
    let mut mesh = triangles(&shapes::grid(n, n));
    let [min, max] = crate::bounds(&mesh).unwrap();
    for p in mesh.positions_mut() {
        *p = (*p - min) / (max.x - min.x);
    }
    mesh
}

/// Returns two spheres with almost the same radius, one inside the other. Coarse faces of the two spheres would cross.
fn nested_spheres() -> Mesh {
    let outer = shapes::fans(&shapes::uv_sphere(40, 20));
    let mut inner = outer.clone();
    for p in inner.positions_mut() {
        *p *= 0.96;
    }
    let mut positions = outer.positions().to_vec();
    positions.extend(inner.positions());
    let n = u32::try_from(outer.n_vertices()).unwrap();
    let number = |v: VertexId| u32::try_from(v.index()).unwrap();
    let triangles = |mesh: &Mesh, first: u32| -> Vec<Vec<u32>> {
        let corners = |f| mesh.face_vertices(f).map(|v| first + number(v)).collect();
        mesh.faces().map(corners).collect()
    };
    let faces = [triangles(&outer, 0), triangles(&inner, n)].concat();
    Mesh::from_polygons(positions, &faces).unwrap().0
}

#[test]
fn no_faces_intersect_if_intersections_are_refused() {
    let mesh = nested_spheres();
    let run = |refuse_intersections| {
        let options = Options {
            faces: 60,
            refuse_intersections,
            ..Options::default()
        };
        simplify(&mesh, &options, &NoProgress).unwrap()
    };
    let crossing = |mesh: &Mesh| self_intersecting_faces(mesh, &NoProgress).unwrap().len();
    assert_eq!(crossing(&mesh), 0);
    assert!(crossing(&run(false).mesh) > 0);
    let refused = run(true);
    assert_eq!(crossing(&refused.mesh), 0);
    assert!(refused.mesh.n_faces() < mesh.n_faces() / 2);
    let reasons: Vec<Blocked> = refused.blocked.iter().map(|(reason, _)| *reason).collect();
    assert!(reasons.contains(&Blocked::Intersections), "{reasons:?}");
}

#[test]
fn the_number_of_faces_is_met() {
    for faces in [3600, 2001, 500, 100] {
        let left = simplified(&torus(), &to(faces)).mesh.n_faces();
        assert!((faces - 1..=faces).contains(&left), "{left} of {faces}");
    }
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let mut small = torus();
    set_uv(&mut small, |p| DVec2::new(p.x, p.y * p.z));
    // The passes over a mesh of this size visit several levels.
    let large = triangles(&shapes::torus(200, 100, 1.0, 0.4));
    for (mesh, faces) in [(small, 700), (large, 4000)] {
        let with_threads = |n| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build();
            pool.unwrap().install(|| simplified(&mesh, &to(faces)).mesh)
        };
        let expected = with_threads(1);
        for n in [2, 8] {
            assert_eq!(with_threads(n), expected, "{n} threads");
        }
    }
}

#[test]
fn the_surface_is_near_the_original() {
    let before = torus();
    let after = simplified(&before, &to(360)).mesh;
    let distance = Distance::between(&before, &after, None).unwrap();
    assert!(
        distance.at_most() < 0.01 * diagonal(&before, &after),
        "{distance:?}"
    );
    assert!((crate::volume(&after) / crate::volume(&before) - 1.0).abs() < 0.02);
}

#[test]
fn no_triangle_of_a_convex_surface_faces_inward() {
    let sphere = triangles(&shapes::uv_sphere(40, 40));
    let after = simplified(&sphere, &to(200)).mesh;
    for f in after.faces() {
        let center = after
            .face_vertices(f)
            .map(|v| after.position(v))
            .sum::<DVec3>();
        assert!(after.face_normal(f).dot(center) > 0.0);
    }
}

#[test]
fn a_flat_square_keeps_its_corners_and_its_area() {
    for n in [2, 20, 100] {
        let after = simplified(&square(n), &to(2)).mesh;
        assert_eq!((after.n_faces(), after.n_vertices()), (2, 4));
        let error = crate::area(&after) - 1.0;
        assert!(error.abs() < 1e-11, "{n}: {error:e}");
    }
}

#[test]
fn a_cube_of_many_triangles_becomes_a_cube_of_twelve() {
    let mut cube = shapes::cube();
    for _ in 0..3 {
        cube = shapes::fans(&cube);
    }
    let cube = triangles(&cube);
    let volume = crate::volume(&cube);
    let after = simplified(&cube, &to(12)).mesh;
    assert_eq!(after.n_faces(), 12);
    assert!((crate::volume(&after) / volume - 1.0).abs() < 1e-6);
}

#[test]
fn very_small_and_very_large_meshes_give_the_same_result() {
    let before = torus();
    let expected = simplified(&before, &to(500)).mesh;
    for factor in [-300, 300].map(|exponent| libm::ldexp(1.0, exponent)) {
        let mut scaled = before.clone();
        scaled.positions_mut().iter_mut().for_each(|p| *p *= factor);
        let after = simplified(&scaled, &to(500)).mesh;
        assert_eq!(after.connectivity(), expected.connectivity());
        assert!(
            after
                .positions()
                .iter()
                .zip(expected.positions())
                .all(|(p, q)| *p == *q * factor)
        );
    }
}

#[test]
fn a_seam_stays_and_texture_coordinates_do_not_blend_across_it() {
    // The texture coordinate u is x to the left of the line x = 0.5, and x + 10 to the right of this line.
    let mut mesh = square(16);
    let uv: Vec<DVec2> = (0..mesh.n_half_edges())
        .map(|h| {
            let h = HalfEdgeId::new(h);
            let Some(f) = mesh.face(h) else {
                return DVec2::ZERO;
            };
            let p = mesh.position(mesh.origin(h));
            let center = mesh
                .face_vertices(f)
                .map(|v| mesh.position(v).x)
                .sum::<f64>()
                / 3.0;
            DVec2::new(if center < 0.5 { p.x } else { p.x + 10.0 }, p.y)
        })
        .collect();
    mesh.set(UV, uv);
    let after = simplified(&mesh, &to(8)).mesh;
    assert!(after.n_faces() <= 8);
    let uv = after.get(UV).unwrap();
    for f in after.faces() {
        let corners: Vec<HalfEdgeId> = after.face_half_edges(f).collect();
        let is_left = uv[corners[0].index()].x < 5.0;
        for h in corners {
            let p = after.position(after.origin(h));
            let expected = DVec2::new(if is_left { p.x } else { p.x + 10.0 }, p.y);
            assert!(uv[h.index()].distance(expected) < 1e-7, "{h}");
        }
    }
}

/// Returns the edges of a [`square`] that lie on the line x = 0.5.
pub(crate) fn middle(mesh: &Mesh) -> Vec<EdgeId> {
    let is_on_line = |&v: &VertexId| mesh.position(v).x == 0.5;
    let is_in_middle = |&e: &EdgeId| mesh.edge_vertices(e).iter().all(is_on_line);
    mesh.edges().filter(is_in_middle).collect()
}

#[test]
fn borders_of_materials_creases_features_and_tags_stay() {
    let mesh = square(12);
    let middle = middle(&mesh);
    assert_eq!(middle.len(), 12);
    let left = |mesh: &Mesh, f: FaceId| {
        mesh.face_vertices(f)
            .map(|v| mesh.position(v).x)
            .sum::<f64>()
            < 1.5
    };
    let mut material = mesh.clone();
    material.set(
        MATERIAL,
        mesh.faces().map(|f| i32::from(left(&mesh, f))).collect(),
    );
    let mut crease = mesh.clone();
    crease.set(
        CREASE,
        mesh.edges()
            .map(|e| if middle.contains(&e) { 2.0 } else { 0.0 })
            .collect(),
    );
    let feature = Options {
        features: &middle,
        ..to(4)
    };
    for (mesh, options) in [(material, to(4)), (crease, to(4)), (mesh, feature)] {
        let after = simplified(&mesh, &options).mesh;
        let on_line = |v| (after.position(v).x - 0.5).abs() < 1e-7;
        let line = after
            .edges()
            .filter(|&e| after.edge_vertices(e).into_iter().all(on_line))
            .count();
        assert_eq!((after.n_faces(), line), (4, 1));
        if let Some(material) = after.get(MATERIAL) {
            assert!(
                after
                    .faces()
                    .all(|f| material[f.index()] == i32::from(left(&after, f)))
            );
        }
        if let Some(crease) = after.get(CREASE) {
            assert_eq!(crease.iter().filter(|&&c| c == 2.0).count(), 1);
        }
    }
}

#[test]
fn vertices_with_different_tags_are_not_merged() {
    let mut mesh = square(8);
    let tagged = mesh
        .vertices()
        .find(|&v| mesh.position(v) == DVec3::new(0.5, 0.5, 0.0))
        .unwrap();
    let mut tip = vec![false; mesh.n_vertices()];
    tip[tagged.index()] = true;
    let column = Column {
        name: "tip".into(),
        rule: Rule::Copy,
        values: Values::Tag(tip),
    };
    mesh.insert_column(Domain::Vertex, column);
    let result = simplified(&mesh, &to(4));
    let tip = result.mesh.tag(Domain::Vertex, "tip").unwrap();
    assert_eq!(tip.iter().filter(|&&t| t).count(), 1);
    assert_eq!(result.mesh.n_faces(), 4);
}

#[test]
fn pinned_vertices_keep_their_bits() {
    let mesh = torus();
    let pinned: Vec<VertexId> = mesh.vertices().step_by(7).collect();
    let after = simplified(
        &mesh,
        &Options {
            pinned: &pinned,
            ..to(0)
        },
    )
    .mesh;
    for v in pinned {
        assert!(after.positions().contains(&mesh.position(v)));
    }
}

#[test]
fn isolated_vertices_keep_their_values() {
    let mut mesh = torus();
    for f in mesh.vertex_faces(VertexId::new(500)).collect::<Vec<_>>() {
        mesh.delete_face(f).unwrap();
    }
    mesh.compact();
    assert_eq!(mesh.vertex_half_edge(VertexId::new(500)), None);
    let names: Vec<f64> = (0..mesh.n_vertices()).map(|v| v as f64).collect();
    let column = Column {
        name: "number".to_owned(),
        rule: Rule::Interpolate,
        values: Values::Float(names),
    };
    mesh.insert_column(Domain::Vertex, column);
    let after = simplified(&mesh, &to(200)).mesh;
    let v = after
        .vertices()
        .find(|&v| after.vertex_half_edge(v).is_none());
    let v = v.unwrap();
    assert_eq!(after.position(v), mesh.position(VertexId::new(500)));
    let column = after.attributes().column(Domain::Vertex, "number");
    assert_eq!(column.unwrap().values.component(v.index(), 0), 500.0);
}

#[test]
fn what_blocks_is_counted() {
    let tetrahedron = simplified(&shapes::tetrahedron(), &to(0));
    assert_eq!(tetrahedron.mesh.n_faces(), 4);
    assert_eq!(
        tetrahedron
            .blocked
            .iter()
            .map(|&(_, count)| count)
            .sum::<usize>(),
        6
    );
    let torus = torus();
    let all: Vec<VertexId> = torus.vertices().collect();
    let pinned = simplified(
        &torus,
        &Options {
            pinned: &all,
            ..to(0)
        },
    );
    assert_eq!(pinned.blocked, [(Blocked::Lines, torus.n_edges())]);
}

/// Sets the texture coordinates of all corners, as a function of the position.
fn set_uv(mesh: &mut Mesh, at: impl Fn(DVec3) -> DVec2) {
    let uv = |h| at(mesh.position(mesh.origin(h)));
    let uvs = mesh.half_edges().map(uv).collect();
    mesh.set(UV, uvs);
}

/// Returns the mean distance between the texture coordinates of a mesh in the plane z = 0 and the values of `at`.
fn texture_error(mesh: &Mesh, at: impl Fn(DVec3) -> DVec2) -> f64 {
    let uv = mesh.get(UV).unwrap();
    let (mut sum, mut area) = (0.0, 0.0);
    for f in mesh.faces() {
        let h: Vec<HalfEdgeId> = mesh.face_half_edges(f).collect();
        for i in 0..12 {
            for k in 0..12 - i {
                let (s, t) = ((f64::from(i) + 0.3) / 12.0, (f64::from(k) + 0.3) / 12.0);
                let weights = [1.0 - s - t, s, t];
                let p = (0..3)
                    .map(|i| weights[i] * mesh.position(mesh.origin(h[i])))
                    .sum();
                let q: DVec2 = (0..3).map(|i| weights[i] * uv[h[i].index()]).sum();
                sum += mesh.face_area(f) * q.distance(at(p));
                area += mesh.face_area(f);
            }
        }
    }
    sum / area
}

#[test]
fn texture_coordinates_are_a_part_of_the_cost() {
    // The texture coordinate u changes quickly near x = 0.5.
    let at = |p: DVec3| DVec2::new(p.x + 0.2 * libm::tanh(15.0 * (p.x - 0.5)), p.y);
    let flat = square(32);
    let mut textured = flat.clone();
    set_uv(&mut textured, at);
    let with = simplified(&textured, &to(120)).mesh;
    // The mesh without texture is simplified to the same number of triangles. It then gets the exact texture
    // coordinates at its vertices.
    let mut without = simplified(&flat, &to(120)).mesh;
    set_uv(&mut without, at);
    let [with, without] = [with, without].map(|mesh| texture_error(&mesh, at));
    assert!(with < 0.5 * without, "{with} {without}");
}

#[test]
fn no_triangle_is_turned_over_in_the_texture() {
    let mut mesh = waves();
    set_uv(&mut mesh, |p| {
        DVec2::new(p.x * p.x + p.x, p.y + 0.1 * libm::sin(20.0 * p.x))
    });
    for n in [600, 200, 60] {
        let after = simplified(&mesh, &to(n)).mesh;
        let uv = after.get(UV).unwrap();
        for f in after.faces() {
            let h: Vec<DVec2> = after.face_half_edges(f).map(|h| uv[h.index()]).collect();
            assert!((h[1] - h[0]).perp_dot(h[2] - h[0]) > 0.0, "{n}: {f}");
        }
    }
}

#[test]
fn colors_stay_in_their_range_and_keep_their_border() {
    let mut mesh = square(32);
    let color = |p: &DVec3| mesh::DVec4::splat(if p.x + 0.3 * p.y < 0.6 { 0.0 } else { 1.0 });
    let colors = mesh.positions().iter().map(color).collect();
    mesh.set(mesh::COLOR, colors);
    let after = simplified(&mesh, &to(200)).mesh;
    let colors = after.get(mesh::COLOR).unwrap();
    assert!(
        colors
            .iter()
            .all(|c| c.min_element() >= 0.0 && c.max_element() <= 1.0)
    );
    let is_wrong = |(p, c): &(&DVec3, &mesh::DVec4)| {
        let side = p.x + 0.3 * p.y - 0.6;
        side.abs() > 0.1 && (c.x > 0.5) != (side > 0.0)
    };
    assert_eq!(
        after
            .positions()
            .iter()
            .zip(colors)
            .filter(is_wrong)
            .count(),
        0
    );
}

#[test]
fn values_at_huge_offsets_do_not_disturb_the_surface() {
    let mut mesh = torus();
    let expected = simplified(&mesh, &to(400)).mesh;
    set_uv(&mut mesh, |_| DVec2::splat(1e6));
    let after = simplified(&mesh, &to(400)).mesh;
    assert_eq!(after.positions(), expected.positions());
    assert!(
        after
            .get(UV)
            .unwrap()
            .iter()
            .all(|uv| *uv == DVec2::splat(1e6) || *uv == DVec2::ZERO)
    );
}

#[test]
fn normals_stay_of_length_one() {
    let mut mesh = triangles(&shapes::uv_sphere(24, 24));
    let normals = mesh.positions().iter().map(|p| p.normalize()).collect();
    mesh.set(VERTEX_NORMAL, normals);
    let after = simplified(&mesh, &to(100)).mesh;
    for (n, p) in after
        .get(VERTEX_NORMAL)
        .unwrap()
        .iter()
        .zip(after.positions())
    {
        assert!((n.length() - 1.0).abs() < 1e-12 && n.dot(p.normalize()) > 0.9);
    }
}

/// Returns a wavy square, which has a boundary.
pub(crate) fn waves() -> Mesh {
    let mut mesh = square(24);
    for p in mesh.positions_mut() {
        p.z = 0.05 * libm::sin(9.0 * p.x) * libm::cos(7.0 * p.y);
        p.x += 0.04 * libm::sin(6.0 * p.y);
    }
    mesh
}

#[test]
fn an_error_is_never_exceeded() {
    let reduced = |mesh: &Mesh, error| {
        let options = Options {
            error: Some(error),
            ..Options::default()
        };
        let after = simplified(mesh, &options).mesh;
        let distance = Distance::between(mesh, &after, None).unwrap();
        assert!(distance.largest() <= error, "{distance:?} > {error}");
        after.n_faces()
    };
    let sphere = triangles(&shapes::uv_sphere(40, 20));
    let cylinder = triangles(&shapes::cylinder(40, true));
    // Each mesh is listed with a number of faces. With the error limit 0.05, the result must not have more faces than
    // this.
    for (mesh, most) in [(torus(), 700), (waves(), 90), (sphere, 450), (cylinder, 90)] {
        let sizes = [1e-9, 0.001, 0.01, 0.05].map(|error| reduced(&mesh, error));
        assert!(sizes[3] <= most, "{sizes:?}");
    }
    // A flat square is reduced to two triangles, even if the error is tiny.
    assert_eq!(reduced(&square(20), 1e-6), 2);
}

#[test]
fn polygons_are_refused_with_the_face() {
    let refused = simplify(&shapes::cube(), &to(4), &NoProgress).unwrap_err();
    assert_eq!(refused, SimplifyError::NotTriangle(FaceId::new(0)));
}

#[test]
fn it_can_be_cancelled() {
    struct Never;
    impl Progress for Never {
        fn advance(&self, _: &str, _: u64, _: u64) -> bool {
            false
        }
    }
    let cancelled = simplify(&torus(), &to(10), &Never).unwrap_err();
    assert_eq!(cancelled, SimplifyError::Cancelled(Cancelled));
}

proptest! {
    /// The input is any list of triangles between points of a small grid, including triangles without area, at any
    /// scale.
    #[test]
    fn soups_of_triangles_keep_the_invariants(
        points in proptest::collection::vec((0..4_u8, 0..4_u8, 0..4_u8), 4..24),
        triangles in proptest::collection::vec([0..24_usize, 0..24_usize, 0..24_usize], 1..60),
        exponent in -1000..1000_i32, faces in 0..20_usize,
    ) {
        let scale = libm::ldexp(1.0, exponent);
        let positions: Vec<DVec3> = points.iter()
            .map(|&(x, y, z)| scale * DVec3::new(f64::from(x), f64::from(y), f64::from(z)))
            .collect();
        let polygons: Vec<[u32; 3]> = triangles.iter()
            .map(|t| t.map(|v| u32::try_from(v % positions.len()).unwrap()))
            .filter(|[a, b, c]| a != b && b != c && c != a)
            .collect();
        let Ok((mesh, _)) = Mesh::from_polygons(positions, &polygons) else {
            return Ok(());
        };
        let after = simplified(&mesh, &to(faces)).mesh;
        prop_assert!(after.n_faces() <= mesh.n_faces());
    }
}
