//! The parameter sets of a batch. The file of `--sets` is a list of JSON objects. Each object has the values of one
//! parameter set:
//!
//! ```text
//! [
//!     {"levels": 1, "center": [0, 0, 1]},
//!     {"levels": 2, "name": "fine"}
//! ]
//! ```

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context as _, bail, ensure};
use recipe::{Parameter, did_you_mean};
use serde_json::Value as Json;

/// A set of parameter values with which the recipe is run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ParameterSet {
    /// The position of the parameter set in its file, counted from 1. The outputs of the parameter set are written to a
    /// folder that is named after this number.
    pub(super) number: usize,
    /// The values of the parameters, in the form in which `--set` expects them.
    pub(super) values: BTreeMap<String, String>,
}

/// Reads parameter sets. `is_given` returns whether a parameter already has a value.
///
/// # Errors
///
/// Returns an error if the file is not a list of objects. Also returns an error if a parameter does not exist, already
/// has a value, or gets a value of the wrong type.
pub(super) fn read(
    path: &Path,
    parameters: &[Parameter],
    is_given: impl Fn(&str) -> bool,
) -> anyhow::Result<Vec<ParameterSet>> {
    let shown = path.display();
    let text = std::fs::read_to_string(path).with_context(|| format!("cannot read {shown}"))?;
    let expected =
        "expected a list of objects with values of parameters, such as [{\"levels\": 1}]";
    let sets: Vec<BTreeMap<String, Json>> =
        serde_json::from_str(&text).with_context(|| format!("{shown}: {expected}"))?;
    ensure!(!sets.is_empty(), "{shown} is empty: {expected}");
    let mut all = Vec::with_capacity(sets.len());
    for (number, set) in (1..).zip(sets) {
        let mut values = BTreeMap::new();
        for (name, value) in set {
            let known = parameters.iter().map(|p| p.name.as_str());
            if !known.clone().any(|known| known == name) {
                let help = did_you_mean(&name, known);
                bail!("{shown}: set {number}: the recipe has no parameter `{name}`: {help}");
            }
            ensure!(
                !is_given(&name),
                "{shown}: set {number}: the parameter `{name}` already has a value from the command line"
            );
            let Some(text) = plain(&value) else {
                bail!(
                    "{shown}: set {number}: `{name}` is {value}, expected a number, a text, a Boolean or a list of numbers"
                );
            };
            values.insert(name, text);
        }
        all.push(ParameterSet { number, values });
    }
    Ok(all)
}

/// Returns a value in the form in which it is written on the command line.
fn plain(value: &Json) -> Option<String> {
    Some(match value {
        Json::String(text) => text.clone(),
        Json::Bool(_) | Json::Number(_) => value.to_string(),
        Json::Array(parts) => {
            let parts = parts
                .iter()
                .map(|part| part.is_number().then(|| part.to_string()));
            format!("({})", parts.collect::<Option<Vec<String>>>()?.join(", "))
        }
        Json::Null | Json::Object(_) => return None,
    })
}

/// Returns a text that names an input file and its parameter values, such as `cow.obj (levels = 2)`.
pub(super) fn label(path: &str, values: &BTreeMap<String, String>) -> String {
    let values: Vec<String> = values.iter().map(|(n, v)| format!("{n} = {v}")).collect();
    match (path, values.join(", ")) {
        (path, values) if values.is_empty() => path.to_owned(),
        ("", values) => values,
        (path, values) => format!("{path} ({values})"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_written_as_on_the_command_line() {
        for (json, text) in [
            ("1", Some("1")),
            ("0.5", Some("0.5")),
            ("true", Some("true")),
            ("\"a b\"", Some("a b")),
            ("[0, 0.5, 1]", Some("(0, 0.5, 1)")),
            ("[[1]]", None),
            ("null", None),
            ("{}", None),
        ] {
            let value = serde_json::from_str(json).unwrap();
            assert_eq!(plain(&value).as_deref(), text, "{json}");
        }
    }
}
