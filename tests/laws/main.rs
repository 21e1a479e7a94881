//! Tests of general properties. The tests cover every operation on every test scene, every schema, random sequences of
//! edits, the book, and the source files.

mod all_edits;
mod any_edit;
mod book;
mod cache;
mod cancelling;
mod cube_diagonals;
mod every_op;
mod extremes;
mod files;
mod fixtures;
mod forecasts;
#[cfg(unix)]
mod growth;
mod layout;
mod opensubdiv;
mod random_edits;
mod registry;
mod renewing;
mod samples;
mod saving;
mod schema;
mod threads;

use std::path::{Path, PathBuf};

/// Returns the root folder of the workspace.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("this package is a folder of the workspace")
}

/// Returns the paths of the recipes in `scenes/`, sorted.
fn recipes() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(root().join("scenes")).expect("the folder scenes/ exists");
    let mut found: Vec<PathBuf> = entries
        .map(|entry| entry.expect("the folder can be listed").path())
        .filter(|path| path.extension().is_some_and(|e| e == "ron"))
        .collect();
    found.sort();
    found
}

/// Panics if there are failures, with one failure per line.
#[track_caller]
fn assert_none(failures: &[String]) {
    let n = failures.len();
    assert!(n == 0, "{n} failures:\n{}", failures.join("\n"));
}
