//! Errors are reported clearly, and failed runs leave no files.

use crate::folder::{Ended, Folder};

/// Runs a recipe that must fail, and checks that it left no outputs.
#[track_caller]
fn fails(folder: &Folder) -> Ended {
    let ended = folder.run("run recipe.ron").with_code(1);
    assert!(folder.entries("out").is_empty(), "{ended:#?}");
    assert!(!ended.stderr.contains("panicked"), "{ended:#?}");
    ended
}

#[test]
fn five_different_mistakes_are_five_errors_and_nothing_runs() {
    let folder = Folder::with_recipe(
        r#"(
    recipe: 1,
    steps: [
        Cubee(name: "cube"),
        Torus(name: "torus", around: 8, across: 6, minr: 0.5),
        LoopSubdivide(levels: 1.5),
        (id: "sharp", run: FlipEdges(edges: Boundery)),
        Save(path: "torus.obj"),
    ],
    expect: [Faces(eq: 6), Genus()],
)"#,
    );
    let ended = fails(&folder).complains(&[
        "error: unknown operation `Cubee`\n",
        "recipe.ron:4:9\n",
        "4 │         Cubee(name: \"cube\"),\n",
        "^^^^^\n",
        "help: did you mean `Cube`?\n",
        "error: unknown field `minr` in `Torus`\n",
        "recipe.ron:5:52\n",
        "help: did you mean `minor`?\n",
        "error: expected a whole number for `levels`, found 1.5\n",
        "recipe.ron:6:31\n",
        "error: unknown variant `Boundery` for `edges`\n",
        "recipe.ron:7:45\n",
        "help: did you mean `Boundary`?\n",
        "error: the expectation has no bound, so it can never fail\n",
        "recipe.ron:10:28\n",
        "help: add a bound, such as `eq`, `min` or `max`\n",
        "5 errors, no step was run\n",
    ]);
    assert_eq!(ended.stderr.matches("error: ").count(), 5);
    assert_eq!(ended.stdout, "");
    assert_eq!(folder.entries("."), ["recipe.ron"]);
}

#[test]
fn a_refusal_says_how_to_continue_if_the_step_can() {
    for (steps, can_skip) in [
        ("Tetrahedron(), FlipEdges(edges: All)", true),
        (
            "Grid(columns: 2, rows: 2), BevelVertices(vertices: All, fraction: 0.25)",
            true,
        ),
        (
            "Grid(columns: 2, rows: 2), DeleteFaces(faces: Faces([0, 3]))",
            true,
        ),
        ("Tetrahedron(), Simplify(faces: 2)", true),
        ("Tetrahedron(), BridgeLoops(first: 0, second: 3)", false),
    ] {
        let text = format!("(recipe: 1, steps: [{steps}])");
        let ended = fails(&Folder::with_recipe(&text));
        let help = "help: to continue in such cases, add `on_refusal: Skip`\n";
        assert_eq!(ended.stderr.contains(help), can_skip, "{ended:#?}");
    }
}

#[test]
fn a_syntax_error_hides_no_other_mistake() {
    let folder =
        Folder::with_recipe("(recipe: 1, steps: [\n  Cube(name: \"a\",\n  Cubee(name: \"b\"),\n])");
    fails(&folder).complains(&[
        "recipe.ron:2:7\n",
        "unknown operation `Cubee`",
        "recipe.ron:3:3\n",
    ]);
}

const LOAD: &str = "(recipe: 1, steps: [Load(path: \"FILE\"), Save(path: \"new.obj\")])";

#[test]
fn a_broken_file_is_named_with_the_line() {
    let patch = format!("1\n{}0 0 0\n0 0 x\n", "0 0 0  ".repeat(14));
    for (file, content, place) in [
        ("patch.bez", patch.as_str(), "patch.bez:3:5: "),
        ("short.bez", "2\n0 0 0\n", "short.bez:1:1: "),
        ("curve.bzc", "2\n0 0\n1 one\n", "curve.bzc:3:3: "),
        (
            "index.obj",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
            "index.obj:4:7: ",
        ),
        ("broken.gltf", "{\"asset\": ", "broken.gltf:1:"),
        ("broken.glb", "glTF, not", "broken.glb:"),
    ] {
        let recipe = LOAD.replace("FILE", file);
        let folder = Folder::with_recipe(&recipe).with(file, content);
        let ended = fails(&folder).complains(&["error: ", place]);
        assert_eq!(ended.stderr.matches("error: ").count(), 1, "{ended:#?}");
        folder
            .run(&format!("info {file}"))
            .with_code(1)
            .complains(&[place]);
    }
}

#[test]
fn a_file_that_is_missing_is_found_before_anything_runs() {
    fails(&Folder::with_recipe(&LOAD.replace("FILE", "no.obj"))).complains(&[
        "error: ",
        "no.obj",
        "recipe.ron:1:32",
        "1 error, no step was run\n",
    ]);
}

