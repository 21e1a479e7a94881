//! `check` reports errors that would make a run fail. It also lists the losses that are known before the files are read
//! completely.

use crate::folder::Folder;

const SQUARE: &str = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\n";

/// Checks that `check` reports these errors of a recipe, and no others.
#[track_caller]
fn refuses(folder: &Folder, steps: &str, errors: &[&str]) {
    let text = format!("(recipe: 1, steps: [{steps}])");
    let ended = folder.run_with("check -", &text).with_code(1);
    assert_eq!(
        ended.stderr.matches("error: ").count(),
        errors.len(),
        "{ended:#?}"
    );
    ended.complains(errors);
}

#[track_caller]
fn accepts(folder: &Folder, steps: &str) {
    let text = format!("(recipe: 1, steps: [{steps}])");
    folder.run_with("run -", &text).with_code(0);
}

#[test]
fn numbers_of_elements_that_do_not_exist() {
    let folder = Folder::new();
    let edge = "vertex 99 does not exist: the mesh has 8 vertices";
    refuses(
        &folder,
        "Cube(), SplitEdges(edges: Between(0, 99))",
        &[edge],
    );
    refuses(
        &folder,
        "Cube(), PokeFaces(faces: Not(Faces([2, 6])))",
        &["face 6 does not exist: the mesh has 6 faces"],
    );
    refuses(
        &folder,
        "Cube(), BevelEdges(edges: Or([EdgesAround(Vertices([9])), Path(from: 0, to: 8)]), fraction: 0.1)",
        &["vertex 9 does not exist", "vertex 8 does not exist"],
    );
    refuses(
        &folder,
        "Cube(), Picture(path: \"a.png\", highlight: Faces([6]))",
        &["face 6 does not exist"],
    );
    // If several meshes have no face 6, the error message is about the first of these meshes. `on:` chooses the meshes
    // that are checked.
    let two = "Cube(), Torus(name: \"t\")";
    refuses(
        &folder,
        &format!("{two}, PokeFaces(faces: Faces([6]))"),
        &["face 6 does not exist: the mesh has 6 faces"],
    );
    accepts(
        &folder,
        &format!("{two}, (run: PokeFaces(faces: Faces([6])), on: [\"t\"])"),
    );
    // The face 23 exists, because the first `PokeFaces` creates it.
    accepts(
        &folder,
        "Cube(), PokeFaces(), PokeFaces(faces: Faces([23]))",
    );
    accepts(
        &folder,
        "Cube(), (run: PokeFaces(faces: Faces([6])), refused: Missing)",
    );
}

#[test]
fn names_of_materials_that_do_not_exist() {
    let folder = Folder::new()
        .with("a.mtl", "newmtl red\nnewmtl blue\n")
        .with(
            "a.obj",
            format!("mtllib a.mtl\n{SQUARE}usemtl red\nf 1 2 3 4\n"),
        )
        .with("plain.obj", format!("{SQUARE}f 1 2 3 4\n"));
    let select = |file: &str, name: &str| {
        format!("Load(path: \"{file}\"), PokeFaces(faces: Material(\"{name}\"))")
    };
    accepts(&folder, &select("a.obj", "red"));
    accepts(&folder, &select("a.obj", "blue"));
    refuses(
        &folder,
        &select("a.obj", "rde"),
        &["\"a\" has no material named \"rde\""],
    );
    refuses(
        &folder,
        &select("plain.obj", "red"),
        &["\"plain\" has no material named \"red\""],
    );
    refuses(
        &folder,
        "Cube(), PokeFaces(faces: Material(\"red\"))",
        &["\"cube\" has no material named \"red\""],
    );
    let joined =
        "Load(path: \"a.obj\"), Cube(), Join(objects: [\"a\", \"cube\"], name: \"both\"), ";
    accepts(
        &folder,
        &format!("{joined} PokeFaces(faces: Material(\"blue\"))"),
    );
}

#[test]
fn losses_that_a_file_shows_are_listed_and_can_be_errors() {
    let folder = Folder::new().with(
        "a.obj",
        format!("mtllib no.mtl\n{SQUARE}vp 1\nf 1 2 3 4\nl 1 2\n"),
    );
    let text = "(recipe: 1, steps: [Load(path: \"a.obj\")])";
    folder.run_with("check -", text).with_code(0).prints(&[
        "a.obj:6: 1 statement `vp` left out",
        "1 polyline (`l`) left out",
        "material library `no.mtl` left out",
    ]);
    let text = "(recipe: 1, steps: [(run: Load(path: \"a.obj\"), on_loss: Error)])";
    folder
        .run_with("check -", text)
        .with_code(1)
        .complains(&["`on_loss` does not allow it"]);
}

