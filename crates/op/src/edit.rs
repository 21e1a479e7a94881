//! Local edits over a selection.

use mesh::{EditError, Mesh};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{Context, OpError, Report};

/// What to do when an edit of a selected element is refused.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum OnRefusal {
    /// Fail; the mesh is as it was before the step.
    #[default]
    Error,
    /// Leave that element as it is, count it, and go on.
    Skip,
}

/// Edits the elements one after another, each judged at its moment.
///
/// The report counts the edits that were done and, for [`OnRefusal::Skip`], those that were refused, by
/// reason. Elements that an earlier edit removed count as refused.
///
/// # Errors
///
/// [`OpError::Cancelled`], and the first refusal for [`OnRefusal::Error`]. The mesh is then edited in
/// part: operations return the error, and their driver throws that mesh away.
pub fn edit_each<I: Copy>(
    mesh: &mut Mesh,
    elements: &[I],
    on_refusal: OnRefusal,
    what: &str,
    cx: &Context,
    mut edit: impl FnMut(&mut Mesh, I) -> Result<(), EditError>,
) -> Result<Report, OpError> {
    let mut report = Report::default();
    let total = elements.len() as u64;
    cx.advance(what, 0, total)?;
    for (done, &element) in (1..).zip(elements) {
        match edit(mesh, element) {
            Ok(()) => report.changed += 1,
            Err(refusal) => match on_refusal {
                OnRefusal::Error => return Err(refusal.into()),
                OnRefusal::Skip => report.refuse(refusal.into())?,
            },
        }
        if done % 4096 == 0 {
            cx.advance(what, done, total)?;
        }
    }
    Ok(report)
}
