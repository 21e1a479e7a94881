//! Checks that every recipe in `scenes/` gives the same results with a cache as without a cache. The cache can be
//! empty, filled, damaged, or shared by two runs.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use ::cache::{Cache, Caching};
use engine::FileReader;
use op::Files;
use recipe::{Outcome, Settings, Silent, StepCache};
use tempfile::TempDir;

/// The results of a run, without times.
#[derive(Debug, PartialEq)]
struct RunResults {
    steps: Vec<String>,
    failures: Vec<recipe::Diagnostic>,
    checked: usize,
    digest: scene::Digest,
    outputs: BTreeMap<PathBuf, Vec<u8>>,
}

fn run(path: &Path, cache: Option<&Cache>) -> (RunResults, Outcome) {
    let source = fs::read_to_string(path).unwrap();
    let out = TempDir::new().unwrap();
    let source = recipe::Source::new(path, source);
    let reading = recipe::read(&source, &ops_all::registry(), recipe::Values::default());
    assert!(!reading.has_errors(), "{}", path.display());
    let files = Files {
        input: path.parent().unwrap().to_owned(),
        output: out.path().to_owned(),
        placeholders: reading.recipe.placeholders(),
        provenance: Some(format!("recipe {}", reading.recipe.digest())),
        ..Files::default()
    };
    let caching = cache.map(|cache| Caching {
        cache,
        recipe: Some(path),
        want_scene: false,
    });
    let settings = Settings {
        files: &files,
        budget: u64::MAX,
        reader: &FileReader,
        keep_outputs: true,
        writes: true,
        cache: caching.as_ref().map(|caching| caching as &dyn StepCache),
    };
    let outcome = recipe::run(&reading.recipe, settings, &Silent);
    let step = |s: &recipe::StepDone| {
        let counts = [s.vertices, s.edges, s.faces];
        format!("{} {:?} {:?} {counts:?}", s.label, s.report, s.refused)
    };
    let output = |written: &PathBuf| {
        let name = written.strip_prefix(out.path()).unwrap().to_owned();
        (name, fs::read(written).unwrap())
    };
    let results = RunResults {
        steps: outcome.steps.iter().map(step).collect(),
        failures: outcome.failures.clone(),
        checked: outcome.checked,
        digest: outcome.digest,
        outputs: outcome.written.iter().map(output).collect(),
    };
    (results, outcome)
}

fn scenes() -> Vec<PathBuf> {
    let mut scenes: Vec<PathBuf> = fs::read_dir(crate::root().join("scenes"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "ron"))
        .collect();
    scenes.sort();
    scenes
}

/// Returns all files below a folder, sorted.
fn all_files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(all_files(&path));
        } else {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// Damages every n-th file in one of four ways: one bit is changed, or the file is truncated, removed, or replaced with
/// a different file.
fn damage(folder: &Path, n: usize) {
    let files = all_files(folder);
    for (i, path) in files.iter().enumerate().filter(|(i, _)| i % n == 0) {
        let mut bytes = fs::read(path).unwrap();
        match i / n % 4 {
            0 => {
                let offset = i * 7919 % bytes.len().max(1);
                if let Some(byte) = bytes.get_mut(offset) {
                    *byte ^= 1;
                }
                fs::write(path, bytes).unwrap();
            }
            1 => fs::write(path, &bytes[..bytes.len() / 3]).unwrap(),
            2 => fs::remove_file(path).unwrap(),
            _ => _ = fs::copy(&files[i * 31 % files.len()], path),
        }
    }
}

#[test]
fn results_with_a_cache_equal_results_without() {
    let folder = TempDir::new().unwrap();
    let cache = Cache::new(folder.path(), u64::MAX, "tests");
    let scenes = scenes();
    let plain: Vec<RunResults> = scenes.iter().map(|path| run(path, None).0).collect();
    let check = |state: &str| {
        for (path, plain) in scenes.iter().zip(&plain) {
            let (results, _) = run(path, Some(&cache));
            assert!(
                results == *plain,
                "{} with a cache that is {state}",
                path.display()
            );
        }
    };
    check("empty");
    check("full");
    for n in [2, 3, 7] {
        damage(folder.path(), n);
        check("damaged");
    }
    for (path, plain) in scenes.iter().zip(&plain) {
        let ((a, _), (b, _)) = rayon::join(|| run(path, Some(&cache)), || run(path, Some(&cache)));
        assert!(
            a == *plain && b == *plain,
            "{} in two concurrent runs",
            path.display()
        );
    }
    cache.clear().unwrap();
    for (path, plain) in scenes.iter().zip(&plain) {
        let ((a, _), (b, _)) = rayon::join(|| run(path, Some(&cache)), || run(path, Some(&cache)));
        assert!(
            a == *plain && b == *plain,
            "{}: two concurrent runs with an empty cache have different results from a run without a cache",
            path.display()
        );
    }
}

#[test]
fn every_operation_that_the_scenes_use_can_be_cached() {
    let folder = TempDir::new().unwrap();
    let cache = Cache::new(folder.path(), u64::MAX, "tests");
    for path in scenes() {
        run(&path, Some(&cache));
        let (_, outcome) = run(&path, Some(&cache));
        for step in &outcome.steps {
            // A large output is not cached if it can be written quickly. Then the step can run again.
            let fine = matches!(step.ran, None | Some(recipe::RerunReason::NotKept));
            assert!(fine, "{}, {}: {:?}", path.display(), step.label, step.ran);
        }
    }
}
