//! Tests of the step cache. The tests check which steps run again and why, and that the outcome is the same as without
//! the cache.

mod damage;
mod law;
#[path = "../../recipe/src/tests/operations.rs"]
mod operations;

use std::cell::Cell;
use std::fs;
use std::path::{Path, PathBuf};

use op::{Context, FileUse, Files, OpError, Operation, Plan, PlanContext, Problem, Report};
use scene::{Object, Scene};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tempfile::TempDir;

use recipe::{Outcome, Reader, RerunReason, Settings, Silent, Violation};

use self::operations::{registry, steps};
use crate::{Cache, Caching};

/// Reads a file that contains a number n, and returns a grid of n faces.
struct GridReader;

impl Reader for GridReader {
    fn scene(&self, path: &Path, files: &Files) -> Result<Scene, Violation> {
        files.has_read(path);
        let text = fs::read_to_string(path).map_err(|error| error.to_string())?;
        let n = text.trim().parse().map_err(|_| "no number")?;
        let mut scene = Scene::new();
        let object = Object::mesh("file", geometry::shapes::grid(n, 1));
        scene.insert(object).map_err(|error| error.to_string())?;
        Ok(scene)
    }

    fn compare_pictures(
        &self,
        _: (&Path, &[u8]),
        _: (&Path, &[u8]),
        _: u8,
    ) -> Result<Option<String>, Violation> {
        Err("these tests compare no pictures".into())
    }
}

/// Makes a sheet whose number of squares is read from a file.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
struct FromFile {
    /// The file.
    path: String,
    /// Whether the step reports that it has read the file.
    #[serde(default)]
    reports: bool,
}

impl Operation for FromFile {
    const NAME: &'static str = "FromFile";
    const SUMMARY: &'static str = "Make a sheet";
    const EXAMPLE: &'static str = r#"FromFile(path: "sheet.txt")"#;

    fn plan(&self, plan: &mut Plan, _: &PlanContext) -> Vec<Problem> {
        plan.incomplete = true;
        Vec::new()
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        let path = cx.files().to_read(&self.path);
        if self.reports {
            cx.files().has_read(path.as_path());
            cx.files()
                .has_checked_existence(path.with_extension("beside"));
        }
        let text = fs::read_to_string(&path).unwrap_or_else(|_| "1".to_owned());
        let n = text.trim().parse().unwrap_or(1);
        let object = Object::mesh("file", geometry::shapes::grid(n, 1));
        let inserted = scene.insert(object);
        inserted.map_err(|error| OpError::Object(error.to_string()))?;
        Ok(Report::changed(1).note(format!("read {text}")))
    }
}

/// A test folder with inputs, a cache and outputs.
struct Place {
    folder: TempDir,
    cache: Cache,
    budget: Cell<u64>,
    recipe: Option<PathBuf>,
    want_scene: bool,
    keep_outputs: bool,
}

impl Place {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        Self {
            cache: Cache::new(folder.path().join("cache"), u64::MAX, "tests 1"),
            budget: Cell::new(u64::MAX),
            recipe: Some(folder.path().join("recipe.ron")),
            folder,
            want_scene: false,
            keep_outputs: true,
        }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    fn caching(&self) -> Caching<'_> {
        Caching {
            cache: &self.cache,
            recipe: self.recipe.as_deref(),
            want_scene: self.want_scene,
        }
    }

    #[track_caller]
    fn run_with(&self, text: &str, caching: Option<Caching>, out: &str) -> Outcome {
        let registry = registry().with::<FromFile>();
        let source = recipe::Source::new(self.path("recipe.ron"), text);
        let reading = recipe::read(&source, &registry, recipe::Values::default());
        assert!(!reading.has_errors(), "{text}: {:?}", reading.diagnostics);
        let files = Files {
            input: self.folder.path().into(),
            output: self.path(out),
            placeholders: reading.recipe.placeholders(),
            provenance: Some(reading.recipe.digest()),
            ..Files::default()
        };
        let settings = Settings {
            files: &files,
            budget: self.budget.get(),
            reader: &GridReader,
            keep_outputs: self.keep_outputs,
            writes: text.contains("Write"),
            cache: caching
                .as_ref()
                .map(|caching| caching as &dyn recipe::StepCache),
        };
        recipe::run(&reading.recipe, settings, &Silent)
    }

    /// Runs a recipe with the cache and without it, and asserts that the outcomes are the same.
    #[track_caller]
    fn run(&self, text: &str) -> Outcome {
        let plain = self.run_with(text, None, "plain");
        let cached = self.run_with(text, Some(self.caching()), "out");
        assert_same(&plain, &cached);
        let files = |outcome: &Outcome, out| {
            let of = |path: &PathBuf| {
                let name = path.strip_prefix(self.path(out)).unwrap().to_owned();
                (name, fs::read(path).unwrap())
            };
            outcome.written.iter().map(of).collect::<Vec<_>>()
        };
        assert_eq!(files(&plain, "plain"), files(&cached, "out"));
        cached
    }

    /// Runs a recipe. Returns the numbers (counted from 1) of the steps that ran, and why they ran.
    #[track_caller]
    fn ran(&self, text: &str) -> Vec<(usize, String)> {
        let outcome = self.run(text);
        let why =
            |(i, step): (usize, &recipe::StepDone)| Some((i + 1, step.ran.as_ref()?.to_string()));
        outcome.steps.iter().enumerate().filter_map(why).collect()
    }

    #[track_caller]
    fn runs_nothing(&self, text: &str) {
        assert_eq!(self.ran(text), Vec::new(), "{text}");
    }

    #[track_caller]
    fn numbers(&self, text: &str) -> Vec<usize> {
        self.ran(text).into_iter().map(|(i, _)| i).collect()
    }
}

