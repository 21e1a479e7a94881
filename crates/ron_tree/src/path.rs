//! Finds the span of a parameter that is given by its path.

use super::tree::{Value, ValueKind};
use crate::diagnostic::Span;

/// Returns the span of the value at `path` in `value`.
///
/// The path starts at the outermost value. As in the JSON form, the path consists of names (of fields, variants and
/// keys) and of indices of items, counted from 0. For example, `["edges", "Random", "count"]` leads to the 24 in
/// `FlipEdges(edges: Random(count: 24))`. The path can omit the names of calls, and the index of the only value in
/// parentheses. The path never contains `Some`. If the value at `path` does not exist, returns the span of the deepest
/// existing value on the path.
pub fn field_span(value: &Value, path: &[String]) -> Span {
    let (mut value, mut deepest) = (value, value);
    // Whether an item of the path has already matched the name of the variant at `value`.
    let mut is_variant_matched = false;
    let mut rest = path;
    while let Some((item, after)) = rest.split_first() {
        match step(value, item, is_variant_matched) {
            Step::Into(inner) => {
                (value, deepest, rest, is_variant_matched) = (inner, inner, after, false);
            }
            Step::Variant => (deepest, rest, is_variant_matched) = (value, after, true),
            // The current item of the path is not consumed, because the next iteration looks it up in the inner value.
            Step::Through(inner) => (value, is_variant_matched) = (inner, false),
            Step::NotFound => break,
        }
    }
    deepest.span
}

/// How a path continues from a value.
enum Step<'v> {
    /// The item of the path leads to this value.
    Into(&'v Value),
    /// The item is the name of the variant.
    Variant,
    /// The item must be looked up in this inner value.
    Through(&'v Value),
    /// The item does not exist.
    NotFound,
}

fn step<'v>(value: &'v Value, item: &str, is_variant_matched: bool) -> Step<'v> {
    if let Some(inner) = value.some() {
        return Step::Through(inner);
    }
    let index = item.parse::<usize>();
    let found = match &value.kind {
        ValueKind::Call(call) if !is_variant_matched && *item == *call.name.text => {
            return Step::Variant;
        }
        ValueKind::Call(call) => return Step::Through(&call.body),
        ValueKind::Name(name) if *item == **name => return Step::Variant,
        ValueKind::Struct(_) => value.field(item),
        ValueKind::Map(entries) => entries
            .iter()
            .find(|(key, _)| key.as_str() == Some(item))
            .map(|(_, value)| value),
        // A tuple with one item is usually the content of a variant, and the path skips it. There is one exception: the
        // path continues with an index, and the item is neither a tuple nor a list. Then the index refers to the tuple
        // itself.
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
    found.map_or(Step::NotFound, Step::Into)
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
    fn a_path_to_a_missing_value_leads_to_the_deepest_existing_value() {
        assert_eq!(found(&["at", "7"]), "(1, 2)");
        assert_eq!(
            found(&["edges", "Random", "seed"]),
            "Random(count: 24, of: Some(Not(Tagged(\"a\"))))"
        );
        assert_eq!(found(&["nothing"]), SOURCE);
        assert_eq!(found(&[]), SOURCE);
    }
}
