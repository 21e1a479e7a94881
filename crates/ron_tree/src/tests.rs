//! Tests of the parser as a whole: the values of valid source texts and the errors of invalid ones.

mod de;

use super::*;
use crate::diagnostic::Diagnostic;
use proptest::prelude::*;
use serde_json::json;

const RECIPE: &str = include_str!("tests/teapot.ron");

/// Returns the message and the spanned text of each error in a source text.
fn problems(source: &str) -> Vec<(String, &str)> {
    let place = |d: &Diagnostic| d.span.map_or("", |span| span.of(source));
    parse(source)
        .diagnostics
        .iter()
        .map(|d| (d.message.clone(), place(d)))
        .collect()
}

/// Returns the only error in a source text.
fn problem(source: &str) -> (String, &str) {
    let mut found = problems(source);
    assert_eq!(found.len(), 1, "{source}\n{found:#?}");
    found.remove(0)
}

#[test]
fn a_recipe_is_parsed() {
    let parsed = parse(RECIPE);

    assert_eq!(parsed.diagnostics, []);
    let steps = parsed.value.field("steps").unwrap().items().unwrap();
    assert_eq!(steps.len(), 8);
    assert_eq!(steps[0].name().unwrap().0, "Load");
    assert_eq!(
        steps[0].field("path").unwrap().as_str(),
        Some("assets/teapot.bez")
    );
    assert_eq!(
        to_json(&steps[5]),
        json!({"VertexNormals": {"weight": "Area"}})
    );
}

#[test]
fn a_printed_value_is_parsed_as_the_same_value() {
    let value = parse(RECIPE).value;

    let reparsed = parse(&value.to_string());

    assert_eq!(reparsed.diagnostics, []);
    assert_eq!(to_json(&reparsed.value), to_json(&value));
}

#[test]
fn five_mistakes_in_five_steps_give_five_errors() {
    let source = r#"(
    recipe: 1,
    steps: [
        Load(path "assets/teapot.bez"),
        Tessellate(segments: 8u32),
        Weld(distance = 1e-6),
        FlipEdges(edges: Random(count: 24 seed: 7)),
        LoopSubdivide(levels: 1,
        VertexNormals(weight: Area),
        Save(path: "teapot.glb"),
    ],
)"#;

    let found = problems(source);

    assert_eq!(found.len(), 5, "{found:#?}");
    let steps = parse(source)
        .value
        .field("steps")
        .unwrap()
        .items()
        .unwrap()
        .len();
    assert_eq!(steps, 7);
}

/// Returns a recipe in which one step is replaced by the given text.
fn with_step(step: &str) -> String {
    format!(
        "(\n    recipe: 1,\n    steps: [\n        Load(path: \"a.bez\"),\n        {step}\n        \
         Save(path: \"b.obj\"),\n    ],\n    expect: [Manifold],\n)\n"
    )
}

