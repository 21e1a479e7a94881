//! Decodes streams of attributes. A stream stores, for each byte of an element, the difference from the same byte of
//! the previous element. A difference needs only a few bits if it is small.
//!
//! ```text
//! 0xa0 or 0xa1 | block | block | ... | zeros | initial element | modes of the channels
//!                |
//!                up to 256 elements: | controls | byte 0 | byte 1 | ...
//!                                                 |
//!                                     2 bits for each 16 elements | 16 differences | 16 differences | ...
//! ```
//!
//! A channel consists of four consecutive bytes of each element. For each byte of an element, the controls of a block
//! define how many bits the differences of this byte can have. The mode of a channel is one of the variants of
//! `Channel`. Only version 1 (`0xa1`) has controls and modes.

use super::input::Input;
use crate::fault::Fault;

/// The number of differences in a group.
pub(super) const GROUP: usize = 16;
/// The largest size of a block in bytes.
const BLOCK_BYTES: usize = 8192;
/// The largest number of elements in a block.
pub(super) const BLOCK: usize = 256;

/// For each of the four kinds of groups, the number of bits of each difference in the group.
type Bits = [u8; 4];

const VERSION_0: Bits = [0, 2, 4, 8];
const FEW_BITS: Bits = [0, 1, 2, 4];
const MORE_BITS: Bits = [1, 2, 4, 8];

/// How the differences of a channel are encoded.
#[derive(Clone, Copy)]
enum Channel {
    /// The channel has four differences, one for each byte.
    Bytes,
    /// The channel is two 16-bit numbers, and each of them has its own difference.
    Shorts,
    /// The difference is the bitwise XOR of the channel and the same channel of the previous element, rotated left by
    /// this number of bits.
    Bits(u32),
}

pub(super) fn elements_in_block(stride: usize) -> usize {
    (BLOCK_BYTES / stride / GROUP * GROUP).min(BLOCK)
}

/// A lower bound for the size of a stream in bytes. The stream has `count` elements, each with `stride` bytes. The
/// stride is at most 256. A block is shortest if all its differences are 0. In version 0, such a block needs 2 bits for
/// each group of 16 differences. In version 1, such a block needs 2 bits for each byte of an element, regardless of the
/// number of elements in the block.
pub(super) fn shortest(count: u64, stride: u64) -> u64 {
    let stride = usize::try_from(stride).unwrap_or(BLOCK).clamp(1, BLOCK);
    let block = elements_in_block(stride) as u64;
    let controls = (stride / 4) as u64;
    let mut tail = (stride + stride / 4).max(24);
    if count == 0 {
        // A stream without blocks consists of a header and a tail, and the tail can be shorter in version 0. A stream
        // with blocks is always shorter in version 1, because blocks of zeros are shorter in this version.
        tail = tail.min(stride.max(32));
    }
    let around = 1 + tail as u64;
    count
        .div_ceil(block)
        .saturating_mul(controls)
        .saturating_add(around)
}

/// Decodes elements of `stride` bytes until `out` is full.
///
/// # Errors
///
/// Returns the first error in the stream, with its position.
pub(super) fn decode(stream: &[u8], stride: usize, out: &mut [u8]) -> Result<(), Fault> {
    let n_channels = stride / 4;
    let (is_old, in_tail) = match stream.first() {
        Some(0xa0) => (true, stride),
        Some(0xa1) => (false, stride + n_channels),
        Some(found) => {
            let message = format!("expected 0xa0 or 0xa1, found {found:#04x}");
            return Err(Fault::byte(0, message));
        }
        None => return Err(Fault::byte(0, "the stream is empty")),
    };
    let mut input = Input::new(stream, in_tail.max(if is_old { 32 } else { 24 }))?;
    let (mut before, modes) = {
        let (before, modes) = stream[stream.len() - in_tail..].split_at(stride);
        (before.to_vec(), modes)
    };
    let channels = if is_old {
        vec![Channel::Bytes; n_channels]
    } else {
        let first = stream.len() - n_channels;
        let channel = |(i, &mode)| channel(mode).map_err(|why| Fault::byte(first + i, why));
        modes
            .iter()
            .enumerate()
            .map(channel)
            .collect::<Result<_, _>>()?
    };
    let mut differences = vec![[0; BLOCK]; stride];
    for block in out.chunks_mut(elements_in_block(stride) * stride) {
        let n = block.len() / stride;
        let controls = input.take(if is_old { 0 } else { n_channels })?;
        for (k, differences) in differences.iter_mut().enumerate() {
            let control = controls
                .get(k / 4)
                .map(|control| control >> (2 * (k % 4)) & 3);
            match control {
                None => groups(&mut input, VERSION_0, n, differences)?,
                Some(0) => groups(&mut input, FEW_BITS, n, differences)?,
                Some(1) => groups(&mut input, MORE_BITS, n, differences)?,
                Some(2) => differences.fill(0),
                Some(_) => differences[..n].copy_from_slice(input.take(n)?),
            }
        }
        let channels = channels.iter().zip(before.as_chunks_mut().0);
        let four = differences.as_chunks().0;
        for (c, ((&channel, before), differences)) in channels.zip(four).enumerate() {
            channel.sum(before, differences, c, stride, block);
        }
    }
    input.end()
}

