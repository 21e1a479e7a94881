//! `new` writes recipes that can be run as they are.

use std::path::Path;

use crate::folder::Folder;

#[test]
fn a_new_recipe_runs() {
    let folder = Folder::new();
    let ended = folder.run("new part").with_code(0);
    assert_eq!(
        ended.stdout,
        "wrote part.ron\nnext: meshwright run part.ron\n"
    );
    folder
        .run("run part.ron")
        .with_code(0)
        .prints(&["wrote out/part.glb\n", "wrote out/part.png\n"]);

    let before = folder.read("part.ron");
    let again = folder.run("new part").with_code(1);
    assert_eq!(again.stderr, "error: part.ron already exists\n");
    assert_eq!(folder.read("part.ron"), before);
}

#[test]
fn a_new_recipe_loads_a_model() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/assets");
    for model in ["bunny.obj", "wavy.bez"] {
        let folder = Folder::new().with(model, std::fs::read(scenes.join(model)).unwrap());
        let recipe = Path::new(model).with_extension("ron");
        folder.run(&format!("new {model}")).with_code(0);
        let run = format!("run {}", recipe.display());
        folder.run(&run).with_code(0).prints(&["1 Load "]);
    }
}

#[test]
fn a_recipe_for_a_missing_model_is_not_written() {
    let folder = Folder::new();
    let ended = folder.run("new lost.obj").with_code(1);
    assert_eq!(ended.stderr, "error: the file lost.obj does not exist\n");
    folder.run("new curve.bzc").with_code(1);
    assert!(folder.entries(".").is_empty());
}
