//! The editor: a document, the thread that runs it, the step cursor and the picked elements.

mod command;
mod files;
mod moves;
mod picks;
mod record;
mod steps;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use engine::{Source, SourceError};
use op::Registry;
use scene::Scene;
use store::Store;
use web_time::Instant;

use crate::document::{Document, FileChange};
use crate::journal::Journal;
use crate::pick::Indexes;
use crate::run::{Event, Progress, Request, RunState, Runner, Snapshot, Status, Wake};
use crate::select::{Picked, Proposal};
use crate::text::Outline;
use picks::Proposals;

pub use command::{Command, CommandError, SelectionText};
pub use moves::Movement;
pub use picks::PickError;

/// The settings of an editor.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The folder for outputs. Defaults to `out`.
    pub out: PathBuf,
    /// The memory budget for the meshes of a run, in bytes. Defaults to [`engine::BUDGET`].
    pub budget: u64,
    /// The maximum memory for kept scenes, in bytes. If the scene after a step is kept, the step need not run again.
    /// Defaults to 4 GiB.
    pub memory: u64,
    /// The folder for journals, from which unsaved texts are recovered after a crash. If `None`, which is the default,
    /// no journal is written.
    pub journals: Option<PathBuf>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            out: PathBuf::from("out"),
            budget: engine::BUDGET,
            memory: 4 << 30,
            journals: None,
        }
    }
}

/// The editor: a document, the thread that runs it, the step cursor and the picked elements.
pub struct Editor {
    registry: Arc<Registry>,
    store: Arc<dyn Store>,
    settings: Settings,
    document: Document,
    /// The outline of the document's text.
    outline: Outline,
    runner: Runner,
    run: RunState,
    /// The number of the newest request to run a text.
    number: u64,
    /// The version of the text whose results are in `run`. `None` if `run` has the results of a preview.
    run_version: Option<u64>,
    /// The version of the text for which the last run was requested. `None` if the last request was for a preview.
    requested: Option<u64>,
    /// Whether the results in `run` answer the newest request to run a text.
    is_checked: bool,
    /// Whether the newest request to run a text was canceled.
    is_canceled: bool,
    /// The text of a preview, which runs in place of the document's text.
    preview: Option<Arc<str>>,
    /// The number of steps that the preview inserts at the step cursor.
    preview_steps: usize,
    /// The step cursor: the number of steps that precede it in the text.
    cursor: usize,
    /// The scene that is shown. While the scene after the last step before the step cursor is not known, this is an
    /// earlier scene.
    shown: Arc<Scene>,
    picked: Option<Picked>,
    /// Whether the scene that is shown has all picked elements. During a preview, some of the picked elements can be
    /// missing from the scene.
    has_picked: bool,
    /// The selections that describe the picked elements.
    proposals: Proposals,
    /// The first selection that describes the picked elements: a selection that the user has typed, or the selection
    /// for a single picked element. If another selection is requested, a selection from `proposals` is used instead.
    first_proposal: Option<Proposal>,
    proposal: usize,
    indexes: Indexes,
    journal: Option<Journal>,
}

/// Why a file cannot be opened.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// The recipe cannot be read.
    #[error(transparent)]
    Recipe(#[from] SourceError),
    /// The model does not exist.
    #[error("cannot read {}: the file does not exist", .0.display())]
    Missing(PathBuf),
    /// The file is of a kind that the editor does not open.
    #[error("{0} is not a recipe (.ron) or a model; models: {1}")]
    Kind(PathBuf, String),
}

/// The changes since the last call of [`Editor::poll`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Update {
    /// Whether the scene that the view shows may have changed.
    pub scene: bool,
    /// Whether the state of the run changed.
    pub run: bool,
    /// The change that another program made to the file of the recipe, if any.
    pub file: Option<FileChange>,
}

