//! Shortens a recipe so that it stops after or before a given step.

use recipe::{RecipeStep, did_you_mean};

use crate::Loaded;

/// Where a recipe stops. By default, the recipe runs to the end. If both fields are set, the recipe stops at
/// `before`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stop<'a> {
    /// Stop after the step or call with this id or label. If the step or call is repeated, stop after its last
    /// repetition.
    pub after: Option<&'a str>,
    /// Stop before the step or call with this id or label. If the step or call is repeated, stop before its first
    /// repetition.
    pub before: Option<&'a str>,
}

/// No step or call of the recipe has the given id or label.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no step of {path} has the id \"{id}\": {help}")]
pub struct UnknownStep {
    /// The path of the recipe.
    pub path: String,
    /// The given id or label, which no step or call has.
    pub id: String,
    /// The most similar ids, or the known ids if none is similar.
    pub help: String,
}

impl Loaded {
    /// Removes the steps after the stopping point, and all expectations of the recipe. Returns the label of the step
    /// that [`Stop::before`] names. If [`Stop::before`] names a call, returns the label of the first step of this call.
    /// The returned label seeds the random choices of the step. If [`Stop::before`] is `None`, returns an empty string.
    ///
    /// # Errors
    ///
    /// Returns [`UnknownStep`] if no step or call has the id or label.
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
            let place = steps.iter().rposition(|step| is_match(step, id));
            n = place.ok_or_else(|| unknown(id))? + 1;
        }
        if let Some(id) = stop.before {
            let place = steps.iter().position(|step| is_match(step, id));
            n = place.ok_or_else(|| unknown(id))?;
            steps[n].label().clone_into(&mut stream);
        }
        self.recipe.steps.truncate(n);
        self.recipe.expectations.clear();
        Ok(stream)
    }
}

/// Whether `id` is the id or the label of a step, or the label of a call that contains the step.
fn is_match(step: &RecipeStep, id: &str) -> bool {
    let inside = step.label.strip_prefix(id);
    step.label == id
        || (step.scope == 0 && step.id.as_deref() == Some(id))
        || inside.is_some_and(|rest| rest.starts_with('/'))
}
