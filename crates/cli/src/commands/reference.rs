//! Generates the reference of all operations as Markdown.

use std::path::Path;

use op::Registry;
use recipe::{FieldDoc, TypeDoc, VariantDoc, fields, step_kinds, types};
use serde_json::Value as Json;

use super::new_op::snake_case;

/// Returns the reference of all operations as Markdown.
pub(crate) fn reference(registry: &Registry, pictures: Option<&Path>) -> String {
    let mut text =
        "# Operations\n\nThis page is the output of the command `meshwright ops --markdown`.\n\n"
            .to_owned();
    for entry in registry.entries() {
        let (name, anchor) = (entry.name, entry.name.to_lowercase());
        text += &format!("- [{name}](#{anchor}): {}\n", entry.summary);
    }
    let mut used: Vec<TypeDoc> = Vec::new();
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
        add_types(&mut used, types(&schema));
    }
    used.sort_by(|a, b| a.name.cmp(&b.name));
    text += "\n# Steps that contain steps\n";
    for (name, schema) in step_kinds() {
        let (doc, table) = (description(&schema), fields_table(&fields(&schema)));
        text += &format!("\n## {name}\n\n{doc}.\n\n{table}");
    }
    text += "\n# Types of parameters\n";
    for t in &used {
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

/// Adds types to the list, except the types that the list already has. If types have the same name but differ, all of
/// them are added.
fn add_types(used: &mut Vec<TypeDoc>, types: Vec<TypeDoc>) {
    for t in types {
        if !used.contains(&t) {
            used.push(t);
        }
    }
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
        let default = match field.default.as_deref() {
            Some("none") => "optional".to_owned(),
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

/// Formats a string as one cell of a table.
fn cell(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    words.join(" ").replace('|', "\\|")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_types_of_the_reference_have_one_name() {
        let mut used = Vec::new();
        for entry in ops_all::registry().entries() {
            add_types(&mut used, types(&entry.schema()));
        }
        let mut names: Vec<&str> = used.iter().map(|t| t.name.as_str()).collect();
        names.sort_unstable();
        let twice = names.windows(2).filter(|pair| pair[0] == pair[1]);
        let twice: Vec<&str> = twice.map(|pair| pair[0]).collect();
        assert_eq!(twice, [""; 0]);
        // If one operation uses two types with the name `Side`, the second type gets the name `Side2`.
        let numbered = names
            .iter()
            .find(|name| name.ends_with('2') || name.ends_with('3'));
        assert_eq!(numbered, None);
        for name in ["Side", "SymmetrizeSide", "Until", "FlipUntil"] {
            assert!(names.contains(&name), "{name}");
        }
    }
}
