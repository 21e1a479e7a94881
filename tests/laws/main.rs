//! Laws that hold for everything in the workspace: every operation on every fixture, every schema,
//! every sequence of edits.

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
mod layout;
mod opensubdiv;
mod random_edits;
mod registry;
mod renewing;
mod samples;
mod schema;
mod threads;

use std::path::{Path, PathBuf};

/// The root of the workspace.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("this package is a folder of the workspace")
}

/// The recipes in `scenes/`, in order of their names.
fn recipes() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(root().join("scenes")).expect("there is a folder scenes/");
    let mut found: Vec<PathBuf> = entries
        .map(|entry| entry.expect("the folder can be listed").path())
        .filter(|path| path.extension().is_some_and(|e| e == "ron"))
        .collect();
    found.sort();
    found
}

/// Fails with all failures, one a line.
#[track_caller]
fn assert_none(failures: &[String]) {
    let n = failures.len();
    assert!(n == 0, "{n} failures:\n{}", failures.join("\n"));
}
