//! Tests of checking texts against schemas. The results are compared with the texts that the crate `ron` accepts.

use super::*;
use crate::substitute;
use proptest::prelude::*;
use ron_tree::{Lexer, parse, to_json};
use schemars::{JsonSchema, schema_for};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// An operation with every kind of parameter.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Everything {
    #[schemars(range(min = 0, max = 5))]
    levels: u32,
    #[serde(default)]
    edges: Selection,
    #[serde(default)]
    weight: Weight,
    at: Option<Vector>,
    #[schemars(length(min = 1, max = 8))]
    #[serde(default = "a_name")]
    name: String,
    tag: Option<String>,
    #[serde(default)]
    other: Option<Box<Selection>>,
    #[serde(default)]
    #[schemars(length(max = 3))]
    list: Vec<Weight>,
    #[serde(default)]
    grid: [u8; 2],
    #[serde(default)]
    map: BTreeMap<String, f32>,
    #[serde(default)]
    flag: bool,
    #[serde(default)]
    nothing: (),
    #[serde(default)]
    letter: char,
    #[serde(default)]
    nested: Nested,
    #[serde(default)]
    single: f32,
    #[serde(default)]
    signed: i8,
    #[serde(default)]
    size: Size,
    #[serde(default)]
    signed_size: Option<i64>,
}

fn a_name() -> String {
    "a".to_owned()
}

#[derive(Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
enum Selection {
    #[default]
    All,
    Boundary,
    Between(u32, u32),
    Vertices(Vec<u32>),
    Sharp {
        #[schemars(range(min = 0.0, max = 180.0))]
        above: f64,
    },
    Random {
        count: u64,
        #[serde(default)]
        of: Option<Box<Self>>,
    },
    Tagged(String),
    And(Vec<Self>),
    Not(Box<Self>),
    Valence(#[schemars(range(min = 1))] u32),
    Inside(Nested),
    Near(Vector),
    Maybe(Option<f64>),
    Empty(),
    Bare {},
    Within([f64; 2]),
    Named(BTreeMap<String, u8>),
}

#[derive(Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
enum Weight {
    #[default]
    Area,
    Angle,
    Uniform,
}

#[derive(Debug, Default, Deserialize, Serialize, JsonSchema)]
struct Vector(f64, f64, f64);

#[derive(Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Nested {
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    width: Option<f64>,
    #[serde(default)]
    inner: Option<Box<Nested>>,
}

#[derive(Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(transparent)]
struct Size(usize);

fn schema() -> Json {
    schema_for!(Everything).to_value()
}

/// Returns the errors of a text, as `spanned text: message`.
fn problems(source: &str) -> Vec<String> {
    let parsed = parse(source);
    assert_eq!(parsed.diagnostics, [], "{source}");
    let problems = check_step(&parsed.value, &schema()).wrong;
    problems
        .iter()
        .map(|d| format!("{}: {}", d.span.unwrap().of(source), d.message))
        .collect()
}

/// Returns the only error of a step that has these parameters and the valid parameter `levels`.
fn problem(parameters: &str) -> String {
    let mut found = problems(&format!("Everything(levels: 1, {parameters})"));
    assert_eq!(found.len(), 1, "{parameters}: {found:#?}");
    found.remove(0)
}

/// Returns the help text of the only error of a step that has these parameters and the valid parameter `levels`.
fn help(parameters: &str) -> String {
    let parsed = parse(&format!("Everything(levels: 1, {parameters})"));
    check_step(&parsed.value, &schema())
        .wrong
        .remove(0)
        .help
        .unwrap()
}