/// Asserts that two outcomes are the same, except for times and messages about the cache.
#[track_caller]
fn assert_same(a: &Outcome, b: &Outcome) {
    let steps = |outcome: &Outcome| {
        let of = |s: &recipe::StepDone| {
            let counts = [s.vertices, s.edges, s.faces];
            (s.label.clone(), s.report.clone(), s.refused, counts)
        };
        outcome.steps.iter().map(of).collect::<Vec<_>>()
    };
    assert_eq!(steps(a), steps(b));
    assert_eq!(a.failures, b.failures);
    assert_eq!((a.cancelled, a.checked), (b.cancelled, b.checked));
    assert_eq!(a.digest, b.digest);
    if let (Some(a), Some(b)) = (&a.scene, &b.scene) {
        assert!(a == b, "the scenes differ");
    }
}

/// Returns a recipe of ten steps. Step 1 makes a sheet, and each later step i lifts it by `change(i)`.
fn ten(change: impl Fn(usize) -> f64) -> String {
    let lift = |i| format!("(id: \"lift{i}\", run: Lift(by: {:?}))", change(i));
    let lifts: Vec<String> = (2..=10).map(lift).collect();
    let lifts = lifts.join(", ");
    steps(&format!("Sheet(columns: 4), {lifts}"))
}

#[test]
fn a_second_run_runs_nothing() {
    let place = Place::new();
    let text = ten(|_| 1.5);
    assert_eq!(place.numbers(&text), (1..=10).collect::<Vec<_>>());
    place.runs_nothing(&text);
}

#[test]
fn only_the_changed_step_and_later_steps_run_again() {
    let place = Place::new();
    place.run(&ten(|_| 1.5));
    let last = ten(|i| if i == 10 { 2.5 } else { 1.5 });
    let why = "parameters changed: by 1.5 -> 2.5".to_owned();
    assert_eq!(place.ran(&last), [(10, why.clone())]);
    place.run(&ten(|_| 1.5));
    let ninth = ten(|i| if i == 9 { 2.5 } else { 1.5 });
    let after = "the earlier step 9 lift9 ran again".to_owned();
    assert_eq!(place.ran(&ninth), [(9, why), (10, after)]);
    // After both runs, the cache contains the results of both versions of the recipe.
    place.runs_nothing(&ten(|_| 1.5));
    place.runs_nothing(&ninth);
}

#[test]
fn recipes_with_the_same_steps_share_their_results() {
    let mut place = Place::new();
    let and = |more| steps(&format!("Sheet(columns: 4), Lift(by: 1), {more}"));
    place.run(&and(""));
    place.recipe = Some(place.path("other.ron"));
    let why = "the step has not run before".to_owned();
    assert_eq!(place.ran(&and("Lift(by: 3)")), [(3, why)]);
}

