//! A run as events for other programs: one JSON object a line, as things happen.
//!
//! ```text
//! {"event":"start", "format":1, "program":"meshwright 0.1.0", "recipe":"a.ron", "recipe_digest":"..",
//!                   "parameters":[{"name":"levels", "value":"2", "from":"--set"}], "steps":7}
//! {"event":"step", "number":1, "label":"smooth", "operation":"LoopSubdivide"}
//! {"event":"progress", "number":1, "what":"..", "done":3, "total":8}      at most ten times a second
//! {"event":"done", "number":1, "label":"smooth", "vertices":8, "edges":12, "faces":6, "changed":6,
//!                  "refused":[{"reason":"Boundary", "count":2, "first":".."}],
//!                  "losses":[{"object":"cow", "name":"uv", "message":".."}], "notes":[".."],
//!                  "digest":"..", "milliseconds":1.5, "cached":false, "ran_because":"parameters changed: levels 1 -> 2"}
//! {"event":"problem", "severity":"error", "file":"a.ron", "line":7, "column":9, "message":"..", "help":".."}
//! {"event":"picture", "path":"a-error-1.png"}                             of a problem, with --picture-errors
//! {"event":"wrote", "path":"out/a.obj"}
//! {"event":"end", "succeeded":true, "cancelled":false, "steps":7, "expectations":4, "digest":"..",
//!                 "milliseconds":20.5}
//! ```
//!
//! `format` is the version of this list: new events and new fields may come without another number, and
//! readers pass over what they do not know. Numbers of steps begin at 1. `end` is always the last line,
//! also of a recipe with mistakes. What is unknown is `null`.

use std::io::{self, Write as _};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use op::Progress;
use recipe::{Listener, Outcome, StepDone};
use serde::Serialize;
use serde_json::{Value as Json, json};

use crate::listener::lock;
use crate::output::{ProblemJson, STAMP, origin, problems_json};
use crate::picture_errors::Pictures;
use engine::Loaded;

/// The version of the events.
const FORMAT: u32 = 1;

/// The least time between two events of progress.
const PAUSE: Duration = Duration::from_millis(100);

/// Writes the events of one run. Stops the run when nobody reads them any more.
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
    problem: ProblemJson,
}

struct State {
    /// The step that runs, from 1.
    number: usize,
    /// When progress was told last.
    told: Instant,
    problem: Option<io::Error>,
}

impl<'a> Events<'a> {
    /// Writes the start of a run, and what is wrong with the recipe. `progress` says whether to go on.
    pub(crate) fn start(loaded: &'a Loaded, progress: &'a dyn Progress) -> Self {
        let now = Instant::now();
        let events = Self {
            loaded,
            progress,
            begin: now,
            state: Mutex::new(State {
                number: 0,
                told: now,
                problem: None,
            }),
        };
        let parameters: Vec<Json> = (loaded.recipe.parameters().iter())
            .map(|p| json!({ "name": p.name, "value": p.value.to_string(), "from": origin(&p.origin) }))
            .collect();
        events.tell(&json!({
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

    /// Writes what went wrong, what was written, and the end; without an outcome, that of a recipe that cannot run.
    ///
    /// # Errors
    ///
    /// The first line that could not be written.
    pub(crate) fn end(self, outcome: Option<&Outcome>, pictures: &Pictures) -> io::Result<()> {
        self.problems(outcome.map_or(&[], |o| &o.failures));
        pictures.warn();
        for path in pictures.paths() {
            self.tell(&json!({ "event": "picture", "path": path.display().to_string() }));
        }
        for path in outcome.map_or(&[][..], |o| &o.written) {
            self.tell(&json!({ "event": "wrote", "path": path.display().to_string() }));
        }
        self.tell(&json!({
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

    /// Writes problems, each as an event.
    fn problems(&self, diagnostics: &[recipe::Diagnostic]) {
        for problem in problems_json(diagnostics, &self.loaded.recipe.sources) {
            self.tell(&ProblemEvent {
                event: "problem",
                problem,
            });
        }
    }

    fn tell(&self, event: &impl Serialize) {
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
        let (number, is_read) = (state.number, state.problem.is_none());
        let is_due = state.told.elapsed() >= PAUSE;
        if is_due {
            state.told = Instant::now();
        }
        drop(state);
        if is_due {
            self.tell(&json!({
                "event": "progress", "number": number, "what": what, "done": done, "total": total,
            }));
        }
        is_read && self.progress.advance(what, done, total)
    }
}

impl Listener for Events<'_> {
    fn step_begins(&self, number: usize, label: &str) {
        lock(&self.state).number = number + 1;
        let operation = &self.loaded.recipe.steps[number].name;
        self.tell(&json!({
            "event": "step", "number": number + 1, "label": label, "operation": operation,
        }));
    }

    fn wants_digests(&self) -> bool {
        true
    }

    fn step_done(&self, number: usize, done: &StepDone) {
        let losses = (done.report.losses.iter())
            .map(|l| json!({ "object": l.object, "name": l.name, "message": l.to_string() }));
        self.tell(&json!({
            "event": "done",
            "number": number + 1,
            "label": done.label,
            "vertices": done.vertices,
            "edges": done.edges,
            "faces": done.faces,
            "changed": done.report.changed,
            "refused": done.report.refused,
            "losses": losses.collect::<Vec<_>>(),
            "notes": done.report.notes,
            "digest": done.digest.map(|digest| digest.to_string()),
            "milliseconds": milliseconds(done.time),
            "cached": done.ran.is_none(),
            "ran_because": done.ran.as_ref().map(ToString::to_string),
        }));
    }
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
