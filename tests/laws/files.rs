//! Checks that only the crates in `ALLOWED` access files or clocks directly. All other crates must run on platforms
//! without files and clocks.

use std::path::{Path, PathBuf};

use super::{assert_none, root};

/// The crates that are allowed to access files or clocks directly: the program, the window of the editor, the store,
/// the step cache on disk, and benchmarks.
const ALLOWED: [&str; 5] = ["benches", "cache", "cli", "store", "viewer"];

/// The names in source code that indicate direct access to files or clocks.
const WORDS: [&str; 13] = [
    "std::fs",
    "File::open",
    "File::create",
    "OpenOptions",
    "read_dir",
    "tempfile::",
    ".canonicalize()",
    ".exists()",
    ".is_dir()",
    ".is_symlink()",
    ".metadata()",
    "std::time::Instant",
    "SystemTime",
];

#[test]
fn files_go_through_the_store() {
    let mut found = Vec::new();
    for folder in ["crates", "ops"].map(|name| root().join(name)) {
        for package in entries(&folder) {
            if !ALLOWED.iter().any(|name| package.ends_with(name)) {
                search(&package.join("src"), &mut found);
            }
        }
    }
    assert_none(&found);
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.map(|entry| entry.path()).collect()
}

fn search(folder: &Path, found: &mut Vec<String>) {
    for path in entries(folder) {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() && name != "tests" {
            search(&path, found);
        } else if name.ends_with(".rs") && !["tests.rs", "testing.rs"].contains(&&*name) {
            let text = std::fs::read_to_string(&path).unwrap_or_default();
            // The tests of a source file are at its end and are not checked.
            let code = text.split("#[cfg(test)]\nmod tests {").next();
            for (i, line) in code.unwrap_or_default().lines().enumerate() {
                let is_comment = line.trim_start().starts_with("//");
                if !is_comment && let Some(word) = WORDS.iter().find(|word| line.contains(**word)) {
                    let place = path.display();
                    found.push(format!(
                        "{place}:{}: `{word}` must not be used here: use the store",
                        i + 1
                    ));
                }
            }
        }
    }
}
