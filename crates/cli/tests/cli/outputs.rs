//! The expectation `Output`, which compares a written file with a reference file beside the recipe.

use std::fs::File;
use std::io::BufReader;

use crate::folder::{Folder, names};

const RECIPE: &str = r#"(
    recipe: 1,
    steps: [
        Grid(name: "sheet", columns: 3, rows: 1),
        Picture(path: "a/sheet.png", size: (40, 30)),
        Save(path: "sheet.obj"),
    ],
    expect: [
        Output(path: "a/sheet.png", as: "goldens/sheet.png"),
        Output(path: "sheet.obj", as: "goldens/flat.obj"),
    ],
)"#;

/// A folder with the recipe and its reference files.
fn recorded() -> Folder {
    let folder = Folder::with_recipe(RECIPE);
    folder.run("test recipe.ron --update").with_code(0);
    folder
}

/// Changes one pixel of a picture. The picture must have no alpha channel.
fn change_a_pixel(folder: &Folder, name: &str, place: usize, by: u8) {
    let file = BufReader::new(File::open(folder.path(name)).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    pixels[3 * place] ^= by;
    let file = File::create(folder.path(name)).unwrap();
    let mut encoder = png::Encoder::new(file, info.width, info.height);
    encoder.set_color(info.color_type);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&pixels).unwrap();
    writer.finish().unwrap();
}

#[test]
fn missing_reference_files_are_reported_and_written_by_update() {
    let folder = Folder::with_recipe(RECIPE);
    folder.run("check recipe.ron").with_code(0).complains(&[
        "goldens/sheet.png",
        "run `meshwright test --update` to create it",
    ]);
    for command in ["run recipe.ron", "test recipe.ron"] {
        folder.run(command).with_code(1).complains(&[
            "expected \"a/sheet.png\" to match goldens/sheet.png, which does not exist",
            "recipe.ron:9:9",
        ]);
    }
    assert!(!folder.path("out/sheet.obj").exists() && !folder.path("goldens").exists());
    folder.run("test recipe.ron --update").with_code(0).prints(&[
        "recipe.ron:9: Output(path: \"a/sheet.png\", as: \"goldens/sheet.png\") -> goldens/sheet.png is written\n",
        "ok     recipe.ron",
    ]);
    assert_eq!(folder.entries("goldens"), ["flat.obj", "sheet.png"]);
    assert_eq!(folder.read("recipe.ron"), RECIPE.as_bytes());

    // After the update, the expectations are met, with and without the cache. A second update rewrites no reference
    // file.
    for command in [
        "test recipe.ron",
        "test recipe.ron --no-cache",
        "run recipe.ron",
        "check recipe.ron",
    ] {
        folder.run(command).with_code(0);
    }
    let again = folder.run("test recipe.ron --update").with_code(0);
    assert!(!again.stdout.contains("->"), "{again:#?}");
    let (out, golden) = ("out/a/sheet.png", "goldens/sheet.png");
    assert_eq!(folder.read(out), folder.read(golden));
}

#[test]
fn one_different_pixel_fails_unless_tolerated() {
    let folder = recorded();
    change_a_pixel(&folder, "goldens/sheet.png", 41, 4);
    let message = "expected \"a/sheet.png\" to match goldens/sheet.png: 1 of 1200 pixels differs, by 4 of 255, at (1, 1)";
    // The message is the same if the result of the step that writes the picture is taken from the cache.
    for command in [
        "test recipe.ron",
        "test recipe.ron --no-cache",
        "run recipe.ron",
    ] {
        folder.run(command).with_code(1).complains(&[message]);
    }
    for (tolerance, code) in [(3, 1), (4, 0)] {
        let tolerance = format!("sheet.png\", tolerance: {tolerance}),");
        let tolerant = RECIPE.replace("sheet.png\"),", &tolerance);
        assert_ne!(tolerant, RECIPE);
        let files = ["goldens/sheet.png", "goldens/flat.obj"];
        let [png, obj] = files.map(|name| folder.read(name));
        let folder = Folder::with_recipe(&tolerant)
            .with(files[0], png)
            .with(files[1], obj);
        folder.run("test recipe.ron").with_code(code);
    }
    folder
        .run("test recipe.ron --update")
        .with_code(0)
        .prints(&["goldens/sheet.png is written"]);
    folder.run("test recipe.ron").with_code(0);
}

