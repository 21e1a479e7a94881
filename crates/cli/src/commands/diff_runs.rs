//! `meshwright diff --runs`: compares two recorded runs. A recorded run is the output of `run --format json`, with one
//! event per line.

use std::path::Path;

use anyhow::Context as _;
use serde_json::{Map, Value as Json, json};

use crate::args::{Format, WrongUsage};
use crate::output::{print, print_json};

/// Fields that are not compared: times, cache use, and the path of the recipe.
const IGNORED_FIELDS: [&str; 4] = ["milliseconds", "cached", "ran_because", "file"];

/// The newest version of the event format that this program can read.
const FORMAT: u64 = 1;

/// A recorded run.
struct Run {
    /// The parameters of the recipe.
    parameters: Vec<Json>,
    /// The `done` event of each step.
    steps: Vec<Json>,
    /// The `problem` events and the `end` event.
    end: Vec<Json>,
}

/// The name of a value that differs between two runs, and the value in each run.
type ValuePair<'j> = (String, &'j Json, &'j Json);

pub(crate) fn run(first: &Path, second: &Path, format: Format) -> anyhow::Result<bool> {
    let (a, b) = (Run::read(first)?, Run::read(second)?);
    let parameters = a.differing_parameters(&b);
    let (place, differing) = a.first_difference(&b);
    let equal = place.is_none();
    if format == Format::Json {
        let list = |differing: &[ValuePair]| -> Vec<Json> {
            let one = |(what, a, b): &ValuePair| json!({ "what": what, "first": a, "second": b });
            differing.iter().map(one).collect()
        };
        print_json(&json!({
            "equal": equal, "at": place, "differs": list(&differing), "parameters": list(&parameters),
        }))?;
        return Ok(equal);
    }
    let mut text = String::new();
    for (name, a, b) in &parameters {
        text += &format!("parameter {name}: {a} and {b}\n");
    }
    match place {
        None => text += "the runs are equal\n",
        Some(place) => text += &format!("first difference: {place}\n"),
    }
    for (what, a, b) in &differing {
        text += &format!("  {what}\n    {a}\n    {b}\n");
    }
    print(&text)?;
    Ok(equal)
}

impl Run {
    fn read(path: &Path) -> anyhow::Result<Self> {
        let shown = path.display();
        let text = std::fs::read_to_string(path).with_context(|| format!("cannot read {shown}"))?;
        let mut run = Self {
            parameters: Vec::new(),
            steps: Vec::new(),
            end: Vec::new(),
        };
        let mut has_end = false;
        for (i, line) in text.lines().enumerate() {
            let event: Json = serde_json::from_str(line).map_err(|error| {
                let help = "to record a run, write the output of `meshwright run RECIPE --format json` to a file";
                WrongUsage(format!(
                    "{shown}:{}: not an event of a run: {error}; {help}",
                    i + 1
                ))
            })?;
            match event["event"].as_str() {
                Some("start") => {
                    let version = event["format"].as_u64().unwrap_or(0);
                    if version > FORMAT {
                        let message = format!(
                            "{shown} has version {version}, expected at most {FORMAT}: a newer version of meshwright wrote it"
                        );
                        return Err(WrongUsage(message).into());
                    }
                    let parameters = event["parameters"].as_array();
                    run.parameters
                        .extend(parameters.into_iter().flatten().cloned());
                }
                Some("done") => run.steps.push(event),
                Some("problem") => run.end.push(event),
                Some("end") => {
                    has_end = true;
                    run.end.push(event);
                }
                // Progress events and unknown events of newer versions are ignored.
                _ => {}
            }
        }
        if !has_end {
            let help = "to record a run, write the output of `meshwright run RECIPE --format json` to a file";
            let message = format!(
                "{shown} is not a complete record of a run: the event `end` is missing; {help}"
            );
            return Err(WrongUsage(message).into());
        }
        Ok(run)
    }

    /// Returns the parameters that exist in both runs but have different values.
    fn differing_parameters<'j>(&'j self, other: &'j Self) -> Vec<ValuePair<'j>> {
        let value = |parameter: &Json| {
            let theirs = other
                .parameters
                .iter()
                .find(|p| p["name"] == parameter["name"]);
            theirs.map(|p| &p["value"])
        };
        self.parameters
            .iter()
            .filter_map(|p| Some((p["name"].as_str()?.to_owned(), &p["value"], value(p)?)))
            .filter(|(_, a, b)| a != b)
            .collect()
    }

    /// Returns the first event in which the runs differ, if any, and the values that differ in that event.
    fn first_difference<'j>(&'j self, other: &'j Self) -> (Option<String>, Vec<ValuePair<'j>>) {
        for (i, (step, their)) in self.steps.iter().zip(&other.steps).enumerate() {
            let differing = differing_fields(step, their);
            if !differing.is_empty() {
                let label = step["label"].as_str().unwrap_or("?");
                return (Some(format!("step {}, {label}", i + 1)), differing);
            }
        }
        let (n, m) = (self.steps.len(), other.steps.len());
        if n != m {
            let longer = if n > m { self } else { other };
            let label = longer.steps[n.min(m)]["label"].as_str().unwrap_or("?");
            let place = format!(
                "step {}, {label} (only one run has this step)",
                n.min(m) + 1
            );
            return (Some(place), Vec::new());
        }
        for (event, their) in self.end.iter().zip(&other.end) {
            let differing = differing_fields(event, their);
            if !differing.is_empty() {
                return (Some("the end".to_owned()), differing);
            }
        }
        let same = self.end.len() == other.end.len();
        ((!same).then(|| "the end".to_owned()), Vec::new())
    }
}

/// Returns the fields that differ between two events. If only one of the two events has a field, this field is ignored,
/// because the other event can be from an older version of the program.
fn differing_fields<'j>(a: &'j Json, b: &'j Json) -> Vec<ValuePair<'j>> {
    let names = a.as_object().into_iter().flat_map(Map::keys);
    names
        .filter(|name| !IGNORED_FIELDS.contains(&name.as_str()))
        .filter_map(|name| Some((name.clone(), a.get(name)?, b.get(name)?)))
        .filter(|(_, a, b)| a != b && !a.is_null() && !b.is_null())
        .collect()
}
