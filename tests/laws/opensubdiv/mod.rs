//! Pixar's OpenSubdiv as a second opinion: what it makes of the cases in `tests/oracle/`, and what the
//! crate `subdivision` makes of them. `tests/oracle/README.md` describes the files.

mod case;

use std::collections::BTreeMap;

use mesh::{CREASE, DVec2, DVec3, EdgeId, FaceId, Mesh, UV, VERTEX_SHARPNESS, VertexId};
use op::NoProgress;
use subdivision::{Rules, Scheme, subdivide};

use case::{Lines, case, folder, mesh_of, parse, point, result, rules_of};

/// How far two numbers may lie apart: the results have seven digits, and OpenSubdiv's sharpness is `f32`.
const TOLERANCE: f64 = 1e-6;

/// For each vertex of `mesh` the one of `expected` that lies nearest, if that is the same place and no other
/// vertex lies there.
fn matched(mesh: &Mesh, expected: &[DVec3], tolerance: f64) -> Result<Vec<VertexId>, String> {
    if mesh.n_vertices() != expected.len() {
        let n = mesh.n_vertices();
        return Err(format!("{n} vertices in place of {}", expected.len()));
    }
    let mut taken = vec![false; expected.len()];
    let mut partners = Vec::with_capacity(expected.len());
    let (mut wrong, mut most) = (0, 0.0_f64);
    for &p in mesh.positions() {
        let distance = |i: &usize| expected[*i].distance(p);
        let nearest = (0..expected.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let nearest = nearest.expect("as many as the mesh has");
        most = most.max(distance(&nearest));
        let twice = std::mem::replace(&mut taken[nearest], true);
        wrong += usize::from(twice || distance(&nearest) > tolerance);
        partners.push(VertexId::new(nearest));
    }
    if wrong > 0 {
        let n = expected.len();
        return Err(format!(
            "{wrong} of {n} vertices lie elsewhere, by {most:e}"
        ));
    }
    Ok(partners)
}

/// A face from its lowest vertex on, with the uvs of the corners.
fn cycle(mut corners: Vec<(VertexId, Option<DVec2>)>) -> (Vec<VertexId>, Vec<Option<DVec2>>) {
    let lowest = (0..corners.len()).min_by_key(|&i| corners[i].0);
    corners.rotate_left(lowest.unwrap_or(0));
    corners.into_iter().unzip()
}

/// What differs between the faces of `mesh` and the expected ones, and between their uvs.
fn faces_differ(mesh: &Mesh, partners: &[VertexId], expected: &Lines) -> Vec<String> {
    let uvs = expected.uvs();
    let wanted: BTreeMap<_, _> = expected
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
        let Some(wanted) = wanted.get(&vertices) else {
            unknown += 1;
            continue;
        };
        for (uv, wanted) in uvs.iter().zip(wanted) {
            let distance = match (uv, wanted) {
                (Some(uv), Some(wanted)) => uv.distance(*wanted),
                (None, None) => 0.0,
                _ => f64::INFINITY,
            };
            apart += usize::from(distance > TOLERANCE);
            most = most.max(distance);
        }
    }

    let mut failures = Vec::new();
    if mesh.n_faces() != wanted.len() || unknown > 0 {
        let (n, wanted) = (mesh.n_faces(), wanted.len());
        failures.push(format!(
            "{n} faces in place of {wanted}, {unknown} of them unknown"
        ));
    }
    if apart > 0 {
        failures.push(format!("{apart} corners have other uvs, by up to {most}"));
    }
    failures
}

/// What differs between the sharpness that is left and the expected one. Edges of the boundary and
/// vertices that the rule of the boundary makes corners are left out: OpenSubdiv writes the rule into its numbers.
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
        let wanted = creases.get(&ends).copied().unwrap_or(0.0);
        let here = column.get(e.index()).copied().unwrap_or(0.0);
        !mesh.is_boundary_edge(*e) && (here - wanted).abs() > TOLERANCE
    };
    let wrong = mesh.edges().filter(differs).count();
    if wrong > 0 {
        failures.push(format!("{wrong} edges have another sharpness"));
    }

    let column = mesh.get(VERTEX_SHARPNESS).unwrap_or_default();
    let differs = |v: &VertexId| {
        let wanted = corners.get(&partners[v.index()]).copied().unwrap_or(0.0);
        let here = column.get(v.index()).copied().unwrap_or(0.0);
        let one_face = mesh.vertex_faces(*v).count() == 1;
        !one_face && (here - wanted).abs() > TOLERANCE
    };
    let wrong = mesh.vertices().filter(differs).count();
    if wrong > 0 {
        failures.push(format!("{wrong} vertices have another sharpness"));
    }
    failures
}

/// What differs between OpenSubdiv's result for a case and ours.
fn differences(name: &str) -> Vec<String> {
    let case = case(name);
    let expected = result(name);
    let (mesh, rules) = (mesh_of(&case), rules_of(&case));
    let fine = match subdivide(&mesh, rules, parse(case.choice("levels")), &NoProgress) {
        Ok(fine) => fine,
        Err(error) => return vec![error.to_string()],
    };

    let [low, high] = geometry::bounds(&mesh).expect("cases have vertices");
    let tolerance = TOLERANCE * (high - low).length();
    let mut failures = compared(&fine, &expected, tolerance);
    if failures.is_empty() && case.choice("limit") == "yes" {
        failures = limits_differ(&fine, rules, &expected, tolerance);
    }
    failures
}

