//! `sweep`: runs one recipe with many parameter values.

use serde_json::{Value as Json, json};

use crate::folder::{Ended, Folder};

const RECIPE: &str = r#"(
    recipe: 1,
    params: {
        "around": Int(default: 8, min: 3, max: 64),
        "levels": Int(default: 0, max: 3),
        "minor": Float(default: 0.5, min: 0.1, max: 2),
    },
    steps: [
        Torus(name: "torus", around: arg("around"), across: 6, major: 1, minor: arg("minor")),
        Triangulate,
        LoopSubdivide(levels: arg("levels")),
        Save(path: "torus.obj"),
    ],
    expect: [Faces(eq: 96)],
)"#;

fn folder(sweep: &str) -> Folder {
    Folder::with_recipe(RECIPE).with("a.sweep.ron", sweep)
}

fn fields(fields: &str) -> String {
    format!("(sweep: 1, recipe: \"recipe.ron\", {fields})")
}

fn json(ended: &Ended) -> Json {
    ended.json()
}

/// Returns the values of one measure, one value for each run of the sweep.
fn measure(table: &Json, name: &str) -> Vec<Json> {
    let cells = table["cells"].as_array().unwrap();
    cells
        .iter()
        .map(|cell| cell["measures"][name].clone())
        .collect()
}

#[test]
fn the_table_has_a_row_for_each_cell_and_the_last_parameter_changes_fastest() {
    let folder = folder(&fields(
        "over: {\"levels\": [0, 1], \"around\": [8, 16, 4]}, keep: [Vertices, Edges, Faces, EulerCharacteristic, Genus, Components, BoundaryLoops, Objects]",
    ));
    let ended = folder.run("sweep a.sweep.ron --format json").with_code(0);
    let table = json(&ended);
    assert_eq!(table["parameters"], json!(["levels", "around"]));
    assert_eq!(measure(&table, "Faces"), [96, 192, 48, 384, 768, 192]);
    // In every run of the sweep, V - E + F of the torus is 0.
    for name in ["EulerCharacteristic", "BoundaryLoops"] {
        assert_eq!(measure(&table, name), [0; 6]);
    }
    for name in ["Genus", "Components", "Objects"] {
        assert_eq!(measure(&table, name), [1; 6]);
    }
    assert_eq!(
        table["cells"][4]["parameters"],
        json!({"levels": 1, "around": 16})
    );

    folder.run("sweep a.sweep.ron").with_code(0).prints(&[
        "cell  levels  around  Vertices",
        "\n1          0       8        48",
        "\n6          1       4        96",
        "6 cells; the sweep did not check 1 expectation of the recipe: to check expectations, write `expect: true` in the sweep file\n",
    ]);
    // Outputs are only written with --keep-outputs.
    assert_eq!(folder.entries("."), ["a.sweep.ron", "recipe.ron"]);
}