/// Decodes `n` differences, which belong to bytes at the same position in `n` consecutive elements.
fn groups(
    input: &mut Input,
    bits: Bits,
    n: usize,
    differences: &mut [u8; BLOCK],
) -> Result<(), Fault> {
    let n = n.div_ceil(GROUP);
    let kinds = input.take(n.div_ceil(4))?;
    let groups = differences.as_chunks_mut::<GROUP>().0.iter_mut().take(n);
    for (g, group) in groups.enumerate() {
        let kind = kinds[g / 4] >> (2 * (g % 4)) & 3;
        match bits[usize::from(kind)] {
            0 => group.fill(0),
            8 => group.copy_from_slice(input.take(GROUP)?),
            bits => few_bits(input, usize::from(bits), group)?,
        }
    }
    Ok(())
}

/// Decodes differences of 1, 2 or 4 bits. If all bits of a difference are set, its value is stored in an additional
/// byte after the group.
fn few_bits(input: &mut Input, bits: usize, group: &mut [u8; GROUP]) -> Result<(), Fault> {
    let packed = input.take(2 * bits)?;
    let (in_byte, all) = (8 / bits, (1 << bits) - 1);
    for (i, slot) in group.iter_mut().enumerate() {
        let place = match bits {
            // Differences of 1 bit are stored from the lowest bit upward. Differences of 2 or 4 bits are stored from
            // the highest bits downward.
            1 => i % in_byte,
            _ => bits * (in_byte - 1 - i % in_byte),
        };
        *slot = packed[i / in_byte] >> place & all;
    }
    for slot in group.iter_mut().filter(|slot| **slot == all) {
        *slot = input.byte()?;
    }
    Ok(())
}

/// Decodes the mode of a channel.
fn channel(mode: u8) -> Result<Channel, String> {
    match (mode & 15, mode >> 4) {
        (0, 0) => Ok(Channel::Bytes),
        (1, 0) => Ok(Channel::Shorts),
        (2, turn) => Ok(Channel::Bits(turn.into())),
        _ => Err(format!("expected a valid channel mode, found {mode:#04x}")),
    }
}

impl Channel {
    /// Computes the four bytes of channel `c` in each element of a block from the differences, and writes them to the
    /// block. Before the call, `before` is the element before the block. After the call, `before` is the last element
    /// of the block.
    fn sum(
        self,
        before: &mut [u8; 4],
        differences: &[[u8; BLOCK]; 4],
        c: usize,
        stride: usize,
        block: &mut [u8],
    ) {
        match self {
            Self::Bytes => scan(before, differences, c, stride, block, |before, d| {
                let byte =
                    |k: usize| before[k].wrapping_add((d[k] >> 1) ^ (d[k] & 1).wrapping_neg());
                [byte(0), byte(1), byte(2), byte(3)]
            }),
            Self::Shorts => scan(before, differences, c, stride, block, |before, d| {
                let short = |k: usize| {
                    let d = u16::from_le_bytes([d[k], d[k + 1]]);
                    let before = u16::from_le_bytes([before[k], before[k + 1]]);
                    before
                        .wrapping_add((d >> 1) ^ (d & 1).wrapping_neg())
                        .to_le_bytes()
                };
                let ([a, b], [c, d]) = (short(0), short(2));
                [a, b, c, d]
            }),
            Self::Bits(turn) => scan(before, differences, c, stride, block, |before, d| {
                let d = u32::from_le_bytes(d).rotate_right(turn);
                (u32::from_le_bytes(before) ^ d).to_le_bytes()
            }),
        }
    }
}

/// Computes the channel of each element from the previous element and the differences.
#[inline]
fn scan(
    before: &mut [u8; 4],
    [p, q, r, s]: &[[u8; BLOCK]; 4],
    c: usize,
    stride: usize,
    block: &mut [u8],
    next: impl Fn([u8; 4], [u8; 4]) -> [u8; 4],
) {
    let differences = p.iter().zip(q).zip(r).zip(s);
    for (element, (((p, q), r), s)) in block.chunks_exact_mut(stride).zip(differences) {
        *before = next(*before, [*p, *q, *r, *s]);
        element[4 * c..4 * c + 4].copy_from_slice(before);
    }
}
