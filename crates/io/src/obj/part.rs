//! The content of a part of an OBJ file. The parts of a file are parsed in parallel and then joined.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, DVec4};

use super::corner::{Corner, Counts, Index};
use super::file::{LeftOut, NONE};
use crate::text::{TextPosition, name};

/// The content of a part of an OBJ file. Line numbers start at 1 at the beginning of the part, and indices of faces,
/// sets and names start at 0.
#[derive(Debug, Default)]
pub(super) struct Part {
    pub(super) positions: Vec<DVec3>,
    /// The color of each position; the list is empty if no position of this part has a color.
    pub(super) colors: Vec<DVec4>,
    /// The values of `#MRGB` comments. Each value is a 32-bit number whose bytes are the mask, red, green and blue,
    /// from the highest to the lowest byte.
    pub(super) mrgb_colors: Vec<u32>,
    pub(super) uvs: Vec<DVec2>,
    pub(super) normals: Vec<DVec3>,
    /// For each face, the index after its last corner in the lists of `corners`.
    pub(super) face_ends: Vec<u32>,
    /// Three lists: the indices of the positions, of the texture coordinates and of the normals of the corners. A
    /// missing index is [`NONE`], and a list in which all indices are missing is empty.
    pub(super) corners: [Indices; 3],
    /// For each polyline, the index after its last corner in `line_corners`.
    pub(super) line_ends: Vec<u32>,
    /// The vertices of the corners of polylines.
    pub(super) line_corners: Indices,
    /// The groups, object, material and smoothing group of each run of consecutive faces. If the part has faces, the
    /// first run begins with face 0.
    pub(super) runs: Vec<PartRun>,
    /// The groups, object, material and smoothing group after the last statement.
    pub(super) last: PartRun,
    /// Sets of indices into `groups`.
    pub(super) group_sets: Vec<Vec<u32>>,
    pub(super) groups: Names,
    /// The names of objects. An `o` statement with an empty name means that the following faces have no object.
    pub(super) objects: Names,
    /// The names of materials. A `usemtl` statement with an empty name means that the following faces have no material.
    pub(super) materials: Names,
    pub(super) libraries: Vec<(TextPosition, String)>,
    /// For each kind of content that was left out, how often it occurs, and the first line in which it occurs.
    pub(super) left_out: BTreeMap<LeftOut, (usize, usize)>,
    /// The absolute indices of this part are valid if the file defines at least this many positions, texture
    /// coordinates and normals.
    pub(super) highest: Counts,
    /// The relative indices of this part are valid if earlier parts define at least this many positions, texture
    /// coordinates and normals.
    pub(super) reach: Counts,
    /// The number of lines that end in this part.
    pub(super) n_lines: usize,
}

impl Part {
    /// Returns how many positions, texture coordinates and normals the part defines.
    pub(super) fn counts(&self) -> Counts {
        [self.positions.len(), self.uvs.len(), self.normals.len()]
    }

    /// The number of corners of all faces.
    pub(super) fn n_corners(&self) -> usize {
        self.corners[0].len()
    }

    pub(super) fn add_vertex(&mut self, position: DVec3, color: Option<DVec4>) {
        if color.is_some() && self.colors.is_empty() {
            self.colors.resize(self.positions.len(), DVec4::ONE);
        }
        if color.is_some() || !self.colors.is_empty() {
            self.colors.push(color.unwrap_or(DVec4::ONE));
        }
        self.positions.push(position);
    }

    /// Updates `highest` and `reach` for the indices of a corner.
    #[inline]
    pub(super) fn record_indices(&mut self, corner: Corner) {
        for (k, index) in corner.into_iter().enumerate() {
            match index {
                None => {}
                Some(Index::Absolute(index)) => {
                    self.highest[k] = self.highest[k].max(index as usize + 1);
                }
                Some(Index::Relative(index)) => {
                    let back = usize::try_from(-index).unwrap_or(0);
                    self.reach[k] = self.reach[k].max(back);
                }
            }
        }
    }

    /// Adds a corner of a face.
    #[inline]
    pub(super) fn push_corner(&mut self, corner: Corner) {
        self.record_indices(corner);
        let n = self.n_corners();
        for (column, index) in self.corners.iter_mut().zip(corner) {
            column.push_optional(n, index);
        }
    }

    /// Keeps the first `n` face corners and removes the others. The columns are positions, texture coordinates and
    /// normals. The flags in `had` are false for columns that were empty before the removed corners were added. These
    /// columns become empty again.
    pub(super) fn truncate_corners(&mut self, n: usize, had: [bool; 3]) {
        for (column, had) in self.corners.iter_mut().zip(had) {
            column.truncate(if had { n } else { 0 });
        }
    }
}

/// The groups, object, material and smoothing group of consecutive faces. A field is `None` if no earlier statement of
/// this part sets it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct PartRun {
    pub(super) first_face: usize,
    /// An index into `group_sets`.
    pub(super) groups: Option<usize>,
    /// An index into `objects`.
    pub(super) object: Option<usize>,
    /// An index into `materials`.
    pub(super) material: Option<usize>,
    pub(super) smoothing: Option<i32>,
}

/// A list of indices, some of which are relative to the beginning of the part.
#[derive(Debug, Default)]
pub(super) struct Indices {
    /// The absolute and the relative indices. Negative relative indices are stored modulo 2^32.
    pub(super) values: Vec<u32>,
    /// The positions of the relative indices in `values`.
    pub(super) relative: Vec<u32>,
}

impl Indices {
    pub(super) fn len(&self) -> usize {
        self.values.len()
    }

    #[inline]
    pub(super) fn push(&mut self, index: Index) {
        match index {
            Index::Absolute(index) => self.values.push(index),
            Index::Relative(index) => {
                self.relative.push(to_u32(self.values.len()));
                let low = index & i64::from(u32::MAX);
                self.values.push(u32::try_from(low).unwrap_or(NONE));
            }
        }
    }

    /// Appends an index to a column that stays empty until its first index. When the first index is appended, `n`
    /// missing indices are inserted before it.
    #[inline]
    pub(super) fn push_optional(&mut self, n: usize, index: Option<Index>) {
        match index {
            Some(index) => {
                if self.values.is_empty() {
                    self.values.resize(n, NONE);
                }
                self.push(index);
            }
            None if self.values.is_empty() => {}
            None => self.values.push(NONE),
        }
    }

    fn truncate(&mut self, n: usize) {
        self.values.truncate(n);
        while self.relative.last().is_some_and(|&at| at as usize >= n) {
            self.relative.pop();
        }
    }
}

/// Unique names in order of first occurrence.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Names {
    pub(super) list: Vec<String>,
    places: BTreeMap<String, usize>,
}

impl Names {
    /// Returns the index of a name. Adds the name if it is new.
    pub(super) fn index_of_bytes(&mut self, bytes: &[u8]) -> usize {
        self.index_of(name(bytes))
    }

    /// Returns the index of a name. Adds the name if it is new.
    pub(super) fn index_of(&mut self, name: String) -> usize {
        let next = self.list.len();
        match self.places.entry(name) {
            std::collections::btree_map::Entry::Occupied(known) => *known.get(),
            std::collections::btree_map::Entry::Vacant(new) => {
                self.list.push(new.key().clone());
                new.insert(next);
                next
            }
        }
    }
}

/// Converts a count to 32 bits. Files with counts that do not fit in 32 bits are refused elsewhere.
pub(super) fn to_u32(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(NONE)
}
