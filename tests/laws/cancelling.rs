//! Operations and runs that are told to stop.

use std::sync::atomic::{AtomicUsize, Ordering};

use engine::FileReader;
use op::{OpError, Progress};
use recipe::{Listener, Outcome, Settings, StepDone};

use crate::assert_none;
use crate::every_op::{Case, files};
use crate::samples::samples;

/// Goes on so many times and then says stop.
struct StopAfter {
    allowed: usize,
    calls: AtomicUsize,
}

impl StopAfter {
    fn new(allowed: usize) -> Self {
        let calls = AtomicUsize::new(0);
        Self { allowed, calls }
    }

    fn was_asked(&self) -> bool {
        self.calls.load(Ordering::Relaxed) > self.allowed
    }
}

impl Progress for StopAfter {
    fn advance(&self, _: &str, _: u64, _: u64) -> bool {
        self.calls.fetch_add(1, Ordering::Relaxed) < self.allowed
    }
}

#[test]
fn an_operation_that_is_cancelled_at_once_has_changed_nothing() {
    let mut failures = Vec::new();
    for case in Case::all() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let stop = StopAfter::new(0);
        let (scene, result) = case.run(folder.path(), &stop);
        let mut written = folder.path().read_dir().expect("the folder is there");
        let was_cancelled = matches!(result, Err(OpError::Cancelled));
        if stop.was_asked() && !was_cancelled {
            failures.push(format!("{}: asked whether to stop, and did not", case.name));
        }
        // An operation that finds nothing to do need not ask.
        if (result.is_ok() || was_cancelled) && scene != case.scene {
            failures.push(format!("{}: changed the scene before it asked", case.name));
        }
        if written.next().is_some() {
            failures.push(format!("{}: wrote a file", case.name));
        }
    }
    assert_none(&failures);
}

/// What comes before a step in the recipes of the next test: an object of each name that samples use.
const PRELUDE: &str = r#"
    Cube(name: "mesh", triangles: true),
    Octahedron(name: "other"),
    Load(path: "teapot.bez", name: "patches"),
    Load(path: "curve.bzc"),
"#;

#[test]
fn a_run_that_is_cancelled_ends_with_the_scene_from_before_the_step() {
    let registry = ops_all::registry();
    let mut failures = Vec::new();
    for (entry, sample) in samples(&registry) {
        let step = format!("{}{sample}", entry.name);
        let before = run(PRELUDE, usize::MAX);
        assert!(before.outcome.succeeded(), "{:?}", before.outcome.failures);
        let whole = run(&format!("{PRELUDE}{step}"), usize::MAX);
        for stop_at in [before.calls, whole.calls.saturating_sub(1)] {
            if stop_at < before.calls || stop_at >= whole.calls {
                continue;
            }
            let stopped = run(&format!("{PRELUDE}{step}"), stop_at).outcome;
            if !stopped.cancelled {
                failures.push(format!("{step}: call {stop_at} did not stop it"));
            }
            if stopped.scene != before.outcome.scene {
                failures.push(format!(
                    "{step}: stopped at call {stop_at}, the scene is another"
                ));
            }
            if !stopped.written.is_empty() {
                failures.push(format!("{step}: stopped at call {stop_at}, but wrote"));
            }
        }
    }
    assert_none(&failures);
}

/// How a run ended.
struct Run {
    outcome: Outcome,
    /// How often it was asked whether to go on.
    calls: usize,
}

/// Runs a list of steps and says stop after so many questions.
fn run(steps: &str, allowed: usize) -> Run {
    let source = format!("(recipe: 1, steps: [{steps}])");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let reading = recipe::read(
        &recipe::Source::new(folder.path().join("cancelled.ron"), source.as_str()),
        &ops_all::registry(),
        recipe::Values::default(),
    );
    assert!(!reading.has_errors(), "{steps}: {:?}", reading.diagnostics);
    let stop = StopAfter::new(allowed);
    let settings = Settings {
        files: &files(folder.path()),
        budget: u64::MAX,
        reader: &FileReader,
        keep_outputs: true,
        writes: true,
        cache: None,
    };
    let outcome = recipe::run(&reading.recipe, settings, &stop);
    let calls = stop.calls.load(Ordering::Relaxed);
    Run { outcome, calls }
}

impl Listener for StopAfter {
    fn step_begins(&self, _: usize, _: &str) {}
    fn step_done(&self, _: usize, _: &StepDone) {}
}
