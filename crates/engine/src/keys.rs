//! Keys of steps. The key of a step depends on the step, on all steps before it, and on the input files of these steps.
//! If the key of a step is unchanged, the editor and the engine in the browser reuse the result that they have stored
//! for the step.

use std::path::{Path, PathBuf};

use store::{Entry, Store};

use crate::Loaded;

/// The key of a step: a hash of the memory budget, of the step, and of all steps before this step. The lengths and
/// modification times of the input files of all these steps are also hashed.
pub type StepKey = [u8; 32];

/// The keys of a recipe.
#[derive(Clone, Debug, Default)]
pub struct StepKeys {
    /// The key of each step.
    pub steps: Vec<StepKey>,
    /// The key of each expectation. The key is a hash of three parts: the expectation, the key of the step after which
    /// the expectation is checked, and the lengths and modification times of all input files.
    pub expectations: Vec<StepKey>,
    /// The key before the first step: a hash of the memory budget.
    pub start: StepKey,
}

impl StepKeys {
    /// Returns the keys of a recipe that was read and checked. The keys depend on the lengths and modification times of
    /// the input files that the forecast lists. Other input files, such as the material files of a model, have no
    /// effect on the keys.
    pub fn of(loaded: &Loaded) -> Self {
        let recipe = &loaded.recipe;
        let store = &*loaded.files.store;
        let start = hash(&[&loaded.budget.to_le_bytes()]);
        let files = recipe.files(&loaded.files);
        let mut key = start;
        let mut n_inputs = 0;
        let mut steps = Vec::with_capacity(recipe.steps.len());
        for (i, step) in recipe.steps.iter().enumerate() {
            let (version, canonical) = match &step.step {
                Some(step) => (step.version(), step.canonical()),
                None => (0, step.value.to_string()),
            };
            let around = format!(
                "{:?} {:?} {:?} {:?} {version} {canonical}",
                step.label(),
                step.on_names(),
                step.refused,
                step.on_loss,
            );
            let files = &files[step.scope];
            let place = format!("{} {:?}", files.input.display(), files.placeholders);
            let known = loaded
                .forecast
                .steps
                .get(i)
                .map_or(n_inputs, |step| step.n_inputs);
            let inputs = loaded
                .forecast
                .inputs
                .get(n_inputs..known)
                .unwrap_or_default();
            n_inputs = known;
            let stamps = stamps(inputs, store);
            let parts = [
                &key[..],
                step.name.as_bytes(),
                around.as_bytes(),
                place.as_bytes(),
                stamps.as_bytes(),
            ];
            key = hash(&parts);
            steps.push(key);
        }
        let all_inputs = stamps(&loaded.forecast.inputs, store);
        let expectations = (recipe.expectations.iter())
            .map(|placed| {
                let after = placed.after.map_or(key, |i| steps[i]);
                let what = format!("{:?} {:?} {:?}", placed.that, placed.on, placed.after);
                hash(&[&after, what.as_bytes(), all_inputs.as_bytes()])
            })
            .collect();
        Self {
            steps,
            expectations,
            start,
        }
    }

    /// Returns the key of the last step. If the recipe has no steps, returns the key before the first step.
    pub fn end(&self) -> StepKey {
        self.steps.last().copied().unwrap_or(self.start)
    }
}

/// Returns a text that contains the path, the length and the modification time of each file.
fn stamps(paths: &[PathBuf], store: &dyn Store) -> String {
    paths
        .iter()
        .map(|path| stamp_line(path, store.entry(path)))
        .collect()
}

/// Returns a text that contains the path of a file and its `stamp`: the length and the modification time of the file.
/// The stamp of a file that does not exist is `None`.
pub fn stamp_line(path: &Path, stamp: Option<Entry>) -> String {
    format!("{} {stamp:?}\n", path.display())
}

fn hash(parts: &[&[u8]]) -> StepKey {
    let mut hasher = blake3::Hasher::new();
    for part in parts {
        hasher.update(&(part.len() as u64).to_le_bytes());
        hasher.update(part);
    }
    *hasher.finalize().as_bytes()
}
