//! Writes streams of attributes, version 0 of the codec; see [`attributes`](super::attributes) for the layout.

use super::attributes::{BLOCK, GROUP, elements_in_block};
use mesh::parallel;

/// The minimum size in bytes of the tail at the end of a stream. If an element is longer than this minimum, the tail is
/// as long as the element.
const TAIL: usize = 32;

/// Encodes elements of `stride` bytes. The stride is a multiple of 4 from 4 to 256. The length of `elements` is a
/// multiple of the stride. The stream is the same for any number of threads.
pub(in super::super) fn encode(elements: &[u8], stride: usize) -> Vec<u8> {
    let in_block = elements_in_block(stride);
    let blocks = elements.len().div_ceil(in_block * stride);
    let first = elements.get(..stride).unwrap_or_default();
    let encoded = parallel::map(blocks, |block| {
        let start = block * in_block * stride;
        let end = elements.len().min(start + in_block * stride);
        // The first element of the stream is stored as the difference from itself, so all its differences are 0.
        let before = start.checked_sub(stride);
        let before = before.map_or(first, |at| &elements[at..start]);
        encode_block(&elements[start..end], before)
    });
    let mut out = vec![0xa0];
    for block in encoded {
        out.extend(block);
    }
    out.resize(out.len() + TAIL.max(stride) - first.len(), 0);
    out.extend_from_slice(first);
    out
}

fn encode_block(elements: &[u8], before: &[u8]) -> Vec<u8> {
    let stride = before.len();
    let mut out = Vec::new();
    for (k, &before) in before.iter().enumerate() {
        let mut differences = [0; BLOCK];
        let mut last = before;
        let bytes = elements[k..].iter().step_by(stride);
        let n = elements.len() / stride;
        for (slot, &byte) in differences.iter_mut().zip(bytes) {
            let difference = byte.wrapping_sub(last);
            *slot = (difference << 1) ^ (difference >> 7).wrapping_neg();
            last = byte;
        }
        encode_groups(&differences[..n.next_multiple_of(GROUP)], &mut out);
    }
    out
}

/// Encodes differences that belong to bytes at the same position in consecutive elements. Entry i is the byte of
/// element i minus the byte of the element before it. The number of differences is a multiple of [`GROUP`].
fn encode_groups(differences: &[u8], out: &mut Vec<u8>) {
    let groups = differences.as_chunks::<GROUP>().0;
    let kinds = out.len();
    out.resize(kinds + groups.len().div_ceil(4), 0);
    for (g, group) in groups.iter().enumerate() {
        let large = |most: u8| group.iter().filter(|&&d| d >= most).count();
        // The sizes of the group in bytes if each difference is stored with 0, 2, 4 or 8 bits. The smallest size is
        // chosen. If several sizes are equal, the first of them is chosen.
        let sizes = [
            if large(1) == 0 { 0 } else { usize::MAX },
            4 + large(3),
            8 + large(15),
            GROUP,
        ];
        let kind = (0..4).min_by_key(|&kind| sizes[kind]).unwrap_or(3);
        out[kinds + g / 4] |= [0, 1, 2, 3][kind] << (2 * (g % 4));
        match kind {
            0 => {}
            1 => encode_few_bits(group, 2, out),
            2 => encode_few_bits(group, 4, out),
            _ => out.extend_from_slice(group),
        }
    }
}

/// Encodes differences of 2 or 4 bits. Differences that do not fit into these bits are stored as full bytes after the
/// group.
fn encode_few_bits(group: &[u8; GROUP], bits: usize, out: &mut Vec<u8>) {
    let most = (1 << bits) - 1;
    for together in group.chunks(8 / bits) {
        let packed = together
            .iter()
            .fold(0_u8, |packed, &d| packed << bits | d.min(most));
        out.push(packed);
    }
    out.extend(group.iter().filter(|&&d| d >= most));
}
