//! Places in a text, and problems with them.

use std::ops::Range;

/// One problem of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Whether the text can be used in spite of it.
    pub severity: Severity,
    /// What is wrong, in one line: lower case, no full stop.
    pub message: String,
    /// The text that the places are in: its index in a list of texts that the reader keeps, 0 for the first.
    pub source: usize,
    /// The place, if the problem has one.
    pub span: Option<Span>,
    /// Other places that matter, each with a few words on why.
    pub labels: Vec<(Span, String)>,
    /// What to do about it.
    pub help: Option<String>,
    /// The calls that led to the text, the last one first: their texts and places.
    pub calls: Vec<(usize, Span)>,
}

impl Diagnostic {
    /// An error at `span`.
    pub fn error(span: Span, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Error,
            message: message.into(),
            source: 0,
            span: Some(span),
            labels: Vec::new(),
            help: None,
            calls: Vec::new(),
        }
    }

    /// A warning at `span`.
    pub fn warning(span: Span, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Warning,
            ..Self::error(span, message)
        }
    }

    /// An error that belongs to no place in the text.
    pub fn without_place(message: impl Into<String>) -> Self {
        Self {
            span: None,
            ..Self::error(Span::default(), message)
        }
    }

    /// The same, with a second place.
    #[must_use]
    pub fn with_label(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push((span, text.into()));
        self
    }

    /// The same, with advice.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Whether the text is refused because of it.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }

    /// The diagnostic in one line, `file:line:column: error: message`.
    ///
    /// `lines` is the index of the text that the spans point into.
    pub fn short(&self, path: &str, lines: &LineIndex) -> String {
        let severity = self.severity.name();
        let message = &self.message;
        match self.span {
            None => format!("{path}: {severity}: {message}"),
            Some(span) => {
                let (line, column) = lines.position(span.start);
                format!("{path}:{line}:{column}: {severity}: {message}")
            }
        }
    }
}

/// How bad a problem is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The text is refused.
    Error,
    /// The text is accepted, and somebody should look at it.
    Warning,
}

impl Severity {
    /// `error` or `warning`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
        }
    }
}

/// A range of bytes in a text; `end` is not part of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Span {
    /// The first byte.
    pub start: usize,
    /// The byte after the last one.
    pub end: usize,
}

impl Span {
    /// The bytes from `start` up to `end`.
    pub fn new(start: usize, end: usize) -> Self {
        Self { start, end }
    }

    /// The number of bytes.
    pub fn len(self) -> usize {
        self.end.saturating_sub(self.start)
    }

    /// Whether no byte lies in it.
    pub fn is_empty(self) -> bool {
        self.end <= self.start
    }

    /// From the start of this span to the end of `other`.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self::new(self.start, other.end)
    }

    /// Whether `other` lies within this span.
    pub fn contains(self, other: Self) -> bool {
        self.start <= other.start && other.end <= self.end
    }

    /// The part of `source` that the span covers; empty if it does not fit the text.
    pub fn of(self, source: &str) -> &str {
        source.get(self.range()).unwrap_or("")
    }

    /// The span as a range.
    pub fn range(self) -> Range<usize> {
        self.start..self.end
    }

    /// The span as a range that lies in `source` and splits no character.
    pub fn fitted(self, source: &str) -> Range<usize> {
        let start = char_start(source, self.start);
        start..char_start(source, self.end).max(start)
    }
}

/// Finds lines and columns in a text.
#[derive(Clone, Debug)]
pub struct LineIndex<'s> {
    source: &'s str,
    /// The byte at which each line starts.
    starts: Vec<usize>,
}

impl<'s> LineIndex<'s> {
    /// Indexes `source`; a line ends after its line feed.
    pub fn new(source: &'s str) -> Self {
        let after_feeds = source
            .bytes()
            .enumerate()
            .filter(|&(_, b)| b == b'\n')
            .map(|(i, _)| i + 1);
        Self {
            source,
            starts: std::iter::once(0).chain(after_feeds).collect(),
        }
    }

    /// Line and column of the byte at `offset`, both from 1; columns count characters.
    ///
    /// An offset behind the end of the text, or inside a character, gives the place before it.
    pub fn position(&self, offset: usize) -> (usize, usize) {
        let offset = char_start(self.source, offset);
        let line = self.starts.partition_point(|&start| start <= offset);
        let start = self.starts[line - 1];
        (line, self.source[start..offset].chars().count() + 1)
    }

    /// The text of a line counted from 1, with its line feed; empty if there is no such line.
    pub fn line(&self, line: usize) -> &'s str {
        let Some(&start) = self.starts.get(line - 1) else {
            return "";
        };
        let end = self.starts.get(line).copied().unwrap_or(self.source.len());
        &self.source[start..end]
    }
}

/// The start of the character at `offset`, or the end of the text.
fn char_start(source: &str, offset: usize) -> usize {
    let mut offset = offset.min(source.len());
    while !source.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters() {
        let lines = LineIndex::new("a\näö x\n");

        assert_eq!(lines.position(0), (1, 1));
        assert_eq!(lines.position(7), (2, 4));
        assert_eq!(lines.position(99), (3, 1));
    }
}