#[test]
fn provenance_is_not_compared_but_contents_are() {
    let recipe = r#"(
    recipe: 1,
    params: { "size": Float(default: 1) },
    steps: [
        Load(path: "a.bzc"),
        CurveFigure(path: "a.svg", t: [0.5]),
        Grid(name: "sheet", columns: 2, rows: 1, size: arg("size")),
        Save(path: "b.mws"),
        Picture(path: "c.gif", size: (16, 12), turntable: (frames: 2)),
    ],
    expect: [
        Output(path: "a.svg", as: "a.svg"),
        Output(path: "b.mws", as: "b.mws"),
        Output(path: "c.gif", as: "c.gif"),
    ],
)"#;
    let folder = Folder::with_recipe(recipe).with("a.bzc", "3\n0 0\n1 2\n2 0\n");
    folder.run("test recipe.ron --update").with_code(0);
    // The second run computes the same scene. However, its files record that the parameter `size` was set, so their
    // bytes differ from those of the first run.
    folder.run("run recipe.ron --set size=1").with_code(0);
    for name in ["a.svg", "b.mws", "c.gif"] {
        let out = folder.read(&format!("out/{name}"));
        assert!(out != folder.read(name), "{name}");
    }
    folder
        .run("run recipe.ron --set size=2")
        .with_code(1)
        .complains(&["expected \"b.mws\" to match b.mws: expected the objects in the file to have the digest"]);
    let folder = folder.with("a.bzc", "3\n0 0\n1 3\n2 0\n");
    folder
        .run("test recipe.ron")
        .with_code(1)
        .complains(&["expected \"a.svg\" to match a.svg: the first difference is at byte "]);
}

#[test]
fn a_mesh_that_needs_files_beside_it_is_not_recorded() {
    let folder = Folder::with_recipe(
        r#"(recipe: 1, steps: [Load(path: "m.obj"), Save(path: "a.obj")],
            expect: [Output(path: "a.obj", as: "golden.obj")])"#,
    )
    .with(
        "m.obj",
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n",
    )
    .with("m.mtl", "newmtl red\nKd 1 0 0\n");
    folder
        .run("test recipe.ron --update")
        .with_code(1)
        .complains(&[
            "the written file cannot be recorded because it depends on other files: write a .glb, .ply or .mws",
        ]);
    assert!(!folder.path("golden.obj").exists());
}

#[test]
fn paths_that_lead_out_and_files_that_no_step_writes_are_refused() {
    let picture = "path: \"a/sheet.png\", as: \"goldens/sheet.png\"";
    for (output, complaint) in [
        (
            "path: \"../sheet.png\", as: \"g.png\"",
            "must stay inside the output folder",
        ),
        (
            "path: \"a/sheet.png\", as: \"../g.png\"",
            "the path \"../g.png\" must stay inside the recipe's folder",
        ),
        (
            "path: \"a/sheet.png\", as: \"/g.png\"",
            "must stay inside the recipe's folder",
        ),
        ("path: \"a/sheet.png\", as: \"a/\"", "does not name a file"),
        ("path: \"a/sheet.png\", as: \"\"", "does not name a file"),
        (
            "path: \"a/shet.png\", as: \"g.png\"",
            "did you mean `a/sheet.png`?",
        ),
        (
            "path: \"sheet.obj\", as: \"g.obj\", tolerance: 3",
            "pictures",
        ),
        (
            "path: \"a/sheet.png\", as: \"g.png\", tolerance: 256",
            "expected at most 255",
        ),
    ] {
        let recipe = RECIPE.replace(picture, output);
        assert_ne!(recipe, RECIPE);
        let folder = Folder::with_recipe(&recipe);
        for command in ["check recipe.ron", "test recipe.ron --update"] {
            let ended = folder.run(command).with_code(1);
            assert!(ended.stderr.contains(complaint), "{output}: {ended:#?}");
        }
        assert_eq!(folder.entries("."), ["recipe.ron"]);
    }
    // Here, the expectation is checked after the step `grid`, which runs before the step that writes the picture.
    let grid = "Grid(name: \"sheet\", columns: 3, rows: 1)";
    let early = RECIPE
        .replace(grid, &format!("(id: \"grid\", run: {grid})"))
        .replace(
            &format!("Output({picture})"),
            &format!("(after: \"grid\", that: Output({picture}))"),
        );
    Folder::with_recipe(&early)
        .run("check recipe.ron")
        .with_code(1)
        .complains(&["no step writes \"a/sheet.png\" before this expectation is checked"]);
}

