//! A cache in memory that maps the key of each step to the scene after the step.

use std::collections::HashMap;
use std::sync::Arc;

use engine::{SceneMemory, StepDone, StepKey};
use scene::{Digest, Scene};

use super::state::Verdict;

/// The scene after a step, and the report of the step. Clones share the scene.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// The scene after the step.
    pub scene: Arc<Scene>,
    /// The report of the step, the time that the step took, and the numbers of elements after the step.
    pub done: Arc<StepDone>,
}

/// The maximum number of digests that are kept. The same maximum applies to the results of expectations. If there are
/// more digests than this, all digests are removed. If there are more results, all results are removed.
const MAX_RESULTS: usize = 100_000;

/// The known results. If a step does not change a mesh, the scenes before and after the step share the mesh.
#[derive(Default)]
pub(super) struct Snapshots {
    of_steps: HashMap<StepKey, (Snapshot, u64)>,
    /// The digests of final scenes.
    pub(super) digests: HashMap<StepKey, Digest>,
    /// The results of expectations.
    pub(super) verdicts: HashMap<StepKey, Verdict>,
    clock: u64,
}

impl Snapshots {
    /// Begins a run. Snapshots that this run uses count as newer than snapshots that were last used in earlier runs.
    pub(super) fn tick(&mut self) {
        self.clock += 1;
    }

    pub(super) fn get(&mut self, key: &StepKey) -> Option<Snapshot> {
        let (snapshot, used) = self.of_steps.get_mut(key)?;
        *used = self.clock;
        Some(snapshot.clone())
    }

    pub(super) fn insert(&mut self, key: StepKey, snapshot: Snapshot) {
        self.of_steps.insert(key, (snapshot, self.clock));
    }

    /// Removes the least recently used snapshots until the remaining snapshots fit into `memory` bytes. Snapshots that
    /// the last run has used are never removed.
    pub(super) fn trim(&mut self, memory: u64) {
        let mut by_age: Vec<(u64, StepKey)> = self
            .of_steps
            .iter()
            .map(|(key, (_, used))| (*used, *key))
            .collect();
        // The newest snapshots come first. Snapshots of equal age are ordered by their keys, so that the order is
        // always the same.
        by_age.sort_unstable_by(|a, b| b.cmp(a));
        let mut total = SceneMemory::default();
        for (used, key) in by_age {
            let Some((snapshot, _)) = self.of_steps.get(&key) else {
                continue;
            };
            if total.add(&snapshot.scene) > memory && used < self.clock {
                self.of_steps.remove(&key);
            }
        }
        if self.verdicts.len() > MAX_RESULTS {
            self.verdicts.clear();
        }
        if self.digests.len() > MAX_RESULTS {
            self.digests.clear();
        }
    }
}
