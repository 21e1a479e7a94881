//! Output that several commands share: tables, diagnostics, JSON and files.

use std::borrow::Cow;
use std::io::{self, IsTerminal, Write};
use std::path::Path;

use mesh::DVec3;
use recipe::{Origin, Outcome, Recipe, RecipeStep, Source, StepDone};
use ron_tree::{Value, ValueKind};

use engine::Loaded;
pub(crate) use op::readable as number;
use serde::Serialize;
use store::{Disk, NewFile, Store, StoreError, folder_of};

/// The name and the version of the program, as they are recorded in output files.
pub(crate) const STAMP: &str = concat!("meshwright ", env!("CARGO_PKG_VERSION"));

/// Writes to standard output. A broken pipe is returned as an error. The caller decides how to handle a broken pipe.
pub(crate) fn print(text: &str) -> io::Result<()> {
    io::stdout().write_all(text.as_bytes())
}

/// Prints a report as JSON.
pub(crate) fn print_json(report: &impl Serialize) -> anyhow::Result<()> {
    Ok(print(&(serde_json::to_string_pretty(report)? + "\n"))?)
}

/// Writes to standard error. An error while writing is ignored, because it could not be reported.
pub(crate) fn print_error(text: &str) {
    let _ = io::stderr().write_all(text.as_bytes());
}

/// Prints diagnostics to standard error, with source lines, as a compiler does.
pub(crate) fn print_diagnostics(loaded: &Loaded, diagnostics: &[recipe::Diagnostic]) {
    print_diagnostics_in(&loaded.recipe.sources, diagnostics);
}

/// Like [`print_diagnostics`], but the source texts are given as an argument.
pub(crate) fn print_diagnostics_in(sources: &[Source], diagnostics: &[recipe::Diagnostic]) {
    const MAX_SHOWN: usize = 200;
    if !diagnostics.is_empty() {
        let colours = has_colors(io::stderr().is_terminal());
        let shown = &diagnostics[..diagnostics.len().min(MAX_SHOWN)];
        print_error(&recipe::render(sources, shown, colours));
        if diagnostics.len() > MAX_SHOWN {
            print_error(&format!("and {} more\n", diagnostics.len() - MAX_SHOWN));
        }
    }
}

/// Whether the output has colors. Output to a terminal has colors, unless `NO_COLOR` is set or the terminal is `dumb`.
fn has_colors(is_terminal: bool) -> bool {
    let variable = |name| std::env::var_os(name).unwrap_or_default();
    is_terminal && variable("NO_COLOR").is_empty() && variable("TERM") != "dumb"
}

/// Returns a table with a row for each step: the element counts after the step, the time of the step, and a summary of
/// its work.
pub(crate) fn step_table(recipe: &Recipe, outcome: &Outcome) -> String {
    let mut rows = vec![header_row([
        "step", "vertices", "edges", "faces", "time", "",
    ])];
    let steps = recipe.steps.iter().skip(outcome.first);
    for (i, (step, done)) in steps.zip(&outcome.steps).enumerate() {
        let count = |n| group_digits(n as u64);
        let time = match done.ran {
            Some(_) => format!("{:.1} ms", done.time.as_secs_f64() * 1e3),
            None => "cached".to_owned(),
        };
        let mut row = vec![format!("{:>2} {}", i + 1, done.label)];
        row.extend([done.vertices, done.edges, done.faces].map(count));
        row.extend([time, summary(step, done)]);
        rows.push(row);
    }
    text_table(&rows)
}

/// Returns the summary of a step: the file that it reads or writes, the number of elements that it changed, and the
/// number of refused edits.
fn summary(step: &RecipeStep, done: &StepDone) -> String {
    let mut parts = Vec::new();
    let parameters = match &step.value.kind {
        ValueKind::Call(call) => call.body.field("path"),
        _ => None,
    };
    if let Some(path) = parameters.and_then(Value::as_str) {
        let name = Path::new(path).file_name().unwrap_or_default();
        parts.push(escape_control(&name.to_string_lossy()).into_owned());
    }
    let verb = step.step.as_ref().map_or("", |step| step.done());
    let changed = done.report.changed;
    if !verb.is_empty() && done.refused.is_none() {
        parts.push(format!("{} {verb}", group_digits(changed)));
    }
    let refused: u64 = done
        .report
        .refused
        .iter()
        .map(|refused| refused.count)
        .sum();
    if refused > 0 {
        parts.push(format!("{} refused", group_digits(refused)));
    }
    parts.join(", ")
}

