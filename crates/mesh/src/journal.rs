//! Undo and redo of edits.
//!
//! [`Mesh::begin`] opens a journal. While the journal is open, every write records the value that it overwrites.
//! [`Mesh::rollback`] restores the mesh bit for bit. [`Mesh::commit`] returns a [`Change`] that can be reverted later
//! and then redone. Memory and time are proportional to the size of the change, not to the size of the mesh. While no
//! journal is open, a write costs only one additional comparison.
//!
//! Calls can be nested: each `begin` opens a level, and the matching `commit` or `rollback` ends this level. An inner
//! `rollback` undoes the edits since the inner `begin`; an inner `commit` makes these edits part of the outer level.
//!
//! The journal is a stack of entries. An element that was added after the innermost level was opened needs no entry: an
//! undo truncates the arrays to their old lengths. An undo in turn records the values that it overwrites; this record
//! is the change that redoes the edits.
//!
//! Before an edit starts, the total size of the entries is checked. Copies of whole arrays do not count. The limit for
//! the entries is the memory of the mesh plus 64 KiB. If the journal has only one level and its entries reach the
//! limit, one copy of the old mesh replaces the entries. If a level of the journal has a copy of the mesh, no further
//! entries are recorded for this level.

use bytemuck::cast_slice_mut;
use glam::DVec3;

use crate::attribute::{Attributes, Column, pop_value};
use crate::{Connectivity, Domain, Id, Mesh, Values, VertexId};

/// A record of one or more edits of a mesh, with which the edits can be undone. See [`Mesh::commit`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Change {
    entries: Vec<Entry>,
    /// The bytes of the overwritten positions and attribute values, in the order of their entries.
    values: Vec<u8>,
}

impl Change {
    /// Whether the change contains no edits.
    pub fn is_empty(&self) -> bool {
        self.entries
            .iter()
            .all(|entry| matches!(entry, Entry::Level(_)))
    }

    /// Returns the size of the change in bytes. If the change contains copies of whole arrays, these copies are not
    /// counted.
    pub fn bytes(&self) -> usize {
        size_of_val(self.entries.as_slice()) + self.values.len()
    }
}

/// If the entries of a journal take at least this number of bytes more than the mesh, a copy of the mesh replaces them.
const JOURNAL_ALLOWANCE: usize = 1 << 16;

/// The open journal of a mesh.
#[derive(Debug, Default)]
pub(crate) struct Journal {
    recorded: Change,
    levels: Vec<Level>,
    /// The number of elements of each domain when the innermost level was opened. Changes are recorded only for
    /// elements that existed at that time. If the whole mesh was recorded, all four numbers are 0, so that no further
    /// changes are recorded.
    lengths: Lengths,
}

/// One level of recording: from a `begin` to its `commit` or `rollback`.
#[derive(Clone, Copy, Debug)]
struct Level {
    /// The index of the first entry of the level.
    start: usize,
    /// The index, in [`Change::values`], of the first byte that was recorded after this `begin`.
    first_value: usize,
    /// The lengths of the arrays at `begin`.
    lengths: Lengths,
    /// Whether a copy of the whole mesh was recorded, so that no further entries are needed.
    has_whole: bool,
}

/// One recorded value, which an undo restores.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Entry {
    /// An overwritten id: the array, the index in the array, and the id as a plain number.
    Link(Array, u32, u32),
    /// The position of a vertex; the bytes are in [`Change::values`].
    Position(VertexId),
    /// The values of an element in all columns of the domain; the bytes are in [`Change::values`].
    Values(Domain, usize),
    /// The dead mark of an element, which an undo toggles.
    Mark(Domain, usize),
    /// A column that was overwritten or removed. An undo restores this column, and removes the current column of the
    /// same name if there is one.
    Column(Domain, Box<Column>),
    /// The name of a column that did not exist before. An undo removes the column.
    NoColumn(Domain, Box<str>),
    Positions(Box<[DVec3]>),
    Attributes(Box<Attributes>),
    /// A copy of the whole mesh, without its journal.
    Whole(Box<Mesh>),
    /// The lengths of the arrays at the start of a level. An undo truncates the arrays to these lengths.
    Level(Box<Lengths>),
    /// The entries that an undo has removed from the ends of the arrays. A redo appends these entries to the arrays
    /// again.
    Tail(Box<Tail>),
}

