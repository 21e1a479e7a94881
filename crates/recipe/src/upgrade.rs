//! Old names in a recipe: the reader accepts them with a warning, and `meshwright upgrade` replaces them.
//!
//! A renamed operation keeps its old names as aliases. A renamed field or variant declares its old names for `serde`
//! and in its schema:
//!
//! ```text
//! #[serde(alias = "amount")]
//! #[schemars(extend("aliases" = ["amount"]))]
//! by: f64,
//! ```

use op::Registry;

use crate::read::{VERSION, wrong_version};
use crate::schema::{self, Schemas};
pub use crate::schema_check::Rename;
use crate::schema_check::{check_step, checked};
use ron_tree::{Diagnostic, LineIndex, Value, ValueKind};

/// A recipe with current names.
#[derive(Clone, Debug)]
pub struct Upgraded {
    /// The new text. Comments and layout are unchanged.
    pub text: String,
    /// The replaced names in the order of the text, each with its line in the old text, counted from 1.
    pub renames: Vec<(usize, Rename)>,
}

/// Replaces old names in a recipe. The recipe is allowed to have other errors, as long as its text can be parsed.
///
/// # Errors
///
/// Returns the syntax errors of the text, or an error if the version of the recipe is missing or not supported.
pub fn upgrade(source: &str, registry: &Registry) -> Result<Upgraded, Vec<Diagnostic>> {
    let parsed = ron_tree::parse(source);
    let root = &parsed.value;
    if !parsed.diagnostics.is_empty() {
        return Err(parsed.diagnostics);
    }
    if let Some(problem) = missing_or_wrong_version(root) {
        return Err(vec![problem]);
    }
    let schemas = Schemas::new(registry);
    let mut found = Vec::new();
    if let Some(ValueKind::Map(params)) = root.field("params").map(|p| &p.kind) {
        let renames = |(_, param): &(Value, Value)| checked(param, schema::param()).renames;
        found.extend(params.iter().flat_map(renames));
    }
    for list in ["steps", "expect"] {
        for item in root.field(list).and_then(Value::items).unwrap_or_default() {
            if list == "steps" {
                step(item, &schemas, &mut found);
            } else {
                expectation(item, &mut found);
            }
        }
    }
    found.sort_by_key(|rename| rename.span);
    found.dedup();
    let edits = found.iter().map(|r| (r.span, r.to.clone())).collect();
    let text = ron_tree::replace(source, edits).expect("names do not overlap");
    let lines = LineIndex::new(source);
    let renames = found
        .into_iter()
        .map(|rename| (lines.position(rename.span.start).0, rename))
        .collect();
    Ok(Upgraded { text, renames })
}

fn missing_or_wrong_version(root: &Value) -> Option<Diagnostic> {
    let Some(version) = root.field("recipe") else {
        let message = "expected a recipe, found text without `recipe: 1`";
        return Some(Diagnostic::error(root.span, message));
    };
    if matches!(&version.kind, ValueKind::Number(number) if number.is_int()) {
        return wrong_version(root, "recipe", VERSION);
    }
    let message = format!("expected version {VERSION}, found {}", version.describe());
    Some(Diagnostic::error(version.span, message).with_help("write 1"))
}

/// Collects the old names in a step: `Name(..)` or `(run: Name(..), ..)`. Steps can contain lists of steps.
fn step(written: &Value, schemas: &Schemas, found: &mut Vec<Rename>) {
    let envelope = matches!(written.kind, ValueKind::Struct(_));
    let run = written.field("run").filter(|_| envelope).unwrap_or(written);
    if let Some(entry) = run.name().and_then(|(name, _)| schemas.registry.get(name)) {
        found.extend(check_step(run, &schemas.of(entry)).renames_in_step(run, entry.name));
        return;
    }
    for field in written.fields().iter().chain(run.fields()) {
        for item in field.value.items().unwrap_or_default() {
            step(item, schemas, found);
        }
    }
}

fn expectation(written: &Value, found: &mut Vec<Rename>) {
    let that = match written.kind {
        ValueKind::Struct(_) => written.field("that"),
        _ => Some(written),
    };
    let Some(that) = that else { return };
    for item in that.items().unwrap_or(std::slice::from_ref(that)) {
        found.extend(checked(item, schema::expectation()).renames);
    }
}
