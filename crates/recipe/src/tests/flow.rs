//! Tests of steps that contain steps, of presets, and of losses.

use std::path::Path;

use super::{Reading, checked, read, registry, run, shown, steps};
use crate::{Source, Values};

/// Returns the labels of the steps.
fn labels(reading: &Reading) -> Vec<&str> {
    let steps = reading.recipe.steps.iter();
    steps.map(crate::RecipeStep::label).collect()
}

/// Returns the canonical parameters of the steps.
fn canonical(reading: &Reading) -> Vec<String> {
    let steps = reading.recipe.steps.iter();
    steps
        .map(|s| s.step.as_ref().expect("it was read").canonical())
        .collect()
}

fn read_file(path: &Path, values: Values) -> Reading {
    crate::read(&Source::open(path).unwrap(), &registry(), values)
}

/// Creates a folder with these files.
fn folder(texts: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in texts {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    folder
}

#[test]
fn a_repetition_is_replaced_by_its_repeated_steps() {
    let reading = read(&steps(
        r#"Sheet(columns: 2), Repeat(times: 2, steps: [
            (id: "up", run: Lift(by: 1)),
            Repeat(times: 2, steps: [Lift(by: 3)]),
        ])"#,
    ));
    assert_eq!(
        labels(&reading),
        [
            "Sheet", "up#1", "Lift#1.1", "Lift#1.2", "up#2", "Lift#2.1", "Lift#2.2"
        ]
    );
}

#[test]
fn random_choices_differ_between_repetitions() {
    let one = "Lift(by: 1, vertices: Random(count: 1, seed: 7))";
    let highest = |times: u32| {
        let text = steps(&format!(
            "Sheet(columns: 50), Repeat(times: {times}, steps: [{one}])"
        ));
        let outcome = run(&read(&text));
        let mesh = outcome.scene.as_ref().unwrap().objects()[0]
            .as_mesh()
            .unwrap();
        let lifted = mesh.positions().iter().filter(|p| p.z > 0.0).count();
        assert!(outcome.succeeded());
        lifted
    };
    assert!(highest(20) > 10, "not always the same vertex");
}

#[test]
fn expectations_after_a_step_must_hold_in_each_repetition() {
    let text = r#"(recipe: 1, steps: [
        Sheet(columns: 2),
        (id: "all", run: Repeat(times: 3, steps: [(id: "up", run: Lift(by: 1))])),
    ], expect: [
        (after: "up", that: Bounds(min: (-1, -0.5, 1), max: (1, 0.5, 1))),
        (after: "all", that: Bounds(min: (-1, -0.5, 3), max: (1, 0.5, 3))),
    ])"#;
    let outcome = run(&read(text));
    assert_eq!(outcome.checked, 4);
    let failed: Vec<_> = outcome.failures.iter().map(|f| f.span).collect();
    assert_eq!(failed.len(), 2, "{:?}", outcome.failures);
    let after: Vec<&str> = (outcome.failures.iter())
        .map(|failure| failure.labels[0].1.as_str())
        .collect();
    assert_eq!(after, ["after up#2", "after up#3"]);
}

#[test]
fn a_condition_takes_one_branch_and_reads_both() {
    let text = |by: &str| {
        format!(
            r#"(recipe: 1, params: {{
                "high": Bool(default: true),
                "kind": Choice(default: "Flat", of: ["Flat", "Steep"]),
            }}, steps: [
                Sheet(columns: 2),
                If(param: "high", steps: [(id: "up", run: Lift(by: 1))], otherwise: [(id: "up", run: Lift(by: {by}))]),
                If(param: "kind", is: Steep, steps: [Lift(by: 9)]),
            ], expect: [(after: "up", that: Faces(eq: 2))])"#
        )
    };
    let set = |pairs: &[(&str, &str)]| {
        let pairs: Vec<_> = (pairs.iter())
            .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()))
            .collect();
        let values = Values {
            set: &pairs,
            ..Values::default()
        };
        let reading = crate::read(&Source::new("a.ron", text("2")), &registry(), values);
        assert_eq!(reading.diagnostics, []);
        canonical(&reading)[1..]
            .iter()
            .map(|c| c[..6].to_owned())
            .collect::<Vec<_>>()
    };
    assert_eq!(set(&[]), ["(by:1."]);
    assert_eq!(set(&[("high", "false")]), ["(by:2."]);
    assert_eq!(set(&[("kind", "Steep")]), ["(by:1.", "(by:9."]);
    let wrong = text("\"no\"");
    assert_eq!(
        shown(&wrong, &read(&wrong).diagnostics)[0].1,
        "expected a number for `by`, found the string \"no\""
    );
}

