//! `meshwright test`: runs recipes as tests, several at once.
//!
//! A line for each recipe, in the order of their paths, and a summary; or with `--format json` one
//! object:
//!
//! ```text
//! {
//!   "succeeded": true,            none failed, none was left out by Ctrl-C
//!   "passed": 1, "failed": 0,
//!   "no_expectations": 1,         read, and not run
//!   "called_by_others": 0,        read, and not run by themselves
//!   "not_run": 0,                 because of Ctrl-C
//!   "recipes": [{
//!     "recipe": "scenes/a.ron",
//!     "state": "passed",          or "failed", "no expectations", "called by others", "not run"
//!     "expectations": 3,          how many were held against the scene
//!     "digest": "..",             of the scene at the end; null if it was not run
//!     "milliseconds": 12.5,
//!     "changes": ["scenes/a.ron:7: Faces(eq: 4) -> 6"],          what --update has written
//!     "failures": [{"severity": "error", "line": 4, "column": 9, "message": "..", "help": null}],
//!     "pictures": ["a-error-1.png"]                               of failures, with --picture-errors
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
use recipe::Diagnostic;
use serde_json::{Value as Json, json};

use super::test_update::renew;
use crate::args::{Format, TestArgs, ValueArgs};
use crate::cache;
use crate::listener::{QUIET, catch_interrupts};
use crate::loading::{RecipeFile, load_text, recipes};
use crate::many::{Ended, all, in_order, interrupted};
use crate::output::{complain, counted, print, print_json, problems_json, show, write_whole};
use crate::picture_errors::{Pictures, Picturing};

pub(crate) fn run(args: &TestArgs, engine: &Engine) -> anyhow::Result<bool> {
    let recipes = recipes(&args.paths)?;
    ensure!(!recipes.is_empty(), "there are no recipes (*.ron) to test");
    catch_interrupts();
    let tests = tests(&recipes, args, engine)?;
    let cache = cache::open(&args.cache)?;

    let run = |i: usize| tests[i].run(args, cache.as_ref());
    let bytes = |i: usize| tests[i].bytes();
    let (mut results, mut printed) = (Vec::new(), Ok(()));
    in_order(tests.len(), args.many.limits(), bytes, run, |i, end| {
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
        complain(&cache::warning(problem));
    }

    if let Some(path) = &args.junit {
        write_whole(path, junit::report(&tests, &results).as_bytes())?;
    }
    let count = |state: State| results.iter().filter(|r| r.state == state).count();
    let (failed, not_run) = (count(State::Failed), count(State::NotRun));
    let (passed, called) = (count(State::Passed), count(State::Called));
    let unexpecting = count(State::NoExpectations);
    if args.format == Format::Json {
        let rows = tests.iter().zip(&results);
        print_json(&json!({
            "succeeded": failed == 0 && not_run == 0 && passed > 0,
            "passed": passed,
            "failed": failed,
            "no_expectations": unexpecting,
            "called_by_others": called,
            "not_run": not_run,
            "recipes": rows.map(|(test, result)| test.json(result)).collect::<Vec<_>>(),
        }))?;
    } else {
        let mut summary = format!("{passed} passed, {failed} failed");
        if unexpecting > 0 {
            summary += &format!(", {unexpecting} without expectations");
        }
        if called > 0 {
            summary += &format!(", {called} called by others");
        }
        if not_run > 0 {
            summary += &format!(", {not_run} not run: interrupted");
        }
        print(&format!("{summary}\n"))?;
    }
    if passed + failed + not_run == 0 {
        complain(
            "error: nothing was tested: no recipe has expectations, or others call all that have\n",
        );
    }
    Ok(failed == 0 && not_run == 0 && passed > 0)
}

/// Reads and checks the recipes, and chooses those that were asked for.
fn tests<'a>(
    recipes: &'a [RecipeFile],
    args: &TestArgs,
    engine: &Engine,
) -> anyhow::Result<Vec<Test<'a>>> {
    let loaded = all(recipes.len(), args.many.limits(), |i| {
        load(&recipes[i], args, engine)
    })?;
    let made = recipes.iter().zip(loaded);
    let mut tests: Vec<Test> = made.map(|(found, end)| Test::new(found, end)).collect();
    let place = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    let read = tests.iter().filter_map(|test| test.loaded.as_ref().ok());
    let called: HashSet<PathBuf> = read
        .flat_map(|loaded| loaded.recipe.sources.iter().skip(1))
        .map(|source| place(&source.path))
        .collect();
    for test in &mut tests {
        test.is_part = !test.found.is_named && called.contains(&place(&test.found.path));
    }
    if let Some(filter) = &args.filter {
        tests.retain(|test| test.found.path.to_string_lossy().contains(filter));
        let n = recipes.len();
        ensure!(
            !tests.is_empty(),
            "none of {n} recipes has \"{filter}\" in its path"
        );
    }
    if let Some(out) = &args.out {
        let mut owners = HashMap::new();
        for Test { found, .. } in &tests {
            if let Some(other) = owners.insert(&found.own_folder, &found.path) {
                anyhow::bail!(
                    "{} and {} would both write into {}: test them one after the other",
                    other.display(),
                    found.path.display(),
                    out.join(&found.own_folder).display()
                );
            }
        }
    }
    Ok(tests)
}

