//! Running a recipe.
//!
//! Steps run one after another on a scene. If one fails, the run ends and nothing is written: outputs
//! go to a folder of their own beside their places, and are moved there when everything has held.
//!
//! With a [cache](StepCache) a step runs only if the cache does not have its result, and a scene is
//! brought back from it only where a step runs or an expectation must be held against it.

mod before;
mod cache;
mod listener;
mod outcome;
mod stage;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use op::{Context, ErrorLocation, FileLog, Files, OpError, Progress, Refusal, Report};
use scene::{Digest, Geometry, Scene};
use web_time::Instant;

use crate::check::forbidden;
use crate::expect::{ActualValue, Reader, Subject};
use crate::recipe::{Recipe, RecipeStep};
use before::Before;
use ron_tree::Diagnostic;
use stage::{deliver, listing, staging, written};

pub use cache::{CachedRun, Change, Done, Finding, RerunReason, StepCache};
pub use listener::{Failure, Listener, Silent, StepDone};
pub use outcome::{Outcome, UnmetExpectation};

/// What a run needs beside its recipe.
#[derive(Clone, Copy)]
pub struct Settings<'a> {
    /// Where files are.
    pub files: &'a Files,
    /// How many bytes meshes may take.
    pub budget: u64,
    /// How files are read for expectations.
    pub reader: &'a dyn Reader,
    /// Whether outputs are kept.
    pub keep_outputs: bool,
    /// Whether the recipe writes anything.
    pub writes: bool,
    /// The cache, if there is one.
    pub cache: Option<&'a dyn StepCache>,
}

/// Runs a recipe that was read and checked without errors.
pub fn run(recipe: &Recipe, settings: Settings, listener: &dyn Listener) -> Outcome {
    run_from(recipe, 0, Scene::new(), settings, listener)
}

/// Runs a recipe from the step of number `first` on: `scene` is that before it, as [`Listener::scene_after`] or an
/// [`Outcome`] gave it. A change of a step costs no step before it.
///
/// Expectations after earlier steps are not held again, and what earlier steps write is not written again. There is no
/// cache then: it knows a scene by the steps that led to it, and nobody checks that these led to `scene`.
pub fn run_from(
    recipe: &Recipe,
    first: usize,
    scene: Scene,
    settings: Settings,
    listener: &dyn Listener,
) -> Outcome {
    // The cache reads inputs and outputs from the disk by itself.
    let is_useful = first == 0 && settings.files.store.is_disk();
    let cache = settings.cache.filter(|_| is_useful);
    let mut runner = Runner {
        recipe,
        settings,
        files: Vec::new(),
        log: FileLog::default(),
        stage: None,
        session: cache.map(StepCache::begin),
        scene,
        at: first,
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
            // Only what this run asks for counts.
            files.log.clone_from(&runner.log);
            if let Some(stage) = &stage {
                stage.path().clone_into(&mut files.output);
                runner.stage = Some(stage.path().to_owned());
            }
            runner.files = recipe.files(&files);
            runner.run(listener);
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
    runner.end(written)
}

struct Runner<'a> {
    recipe: &'a Recipe,
    settings: Settings<'a>,
    /// Where the steps of each scope read, and the stage that they write to.
    files: Vec<Files>,
    /// What they ask for.
    log: FileLog,
    stage: Option<PathBuf>,
    session: Option<Box<dyn CachedRun + 'a>>,
    /// The scene before the step of number `at`. Later steps than that were found in the cache.
    scene: Scene,
    at: usize,
    /// The step that the run began with.
    first: usize,
    /// How many steps are done: one more than are listed if the last one lost what it must not.
    n_done: usize,
    steps: Vec<StepDone>,
    failures: Vec<Diagnostic>,
    unmet: Vec<UnmetExpectation>,
    cancelled: bool,
    checked: usize,
}

/// Why a step failed, and the places that it is about.
pub(crate) struct Fault {
    pub(crate) message: String,
    places: Vec<ErrorLocation>,
}

/// Why a run goes no further: it was cancelled, or a failure was reported.
struct Stopped;

