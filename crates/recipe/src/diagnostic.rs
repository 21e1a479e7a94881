//! Renders diagnostics like a compiler, with excerpts of the text.
//!
//! ```text
//! error: `levels` is 9, expected at most 5
//!   ┌─ teapot.ron:7:31
//!   │
//! 7 │         LoopSubdivide(levels: 9),
//!   │                               ^
//!   │
//!   = help: allowed: 0 to 5
//! ```

use codespan_reporting::diagnostic as codespan;
use codespan_reporting::files::SimpleFiles;
use codespan_reporting::term::{self, termcolor};
use ron_tree::{Diagnostic, LineIndex, Severity, Span};
use std::borrow::Cow;
use std::fmt::Write as _;

use crate::source::Source;

/// Renders diagnostics in the order of the text, each with the lines of the text to which it refers.
///
/// `sources` are the texts to which the diagnostics refer: the recipe and the recipes that it calls. If `colours` is
/// set, the output contains ANSI color codes.
pub fn render(sources: &[Source], diagnostics: &[Diagnostic], colours: bool) -> String {
    let mut sorted: Vec<&Diagnostic> = diagnostics.iter().collect();
    sorted.sort_by_key(|d| (d.source, d.span, d.severity));

    let mut texts = SimpleFiles::new();
    let mut lines = Vec::new();
    for source in sources {
        let shown = source.path.display().to_string();
        texts.add(shown, without_control_characters(&source.text));
        lines.push(LineIndex::new(&source.text));
    }
    let config = term::Config::default();
    let mut out = String::new();
    for diagnostic in sorted {
        let (Some(source), Some(index)) =
            (sources.get(diagnostic.source), lines.get(diagnostic.source))
        else {
            out += &format!("{}: {}\n", diagnostic.severity.name(), diagnostic.message);
            continue;
        };
        let place = |(source, span): &(usize, Span)| {
            let (line, column) = lines.get(*source)?.position(span.start);
            let path = sources[*source].path.display();
            Some(format!("called from {path}:{line}:{column}"))
        };
        let mut notes: Vec<String> = diagnostic.calls.iter().filter_map(place).collect();
        notes.extend(diagnostic.help.iter().map(|help| format!("help: {help}")));
        let rendered = if has_long_line(diagnostic, index) {
            None
        } else {
            let report = to_codespan(diagnostic, &source.text).with_notes(notes.clone());
            if colours {
                let mut buffer = termcolor::Ansi::new(Vec::new());
                let written = term::emit_to_write_style(&mut buffer, &config, &texts, &report);
                written
                    .ok()
                    .and_then(|()| String::from_utf8(buffer.into_inner()).ok())
            } else {
                term::emit_into_string(&config, &texts, &report).ok()
            }
        };
        // If a line is too long to be shown, the diagnostic is shown without an excerpt.
        let path = source.path.display().to_string();
        out += &rendered.unwrap_or_else(|| in_short(&path, diagnostic, index, &notes));
    }
    out
}

/// The maximum length of a line that is shown, in bytes.
const MAX_LINE_LEN: usize = 1000;

fn has_long_line(diagnostic: &Diagnostic, lines: &LineIndex) -> bool {
    let places = diagnostic
        .span
        .iter()
        .chain(diagnostic.labels.iter().map(|(span, _)| span));
    places.into_iter().any(|span| {
        let (first, last) = (lines.position(span.start).0, lines.position(span.end).0);
        lines.line(first).len() > MAX_LINE_LEN || lines.line(last).len() > MAX_LINE_LEN
    })
}

fn in_short(path: &str, diagnostic: &Diagnostic, lines: &LineIndex, notes: &[String]) -> String {
    let mut out = diagnostic.short(path, lines) + "\n";
    for (span, text) in &diagnostic.labels {
        let (line, column) = lines.position(span.start);
        let _ = writeln!(out, "  {path}:{line}:{column}: {text}");
    }
    for note in notes {
        let _ = writeln!(out, "  = {note}");
    }
    out + "\n"
}

