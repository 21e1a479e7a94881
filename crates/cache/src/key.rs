//! What a step is made of, and the digests that name it and the state behind it.

use op::Refusal;
use serde::{Deserialize, Serialize};

use crate::folder::Hash;
use crate::seen::FileState;
use recipe::RecipeStep;

/// The form of everything that is stored; another one never meets the files of this one.
const FORM: &str = "meshwright step cache 1";

/// All that decides the result of a step before it runs.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct Ingredients {
    pub(crate) program: String,
    pub(crate) operation: String,
    pub(crate) version: u32,
    /// With every default written out.
    pub(crate) parameters: String,
    pub(crate) on: Option<Vec<String>>,
    /// The name that keys random choices.
    pub(crate) stream: String,
    pub(crate) refused: Option<Refusal>,
    pub(crate) budget: u64,
    /// The state before the step.
    pub(crate) before: State,
}

/// The key of a step: what its result is stored under.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct Key(pub(crate) Hash);

/// The state of a scene, by how it came to be.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct State(pub(crate) Hash);

impl Ingredients {
    /// What a step is made of; `None` if it could not be read.
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
    /// The state after a step that has read these files.
    pub(crate) fn after(self, read: &[FileState]) -> State {
        let files: Vec<_> = read
            .iter()
            .map(|file| (file.path.as_os_str().as_encoded_bytes(), file.seen))
            .collect();
        State(digest("state", &(self, files)))
    }
}

impl State {
    /// The state of an empty scene.
    pub(crate) fn start() -> Self {
        Self(digest("start", &()))
    }

    /// The state of a scene of which only the content is known.
    pub(crate) fn of_scene(digest_of_scene: scene::Digest) -> Self {
        Self(digest("scene", &digest_of_scene.to_bytes()))
    }
}

/// The digest of plain data; `what` keeps different uses apart.
pub(crate) fn digest(what: &str, data: &impl Serialize) -> Hash {
    let bytes = postcard::to_stdvec(data).expect("plain data of known lengths");
    let mut hasher = blake3::Hasher::new_derive_key(FORM);
    hasher.update(&(what.len() as u64).to_le_bytes());
    hasher.update(what.as_bytes());
    hasher.update(&bytes);
    *hasher.finalize().as_bytes()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::seen::Seen;

    fn made_of() -> Ingredients {
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
                let mut changed = made_of();
                change(&mut changed);
                changed.key().0
            })
            .collect();
        assert_eq!(keys.len(), changes.len());
        // Text does not move from one part to another.
        let (mut a, mut b) = (made_of(), made_of());
        (a.program, a.operation) = ("pO".into(), "p".into());
        (b.program, b.operation) = ("p".into(), "Op".into());
        assert_ne!(a.key(), b.key());
    }

    #[test]
    fn the_state_changes_with_every_file_that_was_read() {
        let key = made_of().key();
        let file = |path: &str, seen| FileState {
            path: path.into(),
            seen,
        };
        let a = || file("a", Seen::Content([1; 32]));
        let states = [
            key.after(&[]),
            key.after(&[a()]),
            key.after(&[a(), a()]),
            key.after(&[file("b", Seen::Content([1; 32]))]),
            key.after(&[file("a", Seen::Content([2; 32]))]),
            key.after(&[file("a", Seen::Plain)]),
            key.after(&[file("a", Seen::Nothing)]),
            State::start(),
        ];
        let different: BTreeSet<Hash> = states.iter().map(|state| state.0).collect();
        assert_eq!(different.len(), states.len());
    }

    #[cfg(unix)]
    #[test]
    fn paths_that_are_no_text_are_told_apart() {
        use std::os::unix::ffi::OsStrExt;
        let file = |bytes: &[u8]| FileState {
            path: std::ffi::OsStr::from_bytes(bytes).into(),
            seen: Seen::Plain,
        };
        let key = made_of().key();
        assert_ne!(key.after(&[file(b"\xff")]), key.after(&[file(b"\xfe")]));
    }
}
