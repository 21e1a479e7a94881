//! Checks that the schemas of operations and recipes are strict, have documentation, and agree with the reader.

use jsonschema::Validator;
use recipe::{Diagnostic, Parameter};
use serde_json::Value as Json;

use crate::samples::samples;
use crate::{assert_none, recipes};

/// Calls `visit` for this schema and for each JSON value inside it. `visit` also receives the path of the value.
fn walk<'s>(schema: &'s Json, path: &str, visit: &mut impl FnMut(&'s Json, &str)) {
    visit(schema, path);
    match schema {
        Json::Object(fields) => {
            for (key, value) in fields {
                walk(value, &format!("{path}/{key}"), visit);
            }
        }
        Json::Array(items) => {
            for (i, item) in items.iter().enumerate() {
                walk(item, &format!("{path}/{i}"), visit);
            }
        }
        _ => {}
    }
}

/// Returns the name of the variant if this is the schema of a variant with fields: `{"Name": {..}}`.
fn variant(schema: &Json) -> Option<&str> {
    let fields = schema["properties"].as_object()?;
    let (name, _) = fields.iter().next()?;
    let is_alone = fields.len() == 1 && schema["required"].as_array()?.len() == 1;
    (is_alone && name.starts_with(char::is_uppercase)).then_some(name)
}

#[test]
fn no_object_in_a_schema_allows_unknown_fields() {
    let schema = recipe::schema(&ops_all::registry());
    let mut failures = Vec::new();
    walk(&schema, "", &mut |schema, path| {
        // An operation can have a parameter with the name `properties`. The JSON object that maps the names of
        // parameters to their schemas then has a member `properties`, but is not a schema. The member `type` of this
        // JSON object, if any, is not the string `object`.
        let is_object = schema["type"] == "object" && schema["properties"].is_object();
        if is_object && schema["additionalProperties"] != false {
            failures.push(format!("{path}: needs deny_unknown_fields"));
        }
    });
    assert_none(&failures);
}

#[test]
fn every_parameter_and_every_variant_has_a_description() {
    let schema = recipe::schema(&ops_all::registry());
    let has_text = |schema: &Json| {
        schema["description"]
            .as_str()
            .is_some_and(|d| !d.is_empty())
    };
    let mut failures = Vec::new();
    walk(&schema["$defs"], "$defs", &mut |schema, path| {
        let is_choice = schema["const"].is_string() || variant(schema).is_some();
        if is_choice && !has_text(schema) {
            failures.push(format!("{path}: a variant without a doc comment"));
        }
        // The crate `schemars` writes an `enum` of strings if variants have no doc comments.
        if schema["type"] == "string" && schema["enum"].is_array() {
            failures.push(format!("{path}: variants without doc comments"));
        }
        if variant(schema).is_some() {
            return;
        }
        if schema["type"] != "object" {
            return;
        }
        for (name, field) in schema["properties"].as_object().into_iter().flatten() {
            if !has_text(field) {
                failures.push(format!("{path}: the field {name} has no doc comment"));
            }
        }
    });
    for entry in ops_all::registry().entries() {
        if !has_text(&entry.schema()) {
            failures.push(format!("{}: the struct has no doc comment", entry.name));
        }
    }
    assert_none(&failures);
}

#[test]
fn unknown_fields_are_errors_at_every_level() {
    let registry = ops_all::registry();
    let mut failures = Vec::new();
    for (entry, sample) in samples(&registry) {
        for (at, _) in sample.match_indices('(') {
            // Parentheses of tuples are skipped, because tuples have no fields.
            let inside = &sample[at + 1..];
            let mut name = inside.split(':').next().expect("a first part").chars();
            let is_empty = inside.starts_with(')');
            if !is_empty && !name.all(|c| c.is_alphanumeric() || c == '_') {
                continue;
            }
            let broken = format!("{}(surplus: 1, {inside}", &sample[..at]);
            if entry.deserialize(&ron_tree::parse(&broken).value).is_ok() {
                failures.push(format!("{}{broken}", entry.name));
            }
        }
    }
    assert_none(&failures);
}