fn to_codespan(diagnostic: &Diagnostic, source: &str) -> codespan::Diagnostic<usize> {
    let file = diagnostic.source;
    let severity = match diagnostic.severity {
        Severity::Error => codespan::Severity::Error,
        Severity::Warning => codespan::Severity::Warning,
    };
    let fit = |span: Span| span.fitted(source);
    let primary = diagnostic
        .span
        .map(|span| codespan::Label::primary(file, fit(span)));
    let others = diagnostic
        .labels
        .iter()
        .map(|(span, text)| codespan::Label::secondary(file, fit(*span)).with_message(text));
    codespan::Diagnostic::new(severity)
        .with_message(&diagnostic.message)
        .with_labels(primary.into_iter().chain(others).collect())
}

/// Replaces control characters by `?`, so that the text cannot control the terminal. Byte offsets stay the same.
fn without_control_characters(source: &str) -> Cow<'_, str> {
    let is_control = |c: char| c.is_ascii_control() && !matches!(c, '\n' | '\r' | '\t');
    if source.contains(is_control) {
        Cow::Owned(source.replace(is_control, "?"))
    } else {
        Cow::Borrowed(source)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn render(path: &str, text: &str, diagnostics: &[Diagnostic], colours: bool) -> String {
        super::render(&[Source::new(path, text)], diagnostics, colours)
    }

    #[test]
    fn diagnostics_are_in_the_order_of_the_text() {
        let late = Diagnostic::error(Span::new(4, 5), "late");
        let early = Diagnostic::warning(Span::new(0, 1), "early");

        let text = render("x.ron", "a\nb\nc", &[late, early], false);

        assert!(
            text.find("warning: early") < text.find("error: late"),
            "{text}"
        );
        assert!(text.contains("x.ron:3:1"), "{text}");
    }

    #[test]
    fn the_line_the_caret_and_the_help_are_shown() {
        let source = "Loop(levels: 9)";
        let problem = Diagnostic::error(Span::new(13, 14), "too many").with_help("fewer");

        let text = render("x.ron", source, std::slice::from_ref(&problem), false);

        assert!(
            text.contains("1 │ Loop(levels: 9)\n  │              ^"),
            "{text}"
        );
        assert!(text.contains("= help: fewer"), "{text}");
        let coloured = render("x.ron", source, std::slice::from_ref(&problem), true);
        assert!(coloured.contains('\u{1b}') && !text.contains('\u{1b}'));
        assert_eq!(
            problem.short("x.ron", &LineIndex::new(source)),
            "x.ron:1:14: error: too many"
        );
    }

    #[test]
    fn an_error_in_a_called_recipe_shows_the_call() {
        let sources = [Source::new("a.ron", "x\n  y"), Source::new("b.ron", "z")];
        let problem = Diagnostic {
            source: 1,
            calls: vec![(0, Span::new(4, 5))],
            ..Diagnostic::error(Span::new(0, 1), "bad").with_help("mend it")
        };

        let text = super::render(&sources, &[problem], false);

        assert!(text.contains("b.ron:1:1"), "{text}");
        let notes = "  = called from a.ron:2:3\n  = help: mend it\n";
        assert!(text.contains(notes), "{text}");
    }

    #[test]
    fn a_span_outside_of_the_text_is_still_shown() {
        let problem = Diagnostic::error(Span::new(1, 99), "beyond");

        assert!(render("x.ron", "ä", &[problem], false).contains("x.ron:1:1"));
    }

    #[test]
    fn a_very_long_line_is_not_shown() {
        let source = "x".repeat(1_000_000);
        let problem = Diagnostic::error(Span::new(9, 10), "here").with_help("look");

        let text = render("x.ron", &source, &[problem], false);

        assert_eq!(text, "x.ron:1:10: error: here\n  = help: look\n\n");
    }

    #[test]
    fn control_characters_are_not_printed() {
        let problem = Diagnostic::error(Span::new(0, 1), "bad");

        assert!(!render("x.ron", "\u{1b}[2J", &[problem], false).contains('\u{1b}'));
    }
}
