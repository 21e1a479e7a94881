//! Some elements of a mesh, and the ranks of these and of the others.

use std::ops::Range;

use crate::parallel::of_blocks;

/// Numbers in rising order.
#[derive(Debug)]
pub(crate) struct Chosen(Vec<u32>);

impl Chosen {
    /// The numbers below `n` of which `is_chosen` holds.
    pub(crate) fn of(n: usize, is_chosen: impl Fn(usize) -> bool + Sync) -> Self {
        let number = |i| u32::try_from(i).expect("fewer than ids");
        let in_block = |block: Range<usize>| -> Vec<u32> {
            block.filter(|&i| is_chosen(i)).map(number).collect()
        };
        Self(of_blocks(n, &in_block).concat())
    }

    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// The one of rank `r`.
    #[inline]
    pub(crate) fn at(&self, r: usize) -> usize {
        self.0[r] as usize
    }

    /// How many are below `i`: the rank of `i`, if it is chosen.
    #[inline]
    pub(crate) fn below(&self, i: usize) -> usize {
        self.0.partition_point(|&chosen| (chosen as usize) < i)
    }

    #[inline]
    pub(crate) fn contains(&self, i: usize) -> bool {
        self.0.get(self.below(i)).is_some_and(|&c| c as usize == i)
    }

    /// The rank of `i` among the numbers that are not chosen, to which it belongs.
    #[inline]
    pub(crate) fn rank_of_other(&self, i: usize) -> usize {
        i - self.below(i)
    }

    /// The number of rank `r` among those that are not chosen.
    #[inline]
    pub(crate) fn other(&self, r: usize) -> usize {
        // Before the k-th chosen number c are c - k others.
        let mut ranks = (0, self.0.len());
        while ranks.0 < ranks.1 {
            let k = ranks.0.midpoint(ranks.1);
            if self.at(k) - k <= r {
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
    fn ranks_lead_back_to_their_numbers() {
        for modulus in [1, 2, 3, 7, 100] {
            for residue in 0..modulus {
                let is_chosen = |i: usize| i % modulus == residue;
                let chosen = Chosen::of(50, is_chosen);
                let (inside, others): (Vec<usize>, Vec<usize>) =
                    (0..50).partition(|&i| is_chosen(i));
                assert_eq!(chosen.len(), inside.len());
                for (r, &i) in inside.iter().enumerate() {
                    assert_eq!((chosen.at(r), chosen.below(i)), (i, r));
                    assert!(chosen.contains(i));
                }
                for (r, &i) in others.iter().enumerate() {
                    assert_eq!((chosen.other(r), chosen.rank_of_other(i)), (i, r));
                    assert!(!chosen.contains(i));
                }
            }
        }
    }
}
