//! The memory budget of a file. In a small file, many references to the same content can need much memory. The budget
//! limits the total memory.

use std::cell::Cell;

use crate::fault::Fault;

/// The memory budget is the size of the file times this factor, but at least [`MIN_BUDGET`].
const BUDGET_FACTOR: u64 = 64;
/// The smallest memory budget of a file, in bytes.
const MIN_BUDGET: u64 = 1 << 24;

/// If a document has compressed views, each byte of its buffers increases the memory budget by this number times
/// [`BUDGET_FACTOR`]. The increase is larger than for uncompressed data, because compressed data gives a larger mesh
/// than uncompressed data of the same size. A triangle with its vertices takes two bytes on average if it is
/// compressed, and at least twenty bytes if it is not.
const COMPRESSED: u64 = 4;

/// The memory that can still be used, in bytes.
#[derive(Default)]
pub(super) struct Budget {
    left: Cell<u64>,
    /// The second budget: how many bytes further decoded views can have in total.
    inflation: Cell<u64>,
}

impl Budget {
    /// The approximate size of an object without faces.
    pub(super) const OBJECT: u64 = 300;

    /// Creates the memory budget of a file of `size` bytes.
    pub(super) fn of(size: usize) -> Self {
        let budget = Self::default();
        budget.grant(size as u64);
        budget.left.set(budget.left.get().max(MIN_BUDGET));
        budget
    }

    /// Increases the memory budget because `size` additional bytes of input were read.
    pub(super) fn grant(&self, size: u64) {
        let more = size.saturating_mul(BUDGET_FACTOR);
        for bytes in [&self.left, &self.inflation] {
            bytes.set(bytes.get().saturating_add(more));
        }
    }

    /// Increases the memory budget because a document with buffers of `size` bytes contains compressed data. This
    /// increase is added to the increase by [`grant`](Self::grant).
    pub(super) fn grant_compressed(&self, size: u64) {
        let more = size.saturating_mul(BUDGET_FACTOR * (COMPRESSED - 1));
        self.left.set(self.left.get().saturating_add(more));
    }

    /// Whether this number of bytes is left in the memory budget.
    pub(super) fn has(&self, bytes: u64) -> bool {
        bytes <= self.left.get()
    }

    /// Subtracts bytes from the memory budget. `pointer` is the JSON pointer of the part that needs the memory.
    ///
    /// # Errors
    ///
    /// Returns an error if the budget is used up.
    pub(super) fn spend(&self, bytes: u64, pointer: &str) -> Result<(), Fault> {
        let left = self.left.get().checked_sub(bytes).ok_or_else(|| {
            let message = format!(
                "the file refers to the same data so often that it needs more than {BUDGET_FACTOR} times its \
                size in memory"
            );
            Fault::json(pointer, message)
        })?;
        self.left.set(left);
        Ok(())
    }

    /// Subtracts the decoded size of a compressed view from the budget, and returns this size as a `usize`. A second,
    /// smaller budget limits the total size of all decoded views, because a stream of zeros can be a thousand times
    /// smaller than its decoded data. Files with real data do not reach this limit. `pointer` is the JSON pointer of
    /// the part that needs the memory.
    ///
    /// # Errors
    ///
    /// Returns an error if the budget is used up.
    pub(super) fn inflate(&self, bytes: u64, pointer: &str) -> Result<usize, Fault> {
        self.spend(bytes, pointer)?;
        let left = self.inflation.get().checked_sub(bytes);
        let length = usize::try_from(bytes).ok();
        let (Some(left), Some(length)) = (left, length) else {
            let message = format!(
                "decoding this view adds {}, which makes the decoded views more than {BUDGET_FACTOR} times as large as \
                 the file",
                mesh::readable_bytes(bytes)
            );
            return Err(Fault::json(pointer, message));
        };
        self.inflation.set(left);
        Ok(length)
    }
}
