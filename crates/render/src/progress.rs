//! How far a picture is, and whether to go on.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::PictureError;

/// Is told how much of a picture is done, from 0 to 1, and says whether to go on: from any thread, one call at a time,
/// often, and so in little time.
pub type GoOn<'a> = &'a (dyn Fn(f64) -> bool + Sync);

/// Work of several threads that can be stopped.
pub(crate) struct Work<'a> {
    go_on: GoOn<'a>,
    total: u64,
    done: Mutex<u64>,
    is_stopped: AtomicBool,
}

impl<'a> Work<'a> {
    /// Work of this amount, in units of its own.
    pub(crate) fn new(go_on: GoOn<'a>, total: u64) -> Self {
        Self {
            go_on,
            total: total.max(1),
            done: Mutex::new(0),
            is_stopped: AtomicBool::new(false),
        }
    }

    /// Adds to what is done.
    ///
    /// # Errors
    ///
    /// [`PictureError::Cancelled`] if there is no need to go on; ever after, once it has been so.
    pub(crate) fn add(&self, amount: u64) -> Result<(), PictureError> {
        if self.is_stopped.load(Ordering::Relaxed) {
            return Err(PictureError::Cancelled);
        }
        let mut done = match self.done.lock() {
            Ok(done) => done,
            Err(poisoned) => poisoned.into_inner(),
        };
        *done = done.saturating_add(amount).min(self.total);
        if (self.go_on)(*done as f64 / self.total as f64) {
            return Ok(());
        }
        self.is_stopped.store(true, Ordering::Relaxed);
        Err(PictureError::Cancelled)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_rises_to_its_end_and_stays_stopped() {
        let told = Mutex::new(Vec::new());
        let go_on = |part: f64| {
            told.lock().unwrap().push(part);
            part < 0.7
        };
        let work = Work::new(&go_on, 10);
        let went_on: Vec<bool> = (0..4).map(|_| work.add(3).is_ok()).collect();
        assert_eq!(went_on, [true, true, false, false]);
        assert_eq!(*told.lock().unwrap(), [0.3, 0.6, 0.9]);
        // More than was expected, and nothing at all.
        assert!(Work::new(&|part| part <= 1.0, 2).add(9).is_ok());
        assert!(Work::new(&|part| part <= 1.0, 0).add(0).is_ok());
    }
}
