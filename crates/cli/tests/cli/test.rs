//! `test`: runs recipes as tests.

use crate::folder::Folder;

const GOOD: &str =
    "(recipe: 1, steps: [Cube(name: \"a\"), Save(path: \"a.obj\")], expect: [Faces(eq: 6)])";
const BAD: &str =
    "(recipe: 1, steps: [Cube(name: \"a\"), Save(path: \"a.obj\")], expect: [Faces(eq: 7)])";

#[test]
fn each_recipe_is_a_line_and_one_failure_fails_the_command() {
    let folder = Folder::new()
        .with("scenes/b_good.ron", GOOD)
        .with("scenes/a_bad.ron", BAD)
        .with("scenes/notes.txt", "no recipe");
    folder
        .run("test scenes")
        .with_code(1)
        .prints(&[
            "FAILED scenes/a_bad.ron (1 expectation, ",
            "ok     scenes/b_good.ron (1 expectation, ",
            "1 passed, 1 failed\n",
        ])
        .complains(&["error: expected 7 faces, found 6\n", "scenes/a_bad.ron:1:"]);
    assert_eq!(folder.entries("."), ["scenes"]);
    assert_eq!(
        folder.entries("scenes"),
        ["a_bad.ron", "b_good.ron", "notes.txt"]
    );
}

#[test]
fn recipes_that_cannot_be_read_count_as_failed() {
    let folder = Folder::new()
        .with("scenes/a.ron", GOOD)
        .with("scenes/b.ron", "(recipe: 1, steps: [Cubee])")
        .with("scenes/c.ron", b"\xff");
    folder
        .run("test")
        .with_code(1)
        .prints(&[
            "ok     scenes/a.ron",
            "FAILED scenes/b.ron\n",
            "FAILED scenes/c.ron\n",
            "1 passed, 2 failed\n",
        ])
        .complains(&["unknown operation `Cubee`", "scenes/c.ron:1: "]);
}

#[test]
fn outputs_are_kept_in_a_folder_for_each_recipe_if_requested() {
    let folder = Folder::new().with("x.ron", GOOD).with("y.ron", GOOD);
    folder
        .run("test x.ron y.ron --out kept")
        .with_code(0)
        .prints(&["2 passed, 0 failed\n"]);
    assert_eq!(folder.entries("kept"), ["x", "y"]);
    assert_eq!(folder.entries("kept/x"), ["a.obj"]);
}

#[test]
fn a_recipe_has_the_digest_that_a_run_prints() {
    let folder = Folder::with_recipe(GOOD);
    let run = folder.run("run recipe.ron").with_code(0);
    let digest = format!("digest {})\n", run.digest());
    folder
        .run("test recipe.ron")
        .with_code(0)
        .prints(&[&digest]);
}

#[test]
fn no_recipes_to_test_is_an_error() {
    let folder = Folder::new().with("empty/notes.txt", "");
    folder
        .run("test empty")
        .with_code(1)
        .complains(&["error: found no recipes (*.ron) to test\n"]);
    folder
        .run("test nowhere")
        .with_code(1)
        .complains(&["error: the file or folder nowhere does not exist\n"]);
}

#[test]
fn recorded_values_are_updated_in_place() {
    let recipe = "(\r\n  recipe: 1, // äöü\r\n  steps: [Cube(name: \"a\")],\r\n  expect: [\r\n    \
        Faces(eq: 1_200), // many\r\n    Area( eq: 3.5 ), Digest(\"?\"),\r\n    Edges(max: 2),\r\n  ],\r\n)";
    let folder = Folder::new().with("a.ron", recipe).with("b.ron", GOOD);
    folder
        .run("test a.ron b.ron --update")
        .with_code(1)
        .prints(&[
            "a.ron:5: Faces(eq: 1_200) -> 6\n",
            "a.ron:6: Area(eq: 3.5) -> 24.0\n",
            "a.ron:6: Digest(\"?\") -> \"",
            "FAILED a.ron",
            "ok     b.ron",
        ])
        .complains(&["expected at most 2 edges, found 12", "only recorded values"]);
    let text = String::from_utf8(folder.read("a.ron")).unwrap();
    let digest = text
        .split("Digest(\"")
        .nth(1)
        .unwrap()
        .split('"')
        .next()
        .unwrap();
    let expected = recipe
        .replace("1_200", "6")
        .replace("3.5", "24.0")
        .replace('?', digest);
    assert_eq!(text, expected);
    assert_eq!(folder.read("b.ron"), GOOD.as_bytes());

    // `--update` does not change limits such as `max`. After the limit is corrected by hand, `--update` changes
    // nothing.
    let fixed = text.replace("max: 2", "max: 12");
    let folder = Folder::new().with("a.ron", &fixed);
    for arguments in ["test a.ron", "test a.ron --update", "test a.ron"] {
        folder.run(arguments).with_code(0);
        assert_eq!(folder.read("a.ron"), fixed.as_bytes());
    }
    assert_eq!(folder.entries("."), ["a.ron"]);
}

