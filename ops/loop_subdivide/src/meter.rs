//! How far the work is, counted by all threads together.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use op::{Context, OpError, Progress};

/// How many elements one task works on. A block takes well below a millisecond, so that progress is
/// smooth and cancelling quick.
pub(crate) const BLOCK: usize = 4096;

/// Adds up the work of all threads and tells the listener.
pub(crate) struct Meter<'a> {
    listener: &'a dyn Progress,
    done: AtomicU64,
    total: u64,
}

impl<'a> Meter<'a> {
    pub(crate) fn new(listener: &'a dyn Progress, total: u64) -> Self {
        Self {
            listener,
            done: AtomicU64::new(0),
            total,
        }
    }

    /// Counts `n` more elements as done.
    pub(crate) fn add(&self, n: usize) -> Result<(), OpError> {
        let done = self.done.fetch_add(n as u64, Relaxed) + n as u64;
        if self.listener.advance("Loop subdivision", done, self.total) {
            Ok(())
        } else {
            Err(OpError::Cancelled)
        }
    }
}

/// Lets the context of a step listen.
pub(crate) struct Through<'c, 'a>(pub(crate) &'c Context<'a>);

impl Progress for Through<'_, '_> {
    fn advance(&self, what: &str, done: u64, total: u64) -> bool {
        self.0.advance(what, done, total).is_ok()
    }
}
