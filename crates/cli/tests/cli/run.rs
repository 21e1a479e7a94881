//! `run` and `check`.

use crate::folder::Folder;

/// A torus of 96 triangles, subdivided and written twice.
pub(crate) const TORUS: &str = r#"(
    recipe: 1,
    params: { "levels": Int(default: 1, min: 0, max: 4, doc: "how often") },
    steps: [
        Torus(name: "torus", around: 8, across: 6),
        Triangulate,
        (id: "smooth", run: LoopSubdivide(levels: arg("levels"))),
        Save(path: "torus.obj"),
        Save(path: "deep/torus.glb"),
    ],
    expect: [Genus(eq: 1), (after: "smooth", that: Closed)],
)"#;

#[test]
fn a_run_prints_its_steps_outputs_and_digest() {
    let folder = Folder::with_recipe(TORUS);
    let ended = folder.run("run recipe.ron").with_code(0).prints(&[
        "step",
        " 1 Torus",
        " 2 Triangulate",
        " 3 smooth",
        "192",
        "576",
        "384",
        " 4 Save",
        "wrote out/deep/torus.glb\n",
        "wrote out/torus.obj\n",
        "2 expectations met\n",
        "digest ",
    ]);
    assert_eq!(ended.stderr, "");
    assert_eq!(ended.digest().len(), 32);
    assert_eq!(folder.entries("out"), ["deep", "torus.obj"]);
    assert_eq!(folder.entries("out/deep"), ["torus.glb"]);
    folder
        .run("info out/torus.obj")
        .with_code(0)
        .prints(&["faces", "384 (384 of 3 corners)"]);
}

#[test]
fn points_of_polylines_are_counted_and_singular_is_used_for_one() {
    let folder = Folder::with_recipe(
        r#"(recipe: 1, steps: [Load(path: "a.bzc"), SampleCurve(segments: 9)], expect: [Vertices(eq: 10)])"#,
    )
    .with("a.bzc", "3\n0 0\n1 2\n2 0\n");
    let run = folder.run("run recipe.ron").with_code(0);
    let row = run.stdout.lines().find(|l| l.contains("SampleCurve"));
    let words: Vec<&str> = row.unwrap().split_whitespace().collect();
    assert_eq!(words[..5], ["2", "SampleCurve", "10", "0", "0"]);
    run.prints(&["1 expectation met\n"]);
    folder
        .run("check recipe.ron")
        .with_code(0)
        .prints(&["2 steps, 1 expectation\n"]);
}

#[test]
fn a_parameter_can_be_set() {
    let folder = Folder::with_recipe(TORUS);
    folder
        .run("run recipe.ron --set levels=2 --out set")
        .with_code(0)
        .prints(&[" 3 smooth", "1 536"]);
    assert_eq!(folder.entries("set"), ["deep", "torus.obj"]);
}

#[test]
fn a_parameter_that_cannot_be_set_is_an_error() {
    let folder = Folder::with_recipe(TORUS);
    for (set, message, help) in [
        (
            "level=2",
            "error: the recipe has no parameter `level`",
            "did you mean `levels`?",
        ),
        (
            "levels=5",
            "error: the value that was set for the parameter `levels` is not allowed: 5 is above the maximum 4",
            "",
        ),
        (
            "levels=two",
            "error: the value that was set for the parameter `levels` is not allowed: expected a whole number, found `two`",
            "",
        ),
    ] {
        folder
            .run(&format!("run recipe.ron --set {set}"))
            .with_code(1)
            .complains(&[message, help, "1 error, no step was run\n"]);
    }
    assert_eq!(folder.entries("."), ["recipe.ron"]);
}

#[test]
fn a_run_explains_where_values_come_from() {
    let folder = Folder::with_recipe(TORUS);
    for command in ["run", "check"] {
        folder
            .run(&format!("{command} recipe.ron --explain"))
            .with_code(0)
            .prints(&["levels", "1", "the recipe's default\n"]);
        folder
            .run(&format!("{command} recipe.ron --explain --set levels=0"))
            .with_code(0)
            .prints(&["levels", "0", "--set\n"]);
    }
}

#[test]
fn a_run_prints_the_notes_of_steps() {
    let folder = Folder::with_recipe(
        "(recipe: 1, steps: [Cube(), (id: \"soft\", note: \"the maker wants it soft\", run: Triangulate())])",
    );
    for command in ["run", "check"] {
        folder
            .run(&format!("{command} recipe.ron --explain"))
            .with_code(0)
            .prints(&["2 soft: the maker wants it soft\n"]);
    }
}

#[test]
fn changes_by_reading_are_data_in_json() {
    let folder = Folder::with_recipe("(recipe: 1, steps: [Load(path: \"a.obj\")])").with(
        "a.obj",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n",
    );
    let events = folder.run("run recipe.ron --format json").events();
    let done = events.iter().find(|e| e["event"] == "done").unwrap();
    let change = &done["changes"][0];
    assert_eq!(change["code"], "edges-split");
    assert_eq!(change["count"], 1);
    assert_eq!(change["edges"], serde_json::json!([[0, 1]]));
    // Without `--format json`, the list after the table describes the same change.
    let text = change["text"].as_str().unwrap();
    folder.run("run recipe.ron").prints(&[text]);
}

#[test]
fn the_stem_of_a_compressed_input_names_the_output() {
    let recipe = r#"(recipe: 1, params: { "input": Path(default: "model.obj.gz") },
        steps: [Cube(), Save(path: "{input.stem}.obj")])"#;
    let folder = Folder::with_recipe(recipe);
    folder
        .run("run recipe.ron")
        .with_code(0)
        .prints(&["wrote out/model.obj"]);
}

