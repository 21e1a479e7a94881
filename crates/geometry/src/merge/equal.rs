//! Finds equal positions.
//!
//! A hash distributes the positions over buckets. The buckets are processed in parallel. To find equal positions, each
//! bucket uses a hash table that is small enough for the processor cache. Entries are added to the table in the order of
//! the positions. Therefore, the result does not depend on the hash.

use std::hash::{BuildHasher, RandomState};
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use mesh::{DVec3, parallel, prefetch};

/// The number of positions in a chunk. Each chunk is hashed by one task.
const CHUNK: usize = 1 << 15;
/// The approximate number of positions in a bucket.
const BUCKET: usize = 1 << 14;
const MAX_BUCKETS: usize = 1 << 10;
/// How many entries the prefetched position is ahead of the position that is looked up.
const AHEAD: usize = 16;

/// Returns, for each position, the index of the first position that is equal to it. 0 and -0 are equal, and NaN is equal
/// only to NaN with the same bits. There must be fewer than 2^32 - 1 positions. The coordinates can be 32-bit or 64-bit
/// numbers; 32-bit numbers are compared after conversion to 64 bits.
///
/// # Examples
///
/// ```
/// use mesh::DVec3;
///
/// assert_eq!(geometry::first_equal(&[DVec3::X, DVec3::Y, DVec3::X]), [0, 1, 0]);
/// ```
pub fn first_equal<P: Copy + Into<DVec3> + Sync>(positions: &[P]) -> Vec<u32> {
    let buckets = (positions.len() / BUCKET + 1)
        .next_power_of_two()
        .min(MAX_BUCKETS);
    let keys = Keys::new();
    // For each chunk, `sorted` contains an entry for each position, ordered by bucket. An entry combines a part of the
    // hash and the index of the position.
    let mut sorted = mesh::zeroed::<u64>(positions.len());
    let chunks = sorted.chunks_mut(CHUNK).zip(positions.chunks(CHUNK));
    let starts: Vec<Vec<usize>> = parallel::consume(chunks, |chunk, (sorted, positions)| {
        let hashes: Vec<u64> = positions.iter().map(|&p| keys.hash(p.into())).collect();
        let bucket = |hash: u64| low(hash) as usize & (buckets - 1);
        let mut starts = vec![0; buckets + 1];
        for &hash in &hashes {
            starts[bucket(hash) + 1] += 1;
        }
        for b in 0..buckets {
            starts[b + 1] += starts[b];
        }
        let mut next = starts.clone();
        for (i, &hash) in hashes.iter().enumerate() {
            let place = &mut next[bucket(hash)];
            let number = index(chunk * CHUNK + i);
            sorted[*place] = hash & HIGH | u64::from(number);
            *place += 1;
        }
        starts
    });
    let first: Vec<AtomicU32> = mesh::zeroed(positions.len());
    parallel::map(buckets, |b| {
        let chunks = sorted.chunks(CHUNK).zip(&starts);
        let parts = chunks.map(|(chunk, starts)| &chunk[starts[b]..starts[b + 1]]);
        let entries = parts.collect::<Vec<_>>().concat();
        let mut table = Table::new(entries.len());
        for (i, &entry) in entries.iter().enumerate() {
            if let Some(&later) = entries.get(i + AHEAD) {
                prefetch(positions, low(later) as usize);
            }
            first[low(entry) as usize].store(table.first(entry, positions), Relaxed);
        }
    });
    first.into_iter().map(AtomicU32::into_inner).collect()
}

/// The bits of a table entry that store a part of the hash. The other bits store an index.
const HIGH: u64 = !0 << 32;

/// A hash table with open addressing. At most half of its slots are used.
struct Table {
    slots: Vec<u64>,
    shift: u32,
}

impl Table {
    /// Marks an empty slot: an index that no position has.
    const EMPTY: u64 = u32::MAX as u64;

    fn new(n: usize) -> Self {
        let bits = (2 * n).next_power_of_two().trailing_zeros().clamp(1, 31);
        Self {
            slots: vec![Self::EMPTY; 1 << bits],
            shift: u64::BITS - bits,
        }
    }

    /// Returns the index of the first position that was added to the table and equals the position of `entry`. If there
    /// is none, adds `entry`.
    fn first<P: Copy + Into<DVec3>>(&mut self, entry: u64, positions: &[P]) -> u32 {
        let number = low(entry);
        let mut at = low(entry >> self.shift) as usize;
        loop {
            let known = self.slots[at];
            if known == Self::EMPTY {
                self.slots[at] = entry;
                return number;
            }
            let first = low(known);
            let same = (known ^ entry) & HIGH == 0
                && bits(positions[first as usize].into())
                    == bits(positions[number as usize].into());
            if same {
                return first;
            }
            at = (at + 1) & (self.slots.len() - 1);
        }
    }
}

/// Adding 0 turns -0 into 0, so that both have the same bits.
#[inline]
fn bits(p: DVec3) -> [u64; 3] {
    p.to_array().map(|x| (x + 0.0).to_bits())
}

/// Random keys of the hash function. They protect against a file that is crafted so that all of its positions have the
/// same hash.
struct Keys([u64; 3]);

impl Keys {
    fn new() -> Self {
        let state = RandomState::new();
        Self([1, 2, 3].map(|i: u64| state.hash_one(i) | 1))
    }

    #[inline]
    fn hash(&self, p: DVec3) -> u64 {
        let Self([a, b, c]) = self;
        let [x, y, z] = bits(p);
        let fold = |a: u64, b: u64| {
            let product = u128::from(a) * u128::from(b);
            low_half(product >> 64) ^ low_half(product)
        };
        fold(fold(x ^ a, y ^ b) ^ z, *c)
    }
}

/// Returns the index that a table entry stores.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    reason = "the index is in the lower half"
)]
fn low(entry: u64) -> u32 {
    entry as u32
}

#[inline]
#[expect(
    clippy::cast_possible_truncation,
    reason = "the index is in the lower half"
)]
fn low_half(product: u128) -> u64 {
    product as u64
}

/// Converts `i`, which is less than 2^32, to 32 bits.
fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}