fn load(found: &RecipeFile, args: &TestArgs, engine: &Engine) -> anyhow::Result<Loaded> {
    let out = match &args.out {
        Some(out) => out.join(&found.own_folder),
        None => "out".into(),
    };
    let source = engine.open(&found.path).map_err(anyhow::Error::msg)?;
    load_text(
        &source,
        &ValueArgs::default(),
        &out,
        args.many.budget,
        engine,
    )
}

/// A recipe to test.
struct Test<'a> {
    found: &'a RecipeFile,
    /// What runs it; or why it cannot even be read.
    loaded: Result<Loaded, String>,
    /// Whether it was found beside recipes that call it, which hold its expectations then.
    is_part: bool,
}

impl<'a> Test<'a> {
    fn new(found: &'a RecipeFile, loaded: Ended<anyhow::Result<Loaded>>) -> Self {
        let loaded = loaded.map_err(interrupted);
        Self {
            found,
            loaded: loaded.and_then(|loaded| loaded.map_err(|error| format!("{error:#}"))),
            is_part: false,
        }
    }

    /// The recipe that can run, if it can and should.
    fn to_run(&self) -> Option<&Loaded> {
        let loaded = self.loaded.as_ref().ok()?;
        let runs = !loaded.has_errors() && !self.is_part && expects(loaded);
        runs.then_some(loaded)
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
        // What a part of other recipes needs from them is missing when it is checked alone.
        if loaded.is_read && (self.is_part || !expects(loaded)) {
            let state = if self.is_part {
                State::Called
            } else {
                State::NoExpectations
            };
            return TestResult {
                state,
                ..TestResult::default()
            };
        }
        if loaded.has_errors() {
            return TestResult::failed(&loaded.diagnostics, None);
        }
        let pictures = if args.update {
            // What it mends is no failure.
            Pictures::default()
        } else {
            let name = &self.found.own_folder;
            args.picture_errors.named(name, loaded.budget)
        };
        let listener = Picturing {
            listener: &QUIET,
            pictures: &pictures,
        };
        let caching = cache.map(|cache| cache::using(cache, &self.found.path));
        let run = Run {
            keep_outputs: args.out.is_some(),
            cache: caching.as_ref().map(|caching| caching as _),
        };
        let mut outcome = loaded.run(run, &listener);
        let mut changes = Vec::new();
        if args.update {
            match renew(&self.found.path, loaded, &mut outcome) {
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

    /// Prints the line of the recipe, and what is wrong with it.
    fn show(&self, result: &TestResult) -> anyhow::Result<()> {
        let path = self.found.path.display();
        let word = match result.state {
            State::Passed => "ok    ",
            State::Failed => "FAILED",
            State::NoExpectations | State::Called | State::NotRun => "-     ",
        };
        let rest = match (result.state, &result.digest) {
            (State::NoExpectations, _) => " (no expectations, not run)".to_owned(),
            (State::Called, _) => " (a part that others call, not run)".to_owned(),
            (State::NotRun, _) => " (not run)".to_owned(),
            (_, None) => String::new(),
            (_, Some(digest)) => {
                let (n, time) = (result.expectations, result.time.as_secs_f64() * 1e3);
                let held = counted(n, "expectation");
                format!(" ({held}, {time:.0} ms, digest {digest})")
            }
        };
        for line in &result.changes {
            print(&format!("{line}\n"))?;
        }
        print(&format!("{word} {path}{rest}\n"))?;
        if let Some(message) = &result.message {
            complain(&format!("error: {message}\n"));
        }
        if let Ok(loaded) = &self.loaded {
            show(loaded, &result.diagnostics);
        }
        result.pictures.tell();
        Ok(())
    }

    fn json(&self, result: &TestResult) -> Json {
        let mut failures: Vec<Json> = Vec::new();
        if let Ok(loaded) = &self.loaded {
            let problems = problems_json(&result.diagnostics, &loaded.recipe.sources);
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

/// Whether the recipe says what must come out, or what must be refused.
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
    /// How many expectations were held against the scene.
    expectations: usize,
    /// The digest of the scene at the end, if the recipe was run.
    digest: Option<String>,
    time: Duration,
    /// What was written anew in the recipe, a line each.
    changes: Vec<String>,
    /// What is wrong with the recipe or with what it made.
    diagnostics: Vec<Diagnostic>,
    /// What is wrong beside that.
    message: Option<String>,
    /// The pictures of what is wrong.
    pictures: Pictures,
}

impl TestResult {
    /// A recipe that was not run.
    fn failed(diagnostics: &[Diagnostic], message: Option<String>) -> Self {
        Self {
            diagnostics: diagnostics.to_vec(),
            message,
            ..Self::default()
        }
    }
}
