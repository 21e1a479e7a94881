//! Attributes after local refinement.

use geometry::shapes;
use mesh::{COLOR, CREASE, DVec2, DVec3, FaceId, HalfEdgeId, MATERIAL, Mesh, UV, VERTEX_SHARPNESS};

use super::{LOOP, MIDPOINT, cases, refined, with_attributes, with_faces_numbered};
use crate::{FaceVarying, Rules, fixtures};

#[test]
fn attributes_follow_their_elements() {
    for (name, mesh, faces) in cases() {
        let mesh = with_attributes(mesh);
        let new = refined(&mesh, &faces, LOOP, 2);
        // Before refinement, colors equal positions. They must still be equal after it.
        for (color, p) in new.get(COLOR).unwrap().iter().zip(new.positions()) {
            assert_eq!(color.truncate(), *p, "{name}");
        }
        // Together, the parts of an old face have the same area as this face. The parts come in the order of the old
        // faces.
        let linear = refined(&mesh, &faces, MIDPOINT, 2);
        let material = linear.get(MATERIAL).unwrap();
        assert!(material.is_sorted(), "{name}");
        let mut areas = vec![0.0; mesh.n_faces()];
        for f in linear.faces() {
            areas[usize::try_from(material[f.index()]).unwrap()] += linear.face_area(f);
        }
        for (f, area) in mesh.faces().zip(areas) {
            assert!((area - mesh.face_area(f)).abs() < 1e-13, "{name} {f}");
        }
    }
}

#[test]
fn texture_coordinates_stay_affine_in_each_old_face_and_seams_are_kept() {
    for (name, mut mesh, faces) in cases() {
        let affine =
            |p: DVec3, f: FaceId| DVec2::new(p.x + 0.5 * p.z, p.y) * (1.0 + f.index() as f64);
        let uvs = mesh.half_edges().map(|h| {
            let p = mesh.position(mesh.origin(h));
            mesh.face(h).map_or(DVec2::ZERO, |f| affine(p, f))
        });
        let uvs: Vec<DVec2> = uvs.collect();
        mesh.set(UV, uvs);
        let mesh = with_faces_numbered(mesh);
        let new = refined(&mesh, &faces, MIDPOINT, 3);
        let (uvs, material) = (new.get(UV).unwrap(), new.get(MATERIAL).unwrap());
        for h in new.half_edges() {
            let Some(f) = new.face(h) else {
                assert_eq!(uvs[h.index()], DVec2::ZERO, "{name}");
                continue;
            };
            let old = FaceId::new(usize::try_from(material[f.index()]).unwrap());
            let expected = affine(new.position(new.origin(h)), old);
            assert!(uvs[h.index()].distance(expected) < 1e-12, "{name} {h}");
        }
    }
}

#[test]
fn creases_keep_their_length_and_decrease_only_between_chosen_faces() {
    let mut mesh = fixtures::triangulated(&shapes::cube());
    mesh.set(
        CREASE,
        (0..mesh.n_edges()).map(|e| 1.0 + e as f64).collect(),
    );
    // Each edge has a different sharpness. For each old edge, the new edges with its sharpness must together be as long
    // as the old edge.
    let faces: Vec<bool> = (0..mesh.n_faces()).map(|f| f < 2).collect();
    let new = refined(&mesh, &faces, MIDPOINT, 3);
    let crease = new.get(CREASE).unwrap();
    for e in mesh.edges() {
        let number = 1.0 + e.index() as f64;
        let parts = new.edges().filter(|part| crease[part.index()] == number);
        let length: f64 = parts.map(|part| new.length(part.half_edge())).sum();
        assert!((length - mesh.length(e.half_edge())).abs() < 1e-13, "{e}");
    }
    // After two levels, the sharpness of the edge between the two chosen faces has decreased from 2 to 0. All other
    // edges keep their sharpness.
    mesh.set(CREASE, vec![2.0; mesh.n_edges()]);
    let new = refined(&mesh, &faces, LOOP, 2);
    let crease = new.get(CREASE).unwrap();
    let count = |s: f64| crease.iter().filter(|&&c| c == s).count();
    let outside = refined(&mesh, &faces, MIDPOINT, 2);
    let kept = outside.get(CREASE).unwrap().iter().filter(|&&c| c == 2.0);
    assert_eq!(count(2.0), kept.count() - 4);
    assert_eq!(count(1.0), 0);
}

#[test]
fn vertex_sharpness_decreases_only_inside_the_chosen_faces() {
    for (name, mut mesh, faces) in cases() {
        mesh.set(VERTEX_SHARPNESS, vec![2.0; mesh.n_vertices()]);
        let new = refined(&mesh, &faces, LOOP, 1);
        let corner = new.get(VERTEX_SHARPNESS).unwrap();
        for v in mesh.vertices().filter(|_| faces.contains(&true)) {
            let is_inside = mesh.vertex_faces(v).all(|f| faces[f.index()]);
            let expected = if is_inside { 1.0 } else { 2.0 };
            assert_eq!(corner[v.index()], expected, "{name} {v}");
        }
        assert!(corner[mesh.n_vertices()..].iter().all(|&s| s == 0.0));
    }
}

#[test]
fn texture_coordinates_equal_to_positions_stay_equal_if_smoothed_alike() {
    let rules = Rules {
        face_varying: FaceVarying::None,
        ..LOOP
    };
    for (name, mut mesh, faces) in cases() {
        let flat = |m: &Mesh, h: HalfEdgeId| m.position(m.origin(h)).truncate();
        let uvs: Vec<DVec2> = mesh.half_edges().map(|h| flat(&mesh, h)).collect();
        mesh.set(UV, uvs);
        let new = refined(&mesh, &faces, rules, 3);
        let uvs = new.get(UV).unwrap();
        for h in new.half_edges().filter(|&h| new.face(h).is_some()) {
            let far = uvs[h.index()].distance(flat(&new, h));
            assert!(far < 1e-14, "{name} {h} {far:e}");
        }
    }
}
