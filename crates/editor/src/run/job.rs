//! One run: reads and checks the recipe, finds the first step that must run, and runs this step and all later steps.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use engine::{
    Engine, Failure, Listener, Loaded, Options, Outcome, Run, StepDone, StepKeys, stamp_line,
};
use recipe::{Expectation, Recipe};
use scene::Scene;
use store::Store;
use web_time::Instant;

use super::snapshot::{Snapshot, Snapshots};
use super::state::{
    End, Event, ExpectationState, FailureState, RunState, Status, StepState, Verdict,
};
use super::{Progress, Request, Shared};

pub(super) struct Job<'a> {
    pub(super) engine: &'a Engine<'a>,
    pub(super) store: &'a dyn Store,
    pub(super) shared: &'a Shared,
    pub(super) cancel: &'a AtomicBool,
    pub(super) request: &'a Request,
}

impl Job<'_> {
    pub(super) fn run(&self, snapshots: &mut Snapshots) {
        let begin = Instant::now();
        let options = Options {
            out: &self.request.out,
            budget: self.request.budget,
            ..Options::default()
        };
        let loaded = self.engine.load(&self.request.source, &options);
        snapshots.tick();
        let keys = StepKeys::of(&loaded);
        let mut state = state_of(&loaded);
        let called = loaded
            .recipe
            .sources
            .iter()
            .skip(1)
            .map(|source| &source.path);
        let watched = called.chain(&loaded.forecast.inputs);
        let watched = watched.map(|path| (path.clone(), stamp_line(path, self.store.entry(path))));
        state.watched = watched.collect();
        let known = take_known(&mut state, &keys, snapshots);
        let number = self.request.number;
        self.shared.send(Event::Checked {
            number,
            state: Box::new(state.clone()),
        });
        let mut end = if loaded.has_errors() {
            end_of(&state, &loaded.recipe, Vec::new(), snapshots, &keys)
        } else {
            self.run_rest(&loaded, state, known, snapshots, &keys)
        };
        end.time = begin.elapsed();
        snapshots.trim(self.request.memory);
        self.shared.send(Event::Done {
            number,
            end: Box::new(end),
        });
    }

    /// Runs the first step that must run and all later steps.
    fn run_rest(
        &self,
        loaded: &Loaded,
        mut state: RunState,
        known: usize,
        snapshots: &mut Snapshots,
        keys: &StepKeys,
    ) -> End {
        let first = self.first_step(loaded, &state, known);
        let is_known = first == loaded.recipe.steps.len()
            && state
                .expectations
                .iter()
                .all(|placed| placed.verdict.is_some())
            && snapshots.digests.contains_key(&keys.end());
        if is_known && !self.request.keep_outputs {
            return end_of(&state, &loaded.recipe, Vec::new(), snapshots, keys);
        }
        let before = first
            .checked_sub(1)
            .and_then(|i| state.steps[i].result.as_ref());
        let start = before.map_or_else(Scene::new, |snapshot| (*snapshot.scene).clone());
        let follower = Follower::new(self, first);
        let run = Run {
            keep_outputs: self.request.keep_outputs,
            cache: None,
        };
        let outcome = loaded.run_from(first, start, run, &follower);
        for (i, snapshot) in take(&follower.results) {
            snapshots.insert(keys.steps[i], snapshot.clone());
            state.steps[i].result = Some(snapshot);
        }
        let found = take(&follower.failures);
        let is_whole = !outcome.cancelled && outcome.failures.len() == outcome.unmet.len();
        take_verdicts(&mut state, &loaded.recipe, &outcome, &found, is_whole);
        for (placed, key) in state.expectations.iter().zip(&keys.expectations) {
            if let Some(verdict) = &placed.verdict {
                snapshots.verdicts.insert(*key, verdict.clone());
            }
        }
        if is_whole {
            snapshots.digests.insert(keys.end(), outcome.digest);
        }
        // A failed expectation is reported by its verdict (the result of the expectation). All other failures are
        // collected here, such as an output that cannot be written.
        let is_unmet = |i: usize| outcome.unmet.iter().any(|unmet| unmet.failure == i);
        let others = outcome
            .failures
            .iter()
            .enumerate()
            .filter(|(i, _)| !is_unmet(*i));
        let failures = others.map(|(i, diagnostic)| {
            let known = found
                .get(i)
                .filter(|failure| failure.diagnostic == *diagnostic);
            known.cloned().unwrap_or_else(|| FailureState {
                diagnostic: diagnostic.clone(),
                places: Vec::new(),
                step: None,
            })
        });
        let ran = outcome.steps.len();
        let end = end_of(&state, &loaded.recipe, failures.collect(), snapshots, keys);
        End {
            canceled: outcome.cancelled,
            written: outcome.written,
            ran,
            ..end
        }
    }

    /// Returns the index of the first step that must run. `known` is the number of steps before the first step whose
    /// result is not known.
    fn first_step(&self, loaded: &Loaded, state: &RunState, known: usize) -> usize {
        if self.request.keep_outputs {
            return 0;
        }
        let mut first = known;
        // An expectation is checked only if the step before it runs. Therefore the step before each unchecked
        // expectation must run.
        for placed in state
            .expectations
            .iter()
            .filter(|placed| placed.verdict.is_none())
        {
            if let Some(after) = placed.after {
                first = first.min(after);
            }
        }
        // An expectation about outputs can be checked only if the steps that write outputs run.
        let mut expectations = loaded.recipe.expectations.iter().zip(&state.expectations);
        let needs_files = |that: &Expectation| match that {
            Expectation::Output { .. } => true,
            Expectation::Not(that) => matches!(**that, Expectation::Output { .. }),
            _ => false,
        };
        if expectations.any(|(placed, state)| state.verdict.is_none() && needs_files(&placed.that))
        {
            let forecast = &loaded.forecast.steps;
            let writes = forecast.iter().position(|step| step.n_outputs > 0);
            first = first.min(writes.unwrap_or(first));
        }
        first
    }
}

