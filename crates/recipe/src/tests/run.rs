//! Tests of running recipes: a run writes either all outputs or none.

use std::fs;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use mesh::DVec3;
use op::{ErrorLocation, Files, Progress};
use scene::{Digest, Scene};
use tempfile::TempDir;

use super::{files, objects, read, read_with, shown, steps};
use crate::{Failure, Listener, Outcome, Reading, Settings, Silent, StepDone, run};

/// Runs a recipe without errors.
#[track_caller]
fn ran(text: &str, output: &Path) -> Outcome {
    let reading = read(text);
    assert_eq!(reading.diagnostics, [], "{text}");
    run_reading(&reading, output, true, &Silent)
}

fn run_reading(
    reading: &Reading,
    output: &Path,
    keep_outputs: bool,
    listener: &dyn Listener,
) -> Outcome {
    let files: Files = files(reading, output);
    let forecast = crate::check(&reading.recipe, &files, u64::MAX);
    let settings = Settings {
        files: &files,
        budget: u64::MAX,
        reader: &objects(|path, _| {
            Err(format!("{} is not available in this test", path.display()))
        }),
        keep_outputs,
        writes: !forecast.outputs.is_empty(),
        cache: None,
    };
    run(&reading.recipe, settings, listener)
}

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

/// Returns the names of all entries of a folder, including hidden files.
fn entries(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn steps_run_in_order_and_outputs_appear() {
    let folder = folder();
    let text = r#"(recipe: 1, steps: [
            Sheet(columns: 2),
            (id: "up", run: Lift(by: 1)),
            Write(path: "names.txt"),
            Write(path: "deep/er/names.txt"),
        ], expect: [
            Faces(eq: 2),
            (after: "up", that: Bounds(min: (-1, -0.5, 1), max: (1, 0.5, 1))),
        ])"#;
    let outcome = ran(text, folder.path());
    assert!(outcome.succeeded(), "{:?}", outcome.failures);
    assert_eq!(outcome.checked, 2);
    assert_eq!(
        outcome.written,
        ["deep/er/names.txt", "names.txt"].map(|p| folder.path().join(p))
    );
    assert_eq!(fs::read(&outcome.written[1]).unwrap(), b"sheet");
    assert_eq!(entries(folder.path()), ["deep", "names.txt"]);
    let up = &outcome.steps[1];
    assert_eq!((up.label.as_str(), up.report.changed), ("up", 6));
    assert_eq!((up.vertices, up.edges, up.faces), (6, 7, 2));
    assert_eq!(outcome.digest, outcome.scene.unwrap().digest());
}

#[test]
fn outputs_can_be_discarded() {
    let folder = folder();
    let out = folder.path().join("out");
    let reading = read(&steps("Sheet(columns: 1), Write(path: \"a.txt\")"));
    let outcome = run_reading(&reading, &out, false, &Silent);
    assert!(outcome.succeeded() && outcome.written.is_empty());
    assert!(!out.exists());
}

#[test]
fn an_expected_refusal_leaves_the_scene_unchanged() {
    let folder = folder();
    let plain = ran(&steps("Sheet(columns: 2)"), folder.path());
    let outcome = ran(
        r#"(recipe: 1, steps: [
            Sheet(columns: 2),
            (id: "no", run: Lift(by: 1, fails: Seam), refused: Seam),
        ], expect: [(after: "no", that: Bounds(min: (-1, -0.5, 0), max: (1, 0.5, 0)))])"#,
        folder.path(),
    );
    assert!(outcome.succeeded(), "{:?}", outcome.failures);
    assert_eq!(outcome.steps[1].refused, Some(op::Refusal::Seam));
    assert_eq!(
        outcome.steps[1].report.notes,
        ["refused as expected: v3 refuses"]
    );
    assert_eq!(outcome.scene, plain.scene);
}

#[test]
fn a_missing_refusal_fails_and_leaves_the_scene_unchanged() {
    let folder = folder();
    let plain = ran(&steps("Sheet(columns: 2)"), folder.path());
    for (lift, message) in [
        (
            "Lift(by: 1)",
            "expected the step to be refused with the reason Boundary, but the step succeeded",
        ),
        (
            "Lift(by: 1, fails: Seam)",
            "expected the step to be refused with the reason Boundary, but the step failed for another reason: v3 refuses",
        ),
    ] {
        let text = steps(&format!(
            "Sheet(columns: 2), (run: {lift}, refused: Boundary), Write(path: \"a.txt\")"
        ));
        let outcome = ran(&text, folder.path());
        assert!(!outcome.succeeded());
        assert_eq!(shown(&text, &outcome.failures), [("Lift", message, "")]);
        assert_eq!(outcome.scene, plain.scene);
        assert!(entries(folder.path()).is_empty());
    }
}

