//! `meshwright test`: runs recipes as tests, several of them at the same time.
//!
//! Prints a line for each recipe, in the order of the given paths, and then a summary. The recipes of a folder are
//! sorted by name. If the option `--format json` is given, prints one JSON object:
//!
//! ```text
//! {
//!   "succeeded": true,            at least one passed, none failed, Ctrl-C was not pressed
//!   "passed": 1, "failed": 0,
//!   "no_expectations": 1,         read, but not run
//!   "called_by_others": 0,        called by other tested recipes, and not run by themselves
//!   "not_run": 0,                 because of Ctrl-C
//!   "recipes": [{
//!     "recipe": "scenes/a.ron",
//!     "state": "passed",          or "failed", "no expectations", "called by others", "not run"
//!     "expectations": 3,          the number of expectations that were checked
//!     "digest": "..",             of the final scene; null if the recipe was not run
//!     "milliseconds": 12.5,
//!     "changes": ["scenes/a.ron:7: Faces(eq: 4) -> 6"],          made by --update
//!     "failures": [{"severity": "error", "line": 4, "column": 9, "message": "..", "help": null}],
//!     "pictures": ["a-error-1.png"]                               pictures of failures, with --picture-errors
//!   }]
//! }
//! ```

mod junit;

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use ::cache::Cache;
use anyhow::ensure;
use engine::{Engine, Loaded, Run};
use mesh::counted;
use recipe::{Diagnostic, JobLimits};
use serde_json::{Value as Json, json};

use super::test_update::update_recorded_values;
use crate::args::{Format, TestArgs, ValueArgs};
use crate::cache;
use crate::listener::{INTERRUPT, catch_interrupts};
use crate::loading::{Checking, RecipeFile, load_text, recipes};
use crate::many::{JobResult, error_message, run_all, run_in_order};
use crate::output::{print, print_diagnostics, print_error, print_json, write_atomically};
use crate::picture_errors::{PictureListener, Pictures};

pub(crate) fn run(args: &TestArgs, engine: &Engine) -> anyhow::Result<bool> {
    let recipes = recipes(&args.paths)?;
    ensure!(!recipes.is_empty(), "found no recipes (*.ron) to test");
    catch_interrupts();
    let tests = tests(&recipes, args, engine)?;
    let cache = cache::open(&args.cache)?;

    let run = |i: usize| tests[i].run(args, cache.as_ref());
    let bytes = |i: usize| tests[i].bytes();
    let (mut results, mut printed) = (Vec::new(), Ok(()));
    run_in_order(tests.len(), args.many.limits(), bytes, run, |i, end| {
        let result = end.unwrap_or_else(|panicked| TestResult {
            state: match panicked {
                Some(_) => State::Failed,
                None => State::NotRun,
            },
            message: panicked,
            ..TestResult::default()
        });
        if args.format == Format::Human && printed.is_ok() {
            printed = tests[i].show(&result);
        }
        results.push(result);
    })?;
    printed?;
    if let Some(problem) = cache.as_ref().and_then(Cache::problem) {
        print_error(&cache::warning(problem));
    }

    if let Some(path) = &args.junit {
        write_atomically(path, junit::tests_report(&tests, &results).as_bytes())?;
    }
    let count = |state: State| results.iter().filter(|r| r.state == state).count();
    let (failed, not_run) = (count(State::Failed), count(State::NotRun));
    let (passed, called) = (count(State::Passed), count(State::Called));
    let without_expectations = count(State::NoExpectations);
    if args.format == Format::Json {
        let rows = tests.iter().zip(&results);
        print_json(&json!({
            "succeeded": failed == 0 && not_run == 0 && passed > 0,
            "passed": passed,
            "failed": failed,
            "no_expectations": without_expectations,
            "called_by_others": called,
            "not_run": not_run,
            "recipes": rows.map(|(test, result)| test.json(result)).collect::<Vec<_>>(),
        }))?;
    } else {
        let mut summary = format!("{passed} passed, {failed} failed");
        if without_expectations > 0 {
            summary += &format!(", {without_expectations} without expectations");
        }
        if called > 0 {
            summary += &format!(", {called} called by other recipes");
        }
        if not_run > 0 {
            summary += &format!(", {not_run} not run: interrupted");
        }
        print(&format!("{summary}\n"))?;
    }
    if passed + failed + not_run == 0 {
        print_error(
            "error: nothing was tested: each recipe either has no expectations or is called by other recipes\n",
        );
    }
    Ok(failed == 0 && not_run == 0 && passed > 0)
}

/// Returns the recipes that are run as tests of their own. They are among the given paths or below the given folders.
pub(crate) fn tested(paths: &[PathBuf], engine: &Engine) -> anyhow::Result<Vec<PathBuf>> {
    let recipes = recipes(paths)?;
    let limits = JobLimits {
        threads: 0,
        jobs: 0,
        budget: engine::BUDGET,
    };
    let checking = Checking {
        budget: limits.budget,
        strict: false,
    };
    let mut tests = read(&recipes, None, limits, checking, engine)?;
    mark_called(&mut tests);
    tests.retain(|test| test.reason_not_to_run().is_none());
    Ok(tests.iter().map(|test| test.found.path.clone()).collect())
}

