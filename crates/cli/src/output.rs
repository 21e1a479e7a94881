//! Output that several commands share: tables, diagnostics, JSON and files.

use std::borrow::Cow;
use std::io::{self, IsTerminal, Write};
use std::path::Path;

use recipe::{LineIndex, Origin, Outcome, Recipe, Source, StepDone};

use engine::Loaded;
use serde::Serialize;
use store::{Disk, NewFile, Store, StoreError, folder_of};

/// The program and its version, as written to files.
pub(crate) const STAMP: &str = concat!("meshwright ", env!("CARGO_PKG_VERSION"));

/// Writes to standard output. The caller decides whether a broken pipe is an error.
pub(crate) fn print(text: &str) -> io::Result<()> {
    io::stdout().write_all(text.as_bytes())
}

/// Prints a report as JSON.
pub(crate) fn print_json(report: &impl Serialize) -> anyhow::Result<()> {
    Ok(print(&(serde_json::to_string_pretty(report)? + "\n"))?)
}

/// Writes to standard error. Write errors are ignored, since they could not be reported.
pub(crate) fn print_error(text: &str) {
    let _ = io::stderr().write_all(text.as_bytes());
}

/// Prints diagnostics to standard error, with source lines, as a compiler does.
pub(crate) fn print_diagnostics(loaded: &Loaded, diagnostics: &[recipe::Diagnostic]) {
    print_diagnostics_in(&loaded.recipe.sources, diagnostics);
}

/// Like [`print_diagnostics`], for diagnostics in any sources.
pub(crate) fn print_diagnostics_in(sources: &[Source], diagnostics: &[recipe::Diagnostic]) {
    const MAX_SHOWN: usize = 200;
    if !diagnostics.is_empty() {
        let colours = io::stderr().is_terminal();
        let shown = &diagnostics[..diagnostics.len().min(MAX_SHOWN)];
        print_error(&recipe::render(sources, shown, colours));
        if diagnostics.len() > MAX_SHOWN {
            print_error(&format!("and {} more\n", diagnostics.len() - MAX_SHOWN));
        }
    }
}

/// Returns a table of the steps, with the element counts after each step and its time.
pub(crate) fn step_table(steps: &[StepDone]) -> String {
    let mut rows = vec![header_row(["step", "vertices", "edges", "faces", "time"])];
    for (i, step) in steps.iter().enumerate() {
        let count = |n| group_digits(n as u64);
        let time = match step.ran {
            Some(_) => format!("{:.1} ms", step.time.as_secs_f64() * 1e3),
            None => "cached".to_owned(),
        };
        let mut row = vec![format!("{:>2} {}", i + 1, step.label)];
        row.extend([step.vertices, step.edges, step.faces].map(count));
        row.push(time);
        rows.push(row);
    }
    table(&rows)
}

/// Returns what the steps report, one item per line: refused edits, losses and notes.
pub(crate) fn step_notes(steps: &[StepDone]) -> String {
    let mut text = String::new();
    for step in steps {
        let label = &step.label;
        for refused in &step.report.refused {
            let (n, reason, first) = (refused.count, refused.reason, &refused.first);
            text += &format!("{label}: {n} refused, {reason:?} (first: {first})\n");
        }
        for loss in &step.report.losses {
            text += &format!("{label}: {loss}\n");
        }
        for note in &step.report.notes {
            text += &format!("{label}: {note}\n");
        }
    }
    text
}

/// Returns the header row of a table.
pub(crate) fn header_row<const N: usize>(titles: [&str; N]) -> Vec<String> {
    titles.map(str::to_owned).to_vec()
}

/// Aligns rows in columns: the first column to the left, all others to the right.
pub(crate) fn table(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |c: usize| {
        let cells = rows.iter().filter_map(|row| row.get(c));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (c, cell) in row.iter().enumerate() {
            if c == 0 {
                line += &format!("{cell:<0$}", widths[0]);
            } else {
                line += &format!("  {cell:>0$}", widths[c]);
            }
        }
        text += line.trim_end();
        text.push('\n');
    }
    text
}