/// Adds the known results of the steps and expectations to the state. Returns the number of steps before the first step
/// whose result is not known.
fn take_known(state: &mut RunState, keys: &StepKeys, snapshots: &mut Snapshots) -> usize {
    let mut known = 0;
    for (step, key) in state.steps.iter_mut().zip(&keys.steps) {
        step.result = snapshots.get(key);
        if step.result.is_none() {
            break;
        }
        known += 1;
    }
    for (placed, key) in state.expectations.iter_mut().zip(&keys.expectations) {
        placed.verdict = snapshots.verdicts.get(key).cloned();
    }
    known
}

/// Writes the results of the checked expectations of a run into `state`. `is_whole` says whether the run has completed
/// all of its steps.
fn take_verdicts(
    state: &mut RunState,
    recipe: &Recipe,
    outcome: &Outcome,
    failures: &[FailureState],
    is_whole: bool,
) {
    let ran = outcome.first..outcome.first + outcome.steps.len();
    for (i, placed) in recipe.expectations.iter().enumerate() {
        // If a run ended early, expectations after its last step can be unchecked.
        let is_checked = match placed.after {
            None => is_whole,
            Some(after) => ran.contains(&after) && (is_whole || after + 1 < ran.end),
        };
        let unmet = outcome.unmet.iter().find(|unmet| unmet.expectation == i);
        let verdict = match unmet {
            Some(unmet) => Verdict::Fails {
                message: outcome.failures[unmet.failure].message.clone(),
                places: failures
                    .get(unmet.failure)
                    .map_or_else(Vec::new, |f| f.places.clone()),
            },
            None if is_checked => Verdict::Holds,
            None => continue,
        };
        state.expectations[i].verdict = Some(verdict);
    }
}

/// Returns the message about the end of a run, with all results that are known at that time. `failures` are the
/// failures of steps and outputs.
fn end_of(
    state: &RunState,
    recipe: &Recipe,
    mut failures: Vec<FailureState>,
    snapshots: &Snapshots,
    keys: &StepKeys,
) -> End {
    for (placed, of) in state.expectations.iter().zip(&recipe.expectations) {
        if let Some(Verdict::Fails { message, places }) = &placed.verdict {
            let diagnostic = engine::Diagnostic::error(of.span, message.clone());
            failures.push(FailureState {
                diagnostic: recipe.located(diagnostic, of.scope),
                places: places.clone(),
                step: of.after,
            });
        }
    }
    let is_whole = state.steps.iter().all(|step| step.result.is_some());
    let digest = snapshots.digests.get(&keys.end()).copied();
    End {
        canceled: false,
        failures,
        verdicts: state
            .expectations
            .iter()
            .map(|placed| placed.verdict.clone())
            .collect(),
        digest: digest.filter(|_| is_whole),
        written: Vec::new(),
        time: Duration::ZERO,
        ran: 0,
    }
}

