use super::*;
use geometry::shapes;
use mesh::{Attribute, COLOR, DVec2, DVec4, FaceId, UV, VertexId};
use scene::Object;

const GROUP: Attribute<FaceId, i32> = Attribute::new("group", Rule::Copy);

fn step(text: &str) -> Transfer {
    op::test::read(text).unwrap()
}

/// Returns the texture coordinates of the point `p`: (x, y) in the left chart, and (x + 5, y) in the right chart.
fn uv(p: DVec3, right: bool) -> DVec2 {
    DVec2::new(p.x + if right { 5.0 } else { 0.0 }, p.y)
}

/// Returns a square of 8 x 8 faces with coordinates from -4 to 4. The square has two charts, a color that is linear in
/// x, and a group number for each face.
fn source() -> Mesh {
    let mut mesh = shapes::grid(8, 8);
    let scale = 4.0 / mesh.positions().iter().fold(0.0, |m, p| p.x.max(m));
    mesh.positions_mut().iter_mut().for_each(|p| *p *= scale);
    let of_corner = |i| {
        let h = HalfEdgeId::new(i);
        mesh.face(h).map_or(DVec2::ZERO, |f| {
            uv(mesh.position(mesh.origin(h)), mesh.face_center(f).x > 0.0)
        })
    };
    let uvs = (0..mesh.domain_len(Domain::Corner))
        .map(of_corner)
        .collect();
    let colors = mesh
        .positions()
        .iter()
        .map(|p| DVec4::new(p.x, 0.0, 0.0, 1.0))
        .collect();
    let groups = mesh
        .faces()
        .map(|f| if mesh.face_center(f).y > 0.0 { 7 } else { 3 })
        .collect();
    mesh.set(UV, uvs);
    mesh.set(COLOR, colors);
    mesh.set(GROUP, groups);
    mesh
}

fn scene(target: Mesh) -> Scene {
    let mut scene = Scene::new();
    scene.insert(Object::mesh("scan", source())).unwrap();
    scene.insert(Object::mesh("low", target)).unwrap();
    scene
}

fn low(scene: &Scene) -> &Mesh {
    scene.object("low").unwrap().as_mesh().unwrap()
}

/// Returns a sheet that lies 0.01 above the source and is divided into faces differently.
fn target() -> Mesh {
    let mut mesh = shapes::grid(5, 7);
    let largest = mesh
        .positions()
        .iter()
        .fold(0.0, |m, p| p.abs().max_element().max(m));
    for p in mesh.positions_mut() {
        *p = *p * (3.9 / largest) + DVec3::new(0.0, 0.0, 0.01);
    }
    mesh
}

