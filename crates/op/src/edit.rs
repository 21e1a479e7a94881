//! Local edits of the elements of a selection.

use mesh::{EdgeId, EditError, Element, FaceId, HalfEdgeId, Mesh, VertexId};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{Context, OpError, Problem, Range, Report};

/// What to do when an edit is refused, that is, when the edit is not possible at a selected element.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum OnRefusal {
    /// Fail, and leave the mesh unchanged.
    #[default]
    Error,
    /// Leave the element unchanged, count the refusal in the report, and continue with the next element.
    Skip,
}

impl OnRefusal {
    /// Returns how many elements the step will edit, as a range. With [`OnRefusal::Error`], the step edits all selected
    /// elements. With [`OnRefusal::Skip`], the step can edit any number of the selected elements.
    #[must_use]
    pub fn done(self, selected: Range) -> Range {
        match self {
            Self::Error => selected,
            Self::Skip => selected.or_less(),
        }
    }

    /// Returns the problem that `plan` reports for an edit that will be refused. The problem is an error for
    /// [`OnRefusal::Error`] and a warning for [`OnRefusal::Skip`].
    pub fn problem(self, message: impl Into<String>) -> Problem {
        match self {
            Self::Error => Problem::error(message),
            Self::Skip => Problem::warning(message),
        }
    }

    /// Handles a refused edit: returns the refusal as an error, or counts it in the report and returns `Ok`.
    ///
    /// # Errors
    ///
    /// Returns the argument `refused` if `self` is [`OnRefusal::Error`], or if this argument is not an
    /// [`OpError::Refused`].
    pub fn refuse(self, refused: OpError, report: &mut Report) -> Result<(), OpError> {
        match self {
            Self::Error => Err(refused.skippable()),
            Self::Skip => report.refuse(refused),
        }
    }
}

/// What to do at a seam. A seam is an edge whose corner values, such as UVs, differ between its two sides.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Seams {
    /// Refuse the edit.
    #[default]
    Refuse,
    /// Edit anyway. At each end of the seam, the corner values of one side are kept, and the corner values of the other
    /// side are lost.
    Drop,
}

impl From<Seams> for mesh::Seams {
    fn from(seams: Seams) -> Self {
        match seams {
            Seams::Refuse => Self::Refuse,
            Seams::Drop => Self::Drop,
        }
    }
}

/// The target of an edit: an element, or a pair of elements.
pub trait EditTarget: Copy {
    /// Returns the elements that this target consists of.
    fn elements(self) -> Vec<Element>;

    /// Asks the processor to prefetch the memory of the next elements to edit. `at` is the index of the current element
    /// in the list.
    fn fetch_ahead(_: &Mesh, _: &[Self], _at: usize) {}
}

macro_rules! edit_target {
    ($($id:ty),*) => {
        $(impl EditTarget for $id {
            fn elements(self) -> Vec<Element> {
                vec![self.into()]
            }
        })*
    };
}

edit_target!(VertexId, HalfEdgeId, FaceId);

impl EditTarget for EdgeId {
    fn elements(self) -> Vec<Element> {
        vec![self.into()]
    }

    #[inline]
    fn fetch_ahead(mesh: &Mesh, edges: &[Self], at: usize) {
        mesh.fetch_ahead(edges, at);
    }
}

impl<E: EditTarget> EditTarget for [E; 2] {
    fn elements(self) -> Vec<Element> {
        self.into_iter().flat_map(E::elements).collect()
    }
}

/// Calls `edit` for each element, in the order of `elements`. Each edit is checked against the mesh that the earlier
/// edits have produced.
///
/// The report counts the edits. With [`OnRefusal::Skip`], the report also counts the refused edits for each reason. If
/// an earlier edit of the same call has removed an element, the edit of that element counts as refused. `what` is the
/// name of the task that progress reports show.
///
/// # Errors
///
/// Returns [`OpError::Cancelled`] if the run was canceled. With [`OnRefusal::Error`], returns the first refusal as the
/// error. When this function returns an error, some of the elements can already be edited. The operation must return
/// the error, and the caller of the operation undoes the edits.
pub fn edit_each<I: EditTarget>(
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
    for (at, &element) in elements.iter().enumerate() {
        I::fetch_ahead(mesh, elements, at);
        if let Err(refusal) = edit(mesh, element) {
            let refused = || OpError::refused_edit(refusal, mesh, &element.elements());
            match on_refusal {
                OnRefusal::Error => return Err(refused().skippable()),
                OnRefusal::Skip => {
                    report.count_refused(refusal.into(), 1, || refused().to_string());
                }
            }
        } else {
            report.changed += 1;
        }
        if (at + 1).is_multiple_of(4096) {
            cx.advance(what, at as u64 + 1, total)?;
        }
    }
    Ok(report)
}
