//! `meshwright upgrade`: rewrites outdated names in recipes.

use std::path::Path;

use mesh::counted;
use op::Registry;
use recipe::Source;
use recipe::upgrade::upgrade;

use crate::args::UpgradeArgs;
use crate::loading::recipes;
use crate::output::{print, print_error};

pub(crate) fn run(args: &UpgradeArgs, registry: &Registry) -> anyhow::Result<bool> {
    let recipes = recipes(&args.recipes)?;
    let (mut failed, mut outdated) = (0, 0);
    for found in &recipes {
        match upgrade_recipe(&found.path, args.check, registry) {
            Ok(true) => outdated += 1,
            Ok(false) => {}
            Err(error) => {
                failed += 1;
                print_error(&format!("error: {error:#}\n"));
            }
        }
    }
    let n = counted(recipes.len(), "recipe");
    print(&match (outdated, args.check) {
        (0, _) => format!("{n}, nothing to rewrite\n"),
        (_, true) => format!("{n}, {outdated} to rewrite\n"),
        (_, false) => format!("{n}, {outdated} rewritten\n"),
    })?;
    Ok(failed == 0 && !(args.check && outdated > 0))
}

/// Upgrades one recipe. If `only_check` is true, lists the changes but does not make them. Returns whether the recipe
/// has outdated names.
fn upgrade_recipe(path: &Path, only_check: bool, registry: &Registry) -> anyhow::Result<bool> {
    let source = Source::open(path)?;
    let shown = path.display().to_string();
    let upgraded = match upgrade(&source.text, registry) {
        Ok(upgraded) => upgraded,
        Err(problems) => {
            print_error(&recipe::render(&[source], &problems, false));
            anyhow::bail!("{shown} cannot be upgraded");
        }
    };
    for (line, rename) in &upgraded.renames {
        let (from, to) = (&rename.from, &rename.to);
        print(&format!("{shown}:{line}: {from} -> {to}\n"))?;
    }
    if !only_check && upgraded.text != *source.text {
        store::replace(path, upgraded.text.as_bytes())?;
    }
    Ok(!upgraded.renames.is_empty())
}