#[test]
fn measures_are_those_of_a_run() {
    let folder = folder(&fields(
        "over: {\"around\": [8, 32]}, set: {\"levels\": 1}, keep: [Area, Volume, Digest, DistanceTo(other: File(\"kept/1/torus.obj\"))]",
    ))
    .with("kept/1/torus.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder
        .run("sweep a.sweep.ron --keep-outputs kept")
        .with_code(0);
    let table = json(&folder.run("sweep a.sweep.ron --format json").with_code(0));
    assert_eq!(table["set"], json!({"levels": 1}));
    let run = folder
        .run("run recipe.ron --no-expect --set levels=1 --set around=32")
        .with_code(0);
    assert_eq!(measure(&table, "Digest")[1], run.digest());
    let facts = folder.run("info out/torus.obj --format json").json();
    assert_eq!(measure(&table, "Area")[1], facts["objects"][0]["area"]);
    // `DistanceTo` compares each result with the output of the first run. Therefore, only the second run has a distance
    // greater than 0.
    let distances = measure(&table, "DistanceTo(other: File(\"kept/1/torus.obj\"))");
    assert!(distances[0].as_f64().unwrap() < 1e-12, "{distances:?}");
    assert!(distances[1].as_f64().unwrap() > 1e-3, "{distances:?}");
}

#[test]
fn the_smallest_angle_of_regular_triangles_is_60_degrees() {
    let folder = Folder::with_recipe(
        "(recipe: 1, params: {\"flat\": Bool(default: false)}, steps: [Icosahedron(name: \"a\")])",
    )
    .with("a.sweep.ron", fields("keep: [MinAngle]"));
    let table = json(&folder.run("sweep a.sweep.ron --format json").with_code(0));
    let angle = measure(&table, "MinAngle")[0].as_f64().unwrap();
    assert!((angle - 60.0).abs() < 1e-10, "{angle}");
}

#[test]
fn results_do_not_depend_on_jobs_threads_and_budget() {
    let folder = folder(&fields(
        "over: {\"around\": Range(from: 3, to: 30, steps: 10), \"minor\": Range(from: 0.1, to: 0.5, steps: 5)}, keep: [Area, Volume, MinAngle, Digest]",
    ));
    let made = |arguments: &str| {
        let ended = folder
            .run(&format!("sweep a.sweep.ron --out t.csv {arguments}"))
            .with_code(0);
        (ended.stdout, folder.read("t.csv"))
    };
    let one = made("--threads 1");
    assert_eq!(
        String::from_utf8(one.1.clone()).unwrap().lines().count(),
        51
    );
    for arguments in [
        "--threads 2",
        "--threads 8",
        "--threads 8 --jobs 3",
        "--budget 1MiB",
    ] {
        assert_eq!(made(arguments), one, "{arguments}");
    }
}

#[test]
fn a_failed_cell_is_a_row_with_its_error() {
    let folder = folder(&fields(
        "over: {\"around\": [8, 16]}, expect: true, keep: [Faces, Seconds]",
    ));
    let ended = folder.run("sweep a.sweep.ron --out t.json").with_code(1);
    assert!(
        ended.stdout.contains("FAILED\n2 cells, 1 failed\n"),
        "{ended:#?}"
    );
    assert_eq!(
        ended.stderr,
        "error: cell 2: expected 96 faces, found 192\n"
    );
    let table: Json = serde_json::from_slice(&folder.read("t.json")).unwrap();
    assert_eq!(table["succeeded"], false);
    assert_eq!(table["cells"][0]["measures"]["Faces"], 96);
    assert!(table["cells"][0]["measures"]["Seconds"].as_f64().unwrap() >= 0.0);
    assert_eq!(table["cells"][1]["measures"], Json::Null);
    assert_eq!(table["cells"][1]["error"], "expected 96 faces, found 192");
}

#[test]
fn a_cell_that_fails_its_check_is_a_row_too() {
    let folder = folder(&fields(
        "over: {\"levels\": [0, 3]}, set: {\"around\": 64}, keep: [Faces]",
    ));
    let ended = folder.run("sweep a.sweep.ron --budget 300KiB").with_code(1);
    assert!(ended.stderr.contains("error: cell 2: "), "{ended:#?}");
    assert!(ended.stderr.contains("budget"), "{ended:#?}");
    assert!(ended.stdout.contains("2 cells, 1 failed"), "{ended:#?}");
}

#[test]
fn outputs_of_each_cell_are_in_a_folder_named_by_its_number() {
    let folder = folder(&fields("over: {\"around\": [8, 16]}, keep: [Faces]"));
    folder
        .run("sweep a.sweep.ron --keep-outputs kept")
        .with_code(0);
    assert_eq!(folder.entries("kept"), ["1", "2"]);
    assert_eq!(folder.entries("kept/2"), ["torus.obj"]);
    let facts = folder.run("info kept/2/torus.obj --format json").json();
    assert_eq!(facts["objects"][0]["faces"], 192);
}

#[test]
fn all_errors_are_reported_with_their_places_and_no_cell_runs() {
    let folder = folder(
        r#"(
    sweep: 1,
    recipe: "recipe.ron",
    over: {
        "round": [1],
        "around": [2, 8.5, "9"],
        "minor": [],
    },
    set: { "levels": 4 },
    keep: [Facets, DistanceTo(other: File("none.obj"))],
)"#,
    );
    let ended = folder
        .run("sweep a.sweep.ron --keep-outputs kept --out t.csv")
        .with_code(1)
        .complains(&[
            "error: the recipe has no parameter `round`\n",
            "a.sweep.ron:5:9\n",
            "help: did you mean `around`?\n",
            "error: 2 is below the minimum 3\n",
            "a.sweep.ron:6:20\n",
            "error: expected a whole number, found `8.5`\n",
            "a.sweep.ron:6:23\n",
            "error: expected a whole number, found the string \"9\"\n",
            "error: expected at least one value, found an empty list\n",
            "a.sweep.ron:7:18\n",
            "error: 4 is above the maximum 3\n",
            "a.sweep.ron:9:22\n",
            "error: unknown variant `Facets`",
            "a.sweep.ron:10:12\n",
            "error: the file none.obj does not exist\n",
            "a.sweep.ron:10:20\n",
            "8 errors, so no run was started\n",
        ]);
    assert_eq!(ended.stdout, "");
    assert_eq!(folder.entries("."), ["a.sweep.ron", "recipe.ron"]);
}

