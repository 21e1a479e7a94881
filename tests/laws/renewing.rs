//! Recorded numbers of the recipes in `scenes/` that are broken come back when they are renewed, and the text is
//! what it was.

use engine::FileReader;
use op::Files;
use recipe::update::update;
use recipe::{Settings, Silent, Source, Span, Values};
use ron_tree::{Value, ValueKind};

use crate::{assert_none, recipes};

#[test]
fn broken_numbers_of_every_scene_come_back() {
    let mut failures = Vec::new();
    let mut n_broken = 0;
    for path in recipes() {
        let shown = path.display();
        let source = std::fs::read_to_string(&path).expect("the recipe can be read");
        let tree = ron_tree::parse(&source).value;
        let mut numbers = Vec::new();
        let expected = tree.field("expect").and_then(Value::items);
        recorded(expected.unwrap_or_default(), &mut numbers);
        n_broken += numbers.len();
        let edits = numbers.iter().map(|&span| (span, other(span.of(&source))));
        let broken = ron_tree::replace(&source, edits.collect()).expect("numbers lie apart");
        match renewed(&Source::new(&path, broken)) {
            Ok((text, n)) => {
                if text != source {
                    failures.push(format!("{shown}: another text came back:\n{text}"));
                }
                if n != numbers.len() {
                    failures.push(format!("{shown}: {n} of {} renewed", numbers.len()));
                }
            }
            Err(problem) => failures.push(format!("{shown}: {problem}")),
        }
    }
    assert_none(&failures);
    assert!(n_broken > 50, "only {n_broken} numbers were broken");
}

/// The number with another last digit.
fn other(number: &str) -> String {
    let (rest, last) = number.split_at(number.len() - 1);
    let digit: u8 = last.parse().expect("a number ends with a digit");
    format!("{rest}{}", (digit + 3) % 10)
}

/// The places of the whole numbers that expectations record; not those that a parameter brings.
fn recorded(items: &[Value], numbers: &mut Vec<Span>) {
    for item in items {
        if item.name().is_none() {
            let that = item.field("that");
            let inside = that.map(|that| that.items().unwrap_or(std::slice::from_ref(that)));
            recorded(inside.unwrap_or_default(), numbers);
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

/// The text of a recipe after a run and an update, and how many values were changed.
fn renewed(source: &Source) -> Result<(String, usize), String> {
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
