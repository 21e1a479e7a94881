//! Diagnostics (errors and warnings) and the spans of text that they refer to.

use std::ops::Range;

/// An error or a warning about a source text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Whether the diagnostic is an error or a warning.
    pub severity: Severity,
    /// The message: one line that starts in lower case and has no final period.
    pub message: String,
    /// The index of the source text that the spans refer to, in the list of all source texts. The index 0 is the first
    /// text.
    pub source: usize,
    /// The span that the message is about, if it is about a part of the text.
    pub span: Option<Span>,
    /// Other relevant spans, each with a short explanation.
    pub labels: Vec<(Span, String)>,
    /// How to correct the text.
    pub help: Option<String>,
    /// If other source texts called this text: the chain of these calls, innermost first. Each entry has the index of
    /// the text that contains the call, and the span of the call in that text.
    pub calls: Vec<(usize, Span)>,
}

impl Diagnostic {
    /// Creates an error at `span`.
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

    /// Creates a warning at `span`.
    pub fn warning(span: Span, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Warning,
            ..Self::error(span, message)
        }
    }

    /// Creates an error that is not about a part of the text.
    pub fn without_place(message: impl Into<String>) -> Self {
        Self {
            span: None,
            ..Self::error(Span::default(), message)
        }
    }

    /// Adds a label: another relevant span with a short explanation.
    #[must_use]
    pub fn with_label(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push((span, text.into()));
        self
    }

    /// Sets the help text.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Whether this is an error.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }

    /// Returns the diagnostic in one line: `file:line:column: error: message`.
    ///
    /// `lines` is the line index of the text that the spans refer to.
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

/// The severity of a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The text cannot be used.
    Error,
    /// The text can be used, but is probably not as intended.
    Warning,
}

impl Severity {
    /// Returns `error` or `warning`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
        }
    }
}

/// A range of bytes in a source text. `end` is exclusive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Span {
    /// The first byte.
    pub start: usize,
    /// The byte after the last byte.
    pub end: usize,
}

impl Span {
    /// Creates the span from `start` up to, but not including, `end`.
    pub fn new(start: usize, end: usize) -> Self {
        Self { start, end }
    }

    /// Returns the number of bytes.
    pub fn len(self) -> usize {
        self.end.saturating_sub(self.start)
    }

    /// Whether the span has no bytes.
    pub fn is_empty(self) -> bool {
        self.end <= self.start
    }

    /// Returns the span from the start of this span to the end of `other`.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self::new(self.start, other.end)
    }

    /// Whether `other` is within this span.
    pub fn contains(self, other: Self) -> bool {
        self.start <= other.start && other.end <= self.end
    }

    /// Returns the part of `source` that the span covers. The result is empty if the span is out of range or splits a
    /// character.
    pub fn of(self, source: &str) -> &str {
        source.get(self.range()).unwrap_or("")
    }

    /// Returns the span as a range.
    pub fn range(self) -> Range<usize> {
        self.start..self.end
    }

    /// Returns the span as a range that does not split a character of `source`. A bound inside a character is moved
    /// to the start of that character. A bound beyond the text is moved to the end of the text.
    pub fn fitted(self, source: &str) -> Range<usize> {
        let start = char_start(source, self.start);
        start..char_start(source, self.end).max(start)
    }
}

/// Finds lines and columns in a source text.
#[derive(Clone, Debug)]
pub struct LineIndex<'s> {
    source: &'s str,
    /// The offset of the first byte of each line.
    starts: Vec<usize>,
}

impl<'s> LineIndex<'s> {
    /// Indexes `source`. A line ends after its line feed.
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

    /// Returns the line and the column of the byte at `offset`, both counted from 1. Columns count characters.
    ///
    /// An offset beyond the end of the text counts as the end of the text. An offset inside a character counts as the
    /// start of that character.
    pub fn position(&self, offset: usize) -> (usize, usize) {
        let offset = char_start(self.source, offset);
        let line = self.starts.partition_point(|&start| start <= offset);
        let start = self.starts[line - 1];
        (line, self.source[start..offset].chars().count() + 1)
    }

    /// Returns the text of a line (counted from 1) with its line feed. The result is empty if the line does not exist.
    pub fn line(&self, line: usize) -> &'s str {
        let Some(&start) = self.starts.get(line - 1) else {
            return "";
        };
        let end = self.starts.get(line).copied().unwrap_or(self.source.len());
        &self.source[start..end]
    }
}

/// Returns the start of the character that contains the byte at `offset`, or the end of the text if `offset` is beyond
/// the end.
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
