//! Standard input and standard output in place of files: the path `-`.

use crate::folder::{Ended, Folder};

const SQUARE: &str = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3 4\n";

#[test]
fn a_recipe_is_read_from_standard_input_with_paths_of_the_working_directory() {
    let folder = Folder::new().with("models/square.obj", SQUARE);
    let recipe = r#"(recipe: 1, steps: [
        Load(path: "models/square.obj"), PokeFaces(), Save(path: "poked.obj"),
    ], expect: [Faces(eq: 4)])"#;
    folder.run_with("run -", recipe).with_code(0).prints(&[
        "PokeFaces",
        "wrote out/poked.obj",
        "1 expectation met",
    ]);
    folder
        .run_with("check -", recipe)
        .with_code(0)
        .prints(&["stdin.ron is valid: 3 steps, 1 expectation"]);
    folder
        .run_with("run -", "(recipe: 1, steps: [Cubee()])")
        .with_code(1)
        .complains(&["stdin.ron:1:21"]);
    // The capsule (a recipe that reproduces the failure) does not need standard input.
    let failing = r"(recipe: 1, steps: [Cube(), SplitEdges(edges: Between(0, 6))])";
    folder
        .run_with("run - --capsule failing --picture-errors", failing)
        .with_code(1)
        .complains(&["stdin-error-1.png", "run failing/recipe.ron"]);
    folder.run("run failing/recipe.ron").with_code(1);
    folder
        .run_with("watch -", recipe)
        .with_code(2)
        .complains(&["`watch` cannot use standard input"]);
}

#[test]
fn a_recipe_on_standard_input_must_be_text_of_limited_size() {
    let folder = Folder::new();
    let run = |input: &[u8]| folder.run_with("run -", input).with_code(1);
    run(b"(\n\xff").complains(&["stdin.ron:2: the recipe is not UTF-8 text"]);
    run(&vec![b' '; (64 << 20) + 1]).complains(&["the recipe is larger than 64 MiB"]);
}

#[test]
fn info_describes_standard_input() {
    let folder = Folder::new();
    folder
        .run_with("info - --from obj", SQUARE)
        .with_code(0)
        .prints(&["stdin: mesh", "vertices           4"]);
    let json = folder.run_with("info - --from OBJ --format json", SQUARE);
    assert_eq!(json.json()["file"], "stdin.obj");
    folder
        .run_with("info - --from obj", "f 1 2 3\n")
        .with_code(1)
        .complains(&["stdin.obj:1:"]);
}

#[test]
fn a_file_goes_through_both_pipes_as_it_goes_through_files() {
    let folder = Folder::new().with("in.obj", SQUARE);
    for (to, from) in [
        ("ply", "ply"),
        ("off", "off"),
        ("glb", "glb"),
        ("mws", "mws"),
    ] {
        folder
            .run(&format!("convert in.obj stdout.{to}"))
            .with_code(0);
        folder
            .shell(&format!(
                r#""$0" convert - - --from obj --to {to} < in.obj > piped.{to}"#
            ))
            .with_code(0);
        folder
            .run(&format!("diff stdout.{to} piped.{to}"))
            .with_code(0);
        let piped = format!(r#""$0" convert in.obj - --to {to} | "$0" info - --from {from}"#);
        folder
            .shell(&piped)
            .with_code(0)
            .prints(&["vertices           4"]);
    }
    // The mesh on standard input can be compressed with gzip.
    folder
        .shell(r#""$0" convert in.obj - --to obj.gz | "$0" convert - out.ply --from obj.gz"#)
        .with_code(0)
        .prints(&["wrote out.ply"]);
}

#[test]
fn standard_output_has_the_bytes_alone() {
    let folder = Folder::new().with("in.obj", format!("{SQUARE}f 1 2 2\ncstype bezier\n"));
    let ended = folder.run("convert in.obj - --to off").with_code(0);
    assert!(ended.stdout.starts_with("OFF\n"), "{ended:#?}");
    assert!(!ended.stdout.contains("left out"), "{ended:#?}");
    ended.complains(&["left out"]);
    let ended = folder.run("convert in.obj - --to off --format json");
    let report: serde_json::Value = serde_json::from_str(&ended.stderr).unwrap();
    assert_eq!(report["bytes"], ended.stdout.len());
    assert_eq!(report["wrote"].as_array().unwrap().len(), 0);
    // If a loss is an error, nothing is written to standard output.
    let ended = folder
        .run("convert in.obj - --to off --strict")
        .with_code(1);
    assert_eq!(ended.stdout, "");
}

#[test]
fn standard_output_takes_one_file() {
    let folder = Folder::new()
        .with("in.mtl", "newmtl red\nKd 1 0 0\nmap_Kd red.png\n")
        .with("red.png", b"\x89PNG\r\n")
        .with(
            "in.obj",
            format!(
                "mtllib in.mtl\n{}",
                SQUARE.replace("f 1", "usemtl red\nf 1")
            ),
        );
    folder
        .run("convert in.obj - --to gltf")
        .with_code(2)
        .complains(&["standard output takes only one file: use --to glb"]);
    let ended = folder.run("convert in.obj - --to obj").with_code(0);
    assert!(!ended.stdout.contains("mtl") && ended.stdout.contains("f 1 2 3 4"));
    ended.complains(&["\"in\" lost \"materials\" (1): OBJ stores materials in a second file"]);
    let ended = folder
        .run("convert in.obj - --to obj --strict")
        .with_code(1);
    assert_eq!(ended.stdout, "");
    let ended = folder
        .run("convert in.obj - --to glb --images Copy")
        .with_code(1);
    ended.complains(&["the output needs 2 files, but standard output takes only one"]);
}

#[test]
fn the_format_of_a_pipe_must_be_named() {
    let folder = Folder::new().with("in.obj", SQUARE);
    let refused = |arguments: &str, message: &str| {
        folder.run(arguments).with_code(2).complains(&[message]);
    };
    refused(
        "info -",
        "`-` has no extension that determines the file format: name the format with an option, such as --from obj",
    );
    refused(
        "convert in.obj -",
        "name the format with an option, such as --to obj",
    );
    refused("info - --from xyz", "--from xyz: expected one of obj, gltf");
    refused("info in.obj --from obj", "--from applies only to `-`");
    refused(
        "convert in.obj out.ply --to ply",
        "--to applies only to `-`",
    );
}

#[test]
#[cfg(unix)]
fn a_closed_pipe_ends_the_program_quietly() {
    let mut large = String::from("v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    large += &"f 1 2 3\nv 1 1 1\n".repeat(50_000);
    let folder = Folder::new().with("in.obj", large);
    let ended: Ended =
        folder.shell(r#"("$0" convert in.obj - --to obj; echo $? > code) | head -c 1"#);
    assert_eq!(ended.stdout, "#");
    assert!(!ended.stderr.contains("error"), "{ended:#?}");
    assert_eq!(folder.read("code"), b"0\n");
}
