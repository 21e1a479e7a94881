//! Records which expectations (statements in a recipe about the scene) hold for a scene, so that these expectations
//! need not be checked again.

use op::{FileUse, Files};
use serde::{Deserialize, Serialize};

use crate::folder::Hash;
use crate::inputs::{FileChecker, Inputs};
use crate::key::digest;
use recipe::RecipeExpectation;

/// An expectation that holds for a scene.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct MetExpectation {
    /// The digest of the text of the expectation and of the objects in its field `on`.
    id: Hash,
    /// The files with which the expectation compares the scene.
    inputs: Inputs,
}

impl MetExpectation {
    /// Records an expectation, and the files that were read or looked for when it was checked. Returns `None` if the
    /// state of a file cannot be determined.
    pub(crate) fn new(
        placed: &RecipeExpectation,
        uses: &[FileUse],
        checker: &mut FileChecker,
    ) -> Option<Self> {
        Some(Self {
            id: id(placed),
            inputs: checker.inputs(uses).ok()?,
        })
    }
}

/// Whether `met` contains the expectation, and none of its input files has changed since it was recorded.
pub(crate) fn is_known_to_hold(
    met: &[MetExpectation],
    placed: &RecipeExpectation,
    files: &Files,
    checker: &mut FileChecker,
) -> bool {
    let id = id(placed);
    let mut same = met.iter().filter(|met| met.id == id);
    same.any(|met| {
        met.inputs.resolve_as_before(files)
            && checker.first_change(files, &met.inputs.files).is_none()
    })
}

fn id(placed: &RecipeExpectation) -> Hash {
    digest("expectation", &(placed.that.to_string(), &placed.on))
}
