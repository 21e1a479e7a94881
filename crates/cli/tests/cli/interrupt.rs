//! Ctrl-C.
#![cfg(unix)]

use std::io::Read;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::folder::{Folder, PROGRAM, names};

/// Starts a long run and interrupts it after the time `wait`. Checks that the run ends quickly and leaves no files.
#[track_caller]
fn interrupted_after(wait: Duration, out: &str) {
    let folder = Folder::with_recipe(
        r#"(recipe: 1, steps: [
            Torus(name: "a", around: 8, across: 6),
            Triangulate,
            Save(path: "first.obj"),
            LoopSubdivide(levels: 9),
            Save(path: "last.obj"),
        ])"#,
    );
    let mut child = Command::new(PROGRAM)
        .args(["run", "recipe.ron", "--no-cache", "--out", out])
        .current_dir(folder.path("."))
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // The temporary folder for outputs is created when the run starts.
    let first = folder.path(out.split('/').next().unwrap());
    let out = folder.path(out);
    let begin = Instant::now();
    while names(&out).is_empty() && begin.elapsed() < Duration::from_secs(30) {
        sleep(Duration::from_millis(5));
    }
    sleep(wait);
    assert_eq!(child.try_wait().unwrap(), None, "the run was too short");

    let signal = Instant::now();
    let kill = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(kill.unwrap().success());
    let mut stderr = String::new();
    let mut pipe = child.stderr.take().unwrap();
    pipe.read_to_string(&mut stderr).unwrap();
    let status = child.wait().unwrap();

    assert_eq!(stderr, "interrupted, no files were written\n");
    assert_eq!(status.code(), Some(130));
    assert!(
        signal.elapsed() < Duration::from_secs(10),
        "{:?}",
        signal.elapsed()
    );
    // The run created the output folder with its parents, so the run also removes them.
    assert!(!first.exists());
}

#[test]
fn an_interrupted_run_ends_quickly_and_leaves_no_files() {
    interrupted_after(Duration::from_millis(300), "a/b/c");
}

#[test]
fn a_run_can_be_interrupted_immediately() {
    interrupted_after(Duration::ZERO, "out");
}