/// Reads and checks the recipes. Recipes that the filter does not select are left out.
fn tests<'a>(
    recipes: &'a [RecipeFile],
    args: &TestArgs,
    engine: &Engine,
) -> anyhow::Result<Vec<Test<'a>>> {
    let (limits, checking) = (args.many.limits(), args.many.checking());
    let mut tests = read(recipes, args.out.as_deref(), limits, checking, engine)?;
    if let Some(filter) = &args.filter {
        tests.retain(|test| test.found.path.to_string_lossy().contains(filter));
        let found = counted(recipes.len(), "recipe");
        ensure!(
            !tests.is_empty(),
            "found {found}, but none has \"{filter}\" in its path"
        );
    }
    mark_called(&mut tests);
    if let Some(out) = &args.out {
        let mut owners = HashMap::new();
        for Test { found, .. } in &tests {
            if let Some(other) = owners.insert(&found.own_folder, &found.path) {
                anyhow::bail!(
                    "{} and {} would both write to the folder {}: test them in separate runs",
                    other.display(),
                    found.path.display(),
                    out.join(&found.own_folder).display()
                );
            }
        }
    }
    Ok(tests)
}

/// Reads and checks the recipes.
fn read<'a>(
    recipes: &'a [RecipeFile],
    out: Option<&Path>,
    limits: JobLimits,
    checking: Checking,
    engine: &Engine,
) -> anyhow::Result<Vec<Test<'a>>> {
    let loaded = run_all(recipes.len(), limits, |i| {
        let found = &recipes[i];
        let out = out.map_or_else(|| "out".into(), |out| out.join(&found.own_folder));
        let source = engine.open(&found.path)?;
        load_text(&source, &ValueArgs::default(), &out, checking, engine)
    })?;
    let made = recipes.iter().zip(loaded);
    Ok(made.map(|(found, end)| Test::new(found, end)).collect())
}

/// Marks the recipes that other recipes of the list call.
fn mark_called(tests: &mut [Test]) {
    let place = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    let read = tests.iter().filter_map(|test| test.loaded.as_ref().ok());
    let called: HashSet<PathBuf> = read
        .flat_map(|loaded| loaded.recipe.sources.iter().skip(1))
        .map(|source| place(&source.path))
        .collect();
    for test in tests {
        test.is_called = !test.found.is_named && called.contains(&place(&test.found.path));
    }
}

/// A recipe to test.
struct Test<'a> {
    found: &'a RecipeFile,
    /// The loaded recipe, or an error if it cannot be read.
    loaded: Result<Loaded, String>,
    /// Whether the recipe was found in a folder and another tested recipe calls it. If so, the recipe is not run as a
    /// test of its own.
    is_called: bool,
}

impl<'a> Test<'a> {
    fn new(found: &'a RecipeFile, loaded: JobResult<anyhow::Result<Loaded>>) -> Self {
        let loaded = loaded.map_err(error_message);
        Self {
            found,
            loaded: loaded.and_then(|loaded| loaded.map_err(|error| format!("{error:#}"))),
            is_called: false,
        }
    }

    /// Returns the recipe if it must be run as a test of its own and has no errors.
    fn to_run(&self) -> Option<&Loaded> {
        let loaded = self.loaded.as_ref().ok()?;
        let runs = !loaded.has_errors() && !self.is_called && expects(loaded);
        runs.then_some(loaded)
    }

    /// If the recipe is not run as a test of its own, returns the reason.
    ///
    /// A called recipe can need objects that the calling recipe creates. If checking such a recipe alone finds errors,
    /// these errors are ignored.
    fn reason_not_to_run(&self) -> Option<State> {
        let loaded = self.loaded.as_ref().ok().filter(|loaded| loaded.is_read)?;
        match (self.is_called, expects(loaded)) {
            (true, _) => Some(State::Called),
            (false, false) => Some(State::NoExpectations),
            (false, true) => None,
        }
    }

    fn bytes(&self) -> u64 {
        self.to_run().map_or(0, |l| l.forecast.peak_bytes())
    }

