//! `check` refuses what a run must refuse, and lists the losses that are known before the files are read completely.

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
    // If several meshes lack the element, the first of these meshes is reported. `on:` chooses the meshes that are
    // checked.
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
    // Elements that an earlier step creates are counted.
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