/// The scene that the view shows.
#[derive(Clone, Debug)]
pub struct View {
    /// The scene.
    pub scene: Arc<Scene>,
    /// Whether `scene` is the scene after the last step before the step cursor. If that scene is not known, because the
    /// run has not ended or has failed, `scene` is the last known scene.
    pub is_current: bool,
}

impl Editor {
    /// Creates an editor with a new recipe.
    pub fn new(registry: Arc<Registry>, store: Arc<dyn Store>, settings: Settings) -> Self {
        let document = files::new_document();
        let mut editor = Self {
            runner: Runner::new(registry.clone(), store.clone()),
            registry,
            store,
            outline: Outline::of(document.text()),
            document,
            run: RunState::default(),
            number: 0,
            run_version: None,
            requested: None,
            is_checked: false,
            is_canceled: false,
            preview: None,
            preview_steps: 0,
            cursor: usize::MAX,
            shown: Arc::default(),
            picked: None,
            has_picked: true,
            proposals: Proposals::default(),
            first_proposal: None,
            proposal: 0,
            indexes: Indexes::new(),
            journal: settings.journals.as_deref().map(Journal::new),
            settings,
        };
        editor.show(None);
        editor
    }

    /// Returns the document.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// Returns the text of the recipe.
    pub fn text(&self) -> &str {
        self.document.text()
    }

    /// Returns the outline of the text.
    pub fn outline(&self) -> &Outline {
        &self.outline
    }

    /// Returns the operations.
    pub fn registry(&self) -> &Arc<Registry> {
        &self.registry
    }

    /// Returns the spatial indexes, which are used to pick elements of meshes.
    pub fn indexes(&self) -> &Indexes {
        &self.indexes
    }

    /// Sets a function that is called, from other threads, when [`poll`](Self::poll) would return a change.
    pub fn on_wake(&self, wake: Wake) {
        self.runner.on_event(wake.clone());
        self.indexes.on_ready(wake);
    }

    /// Replaces the text by a text that the user has typed. Consecutive changes by typing become one entry of the
    /// history.
    pub fn set_text(&mut self, text: &str) {
        self.change(text, "type", true);
    }

    /// Undoes the last change of the text. If the scenes of the earlier text are still in memory, no step has to run.
    /// Returns whether there was a change to undo.
    pub fn undo(&mut self) -> bool {
        let done = self.document.undo();
        if done {
            self.restored();
        }
        done
    }

    /// Redoes the change that was undone last. Returns whether there was a change to redo.
    pub fn redo(&mut self) -> bool {
        let done = self.document.redo();
        if done {
            self.restored();
        }
        done
    }

    fn restored(&mut self) {
        let before = std::mem::replace(&mut self.outline, Outline::of(self.document.text()));
        let n = self.outline.steps.len();
        self.cursor = match self.document.cursor() {
            cursor if cursor <= n => cursor,
            _ => self.cursor.min(before.steps.len()).min(n),
        };
        self.show(None);
    }

    /// Returns the state of the newest run.
    pub fn run(&self) -> &RunState {
        &self.run
    }

    /// Whether [`run`](Self::run) belongs to the current text. If false, the spans of the run can be wrong for the
    /// current text.
    pub fn is_run_current(&self) -> bool {
        self.run_version == Some(self.document.version())
    }

    /// Whether a run is in progress, or is waiting to start.
    pub fn is_running(&self) -> bool {
        !self.is_canceled && (!self.is_checked || self.run.is_running())
    }

    /// Returns the progress of the run, if a run is in progress.
    pub fn progress(&self) -> Option<Progress> {
        if !self.is_running() {
            return None;
        }
        Some(self.runner.progress(self.number).unwrap_or_default())
    }

    /// Cancels the run. The scenes of the steps that have already run are kept.
    pub fn cancel(&mut self) {
        if self.is_running() {
            self.runner.cancel();
            self.run.status = Status::Canceled;
            self.is_canceled = true;
        }
    }