#[test]
fn a_failing_step_ends_the_run_and_nothing_is_written() {
    let folder = folder();
    let text = steps(
        "Sheet(columns: 2), Write(path: \"a.txt\"), Lift(by: 1, fails: Pinch), Write(path: \"b.txt\")",
    );
    let outcome = ran(&text, folder.path());
    assert_eq!(
        shown(&text, &outcome.failures),
        [("Lift", "v3 refuses", "")]
    );
    assert_eq!(outcome.steps.len(), 2);
    let plain = ran(&steps("Sheet(columns: 2)"), folder.path());
    assert_eq!(outcome.digest, plain.digest);
    assert!(outcome.written.is_empty() && entries(folder.path()).is_empty());
}

#[test]
fn all_unmet_expectations_are_reported_and_nothing_is_written() {
    let folder = folder();
    let text = r#"(recipe: 1, steps: [
            (id: "sheet", run: Sheet(columns: 2)), Write(path: "a.txt"),
        ], expect: [Closed, Faces(eq: 2), (after: "sheet", that: [Vertices(eq: 5), Manifold])])"#;
    let outcome = ran(text, folder.path());
    assert_eq!(
        shown(text, &outcome.failures),
        [
            ("Vertices(eq: 5)", "expected 5 vertices, found 6", ""),
            (
                "Closed",
                "expected no boundary edges, but the edge v0-v1 of \"sheet\" is a boundary edge",
                ""
            ),
        ]
    );
    let (label, why) = &outcome.failures[0].labels[0];
    assert_eq!((label.of(text), why.as_str()), ("Sheet", "after this step"));
    assert_eq!((outcome.checked, outcome.steps.len()), (4, 2));
    assert!(entries(folder.path()).is_empty());
}

#[test]
fn a_step_acts_on_the_objects_in_on() {
    let folder = folder();
    let text = r#"(recipe: 1, steps: [
            Sheet(columns: 2), Sheet(columns: 2, name: "b"),
            (run: Lift(by: 3), on: ["b"]),
        ], expect: [
            (on: ["sheet"], that: Bounds(min: (-1, -0.5, 0), max: (1, 0.5, 0))),
            (on: ["b"], that: Bounds(min: (-1, -0.5, 3), max: (1, 0.5, 3))),
        ])"#;
    let outcome = ran(text, folder.path());
    assert!(outcome.succeeded(), "{:?}", outcome.failures);
}

#[test]
fn an_output_replaces_only_the_file_with_its_name() {
    let folder = folder();
    fs::write(folder.path().join("a.txt"), "old").unwrap();
    fs::write(folder.path().join("b.txt"), "old").unwrap();
    let outcome = ran(
        &steps("Sheet(columns: 1), Write(path: \"a.txt\")"),
        folder.path(),
    );
    assert!(outcome.succeeded());
    assert_eq!(fs::read(folder.path().join("a.txt")).unwrap(), b"sheet");
    assert_eq!(fs::read(folder.path().join("b.txt")).unwrap(), b"old");
}

#[test]
fn an_output_does_not_replace_a_folder() {
    let folder = folder();
    fs::create_dir(folder.path().join("b.txt")).unwrap();
    let text = steps("Sheet(columns: 1), Write(path: \"a.txt\"), Write(path: \"b.txt\")");
    let outcome = ran(&text, folder.path());
    let path = folder.path().join("b.txt");
    let message = format!(
        "cannot write {}: a folder with that name exists",
        path.display()
    );
    assert_eq!(
        shown(&text, &outcome.failures),
        [("no span", &*message, "")]
    );
    assert_eq!(entries(folder.path()), ["b.txt"]);
}

#[test]
fn an_output_folder_that_cannot_be_created_fails_before_any_step() {
    let folder = folder();
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    let text = steps("Sheet(columns: 1), Write(path: \"a.txt\")");
    let outcome = ran(&text, &file.join("out"));
    assert!(outcome.steps.is_empty());
    let message = &outcome.failures[0].message;
    assert!(
        message.starts_with("cannot write to the output folder"),
        "{message}"
    );
}