/// Returns the state of a recipe before it runs.
fn state_of(loaded: &Loaded) -> RunState {
    let recipe = &loaded.recipe;
    let outline = crate::Outline::of(&recipe.sources[0].text);
    let steps = (recipe.steps.iter().enumerate())
        .map(|(i, step)| {
            // The place of the step in the text of the recipe. If the step belongs to a called recipe, this is the
            // place of the outermost call.
            let mut span = step.span;
            let mut scope = step.scope;
            while let Some((caller, call)) = recipe.scopes.get(scope).and_then(|s| s.called) {
                (scope, span) = (caller, call);
            }
            StepState {
                label: step.label().to_owned(),
                name: step.name.clone(),
                item: outline.step_at(span.start).unwrap_or(0),
                source: recipe.source_of(step.scope),
                span: step.span,
                forecast: loaded.forecast.steps.get(i).cloned(),
                result: None,
            }
        })
        .collect();
    let expectations = (recipe.expectations.iter())
        .map(|placed| ExpectationState {
            source: recipe.source_of(placed.scope),
            span: placed.span,
            after: placed.after,
            verdict: None,
        })
        .collect();
    RunState {
        sources: recipe.sources.clone(),
        diagnostics: loaded.diagnostics.clone(),
        steps,
        expectations,
        parameters: recipe.parameters().to_vec(),
        inputs: loaded.forecast.inputs.clone(),
        status: Status::Running(Progress::default()),
        ..RunState::default()
    }
}

/// The listener of a run: keeps the scene after each step, passes on the progress, and cancels the run on request.
struct Follower<'a> {
    job: &'a Job<'a>,
    /// The index of the current step.
    last: AtomicUsize,
    label: Mutex<String>,
    /// The report of the step whose scene is received next.
    done: Mutex<Option<StepDone>>,
    results: Mutex<Vec<(usize, Snapshot)>>,
    failures: Mutex<Vec<FailureState>>,
}

impl<'a> Follower<'a> {
    fn new(job: &'a Job<'a>, first: usize) -> Self {
        Self {
            job,
            last: AtomicUsize::new(first),
            label: Mutex::default(),
            done: Mutex::default(),
            results: Mutex::default(),
            failures: Mutex::default(),
        }
    }
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn take<T: Default>(mutex: &Mutex<T>) -> T {
    std::mem::take(&mut lock(mutex))
}

impl op::Progress for Follower<'_> {
    fn advance(&self, task: &str, done: u64, total: u64) -> bool {
        let step = lock(&self.label).clone();
        let progress = Progress {
            step,
            task: task.to_owned(),
            done,
            total,
        };
        self.job
            .shared
            .set_progress(self.job.request.number, progress);
        !self.job.cancel.load(Ordering::Relaxed)
    }
}

impl Listener for Follower<'_> {
    fn step_begins(&self, number: usize, label: &str) {
        self.last.store(number, Ordering::Relaxed);
        label.clone_into(&mut lock(&self.label));
    }

    fn step_done(&self, _: usize, done: &StepDone) {
        *lock(&self.done) = Some(done.clone());
    }

    fn wants_scenes(&self) -> bool {
        true
    }

    fn scene_after(&self, number: usize, scene: &Scene) {
        let Some(done) = lock(&self.done).take() else {
            return;
        };
        let result = Snapshot {
            scene: Arc::new(scene.clone()),
            done: Arc::new(done),
        };
        lock(&self.results).push((number, result.clone()));
        self.job.shared.send(Event::Step {
            number: self.job.request.number,
            step: number,
            result,
        });
    }

    fn failed(&self, failure: &Failure) {
        lock(&self.failures).push(FailureState {
            diagnostic: failure.diagnostic.clone(),
            places: failure.places.to_vec(),
            step: Some(self.last.load(Ordering::Relaxed)),
        });
    }

    fn wants_places(&self) -> bool {
        true
    }
}
