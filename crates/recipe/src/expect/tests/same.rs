//! Tests of the expectations that compare a mesh with another mesh, with a digest, or with its own image under motions.

use geometry::shapes;
use mesh::{DVec3, Mesh};

use super::{check, check_on, cube, holds_and_fails, mesh_from, scene};

/// Returns the mesh with its vertices renumbered, its faces reversed in order, and the corners of its faces rotated.
fn shuffled(mesh: &Mesh) -> Mesh {
    let n = mesh.n_vertices();
    // `new` is a permutation only if 7 does not divide n.
    assert_ne!(n % 7, 0);
    let new = |v: usize| (v * 7 + 3) % n;
    let mut positions = vec![DVec3::ZERO; n];
    for v in mesh.vertices() {
        positions[new(v.index())] = mesh.position(v);
    }
    let mut polygons: Vec<Vec<u32>> = mesh
        .faces()
        .enumerate()
        .map(|(i, f)| {
            let corners = mesh.face_vertices(f).map(|v| new(v.index()));
            let mut corners: Vec<u32> = corners.map(|v| u32::try_from(v).unwrap()).collect();
            let n = corners.len();
            corners.rotate_left(i % n);
            corners
        })
        .collect();
    polygons.reverse();
    Mesh::from_polygons(positions, &polygons).unwrap().0
}

#[test]
fn vertex_ids_face_order_and_first_corners_do_not_matter() {
    for mesh in [
        shapes::cube(),
        shapes::icosahedron(),
        shapes::torus(5, 4, 2.0, 0.5),
        shapes::grid(3, 4),
    ] {
        let other = shuffled(&mesh);
        assert_ne!(other, mesh);
        let two = scene([("a", mesh), ("b", other)]);
        let on = ["a".to_owned()];
        assert_eq!(check_on(&two, Some(&on), "Same(as: Object(\"b\"))"), Ok(()));
    }
}

#[test]
fn a_mesh_with_different_vertices_or_faces_is_not_the_same() {
    let quads = shapes::cube();
    let triangles = diagonal_cube();
    let mut moved = shapes::cube();
    moved.positions_mut()[0].x -= 0.25;
    let inside_out = mesh_from(
        quads.positions(),
        &[
            &[1, 3, 2, 0],
            &[6, 7, 5, 4],
            &[4, 5, 1, 0],
            &[5, 7, 3, 1],
            &[7, 6, 2, 3],
            &[6, 4, 0, 2],
        ],
    );
    let all = scene([
        ("quads", quads),
        ("triangles", triangles),
        ("moved", moved),
        ("inside out", inside_out),
        ("tetrahedron", shapes::tetrahedron()),
    ]);
    let on = ["quads".to_owned()];
    let check = |text: &str| check_on(&all, Some(&on), text);
    let different_faces = Err("the faces differ from those of the other mesh".to_owned());
    assert_eq!(check("Same(as: Object(\"triangles\"))"), different_faces);
    assert_eq!(check("Same(as: Object(\"inside out\"))"), different_faces);
    assert_eq!(
        check("Same(as: Object(\"triangles\"), connectivity: false)"),
        Ok(())
    );
    assert_eq!(
        check("Same(as: Object(\"moved\"))"),
        Err(
            "the vertices of the two meshes are not at the same positions (tolerance: 0)"
                .to_owned()
        )
    );
    assert_eq!(
        check("Same(as: Object(\"moved\"), tolerance: 0.25)"),
        Ok(())
    );
    assert_eq!(
        check("Same(as: Object(\"tetrahedron\"))"),
        Err("the mesh has 8 vertices, the other mesh has 4".to_owned())
    );
    assert_eq!(
        check("Same(as: Object(\"sphere\"))"),
        Err("no object is named \"sphere\"".to_owned())
    );
}

#[test]
fn the_other_mesh_can_come_from_a_file_beside_the_recipe() {
    holds_and_fails(
        &scene([("a", shapes::octahedron())]),
        "Same(as: File(\"octahedron.obj\"))",
        "Same(as: File(\"other.obj\"))",
        "folder/other.obj is broken",
    );
}

