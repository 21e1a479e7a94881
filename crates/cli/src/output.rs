//! Texts that several commands print.

use std::borrow::Cow;
use std::io::{self, IsTerminal, Write};
use std::path::Path;

use recipe::{LineIndex, Origin, Outcome, Recipe, Source, StepDone};

use engine::Loaded;
use serde::Serialize;
use store::{Disk, NewFile, Store, StoreError, folder_of};

/// What files say of where they come from.
pub(crate) const STAMP: &str = concat!("meshwright ", env!("CARGO_PKG_VERSION"));

/// Writes to the standard output. An error that a broken pipe causes is told apart by the caller.
pub(crate) fn print(text: &str) -> io::Result<()> {
    io::stdout().write_all(text.as_bytes())
}

/// Prints a report as JSON.
pub(crate) fn print_json(report: &impl Serialize) -> anyhow::Result<()> {
    Ok(print(&(serde_json::to_string_pretty(report)? + "\n"))?)
}

/// Writes to the standard error. If nobody reads that, there is nobody to tell.
pub(crate) fn complain(text: &str) {
    let _ = io::stderr().write_all(text.as_bytes());
}

/// Shows diagnostics on the standard error, as a compiler does.
pub(crate) fn show(loaded: &Loaded, diagnostics: &[recipe::Diagnostic]) {
    show_texts(&loaded.recipe.sources, diagnostics);
}

/// The same for texts of any kind.
pub(crate) fn show_texts(sources: &[Source], diagnostics: &[recipe::Diagnostic]) {
    const MOST: usize = 200;
    if !diagnostics.is_empty() {
        let colours = io::stderr().is_terminal();
        let shown = &diagnostics[..diagnostics.len().min(MOST)];
        complain(&recipe::render(sources, shown, colours));
        if diagnostics.len() > MOST {
            complain(&format!("and {} more\n", diagnostics.len() - MOST));
        }
    }
}

/// The steps as a table: counts after each, and its time.
pub(crate) fn step_table(steps: &[StepDone]) -> String {
    let mut rows = vec![heads(["step", "vertices", "edges", "faces", "time"])];
    for (i, step) in steps.iter().enumerate() {
        let count = |n| grouped(n as u64);
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

/// What the steps report: refused edits, losses, notes.
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

/// The first row of a table.
pub(crate) fn heads<const N: usize>(heads: [&str; N]) -> Vec<String> {
    heads.map(str::to_owned).to_vec()
}

/// Rows in columns: the first to the left, the others to the right.
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

/// So many of something, whose word for several ends in s.
pub(crate) fn counted(n: usize, what: &str) -> String {
    let s = if n == 1 { "" } else { "s" };
    format!("{n} {what}{s}")
}

/// A number with its digits in groups of three.
pub(crate) fn grouped(n: u64) -> String {
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

/// Where the value of each parameter comes from: of the recipe, and of those that it calls.
pub(crate) fn explain(recipe: &Recipe) -> String {
    let mut rows = vec![heads(["parameter", "value", "from"])];
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
    let order = "(--set goes before a preset, and a preset before the recipe's default)";
    format!("{}{order}\n\n", table(&rows))
}

/// For each step whether it was in the cache, or why it ran; and what was not stored.
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

/// Where a value comes from, in words.
pub(crate) fn origin(origin: &Origin) -> String {
    match origin {
        Origin::Default => "the recipe's default".to_owned(),
        Origin::Preset(name) => format!("the preset {name}"),
        Origin::Call => "the call".to_owned(),
        Origin::Set => "--set".to_owned(),
    }
}

/// A diagnostic as JSON.
#[derive(Serialize)]
pub(crate) struct ProblemJson {
    severity: &'static str,
    file: Option<String>,
    line: Option<usize>,
    column: Option<usize>,
    message: String,
    help: Option<String>,
}

/// Diagnostics as JSON.
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

/// A text that stays on its line and cannot steer the terminal.
pub(crate) fn shown(text: &str) -> Cow<'_, str> {
    if !text.contains(char::is_control) {
        return Cow::Borrowed(text);
    }
    let escaped = |c: char| {
        let control = c.is_control().then(|| c.escape_default().collect());
        control.unwrap_or_else(|| c.to_string())
    };
    Cow::Owned(text.chars().map(escaped).collect())
}

/// A text as one word of a shell.
pub(crate) fn quoted(text: &str) -> Cow<'_, str> {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./=:,+%@".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
        Cow::Borrowed(text)
    } else {
        Cow::Owned(format!("'{}'", text.replace('\'', "'\\''")))
    }
}

/// Writes a file whole or not at all. Folders around it are made.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    Ok(begin(path, bytes)?.commit()?)
}

/// Writes a file beside its place. Folders around it are made.
pub(crate) fn begin(path: &Path, bytes: &[u8]) -> Result<Box<dyn NewFile>, StoreError> {
    let begin = || -> io::Result<Box<dyn NewFile>> {
        Disk.make_folder(folder_of(path))?;
        let mut file = Disk.create(path)?;
        file.write_all(bytes)?;
        // A full disk may only be told here.
        file.sync()?;
        Ok(file)
    };
    begin().map_err(|error| StoreError::new("write", path, error))
}
