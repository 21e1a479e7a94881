//! The stage: a temporary folder that holds the outputs until the run succeeds.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use op::Files;
use store::{Entry, TemporaryFolder, files_below};

use super::Settings;

/// Creates the stage if the recipe writes files. If outputs are kept, the stage is inside the output folder.
pub(super) fn staging<'a>(settings: &Settings<'a>) -> Result<Option<TemporaryFolder<'a>>, String> {
    if !settings.writes {
        return Ok(None);
    }
    let folder = &settings.files.output;
    let inside = settings.keep_outputs.then_some(folder.as_path());
    match TemporaryFolder::new(&*settings.files.store, inside) {
        Ok(stage) => Ok(Some(stage)),
        Err(error) if settings.keep_outputs => Err(format!(
            "cannot write to the output folder {}: {}",
            folder.display(),
            error.error
        )),
        Err(error) => Err(error.to_string()),
    }
}

/// Moves all files from the stage to the output folder, and returns their paths.
pub(super) fn deliver(stage: &Path, files: &Files) -> Result<Vec<PathBuf>, String> {
    let store = &*files.store;
    let message = |error: store::StoreError| error.to_string();
    let mut moves = Vec::new();
    for from in files_below(store, stage).map_err(message)? {
        let relative = from.strip_prefix(stage).expect("found below the stage");
        let to = files.output.join(relative);
        files.check_links(relative).map_err(|e| e.to_string())?;
        if let Err(error) = files.make_folder_of(&to) {
            let why = error.error;
            return Err(format!("cannot write {}: {why}", to.display()));
        }
        if store.is_folder(&to) {
            return Err(format!(
                "cannot write {}: a folder with that name exists",
                to.display()
            ));
        }
        moves.push((from, to));
    }
    for (from, to) in &moves {
        store.rename(from, to).map_err(message)?;
    }
    Ok(moves.into_iter().map(|(_, to)| to).collect())
}

/// The files of a stage, each with the metadata that changes when the file is written.
pub(super) type Listing = BTreeMap<PathBuf, Entry>;

/// Lists a stage. Skips files that cannot be listed; `deliver` reports them.
pub(super) fn listing(stage: &Path, files: &Files) -> Listing {
    let paths = files_below(&*files.store, stage).unwrap_or_default();
    let files = paths.into_iter().filter_map(|path| {
        let entry = files.store.entry(&path)?;
        Some((path.strip_prefix(stage).ok()?.to_owned(), entry))
    });
    files.collect()
}

/// Returns the files that are new or changed.
pub(super) fn written(before: &Listing, after: &Listing) -> Vec<PathBuf> {
    let is_new = |(path, state): &(&PathBuf, &_)| before.get(*path) != Some(state);
    let new = after.iter().filter(is_new);
    new.map(|(path, _)| path.clone()).collect()
}
