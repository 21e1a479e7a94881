//! Finds the place of a parameter that is known by its path only.

use super::tree::{Value, ValueKind};
use crate::diagnostic::Span;

/// The place of the value at `path` in `value`.
///
/// The path holds names of fields, variants and keys, and numbers of items from 0, from the outside
/// in, as in the JSON form: `["edges", "Random", "count"]` leads to the 24 of
/// `FlipEdges(edges: Random(count: 24))`. The name of the outermost call, `Some(..)` and the
/// brackets of a variant with one value need not be named. Where the path leads nowhere, since a
/// parameter was left out, its deepest part that exists is the place.
pub fn field_span(value: &Value, path: &[String]) -> Span {
    let (mut value, mut deepest) = (value, value);
    // Whether the name of the call at `value` was named in the path.
    let mut named = false;
    let mut rest = path;
    while let Some((item, after)) = rest.split_first() {
        match step(value, item, named) {
            Step::Into(inner) => (value, deepest, rest, named) = (inner, inner, after, false),
            Step::Variant => (deepest, rest, named) = (value, after, true),
            // The value inside may be the one that has the item.
            Step::Through(inner) => (value, named) = (inner, false),
            Step::Nowhere => break,
        }
    }
    deepest.span
}

enum Step<'v> {
    /// The item leads to this value.
    Into(&'v Value),
    /// The item is the name of the call.
    Variant,
    /// The item is not used yet.
    Through(&'v Value),
    Nowhere,
}

fn step<'v>(value: &'v Value, item: &str, named: bool) -> Step<'v> {
    if let Some(inner) = value.some() {
        return Step::Through(inner);
    }
    let index = item.parse::<usize>();
    let found = match &value.kind {
        ValueKind::Call(call) if !named && *item == *call.name.text => return Step::Variant,
        ValueKind::Call(call) => return Step::Through(&call.body),
        ValueKind::Name(name) if *item == **name => return Step::Variant,
        ValueKind::Struct(_) => value.field(item),
        ValueKind::Map(entries) => entries
            .iter()
            .find(|(key, _)| key.as_str() == Some(item))
            .map(|(_, value)| value),
        // The only value of a variant is the variant's content, and not its first item, if it
        // has parts itself.
        ValueKind::Tuple(items)
            if items.len() == 1
                && (index.is_err()
                    || matches!(items[0].kind, ValueKind::Tuple(_) | ValueKind::List(_))) =>
        {
            return Step::Through(&items[0]);
        }
        ValueKind::Tuple(items) | ValueKind::List(items) => index.ok().and_then(|i| items.get(i)),
        _ => None,
    };
    found.map_or(Step::Nowhere, Step::Into)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parse;

    const SOURCE: &str = "Flip(edges: Random(count: 24, of: Some(Not(Tagged(\"a\")))), \
                          at: (1, 2), list: Vertices([7, 8]), map: {\"k\": 5}, kind: Area)";

    fn found(path: &[&str]) -> &'static str {
        let path: Vec<String> = path.iter().map(ToString::to_string).collect();
        field_span(&parse(SOURCE).value, &path).of(SOURCE)
    }

    #[test]
    fn a_path_leads_to_its_value() {
        assert_eq!(found(&["edges", "Random", "count"]), "24");
        assert_eq!(found(&["edges", "count"]), "24");
        assert_eq!(found(&["Flip", "at", "1"]), "2");
        assert_eq!(found(&["list", "Vertices", "1"]), "8");
        assert_eq!(found(&["map", "k"]), "5");
        assert_eq!(found(&["kind", "Area"]), "Area");
        assert_eq!(
            found(&["edges", "Random", "of", "Not", "Tagged"]),
            "Tagged(\"a\")"
        );
    }

    #[test]
    fn the_deepest_part_that_exists_is_the_place() {
        assert_eq!(found(&["at", "7"]), "(1, 2)");
        assert_eq!(
            found(&["edges", "Random", "seed"]),
            "Random(count: 24, of: Some(Not(Tagged(\"a\"))))"
        );
        assert_eq!(found(&["nothing"]), SOURCE);
        assert_eq!(found(&[]), SOURCE);
    }
}
