//! Runs work on another thread. While the work runs, the calling thread lets other Python threads run, calls the
//! progress callback, and checks for Ctrl-C. Python reports Ctrl-C only on the main thread.

use std::panic::resume_unwind;
use std::process;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use engine::Listener;
use op::Progress;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// The time between two checks for signals. The progress callback is called at the same interval.
const INTERVAL: Duration = Duration::from_millis(40);

/// The id of the process that started the worker threads, or 0 if no threads were started. If this process is forked,
/// the new process does not have these threads.
static PROCESS: AtomicU32 = AtomicU32::new(0);

/// Receives progress reports on the worker threads and keeps them for the calling thread.
#[derive(Default)]
pub(crate) struct Monitor {
    is_cancelled: AtomicBool,
    step: Mutex<String>,
    latest: Mutex<Option<(String, u64, u64)>>,
}

impl Progress for Monitor {
    fn advance(&self, task: &str, done: u64, total: u64) -> bool {
        // If the calling thread is reading the latest report at this moment, the new report is dropped, so that the
        // worker does not wait.
        if let Ok(mut latest) = self.latest.try_lock() {
            *latest = Some((task.to_owned(), done, total));
        }
        !self.is_cancelled.load(Ordering::Relaxed)
    }
}

impl Listener for Monitor {
    fn step_begins(&self, _: usize, label: &str) {
        label.clone_into(&mut self.step.lock().unwrap_or_else(PoisonError::into_inner));
    }
}

/// Runs `work`. `callback(step, task, done, total)` is called at intervals on the calling thread. If the callback
/// raises an exception, the work is canceled.
///
/// # Errors
///
/// Raises the exception that Ctrl-C or the callback raised. Raises `MemoryError` if the system has no memory for a
/// large array. Raises `RuntimeError` in a forked process if its parent process has already run work.
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    callback: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Monitor) -> T + Send,
) -> PyResult<T> {
    let earlier = PROCESS.swap(process::id(), Ordering::Relaxed);
    if earlier != 0 && earlier != process::id() {
        PROCESS.store(earlier, Ordering::Relaxed);
        return Err(PyRuntimeError::new_err(
            "meshwright was used before this process was forked, and its threads do not exist here; \
             start processes with multiprocessing.get_context(\"spawn\")",
        ));
    }
    let monitor = Monitor::default();
    let is_done = AtomicBool::new(false);
    let end = End(&is_done, thread::current());
    let (result, interrupt) = thread::scope(|scope| {
        let worker = scope.spawn(|| {
            let _end = end;
            work(&monitor)
        });
        let mut interrupt = None;
        while !is_done.load(Ordering::Acquire) {
            py.detach(|| thread::park_timeout(INTERVAL));
            if interrupt.is_none()
                && let Err(error) = py.check_signals().and_then(|()| show(&monitor, callback))
            {
                monitor.is_cancelled.store(true, Ordering::Relaxed);
                interrupt = Some(error);
            }
        }
        (py.detach(|| worker.join()), interrupt)
    });
    match (result, interrupt) {
        (_, Some(error)) => Err(error),
        (Ok(result), None) => Ok(result),
        (Err(panic), None) => match panic.downcast::<mesh::OutOfMemory>() {
            Ok(missing) => Err(pyo3::exceptions::PyMemoryError::new_err(
                missing.to_string(),
            )),
            Err(panic) => resume_unwind(panic),
        },
    }
}

/// When this value is dropped, it tells the calling thread that the work has ended. A panic also drops the value, so
/// the calling thread does not wait forever.
struct End<'a>(&'a AtomicBool, thread::Thread);

impl Drop for End<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Release);
        self.1.unpark();
    }
}

/// Passes the latest progress report to the callback.
fn show(monitor: &Monitor, callback: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
    let Some(callback) = callback else {
        return Ok(());
    };
    let latest = || {
        monitor
            .latest
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    };
    let Some((task, done, total)) = latest().take() else {
        return Ok(());
    };
    let step = monitor.step.lock().unwrap_or_else(PoisonError::into_inner);
    let step = step.clone();
    callback.call1((step, task, done, total))?;
    Ok(())
}
