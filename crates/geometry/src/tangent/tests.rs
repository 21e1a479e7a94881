//! Tests of the tangents of known surfaces and of random surfaces.

use super::*;
use crate::shapes;
use mesh::UV;
use proptest::prelude::*;

/// Sets texture coordinates that depend on the position, and smooth normals that are computed from the faces.
fn mapped(mut mesh: Mesh, uv: impl Fn(DVec3) -> DVec2) -> Mesh {
    let mut uvs = vec![DVec2::ZERO; mesh.n_half_edges()];
    let mut normals = vec![DVec3::ZERO; mesh.n_vertices()];
    for f in mesh.faces() {
        for h in mesh.face_half_edges(f) {
            uvs[h.index()] = uv(mesh.position(mesh.origin(h)));
            normals[mesh.origin(h).index()] += mesh.area_vector(f);
        }
    }
    mesh.set(UV, uvs);
    let unit = normals.into_iter().map(DVec3::normalize_or_zero);
    mesh.set(VERTEX_NORMAL, unit.collect());
    mesh
}

fn of(mesh: &Mesh) -> Tangents {
    tangents(mesh, mesh.get(UV).unwrap()).unwrap()
}

fn corners(mesh: &Mesh) -> Vec<HalfEdgeId> {
    mesh.faces().flat_map(|f| mesh.face_half_edges(f)).collect()
}

fn assert_orthonormal(mesh: &Mesh, tangents: &Tangents) {
    let normals = mesh.get(VERTEX_NORMAL).unwrap();
    for h in corners(mesh) {
        let t = tangents.values[h.index()];
        let n = normals[mesh.origin(h).index()].try_normalize();
        assert!((t.truncate().length() - 1.0).abs() < 1e-3, "{h} {t}");
        assert!(
            n.is_none_or(|n| t.truncate().dot(n).abs() < 1e-3),
            "{h} {t}"
        );
        assert!(t.w.abs() == 1.0, "{h} {t}");
    }
}

#[test]
fn the_tangent_of_a_plane_points_along_u_and_the_bitangent_along_v() {
    // The expected tangent t points along u. The bitangent, which is w times the cross product n x t, must point along
    // v.
    let (x, y) = (DVec2::X, DVec2::Y);
    for (u, v) in [(x, y), (-x, y), (x, -y), (y, x), (-y, x), (-x, -y)] {
        let mesh = mapped(shapes::grid(4, 3), |p| {
            let p = p.truncate();
            DVec2::new(p.dot(u), p.dot(v)) * 0.5 + 0.25
        });
        let tangents = of(&mesh);
        assert_eq!(tangents.n_arbitrary, 0);
        for h in corners(&mesh) {
            let t = tangents.values[h.index()];
            assert!(t.truncate().distance(u.extend(0.0)) < 1e-6, "{t} {u} {v}");
            let bitangent = t.w * DVec3::Z.cross(t.truncate());
            assert!(bitangent.distance(v.extend(0.0)) < 1e-6, "{t} {u} {v}");
        }
    }
}

#[test]
fn mirrored_halves_have_opposite_signs() {
    // On both sides of the plane x = 0, u grows with the distance from this plane.
    let mesh = mapped(shapes::grid(4, 2), |p| DVec2::new(p.x.abs(), p.y));
    let tangents = of(&mesh);
    for f in mesh.faces() {
        let side = mesh.face_center(f).x.signum();
        for h in mesh.face_half_edges(f) {
            let t = tangents.values[h.index()];
            assert!(t.distance(DVec4::new(side, 0.0, 0.0, side)) < 1e-6, "{t}");
        }
    }
}

