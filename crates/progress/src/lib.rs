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