#[test]
fn invalid_sweeps_are_refused_with_a_reason() {
    let keep = "keep: [Faces]";
    for (sweep, message) in [
        (
            fields(&format!(
                "over: {{\"minor\": Range(from: 0.1, to: 2, steps: 9999), \"levels\": [0, 1]}}, {keep}"
            )),
            "cells (combinations of values), expected at most 10000",
        ),
        (fields("over: {}"), "`keep` is missing"),
        (
            format!("(sweep: 1, recipe: \"none.ron\", {keep})"),
            "the file none.ron does not exist",
        ),
        (
            format!("(sweep: 2, recipe: \"recipe.ron\", {keep})"),
            "this sweep has the format version 2, expected 1",
        ),
        (
            format!("(sweep: 1, recipe: \"broken.ron\", {keep})"),
            "unknown operation `Cubee`",
        ),
        (String::new(), "error: "),
        ("(".repeat(10_000), "error: "),
    ] {
        let folder = folder(&sweep).with("broken.ron", "(recipe: 1, steps: [Cubee])");
        let ended = folder.run("sweep a.sweep.ron").with_code(1);
        assert!(ended.stderr.contains(message), "{message}: {ended:#?}");
        assert!(!ended.stderr.contains("panicked"), "{ended:#?}");
        assert_eq!(ended.stdout, "", "{message}");
    }
    let folder = folder(&fields(keep));
    let ended = folder.run("sweep a.sweep.ron --out t.txt").with_code(1);
    assert!(
        ended
            .stderr
            .contains("t.txt: expected a table with the extension .csv or .json")
    );
    folder
        .run("sweep none.sweep.ron")
        .with_code(1)
        .complains(&["cannot read none.sweep.ron"]);
}

#[test]
fn paths_among_the_values_are_relative_to_the_sweep() {
    let recipe =
        "(recipe: 1, params: {\"m\": Path(default: \"x.obj\")}, steps: [Load(path: arg(\"m\"))])";
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let folder = Folder::new()
        .with("recipes/r.ron", recipe)
        .with("sweeps/models/a.obj", obj)
        .with(
            "sweeps/s.sweep.ron",
            "(sweep: 1, recipe: \"../recipes/r.ron\", over: {\"m\": [\"models/a.obj\"]}, keep: [Faces])",
        );
    let table = json(
        &folder
            .run("sweep sweeps/s.sweep.ron --format json")
            .with_code(0),
    );
    assert_eq!(measure(&table, "Faces"), [1]);
    assert_eq!(table["cells"][0]["parameters"]["m"], "models/a.obj");
}
