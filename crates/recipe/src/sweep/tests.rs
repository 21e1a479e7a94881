use std::path::Path;

use super::*;
use crate::params::Param;
use crate::recipe::Origin;

fn parameters() -> Vec<Parameter> {
    let declared = [
        ("n", "Int(default: 1, min: 0, max: 9)"),
        ("x", "Float(default: 1, max: 10)"),
        ("flag", "Bool(default: false)"),
        ("kind", "Choice(default: \"A\", of: [\"A\", \"B\"])"),
        ("model", "Path(default: \"a.obj\")"),
        ("to", "Vector(default: (0, 0, 0))"),
        ("text", "Text(default: \"\")"),
    ];
    let parameter = |(name, text): (&str, &str)| {
        let param: Param = ron_tree::from_str(text).unwrap();
        Parameter {
            name: name.to_owned(),
            value: param.default_value().unwrap(),
            param,
            origin: Origin::Default,
        }
    };
    declared.into_iter().map(parameter).collect()
}

fn sweep(fields: &str) -> String {
    format!("(sweep: 1, recipe: \"a.ron\", keep: [Faces], {fields})")
}

/// Returns the grid of a valid sweep.
fn grid(fields: &str) -> Grid {
    let reading = read_sweep(&sweep(fields));
    assert_eq!(reading.diagnostics, []);
    let sweep = reading.sweep.unwrap();
    sweep.grid(&parameters(), Path::new("sweeps")).unwrap()
}

/// Returns the cells of a valid sweep, with each value as text.
fn cells(fields: &str) -> Vec<Vec<String>> {
    let cell = |cell: &Vec<Setting>| cell.iter().map(|s| s.text.clone()).collect();
    grid(fields).cells.iter().map(cell).collect()
}

/// Returns the spanned text and the message of each error of a sweep.
fn wrong(fields: &str) -> Vec<(String, String)> {
    let source = sweep(fields);
    let reading = read_sweep(&source);
    let mut diagnostics = reading.diagnostics;
    if let Some(sweep) = reading.sweep
        && let Err(more) = sweep.grid(&parameters(), Path::new("sweeps"))
    {
        diagnostics.extend(more);
    }
    let shown = |d: &Diagnostic| (d.span.unwrap().of(&source).to_owned(), d.message.clone());
    diagnostics.iter().map(shown).collect()
}

#[test]
fn cells_are_all_combinations_and_the_last_parameter_changes_fastest() {
    let over = "over: {\"n\": [0, 1], \"x\": [0.5, 2], \"flag\": [true]}";
    assert_eq!(
        cells(over),
        [
            ["0", "0.5", "true"],
            ["0", "2.0", "true"],
            ["1", "0.5", "true"],
            ["1", "2.0", "true"]
        ]
    );
    assert_eq!(grid(over).parameters, ["n", "x", "flag"]);
}

#[test]
fn zipped_lists_change_together_and_faster_than_the_others() {
    assert_eq!(
        cells("over: {\"n\": [0, 1]}, zip: {\"x\": [3, 4], \"kind\": [A, \"B\"]}"),
        [
            ["0", "3.0", "A"],
            ["0", "4.0", "B"],
            ["1", "3.0", "A"],
            ["1", "4.0", "B"]
        ]
    );
}

#[test]
fn a_sweep_over_nothing_is_one_cell() {
    assert_eq!(grid("").cells, [Vec::new()]);
}

#[test]
fn a_range_has_both_ends_and_round_numbers_between_them() {
    assert_eq!(
        cells("over: {\"x\": Range(from: 0.1, to: 0.5, steps: 5)}").concat(),
        ["0.1", "0.2", "0.3", "0.4", "0.5"]
    );
    assert_eq!(
        cells("over: {\"n\": Range(from: 8, to: 0, steps: 3)}").concat(),
        ["8", "4", "0"]
    );
    assert_eq!(
        cells("over: {\"n\": Range(from: 3, to: 3, steps: 1)}").concat(),
        ["3"]
    );
    // If `steps` is omitted, the range contains all whole numbers.
    assert_eq!(
        cells("over: {\"n\": Range(from: 4, to: 2)}").concat(),
        ["4", "3", "2"]
    );
}

#[test]
fn values_of_every_type_are_accepted() {
    let grid = grid(
        "set: {\"n\": 0x5, \"flag\": true, \"kind\": B, \"model\": \"b.obj\", \"to\": (1, 2, 3), \"text\": \"a\\\"b\"}",
    );
    let set: Vec<_> = grid
        .set
        .iter()
        .map(|(n, s)| [n.clone(), s.text.clone(), s.value.to_string()])
        .collect();
    assert_eq!(
        set,
        [
            ["n", "5", "5"],
            ["flag", "true", "true"],
            ["kind", "B", "B"],
            ["model", "sweeps/b.obj", "\"b.obj\""],
            ["to", "(1.0, 2.0, 3.0)", "(1.0, 2.0, 3.0)"],
            ["text", "a\"b", "\"a\\\"b\""],
        ]
    );
}

