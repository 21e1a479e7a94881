//! Running a recipe.
//!
//! Steps run one after another on a scene. If one fails, the run ends and nothing is written: outputs
//! go to a folder of their own beside their places, and are moved there when everything has held.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use op::{Context, Files, OpError, Progress, Refusal, Report};
use scene::{Digest, Geometry, Scene};

use crate::check::forbidden;
use crate::diagnostic::Diagnostic;
use crate::expect::{Found, ReadObjects, Subject};
use crate::recipe::{Recipe, RecipeStep};

/// Follows a run.
pub trait Listener: Progress {
    /// A step begins.
    fn step_begins(&self, number: usize, label: &str);
    /// A step is done.
    fn step_done(&self, number: usize, done: &StepDone);
}

/// What a step left behind.
#[derive(Clone, Debug)]
pub struct StepDone {
    /// The step's id or operation.
    pub label: String,
    /// What it did.
    pub report: Report,
    /// The reason for which it was refused, as the recipe says it must be.
    pub refused: Option<Refusal>,
    /// The vertices of all meshes together, after it.
    pub vertices: usize,
    /// The edges.
    pub edges: usize,
    /// The faces.
    pub faces: usize,
    /// How long it took.
    pub time: Duration,
}

/// How a run ended.
#[derive(Debug)]
pub struct Outcome {
    /// The steps that were done.
    pub steps: Vec<StepDone>,
    /// What went wrong: one failed step, or expectations that do not hold.
    pub failures: Vec<Diagnostic>,
    /// The expectations that do not hold.
    pub unmet: Vec<Unmet>,
    /// Whether the run was cancelled.
    pub cancelled: bool,
    /// How many expectations were held against the scene.
    pub checked: usize,
    /// The scene at the end.
    pub scene: Scene,
    /// The digest of the scene at the end.
    pub digest: Digest,
    /// The files that were written.
    pub written: Vec<PathBuf>,
}

/// An expectation that does not hold.
#[derive(Clone, Debug)]
pub struct Unmet {
    /// Its place in [`Recipe::expectations`].
    pub expectation: usize,
    /// The place of what is told of it in [`Outcome::failures`].
    pub failure: usize,
    /// What was found, if a value that it records is another one.
    pub found: Option<Found>,
}

impl Outcome {
    /// Whether every step was done and every expectation holds.
    pub fn succeeded(&self) -> bool {
        self.failures.is_empty() && !self.cancelled
    }
}

/// What a run needs beside its recipe.
#[derive(Clone, Copy)]
pub struct Settings<'a> {
    /// Where files are.
    pub files: &'a Files,
    /// How many bytes meshes may take.
    pub budget: u64,
    /// How files are read for expectations.
    pub read: ReadObjects<'a>,
    /// Whether outputs are kept.
    pub keep_outputs: bool,
    /// Whether the recipe writes anything.
    pub writes: bool,
}

/// Runs a recipe that was read and checked without errors.
pub fn run(recipe: &Recipe, settings: Settings, listener: &dyn Listener) -> Outcome {
    let mut runner = Runner {
        recipe,
        settings,
        scene: Scene::new(),
        steps: Vec::new(),
        failures: Vec::new(),
        unmet: Vec::new(),
        cancelled: false,
        checked: 0,
    };
    let mut written = Vec::new();
    match staging(settings) {
        Ok(stage) => {
            let mut files = settings.files.clone();
            if let Some(stage) = &stage {
                stage.path().clone_into(&mut files.output);
            }
            runner.steps(&files, listener);
            if runner.failures.is_empty() && !runner.cancelled && settings.keep_outputs {
                let delivered = stage.as_ref().map_or(Ok(Vec::new()), |stage| {
                    deliver(stage.path(), settings.files)
                });
                match delivered {
                    Ok(paths) => written = paths,
                    Err(message) => runner.failures.push(Diagnostic::without_place(message)),
                }
            }
        }
        Err(message) => runner.failures.push(Diagnostic::without_place(message)),
    }
    let digest = runner.scene.digest();
    let Runner {
        scene,
        steps,
        failures,
        unmet,
        cancelled,
        checked,
        ..
    } = runner;
    Outcome {
        steps,
        failures,
        unmet,
        cancelled,
        checked,
        scene,
        digest,
        written,
    }
}

