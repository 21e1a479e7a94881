//! Taking edits back.
//!
//! [`Mesh::begin`] opens a journal. From then on every write notes what it overwrites, so that
//! [`Mesh::rollback`] gives back the same bytes, and [`Mesh::commit`] a [`Change`] that can be reverted
//! later, and done again after that. Memory and time are in proportion to the change, not to the mesh.
//! While no journal is open, a write costs one comparison more.
//!
//! Levels nest: an inner `rollback` takes back what was done since the inner `begin`, an inner `commit`
//! leaves it to the outer level.
//!
//! The notes are one stack. An element that is newer than its level needs none: going back cuts the
//! arrays to their lengths. Going back notes what it overwrites in the same way, and that is the change
//! that does it again. Notes that would outgrow the mesh become one copy of it, and a level that has a
//! copy needs no notes any more: so a journal never takes more than about twice the bytes of its mesh.

use bytemuck::cast_slice_mut;
use glam::DVec3;

use crate::attribute::{Attributes, Column, pop_value};
use crate::{Connectivity, Domain, Id, Mesh, Values, VertexId};

/// What an edit, or several, did to a mesh: enough to take it back. See [`Mesh::commit`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Change {
    entries: Vec<Entry>,
    /// The bytes of positions and values, in the order of the entries that own them.
    values: Vec<u8>,
}

impl Change {
    /// Whether nothing was changed.
    pub fn is_empty(&self) -> bool {
        self.entries
            .iter()
            .all(|entry| matches!(entry, Entry::Level(_)))
    }

    /// The bytes that it takes, without those of whole arrays in it.
    pub fn bytes(&self) -> usize {
        size_of_val(self.entries.as_slice()) + self.values.len()
    }
}

/// Notes of so many bytes are kept on any mesh.
const MIN_JOURNAL: usize = 1 << 16;

/// The journal of a mesh while it is open.
#[derive(Clone, Debug, Default)]
pub(crate) struct Journal {
    noted: Change,
    levels: Vec<Level>,
    /// Elements below these counts are noted: those that are older than the innermost level.
    lengths: Lengths,
}

/// What lies between a begin and its end.
#[derive(Clone, Copy, Debug)]
struct Level {
    /// Where its notes begin, and the bytes of their values.
    start: usize,
    first_value: usize,
    /// How long the arrays were.
    lengths: Lengths,
    /// Whether it has noted a whole mesh, so that all else that changes is in that already.
    has_whole: bool,
}

/// One thing to put back.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Entry {
    /// The id at this place of an array, as a plain number.
    Link(Array, u32, u32),
    /// The bytes of a position.
    Position(VertexId),
    /// The bytes of one value in each column of the domain.
    Values(Domain, usize),
    /// An element that was marked dead, or is to be again.
    Mark(Domain, usize),
    /// A column in place of the one of its name, if there is one.
    Column(Domain, Box<Column>),
    /// No column of this name.
    NoColumn(Domain, Box<str>),
    Positions(Box<[DVec3]>),
    Attributes(Box<Attributes>),
    /// A whole mesh, without journal.
    Whole(Box<Mesh>),
    /// The lengths of the arrays at the begin of a level: what is behind them goes.
    Level(Box<Lengths>),
    /// What stood behind: it comes again.
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
    /// The ids of an array as plain numbers.
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

/// How many elements of each domain there are.
type Lengths = [usize; 4];

/// The ends of all arrays.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tail {
    connectivity: Connectivity,
    positions: Vec<DVec3>,
    /// For each domain the values of its columns.
    values: [Vec<Values>; 4],
}

impl Journal {
    /// Notes an entry, made only if it is needed.
    pub(crate) fn note(&mut self, entry: impl FnOnce() -> Entry) {
        if self.levels.last().is_some_and(|level| !level.has_whole) {
            self.noted.entries.push(entry());
        }
    }

    /// Notes the whole mesh from before a change.
    fn note_whole(&mut self, mesh: Mesh) {
        self.note(|| Entry::Whole(Box::new(mesh)));
        if let Some(level) = self.levels.last_mut() {
            level.has_whole = true;
        }
        self.lengths = Lengths::default();
    }

    fn begin(&mut self, lengths: Lengths) {
        self.levels.push(Level {
            start: self.noted.entries.len(),
            first_value: self.noted.values.len(),
            lengths,
            has_whole: false,
        });
        self.lengths = lengths;
        self.note(|| Entry::Level(Box::new(lengths)));
    }

    /// Ends the innermost level and returns where its notes begin.
    fn end(&mut self) -> Level {
        let ended = self.levels.pop().expect("an open journal has a level");
        if let Some(level) = self.levels.last() {
            let lengths = if level.has_whole {
                Lengths::default()
            } else {
                level.lengths
            };
            self.lengths = lengths;
        }
        ended
    }

    #[inline]
    fn is_noted<I: Id>(&self, element: I) -> bool {
        element.index() < self.lengths[I::DOMAIN as usize]
    }

    /// Notes the id that an element had in an array.
    #[inline]
    pub(crate) fn link<I: Id>(&mut self, array: Array, element: I, old: u32) {
        if self.is_noted(element) {
            let entry = Entry::Link(array, bytemuck::cast(element), old);
            self.noted.entries.push(entry);
        }
    }

