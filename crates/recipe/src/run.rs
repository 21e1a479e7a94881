//! Runs the steps of a recipe.
//!
//! The steps run on a scene, one after another. If a step fails, the run ends and no outputs are written. Steps write
//! their files to a temporary folder. The files are moved to the output folder only after all steps have run and all
//! expectations hold.
//!
//! If a [cache](StepCache) is used, a step runs in two cases. Either the cache does not have the result of the step, or
//! the scene after the step is needed and is not in the cache. A scene is needed if the next step must run, or if an
//! expectation must be checked against the scene. The listener and the cache can also request a scene.

mod cache;
mod listener;
mod outcome;
mod snapshot;
mod stage;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use op::{Context, ErrorLocation, FileLog, Files, OpError, Progress, Refusal, Report};
use scene::{Digest, Geometry, Scene};
use web_time::Instant;

use crate::check::forbidden;
use crate::expect::{ActualValue, Reader, Subject};
use crate::recipe::{Recipe, RecipeStep};
use ron_tree::Diagnostic;
use snapshot::SceneSnapshot;
use stage::{deliver, listing, staging, written};

pub use cache::{CachedRun, CompletedStep, FileChange, RerunReason, StepCache, StepResult};
pub use listener::{Failure, Listener, Silent, StepDone};
pub use outcome::{Outcome, UnmetExpectation};

/// The settings of a run.
#[derive(Clone, Copy)]
pub struct Settings<'a> {
    /// The input and output folders, and the store of files.
    pub files: &'a Files,
    /// The memory budget for meshes, in bytes.
    pub budget: u64,
    /// Reads the files that expectations refer to.
    pub reader: &'a dyn Reader,
    /// Whether the output files are kept after the run.
    pub keep_outputs: bool,
    /// Whether the recipe has a step that writes files.
    pub writes: bool,
    /// The step cache, if one is used.
    pub cache: Option<&'a dyn StepCache>,
}

/// Runs a recipe that was read and checked without errors.
pub fn run(recipe: &Recipe, settings: Settings, listener: &dyn Listener) -> Outcome {
    run_from(recipe, 0, Scene::new(), settings, listener)
}

/// Runs a recipe starting at the step with index `first`. `scene` is the scene before this step. An earlier run has
/// passed this scene to [`Listener::scene_after`] or returned it in an [`Outcome`]. Use this function after a change of
/// one step: the steps before this step need not run again.
///
/// The steps before `first` do not write their files again, and the expectations after these steps are not checked
/// again. If `first` is not 0, the cache is not used. The cache identifies a scene by the steps that produced it, and
/// these steps are not known for `scene`.
pub fn run_from(
    recipe: &Recipe,
    first: usize,
    scene: Scene,
    settings: Settings,
    listener: &dyn Listener,
) -> Outcome {
    // The cache accesses inputs and outputs directly on disk, so it does not work with files in a different store.
    let is_usable = first == 0 && settings.files.store.is_disk();
    let cache = settings.cache.filter(|_| is_usable);
    let mut runner = Runner {
        recipe,
        settings,
        files: Vec::new(),
        log: FileLog::default(),
        stage: None,
        session: cache.map(StepCache::begin),
        scene,
        scene_index: first,
        first,
        n_done: first,
        steps: Vec::new(),
        failures: Vec::new(),
        unmet: Vec::new(),
        cancelled: false,
        checked: 0,
    };
    let mut written = Vec::new();
    match staging(&settings) {
        Ok(stage) => {
            let mut files = settings.files.clone();
            // The log of `runner` is new, so it has only the file accesses of this run.
            files.log.clone_from(&runner.log);
            if let Some(stage) = &stage {
                stage.path().clone_into(&mut files.output);
                runner.stage = Some(stage.path().to_owned());
            }
            runner.files = recipe.files(&files);
            runner.run(listener);
            if runner.failures.is_empty()
                && !runner.cancelled
                && settings.keep_outputs
                && let Some(stage) = &stage
            {
                let result;
                (written, result) = deliver(stage.path(), settings.files);
                let error = result.err().map(Diagnostic::without_place);
                runner.failures.extend(error);
            }
        }
        Err(message) => runner.failures.push(Diagnostic::without_place(message)),
    }
    runner.end(written)
}

