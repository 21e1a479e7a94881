//! Checks that the files in `ops/` agree with the list of built-in operations, and checks the names and summaries of
//! these operations.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// Returns the paths in a folder, or no paths if the folder does not exist.
fn list(folder: PathBuf) -> impl Iterator<Item = PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    entries.map(|entry| entry.expect("the folder can be listed").path())
}

/// Returns the source files of all operations in the groups. The key of each file is the name that its operation must
/// have.
fn files() -> BTreeMap<String, PathBuf> {
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

/// Converts `uv_sphere` to `UvSphere`.
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
            "{} is not registered: add `.with::<{name}>()` to `register` in the lib.rs of its group, or add the group \
             to ops/all",
            path.display()
        );
    }
}

#[test]
fn every_operation_has_a_file_of_its_name() {
    let files = files();
    for entry in ops_all::registry().entries() {
        assert!(
            files.contains_key(entry.name),
            "{} has no file of the same name in a group of ops/",
            entry.name
        );
    }
}

/// Converts `UvSphere` to `uv_sphere`.
fn snake_case(name: &str) -> String {
    let mut file = String::new();
    for c in name.chars() {
        if c.is_ascii_uppercase() && !file.is_empty() {
            file.push('_');
        }
        file.push(c.to_ascii_lowercase());
    }
    file
}

#[test]
fn every_operation_except_save_has_a_recipe_and_pictures() {
    let folder = crate::root().join("ops/all/pictures");
    for entry in ops_all::registry().entries() {
        let name = snake_case(entry.name);
        let recipe = folder.join(&name).with_extension("ron");
        assert!(recipe.is_file(), "{} is missing", recipe.display());
        let text = std::fs::read_to_string(recipe).expect("found above");
        let drawn = ["before.png", "after.png"].map(|file| text.contains(&format!("\"{file}\"")));
        assert_eq!(
            drawn[1],
            entry.name != "Save",
            "{name}.ron must draw after.png"
        );
        for (file, drawn) in ["before.png", "after.png"].iter().zip(drawn) {
            let picture = folder.join(&name).join(file);
            let size = picture.metadata().map_or(0, |file| file.len());
            assert_eq!(
                drawn,
                size > 0,
                "{} does not match its recipe: run the recipe",
                picture.display()
            );
            assert!(size < 50_000, "{}: {size} bytes", picture.display());
        }
    }
}

#[test]
fn operation_names_are_unique() {
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
