//! `meshwright test --update`: recorded values are written anew, and so are files that outputs are held against.

use std::path::Path;

use recipe::Outcome;
use recipe::update::update;

use crate::output::begin;
use engine::Loaded;

/// Renews the values that the recipe records and the run found to be others, and returns a line for each
/// that was changed. What is mended so is no failure of the run any more.
pub(crate) fn renew(
    path: &Path,
    loaded: &Loaded,
    outcome: &mut Outcome,
) -> anyhow::Result<Vec<String>> {
    let update = update(&loaded.recipe, outcome);
    // All files first: if one cannot be written, the recipe says nothing new.
    let files = update.files.iter().map(|(path, bytes)| begin(path, bytes));
    let files: Vec<_> = files.collect::<Result<_, _>>()?;
    for file in files {
        file.commit()?;
    }
    let is_other = update.text != loaded.recipe.sources.first().map_or("", |s| &s.text);
    if is_other {
        store::replace(path, update.text.as_bytes())?;
    }
    outcome.failures = update.left;
    let lines = update.changes.iter().map(|change| {
        let (line, was, found) = (change.line, &change.was, &change.found);
        format!("{}:{line}: {was} -> {found}", path.display())
    });
    Ok(lines.collect())
}