/// Valid parameters. Each uses a different feature.
const GOOD: &[&str] = &[
    "levels: 0",
    "levels: 0x5, edges: All",
    "levels: 1, edges: Between(0, 4_000_000_000)",
    "levels: 1, edges: Vertices([])",
    "levels: 1, edges: Vertices([1, 2, 3])",
    "levels: 1, edges: Sharp(above: 30)",
    "levels: 1, edges: Random(count: 3, of: Not(Boundary))",
    "levels: 1, edges: Random(count: 3, of: Some(Not(Boundary)))",
    "levels: 1, edges: Random(count: 3, of: None)",
    "levels: 1, edges: And([All, Not(And([])), Tagged(\"x\")])",
    "levels: 1, edges: Valence(6)",
    "levels: 1, edges: Inside((width: 2.5, inner: Nested(width: 1)))",
    "levels: 1, edges: Near((0, 0, 1))",
    "levels: 1, edges: Near(Vector(0, 0, 1))",
    "levels: 1, edges: Maybe(None)",
    "levels: 1, edges: Maybe(1.5)",
    "levels: 1, edges: Maybe(Some(1.5))",
    "levels: 1, edges: Empty()",
    "levels: 1, edges: Bare()",
    "levels: 1, edges: Within((0, 1))",
    "levels: 1, edges: Named({\"a\": 1})",
    "levels: 1, weight: Angle, at: (0, -1.5, 1e-3)",
    "levels: 1, at: Some((0, 0, 0)), tag: Some(\"a\")",
    "levels: 1, at: None, tag: \"b\", name: \"äöüßäöüß\"",
    "levels: 1, other: Boundary, list: [Area, Angle], grid: (1, 255)",
    "levels: 1, map: {\"a\": 1.5, \"b\": 2}",
    "levels: 1, flag: true, nothing: (), letter: 'x'",
    "levels: 1, nested: (inner: (inner: ())), single: 1e30, signed: -128",
    "levels: 1, size: 18446744073709551615, signed_size: -9223372036854775808",
];

#[test]
fn valid_parameters_have_no_errors_and_are_read_by_ron() {
    for parameters in GOOD {
        let source = format!("Everything({parameters})");
        assert_eq!(problems(&source), [""; 0], "{source}");
        let read: Result<Everything, _> = ron_options().from_str(&source);
        let read = read.unwrap_or_else(|e| panic!("{source}: {e}"));
        if ["Vector(", "Nested(", "Empty(", "nothing"]
            .iter()
            .any(|name| source.contains(name))
        {
            // These texts are not converted to JSON here: without a schema, the name of a struct looks like a variant,
            // and `()` looks like a unit.
            continue;
        }
        // `to_json` gives the same JSON as serde, except for defaults.
        let given = to_json(&parse(&source).value);
        let (given, read) = (&given["Everything"], serde_json::to_value(&read).unwrap());
        let again: Everything = serde_json::from_value(given.clone()).unwrap();
        assert_eq!(serde_json::to_value(&again).unwrap(), read, "{source}");
    }
}

#[test]
fn unknown_fields_are_reported_with_a_suggestion() {
    assert_eq!(
        problem("egdes: All"),
        "egdes: unknown field `egdes` in `Everything`"
    );
    assert_eq!(help("egdes: All"), "did you mean `edges`?");
    assert_eq!(
        problem("edges: Sharp(above: 1, x: 2)"),
        "x: unknown field `x` in `Sharp`"
    );
    assert_eq!(help("edges: Sharp(above: 1, x: 2)"), "fields: `above`");
    assert_eq!(
        problem("nested: (x: 2)"),
        "x: unknown field `x` in `nested`"
    );
}

#[test]
fn missing_fields_are_reported_at_the_name() {
    assert_eq!(
        problems("Everything"),
        ["Everything: `Everything` needs `levels`"]
    );
    assert_eq!(
        problems("Everything(flag: true)"),
        ["Everything: `Everything` needs `levels`"]
    );
    assert_eq!(problem("edges: Random()"), "Random: `Random` needs `count`");
    assert_eq!(
        help("edges: Random()"),
        "write `count:` with a whole number"
    );
}