/// Converts a recipe to JSON. References to parameters are replaced by the default values.
fn json(source: &str) -> Json {
    json_with(&parameters(source), source)
}

fn parameters(source: &str) -> Vec<Parameter> {
    read(source).recipe.parameters().to_vec()
}

fn read(source: &str) -> recipe::Reading {
    let source = recipe::Source::new("test.ron", source);
    recipe::read(&source, &ops_all::registry(), recipe::Values::default())
}

/// Converts a recipe to JSON, with the given parameters.
fn json_with(parameters: &[Parameter], source: &str) -> Json {
    let mut parsed = ron_tree::parse(source);
    assert!(parsed.diagnostics.is_empty(), "{:?}", parsed.diagnostics);
    let unknown = recipe::substitute(&mut parsed.value, |name, span| {
        let found = parameters.iter().find(|p| p.name == name);
        let unknown = || Diagnostic::error(span, format!("unknown parameter {name}"));
        found
            .map(|p| p.value.clone())
            .ok_or_else(|| Box::new(unknown()))
    });
    assert!(unknown.is_empty(), "every parameter is declared");
    ron_tree::to_json(&parsed.value)
}

fn validator() -> Validator {
    jsonschema::validator_for(&recipe::schema(&ops_all::registry())).expect("a valid schema")
}

#[test]
fn every_recipe_in_scenes_fits_the_schema() {
    let recipes = recipes();
    assert!(!recipes.is_empty(), "no recipes found in scenes/");
    let validator = validator();
    let mut failures = Vec::new();
    for path in recipes {
        let source = std::fs::read_to_string(&path).expect("the recipe can be read");
        let errors: Vec<_> = validator
            .iter_errors(&json(&source))
            .map(|error| format!("{}: {}: {error}", path.display(), error.instance_path()))
            .collect();
        failures.extend(errors);
    }
    assert_none(&failures);
}

#[test]
fn every_sample_fits_the_schema() {
    let registry = ops_all::registry();
    let validator = validator();
    let mut failures = Vec::new();
    for (entry, sample) in samples(&registry) {
        let step = format!("{}{sample}", entry.name);
        let json = json(&format!("(recipe: 1, steps: [{step}])"));
        if let Err(error) = validator.validate(&json) {
            failures.push(format!("{step}: {error}"));
        }
    }
    assert_none(&failures);
}

/// A valid recipe that uses many parts of the language.
const VALID: &str = r#"(
    recipe: 1,
    about: "a bit of everything",
    params: { "columns": Int(default: 3, min: 1), "word": Choice(default: "Skip", of: ["Skip"]) },
    steps: [
        Grid(name: "sheet", columns: arg("columns"), rows: 2, center: (0, 0, 1)),
        (id: "cut", run: SplitEdges(edges: Longest(count: 2), at: 0.25), on: ["sheet"], note: "two"),
        (run: FlipEdges(edges: Between(0, 1)), refused: Boundary),
        FlipEdges(edges: And([All, Not(Boundary)]), on_refusal: arg("word")),
        VertexNormals,
        Save(path: "sheet.obj"),
    ],
    expect: [
        Manifold,
        Vertices(min: 12),
        (after: "cut", that: [Not(Closed), Count(of: Edges(Sharp(above: 30)), eq: 0)]),
    ],
)"#;