    pub(crate) fn position(&mut self, v: VertexId, old: DVec3) {
        if self.is_noted(v) {
            self.noted.position(v, old);
        }
    }

    /// Notes the values that `element` has in these columns, all those of its domain.
    pub(crate) fn values<I: Id>(&mut self, element: I, columns: &[Column]) {
        if self.is_noted(element) {
            self.noted.values(I::DOMAIN, element.index(), columns);
        }
    }
}

impl Change {
    fn position(&mut self, v: VertexId, old: DVec3) {
        self.entries.push(Entry::Position(v));
        self.values.extend(bytemuck::bytes_of(&old));
    }

    fn values(&mut self, domain: Domain, i: usize, columns: &[Column]) {
        for column in columns {
            column.values.push_bytes(i, &mut self.values);
        }
        self.entries.push(Entry::Values(domain, i));
    }
}

impl Mesh {
    /// Begins to note what is overwritten, until [`commit`](Self::commit) or
    /// [`rollback`](Self::rollback). May be nested.
    pub fn begin(&mut self) {
        self.bound_journal();
        let lengths = self.lengths();
        self.journal.get_or_insert_default().begin(lengths);
    }

    /// Whether a journal is open.
    pub fn is_recording(&self) -> bool {
        self.journal.is_some()
    }

    /// Takes back everything since the matching [`begin`](Self::begin): every array is the same as it
    /// was then, bit for bit.
    ///
    /// # Panics
    ///
    /// If nothing was begun.
    pub fn rollback(&mut self) {
        let mut journal = self.journal.take().expect("begin comes before rollback");
        let ended = journal.end();
        self.go_back(&mut journal.noted, ended.start);
        if !journal.levels.is_empty() {
            self.journal = Some(journal);
        }
    }

    /// Keeps what was done since the matching [`begin`](Self::begin). If that was the outermost one,
    /// returns the change, to be [reverted](Self::revert) later.
    ///
    /// # Panics
    ///
    /// If nothing was begun.
    pub fn commit(&mut self) -> Option<Change> {
        let mut journal = self.journal.take().expect("begin comes before commit");
        let ended = journal.end();
        let Some(outer) = journal.levels.last_mut() else {
            return Some(journal.noted);
        };
        if outer.has_whole {
            // The copy from before is enough.
            journal.noted.entries.truncate(ended.start);
            journal.noted.values.truncate(ended.first_value);
        } else if ended.has_whole {
            outer.has_whole = true;
            journal.lengths = Lengths::default();
        }
        self.journal = Some(journal);
        None
    }

    /// Takes back a change, and returns the change that does it again.
    ///
    /// The mesh must be as it was when that change was committed: later ones are reverted first.
    ///
    /// # Panics
    ///
    /// If a journal is open. For a change of another mesh, or out of turn, the result is any mesh, or a
    /// panic where it names an element that is not there.
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
    /// let again = mesh.revert(change);
    /// assert_eq!(mesh, before);
    /// mesh.revert(again);
    /// assert_eq!(mesh, after);
    /// # Ok::<(), mesh::EditError>(())
    /// ```
    pub fn revert(&mut self, mut change: Change) -> Change {
        assert!(self.journal.is_none(), "a journal is open");
        self.go_back(&mut change, 0)
    }

    /// Runs `edit` as a whole: if it returns an error, the mesh is as it was before.
    ///
    /// # Errors
    ///
    /// The error of `edit`.
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

    /// Puts another mesh in the place of this one. Where `*mesh = other` would lose an open journal,
    /// this notes it.
    pub fn replace(&mut self, other: Self) {
        let journal = self.journal.take();
        let old = std::mem::replace(self, other);
        self.journal = journal;
        if let Some(journal) = &mut self.journal {
            journal.note_whole(old);
        }
    }

    /// Turns notes that have become larger than the mesh into one copy of it as it was at the begin.
    /// Called between edits; inner levels are those of one edit, and short.
    pub(crate) fn bound_journal(&mut self) {
        let Some(journal) = &self.journal else { return };
        let [level] = journal.levels[..] else { return };
        if level.has_whole || journal.noted.bytes() < self.bytes() + MIN_JOURNAL {
            return;
        }
        let mut journal = self.journal.take().expect("looked at above");
        let mut before = self.clone();
        before.go_back(&mut journal.noted, level.start);
        journal.levels.clear();
        journal.begin(level.lengths);
        journal.note_whole(before);
        self.journal = Some(journal);
    }

    /// Puts back what the entries from `start` on say, the last one first. Returns what undoes that.
    fn go_back(&mut self, change: &mut Change, start: usize) -> Change {
        let mut inverse = Change::default();
        for entry in change.entries.drain(start..).rev() {
            let undo = self.put_back(entry, &mut change.values, &mut inverse);
            inverse.entries.extend(undo);
        }
        inverse
    }

    /// Puts one entry back. Returns the entry that undoes that, unless it went into `inverse` together
    /// with numbers.
    fn put_back(
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
                inverse.position(v, *position);
                *position = pop_value(values);
                return None;
            }
            Entry::Values(domain, i) => {
                inverse.values(domain, i, self.attributes.of(domain));
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
                debug_assert!(fits, "the columns are those that the tail was cut from");
            }
        }
    }
}

#[cfg(test)]
mod tests;
