//! Reads selections from texts that are not recipes, such as options of the command line, and resolves them on a mesh.
//!
//! ```text
//! "Sharp(above: 30)"   exists only for edges                  ---> edges
//! "Vertices([0, 4])"   exists only for vertices               ---> vertices
//! "Boundary"           exists for vertices, edges and faces   ---> an error: the kind must be specified
//! ```

use mesh::Mesh;
use op::{Context, ElementKind, Elements, Files, NoProgress, OpError, Selected};
use scene::{Object, Scene};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;

use crate::schema;
use crate::schema_check;
use ron_tree::{Diagnostic, Value, ValueKind};

/// Reads a selection from text in the syntax of recipes. The selection selects elements of `kind`. If `kind` is `None`,
/// the selection must be valid for exactly one kind of element, and it then selects elements of this kind.
///
/// # Errors
///
/// Returns all errors, with their spans in `source`. If `kind` is `None` and the selection is valid for no kind of
/// element, returns the errors for the kind that fits best. If the selection is valid for several kinds of element, the
/// error says that the kind must be specified.
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

/// Reads the parameters of a step from text of the form `Name(parameters)`. The name is not checked.
///
/// # Errors
///
/// Returns all errors, with their spans in `source`.
pub fn read_step<T: DeserializeOwned + JsonSchema>(source: &str) -> Result<T, Vec<Diagnostic>> {
    let parsed = ron_tree::parse(source);
    let step = &parsed.value;
    let checked = schema_check::check_step(step, &schema::of::<T>());
    let wrong = [parsed.diagnostics, checked.wrong.clone()].concat();
    if !wrong.is_empty() {
        return Err(wrong);
    }
    let full = checked.in_full(step);
    let parameters = match &full.kind {
        ValueKind::Call(call) => &call.body,
        _ => &*full,
    };
    T::deserialize(parameters)
        .map_err(|error| vec![schema_check::deserialize_error(step.span, error)])
}

/// If `text` starts with the name of a variant of `T` in the wrong case, returns the text with the right case. For
/// example, `front` becomes `Front`.
pub fn with_case_of<T: JsonSchema>(text: &str) -> String {
    let end = text.find(|c: char| !(c.is_alphanumeric() || c == '_'));
    let (name, rest) = text.split_at(end.unwrap_or(text.len()));
    let schema = schema::of::<T>();
    let known = schema_check::Schema::root(&schema).variants();
    let found = known
        .into_iter()
        .find(|known| known.eq_ignore_ascii_case(name));
    format!("{}{rest}", found.unwrap_or(name))
}

fn typed<T: DeserializeOwned + JsonSchema>(value: &Value) -> Result<T, Vec<Diagnostic>> {
    schema_check::typed(value, &schema::of::<T>())
}

/// Returns the elements of an object that the selection `elements` matches. `stream` seeds random choices. To get the
/// same random choices as a step, pass the label of the step.
///
/// # Errors
///
/// Returns the errors of [`Elements::resolve`].
pub fn resolve(
    elements: &Elements,
    scene: &Scene,
    object: &Object,
    mesh: &Mesh,
    stream: &str,
) -> Result<Selected, OpError> {
    let files = Files::default();
    let mut cx = Context::new(&NoProgress, &files);
    cx.stream = stream;
    cx.set_object(scene, &object.name);
    elements.resolve(mesh, &cx)
}

#[cfg(test)]
mod tests {
    use geometry::shapes;
    use mesh::VertexId;

    use super::*;

    fn wrong(source: &str, kind: Option<ElementKind>) -> Vec<(String, String, String)> {
        let shown = |d: Diagnostic| {
            let place = d.span.unwrap_or_default().of(source).to_owned();
            (place, d.message, d.help.unwrap_or_default())
        };
        let diagnostics = read_selection(source, kind).unwrap_err();
        diagnostics.into_iter().map(shown).collect()
    }

    #[test]
    fn the_kind_can_be_omitted_if_only_one_fits() {
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
    fn the_kind_must_be_specified_if_several_fit() {
        assert_eq!(
            wrong("All", None),
            [(
                "All".to_owned(),
                "this selection can select vertices or edges or faces: specify which".to_owned(),
                "write `Vertices(All)` or `Edges(All)` or `Faces(All)`".to_owned()
            )]
        );
        for kind in ElementKind::ALL {
            assert_eq!(read_selection("All", Some(kind)).unwrap().kind(), kind);
        }
    }

    #[test]
    fn the_kind_can_be_written_in_full() {
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
            "`Sharp` selects edges, expected a selection of faces for `Faces`"
        );
    }

    #[test]
    fn suggestions_for_an_unknown_selection_come_from_all_kinds() {
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
    fn errors_are_reported_for_the_kind_that_fits_best() {
        assert_eq!(
            wrong("And([Boundary, Sharp(abov: 30)])", None)
                .into_iter()
                .map(|(place, message, _)| (place, message))
                .collect::<Vec<_>>(),
            [(
                "abov".to_owned(),
                "unknown field `abov` in `Sharp` (read as a selection of edges)".to_owned()
            ),]
        );
        assert_eq!(
            wrong("Sharp(above: 300)", None)[0].1,
            "`above` is 300, expected at most 180 (read as a selection of edges)"
        );
        assert_eq!(wrong("Sharp(above: 30", Some(ElementKind::Edges)).len(), 1);
        assert!(!wrong("", None).is_empty() && !wrong("12", None).is_empty());
    }

    #[test]
    fn resolve_returns_the_selected_elements() {
        let object = Object::mesh("cube", shapes::cube());
        let mesh = object.as_mesh().unwrap();
        let found = |source, kind| {
            let elements = read_selection(source, kind).unwrap();
            resolve(&elements, &Scene::new(), &object, mesh, "")
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
