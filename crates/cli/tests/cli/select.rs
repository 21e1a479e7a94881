//! `select`: the elements that a selection matches.

use serde_json::json;

use crate::folder::Folder;

const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

const RECIPE: &str = r#"(
    recipe: 1,
    params: { "name": Text(default: "cube") },
    presets: { "crate": { "name": "crate" } },
    steps: [
        (id: "make", run: Cube(name: arg("name"))),
        (id: "tag", run: TagFaces(name: "top", faces: Faces([1]))),
        (id: "poke", run: PokeFaces(faces: Tagged("top"))),
        Save(path: "cube.obj"),
    ],
    expect: [Faces(eq: 99)],
)"#;

fn cube() -> Folder {
    Folder::new().with("cube.obj", CUBE)
}

#[test]
fn edges_are_shown_in_the_syntax_of_recipes() {
    let ended = cube()
        .run_all(&["select", "cube.obj", "Sharp(above: 30)"])
        .with_code(0)
        .prints(&["12 of 12 edges\n", "  Between(", ")\n"]);
    assert_eq!(ended.stdout.lines().count(), 13);
    // Each printed line is a valid selection.
    let line = ended.stdout.lines().nth(1).unwrap().trim();
    cube()
        .run_all(&["select", "cube.obj", line])
        .with_code(0)
        .prints(&["1 of 12 edges\n", line]);
}

#[test]
fn vertices_have_positions_and_faces_their_vertices() {
    cube()
        .run_all(&["select", "cube.obj", "Vertices([6, 1])"])
        .with_code(0)
        .prints(&["2 of 8 vertices\n  1  (1, 0, 0)\n  6  (1, 1, 1)\n"]);
    cube()
        .run_all(&["select", "cube.obj", "Degree(4)", "--first", "2"])
        .with_code(0)
        .prints(&[
            "6 of 6 faces\n  0  of 3 2 1 0\n  1  of 4 5 6 7\n  and 4 more: --all shows them\n",
        ]);
    cube()
        .run_all(&["select", "cube.obj", "Degree(4)", "--all", "--first", "2"])
        .with_code(0)
        .prints(&["  5  of 3 0 4 7\n"]);
}

#[test]
fn a_selection_valid_for_several_kinds_needs_a_kind() {
    let folder = cube();
    folder
        .run_all(&["select", "cube.obj", "All"])
        .with_code(2)
        .complains(&[
            "this selection can select vertices or edges or faces: specify which",
            "write `Vertices(All)` or `Edges(All)` or `Faces(All)`",
        ]);
    let ended = folder
        .run_all(&["select", "cube.obj", "All", "--of", "edges", "--count"])
        .with_code(0);
    assert_eq!(ended.stdout, "12\n");
}

#[test]
fn an_invalid_selection_is_shown_with_its_place_and_help() {
    let folder = cube();
    folder
        .run_all(&["select", "cube.obj", "Shrp(above: 30)"])
        .with_code(2)
        .complains(&["unknown selection `Shrp`", "^^^^", "did you mean `Sharp`?"]);
    folder
        .run_all(&["select", "cube.obj", "Sharp(above: 300)"])
        .with_code(2)
        .complains(&["`above` is 300, expected at most 180"]);
    folder
        .run_all(&["select", "cube.obj", "Sharp(above: 30"])
        .with_code(2)
        .complains(&["selection:1:"]);
    folder
        .run_all(&["select", "cube.obj", "Vertices([8])"])
        .with_code(1)
        .complains(&["vertex 8 does not exist: the mesh has 8 vertices"]);
    folder
        .run_all(&["select", "cube.obj", "Tagged(\"nose\")", "--of", "faces"])
        .with_code(1)
        .complains(&["no faces are tagged \"nose\""]);
    folder
        .run_all(&["select", "cube.obj", "Degree(4)", "--on", "cub"])
        .with_code(2)
        .complains(&["unknown object \"cub\": did you mean `cube`?"]);
    folder
        .run_all(&["select", "cube.obj", "Degree(4)", "--after", "x"])
        .with_code(2)
        .complains(&["cube.obj is not a recipe"]);
}

#[test]
fn a_recipe_runs_up_to_the_given_step_and_writes_no_files() {
    let folder = Folder::with_recipe(RECIPE);
    let count = |more: &[&str]| {
        let mut arguments = vec!["select", "recipe.ron", "All", "--of", "faces", "--count"];
        arguments.extend(more);
        folder.run_all(&arguments).with_code(0).stdout
    };
    assert_eq!(count(&[]), "9\n");
    assert_eq!(count(&["--after", "poke"]), "9\n");
    assert_eq!(count(&["--before", "poke"]), "6\n");
    folder
        .run_all(&["select", "recipe.ron", "Tagged(\"top\")", "--of", "faces"])
        .with_code(0)
        .prints(&["cube: 4 of 9 faces\n"]);
    folder
        .run_all(&["select", "recipe.ron", "Degree(4)", "--set", "name=box"])
        .with_code(0)
        .prints(&["box: 5 of 9 faces\n"]);
    folder
        .run_all(&["select", "recipe.ron", "Degree(4)", "--preset", "crate"])
        .with_code(0)
        .prints(&["crate: 5 of 9 faces\n"]);
    folder
        .run_all(&["select", "recipe.ron", "Degree(4)", "--after", "pok"])
        .with_code(2)
        .complains(&["no step of recipe.ron has the id \"pok\": did you mean `poke`?"]);
    assert_eq!(folder.entries("."), ["recipe.ron"]);
}

#[test]
fn a_call_is_named_by_its_id_or_its_recipe() {
    let part = RECIPE.replace("Save(path: \"cube.obj\"),", "");
    let folder = Folder::new().with("recipe.ron", &part).with(
        "twice.ron",
        r#"(recipe: 1, steps: [
            (id: "first", run: Call(recipe: "recipe.ron")),
            Call(recipe: "recipe.ron", with: {"name": "other"}),
        ])"#,
    );
    let count = |at: [&str; 2]| {
        let arguments = [&["select", "twice.ron", "All", "--of", "faces"][..], &at].concat();
        folder.run_all(&arguments).with_code(0).stdout
    };
    assert!(count(["--before", "recipe"]).starts_with("cube: 9 of 9 faces"));
    assert_eq!(count(["--after", "first"]), count(["--before", "recipe"]));
    assert!(count(["--after", "recipe"]).contains("other: 9 of 9 faces"));
}

#[test]
fn a_mesh_file_has_no_parameters() {
    for more in [["--set", "name=box"], ["--preset", "crate"]] {
        let arguments = [&["select", "cube.obj", "Degree(4)"][..], &more].concat();
        cube()
            .run_all(&arguments)
            .with_code(2)
            .complains(&["cube.obj is not a recipe (*.ron), so it has no steps and no parameters"]);
    }
}

#[test]
fn json_has_all_elements() {
    let json = cube()
        .run_all(&[
            "select",
            "cube.obj",
            "Sharp(above: 30)",
            "--first",
            "1",
            "--format",
            "json",
        ])
        .with_code(0)
        .json();
    assert_eq!((&json["of"], &json["count"]), (&json!("edges"), &json!(12)));
    let elements = json["objects"][0]["elements"].as_array().unwrap();
    assert_eq!(elements.len(), 12);
    assert_eq!(elements[0]["vertices"].as_array().unwrap().len(), 2);
}