/// One of the arrays of [`Connectivity`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Array {
    Next,
    Origin,
    Face,
    VertexHalfEdge,
    FaceHalfEdge,
}

impl Connectivity {
    /// Returns the ids of an array as plain numbers.
    #[inline]
    pub(crate) fn ids_mut(&mut self, array: Array) -> &mut [u32] {
        match array {
            Array::Next => cast_slice_mut(&mut self.next),
            Array::Origin => cast_slice_mut(&mut self.origin),
            Array::Face => cast_slice_mut(&mut self.face),
            Array::VertexHalfEdge => cast_slice_mut(&mut self.vertex_half_edge),
            Array::FaceHalfEdge => cast_slice_mut(&mut self.face_half_edge),
        }
    }
}

/// The number of elements of each domain, including dead ones.
type Lengths = [usize; 4];

/// Entries that were cut off from the ends of all arrays.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tail {
    connectivity: Connectivity,
    positions: Vec<DVec3>,
    /// For each domain, the values of its columns.
    values: [Vec<Values>; 4],
}

impl Journal {
    /// Records an entry, unless the innermost level already has a copy of the whole mesh. In that case, `entry` is not
    /// called.
    pub(crate) fn record(&mut self, entry: impl FnOnce() -> Entry) {
        if self.levels.last().is_some_and(|level| !level.has_whole) {
            self.recorded.entries.push(entry());
        }
    }

    /// Records `mesh`, which must be a copy of the whole mesh as it was before the change.
    fn record_whole(&mut self, mesh: Mesh) {
        self.record(|| Entry::Whole(Box::new(mesh)));
        if let Some(level) = self.levels.last_mut() {
            level.has_whole = true;
        }
        self.lengths = Lengths::default();
    }

    fn begin(&mut self, lengths: Lengths) {
        self.levels.push(Level {
            start: self.recorded.entries.len(),
            first_value: self.recorded.values.len(),
            lengths,
            has_whole: false,
        });
        self.lengths = lengths;
        self.record(|| Entry::Level(Box::new(lengths)));
    }

    /// Ends the innermost level and returns it.
    fn end(&mut self) -> Level {
        let inner = self.levels.pop().expect("an open journal has a level");
        if let Some(level) = self.levels.last() {
            let lengths = if level.has_whole {
                Lengths::default()
            } else {
                level.lengths
            };
            self.lengths = lengths;
        }
        inner
    }

    /// Whether changes of this element must be recorded. This is the case if the element is older than the innermost
    /// level and this level has no copy of the whole mesh.
    #[inline]
    fn needs_entry<I: Id>(&self, element: I) -> bool {
        element.index() < self.lengths[I::DOMAIN as usize]
    }

    /// Records the old id at the index of `element` in an array, unless the element was added after the innermost level
    /// was opened.
    #[inline]
    pub(crate) fn record_link<I: Id>(&mut self, array: Array, element: I, old: u32) {
        if self.needs_entry(element) {
            let entry = Entry::Link(array, bytemuck::cast(element), old);
            self.recorded.entries.push(entry);
        }
    }

    /// Records the old position of a vertex, unless the vertex was added after the innermost level was opened.
    pub(crate) fn record_position(&mut self, v: VertexId, old: DVec3) {
        if self.needs_entry(v) {
            self.recorded.push_position(v, old);
        }
    }

    /// Records the old values of `element`. `columns` must be all columns of the domain of this element. Records
    /// nothing if the element was added after the innermost level was opened.
    pub(crate) fn record_values<I: Id>(&mut self, element: I, columns: &[Column]) {
        if self.needs_entry(element) {
            self.recorded
                .push_values(I::DOMAIN, element.index(), columns);
        }
    }
}

impl Change {
    fn push_position(&mut self, v: VertexId, old: DVec3) {
        self.entries.push(Entry::Position(v));
        self.values.extend(bytemuck::bytes_of(&old));
    }

    fn push_values(&mut self, domain: Domain, i: usize, columns: &[Column]) {
        for column in columns {
            column.values.push_bytes(i, &mut self.values);
        }
        self.entries.push(Entry::Values(domain, i));
    }
}

impl Mesh {
    /// Starts to record changes, until the matching [`commit`](Self::commit) or
    /// [`rollback`](Self::rollback). Calls can be nested.
    pub fn begin(&mut self) {
        self.bound_journal();
        let lengths = self.lengths();
        self.journal.get_or_insert_default().begin(lengths);
    }