    fn run(&self, args: &TestArgs, cache: Option<&Cache>) -> TestResult {
        let begin = Instant::now();
        let loaded = match &self.loaded {
            Ok(loaded) => loaded,
            Err(message) => return TestResult::failed(&[], Some(message.clone())),
        };
        if let Some(state) = self.reason_not_to_run() {
            return TestResult {
                state,
                ..TestResult::default()
            };
        }
        if loaded.has_errors() {
            return TestResult::failed(&loaded.diagnostics, None);
        }
        let pictures = if args.update {
            // The failures are not drawn, because updating the recorded values can fix them.
            Pictures::default()
        } else {
            let name = &self.found.own_folder;
            args.picture_errors.named(name, loaded.budget)
        };
        let listener = PictureListener {
            listener: &INTERRUPT,
            pictures: &pictures,
        };
        let caching = cache.map(|cache| cache::caching_for(cache, &self.found.path));
        let run = Run {
            keep_outputs: args.out.is_some(),
            cache: caching.as_ref().map(|caching| caching as _),
        };
        let mut outcome = loaded.run(run, &listener);
        let mut changes = Vec::new();
        if args.update {
            match update_recorded_values(&self.found.path, loaded, &mut outcome) {
                Ok(lines) => changes = lines,
                Err(error) => {
                    return TestResult::failed(&outcome.failures, Some(format!("{error:#}")));
                }
            }
        }
        let state = match (outcome.succeeded(), outcome.cancelled) {
            (_, true) => State::NotRun,
            (true, _) => State::Passed,
            (false, _) => State::Failed,
        };
        TestResult {
            state,
            expectations: outcome.checked,
            digest: (!outcome.cancelled).then(|| outcome.digest.to_string()),
            time: begin.elapsed(),
            changes,
            diagnostics: outcome.failures,
            message: None,
            pictures,
        }
    }

    /// Prints the line with the result of the recipe, and then its errors.
    fn show(&self, result: &TestResult) -> anyhow::Result<()> {
        let path = self.found.path.display();
        let word = match result.state {
            State::Passed => "ok    ",
            State::Failed => "FAILED",
            State::NoExpectations | State::Called | State::NotRun => "-     ",
        };
        let rest = match (result.state, &result.digest) {
            (State::NoExpectations, _) => " (no expectations, not run)".to_owned(),
            (State::Called, _) => " (called by other recipes, not run)".to_owned(),
            (State::NotRun, _) => " (not run)".to_owned(),
            (_, None) => String::new(),
            (_, Some(digest)) => {
                let (n, time) = (result.expectations, result.time.as_secs_f64() * 1e3);
                let expectations = counted(n, "expectation");
                format!(" ({expectations}, {time:.0} ms, digest {digest})")
            }
        };
        for line in &result.changes {
            print(&format!("{line}\n"))?;
        }
        print(&format!("{word} {path}{rest}\n"))?;
        if let Some(message) = &result.message {
            print_error(&format!("error: {message}\n"));
        }
        if let Ok(loaded) = &self.loaded {
            print_diagnostics(loaded, &result.diagnostics);
        }
        result.pictures.print_list();
        Ok(())
    }

    fn json(&self, result: &TestResult) -> Json {
        let mut failures: Vec<Json> = Vec::new();
        if let Ok(loaded) = &self.loaded {
            let problems = engine::json::problems(&result.diagnostics, &loaded.recipe.sources);
            failures.extend(problems.iter().map(|problem| json!(problem)));
        }
        let message = result.message.iter();
        failures.extend(message.map(|m| json!({ "severity": "error", "message": m })));
        json!({
            "recipe": self.found.path.display().to_string(),
            "state": result.state.name(),
            "expectations": result.expectations,
            "digest": result.digest,
            "milliseconds": result.time.as_secs_f64() * 1e3,
            "changes": result.changes,
            "failures": failures,
            "pictures": result.pictures.paths(),
        })
    }
}

/// Whether the recipe has expectations, or steps that must be refused.
fn expects(loaded: &Loaded) -> bool {
    let recipe = &loaded.recipe;
    !recipe.expectations.is_empty() || recipe.steps.iter().any(|step| step.refused.is_some())
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum State {
    Passed,
    #[default]
    Failed,
    NoExpectations,
    Called,
    NotRun,
}

impl State {
    fn name(self) -> &'static str {
        match self {
            Self::Passed => "passed",
            Self::Failed => "failed",
            Self::NoExpectations => "no expectations",
            Self::Called => "called by others",
            Self::NotRun => "not run",
        }
    }
}

/// How a test ended.
#[derive(Default)]
struct TestResult {
    state: State,
    /// The number of expectations that were checked.
    expectations: usize,
    /// The digest of the final scene, if the recipe was run and the run was not canceled.
    digest: Option<String>,
    time: Duration,
    /// The changes that `--update` made. Each change is described in one line.
    changes: Vec<String>,
    /// The problems of the recipe or of its run.
    diagnostics: Vec<Diagnostic>,
    /// The message of an error that is not one of the problems in `diagnostics`.
    message: Option<String>,
    /// The pictures of the failures.
    pictures: Pictures,
}

impl TestResult {
    /// Returns the result of a recipe that could not be run or updated.
    fn failed(diagnostics: &[Diagnostic], message: Option<String>) -> Self {
        Self {
            diagnostics: diagnostics.to_vec(),
            message,
            ..Self::default()
        }
    }
}