#[test]
fn a_change_of_any_key_ingredient_runs_a_step_again() {
    let base = "Sheet(columns: 2), Sheet(columns: 3, name: \"b\"), (id: \"x\", run: Lift(by: 1))";
    let with = |last: &str| base.replace("(id: \"x\", run: Lift(by: 1))", last);
    for (changed, why) in [
        (
            with("(id: \"x\", run: Lift(by: 2))"),
            "parameters changed: by 1.0 -> 2.0",
        ),
        (
            with("(id: \"y\", run: Lift(by: 1))"),
            "the id of the step changed, and random choices depend on the id",
        ),
        (
            with("(id: \"x\", run: Lift(by: 1), on: [\"b\"])"),
            "`on` changed",
        ),
        (
            with("(id: \"x\", run: Lift(by: 1, fails: Seam), refused: Seam)"),
            "parameters changed: fails None -> Seam",
        ),
        (
            base.replace("columns: 3", "columns: 4"),
            "the earlier step 2 Sheet ran again",
        ),
        (
            base.replacen("Sheet(columns: 2), ", "", 1),
            "the earlier step 1 Sheet ran again",
        ),
    ] {
        let place = Place::new();
        place.run(&steps(base));
        let ran = place.ran(&steps(&changed));
        assert_eq!(
            ran.last().map(|(_, why)| why.as_str()),
            Some(why),
            "{changed}"
        );
    }
}

#[test]
fn a_different_budget_or_program_runs_all_steps_again() {
    let mut place = Place::new();
    let text = steps("Sheet(columns: 2), Lift(by: 1)");
    place.run(&text);
    place.budget.set(1 << 30);
    let ran = place.ran(&text);
    assert_eq!(ran[0], (1, "the memory budget changed".to_owned()));
    assert_eq!(ran[1].0, 2);
    place.cache = Cache::new(place.path("cache"), u64::MAX, "tests 2");
    let why = "the last run used a different version or build of the program".to_owned();
    assert_eq!(place.ran(&text), [(1, why.clone()), (2, why)]);
}

#[test]
fn an_input_file_that_changes_disappears_or_appears_is_named() {
    let place = Place::new();
    let text = steps("FromFile(path: \"n.txt\", reports: true), Lift(by: 1)");
    let n = place.path("n.txt").display().to_string();
    let beside = place.path("n.beside").display().to_string();
    place.write("n.txt", "3");
    place.run(&text);
    place.runs_nothing(&text);
    for (change, why) in [
        (
            Box::new(|| place.write("n.txt", "4")) as Box<dyn Fn()>,
            format!("the file {n} changed"),
        ),
        (
            Box::new(|| fs::remove_file(place.path("n.txt")).unwrap()),
            format!("the file {n} no longer exists"),
        ),
        (
            Box::new(|| place.write("n.txt", "5")),
            format!("the file {n} did not exist before"),
        ),
        (
            Box::new(|| place.write("n.beside", "")),
            format!("the file {beside} did not exist before"),
        ),
    ] {
        change();
        let ran = place.ran(&text);
        assert_eq!(ran[0], (1, why));
        place.runs_nothing(&text);
    }
    // After these changes, both files have the same content as in an earlier run. The result of that run is still in
    // the cache.
    fs::remove_file(place.path("n.beside")).unwrap();
    place.write("n.txt", "4");
    place.runs_nothing(&text);
}

#[test]
fn a_step_that_does_not_report_what_it_reads_runs_every_time() {
    let place = Place::new();
    let text = steps("FromFile(path: \"n.txt\"), Lift(by: 1), Lift(by: 2)");
    place.write("n.txt", "3");
    place.run(&text);
    let ran = place.ran(&text);
    assert_eq!(ran.len(), 1);
    assert!(
        ran[0]
            .1
            .starts_with("the input files of the step cannot be determined ("),
        "{ran:?}"
    );
    place.write("n.txt", "4");
    assert_eq!(place.numbers(&text), [1, 2, 3]);
    // The contents `3` and ` 3` give the same scene, and later steps depend only on the scene.
    place.write("n.txt", " 3");
    assert_eq!(place.numbers(&text), [1]);
}

#[test]
fn the_same_path_in_a_different_folder_is_a_different_file() {
    let (a, mut b) = (Place::new(), Place::new());
    b.cache = Cache::new(a.path("cache"), u64::MAX, "tests 1");
    a.write("n.txt", "3");
    b.write("n.txt", "4");
    for (steps, expect) in [
        ("FromFile(path: \"n.txt\", reports: true)", "Not(Closed)"),
        ("Sheet(columns: 3)", "Same(as: File(\"n.txt\"))"),
    ] {
        let text = format!("(recipe: 1, steps: [{steps}], expect: [{expect}])");
        for _ in 0..2 {
            a.run(&text);
            b.run(&text);
        }
        a.runs_nothing(&text);
        b.runs_nothing(&text);
    }
}

#[test]
fn on_loss_is_checked_for_cached_results_too() {
    let place = Place::new();
    let text = "(recipe: 1, steps: [Sheet(columns: 2), (run: Lift(by: 1), on_loss: Error)])";
    place.run(text);
    place.runs_nothing(text);
}

