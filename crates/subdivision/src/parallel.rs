//! Parallel loops over many elements, with shared progress counting.

use std::ops::Range;

use mesh::Value;
use progress::{Cancelled, Meter};
use rayon::prelude::*;

/// The number of elements in one block. Each task processes one block in well below a millisecond, so that progress is
/// smooth and cancellation is quick.
pub(crate) const BLOCK: usize = 4096;

/// Processes one block of an array. The first argument is the index of the first element of the block.
type Task<'a, T> = dyn Fn(usize, &mut [T]) -> Result<(), Cancelled> + Sync + 'a;

/// Runs `task` on all blocks of an array in parallel. Here and in the functions below, the task is `dyn`. Therefore,
/// the parallel loop is compiled once for each element type, and not for each closure.
pub(crate) fn in_blocks<T: Send>(array: &mut [T], task: &Task<T>) -> Result<(), Cancelled> {
    let blocks = array.par_chunks_mut(BLOCK).enumerate();
    blocks.try_for_each(|(block, part)| task(block * BLOCK, part))
}

/// Computes an array: element i is `value(i)`. Adds one to the meter for each element.
pub(crate) fn fill<T: Send>(
    array: &mut [T],
    meter: &Meter,
    value: impl Fn(usize) -> T + Sync,
) -> Result<(), Cancelled> {
    fill_counted(array, meter, 1, value)
}

/// Computes an array like [`fill`], but adds nothing to the meter. Use this function for arrays whose elements are not
/// included in the total of the meter.
pub(crate) fn fill_uncounted<T: Send>(
    array: &mut [T],
    meter: &Meter,
    value: impl Fn(usize) -> T + Sync,
) -> Result<(), Cancelled> {
    fill_counted(array, meter, 0, value)
}

fn fill_counted<T: Send>(
    array: &mut [T],
    meter: &Meter,
    each: usize,
    value: impl Fn(usize) -> T + Sync,
) -> Result<(), Cancelled> {
    in_blocks(array, &|start, part| {
        for (i, slot) in (start..).zip(part.iter_mut()) {
            *slot = value(i);
        }
        meter.add(each * part.len())
    })
}

/// Computes an array of `n` elements: element i is `value(i)`. Adds nothing to the meter.
pub(crate) fn computed<T: Value>(
    n: usize,
    meter: &Meter,
    value: impl Fn(usize) -> T + Sync,
) -> Result<Vec<T>, Cancelled> {
    let mut new = mesh::zeroed(n);
    fill_uncounted(&mut new, meter, value)?;
    Ok(new)
}

/// Calls `task` with each block of the numbers below `n`, in parallel, and returns the results in order.
pub(crate) fn of_blocks<T: Send>(n: usize, task: &(dyn Fn(Range<usize>) -> T + Sync)) -> Vec<T> {
    let blocks = (0..n.div_ceil(BLOCK)).into_par_iter();
    blocks.map(|block| task(block_of(block, n))).collect()
}

/// Whether `test` is true for at least one number below `n`.
pub(crate) fn any(n: usize, test: impl Fn(usize) -> bool + Sync) -> bool {
    any_block(n, &|mut block| block.any(&test))
}

fn any_block(n: usize, test: &(dyn Fn(Range<usize>) -> bool + Sync)) -> bool {
    let blocks = (0..n.div_ceil(BLOCK)).into_par_iter();
    blocks.any(|block| test(block_of(block, n)))
}

fn block_of(block: usize, n: usize) -> Range<usize> {
    block * BLOCK..n.min((block + 1) * BLOCK)
}
