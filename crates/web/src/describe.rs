//! Descriptions of problems, expectations, parameters and objects as JSON.

use engine::json::{Problem, problems};
use engine::{Diagnostic, Loaded, Outcome};
use recipe::{LineIndex, Param, Parameter};
use scene::Geometry;
use serde::Serialize;
use serde_json::{Value as Json, json};

/// A diagnostic with its range in the text of the recipe.
#[derive(Serialize)]
pub(crate) struct PlacedProblem {
    #[serde(flatten)]
    problem: Problem,
    /// The start and the exclusive end in UTF-16 code units, which JavaScript counts. `null` if the problem is not in
    /// the text of the recipe itself.
    range: Option<[usize; 2]>,
}

/// Describes diagnostics.
pub(crate) fn placed(diagnostics: &[Diagnostic], loaded: &Loaded) -> Vec<PlacedProblem> {
    let sources = &loaded.recipe.sources;
    let text = sources.first().map_or("", |s| &s.text);
    let range = |d: &Diagnostic| {
        let range = d.span.filter(|_| d.source == 0)?.fitted(text);
        let units = |end: usize| text[..end].encode_utf16().count();
        Some([units(range.start), units(range.end)])
    };
    let described = problems(diagnostics, sources).into_iter().zip(diagnostics);
    described
        .map(|(problem, d)| PlacedProblem {
            problem,
            range: range(d),
        })
        .collect()
}

/// Describes the first `checked` expectations, whose results are known.
pub(crate) fn expectations(loaded: &Loaded, outcome: &Outcome, checked: usize) -> Vec<Json> {
    let recipe = &loaded.recipe;
    let checked = recipe.expectations.iter().enumerate().take(checked);
    let described = checked.map(|(i, placed)| {
        let source = &recipe.sources[recipe.scopes[placed.scope].source];
        let (line, _) = LineIndex::new(&source.text).position(placed.span.start);
        json!({
            "file": source.path.display().to_string(),
            "line": line,
            "text": as_written(&source.text[placed.span.fitted(&source.text)]),
            "met": outcome.unmet.iter().all(|unmet| unmet.expectation != i),
        })
    });
    described.collect()
}

/// Returns a part of a recipe on one line.
fn as_written(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Describes a parameter.
pub(crate) fn parameter(parameter: &Parameter) -> Json {
    let param = &parameter.param;
    let mut json = json!({
        "name": parameter.name, "type": param.type_name(), "value": parameter.plain_text(), "doc": param.doc(),
        "min": null, "max": null, "of": null,
    });
    match param {
        Param::Int { min, max, .. } => (json["min"], json["max"]) = (json!(min), json!(max)),
        Param::Float { min, max, .. } => (json["min"], json["max"]) = (json!(min), json!(max)),
        Param::Choice { of, .. } => json["of"] = json!(of),
        _ => {}
    }
    json
}

/// Describes an object.
pub(crate) fn object(object: &scene::Object) -> Json {
    let mut json = json!({ "name": object.name, "kind": object.geometry.kind() });
    if let Geometry::Mesh(mesh) = &object.geometry {
        json["vertices"] = json!(mesh.n_vertices());
        json["edges"] = json!(mesh.n_edges());
        json["faces"] = json!(mesh.n_faces());
    }
    json
}