#[cfg(unix)]
#[test]
fn an_updated_recipe_keeps_its_permissions_and_its_link() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = Folder::new().with("deep/a.ron", BAD);
    let path = folder.path("deep/a.ron");
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o640)).unwrap();
    symlink("deep/a.ron", folder.path("a.ron")).unwrap();
    folder.run("test a.ron --update").with_code(0);
    assert!(folder.path("a.ron").is_symlink());
    let mode = std::fs::metadata(&path).unwrap().permissions().mode();
    assert_eq!(mode & 0o777, 0o640);
    assert_eq!(
        folder.read("deep/a.ron"),
        BAD.replace("eq: 7", "eq: 6").as_bytes()
    );
}

#[test]
fn the_order_and_the_results_do_not_depend_on_threads() {
    let folder = (0..20).fold(Folder::new(), |folder, i| {
        let text = if i % 7 == 3 { BAD } else { GOOD };
        folder.with(&format!("scenes/{i:02}.ron"), text)
    });
    let made = |arguments: &str| {
        let ended = folder.run(&format!("test {arguments}")).with_code(1);
        let without_time = |line: &str| line.split(", ").filter(|p| !p.ends_with(" ms")).collect();
        let lines: Vec<String> = ended.stdout.lines().map(without_time).collect();
        (lines, ended.stderr)
    };
    let one = made("--threads 1");
    assert_eq!(one.0.len(), 21);
    assert_eq!(one.0[20], "17 passed3 failed");
    for arguments in ["--threads 2", "--threads 8", "--jobs 3 --threads 8"] {
        assert_eq!(made(arguments), one, "{arguments}");
    }
}

#[test]
fn folders_are_searched_except_assets_and_hidden_ones() {
    let folder = Folder::new()
        .with("scenes/b.ron", GOOD)
        .with("scenes/a/deep/er.ron", GOOD)
        .with("scenes/assets/part.ron", BAD)
        .with("scenes/a/assets/part.ron", BAD)
        .with("scenes/.git/x.ron", BAD)
        .with("scenes/.x.ron", BAD)
        .with("scenes/c.sweep.ron", "(sweep: 1)");
    let ended = folder.run("test scenes --out kept").with_code(0).prints(&[
        "ok     scenes/a/deep/er.ron (",
        "ok     scenes/b.ron (",
        "2 passed, 0 failed\n",
    ]);
    assert_eq!(ended.stdout.lines().count(), 3);
    // Recipes given by path are tested in any folder, and each recipe is tested only once.
    folder
        .run("test scenes/assets/part.ron scenes/b.ron scenes")
        .with_code(1)
        .prints(&["2 passed, 1 failed\n"]);
    assert_eq!(folder.entries("kept/a/deep/er"), ["a.obj"]);
    assert_eq!(folder.entries("kept"), ["a", "b"]);
}

#[test]
fn a_recipe_without_expectations_is_listed_but_not_passed() {
    let folder = Folder::new()
        .with("scenes/a.ron", GOOD)
        .with("scenes/part.ron", "(recipe: 1, steps: [Delete(objects: [\"of the caller\"])])")
        .with(
            "scenes/refused.ron",
            "(recipe: 1, steps: [Grid(name: \"a\", columns: 1, rows: 1), (run: FlipEdges(edges: Boundary), refused: Boundary)])",
        );
    folder.run("test").with_code(0).prints(&[
        "ok     scenes/a.ron (1 expectation, ",
        "-      scenes/part.ron (no expectations, not run)\n",
        "ok     scenes/refused.ron (0 expectations, ",
        "2 passed, 0 failed, 1 without expectations\n",
    ]);
    folder
        .run("test scenes/part.ron")
        .with_code(1)
        .prints(&["0 passed, 0 failed, 1 without expectations\n"])
        .complains(&["error: nothing was tested: "]);
}

#[test]
fn a_recipe_that_others_call_is_run_only_if_given_by_path() {
    let folder = Folder::new()
        .with("scenes/lib/smooth.ron", "(recipe: 1, steps: [LoopSubdivide(levels: 1)], expect: [Closed])")
        .with(
            "scenes/a.ron",
            "(recipe: 1, steps: [Tetrahedron(name: \"a\"), Call(recipe: \"lib/smooth.ron\")], expect: [Faces(eq: 16)])",
        );
    folder.run("test").with_code(0).prints(&[
        "ok     scenes/a.ron (",
        "-      scenes/lib/smooth.ron (called by other recipes, not run)\n",
        "1 passed, 0 failed, 1 called by other recipes\n",
    ]);
    folder
        .run("test scenes/lib/smooth.ron")
        .with_code(1)
        .prints(&["FAILED scenes/lib/smooth.ron", "0 passed, 1 failed\n"]);
}

