//! `upgrade`: outdated names. The tests of the recipe library cover renamed operations.

use crate::folder::Folder;

const GOOD: &str = "(recipe: 1, steps: [Cube(name: \"a\")]) // stays\r\n";

#[test]
fn a_current_recipe_stays_unchanged() {
    let folder = Folder::new().with("x/a.ron", GOOD).with("x/b.ron", GOOD);
    for arguments in ["upgrade x", "upgrade x/a.ron x/b.ron --check"] {
        folder
            .run(arguments)
            .with_code(0)
            .prints(&["2 recipes, nothing to rewrite\n"]);
    }
    assert_eq!(folder.read("x/a.ron"), GOOD.as_bytes());
    assert_eq!(folder.entries("x"), ["a.ron", "b.ron"]);
}

#[test]
fn renamed_quantities_are_rewritten() {
    let old =
        "(recipe: 1, steps: [Cube(), Picture(path: \"a.png\", color_by: (of: SmallestAngle))])";
    let folder = Folder::new().with("a.ron", old);
    folder
        .run("check a.ron")
        .with_code(0)
        .complains(&["`SmallestAngle` was renamed to `MinAngle`"]);
    folder
        .run("upgrade a.ron")
        .with_code(0)
        .prints(&["a.ron:1: SmallestAngle -> MinAngle"]);
    let new = old.replace("SmallestAngle", "MinAngle");
    assert_eq!(folder.read("a.ron"), new.as_bytes());
}

#[test]
fn a_newer_recipe_is_refused_and_the_next_one_is_upgraded() {
    let folder = Folder::new()
        .with("a.ron", "(recipe: 7, steps: [])")
        .with("b.ron", GOOD);
    folder
        .run("upgrade a.ron b.ron")
        .with_code(1)
        .prints(&["2 recipes, nothing to rewrite\n"])
        .complains(&[
            "this recipe has the format version 7, expected 1",
            "a newer version of meshwright may be able to read the file",
            "error: a.ron cannot be upgraded\n",
        ]);
    folder.run("upgrade").with_code(2);
    folder
        .run("upgrade nowhere.ron")
        .with_code(1)
        .complains(&["the file or folder nowhere.ron does not exist"]);
}