#[test]
fn a_path_that_is_set_is_relative_to_the_working_directory_and_names_the_output() {
    let recipe = r#"(recipe: 1,
        params: { "input": Path(default: "triangle.obj") },
        steps: [Load(path: arg("input")), Save(path: "{input.stem}.new.obj")])"#;
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let folder = Folder::new()
        .with("scenes/recipe.ron", recipe)
        .with("scenes/triangle.obj", triangle)
        .with("here/other.obj", triangle);
    folder.run("run scenes/recipe.ron").with_code(0);
    folder
        .run("run scenes/recipe.ron --set input=here/other.obj")
        .with_code(0)
        .prints(&["wrote out/other.new.obj\n"]);
    assert_eq!(folder.entries("out"), ["other.new.obj", "triangle.new.obj"]);
}

#[test]
fn a_run_can_report_in_json() {
    let folder = Folder::with_recipe(TORUS);
    let ended = folder.run("run recipe.ron --format json").with_code(0);
    let events = ended.events();
    let of = |kind: &str| {
        let found = events.iter().filter(|e| e["event"] == kind);
        found.collect::<Vec<_>>()
    };
    assert_eq!(
        (&events[0]["event"], &events[0]["format"]),
        (&"start".into(), &1.into())
    );
    assert_eq!(events[0]["steps"], of("step").len());
    let [step, done] = [of("step")[2], of("done")[2]];
    assert_eq!(
        (&step["label"], &step["operation"]),
        (&"smooth".into(), &"LoopSubdivide".into())
    );
    assert_eq!(
        (&done["label"], &done["number"]),
        (&"smooth".into(), &3.into())
    );
    assert_eq!(done["faces"], 384);
    assert_eq!(of("wrote")[1]["path"], "out/torus.obj");
    let end = events.last().unwrap();
    assert_eq!(
        (&end["event"], &end["succeeded"]),
        (&"end".into(), &true.into())
    );
    assert_eq!(end["expectations"], 2);
    let digest = end["digest"].as_str().unwrap();
    assert_eq!(folder.run("run recipe.ron").digest(), digest);
    assert_eq!(ended.stderr, "");
}

#[test]
fn a_failure_is_reported_in_json_too() {
    let folder = Folder::with_recipe("(recipe: 1, steps: [\n  Cubee(name: \"a\"),\n])");
    let events = folder
        .run("run recipe.ron --format json")
        .with_code(1)
        .events();
    let [start, failure, end] = &events[..] else {
        panic!("{events:#?}")
    };
    assert_eq!(
        (&start["event"], &end["event"]),
        (&"start".into(), &"end".into())
    );
    assert_eq!(
        (&end["succeeded"], &failure["file"]),
        (&false.into(), &"recipe.ron".into())
    );
    assert_eq!(failure["message"], "unknown operation `Cubee`");
    assert_eq!(failure["help"], "did you mean `Cube`?");
    assert_eq!(
        (&failure["line"], &failure["column"]),
        (&2.into(), &3.into())
    );

    let folder = Folder::with_recipe(
        "(recipe: 1, steps: [Cube(name: \"a\")], expect: [Faces(eq: 7), Closed])",
    );
    let events = folder
        .run("run recipe.ron --format json")
        .with_code(1)
        .events();
    let problems: Vec<_> = events.iter().filter(|e| e["event"] == "problem").collect();
    assert_eq!(problems.len(), 1);
    assert_eq!(problems[0]["message"], "expected 7 faces, found 6");
    assert_eq!(events.last().unwrap()["succeeded"], false);
}

#[test]
fn one_thread_and_eight_give_the_same_bytes() {
    let folder = Folder::with_recipe(TORUS);
    let run = |threads: &str| {
        let arguments =
            format!("run recipe.ron --set levels=4 --threads {threads} --out {threads}");
        folder.run(&arguments).with_code(0)
    };
    let (one, eight) = (run("1"), run("8"));
    assert_eq!(one.digest(), eight.digest());
    for file in ["torus.obj", "deep/torus.glb"] {
        let bytes = folder.read(&format!("1/{file}"));
        assert!(bytes.len() > 100_000, "{file}");
        assert!(bytes == folder.read(&format!("8/{file}")), "{file}");
    }
}

#[test]
fn edits_that_are_refused_and_skipped_are_counted() {
    let folder = Folder::with_recipe(
        r#"(recipe: 1, steps: [
            Tetrahedron(name: "a"),
            (id: "shuffle", run: FlipEdges(edges: All, on_refusal: Skip)),
        ])"#,
    );
    folder
        .run("run recipe.ron")
        .with_code(0)
        .prints(&["shuffle: 6 refused, DuplicateEdge (first: "]);
}

#[test]
fn a_check_forecasts_and_writes_nothing() {
    let folder = Folder::with_recipe(TORUS);
    folder.run("check recipe.ron").with_code(0).prints(&[
        "memory",
        " 1 Torus",
        "48",
        "96",
        "48",
        " 3 smooth",
        "192",
        "576",
        "384",
        "recipe.ron is valid: 5 steps, 2 expectations\n",
    ]);
    assert_eq!(folder.entries("."), ["recipe.ron"]);
    let json = folder
        .run("check recipe.ron --format json")
        .with_code(0)
        .json();
    assert_eq!(json["forecast"][2]["faces"]["max"], 384);
}

#[test]
fn a_check_and_a_run_report_the_same_errors() {
    let folder = Folder::with_recipe("(recipe: 1, steps: [Cube(sise: 1)])");
    let check = folder.run("check recipe.ron").with_code(1);
    let run = folder.run("run recipe.ron").with_code(1);
    assert_eq!(check.stderr, run.stderr);
    assert_eq!(check.stdout, "");
}
