//! `test`: recipes as tests.

use crate::folder::Folder;

const GOOD: &str =
    "(recipe: 1, steps: [Cube(name: \"a\"), Save(path: \"a.obj\")], expect: [Faces(eq: 6)])";
const BAD: &str =
    "(recipe: 1, steps: [Cube(name: \"a\"), Save(path: \"a.obj\")], expect: [Faces(eq: 7)])";

#[test]
fn each_recipe_is_a_line_and_one_that_fails_fails_all() {
    let folder = Folder::new()
        .with("scenes/b_good.ron", GOOD)
        .with("scenes/a_bad.ron", BAD)
        .with("scenes/notes.txt", "no recipe");
    folder
        .run("test scenes")
        .with_code(1)
        .prints(&[
            "FAILED scenes/a_bad.ron (1 expectations, ",
            "ok     scenes/b_good.ron (1 expectations, ",
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
fn recipes_that_cannot_be_read_have_failed() {
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
fn outputs_are_kept_in_a_folder_for_each_recipe_if_asked_for() {
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
fn nothing_to_test_is_an_error() {
    let folder = Folder::new().with("empty/notes.txt", "");
    folder
        .run("test empty")
        .with_code(1)
        .complains(&["error: there are no recipes (*.ron) to test\n"]);
    folder
        .run("test nowhere")
        .with_code(1)
        .complains(&["error: there is no file or folder nowhere\n"]);
}
