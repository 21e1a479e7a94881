//! `batch`: runs one recipe on many files.

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

/// A report without times.
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

/// The inputs of a report with a text for each.
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

/// A line without `12 ms`.
fn without_time(line: &str) -> String {
    match (line.find(" ("), line.find(" ms")) {
        (Some(from), Some(to)) => line[..from].to_owned() + &line[to..],
        _ => line.to_owned(),
    }
}

#[test]
fn finished_files_are_not_processed_again_until_something_changes() {
    let folder = with_models(6).with("models/broken.obj", "f 1 2 3\n");
    let again = |arguments: &str| {
        let ended = batch(&folder, arguments).with_code(1);
        ended.stdout.lines().filter(|l| !l.contains(';')).count()
    };
    assert_eq!(again("--report a.json"), 8);
    assert_eq!(again("--report b.json"), 0);
    assert_eq!(report(&folder, "a.json"), report(&folder, "b.json"));
    // Only the broken file is processed again.
    assert_eq!(again("--retry-failed"), 1);
    // An input was changed.
    fs::write(folder.path("models/m002.obj"), tetrahedron(9)).unwrap();
    assert_eq!(again(""), 1);
    // One output was removed, and one was changed.
    fs::remove_file(folder.path("out/m001.obj")).unwrap();
    fs::write(folder.path("out/m004.obj"), "").unwrap();
    assert_eq!(again(""), 2);
    // A parameter was changed.
    assert_eq!(again("--set levels=2"), 8);
    assert_eq!(again("--set levels=2"), 0);
    // Changing a comment of the recipe has no effect, but changing an expectation does.
    fs::write(folder.path("recipe.ron"), format!("// new\n{RECIPE}")).unwrap();
    assert_eq!(again("--set levels=2"), 0);
    fs::write(
        folder.path("recipe.ron"),
        RECIPE.replace("min: 5", "min: 6"),
    )
    .unwrap();
    assert_eq!(again("--set levels=2"), 8);
}

#[test]
fn a_file_over_the_budget_is_processed_again_with_a_larger_budget() {
    let folder = with_models(2);
    batch(&folder, "--set levels=6 --budget 100KiB")
        .with_code(1)
        .prints(&["0 ok, 2 failed"]);
    let again = batch(&folder, "--set levels=6 --budget 100KiB").with_code(1);
    assert!(
        again
            .stdout
            .ends_with("2 of them finished in earlier runs\n"),
        "{again:#?}"
    );
    batch(&folder, "--set levels=6")
        .with_code(0)
        .prints(&["2 ok, 0 failed\n"]);
}

#[cfg(unix)]
#[test]
fn a_batch_that_is_killed_is_resumed() {
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};

    let folder = with_models(24).with("models/broken.obj", "f 1 2 3\n");
    let arguments = "batch recipe.ron --inputs models/*.obj --set levels=6 --threads 2";
    let n_recorded = |folder: &Folder| {
        let journal = fs::read_to_string(folder.path("out/batch.jsonl")).unwrap_or_default();
        journal
            .lines()
            .filter(|l| l.starts_with("{\"key\""))
            .count()
    };
    let mut killed_at = Vec::new();
    // Killed three times, each time after a few more files.
    for further in [1, 4, 5] {
        let before = n_recorded(&folder);
        let mut child = Command::new(crate::folder::PROGRAM)
            .args(arguments.split(' '))
            .current_dir(folder.path("."))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let begin = Instant::now();
        while n_recorded(&folder) < before + further && begin.elapsed() < Duration::from_secs(60) {
            std::thread::sleep(Duration::from_millis(2));
        }
        child.kill().unwrap();
        child.wait().unwrap();
        killed_at.push(n_recorded(&folder));
    }
    let done = *killed_at.last().unwrap();
    assert!((10..25).contains(&done), "{killed_at:?}");
    // An incomplete line, as left by a killed process, is not a row.
    let torn = fs::read_to_string(folder.path("out/batch.jsonl")).unwrap() + "{\"key\": \"12";
    fs::write(folder.path("out/batch.jsonl"), torn).unwrap();

    let ended = folder
        .run(&format!("{arguments} --report resumed.json"))
        .with_code(1);
    let tried = ended
        .stdout
        .lines()
        .filter(|l| l.contains("models/"))
        .count();
    assert_eq!(tried, 25 - done, "{ended:#?}");
    let kept = format!("{done} of them finished in earlier runs\n");
    assert!(ended.stdout.ends_with(&kept), "{ended:#?}");
    // Every file was processed exactly once.
    assert_eq!(n_recorded(&folder), 25);

    // The report and the files are the same as those of an uninterrupted batch.
    fs::rename(folder.path("out"), folder.path("first")).unwrap();
    let whole = folder.run(&format!("{arguments} --report whole.json"));
    assert!(!whole.stdout.contains("earlier runs"), "{whole:#?}");
    assert_eq!(
        report(&folder, "resumed.json"),
        report(&folder, "whole.json")
    );
    assert_eq!(folder.entries("first"), folder.entries("out"));
    for name in models(&folder, "out") {
        let [first, whole] = ["first", "out"].map(|out| folder.read(&format!("{out}/{name}")));
        assert!(first == whole, "{name}");
    }
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_a_batch_cleanly() {
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};

    let folder = with_models(30);
    let arguments =
        "batch recipe.ron --inputs models/*.obj --set levels=7 --threads 2 --report r.json";
    let child = Command::new(crate::folder::PROGRAM)
        .args(arguments.split(' '))
        .current_dir(folder.path("."))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let begin = Instant::now();
    while !folder.path("out/m001.obj").exists() && begin.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(2));
    }
    let kill = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(kill.unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    let stdout = String::from_utf8(output.stdout).unwrap();
    assert!(stdout.contains(" not processed: interrupted\n"), "{stdout}");

    let report = report(&folder, "r.json");
    let ok = column(&report, "state")
        .iter()
        .filter(|(_, s)| *s == "ok")
        .count();
    assert_eq!(report["ok"], ok);
    assert_eq!(report["skipped"], 30 - ok);
    assert!((1..30).contains(&ok), "{ok}");
    // The folder contains only complete outputs and the journal.
    let made = names(&folder.path("out"));
    assert_eq!(made.len(), ok + 1, "{made:?}");
    let ended = folder.run(arguments).with_code(0);
    assert!(
        ended
            .stdout
            .contains(&format!("{ok} of them finished in earlier runs")),
        "{ended:#?}"
    );
}

