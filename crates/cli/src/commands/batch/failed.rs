//! What is kept of a file that failed: why, in full, and the command that repeats it.

use std::path::{Path, PathBuf};

use super::inputs::Input;
use super::plan::Batch;
use super::row::Row;
use crate::output::{quoted, write_whole};

/// The folder of all failures.
pub(super) fn folder(out: &Path) -> PathBuf {
    out.join("failed")
}

/// The file of one failure: the name of the input, short enough for every file system, and what tells
/// inputs of one name apart.
fn path(batch: &Batch, file: &Input) -> PathBuf {
    let name = file.relative.file_name().unwrap_or_default();
    let name = name.to_string_lossy();
    let is_plain = |c: char| c.is_alphanumeric() || matches!(c, '.' | '-' | '_');
    let plain = |c: char| if is_plain(c) { c } else { '_' };
    let name: String = name.chars().map(plain).take(50).collect();
    let digest = blake3::hash(file.path.as_bytes()).to_hex();
    folder(&batch.args.out).join(format!("{name}-{}.txt", &digest[..8]))
}

/// Writes the failure of a file; `text` is the whole of what is to be said of it.
pub(super) fn write(batch: &Batch, file: &Input, row: &Row, text: &str) -> anyhow::Result<()> {
    let step = row.step.as_ref().map(|s| format!(" at {s}"));
    let step = step.unwrap_or_default();
    let again = command(batch, file);
    let folder = std::env::current_dir().unwrap_or_default();
    let text = format!(
        "{} failed{step}\n\n{text}\nTo repeat it, in {}:\n\n{again}\n",
        file.path,
        folder.display()
    );
    write_whole(&path(batch, file), text.as_bytes())
}

/// Removes what is kept of an earlier failure.
pub(super) fn remove(batch: &Batch, file: &Input) {
    // Most never failed.
    let _ = std::fs::remove_file(path(batch, file));
}

/// The command that runs the recipe on this file alone.
fn command(batch: &Batch, file: &Input) -> String {
    let values = &batch.args.values;
    let recipe = batch.path.display().to_string();
    let mut words = vec!["meshwright".to_owned(), "run".to_owned(), recipe];
    let mut option = |name: &str, value: String| words.extend([name.to_owned(), value]);
    if let Some(preset) = &values.preset {
        option("--preset", preset.clone());
    }
    let input = (batch.param.clone(), file.path.clone());
    for (name, value) in values.set.iter().chain([&input]) {
        option("--set", format!("{name}={value}"));
    }
    option("--out", batch.out(file).display().to_string());
    option("--budget", batch.args.many.budget.to_string());
    let quoted: Vec<_> = words.iter().map(|word| quoted(word)).collect();
    quoted.join(" ")
}
