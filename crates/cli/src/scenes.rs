//! From the path of a file to a scene: what a file of meshes holds, or what a recipe makes.

use std::path::Path;

use anyhow::Context as _;
use engine::{BUDGET, Disk, Engine, Run, Stop};
use mesh_io::{Note, ReadOptions};
use scene::Scene;

use crate::args::{ValueArgs, WrongUsage};
use crate::listener::{Terminal, catch_interrupts};
use crate::loading::load_recipe;
use crate::output::{complain, show};

/// A scene, and what it takes to ask it as a step would.
pub(crate) struct SceneAtStep {
    pub(crate) scene: Scene,
    /// What keys random choices: that of the step that the recipe stopped before.
    pub(crate) stream: String,
}

/// Whether a file is a recipe, by its ending.
pub(crate) fn is_recipe(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "ron")
}

/// The scene of a file, or of a recipe where it stops. Expectations are not held, and nothing is written.
pub(crate) fn find(
    path: &Path,
    options: &ReadOptions,
    values: &ValueArgs,
    stop: Stop,
    engine: &Engine,
) -> anyhow::Result<SceneAtStep> {
    if is_recipe(path) {
        return run(path, values, stop, engine);
    }
    if stop.after.is_some() || stop.before.is_some() || !values.is_empty() {
        let message = format!(
            "{} is no recipe (*.ron): it has neither steps nor parameters",
            path.display()
        );
        return Err(WrongUsage(message).into());
    }
    let (scene, notes) = read_file(path, options)?;
    for note in &notes {
        complain(&format!("note: {note}\n"));
    }
    Ok(SceneAtStep {
        scene,
        stream: String::new(),
    })
}

/// The objects of a file as a scene, and what was left out or changed.
pub(crate) fn read_file(path: &Path, options: &ReadOptions) -> anyhow::Result<(Scene, Vec<Note>)> {
    let loaded = mesh_io::read(&Disk, path, options);
    let loaded = loaded.map_err(|error| anyhow::anyhow!("{error}"))?;
    let mut scene = Scene::new();
    for object in loaded.objects {
        let inserted = scene.insert(object);
        inserted.with_context(|| format!("cannot use {}", path.display()))?;
    }
    Ok((scene, loaded.notes))
}

fn run(
    path: &Path,
    values: &ValueArgs,
    stop: Stop,
    engine: &Engine,
) -> anyhow::Result<SceneAtStep> {
    let shown = path.display();
    let mut loaded = load_recipe(path, values, Path::new("out"), BUDGET, engine)?;
    show(&loaded, &loaded.diagnostics);
    anyhow::ensure!(!loaded.has_errors(), "{shown} cannot run");
    let stream = loaded.stop(stop).map_err(|e| WrongUsage(e.to_string()))?;

    catch_interrupts();
    let terminal = Terminal::new();
    let outcome = loaded.run(Run::default(), &terminal);
    terminal.clear();
    show(&loaded, &outcome.failures);
    anyhow::ensure!(!outcome.cancelled, "interrupted");
    anyhow::ensure!(outcome.succeeded(), "{shown} failed");
    Ok(SceneAtStep {
        scene: outcome.scene.expect("a run without a cache has its scene"),
        stream,
    })
}
