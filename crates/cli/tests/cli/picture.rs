//! `picture`: draws files and the results of recipes.

use crate::folder::Folder;

const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

const RECIPE: &str = r#"(
    recipe: 1,
    steps: [
        Cube(name: "cube"),
        (id: "poke", run: PokeFaces()),
        Picture(path: "made.png", size: (16, 12)),
    ],
)"#;

fn cube() -> Folder {
    Folder::new().with("cube.obj", CUBE).with("r.ron", RECIPE)
}

/// Width and height of a PNG file.
fn size(folder: &Folder, name: &str) -> (u32, u32) {
    let bytes = std::fs::read(folder.path(name)).unwrap();
    assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
    let side = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
    (side(16), side(20))
}

#[test]
fn the_image_is_named_after_the_file() {
    let folder = cube();
    folder
        .run("picture cube.obj --size 40x30 --wireframe --shading Flat")
        .with_code(0)
        .prints(&["wrote cube.png, 40 x 30 pixels\n"]);
    assert_eq!(size(&folder, "cube.png"), (40, 30));
    folder
        .run("picture cube.obj --size 20x20 --from Front --from Top --orthographic --z-up -o two.png")
        .with_code(0);
    assert_eq!(size(&folder, "two.png"), (40, 20));
    folder
        .run("picture cube.obj --size 20x20 --turntable")
        .with_code(0)
        .prints(&["wrote cube.gif"]);
}

#[test]
fn a_step_is_shown_before_and_after() {
    let folder = cube();
    folder
        .run("picture r.ron --size 40x30 --change poke --color-by Valence")
        .with_code(0);
    let (width, height) = size(&folder, "r.png");
    assert!(width >= 80 && height > 30, "{width} {height}");
    // `meshwright picture` does not write the pictures of the recipe's own `Picture` steps.
    assert!(!folder.path("out/made.png").exists());
    folder.run("run r.ron").with_code(0);
    assert_eq!(size(&folder, "out/made.png"), (16, 12));
    folder
        .run("reproduce out/made.png --recipe r.ron")
        .with_code(0);
}

#[test]
fn changed_faces_are_highlighted() {
    let recipe = r#"(recipe: 1, steps: [
        Cube(name: "cube"),
        (id: "one", run: PokeFaces(faces: Nearest(to: (0, 0, 5)))),
        (id: "all", run: PokeFaces()),
        (id: "none", run: VertexNormals()),
    ])"#;
    let folder = Folder::new().with("r.ron", recipe);
    let has_orange = |options: &str| {
        let command = format!("picture r.ron --size 80x60 --shading Plain -o out.png {options}");
        folder.run(&command).with_code(0);
        let bytes = std::fs::read(folder.path("out.png")).unwrap();
        let image = render::Image::from_png(&bytes).unwrap();
        image.pixels.iter().any(|p| p[0] > 180 && p[2] < 60)
    };
    assert!(has_orange("--change one"));
    assert!(!has_orange("--change all"));
    assert!(!has_orange("--change none"));
    assert!(!has_orange("--after one"));
}

#[test]
fn several_files_are_drawn_on_a_sheet() {
    let folder = cube().with("b.obj", CUBE).with("broken.obj", "f 1 2 3\n");
    folder
        .run_all(&["picture", "*.obj"])
        .with_code(2)
        .complains(&["expected one file, found 3: use --sheet"]);
    folder
        .run_all(&[
            "picture",
            "*.obj",
            "--sheet",
            "--size",
            "40x30",
            "--columns",
            "2",
        ])
        .with_code(1)
        .complains(&["broken.obj"]);
    let (width, height) = size(&folder, "sheet.png");
    assert!(width > 80 && height > 120, "{width} {height}");
}

