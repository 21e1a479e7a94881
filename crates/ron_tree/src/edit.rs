//! Replaces parts of a source text and leaves the rest unchanged.

use crate::diagnostic::Span;

/// An edit that overlaps another edit, or is not within the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the edit of bytes {} to {} overlaps another edit or is not within the text", .0.start, .0.end)]
pub struct EditOverlap(pub Span);

/// Replaces each span by its text. Comments and layout around the spans are unchanged.
///
/// The edits can be in any order. An edit with an empty span inserts its text; several insertions at the same offset
/// keep their order.
///
/// # Errors
///
/// Returns [`EditOverlap`] if two spans overlap, or a span is out of range or splits a character.
///
/// # Examples
///
/// ```
/// use ron_tree::Span;
/// use ron_tree::{parse, replace};
///
/// let source = "Loop(levels: 1 /* enough */)";
/// let levels = parse(source).value.field("levels").unwrap().span;
/// let edited = replace(source, vec![(levels, "2".to_owned())])?;
/// assert_eq!(edited, "Loop(levels: 2 /* enough */)");
/// # Ok::<(), ron_tree::EditOverlap>(())
/// ```
pub fn replace(source: &str, mut edits: Vec<(Span, String)>) -> Result<String, EditOverlap> {
    edits.sort_by_key(|(span, _)| *span);
    let added: usize = edits.iter().map(|(_, text)| text.len()).sum();
    let mut out = String::with_capacity(source.len() + added);
    let mut at = 0;
    for (span, text) in edits {
        let fits = at <= span.start && source.get(span.range()).is_some();
        if !fits {
            return Err(EditOverlap(span));
        }
        out += &source[at..span.start];
        out += &text;
        at = span.end;
    }
    out += &source[at..];
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edited(edits: &[(usize, usize, &str)]) -> Result<String, EditOverlap> {
        let edits = edits
            .iter()
            .map(|&(start, end, text)| (Span::new(start, end), text.to_owned()));
        replace("abcdef", edits.collect())
    }

    #[test]
    fn edits_can_be_in_any_order() {
        assert_eq!(
            edited(&[(4, 5, "E"), (0, 2, ""), (3, 3, "+"), (3, 3, "-")]).unwrap(),
            "c+-dEf"
        );
    }

    #[test]
    fn edits_that_overlap_are_refused() {
        assert_eq!(
            edited(&[(0, 3, "x"), (2, 4, "y")]),
            Err(EditOverlap(Span::new(2, 4)))
        );
        assert_eq!(edited(&[(5, 9, "x")]), Err(EditOverlap(Span::new(5, 9))));
    }
}