#[test]
fn a_wrong_type_tells_what_was_expected_and_found() {
    assert_eq!(
        problems("Everything(levels: 1.5)"),
        ["1.5: expected a whole number for `levels`, found 1.5"]
    );
    for (parameter, message) in [
        (
            "flag: 1",
            "1: expected `true` or `false` for `flag`, found 1",
        ),
        (
            "flag: True",
            "True: expected `true` or `false` for `flag`, found `True`",
        ),
        ("name: 1", "1: expected a string for `name`, found 1"),
        ("name: a", "a: expected a string for `name`, found `a`"),
        (
            "name: 'a'",
            "'a': expected a string for `name`, found the character 'a'",
        ),
        (
            "letter: \"a\"",
            "\"a\": expected a character `'c'` for `letter`, found the string \"a\"",
        ),
        (
            "single: \"1\"",
            "\"1\": expected a number for `single`, found the string \"1\"",
        ),
        (
            "single: 0x10",
            "0x10: expected a decimal number for `single`, found 0x10",
        ),
        (
            "single: None",
            "None: expected a number for `single`, found `None`",
        ),
        (
            "single: Some(1)",
            "Some(1): expected a number for `single`, found `Some(..)`",
        ),
        ("nothing: 1", "1: expected `()` for `nothing`, found 1"),
        (
            "nothing: ( )",
            "( ): expected `()` for `nothing`, found `()`",
        ),
        (
            "map: (a: 1)",
            "(a: 1): expected a map `{..}` for `map`, found named fields `(name: ..)`",
        ),
        (
            "map: {a: 1}",
            "a: expected a string `\"..\"` as the key for `map`, found `a`",
        ),
        (
            "map: {\"k\": true}",
            "true: expected a number for `k`, found `true`",
        ),
        (
            "list: (Area)",
            "(Area): expected a list `[..]` for `list`, found a value in brackets `(..)`",
        ),
        (
            "list: [1]",
            "1: expected one of `Area`, `Angle`, `Uniform` in `list`, found 1",
        ),
        (
            "nested: [1]",
            "[1]: expected named fields `(width: ..)` for `nested`, found a list `[..]`",
        ),
        (
            "nested: Other(width: 1)",
            "Other(width: 1): expected named fields `(width: ..)` for `nested`, found `Other(..)`",
        ),
        (
            "at: [0, 0, 1]",
            "[0, 0, 1]: expected 3 values in brackets `(.., .., ..)` for `at`, found a list `[..]`",
        ),
        (
            "at: (0, 1)",
            "(0, 1): expected 3 values in brackets `(.., .., ..)` for `at`, found 2 values",
        ),
        (
            "at: (0, 1, true)",
            "true: expected a number in `at`, found `true`",
        ),
        ("edges: 7", "7: expected a `Selection` for `edges`, found 7"),
    ] {
        assert_eq!(problem(parameter), message);
    }
}

#[test]
fn unknown_variants_are_errors() {
    for (parameter, message) in [
        ("weight: Aera", "Aera: unknown variant `Aera` for `weight`"),
        ("weight: Area()", "(): `Area` takes no parameters"),
        (
            "weight: \"Area\"",
            "\"Area\": the variant `Area` must not be in quotes",
        ),
        ("edges: Random", "Random: `Random` needs parameters"),
        (
            "edges: Radnom(count: 1)",
            "Radnom: unknown variant `Radnom` for `edges`",
        ),
        (
            "edges: Between(1)",
            "(1): expected `Between(.., ..)`, found 1 value",
        ),
        (
            "edges: Between(1, 2, 3)",
            "(1, 2, 3): expected `Between(.., ..)`, found 3 values",
        ),
        (
            "edges: Between([1, 2])",
            "([1, 2]): expected `Between(.., ..)`, found 1 value",
        ),
        (
            "edges: Not()",
            "(): expected one value in `Not(..)`, found none",
        ),
        (
            "edges: Not(All, All)",
            "(All, All): expected one value in `Not(..)`, found 2 values",
        ),
        (
            "edges: Inside(width: 1)",
            "(width: 1): expected one value in `Inside(..)`, found named fields `(name: ..)`",
        ),
        (
            "edges: Near(0, 0, 1)",
            "(0, 0, 1): expected one value in `Near(..)`, found 3 values",
        ),
        (
            "edges: Vertices(1, 2)",
            "(1, 2): expected one value in `Vertices(..)`, found 2 values",
        ),
        (
            "edges: And([All, Not(Al)])",
            "Al: unknown variant `Al` for `Not`",
        ),
        ("edges: Empty", "Empty: `Empty` needs parameters"),
        (
            "edges: Random((count: 1))",
            "((count: 1)): expected named fields `(count: ..)` for `Random`, found a value in brackets `(..)`",
        ),
        ("edges: None", "None: unknown variant `None` for `edges`"),
    ] {
        let mut found = problems(&format!("Everything(levels: 1, {parameter})"));
        assert!(!found.is_empty(), "{parameter}");
        assert_eq!(found.remove(0), message);
    }
    assert_eq!(help("weight: Aera"), "did you mean `Area`?");
    assert_eq!(
        help("weight: Zebra"),
        "variants: `Area`, `Angle`, `Uniform`"
    );
    assert_eq!(help("edges: Random"), "write `Random(count: ..)`");
    // If a value is written without the name of its field, the help contains this name.
    assert_eq!(help("edges: Random(3)"), "write `(count: 3)`");
    assert_eq!(help("nested: 1.5"), "write `(width: 1.5)`");
    assert_eq!(help("at: Up"), "write numbers, such as `(0.5, 0.5, 0.5)`");
    assert_eq!(
        help("edges: Near(0, 0, 1)"),
        "inside the parentheses of `Near`, the value needs its own parentheses: `Near((.., .., ..))`"
    );
    assert_eq!(help("edges: Vertices(1, 2)"), "write `Vertices([..])`");
    assert_eq!(help("edges: Not()"), "the value must be a `Selection`");
}