    /// Whether a journal is open.
    pub fn is_recording(&self) -> bool {
        self.journal.is_some()
    }

    /// Undoes all changes since the matching [`begin`](Self::begin): every array is restored bit for bit.
    ///
    /// # Panics
    ///
    /// Panics if no journal is open.
    pub fn rollback(&mut self) {
        let mut journal = self
            .journal
            .take()
            .expect("`begin` must be called before `rollback`");
        let level = journal.end();
        self.undo_entries(&mut journal.recorded, level.start);
        if !journal.levels.is_empty() {
            self.journal = Some(journal);
        }
    }

    /// Keeps all changes since the matching [`begin`](Self::begin). If this call ends the outermost level, returns the
    /// change, which can be [reverted](Self::revert) later. Otherwise, returns `None`.
    ///
    /// # Panics
    ///
    /// Panics if no journal is open.
    pub fn commit(&mut self) -> Option<Change> {
        let mut journal = self
            .journal
            .take()
            .expect("`begin` must be called before `commit`");
        let inner = journal.end();
        let Some(outer) = journal.levels.last_mut() else {
            return Some(journal.recorded);
        };
        if outer.has_whole {
            // The outer level of the journal already has a copy of the whole mesh. Therefore, it does not need the
            // entries of the inner level.
            journal.recorded.entries.truncate(inner.start);
            journal.recorded.values.truncate(inner.first_value);
        } else if inner.has_whole {
            outer.has_whole = true;
            journal.lengths = Lengths::default();
        }
        self.journal = Some(journal);
        None
    }

    /// Undoes a change, and returns the change that redoes it.
    ///
    /// The mesh must be in the state that it had when the change was committed: revert later changes first.
    ///
    /// # Panics
    ///
    /// Panics if a journal is open. If the change belongs to a different mesh, or to a different state of this mesh,
    /// the result is unspecified and can be an invalid mesh. The call panics if the change refers to an element that
    /// does not exist.
    ///
    /// # Examples
    ///
    /// ```
    /// let mut mesh = geometry::shapes::tetrahedron();
    /// let before = mesh.clone();
    /// mesh.begin();
    /// let m = mesh.split_edge(mesh::EdgeId::new(0), 0.5)?;
    /// let change = mesh.commit().unwrap();
    /// let after = mesh.clone();
    ///
    /// let redo = mesh.revert(change);
    /// assert_eq!(mesh, before);
    /// mesh.revert(redo);
    /// assert_eq!(mesh, after);
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    pub fn revert(&mut self, mut change: Change) -> Change {
        assert!(self.journal.is_none(), "a journal is open");
        self.undo_entries(&mut change, 0)
    }

    /// Runs `edit` atomically: if `edit` returns an error, all changes that `edit` has made are undone.
    ///
    /// # Errors
    ///
    /// Returns the error of `edit`.
    pub fn atomically<T, E>(
        &mut self,
        edit: impl FnOnce(&mut Self) -> Result<T, E>,
    ) -> Result<T, E> {
        self.begin();
        let result = edit(self);
        if result.is_ok() {
            self.commit();
        } else {
            self.rollback();
        }
        result
    }

    /// Replaces the mesh by `other`. An open journal records the replacement. In contrast, `*mesh = other` would
    /// discard the journal.
    pub fn replace(&mut self, other: Self) {
        let journal = self.journal.take();
        let old = std::mem::replace(self, other);
        self.journal = journal;
        if let Some(journal) = &mut self.journal {
            journal.record_whole(old);
        }
    }

    /// If the entries take too much memory, replaces them by one copy of the mesh as it was at `begin`. The limit is
    /// the size of the mesh plus [`JOURNAL_ALLOWANCE`]. This function is called between edits. Does nothing while inner
    /// levels are open, because an inner level is expected to record only a few edits.
    pub(crate) fn bound_journal(&mut self) {
        let Some(journal) = &self.journal else { return };
        let [level] = journal.levels[..] else { return };
        if level.has_whole || journal.recorded.bytes() < self.bytes() + JOURNAL_ALLOWANCE {
            return;
        }
        let mut journal = self.journal.take().expect("checked above");
        let mut before = self.clone();
        before.undo_entries(&mut journal.recorded, level.start);
        journal.levels.clear();
        journal.begin(level.lengths);
        journal.record_whole(before);
        self.journal = Some(journal);
    }

