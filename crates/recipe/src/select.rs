//! Selections on their own, outside of a recipe: read from a text, and asked of a mesh.
//!
//! ```text
//! "Sharp(above: 30)"   only edges can be sharp           ---> edges
//! "Vertices([0, 4])"   only vertices have this           ---> vertices
//! "Boundary"           vertices, edges and faces can     ---> say which are meant
//! ```

use mesh::Mesh;
use op::{Context, ElementKind, Elements, Files, NoProgress, OpError, Selected};
use scene::Object;
use schemars::JsonSchema;
use serde::de::DeserializeOwned;

use crate::schema;
use crate::shape;
use ron_tree::{Diagnostic, Value, ValueKind};

/// Reads a selection as recipes write it: of `kind`, or else of the one kind of elements that has such
/// selections.
///
/// # Errors
///
/// Everything that is wrong with it, with places in `source`. Where no kind is given and none fits, that
/// is told of the kind that fits furthest; where several fit, that one must be given.
pub fn read_selection(
    source: &str,
    kind: Option<ElementKind>,
) -> Result<Elements, Vec<Diagnostic>> {
    let parsed = ron_tree::parse(source);
    if !parsed.diagnostics.is_empty() {
        return Err(parsed.diagnostics);
    }
    let value = &parsed.value;
    match kind {
        None => typed(value),
        Some(ElementKind::Vertices) => typed(value).map(Elements::Vertices),
        Some(ElementKind::Edges) => typed(value).map(Elements::Edges),
        Some(ElementKind::Faces) => typed(value).map(Elements::Faces),
    }
}

/// Reads the parameters of a step `Name(parameters)`, whatever the name.
///
/// # Errors
///
/// Everything that is wrong with them, with places in `source`.
pub fn read_step<T: DeserializeOwned + JsonSchema>(source: &str) -> Result<T, Vec<Diagnostic>> {
    let parsed = ron_tree::parse(source);
    let step = &parsed.value;
    let checked = shape::check_step(step, &schema::of::<T>());
    let wrong = [parsed.diagnostics, checked.wrong.clone()].concat();
    if !wrong.is_empty() {
        return Err(wrong);
    }
    let full = checked.in_full(step);
    let parameters = match &full.kind {
        ValueKind::Call(call) => &call.body,
        _ => &*full,
    };
    T::deserialize(parameters).map_err(|error| vec![shape::unread(step.span, error)])
}

fn typed<T: DeserializeOwned + JsonSchema>(value: &Value) -> Result<T, Vec<Diagnostic>> {
    shape::typed(value, &schema::of::<T>())
}

/// The elements of an object that a selection matches. `stream` keys random choices: the id of a step, or
/// else the name of its operation, gives the choice that this step makes.
///
/// # Errors
///
/// As [`Elements::resolve`].
pub fn resolve(
    elements: &Elements,
    object: &Object,
    mesh: &Mesh,
    stream: &str,
) -> Result<Selected, OpError> {
    let files = Files::default();
    let mut cx = Context::new(&NoProgress, &files);
    cx.stream = stream;
    cx.materials = object.materials.iter().map(|m| m.name.clone()).collect();
    elements.resolve(mesh, &cx)
}

#[cfg(test)]
mod tests {
    use geometry::shapes;
    use mesh::VertexId;

    use super::*;

    fn wrong(source: &str, kind: Option<ElementKind>) -> Vec<(String, String, String)> {
        let told = |d: Diagnostic| {
            let place = d.span.unwrap_or_default().of(source).to_owned();
            (place, d.message, d.help.unwrap_or_default())
        };
        let diagnostics = read_selection(source, kind).unwrap_err();
        diagnostics.into_iter().map(told).collect()
    }

    #[test]
    fn the_kind_is_told_by_the_text_where_only_one_fits() {
        for (source, kind) in [
            ("Sharp(above: 30)", ElementKind::Edges),
            ("Isolated", ElementKind::Vertices),
            ("Degree(3)", ElementKind::Faces),
            ("And([Boundary, Longer(than: 1)])", ElementKind::Edges),
            ("Not(CornersOf(Faces([0])))", ElementKind::Vertices),
        ] {
            assert_eq!(
                read_selection(source, None).unwrap().kind(),
                kind,
                "{source}"
            );
        }
    }

    #[test]
    fn a_text_that_several_kinds_have_needs_a_word() {
        assert_eq!(
            wrong("All", None),
            [(
                "All".to_owned(),
                "this selects vertices or edges or faces: say which are meant".to_owned(),
                "write `Vertices(All)` or `Edges(All)` or `Faces(All)`".to_owned()
            )]
        );
        for kind in ElementKind::ALL {
            assert_eq!(read_selection("All", Some(kind)).unwrap().kind(), kind);
        }
    }

    #[test]
    fn the_kind_may_be_said_in_full() {
        for (full, short) in [
            ("Edges(Sharp(above: 30))", "Sharp(above: 30)"),
            ("Faces(Faces([1]))", "Faces([1])"),
            ("Vertices(Vertices([1]))", "Vertices([1])"),
        ] {
            assert_eq!(read_selection(full, None), read_selection(short, None));
        }
        assert_eq!(
            read_selection("Vertices(All)", None).unwrap().kind(),
            ElementKind::Vertices
        );
        assert_eq!(
            wrong("Faces(Sharp(above: 30))", None)[0].1,
            "unknown variant `Sharp` for `Faces`"
        );
    }

    #[test]
    fn an_unknown_selection_has_the_nearest_of_all_kinds() {
        assert_eq!(
            wrong("Shrp(above: 30)", None),
            [(
                "Shrp".to_owned(),
                "unknown selection `Shrp`".to_owned(),
                "did you mean `Sharp`?".to_owned()
            )]
        );
    }

    #[test]
    fn errors_are_those_of_the_kind_that_fits_best() {
        assert_eq!(
            wrong("And([Boundary, Sharp(abov: 30)])", None)
                .into_iter()
                .map(|(place, message, _)| (place, message))
                .collect::<Vec<_>>(),
            [
                (
                    "Sharp".to_owned(),
                    "`Sharp` needs `above` (read as a selection of edges)".to_owned()
                ),
                (
                    "abov".to_owned(),
                    "unknown field `abov` in `Sharp` (read as a selection of edges)".to_owned()
                ),
            ]
        );
        assert_eq!(
            wrong("Sharp(above: 300)", None)[0].1,
            "`above` is 300, expected at most 180 (read as a selection of edges)"
        );
        assert_eq!(wrong("Sharp(above: 30", Some(ElementKind::Edges)).len(), 1);
        assert!(!wrong("", None).is_empty() && !wrong("12", None).is_empty());
    }

    #[test]
    fn elements_are_those_that_the_selection_has() {
        let object = Object::mesh("cube", shapes::cube());
        let mesh = object.as_mesh().unwrap();
        let found = |source, kind| {
            let elements = read_selection(source, kind).unwrap();
            resolve(&elements, &object, mesh, "")
        };
        assert_eq!(found("Sharp(above: 30)", None).unwrap().len(), 12);
        assert!(
            found("Boundary", Some(ElementKind::Faces))
                .unwrap()
                .is_empty()
        );
        assert_eq!(
            found("Vertices([3])", None).unwrap(),
            Selected::Vertices(vec![VertexId::new(3)])
        );
        assert!(found("Tagged(\"nose\")", Some(ElementKind::Faces)).is_err());
    }
}
