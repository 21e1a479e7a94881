//! A file of the wrong kind, a selection of the wrong kind, and names in a different letter case.

use crate::folder::Folder;

const RECIPE: &str = r#"(recipe: 1, params: { "n": Int(default: 2) }, steps: [
    Cube(name: "box"), (id: "cut", run: Triangulate()), Save(path: "box.obj"),
])"#;

const SWEEP: &str = r#"(sweep: 1, recipe: "recipe.ron", over: { "n": [1, 2] }, keep: [Faces])"#;

#[test]
fn the_error_for_a_file_of_the_wrong_kind_names_the_commands_for_it() {
    let folder = Folder::with_recipe(RECIPE)
        .with("levels.ron", SWEEP)
        .with("README.md", "# Models\n\nThis folder contains models.\n")
        .with("a b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let is_mesh = "a b.obj is a mesh file, expected a recipe: use `meshwright info 'a b.obj'`";
    let is_sweep = "levels.ron is a sweep, expected a recipe: use `meshwright sweep levels.ron`";
    let is_recipe = "recipe.ron is a recipe, expected a mesh file: use `meshwright run recipe.ron`";
    for (arguments, message) in [
        (&["run", "a b.obj"][..], is_mesh),
        (&["check", "a b.obj"], is_mesh),
        (&["watch", "a b.obj"], is_mesh),
        (&["test", "a b.obj"], is_mesh),
        (&["shrink", "a b.obj"], is_mesh),
        (&["upgrade", "a b.obj"], is_mesh),
        (&["batch", "a b.obj", "--inputs", "*.obj"], is_mesh),
        (&["run", "levels.ron"], is_sweep),
        (&["check", "levels.ron"], is_sweep),
        (&["test", "levels.ron"], is_sweep),
        (&["picture", "levels.ron"], is_sweep),
        (&["info", "recipe.ron"], is_recipe),
        (&["convert", "recipe.ron", "a.obj"], is_recipe),
        (&["reproduce", "recipe.ron"], is_recipe),
        (
            &["info", "levels.ron"],
            "levels.ron is a sweep, expected a mesh file: use `meshwright sweep levels.ron`",
        ),
        (
            &["sweep", "recipe.ron"],
            "recipe.ron is a recipe, expected a sweep: use `meshwright run recipe.ron`",
        ),
        (
            &["sweep", "a b.obj"],
            "a b.obj is a mesh file, expected a sweep",
        ),
        (
            &["run", "README.md"],
            "README.md is not a recipe: expected a .ron file, which begins with `(`",
        ),
        (
            &["sweep", "README.md"],
            "README.md is not a sweep: expected a .ron file, which begins with `(`",
        ),
        (&["info", "."], ". is a folder, expected a mesh file"),
        (&["run", "."], ". is a folder, expected a recipe"),
    ] {
        folder.run_all(arguments).with_code(2).complains(&[message]);
    }
    // Missing files are reported as missing.
    folder
        .run("run missing.obj")
        .with_code(1)
        .complains(&["cannot read missing.obj: No such file"]);
    assert_eq!(
        folder.entries("."),
        ["README.md", "a b.obj", "levels.ron", "recipe.ron"]
    );
}

#[test]
fn a_selection_of_the_wrong_kind_gets_the_selection_that_converts_it() {
    for (step, help) in [
        ("FlipEdges(edges: Faces([0]))", "write `EdgesOf(Faces(..))`"),
        (
            "FlipEdges(edges: Not(Isolated))",
            "write `EdgesAround(Isolated(..))` or `EdgesWithin(Isolated(..))`",
        ),
        (
            "PokeFaces(faces: Sharp(above: 30))",
            "write `FacesBeside(Sharp(..))`",
        ),
        (
            "PokeFaces(faces: Vertices([1]))",
            "write `FacesAround(Vertices(..))`",
        ),
        (
            "TagVertices(name: \"a\", vertices: Between(0, 1))",
            "write `EndsOf(Between(..))`",
        ),
        (
            "TagVertices(name: \"a\", vertices: Degree(4))",
            "write `CornersOf(Degree(..))`",
        ),
    ] {
        let text = format!("(recipe: 1, steps: [Cube(name: \"a\"), {step}])");
        Folder::with_recipe(&text)
            .run("check recipe.ron")
            .with_code(1)
            .complains(&["` selects ", ", expected a selection of ", help]);
    }
}

#[test]
fn names_of_values_can_be_written_in_any_case() {
    let choice = r#"(recipe: 1, params: { "how": Choice(default: "Flat", of: ["Flat", "Smooth"]) },
        steps: [Cube(name: "a"), Picture(path: "a.png", style: (shading: arg("how")), size: (8, 8))])"#;
    let folder = Folder::with_recipe(RECIPE)
        .with("choice.ron", choice)
        .with("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for arguments in [
        "info a.obj --orientation keep --duplicates DROP",
        "info a.obj --format JSON",
        "select a.obj All --of Faces",
        "run choice.ron --set how=smooth",
        "picture a.obj --from front --shading flat --color-by valence --size 8x8",
    ] {
        folder.run(arguments).with_code(0);
    }
    folder
        .run("info a.obj --orientation kep")
        .with_code(2)
        .complains(&["expected `Orient` or `Keep`"]);
}
