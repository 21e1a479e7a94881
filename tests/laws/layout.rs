//! Checks the dependencies between crates, and the number of packages in a first build.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use serde_json::Value;

use crate::{assert_none, root};

/// The direct dependencies that each crate is allowed to have. A crate can also use everything that its direct
/// dependencies can use.
const ALLOWED_DEPENDENCIES: &[(&str, &[&str])] = &[
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
    ("editor", &["engine"]),
    ("python", &["cli"]),
    ("web", &["engine", "ops-all"]),
    ("viewer", &["editor", "view", "ops-all"]),
    ("benches", &["ops-*", "engine"]),
    ("tests", &["cli"]),
];

/// The maximum number of external packages that `cargo build` compiles. A commit that raises this number must state how
/// much time it adds to a first build.
const MAX_PACKAGES: usize = 122;

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

/// Returns all crates that a crate can use. `ops-*` stands for every group of operations.
fn allowed_for(name: &str) -> BTreeSet<&'static str> {
    let is_group = name.starts_with("ops-") && name != "ops-all";
    let entry = if is_group { "ops-*" } else { name };
    let (_, nearest) = ALLOWED_DEPENDENCIES
        .iter()
        .find(|(crate_name, _)| *crate_name == entry)
        .unwrap_or_else(|| panic!("add the crate {name} to ALLOWED_DEPENDENCIES"));
    let mut all = BTreeSet::new();
    for near in *nearest {
        all.insert(*near);
        all.extend(allowed_for(near));
    }
    all
}

#[test]
fn crates_use_only_allowed_dependencies() {
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
        let allowed = allowed_for(name);
        for dependency in package["dependencies"].as_array().expect("a list") {
            let Some(used) = short(dependency).filter(|used| crates.contains_key(used)) else {
                continue;
            };
            let is_group = used.starts_with("ops-") && used != "ops-all";
            let is_allowed =
                allowed.contains(used.as_str()) || is_group && allowed.contains("ops-*");
            // The dependencies of tests are not checked.
            if dependency["kind"].is_null() && !is_allowed {
                failures.push(format!(
                    "{name} uses {used}, which is not an allowed dependency"
                ));
            }
        }
    }
    assert!(crates.len() > 20, "the packages are found by their names");
    assert_none(&failures);
}

#[test]
fn a_first_build_compiles_at_most_max_packages() {
    let tree =
        cargo("tree -p meshwright-cli -e normal --prefix none --target x86_64-unknown-linux-gnu");
    let packages: BTreeSet<&str> = tree
        .lines()
        .map(|line| line.trim_end_matches(" (*)"))
        // Leaves out packages of this workspace: `cargo tree` prints their paths.
        .filter(|line| !line.contains(" (") || line.ends_with("(proc-macro)"))
        .collect();
    let n = packages.len();
    assert!(
        n <= MAX_PACKAGES,
        "{n} packages, expected at most {MAX_PACKAGES}: {packages:#?}"
    );
}
