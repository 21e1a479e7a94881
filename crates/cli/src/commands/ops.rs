//! `meshwright ops` and `meshwright expectations`: describe what recipes can contain. The descriptions are made from
//! the Rust types into which recipes are parsed.

use op::{Entry, Registry};
use recipe::{
    FieldDoc, TypeDoc, VariantDoc, did_you_mean, fields, step_kinds, suggest_operations, types,
};
use serde_json::{Value as Json, json};

use super::reference::reference;
use crate::args::{Format, OpsArgs};
use crate::output::{print, print_json};

/// Maximum length of the lines in a list of variants.
const WIDTH: usize = 100;

pub(crate) fn run(args: &OpsArgs, registry: &Registry) -> anyhow::Result<bool> {
    if args.format == Format::Json {
        let json = match &args.name {
            Some(name) => operation_json(name, registry)?,
            None => list_json(registry),
        };
        print_json(&json)?;
        return Ok(true);
    }
    let text = if args.markdown {
        reference(registry, args.pictures.as_deref())
    } else if args.selections {
        selections()
    } else if let Some(name) = &args.name {
        operation(name, registry)?
    } else {
        list(registry)
    };
    print(&text)?;
    Ok(true)
}

/// Prints the list of all expectations, or the description of one expectation and its fields.
pub(crate) fn expectations(name: Option<&str>) -> anyhow::Result<bool> {
    let all = recipe::expectations();
    let Some(name) = name else {
        let text = variants_text(&all, "");
        print(&format!(
            "{text}\n`meshwright expectations NAME` describes one expectation.\n"
        ))?;
        return Ok(true);
    };
    let Some(one) = all.iter().find(|one| one.name == name) else {
        let known = all.iter().map(|one| one.name.as_str());
        anyhow::bail!(
            "unknown expectation `{name}`: {}",
            did_you_mean(name, known)
        );
    };
    let mut text = format!("{}\n\n{}\n", one.written, one.doc);
    if !one.fields.is_empty() {
        text += "\nFields:\n";
    }
    text.extend(one.fields.iter().map(|field| field_text(field, "  ")));
    print(&text)?;
    Ok(true)
}

fn list(registry: &Registry) -> String {
    let row = |name: &str, summary: &str| format!("{name:<20} {summary}\n");
    let entries = registry.entries().iter();
    let mut text: String = entries.map(|e| row(e.name, e.summary)).collect();
    for (name, schema) in step_kinds() {
        text += &row(name, schema["description"].as_str().unwrap_or_default());
    }
    text + "\n`meshwright ops NAME` describes one operation, `meshwright ops --selections` lists the selections.\n"
}

/// Returns the name and the summary of each operation.
fn list_json(registry: &Registry) -> Json {
    let entries = registry.entries().iter();
    let operations = entries.map(|e| json!({ "name": e.name, "summary": e.summary }));
    let steps = step_kinds().into_iter();
    let steps = steps.map(|(name, s)| json!({ "name": name, "summary": s["description"] }));
    operations.chain(steps).collect()
}

/// Returns the description of an operation, with the JSON schema of its parameters.
fn operation_json(name: &str, registry: &Registry) -> anyhow::Result<Json> {
    Ok(match find(name, registry)? {
        Found::Step(schema) => {
            let docs = &schema["description"];
            json!({ "name": name, "summary": docs, "docs": docs, "schema": schema })
        }
        Found::Operation(entry) => {
            let schema = entry.schema();
            json!({
                "name": entry.name, "version": entry.version, "summary": entry.summary,
                "docs": schema["description"], "takes_on": entry.takes_on, "example": entry.example,
                "schema": schema,
            })
        }
    })
}

fn selections() -> String {
    let types = recipe::selections();
    let texts: Vec<String> = types.iter().map(type_text).collect();
    texts.join("\n")
}

fn operation(name: &str, registry: &Registry) -> anyhow::Result<String> {
    Ok(match find(name, registry)? {
        Found::Step(schema) => format!("{name}: {}", described(&schema, "")),
        Found::Operation(entry) => detail(entry),
    })
}

/// An operation, or one of the steps that are not operations: `Call`, `Repeat` and `If`.
enum Found<'r> {
    /// The JSON schema of the step.
    Step(Json),
    Operation(&'r Entry),
}

