//! Replaces parts of a text and leaves the rest as it is.

use crate::diagnostic::Span;

/// Two edits of one text that cannot both be done, or one that lies outside of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected edits that lie apart in the text, found bytes {} to {} twice or outside", .0.start, .0.end)]
pub struct EditOverlap(pub Span);

/// Puts each text in place of its span; comments and layout around them stay.
///
/// The edits come in any order. An empty span inserts; several insertions at one place come in
/// the order given.
///
/// # Errors
///
/// [`EditOverlap`] if two spans overlap, or one does not fit the text.
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
    fn edits_come_in_any_order() {
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
