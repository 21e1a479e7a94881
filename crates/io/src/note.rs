//! Describes notes. A note reports content that reading changed or left out. All of this content is reported, except
//! comments and headers.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::{Path, PathBuf};

use glam::DVec3;
use mesh::{Elements, VertexId};

/// Content of a file that a reader changed or left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// The name of the kind of note, such as `faces-reversed`. This name is stable, so programs can rely on it.
    pub code: &'static str,
    /// Whether the content is missing from the scene, or is present in a different form.
    pub kind: NoteKind,
    /// The file that the note is about: the requested file or a file that it refers to.
    pub path: PathBuf,
    /// The first line that the note is about, counted from 1. `None` if the file is not a text file or the line is not
    /// known.
    pub line: Option<usize>,
    /// The number of elements, statements or other things that the note is about.
    pub count: usize,
    /// The text that follows the count, such as `statements 'vp' left out`. It names the counted elements, statements
    /// or other things, and says how the reader handled them. The text is in the plural if the count can exceed 1. If
    /// the count is 1, [`Display`](fmt::Display) writes the first noun in the singular.
    pub what: String,
    /// The affected elements of the file, if they are known.
    pub elements: Option<Elements>,
    /// The positions of the first affected elements, in scene units. Each entry lists the points of an element: one
    /// point for a vertex, both ends for an edge, and the corners in order for a face. At most
    /// [`MAX_PLACES`](Self::MAX_PLACES) entries.
    pub places: Vec<Vec<DVec3>>,
}

impl Note {
    /// The largest number of elements whose positions are stored.
    pub const MAX_PLACES: usize = 10_000;
}

/// Polygons, from which the positions of vertices, edges and faces are computed.
#[derive(Clone, Copy)]
pub(crate) struct PolygonArrays<'a> {
    /// The position of each vertex.
    pub(crate) positions: &'a [DVec3],
    /// For each polygon, the index of its first corner, followed by the total number of corners.
    pub(crate) offsets: &'a [u32],
    /// The vertex of each corner.
    pub(crate) corners: &'a [u32],
}

impl PolygonArrays<'_> {
    /// Returns the positions of `elements` in the form in which [`Note::places`] stores them.
    pub(crate) fn places(&self, elements: &Elements) -> Vec<Vec<DVec3>> {
        let at = |v: usize| self.positions.get(v).copied();
        let vertex = |v: VertexId| at(v.index());
        let face = |f: usize| {
            let (first, end) = (*self.offsets.get(f)?, *self.offsets.get(f + 1)?);
            let corners = self.corners.get(first as usize..end as usize)?.iter();
            corners.map(|&v| at(v as usize)).collect()
        };
        let most = Note::MAX_PLACES;
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

/// The kind of content that a [`Note`] reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NoteKind {
    /// The file has content that the scene does not have.
    LeftOut,
    /// The scene has the content in a different form than the file.
    Changed,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.path.display())?;
        if let Some(line) = self.line {
            write!(f, "{line}:")?;
        }
        match self.count {
            1 => write!(f, " 1 {}", singular(&self.what))?,
            n => write!(f, " {n} {}", self.what)?,
        }
        if let Some(elements) = &self.elements {
            write!(f, " {elements}")?;
        }
        Ok(())
    }
}

/// The plural nouns that [`singular`] converts if they are among the first words of a note.
const NOUNS: [&str; 62] = [
    "animations",
    "attributes",
    "bytes",
    "cameras",
    "channels",
    "colors",
    "coordinates",
    "corners",
    "edges",
    "effects",
    "elements",
    "faces",
    "facets",
    "fields",
    "files",
    "geometries",
    "groups",
    "holes",
    "images",
    "inputs",
    "instances",
    "joints",
    "lights",
    "lines",
    "links",
    "lists",
    "masks",
    "materials",
    "members",
    "meshes",
    "names",
    "nodes",
    "normals",
    "notes",
    "numbers",
    "objects",
    "parameters",
    "parts",
    "points",
    "polygons",
    "polylines",
    "primitives",
    "profiles",
    "references",
    "rows",
    "samplers",
    "scenes",
    "sets",
    "skews",
    "skins",
    "morphs",
    "solids",
    "statements",
    "strips",
    "targets",
    "textures",
    "transforms",
    "triangles",
    "uses",
    "values",
    "vertices",
    "weights",
];

/// Converts the text of a note from the plural to the singular, for example `meshes left out` to `mesh left out`. The
/// text is unchanged if none of its first three words is one of the [`NOUNS`].
fn singular(what: &str) -> String {
    let mut words: Vec<String> = what.split(' ').map(str::to_owned).collect();
    let is_noun = |word: &String| NOUNS.contains(&word.as_str());
    // Up to two words can precede the noun, for example in `third texture coordinates`.
    let Some(first) = words.iter().take(3).position(is_noun) else {
        return what.to_owned();
    };
    words[first] = singular_noun(&words[first]);
    if words.get(first + 1).is_some_and(|word| word == "and")
        && words.get(first + 2).is_some_and(is_noun)
    {
        "or".clone_into(&mut words[first + 1]);
        words[first + 2] = singular_noun(&words[first + 2]);
    }
    let text = words.join(" ");
    let verbs = [
        ("that visit ", "that visits "),
        ("that repeat ", "that repeats "),
        ("that point ", "that points "),
        ("because they are ", "because it is "),
        ("because they have ", "because it has "),
        ("because they point ", "because it points "),
        ("because they visit ", "because it visits "),
        (": they have ", ": it has "),
        ("in their rest pose", "in its rest pose"),
    ];
    verbs
        .iter()
        .fold(text, |text, (many, one)| text.replace(many, one))
}

