//! Tests the function `update`, which writes current numbers into the expectations of a recipe. The test changes these
//! numbers in each recipe in `scenes/`. The function must restore them, and keep the rest of the text.

use engine::FileReader;
use op::Files;
use recipe::update::update;
use recipe::{Settings, Silent, Source, Span, Values};
use ron_tree::{Value, ValueKind};

use crate::{assert_none, recipes};

#[test]
fn updating_restores_changed_numbers_of_every_recipe() {
    let mut failures = Vec::new();
    let mut n_changed = 0;
    for path in recipes() {
        let shown = path.display();
        let source = std::fs::read_to_string(&path).expect("the recipe can be read");
        let tree = ron_tree::parse(&source).value;
        let mut numbers = Vec::new();
        let expected = tree.field("expect").and_then(Value::items);
        collect_recorded(expected.unwrap_or_default(), &mut numbers);
        n_changed += numbers.len();
        let edits = numbers
            .iter()
            .map(|&span| (span, with_other_digit(span.of(&source))));
        let changed = ron_tree::replace(&source, edits.collect()).expect("numbers do not overlap");
        match updated(&Source::new(&path, changed)) {
            Ok((text, n)) => {
                if text != source {
                    failures.push(format!("{shown}: the updated text differs:\n{text}"));
                }
                if n != numbers.len() {
                    failures.push(format!(
                        "{shown}: {n} of {} numbers were updated",
                        numbers.len()
                    ));
                }
            }
            Err(problem) => failures.push(format!("{shown}: {problem}")),
        }
    }
    assert_none(&failures);
    assert!(n_changed > 50, "only {n_changed} numbers were changed");
}

/// Returns `number` with a different last digit.
fn with_other_digit(number: &str) -> String {
    let (rest, last) = number.split_at(number.len() - 1);
    let digit: u8 = last.parse().expect("a number ends with a digit");
    format!("{rest}{}", (digit + 3) % 10)
}

/// Collects the spans of the integers in the fields `eq` of expectations. Skips areas, volumes, numbers that come from
/// a parameter, and expectations that also have `min` or `max`.
fn collect_recorded(items: &[Value], numbers: &mut Vec<Span>) {
    for item in items {
        if item.name().is_none() {
            let that = item.field("that");
            let inside = that.map(|that| that.items().unwrap_or(std::slice::from_ref(that)));
            collect_recorded(inside.unwrap_or_default(), numbers);
        } else if let Some(eq) = item.field("eq")
            && item.field("min").is_none()
            && item.field("max").is_none()
            && item
                .name()
                .is_some_and(|(name, _)| name != "Area" && name != "Volume")
            && let ValueKind::Number(number) = &eq.kind
            && number.to_int().is_some()
        {
            numbers.push(eq.span);
        }
    }
}

/// Runs and updates a recipe. Returns the new text and the number of changed values.
fn updated(source: &Source) -> Result<(String, usize), String> {
    let reading = recipe::read(source, &ops_all::registry(), Values::default());
    if reading.has_errors() {
        return Err(recipe::render(
            &reading.recipe.sources,
            &reading.diagnostics,
            false,
        ));
    }
    let out = tempfile::tempdir().map_err(|error| error.to_string())?;
    let files = Files {
        input: source.folder().to_owned(),
        output: out.path().to_owned(),
        placeholders: reading.recipe.placeholders(),
        ..Files::default()
    };
    let settings = Settings {
        files: &files,
        budget: 4 << 30,
        reader: &FileReader,
        keep_outputs: true,
        writes: true,
        cache: None,
    };
    let outcome = recipe::run(&reading.recipe, settings, &Silent);
    let update = update(&reading.recipe, &outcome);
    if !update.left.is_empty() {
        return Err(recipe::render(&reading.recipe.sources, &update.left, false));
    }
    Ok((update.text, update.changes.len()))
}
