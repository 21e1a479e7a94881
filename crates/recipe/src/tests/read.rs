//! Tests of reading recipes. Every error is reported with its span in the text.

use super::{read, read_with, registry, shown, steps};
use crate::Severity;

#[track_caller]
fn has_one_error(text: &str, place: &str, message: &str, help: &str) {
    let reading = read(text);
    assert_eq!(
        shown(text, &reading.diagnostics),
        [(place, message, help)],
        "{text}"
    );
    assert!(reading.has_errors());
}

#[test]
fn five_mistakes_give_five_errors_at_their_spans() {
    let text = r#"(
        recipe: 1,
        steps: [
            Sheet(colums: 3, columns: 2),
            Lfit(by: 1),
            Lift(by: "high"),
            Sheet(columns: 0),
            (id: "last", run: Lift(vertices: Boundry)),
        ],
        expect: [Faces()],
    )"#;
    let reading = read(text);
    assert_eq!(
        shown(text, &reading.diagnostics),
        [
            (
                "colums",
                "unknown field `colums` in `Sheet`",
                "did you mean `columns`?"
            ),
            ("Lfit", "unknown operation `Lfit`", "did you mean `Lift`?"),
            (
                "\"high\"",
                "expected a number for `by`, found the string \"high\"",
                "write numbers without quotes"
            ),
            (
                "0",
                "`columns` is 0, expected at least 1",
                "allowed: 1 to 1000000"
            ),
            ("Lift", "`Lift` needs `by`", "write `by:` with a number"),
            (
                "Boundry",
                "unknown variant `Boundry` for `vertices`",
                "did you mean `Boundary`?"
            ),
            (
                "Faces()",
                "the expectation has no bound, so it can never fail",
                "add a bound, such as `eq`, `min` or `max`"
            ),
        ]
    );
    assert!(reading.has_errors());
    assert_eq!(reading.recipe.steps.len(), 5);
}

#[test]
fn a_recipe_without_errors_is_read_completely() {
    let text = r#"(
        recipe: 1,
        about: "two sheets",
        needs: "0.1",
        params: { "n": Int(default: 3, min: 1, max: 9, doc: "how many") },
        steps: [
            Sheet(columns: arg("n")),
            (id: "up", run: Lift(by: 1, vertices: Not(Boundary)), on: ["sheet"], note: "why"),
        ],
        expect: [(after: "up", on: ["sheet"], that: [Faces(eq: arg("n")), Manifold])],
    )"#;
    let reading = read(text);
    assert_eq!(reading.diagnostics, []);
    let recipe = reading.recipe;
    assert_eq!(recipe.about.as_deref(), Some("two sheets"));
    assert_eq!(recipe.parameters()[0].value.to_string(), "3");
    assert_eq!(recipe.steps[0].label(), "Sheet");
    assert_eq!(recipe.steps[1].label(), "up");
    assert_eq!(recipe.steps[1].span.of(text), "Lift");
    assert_eq!(recipe.steps[1].on_names(), Some(vec!["sheet".to_owned()]));
    assert_eq!(recipe.expectations.len(), 2);
    assert!(recipe.expectations.iter().all(|e| e.after == Some(1)));
    assert_eq!(recipe.expectations[1].span.of(text), "Manifold");
    let step = recipe.steps[0].step.as_ref().unwrap();
    assert_eq!(step.canonical(), "(columns:3,name:\"sheet\")");
}

#[test]
fn a_recipe_with_a_different_version_gives_one_error() {
    has_one_error(
        "(recipe: 2, stages: {\"new\": Things})",
        "2",
        "this recipe has the format version 2, expected 1",
        "a newer version of meshwright may be able to read the file",
    );
    has_one_error(
        "(recipe: 0, steps: [])",
        "0",
        "this recipe has the format version 0, expected 1",
        "write 1",
    );
}

