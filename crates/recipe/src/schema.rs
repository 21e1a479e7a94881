//! JSON schemas. Text editors can check and complete recipes with the schema of whole recipes. [`read`](crate::read())
//! checks parts of a recipe with the schemas of these parts.

use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use op::{Entry, Refusal, Registry};
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::{Value as Json, json};

use crate::expect::Expectation;
use crate::params::Param;
use crate::recipe::{Kind, MAX_STEPS, OnLoss};

/// The operations of a registry, with the JSON schemas of their parameters. Each schema is created when it is needed
/// for the first time. Threads that read many recipes can share one `Schemas` value.
#[derive(Debug)]
pub struct Schemas<'r> {
    pub(crate) registry: &'r Registry,
    created: Mutex<HashMap<&'static str, Arc<Json>>>,
}

impl<'r> Schemas<'r> {
    /// Returns the schemas of `registry`.
    pub fn new(registry: &'r Registry) -> Self {
        Self {
            registry,
            created: Mutex::new(HashMap::new()),
        }
    }

    /// Returns the schema of an operation of the registry.
    pub(crate) fn of(&self, entry: &Entry) -> Arc<Json> {
        let created = || self.created.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(schema) = created().get(entry.name) {
            return schema.clone();
        }
        // The schema is created without holding the lock. If two threads create the same schema at the same time, only
        // one of the two results is kept.
        let schema = Arc::new(entry.schema());
        created().entry(entry.name).or_insert(schema).clone()
    }
}

/// Returns the schema of a type.
pub(crate) fn of<T: JsonSchema>() -> Json {
    schemars::schema_for!(T).to_value()
}

/// Returns the schema of the declaration of a parameter.
pub(crate) fn param() -> &'static Json {
    static SCHEMA: LazyLock<Json> = LazyLock::new(of::<Param>);
    &SCHEMA
}

/// Returns the schema of an expectation without the fields `after`, `on` and `that`.
pub(crate) fn expectation() -> &'static Json {
    static SCHEMA: LazyLock<Json> = LazyLock::new(of::<Expectation>);
    &SCHEMA
}

/// Returns the schema of the fields of a recipe. In this schema, steps and expectations can have any value.
pub(crate) fn envelope() -> &'static Json {
    static SCHEMA: LazyLock<Json> = LazyLock::new(|| {
        with_definitions(|defined| {
            let on_loss = reference::<OnLoss>(defined);
            recipe(&json!({}), &json!({}), &json!({}), &on_loss)
        })
    });
    &SCHEMA
}

/// Returns the schema of the fields of a step. In this schema, the operation can have any value.
pub(crate) fn step_envelope() -> &'static Json {
    static SCHEMA: LazyLock<Json> =
        LazyLock::new(|| with_definitions(|defined| step_fields(&json!({}), defined)));
    &SCHEMA
}

/// Returns the schema of the parameters of a step that contains other steps. In this schema, the inner steps can have
/// any value.
pub(crate) fn flow(kind: Kind) -> Json {
    flow_fields(kind, &json!({}))
}

/// Returns the names of the steps that contain other steps ([`Call`, `Repeat` and `If`](crate::read())), each with the
/// schema of its parameters.
pub fn step_kinds() -> Vec<(&'static str, Json)> {
    let kinds = Kind::ALL.into_iter();
    kinds.map(|kind| (kind.name(), flow(kind))).collect()
}

fn flow_fields(kind: Kind, step: &Json) -> Json {
    let steps = |doc: &str| json!({ "type": "array", "items": step, "description": doc });
    let (doc, properties, required) = match kind {
        Kind::Call => (
            "Run another recipe on the current scene",
            json!({
                "recipe": {
                    "type": "string",
                    "description": "The path of the called recipe, relative to the folder of the calling recipe.",
                },
                "with": {
                    "type": "object",
                    "additionalProperties": {},
                    "description": "Values for parameters of the called recipe. Parameters without a value keep their defaults.",
                },
            }),
            json!(["recipe"]),
        ),
        Kind::Repeat => (
            "Run steps several times",
            json!({
                "times": {
                    "type": "integer",
                    "minimum": 0,
                    "maximum": MAX_STEPS,
                    "description": "The number of repetitions.",
                },
                "steps": steps("The steps to repeat."),
            }),
            json!(["times", "steps"]),
        ),
        Kind::If => (
            "Run steps if a recipe parameter has a given value",
            json!({
                "param": { "type": "string", "description": "The name of the parameter." },
                "is": { "description": "The value with which the parameter is compared. Defaults to `true`." },
                "steps": steps("The steps that run if the parameter has the value."),
                "otherwise": steps("The steps that run if the parameter has a different value."),
            }),
            json!(["param", "steps"]),
        ),
    };
    json!({
        "type": "object",
        "description": doc,
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    })
}

/// Returns the schema of `(after: .., on: .., that: ..)`. In this schema, `that` can have any value.
pub(crate) fn expectation_envelope() -> Json {
    expectation_fields(&json!({}))
}

