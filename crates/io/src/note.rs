//! What reading changed or left out, and what writing lost: nothing is dropped silently.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::{Path, PathBuf};

use glam::DVec3;
use mesh::{Domain, Elements, VertexId};

use crate::FileSeen;

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
        let places: Vec<Option<Vec<DVec3>>> = match elements {
            Elements::Vertices(list) => (list.iter().take(most))
                .map(|&v| Some(vec![vertex(v)?]))
                .collect(),
            Elements::Edges(list) => (list.iter().take(most))
                .map(|ends| ends.iter().map(|&v| vertex(v)).collect())
                .collect(),
            Elements::Faces(list) => list.iter().take(most).map(|&f| face(f)).collect(),
        };
        places.into_iter().flatten().collect()
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
    /// The files beside it that were looked at.
    files: BTreeSet<FileSeen>,
}

impl Notes {
    pub(crate) fn of(path: &Path) -> Self {
        Self {
            path: path.to_path_buf(),
            list: Vec::new(),
            further: BTreeMap::new(),
            files: BTreeSet::new(),
        }
    }

    /// Notes that the content of a file was wanted.
    pub(crate) fn has_read(&mut self, path: PathBuf) {
        self.files.insert(FileSeen {
            path,
            is_read: true,
        });
    }

    /// Notes that it was looked whether there is such a file.
    pub(crate) fn has_looked_for(&mut self, path: PathBuf) {
        self.files.insert(FileSeen {
            path,
            is_read: false,
        });
    }

    /// The files beside the one that was read, sorted.
    pub(crate) fn take_files(&mut self) -> Vec<FileSeen> {
        std::mem::take(&mut self.files).into_iter().collect()
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
        if elements.len() > 0 {
            let note = Note {
                kind,
                path: self.path.clone(),
                line: None,
                count: elements.len(),
                what: what.into(),
                elements: Some(elements),
                places,
            };
            self.push(note);
        }
    }

    fn add(&mut self, kind: NoteKind, count: usize, line: Option<usize>, what: String) {
        if count > 0 {
            let path = self.path.clone();
            self.push(Note {
                kind,
                path,
                line,
                count,
                what,
                elements: None,
                places: Vec::new(),
            });
        }
    }

    fn push(&mut self, note: Note) {
        if self.list.len() < MOST {
            self.list.push(note);
        } else {
            *self.further.entry(note.kind).or_default() += 1;
        }
    }

    /// Adds the notes about another file.
    pub(crate) fn append(&mut self, other: Self) {
        self.files.extend(other.files);
        for note in other.list {
            self.push(note);
        }
        for (kind, count) in other.further {
            *self.further.entry(kind).or_default() += count;
        }
    }

    pub(crate) fn into_vec(self) -> Vec<Note> {
        let Self {
            path,
            mut list,
            further,
            ..
        } = self;
        list.extend(further.into_iter().map(|(kind, count)| {
            let what = match kind {
                NoteKind::LeftOut => "further notes of what is left out",
                NoteKind::Changed => "further notes of what is changed",
            };
            Note {
                kind,
                path: path.clone(),
                line: None,
                count,
                what: what.to_owned(),
                elements: None,
                places: Vec::new(),
            }
        }));
        list
    }
}

/// Something of the scene that a written file does not hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loss {
    /// The name of the object.
    pub object: String,
    /// What the lost values belong to; `None` if they belong to the object as a whole.
    pub domain: Option<Domain>,
    /// The name of the attribute, or what else it is.
    pub attribute: String,
    /// How many values or elements it concerns.
    pub count: usize,
    /// Why the file does not hold them.
    pub reason: String,
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "object `{}`: ", self.object)?;
        if let Some(domain) = self.domain {
            write!(f, "{domain} ")?;
        }
        write!(f, "`{}` ({}): {}", self.attribute, self.count, self.reason)
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
