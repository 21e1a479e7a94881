//! The step cache: `run`, `cache`, and processes that share the cache or are killed.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use crate::folder::{Ended, Folder, PROGRAM};
use crate::run::TORUS;

/// The events `done`, `problem` and `end` of a run, without the fields about the time and the cache.
fn comparable_events(stdout: &[u8]) -> Vec<serde_json::Value> {
    let mut events = Vec::new();
    for line in std::str::from_utf8(stdout).unwrap().lines() {
        let mut event: serde_json::Value = serde_json::from_str(line).unwrap();
        if ["done", "problem", "end"].contains(&event["event"].as_str().unwrap()) {
            for field in ["milliseconds", "cached", "ran_because"] {
                event.as_object_mut().unwrap().remove(field);
            }
            events.push(event);
        }
    }
    events
}

#[test]
fn a_second_run_takes_everything_from_the_cache() {
    let folder = Folder::with_recipe(TORUS);
    let first = folder.run("run recipe.ron").with_code(0);
    let outputs = ["out/torus.obj", "out/deep/torus.glb"];
    let bytes = outputs.map(|path| folder.read(path));
    fs::remove_dir_all(folder.path("out")).unwrap();
    let second = folder
        .run("run recipe.ron --explain")
        .with_code(0)
        .prints(&[
            " 3 smooth",
            "cached\n",
            "1 Torus: cached\n",
            "5 Save: cached\n",
            "wrote out/deep/torus.glb\n",
            "2 expectations met\n",
        ]);
    assert_eq!(first.digest(), second.digest());
    assert_eq!(outputs.map(|path| folder.read(path)), bytes);
    assert_eq!(folder.entries("out"), ["deep", "torus.obj"]);
}

#[test]
fn a_run_explains_why_a_step_ran() {
    let folder = Folder::with_recipe(TORUS);
    folder
        .run("run recipe.ron --explain")
        .with_code(0)
        .prints(&["1 Torus: ran because the step has not run before\n"]);
    folder
        .run("run recipe.ron --explain --set levels=2")
        .with_code(0)
        .prints(&[
            "2 Triangulate: cached\n",
            "3 smooth: ran because parameters changed: levels 1 -> 2\n",
            "4 Save: ran because the earlier step 3 smooth ran again\n",
        ]);
    folder
        .run("run recipe.ron --explain --no-cache")
        .with_code(0)
        .prints(&["1 Torus: ran because no cache is used\n"]);
}

#[test]
fn a_file_that_an_input_refers_to_is_an_input_too() {
    let folder = Folder::with_recipe(r#"(recipe: 1, steps: [Load(path: "a.obj")])"#).with(
        "a.obj",
        "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl x\nf 1 2 3\n",
    );
    let run = || folder.run("run recipe.ron --explain").with_code(0);
    let missing = run().prints(&["1 Load: ran", "material library `a.mtl` left out"]);
    run().prints(&["1 Load: cached\n", "material library `a.mtl` left out"]);
    fs::write(folder.path("a.mtl"), "newmtl x\nKd 1 0 0\n").unwrap();
    let red = run().prints(&["1 Load: ran because the file ./a.mtl did not exist before\n"]);
    assert_ne!(red.digest(), missing.digest());
    fs::write(folder.path("a.mtl"), "newmtl x\nKd 0 1 0\n").unwrap();
    let green = run().prints(&["1 Load: ran because the file ./a.mtl changed\n"]);
    assert_ne!(red.digest(), green.digest());
    fs::remove_file(folder.path("a.mtl")).unwrap();
    let again = run();
    assert_eq!(again.digest(), missing.digest());
}

