//! Local edits over a selection.

use mesh::{EdgeId, EditError, Element, FaceId, HalfEdgeId, Mesh, VertexId};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{Context, OpError, Problem, Range, Report};

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

    /// The problem to report from `plan` for an edit that will be refused.
    pub fn problem(self, message: impl Into<String>) -> Problem {
        match self {
            Self::Error => Problem::error(message),
            Self::Skip => Problem::warning(message),
        }
    }

    /// Fails with a refusal, or counts it.
    ///
    /// # Errors
    ///
    /// `refused` for [`OnRefusal::Error`], and if it is no refusal.
    pub fn refuse(self, refused: OpError, report: &mut Report) -> Result<(), OpError> {
        match self {
            Self::Error => Err(refused),
            Self::Skip => report.refuse(refused),
        }
    }
}

/// What to do at a seam: an edge whose corner values, such as UVs, differ between its two sides.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Seams {
    /// Refuse the edit.
    #[default]
    Refuse,
    /// Edit all the same. Each corner keeps the values of one side.
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

/// What an edit is done to.
pub trait Edited: Copy {
    /// The elements that it is.
    fn elements(self) -> Vec<Element>;

    /// Asks the processor to fetch what the edits after the `at`-th will touch.
    fn fetch_ahead(_: &Mesh, _: &[Self], _at: usize) {}
}

macro_rules! edited {
    ($($id:ty),*) => {
        $(impl Edited for $id {
            fn elements(self) -> Vec<Element> {
                vec![self.into()]
            }
        })*
    };
}

edited!(VertexId, HalfEdgeId, FaceId);

impl Edited for EdgeId {
    fn elements(self) -> Vec<Element> {
        vec![self.into()]
    }

    #[inline]
    fn fetch_ahead(mesh: &Mesh, edges: &[Self], at: usize) {
        mesh.fetch_ahead(edges, at);
    }
}

impl<E: Edited> Edited for [E; 2] {
    fn elements(self) -> Vec<Element> {
        self.into_iter().flat_map(E::elements).collect()
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
pub fn edit_each<I: Edited>(
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
                OnRefusal::Error => return Err(refused()),
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
