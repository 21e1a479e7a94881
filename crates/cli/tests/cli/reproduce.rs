//! `meshwright reproduce`.

use crate::folder::Folder;

const RECIPE: &str = r#"(recipe: 1,
    params: {"input": Path(default: "a.obj"), "levels": Int(default: 1)},
    presets: {"fine": {"levels": 2}},
    steps: [
        Load(path: arg("input")),
        LoopSubdivide(levels: arg("levels")),
        Save(path: "{input.stem}.obj"), Save(path: "deep/a.glb"), Save(path: "a.gltf"), Save(path: "a.stl"),
        Save(path: "a.ply"), Save(path: "a.off"),
    ])"#;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

fn folder() -> Folder {
    Folder::new()
        .with("scenes/r.ron", RECIPE)
        .with("scenes/a.obj", TRIANGLE)
}

#[test]
fn every_output_of_a_run_is_reproduced() {
    let folder = folder();
    folder.run("run scenes/r.ron --preset fine").with_code(0);
    let files = "out/a.obj out/deep/a.glb out/a.gltf out/a.ply out/a.off";
    folder
        .run(&format!("reproduce {files}"))
        .with_code(0)
        .prints(&[
            "out/a.obj is reproduced by scenes/r.ron, digest ",
            "out/deep/a.glb is reproduced",
            "out/a.off is reproduced",
        ]);
    // An STL file has no room for the name of the preset. Therefore, `reproduce` runs the recipe without the preset,
    // and the result differs.
    folder.run("reproduce out/a.stl").with_code(1);
    folder.run("run scenes/r.ron").with_code(0);
    folder
        .run("reproduce out/a.stl --recipe scenes/r.ron")
        .with_code(0)
        .prints(&["out/a.stl is reproduced"]);
    folder.run("reproduce out/a.stl").with_code(0);
}

#[test]
fn parameters_that_were_set_are_set_again() {
    let folder = folder().with("other/b.obj", TRIANGLE);
    folder
        .run("run scenes/r.ron --set input=other/b.obj --set levels=3")
        .with_code(0);
    folder
        .run("reproduce out/b.obj")
        .with_code(0)
        .prints(&["out/b.obj is reproduced by scenes/r.ron"]);
}

#[test]
fn absolute_paths_are_not_recorded() {
    let folder = folder().with("other/b.obj", TRIANGLE);
    let root = folder.path("scenes").canonicalize().unwrap();
    let root = root.parent().unwrap().to_string_lossy().into_owned();
    folder
        .shell(&format!(
            "cd scenes && \"$0\" run r.ron --out ../out --set input={root}/other/b.obj"
        ))
        .with_code(0);
    for name in ["out/b.obj", "out/deep/a.glb", "out/a.ply", "out/a.off"] {
        let bytes = folder.read(name);
        let has = |text: &str| bytes.windows(text.len()).any(|w| w == text.as_bytes());
        assert!(has("\"b.obj\"") || has("\\\"b.obj\\\""), "{name}");
        assert!(!has(&root) && !has("other"), "{name}");
    }
    // A file in the recipe's folder is recorded by its relative path.
    folder
        .shell(&format!(
            "cd scenes && \"$0\" run r.ron --out ../out --set input={root}/scenes/a.obj"
        ))
        .with_code(0);
    folder.run("reproduce out/a.obj").with_code(0);
}

#[test]
fn changes_since_the_run_are_reported() {
    let folder = folder();
    folder.run("run scenes/r.ron").with_code(0);
    let folder = folder.with("scenes/a.obj", "v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.run("reproduce out/a.obj").with_code(1).complains(&[
        "out/a.obj is not reproduced by scenes/r.ron",
        "a.obj has changed",
    ]);
    let folder = folder.with("scenes/a.obj", TRIANGLE).with(
        "scenes/r.ron",
        RECIPE.replace("Int(default: 1)", "Int(default: 3)"),
    );
    folder
        .run("reproduce out/a.obj")
        .with_code(1)
        .complains(&["the first difference is at byte ", "the recipe has changed"]);
    let folder = folder.with("scenes/r.ron", RECIPE);
    let text = String::from_utf8(folder.read("out/a.obj")).unwrap();
    let folder = folder.with("out/a.obj", text.replacen("v ", "v 1", 1));
    folder
        .run("reproduce out/a.obj")
        .with_code(1)
        .complains(&["either the output file was modified or a step is not deterministic"]);
}

#[test]
fn a_file_without_provenance_needs_the_option_recipe() {
    let folder = folder();
    folder
        .run("reproduce scenes/a.obj")
        .with_code(1)
        .complains(&[
            "scenes/a.obj does not record which recipe wrote it",
            "--recipe",
        ]);
    folder.run("run scenes/r.ron").with_code(0);
    std::fs::remove_file(folder.path("scenes/r.ron")).unwrap();
    folder.run("reproduce out/a.obj").with_code(1).complains(&[
        "was written by the recipe r.ron, which was not found below the working directory",
        "--recipe",
    ]);
}