#[test]
fn the_cache_shows_its_size_and_can_be_cleared() {
    let folder = Folder::with_recipe(TORUS);
    folder
        .run("cache")
        .with_code(0)
        .prints(&["folder", "holds 0 bytes: 0 steps"]);
    folder.run("run recipe.ron --cache here").with_code(0);
    let json = folder.run("cache --cache here --format json").json();
    assert_eq!(json["steps"], 5);
    assert!(json["bytes"].as_u64().unwrap() > 1000);
    folder
        .run("cache --cache here info")
        .with_code(0)
        .prints(&["5 steps"]);
    folder
        .run("cache clear --cache here")
        .with_code(0)
        .prints(&["removed", "5 steps"]);
    folder
        .run("cache --cache here")
        .with_code(0)
        .prints(&["0 steps"]);
    assert_eq!(folder.run("cache --format json").json()["steps"], 0);
}

#[test]
fn a_cache_that_cannot_be_written_is_a_warning() {
    let folder = Folder::with_recipe(TORUS).with("file", "");
    let ended = folder
        .run("run recipe.ron --cache file/cache")
        .with_code(0)
        .prints(&["wrote out/torus.obj\n"])
        .complains(&["warning: cannot write to the cache folder file/cache: "]);
    assert_eq!(ended.stderr.lines().count(), 1, "{}", ended.stderr);
    let ended = folder
        .run("test recipe.ron --cache file/cache")
        .with_code(0);
    assert_eq!(ended.stderr.lines().count(), 1, "{}", ended.stderr);
}

#[test]
fn a_small_limit_keeps_the_cache_small() {
    let folder = Folder::with_recipe(TORUS);
    folder
        .run("run recipe.ron --cache here --cache-limit 0")
        .with_code(0);
    assert_eq!(
        folder.run("cache --cache here --format json").json()["bytes"],
        0
    );
}

fn start(folder: &Folder, out: &str) -> std::process::Child {
    Command::new(PROGRAM)
        .args([
            "run",
            "recipe.ron",
            "--format",
            "json",
            "--cache",
            "shared",
            "--out",
            out,
        ])
        .current_dir(folder.path("."))
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// A recipe that runs long enough for a test to kill the run in the middle.
const LONGER: &str = r#"(recipe: 1, steps: [
    Torus(name: "a", around: 60, across: 40),
    Triangulate,
    LoopSubdivide(levels: 2),
    VertexNormals(weight: Area),
    (id: "tag", run: TagFaces(faces: Random(count: 100, seed: 3), name: "t")),
    Save(path: "a.obj"),
    Save(path: "a.glb"),
], expect: [Genus(eq: 1), Closed])"#;

/// Checks that a run with the cache gives the same events and outputs as a run without the cache.
fn check_run(folder: &Folder, plain: &Ended, out: &str, stdout: &[u8]) {
    assert_eq!(
        comparable_events(stdout),
        comparable_events(plain.stdout.as_bytes())
    );
    for name in ["a.obj", "a.glb"] {
        let same = folder.read(&format!("plain/{name}")) == folder.read(&format!("{out}/{name}"));
        assert!(same, "{name}");
    }
}

#[test]
fn several_processes_share_a_cache() {
    let folder = Folder::with_recipe(LONGER);
    let plain = folder
        .run("run recipe.ron --no-cache --out plain --format json")
        .with_code(0);
    for _ in 0..2 {
        let outs = ["one", "two", "three"];
        let children = outs.map(|out| (out, start(&folder, out)));
        for (out, child) in children {
            let output = child.wait_with_output().unwrap();
            assert!(output.status.success());
            check_run(&folder, &plain, out, &output.stdout);
        }
    }
}

#[test]
fn a_run_that_is_killed_at_any_moment_leaves_a_valid_cache() {
    let folder = Folder::with_recipe(LONGER);
    let plain = folder
        .run("run recipe.ron --no-cache --out plain --format json")
        .with_code(0);
    for round in 0..12_u64 {
        if round % 4 == 0 {
            let _ = fs::remove_dir_all(folder.path("shared"));
        }
        let mut child = start(&folder, "killed");
        sleep(Duration::from_millis(7 * round + 3));
        let _ = child.kill();
        let _ = child.wait();
        let output = start(&folder, "out").wait_with_output().unwrap();
        assert!(output.status.success());
        check_run(&folder, &plain, "out", &output.stdout);
    }
    assert!(Path::new(&folder.path("shared")).is_dir());
}
