//! The compiled part of the Python package `meshwright`. Users call the Python modules in `python/meshwright`. These
//! modules call the compiled part, and add types and documentation.
//!
//! ```text
//! scenes.rs     Scene: the objects of a scene; runs one step on a scene
//! mesh_views.rs Mesh: arrays of a mesh; build.rs makes meshes from arrays, edit.rs edits single elements
//! array.rs      Array: a read-only view of memory for `NumPy`
//! matrix.rs     sparse matrices
//! recipes.rs    Recipe: reads, checks and runs a recipe
//! interrupt.rs  runs work on another thread, so that Ctrl-C and other Python threads are not blocked
//! errors.rs     the exceptions
//! ```

mod array;
mod build;
mod edit;
mod errors;
mod interrupt;
mod matrix;
mod mesh_views;
mod recipes;
mod scenes;

use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::LazyLock;

use engine::Engine;
use op::Registry;
use pyo3::prelude::*;
use recipe::Schemas;

static REGISTRY: LazyLock<Registry> = LazyLock::new(ops_all::registry);
static SCHEMAS: LazyLock<Schemas<'static>> = LazyLock::new(|| Schemas::new(&REGISTRY));
static ENGINE: LazyLock<Engine<'static>> = LazyLock::new(|| Engine::new(&REGISTRY));

/// Returns the JSON schema of recipes as text.
#[pyfunction]
fn schema() -> String {
    recipe::schema(&REGISTRY).to_string()
}

/// Returns the operations as JSON. Each entry has the name, the summary and an example of an operation, and whether its
/// steps can have the field `on`, which names objects.
#[pyfunction]
fn operations() -> String {
    let entries = REGISTRY.entries().iter().map(|entry| {
        serde_json::json!({
            "name": entry.name,
            "summary": entry.summary,
            "example": entry.example,
            "takes_on": entry.takes_on,
        })
    });
    serde_json::Value::Array(entries.collect()).to_string()
}

/// Runs the program `meshwright`, and returns its exit code. The first argument is the name of the program.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "Python passes a new list")]
fn program(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| cli::run_with(&REGISTRY, &arguments))
}

/// Returns the recipes that `meshwright test` would run for the given recipes and folders.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "Python passes a new list")]
fn tested_recipes(py: Python<'_>, paths: Vec<PathBuf>) -> PyResult<Vec<PathBuf>> {
    let found = interrupt::run(py, None, |_| cli::tested_recipes(&REGISTRY, &paths))?;
    found.map_err(|message| errors::error(py, &message))
}

/// Returns the input files that `meshwright batch` would process for the given paths and patterns.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "Python passes a new list")]
fn batch_inputs(py: Python<'_>, patterns: Vec<String>) -> PyResult<Vec<String>> {
    let found = interrupt::run(py, None, |_| cli::batch_inputs(&patterns))?;
    found.map_err(|message| errors::error(py, &message))
}

/// The compiled part of the package.
#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<array::Array>()?;
    module.add_class::<edit::Editor>()?;
    module.add_class::<mesh_views::Mesh>()?;
    module.add_class::<recipes::Recipe>()?;
    module.add_class::<scenes::Scene>()?;
    module.add_function(wrap_pyfunction!(schema, module)?)?;
    module.add_function(wrap_pyfunction!(operations, module)?)?;
    module.add_function(wrap_pyfunction!(program, module)?)?;
    module.add_function(wrap_pyfunction!(tested_recipes, module)?)?;
    module.add_function(wrap_pyfunction!(batch_inputs, module)?)?;
    module.add_function(wrap_pyfunction!(build::from_arrays, module)?)?;
    module.add_function(wrap_pyfunction!(matrix::laplacian, module)?)?;
    module.add_function(wrap_pyfunction!(matrix::subdivision, module)?)?;
    Ok(())
}