#[test]
fn values_must_be_in_range() {
    assert_eq!(
        problems("Everything(levels: 9)"),
        ["9: `levels` is 9, expected at most 5"]
    );
    for (parameter, message, advice) in [
        (
            "signed: 200",
            "200: `signed` is 200, expected at most 127",
            "allowed: -128 to 127",
        ),
        (
            "size: -1",
            "-1: `size` is -1, expected at least 0",
            "allowed: 0 to 18446744073709551615",
        ),
        (
            "edges: Sharp(above: 190.5)",
            "190.5: `above` is 190.5, expected at most 180",
            "allowed: 0 to 180",
        ),
        (
            "edges: Valence(0)",
            "0: `Valence` is 0, expected at least 1",
            "allowed: 1 to 4294967295",
        ),
        (
            "edges: Between(-1, 2)",
            "-1: a value in `Between` is -1, expected at least 0",
            "allowed: 0 to 4294967295",
        ),
        (
            "edges: Vertices([5000000000])",
            "5000000000: a value in `Vertices` is 5000000000, expected at most 4294967295",
            "allowed: 0 to 4294967295",
        ),
        (
            "nested: (width: 0)",
            "0: `width` is 0, expected more than 0",
            "allowed: more than 0",
        ),
        (
            "single: 1e39",
            "1e39: expected a finite number for `single`, found 1e39",
            "the largest number is 3.4028234663852886e38",
        ),
    ] {
        assert_eq!(problem(parameter), message);
        assert_eq!(help(parameter), advice);
    }
    assert_eq!(
        problem("single: inf"),
        "inf: expected a finite number for `single`, found inf"
    );
    assert_eq!(
        problem("single: -NaN"),
        "-NaN: expected a finite number for `single`, found -NaN"
    );
    let huge = "9".repeat(50);
    assert_eq!(
        problem(&format!("size: {huge}")).len(),
        50 + ": `size` is , expected at most 18446744073709551615".len() + 50
    );
}

#[test]
fn lengths_are_checked() {
    assert_eq!(
        problem("name: \"\""),
        "\"\": `name` has 0 characters, expected at least 1"
    );
    assert_eq!(
        problem("name: \"123456789\""),
        "\"123456789\": `name` has 9 characters, expected at most 8"
    );
    assert_eq!(
        problem("list: [Area, Area, Area, Area]"),
        "[Area, Area, Area, Area]: `list` has 4 items, expected at most 3"
    );
}

#[test]
fn a_wrong_name_of_a_required_field_is_one_error() {
    let found = problem("edges: Random(amount: 3)");
    assert!(found.contains("unknown field `amount`"), "{found}");
    assert_eq!(
        help("edges: Random(amount: 3)"),
        "write `count:` with a whole number instead"
    );
    assert_eq!(help("edges: Random(cuont: 3)"), "did you mean `count`?");
    problem("edges: Random(cuont: 3)");
}

#[test]
fn every_error_of_a_step_is_found() {
    let source = "Everything(levels: 9, egdes: All, weight: Aera, \
                  other: And([Between(1), Sharp(abve: 1), Valence(0)]), at: (0, 0))";

    let found = problems(source);

    assert_eq!(
        found,
        [
            "9: `levels` is 9, expected at most 5",
            "egdes: unknown field `egdes` in `Everything`",
            "Aera: unknown variant `Aera` for `weight`",
            "(1): expected `Between(.., ..)`, found 1 value",
            "abve: unknown field `abve` in `Sharp`",
            "0: `Valence` is 0, expected at least 1",
            "(0, 0): expected 3 values in brackets `(.., .., ..)` for `at`, found 2 values",
        ]
    );
}

