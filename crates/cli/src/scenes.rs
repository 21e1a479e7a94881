//! From the path of a file to a scene: what a file of meshes holds, or what a recipe makes.

use std::path::Path;

use anyhow::Context as _;
use mesh_io::ReadOptions;
use op::Registry;
use recipe::RecipeStep;
use recipe::shape::did_you_mean;
use scene::Scene;

use crate::WrongUsage;
use crate::args::ValueArgs;
use crate::listener::{Terminal, catch_interrupts};
use crate::loading::load_recipe;
use crate::output::{complain, show};

/// Where a recipe stops.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Stop<'a> {
    /// After the step or call of this id, or of this label; after its last turn.
    pub(crate) after: Option<&'a str>,
    /// Before the step or call of this id, or of this label; before its first turn.
    pub(crate) before: Option<&'a str>,
}

/// A scene, and what it takes to ask it as a step would.
pub(crate) struct Found {
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
    registry: &Registry,
) -> anyhow::Result<Found> {
    if is_recipe(path) {
        return run(path, values, stop, registry);
    }
    if stop.after.is_some() || stop.before.is_some() || !values.is_empty() {
        let message = format!(
            "{} is no recipe (*.ron): it has neither steps nor parameters",
            path.display()
        );
        return Err(WrongUsage(message).into());
    }
    let loaded =
        mesh_io::read(&store::Disk, path, options).map_err(|error| anyhow::anyhow!("{error}"))?;
    for note in &loaded.notes {
        complain(&format!("note: {note}\n"));
    }
    let mut scene = Scene::new();
    for object in loaded.objects {
        scene
            .insert(object)
            .with_context(|| format!("cannot use {}", path.display()))?;
    }
    Ok(Found {
        scene,
        stream: String::new(),
    })
}

fn run(path: &Path, values: &ValueArgs, stop: Stop, registry: &Registry) -> anyhow::Result<Found> {
    let shown = path.display();
    let mut loaded = load_recipe(path, values, Path::new("out"), BUDGET, registry)?;
    show(&loaded, &loaded.diagnostics);
    anyhow::ensure!(!loaded.has_errors(), "{shown} cannot run");
    let steps = &loaded.recipe.steps;
    let is_meant = |step: &RecipeStep, id: &str| {
        let is_in_call = || {
            step.label
                .strip_prefix(id)
                .is_some_and(|rest| rest.starts_with('/'))
        };
        step.label == id || (step.scope == 0 && step.id.as_deref() == Some(id)) || is_in_call()
    };
    let unknown = |id: &str| {
        let known = steps.iter().filter_map(|step| step.id.as_deref());
        let help = did_you_mean(id, known);
        WrongUsage(format!("no step of {shown} has the id \"{id}\": {help}"))
    };
    let (mut n, mut stream) = (steps.len(), String::new());
    if let Some(id) = stop.after {
        let place = steps.iter().rposition(|step| is_meant(step, id));
        n = place.ok_or_else(|| unknown(id))? + 1;
    }
    if let Some(id) = stop.before {
        let place = steps.iter().position(|step| is_meant(step, id));
        n = place.ok_or_else(|| unknown(id))?;
        steps[n].label().clone_into(&mut stream);
    }
    loaded.recipe.steps.truncate(n);
    loaded.recipe.expectations.clear();

    catch_interrupts();
    let terminal = Terminal::new();
    let settings = loaded.settings(BUDGET);
    let outcome = recipe::run(&loaded.recipe, settings, &terminal);
    terminal.clear();
    show(&loaded, &outcome.failures);
    anyhow::ensure!(!outcome.cancelled, "interrupted");
    anyhow::ensure!(outcome.succeeded(), "{shown} failed");
    Ok(Found {
        scene: outcome.scene.expect("a run without a cache has its scene"),
        stream,
    })
}

/// The memory that meshes may take.
pub(crate) const BUDGET: u64 = 8 << 30;
