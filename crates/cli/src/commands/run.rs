//! `meshwright run`: runs a recipe.

use ::cache::Cache;
use anyhow::Context as _;
use engine::{Engine, Loaded, Run};
use mesh::counted;
use recipe::Outcome;

use crate::args::{Format, RunArgs};
use crate::cache;
use crate::capsule;
use crate::events::Events;
use crate::listener::{Terminal, catch_interrupts};
use crate::loading::load;
use crate::output::{
    explain, explain_steps, print, print_diagnostics, print_error, print_json, step_notes,
    step_table,
};
use crate::picture_errors::{PictureListener, Pictures};
use crate::pipes::recipe_name;

pub(crate) fn run(args: &RunArgs, engine: &Engine) -> anyhow::Result<bool> {
    start_threads(args.threads)?;
    let mut loaded = load_to_run(args, engine)?;
    let cache = cache::open(&args.cache)?;
    catch_interrupts();
    let pictures = (args.picture_errors).of(recipe_name(&args.recipe.recipe), args.recipe.budget);
    let Some(outcome) = execute(args, &loaded, cache.as_ref(), &pictures, &|| true)? else {
        return Ok(false);
    };
    if args.recipe.format == Format::Human {
        print_outcome(args, &loaded, &outcome, &pictures)?;
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
        print_error(&format!(
            "to reproduce the failure: meshwright run {}\n",
            path.display()
        ));
    }
    Ok(outcome.succeeded())
}

/// Sets the number of threads of this program.
pub(crate) fn start_threads(n: Option<u16>) -> anyhow::Result<()> {
    let Some(n) = n else { return Ok(()) };
    rayon::ThreadPoolBuilder::new()
        .num_threads(n.into())
        .build_global()
        .context("cannot start the threads")
}

/// Reads and checks the recipe. If `--no-expect` is given, its expectations are left out.
pub(crate) fn load_to_run(args: &RunArgs, engine: &Engine) -> anyhow::Result<Loaded> {
    let mut loaded = load(&args.recipe, engine)?;
    if args.no_expect {
        loaded.recipe.expectations.clear();
    }
    Ok(loaded)
}

/// Runs a recipe until its end or until `go_on` returns false. Draws failures if `--picture-errors` is given. If the
/// recipe has errors, prints them and returns `None`. If the option `--format json` is given, prints the events of the
/// run.
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
            report_errors(loaded, json)?;
        }
        return Ok(None);
    }
    if !json {
        print_diagnostics(loaded, &loaded.diagnostics);
    }
    let caching = cache.map(|cache| cache::caching_for(cache, recipe_name(&args.recipe.recipe)));
    let run = Run {
        keep_outputs: true,
        cache: caching.as_ref().map(|caching| caching as _),
    };
    let terminal = Terminal::until(go_on);
    let events = json.then(|| Events::start(loaded, &terminal));
    let listener = PictureListener {
        listener: events.as_ref().map_or(&terminal, |events| events as _),
        pictures,
    };
    let outcome = loaded.run(run, &listener);
    terminal.clear();
    if let Some(events) = events {
        events.end(Some(&outcome), pictures)?;
    }
    if let Some(problem) = &outcome.cache_problem {
        print_error(&cache::warning(problem));
    }
    Ok(Some(outcome))
}

/// Prints the results of a run.
pub(crate) fn print_outcome(
    args: &RunArgs,
    loaded: &Loaded,
    outcome: &Outcome,
    pictures: &Pictures,
) -> anyhow::Result<()> {
    if !outcome.steps.is_empty() {
        print(&step_table(&loaded.recipe, outcome))?;
    }
    if args.explain {
        print(&explain_steps(outcome))?;
    }
    print(&step_notes(&outcome.steps))?;
    print_diagnostics(loaded, &outcome.failures);
    pictures.print_list();
    for path in &outcome.written {
        print(&format!("wrote {}\n", path.display()))?;
    }
    if outcome.succeeded() {
        let n = outcome.checked;
        if n > 0 {
            print(&format!("{} met\n", counted(n, "expectation")))?;
        }
        print(&format!("digest {}\n", outcome.digest))?;
    } else if outcome.cancelled {
        print_error("interrupted, no files were written\n");
    } else {
        let written = match outcome.written.len() {
            0 => ", no files were written".to_owned(),
            n => format!(" after writing {}", counted(n, "file")),
        };
        print_error(&format!("{} failed{written}\n", loaded.path));
        if !outcome.unmet.is_empty() {
            let mut parameters = loaded.recipe.parameters().iter();
            let reason = if parameters.any(recipe::Parameter::is_set) {
                "perhaps the expectations hold only for the default values of the parameters: "
            } else {
                ""
            };
            print_error(&format!(
                "{reason}to write the files without checking expectations, use --no-expect\n"
            ));
        }
    }
    Ok(())
}

/// Prints the errors of a recipe that cannot be run.
pub(crate) fn report_errors(loaded: &Loaded, json: bool) -> anyhow::Result<bool> {
    if json {
        let problems = engine::json::problems(&loaded.diagnostics, &loaded.recipe.sources);
        print_json(&serde_json::json!({
            "recipe": loaded.path, "succeeded": false, "failures": problems,
        }))?;
        return Ok(false);
    }
    print_diagnostics(loaded, &loaded.diagnostics);
    let errors = counted(loaded.n_errors(), "error");
    print_error(&format!("{errors}, no step was run\n"));
    Ok(false)
}
