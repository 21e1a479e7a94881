//! Runs the recipe in a separate thread. When a new run is requested, the current run is canceled. If the result of a
//! step is known, the step does not run again.
//!
//! ```text
//! request --> waiting (only the newest) --> thread: read, check, reuse snapshots, run the rest --> events --> Editor::poll
//! ```

mod job;
mod snapshot;
mod state;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use engine::{Engine, Source, stamp_line};
use op::Registry;
use store::Store;

use job::Job;
use snapshot::Snapshots;

pub use snapshot::Snapshot;
pub use state::{ExpectationState, FailureState, RunState, Status, StepState, Verdict};

pub(crate) use state::Event;

/// A request to run a recipe.
#[derive(Clone, Debug)]
pub(crate) struct Request {
    /// The number of the request. A later request has a higher number.
    pub(crate) number: u64,
    pub(crate) source: Source,
    /// The folder for outputs.
    pub(crate) out: PathBuf,
    /// If true, the run keeps the output files that it writes. If false, the run discards them.
    pub(crate) keep_outputs: bool,
    /// The memory budget for meshes, in bytes.
    pub(crate) budget: u64,
    /// The maximum memory, in bytes, for the scenes that are kept after steps have run.
    pub(crate) memory: u64,
}

/// A function that is called when there are new events to poll.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// A handle of the thread. When the handle is dropped, the run is canceled and the thread ends.
pub(crate) struct Runner {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Default)]
struct Shared {
    state: Mutex<Waiting>,
    wake: Condvar,
}

#[derive(Default)]
struct Waiting {
    request: Option<Request>,
    /// Cancels the current run.
    cancel: Arc<AtomicBool>,
    events: Vec<Event>,
    progress: Option<(u64, Progress)>,
    ends: bool,
    on_event: Option<Wake>,
    /// The files whose changes are reported. Each file has its last known stamp: a text that describes the state of the
    /// file.
    watched: Vec<(PathBuf, String)>,
}

/// After this time, the watched files are checked for changes again.
const LOOK: Duration = Duration::from_millis(250);

/// The progress of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// The label of the current step.
    pub step: String,
    /// The current computation.
    pub task: String,
    /// How many parts of the computation are done.
    pub done: u64,
    /// How many parts the computation has.
    pub total: u64,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Waiting> {
        // If a thread panics while it holds the lock, the state is still valid.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn send(&self, event: Event) {
        let wake = {
            let mut state = self.lock();
            state.events.push(event);
            state.on_event.clone()
        };
        self.wake.notify_all();
        if let Some(wake) = wake {
            wake();
        }
    }

    fn set_progress(&self, number: u64, progress: Progress) {
        self.lock().progress = Some((number, progress));
    }
}

impl Runner {
    pub(crate) fn new(registry: Arc<Registry>, store: Arc<dyn Store>) -> Self {
        let shared = Arc::new(Shared::default());
        let of_thread = shared.clone();
        let thread = std::thread::Builder::new()
            .name("meshwright engine".to_owned())
            .spawn(move || serve(&of_thread, &registry, &store))
            .ok();
        Self { shared, thread }
    }

    /// Requests a run: replaces the request that is waiting, if any, and cancels the current run.
    pub(crate) fn request(&self, request: Request) {
        let mut state = self.shared.lock();
        state.cancel.store(true, Ordering::Relaxed);
        state.request = Some(request);
        drop(state);
        self.shared.wake.notify_all();
    }

    /// Cancels the current run and the waiting request. Returns whether a request was waiting.
    pub(crate) fn cancel(&self) -> bool {
        let mut state = self.shared.lock();
        state.cancel.store(true, Ordering::Relaxed);
        state.request.take().is_some()
    }

    /// Returns the events that have not been returned before.
    pub(crate) fn events(&self) -> Vec<Event> {
        std::mem::take(&mut self.shared.lock().events)
    }

    /// Waits until there are events, or until the given time has passed.
    pub(crate) fn wait(&self, time: Duration) {
        let state = self.shared.lock();
        if state.events.is_empty() {
            drop(self.shared.wake.wait_timeout(state, time));
        }
    }

    pub(crate) fn progress(&self, number: u64) -> Option<Progress> {
        let state = self.shared.lock();
        let (of, progress) = state.progress.as_ref()?;
        (*of == number).then(|| progress.clone())
    }

    /// Sets the files whose changes are reported. Each file has the stamp that the editor has seen last.
    pub(crate) fn watch(&self, files: Vec<(PathBuf, String)>) {
        self.shared.lock().watched = files;
    }

    pub(crate) fn on_event(&self, wake: Wake) {
        self.shared.lock().on_event = Some(wake);
    }
}

impl Drop for Runner {
    fn drop(&mut self) {
        {
            let mut state = self.shared.lock();
            state.ends = true;
            state.cancel.store(true, Ordering::Relaxed);
        }
        self.shared.wake.notify_all();
        if let Some(thread) = self.thread.take() {
            // The thread catches panics of operations, so it ends only when `ends` is set.
            let _ = thread.join();
        }
    }
}

/// Runs requests until the handle is dropped.
fn serve(shared: &Shared, registry: &Registry, store: &Arc<dyn Store>) {
    let engine = Engine::new(registry).with_store(store.clone());
    let mut snapshots = Snapshots::default();
    loop {
        let Some((request, cancel)) = next_request(shared, &**store) else {
            return;
        };
        let number = request.number;
        let job = Job {
            engine: &engine,
            store: &**store,
            shared,
            cancel: &cancel,
            request: &request,
        };
        // The snapshots are valid even after a panic, because each snapshot is added as a whole or not at all.
        if catch_unwind(AssertUnwindSafe(|| job.run(&mut snapshots))).is_err() {
            shared.send(Event::Panicked { number });
        }
    }
}

/// Waits for a request, and watches the files while it waits. Returns `None` if the thread must end.
fn next_request(shared: &Shared, store: &dyn Store) -> Option<(Request, Arc<AtomicBool>)> {
    let mut state = shared.lock();
    loop {
        if state.ends {
            return None;
        }
        if let Some(request) = state.request.take() {
            let cancel = Arc::new(AtomicBool::new(false));
            state.cancel = cancel.clone();
            return Some((request, cancel));
        }
        let mut files = state.watched.clone();
        drop(state);
        let mut is_changed = false;
        for (path, seen) in &mut files {
            let now = stamp_line(path, store.entry(path));
            is_changed |= *seen != now;
            *seen = now;
        }
        if is_changed {
            // The new states of the files are stored, so that each change is reported only once.
            let mut state = shared.lock();
            let old = state.watched.iter().map(|(path, _)| path);
            if old.eq(files.iter().map(|(path, _)| path)) {
                state.watched = files;
            }
            drop(state);
            shared.send(Event::FilesChanged);
        }
        state = shared.lock();
        if state.request.is_none() && !state.ends {
            let waited = shared.wake.wait_timeout(state, LOOK);
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}
