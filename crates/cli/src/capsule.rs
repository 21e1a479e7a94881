//! Writes failure capsules, which are small recipes that reproduce a failure.

use std::fs;
use std::path::Path;

use anyhow::Context as _;
use recipe::capsule::{BEFORE, capsule};
use scene::Scene;

use crate::listener::INTERRUPT;
use crate::output::write_atomically;
use engine::Loaded;

/// Runs the steps before `step` and returns the scene. These steps are expected to succeed.
pub(crate) fn scene_before(loaded: &mut Loaded, step: usize) -> anyhow::Result<Scene> {
    loaded.scene_before(step, &INTERRUPT).context(
        "the failed step cannot be reproduced: an earlier step failed when it was run again",
    )
}

/// Writes a capsule: a recipe with the failed step and the steps after it, and the scene before the failed step.
pub(crate) fn write(
    loaded: &Loaded,
    step: usize,
    message: &str,
    scene: &Scene,
    folder: &Path,
) -> anyhow::Result<()> {
    let failed = || format!("cannot write the capsule {}", folder.display());
    fs::create_dir_all(folder).with_context(failed)?;
    let options = mesh_io::WriteOptions::default();
    mesh_io::write(&store::Disk, &folder.join(BEFORE), scene, &options).with_context(failed)?;
    let text = capsule(
        &loaded.recipe,
        step,
        message,
        &loaded.forecast.inputs,
        (folder, &*loaded.files.store),
    );
    write_atomically(&folder.join("recipe.ron"), text.as_bytes())
}