#[test]
fn content_that_strict_loading_refuses() {
    let folder = Folder::new()
        .with("vp.obj", format!("{SQUARE}vp 1\nf 1 2 3 4\n"))
        .with(
            "image.obj",
            format!("mtllib a.mtl\n{SQUARE}usemtl m\nf 1 2 3 4\n"),
        )
        .with("a.mtl", "newmtl m\nmap_Kd none.png\n");
    for (file, what) in [
        ("vp.obj", "1 statement `vp` left out"),
        ("image.obj", "none.png"),
    ] {
        let load = format!("Load(path: \"{file}\", strict: true)");
        refuses(&folder, &load, &[what]);
    }
}

#[test]
fn objects_that_a_format_cannot_store() {
    let folder = Folder::new().with("a.bez", format!("1\n{}", "0 0 0\n".repeat(16)));
    refuses(
        &folder,
        "Cube(), Save(path: \"a.bez\")",
        &["object `cube`: a .bez file stores Bezier patches, found mesh"],
    );
    refuses(
        &folder,
        "Cube(), Save(path: \"a.bzc\")",
        &["object `cube`: a .bzc file stores a curve, found mesh"],
    );
    refuses(
        &folder,
        "Load(path: \"a.bez\"), Save(path: \"b.obj\")",
        &["object `a`: OBJ files store meshes and polylines, found patches"],
    );
}

#[test]
fn attributes_that_files_and_other_objects_do_not_have() {
    let folder = Folder::new().with("a.obj", format!("{SQUARE}f 1 2 3 4\n"));
    let load = "Load(path: \"a.obj\")";
    refuses(
        &folder,
        &format!("{load}, PackUvs()"),
        &["no texture coordinates"],
    );
    refuses(
        &folder,
        &format!("{load}, PokeFaces(faces: Tagged(\"t\"))"),
        &["no element of \"a\" is tagged \"t\""],
    );
    refuses(
        &folder,
        "Cube(), Torus(), Transfer(from: \"cube\", attributes: [\"uv\"])",
        &["\"cube\" has no attribute \"uv\"; its attributes: none"],
    );
}

#[test]
fn counts_and_budgets_that_a_file_exceeds() {
    let folder = Folder::new().with("a.obj", format!("{SQUARE}f 1 2 3\nf 1 3 4\n"));
    let levels =
        |n: u32| format!("(recipe: 1, steps: [Load(path: \"a.obj\"), LoopSubdivide(levels: {n})])");
    folder
        .run_with("check - --budget 1MiB", levels(4))
        .with_code(0);
    for n in [9, 10] {
        let ended = folder.run_with("check - --budget 1MiB", levels(n));
        ended.with_code(1).complains(&["budget"]);
    }
    refuses(
        &folder,
        "Load(path: \"a.obj\"), CatmullClark(), LoopSubdivide()",
        &["LoopSubdivide needs triangles"],
    );
}

#[test]
fn losses_of_saving_are_listed_before_the_run() {
    let steps = "Cube(), Crease(edges: All, sharpness: 1), VertexNormals(), Torus()";
    let text = format!("(recipe: 1, steps: [{steps}, Save(path: \"a.stl\")])");
    let folder = Folder::new();
    folder.run_with("check -", &text).with_code(0).prints(&[
        "\"cube\" lost polygons",
        "\"cube\" lost the edge attribute \"crease\": STL cannot store it",
        "\"cube\" lost the vertex attribute \"normal\": STL cannot store it",
        "\"cube\" may lose digits of positions",
    ]);
    let ended = folder.run_with("check - --format json", &text).with_code(0);
    let json: serde_json::Value = serde_json::from_str(&ended.stdout).unwrap();
    let losses = json["forecast"][4]["losses"].as_array().unwrap();
    let codes: Vec<&str> = losses
        .iter()
        .filter_map(|loss| loss["code"].as_str())
        .collect();
    assert_eq!(
        codes,
        [
            "name-lost",
            "polygon-lost",
            "attribute-lost",
            "attribute-lost",
            "polygon-lost"
        ],
        "{json:#}"
    );
}

#[test]
fn strict_makes_losses_errors_unless_the_recipe_allows_them() {
    let recipe = |more: &str| {
        format!(
            "(recipe: 1, {more} steps: [Cube(), Save(path: \"a.glb\")], expect: [Faces(eq: 6)])"
        )
    };
    let folder = Folder::new()
        .with("warn.ron", recipe(""))
        .with("allow.ron", recipe("on_loss: Allow([\"polygon\"]),"));
    for command in ["run", "check", "test"] {
        folder.run(&format!("{command} warn.ron")).with_code(0);
        folder
            .run(&format!("{command} warn.ron --strict"))
            .with_code(1);
        folder
            .run(&format!("{command} allow.ron --strict"))
            .with_code(0);
    }
    folder
        .run("check warn.ron --strict")
        .complains(&["Save loses polygons of \"cube\", and `on_loss` does not allow it"]);
}