#[test]
fn a_called_recipe_is_run_if_the_filter_leaves_out_its_callers() {
    let folder = Folder::new().with("scenes/lib/part.ron", GOOD).with(
        "scenes/caller.ron",
        "(recipe: 1, steps: [Call(recipe: \"lib/part.ron\")], expect: [Manifold])",
    );
    folder.run("test").with_code(0).prints(&[
        "-      scenes/lib/part.ron (called by other recipes, not run)\n",
        "1 passed, 0 failed, 1 called by other recipes\n",
    ]);
    folder.run("test --filter part").with_code(0).prints(&[
        "ok     scenes/lib/part.ron (1 expectation, ",
        "1 passed, 0 failed\n",
    ]);
    folder
        .run("test --filter r")
        .with_code(0)
        .prints(&["1 passed, 0 failed, 1 called by other recipes\n"]);
}

#[test]
fn a_filter_selects_by_path() {
    let folder = Folder::new()
        .with("scenes/cube.ron", GOOD)
        .with("scenes/more/cube_flip.ron", GOOD)
        .with("scenes/torus.ron", BAD);
    folder
        .run("test --filter cube")
        .with_code(0)
        .prints(&["2 passed, 0 failed\n"]);
    folder
        .run("test --filter cuboid")
        .with_code(1)
        .complains(&["error: found 3 recipes, but none has \"cuboid\" in its path\n"]);
}

#[test]
fn two_recipes_that_would_keep_outputs_in_one_folder_are_refused() {
    let folder = Folder::new().with("a/x.ron", GOOD).with("b/x.ron", GOOD);
    folder
        .run("test a b --out kept")
        .with_code(1)
        .complains(&["a/x.ron and b/x.ron would both write to the folder kept/x"]);
    folder.run("test a b").with_code(0);
}

#[test]
fn json_results_are_one_object() {
    let folder = Folder::new()
        .with("scenes/a.ron", GOOD)
        .with("scenes/b.ron", BAD)
        .with("scenes/c.ron", b"\xff")
        .with("scenes/d.ron", "(recipe: 1, steps: [Cube(name: \"a\")])");
    let json = folder.run("test --format json").with_code(1).json();
    assert_eq!(json["succeeded"], false);
    assert_eq!(json["passed"], 1);
    assert_eq!(json["failed"], 2);
    assert_eq!(json["no_expectations"], 1);
    let recipes = json["recipes"].as_array().unwrap();
    let states: Vec<&str> = recipes
        .iter()
        .map(|r| r["state"].as_str().unwrap())
        .collect();
    assert_eq!(states, ["passed", "failed", "failed", "no expectations"]);
    assert_eq!(
        recipes[1]["failures"][0]["message"],
        "expected 7 faces, found 6"
    );
    assert_eq!(recipes[1]["failures"][0]["line"], 1);
    let message = recipes[2]["failures"][0]["message"].as_str().unwrap();
    assert!(message.contains("not UTF-8"), "{message}");
    assert_eq!(recipes[0]["digest"].as_str().unwrap().len(), 32);
}

#[test]
fn junit_xml_is_well_formed_for_any_name_and_has_the_full_failure() {
    let mut folder = Folder::new()
        .with("scenes/a & b <c>.ron", GOOD)
        .with("scenes/b.ron", BAD)
        .with("scenes/d.ron", "(recipe: 1, steps: [Cube(name: \"a\")])");
    let mut failed = 1;
    if cfg!(unix) {
        folder = folder.with(
            "scenes/new\nline \"quoted\" \u{1}.ron",
            BAD.replace("a.obj", "]]>.obj"),
        );
        failed += 1;
    }
    folder.run("test --junit deep/tests.xml").with_code(1);
    let text = String::from_utf8(folder.read("deep/tests.xml")).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap_or_else(|e| panic!("{e}: {text}"));
    let suite = document
        .descendants()
        .find(|n| n.has_tag_name("testsuite"))
        .unwrap();
    let attribute = |name: &str| suite.attribute(name).unwrap().parse::<usize>().unwrap();
    assert_eq!(attribute("tests"), 2 + failed);
    assert_eq!(attribute("failures"), failed);
    let cases: Vec<_> = document
        .descendants()
        .filter(|n| n.has_tag_name("testcase"))
        .collect();
    assert_eq!(cases[0].attribute("name"), Some("scenes/a & b <c>.ron"));
    let failure = cases[1]
        .children()
        .find(|n| n.has_tag_name("failure"))
        .unwrap();
    assert_eq!(
        failure.attribute("message"),
        Some("expected 7 faces, found 6")
    );
    let description = failure.text().unwrap();
    assert!(description.contains("scenes/b.ron:1:"), "{description}");
    assert!(description.contains("^^^^"), "{description}");
}