struct Runner<'a> {
    recipe: &'a Recipe,
    settings: Settings<'a>,
    /// For each scope: the folder that contains its input files, and the temporary folder for its output files.
    files: Vec<Files>,
    /// The file accesses of the current step, or of the current expectation.
    log: FileLog,
    stage: Option<PathBuf>,
    session: Option<Box<dyn CachedRun + 'a>>,
    /// The scene before the step with index `scene_index`. If the results of the last steps were taken from the cache,
    /// `scene_index` is less than `n_done`.
    scene: Scene,
    scene_index: usize,
    /// The index of the first step of the run.
    first: usize,
    /// The index of the first step that is not yet done. A step with a loss that is not allowed counts as done, but it
    /// is not in `steps`.
    n_done: usize,
    steps: Vec<StepDone>,
    failures: Vec<Diagnostic>,
    unmet: Vec<UnmetExpectation>,
    cancelled: bool,
    checked: usize,
}

/// Why a step failed.
#[derive(Clone, Debug, PartialEq)]
pub struct StepError {
    /// The reason in one line. The line starts in lower case and has no period at the end.
    pub message: String,
    /// The locations in the scene to which the failure refers, if any are known.
    pub places: Vec<ErrorLocation>,
    /// Advice for the user, if there is any.
    pub help: Option<&'static str>,
}

/// The error that ends a run early. The cancellation or the failure that caused this error is already recorded.
struct Stopped;

