//! The files in `ops/` and the list of built-in operations say the same.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// The name of each operation that a file of a group has, with the file.
fn files() -> BTreeMap<String, PathBuf> {
    let list = |folder: PathBuf| {
        let entries = std::fs::read_dir(folder).into_iter().flatten();
        entries.map(|entry| entry.expect("the folder can be listed").path())
    };
    list(crate::root().join("ops"))
        .flat_map(|group| list(group.join("src")))
        .filter(|path| path.extension().is_some_and(|x| x == "rs"))
        .filter(|path| {
            let source = std::fs::read_to_string(path).expect("sources can be read");
            source.lines().any(|line| {
                line.starts_with("impl Operation for ")
                    || line.starts_with("impl MeshOperation for ")
            })
        })
        .map(|path| {
            let stem = path.file_stem().and_then(|stem| stem.to_str());
            (camel_case(stem.expect("names are ASCII")), path)
        })
        .collect()
}

/// `uv_sphere` is `UvSphere`.
fn camel_case(file: &str) -> String {
    let word = |word: &str| word[..1].to_uppercase() + &word[1..];
    file.split('_').map(word).collect()
}

#[test]
fn every_file_is_in_the_registry() {
    let registry = ops_all::registry();
    for (name, path) in files() {
        assert!(
            registry.entries().iter().any(|entry| entry.name == name),
            "{} is not registered: its group's lib.rs needs `.with::<{name}>()` in `register`, or ops/all the group",
            path.display()
        );
    }
}

#[test]
fn every_operation_has_its_file() {
    let files = files();
    for entry in ops_all::registry().entries() {
        assert!(
            files.contains_key(entry.name),
            "{} has no file of its name in a group of ops/",
            entry.name
        );
    }
}

#[test]
fn every_name_is_there_once() {
    let registry = ops_all::registry();
    assert_eq!(registry.check(), Ok(()));
    let mut seen = BTreeSet::new();
    for entry in registry.entries() {
        for name in [entry.name].iter().chain(entry.aliases) {
            assert!(seen.insert(*name), "two operations are named {name}");
        }
    }
}

#[test]
fn every_summary_is_one_line_without_a_full_stop() {
    for entry in ops_all::registry().entries() {
        let summary = entry.summary;
        assert!(
            !summary.is_empty() && !summary.contains('\n') && !summary.ends_with('.'),
            "{}: {summary:?}",
            entry.name
        );
    }
}