#[test]
fn one_mistake_gives_one_error_and_the_other_steps_are_parsed() {
    for step in [
        "Loop(levels 1),",
        "Loop(levels = 1),",
        "Loop(levels: ),",
        "Loop(levels: , creases: All),",
        "Loop(levels: creases: All),",
        "Loop(levels:: 1),",
        "Loop(levels: 1 creases: All),",
        "Loop(levels: 1; creases: All),",
        "Loop(levels: 1,, creases: All),",
        "Loop(, levels: 1),",
        "Loop(levels: 1, creases),",
        "Loop(levels: 1, All),",
        "Loop(All, levels: 1),",
        "Loop(levels: 1, Random(count: 3)),",
        "Loop(\"levels\": 1),",
        "Loop(levels: 1)",
        "Loop(levels: 1);",
        "Loop(levels: 1,",
        "Loop(levels: 1],",
        "Loop(levels: 1},",
        "Loop(levels: 1)),",
        "Flip(edges: Vertices([1, 2)),",
        "Flip(edges: Vertices([1, 2, 3)),",
        "Flip(edges: Vertices([1 2])),",
        "Flip(edges: Vertices([1, 2]),",
        "Flip(edges: Vertices[1, 2]),",
        "Flip(edges: And([a: 1, Sharp])),",
        "Move(by: (0, 0, 1], about: Center),",
        "Move(by: (0, 0, 1, about: Center),",
        "Loop(levels: @),",
        "Loop(levels: 1 @),",
        "Loop(levels: 1 % 2),",
        "@ Loop(levels: 1),",
        "Loop(levels: 1e),",
        "Loop(levels: 1..2),",
        "Loop(levels: 0x),",
        "Load(path: 'a.bez'),",
        "Load(path: b\"a.bez\"),",
        "Load(path: \"a.bez),",
        "Load(path: \"a.bez, name: \"b\"),",
        "Load(path: \"C:\\models\"),",
        "Load(path: \"a.bez\", path: \"b.bez\"),",
        "Load(path: \"a\" : \"b\"),",
        "Param(set: {\"a\": 1, \"a\": 2}),",
        "Param(set: {\"a\" 1}),",
        "Param(set: {\"a\" = 1}),",
        "Param(set: {\"a\"}),",
        "#![enable(implicit_some)],",
        "(id: \"x\", run: Loop(levels: 1),",
        "(id: \"x\" run: Loop(levels: 1)),",
        "(id: \"x\", run Loop(levels: 1)),",
        "Loop(\n            levels: 1,\n        ],",
        "Loop(\n            levels: 1,\n",
    ] {
        let source = with_step(step);
        let found = problems(&source);
        assert_eq!(found.len(), 1, "{source}\n{found:#?}");
        let value = parse(&source).value;
        let steps = value.field("steps").and_then(Value::items);
        let last = steps.and_then(|steps| steps.iter().rfind(|s| s.name().is_some()));
        assert_eq!(
            last.and_then(Value::name).map(|n| n.0),
            Some("Save"),
            "{source}"
        );
        assert!(value.field("expect").is_some(), "{source}");
    }
}

#[test]
fn a_missing_outer_bracket_gives_one_or_two_errors() {
    let recipe = with_step("Loop(levels: 1),");
    for broken in [
        recipe.replacen("    ],\n", "", 1),
        recipe.replacen("    ],\n", "    ),\n", 1),
        recipe.replacen("\n)\n", "\n", 1),
        recipe.replacen("\n)\n", "\n]\n", 1),
        recipe.replacen("\n)\n", "\n))\n", 1),
        recipe.replacen("(\n", "\n", 1),
        recipe.replacen("steps: [", "steps: ", 1),
        recipe.replacen("steps: [", "steps [", 1),
        recipe.replacen("recipe: 1,", "recipe: 1", 1),
        recipe.replacen("Manifold]", "Manifold", 1),
        recipe.replacen("],\n    expect", "]\n    expect", 1),
        format!("{recipe} more"),
        format!("{recipe} /* more"),
        recipe.replace("Manifold", "/* Manifold"),
    ] {
        let found = problems(&broken);
        assert!((1..=2).contains(&found.len()), "{broken}\n{found:#?}");
    }
}

