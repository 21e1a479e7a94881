use std::path::Path;

use op::Files;
use scene::{Geometry, Object, Scene};

use super::*;

use bezier::Curve;
use mesh::{Connectivity, DVec3, FaceId, HalfEdgeId, Mesh, Rule, Values, VertexId, shapes};

/// A scene with these meshes.
fn scene(meshes: impl IntoIterator<Item = (&'static str, Mesh)>) -> Scene {
    let mut scene = Scene::new();
    for (name, mesh) in meshes {
        scene.insert(Object::mesh(name, mesh)).unwrap();
    }
    scene
}

fn cube() -> Scene {
    scene([("cube", shapes::cube())])
}

fn of(positions: &[DVec3], polygons: &[&[u32]]) -> Mesh {
    Mesh::from_polygons(positions.to_vec(), polygons).unwrap().0
}

fn expectation(text: &str) -> Expectation {
    crate::syntax::ron_options()
        .from_str(text)
        .unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// Holds an expectation against some objects of a scene. The file `octahedron.obj` holds one, every
/// other file is broken.
fn check_on(scene: &Scene, on: Option<&[String]>, text: &str) -> Result<(), String> {
    let files = Files {
        input: "folder".into(),
        ..Files::default()
    };
    let read = |path: &Path, _: &Files| {
        if path == Path::new("folder/octahedron.obj") {
            Ok(vec![Object::mesh("octahedron", shapes::octahedron())])
        } else {
            Err(format!("{} is broken", path.display()))
        }
    };
    let subject = Subject {
        scene,
        on,
        files: &files,
        read: &read,
    };
    expectation(text).check(subject)
}

fn check(scene: &Scene, text: &str) -> Result<(), String> {
    check_on(scene, None, text)
}

/// One expectation holds, another fails with a message.
#[track_caller]
fn holds_and_fails(scene: &Scene, holds: &str, fails: &str, message: &str) {
    assert_eq!(check(scene, holds), Ok(()), "{holds}");
    assert_eq!(check(scene, fails), Err(message.to_owned()), "{fails}");
}

#[test]
fn counts_have_an_exact_number_a_least_and_a_most() {
    let cases = [
        ("Objects", 1, "objects"),
        ("Vertices", 8, "vertices"),
        ("Edges", 12, "edges"),
        ("Faces", 6, "faces"),
        ("Components", 1, "components"),
        ("BoundaryLoops", 0, "boundary loops"),
        ("EulerCharacteristic", 2, "as Euler characteristic"),
        ("Genus", 0, "as genus"),
    ];
    for (name, n, what) in cases {
        let over = n + 1;
        holds_and_fails(
            &cube(),
            &format!("{name}(eq: {n})"),
            &format!("{name}(eq: {over})"),
            &format!("expected {over} {what}, found {n}"),
        );
        holds_and_fails(
            &cube(),
            &format!("{name}(min: {n}, max: {n})"),
            &format!("{name}(min: {over})"),
            &format!("expected at least {over} {what}, found {n}"),
        );
    }
    holds_and_fails(
        &cube(),
        "Faces(max: 6)",
        "Faces(max: 5)",
        "expected at most 5 faces, found 6",
    );
}

#[test]
fn counts_are_of_all_meshes_or_of_those_in_on() {
    let two = scene([
        ("cube", shapes::cube()),
        ("torus", shapes::torus(4, 3, 2.0, 1.0)),
    ]);
    assert_eq!(check(&two, "Faces(eq: 18)"), Ok(()));
    assert_eq!(check(&two, "Genus(eq: 1)"), Ok(()));
    let torus = ["torus".to_owned()];
    assert_eq!(check_on(&two, Some(&torus), "Faces(eq: 12)"), Ok(()));
    let nobody = ["sphere".to_owned()];
    assert_eq!(
        check_on(&two, Some(&nobody), "Faces(eq: 12)"),
        Err("no object is named \"sphere\"".to_owned())
    );
}

#[test]
fn an_open_sheet_has_a_boundary_loop() {
    let sheet = scene([("sheet", shapes::grid(3, 2))]);
    holds_and_fails(
        &sheet,
        "BoundaryLoops(eq: 1)",
        "BoundaryLoops(eq: 0)",
        "expected 0 boundary loops, found 1",
    );
}

#[test]
fn area_and_volume_are_compared_within_a_tolerance() {
    holds_and_fails(
        &cube(),
        "Area(eq: 24)",
        "Area(eq: 23.5)",
        "expected an area of 23.5, found 24",
    );
    holds_and_fails(
        &cube(),
        "Area(eq: 23.5, tolerance: 0.5)",
        "Area(min: 25)",
        "expected an area of at least 25, found 24",
    );
    holds_and_fails(
        &cube(),
        "Volume(eq: 8)",
        "Volume(eq: 8.25, tolerance: 0.125)",
        &format!(
            "expected a volume of 8.25, found {}",
            shapes::cube().volume()
        ),
    );
    holds_and_fails(
        &cube(),
        "Volume(min: 7.99, max: 8.01)",
        "Volume(max: 7.5)",
        &format!(
            "expected a volume of at most 7.5, found {}",
            shapes::cube().volume()
        ),
    );
}

#[test]
fn bounds_are_those_of_all_points() {
    holds_and_fails(
        &cube(),
        "Bounds(min: (-1, -1, -1), max: (1, 1, 1))",
        "Bounds(min: (-1, -1, -1), max: (1, 1, 2))",
        "expected bounds from [-1, -1, -1] to [1, 1, 2], found [-1, -1, -1] to [1, 1, 1]",
    );
    let nothing = Scene::new();
    assert_eq!(
        check(&nothing, "Bounds(min: (0, 0, 0), max: (0, 0, 0))"),
        Err("expected points, found none".to_owned())
    );
}

#[test]
fn points_of_curves_and_polylines_count_as_vertices() {
    let points = vec![glam::DVec2::ZERO, glam::DVec2::new(2.0, 1.0)];
    let mut scene = lines();
    let curve = Geometry::Curve(Curve::new(points).unwrap());
    scene.insert(Object::new("curve", curve)).unwrap();
    holds_and_fails(
        &scene,
        "Vertices(eq: 5)",
        "Vertices(eq: 3)",
        "expected 3 vertices, found 5",
    );
    assert_eq!(
        check(&scene, "Bounds(min: (0, 0, 0), max: (3, 1, 0))"),
        Ok(())
    );
}

#[test]
fn a_manifold_has_no_defects() {
    let mut broken = shapes::cube();
    broken.positions_mut()[3].x = f64::NAN;
    assert_eq!(check(&cube(), "Manifold"), Ok(()));
    assert_eq!(
        check(&scene([("broken", broken)]), "Manifold"),
        Err("expected a manifold, but in broken the position of v3 is not finite".to_owned())
    );
    assert_eq!(
        check(&Scene::new(), "Manifold"),
        Err("expected a mesh, found none".to_owned())
    );
}

/// Five triangles, two edges of which join v0 and v1, and two v1 and v2; around each vertex is one fan.
fn with_double_edges() -> Mesh {
    let origins = [
        [0, 1],
        [1, 2],
        [2, 0],
        [2, 1],
        [1, 0],
        [1, 3],
        [3, 2],
        [1, 4],
        [4, 3],
        [2, 4],
    ];
    let faces = [[0, 2, 4], [5, 6, 8], [3, 10, 12], [11, 14, 16], [15, 7, 18]];
    let origin: Vec<VertexId> = origins.concat().into_iter().map(VertexId::new).collect();
    let n = origin.len();
    let mut next = vec![HalfEdgeId::NONE; n];
    let mut face = vec![FaceId::NONE; n];
    for (f, corners) in faces.into_iter().enumerate() {
        for i in 0..3 {
            next[corners[i]] = HalfEdgeId::new(corners[(i + 1) % 3]);
            face[corners[i]] = FaceId::new(f);
        }
    }
    let leaving = |v: VertexId| {
        let boundary = (0..n).find(|&h| face[h] == FaceId::NONE && origin[h] == v);
        HalfEdgeId::new(boundary.unwrap())
    };
    for h in (0..n).filter(|&h| face[h] == FaceId::NONE) {
        next[h] = leaving(origin[h ^ 1]);
    }
    let connectivity = Connectivity {
        vertex_half_edge: (0..5).map(|v| leaving(VertexId::new(v))).collect(),
        face_half_edge: faces.map(|corners| HalfEdgeId::new(corners[0])).to_vec(),
        next,
        origin,
        face,
    };
    let positions = (0..5).map(|i| DVec3::new(f64::from(i), f64::from(i * i), 0.0));
    Mesh::from_arrays(connectivity, positions.collect())
}

#[test]
fn two_edges_between_the_same_vertices_are_no_manifold() {
    let mesh = with_double_edges();
    assert_eq!(mesh.defects(), []);
    assert_eq!(
        check(&scene([("double", mesh)]), "Manifold"),
        Err("expected a manifold, but in double several edges join v0 and v1".to_owned())
    );
}

#[test]
fn a_closed_mesh_has_no_boundary() {
    assert_eq!(check(&cube(), "Closed"), Ok(()));
    assert_eq!(
        check(&scene([("sheet", shapes::square())]), "Closed"),
        Err("expected no boundary, but sheet has one at the edge v0-v1".to_owned())
    );
    assert_eq!(
        check(&lines(), "Closed"),
        Err("expected a mesh, found none".to_owned())
    );
}

#[test]
fn selected_elements_are_counted() {
    holds_and_fails(
        &cube(),
        "Count(of: Vertices(Valence(3)), eq: 8)",
        "Count(of: Edges(Sharp(above: 91)), min: 1)",
        "expected at least 1 selected edges, found 0",
    );
    holds_and_fails(
        &cube(),
        "Count(of: Faces(Degree(4)), min: 6, max: 6)",
        "Count(of: Edges(Between(0, 7)), eq: 1)",
        "there is no edge between vertices 0 and 7",
    );
}

#[test]
fn valences_lie_in_a_range() {
    holds_and_fails(
        &cube(),
        "Valence(min: 3, max: 3)",
        "Valence(min: 4)",
        "expected at least 4 edges at v0, found 3",
    );
    holds_and_fails(
        &cube(),
        "Valence(of: Vertices([5]), max: 3)",
        "Valence(of: Boundary, max: 3)",
        "expected vertices to be selected, found none",
    );
}

#[test]
fn dihedral_angles_lie_in_a_range() {
    // Steps up along x: flat, then up by a right angle.
    let p = |x: f64, z: f64| [DVec3::new(x, 0.0, z), DVec3::new(x, 1.0, z)];
    let positions: Vec<DVec3> = [p(0.0, 0.0), p(1.0, 0.0), p(2.0, 0.0), p(2.0, 1.0)].concat();
    let stairs = scene([(
        "stairs",
        of(&positions, &[&[0, 2, 3, 1], &[2, 4, 5, 3], &[4, 6, 7, 5]]),
    )]);
    holds_and_fails(
        &stairs,
        "DihedralAngle(min: 0, max: 90.000001, reaches: 89.999999)",
        "DihedralAngle(reaches: 91)",
        "expected a largest dihedral angle of at least 91, found 90",
    );
    holds_and_fails(
        &stairs,
        "DihedralAngle(of: Between(2, 3), max: 0)",
        "DihedralAngle(of: Between(2, 3), min: 1)",
        "expected a dihedral angle at the edge v2-v3 of at least 1, found 0",
    );
    assert_eq!(
        check(&stairs, "DihedralAngle(of: Boundary, max: 180)"),
        Err("expected edges between two faces to be selected, found none".to_owned())
    );
}

#[test]
fn the_mean_area_of_faces_is_in_proportion_to_the_median() {
    // Areas 1, 1 and 4.
    let positions: Vec<DVec3> = [0.0, 1.0, 2.0, 6.0]
        .map(|x| [DVec3::new(x, 0.0, 0.0), DVec3::new(x, 1.0, 0.0)])
        .concat();
    let strip = scene([(
        "strip",
        of(&positions, &[&[0, 2, 3, 1], &[2, 4, 5, 3], &[4, 6, 7, 5]]),
    )]);
    holds_and_fails(
        &strip,
        "MeanFaceArea(of: Faces([0, 2]), min: 2.5, max: 2.5)",
        "MeanFaceArea(of: Faces([2]), max: 3)",
        "expected a mean face area over the median of at most 3, found 4",
    );
    assert_eq!(
        check(&strip, "MeanFaceArea(of: Degree(3), max: 3)"),
        Err("expected faces to be selected, found none".to_owned())
    );
}

#[test]
fn one_vertex_is_at_a_place() {
    holds_and_fails(
        &cube(),
        "Position(of: Vertices([7]), is: (1, 1, 1))",
        "Position(of: Vertices([7]), is: (1, 1, 1.5), tolerance: 0.25)",
        "expected v7 at [1, 1, 1.5], found it at [1, 1, 1]",
    );
    assert_eq!(
        check(&cube(), "Position(of: Vertices([6, 7]), is: (1, 1, 1))"),
        Err("expected one vertex to be selected, found 2".to_owned())
    );
}

/// A polyline of three points.
fn lines() -> Scene {
    let line = vec![DVec3::ZERO, DVec3::X, DVec3::new(3.0, 1.0, 0.0)];
    let mut scene = Scene::new();
    let lines = Geometry::Polylines(vec![line]);
    scene.insert(Object::new("lines", lines)).unwrap();
    scene
}

#[test]
fn one_point_of_a_polyline_is_at_a_place() {
    holds_and_fails(
        &lines(),
        "Point(index: 2, is: (3, 1, 0))",
        "Point(line: 0, index: 2, is: (3, 2, 0))",
        "expected point 2 of polyline 0 at [3, 2, 0], found it at [3, 1, 0]",
    );
    assert_eq!(
        check(&lines(), "Point(index: 3, is: (0, 0, 0))"),
        Err("there is no point 3 on a polyline 0".to_owned())
    );
    assert_eq!(
        check(&cube(), "Point(index: 0, is: (0, 0, 0))"),
        Err("this expectation is about one object of polylines, found 0".to_owned())
    );
}

/// The mesh with its vertices numbered anew, its faces in another order and each begun at another corner.
fn shuffled(mesh: &Mesh) -> Mesh {
    let n = mesh.n_vertices();
    // A permutation, because 7 divides no number of vertices in these tests.
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
fn a_mesh_is_the_same_up_to_numbers_of_vertices_and_first_corners_of_faces() {
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
fn a_mesh_with_other_vertices_or_faces_is_not_the_same() {
    let quads = shapes::cube();
    let triangles = diagonal_cube();
    let mut moved = shapes::cube();
    moved.positions_mut()[0].x -= 0.25;
    let inside_out = of(
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
    let others = Err("expected the faces of the other mesh, found others".to_owned());
    assert_eq!(check("Same(as: Object(\"triangles\"))"), others);
    assert_eq!(check("Same(as: Object(\"inside out\"))"), others);
    assert_eq!(
        check("Same(as: Object(\"triangles\"), connectivity: false)"),
        Ok(())
    );
    assert_eq!(
        check("Same(as: Object(\"moved\"))"),
        Err("expected the vertices of the other mesh within 0".to_owned())
    );
    assert_eq!(
        check("Same(as: Object(\"moved\"), tolerance: 0.25)"),
        Ok(())
    );
    assert_eq!(
        check("Same(as: Object(\"tetrahedron\"))"),
        Err("expected 4 vertices as in the other mesh, found 8".to_owned())
    );
    assert_eq!(
        check("Same(as: Object(\"sphere\"))"),
        Err("no object is named \"sphere\"".to_owned())
    );
}

#[test]
fn the_other_mesh_can_be_in_a_file_beside_the_recipe() {
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
            "expected a distance below 0.5, found 0.5: from v0 at [-1, -1, -1] to f5 at [-1, -1, -0.5] of the other"
                .to_owned()
        )
    );
    assert_eq!(
        check_on(&two, None, "DistanceTo(other: Object(\"far\"), below: 1)"),
        Err("this expectation is about one mesh, found 2: name it with `on:`".to_owned())
    );
}

/// A cube with one diagonal on each face.
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
    // The corners of a tetrahedron are every second one of a cube: half of its motions keep them.
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
fn a_diagonal_on_each_face_breaks_the_symmetry_of_faces_and_not_of_vertices() {
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
    // Those that are left are a group of their own: their number divides that of all.
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
    // The three rotations about the diagonal through the dent are left.
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

#[test]
fn an_attribute_is_on_every_mesh() {
    let mut tagged = shapes::cube();
    let column = mesh::Column {
        name: "rim".to_owned(),
        rule: Rule::Copy,
        values: Values::Tag(vec![true; 12]),
    };
    tagged.insert_column(Domain::Edge, column);
    holds_and_fails(
        &scene([("cube", tagged)]),
        "HasAttribute(domain: Edge, name: \"rim\")",
        "HasAttribute(domain: Corner, name: \"uv\")",
        "expected the corner attribute \"uv\", but cube has none",
    );
}

#[test]
fn the_digest_is_that_of_the_scene() {
    let digest = cube().digest();
    holds_and_fails(
        &cube(),
        &format!("Digest(\"{digest}\")"),
        "Digest(\"00\")",
        &format!("expected the digest 00, found {digest}"),
    );
}

#[test]
fn not_is_the_contrary() {
    holds_and_fails(
        &cube(),
        "Not(Faces(eq: 7))",
        "Not(Closed)",
        "expected Closed not to hold, but it does",
    );
    holds_and_fails(
        &cube(),
        "Not(Not(Faces(min: 6)))",
        "Not(Faces(min: 6))",
        "expected Faces(eq:None,min:Some(6),max:None) not to hold, but it does",
    );
}

#[test]
fn not_does_not_hold_for_what_cannot_be_told() {
    assert_eq!(
        check(&cube(), "Not(Same(as: File(\"other.obj\")))"),
        Err("folder/other.obj is broken".to_owned())
    );
    assert_eq!(
        check(&Scene::new(), "Not(Closed)"),
        Err("expected a mesh, found none".to_owned())
    );
    assert_eq!(
        check(&cube(), "Not(Not(Same(as: Object(\"sphere\"))))"),
        Err("no object is named \"sphere\"".to_owned())
    );
    // A selection that is refused is an answer: there is no such edge.
    assert_eq!(
        check(&cube(), "Not(Count(of: Edges(Between(0, 7)), eq: 1))"),
        Ok(())
    );
}

#[test]
fn what_has_no_bound_is_a_problem() {
    for text in [
        "Objects()",
        "Vertices()",
        "Edges()",
        "Faces()",
        "Components()",
        "BoundaryLoops()",
        "EulerCharacteristic()",
        "Genus()",
        "Area()",
        "Volume(tolerance: 1)",
        "Count(of: Faces(All))",
        "Valence()",
        "DihedralAngle(of: Boundary)",
        "MeanFaceArea(of: All)",
        "EdgeLength()",
        "MinAngle(of: All)",
        "Not(Faces())",
    ] {
        let problem = expectation(text).problem();
        assert_eq!(
            problem,
            Some("it has no bound, so it can never fail"),
            "{text}"
        );
    }
    for text in [
        "Faces(eq: 0)",
        "Genus(min: 0)",
        "Area(max: 0)",
        "Valence(max: 6)",
        "DihedralAngle(reaches: 1)",
        "Manifold",
        "Closed",
        "SymmetricUnder(group: AxisMirrors)",
        "Not(Closed)",
    ] {
        assert_eq!(expectation(text).problem(), None, "{text}");
    }
}

#[test]
fn what_it_compares_with_is_named() {
    let object = Other::Object("b".to_owned());
    assert_eq!(
        expectation("Not(Same(as: Object(\"b\")))").others(),
        Some(&object)
    );
    assert_eq!(
        expectation("DistanceTo(other: File(\"b\"), below: 1)").others(),
        Some(&Other::File("b".to_owned()))
    );
    assert_eq!(expectation("Closed").others(), None);
}

#[test]
fn lengths_of_edges_and_angles_of_corners_are_measured() {
    let p = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    // Angles of 90, 60 and 30 degrees, sides of 1, 2 and the root of 3.
    let triangle = scene([(
        "a",
        of(
            &[p(0.0, 0.0), p(1.0, 0.0), p(0.0, 3_f64.sqrt())],
            &[&[0, 1, 2]],
        ),
    )]);
    holds_and_fails(
        &triangle,
        "EdgeLength(min: 1, max: 2.000001)",
        "EdgeLength(of: Between(0, 1), max: 0.5)",
        "expected a length of the edge v0-v1 of at most 0.5, found 1",
    );
    assert!(check(&triangle, "MinAngle(min: 29.9999, max: 30.0001)").is_ok());
    let error = check(&triangle, "MinAngle(min: 31)").unwrap_err();
    assert!(
        error.starts_with("expected a smallest corner angle, that of f0, of at least 31, found 30"),
        "{error}"
    );
    assert!(check(&triangle, "EdgeLength(of: Not(All), min: 0)").is_err());
    assert!(check(&triangle, "MinAngle(of: Not(All), min: 0)").is_err());
}
