//! The folders in `ops/` and the list of built-in operations say the same.

use std::collections::BTreeSet;

/// The folders in `ops/` but `all`.
fn folders() -> BTreeSet<String> {
    let entries = std::fs::read_dir(crate::root().join("ops")).expect("there is a folder ops/");
    entries
        .map(|entry| entry.expect("the folder can be listed"))
        .filter(|entry| entry.path().join("Cargo.toml").is_file())
        .map(|entry| entry.file_name().into_string().expect("names are ASCII"))
        .filter(|name| name != "all")
        .collect()
}

/// `uv_sphere` is `UvSphere`.
fn camel_case(folder: &str) -> String {
    let word = |word: &str| word[..1].to_uppercase() + &word[1..];
    folder.split('_').map(word).collect()
}

#[test]
fn every_folder_is_in_the_registry() {
    let registry = ops_all::registry();
    let names: BTreeSet<_> = registry.entries().iter().map(|e| e.name).collect();
    let forgotten: Vec<_> = folders()
        .into_iter()
        .filter(|folder| !names.contains(camel_case(folder).as_str()))
        .collect();
    assert!(
        forgotten.is_empty(),
        "ops/all does not list these folders of ops/: {}",
        forgotten.join(", ")
    );
}

#[test]
fn every_operation_has_its_folder() {
    let names: BTreeSet<_> = folders().iter().map(|f| camel_case(f)).collect();
    for entry in ops_all::registry().entries() {
        assert!(
            names.contains(entry.name),
            "{} has no folder of its name in ops/",
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
fn packages_and_libraries_have_the_names_of_their_folders() {
    for folder in folders() {
        let path = crate::root().join("ops").join(&folder).join("Cargo.toml");
        let manifest = std::fs::read_to_string(path).expect("found above");
        let kebab = folder.replace('_', "-");
        for name in [format!("meshwright-op-{kebab}"), folder.clone()] {
            let line = format!("name = \"{name}\"");
            assert!(
                manifest.lines().any(|l| l == line),
                "ops/{folder}/Cargo.toml has no line {line}"
            );
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
