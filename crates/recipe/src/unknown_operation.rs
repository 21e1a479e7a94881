//! Suggestions for the name of an unknown operation.

use op::Registry;

use crate::recipe::Kind;
use crate::schema_check::{listed, nearest};

/// Words for boolean operations on solids. Meshwright does not have such operations yet.
const BOOLEANS: &[&str] = &[
    "boolean",
    "csg",
    "difference",
    "intersect",
    "intersection",
    "subtract",
    "union",
];

/// Returns the help text of an error about the unknown operation `name`. The text suggests at most three operations.
/// Operations with a similar name come first, then other operations whose [`words`](op::Entry::words) contain a word of
/// `name`. If there are such other operations, at most one operation with a similar name is suggested. If neither rule
/// finds an operation, the text suggests operations whose names share a word with `name`. If there is nothing to
/// suggest, the text names the command that lists all operations.
///
/// If `name` contains a word for a boolean operation, the help text says that there are no boolean operations. The text
/// then names operations that can be used instead.
pub fn suggest_operations(name: &str, registry: &Registry) -> String {
    let entries = registry.entries();
    let known = entries.iter().map(|entry| entry.name);
    let known = known.chain(Kind::ALL.map(Kind::name));
    let mut suggestions = nearest(name, known.clone());
    let words = words(name);
    let is_known = |name: &&str| known.clone().any(|known| known == *name);
    if words.iter().any(|word| BOOLEANS.contains(&word.as_str())) {
        let mut nearest = [
            (
                "Join",
                "combines objects without intersecting their surfaces",
            ),
            ("Bisect", "cuts a mesh at a plane"),
        ]
        .iter()
        .filter(|(name, _)| is_known(name))
        .map(|(name, what)| format!("`{name}` {what}"));
        let mut text = "Meshwright has no boolean operations yet".to_owned();
        for (i, what) in nearest.by_ref().enumerate() {
            text += if i == 0 { ": " } else { ", and " };
            text += &what;
        }
        return text;
    }
    let is_also_called = |entry_words: &[&str]| {
        words
            .iter()
            .any(|word| entry_words.contains(&word.as_str()))
    };
    let also_called = entries.iter().filter(|entry| is_also_called(entry.words));
    let mut also_called: Vec<&str> = also_called.map(|entry| entry.name).collect();
    also_called.retain(|name| !suggestions.contains(name));
    if !also_called.is_empty() {
        // A similar name is only a guess, so only the most similar name is kept.
        suggestions.truncate(1);
    }
    suggestions.extend(also_called);
    if suggestions.is_empty() {
        let shares_word = |name: &str| self::words(name).iter().any(|word| words.contains(word));
        suggestions.extend(known.filter(|name| shares_word(name)));
    }
    suggestions.truncate(3);
    if suggestions.is_empty() {
        "`meshwright ops` lists all operations".to_owned()
    } else {
        format!("did you mean {}?", listed(suggestions))
    }
}

/// Returns the words of a name such as `FlipEdges`, `flip_edges` or `flip-edges`, in lower case.
fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    for c in name.chars().take(64) {
        if c.is_uppercase() || !c.is_alphanumeric() {
            words.push(String::new());
        }
        if let Some(word) = words.last_mut().filter(|_| c.is_alphanumeric()) {
            word.extend(c.to_lowercase());
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hint_for_a_boolean_operation_says_that_there_are_none() {
        let registry = Registry::new();
        for name in ["Boolean", "union", "SubtractMesh", "mesh_difference"] {
            let help = suggest_operations(name, &registry);
            assert_eq!(help, "Meshwright has no boolean operations yet", "{name}");
        }
    }

    #[test]
    fn names_are_split_into_words() {
        assert_eq!(words("FlipEdges"), ["flip", "edges"]);
        assert_eq!(words("flip_edges-now"), ["flip", "edges", "now"]);
        assert!(words("_").is_empty());
    }
}
