//! `meshwright diff --runs`: two recorded runs, as `run --format json` prints them: an event a line.

use std::path::Path;

use anyhow::Context as _;
use serde_json::{Map, Value as Json, json};

use crate::args::{Format, WrongUsage};
use crate::output::{print, print_json};

/// What may differ between runs of one recipe: times, what was taken from earlier runs, where it ran.
const APART: [&str; 4] = ["milliseconds", "cached", "ran_because", "file"];

/// The events that are read are of this version.
const FORMAT: u64 = 1;

/// A recorded run.
struct Run {
    /// The parameters of the recipe.
    parameters: Vec<Json>,
    /// What each step did.
    steps: Vec<Json>,
    /// What went wrong, and the end.
    end: Vec<Json>,
}

/// A thing that differs: what it is, and what either run says of it.
type Differing<'j> = (String, &'j Json, &'j Json);

pub(crate) fn run(first: &Path, second: &Path, format: Format) -> anyhow::Result<bool> {
    let (a, b) = (Run::read(first)?, Run::read(second)?);
    let parameters = a.other_parameters(&b);
    let (place, differing) = a.first_difference(&b);
    let equal = place.is_none();
    if format == Format::Json {
        let list = |differing: &[Differing]| -> Vec<Json> {
            let one = |(what, a, b): &Differing| json!({ "what": what, "first": a, "second": b });
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
        let mut is_whole = false;
        for (i, line) in text.lines().enumerate() {
            let event: Json = serde_json::from_str(line).map_err(|error| {
                let help = "meshwright run RECIPE --format json records one";
                WrongUsage(format!(
                    "{shown}:{}: no event of a run: {error}; {help}",
                    i + 1
                ))
            })?;
            match event["event"].as_str() {
                Some("start") => {
                    let version = event["format"].as_u64().unwrap_or(0);
                    if version > FORMAT {
                        let message = format!("{shown} is of version {version}, expected {FORMAT}");
                        return Err(
                            WrongUsage(format!("{message}: a newer meshwright wrote it")).into(),
                        );
                    }
                    let parameters = event["parameters"].as_array();
                    run.parameters
                        .extend(parameters.into_iter().flatten().cloned());
                }
                Some("done") => run.steps.push(event),
                Some("problem") => run.end.push(event),
                Some("end") => {
                    is_whole = true;
                    run.end.push(event);
                }
                // Progress, and what newer programs tell besides.
                _ => {}
            }
        }
        if !is_whole {
            let help = "meshwright run RECIPE --format json records one";
            let message = format!("{shown} is no whole record of a run, it has no end; {help}");
            return Err(WrongUsage(message).into());
        }
        Ok(run)
    }

    /// The parameters of both runs whose values differ.
    fn other_parameters<'j>(&'j self, other: &'j Self) -> Vec<Differing<'j>> {
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

    /// Where the runs differ first, and in what; nothing if they do not.
    fn first_difference<'j>(&'j self, other: &'j Self) -> (Option<String>, Vec<Differing<'j>>) {
        for (i, (step, their)) in self.steps.iter().zip(&other.steps).enumerate() {
            let differing = fields(step, their);
            if !differing.is_empty() {
                let label = step["label"].as_str().unwrap_or("?");
                return (Some(format!("step {}, {label}", i + 1)), differing);
            }
        }
        let (n, m) = (self.steps.len(), other.steps.len());
        if n != m {
            let longer = if n > m { self } else { other };
            let label = longer.steps[n.min(m)]["label"].as_str().unwrap_or("?");
            let place = format!("step {}, {label}, that only one run has", n.min(m) + 1);
            return (Some(place), Vec::new());
        }
        for (event, their) in self.end.iter().zip(&other.end) {
            let differing = fields(event, their);
            if !differing.is_empty() {
                return (Some("the end".to_owned()), differing);
            }
        }
        let same = self.end.len() == other.end.len();
        ((!same).then(|| "the end".to_owned()), Vec::new())
    }
}

/// What differs between two events. What only one of them knows is no difference: the other may be older.
fn fields<'j>(a: &'j Json, b: &'j Json) -> Vec<Differing<'j>> {
    let names = a.as_object().into_iter().flat_map(Map::keys);
    names
        .filter(|name| !APART.contains(&name.as_str()))
        .filter_map(|name| Some((name.clone(), a.get(name)?, b.get(name)?)))
        .filter(|(_, a, b)| a != b && !a.is_null() && !b.is_null())
        .collect()
}