struct Runner<'a> {
    recipe: &'a Recipe,
    settings: Settings<'a>,
    scene: Scene,
    steps: Vec<StepDone>,
    failures: Vec<Diagnostic>,
    unmet: Vec<Unmet>,
    cancelled: bool,
    checked: usize,
}

impl Runner<'_> {
    fn steps(&mut self, files: &Files, listener: &dyn Listener) {
        let files = self.recipe.files(files);
        for (i, step) in self.recipe.steps.iter().enumerate() {
            listener.step_begins(i, step.label());
            let begin = Instant::now();
            let (report, refused) = match self.step(step, &files[step.scope], listener) {
                Ok(done) => done,
                Err(None) => {
                    self.cancelled = true;
                    return;
                }
                Err(Some(message)) => {
                    self.fail(step.scope, Diagnostic::error(step.span, message));
                    return;
                }
            };
            if let Some(loss) = step.on_loss.forbidden(&report.losses) {
                self.fail(step.scope, forbidden(step, loss));
                return;
            }
            let done = self.done(step.label(), report, refused, begin.elapsed());
            listener.step_done(i, &done);
            self.steps.push(done);
            self.expectations(Some(i), &files);
        }
        self.expectations(None, &files);
    }

    fn fail(&mut self, scope: usize, failure: Diagnostic) {
        self.failures.push(self.recipe.located(failure, scope));
    }

    /// Does a step. Fails with a message, or without one if it was cancelled; the scene is then as it
    /// was before.
    fn step(
        &mut self,
        step: &RecipeStep,
        files: &Files,
        listener: &dyn Listener,
    ) -> Result<(Report, Option<Refusal>), Option<String>> {
        let Some(operation) = &step.step else {
            return Err(Some("this step could not be read".to_owned()));
        };
        // Held only where it is needed: whoever changes a mesh that is held copies it first.
        let is_needed = step.refused.is_some() || !operation.is_atomic();
        let before = is_needed.then(|| self.scene.clone());
        let on = step.on_names();
        let progress: &dyn Progress = &Forward(listener);
        let mut cx = Context::new(progress, files);
        cx.on = on.as_deref();
        cx.stream = step.label();
        cx.budget = self.settings.budget;
        let result = operation.apply(&mut self.scene, &mut cx);
        if result.is_err() || step.refused.is_some() {
            self.scene = before.unwrap_or_else(|| std::mem::take(&mut self.scene));
        }
        match (result, step.refused) {
            (Err(OpError::Cancelled), _) => Err(None),
            (Ok(report), None) => Ok((report, None)),
            (Ok(_), Some(expected)) => Err(Some(format!(
                "expected to be refused as {expected:?}, but it was done"
            ))),
            (Err(OpError::Refused { reason, message }), Some(expected)) if reason == expected => {
                Ok((
                    Report::default().note(format!("refused as expected: {message}")),
                    Some(reason),
                ))
            }
            (Err(error), None) => Err(Some(error.to_string())),
            (Err(error), Some(expected)) => Err(Some(format!(
                "expected to be refused as {expected:?}, but: {error}"
            ))),
        }
    }

    fn done(
        &self,
        label: &str,
        report: Report,
        refused: Option<Refusal>,
        time: Duration,
    ) -> StepDone {
        let count = |n: fn(&mesh::Mesh) -> usize| {
            let meshes = self
                .scene
                .objects()
                .iter()
                .filter_map(|o| match &o.geometry {
                    Geometry::Mesh(mesh) => Some(mesh),
                    _ => None,
                });
            meshes.map(|m| n(m)).sum()
        };
        StepDone {
            label: label.to_owned(),
            report,
            refused,
            vertices: count(mesh::Mesh::n_vertices),
            edges: count(mesh::Mesh::n_edges),
            faces: count(mesh::Mesh::n_faces),
            time,
        }
    }

    /// Holds the expectations after this step, or at the end, against the scene.
    fn expectations(&mut self, after: Option<usize>, files: &[Files]) {
        for (i, placed) in self.recipe.expectations.iter().enumerate() {
            if placed.after != after {
                continue;
            }
            let subject = Subject {
                scene: &self.scene,
                on: placed.on.as_deref(),
                files: &files[placed.scope],
                read: self.settings.read,
            };
            self.checked += 1;
            if let Err(broken) = placed.that.hold(subject) {
                self.unmet.push(Unmet {
                    expectation: i,
                    failure: self.failures.len(),
                    found: broken.found,
                });
                let failure = Diagnostic::error(placed.span, broken.message);
                let step = after.and_then(|i| self.recipe.steps.get(i));
                let failure = match step.filter(|step| step.scope == placed.scope) {
                    Some(step) => failure.with_label(step.span, "after this step"),
                    None => failure,
                };
                self.fail(placed.scope, failure);
            }
        }
    }
}

