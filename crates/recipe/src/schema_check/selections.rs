//! Explains errors about selections of the wrong kind, such as `Faces([0])` where a selection of edges is expected.

use std::sync::LazyLock;

use op::{EdgeSelection, ElementKind, FaceSelection, VertexSelection};
use serde_json::Value as Json;

use super::Schema;
use crate::schema;

/// An error for a selection of the wrong kind.
pub(super) struct WrongKind {
    pub(super) message: String,
    pub(super) help: String,
}

/// The name of a selection type, and the names of its variants.
type Variants = (&'static str, Vec<String>);

/// Explains an error: the variant `name` belongs to a selection type other than `expected`. Returns `None` if
/// `expected` is not a selection type, or if no selection type has the variant.
pub(super) fn of_other_kind(name: &str, expected: &str) -> Option<WrongKind> {
    static ALL: LazyLock<[Variants; 3]> = LazyLock::new(|| {
        [
            (
                "VertexSelection",
                variants(&schema::of::<VertexSelection>()),
            ),
            ("EdgeSelection", variants(&schema::of::<EdgeSelection>())),
            ("FaceSelection", variants(&schema::of::<FaceSelection>())),
        ]
    });
    let kinds = || ElementKind::ALL.into_iter().zip(&*ALL);
    let (expected, _) = kinds().find(|(_, (of, _))| *of == expected)?;
    let (found, _) = kinds().find(|(_, (_, variants))| variants.iter().any(|v| v == name))?;
    let (word, found_word) = (expected.word(), found.word());
    let full = expected.conversions(found).iter();
    let full: Vec<String> = full.map(|outer| format!("`{outer}({name}(..))`")).collect();
    Some(WrongKind {
        message: format!("`{name}` selects {found_word}, expected a selection of {word}"),
        help: format!("write {}", full.join(" or ")),
    })
}

fn variants(schema: &Json) -> Vec<String> {
    let names = Schema::root(schema).variants();
    names.into_iter().map(str::to_owned).collect()
}
