//! How long computations report progress and are cancelled.
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

/// Listens to a computation and can cancel it.
pub trait Progress: Sync {
    /// Called when `done` of `total` parts of a computation are done; `what` names it in a few words.
    /// Returns whether to go on.
    fn advance(&self, what: &str, done: u64, total: u64) -> bool;

    /// The same for `?`.
    ///
    /// # Errors
    ///
    /// [`Cancelled`] if the computation is to stop.
    fn report(&self, what: &str, done: u64, total: u64) -> Result<(), Cancelled> {
        if self.advance(what, done, total) {
            Ok(())
        } else {
            Err(Cancelled)
        }
    }
}

/// Adds up the work of all threads on one computation and reports it.
pub struct Meter<'a> {
    listener: &'a dyn Progress,
    what: &'static str,
    done: AtomicU64,
    total: u64,
    /// A report follows when the parts that are done pass a multiple of this.
    interval: u64,
}

impl<'a> Meter<'a> {
    /// A computation of `total` parts, named by `what`, with none done yet. Every addition is reported.
    pub fn new(listener: &'a dyn Progress, what: &'static str, total: u64) -> Self {
        Self {
            listener,
            what,
            done: AtomicU64::new(0),
            total,
            interval: 1,
        }
    }

    /// Reports once for every `interval` parts only, for additions of a few.
    #[must_use]
    pub fn every(self, interval: u64) -> Self {
        Self { interval, ..self }
    }

    /// Counts `n` more parts as done. Adding 0 only asks whether to go on.
    ///
    /// # Errors
    ///
    /// [`Cancelled`] if the computation is to stop.
    pub fn add(&self, n: usize) -> Result<(), Cancelled> {
        let before = self.done.fetch_add(n as u64, Relaxed);
        let done = before + n as u64;
        if n > 0 && before / self.interval == done / self.interval {
            return Ok(());
        }
        self.listener
            .report(self.what, done.min(self.total), self.total)
    }

    /// Reports that all parts are done.
    ///
    /// # Errors
    ///
    /// [`Cancelled`] if the computation is to stop.
    pub fn finish(&self) -> Result<(), Cancelled> {
        self.done.store(self.total, Relaxed);
        self.add(0)
    }
}

/// Ignores progress and never cancels.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoProgress;

impl Progress for NoProgress {
    fn advance(&self, _: &str, _: u64, _: u64) -> bool {
        true
    }
}

/// The computation was cancelled.
#[derive(Clone, Copy, Debug, Eq, PartialEq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;