/// Returns the schema of whole recipes with the operations of `registry`. The schema describes recipes in the JSON form
/// of RON: `Name(a: 1)` is `{"Name": {"a": 1}}`, and a name without parameters is a string.
pub fn schema(registry: &Registry) -> Json {
    // A step can contain steps, so the schema of a step refers to itself by a name.
    let step_reference = json!({ "$ref": "#/$defs/Step" });
    let mut step = Json::Null;
    let mut schema = with_definitions(|defined| {
        let call = |name: &str, doc: &Json, parameters: &Json| {
            json!({
                "type": "object",
                "description": doc,
                "properties": { name: parameters },
                "required": [name],
                "additionalProperties": false,
            })
        };
        let mut operations = Vec::new();
        for entry in registry.entries() {
            let (name, summary) = (entry.name, json!(entry.summary));
            operations.push(call(name, &summary, &entry.schema_in(defined)));
            if entry.schema().get("required").is_none() {
                operations.push(json!({ "const": name, "description": summary }));
            }
        }
        operations.extend(Kind::ALL.map(|kind| {
            let fields = flow_fields(kind, &step_reference);
            call(kind.name(), &fields["description"], &fields)
        }));
        let operation = json!({ "oneOf": operations });
        let fields = step_fields(&operation, defined);
        step = json!({ "oneOf": [operation, fields] });
        let expectation = reference::<Expectation>(defined);
        let many =
            json!({ "oneOf": [expectation.clone(), { "type": "array", "items": expectation }] });
        let placed = json!({ "oneOf": [expectation, expectation_fields(&many)] });
        let (param, on_loss) = (reference::<Param>(defined), reference::<OnLoss>(defined));
        recipe(&param, &step_reference, &placed, &on_loss)
    });
    allow_shorthand(&mut schema);
    schema["$defs"]["Step"] = step;
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("Meshwright recipe");
    schema
}

fn recipe(param: &Json, step: &Json, expectation: &Json, on_loss: &Json) -> Json {
    json!({
        "type": "object",
        "properties": {
            "recipe": { "type": "integer", "const": 1 },
            "needs": { "type": "string" },
            "about": { "type": "string" },
            "params": { "type": "object", "additionalProperties": param },
            "presets": {
                "type": "object",
                "additionalProperties": { "type": "object", "additionalProperties": {} },
            },
            "on_loss": on_loss,
            "steps": { "type": "array", "items": step },
            "expect": { "type": "array", "items": expectation },
        },
        "required": ["recipe", "steps"],
        "additionalProperties": false,
    })
}

fn step_fields(operation: &Json, defined: &mut SchemaGenerator) -> Json {
    // If the description were in the same object as `$ref` or `oneOf`, it would become part of the schema of the value.
    // Therefore this schema is wrapped in `allOf`.
    let described = |schema: &Json, doc: &str| json!({ "allOf": [schema], "description": doc });
    json!({
        "type": "object",
        "properties": {
            "id": {
                "type": "string",
                "minLength": 1,
                "description": "The name by which other parts of the recipe refer to the step.",
            },
            "run": described(operation, "The operation."),
            "on": {
                "type": "array",
                "items": { "type": "string" },
                "minItems": 1,
                "description": "The names of the objects that the step acts on. If omitted, the step acts on all suitable objects.",
            },
            "enabled": {
                "type": "boolean",
                "description": "Whether the step runs. Defaults to `true`. If `false`, the step is not checked. Expectations that name the step in `after` are not checked either.",
            },
            "note": { "type": "string", "description": "A comment on the step. `meshwright run --explain` and `meshwright check --explain` print the comment." },
            "refused": described(
                &reference::<Refusal>(defined),
                "The operation must refuse its input for this reason, and leave the scene unchanged.",
            ),
            "on_loss": described(
                &reference::<OnLoss>(defined),
                "What happens if the step loses data. Defaults to the `on_loss` of the recipe.",
            ),
        },
        "required": ["run"],
        "additionalProperties": false,
    })
}

fn expectation_fields(that: &Json) -> Json {
    json!({
        "type": "object",
        "properties": {
            "after": { "type": "string" },
            "on": { "type": "array", "items": { "type": "string" }, "minItems": 1 },
            "that": that,
        },
        "required": ["that"],
        "additionalProperties": false,
    })
}

/// Returns the schema that `build` creates, together with the definitions to which it refers.
fn with_definitions(build: impl FnOnce(&mut SchemaGenerator) -> Json) -> Json {
    let mut defined = SchemaGenerator::default();
    let mut schema = build(&mut defined);
    schema["$defs"] = Json::Object(defined.take_definitions(true));
    schema
}

/// Returns a reference to the schema of a type.
fn reference<T: JsonSchema>(defined: &mut SchemaGenerator) -> Json {
    defined.subschema_for::<T>().to_value()
}

/// Extends the schema of each enumeration that has the keyword `x-shorthand`. Values of these enumerations can omit the
/// name of the variant, so the contents of the variants are added as alternatives.
fn allow_shorthand(schema: &mut Json) {
    match schema {
        Json::Object(object) => {
            object.values_mut().for_each(allow_shorthand);
            if object.remove("x-shorthand").is_some()
                && let Some(Json::Array(variants)) = object.remove("oneOf")
            {
                let contents: Vec<Json> = variants
                    .iter()
                    .filter_map(|variant| variant["properties"].as_object())
                    .flat_map(|properties| properties.values().cloned())
                    .collect();
                object.insert("anyOf".into(), [variants, contents].concat().into());
            }
        }
        Json::Array(items) => items.iter_mut().for_each(allow_shorthand),
        _ => {}
    }
}
