//! Keys of steps: two steps have the same key if they and all steps before them are the same, so that their results are
//! the same.

use std::path::{Path, PathBuf};

use engine::Loaded;
use store::{Entry, Store};

/// The key of a step, which stands for the step and all steps before it.
pub(super) type Key = [u8; 32];

/// The keys of a recipe.
pub(super) struct Keys {
    /// The key after each step.
    pub(super) steps: Vec<Key>,
    /// The key of each expectation, by its index: it stands for the expectation and the steps before it.
    pub(super) expectations: Vec<Key>,
    /// The key of the empty scene.
    pub(super) start: Key,
}

impl Keys {
    pub(super) fn of(loaded: &Loaded, store: &dyn Store, budget: u64) -> Self {
        let recipe = &loaded.recipe;
        let start = hash(&[&budget.to_le_bytes()]);
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

    /// Returns the key of the scene at the end.
    pub(super) fn end(&self) -> Key {
        self.steps.last().copied().unwrap_or(self.start)
    }
}

/// Returns a text that changes when one of the files changes.
pub(super) fn stamps(paths: &[PathBuf], store: &dyn Store) -> String {
    paths
        .iter()
        .map(|path| line(path, stamp(path, store)))
        .collect()
}

/// Returns a text with the stamp of a file.
pub(crate) fn line(path: &Path, stamp: Stamp) -> String {
    format!("{} {stamp:?}\n", path.display())
}

/// The description of a file, which changes when the file changes; `None` for a file that does not exist.
pub(crate) type Stamp = Option<Entry>;

/// Returns the description of a file.
pub(crate) fn stamp(path: &Path, store: &dyn Store) -> Stamp {
    store.entry(path)
}

fn hash(parts: &[&[u8]]) -> Key {
    let mut hasher = blake3::Hasher::new();
    for part in parts {
        hasher.update(&(part.len() as u64).to_le_bytes());
        hasher.update(part);
    }
    *hasher.finalize().as_bytes()
}
