//! Finds pairs of triangles whose bounding boxes overlap.

use mesh::{DVec3, parallel};
use progress::{Cancelled, Meter, Progress};

use super::SurfaceIndex;

/// The search is divided into about this number of tasks.
const TASKS: usize = 1024;

/// The root nodes of two subtrees whose triangles are compared. If both are the same subtree of the same index, each
/// pair of triangles is visited only once.
type Task = (usize, usize);

impl SurfaceIndex {
    /// Returns all pairs of different triangles of this index that satisfy two conditions: their bounding boxes overlap
    /// or touch, and `keep` returns true. The pairs are in ascending order. The first index of a pair is the smaller
    /// one. Runs in parallel; only the pairs that are kept take memory.
    ///
    /// # Errors
    ///
    /// Returns [`Cancelled`] if `progress` asks to stop.
    pub fn pairs(
        &self,
        keep: impl Fn(u32, u32) -> bool + Sync,
        progress: &dyn Progress,
    ) -> Result<Vec<[u32; 2]>, Cancelled> {
        self.search(self, true, &keep, progress)
    }

    /// Returns pairs of triangles: the first is from this index, and the second is from `other`. A pair is returned if
    /// the bounding boxes of its triangles overlap or touch, and `keep` returns true. The pairs are in ascending order.
    /// Runs in parallel; only the pairs that are kept take memory.
    ///
    /// # Errors
    ///
    /// Returns [`Cancelled`] if `progress` asks to stop.
    pub fn pairs_with(
        &self,
        other: &Self,
        keep: impl Fn(u32, u32) -> bool + Sync,
        progress: &dyn Progress,
    ) -> Result<Vec<[u32; 2]>, Cancelled> {
        self.search(other, false, &keep, progress)
    }

    fn search(
        &self,
        other: &Self,
        is_self: bool,
        keep: &(impl Fn(u32, u32) -> bool + Sync),
        progress: &dyn Progress,
    ) -> Result<Vec<[u32; 2]>, Cancelled> {
        let pairs = Pairs {
            one: self,
            two: other,
            is_self,
            keep,
        };
        let mut tasks = vec![(0, 0)];
        while tasks.len() < TASKS {
            let mut parts = Vec::with_capacity(4 * tasks.len());
            for task in &tasks {
                match pairs.parts(*task) {
                    Some(found) => parts.extend(found.into_iter().flatten()),
                    None => parts.push(*task),
                }
            }
            if parts == tasks {
                break;
            }
            tasks = parts;
        }
        let meter = Meter::new(progress, "find overlapping triangles", tasks.len() as u64);
        let found: Result<Vec<Vec<[u32; 2]>>, Cancelled> = parallel::consume(tasks, |_, task| {
            let mut found = Vec::new();
            pairs.collect(task, &mut found, &|| meter.add(0))?;
            meter.add(1)?;
            Ok(found)
        })
        .into_iter()
        .collect();
        let mut found = found?.concat();
        found.sort_unstable();
        Ok(found)
    }
}

struct Pairs<'a, K> {
    one: &'a SurfaceIndex,
    two: &'a SurfaceIndex,
    is_self: bool,
    keep: &'a K,
}

impl<K: Fn(u32, u32) -> bool> Pairs<'_, K> {
    /// Divides a task, which is a pair of nodes: replaces one of the nodes by its two children. A pair of a node with
    /// itself becomes three pairs: each child with itself, and the two children with each other. Returns `None` if both
    /// nodes are leaves. Pairs of nodes whose boxes do not overlap are left out.
    fn parts(&self, (i, j): Task) -> Option<[Option<Task>; 3]> {
        let (a, b) = (&self.one.nodes[i], &self.two.nodes[j]);
        if self.is_self && i == j {
            let right = a.right as usize;
            let across = self.overlap((i + 1, right));
            return (right != 0).then_some([Some((i + 1, i + 1)), across, Some((right, right))]);
        }
        let divides_first = b.right == 0 || a.right != 0 && a.last - a.first >= b.last - b.first;
        if !divides_first {
            Some([
                self.overlap((i, j + 1)),
                self.overlap((i, b.right as usize)),
                None,
            ])
        } else if a.right != 0 {
            Some([
                self.overlap((i + 1, j)),
                self.overlap((a.right as usize, j)),
                None,
            ])
        } else {
            None
        }
    }

    fn overlap(&self, (i, j): Task) -> Option<Task> {
        let (a, b) = (self.one.nodes.get(i)?, self.two.nodes.get(j)?);
        touch([a.min, a.max], [b.min, b.max]).then_some((i, j))
    }

    fn collect(
        &self,
        task: Task,
        found: &mut Vec<[u32; 2]>,
        ask: &dyn Fn() -> Result<(), Cancelled>,
    ) -> Result<(), Cancelled> {
        let mut waiting = vec![task];
        let mut n_leaves = 0_u32;
        while let Some(task) = waiting.pop() {
            if let Some(parts) = self.parts(task) {
                waiting.extend(parts.into_iter().flatten());
                continue;
            }
            n_leaves += 1;
            if n_leaves.is_multiple_of(1 << 14) {
                ask()?;
            }
            let (a, b) = (&self.one.nodes[task.0], &self.two.nodes[task.1]);
            for s in a.first..a.last {
                let around = bounds(&self.one.positions[s as usize]);
                let is_same_leaf = self.is_self && task.0 == task.1;
                for t in if is_same_leaf { s + 1 } else { b.first }..b.last {
                    if touch(around, bounds(&self.two.positions[t as usize])) {
                        let pair = if self.is_self {
                            [s.min(t), s.max(t)]
                        } else {
                            [s, t]
                        };
                        if (self.keep)(pair[0], pair[1]) {
                            found.push(pair);
                        }
                    }
                }
            }
        }
        Ok(())
    }
}

fn bounds(t: &[DVec3; 3]) -> [DVec3; 2] {
    [t[0].min(t[1]).min(t[2]), t[0].max(t[1]).max(t[2])]
}

fn touch([min, max]: [DVec3; 2], [low, high]: [DVec3; 2]) -> bool {
    min.cmple(high).all() && low.cmple(max).all()
}
