//! Numbering the different values on the corners around vertices, for writers.

/// Numbers the different values that stand at each of many places, in the order in which they come.
///
/// Made for few values at a place. Of a crowd only the latest [`Numbering::LOOKED_AT`] are compared, so
/// that a vertex with a million corners costs no more than others; a value may then get a second
/// number.
#[derive(Debug)]
pub(crate) struct Numbering<K> {
    /// For each place its latest number.
    latest: Vec<u32>,
    /// For each number its value and the number that its place got before.
    entries: Vec<(K, u32)>,
}

impl<K: PartialEq> Numbering<K> {
    const LOOKED_AT: usize = 64;

    pub(crate) fn new(n_places: usize) -> Self {
        Self {
            latest: vec![u32::MAX; n_places],
            entries: Vec::new(),
        }
    }

    /// The number of `key` at `place`, and whether it is new.
    pub(crate) fn number(&mut self, place: usize, key: K) -> (u32, bool) {
        let mut at = self.latest[place];
        for _ in 0..Self::LOOKED_AT {
            let Some((known, before)) = self.entries.get(at as usize) else {
                break;
            };
            if *known == key {
                return (at, false);
            }
            at = *before;
        }
        let number = u32::try_from(self.entries.len()).unwrap_or(u32::MAX);
        self.entries.push((key, self.latest[place]));
        self.latest[place] = number;
        (number, true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_values_at_one_place_share_a_number() {
        let mut numbering = Numbering::new(2);
        assert_eq!(numbering.number(0, 'a'), (0, true));
        assert_eq!(numbering.number(0, 'b'), (1, true));
        assert_eq!(numbering.number(1, 'a'), (2, true));
        assert_eq!(numbering.number(0, 'a'), (0, false));
        assert_eq!(numbering.number(1, 'a'), (2, false));
    }

    #[test]
    fn a_crowd_at_one_place_takes_no_quadratic_time() {
        let mut numbering = Numbering::new(1);
        for i in 0..200_000 {
            assert_eq!(numbering.number(0, i), (i, true));
        }
    }
}
