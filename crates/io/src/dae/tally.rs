//! What a file costs, and what is left out of it.

use std::collections::BTreeMap;

use super::document::{Node, error_at, line};
use crate::fault::Fault;
use crate::note::{NoteKind, Notes};

/// What was left out or changed, added up by what it is.
#[derive(Default)]
pub(super) struct Tally(BTreeMap<(NoteKind, &'static str), (usize, usize)>);

impl Tally {
    pub(super) fn left_out(&mut self, count: usize, node: Node, what: &'static str) {
        self.add(NoteKind::LeftOut, count, node, what);
    }

    pub(super) fn changed(&mut self, count: usize, node: Node, what: &'static str) {
        self.add(NoteKind::Changed, count, node, what);
    }

    fn add(&mut self, kind: NoteKind, count: usize, node: Node, what: &'static str) {
        if count > 0 {
            // The line is looked for only once: that takes time.
            let entry = self.0.entry((kind, what));
            let (sum, _) = entry.or_insert_with(|| (0, line(node)));
            *sum = sum.saturating_add(count);
        }
    }

    pub(super) fn into_notes(self, notes: &mut Notes) {
        for ((kind, what), (count, line)) in self.0 {
            notes.add(kind, count, Some(line), what.to_owned());
        }
    }
}

/// How much memory may still be taken. A file may repeat its geometries by instances, but not without end.
pub(super) struct Budget(usize);

impl Budget {
    /// A file may become this many times its size in memory, ...
    pub(super) const TIMES: usize = 64;
    /// ... and this many bytes in any case.
    pub(super) const FREE: usize = 1 << 24;
    /// How many bytes an object without faces takes, a material of it and what binds it, a vertex, a corner and a
    /// further value of a corner, about.
    pub(super) const OBJECT: usize = 1000;
    pub(super) const MATERIAL: usize = 1000;
    pub(super) const BOUND: usize = 50;
    pub(super) const VERTEX: usize = 64;
    pub(super) const CORNER: usize = 48;
    pub(super) const VALUE: usize = 24;
    /// What reading a number costs each time that it is read: time rather than memory.
    pub(super) const NUMBER: usize = 20;

    pub(super) fn of(size: usize) -> Self {
        Self(size.saturating_mul(Self::TIMES).max(Self::FREE))
    }

    pub(super) fn take(&mut self, node: Node, bytes: usize) -> Result<(), Fault> {
        let message = "the file repeats its polygons far more often than usual for its size";
        self.0 = self
            .0
            .checked_sub(bytes)
            .ok_or_else(|| error_at(node, message))?;
        Ok(())
    }
}
