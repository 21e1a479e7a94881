//! Progress bars on a terminal, and handling of Ctrl-C.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use engine::Cancel;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use op::Progress;
use recipe::{Listener, StepDone};

/// Set by Ctrl-C. Every long loop checks whether `INTERRUPT` is set. Also serves as a listener that shows nothing, for
/// simultaneous runs.
pub(crate) static INTERRUPT: Cancel = Cancel::new();

/// Makes the first Ctrl-C cancel the run cleanly and the second end the program immediately.
pub(crate) fn catch_interrupts() {
    // If installing the handler fails, Ctrl-C still ends the program.
    let _ = ctrlc::set_handler(|| {
        if INTERRUPT.set() {
            std::process::exit(130);
        }
    });
}

/// Whether Ctrl-C was pressed.
pub(crate) fn is_interrupted() -> bool {
    INTERRUPT.is_set()
}

/// Locks a mutex and ignores poisoning, because a panic cannot leave the protected values half-changed.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Shows the progress of the current step if standard error is a terminal, otherwise nothing.
pub(crate) struct Terminal<'a> {
    bar: ProgressBar,
    go_on: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> Terminal<'a> {
    /// Creates a listener for work that Ctrl-C cancels.
    pub(crate) fn new() -> Self {
        Self::until(&|| true)
    }

    /// Creates a listener for work that ends on Ctrl-C or as soon as `go_on` returns false.
    pub(crate) fn until(go_on: &'a (dyn Fn() -> bool + Sync)) -> Self {
        // The bar is drawn on standard error, and only if standard error is a terminal that can move its cursor.
        let bar = ProgressBar::new(0);
        if std::env::var_os("TERM").is_some_and(|term| term == "dumb") {
            bar.set_draw_target(ProgressDrawTarget::hidden());
        }
        if let Ok(style) = ProgressStyle::with_template(
            "{spinner} {prefix}: {msg} {wide_bar} {percent}%, {eta} left",
        ) {
            bar.set_style(style);
        }
        // Periodic redrawing starts a thread. Starting it can fail when memory is low.
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_millis(120));
        }
        Self { bar, go_on }
    }

    /// Removes the progress bar from the screen.
    pub(crate) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

impl Progress for Terminal<'_> {
    fn advance(&self, what: &str, done: u64, total: u64) -> bool {
        if !self.bar.is_hidden() {
            // Each phase has its own estimate of the remaining time.
            if self.bar.message() != what {
                self.bar.set_message(what.to_owned());
                self.bar.reset();
            }
            self.bar.set_length(total.max(1));
            self.bar.set_position(done);
        }
        !is_interrupted() && (self.go_on)()
    }
}

impl Listener for Terminal<'_> {
    fn step_begins(&self, number: usize, label: &str) {
        self.bar.set_prefix(format!("{} {label}", number + 1));
        self.bar.set_message(String::new());
        self.bar.set_position(0);
    }

    fn step_done(&self, _: usize, _: &StepDone) {}
}