#[test]
fn all_errors_in_the_values_are_reported_at_once() {
    let found = wrong(
        "over: {\"m\": [1], \"n\": [1.5, 12, \"2\", 3], \"x\": [], \"flag\": true, \"to\": [(1, 2)],
         \"kind\": Range(from: 0, to: 1, steps: 2)}, zip: {\"text\": [Area]}, set: {\"n\": 1, \"model\": 5}",
    );
    let expected = [
        ("\"m\"", "the recipe has no parameter `m`"),
        ("1.5", "expected a whole number, found `1.5`"),
        ("12", "12 is above the maximum 9"),
        ("\"2\"", "expected a whole number, found the string \"2\""),
        ("[]", "expected at least one value, found an empty list"),
        (
            "true",
            "expected a list of values `[..]` or `Range(from: .., to: .., steps: ..)`, found `true`",
        ),
        (
            "(1, 2)",
            "expected three numbers `(x, y, z)`, found `(1, 2)`",
        ),
        (
            "Range(from: 0, to: 1, steps: 2)",
            "expected a list of values `[..]`: `Range` is for numbers, but the parameter has the type Choice",
        ),
        ("Area", "expected a string in quotes, found `Area`"),
        ("\"n\"", "the sweep gives values for `n` in two places"),
        ("5", "expected a path in quotes, found 5"),
    ];
    let expected: Vec<_> = expected.map(|(a, b)| (a.to_owned(), b.to_owned())).into();
    assert_eq!(found, expected);
}

#[test]
fn invalid_ranges_are_refused_with_a_reason() {
    let found = |range: &str| {
        wrong(&format!("over: {{\"n\": Range({range})}}"))
            .remove(0)
            .1
    };
    assert_eq!(
        found("from: 0, to: 1, steps: 3"),
        "expected whole numbers, but this range contains 0.5"
    );
    assert_eq!(
        found("from: 0, to: 99, steps: 2"),
        "99 is above the maximum 9"
    );
    assert_eq!(
        found("from: 0, to: 1, steps: 1"),
        "`from` and `to` must be equal if `steps` is 1, found 0 and 1"
    );
    assert!(found("from: -1e300, to: 1e300").contains("expected at most 10000"));
    let without_steps = wrong("over: {\"x\": Range(from: 0, to: 1)}").remove(0).1;
    assert!(without_steps.contains("needs `steps`"), "{without_steps}");
    assert!(found("from: 0, to: 1, steps: 0").contains("expected at least 1"));
    assert!(found("from: 0, to: 1, steps: 2, step: 2").contains("unknown field `step`"));
    assert!(found("from: 0, to: 1, steps: 4_000_000_000").contains("expected at most 10000"));
}

#[test]
fn zipped_lists_must_have_the_same_length() {
    assert_eq!(
        wrong("zip: {\"n\": [1, 2], \"x\": [1]}"),
        [(
            "[1]".to_owned(),
            "all lists of `zip` must have the same length, but `x` has 1 value and `n` has 2"
                .to_owned()
        )]
    );
}

#[test]
fn too_many_cells_are_refused_before_they_are_created() {
    let many = "Range(from: 0, to: 1, steps: 9999)";
    let found = wrong(&format!(
        "over: {{\"x\": {many}, \"text\": [\"a\", \"b\"]}}"
    ));
    assert_eq!(
        found[0].1,
        "the sweep has 9999 x 2 cells (combinations of values), expected at most 10000"
    );
}

#[test]
fn errors_in_the_fields_are_reported_as_in_a_recipe() {
    let source = "(sweep: 1, recipe: \"a.ron\", keep: [Facets, Area, DistanceTo(File(\"a\"))], overr: {}, set: [])";
    let reading = read_sweep(source);
    let messages: Vec<&str> = reading.diagnostics.iter().map(|d| &*d.message).collect();
    assert_eq!(messages.len(), 4, "{messages:?}");
    assert!(messages[0].contains("unknown variant `Facets`"));
    assert_eq!(
        reading.diagnostics[0].help.as_deref(),
        Some("did you mean `Faces`?")
    );
    assert!(messages[1].contains("DistanceTo"));
    assert!(messages[2].contains("unknown field `overr`"));
    assert!(messages[3].contains("`set`"));

    let of = |source: &str| read_sweep(source).diagnostics.remove(0).message;
    assert_eq!(
        of("(sweep: 2)"),
        "this sweep has the format version 2, expected 1"
    );
    assert!(of("(sweep: 1, keep: [Faces])").contains("recipe"));
    assert!(of("(sweep: 1, recipe: \"a.ron\", keep: [])").contains("at least 1"));
    assert!(read_sweep("").has_errors() && read_sweep("[").has_errors());
}

#[test]
fn any_text_is_read_or_refused_and_never_panics() {
    use proptest::prelude::*;
    let piece = prop::sample::select(vec![
        "(", ")", "[", "]", "{", "}", ",", ":", "sweep", "1", "recipe", "\"a\"", "over", "\"n\"",
        "Range", "from", "to", "steps", "keep", "Faces", "zip", "set", "-1e308", "None", " ", "é",
    ]);
    let texts = prop::collection::vec(piece, 0..40).prop_map(|pieces| pieces.concat());
    proptest!(|(text in texts, fields in "\\PC{0,60}")| {
        for source in [text, sweep(&fields)] {
            if let Some(sweep) = read_sweep(&source).sweep {
                let _ = sweep.grid(&parameters(), Path::new(""));
            }
        }
    });
}

#[test]
fn a_grid_knows_which_parameters_change_together() {
    let axes = |fields: &str| -> Vec<(Vec<String>, usize)> {
        let grid = grid(fields);
        let named = |axis: &Axis| (grid.parameters[axis.parameters.clone()].to_vec(), axis.len);
        let axes: Vec<_> = grid.axes.iter().map(named).collect();
        let product: usize = grid.axes.iter().map(|axis| axis.len).product();
        assert_eq!(product, grid.cells.len());
        axes
    };
    assert_eq!(axes(""), []);
    assert_eq!(
        axes(
            "over: {\"n\": [1, 2], \"flag\": [true]}, zip: {\"x\": [1, 2, 3], \"text\": [\"a\", \"b\", \"c\"]}"
        ),
        [
            (vec!["n".to_owned()], 2),
            (vec!["flag".to_owned()], 1),
            (vec!["x".to_owned(), "text".to_owned()], 3),
        ]
    );
}
