//! What reading changed or left out: nothing is dropped silently.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::{Path, PathBuf};

use glam::DVec3;
use mesh::{Elements, VertexId};

/// Something that a reader did not take as it stands in the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// Whether something is missing from the scene or only has another form.
    pub kind: NoteKind,
    /// The file that holds it: the one that was read or one that it refers to.
    pub path: PathBuf,
    /// The first line that it concerns, from 1, in text files.
    pub line: Option<usize>,
    /// How many there are of what the note is about.
    pub count: usize,
    /// What it is and what became of it, as words that follow the count: `statements 'vp' left out`.
    pub what: String,
    /// The elements of the file that it concerns, where they are known.
    pub elements: Option<Elements>,
    /// Where the first of these elements are, at most [`MOST_PLACES`](Self::MOST_PLACES) of them, in scene units: one
    /// point of a vertex, both ends of an edge, the corners of a face in order.
    pub places: Vec<Vec<DVec3>>,
}

impl Note {
    /// Of so many elements it is kept where they are.
    pub const MOST_PLACES: usize = 10_000;
}

/// Polygons as a file gives them, to say where elements of them are.
#[derive(Clone, Copy)]
pub(crate) struct Given<'a> {
    /// Of the vertices.
    pub(crate) positions: &'a [DVec3],
    /// Where the corners of each polygon begin, and where the last one's end.
    pub(crate) offsets: &'a [u32],
    /// The vertices of the corners.
    pub(crate) corners: &'a [u32],
}

impl Given<'_> {
    /// As [`Note::places`].
    pub(crate) fn places(&self, elements: &Elements) -> Vec<Vec<DVec3>> {
        let at = |v: usize| self.positions.get(v).copied();
        let vertex = |v: VertexId| at(v.index());
        let face = |f: usize| {
            let (first, end) = (*self.offsets.get(f)?, *self.offsets.get(f + 1)?);
            let corners = self.corners.get(first as usize..end as usize)?.iter();
            corners.map(|&v| at(v as usize)).collect()
        };
        let most = Note::MOST_PLACES;
        let edge = |ends: &[VertexId; 2]| ends.iter().map(|&v| vertex(v)).collect();
        match elements {
            Elements::Vertices(list) => {
                let vertices = list.iter().take(most);
                vertices.filter_map(|&v| Some(vec![vertex(v)?])).collect()
            }
            Elements::Edges(list) => list.iter().take(most).filter_map(edge).collect(),
            Elements::Faces(list) => list.iter().take(most).filter_map(|&f| face(f)).collect(),
        }
    }
}

/// What kind of news a [`Note`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NoteKind {
    /// The file holds something that the scene does not.
    LeftOut,
    /// The scene holds it in another form than the file.
    Changed,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.path.display())?;
        if let Some(line) = self.line {
            write!(f, "{line}:")?;
        }
        write!(f, " {} {}", self.count, self.what)?;
        if let Some(elements) = &self.elements {
            write!(f, " {elements}")?;
        }
        Ok(())
    }
}

/// Behind so many notes further ones are only counted: a file can give cause for one with every few bytes.
const MOST: usize = 1000;

/// The notes about one file, while it is being read.
#[derive(Debug)]
pub(crate) struct Notes {
    path: PathBuf,
    list: Vec<Note>,
    /// How many there are behind those of the list.
    further: BTreeMap<NoteKind, usize>,
}

impl Notes {
    pub(crate) fn of(path: &Path) -> Self {
        Self {
            path: path.to_path_buf(),
            list: Vec::new(),
            further: BTreeMap::new(),
        }
    }

    /// Adds a note unless `count` is 0.
    pub(crate) fn left_out(
        &mut self,
        count: usize,
        line: impl Into<Option<usize>>,
        what: impl Into<String>,
    ) {
        self.add(NoteKind::LeftOut, count, line.into(), what.into());
    }

    /// Adds a note unless `count` is 0.
    pub(crate) fn changed(
        &mut self,
        count: usize,
        line: impl Into<Option<usize>>,
        what: impl Into<String>,
    ) {
        self.add(NoteKind::Changed, count, line.into(), what.into());
    }

    /// Adds a note about these elements, which are at these places, unless there are none.
    pub(crate) fn elements(
        &mut self,
        kind: NoteKind,
        what: impl Into<String>,
        elements: Elements,
        places: Vec<Vec<DVec3>>,
    ) {
        let note = self.note(kind, elements.len(), None, what.into());
        self.push(Note {
            elements: Some(elements),
            places,
            ..note
        });
    }

    /// Adds a note unless `count` is 0.
    pub(crate) fn add(&mut self, kind: NoteKind, count: usize, line: Option<usize>, what: String) {
        let note = self.note(kind, count, line, what);
        self.push(note);
    }

    fn note(&self, kind: NoteKind, count: usize, line: Option<usize>, what: String) -> Note {
        Note {
            kind,
            path: self.path.clone(),
            line,
            count,
            what,
            elements: None,
            places: Vec::new(),
        }
    }

    fn push(&mut self, note: Note) {
        if note.count == 0 {
            return;
        }
        if self.list.len() < MOST {
            self.list.push(note);
        } else {
            *self.further.entry(note.kind).or_default() += 1;
        }
    }

    /// Adds the notes about another file.
    pub(crate) fn append(&mut self, other: Self) {
        for note in other.list {
            self.push(note);
        }
        for (kind, count) in other.further {
            *self.further.entry(kind).or_default() += count;
        }
    }

    pub(crate) fn into_vec(mut self) -> Vec<Note> {
        for (kind, count) in std::mem::take(&mut self.further) {
            let what = match kind {
                NoteKind::LeftOut => "further notes of what is left out",
                NoteKind::Changed => "further notes of what is changed",
            };
            let note = self.note(kind, count, None, what.to_owned());
            self.list.push(note);
        }
        self.list
    }
}

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
        let what = format!("node named `{name}` is now called `{new}`: the name is taken");
        notes.changed(usize::from(new != name), None, what);
        new
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_notes_are_counted_instead_of_listed() {
        let mut notes = Notes::of(Path::new("a"));
        for i in 0..1500 {
            notes.left_out(2, i, "things left out");
            notes.changed(1, None, "things changed");
        }
        let mut all = Notes::of(Path::new("b"));
        all.append(notes);
        let list = all.into_vec();
        assert_eq!(list.len(), 1002);
        let [left_out, changed] = [&list[1000], &list[1001]].map(ToString::to_string);
        assert_eq!(left_out, "b: 1000 further notes of what is left out");
        assert_eq!(changed, "b: 1000 further notes of what is changed");
    }
}
