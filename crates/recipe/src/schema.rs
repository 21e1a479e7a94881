//! JSON schemas: of whole recipes for editors, and of their parts for the reader.

use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use op::{Entry, Refusal, Registry};
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::{Value as Json, json};

use crate::expect::Expectation;
use crate::params::Param;
use crate::recipe::{Kind, MAX_STEPS, OnLoss};

/// The operations of a registry and their schemas, each made when it is first asked for: for whoever reads
/// many recipes, on any number of threads.
#[derive(Debug)]
pub struct Schemas<'r> {
    pub(crate) registry: &'r Registry,
    made: Mutex<HashMap<&'static str, Arc<Json>>>,
}

impl<'r> Schemas<'r> {
    /// Those of `registry`; none is made yet.
    pub fn new(registry: &'r Registry) -> Self {
        Self {
            registry,
            made: Mutex::new(HashMap::new()),
        }
    }

    /// The schema of an operation of the registry.
    pub(crate) fn of(&self, entry: &Entry) -> Arc<Json> {
        let made = || self.made.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(schema) = made().get(entry.name) {
            return schema.clone();
        }
        // Made without the lock: at worst, twice.
        let schema = Arc::new(entry.schema());
        made().entry(entry.name).or_insert(schema).clone()
    }
}

/// The schema of a type.
pub(crate) fn of<T: JsonSchema>() -> Json {
    schemars::schema_for!(T).to_value()
}

/// The schema of a declared parameter.
pub(crate) fn param() -> &'static Json {
    static SCHEMA: LazyLock<Json> = LazyLock::new(of::<Param>);
    &SCHEMA
}

/// The schema of an expectation alone.
pub(crate) fn expectation() -> &'static Json {
    static SCHEMA: LazyLock<Json> = LazyLock::new(of::<Expectation>);
    &SCHEMA
}

/// The fields around a recipe; steps and expectations can be anything.
pub(crate) fn envelope() -> &'static Json {
    static SCHEMA: LazyLock<Json> = LazyLock::new(|| {
        with_definitions(|defined| {
            let on_loss = reference::<OnLoss>(defined);
            recipe(&json!({}), &json!({}), &json!({}), &on_loss)
        })
    });
    &SCHEMA
}

/// The fields around an operation; the operation can be anything.
pub(crate) fn step_envelope() -> &'static Json {
    static SCHEMA: LazyLock<Json> =
        LazyLock::new(|| with_definitions(|defined| step_fields(&json!({}), defined)));
    &SCHEMA
}

/// The parameters of a step that holds steps; the steps inside can be anything.
pub(crate) fn flow(kind: Kind) -> Json {
    flow_fields(kind, &json!({}))
}

/// The steps that hold steps, [`Call`, `Repeat` and `If`](crate::read()): their names, and the schemas of their
/// parameters.
pub fn step_kinds() -> Vec<(&'static str, Json)> {
    let kinds = Kind::ALL.into_iter();
    kinds.map(|kind| (kind.name(), flow(kind))).collect()
}

fn flow_fields(kind: Kind, step: &Json) -> Json {
    let steps = |doc: &str| json!({ "type": "array", "items": step, "description": doc });
    let (doc, properties, required) = match kind {
        Kind::Call => (
            "Run another recipe on the scene as it is",
            json!({
                "recipe": {
                    "type": "string",
                    "description": "The recipe, seen from the folder of this one.",
                },
                "with": {
                    "type": "object",
                    "additionalProperties": {},
                    "description": "Values for its parameters; the others keep their defaults.",
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
                    "description": "How many times.",
                },
                "steps": steps("The steps."),
            }),
            json!(["times", "steps"]),
        ),
        Kind::If => (
            "Run steps if a parameter has a value",
            json!({
                "param": { "type": "string", "description": "The name of the parameter." },
                "is": { "description": "The value that it must have; `true` if this is left out." },
                "steps": steps("The steps that run if it has the value."),
                "otherwise": steps("The steps that run if it has not."),
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

/// The fields around an expectation; the expectation can be anything.
pub(crate) fn expectation_envelope() -> Json {
    expectation_fields(&json!({}))
}

/// The schema of whole recipes with the operations of `registry`, in the JSON form of RON: `Name(a: 1)`
/// is `{"Name": {"a": 1}}`, and a name without parameters is a string.
pub fn schema(registry: &Registry) -> Json {
    // A step can hold steps, so it has a name.
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
    // What stands beside a reference or a choice goes with it.
    let told = |schema: &Json, doc: &str| json!({ "allOf": [schema], "description": doc });
    json!({
        "type": "object",
        "properties": {
            "id": {
                "type": "string",
                "minLength": 1,
                "description": "The name that later parts of the recipe know the step by.",
            },
            "run": told(operation, "The operation."),
            "on": {
                "type": "array",
                "items": { "type": "string" },
                "minItems": 1,
                "description": "The objects that it acts on; all that it can if this is left out.",
            },
            "note": { "type": "string", "description": "For readers." },
            "refused": told(&reference::<Refusal>(defined), "The reason for which it must be refused, and change nothing."),
            "on_loss": told(&reference::<OnLoss>(defined), "What may be lost; as the recipe says if this is left out."),
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

/// A schema with the definitions that `build` refers to.
fn with_definitions(build: impl FnOnce(&mut SchemaGenerator) -> Json) -> Json {
    let mut defined = SchemaGenerator::default();
    let mut schema = build(&mut defined);
    schema["$defs"] = Json::Object(defined.take_definitions(true));
    schema
}

/// A reference to the schema of a type.
fn reference<T: JsonSchema>(defined: &mut SchemaGenerator) -> Json {
    defined.subschema_for::<T>().to_value()
}

/// Where the outer name of a value may be left out, lets what stands in its brackets stand alone.
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
