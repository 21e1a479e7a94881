//! How much memory a file may take: its pieces can be repeated, but not without end.

use std::cell::Cell;

use crate::fault::Fault;

/// A file may become this many times its size in memory, ...
const TIMES: u64 = 64;
/// ... and this many bytes in any case.
const FREE: u64 = 1 << 24;

/// A byte of a buffer with compressed views pays for as much as this many others. A triangle with its part of the
/// vertices takes two bytes there and twenty or more elsewhere, and the mesh of it is as large.
const COMPRESSED: u64 = 4;

/// The bytes that may still be made.
#[derive(Default)]
pub(super) struct Budget {
    left: Cell<u64>,
    /// Those that compressed views may still become.
    inflation: Cell<u64>,
}

impl Budget {
    /// What an object takes that has no faces, about.
    pub(super) const OBJECT: u64 = 300;

    /// `size` is that of the file.
    pub(super) fn of(size: usize) -> Self {
        let budget = Self::default();
        budget.grant(size as u64);
        budget.left.set(budget.left.get().max(FREE));
        budget
    }

    /// Adds what `size` further bytes pay for.
    pub(super) fn grant(&self, size: u64) {
        let more = size.saturating_mul(TIMES);
        for bytes in [&self.left, &self.inflation] {
            bytes.set(bytes.get().saturating_add(more));
        }
    }

    /// Adds what compressed views pay for in buffers of `size` bytes, which have been granted already.
    pub(super) fn grant_compressed(&self, size: u64) {
        let more = size.saturating_mul(TIMES * (COMPRESSED - 1));
        self.left.set(self.left.get().saturating_add(more));
    }

    /// Takes bytes out of what the file pays for: many pieces may refer to the same bytes of it.
    ///
    /// # Errors
    ///
    /// If the file has used up its share; `pointer` is the place that wants more.
    pub(super) fn spend(&self, bytes: u64, pointer: &str) -> Result<(), Fault> {
        let left = self.left.get().checked_sub(bytes).ok_or_else(|| {
            let message = format!(
                "the file refers to the same data so often that it needs more than {TIMES} times its \
                 size in memory"
            );
            Fault::json(pointer, message)
        })?;
        self.left.set(left);
        Ok(())
    }

    /// Takes the bytes that a compressed view becomes out of what the file pays for, and gives them as a
    /// length in memory. Streams of zeros shrink to a thousandth, but no file consists of them.
    ///
    /// # Errors
    ///
    /// If the file has used up its share; `pointer` is the place that wants more.
    pub(super) fn inflate(&self, bytes: u64, pointer: &str) -> Result<usize, Fault> {
        self.spend(bytes, pointer)?;
        let left = self.inflation.get().checked_sub(bytes);
        let length = usize::try_from(bytes).ok();
        let (Some(left), Some(length)) = (left, length) else {
            let message = format!(
                "compressed views become {bytes} bytes more here, and together more than {TIMES} times \
                 the size of the file"
            );
            return Err(Fault::json(pointer, message));
        };
        self.inflation.set(left);
        Ok(length)
    }
}
