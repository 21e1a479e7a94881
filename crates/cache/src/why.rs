//! The steps of the last run of a recipe, to say why a step runs again.

use std::path::PathBuf;

use recipe::RerunReason;
use serde::{Deserialize, Serialize};

use crate::folder::{Folder, Hash, Kind};
use crate::key::{Ingredients, digest};
use crate::record::{load_data, store_data};

/// A step of the last run.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub(crate) struct Past {
    pub(crate) made_of: Ingredients,
    /// Why it was not stored.
    pub(crate) unknown: Option<(PathBuf, String)>,
}

/// The steps of the last run of a recipe, and those of this one.
#[derive(Debug, Default)]
pub(crate) struct History {
    id: Option<Hash>,
    past: Vec<Past>,
    now: Vec<Past>,
}

impl History {
    /// What is known of a recipe; nothing without one.
    pub(crate) fn load(folder: &Folder, recipe: Option<&std::path::Path>) -> Self {
        let absolute = recipe.map(|path| std::path::absolute(path).unwrap_or_else(|_| path.into()));
        let id = absolute.map(|path| digest("recipe", &path.as_os_str().as_encoded_bytes()));
        Self {
            past: id
                .and_then(|id| load_data(folder, Kind::Recipe, &id).ok())
                .unwrap_or_default(),
            id,
            now: Vec::new(),
        }
    }

    /// Adds a step of this run.
    pub(crate) fn push(&mut self, made_of: Ingredients, unknown: Option<(PathBuf, String)>) {
        self.now.push(Past { made_of, unknown });
    }

    /// Stores the steps of this run, and behind them those of the last one that this one did not come to.
    pub(crate) fn store(&mut self, folder: &Folder) {
        let Some(id) = self.id else { return };
        let n = self.now.len();
        let (now, past) = (
            std::mem::take(&mut self.now),
            std::mem::take(&mut self.past),
        );
        if now != past {
            let all: Vec<Past> = now.into_iter().chain(past.into_iter().skip(n)).collect();
            store_data(folder, Kind::Recipe, &id, &all);
        }
    }

    /// Why a step has another key than in the last run; `ran` is the last earlier step that ran in this one, with
    /// its number.
    pub(crate) fn why(&self, now: &Ingredients, ran: Option<(usize, String)>) -> RerunReason {
        let here = self.now.len();
        let is_it = |past: &&Past| {
            past.made_of.operation == now.operation && past.made_of.stream == now.stream
        };
        let past = self.past.get(here).filter(is_it);
        let past = past.or_else(|| self.past.iter().find(is_it));
        // A step that was given another id.
        let same_operation = |past: &&Past| past.made_of.operation == now.operation;
        let past = past.or_else(|| self.past.get(here).filter(same_operation));
        let Some(Past { made_of, unknown }) = past else {
            return RerunReason::New;
        };
        let why = made_of.differs(now, ran);
        why.unwrap_or_else(|| match unknown {
            Some((path, why)) => RerunReason::Unknown(path.clone(), why.clone()),
            None => RerunReason::Gone,
        })
    }
}

impl Ingredients {
    /// In what the step of now differs from this one.
    fn differs(&self, now: &Self, ran: Option<(usize, String)>) -> Option<RerunReason> {
        Some(if self.program != now.program {
            RerunReason::Program
        } else if self.version != now.version {
            RerunReason::Version {
                from: self.version,
                to: now.version,
            }
        } else if self.parameters != now.parameters {
            RerunReason::Parameters(changes(&self.parameters, &now.parameters))
        } else if self.on != now.on {
            RerunReason::On
        } else if self.stream != now.stream {
            RerunReason::Id
        } else if self.refused != now.refused {
            RerunReason::Refused
        } else if self.budget != now.budget {
            RerunReason::Budget
        } else if self.before != now.before {
            ran.map_or(RerunReason::Order, |(number, label)| {
                RerunReason::Earlier(number, label)
            })
        } else {
            return None;
        })
    }
}

/// The fields that differ: `levels 1 -> 2, at 0.5 -> 0.25`.
fn changes(from: &str, to: &str) -> String {
    let (from, to) = (ron_tree::parse(from).value, ron_tree::parse(to).value);
    let name = |field: &ron_tree::Field| field.name.text.to_string();
    let mut names: Vec<String> = from.fields().iter().map(name).collect();
    for added in to.fields().iter().map(name) {
        if !names.contains(&added) {
            names.push(added);
        }
    }
    let text = |value: Option<&ron_tree::Value>| {
        // As recipes have it.
        let value = value.map(|value| value.some().unwrap_or(value));
        value.map_or_else(|| "nothing".to_owned(), ToString::to_string)
    };
    let changed = names.iter().filter_map(|name| {
        let (from, to) = (text(from.field(name)), text(to.field(name)));
        let (from_short, to_short) = (short(&from), short(&to));
        if from == to {
            None
        } else if from_short == to_short {
            // Long values that are alike at their beginning.
            Some(name.clone())
        } else {
            Some(format!("{name} {from_short} -> {to_short}"))
        }
    });
    changed.collect::<Vec<_>>().join(", ")
}

/// The beginning of a text that may be long.
fn short(text: &str) -> String {
    const MOST: usize = 40;
    let mut chars = text.chars();
    let mut short: String = chars.by_ref().take(MOST).collect();
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
        let changes = |from, to| changes(from, to);
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
