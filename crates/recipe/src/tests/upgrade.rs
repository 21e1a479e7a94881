//! Tests of old names in recipes: the reader accepts them with a warning, and `upgrade` replaces them.

use super::{read, registry, shown, steps};
use crate::upgrade::upgrade;

const OLD: &str = "(
    recipe: 1, // one
    steps: [
        Sheet(columns: 2),
        (id: \"a\", run: Raise(height: 1 /* up */, way: North)),\r
        Elevate( by: 2, way: More(amount: 0.5), vertices: Random(count: 1, seed: 3) ),
    ],
)";

const NEW: &str = "(
    recipe: 1, // one
    steps: [
        Sheet(columns: 2),
        (id: \"a\", run: Lift(by: 1 /* up */, way: Up)),\r
        Lift( by: 2, way: Further(than: 0.5), vertices: Random(count: 1, seed: 3) ),
    ],
)";

#[test]
fn old_names_are_read_with_a_warning() {
    let reading = read(OLD);
    assert!(!reading.has_errors(), "{:#?}", reading.diagnostics);
    let help = "run `meshwright upgrade` to replace old names in the recipe";
    assert_eq!(
        shown(OLD, &reading.diagnostics),
        [
            ("Raise", "`Raise` was renamed to `Lift`", help),
            ("height", "`height` was renamed to `by`", help),
            ("North", "`North` was renamed to `Up`", help),
            ("Elevate", "`Elevate` was renamed to `Lift`", help),
            ("More", "`More` was renamed to `Further`", help),
            ("amount", "`amount` was renamed to `than`", help),
        ]
    );
    assert!(read(NEW).diagnostics.is_empty());
}

#[test]
fn upgrading_replaces_only_old_names() {
    let upgraded = upgrade(OLD, &registry()).unwrap();
    assert_eq!(upgraded.text, NEW);
    let renames: Vec<_> = upgraded
        .renames
        .iter()
        .map(|(line, r)| (*line, r.from.as_str(), r.to.as_str()))
        .collect();
    assert_eq!(renames[0], (5, "Raise", "Lift"));
    assert_eq!(renames.len(), 6);
    let again = upgrade(NEW, &registry()).unwrap();
    assert_eq!((again.text.as_str(), again.renames.len()), (NEW, 0));
}

#[test]
fn a_recipe_with_old_names_has_the_same_digest() {
    assert_eq!(read(OLD).recipe.digest(), read(NEW).recipe.digest());
    let labels = |text| -> Vec<String> {
        let recipe = read(text).recipe;
        recipe.steps.iter().map(|s| s.label().to_owned()).collect()
    };
    assert_eq!(labels(OLD), labels(NEW));
}

#[test]
fn a_field_under_both_names_is_an_error() {
    let reading = read(&steps("Sheet(columns: 1), Lift(by: 1, height: 2)"));
    assert!(reading.has_errors());
}

#[test]
fn a_newer_recipe_or_a_text_without_version_is_refused() {
    let refused = |text| {
        let problems = upgrade(text, &registry()).unwrap_err();
        problems[0].message.clone()
    };
    assert_eq!(
        refused("(recipe: 2, steps: [Raise(by: 1)])"),
        "this recipe has the format version 2, expected 1"
    );
    assert_eq!(
        refused("(steps: [Raise(by: 1)])"),
        "expected a recipe, found text without `recipe: 1`"
    );
    assert_eq!(
        refused("(recipe: \"1\", steps: [])"),
        "expected version 1, found the string \"1\""
    );
    assert!(upgrade("(recipe: 1, steps: [Raise(by: 1)", &registry()).is_err());
}

#[test]
fn a_recipe_with_other_errors_is_upgraded_too() {
    let upgraded = upgrade(&steps("Raise(hight: 1), Nothing(a: 1)"), &registry()).unwrap();
    assert_eq!(upgraded.text, steps("Lift(hight: 1), Nothing(a: 1)"));
}

#[test]
fn inner_steps_are_upgraded_too() {
    let text = steps(
        "Sheet(columns: 1), Repeat(times: 2, steps: [(id: \"a\", run: Raise(height: 1))]), \
         (run: If(param: \"p\", steps: [Raise(by: 1)], otherwise: [Elevate(by: 2)]))",
    );
    let new = text
        .replace("Raise", "Lift")
        .replace("Elevate", "Lift")
        .replace("height", "by");
    assert_eq!(upgrade(&text, &registry()).unwrap().text, new);
}

#[test]
fn values_of_parameters_are_not_upgraded() {
    let text =
        "(recipe: 1, params: { \"way\": Choice(default: \"North\", of: [\"North\", \"Up\"]) },
        steps: [Sheet(columns: 1), Lift(by: 1, way: arg(\"way\"))])";
    let reading = read(text);
    assert!(reading.diagnostics.is_empty(), "{:#?}", reading.diagnostics);
    assert_eq!(upgrade(text, &registry()).unwrap().text, text);
}