    /// Runs the whole recipe again from the first step, and writes its output files.
    pub fn write_outputs(&mut self) {
        self.request(true);
    }

    /// Receives the messages of the engine thread. Returns the changes, or `None` if nothing has changed.
    pub fn poll(&mut self) -> Option<Update> {
        let mut update = Update::default();
        for event in self.runner.events() {
            if event.number().is_some_and(|number| number != self.number) {
                continue;
            }
            match event {
                Event::Checked { state, .. } => {
                    self.run = *state;
                    self.run_version = self.requested;
                    self.is_checked = true;
                    (update.run, update.scene) = (true, true);
                    self.watch();
                }
                Event::Step { step, result, .. } => {
                    if let Some(step) = self.run.steps.get_mut(step) {
                        step.result = Some(result);
                    }
                    (update.run, update.scene) = (true, true);
                }
                Event::Done { end, .. } => {
                    let end = *end;
                    for (state, verdict) in self.run.expectations.iter_mut().zip(end.verdicts) {
                        state.verdict = verdict;
                    }
                    self.run.failures = end.failures;
                    self.run.digest = end.digest;
                    self.run.written = end.written;
                    self.run.time = end.time;
                    self.run.ran = end.ran;
                    self.run.status = if end.canceled {
                        Status::Canceled
                    } else {
                        Status::Done
                    };
                    update.run = true;
                }
                Event::Panicked { .. } => {
                    let message = "internal error while the recipe was read (please report it)";
                    self.run.diagnostics = vec![engine::Diagnostic::without_place(message)];
                    self.run.status = Status::Done;
                    self.run_version = self.requested;
                    self.is_checked = true;
                    update.run = true;
                }
                Event::FilesChanged => {
                    update.file = self.document.follow(&*self.store);
                    if update.file == Some(FileChange::Reloaded) {
                        self.text_changed(None);
                    } else {
                        self.request(false);
                    }
                }
            }
        }
        if update.scene {
            self.keep_shown();
        }
        (update != Update::default()).then_some(update)
    }

    /// Polls until the run has ended, or until the given time has passed. Returns whether the run has ended.
    pub fn wait(&mut self, time: Duration) -> bool {
        let end = Instant::now() + time;
        loop {
            self.poll();
            if !self.is_running() {
                return true;
            }
            let Some(rest) = end.checked_duration_since(Instant::now()) else {
                return false;
            };
            self.runner.wait(rest);
        }
    }

    /// Returns the step cursor: the number of steps that precede it in the text. The view shows the scene after these
    /// steps. New steps are inserted at the cursor.
    pub fn cursor(&self) -> usize {
        self.cursor
    }

    /// Moves the step cursor. A cursor greater than the number of steps is set to the number of steps.
    pub fn set_cursor(&mut self, cursor: usize) {
        self.cursor = cursor.min(self.outline.steps.len());
        self.document.set_cursor(self.cursor);
        self.keep_shown();
        self.keep_picked();
    }

    /// Returns the scene that the view shows.
    pub fn view(&self) -> View {
        let (_, is_known) = self.result();
        View {
            scene: self.shown.clone(),
            is_current: self.is_checked && is_known,
        }
    }

    /// Returns the steps of the newest run that come from the step `item` of the text. The result is a range of indices
    /// of the run's steps. During a preview, the run can have more steps than the text. The returned range takes these
    /// additional steps into account.
    pub fn steps_of_item(&self, item: usize) -> std::ops::Range<usize> {
        let is_after = item >= self.cursor;
        let new = if is_after { self.preview_steps } else { 0 };
        self.run.steps_of(item + new)
    }

    /// Returns the last known result of the steps before the cursor. Also returns whether the results of all steps
    /// before the cursor are known.
    fn result(&self) -> (Option<&Snapshot>, bool) {
        let n = self.cursor + self.preview_steps;
        let (last, is_known) = self.run.result_after(n);
        // If the step before the cursor could not be read because of an error, the run does not contain this step.
        let is_before_first = n == 0 && !self.outline.steps.is_empty();
        let is_read = is_before_first
            || !self.run.has_errors()
            || self.run.steps.iter().any(|step| step.item + 1 == n);
        (last, is_known && is_read)
    }