impl Runner<'_> {
    fn run(&mut self, listener: &dyn Listener) {
        // What stopped it is told already.
        let _ = self.run_steps(listener);
        if self.failures.is_empty()
            && !self.cancelled
            && self.session.as_ref().is_some_and(|s| s.wants_scene())
        {
            let _ = self.bring(self.n_done, listener);
        }
    }

    fn run_steps(&mut self, listener: &dyn Listener) -> Result<(), Stopped> {
        let recipe = self.recipe;
        for (i, step) in recipe.steps.iter().enumerate().skip(self.first) {
            listener.step_begins(i, step.label());
            let mut done = self.found_or_run(i, step, listener)?;
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
                self.bring(self.n_done, listener)?;
                listener.scene_after(i, &self.scene);
            }
            self.expectations(Some(i), listener)?;
            if i + 1 < recipe.steps.len()
                && let Some(session) = &mut self.session
            {
                session.flush();
            }
        }
        self.expectations(None, listener)
    }

    /// Takes the result of a step from the cache, or runs it.
    fn found_or_run(
        &mut self,
        i: usize,
        step: &RecipeStep,
        listener: &dyn Listener,
    ) -> Result<StepDone, Stopped> {
        let begin = Instant::now();
        let files = &self.files[step.scope];
        let why = if let Some(session) = &mut self.session {
            // Outputs that are held against others must be there, even if nobody keeps them.
            let is_wanted = |_: &&Path| self.settings.keep_outputs || self.recipe.holds_outputs();
            let stage = self.stage.as_deref().filter(is_wanted);
            match session.find(step, self.settings.budget, files, stage) {
                Ok(found) => {
                    if !listener.advance(step.label(), 1, 1) {
                        self.cancelled = true;
                        return Err(Stopped);
                    }
                    return Ok(StepDone::new(step, found, begin.elapsed(), None));
                }
                Err(why) => why,
            }
        } else {
            RerunReason::NoCache
        };
        self.bring(i, listener)?;
        let session = self.session.as_ref();
        let before = session.map(|_| Before::of(&self.scene));
        let stage = self.stage.as_deref().filter(|_| session.is_some());
        let listed = stage.map(|stage| listing(stage, &self.files[step.scope]));
        self.log.take();
        let begin = Instant::now();
        let (report, refused) = self.apply(step, listener)?;
        let time = begin.elapsed();
        self.at = i + 1;
        let finding = Finding {
            report,
            refused,
            counts: counts(&self.scene),
        };
        if let (Some(session), Some(before)) = (&mut self.session, before) {
            let stage = self.stage.as_deref();
            let files = &self.files[step.scope];
            let done = Done {
                finding: &finding,
                scene: &self.scene,
                same: before.is_still(&self.scene),
                time,
                uses: &self.log.take(),
                written: (stage.zip(listed.as_ref())).map_or_else(Vec::new, |(stage, before)| {
                    written(before, &listing(stage, files))
                }),
                stage,
            };
            session.ran(i + 1, step.label(), files, &done);
        }
        Ok(StepDone::new(step, finding, time, Some(why)))
    }

    /// The digest of the scene after the steps that are done.
    fn digest(&mut self, listener: &dyn Listener) -> Result<Digest, Stopped> {
        if let Some(known) = self.session.as_ref().and_then(|s| s.digest()) {
            return Ok(known);
        }
        self.bring(self.n_done, listener)?;
        let digest = self.scene.digest();
        if let Some(session) = &mut self.session {
            session.set_digest(digest);
        }
        Ok(digest)
    }

    /// Makes the scene that of the place before step `to`, all steps before which are done: from the cache, and by
    /// running steps again whose scenes are not there.
    fn bring(&mut self, to: usize, listener: &dyn Listener) -> Result<(), Stopped> {
        if self.at < to
            && let Some(session) = &mut self.session
            && let Some((place, scene)) = session.bring(self.at, to)
        {
            (self.at, self.scene) = (place, scene);
        }
        let recipe = self.recipe;
        while self.at < to {
            let place = self.at;
            if !self.session.as_ref().is_some_and(|s| s.is_same(place)) {
                let step = &recipe.steps[place];
                let begin = Instant::now();
                self.apply(step, listener)?;
                let time = begin.elapsed();
                if let Some(session) = &mut self.session {
                    let why = session.ran_again(place + 1, step.label(), &self.scene, time);
                    let done = place.checked_sub(self.first);
                    if let Some(done) = done.and_then(|i| self.steps.get_mut(i)) {
                        done.time += time;
                        done.ran.get_or_insert(why);
                    }
                }
            }
            self.at += 1;
        }
        Ok(())
    }

    /// Does a step. The scene is as it was before if that fails.
    fn apply(
        &mut self,
        step: &RecipeStep,
        listener: &dyn Listener,
    ) -> Result<(Report, Option<Refusal>), Stopped> {
        let (files, budget) = (&self.files[step.scope], self.settings.budget);
        attempt(step, &mut self.scene, files, budget, listener).map_err(|fault| {
            match fault {
                None => self.cancelled = true,
                Some(Fault { message, places }) => {
                    let failure = Diagnostic::error(step.span, message);
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

    /// Holds the expectations after this step, or at the end, against the scene.
    fn expectations(
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
                .is_some_and(|s| s.holds(placed, &self.files[placed.scope]))
            {
                self.checked += 1;
                continue;
            }
            let is_about_files = placed.that.output().is_some();
            if !is_about_files || listener.wants_places() {
                self.bring(self.n_done, listener)?;
            }
            self.log.take();
            let subject = Subject {
                scene: &self.scene,
                on: placed.on.as_deref(),
                files: &self.files[placed.scope],
                reader: self.settings.reader,
            };
            self.checked += 1;
            match placed.that.hold(subject) {
                Ok(()) => {
                    let session = self.session.as_mut().filter(|_| !is_about_files);
                    if let Some(session) = session {
                        session.held(placed, &self.log.take());
                    }
                }
                Err(broken) => {
                    let failure = Diagnostic::error(placed.span, broken.message);
                    let step = after.and_then(|i| recipe.steps.get(i));
                    let failure = match step.filter(|step| step.scope == placed.scope) {
                        Some(step) => failure.with_label(step.span, "after this step"),
                        None => failure,
                    };
                    let places = if listener.wants_places() {
                        placed.that.places(subject)
                    } else {
                        Vec::new()
                    };
                    let place = self.failures.len();
                    let found = broken.found.as_ref();
                    self.fail(placed.scope, failure, (&places, found), listener);
                    self.unmet.push(UnmetExpectation {
                        expectation: i,
                        failure: place,
                        found: broken.found,
                    });
                }
            }
        }
        Ok(())
    }

    fn end(mut self, written: Vec<PathBuf>) -> Outcome {
        let is_whole = self.at == self.n_done;
        let known = self.session.as_ref().and_then(|s| s.digest());
        if known.is_none() && !is_whole && !self.cancelled {
            // A step that is run again for its scene and fails was told before.
            let _ = self.bring(self.n_done, &Silent);
        }
        let is_whole = self.at == self.n_done;
        let digest = known.unwrap_or_else(|| self.scene.digest());
        let (mut cache_problem, mut cache_notes) = (None, Vec::new());
        if let Some(mut session) = self.session {
            if is_whole {
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
            scene: is_whole.then_some(self.scene),
            digest,
            written,
            cache_problem,
            cache_notes,
        }
    }
}

/// Does a step. Fails with a message and the places that it is about, or without them if it was cancelled; the
/// scene is then as it was before.
pub(crate) fn attempt(
    step: &RecipeStep,
    scene: &mut Scene,
    files: &Files,
    budget: u64,
    progress: &dyn Progress,
) -> Result<(Report, Option<Refusal>), Option<Fault>> {
    let fault = |message: String, places: &[ErrorLocation]| {
        let places = places.to_vec();
        Err(Some(Fault { message, places }))
    };
    let Some(operation) = &step.step else {
        return fault("this step could not be read".to_owned(), &[]);
    };
    // Held only where it is needed: whoever changes a mesh that is held copies it first.
    let is_needed = step.refused.is_some() || !operation.is_atomic();
    let before = is_needed.then(|| scene.clone());
    let on = step.on_names();
    let mut cx = Context::new(progress, files);
    cx.on = on.as_deref();
    cx.stream = step.label();
    cx.budget = budget;
    // After a panic nothing is known of the scene, and nobody asks for it: the run ends.
    let apply = AssertUnwindSafe(|| operation.apply(scene, &mut cx));
    let Ok(result) = catch_unwind(apply) else {
        *scene = before.unwrap_or_default();
        let message = format!("{} has panicked, which is a mistake in it", step.name);
        return fault(message, &[]);
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
            let message = format!("expected to be refused as {expected:?}, but it was done");
            fault(message, &[])
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
        (Err(error), None) => fault(error.to_string(), error.places()),
        (Err(error), Some(expected)) => {
            let message = format!("expected to be refused as {expected:?}, but: {error}");
            fault(message, error.places())
        }
    }
}

/// Whether one place of an expectation comes before another: the end is the last one.
fn is_before(a: Option<usize>, b: Option<usize>) -> bool {
    a.is_some_and(|a| b.is_none_or(|b| a < b))
}

/// Vertices, edges and faces of all meshes together; points of polylines are vertices.
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