/// A listener as plain progress.
struct Forward<'a>(&'a dyn Listener);

impl Progress for Forward<'_> {
    fn advance(&self, what: &str, done: u64, total: u64) -> bool {
        self.0.advance(what, done, total)
    }
}

/// How the names of the folders begin in which the outputs of a process wait. They are there as long as
/// a run goes on, and stay only if the process is killed.
pub fn stage_prefix(process: u32) -> String {
    format!(".meshwright-{process}-")
}

/// A folder inside the output folder where files wait until everything has held.
fn staging(settings: Settings) -> Result<Option<tempfile::TempDir>, String> {
    if !settings.writes {
        return Ok(None);
    }
    let folder = &settings.files.output;
    let made = || -> std::io::Result<tempfile::TempDir> {
        if settings.keep_outputs {
            std::fs::create_dir_all(folder)?;
            tempfile::Builder::new()
                .prefix(&stage_prefix(std::process::id()))
                .tempdir_in(folder)
        } else {
            tempfile::Builder::new().prefix("meshwright-").tempdir()
        }
    };
    made().map(Some).map_err(|error| {
        format!(
            "cannot write to the output folder {}: {error}",
            folder.display()
        )
    })
}

/// Moves all files to their places.
fn deliver(stage: &Path, files: &Files) -> Result<Vec<PathBuf>, String> {
    let mut waiting = Vec::new();
    collect(stage, &mut waiting).map_err(|e| format!("cannot list the outputs: {e}"))?;
    waiting.sort();
    let mut moves = Vec::new();
    for from in waiting {
        let relative = from.strip_prefix(stage).expect("found below the stage");
        let to = files.output.join(relative);
        let failed = |e: std::io::Error| format!("cannot write {}: {e}", to.display());
        files.check_links(relative).map_err(|e| e.to_string())?;
        if let Some(folder) = to.parent() {
            std::fs::create_dir_all(folder).map_err(failed)?;
        }
        if to.is_dir() {
            return Err(format!(
                "cannot write {}: there is a folder of that name",
                to.display()
            ));
        }
        moves.push((from, to));
    }
    for (from, to) in &moves {
        std::fs::rename(from, to).map_err(|e| format!("cannot write {}: {e}", to.display()))?;
    }
    Ok(moves.into_iter().map(|(_, to)| to).collect())
}

fn collect(folder: &Path, found: &mut Vec<PathBuf>) -> std::io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            collect(&path, found)?;
        } else {
            found.push(path);
        }
    }
    Ok(())
}

/// Follows nothing and never stops.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {
    fn advance(&self, _: &str, _: u64, _: u64) -> bool {
        true
    }
}

impl Listener for Silent {
    fn step_begins(&self, _: usize, _: &str) {}
    fn step_done(&self, _: usize, _: &StepDone) {}
}
