//! `meshwright test --update`: recorded values are written anew.

use std::path::Path;

use anyhow::Context as _;
use recipe::Outcome;
use recipe::update::update;

use crate::loading::Loaded;
use crate::output::print;
use crate::replace::replace_file;

/// Renews the values that the recipe records and the run found to be others, and says what was changed.
/// What is mended so is no failure of the run any more.
pub(crate) fn renew(path: &Path, loaded: &Loaded, outcome: &mut Outcome) -> anyhow::Result<()> {
    let update = update(&loaded.recipe, outcome);
    if !update.changes.is_empty() {
        replace_file(path, &update.text)
            .with_context(|| format!("cannot write {}", path.display()))?;
    }
    for change in &update.changes {
        let (line, was, found) = (change.line, &change.was, &change.found);
        print(&format!("{}:{line}: {was} -> {found}\n", path.display()))?;
    }
    outcome.failures = update.left;
    Ok(())
}
