//! Generates the reference of all operations as Markdown.

use std::collections::BTreeMap;
use std::path::Path;

use op::Registry;
use recipe::{FieldDoc, TypeDoc, VariantDoc, fields, step_kinds, types};
use serde_json::Value as Json;

use super::new_op::snake_case;

/// Returns the reference of all operations as Markdown.
pub(crate) fn reference(registry: &Registry, pictures: Option<&Path>) -> String {
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
    text += "\n# Steps that contain steps\n";
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

/// Returns the pictures of an operation, side by side, with a link to the recipe that draws them.
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

fn variants_table(variants: &[VariantDoc]) -> String {
    let mut text = "| choice | meaning |\n| --- | --- |\n".to_owned();
    for VariantDoc { written, doc, .. } in variants {
        text += &format!("| `{written}` | {} |\n", cell(doc));
    }
    text
}

fn description(schema: &Json) -> &str {
    schema["description"].as_str().unwrap_or_default()
}

/// Formats a text as one cell of a table.
fn cell(text: &str) -> String {
    text.replace('\n', " ").replace('|', "\\|")
}
