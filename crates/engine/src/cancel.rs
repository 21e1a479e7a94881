//! Cancels a run from another thread.

use std::sync::atomic::{AtomicBool, Ordering};

use op::Progress;
use recipe::Listener;

/// A listener that ignores all events. Once [`set`](Self::set) is called, all runs that use this listener are canceled.
#[derive(Debug, Default)]
pub struct Cancel(AtomicBool);

impl Cancel {
    /// Returns a listener that cancels no run until [`set`](Self::set) is called.
    pub const fn new() -> Self {
        Self(AtomicBool::new(false))
    }

    /// Cancels all runs that use this listener. Returns whether [`set`](Self::set) was called before.
    pub fn set(&self) -> bool {
        self.0.swap(true, Ordering::Relaxed)
    }

    /// Whether [`set`](Self::set) was called.
    pub fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

impl Progress for Cancel {
    fn advance(&self, _: &str, _: u64, _: u64) -> bool {
        !self.is_set()
    }
}

impl Listener for Cancel {}