#[test]
fn the_tangent_of_a_cylinder_runs_around_its_axis() {
    let mut mesh = mapped(shapes::torus(48, 24, 3.0, 1.0), |_| DVec2::ZERO);
    // u is the angle around the z axis. Inside a face, this angle does not jump from pi to -pi.
    let mut uvs = vec![DVec2::ZERO; mesh.n_half_edges()];
    for f in mesh.faces() {
        let center = mesh.face_center(f);
        let start = libm::atan2(center.y, center.x);
        for h in mesh.face_half_edges(f) {
            let p = mesh.position(mesh.origin(h));
            let turn = libm::atan2(
                center.x * p.y - center.y * p.x,
                center.truncate().dot(p.truncate()),
            );
            uvs[h.index()] = DVec2::new(start + turn, p.z);
        }
    }
    mesh.set(UV, uvs);
    let tangents = of(&mesh);
    for h in corners(&mesh) {
        let p = mesh.position(mesh.origin(h));
        // Near the top and the bottom of the torus, z hardly changes, so v defines no direction. These corners are
        // skipped.
        if p.z.abs() < 0.8 {
            let around = DVec3::new(-p.y, p.x, 0.0).normalize();
            let t = tangents.values[h.index()].truncate();
            assert!(t.dot(around) > 0.99, "{p} {t} {around}");
        }
    }
    assert_orthonormal(&mesh, &tangents);
}

#[test]
fn equal_texture_coordinates_define_no_direction() {
    let mesh = mapped(shapes::cube(), |_| DVec2::splat(0.5));
    let tangents = of(&mesh);
    assert_eq!(tangents.n_arbitrary, 24);
    assert_orthonormal(&mesh, &tangents);
}

#[test]
fn meshes_without_normals_have_no_tangents() {
    let mesh = shapes::cube();
    assert_eq!(
        tangents(&mesh, &vec![DVec2::ZERO; mesh.n_half_edges()]),
        None
    );
    let empty = mapped(Mesh::default(), |_| DVec2::ZERO);
    assert_eq!(of(&empty).values, []);
}

#[test]
fn polygons_have_the_tangents_of_their_triangles() {
    let map = |p: DVec3| DVec2::new(p.x + 0.3 * p.z, p.y - 0.2 * p.z);
    let polygons = mapped(shapes::cylinder(7, true), map);
    let mut cutter = Cutter::default();
    let mut all = Vec::new();
    for f in polygons.faces() {
        let corners: Vec<u32> = polygons
            .face_vertices(f)
            .map(|v| u32::try_from(v.index()).unwrap())
            .collect();
        let cut = cutter.cut(&polygons, f);
        if corners.len() == 3 {
            all.push([corners[0], corners[1], corners[2]]);
        }
        all.extend(
            cut.triangles()
                .iter()
                .map(|t| t.map(|k| corners[k as usize])),
        );
    }
    let mut cut = Mesh::from_polygons(polygons.positions().to_vec(), &all)
        .unwrap()
        .0;
    cut = mapped(cut, map);
    cut.set(VERTEX_NORMAL, polygons.get(VERTEX_NORMAL).unwrap().to_vec());
    let (whole, cut_tangents) = (of(&polygons), of(&cut));
    let key = |mesh: &Mesh, tangents: &Tangents| {
        let mut found: Vec<_> = corners(mesh)
            .into_iter()
            .map(|h| {
                (
                    mesh.origin(h).index(),
                    tangents.values[h.index()].to_array().map(f64::to_bits),
                )
            })
            .collect();
        found.sort_unstable();
        found.dedup();
        found
    };
    assert_eq!(key(&polygons, &whole), key(&cut, &cut_tangents));
}

proptest! {
    #[test]
    fn tangents_of_any_mesh_are_orthonormal(
        moves in prop::collection::vec(prop::array::uniform3(-0.5..0.5_f64), 64),
        uvs in prop::collection::vec(prop::array::uniform2(-2.0..2.0_f64), 32),
        scale in prop::sample::select(vec![1e-300, 1e-30, 1.0, 1e30, 1e300]),
        which in 0..4_usize,
    ) {
        let mut mesh = [
            shapes::grid(5, 4),
            shapes::torus(6, 5, 2.0, 0.7),
            shapes::cylinder(9, true),
            shapes::uv_sphere(6, 5),
        ][which].clone();
        for (p, m) in mesh.positions_mut().iter_mut().zip(moves) {
            *p = (*p + DVec3::from_array(m)) * scale;
        }
        let mut mesh = mapped(mesh, |_| DVec2::ZERO);
        let uvs = (0..mesh.n_half_edges()).map(|h| DVec2::from_array(uvs[h * 7 % 32]));
        let uvs = uvs.collect();
        mesh.set(UV, uvs);
        let tangents = of(&mesh);
        assert_orthonormal(&mesh, &tangents);
    }
}
