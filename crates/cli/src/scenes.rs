//! Loads a scene from a path: the contents of a mesh file, or the result of a recipe.

use std::path::Path;

use anyhow::Context as _;
use engine::{BUDGET, Disk, Engine, Run, Stop};
use mesh_io::{Note, ReadOptions};
use scene::Scene;

use crate::args::{ValueArgs, WrongUsage};
use crate::file_kind::{FileKind, expect_kind};
use crate::listener::{Terminal, catch_interrupts};
use crate::loading::{Checking, load_recipe};
use crate::output::{print_diagnostics, print_error};
use crate::pipes;

/// A loaded scene: the scene of a mesh file, or the scene at one point of a recipe.
pub(crate) struct SceneAtStep {
    pub(crate) scene: Scene,
    /// The label of the step before which the recipe was stopped. The label is empty if the recipe was not stopped
    /// before a step. The label of the step seeds the random choices of selections.
    pub(crate) stream: String,
}

/// Whether a file has the extension `.ron`, which marks recipes.
pub(crate) fn is_recipe(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "ron")
}

/// The code that marks a note about a missing image.
const IMAGES: &str = "image-missing";

/// Loads the scene of a mesh file, or runs a recipe up to `stop`. The expectations of the recipe are not checked, and
/// no files are written. Missing images are not reported here. Only pictures need images, and missing images are
/// reported when a picture is drawn.
pub(crate) fn load_scene(
    path: &Path,
    options: &ReadOptions,
    values: &ValueArgs,
    stop: Stop,
    engine: &Engine,
) -> anyhow::Result<SceneAtStep> {
    if is_recipe(path) {
        return run_recipe(path, values, stop, engine);
    }
    if stop.after.is_some() || stop.before.is_some() || !values.is_empty() {
        let message = format!(
            "{} is not a recipe (*.ron), so it has no steps and no parameters",
            path.display()
        );
        return Err(WrongUsage(message).into());
    }
    let (scene, notes) = read_file(path, options)?;
    for note in notes.iter().filter(|note| note.code != IMAGES) {
        print_error(&format!("note: {note}\n"));
    }
    Ok(SceneAtStep {
        scene,
        stream: String::new(),
    })
}

/// Reads a mesh file. Returns the objects of the file as a scene, and notes on content that was left out or changed.
pub(crate) fn read_file(path: &Path, options: &ReadOptions) -> anyhow::Result<(Scene, Vec<Note>)> {
    expect_kind(path, FileKind::Mesh)?;
    let loaded = mesh_io::read(&Disk, path, options);
    let loaded = loaded.map_err(|error| anyhow::anyhow!("{error}"))?;
    into_scene(path, loaded)
}

/// Like [`read_file`], but reads standard input if `path` is `-`. `name` is the path that [`pipes::mesh_name`]
/// returned.
pub(crate) fn read_file_or_input(
    path: &Path,
    name: &Path,
    options: &ReadOptions,
) -> anyhow::Result<(Scene, Vec<Note>)> {
    if pipes::is_pipe(path) {
        into_scene(name, pipes::read_mesh(name, options)?)
    } else {
        read_file(path, options)
    }
}

fn into_scene(path: &Path, loaded: mesh_io::Loaded) -> anyhow::Result<(Scene, Vec<Note>)> {
    let mut scene = Scene::new();
    let appended = scene.append(loaded.objects, loaded.graph);
    appended.with_context(|| format!("cannot use {}", path.display()))?;
    Ok((scene, loaded.notes))
}

fn run_recipe(
    path: &Path,
    values: &ValueArgs,
    stop: Stop,
    engine: &Engine,
) -> anyhow::Result<SceneAtStep> {
    let shown = path.display();
    let mut loaded = load_recipe(
        path,
        values,
        Path::new("out"),
        Checking::for_budget(BUDGET),
        engine,
    )?;
    print_diagnostics(&loaded, &loaded.diagnostics);
    anyhow::ensure!(!loaded.has_errors(), "{shown} cannot be run");
    let stream = loaded.stop(stop).map_err(|e| WrongUsage(e.to_string()))?;

    catch_interrupts();
    let terminal = Terminal::new();
    let outcome = loaded.run(Run::default(), &terminal);
    terminal.clear();
    print_diagnostics(&loaded, &outcome.failures);
    anyhow::ensure!(!outcome.cancelled, "interrupted");
    anyhow::ensure!(outcome.succeeded(), "{shown} failed");
    Ok(SceneAtStep {
        scene: outcome
            .scene
            .expect("a run without a cache returns its final scene"),
        stream,
    })
}
