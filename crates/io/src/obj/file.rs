//! What an OBJ file holds, as flat arrays: everything in file order, nothing merged or split.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, DVec4};

use crate::text::Place;

/// The index of a corner that has no texture coordinate or no normal.
pub(super) const NONE: u32 = u32::MAX;

/// The name by which programs say that the faces that follow have no material: the format has no
/// other way to take one back.
pub(super) const NO_MATERIAL: &[u8] = b"(null)";

/// What an OBJ file holds. Indices count from 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ObjFile {
    pub(super) positions: Vec<DVec3>,
    /// One for each position, or none at all. A vertex without one is white.
    pub(super) colors: Vec<DVec4>,
    /// What `ZBrush` says of vertices in comments: mask, red, green and blue, from the highest byte.
    pub(super) painted: Vec<u32>,
    pub(super) uvs: Vec<DVec2>,
    pub(super) normals: Vec<DVec3>,
    /// Polygon i has the corners from `offsets[i]` to `offsets[i + 1]`.
    pub(super) offsets: Vec<u32>,
    /// The positions, texture coordinates and normals of corners: [`NONE`] where a corner has none; empty if no
    /// corner has one.
    pub(super) corners: [Vec<u32>; 3],
    /// Polylines: line i visits the vertices `line_corners[line_offsets[i]..line_offsets[i + 1]]`.
    pub(super) line_offsets: Vec<u32>,
    pub(super) line_corners: Vec<u32>,
    /// What groups, object, material and smoothing the faces have: a run lasts to the next one's
    /// first face. Empty, or the first begins with face 0.
    pub(super) runs: Vec<Run>,
    /// The sets of groups that runs refer to, as indices of `group_names`. Set 0 is empty.
    pub(super) group_sets: Vec<Vec<u32>>,
    pub(super) group_names: Vec<String>,
    pub(super) object_names: Vec<String>,
    pub(super) material_names: Vec<String>,
    /// The words after `mtllib`, each line's as one, with their places.
    pub(super) libraries: Vec<(Place, String)>,
    /// What was left out: a count and the first line.
    pub(super) left_out: BTreeMap<LeftOut, (usize, usize)>,
}

/// What the statements before a face say of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Run {
    pub(super) first_face: usize,
    /// An index of `group_sets`.
    pub(super) groups: usize,
    /// An index of `object_names`.
    pub(super) object: Option<usize>,
    /// An index of `material_names`.
    pub(super) material: Option<usize>,
    /// The smoothing group, 0 for none.
    pub(super) smoothing: i32,
}

/// What the reader does not take.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum LeftOut {
    /// Statements of the format that are not about polygons, by keyword.
    Statement(String),
    /// Words that are no statement.
    Unknown(String),
    /// Unknown words beyond the first few different ones.
    OtherUnknown,
    /// Points (`p`), counted by vertex.
    Points,
    /// Faces of one or two corners.
    SmallFaces,
    /// Weights of vertices (`v x y z w`) other than 1.
    Weights,
    /// Third coordinates of textures (`vt u v w`) other than 0.
    Depths,
    /// Numbers of texture coordinates and normals that are not finite.
    NotFinite,
}