#[test]
fn a_recipe_can_need_a_version_of_the_program() {
    let needs = |version: &str| format!("(recipe: 1, needs: \"{version}\", steps: [])");
    for fine in ["0", "0.1", "0.1.0", "0.0.99"] {
        assert_eq!(read(&needs(fine)).diagnostics, [], "{fine}");
    }
    let here = env!("CARGO_PKG_VERSION");
    has_one_error(
        &needs("99.1"),
        "\"99.1\"",
        &format!("this recipe needs meshwright 99.1, but this program has the version {here}"),
        "",
    );
    has_one_error(
        &needs("newest"),
        "\"newest\"",
        &format!("expected a version such as \"{here}\", found \"newest\""),
        "",
    );
}

#[test]
fn unknown_fields_of_recipes_and_steps_are_errors() {
    has_one_error(
        "(recipe: 1, steps: [], expct: [])",
        "expct",
        "unknown field `expct`",
        "did you mean `expect`?",
    );
    has_one_error(
        &steps("(run: Sheet(columns: 1), nots: \"x\")"),
        "nots",
        "unknown field `nots`",
        "did you mean `note`?",
    );
    let missing = read("(recipe: 1)");
    assert_eq!(missing.diagnostics[0].message, "`steps` is missing");
}

#[test]
fn the_help_says_where_fields_of_steps_and_expectations_are_written() {
    has_one_error(
        &steps("Sheet(columns: 1, on: [\"a\"])"),
        "on",
        "unknown field `on` in `Sheet`",
        "write `(on: .., run: Sheet(..))`",
    );
    has_one_error(
        "(recipe: 1, steps: [], expect: [Faces(eq: 1, after: \"a\")])",
        "after",
        "unknown field `after` in `Faces`",
        "write `(after: .., that: Faces(..))`",
    );
}

#[test]
fn a_step_must_be_an_operation() {
    has_one_error(&steps("7"), "7", "expected an operation, found 7", "");
    let reading = read(&steps("(id: \"a\")"));
    assert_eq!(reading.diagnostics[0].message, "`run` is missing");
    assert_eq!(reading.recipe.steps.len(), 1);
}

#[test]
fn an_undeclared_parameter_is_an_error() {
    let text = r#"(recipe: 1, params: {"columns": Int(default: 2)},
        steps: [Sheet(columns: arg("colums"))], expect: [Faces(eq: arg("x"))])"#;
    assert_eq!(
        shown(text, &read(text).diagnostics),
        [
            (
                "\"colums\"",
                "the recipe has no parameter `colums`",
                "did you mean `columns`?"
            ),
            (
                "\"x\"",
                "the recipe has no parameter `x`",
                "known: `columns`"
            ),
        ]
    );
}

const WITH_PARAMETERS: &str = r#"(recipe: 1,
    params: { "n": Int(default: 2, max: 9), "input": Path(default: "models/cow.obj") },
    steps: [Sheet(columns: arg("n"), name: arg("input"))],
    expect: [Faces(eq: arg("n"))])"#;

#[test]
fn set_values_replace_defaults() {
    let reading = read_with(WITH_PARAMETERS, &[("n", "7")]);
    assert_eq!(reading.diagnostics, []);
    let [n, input] = reading.recipe.parameters() else {
        panic!("two parameters")
    };
    assert_eq!((n.plain_text(), n.is_set()), ("7".to_owned(), true));
    assert!(!input.is_set());
    let step = reading.recipe.steps[0].step.as_ref().unwrap();
    assert_eq!(step.canonical(), "(columns:7,name:\"models/cow.obj\")");
    assert_eq!(
        reading.recipe.expectations[0].that.to_string(),
        "Faces(eq:Some(7),min:None,max:None)"
    );
}

#[test]
fn values_that_cannot_be_set_are_errors_without_a_span() {
    let set = [("n", "many"), ("n", "10"), ("inptu", "x")];
    let reading = read_with(WITH_PARAMETERS, &set);
    assert_eq!(
        shown(WITH_PARAMETERS, &reading.diagnostics),
        [
            (
                "no span",
                "the value that was set for the parameter `n` is not allowed: expected a whole number, found `many`",
                ""
            ),
            (
                "no span",
                "the value that was set for the parameter `n` is not allowed: 10 is above the maximum 9",
                ""
            ),
            (
                "no span",
                "the recipe has no parameter `inptu`",
                "did you mean `input`?"
            ),
        ]
    );
}

