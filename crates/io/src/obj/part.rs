//! What a part of an OBJ file holds, before it is joined with the others.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, DVec4};

use super::corner::{Corner, Counts, Index};
use super::file::{LeftOut, NONE};
use crate::text::{Place, name};

/// What a part of an OBJ file holds. Lines count from the part's first, as 1; faces, sets and names from
/// the part's first, as 0.
#[derive(Debug, Default)]
pub(super) struct Part {
    pub(super) positions: Vec<DVec3>,
    /// One for each position, or none at all.
    pub(super) colors: Vec<DVec4>,
    /// Of `#MRGB` comments: mask, red, green and blue, from the highest byte.
    pub(super) painted: Vec<u32>,
    pub(super) uvs: Vec<DVec2>,
    pub(super) normals: Vec<DVec3>,
    /// For each face how many corners there are up to its end.
    pub(super) face_ends: Vec<u32>,
    /// What the corners of faces have: vertices, and texture coordinates and normals, which are [`NONE`] where a
    /// corner has none, and empty if no corner has one.
    pub(super) corners: [Indices; 3],
    /// For each polyline how many corners there are up to its end.
    pub(super) line_ends: Vec<u32>,
    /// The vertices of the corners of polylines.
    pub(super) line_corners: Indices,
    /// What faces are said to be; the first begins with face 0 if there is a face.
    pub(super) runs: Vec<PartRun>,
    /// What holds at the end.
    pub(super) last: PartRun,
    /// As indices of `groups`.
    pub(super) group_sets: Vec<Vec<u32>>,
    pub(super) groups: Names,
    /// An empty name takes the one before back.
    pub(super) objects: Names,
    /// An empty name takes the one before back.
    pub(super) materials: Names,
    pub(super) libraries: Vec<(Place, String)>,
    /// A count and the first line.
    pub(super) left_out: BTreeMap<LeftOut, (usize, usize)>,
    /// One more than the highest absolute index of each kind.
    pub(super) highest: Counts,
    /// How far relative indices reach back beyond the beginning.
    pub(super) reach: Counts,
    /// How many lines end in this part.
    pub(super) n_lines: usize,
}

impl Part {
    /// How many of each there are.
    pub(super) fn counts(&self) -> Counts {
        [self.positions.len(), self.uvs.len(), self.normals.len()]
    }

    /// How many corners of faces there are.
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

    /// Notes what the indices of a corner need.
    #[inline]
    pub(super) fn look_at(&mut self, corner: Corner) {
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
        self.look_at(corner);
        let n = self.n_corners();
        for (column, index) in self.corners.iter_mut().zip(corner) {
            column.push_optional(n, index);
        }
    }

    /// Forgets the last corners of faces; only some of the columns `had` one before.
    pub(super) fn truncate_corners(&mut self, n: usize, had: [bool; 3]) {
        for (column, had) in self.corners.iter_mut().zip(had) {
            column.truncate(if had { n } else { 0 });
        }
    }
}

/// What the statements before a face say of it, as far as they stand in this part of the file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct PartRun {
    pub(super) first_face: usize,
    /// An index of `group_sets`.
    pub(super) groups: Option<usize>,
    /// An index of `objects`.
    pub(super) object: Option<usize>,
    /// An index of `materials`.
    pub(super) material: Option<usize>,
    pub(super) smoothing: Option<i32>,
}

/// Indices of which some count from the beginning of the part.
#[derive(Debug, Default)]
pub(super) struct Indices {
    /// Absolute indices, and relative ones modulo 2^32.
    pub(super) values: Vec<u32>,
    /// Which of `values` are relative.
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

    /// Appends to a column that stays empty until its first value; `n` values belong before it.
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

/// Different names in the order in which they come.
#[derive(Debug, Default)]
pub(super) struct Names {
    pub(super) list: Vec<String>,
    places: BTreeMap<String, usize>,
}

impl Names {
    /// The place of a name.
    pub(super) fn place(&mut self, bytes: &[u8]) -> usize {
        self.place_of(name(bytes))
    }

    /// The place of a name.
    pub(super) fn place_of(&mut self, name: String) -> usize {
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

/// As 32 bits; files with more of anything are refused.
pub(super) fn to_u32(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(NONE)
}
