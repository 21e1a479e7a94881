//! `meshwright upgrade`: rewrites older spellings in recipes.

use std::path::Path;

use op::Registry;
use recipe::Source;
use recipe::upgrade::upgrade;

use crate::args::UpgradeArgs;
use crate::loading::recipes;
use crate::output::{complain, counted, print};

pub(crate) fn run(args: &UpgradeArgs, registry: &Registry) -> anyhow::Result<bool> {
    let recipes = recipes(&args.recipes)?;
    let (mut failed, mut old) = (0, 0);
    for found in &recipes {
        match one(&found.path, args.check, registry) {
            Ok(true) => old += 1,
            Ok(false) => {}
            Err(error) => {
                failed += 1;
                complain(&format!("error: {error:#}\n"));
            }
        }
    }
    let n = counted(recipes.len(), "recipe");
    print(&match (old, args.check) {
        (0, _) => format!("{n}, nothing to rewrite\n"),
        (_, true) => format!("{n}, {old} to rewrite\n"),
        (_, false) => format!("{n}, {old} rewritten\n"),
    })?;
    Ok(failed == 0 && !(args.check && old > 0))
}

/// Upgrades one recipe, or only says what there is to do. Returns whether it is of an older spelling.
fn one(path: &Path, only_check: bool, registry: &Registry) -> anyhow::Result<bool> {
    let source = Source::open(path).map_err(anyhow::Error::msg)?;
    let shown = path.display().to_string();
    let upgraded = match upgrade(&source.text, registry) {
        Ok(upgraded) => upgraded,
        Err(problems) => {
            complain(&recipe::render(&[source], &problems, false));
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
