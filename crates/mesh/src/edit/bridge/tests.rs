use super::*;
use crate::edit::testing::checked_edit;
use crate::{MATERIAL, UV, VertexId, shapes};
use glam::{DVec2, DVec3};

/// Returns a mesh of two regular polygons that face away from each other: one with `n` corners at z = 1, one with `m`
/// corners at z = -1.
fn two_disks(n: u32, m: u32) -> Mesh {
    let top = shapes::cylinder(n, false);
    let bottom = shapes::cylinder(m, false);
    let mut positions = top.positions()[n as usize..].to_vec();
    positions.extend(&bottom.positions()[..m as usize]);
    let polygons: [Vec<u32>; 2] = [(0..n).collect(), (n..n + m).rev().collect()];
    Mesh::from_polygons(positions, &polygons).unwrap().0
}

fn rims(mesh: &Mesh) -> Vec<HalfEdgeId> {
    mesh.half_edges()
        .filter(|&h| mesh.face(h).is_none())
        .collect()
}

/// Returns the boundary half-edge that leaves `v`, and the boundary half-edge that ends at `w`.
fn boundary_half_edges_at(mesh: &Mesh, v: usize, w: usize) -> (HalfEdgeId, HalfEdgeId) {
    let [h, after] = [v, w].map(|v| mesh.vertex_half_edge(VertexId::new(v)).unwrap());
    (h, mesh.prev(after))
}

#[test]
fn two_squares_become_a_box() {
    let mesh = two_disks(4, 4);
    let (h, g) = boundary_half_edges_at(&mesh, 0, 4);
    let (cube, band) = checked_edit(&mesh, |m| m.bridge_loops(h, g)).unwrap();
    assert_eq!(band.len(), 4);
    assert_eq!((cube.n_faces(), cube.n_edges()), (6, 12));
    assert!(cube.is_closed());
    let expected = shapes::cylinder(4, true);
    assert!((crate::geometry::volume(&cube) - crate::geometry::volume(&expected)).abs() < 1e-12);
    assert!((crate::geometry::area(&cube) - crate::geometry::area(&expected)).abs() < 1e-12);
    assert_eq!(cube.face(h), Some(band[0]));
    assert_eq!(cube.face(g), Some(band[0]));
    assert_eq!(cube.next(cube.next(h)), g);
}

#[test]
fn the_band_has_as_many_faces_as_the_longer_loop_has_edges() {
    for n in 3..=9_u32 {
        for m in 3..=9_u32 {
            let mesh = two_disks(n, m);
            let (h, g) = boundary_half_edges_at(&mesh, 0, n as usize);
            let (joined, band) = checked_edit(&mesh, |m| m.bridge_loops(h, g)).unwrap();
            assert!(joined.is_closed());
            assert_eq!(joined.euler_characteristic(), 2);
            let quads = band.iter().filter(|&&f| joined.degree(f) == 4).count();
            let triangles = band.iter().filter(|&&f| joined.degree(f) == 3).count();
            assert_eq!(quads, n.min(m) as usize);
            assert_eq!(quads + triangles, n.max(m) as usize);
            assert_eq!(
                (joined.face(h), joined.face(g)),
                (Some(band[0]), Some(band[0]))
            );
            // The triangles are spread evenly over the vertices of the shorter loop.
            let max_rungs = (n.max(m)).div_ceil(n.min(m)) as usize;
            assert!(
                joined
                    .vertices()
                    .all(|v| joined.valence(v) <= 2 + max_rungs)
            );
            assert!(crate::geometry::volume(&joined) > 0.0);
        }
    }
}

