//! Where a recipe stops.

use recipe::{RecipeStep, did_you_mean};

use crate::Loaded;

/// Where a recipe stops. By default it does not.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stop<'a> {
    /// After the step or call of this id, or of this label; after its last turn.
    pub after: Option<&'a str>,
    /// Before the step or call of this id, or of this label; before its first turn.
    pub before: Option<&'a str>,
}

/// No step of the recipe has this id.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no step of {path} has the id \"{id}\": {help}")]
pub struct UnknownStep {
    /// The recipe.
    pub path: String,
    /// The id.
    pub id: String,
    /// The nearest ids.
    pub help: String,
}

impl Loaded {
    /// Cuts the recipe off where it stops, and its expectations away. Returns what keys the random choices of the step
    /// that it stopped before; empty if there is none.
    ///
    /// # Errors
    ///
    /// [`UnknownStep`]
    pub fn stop(&mut self, stop: Stop) -> Result<String, UnknownStep> {
        let steps = &self.recipe.steps;
        let unknown = |id: &str| {
            let known = steps.iter().filter_map(|step| step.id.as_deref());
            UnknownStep {
                path: self.path.clone(),
                id: id.to_owned(),
                help: did_you_mean(id, known),
            }
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
        self.recipe.steps.truncate(n);
        self.recipe.expectations.clear();
        Ok(stream)
    }
}

/// Whether a step has the id or the label, or is part of a call that has it.
fn is_meant(step: &RecipeStep, id: &str) -> bool {
    let inside = step.label.strip_prefix(id);
    step.label == id
        || (step.scope == 0 && step.id.as_deref() == Some(id))
        || inside.is_some_and(|rest| rest.starts_with('/'))
}
