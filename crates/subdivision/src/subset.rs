//! A subset of the elements of a mesh. Both members and non-members have ranks: their positions in the order of ids.

use std::ops::Range;

use crate::parallel::of_blocks;

/// A subset of the numbers from 0 to n - 1, which are the ids of n elements. The members are in ascending order.
#[derive(Debug)]
pub(crate) struct Subset(Vec<u32>);

impl Subset {
    /// Collects the numbers below `n` for which `is_member` is true.
    pub(crate) fn of(n: usize, is_member: impl Fn(usize) -> bool + Sync) -> Self {
        let number = |i| u32::try_from(i).expect("the ids of elements fit into 32 bits");
        let in_block = |block: Range<usize>| -> Vec<u32> {
            block.filter(|&i| is_member(i)).map(number).collect()
        };
        Self(of_blocks(n, &in_block).concat())
    }

    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// Returns the member of rank `r`, counted from 0.
    #[inline]
    pub(crate) fn nth(&self, r: usize) -> usize {
        self.0[r] as usize
    }

    /// Returns the number of members below `i`, which is the rank of `i` if it is a member.
    #[inline]
    pub(crate) fn below(&self, i: usize) -> usize {
        self.0.partition_point(|&member| (member as usize) < i)
    }

    #[inline]
    pub(crate) fn contains(&self, i: usize) -> bool {
        self.0.get(self.below(i)).is_some_and(|&c| c as usize == i)
    }

    /// Returns how many non-members are below `i`. `i` itself must not be a member.
    #[inline]
    pub(crate) fn rank_outside(&self, i: usize) -> usize {
        i - self.below(i)
    }

    /// Returns the non-member (a number that is not a member) of rank `r`, counted from 0 in ascending order.
    #[inline]
    pub(crate) fn nth_outside(&self, r: usize) -> usize {
        // If c is the k-th member, then c - k of the numbers below c are not members.
        let mut ranks = (0, self.0.len());
        while ranks.0 < ranks.1 {
            let k = ranks.0.midpoint(ranks.1);
            if self.nth(k) - k <= r {
                ranks.0 = k + 1;
            } else {
                ranks.1 = k;
            }
        }
        r + ranks.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nth_and_rank_are_inverse_inside_and_outside() {
        for modulus in [1, 2, 3, 7, 100] {
            for residue in 0..modulus {
                let is_member = |i: usize| i % modulus == residue;
                let subset = Subset::of(50, is_member);
                let (inside, outside): (Vec<usize>, Vec<usize>) =
                    (0..50).partition(|&i| is_member(i));
                assert_eq!(subset.len(), inside.len());
                for (r, &i) in inside.iter().enumerate() {
                    assert_eq!((subset.nth(r), subset.below(i)), (i, r));
                    assert!(subset.contains(i));
                }
                for (r, &i) in outside.iter().enumerate() {
                    assert_eq!((subset.nth_outside(r), subset.rank_outside(i)), (i, r));
                    assert!(!subset.contains(i));
                }
            }
        }
    }
}