#[test]
fn invalid_options_are_reported_like_those_of_a_step() {
    let folder = cube();
    for (arguments, complaint) in [
        (&["--shading", "Flta"][..], "did you mean `Flat`?"),
        (
            &["--highlight", "Shrp(above: 30)"],
            "unknown selection `Shrp`",
        ),
        (&["--highlight", "Boundary"], "specify which"),
        (&["--color-by", "Wealth"], "unknown variant `Wealth`"),
        (&["--with", "style: (sharpp: 3)"], "unknown field `sharpp`"),
        (&["--size", "0x10"], "expected a size such as 1280x960"),
        (&["--on", "cub"], "unknown object \"cub\""),
    ] {
        let arguments = [&["picture", "cube.obj", "--size", "8x8"], arguments].concat();
        // The default arguments contain `--size`, which cannot be given twice. Therefore, this case replaces the
        // default size.
        let arguments: Vec<&str> = match arguments[4] {
            "--size" => vec!["picture", "cube.obj", "--size", "0x10"],
            _ => arguments,
        };
        folder
            .run_all(&arguments)
            .with_code(2)
            .complains(&[complaint]);
    }
    assert_eq!(folder.entries("."), ["cube.obj", "r.ron"]);
}

#[test]
fn a_selection_and_a_file_can_be_shown_beside_their_facts() {
    let folder = cube();
    folder
        .run_all(&[
            "select",
            "cube.obj",
            "Sharp(above: 30)",
            "--count",
            "--picture",
            "sharp.png",
        ])
        .with_code(0)
        .prints(&["12\n", "wrote sharp.png, 1280 x 960 pixels\n"]);
    assert_eq!(size(&folder, "sharp.png"), (1280, 960));
    // If standard output is a pipe, the picture consists of ASCII characters.
    let ended = folder.run("info cube.obj --picture").with_code(0);
    let after: Vec<&str> = ended
        .stdout
        .lines()
        .skip_while(|l| !l.trim().is_empty())
        .collect();
    assert!(
        after.len() > 10 && ended.stdout.is_ascii(),
        "{}",
        ended.stdout
    );
    assert!(!ended.stdout.contains('\x1b'));
}

/// A mesh with an edge that three faces share.
const FAN: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n";

#[test]
fn failures_of_a_run_are_drawn_if_requested() {
    let folder = Folder::new().with(
        "r.ron",
        r#"(recipe: 1, steps: [
            Grid(name: "grid", columns: 3, rows: 3),
            (id: "flip", run: FlipEdges(edges: Boundary)),
        ], expect: [(after: "flip", that: Closed)])"#,
    );
    folder.run("run r.ron").with_code(1);
    assert_eq!(folder.entries("."), ["r.ron"]);

    folder
        .run("run r.ron --picture-errors")
        .with_code(1)
        .complains(&["see r-error-1.png: "]);
    folder
        .run("test r.ron --picture-errors=some/where")
        .with_code(1)
        .complains(&["see some/where/r-error-1.png: "]);
    let [first, second] = ["r-error-1.png", "some/where/r-error-1.png"]
        .map(|name| std::fs::read(folder.path(name)).unwrap());
    assert!(first == second);
    let (width, height) = size(&folder, "r-error-1.png");
    assert!(width > 1400 && height > 500, "{width} {height}");
    let events = folder.run("run r.ron --format json --picture-errors");
    events.prints(&[r#"{"event":"picture","path":"r-error-1.png"}"#]);
}

#[test]
fn each_unmet_expectation_is_drawn() {
    let folder = Folder::new().with(
        "r.ron",
        r#"(recipe: 1, steps: [Grid(name: "grid", columns: 3, rows: 3)], expect: [
            Closed, Manifold, Faces(eq: 1), EdgeLength(max: 0.001),
        ])"#,
    );

    folder
        .run("test r.ron --format json --picture-errors=e")
        .with_code(1)
        .prints(&["e/r-error-1.png", "e/r-error-2.png", "e/r-error-3.png"]);

    // An expectation about a count has no affected elements, so the picture of its failure has one view instead of two.
    let widths = [1, 2, 3].map(|i| size(&folder, &format!("e/r-error-{i}.png")).0);
    assert!(
        widths[1] < widths[0] && widths[0] == widths[2],
        "{widths:?}"
    );
    assert!(!folder.path("e/r-error-4.png").exists());
}

#[test]
fn non_manifold_elements_of_a_file_are_drawn() {
    let folder = Folder::new().with("fan.obj", FAN).with("cube.obj", CUBE);

    folder
        .run("info fan.obj --picture-errors=e")
        .with_code(0)
        .prints(&["1 non-manifold edge split (v0-v1)"])
        .complains(&["see e/fan-error-1.png: ", "see e/fan-error-2.png: "]);
    folder.run("info cube.obj --picture-errors=e").with_code(0);

    assert!(folder.path("e/fan-error-1.png").exists());
    assert!(!folder.path("e/cube-error-1.png").exists());
}