/// Returns the reports of the steps, with one item on each line. The items are refused edits, losses (data that a step
/// did not keep), repairs of input files, and notes.
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
        for change in &step.report.changes {
            text += &format!("{label}: {}\n", change.message);
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

/// Aligns rows in columns. The first column is aligned to the left, and all other columns are aligned to the right. If
/// the output is a terminal and the table is wider than the terminal, cells are shortened.
pub(crate) fn table(rows: &[Vec<String>]) -> String {
    table_within(rows, terminal_width(), false)
}

/// Like [`table`], but the last column is also aligned to the left.
fn text_table(rows: &[Vec<String>]) -> String {
    table_within(rows, terminal_width(), true)
}

/// If standard output is a terminal, returns the width of the terminal in characters.
fn terminal_width() -> Option<usize> {
    let is_terminal = io::stdout().is_terminal();
    let size = is_terminal.then(|| console::Term::stdout().size_checked())?;
    size.map(|(_, columns)| usize::from(columns))
        .filter(|&columns| columns > 0)
}

/// Aligns rows in columns. If the table is wider than `limit`, the column titles are shortened first. If this is not
/// enough and the last column contains text, the last column is shortened. If the table is still too wide, the first
/// column is shortened. Numbers are never shortened. If the numbers still do not fit, each row of the table continues
/// on further lines, which are indented.
fn table_within(rows: &[Vec<String>], limit: Option<usize>, last_is_text: bool) -> String {
    /// The minimum length of a shortened name, in characters.
    const MIN: usize = 8;
    const INDENT: usize = 4;
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |rows: &[Vec<String>], c: usize| {
        let cells = rows.iter().filter_map(|row| row.get(c));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let mut widths: Vec<usize> = (0..columns).map(|c| width(rows, c)).collect();
    let is_text = |c: usize| c == 0 || (last_is_text && c + 1 == columns);
    if let Some(limit) = limit {
        let total = widths.iter().sum::<usize>() + 2 * columns.saturating_sub(1);
        let mut excess = total.saturating_sub(limit);
        let below = rows.get(1..).unwrap_or_default();
        let contents: Vec<usize> = (0..columns).map(|c| width(below, c).max(MIN)).collect();
        let mut shorten = |c: usize, least: usize| {
            let cut = excess.min(widths[c].saturating_sub(least));
            widths[c] -= cut;
            excess -= cut;
        };
        (0..columns).for_each(|c| shorten(c, contents[c]));
        (0..columns)
            .rev()
            .filter(|&c| is_text(c))
            .for_each(|c| shorten(c, MIN));
    }
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        let mut length = 0;
        for (c, cell) in row.iter().enumerate() {
            let cell = shortened(cell, widths[c]);
            if c > 0 && limit.is_some_and(|limit| length + 2 + widths[c] > limit) {
                text += line.trim_end();
                text.push('\n');
                line = " ".repeat(INDENT);
                length = INDENT;
            } else if c > 0 {
                line += "  ";
                length += 2;
            }
            line += &if is_text(c) {
                format!("{cell:<0$}", widths[c])
            } else {
                format!("{cell:>0$}", widths[c])
            };
            length += widths[c];
        }
        if !line.trim().is_empty() || row.is_empty() {
            text += line.trim_end();
            text.push('\n');
        }
    }
    text
}

/// Shortens a string to at most `most` characters. If characters are removed, the last character is an ellipsis.
fn shortened(text: &str, most: usize) -> Cow<'_, str> {
    if text.chars().count() <= most {
        return Cow::Borrowed(text);
    }
    let start: String = text.chars().take(most.saturating_sub(1)).collect();
    Cow::Owned(start + "…")
}

/// Formats the coordinates of a point with six significant digits, such as `[0.5, 1, 2.33333]`.
pub(crate) fn point(p: DVec3) -> String {
    format!("[{}, {}, {}]", number(p.x), number(p.y), number(p.z))
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

/// Returns the text that `--explain` prints. A table shows where the value of each parameter comes from, for the recipe
/// and the recipes that it calls. After the table, the text lists the steps that have a field `note`.
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
    format!("{}{order}\n\n{}", table(&rows), explain_notes(recipe))
}

