//! `meshwright test`: runs recipes as tests.

use std::path::Path;
use std::time::Instant;

use op::Registry;
use recipe::{Settings, Silent};

use super::test_update::renew;
use crate::args::TestArgs;
use crate::loading::{load_recipe, read_objects, recipes};
use crate::output::{complain, print, show};

pub(crate) fn run(args: &TestArgs, registry: &Registry) -> anyhow::Result<bool> {
    let recipes = recipes(&args.paths)?;
    anyhow::ensure!(!recipes.is_empty(), "there are no recipes (*.ron) to test");
    let mut failed = 0;
    for path in &recipes {
        if !one(path, args, registry)? {
            failed += 1;
        }
    }
    let passed = recipes.len() - failed;
    print(&format!("{passed} passed, {failed} failed\n"))?;
    Ok(failed == 0)
}

/// Runs one recipe and prints its line. A recipe that cannot be read has failed too.
fn one(path: &Path, args: &TestArgs, registry: &Registry) -> anyhow::Result<bool> {
    let begin = Instant::now();
    let out = match (&args.out, path.file_stem()) {
        (Some(out), Some(stem)) => out.join(stem),
        _ => "out".into(),
    };
    let line = |word: &str, rest: &str| print(&format!("{word} {}{rest}\n", path.display()));
    let loaded = match load_recipe(path, &[], None, &out, args.budget, registry) {
        Ok(loaded) => loaded,
        Err(error) => {
            line("FAILED", "")?;
            complain(&format!("error: {error:#}\n"));
            return Ok(false);
        }
    };
    if loaded.has_errors() {
        line("FAILED", "")?;
        show(&loaded, &loaded.diagnostics);
        return Ok(false);
    }
    let settings = Settings {
        files: &loaded.files,
        budget: args.budget,
        read: &read_objects,
        keep_outputs: args.out.is_some(),
        writes: !loaded.forecast.outputs.is_empty(),
    };
    let mut outcome = recipe::run(&loaded.recipe, settings, &Silent);
    if args.update {
        renew(path, &loaded, &mut outcome)?;
    }
    let (n, time) = (outcome.checked, begin.elapsed().as_secs_f64() * 1e3);
    let word = if outcome.succeeded() {
        "ok    "
    } else {
        "FAILED"
    };
    line(
        word,
        &format!(
            " ({n} expectations, {time:.0} ms, digest {})",
            outcome.digest
        ),
    )?;
    show(&loaded, &outcome.failures);
    Ok(outcome.succeeded())
}
