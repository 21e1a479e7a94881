//! `meshwright diff --runs`: two recorded runs, as `run --format json` prints them.

use std::path::Path;

use anyhow::Context as _;
use serde_json::{Map, Value as Json, json};

use crate::WrongUsage;
use crate::args::Format;
use crate::output::print;

/// What may differ between runs of one recipe: times, and what was taken from earlier runs.
const APART: [&str; 6] = ["milliseconds", "time", "cached", "cache", "reused", "why"];

/// What is compared when all steps are equal.
const END: [&str; 6] = [
    "succeeded",
    "cancelled",
    "expectations",
    "digest",
    "failures",
    "written",
];

/// A thing that differs: what it is, and what either run says of it.
type Differing<'j> = (String, &'j Json, &'j Json);

pub(crate) fn run(first: &Path, second: &Path, format: Format) -> anyhow::Result<bool> {
    let (a, b) = (read(first)?, read(second)?);
    let (place, differing) = first_difference(&a, &b);
    let equal = differing.is_empty();
    if format == Format::Json {
        let fields: Vec<Json> = differing
            .iter()
            .map(|(what, a, b)| json!({ "what": what, "first": a, "second": b }))
            .collect();
        let report = json!({ "equal": equal, "at": place, "differs": fields });
        print(&format!("{report:#}\n"))?;
        return Ok(equal);
    }
    if equal {
        print("the runs are equal\n")?;
        return Ok(true);
    }
    let mut text = format!("first difference: {}\n", place.unwrap_or_default());
    for (what, a, b) in &differing {
        text += &format!("  {what}\n    {a}\n    {b}\n");
    }
    print(&text)?;
    Ok(false)
}

fn read(path: &Path) -> anyhow::Result<Json> {
    let shown = path.display();
    let text = std::fs::read_to_string(path).with_context(|| format!("cannot read {shown}"))?;
    let json: Json =
        serde_json::from_str(&text).with_context(|| format!("{shown} is no JSON text"))?;
    if !json.is_object() || !json["steps"].is_array() {
        let message = format!(
            "{shown} is no record of a run: meshwright run RECIPE --format json prints one"
        );
        return Err(WrongUsage(message).into());
    }
    Ok(json)
}

/// Where the runs differ first, and in what.
fn first_difference<'j>(a: &'j Json, b: &'j Json) -> (Option<String>, Vec<Differing<'j>>) {
    let steps = |run: &'j Json| run["steps"].as_array().map_or(&[][..], Vec::as_slice);
    let (ours, theirs) = (steps(a), steps(b));
    for (i, (step, other)) in ours.iter().zip(theirs).enumerate() {
        let differing = fields(step, other);
        if !differing.is_empty() {
            let name = step["step"].as_str().unwrap_or("?");
            return (Some(format!("step {}, {name}", i + 1)), differing);
        }
    }
    if ours.len() != theirs.len() {
        let at = ours.len().min(theirs.len());
        let none = &Json::Null;
        let [step, other] = [ours, theirs].map(|steps| steps.get(at).map_or(none, |s| &s["step"]));
        let place = format!("step {}, that only one run has", at + 1);
        return (Some(place), vec![("step".to_owned(), step, other)]);
    }
    let differing: Vec<_> = END
        .into_iter()
        .filter_map(|key| Some((key.to_owned(), a.get(key)?, b.get(key)?)))
        .filter(|(_, a, b)| a != b)
        .collect();
    let place = (!differing.is_empty()).then(|| "the end".to_owned());
    (place, differing)
}

/// What differs in a step. What only one record has is no difference: the other may be older.
fn fields<'j>(a: &'j Json, b: &'j Json) -> Vec<Differing<'j>> {
    let names = a.as_object().map(Map::keys);
    names
        .into_iter()
        .flatten()
        .filter(|name| !APART.contains(&name.as_str()))
        .filter_map(|name| Some((name.clone(), a.get(name)?, b.get(name)?)))
        .filter(|(_, a, b)| a != b)
        .collect()
}