#[test]
fn parts_are_disjoint_and_merged_they_are_the_whole() {
    let folder = with_models(20).with("models/broken.obj", "f 1 2 3\n");
    for i in 1..=3 {
        let ended = batch(&folder, &format!("--shard {i}/3 --report part{i}.jsonl"));
        assert!(
            ended
                .stdout
                .contains(&format!("; part {i}/3 of 21 files\n")),
            "{ended:#?}"
        );
    }
    let part = |i: usize| {
        let text = String::from_utf8(folder.read(&format!("part{i}.jsonl"))).unwrap();
        let rows = text.lines().skip(1);
        let input = |line: &str| serde_json::from_str::<Json>(line).unwrap()["input"].to_string();
        rows.map(input).collect::<BTreeSet<String>>()
    };
    let parts = [part(1), part(2), part(3)];
    assert_eq!(parts.iter().map(BTreeSet::len).sum::<usize>(), 21);
    assert_eq!(parts.concat_all().len(), 21);

    // Duplicate rows are merged.
    folder
        .run("batch --merge part3.jsonl part1.jsonl part2.jsonl part1.jsonl --report all.json")
        .with_code(1)
        .prints(&["4 reports, 21 files: 20 ok, 1 failed, 0 not processed\n"]);
    fs::remove_file(folder.path("out/batch-1-of-3.jsonl")).unwrap();
    batch(&folder, "--report whole.json").with_code(1);
    assert_eq!(report(&folder, "all.json"), report(&folder, "whole.json"));

    folder
        .run("batch --merge part3.jsonl part1.jsonl --report some.json")
        .with_code(1)
        .complains(&["error: the report of part 2/3 is missing\n"]);
    assert_eq!(
        report(&folder, "some.json")["missing_shards"],
        serde_json::json!([2])
    );
}

trait ConcatAll {
    fn concat_all(&self) -> BTreeSet<String>;
}

impl ConcatAll for [BTreeSet<String>; 3] {
    fn concat_all(&self) -> BTreeSet<String> {
        self.iter().flatten().cloned().collect()
    }
}

#[test]
fn adding_a_file_moves_no_file_to_a_different_part() {
    let folder = with_models(20);
    let part = |folder: &Folder| {
        batch(folder, "--shard 1/3 --report p.json").with_code(0);
        let report = report(folder, "p.json");
        let inputs = column(&report, "state")
            .into_iter()
            .map(|(input, _)| input.to_owned());
        inputs.collect::<BTreeSet<String>>()
    };
    let before = part(&folder);
    let folder = folder
        .with("models/a.obj", tetrahedron(1))
        .with("models/m0005.obj", tetrahedron(1));
    let after = part(&folder);
    assert!(after.is_superset(&before) && after.len() <= before.len() + 2);
}

