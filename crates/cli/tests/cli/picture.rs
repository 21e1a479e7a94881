//! `picture`: images of files and of what recipes make.

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
fn a_file_becomes_an_image_of_its_name() {
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
    // The pictures that the recipe itself would write are not written.
    assert!(!folder.path("out/made.png").exists());
    folder.run("run r.ron").with_code(0);
    assert_eq!(size(&folder, "out/made.png"), (16, 12));
    folder
        .run("reproduce out/made.png --recipe r.ron")
        .with_code(0);
}

#[test]
fn many_files_stand_on_a_sheet() {
    let folder = cube().with("b.obj", CUBE).with("broken.obj", "f 1 2 3\n");
    folder
        .run_all(&["picture", "*.obj"])
        .with_code(2)
        .complains(&["these are 3 files: --sheet puts them on one"]);
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
fn wrong_options_are_shown_as_those_of_a_step() {
    let folder = cube();
    for (arguments, complaint) in [
        (&["--shading", "Flta"][..], "did you mean `Flat`?"),
        (
            &["--highlight", "Shrp(above: 30)"],
            "unknown selection `Shrp`",
        ),
        (&["--highlight", "Boundary"], "say which are meant"),
        (&["--color-by", "Wealth"], "unknown variant `Wealth`"),
        (&["--with", "style: (sharpp: 3)"], "unknown field `sharpp`"),
        (&["--size", "0x10"], "expected a size such as 1280x960"),
        (&["--on", "cub"], "no object is named \"cub\""),
    ] {
        let arguments = [&["picture", "cube.obj", "--size", "8x8"], arguments].concat();
        // The size is given twice once.
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
    // A pipe gets plain characters: darker ones where the picture is darker.
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
