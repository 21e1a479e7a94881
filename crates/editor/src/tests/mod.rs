//! Tests that drive the editor.

mod drive;
mod life;
mod panels;
mod picking;
mod playing;
mod selecting;
mod texts;

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use store::{Memory, Store};

use crate::{Editor, Settings};

/// Returns an editor with files in memory and all operations.
fn editor() -> (Editor, Arc<Memory>) {
    let store = Arc::new(Memory::default());
    let registry = Arc::new(ops_all::registry());
    (
        Editor::new(registry, store.clone(), Settings::default()),
        store,
    )
}

/// Opens a recipe with this text in an editor, waits until the recipe has run, and returns the editor.
fn opened(text: &str) -> (Editor, Arc<Memory>) {
    let (mut editor, store) = editor();
    store.write(Path::new("a.ron"), text.as_bytes()).unwrap();
    editor.open(Path::new("a.ron")).unwrap();
    settle(&mut editor);
    (editor, store)
}

/// Waits until the run has ended.
#[track_caller]
fn settle(editor: &mut Editor) {
    assert!(editor.wait(Duration::from_secs(60)), "the run does not end");
}

/// Waits until the run has ended, which must succeed.
#[track_caller]
fn settled(editor: &mut Editor) {
    settle(editor);
    let run = editor.run();
    assert!(
        !run.has_failed(),
        "{}\n{:?} {:?}",
        editor.text(),
        run.diagnostics,
        run.failures
    );
}