#[test]
fn errors_in_inner_steps_are_reported_like_others() {
    let text = r#"(recipe: 1, params: {"n": Int(default: 2)}, steps: [
        Repeat(times: -1, steps: []),
        Repeat(tims: 1, steps: [Lft(by: 1)]),
        If(param: "n", steps: []),
        If(param: "m", steps: []),
        If(param: "n", is: "two", steps: []),
        (on: ["a"], run: If(param: "n", is: 1, steps: [])),
        Repat(times: 1, steps: []),
    ])"#;
    let reading = read(text);
    let found: Vec<_> = (shown(text, &reading.diagnostics).into_iter())
        .map(|(place, message, _)| (place, message))
        .collect();
    assert_eq!(
        found,
        [
            ("-1", "`times` is -1, expected at least 0"),
            ("tims", "unknown field `tims` in `Repeat`"),
            ("Lft", "unknown operation `Lft`"),
            ("\"n\"", "`n` has the type Int, expected Bool"),
            ("\"m\"", "the recipe has no parameter `m`"),
            (
                "\"two\"",
                "`n` cannot have this value: expected a whole number, found the string \"two\""
            ),
            ("[\"a\"]", "If does not take `on`"),
            ("Repat", "unknown operation `Repat`"),
        ]
    );
    assert_eq!(
        reading.diagnostics[7].help.as_deref(),
        Some("did you mean `Repeat`?")
    );
}

#[test]
fn nested_repetitions_are_limited() {
    let mut inner = "Lift(by: 1)".to_owned();
    for _ in 0..20 {
        inner = format!("Repeat(times: 100, steps: [{inner}])");
    }
    let text = steps(&format!("Sheet(columns: 1), {inner}"));
    let reading = read(&text);
    let messages: Vec<_> = reading
        .diagnostics
        .iter()
        .map(|d| d.message.as_str())
        .collect();
    assert_eq!(
        messages,
        ["the recipe has at least 1000001 steps, expected at most 100000"]
    );
}

const CLEAN: &str = r#"(recipe: 1,
    params: {"by": Float(default: 1, max: 9), "model": Path(default: "own.obj")},
    steps: [(id: "up", run: Lift(by: arg("by"))), Write(path: "{model.stem}.txt")],
    expect: [Faces(eq: 2), (after: "up", that: Manifold)])"#;

#[test]
fn a_recipe_is_called_with_values_for_its_parameters() {
    let folder = folder(&[
        ("lib/clean.ron", CLEAN),
        (
            "main.ron",
            r#"(recipe: 1, params: {"by": Float(default: 3)}, steps: [
                Sheet(columns: 2),
                Call(recipe: "lib/clean.ron"),
                (id: "again", run: Call(recipe: "lib/clean.ron", with: {"by": arg("by"), "model": "cow.obj"})),
                (id: "up", run: Lift(by: 1)),
            ], expect: [(after: "again", that: Faces(eq: 2)), (after: "up", that: Faces(max: 2))])"#,
        ),
    ]);
    let reading = read_file(&folder.path().join("main.ron"), Values::default());
    assert_eq!(reading.diagnostics, []);
    assert_eq!(
        labels(&reading),
        [
            "Sheet",
            "clean/up",
            "clean/Write",
            "again/up",
            "again/Write",
            "up"
        ]
    );
    assert!(canonical(&reading)[3].starts_with("(by:3.0"));
    let recipe = &reading.recipe;
    let after: Vec<_> = recipe.expectations.iter().map(|p| p.after).collect();
    assert_eq!(
        after,
        [Some(1), Some(2), Some(3), Some(4), Some(4), Some(5)]
    );
    let model = recipe.scopes[2].parameters[1].value.to_string();
    assert_eq!(model, "\"../cow.obj\"", "the file beside the caller");
    let called = &recipe.files(&op::Files::default())[2];
    assert_eq!(called.input, folder.path().join("lib"));
    assert_eq!(called.placeholders[0].1, "cow");
}

