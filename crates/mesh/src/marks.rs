//! A set of indices as a bit set, which uses no memory while it is empty.

/// A set of marked indices.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Marks {
    words: Vec<u64>,
    count: usize,
}

impl Marks {
    /// Whether `i` is marked.
    #[inline]
    pub(crate) fn has(&self, i: usize) -> bool {
        self.words
            .get(i / 64)
            .is_some_and(|word| word >> (i % 64) & 1 == 1)
    }

    /// Marks `i`.
    pub(crate) fn add(&mut self, i: usize) {
        if self.words.len() <= i / 64 {
            self.words.resize(i / 64 + 1, 0);
        }
        if !self.has(i) {
            self.words[i / 64] |= 1 << (i % 64);
            self.count += 1;
        }
    }

    /// Removes the mark of `i`. Also removes the zeros at the end of the list of words, so that equal sets have equal
    /// lists.
    pub(crate) fn remove(&mut self, i: usize) {
        if self.has(i) {
            self.words[i / 64] &= !(1 << (i % 64));
            self.count -= 1;
            while self.words.last() == Some(&0) {
                self.words.pop();
            }
        }
    }

    /// Returns the number of marked indices.
    #[inline]
    pub(crate) fn count(&self) -> usize {
        self.count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn removing_a_mark_restores_the_set() {
        let mut marks = Marks::default();
        marks.add(5);
        let before = marks.clone();
        marks.add(700);
        marks.remove(700);
        assert_eq!(marks, before);
    }

    #[test]
    fn a_mark_is_counted_once() {
        let mut marks = Marks::default();
        marks.add(70);
        marks.add(70);
        assert_eq!(
            (marks.count(), marks.has(70), marks.has(6), marks.has(700)),
            (1, true, false, false)
        );
    }
}
