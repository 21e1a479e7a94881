//! Runs recipes under bad conditions: without free file descriptors, or until the run is killed.
#![cfg(unix)]

use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use crate::folder::{Folder, PROGRAM};

/// A recipe with two outputs, the second of which is in a subfolder.
const RECIPE: &str = r#"(recipe: 1, params: { "n": Int(default: 3) }, steps: [
    Grid(name: "a", columns: arg("n"), rows: 9), Save(path: "a.obj"), Save(path: "b/c.ply")])"#;

/// Returns the content of each output file; `None` if the file does not exist.
fn outputs(folder: &Folder) -> Vec<Option<Vec<u8>>> {
    let read = |path: &str| std::fs::read(folder.path(path)).ok();
    ["out/a.obj", "out/b/c.ply"].map(read).to_vec()
}

/// Returns the outputs of a run with this value of `n`.
fn made(n: u32) -> Vec<Option<Vec<u8>>> {
    let folder = Folder::with_recipe(RECIPE);
    folder
        .run(&format!("run recipe.ron --no-cache --set n={n}"))
        .with_code(0);
    outputs(&folder)
}

#[test]
fn a_run_without_free_file_descriptors_ends_with_a_sentence_and_leaves_nothing() {
    let (none, new) = (vec![None, None], made(3));
    let mut succeeded = 0;
    for descriptors in 3..16 {
        let folder = Folder::with_recipe(RECIPE);
        let ended = folder.shell(&format!(
            "ulimit -n {descriptors}; exec \"$0\" run recipe.ron --no-cache --set n=3 --threads 1"
        ));
        match ended.code {
            Some(0) => {
                succeeded += 1;
                assert!(outputs(&folder) == new, "{descriptors} descriptors");
            }
            // The exit code 127 means that the dynamic linker could not open the program's libraries.
            Some(127) => {}
            _ => {
                let ended = ended.with_code(1);
                assert!(!ended.stderr.contains("panicked"), "{ended:#?}");
                assert!(ended.stderr.contains("Too many open files"), "{ended:#?}");
                assert!(outputs(&folder) == none, "{descriptors} descriptors");
            }
        }
        let hidden = folder.entries("out");
        let hidden = hidden.iter().find(|name| name.starts_with('.'));
        assert_eq!(hidden, None, "{descriptors} descriptors");
    }
    assert!(succeeded > 0);
}

#[test]
fn a_run_that_is_killed_leaves_old_or_new_outputs() {
    let (old, new) = (made(3), made(300));
    let folder = Folder::with_recipe(RECIPE);
    folder
        .run("run recipe.ron --no-cache --set n=3")
        .with_code(0);
    for wait in (0..120).step_by(5) {
        let mut child = Command::new(PROGRAM)
            .args(["run", "recipe.ron", "--no-cache", "--set", "n=300"])
            .current_dir(folder.path("."))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        sleep(Duration::from_millis(wait));
        // The process may already have ended.
        let _ = child.kill();
        child.wait().unwrap();
        for (i, found) in outputs(&folder).iter().enumerate() {
            assert!(
                *found == old[i] || *found == new[i],
                "output {i} is neither old nor new after {wait} ms"
            );
        }
    }
    // A run succeeds even if killed runs have left temporary files.
    folder
        .run("run recipe.ron --no-cache --set n=300")
        .with_code(0);
    assert!(outputs(&folder) == new);
}
