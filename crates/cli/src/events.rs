//! Reports a run to other programs as a sequence of events. Each event is one line with a JSON object. The lines are
//! written as the run proceeds.
//!
//! ```text
//! {"event":"start", "format":1, "program":"meshwright 0.1.0", "recipe":"a.ron", "recipe_digest":"..",
//!                   "parameters":[{"name":"levels", "value":"2", "from":"--set"}], "steps":7}
//! {"event":"step", "number":1, "label":"smooth", "operation":"LoopSubdivide"}
//! {"event":"progress", "number":1, "what":"..", "done":3, "total":8}      at most ten times per second
//! {"event":"done", "number":1, "label":"smooth", "vertices":8, "edges":12, "faces":6, "changed":6,
//!                  "refused":[{"reason":"Boundary", "count":2, "first":".."}],
//!                  "losses":[{"object":"cow", "name":"uv", "message":".."}],
//!                  "changes":[{"code":"faces-reversed", "count":2, "text":"..", "faces":[3, 7]}], "notes":[".."],
//!                  "digest":"..", "milliseconds":1.5, "cached":false,
//!                  "ran_because":"parameters changed: levels 1 -> 2"}
//! {"event":"problem", "severity":"error", "file":"a.ron", "line":7, "column":9, "message":"..", "help":".."}
//! {"event":"picture", "path":"a-error-1.png"}                             picture of a problem, with --picture-errors
//! {"event":"wrote", "path":"out/a.obj"}
//! {"event":"end", "succeeded":true, "cancelled":false, "steps":7, "expectations":4, "digest":"..",
//!                 "milliseconds":20.5}
//! ```
//!
//! `format` is the version of the event format. New events and fields can be added without a new version. Programs that
//! read events must ignore the events and fields that they do not know. Steps are numbered from 1. `end` is always the
//! last line, even if the recipe has errors and does not run. A field that has no value is `null`.

use std::io::{self, Write as _};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use op::Progress;
use recipe::{Listener, Outcome, StepDone};
use serde::Serialize;
use serde_json::{Value as Json, json};

use crate::listener::lock;
use crate::output::{STAMP, origin};
use crate::picture_errors::Pictures;
use engine::Loaded;
use engine::json::{Problem, problems, step_done};

/// The version of the event format.
const FORMAT: u32 = 1;

/// The minimum time between two progress events.
const MIN_INTERVAL: Duration = Duration::from_millis(100);

/// Writes the events of one run. Stops the run if an event cannot be written.
pub(crate) struct Events<'a> {
    loaded: &'a Loaded,
    progress: &'a dyn Progress,
    begin: Instant,
    state: Mutex<State>,
}

#[derive(Serialize)]
struct ProblemEvent {
    event: &'static str,
    #[serde(flatten)]
    problem: Problem,
}

struct State {
    /// The number of the current step, from 1.
    number: usize,
    /// The time of the last progress event.
    last_progress: Instant,
    /// The first error that occurred while an event was written.
    problem: Option<io::Error>,
}

impl<'a> Events<'a> {
    /// Writes the start event, and an event for each problem of the recipe. During the run, `progress` decides whether
    /// the run continues.
    pub(crate) fn start(loaded: &'a Loaded, progress: &'a dyn Progress) -> Self {
        let now = Instant::now();
        let events = Self {
            loaded,
            progress,
            begin: now,
            state: Mutex::new(State {
                number: 0,
                last_progress: now,
                problem: None,
            }),
        };
        let parameters: Vec<Json> = (loaded.recipe.parameters().iter())
            .map(|p| json!({ "name": p.name, "value": p.value.to_string(), "from": origin(&p.origin) }))
            .collect();
        events.write(&json!({
            "event": "start",
            "format": FORMAT,
            "program": STAMP,
            "recipe": loaded.path,
            "recipe_digest": loaded.recipe.digest(),
            "parameters": parameters,
            "steps": loaded.recipe.steps.len(),
        }));
        events.problems(&loaded.diagnostics);
        events
    }

    /// Writes events for the problems, for their pictures and for the written files, and then the end event. `outcome`
    /// is `None` if the recipe cannot run.
    ///
    /// # Errors
    ///
    /// Returns the first error that occurred while an event was written.
    pub(crate) fn end(self, outcome: Option<&Outcome>, pictures: &Pictures) -> io::Result<()> {
        self.problems(outcome.map_or(&[], |o| &o.failures));
        pictures.warn();
        for path in pictures.paths() {
            self.write(&json!({ "event": "picture", "path": path.display().to_string() }));
        }
        for path in outcome.map_or(&[][..], |o| &o.written) {
            self.write(&json!({ "event": "wrote", "path": path.display().to_string() }));
        }
        self.write(&json!({
            "event": "end",
            "succeeded": outcome.is_some_and(Outcome::succeeded),
            "cancelled": outcome.is_some_and(|o| o.cancelled),
            "steps": outcome.map_or(0, |o| o.steps.len()),
            "expectations": outcome.map_or(0, |o| o.checked),
            "digest": outcome.map(|o| o.digest.to_string()),
            "milliseconds": milliseconds(self.begin.elapsed()),
        }));
        lock(&self.state).problem.take().map_or(Ok(()), Err)
    }

    /// Writes an event for each problem.
    fn problems(&self, diagnostics: &[recipe::Diagnostic]) {
        for problem in problems(diagnostics, &self.loaded.recipe.sources) {
            self.write(&ProblemEvent {
                event: "problem",
                problem,
            });
        }
    }

    fn write(&self, event: &impl Serialize) {
        let mut out = io::stdout().lock();
        let written = serde_json::to_string(event).map_err(io::Error::from);
        let written = written.and_then(|line| out.write_all((line + "\n").as_bytes()));
        if let Err(error) = written.and_then(|()| out.flush()) {
            lock(&self.state).problem.get_or_insert(error);
        }
    }
}

impl Progress for Events<'_> {
    fn advance(&self, what: &str, done: u64, total: u64) -> bool {
        let mut state = lock(&self.state);
        let (number, is_writable) = (state.number, state.problem.is_none());
        let is_due = state.last_progress.elapsed() >= MIN_INTERVAL;
        if is_due {
            state.last_progress = Instant::now();
        }
        drop(state);
        if is_due {
            self.write(&json!({
                "event": "progress", "number": number, "what": what, "done": done, "total": total,
            }));
        }
        is_writable && self.progress.advance(what, done, total)
    }
}

impl Listener for Events<'_> {
    fn step_begins(&self, number: usize, label: &str) {
        lock(&self.state).number = number + 1;
        let operation = &self.loaded.recipe.steps[number].name;
        self.write(&json!({
            "event": "step", "number": number + 1, "label": label, "operation": operation,
        }));
    }

    fn wants_digests(&self) -> bool {
        true
    }

    fn step_done(&self, number: usize, done: &StepDone) {
        self.write(&step_done(number, done));
    }
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