#[test]
fn a_picture_of_a_failure_that_cannot_be_written_is_a_warning() {
    let folder = Folder::new().with("fan.obj", FAN).with("e", "a file");

    folder
        .run("info fan.obj --picture-errors=e")
        .with_code(0)
        .prints(&["non-manifold edge"])
        .complains(&[
            "warning: cannot make a picture of a failure: cannot write e/fan-error-1.png",
        ]);
}

#[test]
fn paths_on_the_command_line_are_relative_to_the_working_directory() {
    const TRIANGLE: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n\
        usemtl wood\nf 1/1 2/2 3/3\n";
    let mut png = Vec::new();
    let mut encoder = png::Encoder::new(&mut png, 1, 1);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&[200, 0, 0]).unwrap();
    writer.finish().unwrap();
    let folder = cube()
        .with("models/a.obj", TRIANGLE)
        .with("models/m.mtl", "newmtl wood\nmap_Kd wood.png\n")
        .with("elsewhere/wood.png", &png);
    let picture = |more: &[&str]| {
        let arguments = ["picture", "models/a.obj", "--size", "40x30"];
        folder.run_all(&[&arguments, more].concat()).with_code(0)
    };
    // The texture image is not in the folder of the model, but in the folder that --images names.
    let missing = picture(&[]);
    assert!(
        missing.stderr.contains("wood.png: not found"),
        "{missing:#?}"
    );
    for more in [
        &["--images", "elsewhere"][..],
        &["--with", "images: \"elsewhere\""],
    ] {
        let found = picture(more);
        assert_eq!(found.stderr, "", "{more:?}");
    }
    // The path in `DistanceTo` is relative to the working directory. The program still searches for texture images in
    // the folder of the model.
    let folder = folder.with("models/wood.png", &png);
    for of in [
        "DistanceTo(\"cube.obj\")",
        "DistanceTo(\"models/../cube.obj\")",
    ] {
        let ended = folder
            .run_all(&[
                "picture",
                "models/a.obj",
                "--size",
                "40x30",
                "--color-by",
                of,
            ])
            .with_code(0);
        assert_eq!(ended.stderr, "");
    }
    folder
        .run_all(&[
            "picture",
            "models/a.obj",
            "--color-by",
            "DistanceTo(\"a.obj\")",
        ])
        .with_code(1);
}

#[test]
fn an_unexpected_picture_is_drawn_beside_the_expected_one() {
    let recipe = |marked: &str| {
        format!(
            r#"(recipe: 1, steps: [
                Cube(name: "cube"), Picture(path: "cube.png", size: (60, 40){marked}),
            ], expect: [Output(path: "cube.png", as: "golden.png")])"#
        )
    };
    let folder = Folder::new().with("r.ron", recipe(""));
    folder.run("test r.ron --update").with_code(0);
    folder.run("test r.ron --picture-errors").with_code(0);
    let folder = folder.with("r.ron", recipe(", highlight: Vertices(All)"));

    folder
        .run("test r.ron --picture-errors")
        .with_code(1)
        .complains(&["pixels differ", "see r-error-1.png: "]);

    // The picture of the failure shows three images in a row. Gaps of 12 pixels are between the images and at both
    // sides.
    assert_eq!(size(&folder, "r-error-1.png").0, 3 * 60 + 4 * 12);
    // If the reference file is not a PNG file, the picture of the failure shows the scene.
    let folder = folder.with("golden.png", "no picture");
    folder.run("test r.ron --picture-errors").with_code(1);
    assert!(size(&folder, "r-error-1.png").0 > 700);
}

#[test]
fn at_most_20_failures_of_a_run_are_drawn() {
    let folder = Folder::new().with(
        "r.ron",
        r#"(recipe: 1, steps: [
            Grid(name: "grid", columns: 1, rows: 1),
            Repeat(times: 30, steps: [(id: "move", run: Transform(move: (1, 0, 0)))]),
        ], expect: [(after: "move", that: Faces(eq: 9))])"#,
    );

    folder
        .run("run r.ron --picture-errors=e")
        .with_code(1)
        .complains(&[
            "warning: at most 20 pictures of failures are written, so no picture shows the last 10 failures\n",
        ]);

    assert_eq!(folder.entries("e").len(), 20);
}
