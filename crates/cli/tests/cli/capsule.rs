//! Capsules (small recipes that reproduce a failure), and the command `shrink`.

use crate::folder::Folder;

/// Deletes a face of a torus, and then tries to flip boundary edges. The flips are refused.
const FAILS: &str = r#"(recipe: 1,
    params: {"n": Int(default: 12), "part": Path(default: "part.obj")},
    steps: [
        Torus(name: "a", around: arg("n"), across: 9),
        Triangulate(),
        DeleteFaces(faces: Faces([17])),
        Repeat(times: 2, steps: [
            (id: "flip", run: FlipEdges(edges: And([Boundary, Not(Random(count: 1, seed: 3))])), on: ["a"]),
        ]),
        Load(path: arg("part")),
        Save(path: "a.obj"),
    ])"#;

fn folder() -> Folder {
    Folder::new()
        .with("scenes/r.ron", FAILS)
        .with("scenes/part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
}

/// Returns the first line of an error message. The location of the error is on later lines.
fn first_line(stderr: &str) -> &str {
    stderr.lines().next().unwrap_or_default()
}

#[test]
fn a_capsule_fails_as_the_recipe_did() {
    let folder = folder();
    let failed = folder
        .run("run scenes/r.ron --capsule deep/capsule")
        .with_code(1)
        .complains(&["boundary", "meshwright run deep/capsule/recipe.ron"]);
    assert_eq!(folder.entries("deep/capsule"), ["before.mws", "recipe.ron"]);
    let text = String::from_utf8(folder.read("deep/capsule/recipe.ron")).unwrap();
    for part in ["flip#1", "flip#2", "../../scenes/part.obj", "before.mws"] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let again = folder.run("run deep/capsule/recipe.ron").with_code(1);
    assert_eq!(first_line(&again.stderr), first_line(&failed.stderr));
    assert!(folder.entries("out").is_empty(), "no files are written");
}

#[test]
fn no_capsule_is_written_if_no_step_fails() {
    let folder = Folder::with_recipe("(recipe: 1, steps: [Cube(name: \"a\")])");
    folder.run("run recipe.ron --capsule c").with_code(0);
    assert!(folder.entries("c").is_empty());
    folder
        .run("shrink recipe.ron")
        .with_code(1)
        .complains(&["no step of recipe.ron fails"]);
}

#[test]
fn a_shrunk_scene_still_fails() {
    let folder = folder();
    folder
        .run("shrink scenes/r.ron --out small")
        .with_code(0)
        .prints(&[
            "flip#1: ",
            "reduced from 215 to ",
            "meshwright run small/recipe.ron",
        ]);
    folder
        .run("run small/recipe.ron")
        .with_code(1)
        .complains(&["boundary"]);
    let facts = folder.run("info small/before.mws --format json").json();
    assert!(
        facts["objects"][0]["faces"].as_u64().unwrap() <= 2,
        "{facts}"
    );
}
