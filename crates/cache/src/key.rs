//! The key of a step, the ingredients (the data from which the key is computed), and the state of a scene.

use op::Refusal;
use serde::{Deserialize, Serialize};

use crate::folder::Hash;
use crate::inputs::FileState;
use recipe::RecipeStep;

/// The version of the storage format. The names of the files with records and histories depend on this version, so a
/// program with another version of the format never finds these files.
const FORMAT: &str = "meshwright step cache 2";

/// The data that determine the result of a step and that are known before the step runs.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct Ingredients {
    pub(crate) program: String,
    pub(crate) operation: String,
    pub(crate) version: u32,
    /// The parameters in canonical form, with all defaults written out.
    pub(crate) parameters: String,
    pub(crate) on: Option<Vec<String>>,
    /// The label of the step, which seeds the random choices of the step.
    pub(crate) stream: String,
    pub(crate) refused: Option<Refusal>,
    pub(crate) budget: u64,
    /// The state of the scene before the step.
    pub(crate) before: State,
}

/// The key of a step, under which its records are stored.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct Key(pub(crate) Hash);

/// A digest that identifies a scene, usually computed from the steps that produced the scene.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct State(pub(crate) Hash);

impl Ingredients {
    /// Returns the ingredients of a step, from which the key of the step is computed. Returns `None` if the step could
    /// not be read because it contains an error.
    pub(crate) fn of(step: &RecipeStep, program: &str, budget: u64, before: State) -> Option<Self> {
        let operation = step.step.as_ref()?;
        Some(Self {
            program: program.to_owned(),
            operation: operation.name().to_owned(),
            version: operation.version(),
            parameters: operation.canonical(),
            on: step.on_names(),
            stream: step.label().to_owned(),
            refused: step.refused,
            budget,
            before,
        })
    }

    pub(crate) fn key(&self) -> Key {
        Key(digest("key", self))
    }
}

impl Key {
    /// Returns the state of the scene after the step with this key. `read` contains the files that the step read or
    /// looked for.
    pub(crate) fn after(self, read: &[FileState]) -> State {
        let files: Vec<_> = read
            .iter()
            .map(|file| (file.path.as_os_str().as_encoded_bytes(), file.state))
            .collect();
        State(digest("state", &(self, files)))
    }
}

impl State {
    /// Returns the state of the empty scene at the start of a run.
    pub(crate) fn start() -> Self {
        Self(digest("start", &()))
    }

    /// Returns the state of a scene, computed from the content of the scene. This function is used if the input files
    /// of the step that produced the scene are unknown.
    pub(crate) fn of_scene(digest_of_scene: scene::Digest) -> Self {
        Self(digest("scene", &digest_of_scene.to_bytes()))
    }
}

/// Returns the digest of serialized data. `what` is the kind of data. Equal data of different kinds has different
/// digests.
pub(crate) fn digest(what: &str, data: &impl Serialize) -> Hash {
    let bytes = postcard::to_stdvec(data).expect("plain data of known lengths");
    let mut hasher = blake3::Hasher::new_derive_key(FORMAT);
    hasher.update(&(what.len() as u64).to_le_bytes());
    hasher.update(what.as_bytes());
    hasher.update(&bytes);
    *hasher.finalize().as_bytes()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::inputs::PathState;

    fn ingredients() -> Ingredients {
        Ingredients {
            program: "p".into(),
            operation: "Op".into(),
            version: 1,
            parameters: "(a:1)".into(),
            on: None,
            stream: "s".into(),
            refused: None,
            budget: 1,
            before: State::start(),
        }
    }

    #[test]
    fn the_key_changes_with_every_ingredient() {
        let changes: [fn(&mut Ingredients); 13] = [
            |_| {},
            |i| i.program = "q".into(),
            |i| i.operation = "Other".into(),
            |i| i.version = 2,
            |i| i.parameters = "(a:2)".into(),
            |i| i.on = Some(Vec::new()),
            |i| i.on = Some(vec!["a".into(), "b".into()]),
            |i| i.on = Some(vec!["ab".into()]),
            |i| i.stream = "t".into(),
            |i| i.refused = Some(Refusal::Seam),
            |i| i.refused = Some(Refusal::Boundary),
            |i| i.budget = 2,
            |i| i.before = i.key().after(&[]),
        ];
        let keys: BTreeSet<Hash> = changes
            .iter()
            .map(|change| {
                let mut changed = ingredients();
                change(&mut changed);
                changed.key().0
            })
            .collect();
        assert_eq!(keys.len(), changes.len());
        // The same characters can be divided between the fields `program` and `operation` in different ways. Each way
        // must give a different key.
        let (mut a, mut b) = (ingredients(), ingredients());
        (a.program, a.operation) = ("pO".into(), "p".into());
        (b.program, b.operation) = ("p".into(), "Op".into());
        assert_ne!(a.key(), b.key());
    }

    #[test]
    fn the_state_changes_with_every_file_that_was_read() {
        let key = ingredients().key();
        let file = |path: &str, state| FileState {
            path: path.into(),
            state,
        };
        let a = || file("a", PathState::Content([1; 32]));
        let states = [
            key.after(&[]),
            key.after(&[a()]),
            key.after(&[a(), a()]),
            key.after(&[file("b", PathState::Content([1; 32]))]),
            key.after(&[file("a", PathState::Content([2; 32]))]),
            key.after(&[file("a", PathState::Exists)]),
            key.after(&[file("a", PathState::Missing)]),
            State::start(),
        ];
        let different: BTreeSet<Hash> = states.iter().map(|state| state.0).collect();
        assert_eq!(different.len(), states.len());
    }

    #[cfg(unix)]
    #[test]
    fn paths_that_are_not_unicode_have_different_keys() {
        use std::os::unix::ffi::OsStrExt;
        let file = |bytes: &[u8]| FileState {
            path: std::ffi::OsStr::from_bytes(bytes).into(),
            state: PathState::Exists,
        };
        let key = ingredients().key();
        assert_ne!(key.after(&[file(b"\xff")]), key.after(&[file(b"\xfe")]));
    }
}