/// What differs between a mesh and the expected one; positions may differ by `tolerance`.
fn compared(mesh: &Mesh, expected: &Lines, tolerance: f64) -> Vec<String> {
    let partners = match matched(mesh, &expected.positions(), tolerance) {
        Ok(partners) => partners,
        Err(failure) => return vec![failure],
    };
    let mut failures = faces_differ(mesh, &partners, expected);
    failures.extend(sharpness_differs(mesh, &partners, expected));
    failures
}

/// What differs between the limit surface at the vertices of a refined mesh and the expected one, where
/// OpenSubdiv's masks are those of the limit: not the positions of darts, and of the normals those of
/// smooth vertices, of regular ones on the boundary and of corners of one face.
fn limits_differ(mesh: &Mesh, rules: Rules, expected: &Lines, tolerance: f64) -> Vec<String> {
    let partners = matched(mesh, &expected.positions(), tolerance).expect("compared before");
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
        let wanted = &expected[partners[v.index()].index()];
        let (rule, side) = (wanted[9], wanted[10]);
        let off = limit.positions[v.index()].distance(point(wanted));
        if rule != "dart" && off > tolerance {
            failures.push(format!("the limit of a {rule} ({side}) is off by {off:e}"));
        }
        let n_faces = mesh.vertex_faces(v).count();
        let is_exact = match (rule, side) {
            ("smooth", _) => true,
            ("crease", "boundary") => n_faces <= regular,
            ("corner", "boundary") => n_faces == 1,
            _ => false,
        };
        let normal = point(&wanted[3..]).cross(point(&wanted[6..])).normalize();
        let off = normals[v.index()].distance(normal);
        if is_exact && off > 10.0 * TOLERANCE {
            failures.push(format!("the normal of a {rule} ({side}) is off by {off:e}"));
        }
    }
    failures
}

fn names() -> Vec<String> {
    let entries = std::fs::read_dir(folder("cases")).expect("there is a folder of cases");
    let mut names: Vec<String> = entries
        .filter_map(|entry| Some(entry.ok()?.path().file_stem()?.to_str()?.to_owned()))
        .collect();
    names.sort();
    names
}

#[test]
fn opensubdiv_gives_the_same_meshes() {
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

/// Fails unless the result for `case` has exactly these positions, up to order and sign of the coordinates.
#[track_caller]
fn assert_positions(case: &str, wanted: &[([f64; 3], usize)]) {
    let positions = result(case).positions();
    let found = |kind: [f64; 3]| {
        let like = |p: &&DVec3| {
            let mut p = p.abs().to_array();
            p.sort_by(f64::total_cmp);
            DVec3::from(p).distance(kind.into()) < TOLERANCE
        };
        positions.iter().filter(like).count()
    };
    for &(kind, n) in wanted {
        assert_eq!(found(kind), n, "{kind:?} of {case}");
    }
    let n: usize = wanted.iter().map(|&(_, n)| n).sum();
    assert_eq!(positions.len(), n, "{case}");
}

#[test]
fn the_stored_results_of_small_meshes_are_those_computed_by_hand() {
    // Loop: an old vertex of valence 3 keeps 7/16 and takes 3/16 of each neighbor; the sum of the
    // neighbors of p is -p. An edge takes 3/8 of its ends, 1/8 of the two others.
    let quarter = [0.0, 0.0, 0.25];
    assert_positions(
        "known_tetrahedron",
        &[(quarter, 3), ([0.25; 3], 1), ([0.0, 0.25, 0.25], 6)],
    );
    // Catmull-Clark: 1/3 of the vertex and 1/9 of each neighbor and each face; the sum of three is p.
    let [near, corner, far] = [[0.0, 0.0, 1.0], [5.0 / 9.0; 3], [0.0, 0.75, 0.75]];
    assert_positions("known_cube", &[(near, 6), (corner, 8), (far, 12)]);
    // Sharpness 1/2: halfway between that and the sharp rules, which leave corners and middles.
    let [corner, far] = [[7.0 / 9.0; 3], [0.0, 0.875, 0.875]];
    assert_positions("known_sharp_cube", &[(near, 6), (corner, 8), (far, 12)]);
    // A boundary with its own corners: 3/4 and twice 1/8.
    let [corner, far] = [[0.0, 0.75, 0.75], [0.0, 0.0, 1.0]];
    assert_positions("known_square", &[([0.0; 3], 1), (corner, 4), (far, 4)]);
    // Its uvs are the places of the corners, and `CornersOnly` leaves them there.
    let corners = result("known_square").uvs();
    let stayed = corners.iter().filter(|uv| uv.abs() == DVec2::ONE);
    assert_eq!(stayed.count(), 4);
}

#[test]
fn a_wrong_mesh_is_found_out() {
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