/// Lists the steps that have a note.
fn explain_notes(recipe: &Recipe) -> String {
    let mut text = String::new();
    for (i, step) in recipe.steps.iter().enumerate() {
        if let Some(note) = &step.note {
            text += &format!("{} {}: {}\n", i + 1, step.label, escape_control(note));
        }
    }
    if text.is_empty() { text } else { text + "\n" }
}

/// Lists the steps. For each step, the list says either that its result was cached, or why the step ran. After the
/// list, the text names each result that could not be stored in the cache or loaded from the cache.
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

/// Returns a text that says where the value of a parameter comes from.
pub(crate) fn origin(origin: &Origin) -> String {
    match origin {
        Origin::Default => "the recipe's default".to_owned(),
        Origin::Preset(name) => format!("the preset {name}"),
        Origin::Call => "the call".to_owned(),
        Origin::Set => "--set".to_owned(),
    }
}

/// Escapes control characters, so that a string stays on one line and cannot control the terminal.
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

/// Quotes a string, if necessary, so that a shell reads it as one word.
pub(crate) fn shell_quoted(text: &str) -> Cow<'_, str> {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./=:,+%@".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
        Cow::Borrowed(text)
    } else {
        Cow::Owned(format!("'{}'", text.replace('\'', "'\\''")))
    }
}

/// Writes a file either completely or not at all. Creates missing parent folders.
pub(crate) fn write_atomically(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    Ok(write_temporary(path, bytes)?.commit()?)
}

/// Writes a temporary file in the folder of `path`. When the caller commits the returned file, it is moved to `path`.
/// Creates missing parent folders.
pub(crate) fn write_temporary(path: &Path, bytes: &[u8]) -> Result<Box<dyn NewFile>, StoreError> {
    let write = || -> io::Result<Box<dyn NewFile>> {
        Disk.make_folder(folder_of(path))?;
        let mut file = Disk.create(path)?;
        file.write_all(bytes)?;
        // Some file systems report a full disk only when a file is synced.
        file.sync()?;
        Ok(file)
    };
    write().map_err(|error| StoreError::new("write", path, error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_for_people_have_six_significant_digits() {
        for (x, text) in [
            (0.0, "0"),
            (-0.0, "-0"),
            (24.0, "24"),
            (1.0 / 3.0, "0.333333"),
            (23.999_999_99, "24"),
            (0.1 + 0.2, "0.3"),
            (-1_234.567_89, "-1234.57"),
            (4_512_345.678, "4512346"),
            (1.0e-5, "0.00001"),
            (1.234_567_89e-12, "1.23457e-12"),
            (1.0e300, "1e300"),
            (f64::INFINITY, "too large"),
            (f64::NAN, "too large"),
        ] {
            assert_eq!(number(x), text);
        }
    }

    #[test]
    fn every_number_for_people_is_close_to_the_number() {
        let mut x = 1.7e-30;
        while x < 1e30 {
            for x in [x, -x] {
                let shown: f64 = number(x).parse().unwrap();
                assert!(
                    (shown - x).abs() <= x.abs() * 5.1e-6,
                    "{x} is shown as {shown}"
                );
            }
            x *= 1.37;
        }
    }

    #[test]
    fn a_table_fits_the_terminal_without_shortening_numbers() {
        let row = |cells: [&str; 3]| cells.map(str::to_owned).to_vec();
        let rows = [
            row(["cell", "DistanceTo(other: File(\"a.obj\"))", "error"]),
            row(["a very long name of an object", "123456789012", "no"]),
        ];
        let whole = table_within(&rows, None, false);
        assert!(whole.contains("File") && whole.contains("an object"));
        let short = table_within(&rows, Some(40), false);
        assert!(
            short.lines().all(|line| line.chars().count() <= 40),
            "{short}"
        );
        assert!(
            short.contains("123456789012") && short.contains('…'),
            "{short}"
        );
        // Numbers that do not fit into a line are printed on the next lines.
        let wrapped = table_within(&rows, Some(16), true);
        assert!(wrapped.contains("123456789012"), "{wrapped}");
        let is_short = |line: &str| line.chars().count() <= 16;
        assert!(wrapped.lines().all(is_short), "{wrapped}");
    }
}
