//! Progress reports and cancellation of long computations.
//!
//! ```
//! use progress::{Cancelled, NoProgress, Progress};
//!
//! fn sum(numbers: &[f64], progress: &dyn Progress) -> Result<f64, Cancelled> {
//!     let mut sum = 0.0;
//!     let total = numbers.len() as u64;
//!     for (done, part) in (0..).step_by(4096).zip(numbers.chunks(4096)) {
//!         progress.report("sum", done, total)?;
//!         sum += part.iter().sum::<f64>();
//!     }
//!     Ok(sum)
//! }
//!
//! assert_eq!(sum(&[1.0, 2.0], &NoProgress), Ok(3.0));
//! ```

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// A listener that receives progress reports of a computation and can cancel it.
pub trait Progress: Sync {
    /// Called when `done` of the `total` parts of a computation are finished. `task` describes the computation in a
    /// few words. Returns whether to continue the computation.
    fn advance(&self, task: &str, done: u64, total: u64) -> bool;

    /// Calls [`advance`](Self::advance) and returns a `Result`, for use with `?`.
    ///
    /// # Errors
    ///
    /// Returns [`Cancelled`] if the listener cancels the computation.
    fn report(&self, task: &str, done: u64, total: u64) -> Result<(), Cancelled> {
        if self.advance(task, done, total) {
            Ok(())
        } else {
            Err(Cancelled)
        }
    }
}

/// Counts the finished parts of a computation, and reports this count to a listener. The computation can run on several
/// threads.
pub struct Meter<'a> {
    listener: &'a dyn Progress,
    task: &'static str,
    done: AtomicU64,
    total: u64,
    /// Progress is reported whenever the number of finished parts reaches or passes a multiple of this interval.
    interval: u64,
}

impl<'a> Meter<'a> {
    /// Creates a meter for the computation `task`, which consists of `total` parts. Every call of [`add`](Self::add) is
    /// reported, unless [`every`](Self::every) sets an interval.
    pub fn new(listener: &'a dyn Progress, task: &'static str, total: u64) -> Self {
        Self {
            listener,
            task,
            done: AtomicU64::new(0),
            total,
            interval: 1,
        }
    }

    /// Sets the number of finished parts between two reports. An interval is useful if each call of `add` adds only a
    /// few parts.
    #[must_use]
    pub fn every(self, interval: u64) -> Self {
        Self { interval, ..self }
    }

    /// Adds `n` to the number of finished parts. If `n` is 0, the call always sends a report and therefore checks for
    /// cancellation.
    ///
    /// # Errors
    ///
    /// Returns [`Cancelled`] if the listener cancels the computation.
    pub fn add(&self, n: usize) -> Result<(), Cancelled> {
        let before = self.done.fetch_add(n as u64, Relaxed);
        let done = before + n as u64;
        if n > 0 && before / self.interval == done / self.interval {
            return Ok(());
        }
        self.listener
            .report(self.task, done.min(self.total), self.total)
    }

    /// Reports that all parts are done.
    ///
    /// # Errors
    ///
    /// Returns [`Cancelled`] if the listener cancels the computation.
    pub fn finish(&self) -> Result<(), Cancelled> {
        self.done.store(self.total, Relaxed);
        self.add(0)
    }
}

/// A listener that ignores all progress reports and never cancels a computation.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoProgress;

impl Progress for NoProgress {
    fn advance(&self, _: &str, _: u64, _: u64) -> bool {
        true
    }
}

/// The computation was canceled.
#[derive(Clone, Copy, Debug, Eq, PartialEq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;
