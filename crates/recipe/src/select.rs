//! Selections on their own, outside of a recipe: read from a text, and asked of a mesh.
//!
//! ```text
//! "Sharp(above: 30)"   only edges can be sharp           ---> edges
//! "Vertices([0, 4])"   only vertices have this           ---> vertices
//! "Boundary"           vertices, edges and faces can     ---> say which are meant
//! ```

use std::cmp::Reverse;

use mesh::{EdgeId, FaceId, Mesh, VertexId};
use op::{
    Context, EdgeSelection, FaceSelection, Files, NoProgress, OpError, Select, VertexSelection,
};
use scene::Object;
use serde_json::Value as Json;

use crate::diagnostic::Diagnostic;
use crate::expect::Elements;
use crate::schema;
use crate::shape::{check_shape, did_you_mean, variants};
use crate::syntax::{self, Value, ValueKind};

/// What a selection selects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementKind {
    /// Vertices.
    Vertices,
    /// Edges.
    Edges,
    /// Faces.
    Faces,
}

impl ElementKind {
    /// All three.
    pub const ALL: [Self; 3] = [Self::Vertices, Self::Edges, Self::Faces];

    /// `vertices`, `edges` or `faces`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Vertices => VertexSelection::WORD,
            Self::Edges => EdgeSelection::WORD,
            Self::Faces => FaceSelection::WORD,
        }
    }

    fn schema(self) -> Json {
        match self {
            Self::Vertices => schema::of::<VertexSelection>(),
            Self::Edges => schema::of::<EdgeSelection>(),
            Self::Faces => schema::of::<FaceSelection>(),
        }
    }

    fn typed(self, value: &Value) -> Result<Elements, Vec<Diagnostic>> {
        let (text, options) = (value.to_string(), syntax::ron_options());
        match self {
            Self::Vertices => options.from_str(&text).map(Elements::Vertices),
            Self::Edges => options.from_str(&text).map(Elements::Edges),
            Self::Faces => options.from_str(&text).map(Elements::Faces),
        }
        .map_err(|error| vec![Diagnostic::error(value.span, error.code.to_string())])
    }
}

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
    let parsed = syntax::parse(source);
    if !parsed.diagnostics.is_empty() {
        return Err(parsed.diagnostics);
    }
    let value = &parsed.value;
    if let Some(kind) = kind {
        let wrong = check_shape(value, &kind.schema());
        return if wrong.is_empty() {
            kind.typed(value)
        } else {
            Err(wrong)
        };
    }
    let trials = ElementKind::ALL.map(|kind| (kind, check_shape(value, &kind.schema())));
    let fitting: Vec<ElementKind> = trials
        .iter()
        .filter(|(_, wrong)| wrong.is_empty())
        .map(|(kind, _)| *kind)
        .collect();
    match fitting[..] {
        [kind] => kind.typed(value),
        [] => Err(closest(value, trials)),
        ref several => {
            let words: Vec<&str> = several.iter().map(|kind| kind.word()).collect();
            let message = format!("this selects {}: say which are meant", words.join(" or "));
            let help = format!("give --of {}", words.join(" or --of "));
            Err(vec![Diagnostic::error(value.span, message).with_help(help)])
        }
    }
}

/// What is wrong with a selection that is none of any kind.
fn closest(value: &Value, trials: [(ElementKind, Vec<Diagnostic>); 3]) -> Vec<Diagnostic> {
    let names = trials.each_ref().map(|(kind, _)| variants(&kind.schema()));
    if let Some((name, span)) = value.name()
        && !names.iter().flatten().any(|known| known == name)
    {
        let mut known: Vec<&str> = names.iter().flatten().map(String::as_str).collect();
        known.sort_unstable();
        known.dedup();
        let error = Diagnostic::error(span, format!("unknown selection `{name}`"));
        return vec![error.with_help(did_you_mean(name, known))];
    }
    // The kind that knows most of the names, and of those the one with the fewest errors.
    let fit = |kind: ElementKind, wrong: &[Diagnostic]| {
        let known = n_known(value, &variants(&kind.schema()));
        (known, Reverse(wrong.len()))
    };
    let mut best: Option<(ElementKind, Vec<Diagnostic>)> = None;
    for (kind, wrong) in trials {
        let is_better = |(other, others): &(ElementKind, Vec<Diagnostic>)| {
            fit(kind, &wrong) > fit(*other, others)
        };
        if best.as_ref().is_none_or(is_better) {
            best = Some((kind, wrong));
        }
    }
    let (kind, mut wrong) = best.expect("there are three kinds");
    for diagnostic in &mut wrong {
        let word = kind.word();
        diagnostic.message = format!("{} (read as a selection of {word})", diagnostic.message);
    }
    wrong
}

/// How many names in the value are among those of `names`.
fn n_known(value: &Value, names: &[String]) -> usize {
    let all = |values: &[Value]| values.iter().map(|v| n_known(v, names)).sum::<usize>();
    let inside = match &value.kind {
        ValueKind::Call(call) => n_known(&call.body, names),
        ValueKind::Struct(body) => body.fields.iter().map(|f| n_known(&f.value, names)).sum(),
        ValueKind::Tuple(values) | ValueKind::List(values) => all(values),
        _ => 0,
    };
    let is_known = |(name, _): (&str, _)| names.iter().any(|known| known == name);
    inside + usize::from(value.name().is_some_and(is_known))
}

/// The elements of a mesh that a selection matches, in order of their numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Selected {
    /// Vertices.
    Vertices(Vec<VertexId>),
    /// Edges.
    Edges(Vec<EdgeId>),
    /// Faces.
    Faces(Vec<FaceId>),
}

impl Selected {
    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Vertices(list) => list.len(),
            Self::Edges(list) => list.len(),
            Self::Faces(list) => list.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Elements {
    /// What kind of elements these are.
    pub fn kind(&self) -> ElementKind {
        match self {
            Self::Vertices(_) => ElementKind::Vertices,
            Self::Edges(_) => ElementKind::Edges,
            Self::Faces(_) => ElementKind::Faces,
        }
    }

    /// The elements of an object that the selection matches. `stream` keys random choices: the id of a
    /// step, or else the name of its operation, gives the choice that this step makes.
    ///
    /// # Errors
    ///
    /// As [`Select::resolve`]: an element, tag or material that is named is not there, or an expected
    /// number is not met.
    pub fn resolve(&self, object: &Object, mesh: &Mesh, stream: &str) -> Result<Selected, OpError> {
        let files = Files::default();
        let mut cx = Context::new(&NoProgress, &files);
        cx.stream = stream;
        cx.materials = object.materials.iter().map(|m| m.name.clone()).collect();
        Ok(match self {
            Self::Vertices(s) => Selected::Vertices(s.resolve(mesh, &cx)?),
            Self::Edges(s) => Selected::Edges(s.resolve(mesh, &cx)?),
            Self::Faces(s) => Selected::Faces(s.resolve(mesh, &cx)?),
        })
    }
}

#[cfg(test)]
mod tests {
    use mesh::shapes;

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
                "give --of vertices or --of edges or --of faces".to_owned()
            )]
        );
        for kind in ElementKind::ALL {
            assert_eq!(read_selection("All", Some(kind)).unwrap().kind(), kind);
        }
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
            elements.resolve(&object, mesh, "")
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