fn find<'r>(name: &str, registry: &'r Registry) -> anyhow::Result<Found<'r>> {
    if let Some((_, schema)) = step_kinds().into_iter().find(|(kind, _)| *kind == name) {
        return Ok(Found::Step(schema));
    }
    let Some(entry) = registry.get(name) else {
        let is_selection = |t: &TypeDoc| {
            t.name != "Region" && t.variants.iter().any(|variant| variant.name == name)
        };
        if recipe::selections().iter().any(is_selection) {
            anyhow::bail!("`{name}` is a selection: `meshwright ops --selections` describes it");
        }
        if recipe::expectations().iter().any(|e| e.name == name) {
            anyhow::bail!(
                "`{name}` is an expectation: `meshwright expectations {name}` describes it"
            );
        }
        let help = suggest_operations(name, registry);
        anyhow::bail!("unknown operation `{name}`: {help}");
    };
    Ok(Found::Operation(entry))
}

fn detail(entry: &Entry) -> String {
    let mut text = format!(
        "{} (version {}): {}\n\n{}",
        entry.name,
        entry.version,
        entry.summary,
        described(&entry.schema(), entry.summary)
    );
    if entry.takes_on {
        text += &format!(
            "\nThe operation acts on all objects of the kinds that it supports, such as meshes. To choose objects by name, write (on: [\"name\"], run: {}(..))\n",
            entry.name
        );
    }
    text + &format!("\nExample: {}\n", entry.example)
}

/// Returns the text that describes an operation: its description, its parameters and their types. For selection types,
/// only the name is printed. The first paragraph of the description is left out if it repeats `summary`.
fn described(schema: &Json, summary: &str) -> String {
    let mut text = String::new();
    if let Some(description) = schema["description"].as_str() {
        let rest = match description.split_once("\n\n") {
            Some((first, rest)) if repeats(first, summary) => rest,
            _ => description,
        };
        text += &format!("{rest}\n");
    }
    let fields = fields(schema);
    text += if fields.is_empty() {
        "\nNo parameters.\n"
    } else {
        "\nParameters:\n"
    };
    text.extend(fields.iter().map(|field| field_text(field, "  ")));
    // If a type has no fields but only variants, the text of the parameter already lists the variants. The loop below
    // adds the types that have fields.
    let is_shown = |t: &TypeDoc| t.fields.is_empty() && fields.iter().any(|f| f.kind == t.name);
    let types = types(schema);
    for t in types.iter().filter(|t| !t.is_selection() && !is_shown(t)) {
        text += &format!("\n{}", type_text(t));
    }
    if types.iter().any(TypeDoc::is_selection) {
        text += "\n`meshwright ops --selections` lists the selections.\n";
    }
    text
}

/// Whether a sentence such as "Creates a cube." only repeats a summary such as "Create a cube". The words must be the
/// same, apart from verb endings such as the "s" of "Creates".
fn repeats(sentence: &str, summary: &str) -> bool {
    let sentence: Vec<&str> = sentence.trim_end_matches('.').split_whitespace().collect();
    let summary: Vec<&str> = summary.split_whitespace().collect();
    let is_same = |(word, base): (&&str, &&str)| {
        let stem = base.strip_suffix('y').map(|stem| format!("{stem}ies"));
        word == base
            || matches!(word.strip_prefix(*base), Some("s" | "es"))
            || stem.is_some_and(|third_person| third_person == *word)
    };
    sentence.len() == summary.len() && sentence.iter().zip(&summary).all(is_same)
}

fn type_text(t: &TypeDoc) -> String {
    let mut text = format!("{}: {}\n", t.name, t.doc);
    text.extend(t.fields.iter().map(|field| field_text(field, "  ")));
    text + &variants_text(&t.variants, "  ")
}

fn field_text(field: &FieldDoc, indent: &str) -> String {
    let mut text = format!("{indent}{}: {}", field.name, field.kind);
    match field.default.as_deref() {
        Some("none") => text += " (optional)",
        Some(default) => text += &format!(", defaults to {default}"),
        None => text += " (required)",
    }
    text.push('\n');
    for line in field.doc.lines() {
        text += format!("{indent}    {line}").trim_end();
        text.push('\n');
    }
    if field.kind.ends_with("Selection") {
        return text;
    }
    text + &variants_text(&field.variants, &format!("{indent}    "))
}

/// Lists variants, with their documentation in a second column.
fn variants_text(variants: &[VariantDoc], indent: &str) -> String {
    let mut text = String::new();
    for variant in variants {
        let mut line = format!("{indent}{:<34}", variant.written);
        let column = " ".repeat(indent.len() + 34);
        if line.len() > column.len() && !variant.doc.is_empty() {
            text += &format!("{line}\n");
            line.clone_from(&column);
        }
        for word in variant.doc.split_whitespace() {
            if line.chars().count() + 1 + word.chars().count() > WIDTH {
                text += &format!("{line}\n");
                line.clone_from(&column);
            }
            line += &format!(" {word}");
        }
        text += &format!("{}\n", line.trim_end());
    }
    text
}
