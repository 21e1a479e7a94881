//! Stores the content of an OBJ file as flat arrays, in the order of the file.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, DVec4};

use crate::text::TextPosition;

/// Stands for a missing index, at corners without a texture coordinate or without a normal.
pub(super) const NONE: u32 = u32::MAX;

/// The material name that some programs use for faces without a material. The format has no statement that unsets the
/// material.
pub(super) const NO_MATERIAL: &[u8] = b"(null)";

/// The content of an OBJ file. Indices start at 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ObjFile {
    pub(super) positions: Vec<DVec3>,
    /// The color of each position. A position without a color is white; the list is empty if no position has a color.
    pub(super) colors: Vec<DVec4>,
    /// The values of `#MRGB` comments of `ZBrush`. Each value is a 32-bit number whose bytes are the mask, red, green
    /// and blue, from the highest to the lowest byte.
    pub(super) mrgb_colors: Vec<u32>,
    pub(super) uvs: Vec<DVec2>,
    pub(super) normals: Vec<DVec3>,
    /// Polygon i has the corners from `offsets[i]` up to, but not including, `offsets[i + 1]`.
    pub(super) offsets: Vec<u32>,
    /// Three lists with an index for each corner: the indices of positions, of texture coordinates, and of normals. A
    /// missing index is [`NONE`], and a list in which all indices are missing is empty.
    pub(super) corners: [Vec<u32>; 3],
    /// The offsets of the polylines in `line_corners`. Polyline i has the vertices
    /// `line_corners[line_offsets[i]..line_offsets[i + 1]]`.
    pub(super) line_offsets: Vec<u32>,
    pub(super) line_corners: Vec<u32>,
    /// The runs of consecutive faces with the same groups, object, material and smoothing group. If there are faces,
    /// the first run begins with face 0. Each run ends before the first face of the next run.
    pub(super) runs: Vec<Run>,
    /// The distinct sets of groups. Each run of faces refers to one of them. Each set contains indices into
    /// `group_names`. Set 0 is empty.
    pub(super) group_sets: Vec<Vec<u32>>,
    pub(super) group_names: Vec<String>,
    pub(super) object_names: Vec<String>,
    pub(super) material_names: Vec<String>,
    /// The text after each `mtllib`, with its position.
    pub(super) libraries: Vec<(TextPosition, String)>,
    /// For each kind of content that was left out, how often it occurs, and the first line in which it occurs.
    pub(super) left_out: BTreeMap<LeftOut, (usize, usize)>,
}

/// The groups, object, material and smoothing group of consecutive faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Run {
    pub(super) first_face: usize,
    /// An index into `group_sets`.
    pub(super) groups: usize,
    /// An index into `object_names`.
    pub(super) object: Option<usize>,
    /// An index into `material_names`.
    pub(super) material: Option<usize>,
    /// The smoothing group; 0 for none.
    pub(super) smoothing: i32,
}

/// Content that the reader leaves out or changes.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum LeftOut {
    /// Statements of the format that do not describe polygons. The field is the keyword.
    Statement(String),
    /// Words that are not a statement of the format.
    Unknown(String),
    /// Further unknown words. They are not listed by name, because there are already
    /// [`MAX_LISTED_WORDS`](super::statement::MAX_LISTED_WORDS) listed words.
    OtherUnknown,
    /// Points. Each vertex of a `p` statement counts as one point.
    Points,
    /// Faces with one or two corners.
    SmallFaces,
    /// Vertex weights (`v x y z w`) other than 1.
    Weights,
    /// Third texture coordinates (`vt u v w`) other than 0.
    Depths,
    /// Non-finite numbers in texture coordinates and normals.
    NotFinite,
}
