//! Progress and cancellation of work that several threads share.

use std::sync::{Mutex, PoisonError};

use progress::Progress;
use rayon::prelude::*;

use crate::PictureError;

/// Computes `f(i)` for each `i` below `n`, in parallel.
pub(crate) fn map_indices<T: Send>(n: usize, f: impl Fn(usize) -> T + Send + Sync) -> Vec<T> {
    let indices = (0..n).into_par_iter().with_min_len(4096);
    indices.map(f).collect()
}

/// Counts the progress of work that several threads share, and cancels the work on request. Only one thread at a time
/// calls the listener.
pub(crate) struct Work<'a> {
    progress: &'a dyn Progress,
    stage: &'static str,
    total: u64,
    /// The amount of work done. `None` after the work is canceled.
    done: Mutex<Option<u64>>,
}

impl<'a> Work<'a> {
    /// Creates work of `total` units. The caller chooses the unit.
    pub(crate) fn new(progress: &'a dyn Progress, stage: &'static str, total: u64) -> Self {
        Self {
            progress,
            stage,
            total: total.max(1),
            done: Mutex::new(Some(0)),
        }
    }

    /// Adds to the amount of work done.
    ///
    /// # Errors
    ///
    /// Returns [`PictureError::Cancelled`] if the listener cancels the work, or has canceled the work before.
    pub(crate) fn add(&self, amount: u64) -> Result<(), PictureError> {
        let mut done = self.done.lock().unwrap_or_else(PoisonError::into_inner);
        let sum = done.map(|done| done.saturating_add(amount).min(self.total));
        *done = sum.filter(|&sum| self.progress.advance(self.stage, sum, self.total));
        done.map(drop).ok_or(PictureError::Cancelled)
    }
}

/// A progress listener made from a function. The function receives the fraction of the work done, from 0 to 1, and
/// returns false to cancel the work.
#[cfg(test)]
pub(crate) struct Listener<F>(pub(crate) F);

#[cfg(test)]
impl<F: Fn(f64) -> bool + Sync> Progress for Listener<F> {
    fn advance(&self, _: &str, done: u64, total: u64) -> bool {
        (self.0)(done as f64 / total as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_at_most_its_total_and_stays_cancelled() {
        let reported = Mutex::new(Vec::new());
        let until_seventy_percent = Listener(|fraction: f64| {
            reported.lock().unwrap().push(fraction);
            fraction < 0.7
        });
        let work = Work::new(&until_seventy_percent, "draw", 10);
        let continued: Vec<bool> = (0..4).map(|_| work.add(3).is_ok()).collect();
        assert_eq!(continued, [true, true, false, false]);
        assert_eq!(*reported.lock().unwrap(), [0.3, 0.6, 0.9]);
        // The reported fraction is at most 1 even if more work than the total is done, or if the total is 0.
        let at_most_one = Listener(|fraction| fraction <= 1.0);
        assert!(Work::new(&at_most_one, "draw", 2).add(9).is_ok());
        assert!(Work::new(&at_most_one, "draw", 0).add(0).is_ok());
    }
}