#[test]
fn unreadable_fields_are_not_reported_as_missing() {
    for source in [
        "Everything(levels: @)",
        "Everything(levels 1)",
        "Everything(: 1)",
        "Everything(1e)",
    ] {
        let parsed = parse(source);
        assert_ne!(parsed.diagnostics, []);
        assert_eq!(check_step(&parsed.value, &schema()).wrong, [], "{source}");
    }
}

#[test]
fn errors_name_the_parameter_that_the_value_comes_from() {
    let source = "Everything(levels: arg(\"n\"))";
    let mut value = parse(source).value;
    assert_eq!(substitute(&mut value, |_, _| Ok(parse("9").value)), []);

    let found = check_step(&value, &schema()).wrong;

    assert_eq!(
        found[0].message,
        "`levels` is 9, expected at most 5 (from parameter `n`)"
    );
    assert_eq!(found[0].span.unwrap().of(source), "arg(\"n\")");
}

#[test]
fn trivial_and_recursive_schemas_are_handled() {
    let value = parse("(a: 1)").value;

    assert_eq!(check_schema(&value, &serde_json::json!(true)), []);
    assert_eq!(check_schema(&value, &serde_json::json!({"$ref": "#"})), []);
    assert_eq!(
        check_schema(
            &value,
            &serde_json::json!({"anyOf": [{"$ref": "#"}, {"$ref": "#"}]})
        ),
        []
    );
}

#[test]
fn errors_beyond_the_limit_are_counted() {
    let source = format!(
        "Everything(levels: 1, edges: Vertices([{}]))",
        "-1,".repeat(5000)
    );

    let found = check_step(&parse(&source).value, &schema()).wrong;

    assert_eq!(found.len(), 101);
    assert_eq!(found[100].message, "and 4900 more errors like these");
}

#[test]
fn deep_selections_are_read_by_ron() {
    let depth = 100;
    let source = format!(
        "Everything(levels: 1, edges: {}All{})",
        "Not(".repeat(depth),
        ")".repeat(depth)
    );

    assert_eq!(problems(&source), [""; 0]);
    assert!(ron_options().from_str::<Everything>(&source).is_ok());
}

/// Returns the options with which `ron` reads recipes: `Some(..)` can be omitted.
fn ron_options() -> ron::Options {
    ron::Options::default()
        .with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME)
        .without_recursion_limit()
}

/// Returns every token of [`GOOD`], and some tokens that are often invalid.
fn spare_tokens() -> Vec<String> {
    let mut tokens: Vec<String> = GOOD.iter().flat_map(|text| tokens(text)).collect();
    tokens.extend(
        [
            "-1", "1.5", "Some", "None", "()", "( )", "x", "inf", "[", "]", "{", "}", ";", "r#All",
            "0b1", "1_0", "''",
        ]
        .map(str::to_owned),
    );
    tokens.sort();
    tokens.dedup();
    tokens
}

fn tokens(text: &str) -> Vec<String> {
    Lexer::new(text)
        .map(|t| t.span.of(text).to_owned())
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    /// If the check reports no error for a text that is nearly valid, `ron` also accepts the text.
    #[test]
    fn texts_that_ron_refuses_have_errors(
        base in 0..GOOD.len(),
        edits in prop::collection::vec((0_usize..4, any::<prop::sample::Index>(), any::<prop::sample::Index>()), 1..3),
    ) {
        let spare = spare_tokens();
        let mut text = tokens(GOOD[base]);
        for (edit, at, other) in edits {
            let i = at.index(text.len());
            let token = spare[other.index(spare.len())].clone();
            match edit {
                0 => { text.remove(i); }
                1 => text.insert(i, token),
                2 => text[i] = token,
                _ => { let j = other.index(text.len()); text.swap(i, j); }
            }
            if text.is_empty() { break; }
        }
        let source = format!("Everything({})", text.concat());
        let parsed = parse(&source);
        if parsed.diagnostics.is_empty() && check_step(&parsed.value, &schema()).wrong.is_empty() {
            let body = match &parsed.value.kind {
                ValueKind::Call(call) => call.body.span.of(&source),
                _ => "()",
            };
            let read: Result<Everything, _> = ron_options().from_str(body);
            prop_assert!(read.is_ok(), "{}\n{:?}", source, read);
        }
    }
}
