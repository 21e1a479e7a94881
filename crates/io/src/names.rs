//! Names of objects, different from each other.

use std::collections::{BTreeMap, BTreeSet};

use crate::note::Notes;

/// Makes names different from each other.
#[derive(Default)]
pub(crate) struct Names {
    taken: BTreeSet<String>,
    /// The number that was last put behind a name.
    last: BTreeMap<String, usize>,
}

impl Names {
    /// `name`, or `name.2`, `name.3` and so on if that is taken, with a note.
    pub(crate) fn unique(&mut self, name: &str, notes: &mut Notes) -> String {
        let mut new = name.to_owned();
        while !self.taken.insert(new.clone()) {
            let last = self.last.entry(name.to_owned()).or_insert(1);
            *last += 1;
            new = format!("{name}.{last}");
        }
        let renamed = usize::from(new != name);
        notes.changed(
            renamed,
            None,
            format!("node named `{name}` is now called `{new}`: the name is taken"),
        );
        new
    }
}