#[test]
fn an_error_in_a_substituted_value_names_the_parameter() {
    let text =
        r#"(recipe: 1, params: {"n": Text(default: "two")}, steps: [Sheet(columns: arg("n"))])"#;
    has_one_error(
        text,
        "arg(\"n\")",
        "expected a whole number for `columns`, found the string \"two\" (from parameter `n`)",
        "write numbers without quotes",
    );
}

#[test]
fn a_parameter_that_is_never_used_is_a_warning() {
    let text = r#"(recipe: 1, params: {"n": Int(default: 1)}, steps: [])"#;
    let reading = read(text);
    assert!(!reading.has_errors());
    assert_eq!(
        shown(text, &reading.diagnostics),
        [(
            "\"n\"",
            "the parameter `n` is never used",
            "use its value in a step with arg(\"n\")"
        )]
    );
}

#[test]
fn a_default_that_is_not_allowed_is_the_only_error() {
    let text = r#"(recipe: 1, params: {"n": Int(default: 10, max: 9)}, steps: [Sheet(columns: arg("n"))])"#;
    has_one_error(
        text,
        "Int(default: 10, max: 9)",
        "the default value of the parameter `n` is not allowed: 10 is above the maximum 9",
        "",
    );
}

#[test]
fn path_parameters_give_placeholders() {
    let owned = |pairs: [(&str, &str); 2]| pairs.map(|(a, b)| (a.to_owned(), b.to_owned()));
    assert_eq!(
        read(WITH_PARAMETERS).recipe.placeholders(),
        owned([("input.stem", "cow"), ("input.name", "cow.obj")])
    );
    let set = read_with(WITH_PARAMETERS, &[("input", "a/pig.old.obj")]);
    assert_eq!(set.recipe.parameters()[1].plain_text(), "a/pig.old.obj");
    assert_eq!(
        set.recipe.placeholders(),
        owned([("input.stem", "pig.old"), ("input.name", "pig.old.obj")])
    );
}

#[test]
fn ids_must_be_unique() {
    let text = steps(
        r#"(id: "a", run: Sheet(columns: 1)), (id: "b", run: Lift(by: 1)), (id: "a", run: Lift(by: 1))"#,
    );
    let reading = read(&text);
    assert_eq!(
        shown(&text, &reading.diagnostics),
        [("\"a\"", "two steps have the id \"a\"", "")]
    );
    let last = text.rfind("\"a\"").unwrap();
    assert_eq!(reading.diagnostics[0].span.unwrap().start, last);
}

#[test]
fn an_expectation_after_a_step_names_its_id() {
    let text = r#"(recipe: 1, steps: [(id: "up", run: Sheet(columns: 1))],
        expect: [(after: "upp", that: Closed)])"#;
    has_one_error(
        text,
        "\"upp\"",
        "no step has the id \"upp\"",
        "did you mean `up`?",
    );
}

#[test]
fn a_value_without_its_name_gets_help_with_the_name_that_takes_it() {
    for (that, place, message, help) in [
        (
            "Valence(6)",
            "(6)",
            "expected named fields `(of: ..)` for `Valence`, found a value in brackets `(..)`",
            "write `(eq: 6)`",
        ),
        (
            "DistanceTo(other: \"b.obj\", below: 1)",
            "\"b.obj\"",
            "expected one of `Object`, `File` for `other`, found the string \"b.obj\"",
            "write `Object(\"..\")` or `File(\"..\")`",
        ),
    ] {
        let text = format!("(recipe: 1, steps: [Sheet(columns: 1)], expect: [{that}])");
        has_one_error(&text, place, message, help);
    }
}

#[test]
fn on_is_only_for_expectations_about_objects() {
    for that in [
        "Digest(\"0a\")",
        "Not(Digest(\"0a\"))",
        "[Closed, Output(path: \"a.obj\", as: \"b.obj\")]",
    ] {
        let text = format!(
            r#"(recipe: 1, steps: [Sheet(columns: 1)], expect: [(on: ["sheet"], that: {that})])"#
        );
        let name = if that.contains("Digest") {
            "Digest"
        } else {
            "Output"
        };
        has_one_error(
            &text,
            "[\"sheet\"]",
            &format!("{name} does not take `on`"),
            "this expectation checks the whole scene or a file, not single objects",
        );
    }
}

