//! Writes a file for each failed input: the full error messages, and the command that repeats the run.

use std::path::{Path, PathBuf};

use super::inputs::Input;
use super::plan::Batch;
use super::row::Row;
use crate::output::{shell_quoted, write_atomically};

/// Returns the folder for the files that describe failures.
pub(super) fn folder(out: &Path) -> PathBuf {
    out.join("failed")
}

/// Returns the path of the file for one failure. The name of this file begins with the name of the input file. This
/// part is shortened, and characters that some file systems do not allow are replaced. The digest at the end
/// distinguishes input files that have the same name.
fn path(batch: &Batch, file: &Input) -> PathBuf {
    let name = file.relative.file_name().unwrap_or("set".as_ref());
    let mut name = name.to_string_lossy().into_owned();
    if let Some(set) = &file.set {
        name += &format!("-{}", set.number);
    }
    let is_safe = |c: char| c.is_alphanumeric() || matches!(c, '.' | '-' | '_');
    let sanitize = |c: char| if is_safe(c) { c } else { '_' };
    let name: String = name.chars().map(sanitize).take(50).collect();
    let digest = file.digest().to_hex();
    folder(&batch.args.out).join(format!("{name}-{}.txt", &digest[..8]))
}

/// Writes the file that describes the failure of an input file. `text` has the full error messages.
pub(super) fn write(batch: &Batch, file: &Input, row: &Row, text: &str) -> anyhow::Result<()> {
    let step = row.step.as_ref().map(|s| format!(" at {s}"));
    let step = step.unwrap_or_default();
    let command = command(batch, file);
    let folder = std::env::current_dir().unwrap_or_default();
    let text = format!(
        "{} failed{step}\n\n{text}\nTo repeat the run, use this command in the folder {}:\n\n{command}\n",
        file.label(),
        folder.display()
    );
    write_atomically(&path(batch, file), text.as_bytes())
}

/// Returns the text that was written for the failure of an input file.
pub(super) fn read(batch: &Batch, file: &Input) -> std::io::Result<String> {
    std::fs::read_to_string(path(batch, file))
}

/// Removes the file that describes an earlier failure of the input file, if there is one.
pub(super) fn remove(batch: &Batch, file: &Input) {
    // The error is ignored, because usually the file does not exist.
    let _ = std::fs::remove_file(path(batch, file));
}

/// Returns the command that runs the recipe on this input file alone.
fn command(batch: &Batch, file: &Input) -> String {
    let values = &batch.args.values;
    let recipe = batch.path.display().to_string();
    let mut words = vec!["meshwright".to_owned(), "run".to_owned(), recipe];
    let mut option = |name: &str, value: String| words.extend([name.to_owned(), value]);
    if let Some(preset) = &values.preset {
        option("--preset", preset.clone());
    }
    for (name, value) in batch.values(file).set {
        option("--set", format!("{name}={value}"));
    }
    option("--out", batch.out(file).display().to_string());
    option("--budget", batch.args.many.budget.to_string());
    if batch.args.many.strict {
        words.push("--strict".to_owned());
    }
    let words: Vec<_> = words.iter().map(|word| shell_quoted(word)).collect();
    words.join(" ")
}
