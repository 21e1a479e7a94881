//! Local edits over a selection.

use mesh::{EditError, Mesh};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{Context, OpError, Range, Report};

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

impl OnRefusal {
    /// How many of so many selected elements are edited: all, or perhaps fewer where refusals are skipped.
    #[must_use]
    pub fn done(self, selected: Range) -> Range {
        match self {
            Self::Error => selected,
            Self::Skip => selected.or_less(),
        }
    }
}

/// Edits the elements one after another, each judged at its moment.
///
/// The report counts the edits that were done and, for [`OnRefusal::Skip`], those that were refused, by
/// reason. Elements that an earlier edit removed count as refused.
///
/// # Errors
///
/// [`OpError::Cancelled`], and the first refusal for [`OnRefusal::Error`]. The mesh is then edited in
/// part: operations return the error, and their driver takes the edits back.
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
    if total == 0 {
        report.notes.push("nothing was selected".to_owned());
    }
    cx.advance(what, 0, total)?;
    for (done, &element) in (1..).zip(elements) {
        match edit(mesh, element) {
            Ok(()) => report.changed += 1,
            Err(refusal) => match on_refusal {
                OnRefusal::Error => return Err(described(refusal, mesh)),
                OnRefusal::Skip => report.refuse(described(refusal, mesh))?,
            },
        }
        if done % 4096 == 0 {
            cx.advance(what, done, total)?;
        }
    }
    Ok(report)
}

/// A refusal that names its edge as recipes do, by its vertices.
fn described(refusal: EditError, mesh: &Mesh) -> OpError {
    let (EditError::Boundary(e)
    | EditError::NotBoundary(e)
    | EditError::JoinsBoundaries(e)
    | EditError::SameFace(e)
    | EditError::Seam(e)
    | EditError::Vanishes(e)
    | EditError::Link(e, _)
    | EditError::SameOpposite(e, _)) = refusal
    else {
        return refusal.into();
    };
    let [v, w] = mesh.edge_vertices(e).map(mesh::VertexId::index);
    OpError::refused(
        refusal.into(),
        format!("{refusal}; it is Between({v}, {w})"),
    )
}