/// Returns the singular of one of the [`NOUNS`].
fn singular_noun(plural: &str) -> String {
    match plural {
        "geometries" => "geometry".to_owned(),
        "meshes" => "mesh".to_owned(),
        "vertices" => "vertex".to_owned(),
        regular => regular.trim_end_matches('s').to_owned(),
    }
}

/// The maximum number of notes in the list. Further notes are counted but not listed, because a large file can cause
/// millions of notes.
const MAX_LISTED: usize = 1000;

/// Collects the notes about one file while it is read.
#[derive(Debug)]
pub(crate) struct Notes {
    path: PathBuf,
    list: Vec<Note>,
    /// For each kind of note, the number of notes that are counted but not listed.
    unlisted: BTreeMap<NoteKind, usize>,
}

impl Notes {
    pub(crate) fn of(path: &Path) -> Self {
        Self {
            path: path.to_path_buf(),
            list: Vec::new(),
            unlisted: BTreeMap::new(),
        }
    }

    /// Adds a note about content that is left out, unless `count` is 0.
    pub(crate) fn left_out(
        &mut self,
        code: &'static str,
        count: usize,
        line: impl Into<Option<usize>>,
        what: impl Into<String>,
    ) {
        self.add(code, NoteKind::LeftOut, count, line.into(), what.into());
    }

    /// Adds a note about content that is changed, unless `count` is 0.
    pub(crate) fn changed(
        &mut self,
        code: &'static str,
        count: usize,
        line: impl Into<Option<usize>>,
        what: impl Into<String>,
    ) {
        self.add(code, NoteKind::Changed, count, line.into(), what.into());
    }

    /// Adds a note about these elements and their positions. Adds nothing if there are no elements.
    pub(crate) fn elements(
        &mut self,
        code: &'static str,
        kind: NoteKind,
        what: impl Into<String>,
        elements: Elements,
        places: Vec<Vec<DVec3>>,
    ) {
        let note = self.note(code, kind, elements.len(), None, what.into());
        self.push(Note {
            elements: Some(elements),
            places,
            ..note
        });
    }

    /// Adds a note, unless `count` is 0.
    pub(crate) fn add(
        &mut self,
        code: &'static str,
        kind: NoteKind,
        count: usize,
        line: Option<usize>,
        what: String,
    ) {
        let note = self.note(code, kind, count, line, what);
        self.push(note);
    }

    fn note(
        &self,
        code: &'static str,
        kind: NoteKind,
        count: usize,
        line: Option<usize>,
        what: String,
    ) -> Note {
        Note {
            code,
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
        if self.list.len() < MAX_LISTED {
            self.list.push(note);
        } else {
            *self.unlisted.entry(note.kind).or_default() += 1;
        }
    }

    /// Adds the notes about a file that this file refers to, such as a material library.
    pub(crate) fn append(&mut self, other: Self) {
        for note in other.list {
            self.push(note);
        }
        for (kind, count) in other.unlisted {
            *self.unlisted.entry(kind).or_default() += count;
        }
    }

    pub(crate) fn into_vec(mut self) -> Vec<Note> {
        for (kind, count) in std::mem::take(&mut self.unlisted) {
            let (code, what) = match kind {
                NoteKind::LeftOut => ("left-out", "more notes about content left out"),
                NoteKind::Changed => ("changed", "more notes about changed content"),
            };
            let note = self.note(code, kind, count, None, what.to_owned());
            self.list.push(note);
        }
        self.list
    }
}

/// Makes names unique.
#[derive(Default)]
pub(crate) struct Names {
    taken: BTreeSet<String>,
    /// For each name, the number that was appended to it last.
    last: BTreeMap<String, usize>,
}

impl Names {
    /// Returns `name` if it is unused. Otherwise, tries `name.2`, `name.3` and so on, returns the first of these names
    /// that is unused, and adds a note.
    pub(crate) fn unique(&mut self, name: &str, notes: &mut Notes) -> String {
        let mut new = name.to_owned();
        while !self.taken.insert(new.clone()) {
            let last = self.last.entry(name.to_owned()).or_insert(1);
            *last += 1;
            new = format!("{name}.{last}");
        }
        let what = format!(
            "node named `{name}` renamed to `{new}`, because another node is named `{name}`"
        );
        let renamed = usize::from(new != name);
        notes.changed("objects-renamed", renamed, None, what);
        new
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_thing_is_in_the_singular() {
        for (many, one) in [
            (
                "meshes left out: not used by any node",
                "mesh left out: not used by any node",
            ),
            (
                "third texture coordinates left out",
                "third texture coordinate left out",
            ),
            ("lines and points left out", "line or point left out"),
            ("physics elements left out", "physics element left out"),
            ("animation channels left out", "animation channel left out"),
            ("members `extras` left out", "member `extras` left out"),
            (
                "facet normals recomputed because they point away from the front of the facet",
                "facet normal recomputed because it points away from the front of the facet",
            ),
            (
                "uses of the extension \"a uses\" left out",
                "use of the extension \"a uses\" left out",
            ),
            ("node named `values` renamed", "node named `values` renamed"),
        ] {
            assert_eq!(singular(many), one);
        }
    }

    #[test]
    fn many_notes_are_counted_instead_of_listed() {
        let mut notes = Notes::of(Path::new("a"));
        for i in 0..1500 {
            notes.left_out("a", 2, i, "things left out");
            notes.changed("b", 1, None, "things changed");
        }
        let mut all = Notes::of(Path::new("b"));
        all.append(notes);
        let list = all.into_vec();
        assert_eq!(list.len(), 1002);
        let [left_out, changed] = [&list[1000], &list[1001]].map(ToString::to_string);
        assert_eq!(left_out, "b: 1000 more notes about content left out");
        assert_eq!(changed, "b: 1000 more notes about changed content");
    }
}
