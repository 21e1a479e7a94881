//! Creates the exceptions of the package. Their classes are defined in the Python module `meshwright.errors`.

use mesh::EditError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use recipe::{Diagnostic, LineIndex, Source};

/// Creates an exception of the class `name` of the Python module `meshwright.errors`.
fn exception<'py, A>(py: Python<'py>, name: &str, arguments: A) -> PyErr
where
    A: pyo3::call::PyCallArgs<'py>,
{
    let class = py
        .import("meshwright.errors")
        .and_then(|module| module.getattr(name));
    match class.and_then(|class| class.call1(arguments)) {
        Ok(error) => PyErr::from_value(error),
        Err(error) => error,
    }
}

/// Creates an error that does not refer to a place in a recipe.
pub(crate) fn error(py: Python<'_>, message: &str) -> PyErr {
    exception(py, "Error", (message,))
}

/// Creates the error for a recipe or step that cannot run or that failed.
pub(crate) fn recipe_error(
    py: Python<'_>,
    sources: &[Source],
    diagnostics: &[Diagnostic],
) -> PyErr {
    let text = recipe::render(sources, diagnostics, false);
    match problems(py, sources, diagnostics) {
        Ok(problems) => exception(py, "RecipeError", (text.trim_end(), problems)),
        Err(error) => error,
    }
}

/// Returns diagnostics as a list of dictionaries with the fields of `meshwright.Problem`.
pub(crate) fn problems<'py>(
    py: Python<'py>,
    sources: &[Source],
    diagnostics: &[Diagnostic],
) -> PyResult<Bound<'py, PyList>> {
    let list = PyList::empty(py);
    for diagnostic in diagnostics {
        let fields = PyDict::new(py);
        fields.set_item("severity", diagnostic.severity.name())?;
        fields.set_item("message", &diagnostic.message)?;
        fields.set_item("help", &diagnostic.help)?;
        let source = sources.get(diagnostic.source);
        fields.set_item("file", source.map(|s| s.path.display().to_string()))?;
        let position = source
            .zip(diagnostic.span)
            .map(|(source, span)| LineIndex::new(&source.text).position(span.start));
        fields.set_item("line", position.map(|p| p.0))?;
        fields.set_item("column", position.map(|p| p.1))?;
        list.append(fields)?;
    }
    Ok(list)
}

/// Creates the error for a refused edit, with the message, the name of the reason, and the elements, such as `e12`.
pub(crate) fn edit_error(py: Python<'_>, refused: EditError) -> PyErr {
    let reason = format!("{refused:?}");
    let end = reason.find(|c: char| !c.is_alphanumeric());
    let reason = &reason[..end.unwrap_or(reason.len())];
    let elements: Vec<String> = refused.elements().iter().map(ToString::to_string).collect();
    exception(py, "EditError", (refused.to_string(), reason, elements))
}