#[test]
fn errors_of_a_call_are_reported_where_they_are() {
    let folder = folder(&[
        ("clean.ron", CLEAN),
        ("broken.ron", "(recipe: 1, steps: [Lift(by: \"x\")])"),
        (
            "main.ron",
            r#"(recipe: 1, steps: [
                Sheet(columns: 2),
                Call(recipe: "clean.ron", with: {"by": 10, "bye": 1}),
                Call(recipe: "claen.ron"),
                Call(recipe: "broken.ron"),
            ])"#,
        ),
    ]);
    let reading = read_file(&folder.path().join("main.ron"), Values::default());
    let found: Vec<_> = (reading.diagnostics.iter())
        .map(|d| (d.source, d.message.as_str()))
        .collect();
    let missing = folder.path().join("claen.ron");
    let missing = format!(
        "cannot read {}: No such file or directory (os error 2)",
        missing.display()
    );
    assert_eq!(
        found,
        [
            (
                0,
                "this value of the parameter `by` is not allowed: 10 is above the maximum 9"
            ),
            (0, "the recipe has no parameter `bye`"),
            (0, missing.as_str()),
            (2, "expected a number for `by`, found the string \"x\""),
        ]
    );
    assert_eq!(
        reading.diagnostics[2].help.as_deref(),
        Some("did you mean `clean.ron`?")
    );
    let text = crate::render(&reading.recipe.sources, &reading.diagnostics, false);
    assert!(text.contains("broken.ron:1:30"), "{text}");
    assert!(text.contains("main.ron:5:30"), "called from there: {text}");
}

#[test]
fn recipes_that_call_each_other_in_a_cycle_are_listed() {
    let call = |name: &str| format!("(recipe: 1, steps: [Call(recipe: \"{name}\")])");
    let folder = folder(&[
        ("a.ron", &call("lib/b.ron")),
        ("lib/b.ron", &call("c.ron")),
        ("lib/c.ron", &call("../a.ron")),
    ]);
    let reading = read_file(&folder.path().join("a.ron"), Values::default());
    let [circle] = &reading.diagnostics[..] else {
        panic!("{:#?}", reading.diagnostics)
    };
    let at = |name: &str| folder.path().join(name).display().to_string();
    assert_eq!(
        circle.message,
        format!(
            "the recipe calls itself: {} -> {} -> {} -> {}",
            at("a.ron"),
            at("lib/b.ron"),
            at("lib/c.ron"),
            at("lib/../a.ron")
        )
    );
    assert_eq!((circle.source, circle.calls.len()), (2, 2));
}

#[test]
fn multiplying_calls_are_limited() {
    let names: Vec<String> = (0..30).map(|i| format!("{i}.ron")).collect();
    let texts: Vec<String> = (1..31)
        .map(|next| {
            let call = format!("Call(recipe: \"{next}.ron\")");
            format!("(recipe: 1, steps: [{call}, {call}, {call}, {call}])")
        })
        .collect();
    let mut files: Vec<(&str, &str)> = (names.iter().map(String::as_str))
        .zip(texts.iter().map(String::as_str))
        .collect();
    files.push(("30.ron", "(recipe: 1, steps: [])"));
    let folder = folder(&files);
    let reading = read_file(&folder.path().join("0.ron"), Values::default());
    assert!(reading.has_errors());
    assert!(reading.recipe.scopes.len() <= crate::MAX_STEPS + 1);
}

