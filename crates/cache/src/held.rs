//! Expectations that held, so that they need not be asked again of the same scene.

use op::{FileUse, Files};
use serde::{Deserialize, Serialize};

use crate::folder::Hash;
use crate::key::digest;
use crate::seen::{Eyes, Inputs};
use recipe::RecipeExpectation;

/// An expectation that held for a scene.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct Held {
    /// The digest of its text and of the objects that it is about.
    text: Hash,
    /// The files that it compares with.
    read: Inputs,
}

impl Held {
    /// An expectation that held, with what it did with files; `None` if that cannot be told.
    pub(crate) fn new(
        placed: &RecipeExpectation,
        uses: &[FileUse],
        eyes: &mut Eyes,
    ) -> Option<Self> {
        Some(Self {
            text: text(placed),
            read: eyes.read(uses).ok()?,
        })
    }
}

/// Whether one of these says that the expectation holds.
pub(crate) fn holds(
    held: &[Held],
    placed: &RecipeExpectation,
    files: &Files,
    eyes: &mut Eyes,
) -> bool {
    let text = text(placed);
    let mut same = held.iter().filter(|held| held.text == text);
    same.any(|held| held.read.are_asked_for_in(files) && eyes.changed(&held.read.files).is_none())
}

fn text(placed: &RecipeExpectation) -> Hash {
    digest("expectation", &(placed.that.to_string(), &placed.on))
}