#[test]
fn the_distance_to_another_surface_is_below_a_limit() {
    let mut far = shapes::cube();
    far.positions_mut().iter_mut().for_each(|p| p.z += 0.5);
    let two = scene([("cube", shapes::cube()), ("far", far)]);
    let on = ["cube".to_owned()];
    let check = |text: &str| check_on(&two, Some(&on), text);
    assert_eq!(
        check("DistanceTo(other: Object(\"far\"), below: 0.51)"),
        Ok(())
    );
    assert_eq!(
        check("DistanceTo(other: Object(\"far\"), below: 0.5)"),
        Err(
            "expected a distance below 0.5, found 0.5; the distance is largest from v0 at [-1, -1, -1] to f2 at [-1, -1, -0.5] of the other \
             mesh"
                .to_owned()
        )
    );
    assert_eq!(
        check_on(&two, None, "DistanceTo(other: Object(\"far\"), below: 1)"),
        Err("this expectation needs exactly 1 mesh, found 2: name the mesh with `on:`".to_owned())
    );
}

#[test]
fn the_digest_of_the_scene_is_compared() {
    let digest = cube().digest();
    holds_and_fails(
        &cube(),
        &format!("Digest(\"{digest}\")"),
        "Digest(\"00\")",
        &format!("expected the scene to have the digest 00, found {digest}"),
    );
}

/// Returns a cube with one diagonal on each face.
fn diagonal_cube() -> Mesh {
    let cube = shapes::cube();
    let polygons: Vec<[u32; 3]> = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [1, 3, 7, 5],
        [3, 2, 6, 7],
        [2, 0, 4, 6],
    ]
    .iter()
    .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
    .collect();
    Mesh::from_polygons(cube.positions().to_vec(), &polygons)
        .unwrap()
        .0
}

#[test]
fn a_cube_has_24_rotations_and_48_motions() {
    for text in [
        "SymmetricUnder(group: CubeRotations)",
        "SymmetricUnder(group: CubeRotations, eq: 24)",
        "SymmetricUnder(group: CubeMotions)",
        "SymmetricUnder(group: CubeMotions, eq: 48)",
        "SymmetricUnder(group: AxisMirrors, eq: 8)",
    ] {
        assert_eq!(check(&cube(), text), Ok(()), "{text}");
    }
}

#[test]
fn a_tetrahedron_has_half_of_the_symmetries_of_a_cube() {
    // The tetrahedron has four of the eight vertices of a cube, so half of the motions of the cube map it onto itself.
    let tetrahedron = scene([("a", shapes::tetrahedron())]);
    holds_and_fails(
        &tetrahedron,
        "SymmetricUnder(group: CubeRotations, eq: 12)",
        "SymmetricUnder(group: CubeRotations)",
        "expected 24 symmetries, found 12",
    );
    assert_eq!(
        check(&tetrahedron, "SymmetricUnder(group: CubeMotions, eq: 24)"),
        Ok(())
    );
    let octahedron = scene([("a", shapes::octahedron())]);
    assert_eq!(
        check(&octahedron, "SymmetricUnder(group: CubeMotions)"),
        Ok(())
    );
}

#[test]
fn a_diagonal_on_each_face_breaks_the_symmetry_of_faces_but_not_of_vertices() {
    let cube = scene([("cube", diagonal_cube())]);
    assert_eq!(
        check(
            &cube,
            "SymmetricUnder(group: CubeRotations, connectivity: false)"
        ),
        Ok(())
    );
    let count = |group| {
        let Err(message) = check(&cube, &format!("SymmetricUnder(group: {group})")) else {
            panic!("diagonals break the symmetry");
        };
        let found = message.rsplit(' ').next().unwrap();
        found.parse::<u64>().unwrap()
    };
    let (rotations, motions) = (count("CubeRotations"), count("CubeMotions"));
    // The motions under which the mesh stays the same form a subgroup, so their number divides the number of all
    // motions of the group.
    assert!(rotations < 24 && 24 % rotations == 0, "{rotations}");
    assert!(motions < 48 && 48 % motions == 0, "{motions}");
    assert_eq!(
        check(
            &cube,
            &format!("SymmetricUnder(group: CubeMotions, min: {motions}, max: {motions})")
        ),
        Ok(())
    );
}

#[test]
fn a_vertex_that_moves_breaks_symmetries_unless_the_tolerance_allows_it() {
    let mut dented = shapes::cube();
    dented.positions_mut()[7] *= 0.99;
    let dented = scene([("dented", dented)]);
    // Only three rotations map the mesh to itself: those about the diagonal through the moved vertex.
    assert_eq!(
        check(&dented, "SymmetricUnder(group: CubeRotations)"),
        Err("expected 24 symmetries, found 3".to_owned())
    );
    assert_eq!(
        check(
            &dented,
            "SymmetricUnder(group: CubeRotations, tolerance: 0.02)"
        ),
        Ok(())
    );
}
