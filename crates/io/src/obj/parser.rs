//! What reading statements needs: the text, and what was found in it.

use std::collections::BTreeMap;

use super::corner::Limits;
use super::part::{Part, PartRun, to_u32};
use crate::text::Cursor;

/// Reads statements one after the other.
pub(super) struct Parser<'a> {
    pub(super) cursor: Cursor<'a>,
    pub(super) part: Part,
    pub(super) limits: Limits,
    /// What was said last, for the faces that follow.
    pub(super) now: PartRun,
    pub(super) sets: BTreeMap<Vec<u32>, usize>,
}

impl<'a> Parser<'a> {
    pub(super) fn new(cursor: Cursor<'a>, limits: Limits) -> Self {
        Self {
            cursor,
            part: Part::default(),
            limits,
            now: PartRun::default(),
            sets: BTreeMap::new(),
        }
    }

    /// Whether any corner so far has a position, texture coordinates, and a normal.
    pub(super) fn columns(&self) -> [bool; 3] {
        self.part.corners.each_ref().map(|column| column.len() > 0)
    }

    /// Makes a face of the last corners.
    pub(super) fn end_face(&mut self) {
        let run = PartRun {
            first_face: self.part.face_ends.len(),
            ..self.now
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
