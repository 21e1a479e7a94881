//! Tests that `check` predicts the steps that a run will refuse, and the data that the steps will lose. For example, a
//! file format cannot store some attributes. One test runs small recipes: each makes a shape or loads a file, applies
//! at most one operation, and saves the result. The other test runs the recipes in `scenes/`.

use std::collections::BTreeSet;
use std::path::Path;

use engine::{Engine, Loaded, Options, Silent, Source};
use op::Registry;
use rayon::prelude::*;

use crate::{assert_none, recipes, root};

/// Texts in the messages about problems that `check` must find: wrong kinds of geometry, missing attributes and
/// objects, and exceeded memory budgets.
const KNOWN: [&str; 5] = [
    "has no attribute",
    "no object is named",
    "memory budget",
    ", found mesh",
    ", found patches",
];

/// The names of losses that `check` cannot predict, because they depend on the values in the meshes. A loss of
/// `position` occurs, for example, if vertices coincide, and a loss of `mesh` if a mesh loses all faces.
const OF_VALUES: [&str; 2] = ["position", "mesh"];

/// Describes the differences between a run and the forecast of its recipe.
fn disagreements(loaded: &Loaded) -> Vec<String> {
    if loaded.has_errors() {
        return Vec::new();
    }
    let outcome = loaded.run(engine::Run::default(), &Silent);
    let mut found = Vec::new();
    for failure in &outcome.failures {
        if KNOWN.iter().any(|known| failure.message.contains(known)) {
            found.push(format!("check does not report: {}", failure.message));
        }
    }
    for (done, forecast) in outcome.steps.iter().zip(&loaded.forecast.steps) {
        let planned = forecast.losses.iter().chain(&forecast.possible_losses);
        let planned: BTreeSet<&str> = planned.map(|loss| loss.name.as_str()).collect();
        // `FillHoles` drops normals only if the mesh has holes. Whether a mesh has holes depends on its connectivity,
        // which `check` does not know.
        let fills = done.label == "FillHoles";
        let is_unknown = |name: &str| {
            let depends = OF_VALUES.contains(&name) || fills && name == "normal";
            !planned.contains(name) && !planned.contains("attributes") && !depends
        };
        for loss in done.report.losses.iter().filter(|l| is_unknown(&l.name)) {
            found.push(format!("check does not list: {}: {loss}", done.label));
        }
        let counts = [
            ("vertices", forecast.vertices, done.vertices),
            ("edges", forecast.edges, done.edges),
            ("faces", forecast.faces, done.faces),
        ];
        for (what, range, n) in counts {
            // The forecast counts elements of meshes only, but the report of a run also counts control points and
            // polylines.
            if range.max > 0 && !range.contains(n as u64) {
                found.push(format!("{}: {n} {what}, but planned {range:?}", done.label));
            }
        }
        // The losses that the forecast lists as certain must occur.
        let lost = |name: &str| done.report.losses.iter().any(|loss| loss.name == name);
        for loss in forecast.losses.iter().filter(|loss| !lost(&loss.name)) {
            found.push(format!("{}: not lost: {loss}", done.label));
        }
    }
    found
}

fn load(registry: &Registry, folder: &Path, steps: &str, budget: u64) -> Loaded {
    let text = format!("(recipe: 1, steps: [{steps}])");
    let options = Options {
        out: folder,
        budget,
        ..Options::default()
    };
    Engine::new(registry).load(&Source::new(folder.join("a.ron"), text), &options)
}

/// The names and texts of files that the small recipes load.
const FILES: [(&str, &str); 3] = [
    (
        "plain.obj",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng half\nf 1 2 3\nf 1 3 4\n",
    ),
    (
        "textured.obj",
        "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\nv 0 1 0 1 0 0\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\ns 1\n\
         f 1/1/1 2/2/1 3/3/1 4/1/1\nf 1 2 2\n",
    ),
    (
        "table.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
         property float quality\nelement face 1\nproperty list uchar int vertex_indices\n\
         property list uchar int other\nend_header\n0 0 0 1\n1 0 0 2\n0 1 0 3\n3 0 1 2 1 7\n",
    ),
];

/// Steps that make or load an object.
const SOURCES: [&str; 6] = [
    "Cube()",
    "Torus(), Cube()",
    "Icosphere(), VertexNormals(), Tag(name: \"t\", faces: All)",
    "Load(path: \"plain.obj\")",
    "Load(path: \"textured.obj\")",
    "Load(path: \"table.ply\")",
];

/// The formats in which meshes are saved.
const FORMATS: [&str; 8] = ["obj", "glb", "ply", "stl", "off", "csv", "npz", "mws"];

#[test]
fn check_knows_what_small_recipes_refuse_and_lose() {
    let registry = ops_all::registry();
    let saves = FORMATS.map(|extension| format!(", Save(path: \"a.{extension}\")"));
    let saves = saves.concat();
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in FILES {
        std::fs::write(folder.path().join(name), text).expect("the file can be written");
    }
    // Operations with a path are left out. The cases already contain `Load` and `Save`. All other operations with a
    // path write pictures, which takes a long time and loses no data.
    let operations = registry.entries().iter().map(|entry| entry.example);
    let operations = operations.filter(|example| !example.contains("path:"));
    let cases: Vec<String> = operations
        .flat_map(|operation| SOURCES.map(|source| format!("{source}, {operation}{saves}")))
        .chain(SOURCES.map(|source| format!("{source}{saves}")))
        .chain(["bez", "bzc"].map(|extension| format!("Cube(), Save(path: \"a.{extension}\")")))
        .collect();
    let failures: Vec<String> = cases
        .par_iter()
        .flat_map_iter(|steps| {
            let found = |budget| {
                let loaded = load(&registry, folder.path(), steps, budget);
                let found = disagreements(&loaded).into_iter();
                found.map(move |found| format!("{steps} with {budget} bytes: {found}"))
            };
            [8 << 30, 20_000]
                .into_iter()
                .flat_map(found)
                .collect::<Vec<_>>()
        })
        .collect();
    assert_none(&failures);
}

#[test]
fn check_knows_what_scenes_lose() {
    let registry = ops_all::registry();
    let failures: Vec<String> = recipes()
        .par_iter()
        .flat_map_iter(|path| {
            let out = tempfile::tempdir().expect("a temporary folder");
            let options = Options {
                out: out.path(),
                ..Options::default()
            };
            let engine = Engine::new(&registry);
            let loaded = engine.load(&engine.open(path).expect("a recipe"), &options);
            let name = path
                .strip_prefix(root())
                .unwrap_or(path)
                .display()
                .to_string();
            let found = disagreements(&loaded).into_iter();
            found.map(move |found| format!("{name}: {found}"))
        })
        .collect();
    assert_none(&failures);
}
