//! The state of the parser: the text, and the elements that were parsed so far.

use std::collections::BTreeMap;

use super::corner::Limits;
use super::part::{Part, PartRun, to_u32};
use crate::text::Cursor;

/// Parses statements in order.
pub(super) struct Parser<'a> {
    pub(super) cursor: Cursor<'a>,
    pub(super) part: Part,
    pub(super) limits: Limits,
    /// The groups, object, material and smoothing group that apply to the following faces.
    pub(super) current: PartRun,
    pub(super) sets: BTreeMap<Vec<u32>, usize>,
}

impl<'a> Parser<'a> {
    pub(super) fn new(cursor: Cursor<'a>, limits: Limits) -> Self {
        Self {
            cursor,
            part: Part::default(),
            limits,
            current: PartRun::default(),
            sets: BTreeMap::new(),
        }
    }

    /// Returns a flag for each column of corner indices: true if the column has entries. The columns are positions,
    /// texture coordinates and normals.
    pub(super) fn columns(&self) -> [bool; 3] {
        self.part.corners.each_ref().map(|column| column.len() > 0)
    }

    /// Adds a face with all corners that were added since the last face.
    pub(super) fn end_face(&mut self) {
        let run = PartRun {
            first_face: self.part.face_ends.len(),
            ..self.current
        };
        self.part.face_ends.push(to_u32(self.part.n_corners()));
        let differs = |last: &PartRun| {
            run != PartRun {
                first_face: run.first_face,
                ..*last
            }
        };
        if self.part.runs.last().is_none_or(differs) {
            self.part.runs.push(run);
        }
    }
}
