//! Failure capsules: folders with a recipe and a scene that reproduce the failure of a step.
//!
//! ```text
//! capsule/recipe.ron     loads before.mws, then runs the step that failed and the steps after it
//! capsule/before.mws     the scene before that step, bit for bit
//! ```
//!
//! `recipe.ron` is an ordinary recipe without parameters, calls or repetitions. Each parameter is replaced by its
//! value, and each call and each repetition by the steps inside it. Each step keeps its label. The label seeds random
//! choices, so the step makes the same choices as in the original run. The files that the steps read are not copied:
//! `recipe.ron` refers to their original locations.

use std::path::{Path, PathBuf};

use store::Store;

use crate::params::Rebase;
use crate::read::VERSION;
use crate::recipe::{Recipe, RecipeStep};
use crate::source::rebase_path;
use ron_tree::{Span, Value, ValueKind, string_literal};

/// The file name of the scene in a capsule.
pub const BEFORE: &str = "before.mws";

/// Returns the text of the recipe for a failure capsule in `folder`. The text contains the steps of `recipe`, starting
/// with the step at the index `from`. `message` is the error with which this step failed. `inputs` are the files that
/// `recipe` reads.
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
    // The scene before the first step is empty, so a failure capsule for the first step loads no scene.
    if from > 0 {
        text += &format!("        Load(path: {}),\n", string_literal(BEFORE));
    }
    for step in &recipe.steps[from.min(recipe.steps.len())..] {
        let source = &recipe.sources[recipe.source_of(step.scope)];
        let mut value = step.value.clone();
        let folders = Rebase {
            from: source.folder(),
            to: folder,
            store,
        };
        rebase_inputs(&mut value, folders, inputs);
        text += &format!("        {},\n", line(step, &value));
    }
    text + "    ],\n)\n"
}

/// Returns the RON text of a step, as it is written in a recipe.
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
    if step.on_loss != crate::OnLoss::default() {
        fields.push(format!("on_loss: {}", op::to_ron(&step.on_loss)));
    }
    if fields.len() == 1 {
        return value.to_string();
    }
    format!("({})", fields.join(", "))
}

impl Rebase<'_> {
    /// Returns the edits that rewrite the relative paths of input files in the text of a recipe. The new paths are
    /// relative to the folder `to` instead of `from`. `value` is the syntax tree of this text, and `inputs` are the
    /// files that the recipe reads.
    pub fn edits(&self, value: &Value, inputs: &[PathBuf]) -> Vec<(Span, String)> {
        let mut edits = Vec::new();
        let mut values = vec![value.clone()];
        while let Some(mut value) = values.pop() {
            if let ValueKind::String(text) = &value.kind {
                if Path::new(&**text).is_relative() && inputs.contains(&self.from.join(&**text)) {
                    let path = rebase_path(self.store, text, self.from, self.to);
                    let path = path.to_string_lossy().replace('\\', "/");
                    edits.push((value.span, string_literal(&path)));
                }
            } else {
                value.for_each_part(|part| values.push(part.clone()));
            }
        }
        edits
    }
}

/// Rewrites the paths of input files. A path relative to `folders.from` becomes a path relative to `folders.to`.
fn rebase_inputs(value: &mut Value, folders: Rebase, inputs: &[PathBuf]) {
    match &mut value.kind {
        ValueKind::String(text) if inputs.contains(&folders.from.join(&**text)) => {
            let path = rebase_path(folders.store, text, folders.from, folders.to);
            *text = path.to_string_lossy().into();
        }
        _ => value.for_each_part(|part| rebase_inputs(part, folders, inputs)),
    }
}
