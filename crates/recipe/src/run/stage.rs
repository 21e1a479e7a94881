//! The folder where outputs wait until everything has held.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use op::Files;

use super::{Settings, stage_prefix};

/// A folder inside the output folder where files wait until everything has held.
pub(super) fn staging(settings: Settings) -> Result<Option<tempfile::TempDir>, String> {
    if !settings.writes {
        return Ok(None);
    }
    let folder = &settings.files.output;
    let made = || -> std::io::Result<tempfile::TempDir> {
        if settings.keep_outputs {
            std::fs::create_dir_all(folder)?;
            tempfile::Builder::new()
                .prefix(&stage_prefix(std::process::id()))
                .tempdir_in(folder)
        } else {
            tempfile::Builder::new().prefix("meshwright-").tempdir()
        }
    };
    made().map(Some).map_err(|error| {
        format!(
            "cannot write to the output folder {}: {error}",
            folder.display()
        )
    })
}

/// Moves all files to their places.
pub(super) fn deliver(stage: &Path, files: &Files) -> Result<Vec<PathBuf>, String> {
    let mut waiting = Vec::new();
    collect(stage, &mut waiting).map_err(|e| format!("cannot list the outputs: {e}"))?;
    waiting.sort();
    let mut moves = Vec::new();
    for from in waiting {
        let relative = from.strip_prefix(stage).expect("found below the stage");
        let to = files.output.join(relative);
        let failed = |e: std::io::Error| format!("cannot write {}: {e}", to.display());
        files.check_links(relative).map_err(|e| e.to_string())?;
        if let Some(folder) = to.parent() {
            std::fs::create_dir_all(folder).map_err(failed)?;
        }
        if to.is_dir() {
            return Err(format!(
                "cannot write {}: there is a folder of that name",
                to.display()
            ));
        }
        moves.push((from, to));
    }
    for (from, to) in &moves {
        std::fs::rename(from, to).map_err(|e| format!("cannot write {}: {e}", to.display()))?;
    }
    Ok(moves.into_iter().map(|(_, to)| to).collect())
}

fn collect(folder: &Path, found: &mut Vec<PathBuf>) -> std::io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            collect(&path, found)?;
        } else {
            found.push(path);
        }
    }
    Ok(())
}

/// The files of a stage with what changes when they are written.
pub(super) type Listing = BTreeMap<PathBuf, (u64, Option<SystemTime>)>;

/// Lists a stage. What cannot be listed is found out when it is delivered.
pub(super) fn listing(stage: &Path) -> Listing {
    let mut paths = Vec::new();
    let _ = collect(stage, &mut paths);
    let files = paths.into_iter().filter_map(|path| {
        let meta = std::fs::metadata(&path).ok()?;
        let relative = path.strip_prefix(stage).ok()?.to_owned();
        Some((relative, (meta.len(), meta.modified().ok())))
    });
    files.collect()
}

/// The files that are new or other ones.
pub(super) fn written(before: &Listing, after: &Listing) -> Vec<PathBuf> {
    let is_new = |(path, state): &(&PathBuf, &_)| before.get(*path) != Some(state);
    let new = after.iter().filter(is_new);
    new.map(|(path, _)| path.clone()).collect()
}