#[test]
fn messages_tell_what_is_missing_and_where() {
    assert_eq!(problem("(a 1)"), ("missing `:`".into(), ""));
    assert_eq!(problem("(a = 1)"), ("expected `:`, found `=`".into(), "="));
    assert_eq!(problem("(a: )"), ("missing the value of `a`".into(), ""));
    assert_eq!(problem("[1 2]"), ("missing `,`".into(), ""));
    assert_eq!(
        problem("[1,, 2]"),
        ("expected a value, found `,`".into(), ",")
    );
    assert_eq!(
        problem("[1; 2]"),
        ("expected `,` or `]`, found `;`".into(), ";")
    );
    assert_eq!(
        problem("[1, 2"),
        ("the text ends before this `[` is closed".into(), "[")
    );
    assert_eq!(problem("(a: [1, 2)").0, "this `[` is not closed");
    assert_eq!(problem("[1, 2)"), ("expected `]`, found `)`".into(), ")"));
    assert_eq!(
        problem("[\n1, 2), 3\n]"),
        ("`)` has no matching opening bracket".into(), ")")
    );
    assert_eq!(problem("[1 @ , 2]"), ("unexpected `@`".into(), "@"));
    assert_eq!(
        problem("\"a"),
        ("this string has no closing quote".into(), "\"a")
    );
    assert_eq!(
        problem("[1] /* a"),
        ("this comment is not closed".into(), "/*")
    );
    assert_eq!(problem("5m"), ("`5m` is not a number".into(), "5m"));
    assert_eq!(
        problem("'ab'").0,
        "more than one character in single quotes"
    );
    assert_eq!(
        problem("b'a'").0,
        "byte strings are not supported in recipes"
    );
    assert_eq!(
        problem("(1, a: 2)").0,
        "named and unnamed values cannot be mixed"
    );
    assert_eq!(
        problem("(\"a\": 2)").0,
        "field names are written without quotes"
    );
    assert_eq!(
        problem("1 2"),
        ("expected the end of the text, found `2`".into(), "2")
    );
    assert_eq!(
        problem(""),
        ("expected a value, found the end of the text".into(), "")
    );
    assert_eq!(
        problem(" // only a comment").0,
        "expected a value, found the end of the text"
    );
}

#[test]
fn a_field_given_twice_has_both_spans() {
    let source = "(a: 1, b: 2, a: 3)";
    let found = parse(source).diagnostics;

    assert_eq!(found.len(), 1);
    assert_eq!(found[0].message, "the field `a` is given twice");
    assert_eq!(
        (found[0].span.unwrap().start, found[0].labels[0].0.start),
        (13, 1)
    );
}

#[test]
fn attributes_that_enable_extensions_are_refused() {
    assert_eq!(
        problems("#![schema = \"recipe-1\"] #![type = \"x\"] (a: 1)"),
        []
    );
    assert_eq!(
        problem("#![enable(implicit_some, unwrap_newtypes)]\n(a: 1)"),
        (
            "recipes cannot enable extensions of RON".into(),
            "#![enable(implicit_some, unwrap_newtypes)]"
        )
    );
    assert_eq!(problem("#![foo]\n(a: 1)").0, "unknown attribute");
    assert_eq!(
        problem("#!(a: 1)").0,
        "expected an attribute `#![..]`, found `(`"
    );
}

#[test]
fn depth_is_limited() {
    let nested = |n: usize| "[".repeat(n) + &"]".repeat(n);

    assert_eq!(problems(&nested(MAX_DEPTH)), []);
    assert_eq!(
        problem(&nested(MAX_DEPTH + 1)).0,
        "brackets are nested more than 128 levels deep"
    );
    assert_eq!(
        problem(&format!("[{}, {}]", nested(10_000), nested(10_000))).1,
        "["
    );
    assert_eq!(problems(&"(a: [".repeat(100_000)).len(), 2);
}

#[test]
fn hostile_texts_take_little_time() {
    for part in [
        "@ ",
        "[}",
        "(a: (",
        "{",
        "]",
        "a b ",
        ", ",
        "\"\n",
        "a: ",
        "'",
        "#![",
        "[)",
        "/*",
        "(a: 1\n b(",
    ] {
        let found = parse(&part.repeat(100_000)).diagnostics;
        assert!((1..=101).contains(&found.len()), "{part}: {}", found.len());
    }
}

#[test]
fn a_text_that_is_too_large_is_refused() {
    let found = parse(&" ".repeat(MAX_BYTES + 1)).diagnostics;
    assert_eq!(
        found[0].message,
        "the text has 67108865 bytes, expected at most 67108864"
    );

    let found = parse(&format!("[{}]", "1,".repeat(MAX_VALUES + 1))).diagnostics;
    assert_eq!(found.len(), 1);
    assert_eq!(
        found[0].message,
        "too many values: the rest of the text was not read"
    );
}