#[test]
fn contradicting_reports_are_not_merged() {
    let folder = with_models(2);
    batch(&folder, "--report a.json").with_code(0);
    let changed = String::from_utf8(folder.read("a.json")).unwrap();
    let changed = changed.replacen("\"faces\": 16", "\"faces\": 17", 1);
    let folder = folder.with("b.json", changed);
    folder
        .run("batch --merge a.json b.json --report c.json")
        .with_code(1)
        .complains(&[
            "error: models/m000.obj is ok (digest ",
            "a.json and ok",
            "b.json\n",
            "1 contradiction, no report was written",
        ]);
    assert!(!folder.path("c.json").exists());

    batch(&folder, "--set levels=2 --report d.json").with_code(0);
    let differ = folder
        .run("batch --merge a.json d.json --report c.json")
        .with_code(1);
    assert!(
        differ.stderr.contains("a.json and d.json have different "),
        "{differ:#?}"
    );
    for (reports, message) in [
        ("a.csv", "cannot read"),
        (
            "recipe.ron",
            "expected a report with the extension .csv, .json or .jsonl",
        ),
        ("none.json", "cannot read none.json"),
    ] {
        let ended = folder
            .run(&format!("batch --merge {reports} --report c.json"))
            .with_code(1);
        let is_table =
            reports == "a.csv" && ended.stderr.contains("reports in .csv cannot be merged");
        assert!(is_table || ended.stderr.contains(message), "{ended:#?}");
    }
}

#[test]
fn unusual_file_names_are_processed() {
    let mut names = vec![
        "a b",
        "ünïcödé ✓",
        "a,b",
        "it's",
        "[x]",
        "{y}",
        "-dash",
        "a;b=c",
        "$HOME `x`",
    ];
    if cfg!(unix) {
        names.extend(["quote\"d", "new\nline", "tab\t", "star*", "<&>"]);
    }
    let folder = names
        .iter()
        .fold(Folder::with_recipe(RECIPE), |folder, name| {
            folder.with(&format!("models/{name}.obj"), tetrahedron(1))
        });
    let ended = batch(&folder, "--report r.csv").with_code(0);
    // One line per file, even if its name contains line breaks.
    assert_eq!(ended.stdout.lines().count(), names.len() + 1, "{ended:#?}");
    let bytes = folder.read("r.csv");
    let mut table = csv::Reader::from_reader(bytes.as_slice());
    let listed: BTreeSet<String> = table.records().map(|r| r.unwrap()[0].to_owned()).collect();
    let expected: BTreeSet<String> = names.iter().map(|n| format!("models/{n}.obj")).collect();
    assert_eq!(listed, expected);
    for name in names {
        assert!(
            folder.path(&format!("out/{name}.obj")).is_file(),
            "{name:?}"
        );
        // A file whose name looks like a pattern can be given by its name.
        let path = format!("models/{name}.obj");
        let one = folder.run_all(&[
            "batch",
            "recipe.ron",
            &format!("--inputs={path}"),
            "--out",
            "one",
        ]);
        assert_eq!(one.code, Some(0), "{one:#?}");
        assert!(one.stdout.contains("1 ok, 0 failed"), "{one:#?}");
    }
}

#[test]
fn two_files_that_would_write_one_output_are_refused_before_anything_runs() {
    let folder = Folder::with_recipe(RECIPE)
        .with("models/a/cow.obj", tetrahedron(1))
        .with("models/b/cow.obj", tetrahedron(2));
    batch(&folder, "").with_code(1).complains(&[
        "error: models/a/cow.obj and models/b/cow.obj would both write out/cow.obj: use `{model.stem}`",
        "--folders\n",
    ]);
    assert!(!folder.path("out").exists());
    batch(&folder, "--folders").with_code(0);
    assert_eq!(folder.entries("out/a/cow.obj"), ["cow.obj"]);
    assert_eq!(folder.entries("out/b/cow.obj"), ["cow.obj"]);
}

#[test]
fn a_file_that_would_be_overwritten_is_refused_before_anything_runs() {
    let folder = with_models(2);
    batch(&folder, "--out models").with_code(1).complains(&[
        "error: the input file models/m000.obj would be overwritten by the output of models/m000.obj",
    ]);
    assert_eq!(folder.entries("models"), ["m000.obj", "m001.obj"]);
}

