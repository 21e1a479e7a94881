//! Tests the cancellation of operations and runs.

#[cfg(unix)]
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
#[cfg(unix)]
use std::time::Duration;

use engine::FileReader;
#[cfg(unix)]
use geometry::shapes;
use op::{OpError, Progress};
use recipe::{Listener, Outcome, Settings, StepDone};
#[cfg(unix)]
use scene::{Object, Scene};

use crate::assert_none;
use crate::every_op::{Case, files};
#[cfg(unix)]
use crate::growth::processor_time;
use crate::samples::samples;

/// A progress listener that cancels after a number of calls.
struct StopAfter {
    allowed: usize,
    calls: AtomicUsize,
}

impl StopAfter {
    fn new(allowed: usize) -> Self {
        let calls = AtomicUsize::new(0);
        Self { allowed, calls }
    }

    fn has_cancelled(&self) -> bool {
        self.calls.load(Ordering::Relaxed) > self.allowed
    }
}

impl Progress for StopAfter {
    fn advance(&self, _: &str, _: u64, _: u64) -> bool {
        self.calls.fetch_add(1, Ordering::Relaxed) < self.allowed
    }
}

#[test]
fn an_operation_cancelled_at_its_first_call_changes_nothing() {
    let mut failures = Vec::new();
    for case in Case::all() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let stop = StopAfter::new(0);
        let (scene, result) = case.run(folder.path(), &stop);
        let mut written = folder.path().read_dir().expect("the folder exists");
        let was_cancelled = matches!(result, Err(OpError::Cancelled));
        if stop.has_cancelled() && !was_cancelled {
            failures.push(format!("{}: did not stop when cancelled", case.name));
        }
        // The run was canceled at the first progress call, or the operation made no progress call. In both cases, the
        // scene must be unchanged.
        if (result.is_ok() || was_cancelled) && scene != case.scene {
            failures.push(format!(
                "{}: changed the scene before its first progress call",
                case.name
            ));
        }
        if written.next().is_some() {
            failures.push(format!("{}: wrote a file", case.name));
        }
    }
    assert_none(&failures);
}

/// A progress listener that measures the longest processor time between two calls.
#[cfg(unix)]
struct Gaps(Mutex<Gap>);

#[cfg(unix)]
#[derive(Default)]
struct Gap {
    last: Duration,
    last_task: String,
    longest: Duration,
    between: [String; 2],
}

#[cfg(unix)]
impl Gaps {
    fn new() -> Self {
        Self(Mutex::new(Gap {
            last: processor_time(),
            ..Gap::default()
        }))
    }

    fn call(&self, task: &str) {
        let now = processor_time();
        let mut gap = self.0.lock().expect("not poisoned");
        let length = now.saturating_sub(gap.last);
        if length > gap.longest {
            gap.longest = length;
            gap.between = [gap.last_task.clone(), task.to_owned()];
        }
        gap.last = now;
        task.clone_into(&mut gap.last_task);
    }
}

#[cfg(unix)]
impl Progress for Gaps {
    fn advance(&self, task: &str, _: u64, _: u64) -> bool {
        self.call(task);
        true
    }
}

/// Steps that take several seconds on large meshes.
#[cfg(unix)]
const LONG_STEPS: &[&str] = &[
    "Unwrap()",
    "Remesh(length: 0.02)",
    "Simplify(ratio: 0.1)",
    "Smooth(by: Implicit(time: 0.01))",
    "Measure(of: Thickness)",
    "FlipEdges(edges: All, until: Delaunay)",
    "LoopSubdivide(levels: 2)",
    "Save(path: \"a.obj.gz\")",
    "Picture(path: \"a.png\", size: (2000, 2000))",
];

/// Usually, the time between two progress calls is much shorter than one second. The limit is one second, so that the
/// test does not fail on a slow machine.
#[test]
#[cfg(unix)]
fn long_steps_report_progress_at_least_once_a_second() {
    let registry = ops_all::registry();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let failures = pool.expect("a thread can be started").install(|| {
        let mut failures = Vec::new();
        let mut scene = Scene::new();
        let torus = shapes::fans(&shapes::torus(200, 100, 2.0, 1.0));
        scene.insert(Object::mesh("mesh", torus)).expect("a name");
        for step in LONG_STEPS {
            let (name, _) = step.split_once('(').expect("a step has parameters");
            let entry = registry.get(name).expect(step);
            let case = Case::new(entry, &step[name.len()..], "a torus", &scene);
            let folder = tempfile::tempdir().expect("a temporary folder");
            let gaps = Gaps::new();
            let (_, result) = case.run(folder.path(), &gaps);
            gaps.call("the end");
            let gap = gaps.0.into_inner().expect("not poisoned");
            println!("{:?} {step}: between {:?}", gap.longest, gap.between);
            if let Err(error) = result {
                failures.push(format!("{step}: {error}"));
            } else if gap.longest > Duration::from_secs(1) {
                let (longest, between) = (gap.longest, gap.between);
                failures.push(format!(
                    "{step}: no progress for {longest:?} between {between:?}"
                ));
            }
        }
        failures
    });
    assert_none(&failures);
}

/// The first steps of each recipe that `run` executes, before the tested step. These steps create an object for each
/// name to which the sample parameters of operations refer.
const PRELUDE: &str = r#"
    Cube(name: "mesh", triangles: true),
    Octahedron(name: "other"),
    Load(path: "teapot.bez", name: "patches"),
    Load(path: "curve.bzc"),
"#;

#[test]
fn a_cancelled_run_ends_with_the_scene_before_the_step() {
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
                failures.push(format!(
                    "{step}: cancelling at call {stop_at} did not stop the run"
                ));
            }
            if stopped.scene != before.outcome.scene {
                failures.push(format!(
                    "{step}: stopped at call {stop_at}, but the scene has changed"
                ));
            }
            if !stopped.written.is_empty() {
                failures.push(format!(
                    "{step}: stopped at call {stop_at}, but wrote files"
                ));
            }
        }
    }
    assert_none(&failures);
}

struct Run {
    outcome: Outcome,
    /// The number of progress calls.
    calls: usize,
}

/// Runs a list of steps and cancels after `allowed` progress calls.
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
