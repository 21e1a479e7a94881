//! `meshwright test --update`: replaces the expected values in recipes by the actual values of a run. Also replaces
//! reference files (expected output files) by the files that the run has written.

use std::path::Path;

use recipe::Outcome;
use recipe::update::update;

use crate::output::write_temporary;
use engine::Loaded;

/// In the recipe, replaces each expected value that differs from the actual value of the run. Returns one line of text
/// for each change. If the update fixes a failure, this failure is removed from `outcome`.
pub(crate) fn update_recorded_values(
    path: &Path,
    loaded: &Loaded,
    outcome: &mut Outcome,
) -> anyhow::Result<Vec<String>> {
    let update = update(&loaded.recipe, outcome);
    // The reference files are written before the recipe. If a reference file cannot be written, the recipe stays
    // unchanged.
    let files = update
        .files
        .iter()
        .map(|(path, bytes)| write_temporary(path, bytes));
    let files: Vec<_> = files.collect::<Result<_, _>>()?;
    for file in files {
        file.commit()?;
    }
    let is_changed = update.text != loaded.recipe.sources.first().map_or("", |s| &s.text);
    if is_changed {
        store::replace(path, update.text.as_bytes())?;
    }
    outcome.failures = update.left;
    let lines = update.changes.iter().map(|change| {
        let (line, was, found) = (change.line, &change.was, &change.found);
        format!("{}:{line}: {was} -> {found}", path.display())
    });
    Ok(lines.collect())
}
