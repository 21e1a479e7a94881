//! The steps of the last run of a recipe. The cache compares the steps of the last run with the current steps to
//! explain why a step runs again.

use std::path::PathBuf;

use recipe::RerunReason;
use serde::{Deserialize, Serialize};

use crate::folder::{Folder, Hash, Kind};
use crate::key::{Ingredients, digest};
use crate::record::{load_data, store_data};

/// A step of the last run.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub(crate) struct PastStep {
    pub(crate) ingredients: Ingredients,
    /// The path of an input file whose state is unknown, and the reason why it is unknown. Such a file prevents the
    /// result of the step from being stored.
    pub(crate) unknown_input: Option<(PathBuf, String)>,
}

/// The steps of the last run of a recipe, and the steps of the current run.
#[derive(Debug, Default)]
pub(crate) struct History {
    id: Option<Hash>,
    last_run: Vec<PastStep>,
    this_run: Vec<PastStep>,
}

impl History {
    /// Loads the history of a recipe. The history is empty if `recipe` is `None` or has not run before.
    pub(crate) fn load(folder: &Folder, recipe: Option<&std::path::Path>) -> Self {
        let absolute = recipe.map(|path| std::path::absolute(path).unwrap_or_else(|_| path.into()));
        let id = absolute.map(|path| digest("recipe", &path.as_os_str().as_encoded_bytes()));
        Self {
            last_run: id
                .and_then(|id| load_data(folder, Kind::Recipe, &id).ok())
                .unwrap_or_default(),
            id,
            this_run: Vec::new(),
        }
    }

    /// Adds a step of this run.
    pub(crate) fn push(
        &mut self,
        ingredients: Ingredients,
        unknown_input: Option<(PathBuf, String)>,
    ) {
        self.this_run.push(PastStep {
            ingredients,
            unknown_input,
        });
    }

    /// Stores the steps of this run. If this run reached only the first n steps, the later steps of the last run are
    /// kept.
    pub(crate) fn store(&mut self, folder: &Folder) {
        let Some(id) = self.id else { return };
        let n = self.this_run.len();
        let (this_run, last_run) = (
            std::mem::take(&mut self.this_run),
            std::mem::take(&mut self.last_run),
        );
        if this_run != last_run {
            let unreached = last_run.into_iter().skip(n);
            let all: Vec<PastStep> = this_run.into_iter().chain(unreached).collect();
            store_data(folder, Kind::Recipe, &id, &all);
        }
    }

    /// Returns the reason why the cache has no record for the key of the current step. If an earlier step of this run
    /// made later steps run again, `rerun` is the number and the label of that earlier step.
    pub(crate) fn why(&self, now: &Ingredients, rerun: Option<(usize, String)>) -> RerunReason {
        let index = self.this_run.len();
        let is_same_step = |past: &&PastStep| {
            past.ingredients.operation == now.operation && past.ingredients.stream == now.stream
        };
        let past = self.last_run.get(index).filter(is_same_step);
        let past = past.or_else(|| self.last_run.iter().find(is_same_step));
        // The label of a step can differ between two runs. If no step of the last run has this operation and this
        // label, the step at this index counts as the same step if it has this operation.
        let is_same_operation = |past: &&PastStep| past.ingredients.operation == now.operation;
        let past = past.or_else(|| self.last_run.get(index).filter(is_same_operation));
        let Some(past) = past else {
            return RerunReason::New;
        };
        let why = past.ingredients.difference(now, rerun);
        why.unwrap_or_else(|| match &past.unknown_input {
            Some((path, why)) => RerunReason::Unknown(path.clone(), why.clone()),
            None => RerunReason::Gone,
        })
    }
}

impl Ingredients {
    /// Returns the first difference between a step of the last run and the current step.
    fn difference(&self, now: &Self, rerun: Option<(usize, String)>) -> Option<RerunReason> {
        Some(if self.program != now.program {
            RerunReason::Program
        } else if self.version != now.version {
            RerunReason::Version {
                from: self.version,
                to: now.version,
            }
        } else if self.parameters != now.parameters {
            RerunReason::Parameters(parameter_changes(&self.parameters, &now.parameters))
        } else if self.on != now.on {
            RerunReason::On
        } else if self.stream != now.stream {
            RerunReason::Id
        } else if self.refused != now.refused {
            RerunReason::Refused
        } else if self.budget != now.budget {
            RerunReason::Budget
        } else if self.before != now.before {
            rerun.map_or(RerunReason::Order, |(number, label)| {
                RerunReason::Earlier(number, label)
            })
        } else {
            return None;
        })
    }
}

/// Lists the parameters whose values differ, such as `levels 1 -> 2, at 0.5 -> 0.25`.
fn parameter_changes(from: &str, to: &str) -> String {
    let (from, to) = (ron_tree::parse(from).value, ron_tree::parse(to).value);
    let name = |field: &ron_tree::Field| field.name.text.to_string();
    let mut names: Vec<String> = from.fields().iter().map(name).collect();
    for added in to.fields().iter().map(name) {
        if !names.contains(&added) {
            names.push(added);
        }
    }
    let text = |value: Option<&ron_tree::Value>| {
        // Optional values are written as in recipes, without `Some`.
        let value = value.map(|value| value.some().unwrap_or(value));
        value.map_or_else(|| "nothing".to_owned(), ToString::to_string)
    };
    let changed = names.iter().filter_map(|name| {
        let (from, to) = (text(from.field(name)), text(to.field(name)));
        let (from_short, to_short) = (short(&from), short(&to));
        if from == to {
            None
        } else if from_short == to_short {
            // Both values are long and begin with the same characters, so only the name of the parameter is given.
            Some(name.clone())
        } else {
            Some(format!("{name} {from_short} -> {to_short}"))
        }
    });
    changed.collect::<Vec<_>>().join(", ")
}

/// Shortens a long text.
fn short(text: &str) -> String {
    const MAX_CHARS: usize = 40;
    let mut chars = text.chars();
    let mut short: String = chars.by_ref().take(MAX_CHARS).collect();
    if chars.next().is_some() {
        short.push_str("..");
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changed_parameters_are_named_with_their_values() {
        let changes = parameter_changes;
        assert_eq!(
            changes("(levels:1,at:0.5)", "(levels:2,at:0.5)"),
            "levels 1 -> 2"
        );
        assert_eq!(
            changes("(a:1,b:[1,2])", "(b:[1],c:\"x\")"),
            "a 1 -> nothing, b [1, 2] -> [1], c nothing -> \"x\""
        );
        assert_eq!(changes("(a:Some(1))", "(a:Some(2))"), "a 1 -> 2");
        assert_eq!(changes("(a:None)", "(a:Some(2))"), "a None -> 2");
        let long = |end: &str| format!("(text:\"{}{end}\")", "x".repeat(100));
        assert_eq!(changes(&long("a"), &long("b")), "text");
    }
}
