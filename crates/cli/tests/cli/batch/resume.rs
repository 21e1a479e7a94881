//! Batches that are interrupted, and resumed.

use super::*;

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
    // With `--retry-failed`, only the broken file is processed again.
    assert_eq!(again("--retry-failed"), 1);
    // After the change of an input file, only this file is processed again.
    fs::write(folder.path("models/m002.obj"), tetrahedron(9)).unwrap();
    assert_eq!(again(""), 1);
    // One output file was removed, and another was changed. Only the input files of these two outputs are processed
    // again.
    fs::remove_file(folder.path("out/m001.obj")).unwrap();
    fs::write(folder.path("out/m004.obj"), "").unwrap();
    assert_eq!(again(""), 2);
    // With a different parameter value, all files are processed again.
    assert_eq!(again("--set levels=2"), 8);
    assert_eq!(again("--set levels=2"), 0);
    // If only a comment of the recipe changes, no file is processed again. If an expectation changes, all files are.
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
    // The batch is killed three times. Between two kills, it processes at least `further` files.
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
    // A killed process can leave an incomplete line at the end of the journal. This line is ignored.
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

#[cfg(unix)]
#[test]
fn a_journal_that_cannot_be_written_ends_the_batch() {
    let folder = with_models(2).with("out/batch.jsonl/file", "");
    batch(&folder, "")
        .with_code(1)
        .complains(&["error: cannot open the journal out/batch.jsonl"]);
}