#[test]
fn placeholders_are_filled_in_when_writing() {
    let folder = folder();
    let text = r#"(recipe: 1, params: {"input": Path(default: "cow.obj")},
        steps: [Sheet(columns: 1), Write(path: "{input.name}.{input.stem}")])"#;
    let reading = read_with(text, &[("input", "a/pig.obj")]);
    let outcome = run_reading(&reading, folder.path(), true, &Silent);
    assert!(outcome.succeeded(), "{:?}", outcome.failures);
    assert_eq!(entries(folder.path()), ["pig.obj.pig"]);
}

#[test]
fn a_mesh_that_exceeds_the_budget_is_not_built() {
    let reading = read(&steps("Sheet(columns: 1000)"));
    let files = files(&reading, Path::new("out"));
    let settings = Settings {
        files: &files,
        budget: 1000,
        reader: &objects(|_, _| Err(String::new())),
        keep_outputs: true,
        writes: false,
        cache: None,
    };
    let outcome = run(&reading.recipe, settings, &Silent);
    assert_eq!(outcome.failures.len(), 1);
    assert!(
        outcome.failures[0]
            .message
            .contains("the memory budget is 1000 bytes")
    );
    assert!(outcome.scene.unwrap().objects().is_empty());
}

/// A listener that cancels the run in a given call of `advance`, and counts the calls and the steps.
struct Cancel {
    at: u64,
    calls: AtomicU64,
    begun: AtomicU64,
    done: AtomicU64,
}

impl Progress for Cancel {
    fn advance(&self, _: &str, _: u64, _: u64) -> bool {
        self.calls.fetch_add(1, Ordering::Relaxed) + 1 < self.at
    }
}

impl Listener for Cancel {
    fn step_begins(&self, number: usize, _: &str) {
        assert_eq!(number as u64, self.begun.fetch_add(1, Ordering::Relaxed));
    }

    fn step_done(&self, number: usize, _: &StepDone) {
        assert_eq!(number as u64, self.done.fetch_add(1, Ordering::Relaxed));
    }
}

#[test]
fn a_run_can_be_cancelled_at_any_call_and_nothing_is_written() {
    let text = steps("Sheet(columns: 2), Write(path: \"a.txt\"), Lift(by: 1)");
    let reading = read(&text);
    let cancelled = |at| {
        let folder = folder();
        let listener = Cancel {
            at,
            calls: AtomicU64::new(0),
            begun: AtomicU64::new(0),
            done: AtomicU64::new(0),
        };
        let outcome = run_reading(&reading, folder.path(), true, &listener);
        let [begun, done, calls] =
            [listener.begun, listener.done, listener.calls].map(AtomicU64::into_inner);
        (outcome, begun, done, calls, entries(folder.path()))
    };
    let (outcome, begun, done, calls, written) = cancelled(u64::MAX);
    assert!(outcome.succeeded() && !outcome.cancelled);
    assert_eq!((begun, done), (3, 3));
    assert_eq!(written, ["a.txt"]);

    for at in 1..=calls {
        let (outcome, begun, done, heard, written) = cancelled(at);
        assert!(outcome.cancelled && !outcome.succeeded(), "{at}");
        // The run does not call `advance` again after the call that cancels it.
        assert_eq!(heard, at);
        assert_eq!(begun, done + 1);
        assert_eq!(outcome.steps.len() as u64, done);
        assert!(outcome.failures.is_empty() && outcome.written.is_empty());
        assert!(written.is_empty(), "{at}: {written:?}");
        let flat = ran(&steps("Sheet(columns: 2)"), Path::new("out"));
        assert!(outcome.scene == Some(Scene::new()) || outcome.scene == flat.scene);
    }
}

