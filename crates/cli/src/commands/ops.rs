//! `meshwright ops`: lists the operations, or shows one, from the same structs that recipes are read
//! into.

use std::collections::BTreeMap;

use op::{Entry, Registry};
use recipe::{did_you_mean, fields};

use crate::output::{print, table};

pub(crate) fn run(name: Option<&str>, markdown: bool, registry: &Registry) -> anyhow::Result<bool> {
    if markdown {
        print(&reference(registry))?;
        return Ok(true);
    }
    let Some(name) = name else {
        let rows: Vec<Vec<String>> = registry
            .entries()
            .iter()
            .map(|e| vec![format!("{:<20} {}", e.name, e.summary)])
            .collect();
        print(&table(&rows))?;
        return Ok(true);
    };
    let Some(entry) = registry.get(name) else {
        let known = registry.entries().iter().map(|e| e.name);
        anyhow::bail!(
            "there is no operation `{name}`: {}",
            did_you_mean(name, known)
        );
    };
    print(&detail(entry))?;
    Ok(true)
}

fn detail(entry: &Entry) -> String {
    let schema = entry.schema();
    let mut text = format!(
        "{} (version {}): {}\n",
        entry.name, entry.version, entry.summary
    );
    if let Some(description) = schema.get("description").and_then(|d| d.as_str()) {
        text += &format!("\n{description}\n");
    }
    let fields = fields(&schema);
    if fields.is_empty() {
        text += "\nNo parameters.\n";
    } else {
        text += "\nParameters:\n";
    }
    for field in fields {
        text += &format!("  {}: {}", field.name, field.kind);
        match field.default {
            Some(default) => text += &format!(" = {default}"),
            None => text += " (required)",
        }
        text.push('\n');
        for line in field.doc.lines() {
            text += &format!("      {line}\n");
        }
        for (variant, doc) in field.variants {
            let first = doc.lines().next().unwrap_or("");
            text += &format!("      {variant:<34} {first}\n");
        }
    }
    if entry.takes_on {
        text += "\nTakes `on: [\"name\", ..]` to act on chosen objects; without it on all that it can.\n";
    }
    text
}

/// The reference of all operations as Markdown.
pub(crate) fn reference(registry: &Registry) -> String {
    let mut text =
        "# Operations\n\nMade by `meshwright ops --markdown` from the operations themselves.\n\n"
            .to_owned();
    for entry in registry.entries() {
        text += &format!(
            "- [{0}](#{1}): {2}\n",
            entry.name,
            entry.name.to_lowercase(),
            entry.summary
        );
    }
    let mut choices: BTreeMap<String, Vec<(String, String)>> = BTreeMap::new();
    for entry in registry.entries() {
        let schema = entry.schema();
        text += &format!("\n## {}\n\n", entry.name);
        if let Some(description) = schema.get("description").and_then(|d| d.as_str()) {
            text += &format!("{description}\n\n");
        }
        let fields = fields(&schema);
        if fields.is_empty() {
            text += "No parameters.\n";
        } else {
            text += "| parameter | type | default | meaning |\n| --- | --- | --- | --- |\n";
        }
        for field in fields {
            let default = field
                .default
                .map_or("required".to_owned(), |d| format!("`{d}`"));
            let doc = field.doc.replace('\n', " ").replace('|', "\\|");
            text += &format!(
                "| `{}` | {} | {default} | {doc} |\n",
                field.name, field.kind
            );
            if !field.variants.is_empty() {
                choices.insert(field.kind, field.variants);
            }
        }
    }
    text += "\n# Choices\n";
    for (name, variants) in choices {
        text += &format!("\n## {name}\n\n| choice | meaning |\n| --- | --- |\n");
        for (variant, doc) in variants {
            let doc = doc.replace('\n', " ").replace('|', "\\|");
            text += &format!("| `{variant}` | {doc} |\n");
        }
    }
    text
}