const PRESETS: &str = r#"(recipe: 1,
    params: {"n": Int(default: 2, max: 9), "by": Float(default: 1)},
    presets: {"fine": {"n": 8}, "high": {"by": 5, "n": 3}},
    steps: [Sheet(columns: arg("n")), Lift(by: arg("by"))])"#;

#[test]
fn set_values_override_presets_and_presets_override_defaults() {
    let with = |preset, set: &[(String, String)]| {
        let values = Values {
            set,
            preset,
            folder: None,
        };
        let reading = crate::read(&Source::new("a.ron", PRESETS), &registry(), values);
        let parameters = reading.recipe.parameters().iter();
        let literals: Vec<String> = parameters.map(|p| p.value.to_string()).collect();
        (literals.join(" "), reading)
    };
    assert_eq!(with(None, &[]).0, "2 1.0");
    assert_eq!(with(Some("fine"), &[]).0, "8 1.0");
    let set = [("n".to_owned(), "4".to_owned())];
    assert_eq!(with(Some("high"), &set).0, "4 5.0");
    let unknown = with(Some("fien"), &[]).1.diagnostics;
    assert_eq!(unknown[0].message, "the recipe has no preset `fien`");
    assert_eq!(unknown[0].help.as_deref(), Some("did you mean `fine`?"));
}

#[test]
fn every_preset_is_checked_against_the_parameters() {
    let text = PRESETS.replace("{\"n\": 8}", "{\"n\": 10, \"m\": 1, \"by\": Area}");
    let reading = read(&text);
    assert_eq!(
        shown(&text, &reading.diagnostics),
        [
            (
                "10",
                "this value of the parameter `n` is not allowed: 10 is above the maximum 9",
                ""
            ),
            (
                "\"m\"",
                "the recipe has no parameter `m`",
                "did you mean `n`?"
            ),
            (
                "Area",
                "this value of the parameter `by` is not allowed: expected a number, found `Area`",
                ""
            ),
        ]
    );
}

#[test]
fn a_tag_that_no_element_can_have_is_an_error_before_the_run() {
    let text = steps("Sheet(columns: 2), Lift(by: 1, vertices: Or([Boundary, Tagged(\"rim\")]))");
    let found = checked(&text, u64::MAX).diagnostics;
    assert_eq!(
        shown(&text, &found),
        [(
            "Tagged(\"rim\")",
            "no element of \"sheet\" is tagged \"rim\"",
            "no earlier step creates \"rim\""
        )]
    );
}

#[test]
fn a_where_without_a_bound_or_with_an_attribute_that_no_element_can_have_is_an_error() {
    let text = steps("Sheet(columns: 2), Lift(by: 1, vertices: Where(attribute: \"wall\"))");
    let found = checked(&text, u64::MAX).diagnostics;
    let shown = shown(&text, &found);
    let found: Vec<&str> = shown.iter().map(|(_, message, _)| &message[..]).collect();
    assert_eq!(
        found,
        [
            "`Where` has no bound",
            "\"sheet\" has no attribute \"wall\" before this step"
        ]
    );
}

#[test]
fn an_expected_attribute_that_cannot_exist_is_an_error_before_the_run() {
    let text = r#"(recipe: 1, steps: [Sheet(columns: 2)],
        expect: [HasAttribute(domain: Corner, name: "uv"), Not(HasAttribute(domain: Corner, name: "uv"))])"#;
    let found = checked(text, u64::MAX).diagnostics;
    assert_eq!(found.len(), 1);
    assert_eq!(
        found[0].message,
        "\"sheet\" has no corner attribute \"uv\" at this point of the recipe"
    );
}
