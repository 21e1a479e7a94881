//! Decodes streams of arbitrary indices. The decoder has two base indices, which are 0 at first. Each index is stored
//! as the difference from one of the two base indices, and then replaces this base index.
//!
//! ```text
//! 0xd1 | a number for each index | 4 bytes
//! ```
//!
//! The lowest bit of each number in the stream selects the base index, and the other bits are the difference.

use super::input::{Input, header, zigzag};
use crate::fault::Fault;

/// The decoder ignores this number of bytes at the end of the stream.
const TAIL: u8 = 4;

/// A lower bound for the size of a stream of `count` indices, in bytes.
pub(super) fn shortest(count: u64) -> u64 {
    count.saturating_add(1 + u64::from(TAIL))
}

/// Decodes an index for each of the `slots`, which are functions that store an index.
///
/// # Errors
///
/// Returns the first error in the stream, with its position.
pub(super) fn decode(
    stream: &[u8],
    slots: impl Iterator<Item = impl FnOnce(u32)>,
) -> Result<(), Fault> {
    header(stream, 0xd1)?;
    let mut input = Input::new(stream, TAIL.into())?;
    let mut last = [0_u32; 2];
    for slot in slots {
        let number = input.number()?;
        let last = &mut last[(number & 1) as usize];
        *last = last.wrapping_add(zigzag(number >> 1));
        slot(*last);
    }
    input.end()
}
