//! Which crate knows which, and how much a first build compiles.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use serde_json::Value;

use crate::{assert_none, root};

/// What stands directly to the left of each crate in the lines of DESIGN.md. A crate may use these, and what they may use.
const LEFT_OF: &[(&str, &[&str])] = &[
    ("progress", &[]),
    ("store", &[]),
    ("ron-tree", &[]),
    ("mesh", &["progress"]),
    ("geometry", &["mesh"]),
    ("subdivision", &["geometry"]),
    ("bezier", &["geometry"]),
    ("scene", &["subdivision", "bezier", "store"]),
    ("io", &["scene"]),
    ("render", &["scene"]),
    ("view", &["io", "render"]),
    ("op", &["scene", "ron-tree"]),
    ("ops-*", &["op", "view"]),
    ("ops-all", &["ops-*"]),
    ("recipe", &["op"]),
    ("cache", &["recipe"]),
    ("engine", &["cache", "io", "render"]),
    ("cli", &["engine", "view", "ops-pictures", "ops-all"]),
    ("benches", &["ops-*", "engine"]),
    ("tests", &["cli"]),
];

/// The crates of other people that `cargo build` compiles. A change that needs more of them says what it adds to the
/// time of a first build.
const MOST_PACKAGES: usize = 117;

fn cargo(arguments: &str) -> String {
    let output = Command::new(env!("CARGO"))
        .args(arguments.split(' '))
        .args(["--offline", "--locked"])
        .current_dir(root())
        .output()
        .expect("cargo runs");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "cargo {arguments}: {errors}");
    String::from_utf8(output.stdout).expect("cargo writes UTF-8")
}

/// Everything to the left of a crate; `ops-*` stands for every group of operations.
fn left_of(name: &str) -> BTreeSet<&'static str> {
    let is_group = name.starts_with("ops-") && name != "ops-all";
    let entry = if is_group { "ops-*" } else { name };
    let (_, nearest) = LEFT_OF
        .iter()
        .find(|(crate_name, _)| *crate_name == entry)
        .unwrap_or_else(|| panic!("DESIGN.md and this test have no place for the crate {name}"));
    let mut all = BTreeSet::new();
    for near in *nearest {
        all.insert(*near);
        all.extend(left_of(near));
    }
    all
}

#[test]
fn crates_know_only_what_stands_left_of_them() {
    let metadata = cargo("metadata --no-deps --format-version 1");
    let metadata: Value = serde_json::from_str(&metadata).expect("cargo writes JSON");
    let short = |value: &Value| -> Option<String> {
        Some(
            value["name"]
                .as_str()?
                .strip_prefix("meshwright-")?
                .to_owned(),
        )
    };
    let packages = metadata["packages"].as_array().expect("a list");
    let crates: BTreeMap<String, &Value> = packages
        .iter()
        .filter_map(|package| Some((short(package)?, package)))
        .collect();
    let mut failures = Vec::new();
    for (name, package) in &crates {
        let allowed = left_of(name);
        for dependency in package["dependencies"].as_array().expect("a list") {
            let Some(used) = short(dependency).filter(|used| crates.contains_key(used)) else {
                continue;
            };
            let is_group = used.starts_with("ops-") && used != "ops-all";
            let is_allowed =
                allowed.contains(used.as_str()) || is_group && allowed.contains("ops-*");
            // Tests may use more.
            if dependency["kind"].is_null() && !is_allowed {
                failures.push(format!(
                    "{name} uses {used}, which does not stand left of it"
                ));
            }
        }
    }
    assert!(crates.len() > 20, "the packages are found by their names");
    assert_none(&failures);
}

#[test]
fn a_first_build_compiles_no_more_packages_than_before() {
    let tree =
        cargo("tree -p meshwright-cli -e normal --prefix none --target x86_64-unknown-linux-gnu");
    let packages: BTreeSet<&str> = tree
        .lines()
        .map(|line| line.trim_end_matches(" (*)"))
        // Those of this workspace have a path.
        .filter(|line| !line.contains(" (") || line.ends_with("(proc-macro)"))
        .collect();
    let n = packages.len();
    assert!(
        n <= MOST_PACKAGES,
        "{n} packages, at most {MOST_PACKAGES} before: {packages:#?}"
    );
}
