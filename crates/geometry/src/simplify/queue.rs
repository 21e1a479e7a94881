//! A queue of edges, the cheapest first.

use mesh::EdgeId;

/// Edges in levels of nearly equal cost. The edges of a level are visited in passes: an edge that is added to the
/// level during a pass waits for the next pass.
///
/// Levels are faster than a heap: on a mesh of 1,000,000 triangles, a version with a heap spent half of its
/// time in the heap.
pub(super) struct Queue {
    levels: Vec<Vec<EdgeId>>,
    level: usize,
    /// The position in the current level.
    next: usize,
    /// The length of the current level when the pass began.
    end: usize,
    pass: u32,
}

/// The number of low bits of a cost, as a floating-point number, that are dropped to get its level. The
/// exponent and 3 bits of the fraction remain, so costs within a level differ by at most 12.5 %.
const SHIFT: u32 = f64::MANTISSA_DIGITS - 1 - 3;

impl Queue {
    pub(super) fn new() -> Self {
        let levels = vec![Vec::new(); level_of(f64::INFINITY) + 1];
        Self {
            levels,
            level: 0,
            next: 0,
            end: 0,
            pass: 0,
        }
    }

    /// Returns the index of the current pass. The index changes between two passes, and between two levels.
    pub(super) fn pass(&self) -> u32 {
        self.pass
    }

    /// Adds an edge with this cost. If the cost is below the current level, the edge goes to the current level.
    pub(super) fn push(&mut self, e: EdgeId, cost: f64) {
        let level = level_of(cost).max(self.level);
        self.levels[level].push(e);
    }

    /// Whether an edge with this cost belongs to a level after the current one.
    pub(super) fn is_later(&self, cost: f64) -> bool {
        level_of(cost) > self.level
    }

    /// Removes and returns the next edge.
    pub(super) fn pop(&mut self) -> Option<EdgeId> {
        loop {
            let level = self.levels.get_mut(self.level)?;
            if self.next == self.end {
                level.drain(..self.end);
                self.pass += 1;
                (self.next, self.end) = (0, level.len());
            }
            if let Some(&e) = level.get(self.next) {
                self.next += 1;
                return Some(e);
            }
            *level = Vec::new();
            self.level += 1;
        }
    }
}

/// Returns the level of a cost, which must not be negative. A cost that is not a number has the last level.
fn level_of(cost: f64) -> usize {
    let cost = if cost.is_nan() { f64::INFINITY } else { cost };
    usize::try_from(cost.to_bits() >> SHIFT).expect("14 bits")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_come_in_the_order_of_their_levels() {
        let mut queue = Queue::new();
        let costs = [4.0, f64::NAN, 0.0, 1e-300, 4.01, 1e300, 0.5];
        for (e, cost) in costs.into_iter().enumerate() {
            queue.push(EdgeId::new(e), cost);
        }
        let order: Vec<usize> = std::iter::from_fn(|| queue.pop())
            .map(EdgeId::index)
            .collect();
        assert_eq!(order, [2, 3, 6, 0, 4, 5, 1]);
        assert_eq!(queue.pop(), None);
    }

    #[test]
    fn an_edge_added_to_the_current_level_waits_for_the_next_pass() {
        let mut queue = Queue::new();
        let [a, b] = [0, 1].map(EdgeId::new);
        queue.push(a, 1.0);
        queue.push(b, 1.0);
        assert_eq!(queue.pop(), Some(a));
        let pass = queue.pass();
        queue.push(a, 0.0);
        assert_eq!((queue.pop(), queue.pass()), (Some(b), pass));
        assert_eq!((queue.pop(), queue.pass()), (Some(a), pass + 1));
    }
}