#[test]
fn a_byte_order_mark_and_windows_line_ends_are_accepted() {
    assert_eq!(problems("\u{feff}(a: 1,\r\n b: 2)\r\n"), []);
}

/// Generates valid RON text.
fn any_ron() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        Just("true".to_owned()),
        Just("()".to_owned()),
        "[A-Z][a-z]{0,3}",
        "-?[0-9]{1,4}(\\.[0-9]{1,3})?",
        "\\PC{0,6}".prop_map(|s| string_literal(&s)),
        "[^'\\\\\\n]".prop_map(|c| format!("'{c}'")),
    ];
    leaf.prop_recursive(4, 40, 4, |inner| {
        let items = prop::collection::vec(inner.clone(), 1..4);
        prop_oneof![
            items.clone().prop_map(|v| format!("[{}]", v.join(" , "))),
            items.clone().prop_map(|v| format!("({},)", v.join(","))),
            (items.clone(), "[A-Z][a-z]{0,3}").prop_map(|(v, n)| format!("{n}({})", v.join(","))),
            items.clone().prop_map(|v| {
                let fields = v
                    .iter()
                    .enumerate()
                    .map(|(i, v)| format!("f{i}: {v} // c\n"));
                format!("({})", fields.collect::<Vec<_>>().join(","))
            }),
            items.prop_map(|v| {
                let entries = v
                    .iter()
                    .enumerate()
                    .map(|(i, v)| format!("\"k{i}\": {v} /* c */"));
                format!("{{{}}}", entries.collect::<Vec<_>>().join(","))
            }),
        ]
    })
}

proptest! {
    #[test]
    fn any_text_is_parsed(text in "(\\PC|[()\\[\\]{}:,;=#!\"'/*\\\\ \n]|[a-z0-9]){0,120}") {
        let parsed = parse(&text);
        for d in &parsed.diagnostics {
            let span = d.span.unwrap();
            prop_assert!(text.get(span.range()).is_some(), "{:?}", d);
        }
        let _ = (to_json(&parsed.value), parsed.value.to_string());
        // A text with a value that cannot be read must have a diagnostic.
        if parsed.diagnostics.is_empty() {
            prop_assert!(!parsed.value.has_errors());
        }
    }

    #[test]
    fn a_recipe_with_a_part_removed_is_parsed(start in 0..RECIPE.len(), length in 0_usize..40) {
        let end = (start + length).min(RECIPE.len());
        let text = format!("{}{}", &RECIPE[..start], &RECIPE[end..]);
        let parsed = parse(&text);
        prop_assert!(parsed.diagnostics.len() < 25, "{:#?}", parsed.diagnostics);
    }

    #[test]
    fn any_printed_value_is_parsed_as_the_same_value(text in any_ron()) {
        let parsed = parse(&text);
        prop_assert_eq!(&parsed.diagnostics, &[]);
        let printed = parsed.value.to_string();
        let reparsed = parse(&printed);
        prop_assert_eq!(&reparsed.diagnostics, &[]);
        prop_assert_eq!(reparsed.value.to_string(), printed);
        prop_assert_eq!(to_json(&reparsed.value), to_json(&parsed.value));
    }

    #[test]
    fn every_span_covers_its_value(text in any_ron()) {
        fn check(value: &Value, text: &str) {
            let alone = parse(value.span.of(text));
            assert_eq!(to_json(&alone.value), to_json(value));
            value.fields().iter().for_each(|f| check(&f.value, text));
            value.items().into_iter().flatten().for_each(|v| check(v, text));
        }
        check(&parse(&text).value, &text);
    }

    #[test]
    fn ron_accepts_the_same_valid_texts(text in any_ron()) {
        let read = ron::from_str::<serde::de::IgnoredAny>(&text);
        prop_assert!(read.is_ok(), "{}\n{:?}", text, read);
    }
}