    /// Undoes all entries whose index is at least `start`, in reverse order. Returns the change that redoes the undone
    /// edits.
    fn undo_entries(&mut self, change: &mut Change, start: usize) -> Change {
        let mut inverse = Change::default();
        for entry in change.entries.drain(start..).rev() {
            let redo = self.undo_entry(entry, &mut change.values, &mut inverse);
            inverse.entries.extend(redo);
        }
        inverse
    }

    /// Undoes one entry. Returns the entry that redoes the change. Returns `None` if this function has already added
    /// that entry and its values to `inverse`, or if there was nothing to undo.
    fn undo_entry(
        &mut self,
        entry: Entry,
        values: &mut Vec<u8>,
        inverse: &mut Change,
    ) -> Option<Entry> {
        use std::mem::replace;
        let c = &mut self.connectivity;
        Some(match entry {
            Entry::Link(array, i, old) => {
                Entry::Link(array, i, replace(&mut c.ids_mut(array)[i as usize], old))
            }
            Entry::Position(v) => {
                let position = &mut self.positions[v.index()];
                inverse.push_position(v, *position);
                *position = pop_value(values);
                return None;
            }
            Entry::Values(domain, i) => {
                inverse.push_values(domain, i, self.attributes.of(domain));
                for column in self.attributes.of_mut(domain).iter_mut().rev() {
                    column.values.pop_bytes(i, values);
                }
                return None;
            }
            Entry::Mark(domain, i) => {
                let marks = &mut self.dead[domain as usize];
                if marks.has(i) {
                    marks.remove(i);
                } else {
                    marks.add(i);
                }
                Entry::Mark(domain, i)
            }
            Entry::Column(domain, old) => {
                let name = old.name.clone();
                let replaced = self.attributes.remove(domain, &name);
                self.attributes.insert(domain, *old);
                match replaced {
                    Some(column) => Entry::Column(domain, column.into()),
                    None => Entry::NoColumn(domain, name.into()),
                }
            }
            Entry::NoColumn(domain, name) => {
                Entry::Column(domain, self.attributes.remove(domain, &name)?.into())
            }
            Entry::Positions(old) => {
                Entry::Positions(replace(&mut self.positions, old.into_vec()).into())
            }
            Entry::Attributes(old) => Entry::Attributes(replace(&mut self.attributes, *old).into()),
            Entry::Whole(old) => Entry::Whole(Box::new(replace(self, *old))),
            Entry::Level(lengths) => Entry::Tail(Box::new(self.cut_tail(*lengths))),
            Entry::Tail(tail) => {
                let lengths = self.lengths();
                self.append_tail(*tail);
                Entry::Level(Box::new(lengths))
            }
        })
    }

    fn lengths(&self) -> Lengths {
        Domain::ALL.map(|domain| self.domain_len(domain))
    }

    fn cut_tail(&mut self, lengths: Lengths) -> Tail {
        let c = &mut self.connectivity;
        let [vertices, half_edges, _, faces] = lengths;
        Tail {
            connectivity: Connectivity {
                next: c.next.split_off(half_edges),
                origin: c.origin.split_off(half_edges),
                face: c.face.split_off(half_edges),
                vertex_half_edge: c.vertex_half_edge.split_off(vertices),
                face_half_edge: c.face_half_edge.split_off(faces),
            },
            positions: self.positions.split_off(vertices),
            values: Domain::ALL.map(|domain| {
                let columns = self.attributes.of_mut(domain).iter_mut();
                columns
                    .map(|c| c.values.split_off(lengths[domain as usize]))
                    .collect()
            }),
        }
    }

    fn append_tail(&mut self, tail: Tail) {
        let c = &mut self.connectivity;
        c.next.extend(tail.connectivity.next);
        c.origin.extend(tail.connectivity.origin);
        c.face.extend(tail.connectivity.face);
        c.vertex_half_edge
            .extend(tail.connectivity.vertex_half_edge);
        c.face_half_edge.extend(tail.connectivity.face_half_edge);
        self.positions.extend(tail.positions);
        for (domain, ends) in Domain::ALL.into_iter().zip(tail.values) {
            for (column, end) in self.attributes.of_mut(domain).iter_mut().zip(ends) {
                let fits = column.values.append(&end);
                debug_assert!(fits, "the tail was cut from the same columns");
            }
        }
    }
}

#[cfg(test)]
mod tests;
