//! How far a picture is, when several threads draw it.

use std::sync::{Mutex, PoisonError};

use progress::Progress;
use rayon::prelude::*;

use crate::PictureError;

/// What `of` says of each number below `n`, in parallel.
pub(crate) fn each<T: Send>(n: usize, of: impl Fn(usize) -> T + Send + Sync) -> Vec<T> {
    let numbers = (0..n).into_par_iter().with_min_len(4096);
    numbers.map(of).collect()
}

/// Work of several threads that can be cancelled. The listener is called by one of them at a time.
pub(crate) struct Work<'a> {
    progress: &'a dyn Progress,
    what: &'static str,
    total: u64,
    /// `None` once it is cancelled.
    done: Mutex<Option<u64>>,
}

impl<'a> Work<'a> {
    /// Work of this amount, in units of its own.
    pub(crate) fn new(progress: &'a dyn Progress, what: &'static str, total: u64) -> Self {
        Self {
            progress,
            what,
            total: total.max(1),
            done: Mutex::new(Some(0)),
        }
    }

    /// Adds to what is done.
    ///
    /// # Errors
    ///
    /// [`PictureError::Cancelled`] if the listener cancels; ever after, once it has.
    pub(crate) fn add(&self, amount: u64) -> Result<(), PictureError> {
        let mut done = self.done.lock().unwrap_or_else(PoisonError::into_inner);
        let sum = done.map(|done| done.saturating_add(amount).min(self.total));
        *done = sum.filter(|&sum| self.progress.advance(self.what, sum, self.total));
        done.map(drop).ok_or(PictureError::Cancelled)
    }
}

/// A listener that hears how much is done, from 0 to 1, and says whether to go on.
#[cfg(test)]
pub(crate) struct While<F>(pub(crate) F);

#[cfg(test)]
impl<F: Fn(f64) -> bool + Sync> Progress for While<F> {
    fn advance(&self, _: &str, done: u64, total: u64) -> bool {
        (self.0)(done as f64 / total as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_rises_to_its_end_and_stays_cancelled() {
        let heard = Mutex::new(Vec::new());
        let go_on = While(|part: f64| {
            heard.lock().unwrap().push(part);
            part < 0.7
        });
        let work = Work::new(&go_on, "draw", 10);
        let went_on: Vec<bool> = (0..4).map(|_| work.add(3).is_ok()).collect();
        assert_eq!(went_on, [true, true, false, false]);
        assert_eq!(*heard.lock().unwrap(), [0.3, 0.6, 0.9]);
        // More than was expected, and nothing at all.
        let always = While(|part| part <= 1.0);
        assert!(Work::new(&always, "draw", 2).add(9).is_ok());
        assert!(Work::new(&always, "draw", 0).add(0).is_ok());
    }
}