/// Changes that make the recipe invalid: the old text, the new text, and the error.
const BROKEN: &[(&str, &str, &str)] = &[
    ("recipe: 1,", "", "no version"),
    ("recipe: 1,", "recipe: 2,", "a different version"),
    ("recipe: 1,", "recipe: \"1\",", "a version that is a string"),
    ("about:", "abuot:", "an unknown field of the recipe"),
    (
        "about: \"a bit of everything\"",
        "about: 7",
        "a number instead of a string",
    ),
    (
        "Int(default: 3, min: 1)",
        "Int(min: 1)",
        "a parameter without a default",
    ),
    (
        "Int(default: 3, min: 1)",
        "Number(default: 3)",
        "an unknown type of parameter",
    ),
    (
        "Int(default: 3, min: 1)",
        "Int(default: 3, least: 1)",
        "an unknown field of a parameter",
    ),
    (
        "rows: 2",
        "rows: 2, layers: 1",
        "an unknown field of an operation",
    ),
    ("path: \"sheet.obj\"", "", "a missing field"),
    ("rows: 2", "rows: 0", "a number below its range"),
    ("rows: 2", "rows: -2", "a negative count"),
    ("rows: 2", "rows: 2.5", "a fraction instead of a count"),
    ("rows: 2", "rows: \"2\"", "a string instead of a count"),
    ("(0, 0, 1)", "(0, 0)", "a vector of two numbers"),
    ("(0, 0, 1)", "(0, 0, 1, 1)", "a vector of four numbers"),
    ("at: 0.25", "at: 1.5", "a number above its range"),
    (
        "at: 0.25",
        "at: 0",
        "a number at the excluded end of its range",
    ),
    (
        "Longest(count: 2)",
        "Longest(count: 2, from: All)",
        "an unknown field of a selection",
    ),
    (
        "Longest(count: 2)",
        "Biggest(count: 2)",
        "an unknown selection",
    ),
    (
        "Between(0, 1)",
        "Between(0)",
        "a selection with too few numbers",
    ),
    (
        "Between(0, 1)",
        "Between(0, 1, 2)",
        "a selection with too many numbers",
    ),
    ("Not(Boundary)", "Not", "a selection without its operand"),
    ("on: [\"sheet\"]", "on: []", "an empty list of objects"),
    (
        "on: [\"sheet\"]",
        "on: \"sheet\"",
        "a string instead of a list",
    ),
    (
        "note: \"two\"",
        "not: \"two\"",
        "an unknown field of a step",
    ),
    (
        "run: SplitEdges",
        "does: SplitEdges",
        "a step without an operation",
    ),
    ("refused: Boundary", "refused: Border", "an unknown reason"),
    ("VertexNormals", "VertexNormal", "an unknown operation"),
    (
        "path: \"sheet.obj\"",
        "path: true",
        "a boolean instead of a path",
    ),
    ("Manifold", "Manyfold", "an unknown expectation"),
    (
        "Vertices(min: 12)",
        "Vertices(least: 12)",
        "an unknown field of an expectation",
    ),
    (
        "Vertices(min: 12)",
        "Vertices(min: -1)",
        "a negative number of vertices",
    ),
    ("above: 30", "above: 200", "an angle above its range"),
    (
        "after: \"cut\", that:",
        "after: \"cut\", what:",
        "an `after` without expectations",
    ),
];

fn is_accepted(source: &str) -> bool {
    !read(source).has_errors()
}

#[test]
fn the_schema_and_the_reader_accept_a_valid_recipe() {
    let errors: Vec<_> = validator()
        .iter_errors(&json(VALID))
        .map(|error| format!("{}: {error}", error.instance_path()))
        .collect();
    assert_none(&errors);
    assert!(is_accepted(VALID));
}

#[test]
fn the_schema_and_the_reader_reject_invalid_recipes() {
    let validator = validator();
    let parameters = parameters(VALID);
    let mut failures = Vec::new();
    for (from, to, error) in BROKEN {
        assert_eq!(
            VALID.matches(from).count(),
            1,
            "the recipe must contain {from} exactly once"
        );
        let broken = VALID.replace(from, to);
        let is_rejected = !validator.is_valid(&json_with(&parameters, &broken));
        match (is_rejected, !is_accepted(&broken)) {
            (true, true) => {}
            (false, _) => failures.push(format!("{error}: the schema accepts {to:?}")),
            (true, false) => failures.push(format!("{error}: the reader accepts {to:?}")),
        }
    }
    assert_none(&failures);
}
