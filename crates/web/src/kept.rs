//! Keeps the results of the last run, so that the next run can start at the first step that changed.

use std::collections::HashSet;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use engine::{Loaded, Outcome, SceneMemory, StepDone, StepKey, StepKeys};
use scene::Scene;

/// The maximum memory of the kept scenes, in bytes.
const MAX_BYTES: u64 = 1 << 29;

/// The results of the last run.
#[derive(Debug, Default)]
pub(crate) struct Kept {
    /// The steps that are done, in order.
    steps: Vec<(StepKey, StepDone)>,
    scenes: Mutex<Scenes>,
    /// The keys of the expectations that hold.
    held: HashSet<StepKey>,
}

/// The scenes after the first steps of a recipe.
#[derive(Debug, Default)]
struct Scenes {
    /// The scene after each step. `None` if the scene is not kept.
    after: Vec<Option<Scene>>,
    memory: SceneMemory,
}

impl Kept {
    /// Returns the index of the step that the next run must start with, and the scene before this step. Keeps only the
    /// results of the steps before this step.
    pub(crate) fn start(&mut self, loaded: &Loaded, keys: &StepKeys) -> (usize, Scene) {
        let known = self.steps.iter().zip(&keys.steps);
        let known = known.take_while(|((before, _), now)| before == *now);
        // A step that writes files always runs again. The files record the values of all parameters, but the key of the
        // step does not depend on all parameters.
        let forecast = &loaded.forecast.steps;
        let writes = forecast.iter().position(|step| step.n_outputs > 0);
        let first = known.count().min(writes.unwrap_or(usize::MAX));
        // An expectation is checked only if the step before it runs. The run therefore starts at that step or earlier,
        // unless the expectation is known to hold.
        let expectations = loaded.recipe.expectations.iter().zip(&keys.expectations);
        let unknown = expectations.filter(|(_, key)| !self.held.contains(*key));
        let first = unknown
            .filter_map(|(placed, _)| placed.after)
            .fold(first, usize::min);
        let mut scenes = self.scenes();
        let is_kept = |first: &usize| matches!(scenes.after.get(*first - 1), Some(Some(_)));
        let first = (1..=first).rev().find(is_kept).unwrap_or(0);
        scenes.after.truncate(first);
        scenes.keep_last(MAX_BYTES);
        let scene = scenes.after.last().cloned().flatten().unwrap_or_default();
        drop(scenes);
        self.steps.truncate(first);
        (first, scene)
    }

    /// Returns the reports of the steps that do not run again.
    pub(crate) fn reports(&self) -> Vec<StepDone> {
        let report = |(_, done): &(_, StepDone)| StepDone {
            ran: None,
            time: Duration::ZERO,
            ..done.clone()
        };
        self.steps.iter().map(report).collect()
    }

    /// Keeps the scene after the next step. Later steps do not change this scene: a later step that changes a mesh
    /// changes a copy of the mesh.
    pub(crate) fn add_scene(&self, scene: &Scene) {
        let mut scenes = self.scenes();
        scenes.after.push(Some(scene.clone()));
        if scenes.memory.add(scene) > MAX_BYTES {
            scenes.keep_last(MAX_BYTES / 2);
        }
    }

    /// Keeps the reports of a run. `checked` is the number of expectations that this run has checked. An expectation
    /// also counts as checked if an earlier run has checked it and it still holds.
    pub(crate) fn add(&mut self, keys: &StepKeys, outcome: &Outcome, checked: usize) {
        let keyed = keys.steps.iter().skip(outcome.first).zip(&outcome.steps);
        self.steps
            .extend(keyed.map(|(key, done)| (*key, done.clone())));
        let is_met = |i: &usize| outcome.unmet.iter().all(|unmet| unmet.expectation != *i);
        let held = keys.expectations.iter().take(checked).enumerate();
        self.held = held
            .filter(|(i, _)| is_met(i))
            .map(|(_, key)| *key)
            .collect();
    }

    fn scenes(&self) -> MutexGuard<'_, Scenes> {
        self.scenes.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Scenes {
    /// Drops the earliest scenes until the kept scenes need at most this number of bytes.
    fn keep_last(&mut self, limit: u64) {
        let mut memory = SceneMemory::default();
        let fits = |scene: &&Option<Scene>| scene.as_ref().is_none_or(|s| memory.add(s) <= limit);
        let n = self.after.iter().rev().take_while(fits).count();
        let first = self.after.len() - n;
        self.after[..first].fill(None);
        self.memory = SceneMemory::default();
        for scene in self.after.iter().flatten() {
            self.memory.add(scene);
        }
    }
}

#[cfg(test)]
mod tests {
    use geometry::shapes;
    use scene::Object;

    use super::*;

    #[test]
    fn only_the_last_scenes_stay_if_memory_is_short() {
        let scene = |mesh| {
            let mut scene = Scene::new();
            scene.insert(Object::mesh("a", mesh)).unwrap();
            scene
        };
        let (a, b) = (scene(shapes::cube()), scene(shapes::cube()));
        let one = SceneMemory::default().add(&a);
        let kept = Kept::default();
        for scene in [&a, &a, &b] {
            kept.add_scene(scene);
        }
        let is_kept = || -> Vec<bool> { kept.scenes().after.iter().map(Option::is_some).collect() };
        // The memory of a mesh is counted once, even if two scenes share the mesh.
        kept.scenes().keep_last(3 * one - 1);
        assert_eq!(is_kept(), [true; 3]);
        kept.scenes().keep_last(2 * one - 1);
        assert_eq!(is_kept(), [false, false, true]);
    }
}
