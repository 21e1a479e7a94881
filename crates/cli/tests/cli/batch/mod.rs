//! `batch`: runs one recipe on many files.

mod inputs;
mod resume;
mod sets;
mod shards;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::Value as Json;

use crate::folder::{Ended, Folder, names};

/// Subdivides a file.
const RECIPE: &str = r#"(
    recipe: 1,
    params: { "model": Path(default: "none.obj"), "levels": Int(default: 1, max: 9) },
    steps: [
        Load(path: arg("model")),
        (id: "smooth", run: LoopSubdivide(levels: arg("levels"))),
        Save(path: "{model.stem}.obj"),
    ],
    expect: [Faces(min: 5)],
)"#;

/// A tetrahedron of the given size.
fn tetrahedron(size: usize) -> String {
    let s = size;
    format!("v 0 0 0\nv {s} 0 0\nv 0 {s} 0\nv 0 0 {s}\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
}

/// A folder with the recipe, and `count` models in `models`.
fn with_models(count: usize) -> Folder {
    (0..count).fold(Folder::with_recipe(RECIPE), |folder, i| {
        folder.with(&format!("models/m{i:03}.obj"), tetrahedron(i + 1))
    })
}

fn batch(folder: &Folder, arguments: &str) -> Ended {
    folder.run(&format!(
        "batch recipe.ron --inputs models/**/*.obj {arguments}"
    ))
}

/// The names of the models in a folder.
fn models(folder: &Folder, path: &str) -> Vec<String> {
    let mut names = folder.entries(path);
    names.retain(|name| Path::new(name).extension().is_some_and(|e| e == "obj"));
    names
}

/// Reads a report and removes the times of the runs.
fn report(folder: &Folder, path: &str) -> Json {
    let mut report: Json = serde_json::from_slice(&folder.read(path)).unwrap();
    for row in report["rows"].as_array_mut().unwrap() {
        row["seconds"] = Json::Null;
    }
    report
}

fn rows(report: &Json) -> &Vec<Json> {
    report["rows"].as_array().unwrap()
}

/// Returns two texts for each row of a report: the input file, and the value in the column `name`.
fn column<'r>(report: &'r Json, name: &str) -> Vec<(&'r str, &'r str)> {
    let text = |row: &'r Json, name: &str| row[name].as_str().unwrap_or("");
    rows(report)
        .iter()
        .map(|row| (text(row, "input"), text(row, name)))
        .collect()
}

#[test]
fn every_file_is_a_row_in_order_and_a_broken_file_does_not_stop_the_batch() {
    let folder = with_models(3)
        .with("models/a/broken.obj", "f 1 2 3\n")
        .with("models/open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        .with("models/notes.txt", "no model");
    batch(&folder, "--report r.json").with_code(1).prints(&[
        "FAILED models/a/broken.obj: Load: ",
        "ok     models/m000.obj (",
        "ok     models/m001.obj (",
        "ok     models/m002.obj (",
        "FAILED models/open.obj: expected at least 5 faces, found 4\n",
        "3 ok, 2 failed (see out/failed)\n",
    ]);
    let report = report(&folder, "r.json");
    assert_eq!(
        column(&report, "state"),
        [
            ("models/a/broken.obj", "failed"),
            ("models/m000.obj", "ok"),
            ("models/m001.obj", "ok"),
            ("models/m002.obj", "ok"),
            ("models/open.obj", "failed")
        ]
    );
    let row = &rows(&report)[1];
    assert_eq!(row["faces"], 16);
    assert_eq!(row["outputs"][0]["path"], "out/m000.obj");
    let size = folder.read("out/m000.obj").len();
    assert_eq!(row["outputs"][0]["bytes"], size);
    assert_eq!((&report["ok"], &report["failed"]), (&3.into(), &2.into()));
    assert_eq!(
        folder.entries("out"),
        ["batch.jsonl", "failed", "m000.obj", "m001.obj", "m002.obj"]
    );
}

#[test]
fn a_failure_is_recorded_with_the_command_that_repeats_it() {
    let folder = Folder::with_recipe(RECIPE).with("models/it's bad.obj", "f 1 2 3\n");
    batch(&folder, "--set levels=2 --out made").with_code(1);
    let notes = folder.entries("made/failed");
    assert_eq!(notes.len(), 1);
    let note = String::from_utf8(folder.read(&format!("made/failed/{}", notes[0]))).unwrap();
    assert!(
        note.starts_with("models/it's bad.obj failed at Load\n"),
        "{note}"
    );
    assert!(note.contains("recipe.ron:5:9"), "{note}");
    let command = note.lines().last().unwrap();
    let again = command.replace("meshwright", "\"$0\"");
    let ended = folder.shell(&again).with_code(1);
    assert!(ended.stderr.contains("it's bad.obj:1:3: "), "{ended:#?}");

    // When the input is fixed, the record of the failure is removed.
    let folder = folder.with("models/it's bad.obj", tetrahedron(1));
    batch(&folder, "--set levels=2 --out made").with_code(0);
    assert_eq!(folder.entries("made/failed"), [""; 0]);
}

#[test]
fn the_command_that_repeats_a_failure_takes_the_preset_too() {
    let folder = Folder::with_recipe(
        r#"(recipe: 1, params: {"model": Path(default: ""), "levels": Int(default: 0)},
            presets: {"fine": {"levels": 2}},
            steps: [Load(path: arg("model")), LoopSubdivide(levels: arg("levels"))], expect: [Faces(max: 4)])"#,
    )
    .with("models/a.obj", tetrahedron(1));
    batch(&folder, "--preset fine").with_code(1);
    let notes = folder.entries("out/failed");
    let note = String::from_utf8(folder.read(&format!("out/failed/{}", notes[0]))).unwrap();
    let again = note.lines().last().unwrap().replace("meshwright", "\"$0\"");
    folder
        .shell(&again)
        .with_code(1)
        .complains(&["expected at most 4 faces, found 64"]);
}

