//! Progress bars on a terminal, and handling of Ctrl-C.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use engine::Cancel;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use op::Progress;
use recipe::{Listener, StepDone};

/// The flag that Ctrl-C sets. Every loop that can run for a long time checks this flag. The flag is also the progress
/// listener of runs whose progress is not shown, such as the runs of a batch.
pub(crate) static INTERRUPT: Cancel = Cancel::new();

/// Installs the handler of Ctrl-C: the first Ctrl-C cancels the run cleanly, and the second Ctrl-C ends the program
/// immediately.
pub(crate) fn catch_interrupts() {
    // The error is ignored, because Ctrl-C ends the program even without the handler.
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

/// Locks a mutex, even if another thread has panicked while it held the lock. A panic cannot leave the protected values
/// half-changed.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Shows the progress of the current step. If standard error is not a terminal, shows nothing.
pub(crate) struct Terminal<'a> {
    bar: ProgressBar,
    /// The number and the label of the current step, if a recipe is run.
    step: Mutex<String>,
    go_on: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> Terminal<'a> {
    /// Creates a listener for work that Ctrl-C cancels.
    pub(crate) fn new() -> Self {
        Self::until(&|| true)
    }

    /// Creates a listener for work that Ctrl-C cancels. The work is also canceled as soon as `go_on` returns false.
    pub(crate) fn until(go_on: &'a (dyn Fn() -> bool + Sync)) -> Self {
        // The bar is drawn on standard error, and only if standard error is a terminal that can move its cursor.
        let bar = ProgressBar::new(0);
        if std::env::var_os("TERM").is_some_and(|term| term == "dumb") {
            bar.set_draw_target(ProgressDrawTarget::hidden());
        }
        if let Ok(style) =
            ProgressStyle::with_template("{spinner} {msg} {wide_bar} {percent}%, {eta} left")
        {
            bar.set_style(style);
        }
        // Periodic redrawing starts a thread, which can fail when memory is low. Therefore a hidden bar starts no
        // thread.
        if !bar.is_hidden() {
            bar.enable_steady_tick(Duration::from_millis(120));
        }
        Self {
            bar,
            step: Mutex::default(),
            go_on,
        }
    }

    /// Removes the progress bar from the screen.
    pub(crate) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

impl Progress for Terminal<'_> {
    fn advance(&self, what: &str, done: u64, total: u64) -> bool {
        if !self.bar.is_hidden() {
            let step = lock(&self.step);
            // The bar gets the step and its task as a single message. Two separate messages could show a step with the
            // task of another step.
            let message = match step.as_str() {
                "" => what.to_owned(),
                step => format!("{step}: {what}"),
            };
            // If the message is new, a new task has begun. The bar is then reset, so that it estimates the remaining
            // time of the new task.
            if self.bar.message() != message {
                self.bar.set_message(message);
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
        let mut step = lock(&self.step);
        *step = format!("{} {label}", number + 1);
        self.bar.set_message(step.clone());
        self.bar.set_position(0);
    }

    fn step_done(&self, _: usize, _: &StepDone) {}
}

#[cfg(test)]
mod tests {
    use std::io;

    use indicatif::TermLike;

    use super::*;

    /// A terminal that stores every line that the progress bar draws.
    #[derive(Debug, Default)]
    struct Lines(std::sync::Arc<Mutex<Vec<String>>>);

    impl TermLike for Lines {
        fn width(&self) -> u16 {
            80
        }
        fn move_cursor_up(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_down(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_right(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_left(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn write_line(&self, line: &str) -> io::Result<()> {
            self.write_str(line)
        }
        fn write_str(&self, line: &str) -> io::Result<()> {
            lock(&self.0).push(line.to_owned());
            Ok(())
        }
        fn clear_line(&self) -> io::Result<()> {
            Ok(())
        }
        fn flush(&self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_step_is_never_shown_with_the_task_of_another_step() {
        let lines = Lines::default();
        let drawn = lines.0.clone();
        let terminal = Terminal::new();
        let target = ProgressDrawTarget::term_like_with_hz(Box::new(lines), 255);
        terminal.bar.set_draw_target(target);
        for (number, label) in ["Loop", "Save"].into_iter().enumerate() {
            terminal.step_begins(number, label);
            assert_eq!(terminal.bar.message(), format!("{} {label}", number + 1));
            for done in 0..3 {
                assert!(terminal.advance(&label.to_lowercase(), done, 3));
                terminal.bar.tick();
            }
        }
        let drawn = lock(&drawn);
        assert!(
            drawn.iter().any(|line| line.contains("2 Save: save")),
            "{drawn:?}"
        );
        for line in drawn.iter() {
            assert!(
                !(line.contains("1 Loop") && line.contains("save")),
                "{line}"
            );
            assert!(
                !(line.contains("2 Save") && line.contains("loop")),
                "{line}"
            );
        }
    }
}
