//! `meshwright run`: runs a recipe.

use anyhow::Context as _;
use op::Registry;
use recipe::{Outcome, Settings};

use crate::args::{Format, RunArgs};
use crate::cache;
use crate::events::Events;
use crate::listener::{Terminal, catch_interrupts};
use crate::loading::{Loaded, load, read_objects};
use crate::output::{
    complain, explain, explain_steps, print, problems_json, show, step_notes, step_table,
};

pub(crate) fn run(args: &RunArgs, registry: &Registry) -> anyhow::Result<bool> {
    if let Some(threads) = args.threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads.into())
            .build_global()
            .context("cannot start the threads")?;
    }
    let mut loaded = load(&args.recipe, registry)?;
    if args.no_expect {
        loaded.recipe.expectations.clear();
    }
    let json = args.recipe.format == Format::Json;
    if args.explain && !json {
        print(&explain(&loaded.recipe))?;
    }
    if loaded.has_errors() {
        if json {
            Events::start(&loaded, &op::NoProgress).refused()?;
            return Ok(false);
        }
        return refuse(&loaded, json);
    }
    if !json {
        show(&loaded, &loaded.diagnostics);
    }

    let cache = cache::open(&args.cache)?;
    catch_interrupts();
    let terminal = Terminal::new();
    let settings = Settings {
        files: &loaded.files,
        budget: args.recipe.budget,
        read: &read_objects,
        keep_outputs: true,
        writes: !loaded.forecast.outputs.is_empty(),
        cache: cache
            .as_ref()
            .map(|cache| cache::using(cache, &args.recipe.recipe)),
    };
    if json {
        let events = Events::start(&loaded, &terminal);
        events.problems(&loaded.diagnostics);
        let outcome = recipe::run(&loaded.recipe, settings, &events);
        terminal.clear();
        warn_of_cache(&outcome);
        events.end(&outcome)?;
        return Ok(outcome.succeeded());
    }
    let outcome = recipe::run(&loaded.recipe, settings, &terminal);
    terminal.clear();
    warn_of_cache(&outcome);

    if !outcome.steps.is_empty() {
        print(&step_table(&outcome.steps))?;
    }
    if args.explain {
        print(&explain_steps(&outcome))?;
    }
    print(&step_notes(&outcome.steps))?;
    show(&loaded, &outcome.failures);
    for path in &outcome.written {
        print(&format!("wrote {}\n", path.display()))?;
    }
    if outcome.succeeded() {
        let n = outcome.checked;
        if n > 0 {
            print(&format!("{n} expectations hold\n"))?;
        }
        print(&format!("digest {}\n", outcome.digest))?;
    } else if outcome.cancelled {
        complain("interrupted, nothing was written\n");
    } else {
        complain(&format!("{} failed, nothing was written\n", loaded.path));
        let is_set = loaded
            .recipe
            .parameters()
            .iter()
            .any(recipe::Parameter::is_set);
        if is_set && outcome.steps.len() == loaded.recipe.steps.len() {
            complain(
                "a parameter was set: expectations may be meant for its default; --no-expect runs without them\n",
            );
        }
    }
    Ok(outcome.succeeded())
}

fn warn_of_cache(outcome: &Outcome) {
    if let Some(problem) = &outcome.cache_problem {
        complain(&cache::warning(problem));
    }
}

/// Shows what is wrong with a recipe that cannot run.
pub(crate) fn refuse(loaded: &Loaded, json: bool) -> anyhow::Result<bool> {
    if json {
        let problems = problems_json(&loaded.diagnostics, &loaded.recipe.sources);
        let report = serde_json::json!({
            "recipe": loaded.path, "succeeded": false, "failures": problems,
        });
        print(&format!("{report:#}\n"))?;
        return Ok(false);
    }
    show(loaded, &loaded.diagnostics);
    let n = loaded.n_errors();
    let errors = if n == 1 {
        "1 error".to_owned()
    } else {
        format!("{n} errors")
    };
    complain(&format!("{errors}, nothing was run\n"));
    Ok(false)
}