#[test]
fn every_pair_of_edges_on_two_loops_is_joined_or_refused() {
    let mut tunnel = shapes::icosahedron();
    for f in [0, 13] {
        tunnel.delete_face(FaceId::new(f)).unwrap();
    }
    let mut torus = shapes::torus(7, 6, 2.0, 1.0);
    for f in [0, 1, 21, 22, 23] {
        torus.delete_face(FaceId::new(f)).unwrap();
    }
    let (mut n_joined, mut n_refused) = (0, 0);
    for mesh in [two_disks(3, 5), tunnel, torus, shapes::cylinder(5, false)] {
        for &h in &rims(&mesh) {
            for &g in &rims(&mesh) {
                let result = checked_edit(&mesh, |m| m.bridge_loops(h, g));
                if mesh.loop_half_edges(h).any(|x| x == g) {
                    assert_eq!(result.unwrap_err(), EditError::SameLoop(h, g));
                    continue;
                }
                match result {
                    Ok((after, band)) => {
                        n_joined += 1;
                        assert_eq!(after.n_edges(), mesh.n_edges() + band.len());
                        assert_eq!(after.euler_characteristic(), mesh.euler_characteristic());
                        assert_eq!(after.n_boundary_loops() + 2, mesh.n_boundary_loops());
                        assert!(
                            after
                                .find_half_edge(mesh.origin(h), mesh.target(g))
                                .is_some()
                        );
                    }
                    Err(EditError::DuplicateEdge(v, w)) => {
                        n_refused += 1;
                        assert!(mesh.find_half_edge(v, w).is_some());
                    }
                    Err(error) => panic!("{error}"),
                }
            }
        }
    }
    assert!(n_joined > 100 && n_refused > 5, "{n_joined} {n_refused}");
}

#[test]
fn linear_uvs_stay_linear_and_materials_are_those_of_the_longer_loop() {
    // The ring around the middle square of the sheet is removed, so the hole has an outer loop of 12 edges and
    // an inner loop of 4.
    let mut mesh = shapes::grid(5, 5);
    let uv = |h| mesh.position(mesh.origin(h)).truncate() * 2.0 + DVec2::X;
    mesh.set(UV, mesh.half_edges().map(uv).collect());
    mesh.set(MATERIAL, (0..25).collect());
    let mut ring = vec![6, 7, 8, 11, 13, 16, 17, 18];
    while !ring.is_empty() {
        ring.retain(|&f| mesh.delete_face(FaceId::new(f)).is_err());
    }
    let middle = mesh.face_half_edge(FaceId::new(12)).twin();
    let outer = mesh
        .boundary_loops()
        .into_iter()
        .find(|&h| mesh.loop_half_edges(h).count() == 12)
        .unwrap();
    for (h, g) in [(middle, outer), (outer, middle)] {
        let (joined, band) = checked_edit(&mesh, |m| m.bridge_loops(h, g)).unwrap();
        assert_eq!(band.len(), 12);
        for f in band {
            let beside = joined.face(joined.face_half_edge(f).twin()).unwrap();
            let materials = joined.get(MATERIAL).unwrap();
            assert_eq!(materials[f.index()], materials[beside.index()]);
            assert_ne!(materials[f.index()], 12);
            for h in joined.face_half_edges(f) {
                let p = joined.position(joined.origin(h)).truncate();
                assert_eq!(joined.get(UV).unwrap()[h.index()], p * 2.0 + DVec2::X);
            }
        }
    }
}

#[test]
fn missing_half_edges_and_those_with_a_face_are_refused() {
    let mesh = two_disks(3, 3);
    let (h, g) = boundary_half_edges_at(&mesh, 0, 3);
    let refused = |h, g| checked_edit(&mesh, |m| m.bridge_loops(h, g)).unwrap_err();
    assert_eq!(refused(h.twin(), g), EditError::NotBoundary(h.twin()));
    assert_eq!(refused(h, g.twin()), EditError::NotBoundary(g.twin()));
    assert_eq!(refused(h, h), EditError::SameLoop(h, h));
    let missing = HalfEdgeId::new(99);
    assert_eq!(refused(missing, g), EditError::NoSuchHalfEdge(missing));
    assert_eq!(mesh.position(VertexId::new(0)), DVec3::new(1.0, 0.0, 1.0));
}
