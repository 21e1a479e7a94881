//! How much memory a file may take: its pieces can be repeated, but not without end.

use std::cell::Cell;

use super::JsonError;

/// A file may become this many times its size in memory, ...
const TIMES: u64 = 64;
/// ... and this many bytes in any case.
const FREE: u64 = 1 << 24;

/// The bytes that may still be made.
pub(super) struct Budget(Cell<u64>);

impl Budget {
    /// What an object takes that has no faces, about.
    pub(super) const OBJECT: u64 = 500;

    /// `size` is that of the file.
    pub(super) fn of(size: usize) -> Self {
        let budget = Self(Cell::new(0));
        budget.grant(size as u64);
        budget.0.set(budget.0.get().max(FREE));
        budget
    }

    /// Adds what `size` further bytes pay for.
    pub(super) fn grant(&self, size: u64) {
        let more = size.saturating_mul(TIMES);
        self.0.set(self.0.get().saturating_add(more));
    }

    /// Takes bytes out of what the file pays for: many pieces may refer to the same bytes of it.
    ///
    /// # Errors
    ///
    /// If the file has used up its share; `pointer` is the place that wants more.
    pub(super) fn spend(&self, bytes: u64, pointer: &str) -> Result<(), JsonError> {
        let left = self.0.get().checked_sub(bytes).ok_or_else(|| {
            let message = format!(
                "the file refers to the same data so often that it needs more than {TIMES} times its \
                 size in memory"
            );
            JsonError::new(pointer, message)
        })?;
        self.0.set(left);
        Ok(())
    }
}
