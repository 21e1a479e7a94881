//! Failure capsules: a folder with what is needed to see a step fail again.
//!
//! ```text
//! capsule/recipe.ron     loads before.mws, then the step that failed and those behind it
//! capsule/before.mws     the scene before that step, bit for bit
//! ```
//!
//! `recipe.ron` is a recipe like others: parameters are filled in, calls and repetitions are done. Steps keep
//! their labels, so that random choices are the same, and files are read from where they were.

use std::path::{Path, PathBuf};

use store::Store;

use crate::params::Move;
use crate::read::VERSION;
use crate::recipe::{Recipe, RecipeStep};
use crate::source::seen_from;
use ron_tree::{Value, ValueKind, string_literal};

/// The name of the scene in a capsule.
pub const BEFORE: &str = "before.mws";

/// The text of the recipe of a capsule in `folder`: the steps of `recipe` from number `from`, which failed
/// because of `message`. `inputs` are the files that the recipe reads.
pub fn capsule(
    recipe: &Recipe,
    from: usize,
    message: &str,
    inputs: &[PathBuf],
    (folder, store): (&Path, &dyn Store),
) -> String {
    let path = recipe.sources.first().map(|s| s.path.display().to_string());
    let path = path.unwrap_or_default();
    let label = recipe.steps.get(from).map_or("", RecipeStep::label);
    let program = concat!("meshwright ", env!("CARGO_PKG_VERSION"));
    let about = format!("{program}: the step {label} of {path} failed: {message}");
    let mut text = format!(
        "(\n    recipe: {VERSION},\n    about: {},\n",
        string_literal(&about)
    );
    text += "    steps: [\n";
    // In an empty scene nothing has to be loaded.
    if from > 0 {
        text += &format!("        Load(path: {}),\n", string_literal(BEFORE));
    }
    for step in &recipe.steps[from.min(recipe.steps.len())..] {
        let source = &recipe.sources[recipe.source_of(step.scope)];
        let mut value = step.value.clone();
        let folders = Move {
            from: source.folder(),
            to: folder,
            store,
        };
        lead(&mut value, folders, inputs);
        text += &format!("        {},\n", line(step, &value));
    }
    text + "    ],\n)\n"
}

/// The step as it stands in a recipe.
fn line(step: &RecipeStep, value: &Value) -> String {
    let mut fields = Vec::new();
    if step.label != step.name {
        fields.push(format!("id: {}", string_literal(&step.label)));
    }
    fields.push(format!("run: {value}"));
    if let Some(on) = step.on_names() {
        let names: Vec<String> = on.iter().map(|name| string_literal(name)).collect();
        fields.push(format!("on: [{}]", names.join(", ")));
    }
    if let Some(refused) = step.refused {
        fields.push(format!("refused: {refused:?}"));
    }
    if step.on_loss != crate::OnLoss::default()
        && let Ok(on_loss) = ron::to_string(&step.on_loss)
    {
        fields.push(format!("on_loss: {on_loss}"));
    }
    if fields.len() == 1 {
        return value.to_string();
    }
    format!("({})", fields.join(", "))
}

/// Leads the paths of files that are read from one folder to another.
fn lead(value: &mut Value, folders: Move, inputs: &[PathBuf]) {
    match &mut value.kind {
        ValueKind::String(text) if inputs.contains(&folders.from.join(&**text)) => {
            let path = seen_from(folders.store, text, folders.from, folders.to);
            *text = path.to_string_lossy().into();
        }
        _ => value.for_each_part(|part| lead(part, folders, inputs)),
    }
}