    /// Shows the scene after the last step before the step cursor. If this scene is not known, shows the last known
    /// scene of an earlier step. But if the scene is not known because the recipe has errors, the scene that is shown
    /// does not change.
    fn keep_shown(&mut self) {
        let (last, is_known) = self.result();
        let shown = match last {
            Some(_) if !is_known && self.run.has_errors() && !self.shown.objects().is_empty() => {
                return;
            }
            Some(snapshot) => snapshot.scene.clone(),
            // Without a step before the cursor, the scene is empty.
            None if is_known && self.is_checked => Arc::default(),
            None => return,
        };
        if !Arc::ptr_eq(&self.shown, &shown) {
            self.shown = shown;
            // In another scene, some of the picked elements may not exist, or another selection may be needed to
            // select them. A preview keeps the picked elements and their selection.
            if self.preview.is_none() {
                self.keep_picked();
            } else {
                self.has_picked = self.existing() == self.picked;
            }
        }
    }

    /// Replaces the text and runs it. Returns whether the text has changed.
    fn change(&mut self, text: &str, label: &str, merges: bool) -> bool {
        let changed = self.document.replace(text, label, merges);
        if changed {
            self.text_changed(None);
        }
        changed
    }

    /// Reads the outline of the changed text, and runs the text. If `cursor` is `None`, the number of steps before the
    /// step cursor stays the same. A cursor after the last step stays after the last step.
    fn text_changed(&mut self, cursor: Option<usize>) {
        let new = Outline::of(self.document.text());
        let (old_n, new_n) = (self.outline.steps.len(), new.steps.len());
        let is_end = self.cursor >= old_n;
        self.outline = new;
        self.cursor = match cursor {
            Some(cursor) => cursor.min(new_n),
            None if is_end => new_n,
            None => self.cursor.min(new_n),
        };
        self.document.set_cursor(self.cursor);
        self.show(None);
    }

    /// Runs the document's text or a preview.
    fn show(&mut self, preview: Option<Arc<str>>) {
        self.preview = preview;
        self.preview_steps = 0;
        self.cursor = self.cursor.min(self.outline.steps.len());
        self.request(false);
    }

    fn request(&mut self, keep_outputs: bool) {
        self.keep_journal();
        self.number += 1;
        (self.is_canceled, self.is_checked) = (false, false);
        let text = self
            .preview
            .clone()
            .unwrap_or_else(|| self.document.text().clone());
        self.requested = self.preview.is_none().then(|| self.document.version());
        // The existing results belong to an earlier request, not to the text that is to be run now.
        self.run_version = None;
        self.runner.request(Request {
            number: self.number,
            source: Source::new(self.document.path(), text),
            out: self.settings.out.clone(),
            keep_outputs,
            budget: self.settings.budget,
            memory: self.settings.memory,
        });
    }

    /// Writes the unsaved text to the journal, and keeps the journal when the editor is dropped. When the program
    /// starts again, it can offer the text to the user. A program calls this function if it must end before the user
    /// can save the text.
    pub fn leave_journal(&mut self) {
        self.keep_journal();
        self.journal = None;
    }

    /// Watches the file of the recipe, its input files, and the files of called recipes.
    fn watch(&self) {
        let own = self.document.seen();
        self.runner.watch(
            own.into_iter()
                .chain(self.run.watched.iter().cloned())
                .collect(),
        );
    }
}

impl Drop for Editor {
    fn drop(&mut self) {
        // After a panic, the journal stays, so that the unsaved text is offered at the next start.
        if let Some(journal) = &mut self.journal
            && !std::thread::panicking()
        {
            journal.clear(&*self.store);
        }
    }
}