impl Runner<'_> {
    fn run(&mut self, listener: &dyn Listener) {
        // If the run ends early, the cancellation or the failure is already recorded, so the returned error is ignored.
        let _ = self.run_steps(listener);
        if self.failures.is_empty()
            && !self.cancelled
            && self.session.as_ref().is_some_and(|s| s.wants_scene())
        {
            let _ = self.advance_scene(self.n_done, listener);
        }
    }

    fn run_steps(&mut self, listener: &dyn Listener) -> Result<(), Stopped> {
        let recipe = self.recipe;
        for (i, step) in recipe.steps.iter().enumerate().skip(self.first) {
            listener.step_begins(i, step.label());
            let mut done = self.look_up_or_run(i, step, listener)?;
            self.n_done = i + 1;
            if listener.wants_digests() {
                done.digest = Some(self.digest(listener)?);
            }
            if let Some(loss) = step.on_loss.forbidden(&done.report.losses) {
                self.fail(step.scope, forbidden(step, loss), (&[], None), listener);
                return Err(Stopped);
            }
            listener.step_done(i, &done);
            self.steps.push(done);
            if listener.wants_scenes() {
                self.advance_scene(self.n_done, listener)?;
                listener.scene_after(i, &self.scene);
            }
            self.check_expectations(Some(i), listener)?;
            if i + 1 < recipe.steps.len()
                && let Some(session) = &mut self.session
            {
                session.flush();
            }
        }
        self.check_expectations(None, listener)
    }

    /// Takes the result of a step from the cache, or runs the step.
    fn look_up_or_run(
        &mut self,
        i: usize,
        step: &RecipeStep,
        listener: &dyn Listener,
    ) -> Result<StepDone, Stopped> {
        let begin = Instant::now();
        let files = &self.files[step.scope];
        let why = if let Some(session) = &mut self.session {
            // Expectations about outputs need the files, even if the outputs are not kept.
            let needs_files =
                |_: &&Path| self.settings.keep_outputs || self.recipe.checks_outputs();
            let stage = self.stage.as_deref().filter(needs_files);
            match session.look_up(step, self.settings.budget, files, stage) {
                Ok(result) => {
                    if !listener.advance(step.label(), 1, 1) {
                        self.cancelled = true;
                        return Err(Stopped);
                    }
                    return Ok(StepDone::new(step, result, begin.elapsed(), None));
                }
                Err(why) => why,
            }
        } else {
            RerunReason::NoCache
        };
        self.advance_scene(i, listener)?;
        let session = self.session.as_ref();
        let before = session.map(|_| SceneSnapshot::of(&self.scene));
        let stage = self.stage.as_deref().filter(|_| session.is_some());
        let listed = stage.map(|stage| listing(stage, &self.files[step.scope]));
        self.log.take();
        let begin = Instant::now();
        let (report, refused) = self.apply(step, listener)?;
        let time = begin.elapsed();
        self.scene_index = i + 1;
        let result = StepResult {
            report,
            refused,
            counts: counts(&self.scene),
        };
        if let (Some(session), Some(before)) = (&mut self.session, before) {
            let stage = self.stage.as_deref();
            let files = &self.files[step.scope];
            let done = CompletedStep {
                result: &result,
                scene: &self.scene,
                keeps_scene: before.is_unchanged(&self.scene),
                time,
                uses: &self.log.take(),
                written: (stage.zip(listed.as_ref())).map_or_else(Vec::new, |(stage, before)| {
                    written(before, &listing(stage, files))
                }),
                stage,
            };
            session.record_step(i + 1, step.label(), files, &done);
        }
        Ok(StepDone::new(step, result, time, Some(why)))
    }

    /// Returns the digest of the scene after all steps that are done so far.
    fn digest(&mut self, listener: &dyn Listener) -> Result<Digest, Stopped> {
        if let Some(known) = self.session.as_ref().and_then(|s| s.digest()) {
            return Ok(known);
        }
        self.advance_scene(self.n_done, listener)?;
        let digest = self.scene.digest();
        if let Some(session) = &mut self.session {
            session.set_digest(digest);
        }
        Ok(digest)
    }

    /// Advances `scene` to the scene before the step with the index `to`. All earlier steps must be done. If the cache
    /// has scenes from between these two points of the run, loads the latest of these scenes. Then runs the remaining
    /// steps before `to` again.
    fn advance_scene(&mut self, to: usize, listener: &dyn Listener) -> Result<(), Stopped> {
        if self.scene_index < to
            && let Some(session) = &mut self.session
            && let Some((index, scene)) = session.load_scene(self.scene_index, to)
        {
            (self.scene_index, self.scene) = (index, scene);
        }
        let recipe = self.recipe;
        while self.scene_index < to {
            let index = self.scene_index;
            if !(self.session.as_ref()).is_some_and(|s| s.keeps_scene(index)) {
                let step = &recipe.steps[index];
                let begin = Instant::now();
                self.apply(step, listener)?;
                let time = begin.elapsed();
                if let Some(session) = &mut self.session {
                    let why = session.record_rerun(index + 1, step.label(), &self.scene, time);
                    let done = index.checked_sub(self.first);
                    if let Some(done) = done.and_then(|i| self.steps.get_mut(i)) {
                        done.time += time;
                        done.ran.get_or_insert(why);
                    }
                }
            }
            self.scene_index += 1;
        }
        Ok(())
    }

    /// Runs a step. If the step fails, reports the failure. See [`run_step`] for the scene after a failure.
    fn apply(
        &mut self,
        step: &RecipeStep,
        listener: &dyn Listener,
    ) -> Result<(Report, Option<Refusal>), Stopped> {
        let (files, budget) = (&self.files[step.scope], self.settings.budget);
        run_step(step, &mut self.scene, files, budget, listener).map_err(|error| {
            match error {
                None => self.cancelled = true,
                Some(StepError {
                    message,
                    places,
                    help,
                }) => {
                    let mut failure = Diagnostic::error(step.span, message);
                    failure.help = help.map(str::to_owned);
                    self.fail(step.scope, failure, (&places, None), listener);
                }
            }
            Stopped
        })
    }

    fn fail(
        &mut self,
        scope: usize,
        failure: Diagnostic,
        (places, found): (&[ErrorLocation], Option<&ActualValue>),
        listener: &dyn Listener,
    ) {
        let diagnostic = self.recipe.located(failure, scope);
        listener.failed(&Failure {
            diagnostic: &diagnostic,
            scene: &self.scene,
            places,
            found,
        });
        self.failures.push(diagnostic);
    }

    /// Checks the expectations that are placed after the step with the index `after`. If `after` is `None`, checks the
    /// expectations at the end of the recipe.
    fn check_expectations(
        &mut self,
        after: Option<usize>,
        listener: &dyn Listener,
    ) -> Result<(), Stopped> {
        let recipe = self.recipe;
        let first = (recipe.expectations).partition_point(|p| is_before(p.after, after));
        let placed = recipe.expectations.iter().enumerate().skip(first);
        for (i, placed) in placed.take_while(|(_, placed)| placed.after == after) {
            if self
                .session
                .as_mut()
                .is_some_and(|s| s.is_known_to_hold(placed, &self.files[placed.scope]))
            {
                self.checked += 1;
                continue;
            }
            let is_about_files = placed.that.output().is_some();
            if !is_about_files || listener.wants_places() {
                self.advance_scene(self.n_done, listener)?;
            }
            self.log.take();
            let subject = Subject {
                scene: &self.scene,
                on: placed.on.as_deref(),
                files: &self.files[placed.scope],
                reader: self.settings.reader,
                progress: listener,
            };
            self.checked += 1;
            let result = placed.that.check(subject);
            if !listener.advance(
                "check",
                self.checked as u64,
                recipe.expectations.len() as u64,
            ) {
                self.cancelled = true;
                return Err(Stopped);
            }
            match result {
                Ok(()) => {
                    let session = self.session.as_mut().filter(|_| !is_about_files);
                    if let Some(session) = session {
                        session.record_met_expectation(placed, &self.log.take());
                    }
                }
                Err(violation) => {
                    let failure = Diagnostic::error(placed.span, violation.message);
                    let step = after.and_then(|i| recipe.steps.get(i));
                    let failure = match step.filter(|step| step.scope == placed.scope) {
                        Some(step) if step.turns.is_empty() => {
                            failure.with_label(step.span, "after this step")
                        }
                        Some(step) => {
                            failure.with_label(step.span, format!("after {}", step.label()))
                        }
                        None => failure,
                    };
                    let places = if listener.wants_places() {
                        placed.that.places(subject)
                    } else {
                        Vec::new()
                    };
                    let index = self.failures.len();
                    let found = violation.found.as_ref();
                    self.fail(placed.scope, failure, (&places, found), listener);
                    self.unmet.push(UnmetExpectation {
                        expectation: i,
                        failure: index,
                        found: violation.found,
                    });
                }
            }
        }
        Ok(())
    }

    fn end(mut self, written: Vec<PathBuf>) -> Outcome {
        let is_current = self.scene_index == self.n_done;
        let known = self.session.as_ref().and_then(|s| s.digest());
        if known.is_none() && !is_current && !self.cancelled {
            // If a step fails while it runs again, `apply` adds the failure to `failures`, so the returned error is
            // ignored.
            let _ = self.advance_scene(self.n_done, &Silent);
        }
        let is_current = self.scene_index == self.n_done;
        let digest = known.unwrap_or_else(|| self.scene.digest());
        let (mut cache_problem, mut cache_notes) = (None, Vec::new());
        if let Some(mut session) = self.session {
            if is_current {
                session.set_digest(digest);
            }
            (cache_problem, cache_notes) = session.finish();
        }
        Outcome {
            first: self.first,
            steps: self.steps,
            failures: self.failures,
            unmet: self.unmet,
            cancelled: self.cancelled,
            checked: self.checked,
            scene: is_current.then_some(self.scene),
            digest,
            written,
            cache_problem,
            cache_notes,
        }
    }
}

