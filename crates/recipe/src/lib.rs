//! The recipe language: parses recipes, checks them and forecasts their results, runs their steps, and tests their
//! expectations.
//!
//! ```text
//! text --read--> Recipe + diagnostics --check--> Forecast + diagnostics --run--> Outcome
//! ```
//!
//! [`read`] turns text into operations of a [`Registry`](op::Registry), and reports all errors at once. [`read`] also
//! checks each value against the schema of its type (module [`schema_check`]), and then deserializes the value.
//! [`check`] predicts the results of all steps without computing geometry: the element counts and the memory. [`check`]
//! also checks files and names. If the meshes certainly take more memory than the budget, [`check`] reports an error.
//! [`run`] runs the steps. Outputs are written only if every step succeeds and every expectation holds.

pub mod capsule;
pub mod compare;
pub mod expect;
pub mod schema_check;
pub mod shrink;
pub mod stamp;
pub mod update;
pub mod upgrade;

mod check;
mod describe;
mod diagnostic;
mod jobs;
mod params;
mod read;
mod recipe;
mod run;
mod schema;
mod select;
mod source;
mod substitute;
mod sweep;

pub use check::{Forecast, StepForecast, check, check_from};
pub use describe::{
    FieldDoc, TypeDoc, VariantDoc, expectations, fields, fields_in, refusals, selections, types,
};
pub use diagnostic::render;
pub use expect::{ActualValue, Expectation, OtherMesh, Reader, Violation};
pub use jobs::{InOrder, JobEnd, JobLimits, Jobs, JobsError};
pub use params::{Param, ParamError, Rebase};
pub use read::{Reading, VERSION, Values, read, read_by};
pub use recipe::{
    MAX_STEPS, OnLoss, Origin, Parameter, Recipe, RecipeExpectation, RecipeStep, Scope,
};
pub use ron_tree::{Diagnostic, LineIndex, Severity, Span};
pub use run::{
    CachedRun, CompletedStep, Failure, FileChange, Listener, Outcome, RerunReason, Settings,
    Silent, StepCache, StepDone, StepError, StepResult, UnmetExpectation, run, run_from, run_step,
};
pub use schema::{Schemas, schema, step_kinds};
pub use schema_check::did_you_mean;
pub use select::{read_selection, read_step, resolve, with_case_of};
pub use source::{Source, SourceError};
pub use stamp::Stamp;
pub use substitute::substitute;
pub use sweep::{
    Axis, Grid, MAX_CELLS, Measured, Metric, SWEEP_VERSION, Setting, Statistic, Sweep,
    SweepReading, read_sweep,
};
pub use unknown_operation::suggest_operations;

#[cfg(test)]
mod tests;
mod unknown_operation;
