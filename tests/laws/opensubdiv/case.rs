//! Reads the files of cases and results in `tests/oracle/`.

use std::path::{Path, PathBuf};

use mesh::{CREASE, DVec2, DVec3, Mesh, UV, VERTEX_SHARPNESS, VertexId};
use subdivision::{Boundary, Creasing, FaceVarying, LoopWeights, Rules, Scheme, Split};

/// A case or a result file. Each line that is not a comment is a keyword followed by its values.
pub(super) struct Lines {
    text: String,
}

impl Lines {
    fn of(path: &Path) -> Self {
        let text = std::fs::read_to_string(path);
        let text = text.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        Self { text }
    }

    /// Iterates over the values of the lines that start with `word`.
    pub(super) fn after<'a>(&'a self, word: &'a str) -> impl Iterator<Item = Vec<&'a str>> {
        self.text.lines().filter_map(move |line| {
            let mut words = line.split_whitespace();
            (words.next() == Some(word)).then(|| words.collect())
        })
    }

    pub(super) fn option(&self, word: &str) -> &str {
        let mut found = self.text.lines().filter_map(|line| {
            let (first, rest) = line.split_once(' ')?;
            (first == word).then_some(rest)
        });
        found.next().expect("every option has a line")
    }

    pub(super) fn positions(&self) -> Vec<DVec3> {
        self.after("vertex").map(|words| point(&words)).collect()
    }

    /// Returns the corners of each face. A corner has a vertex and, if the case has uvs, the index of a uv.
    pub(super) fn faces(&self) -> Vec<Vec<(u32, Option<usize>)>> {
        let corner = |word: &&str| match word.split_once('/') {
            Some((v, uv)) => (parse(v), Some(parse(uv))),
            None => (parse(word), None),
        };
        let faces = self.after("face");
        faces
            .map(|words| words.iter().map(corner).collect())
            .collect()
    }

    pub(super) fn uvs(&self) -> Vec<DVec2> {
        let uvs = self.after("uv");
        uvs.map(|words| DVec2::new(parse(words[0]), parse(words[1])))
            .collect()
    }

    pub(super) fn creases(&self) -> impl Iterator<Item = ([VertexId; 2], f64)> {
        self.after("crease")
            .map(|words| ([vertex(words[0]), vertex(words[1])], parse(words[2])))
    }

    pub(super) fn corners(&self) -> impl Iterator<Item = (VertexId, f64)> {
        self.after("corner")
            .map(|words| (vertex(words[0]), parse(words[1])))
    }
}

pub(super) fn parse<T: std::str::FromStr>(word: &str) -> T {
    let value = word.parse().ok();
    value.unwrap_or_else(|| panic!("cannot parse {word}"))
}

fn vertex(word: &str) -> VertexId {
    VertexId::new(parse(word))
}

pub(super) fn point(words: &[&str]) -> DVec3 {
    DVec3::new(parse(words[0]), parse(words[1]), parse(words[2]))
}

/// Returns a folder of the reference data: `cases` or `results`.
pub(super) fn folder(name: &str) -> PathBuf {
    crate::root().join("tests/oracle").join(name)
}

pub(super) fn case(name: &str) -> Lines {
    Lines::of(&folder("cases").join(name).with_extension("txt"))
}

pub(super) fn result(case: &str) -> Lines {
    Lines::of(&folder("results").join(case).with_extension("txt"))
}

/// Returns the mesh of a case or a result, with the attributes of the mesh.
pub(super) fn mesh_of(case: &Lines) -> Mesh {
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
    mesh.set(VERTEX_SHARPNESS, corners);

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

pub(super) fn rules_of(case: &Lines) -> Rules {
    Rules {
        scheme: match case.option("scheme") {
            "Loop" => Scheme::Loop(LoopWeights::Loop),
            "CatmullClark" => Scheme::CatmullClark,
            "Bilinear" => Scheme::Midpoint(Split::Quads),
            other => panic!("unknown scheme {other}"),
        },
        boundary: match case.option("boundary") {
            "EdgesOnly" => Boundary::EdgesOnly,
            "EdgesAndCorners" => Boundary::EdgesAndCorners,
            other => panic!("unknown boundary rule {other}"),
        },
        creasing: match case.option("creasing") {
            "Uniform" => Creasing::Uniform,
            "Chaikin" => Creasing::Chaikin,
            other => panic!("unknown creasing rule {other}"),
        },
        face_varying: match case.option("face_varying") {
            "None" => FaceVarying::None,
            "CornersOnly" => FaceVarying::CornersOnly,
            "CornersPlus1" => FaceVarying::CornersPlus1,
            "CornersPlus2" => FaceVarying::CornersPlus2,
            "Boundaries" => FaceVarying::Boundaries,
            "All" => FaceVarying::All,
            other => panic!("unknown face-varying rule {other}"),
        },
    }
}