/// Runs a step that was read and checked without errors. Returns the report of the step. If the recipe expects a
/// refusal, also returns the reason for the refusal.
///
/// # Errors
///
/// Returns `None` if the step was canceled. Returns the reason if the step failed. After a cancellation or a failure,
/// the scene is unchanged, with one exception. If the operation panicked and the scene had not been cloned before, the
/// scene is empty.
pub fn run_step(
    step: &RecipeStep,
    scene: &mut Scene,
    files: &Files,
    budget: u64,
    progress: &dyn Progress,
) -> Result<(Report, Option<Refusal>), Option<StepError>> {
    let error = |message: String, places: &[ErrorLocation]| {
        let places = places.to_vec();
        Err(Some(StepError {
            message,
            places,
            help: None,
        }))
    };
    let Some(operation) = &step.step else {
        return error("this step could not be read".to_owned(), &[]);
    };
    // The scene is cloned only if needed. While a clone exists, an operation must copy each mesh before it changes the
    // mesh.
    let needs_rollback = step.refused.is_some() || !operation.is_atomic();
    let before = needs_rollback.then(|| scene.clone());
    let on = step.on_names();
    let mut cx = Context::new(progress, files);
    cx.on = on.as_deref();
    cx.stream = step.label();
    cx.budget = budget;
    // `AssertUnwindSafe` is correct here: after a panic, the scene is replaced and the run ends.
    let apply = AssertUnwindSafe(|| operation.apply(scene, &mut cx));
    let result = match catch_unwind(apply) {
        Ok(result) => result,
        Err(payload) => {
            *scene = before.unwrap_or_default();
            let name = &step.name;
            let message = match payload.downcast_ref::<mesh::OutOfMemory>() {
                Some(missing) => format!("{name}: {missing}"),
                None => format!("internal error in {name} (please report it)"),
            };
            return error(message, &[]);
        }
    };
    if (result.is_err() || step.refused.is_some())
        && let Some(before) = before
    {
        *scene = before;
    }
    match (result, step.refused) {
        (Err(OpError::Cancelled), _) => Err(None),
        (Ok(report), None) => Ok((report, None)),
        (Ok(_), Some(expected)) => {
            let message = format!(
                "expected the step to be refused with the reason {expected:?}, but the step succeeded"
            );
            error(message, &[])
        }
        (
            Err(OpError::Refused {
                reason, message, ..
            }),
            Some(expected),
        ) if reason == expected => {
            let report = Report::default().note(format!("refused as expected: {message}"));
            Ok((report, Some(reason)))
        }
        (Err(found), None) => Err(Some(StepError {
            message: found.to_string(),
            places: found.places().to_vec(),
            help: found.help(),
        })),
        (Err(found), Some(expected)) => {
            let message = format!(
                "expected the step to be refused with the reason {expected:?}, but the step failed for another reason: {found}"
            );
            error(message, found.places())
        }
    }
}

/// Whether step `a` comes before step `b`. `None` stands for the end of the recipe.
fn is_before(a: Option<usize>, b: Option<usize>) -> bool {
    a.is_some_and(|a| b.is_none_or(|b| a < b))
}

/// Returns the number of vertices, of edges, and of faces of all meshes together. The points of polylines are counted
/// as vertices.
fn counts(scene: &Scene) -> [usize; 3] {
    let mut counts = [0; 3];
    for object in scene.objects() {
        match &object.geometry {
            Geometry::Mesh(mesh) => {
                counts[0] += mesh.n_vertices();
                counts[1] += mesh.n_edges();
                counts[2] += mesh.n_faces();
            }
            Geometry::Polylines(lines) => counts[0] += lines.iter().map(Vec::len).sum::<usize>(),
            Geometry::Patches(_) | Geometry::Curve(_) => {}
        }
    }
    counts
}
