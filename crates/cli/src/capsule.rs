//! Failure capsules as the program writes them.

use std::fs;
use std::path::Path;

use anyhow::Context as _;
use recipe::capsule::{BEFORE, capsule};
use scene::Scene;

use crate::listener::QUIET;
use crate::output::write_whole;
use engine::Loaded;

/// The scene before a step of a recipe, all of whose steps before it can be done.
pub(crate) fn scene_before(loaded: &mut Loaded, step: usize) -> anyhow::Result<Scene> {
    loaded
        .scene_before(step, &QUIET)
        .context("the steps before it fail too now")
}

/// Writes a capsule: the step that failed with what follows it, and the scene before it.
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
    write_whole(&folder.join("recipe.ron"), text.as_bytes())
}