#[test]
fn a_step_that_could_not_be_read_keeps_its_id() {
    let text = r#"(recipe: 1, steps: [(id: "up", run: Lift(by: arg("x")))],
        expect: [(after: "up", that: Manifold)])"#;
    let reading = read(text);
    assert_eq!(reading.diagnostics.len(), 1, "{:?}", reading.diagnostics);
    assert_eq!(reading.recipe.expectations[0].after, Some(0));
}

#[test]
fn on_is_only_for_operations_that_take_it() {
    has_one_error(
        &steps("(run: Sheet(columns: 1), on: [\"a\"])"),
        "[\"a\"]",
        "Sheet does not take `on`",
        "remove `on`: the operation creates new objects, or its parameters name the objects that it acts on",
    );
}

#[test]
fn an_unknown_reason_of_refusal_is_an_error() {
    let text = steps("Sheet(columns: 1), (run: Lift(by: 1), refused: Bondary)");
    let reading = read(&text);
    assert_eq!(reading.diagnostics.len(), 1, "{:?}", reading.diagnostics);
    assert_eq!(reading.diagnostics[0].span.unwrap().of(&text), "Bondary");
}

#[test]
fn a_syntax_error_does_not_hide_errors_in_other_steps() {
    let text = "(recipe: 1, steps: [\n  Sheet(columns: 3,,),\n  Lfit(by: 1),\n  Lift(by: 1\n])";
    let reading = read(text);
    let unknown = reading
        .diagnostics
        .iter()
        .any(|d| d.message == "unknown operation `Lfit`");
    assert!(
        unknown && reading.diagnostics.len() >= 2,
        "{:?}",
        reading.diagnostics
    );
}

#[test]
fn hostile_recipes_give_few_errors() {
    let brackets = "(".repeat(10_000);
    let closed = format!("{brackets}{}", ")".repeat(10_000));
    let nested = steps(&format!(
        "Lift(by: 1, vertices: {}All{})",
        "Not(".repeat(5000),
        ")".repeat(5000)
    ));
    let shallow = steps(&format!(
        "Lift(by: 1, vertices: {}All{})",
        "Not(".repeat(50),
        ")".repeat(50)
    ));
    for text in [&brackets, &closed, &nested, "", "\0", "[[[", "recipe"] {
        let reading = read(text);
        assert!(reading.has_errors(), "{text:.40}");
        assert!(reading.diagnostics.len() < 10, "{text:.40}");
    }
    assert_eq!(read(&shallow).diagnostics, []);
}

#[test]
fn the_digest_depends_only_on_what_the_recipe_does() {
    let digest = |text: &str| read(text).recipe.digest();
    let plain = digest(&steps("Sheet(columns: 2)"));
    assert_eq!(
        digest(&steps(
            "/* two */ (run: Sheet(columns: 2, name: \"sheet\"), note: \"x\")"
        )),
        plain
    );
    assert_ne!(digest(&steps("Sheet(columns: 3)")), plain);
}

const SAMPLE: &str = r#"(
    recipe: 1,
    about: "a sample",
    params: { "n": Int(default: 3, min: 1), "where": Vector(default: (0, 0, 1)) },
    steps: [
        Sheet(columns: 2),
        (id: "up", run: Lift(by: 0.5, vertices: And([Boundary, Vertices([1, 2])])), on: ["sheet"]),
        (run: Lift(by: 1), refused: Boundary),
    ],
    expect: [
        Manifold,
        Not(Closed),
        (after: "up", that: [Faces(eq: 2), Position(of: Vertices([0]), is: (0, 0, 0))]),
        (that: SymmetricUnder(group: AxisMirrors, min: 1)),
        Not(Count(of: Sharp(above: 30), min: 1)),
    ],
)"#;

