//! Converts diagnostics and reports of steps to JSON. The JSON is read by programs that call `meshwright`, and by the
//! browser.

use op::{Loss, ReadingChange, ReadingElements};
use recipe::{Diagnostic, LineIndex, Source, StepDone};
use serde::Serialize;
use serde_json::{Value as Json, json};

/// The fields of a diagnostic in JSON. A field without a value is written as `null`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Problem {
    /// The severity of the problem: `error` or `warning`.
    pub severity: &'static str,
    /// The path of the file.
    pub file: Option<String>,
    /// The line in the file, counted from 1.
    pub line: Option<usize>,
    /// The column: the index of a character in the line, counted from 1.
    pub column: Option<usize>,
    /// The message: one line that starts in lower case and has no final period.
    pub message: String,
    /// How to correct the text.
    pub help: Option<String>,
}

/// Converts diagnostics to their fields in JSON. `sources` contains the texts that the diagnostics refer to.
pub fn problems(diagnostics: &[Diagnostic], sources: &[Source]) -> Vec<Problem> {
    let lines: Vec<LineIndex> = sources.iter().map(|s| LineIndex::new(&s.text)).collect();
    let problem = |d: &Diagnostic| {
        let place = d
            .span
            .and_then(|span| Some(lines.get(d.source)?.position(span.start)));
        Problem {
            severity: d.severity.name(),
            file: sources.get(d.source).map(|s| s.path.display().to_string()),
            line: place.map(|p| p.0),
            column: place.map(|p| p.1),
            message: d.message.clone(),
            help: d.help.clone(),
        }
    };
    diagnostics.iter().map(problem).collect()
}

/// Converts losses to JSON. A loss describes data that a step dropped, such as an attribute.
pub fn losses(losses: &[Loss]) -> Vec<Json> {
    let json = |l: &Loss| {
        let object = (!l.object.is_empty()).then_some(&l.object);
        json!({
            "code": l.code, "count": l.count, "object": object, "name": l.name, "message": l.to_string(),
        })
    };
    losses.iter().map(json).collect()
}

/// Returns the event `done` of a step. The event contains the label, the report and the time of the step, and the
/// numbers of elements in the scene after the step. It also states whether the result was taken from the cache. The
/// argument `number` is the index of the step, counted from 0. The field `number` of the event is this index plus 1,
/// because events count steps from 1.
pub fn step_done(number: usize, done: &StepDone) -> Json {
    json!({
        "event": "done",
        "number": number + 1,
        "label": done.label,
        "vertices": done.vertices,
        "edges": done.edges,
        "faces": done.faces,
        "changed": done.report.changed,
        "refused": done.report.refused,
        "losses": losses(&done.report.losses),
        "changes": done.report.changes.iter().map(change).collect::<Vec<_>>(),
        "notes": done.report.notes,
        "digest": done.digest.map(|digest| digest.to_string()),
        "milliseconds": done.time.as_secs_f64() * 1e3,
        "cached": done.ran.is_none(),
        "ran_because": done.ran.as_ref().map(ToString::to_string),
    })
}

/// Converts a change of a mesh to JSON. The change was made while the file of the mesh was read. The field `text` names
/// only some of the changed elements. The field `vertices`, `edges` or `faces` lists all changed elements.
fn change(change: &ReadingChange) -> Json {
    let mut json = json!({
        "code": change.code, "count": change.count, "text": change.message,
    });
    match &change.elements {
        Some(ReadingElements::Vertices(list)) => json["vertices"] = json!(list),
        Some(ReadingElements::Edges(list)) => json["edges"] = json!(list),
        Some(ReadingElements::Faces(list)) => json["faces"] = json!(list),
        None => {}
    }
    json
}