#[cfg(unix)]
#[test]
fn a_link_does_not_lead_out_of_the_folder_of_the_recipe() {
    let folder = Folder::with_recipe(RECIPE);
    let other = tempfile::tempdir().unwrap();
    std::os::unix::fs::symlink(other.path(), folder.path("goldens")).unwrap();
    folder
        .run("test recipe.ron --update")
        .with_code(1)
        .complains(&["leads out of the recipe's folder through a symbolic link"]);
    assert_eq!(names(other.path()), [""; 0]);
}

#[test]
fn an_output_can_be_expected_to_differ() {
    let picture = "Output(path: \"a/sheet.png\", as: \"goldens/sheet.png\")";
    let recipe = RECIPE.replace(picture, &format!("Not({picture})"));
    let folder = recorded();
    let same = folder.read("goldens/sheet.png");
    let folder = folder.with("recipe.ron", recipe);
    folder
        .run("test recipe.ron")
        .with_code(1)
        .complains(&["not to hold, but it does"]);
    change_a_pixel(&folder, "goldens/sheet.png", 0, 1);
    folder.run("test recipe.ron").with_code(0);
    // If the files cannot be compared, the expectation `Not(Output(..))` also fails.
    std::fs::remove_file(folder.path("goldens/sheet.png")).unwrap();
    folder
        .run("test recipe.ron --update")
        .with_code(1)
        .complains(&["which does not exist"]);
    let folder = folder.with("goldens/sheet.png", &same[..same.len() / 2]);
    folder
        .run("test recipe.ron")
        .with_code(1)
        .complains(&["cannot be read as a picture"]);
}

#[test]
fn a_batch_processes_files_again_if_a_reference_file_has_changed() {
    let recipe = r#"(
        recipe: 1,
        params: { "model": Path(default: "a.obj") },
        steps: [Load(path: arg("model")), Save(path: "{model.stem}.off")],
        expect: [Output(path: "{model.stem}.off", as: "golden.off")],
    )"#;
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let folder = Folder::with_recipe(recipe).with("a.obj", triangle);
    folder.run("test recipe.ron --update").with_code(0);
    let batch = "batch recipe.ron --inputs a.obj";
    folder.run(batch).with_code(0);
    let again = folder.run(batch).with_code(0);
    assert!(
        again.stdout.contains("finished in earlier runs"),
        "{again:#?}"
    );
    let other = String::from_utf8(folder.read("golden.off")).unwrap();
    let changed = other.replace("\n0 1 0", "\n0 2 0");
    assert_ne!(changed, other);
    let folder = folder.with("golden.off", changed);
    folder.run(batch).with_code(1).prints(&[
        "FAILED a.obj: expected",
        "to match golden.off: expected the objects",
    ]);
}

#[test]
fn inputs_and_files_of_a_different_kind_are_never_overwritten() {
    let recipe =
        |steps: &str, expect: &str| format!("(recipe: 1, steps: [{steps}], expect: [{expect}])");
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let moved = r#"Load(path: "in.obj"), Transform(move: (1, 0, 0)), Save(path: "out.obj")"#;
    let cube = r#"Cube(name: "cube"), Picture(path: "p.png", size: (8, 8))"#;
    for (name, text, message) in [
        (
            "a.ron",
            recipe(moved, r#"Output(path: "out.obj", as: "in.obj")"#),
            "a step reads \"in.obj\"",
        ),
        (
            "b.ron",
            recipe(cube, r#"Output(path: "p.png", as: "b.ron")"#),
            "\"b.ron\" and \"p.png\" are files of different formats",
        ),
        (
            "c.ron",
            recipe(cube, r#"Output(path: "p.png", as: "folder.png")"#),
            "\"folder.png\" is not a file",
        ),
    ] {
        let folder = Folder::new()
            .with(name, &text)
            .with("in.obj", triangle)
            .with("folder.png/a", "a");
        for command in ["check", "test --update"] {
            folder
                .run(&format!("{command} {name}"))
                .with_code(1)
                .complains(&[message]);
        }
        assert_eq!(folder.read(name), text.as_bytes());
        assert_eq!(folder.read("in.obj"), triangle.as_bytes());
    }
}

#[test]
fn two_outputs_cannot_have_the_same_reference_file() {
    let folder = Folder::with_recipe(
        r#"(recipe: 1, steps: [
            Cube(name: "cube"),
            Picture(path: "one.png", size: (8, 8)),
            Picture(path: "two.png", size: (9, 9)),
        ], expect: [Output(path: "one.png", as: "g.png"), Output(path: "two.png", as: "g.png")])"#,
    );
    folder
        .run("test recipe.ron --update")
        .with_code(1)
        .complains(&["another expectation records a different file under this name"]);
}
