//! `meshwright run`: runs a recipe.

use ::cache::Cache;
use anyhow::Context as _;
use engine::{Engine, Loaded, Run};
use recipe::Outcome;

use crate::args::{Format, RunArgs};
use crate::cache;
use crate::capsule;
use crate::events::Events;
use crate::listener::{Terminal, catch_interrupts};
use crate::loading::load;
use crate::output::{
    complain, counted, explain, explain_steps, print, print_json, problems_json, show, step_notes,
    step_table,
};
use crate::picture_errors::{Pictures, Picturing};

pub(crate) fn run(args: &RunArgs, engine: &Engine) -> anyhow::Result<bool> {
    start_threads(args.threads)?;
    let mut loaded = load_to_run(args, engine)?;
    let cache = cache::open(&args.cache)?;
    catch_interrupts();
    let pictures = (args.picture_errors).of(&args.recipe.recipe, args.recipe.budget);
    let Some(outcome) = execute(args, &loaded, cache.as_ref(), &pictures, &|| true)? else {
        return Ok(false);
    };
    if args.recipe.format == Format::Human {
        tell(args, &loaded, &outcome, &pictures)?;
    }
    let number = outcome.steps.len();
    if let Some(folder) = &args.capsule
        && !outcome.cancelled
        && number < loaded.recipe.steps.len()
    {
        let message = outcome.failures.last().map_or("", |f| f.message.as_str());
        let scene = capsule::scene_before(&mut loaded, number)?;
        capsule::write(&loaded, number, message, &scene, folder)?;
        let path = folder.join("recipe.ron");
        complain(&format!(
            "see it fail again with: meshwright run {}\n",
            path.display()
        ));
    }
    Ok(outcome.succeeded())
}

/// Makes this program run on so many threads.
pub(crate) fn start_threads(n: Option<u16>) -> anyhow::Result<()> {
    let Some(n) = n else { return Ok(()) };
    rayon::ThreadPoolBuilder::new()
        .num_threads(n.into())
        .build_global()
        .context("cannot start the threads")
}

/// Reads and checks the recipe of a command that runs it.
pub(crate) fn load_to_run(args: &RunArgs, engine: &Engine) -> anyhow::Result<Loaded> {
    let mut loaded = load(&args.recipe, engine)?;
    if args.no_expect {
        loaded.recipe.expectations.clear();
    }
    Ok(loaded)
}

/// Runs a recipe, if it can run, as long as `go_on` holds, and draws what fails. Shows what is wrong with one that
/// cannot run, and events if the command asks for them.
pub(crate) fn execute(
    args: &RunArgs,
    loaded: &Loaded,
    cache: Option<&Cache>,
    pictures: &Pictures,
    go_on: &(dyn Fn() -> bool + Sync),
) -> anyhow::Result<Option<Outcome>> {
    let json = args.recipe.format == Format::Json;
    if args.explain && !json {
        print(&explain(&loaded.recipe))?;
    }
    if loaded.has_errors() {
        if json {
            Events::start(loaded, &op::NoProgress).end(None, &Pictures::default())?;
        } else {
            refuse(loaded, json)?;
        }
        return Ok(None);
    }
    if !json {
        show(loaded, &loaded.diagnostics);
    }
    let caching = cache.map(|cache| cache::using(cache, &args.recipe.recipe));
    let run = Run {
        keep_outputs: true,
        cache: caching.as_ref().map(|caching| caching as _),
    };
    let terminal = Terminal::until(go_on);
    let events = json.then(|| Events::start(loaded, &terminal));
    let listener = Picturing {
        listener: events.as_ref().map_or(&terminal, |events| events as _),
        pictures,
    };
    let outcome = loaded.run(run, &listener);
    terminal.clear();
    if let Some(events) = events {
        events.end(Some(&outcome), pictures)?;
    }
    if let Some(problem) = &outcome.cache_problem {
        complain(&cache::warning(problem));
    }
    Ok(Some(outcome))
}

/// Prints what a run has done.
pub(crate) fn tell(
    args: &RunArgs,
    loaded: &Loaded,
    outcome: &Outcome,
    pictures: &Pictures,
) -> anyhow::Result<()> {
    if !outcome.steps.is_empty() {
        print(&step_table(&outcome.steps))?;
    }
    if args.explain {
        print(&explain_steps(outcome))?;
    }
    print(&step_notes(&outcome.steps))?;
    show(loaded, &outcome.failures);
    pictures.tell();
    for path in &outcome.written {
        print(&format!("wrote {}\n", path.display()))?;
    }
    if outcome.succeeded() {
        let n = outcome.checked;
        if n > 0 {
            let hold = if n == 1 { "holds" } else { "hold" };
            print(&format!("{} {hold}\n", counted(n, "expectation")))?;
        }
        print(&format!("digest {}\n", outcome.digest))?;
    } else if outcome.cancelled {
        complain("interrupted, nothing was written\n");
    } else {
        complain(&format!("{} failed, nothing was written\n", loaded.path));
        let parameters = loaded.recipe.parameters();
        let is_set = parameters.iter().any(recipe::Parameter::is_set);
        if is_set && outcome.steps.len() == loaded.recipe.steps.len() {
            complain(
                "a parameter was set: expectations may be meant for its default; --no-expect runs without them\n",
            );
        }
    }
    Ok(())
}

/// Shows what is wrong with a recipe that cannot run.
pub(crate) fn refuse(loaded: &Loaded, json: bool) -> anyhow::Result<bool> {
    if json {
        let problems = problems_json(&loaded.diagnostics, &loaded.recipe.sources);
        print_json(&serde_json::json!({
            "recipe": loaded.path, "succeeded": false, "failures": problems,
        }))?;
        return Ok(false);
    }
    show(loaded, &loaded.diagnostics);
    let errors = counted(loaded.n_errors(), "error");
    complain(&format!("{errors}, nothing was run\n"));
    Ok(false)
}
