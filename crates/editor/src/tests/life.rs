//! Tests of files, recovery, expectations, cancellation and panics.

use std::path::Path;

use mesh::Mesh;
use op::prelude::*;
use store::Memory;

use super::*;
use crate::{Command, FileChange, Status, Verdict, recoverable};

const LINE: &str = "(recipe: 1, steps: [Cube(name: \"a\"), PokeFaces()])";

fn write(store: &Memory, path: &str, text: &str) {
    store.write(Path::new(path), text.as_bytes()).unwrap();
}

/// Polls the editor until it reports a change of the file.
fn file_change(editor: &mut Editor) -> FileChange {
    let end = std::time::Instant::now() + Duration::from_secs(60);
    while std::time::Instant::now() < end {
        if let Some(change) = editor.poll().and_then(|update| update.file) {
            return change;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    panic!("no change of the file was found");
}

#[test]
fn a_file_changed_on_disk_is_followed() {
    let (mut editor, store) = opened(LINE);
    let theirs = LINE.replace("PokeFaces()", "Reverse()");
    write(&store, "a.ron", &theirs);
    assert_eq!(file_change(&mut editor), FileChange::Reloaded);
    settled(&mut editor);
    assert_eq!(
        (editor.text(), editor.document().is_dirty()),
        (theirs.as_str(), false)
    );
    // An undo brings back the previous text.
    assert!(editor.undo());
    assert_eq!(editor.text(), LINE);
}

#[test]
fn unsaved_changes_and_a_changed_file_are_a_conflict() {
    for keep in [true, false] {
        let (mut editor, store) = opened(LINE);
        let (mine, theirs) = (
            LINE.replace("Poke", "Split"),
            LINE.replace("\"a\"", "\"b\""),
        );
        editor.set_text(&mine);
        write(&store, "a.ron", &theirs);
        assert_eq!(file_change(&mut editor), FileChange::Conflict);
        assert_eq!(editor.text(), mine);
        assert_eq!(&*editor.document().conflict().unwrap().theirs, theirs);
        assert!(
            editor
                .save()
                .unwrap_err()
                .to_string()
                .contains("changed by another program")
        );
        if keep {
            editor.keep_mine();
            editor.save().unwrap();
            assert_eq!(store.read(Path::new("a.ron")).unwrap(), mine.as_bytes());
        } else {
            editor.take_theirs();
            assert_eq!(
                (editor.text(), editor.document().is_dirty()),
                (theirs.as_str(), false)
            );
            assert!(editor.undo());
            assert_eq!(editor.text(), mine);
        }
    }
}

#[test]
fn a_changed_model_runs_only_the_steps_from_its_load_on() {
    let (mut editor, store) = editor();
    let model = |x: u32| format!("v 0 0 0\nv {x} 0 0\nv 0 1 0\nf 1 2 3\n");
    write(&store, "m.obj", &model(1));
    write(
        &store,
        "a.ron",
        "(recipe: 1, steps: [Cube(name: \"a\"), Load(path: \"m.obj\"), Reverse()])",
    );
    editor.open(Path::new("a.ron")).unwrap();
    settled(&mut editor);
    let before = editor.run().digest;
    assert_eq!(editor.run().ran, 3);
    write(&store, "m.obj", &model(2));
    let end = std::time::Instant::now() + Duration::from_secs(60);
    while editor.run().digest == before && std::time::Instant::now() < end {
        editor.wait(Duration::from_millis(10));
        std::thread::sleep(Duration::from_millis(5));
    }
    settled(&mut editor);
    assert_ne!(editor.run().digest, before);
    assert_eq!(editor.run().ran, 2);
}

#[test]
fn a_recipe_that_is_saved_in_another_folder_loads_the_same_files() {
    let (mut editor, store) = editor();
    write(
        &store,
        "models/m.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    );
    write(&store, "recipes/b.ron", "(recipe: 1, steps: [])");
    editor.open(Path::new("models/m.obj")).unwrap();
    settled(&mut editor);
    let digest = editor.run().digest;
    editor.save_as(Path::new("recipes/a.ron")).unwrap();
    assert!(
        editor.text().contains("Load(path: \"../models/m.obj\")"),
        "{}",
        editor.text()
    );
    assert!(!editor.document().is_dirty());
    settled(&mut editor);
    assert_eq!(editor.run().digest, digest);
    // If the recipe is saved in the same folder under another name, its text does not change.
    let text = editor.text().to_owned();
    editor.save_as(Path::new("recipes/c.ron")).unwrap();
    assert_eq!(editor.text(), text);
}

#[test]
fn an_error_in_the_text_keeps_the_last_scene() {
    let (mut editor, _) = opened(LINE);
    let good = editor.view().scene;
    for wrong in ["(recipe: 1, steps: [", &LINE.replace("Poke", "Pook"), ""] {
        editor.set_text(wrong);
        settle(&mut editor);
        let view = editor.view();
        assert!(
            Arc::ptr_eq(&view.scene, &good) && !view.is_current,
            "{wrong}"
        );
    }
    // If the cursor is before the first step, the editor shows the empty scene.
    editor.set_text(&LINE.replace("Poke", "Pook"));
    editor.set_cursor(0);
    settle(&mut editor);
    assert!(editor.view().scene.objects().is_empty());
}

#[test]
fn unsaved_text_is_offered_after_a_crash() {
    let store = Arc::new(Memory::default());
    let settings = Settings {
        journals: Some("state".into()),
        ..Settings::default()
    };
    let new = || {
        Editor::new(
            Arc::new(ops_all::registry()),
            store.clone(),
            settings.clone(),
        )
    };
    write(&store, "a.ron", LINE);
    let mut editor = new();
    editor.open(Path::new("a.ron")).unwrap();
    assert_eq!(recoverable(&*store, Path::new("state")), []);
    editor.apply(&Command::new("Reverse")).unwrap();
    let text = editor.text().to_owned();
    // `forget` ends the editor without closing it, as a crash does.
    std::mem::forget(editor);
    let found = recoverable(&*store, Path::new("state"));
    assert_eq!(
        (found.len(), &found[0].text, found[0].has_file),
        (1, &text, true)
    );
    let mut editor = new();
    editor.recover(&found[0]);
    assert_eq!(
        (editor.text(), editor.document().is_dirty()),
        (text.as_str(), true)
    );
    assert_eq!(recoverable(&*store, Path::new("state")).len(), 1);
    assert!(editor.undo());
    assert_eq!((editor.text(), editor.document().is_dirty()), (LINE, false));
    assert!(editor.redo());
    editor.save().unwrap();
    assert_eq!(recoverable(&*store, Path::new("state")), []);
    editor.apply(&Command::new("Reverse")).unwrap();
    drop(editor);
    assert_eq!(recoverable(&*store, Path::new("state")), []);
}

#[test]
fn expectations_hold_or_fail_with_the_actual_value() {
    let text = "(recipe: 1, steps: [(id: \"c\", run: Cube(name: \"a\")), PokeFaces()],
        expect: [(after: \"c\", that: Faces(eq: 6)), Faces(eq: 25), Manifold])";
    let (mut editor, _) = opened(text);
    let verdicts = |editor: &Editor| -> Vec<Option<bool>> {
        let all = editor.run().expectations.iter();
        all.map(|state| {
            state
                .verdict
                .as_ref()
                .map(|verdict| *verdict == Verdict::Holds)
        })
        .collect()
    };
    assert_eq!(verdicts(&editor), [Some(true), Some(false), Some(true)]);
    let failure = &editor.run().failures[0].diagnostic;
    assert_eq!(failure.span.unwrap().of(text), "Faces(eq: 25)");
    assert!(failure.message.contains("24"), "{}", failure.message);
    // Only the changed expectation is checked again, and no step runs.
    let at = text.find("25").unwrap();
    editor.replace_span(at, at + 2, "24").unwrap();
    settled(&mut editor);
    assert_eq!(
        (verdicts(&editor), editor.run().ran),
        (vec![Some(true); 3], 0)
    );
    // An expectation with `after` is checked only when its step runs. If this expectation changes, the run therefore
    // starts at this step.
    let at = text.find("eq: 6").unwrap();
    editor.replace_span(at, at + 5, "min: 6").unwrap();
    settled(&mut editor);
    assert_eq!(
        (verdicts(&editor), editor.run().ran),
        (vec![Some(true); 3], 2)
    );
}

#[test]
fn a_recorded_test_holds_and_fails_after_a_change() {
    let (mut editor, _) = opened(LINE);
    let recorded = editor.record_test().unwrap();
    assert!(
        recorded.contains(&"Faces(eq: 24)".to_owned()) && recorded.contains(&"Closed".to_owned())
    );
    settled(&mut editor);
    assert_eq!(editor.run().expectations.len(), recorded.len());
    editor.set_cursor(1);
    editor.record_test().unwrap();
    settled(&mut editor);
    assert!(
        editor
            .text()
            .contains("(id: \"cube\", run: Cube(name: \"a\"))"),
        "{}",
        editor.text()
    );
    assert_eq!(editor.run().expectations.len(), 2 * recorded.len());
    editor.delete_step(1).unwrap();
    settle(&mut editor);
    assert!(editor.run().has_failed());
}

#[test]
fn errors_in_the_text_have_spans_and_the_steps_before_stay() {
    let (mut editor, _) = opened(LINE);
    editor.set_text(&LINE.replace("PokeFaces()", "PokeFace(), Reverse("));
    settle(&mut editor);
    let run = editor.run();
    assert!(run.has_failed() && run.diagnostics.iter().all(|d| d.span.is_some()));
    // The editor shows the scene with the cube, which it has stored in the previous run.
    assert_eq!(editor.view().scene.objects().len(), 1);
    assert!(!editor.view().is_current);
    editor.set_text("");
    settle(&mut editor);
    assert!(editor.run().has_failed());
    assert!(editor.apply(&Command::new("Reverse")).is_err());
    editor.set_text(LINE);
    settled(&mut editor);
    assert!(editor.view().is_current);
}

/// An operation that panics, or that waits until the run is canceled.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
struct Misbehave {
    /// Whether to panic.
    panics: bool,
}

impl MeshOperation for Misbehave {
    const NAME: &'static str = "Misbehave";
    const SUMMARY: &'static str = "Misbehave";
    const EXAMPLE: &'static str = "Misbehave(panics: true)";

    fn plan(&self, _: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        Vec::new()
    }

    fn apply(&self, _: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        assert!(!self.panics, "as asked for");
        loop {
            cx.advance("wait", 1, 2)?;
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}

fn misbehaving() -> Editor {
    let store = Arc::new(Memory::default());
    write(&store, "a.ron", LINE);
    let registry = Arc::new(ops_all::registry().with::<Misbehave>());
    let mut editor = Editor::new(registry, store, Settings::default());
    editor.open(Path::new("a.ron")).unwrap();
    settled(&mut editor);
    editor
}

#[test]
fn a_panic_of_an_operation_is_a_failure_of_its_step() {
    let mut editor = misbehaving();
    editor
        .apply(&Command::new("Misbehave").with("panics", "true"))
        .unwrap();
    settle(&mut editor);
    assert!(
        editor.run().failures[0]
            .diagnostic
            .message
            .contains("internal error in Misbehave")
    );
    assert_eq!(editor.view().scene.objects().len(), 1);
    assert!(editor.undo());
    settled(&mut editor);
    assert!(editor.view().is_current);
}

#[test]
fn a_run_can_be_canceled_and_a_newer_text_wins() {
    let mut editor = misbehaving();
    let wait = Command::new("Misbehave").with("panics", "false");
    editor.apply(&wait).unwrap();
    assert!(!editor.wait(Duration::from_millis(200)));
    assert!(editor.is_running() && editor.progress().is_some());
    editor.cancel();
    assert_eq!(
        (editor.is_running(), &editor.run().status),
        (false, &Status::Canceled)
    );
    assert_eq!(editor.view().scene.objects().len(), 1);
    assert!(editor.undo());
    settled(&mut editor);
    // If the text changes while a step is still waiting, the run is canceled.
    editor.apply(&wait).unwrap();
    editor.wait(Duration::from_millis(50));
    let end = editor
        .text()
        .replace("Misbehave(panics: false)", "Reverse()");
    editor.set_text(&end);
    settled(&mut editor);
    assert!(editor.view().is_current);
}
