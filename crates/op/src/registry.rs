//! The registry: the list of operations that a program supports.

use std::fmt;

use ron_tree::{Value, ValueKind};
use scene::{Graph, Scene};
use schemars::{Schema, SchemaGenerator};

use crate::{Context, Loss, OpError, Operation, Plan, PlanContext, Problem, Report};

/// The error for two operations that have the same name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("two operations are named {0}: rename one, or register the second with `with_override`")]
pub struct DuplicateOperation(pub String);

/// The operations that a program supports, in the order in which they were registered.
#[derive(Clone, Debug, Default)]
pub struct Registry {
    entries: Vec<Entry>,
    clash: Option<DuplicateOperation>,
}

/// One operation, with the data for the parser, the help, the schema and the runner.
#[derive(Clone)]
pub struct Entry {
    /// The name of the step in recipes.
    pub name: &'static str,
    /// The version of the operation's results.
    pub version: u32,
    /// What the operation does, in one line.
    pub summary: &'static str,
    /// An example step, as in a recipe.
    pub example: &'static str,
    /// Earlier names of the operation. Recipes can still use these names.
    pub aliases: &'static [&'static str],
    /// Words that other programs use for the operation, in lower case.
    pub words: &'static [&'static str],
    /// Whether a step can choose objects with `on:`.
    pub takes_on: bool,
    schema: fn() -> Schema,
    schema_in: fn(&mut SchemaGenerator) -> Schema,
    deserialize: fn(&Value) -> Result<Box<dyn Step>, ron_tree::Error>,
}

impl fmt::Debug for Entry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Entry")
            .field("name", &self.name)
            .finish_non_exhaustive()
    }
}

impl Entry {
    fn of<T: Operation>() -> Self {
        Self {
            name: T::NAME,
            version: T::VERSION,
            summary: T::SUMMARY,
            example: T::EXAMPLE,
            aliases: T::ALIASES,
            words: T::WORDS,
            takes_on: T::TAKES_ON,
            schema: || schemars::schema_for!(T),
            schema_in: SchemaGenerator::subschema_for::<T>,
            deserialize: |parameters| Ok(Box::new(T::deserialize(parameters)?)),
        }
    }

    /// Returns the JSON schema of the parameters, with their documentation.
    pub fn schema(&self) -> serde_json::Value {
        (self.schema)().to_value()
    }

    /// Adds the schema of the parameters to the definitions of `generator`, and returns a reference to the schema.
    pub fn schema_in(&self, generator: &mut SchemaGenerator) -> serde_json::Value {
        (self.schema_in)(generator).to_value()
    }

    /// Deserializes a step `Name(levels: 2)` or only its parameters `(levels: 2)`. The name is not checked. `Name`
    /// without parentheses is the same as `Name()`.
    ///
    /// # Errors
    ///
    /// Returns an error if the parameters are not valid for this operation. The error contains the reason and the
    /// location.
    pub fn deserialize(&self, step: &Value) -> Result<Box<dyn Step>, ron_tree::Error> {
        match &step.kind {
            ValueKind::Call(call) => (self.deserialize)(&call.body),
            ValueKind::Name(_) => (self.deserialize)(&Value::new(step.span, ValueKind::Unit)),
            _ => (self.deserialize)(step),
        }
    }
}

impl Registry {
    /// Creates a registry without operations.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds an operation. If the new operation shares a current or earlier name with another operation,
    /// [`check`](Self::check) reports the conflict.
    #[must_use]
    pub fn with<T: Operation>(mut self) -> Self {
        let entry = Entry::of::<T>();
        let taken = std::iter::once(entry.name).chain(entry.aliases.iter().copied());
        for name in taken {
            if self.get(name).is_some() {
                self.clash
                    .get_or_insert(DuplicateOperation(name.to_owned()));
            }
        }
        self.entries.push(entry);
        self
    }

    /// Adds an operation that replaces others. First removes every operation that has the name of the new operation, or
    /// had this name earlier.
    #[must_use]
    pub fn with_override<T: Operation>(mut self) -> Self {
        self.entries
            .retain(|e| e.name != T::NAME && !e.aliases.contains(&T::NAME));
        self.with::<T>()
    }

    /// Calls `register`, which adds a group of operations.
    #[must_use]
    pub fn with_group(self, register: fn(Self) -> Self) -> Self {
        register(self)
    }

    /// Checks that no two operations share a name.
    ///
    /// # Errors
    ///
    /// Returns [`DuplicateOperation`] for the first name that is used twice.
    pub fn check(&self) -> Result<(), DuplicateOperation> {
        self.clash.clone().map_or(Ok(()), Err)
    }

    /// Returns all operations in the order in which they were registered.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// Returns the operation that has `name` as its current name or as an earlier name.
    pub fn get(&self, name: &str) -> Option<&Entry> {
        self.entries
            .iter()
            .find(|e| e.name == name || e.aliases.contains(&name))
    }
}

/// An operation with its parameters, as a trait object.
pub trait Step: fmt::Debug + Send + Sync {
    /// Returns the name of the operation.
    fn name(&self) -> &'static str;
    /// See [`Operation::VERSION`].
    fn version(&self) -> u32;
    /// See [`Operation::DONE`].
    fn done(&self) -> &'static str;
    /// See [`Operation::plan`].
    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem>;
    /// See [`Operation::apply`].
    ///
    /// # Errors
    ///
    /// Returns the errors of [`Operation::apply`].
    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError>;
    /// See [`Operation::ATOMIC`].
    fn is_atomic(&self) -> bool;
    /// Returns the parameters of the step in canonical form: in RON, with all default values included.
    fn canonical(&self) -> String;
}

impl<T: Operation> Step for T {
    fn name(&self) -> &'static str {
        T::NAME
    }

    fn version(&self) -> u32 {
        T::VERSION
    }

    fn done(&self) -> &'static str {
        T::DONE
    }

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        let channels = plan.graph().n_channels();
        let problems = Operation::plan(self, plan, cx);
        let lost = lost_channels(channels, plan.graph());
        plan.losses.extend(lost);
        problems
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        let channels = scene.graph().n_channels();
        let mut report = Operation::apply(self, scene, cx)?;
        report.notes.extend(cx.take_notes());
        report.losses.extend(lost_channels(channels, scene.graph()));
        Ok(report)
    }

    fn is_atomic(&self) -> bool {
        T::ATOMIC
    }

    fn canonical(&self) -> String {
        to_ron(self)
    }
}

/// Returns a value as RON. Because the value is passed as a trait object, the serializer is compiled only once.
///
/// # Panics
///
/// Panics if RON cannot represent the value. RON can represent all parameters and expectations.
pub fn to_ron(value: &dyn erased_serde::Serialize) -> String {
    ron::to_string(value).expect("parameters are plain data")
}

/// Returns the loss of animation channels in the step; `None` if no channel was lost. `before` is the number of
/// animation channels before the step.
fn lost_channels(before: usize, graph: &Graph) -> Option<Loss> {
    let lost = before.saturating_sub(graph.n_channels());
    let what = mesh::counted(lost, "animation channel");
    (lost > 0).then(|| Loss {
        count: Some(lost as u64),
        ..Loss::part("", "animations", what, "the animated nodes were removed")
    })
}