#[test]
fn results_do_not_depend_on_jobs_threads_and_budget() {
    let folder = with_models(12).with("models/broken.obj", "f 1 2 3\n");
    let made = |arguments: &str, out: &str| {
        let ended = batch(
            &folder,
            &format!("{arguments} --out {out} --report {out}.json"),
        );
        assert_eq!(ended.code, Some(1), "{ended:#?}");
        let text = serde_json::to_string(&report(&folder, &format!("{out}.json"))).unwrap();
        let files = models(&folder, out).into_iter();
        let files: Vec<Vec<u8>> = files.map(|n| folder.read(&format!("{out}/{n}"))).collect();
        let lines: Vec<String> = ended.stdout.lines().map(without_time).collect();
        (text.replace(&format!("\"{out}/"), "\"out/"), files, lines)
    };
    let one = made("--threads 1", "a");
    assert_eq!(one.1.len(), 12);
    for (arguments, out) in [
        ("--threads 2", "b"),
        ("--threads 8", "c"),
        ("--threads 8 --jobs 3", "d"),
        ("--threads 4 --budget 1MiB", "e"),
    ] {
        let mut other = made(arguments, out);
        for line in &mut other.2 {
            *line = line.replace(&format!("{out}/failed"), "a/failed");
        }
        assert_eq!(other, one, "{arguments}");
    }
}

/// Returns a line of the output without its time, such as `12 ms`.
fn without_time(line: &str) -> String {
    match (line.find(" ("), line.find(" ms")) {
        (Some(from), Some(to)) => line[..from].to_owned() + &line[to..],
        _ => line.to_owned(),
    }
}

#[cfg(unix)]
#[test]
fn an_output_that_cannot_be_written_is_a_failure_and_leaves_no_file() {
    // A limit on the size of files simulates a full disk.
    let folder = with_models(3);
    let limited = "trap '' XFSZ; ulimit -f 8; exec \"$0\" batch recipe.ron --inputs models/*.obj";
    let ended = folder
        .shell(&format!("{limited} --set levels=5"))
        .with_code(1);
    assert!(ended.stdout.contains("0 ok, 3 failed"), "{ended:#?}");
    assert!(
        ended.stdout.contains("FAILED models/m000.obj: Save: "),
        "{ended:#?}"
    );
    assert_eq!(folder.entries("out"), ["batch.jsonl", "failed"]);
    // Without the limit on the size of files, the batch succeeds.
    batch(&folder, "--set levels=5 --retry-failed")
        .with_code(0)
        .prints(&["3 ok, 0 failed\n"]);

    // If the journal cannot be extended, the batch ends. The journal stays valid, so the next batch continues from it.
    let folder = with_models(60);
    let ended = folder.shell(&limited.replace("-f 8", "-f 4")).with_code(1);
    assert!(
        ended
            .stderr
            .contains("error: cannot write the journal out/batch.jsonl"),
        "{ended:#?}"
    );
    let kept = |text: &str| {
        let (_, rest) = text.split_once("; ").unwrap();
        rest.split(' ').next().unwrap().parse::<usize>().unwrap()
    };
    let again = batch(&folder, "").with_code(0);
    assert!((1..60).contains(&kept(&again.stdout)), "{again:#?}");
}

#[test]
fn all_violations_and_the_counts_of_a_failure_are_in_the_reports() {
    let folder = Folder::with_recipe(
        r#"(recipe: 1, params: {"model": Path(default: "a")}, steps: [
            Load(path: arg("model")), Save(path: "{model.stem}.obj"),
        ], expect: [Faces(eq: 5), Vertices(max: 3)])"#,
    )
    .with("models/a <1>.obj", tetrahedron(1));
    batch(&folder, "--report r.json --junit deep/r.xml")
        .with_code(1)
        .prints(&[
            "FAILED models/a <1>.obj: expected 5 faces, found 4; expected at most 3 vertices, found 4\n",
        ]);
    let report = report(&folder, "r.json");
    let row = &rows(&report)[0];
    let counts = ["vertices", "edges", "faces"].map(|name| row[name].as_u64());
    assert_eq!(counts, [4, 6, 4].map(Some));
    assert_eq!(
        row["message"],
        "expected 5 faces, found 4; expected at most 3 vertices, found 4"
    );

    let xml = String::from_utf8(folder.read("deep/r.xml")).unwrap();
    let document = roxmltree::Document::parse(&xml).unwrap();
    let find = |name: &str| {
        let mut nodes = document.descendants();
        nodes.find(|node| node.has_tag_name(name)).unwrap()
    };
    assert_eq!(find("testsuite").attribute("failures"), Some("1"));
    assert_eq!(find("testcase").attribute("name"), Some("models/a <1>.obj"));
    let text = find("failure").text().unwrap();
    assert!(
        text.contains("recipe.ron:3:") && text.contains("To repeat the run"),
        "{text}"
    );

    // If a file is not a report, the error contains no names of Rust types.
    let folder = folder.with("no.json", "1").with("no.jsonl", "[]\n");
    for name in ["no.json", "no.jsonl"] {
        let ended = folder.run(&format!("batch --merge {name} --report all.json"));
        assert!(!ended.stderr.contains("struct"), "{ended:#?}");
        ended
            .with_code(1)
            .complains(&["is not a report of a batch"]);
    }
}