#[test]
fn an_index_out_of_range_is_explained() {
    let recipe = LOAD.replace("FILE", "a.obj");
    let folder = Folder::with_recipe(&recipe).with("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
    fails(&folder).complains(&[
        "a.obj:4:7: the corner refers to vertex 4, but the file defines 3 vertices\n",
        "recipe.ron failed, no files were written\n",
    ]);
}

#[test]
fn an_output_folder_that_cannot_be_created_fails_before_any_step() {
    // No user can create a folder below a file.
    let folder = Folder::with_recipe(crate::run::TORUS).with("file", "");
    let ended = folder
        .run("run recipe.ron --out file/out")
        .with_code(1)
        .complains(&[
            "error: cannot write to the output folder file/out: ",
            "recipe.ron failed, no files were written\n",
        ]);
    assert!(!ended.stdout.contains("Torus"), "{ended:#?}");
    assert_eq!(folder.entries("."), ["file", "recipe.ron"]);
}

#[test]
fn more_levels_than_ids_allow_are_refused_before_anything_runs() {
    let folder = Folder::with_recipe(
        r#"(recipe: 1, steps: [
            Icosahedron(name: "a"), LoopSubdivide(levels: 14), Save(path: "a.obj"),
        ])"#,
    );
    fails(&folder).complains(&[
        "error: level 14 ",
        "recipe.ron:2:59\n",
        "1 error, no step was run\n",
    ]);
}

#[test]
fn more_memory_than_the_budget_is_refused_before_anything_runs() {
    let folder = Folder::with_recipe(
        r#"(recipe: 1, steps: [Icosahedron(name: "a"), LoopSubdivide(levels: 6), Save(path: "a.obj")])"#,
    );
    folder
        .run("run recipe.ron --budget 1MiB")
        .with_code(1)
        .complains(&["error: ", "budget", "1.0 MiB", "1 error, no step was run\n"]);
    assert!(folder.entries("out").is_empty());
    folder.run("check recipe.ron --budget 1GiB").with_code(0);
}

#[test]
fn a_missing_recipe_and_one_that_is_not_text_are_one_line_of_error() {
    let folder = Folder::new().with("latin.ron", b"(\n recipe: 1, // caf\xe9\n)");
    let missing = folder.run("run none.ron").with_code(1);
    assert!(
        missing.stderr.starts_with("error: cannot read none.ron: "),
        "{missing:#?}"
    );
    assert_eq!(missing.stderr.lines().count(), 1);
    let latin = folder.run("run latin.ron").with_code(1);
    assert_eq!(
        latin.stderr,
        "error: latin.ron:2: the recipe is not UTF-8 text\n"
    );
}

#[test]
fn a_recipe_of_a_newer_version_is_refused() {
    fails(&Folder::with_recipe("(recipe: 2, stages: [])")).complains(&[
        "error: this recipe has the format version 2, expected 1\n",
        "recipe.ron:1:10\n",
        "help: a newer version of meshwright may be able to read the file\n",
    ]);
}

#[test]
fn outputs_outside_of_the_output_folder_are_refused() {
    for path in ["../a.obj", "/tmp/a.obj", "a/../../a.obj", "c:a.obj"] {
        let folder = Folder::with_recipe(&format!(
            "(recipe: 1, steps: [Cube(name: \"a\"), Save(path: \"{path}\")])"
        ));
        let message = format!("error: the output path \"{path}\" must stay inside");
        fails(&folder).complains(&[&message, "recipe.ron:1:49\n"]);
    }
}

#[cfg(unix)]
#[test]
fn a_link_does_not_lead_out_of_the_output_folder() {
    let folder =
        Folder::with_recipe("(recipe: 1, steps: [Cube(name: \"a\"), Save(path: \"link/a.obj\")])")
            .with("elsewhere/b.obj", "");
    std::fs::create_dir(folder.path("out")).unwrap();
    std::os::unix::fs::symlink(folder.path("elsewhere"), folder.path("out/link")).unwrap();
    folder
        .run("run recipe.ron")
        .with_code(1)
        .complains(&["leads out of the output folder through a symbolic link"]);
    assert_eq!(folder.entries("elsewhere"), ["b.obj"]);
}

#[test]
fn two_steps_do_not_write_one_file() {
    let folder = Folder::with_recipe(
        "(recipe: 1, steps: [Cube(name: \"a\"), Save(path: \"a.obj\"), Save(path: \"a.obj\")])",
    );
    let ended = fails(&folder).complains(&["an earlier step ", "recipe.ron:1:70\n"]);
    assert_eq!(ended.stderr.matches("error: ").count(), 1, "{ended:#?}");
}

#[test]
fn an_unmet_expectation_keeps_earlier_outputs() {
    let recipe = "(recipe: 1, steps: [(id: \"a\", run: Cube(name: \"a\")), Save(path: \"a.obj\")],
    expect: [(after: \"a\", that: Faces(eq: 7)), Vertices(min: 9)])";
    let folder = Folder::with_recipe(recipe).with("out/a.obj", "old");
    folder.run("run recipe.ron").with_code(1).complains(&[
        "error: expected 7 faces, found 6\n",
        "after this step",
        "error: expected at least 9 vertices, found 8\n",
        "recipe.ron failed, no files were written\n",
        "to write the files without checking expectations, use --no-expect\n",
    ]);
    assert_eq!(folder.entries("out"), ["a.obj"]);
    assert_eq!(folder.read("out/a.obj"), b"old");
}

#[test]
fn a_step_refused_for_the_expected_reason_passes() {
    let folder = Folder::with_recipe(
        r#"(recipe: 1, steps: [
            Grid(name: "a", columns: 1, rows: 1),
            (run: FlipEdges(edges: Boundary), refused: Boundary),
            (run: FlipEdges(edges: Between(0, 1)), refused: Seam),
        ])"#,
    );
    fails(&folder).complains(&[
        "error: expected the step to be refused with the reason Seam, but the step failed for another reason: ",
        "recipe.ron:4:19\n",
    ]);
}

#[test]
fn a_recipe_of_ten_thousand_brackets_is_refused_quickly() {
    let folder = Folder::with_recipe(&"(".repeat(10_000));
    fails(&folder).complains(&["error: ", "no step was run\n"]);
}
