//! Functions that read, check and run recipes.

use std::path::{Path, PathBuf};

use engine::{Loaded, Options, Run, Source, Values};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::ENGINE;
use crate::errors::{error, problems, recipe_error};
use crate::interrupt::run;
use crate::scenes::Scene;

/// A recipe that was read and checked.
#[pyclass(frozen, module = "meshwright._core")]
pub(crate) struct Recipe(Loaded);

#[pymethods]
impl Recipe {
    /// Reads and checks a recipe. If no text is given, reads the file `path`. Relative paths in `set` are relative to
    /// the working directory.
    #[new]
    #[pyo3(signature = (text, path, set, preset, out, budget))]
    #[expect(clippy::needless_pass_by_value, reason = "Python passes new values")]
    fn new(
        py: Python<'_>,
        text: Option<String>,
        path: PathBuf,
        set: Vec<(String, String)>,
        preset: Option<String>,
        out: PathBuf,
        budget: Option<u64>,
    ) -> PyResult<Self> {
        let loaded = run(py, None, |_| {
            let source = match text {
                Some(text) => Source::new(path, text),
                None => ENGINE.open(&path).map_err(|error| error.to_string())?,
            };
            let options = Options {
                values: Values {
                    set: &set,
                    preset: preset.as_deref(),
                    folder: Some(Path::new("")),
                },
                out: &out,
                budget: budget.unwrap_or(engine::BUDGET),
                strict: false,
            };
            Ok::<_, String>(ENGINE.load(&source, &options))
        })?;
        loaded.map(Self).map_err(|message| error(py, &message))
    }

    /// The errors and warnings of the recipe, as dictionaries.
    fn problems<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        problems(py, &self.0.recipe.sources, &self.0.diagnostics)
    }

    /// Raises an exception with the errors of the recipe, if there are any.
    fn check(&self, py: Python<'_>) -> PyResult<()> {
        if self.0.has_errors() {
            let sources = &self.0.recipe.sources;
            return Err(recipe_error(py, sources, &self.0.diagnostics));
        }
        Ok(())
    }

    /// Returns the name, the type, the value and the documentation of each parameter.
    fn parameters(&self) -> Vec<(String, &'static str, String, Option<String>)> {
        let scope = self.0.recipe.scopes.first();
        let parameters = scope.map_or(&[][..], |scope| &scope.parameters).iter();
        let described = parameters.map(|p| {
            let doc = p.param.doc().map(str::to_owned);
            (p.name.clone(), p.param.type_name(), p.plain_text(), doc)
        });
        described.collect()
    }

    /// The labels of the steps.
    fn steps(&self) -> Vec<&str> {
        self.0
            .recipe
            .steps
            .iter()
            .map(recipe::RecipeStep::label)
            .collect()
    }

    /// The number of expectations.
    fn n_expectations(&self) -> usize {
        self.0.recipe.expectations.len()
    }

    /// Returns an upper bound, in bytes, of the memory that all meshes together take after any step. Returns `None` if
    /// there is no bound.
    fn peak_bytes(&self) -> Option<u64> {
        let peaks = self.0.forecast.steps.iter().map(|step| step.bytes.max);
        peaks.max().filter(|&peak| peak < u64::MAX)
    }

    /// Runs the recipe. Returns the scene, and a dictionary with the steps, the files, the number of expectations and
    /// the digest of the scene.
    fn run<'py>(
        &self,
        py: Python<'py>,
        keep_outputs: bool,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<(Option<Scene>, Bound<'py, PyDict>)> {
        self.check(py)?;
        let settings = Run {
            keep_outputs,
            cache: None,
        };
        let outcome = run(py, progress, |monitor| self.0.run(settings, monitor))?;
        if !outcome.succeeded() {
            let sources = &self.0.recipe.sources;
            return Err(recipe_error(py, sources, &outcome.failures));
        }
        let about = PyDict::new(py);
        about.set_item("digest", outcome.digest.to_string())?;
        about.set_item("checked", outcome.checked)?;
        let written = outcome
            .written
            .iter()
            .map(|path| path.display().to_string());
        about.set_item("files", PyList::new(py, written)?)?;
        let steps = PyList::empty(py);
        for step in &outcome.steps {
            let fields = PyDict::new(py);
            fields.set_item("name", &step.label)?;
            fields.set_item("vertices", step.vertices)?;
            fields.set_item("edges", step.edges)?;
            fields.set_item("faces", step.faces)?;
            fields.set_item("seconds", step.time.as_secs_f64())?;
            let report = serde_json::to_string(&step.report).expect("a report is plain data");
            fields.set_item("report", report)?;
            steps.append(fields)?;
        }
        about.set_item("steps", steps)?;
        Ok((outcome.scene.map(Scene), about))
    }
}