#[test]
fn outputs_come_from_the_cache_with_the_same_bytes() {
    let mut place = Place::new();
    let text = steps(
        "Sheet(columns: 2), Write(path: \"deep/a.txt\"), Lift(by: 1), Write(path: \"b.txt\")",
    );
    place.run(&text);
    fs::remove_dir_all(place.path("out")).unwrap();
    place.runs_nothing(&text);
    assert_eq!(fs::read(place.path("out/deep/a.txt")).unwrap(), b"sheet");
    // The provenance has changed. The output files may contain the provenance, so they are written again.
    let edited = text.replace("by: 1", "by: 2");
    let ran = place.ran(&edited);
    assert_eq!(ran[0], (2, RerunReason::Provenance.to_string()));
    assert_eq!(ran[1].0, 3);
    place.keep_outputs = false;
    let other = text.replace("by: 1", "by: 3");
    place.run(&other);
    place.runs_nothing(&other);
}

#[test]
fn an_expected_refusal_is_cached_and_leaves_the_scene_unchanged() {
    let place = Place::new();
    let text =
        steps("Sheet(columns: 2), (run: Lift(by: 1, fails: Seam), refused: Seam), Lift(by: 3)");
    place.run(&text);
    place.runs_nothing(&text);
    assert_eq!(place.numbers(&text.replace("by: 3", "by: 4")), [3]);
}

#[test]
fn a_failing_step_is_not_stored_and_fails_again() {
    let place = Place::new();
    let text = steps("Sheet(columns: 2), Lift(by: 1, fails: Pinch), Lift(by: 2)");
    for _ in 0..2 {
        let outcome = place.run(&text);
        assert_eq!((outcome.steps.len(), outcome.failures.len()), (1, 1));
    }
    assert_eq!(place.numbers(&text.replace(", fails: Pinch", "")), [2, 3]);
}

#[test]
fn expectations_that_hold_are_not_checked_again() {
    let place = Place::new();
    place.write("n.txt", "2");
    let text = r#"(recipe: 1, steps: [(id: "sheet", run: Sheet(columns: 2)), (id: "up", run: Lift(by: 1))],
        expect: [(after: "sheet", that: Same(as: File("n.txt"))), Faces(eq: 2), (after: "up", that: Not(Closed))])"#;
    place.run(text);
    let outcome = place.run(text);
    assert_eq!(outcome.checked, 3);
    assert!(outcome.scene.is_none(), "the scene was not needed");
    // The expectation compares the scene with a file. If this file changes, the expectation is checked again.
    place.write("n.txt", "3");
    let outcome = place.run(text);
    assert_eq!(outcome.failures.len(), 1);
    place.write("n.txt", "2");
    assert!(place.run(text).scene.is_none());
    // A new expectation is checked against the scene after its step.
    let outcome = place.run(&text.replace("Faces(eq: 2)", "Vertices(eq: 7)"));
    assert_eq!(outcome.failures.len(), 1);
    assert!(outcome.steps.iter().all(|step| step.ran.is_none()));
}

#[test]
fn the_final_scene_is_loaded_if_it_is_wanted() {
    let mut place = Place::new();
    let text = steps("Sheet(columns: 2), Lift(by: 1)");
    place.run(&text);
    assert!(place.run(&text).scene.is_none());
    place.want_scene = true;
    let outcome = place.run(&text);
    assert!(outcome.steps.iter().all(|step| step.ran.is_none()));
    assert_eq!(outcome.scene.unwrap().digest(), outcome.digest);
}

#[test]
fn a_large_scene_that_is_fast_to_compute_may_be_computed_again() {
    let place = Place::new();
    let text = steps("Sheet(columns: 60000), Write(path: \"a.txt\")");
    place.run(&text);
    // On a fast machine, storing the scene can take longer than computing it. The scene is then not stored, but the
    // outcome is the same.
    let more = text.replace("])", ", Sheet(columns: 1, name: \"b\")])");
    let outcome = place.run(&more);
    assert_eq!(outcome.steps.len(), 3);
    assert!(outcome.steps[2].ran.is_some());
}

#[test]
fn file_logs_can_be_taken_through_any_clone() {
    let files = Files::default();
    files.to_read("elsewhere");
    assert_eq!(files.log.take().len(), 1);
    files.log.note(FileUse::Read("a".into()));
    let copy = files.clone();
    assert_eq!(copy.log.take().len(), 1);
    assert_eq!(files.log.take(), []);
}