#[cfg(unix)]
#[test]
fn outputs_do_not_follow_links_out_of_the_folder() {
    let (folder, elsewhere) = (folder(), folder());
    let reading = read(&steps("Sheet(columns: 1), Write(path: \"link/new/a.txt\")"));
    // The output folder gets a link to another folder, but only after the recipe was read.
    let files = files(&reading, folder.path());
    let settings = Settings {
        files: &files,
        budget: u64::MAX,
        reader: &objects(|_, _| Err(String::new())),
        keep_outputs: true,
        writes: true,
        cache: None,
    };
    std::os::unix::fs::symlink(elsewhere.path(), folder.path().join("link")).unwrap();
    let outcome = run(&reading.recipe, settings, &Silent);
    assert_eq!(outcome.failures.len(), 1, "{:?}", outcome.failures);
    assert!(
        outcome.failures[0]
            .message
            .contains("through a symbolic link")
    );
    assert!(entries(elsewhere.path()).is_empty());
}

#[test]
fn a_step_that_panics_fails_the_run_and_nothing_is_written() {
    let text = steps("Sheet(columns: 2), Write(path: \"a.txt\"), Lift(by: -1e7)");
    let folder = folder();
    let outcome = ran(&text, folder.path());
    assert_eq!(
        shown(&text, &outcome.failures),
        [("Lift", "internal error in Lift (please report it)", "")]
    );
    assert_eq!(outcome.steps.len(), 2);
    assert_eq!(entries(folder.path()), [""; 0]);
}

/// A listener that records the message, the locations, and the digest of the scene of each failure.
#[derive(Default)]
struct Failures(Mutex<Vec<(String, Vec<ErrorLocation>, Digest)>>);

impl Progress for Failures {
    fn advance(&self, _: &str, _: u64, _: u64) -> bool {
        true
    }
}

impl Listener for Failures {
    fn step_begins(&self, _: usize, _: &str) {}
    fn step_done(&self, _: usize, _: &StepDone) {}

    fn failed(&self, failure: &Failure) {
        let message = failure.diagnostic.message.clone();
        let heard = (message, failure.places.to_vec(), failure.scene.digest());
        self.0.lock().unwrap().push(heard);
    }

    fn wants_places(&self) -> bool {
        true
    }
}

fn failures(text: &str) -> (Outcome, Vec<(String, Vec<ErrorLocation>, Digest)>) {
    let reading = read(text);
    assert_eq!(reading.diagnostics, [], "{text}");
    let folder = folder();
    let listener = Failures::default();
    let outcome = run_reading(&reading, folder.path(), true, &listener);
    (outcome, listener.0.into_inner().unwrap())
}

#[test]
fn a_failing_step_reports_the_places_of_its_elements() {
    let text = steps("Sheet(columns: 2), Lift(by: 3, vertices: Vertices([4]), fails: Boundary)");
    let (outcome, heard) = failures(&text);

    let [(message, places, digest)] = &heard[..] else {
        panic!("{heard:?}");
    };
    assert_eq!(message, "v4 refuses");
    assert_eq!(*message, outcome.failures[0].message);
    // The reported scene is the scene before the step, although the vertex was already lifted when the step failed.
    let scene = outcome.scene.unwrap();
    assert_eq!(*digest, scene.digest());
    let mesh = scene.objects()[0].as_mesh().unwrap();
    let [place] = &places[..] else {
        panic!("{places:?}");
    };
    let lifted = mesh.position(mesh::VertexId::new(4)) + DVec3::new(0.0, 0.0, 3.0);
    assert_eq!(place.object, scene.objects()[0].name);
    assert_eq!((&*place.name, &place.points[..]), ("v4", &[lifted][..]));
}

#[test]
fn unmet_expectations_report_the_elements_and_the_scene_after_their_step() {
    let (outcome, heard) = failures(
        r#"(recipe: 1, steps: [(id: "sheet", run: Sheet(columns: 2)), Lift(by: 1)], expect: [
            (after: "sheet", that: Closed), (after: "sheet", that: Faces(eq: 99)),
        ])"#,
    );

    let [(_, open, first), (_, none, second)] = &heard[..] else {
        panic!("{heard:?}");
    };
    let scene = outcome.scene.unwrap();
    let mesh = scene.objects()[0].as_mesh().unwrap();
    let boundary = mesh.edges().filter(|&e| mesh.is_boundary_edge(e));
    let names: Vec<String> = boundary.map(|e| e.to_string()).collect();
    assert!(open.iter().map(|place| &place.name).eq(&names) && names.len() > 3);
    assert!(open.iter().all(|place| place.points.len() == 2));
    assert!(none.is_empty());
    // Both failures have the scene after the step `sheet`. The next step has changed the final scene.
    assert!(first == second && *first != scene.digest());
}