#[test]
fn the_schema_accepts_valid_recipes() {
    let schema = crate::schema(&registry());
    let validator = jsonschema::validator_for(&schema).unwrap();
    let json = |text: &str| ron_tree::to_json(&ron_tree::parse(text).value);
    assert!(!read(SAMPLE).has_errors());
    let sample = json(SAMPLE);
    let errors: Vec<String> = validator
        .iter_errors(&sample)
        .map(|e| e.to_string())
        .collect();
    assert!(errors.is_empty(), "{errors:#?}");
    for (from, to) in [
        ("recipe: 1", "recipe: 2"),
        ("columns: 2", "colums: 2"),
        ("Lift(by: 0.5", "Lfit(by: 0.5"),
        ("refused: Boundary", "refused: Whim"),
        ("Faces(eq: 2)", "Faces(equal: 2)"),
        ("default: 3", "default: \"3\""),
        ("Sharp(above: 30)", "Shrp(above: 30)"),
        ("Sharp(above: 30)", "Sharp(above: 300)"),
    ] {
        assert!(SAMPLE.contains(from));
        let wrong = SAMPLE.replace(from, to);
        assert!(!validator.is_valid(&json(&wrong)), "{to}");
        assert!(read(&wrong).has_errors(), "{to}");
    }
}

#[test]
fn the_kind_of_a_selection_can_be_omitted_if_only_one_fits() {
    let of = |selection: &str| {
        let text = format!(
            "(recipe: 1, params: {{\"least\": Float(default: 30)}}, steps: [Sheet(columns: 2)], \
             expect: [Not(Count(of: {selection}, min: 1))])"
        );
        let reading = read(&text);
        let that = reading.recipe.expectations.iter().map(|e| e.that.clone());
        let errors: Vec<_> = (reading.diagnostics.iter())
            .filter(|d| d.severity == Severity::Error)
            .cloned()
            .collect();
        let told: Vec<[String; 3]> = shown(&text, &errors)
            .iter()
            .map(|&(a, b, c)| [a, b, c].map(Into::into))
            .collect();
        (that.collect::<Vec<_>>(), told)
    };
    for selection in [
        "Sharp(above: 30)",
        "And([Boundary, Sharp(above: arg(\"least\"))])",
    ] {
        let (short, wrong) = of(selection);
        assert!(wrong.is_empty() && short.len() == 1, "{wrong:#?}");
        assert_eq!(short, of(&format!("Edges({selection})")).0);
    }
    let (_, wrong) = of("Boundary");
    let message = "this selection can select vertices or edges or faces: specify which";
    let help = "write `Vertices(Boundary)` or `Edges(Boundary)` or `Faces(Boundary)`";
    assert_eq!(wrong, [["Boundary", message, help]]);
}

#[test]
fn errors_are_in_the_order_of_the_text() {
    let text = steps("Lfit(by: 1), Sheet(columns: 0), 7, Sheet(colums: 2)");
    let reading = read(&text);
    let places: Vec<_> = reading.diagnostics.iter().map(|d| d.span).collect();
    assert!(places.is_sorted() && places.len() >= 4, "{places:?}");
    let errors = |d: &crate::Diagnostic| d.severity == Severity::Error;
    assert!(reading.diagnostics.iter().all(errors));
}

#[test]
fn every_error_of_a_long_recipe_is_found() {
    let n = 20_000;
    let step = |i| format!("(id: \"s{i}\", run: Lift(bye: 1)),\n");
    let expectation = |i| format!("(after: \"s{i}\", that: Closed),");
    let expectations: String = (0..n).map(expectation).collect();
    let list: String = (0..n).map(step).collect();
    let reading = read(&format!(
        "(recipe: 1, steps: [{list}], expect: [{expectations}])"
    ));

    assert_eq!(reading.diagnostics.len(), n, "an unknown field in each");
    assert_eq!(reading.recipe.steps.len(), n);
    let after: Vec<_> = reading
        .recipe
        .expectations
        .iter()
        .map(|placed| placed.after)
        .collect();
    assert_eq!(after, (0..n).map(Some).collect::<Vec<_>>());
}
