//! Pixar's OpenSubdiv as a second opinion: what it makes of the cases in `tests/oracle/`, and what the
//! crate `subdivision` makes of them. `tests/oracle/README.md` describes the files.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use mesh::{CORNER, CREASE, DVec2, DVec3, EdgeId, FaceId, Mesh, UV, VertexId};
use op::NoProgress;
use subdivision::{Boundary, Creasing, FaceVarying, LoopWeights, Rules, Scheme, Split, subdivide};

/// How far two numbers may lie apart: the results have seven digits, and OpenSubdiv's sharpness is `f32`.
const TOLERANCE: f64 = 1e-6;

/// A case or a result: lines of a word and what belongs to it.
struct Lines {
    text: String,
}

impl Lines {
    fn of(path: &Path) -> Self {
        let text = std::fs::read_to_string(path);
        let text = text.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        Self { text }
    }

    /// What follows `word` on the lines that begin with it.
    fn after<'a>(&'a self, word: &'a str) -> impl Iterator<Item = Vec<&'a str>> {
        self.text.lines().filter_map(move |line| {
            let mut words = line.split_whitespace();
            (words.next() == Some(word)).then(|| words.collect())
        })
    }

    fn choice(&self, word: &str) -> &str {
        let mut found = self.text.lines().filter_map(|line| {
            let (first, rest) = line.split_once(' ')?;
            (first == word).then_some(rest)
        });
        found.next().expect("every choice is made")
    }

    fn positions(&self) -> Vec<DVec3> {
        self.after("vertex").map(|words| point(&words)).collect()
    }

    /// For each face its corners: a vertex and, if there are any, a number of a uv.
    fn faces(&self) -> Vec<Vec<(u32, Option<usize>)>> {
        let corner = |word: &&str| match word.split_once('/') {
            Some((v, uv)) => (parse(v), Some(parse(uv))),
            None => (parse(word), None),
        };
        let faces = self.after("face");
        faces
            .map(|words| words.iter().map(corner).collect())
            .collect()
    }

    fn uvs(&self) -> Vec<DVec2> {
        let uvs = self.after("uv");
        uvs.map(|words| DVec2::new(parse(words[0]), parse(words[1])))
            .collect()
    }

    fn creases(&self) -> impl Iterator<Item = ([VertexId; 2], f64)> {
        self.after("crease")
            .map(|words| ([vertex(words[0]), vertex(words[1])], parse(words[2])))
    }

    fn corners(&self) -> impl Iterator<Item = (VertexId, f64)> {
        self.after("corner")
            .map(|words| (vertex(words[0]), parse(words[1])))
    }
}

fn parse<T: std::str::FromStr>(word: &str) -> T {
    let value = word.parse().ok();
    value.unwrap_or_else(|| panic!("{word} is not what belongs there"))
}

fn vertex(word: &str) -> VertexId {
    VertexId::new(parse(word))
}

fn point(words: &[&str]) -> DVec3 {
    DVec3::new(parse(words[0]), parse(words[1]), parse(words[2]))
}

/// A folder of the second opinion: `cases` or `results`.
fn folder(name: &str) -> PathBuf {
    crate::root().join("tests/oracle").join(name)
}

fn result(case: &str) -> Lines {
    Lines::of(&folder("results").join(case).with_extension("txt"))
}

/// The mesh of a case with its attributes.
fn mesh_of(case: &Lines) -> Mesh {
    let faces = case.faces();
    let polygons: Vec<Vec<u32>> = faces
        .iter()
        .map(|face| face.iter().map(|&(v, _)| v).collect())
        .collect();
    let (mut mesh, report) =
        Mesh::from_polygons(case.positions(), &polygons).expect("cases are meshes");
    assert!(report.is_clean(), "cases are manifold");

    let mut creases = vec![0.0; mesh.n_edges()];
    for ([v, w], sharpness) in case.creases() {
        let h = mesh
            .find_half_edge(v, w)
            .expect("creases are edges of the mesh");
        creases[h.edge().index()] = sharpness;
    }
    mesh.set(CREASE, creases);

    let mut corners = vec![0.0; mesh.n_vertices()];
    for (v, sharpness) in case.corners() {
        corners[v.index()] = sharpness;
    }
    mesh.set(CORNER, corners);

    let uvs = case.uvs();
    if !uvs.is_empty() {
        let mut column = vec![DVec2::ZERO; mesh.n_half_edges()];
        for f in mesh.faces() {
            for h in mesh.face_half_edges(f) {
                let corner = faces[f.index()]
                    .iter()
                    .find(|corner| corner.0 as usize == mesh.origin(h).index());
                let uv = corner.and_then(|corner| corner.1);
                column[h.index()] = uvs[uv.expect("every corner has a uv")];
            }
        }
        mesh.set(UV, column);
    }
    mesh
}

fn rules_of(case: &Lines) -> Rules {
    Rules {
        scheme: match case.choice("scheme") {
            "Loop" => Scheme::Loop(LoopWeights::Loop),
            "CatmullClark" => Scheme::CatmullClark,
            "Bilinear" => Scheme::Midpoint(Split::Quads),
            other => panic!("{other} is no scheme"),
        },
        boundary: match case.choice("boundary") {
            "EdgesOnly" => Boundary::EdgesOnly,
            "EdgesAndCorners" => Boundary::EdgesAndCorners,
            other => panic!("{other} is no rule of boundaries"),
        },
        creasing: match case.choice("creasing") {
            "Uniform" => Creasing::Uniform,
            "Chaikin" => Creasing::Chaikin,
            other => panic!("{other} is no rule of creases"),
        },
        face_varying: match case.choice("face_varying") {
            "None" => FaceVarying::None,
            "CornersOnly" => FaceVarying::CornersOnly,
            "CornersPlus1" => FaceVarying::CornersPlus1,
            "CornersPlus2" => FaceVarying::CornersPlus2,
            "Boundaries" => FaceVarying::Boundaries,
            "All" => FaceVarying::All,
            other => panic!("{other} is no rule of corner values"),
        },
    }
}

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

    let column = mesh.get(CORNER).unwrap_or_default();
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
    let case = Lines::of(&folder("cases").join(name).with_extension("txt"));
    let expected = result(name);
    let (mesh, rules) = (mesh_of(&case), rules_of(&case));
    let fine = match subdivide(&mesh, rules, parse(case.choice("levels")), &NoProgress) {
        Ok(fine) => fine,
        Err(error) => return vec![error.to_string()],
    };

    let [low, high] = mesh.bounds().expect("cases have vertices");
    compared(&fine, &expected, TOLERANCE * (high - low).length())
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
    assert_eq!(wrong(|mesh| mesh.get_mut(CORNER).unwrap()[9] += 1e-5), 1);
    assert_eq!(wrong(|mesh| mesh.get_mut(CREASE).unwrap().fill(1.0)), 1);
    assert_eq!(
        wrong(|mesh| drop(mesh.remove_column(mesh::Domain::Corner, "uv"))),
        1
    );
    let other = mesh_of(&result("uv_corners_only"));
    assert_eq!(compared(&other, &expected, TOLERANCE).len(), 1);
}
