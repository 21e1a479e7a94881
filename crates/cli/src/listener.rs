//! Progress on a terminal, and Ctrl-C.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use engine::Cancel;
use indicatif::{ProgressBar, ProgressStyle};
use op::Progress;
use recipe::{Listener, StepDone};

/// Set by Ctrl-C; every long loop asks for it. As a listener it shows nothing: for many runs at once.
pub(crate) static QUIET: Cancel = Cancel::new();

/// Lets Ctrl-C end the run in an orderly way. The second one ends the program at once.
pub(crate) fn catch_interrupts() {
    // Without a handler Ctrl-C ends the program, which is fine too.
    let _ = ctrlc::set_handler(|| {
        if QUIET.set() {
            std::process::exit(1);
        }
    });
}

/// Whether Ctrl-C was pressed.
pub(crate) fn is_interrupted() -> bool {
    QUIET.is_set()
}

/// Locks what no panic can leave half-changed.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Shows the step at work on a terminal, and nothing in a pipe.
pub(crate) struct Terminal<'a> {
    bar: ProgressBar,
    go_on: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> Terminal<'a> {
    /// For work that Ctrl-C ends.
    pub(crate) fn new() -> Self {
        Self::until(&|| true)
    }

    /// For work that also ends when `go_on` does not hold.
    pub(crate) fn until(go_on: &'a (dyn Fn() -> bool + Sync)) -> Self {
        // Draws on the standard error, and only if that is a terminal.
        let bar = ProgressBar::new(0);
        if let Ok(style) =
            ProgressStyle::with_template("{spinner} {prefix}: {msg} {wide_bar} {percent}%")
        {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(120));
        Self { bar, go_on }
    }

    /// Takes the bar off the screen.
    pub(crate) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

impl Progress for Terminal<'_> {
    fn advance(&self, what: &str, done: u64, total: u64) -> bool {
        if !self.bar.is_hidden() {
            self.bar.set_message(what.to_owned());
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
