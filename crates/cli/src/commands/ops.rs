//! `meshwright ops`: lists the operations, or shows one, from the same structs that recipes are read
//! into.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::Context as _;
use op::{Entry, Registry};
use recipe::{FieldDoc, TypeDoc, did_you_mean, fields, step_kinds, types};
use serde_json::Value as Json;

use super::new_op::snake_case;
use crate::args::OpsArgs;
use crate::output::print;

pub(crate) fn run(args: &OpsArgs, registry: &Registry) -> anyhow::Result<bool> {
    print(&match &args.name {
        _ if args.markdown => reference(registry, args.pictures.as_deref()),
        None => list(registry),
        Some(name) => shown(name, registry)?,
    })?;
    Ok(true)
}

/// A line for each operation.
fn list(registry: &Registry) -> String {
    let mut text = String::new();
    for e in registry.entries() {
        text += &format!("{:<20} {}\n", e.name, e.summary);
    }
    for (name, schema) in step_kinds() {
        text += &format!("{name:<20} {}\n", description(&schema));
    }
    text
}

/// What is said of one operation.
fn shown(name: &str, registry: &Registry) -> anyhow::Result<String> {
    if let Some((name, schema)) = step_kinds().into_iter().find(|(kind, _)| *kind == name) {
        return Ok(format!("{name}: {}", described(&schema)));
    }
    let entry = registry.get(name).with_context(|| {
        let known = registry.entries().iter().map(|e| e.name);
        let known = known.chain(step_kinds().into_iter().map(|(name, _)| name));
        let help = did_you_mean(name, known);
        format!("there is no operation `{name}`: {help}")
    })?;
    Ok(detail(entry))
}

fn description(schema: &Json) -> &str {
    schema["description"].as_str().unwrap_or_default()
}

fn detail(entry: &Entry) -> String {
    let schema = entry.schema();
    let mut text = format!(
        "{} (version {}): {}\n\n{}",
        entry.name,
        entry.version,
        entry.summary,
        described(&schema)
    );
    if entry.takes_on {
        text += "\nTakes `on: [\"name\", ..]` to act on chosen objects; without it on all that it can.\n";
    }
    text + &format!("\nExample: {}\n", entry.example)
}

/// The description and the parameters.
fn described(schema: &Json) -> String {
    let mut text = String::new();
    if schema["description"].is_string() {
        text += &format!("{}\n", description(schema));
    }
    let fields = fields(schema);
    if fields.is_empty() {
        text += "\nNo parameters.\n";
    } else {
        text += "\nParameters:\n";
    }
    for field in &fields {
        text += &field_text(field, "  ");
    }
    // What the parameters are made of, but for the variants that stand above.
    let shown = |t: &TypeDoc| fields.iter().any(|f| f.kind == t.name);
    for t in types(schema).iter().filter(|t| !shown(t)) {
        text += &format!("\n{}: {}\n", t.name, t.doc);
        for field in &t.fields {
            text += &field_text(field, "  ");
        }
        text += &variants_text(&t.variants, "  ");
    }
    text
}

fn field_text(field: &FieldDoc, indent: &str) -> String {
    let mut text = format!("{indent}{}: {}", field.name, field.kind);
    match &field.default {
        Some(default) => text += &format!(" = {default}"),
        None => text += " (required)",
    }
    text.push('\n');
    for line in field.doc.lines() {
        text += format!("{indent}    {line}").trim_end();
        text.push('\n');
    }
    text + &variants_text(&field.variants, &format!("{indent}    "))
}

fn variants_text(variants: &[(String, String)], indent: &str) -> String {
    let mut text = String::new();
    for (variant, doc) in variants {
        let first = doc.lines().next().unwrap_or("");
        text += format!("{indent}{variant:<34} {first}").trim_end();
        text.push('\n');
    }
    text
}

/// The reference of all operations as Markdown.
fn reference(registry: &Registry, pictures: Option<&Path>) -> String {
    let mut text =
        "# Operations\n\nMade by `meshwright ops --markdown` from the operations themselves.\n\n"
            .to_owned();
    for entry in registry.entries() {
        let (name, anchor) = (entry.name, entry.name.to_lowercase());
        text += &format!("- [{name}](#{anchor}): {}\n", entry.summary);
    }
    let mut used: BTreeMap<String, TypeDoc> = BTreeMap::new();
    for entry in registry.entries() {
        let schema = entry.schema();
        text += &format!("\n## {}\n\n", entry.name);
        if schema["description"].is_string() {
            text += &format!("{}\n\n", description(&schema));
        }
        text += &format!("```ron\n{}\n```\n\n", entry.example);
        if let Some(folder) = pictures {
            text += &images(entry.name, folder);
        }
        let fields = fields(&schema);
        if fields.is_empty() {
            text += "No parameters.\n";
        } else {
            text += &fields_table(&fields);
        }
        used.extend(types(&schema).into_iter().map(|t| (t.name.clone(), t)));
    }
    text += "\n# Steps that hold steps\n";
    for (name, schema) in step_kinds() {
        let (doc, table) = (description(&schema), fields_table(&fields(&schema)));
        text += &format!("\n## {name}\n\n{doc}.\n\n{table}");
    }
    text += "\n# Types of parameters\n";
    for t in used.values() {
        text += &format!("\n## {}\n\n{}\n\n", t.name, t.doc);
        if !t.fields.is_empty() {
            text += &fields_table(&t.fields);
        }
        if !t.variants.is_empty() {
            text += &variants_table(&t.variants);
        }
    }
    text += "\n# Reasons for `refused:`\n\n";
    text + &variants_table(&recipe::refusals())
}

/// The pictures of an operation side by side, with the recipe that draws them.
fn images(operation: &str, folder: &Path) -> String {
    let name = snake_case(operation);
    let recipe = format!("{}/{name}", folder.display());
    let images: Vec<String> = ["before", "after"]
        .iter()
        .filter(|image| folder.join(format!("{name}/{image}.png")).is_file())
        .map(|image| format!("![{image}]({recipe}/{image}.png)"))
        .collect();
    if images.is_empty() {
        return String::new();
    }
    format!("{} [drawn by]({recipe}.ron)\n\n", images.join(" "))
}

fn fields_table(fields: &[FieldDoc]) -> String {
    let mut text =
        "| parameter | type | default | meaning |\n| --- | --- | --- | --- |\n".to_owned();
    for field in fields {
        let default = match &field.default {
            Some(default) => format!("`{default}`"),
            None => "required".to_owned(),
        };
        let (name, kind, doc) = (&field.name, &field.kind, cell(&field.doc));
        text += &format!("| `{name}` | {kind} | {default} | {doc} |\n");
    }
    text
}

fn variants_table(variants: &[(String, String)]) -> String {
    let mut text = "| choice | meaning |\n| --- | --- |\n".to_owned();
    for (variant, doc) in variants {
        text += &format!("| `{variant}` | {} |\n", cell(doc));
    }
    text
}

/// A text in one cell of a table.
fn cell(text: &str) -> String {
    text.replace('\n', " ").replace('|', "\\|")
}
