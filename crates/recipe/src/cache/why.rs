//! Why a step ran and was not taken from the cache.

use std::fmt;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::folder::{Folder, Hash, Kind};
use super::key::{Ingredients, digest};
use super::record::{load_data, store_data};

/// Why a step ran. Shown as the end of a sentence that begins with "because".
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Why {
    /// There is no cache.
    NoCache,
    /// The cache knows no run of this step.
    New,
    /// Another version of the program, or another build of it.
    Program,
    /// The operation has another version.
    Version {
        /// The version then.
        from: u32,
        /// The version now.
        to: u32,
    },
    /// Parameters have other values: which, and what they were and are.
    Parameters(String),
    /// `on` names other objects.
    On,
    /// The id is another one, and keys the random choices.
    Id,
    /// `refused` is another one.
    Refused,
    /// The memory budget is another one.
    Budget,
    /// It reads from another folder.
    Folder,
    /// A file is not what it was.
    File(PathBuf, Change),
    /// The recipe or its parameters are others, and the files that the step writes say which.
    Provenance,
    /// The names of the files that the step writes are others.
    Outputs,
    /// An earlier step, by its number from 1 and its label, ran.
    Earlier(usize, String),
    /// There are other steps before it.
    Order,
    /// The cache does not have its result any more.
    Gone,
    /// Its result in the cache was damaged: how.
    Damaged(String),
    /// Its result was not stored: making it took less time than storing it would have.
    NotKept,
    /// What it depends on cannot be told: a file and the reason.
    Unknown(PathBuf, String),
    /// What it depends on cannot be told, because an earlier step has left a scene with removed elements.
    NoState,
}

/// What became of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// It has another content.
    Changed,
    /// It is not there any more.
    Gone,
    /// It was not there.
    Appeared,
}

impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoCache => f.write_str("there is no cache"),
            Self::New => f.write_str("it has not run before"),
            Self::Program => f.write_str("the program is another one"),
            Self::Version { from, to } => {
                write!(f, "the version of the operation changed: {from} -> {to}")
            }
            Self::Parameters(which) => write!(f, "parameters changed: {which}"),
            Self::On => f.write_str("`on` changed"),
            Self::Id => f.write_str("its id changed, which keys random choices"),
            Self::Refused => f.write_str("`refused` changed"),
            Self::Budget => f.write_str("the memory budget changed"),
            Self::Folder => f.write_str("it reads from another folder"),
            Self::File(path, change) => {
                let change = match change {
                    Change::Changed => "changed",
                    Change::Gone => "is gone",
                    Change::Appeared => "was not there before",
                };
                write!(f, "the file {} {change}", path.display())
            }
            Self::Provenance => {
                f.write_str("the recipe changed, and what is written says from which one it is")
            }
            Self::Outputs => f.write_str("the names of its outputs changed"),
            Self::Earlier(number, label) => write!(f, "step {number} {label} ran again"),
            Self::Order => f.write_str("there are other steps before it"),
            Self::Gone => f.write_str("its result is not in the cache any more"),
            Self::Damaged(how) => write!(f, "its result in the cache was damaged: {how}"),
            Self::NotKept => f.write_str(
                "its result was not stored: making it took less time than storing it would",
            ),
            Self::Unknown(path, why) => {
                write!(f, "what it read cannot be told: {}, {why}", path.display())
            }
            Self::NoState => f.write_str("what an earlier step has left cannot be told"),
        }
    }
}

/// A step of the last run.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct Past {
    pub(super) made_of: Ingredients,
    /// Why it was not stored.
    pub(super) unknown: Option<(PathBuf, String)>,
}

/// The steps of the last run of a recipe, and those of this one.
#[derive(Debug, Default)]
pub(super) struct History {
    id: Option<Hash>,
    past: Vec<Past>,
    now: Vec<Past>,
}

impl History {
    /// What is known of a recipe; nothing without one.
    pub(super) fn load(folder: &Folder, recipe: Option<&std::path::Path>) -> Self {
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
    pub(super) fn push(&mut self, made_of: Ingredients, unknown: Option<(PathBuf, String)>) {
        self.now.push(Past { made_of, unknown });
    }

    /// Stores the steps of this run, and behind them those of the last one that this one did not come to.
    pub(super) fn store(&mut self, folder: &Folder) {
        let Some(id) = self.id else { return };
        let n = self.now.len();
        let (now, past) = (
            std::mem::take(&mut self.now),
            std::mem::take(&mut self.past),
        );
        let is_same = now.len() >= past.len()
            && now
                .iter()
                .zip(&past)
                .all(|(a, b)| a.made_of == b.made_of && a.unknown == b.unknown)
            && now.len() == past.len();
        if !is_same {
            let all: Vec<Past> = now.into_iter().chain(past.into_iter().skip(n)).collect();
            store_data(folder, Kind::Recipe, &id, &all);
        }
    }

    /// Why a step has another key than in the last run; `ran` is the last earlier step that ran in this one, with
    /// its number.
    pub(super) fn why(&self, now: &Ingredients, ran: Option<(usize, String)>) -> Why {
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
            return Why::New;
        };
        let why = made_of.differs(now, ran);
        why.unwrap_or_else(|| match unknown {
            Some((path, why)) => Why::Unknown(path.clone(), why.clone()),
            None => Why::Gone,
        })
    }
}

impl Ingredients {
    /// In what the step of now differs from this one.
    fn differs(&self, now: &Self, ran: Option<(usize, String)>) -> Option<Why> {
        Some(if self.program != now.program {
            Why::Program
        } else if self.version != now.version {
            Why::Version {
                from: self.version,
                to: now.version,
            }
        } else if self.parameters != now.parameters {
            Why::Parameters(changes(&self.parameters, &now.parameters))
        } else if self.on != now.on {
            Why::On
        } else if self.stream != now.stream {
            Why::Id
        } else if self.refused != now.refused {
            Why::Refused
        } else if self.budget != now.budget {
            Why::Budget
        } else if self.before != now.before {
            ran.map_or(Why::Order, |(number, label)| Why::Earlier(number, label))
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
        value.map_or_else(|| "nothing".to_owned(), |value| short(&value.to_string()))
    };
    let changed = names.iter().filter_map(|name| {
        let (from, to) = (from.field(name), to.field(name));
        let (from, to) = (text(from), text(to));
        (from != to).then(|| format!("{name} {from} -> {to}"))
    });
    let changed: Vec<String> = changed.collect();
    if changed.is_empty() {
        // Long values that are alike at their beginning.
        let differs = |name: &&String| {
            let value = |value: &ron_tree::Value| value.field(name).map(ToString::to_string);
            value(&from) != value(&to)
        };
        let names: Vec<&str> = names.iter().filter(differs).map(String::as_str).collect();
        return names.join(", ");
    }
    changed.join(", ")
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