#[test]
fn invalid_batches_are_refused_with_a_reason() {
    let fixed = RECIPE.replace("Path(default: \"none.obj\")", "Text(default: \"a.obj\")");
    let fixed = fixed.replace("{model.stem}.obj", "a.glb");
    let two = RECIPE.replace(
        "\"levels\":",
        "\"other\": Path(default: \"x\"), \"levels\":",
    );
    let folder = with_models(1)
        .with("fixed.ron", fixed)
        .with("two.ron", two)
        .with("broken.ron", "(recipe: 1, steps: [Cubee])");
    let models = "--inputs models/*.obj";
    for (arguments, message) in [
        (
            "recipe.ron --inputs models/*.ply".to_owned(),
            "no file matches models/*.ply",
        ),
        (
            "recipe.ron --inputs models".to_owned(),
            "models is a folder, expected files: use 'models/*.obj'",
        ),
        (
            "recipe.ron --inputs nowhere/*.obj".to_owned(),
            "no file matches nowhere/*.obj",
        ),
        (
            "recipe.ron --inputs models/[.obj".to_owned(),
            "models/[.obj is not a valid file pattern",
        ),
        (
            format!("fixed.ron {models}"),
            "the recipe has no parameter of type Path",
        ),
        (
            format!("two.ron {models}"),
            "choose one of model, other with --param",
        ),
        (
            format!("two.ron {models} --param mode"),
            "no parameter `mode`: did you mean `model`?",
        ),
        (
            format!("recipe.ron {models} --param levels"),
            "`levels` is of type Int, expected Path",
        ),
        (
            format!("recipe.ron {models} --set model=x"),
            "it cannot be set with --set",
        ),
        (
            format!("recipe.ron {models} --set levels=x"),
            "the value set for `levels` is not allowed",
        ),
        (
            format!("recipe.ron {models} --set level=1"),
            "the recipe has no parameter `level`",
        ),
        (
            format!("recipe.ron {models} --report r.txt"),
            "expected a report with the extension",
        ),
        (format!("broken.ron {models}"), "unknown operation `Cubee`"),
        (format!("none.ron {models}"), "cannot read none.ron"),
    ] {
        let ended = folder.run(&format!("batch {arguments}")).with_code(1);
        assert!(ended.stderr.contains(message), "{arguments}: {ended:#?}");
        assert!(!folder.path("out").exists(), "{arguments}");
    }
    for wrong in ["--shard 0/3", "--shard 4/3", "--shard 1", "--jobs 0"] {
        folder
            .run(&format!("batch recipe.ron {models} {wrong}"))
            .with_code(2);
    }
    folder.run("batch recipe.ron").with_code(2);
    folder.run("batch --merge a.json").with_code(2);
}

#[test]
fn several_patterns_are_one_list_without_duplicates() {
    let folder = with_models(3)
        .with("models/x.ply", "no ply")
        .with("models/.hidden.obj", tetrahedron(1))
        .with("more/deep/er/z.obj", tetrahedron(1));
    folder
        .run("batch recipe.ron --inputs models/m00?.obj models/m001.obj more/** models/*.{ply,stl}")
        .with_code(1)
        .prints(&[
            "ok     models/m000.obj",
            "ok     models/m001.obj",
            "ok     models/m002.obj",
            "FAILED models/x.ply",
            "ok     more/deep/er/z.obj",
            "4 ok, 1 failed",
        ]);
}

#[cfg(unix)]
#[test]
fn cyclic_links_do_not_hang() {
    let folder = with_models(2);
    for name in ["one", "two"] {
        std::os::unix::fs::symlink(
            folder.path("models"),
            folder.path(&format!("models/{name}")),
        )
        .unwrap();
    }
    batch(&folder, "")
        .with_code(0)
        .prints(&["2 ok, 0 failed\n"]);
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
    // Without the limit, the batch succeeds.
    batch(&folder, "--set levels=5 --retry-failed")
        .with_code(0)
        .prints(&["3 ok, 0 failed\n"]);

    // If the journal cannot grow, the batch ends; the journal stays valid.
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

#[cfg(unix)]
#[test]
fn a_journal_that_cannot_be_written_ends_the_batch() {
    let folder = with_models(2).with("out/batch.jsonl/file", "");
    batch(&folder, "")
        .with_code(1)
        .complains(&["error: cannot open the journal out/batch.jsonl"]);
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

    // A file that is no report is refused without names of Rust types.
    let folder = folder.with("no.json", "1").with("no.jsonl", "[]\n");
    for name in ["no.json", "no.jsonl"] {
        let ended = folder.run(&format!("batch --merge {name} --report all.json"));
        assert!(!ended.stderr.contains("struct"), "{ended:#?}");
        ended
            .with_code(1)
            .complains(&["is not a report of a batch"]);
    }
}