#[test]
fn affine_values_are_exact_and_no_face_lies_in_two_charts() {
    let mut scene = scene(target());
    let step = step(r#"(from: "scan", attributes: ["uv", "color", "group"], within: 0.1)"#);
    let report = op::test::run(&step, &mut scene).unwrap();
    assert_eq!(report.notes, [""; 0]);
    let mesh = low(&scene);
    for (p, color) in mesh.positions().iter().zip(mesh.get(COLOR).unwrap()) {
        assert!((color.x - p.x).abs() < 1e-12 && (color.w - 1.0).abs() < 1e-12);
    }
    let uvs = mesh.get(UV).unwrap();
    let mut crossing = 0;
    for f in mesh.faces() {
        let right = mesh.face_center(f).x > 0.0;
        for h in mesh.face_half_edges(f) {
            let p = mesh.position(mesh.origin(h));
            // A corner that lies beyond the seam, as seen from the center of its face, gets the texture coordinates at
            // the seam.
            let clamped = DVec3::new(if right { p.x.max(0.0) } else { p.x.min(0.0) }, p.y, 0.0);
            crossing += usize::from(clamped.x != p.x);
            assert!(uvs[h.index()].distance(uv(clamped, right)) < 1e-12);
        }
        let expected = if mesh.face_center(f).y > 0.0 { 7 } else { 3 };
        assert_eq!(mesh.get(GROUP).unwrap()[f.index()], expected);
    }
    assert!(crossing > 0);
}

#[test]
fn a_face_over_a_crossing_sheet_takes_the_chart_of_its_corners() {
    // The source consists of a horizontal and an upright sheet. The center of the target lies on the upright sheet.
    let points = [
        [-1.0, -1.0, 0.0],
        [1.0, -1.0, 0.0],
        [1.0, 1.0, 0.0],
        [-1.0, 1.0, 0.0],
        [0.0, -1.0, -1.0],
        [0.0, 1.0, -1.0],
        [0.0, 1.0, 1.0],
        [0.0, -1.0, 1.0],
    ];
    let points = points.map(DVec3::from_array).to_vec();
    let mut from = Mesh::from_polygons(points, &[[0, 1, 2, 3], [4, 5, 6, 7]])
        .unwrap()
        .0;
    let uvs = (0..from.n_half_edges()).map(|i| {
        let v = from.origin(HalfEdgeId::new(i));
        let p = from.position(v);
        DVec2::new(if v.index() < 4 { p.x } else { 10.0 + p.z }, p.y)
    });
    let uvs = uvs.collect();
    from.set(UV, uvs);
    let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
    let corners = corners.map(|(x, y)| DVec3::new(x, y, 0.01)).to_vec();
    let target = Mesh::from_polygons(corners, &[[0, 1, 2, 3]]).unwrap().0;
    let mut scene = Scene::new();
    scene.insert(Object::mesh("scan", from)).unwrap();
    scene.insert(Object::mesh("low", target)).unwrap();
    op::test::run(&step(r#"(from: "scan", attributes: ["uv"])"#), &mut scene).unwrap();
    let mesh = low(&scene);
    let f = mesh.faces().next().unwrap();
    for h in mesh.face_half_edges(f) {
        let p = mesh.position(mesh.origin(h));
        assert!(mesh.get(UV).unwrap()[h.index()].distance(p.truncate()) < 1e-12);
    }
}

#[test]
fn elements_that_are_too_far_keep_their_values_and_are_counted() {
    let mut target = target();
    let v = VertexId::new(0);
    target.set_position(v, DVec3::new(-3.9, -3.9, 2.0));
    target.set(COLOR, vec![DVec4::splat(0.25); target.n_vertices()]);
    let mut scene = scene(target);
    let step = step(r#"(from: "scan", attributes: ["uv", "color"], within: 0.1)"#);
    let report = op::test::run(&step, &mut scene).unwrap();
    assert_eq!(
        report.notes,
        [
            "vertices that take no values from \"scan\", because they are farther away from it than `within`: 1",
            "corners that take no values from \"scan\", because they are farther away from it than `within`: 4"
        ]
    );
    let mesh = low(&scene);
    assert_eq!(mesh.get(COLOR).unwrap()[0], DVec4::splat(0.25));
    let f = mesh.vertex_faces(v).next().unwrap();
    assert!(
        mesh.face_half_edges(f)
            .all(|h| mesh.get(UV).unwrap()[h.index()] == DVec2::ZERO)
    );
}

#[test]
fn a_mesh_takes_its_own_attributes_back_unchanged() {
    let mut bare = source();
    for (domain, name) in [
        (Domain::Corner, "uv"),
        (Domain::Vertex, "color"),
        (Domain::Face, "group"),
    ] {
        bare.remove_column(domain, name);
    }
    let mut scene = scene(bare);
    op::test::run(
        &step(r#"(from: "scan", attributes: ["group", "uv", "color"])"#),
        &mut scene,
    )
    .unwrap();
    let (mesh, source) = (low(&scene), source());
    assert_eq!(mesh.get(COLOR), source.get(COLOR));
    assert_eq!(mesh.get(GROUP), source.get(GROUP));
    for f in mesh.faces() {
        for h in mesh.face_half_edges(f) {
            assert_eq!(
                mesh.get(UV).unwrap()[h.index()],
                source.get(UV).unwrap()[h.index()]
            );
        }
    }
}

#[test]
fn missing_and_unsuitable_attributes_are_refused() {
    let refused = |text: &str, target: Mesh| {
        let mut scene = scene(target);
        let before = scene.clone();
        let error = op::test::run(&step(text), &mut scene)
            .unwrap_err()
            .to_string();
        assert_eq!(scene, before);
        error
    };
    let error = refused(r#"(from: "scan", attributes: ["uw"])"#, target());
    assert!(
        error.contains("has no attribute \"uw\"; its attributes: vertex attribute \"color\""),
        "{error}"
    );
    let mut other = target();
    other.set(
        Attribute::<VertexId, f64>::new("color", Rule::Copy),
        vec![0.0; other.n_vertices()],
    );
    let error = refused(r#"(from: "scan", attributes: ["color"])"#, other);
    assert!(
        error.contains(
            "\"4 numbers\" in \"scan\", but the type \"number\" in the mesh that receives the values"
        ),
        "{error}"
    );
    refused(r#"(from: "scan", attributes: ["material"])"#, target());
    refused(r#"(from: "scan", attributes: [])"#, target());
    refused(r#"(from: "scam", attributes: ["uv"])"#, target());
}

/// Returns a tube with `n` faces around its axis and 3 faces along its axis. The texture coordinates (angle / 2π, z)
/// have one seam. All vertices are rotated by `turn` times the width of a face.
fn tube(n: u32, turn: f64) -> Mesh {
    let mut points = Vec::new();
    let mut faces = Vec::new();
    for j in 0..4 {
        for i in 0..n {
            let angle = std::f64::consts::TAU * (f64::from(i) + turn) / f64::from(n);
            points.push(DVec2::from_angle(angle).extend(4.0 * f64::from(j)));
            let next = (i + 1) % n;
            if j < 3 {
                faces.push([j * n + i, j * n + next, (j + 1) * n + next, (j + 1) * n + i]);
            }
        }
    }
    let (mut mesh, _) = Mesh::from_polygons(points, &faces).unwrap();
    let mut uvs = vec![DVec2::ZERO; mesh.domain_len(Domain::Corner)];
    for (f, i) in mesh.faces().zip((0..n).cycle()) {
        for (h, u) in mesh.face_half_edges(f).zip([i, i + 1, i + 1, i]) {
            let z = mesh.position(mesh.origin(h)).z;
            uvs[h.index()] = DVec2::new(f64::from(u) / f64::from(n), z);
        }
    }
    mesh.set(UV, uvs);
    mesh
}

fn transferred_uv(from: &Mesh, mut to: Mesh) -> Mesh {
    to.remove_column(Domain::Corner, "uv");
    let mut scene = Scene::new();
    scene.insert(Object::mesh("scan", from.clone())).unwrap();
    scene.insert(Object::mesh("low", to)).unwrap();
    op::test::run(&step(r#"(from: "scan", attributes: ["uv"])"#), &mut scene).unwrap();
    low(&scene).clone()
}

#[test]
fn no_face_is_stretched_across_a_seam_inside_a_chart() {
    let from = tube(48, 0.0);
    for (n, turn) in [(48, 0.0), (48, 0.4), (12, 0.3), (7, 0.5), (200, 0.3)] {
        let mesh = transferred_uv(&from, tube(n, turn));
        let uvs = mesh.get(UV).unwrap();
        let width = 1.0 / f64::from(n);
        for f in mesh.faces() {
            let us = mesh.face_half_edges(f).map(|h| uvs[h.index()].x);
            let (low, high) = us.fold((1.0_f64, 0.0_f64), |(l, h), u| (l.min(u), h.max(u)));
            assert!(high - low < 1.2 * width, "{n} {turn} {f}: {low} {high}");
        }
    }
}

#[test]
fn seams_inside_a_chart_come_back_unchanged() {
    let tube = tube(9, 0.0);
    assert_eq!(transferred_uv(&tube, tube.clone()).get(UV), tube.get(UV));
    // At the poles of a sphere, each corner has the texture coordinate u of the center of its face.
    let mut sphere = shapes::uv_sphere(12, 6);
    let mut uvs = vec![DVec2::ZERO; sphere.domain_len(Domain::Corner)];
    for f in sphere.faces() {
        let middle = sphere.face_center(f);
        let turns = |p: DVec3| p.truncate().to_angle() / std::f64::consts::TAU;
        for h in sphere.face_half_edges(f) {
            let p = sphere.position(sphere.origin(h));
            let u = if p.truncate().length() < 1e-9 {
                turns(middle)
            } else {
                turns(p)
            };
            let u = u + (turns(middle) - u).round();
            uvs[h.index()] = DVec2::new(u, p.z);
        }
    }
    sphere.set(UV, uvs);
    assert_eq!(
        transferred_uv(&sphere, sphere.clone()).get(UV),
        sphere.get(UV)
    );
}
