//! How far the work is, counted by all threads together.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use op::{Context, OpError, Progress};

/// How many elements one task works on. A block takes well below a millisecond, so that progress is
/// smooth and cancelling quick.
pub(crate) const BLOCK: usize = 4096;

/// Adds up the work of all threads and tells the listener.
pub(crate) struct Meter<'a> {
    listener: &'a dyn Progress,
    what: &'static str,
    done: AtomicU64,
    total: u64,
}

impl<'a> Meter<'a> {
    pub(crate) fn new(listener: &'a dyn Progress, what: &'static str, total: u64) -> Self {
        Self {
            listener,
            what,
            done: AtomicU64::new(0),
            total,
        }
    }

    /// Counts `n` more elements as done.
    pub(crate) fn add(&self, n: usize) -> Result<(), OpError> {
        let done = self.done.fetch_add(n as u64, Relaxed) + n as u64;
        if self
            .listener
            .advance(self.what, done.min(self.total), self.total)
        {
            Ok(())
        } else {
            Err(OpError::Cancelled)
        }
    }

    /// All is done.
    pub(crate) fn finish(&self) -> Result<(), OpError> {
        self.done.store(self.total, Relaxed);
        self.add(0)
    }
}

/// Lets the context of a step listen.
pub(crate) struct Through<'c, 'a>(pub(crate) &'c Context<'a>);

impl Progress for Through<'_, '_> {
    fn advance(&self, what: &str, done: u64, total: u64) -> bool {
        self.0.advance(what, done, total).is_ok()
    }
}
