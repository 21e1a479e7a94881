//! Compares the crate `subdivision` with Pixar's OpenSubdiv on the cases in `tests/oracle/`. The file
//! `tests/oracle/README.md` describes the format of the cases.

mod case;

use std::collections::BTreeMap;

use mesh::{CREASE, DVec2, DVec3, EdgeId, FaceId, Mesh, UV, VERTEX_SHARPNESS, VertexId};
use op::NoProgress;
use subdivision::{Rules, Scheme, subdivide};

use case::{Lines, case, folder, mesh_of, parse, point, result, rules_of};

/// The tolerance for uvs and for sharpness. For positions, it is multiplied by the size of the mesh. Normals have ten
/// times this tolerance. A tolerance is necessary because the files contain results with seven decimal places, and
/// OpenSubdiv stores sharpness as `f32`.
const TOLERANCE: f64 = 1e-6;

/// Finds the nearest position in `expected` for each vertex of `mesh`. Fails if the number of vertices is not the
/// number of positions, if a distance exceeds the tolerance, or if a position is used twice.
fn matched(mesh: &Mesh, expected: &[DVec3], tolerance: f64) -> Result<Vec<VertexId>, String> {
    if mesh.n_vertices() != expected.len() {
        let n = mesh.n_vertices();
        return Err(format!("{n} vertices, expected {}", expected.len()));
    }
    let mut taken = vec![false; expected.len()];
    let mut partners = Vec::with_capacity(expected.len());
    let (mut wrong, mut most) = (0, 0.0_f64);
    for &p in mesh.positions() {
        let distance = |i: &usize| expected[*i].distance(p);
        let nearest = (0..expected.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let nearest = nearest.expect("both have the same number of vertices");
        most = most.max(distance(&nearest));
        let twice = std::mem::replace(&mut taken[nearest], true);
        wrong += usize::from(twice || distance(&nearest) > tolerance);
        partners.push(VertexId::new(nearest));
    }
    if wrong > 0 {
        let n = expected.len();
        return Err(format!(
            "{wrong} of {n} vertices do not match; the largest distance is {most:e}"
        ));
    }
    Ok(partners)
}

/// Rotates a face so that it starts at its lowest vertex. Returns its vertices and the uvs of its corners.
fn cycle(mut corners: Vec<(VertexId, Option<DVec2>)>) -> (Vec<VertexId>, Vec<Option<DVec2>>) {
    let lowest = (0..corners.len()).min_by_key(|&i| corners[i].0);
    corners.rotate_left(lowest.unwrap_or(0));
    corners.into_iter().unzip()
}

/// Describes how the faces of `mesh` and their uvs differ from the expected faces and uvs.
fn faces_differ(mesh: &Mesh, partners: &[VertexId], expected: &Lines) -> Vec<String> {
    let uvs = expected.uvs();
    let expected_values: BTreeMap<_, _> = expected
        .faces()
        .into_iter()
        .map(|face| {
            let corners = face.into_iter();
            cycle(
                corners
                    .map(|(v, uv)| (VertexId::new(v as usize), uv.map(|i| uvs[i])))
                    .collect(),
            )
        })
        .collect();

    let column = mesh.get(UV);
    let here = |f: FaceId| {
        let corners = mesh.face_half_edges(f).map(|h| {
            let v = partners[mesh.origin(h).index()];
            (v, column.map(|column| column[h.index()]))
        });
        cycle(corners.collect())
    };
    let (mut unknown, mut apart, mut most) = (0, 0, 0.0_f64);
    for (vertices, uvs) in mesh.faces().map(here) {
        let Some(expected_values) = expected_values.get(&vertices) else {
            unknown += 1;
            continue;
        };
        for (uv, expected_values) in uvs.iter().zip(expected_values) {
            let distance = match (uv, expected_values) {
                (Some(uv), Some(expected_values)) => uv.distance(*expected_values),
                (None, None) => 0.0,
                _ => f64::INFINITY,
            };
            apart += usize::from(distance > TOLERANCE);
            most = most.max(distance);
        }
    }

    let mut failures = Vec::new();
    if mesh.n_faces() != expected_values.len() || unknown > 0 {
        let (n, expected_values) = (mesh.n_faces(), expected_values.len());
        failures.push(format!(
            "{n} faces, expected {expected_values}; {unknown} of them are not expected"
        ));
    }
    if apart > 0 {
        failures.push(format!("the uvs of {apart} corners differ by up to {most}"));
    }
    failures
}

/// Describes the differences between the sharpness of `mesh` and the expected sharpness. Boundary edges and vertices
/// with one face are skipped: OpenSubdiv can make them sharp by its rule for boundaries, and then returns the sharpness
/// that results from this rule.
fn sharpness_differs(mesh: &Mesh, partners: &[VertexId], expected: &Lines) -> Vec<String> {
    let creases: BTreeMap<[VertexId; 2], f64> = expected
        .creases()
        .map(|(mut ends, sharpness)| {
            ends.sort();
            (ends, sharpness)
        })
        .collect();
    let corners: BTreeMap<VertexId, f64> = expected.corners().collect();

    let mut failures = Vec::new();
    let column = mesh.get(CREASE).unwrap_or_default();
    let differs = |e: &EdgeId| {
        let mut ends = mesh.edge_vertices(*e).map(|v| partners[v.index()]);
        ends.sort();
        let expected_values = creases.get(&ends).copied().unwrap_or(0.0);
        let here = column.get(e.index()).copied().unwrap_or(0.0);
        !mesh.is_boundary_edge(*e) && (here - expected_values).abs() > TOLERANCE
    };
    let wrong = mesh.edges().filter(differs).count();
    if wrong > 0 {
        failures.push(format!("{wrong} edges have a different sharpness"));
    }

    let column = mesh.get(VERTEX_SHARPNESS).unwrap_or_default();
    let differs = |v: &VertexId| {
        let expected_values = corners.get(&partners[v.index()]).copied().unwrap_or(0.0);
        let here = column.get(v.index()).copied().unwrap_or(0.0);
        let one_face = mesh.vertex_faces(*v).count() == 1;
        !one_face && (here - expected_values).abs() > TOLERANCE
    };
    let wrong = mesh.vertices().filter(differs).count();
    if wrong > 0 {
        failures.push(format!("{wrong} vertices have a different sharpness"));
    }
    failures
}

/// Describes the differences between the results of OpenSubdiv and of the crate for a case.
fn differences(name: &str) -> Vec<String> {
    let case = case(name);
    let expected = result(name);
    let (mesh, rules) = (mesh_of(&case), rules_of(&case));
    let fine = match subdivide(&mesh, rules, parse(case.option("levels")), &NoProgress) {
        Ok(fine) => fine,
        Err(error) => return vec![error.to_string()],
    };

    let [low, high] = geometry::bounds(&mesh).expect("cases have vertices");
    let tolerance = TOLERANCE * (high - low).length();
    let mut failures = compared(&fine, &expected, tolerance);
    if failures.is_empty() && case.option("limit") == "yes" {
        failures = limits_differ(&fine, rules, &expected, tolerance);
    }
    failures
}

/// Describes the differences between a mesh and the expected mesh. `tolerance` is for positions.
fn compared(mesh: &Mesh, expected: &Lines, tolerance: f64) -> Vec<String> {
    let partners = match matched(mesh, &expected.positions(), tolerance) {
        Ok(partners) => partners,
        Err(failure) => return vec![failure],
    };
    let mut failures = faces_differ(mesh, &partners, expected);
    failures.extend(sharpness_differs(mesh, &partners, expected));
    failures
}

/// Describes how the limit surface at the vertices of a refined mesh differs from the expected limit surface. Compares
/// only values for which OpenSubdiv uses exact limit masks. The positions of all vertices except darts are compared.
/// Normals are compared at smooth vertices, at corners with one face, and at boundary creases with at most 2 quads
/// (Catmull-Clark) or 3 triangles (Loop).
fn limits_differ(mesh: &Mesh, rules: Rules, expected: &Lines, tolerance: f64) -> Vec<String> {
    let partners =
        matched(mesh, &expected.positions(), tolerance).expect("the meshes were compared before");
    let limit = match subdivision::limit(mesh, rules, &NoProgress) {
        Ok(limit) => limit,
        Err(error) => return vec![error.to_string()],
    };
    let normals = limit.normals();
    let expected: Vec<Vec<&str>> = expected.after("limit").collect();
    let regular = if rules.scheme == Scheme::CatmullClark {
        2
    } else {
        3
    };

    let mut failures = Vec::new();
    for v in mesh.vertices() {
        let expected_values = &expected[partners[v.index()].index()];
        let (rule, side) = (expected_values[9], expected_values[10]);
        let off = limit.positions[v.index()].distance(point(expected_values));
        if rule != "dart" && off > tolerance {
            failures.push(format!(
                "the limit position of a {rule} vertex ({side}) differs by {off:e}"
            ));
        }
        let n_faces = mesh.vertex_faces(v).count();
        let is_exact = match (rule, side) {
            ("smooth", _) => true,
            ("crease", "boundary") => n_faces <= regular,
            ("corner", "boundary") => n_faces == 1,
            _ => false,
        };
        let normal = point(&expected_values[3..])
            .cross(point(&expected_values[6..]))
            .normalize();
        let off = normals[v.index()].distance(normal);
        if is_exact && off > 10.0 * TOLERANCE {
            failures.push(format!(
                "the normal of a {rule} vertex ({side}) differs by {off:e}"
            ));
        }
    }
    failures
}

fn names() -> Vec<String> {
    let entries = std::fs::read_dir(folder("cases")).expect("the folder of cases exists");
    let mut names: Vec<String> = entries
        .filter_map(|entry| Some(entry.ok()?.path().file_stem()?.to_str()?.to_owned()))
        .collect();
    names.sort();
    names
}

#[test]
fn results_equal_those_of_opensubdiv() {
    let failures: Vec<String> = names()
        .iter()
        .flat_map(|name| {
            let differences = differences(name);
            differences
                .into_iter()
                .map(move |failure| format!("{name}: {failure}"))
        })
        .collect();
    crate::assert_none(&failures);
}

/// Panics unless the file with the result of `case` has exactly these positions. The order and the signs of the
/// coordinates are ignored.
#[track_caller]
fn assert_positions(case: &str, expected_values: &[([f64; 3], usize)]) {
    let positions = result(case).positions();
    let found = |kind: [f64; 3]| {
        let like = |p: &&DVec3| {
            let mut p = p.abs().to_array();
            p.sort_by(f64::total_cmp);
            DVec3::from(p).distance(kind.into()) < TOLERANCE
        };
        positions.iter().filter(like).count()
    };
    for &(kind, n) in expected_values {
        assert_eq!(found(kind), n, "{kind:?} of {case}");
    }
    let n: usize = expected_values.iter().map(|&(_, n)| n).sum();
    assert_eq!(positions.len(), n, "{case}");
}

#[test]
fn the_stored_results_of_small_meshes_equal_those_computed_by_hand() {
    // In the new position of an old vertex p of valence 3, Loop subdivision gives p the weight 7/16 and each neighbor
    // the weight 3/16. In the tetrahedron, the sum of the three neighbors of p is -p. In the position of the new vertex
    // on an edge, each end has the weight 3/8, and each of the two opposite vertices has the weight 1/8.
    let quarter = [0.0, 0.0, 0.25];
    assert_positions(
        "known_tetrahedron",
        &[(quarter, 3), ([0.25; 3], 1), ([0.0, 0.25, 0.25], 6)],
    );
    // In the new position of an old vertex p of the cube, Catmull-Clark subdivision gives p the weight 1/3, and each
    // neighbor and each face point the weight 1/9. In the cube, the sum of the three neighbors of p is p. The sum of
    // the three face points is also p.
    let [near, corner, far] = [[0.0, 0.0, 1.0], [5.0 / 9.0; 3], [0.0, 0.75, 0.75]];
    assert_positions("known_cube", &[(near, 6), (corner, 8), (far, 12)]);
    // With sharpness 1/2, each position is halfway between the results of the smooth rule and the sharp rule. The sharp
    // rule keeps corners, and puts new vertices at the midpoints of edges.
    let [corner, far] = [[7.0 / 9.0; 3], [0.0, 0.875, 0.875]];
    assert_positions("known_sharp_cube", &[(near, 6), (corner, 8), (far, 12)]);
    // For a boundary vertex that is not a corner, the new position is a weighted sum: the vertex itself has the weight
    // 3/4, and its two neighbors on the boundary have the weight 1/8.
    let [corner, far] = [[0.0, 0.75, 0.75], [0.0, 0.0, 1.0]];
    assert_positions("known_square", &[([0.0; 3], 1), (corner, 4), (far, 4)]);
    // The uvs of the square are the positions of its corners, and the rule `CornersOnly` keeps these uvs.
    let corners = result("known_square").uvs();
    let unchanged = corners.iter().filter(|uv| uv.abs() == DVec2::ONE);
    assert_eq!(unchanged.count(), 4);
}

#[test]
fn differences_are_detected() {
    let expected = result("uv_none");
    let mesh = mesh_of(&expected);
    assert_eq!(compared(&mesh, &expected, TOLERANCE), [""; 0]);

    let wrong = |change: fn(&mut Mesh)| {
        let mut mesh = mesh.clone();
        change(&mut mesh);
        compared(&mesh, &expected, TOLERANCE).len()
    };
    assert_eq!(wrong(|mesh| mesh.positions_mut()[7].x += 1e-5), 1);
    assert_eq!(wrong(|mesh| mesh.get_mut(UV).unwrap()[40].x += 1e-5), 1);
    assert_eq!(
        wrong(|mesh| mesh.get_mut(VERTEX_SHARPNESS).unwrap()[9] += 1e-5),
        1
    );
    assert_eq!(wrong(|mesh| mesh.get_mut(CREASE).unwrap().fill(1.0)), 1);
    assert_eq!(
        wrong(|mesh| drop(mesh.remove_column(mesh::Domain::Corner, "uv"))),
        1
    );
    let other = mesh_of(&result("uv_corners_only"));
    assert_eq!(compared(&other, &expected, TOLERANCE).len(), 1);
}