/// Formats a number with its digits in groups of three, separated by spaces.
pub(crate) fn group_digits(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// Returns a table with the origin of each parameter value, for the recipe and the recipes it calls.
pub(crate) fn explain(recipe: &Recipe) -> String {
    let mut rows = vec![header_row(["parameter", "value", "from"])];
    for scope in &recipe.scopes {
        let path = recipe.sources[scope.source].path.display();
        for parameter in &scope.parameters {
            let name = match scope.called {
                None => parameter.name.clone(),
                Some(_) => format!("{path}: {}", parameter.name),
            };
            let (value, from) = (parameter.value.to_string(), origin(&parameter.origin));
            rows.push(vec![name, value, from]);
        }
    }
    let order = "(--set overrides presets; presets override the recipe's defaults)";
    format!("{}{order}\n\n", table(&rows))
}

/// Lists for each step that it was cached or why it ran, and then the notes of the cache.
pub(crate) fn explain_steps(outcome: &Outcome) -> String {
    let mut text = String::new();
    for (i, step) in outcome.steps.iter().enumerate() {
        let (number, label) = (i + 1, &step.label);
        text += &match &step.ran {
            None => format!("{number} {label}: cached\n"),
            Some(why) => format!("{number} {label}: ran because {why}\n"),
        };
    }
    for note in &outcome.cache_notes {
        text += &format!("{note}\n");
    }
    text
}

/// Describes the origin of a parameter value.
pub(crate) fn origin(origin: &Origin) -> String {
    match origin {
        Origin::Default => "the recipe's default".to_owned(),
        Origin::Preset(name) => format!("the preset {name}"),
        Origin::Call => "the call".to_owned(),
        Origin::Set => "--set".to_owned(),
    }
}

/// Converts losses for serialization as JSON.
pub(crate) fn losses_json(losses: &[op::Loss]) -> Vec<serde_json::Value> {
    let json = |l: &op::Loss| serde_json::json!({ "object": l.object, "name": l.name, "message": l.to_string() });
    losses.iter().map(json).collect()
}

/// A diagnostic, for serialization as JSON.
#[derive(Serialize)]
pub(crate) struct ProblemJson {
    severity: &'static str,
    file: Option<String>,
    line: Option<usize>,
    column: Option<usize>,
    message: String,
    help: Option<String>,
}

/// Converts diagnostics for serialization as JSON.
pub(crate) fn problems_json(
    diagnostics: &[recipe::Diagnostic],
    sources: &[Source],
) -> Vec<ProblemJson> {
    let lines: Vec<LineIndex> = sources.iter().map(|s| LineIndex::new(&s.text)).collect();
    let problem = |d: &recipe::Diagnostic| {
        let place = d
            .span
            .and_then(|span| Some(lines.get(d.source)?.position(span.start)));
        ProblemJson {
            severity: d.severity.name(),
            file: sources.get(d.source).map(|s| s.path.display().to_string()),
            line: place.map(|p| p.0),
            column: place.map(|p| p.1),
            message: d.message.clone(),
            help: d.help.clone(),
        }
    };
    diagnostics.iter().map(problem).collect()
}

/// Escapes control characters, so that a text stays on one line and cannot control the terminal.
pub(crate) fn escape_control(text: &str) -> Cow<'_, str> {
    if !text.contains(char::is_control) {
        return Cow::Borrowed(text);
    }
    let escaped = |c: char| {
        let control = c.is_control().then(|| c.escape_default().collect());
        control.unwrap_or_else(|| c.to_string())
    };
    Cow::Owned(text.chars().map(escaped).collect())
}

/// Quotes a text, if necessary, so that a shell reads it as one word.
pub(crate) fn shell_quoted(text: &str) -> Cow<'_, str> {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./=:,+%@".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
        Cow::Borrowed(text)
    } else {
        Cow::Owned(format!("'{}'", text.replace('\'', "'\\''")))
    }
}

/// Writes a file completely or not at all. Creates missing parent folders.
pub(crate) fn write_atomically(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    Ok(write_temporary(path, bytes)?.commit()?)
}

/// Writes a temporary file beside `path`; committing it moves it to `path`. Creates missing parent folders.
pub(crate) fn write_temporary(path: &Path, bytes: &[u8]) -> Result<Box<dyn NewFile>, StoreError> {
    let write = || -> io::Result<Box<dyn NewFile>> {
        Disk.make_folder(folder_of(path))?;
        let mut file = Disk.create(path)?;
        file.write_all(bytes)?;
        // Some file systems report a full disk only when syncing.
        file.sync()?;
        Ok(file)
    };
    write().map_err(|error| StoreError::new("write", path, error))
}
