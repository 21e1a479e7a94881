//! Attributes: named, typed columns of values on vertices, corners, edges and faces.
//!
//! The domain of a column is one of these four kinds of elements. A column has one value for each element of its
//! domain. The [`Rule`] of a column defines how edits change its values. A corner is represented by a half-edge of its
//! face: the half-edge that leaves the vertex of the corner. The value of the corner is stored at this half-edge. A
//! corner column also has values at half-edges without a face, but these values have no meaning.
//!
//! Well-known attributes have constants ([`UV`], [`VERTEX_NORMAL`], ...). Programs can also use any other name.

mod columns;
mod rig;
mod values;

use std::marker::PhantomData;

use glam::{DVec2, DVec3, DVec4};

use crate::{EdgeId, FaceId, HalfEdgeId, VertexId};

pub use columns::{Attributes, Column, Sources};
pub use rig::{
    is_morph_direction, is_rig_name, joint_name, joint_of, morph_name, morph_normal_name,
    morph_normal_of, morph_of, morph_tangent_name, morph_tangent_of, morph_value_name,
    morph_value_of, uv_set,
};
pub(crate) use values::pop_value;
pub use values::{Value, Values};

/// Texture coordinates of corners.
pub const UV: Attribute<HalfEdgeId, DVec2> = Attribute::new("uv", Rule::Interpolate);
/// Unit normals of vertices.
pub const VERTEX_NORMAL: Attribute<VertexId, DVec3> = Attribute::new("normal", Rule::Normal);
/// Unit normals of corners, which can differ between the faces around a vertex.
pub const CORNER_NORMAL: Attribute<HalfEdgeId, DVec3> = Attribute::new("normal", Rule::Normal);
/// At each vertex, a unit vector that is tangent to the surface. The direction in the tangent plane is arbitrary.
pub const TANGENT: Attribute<VertexId, DVec3> = Attribute::new("tangent", Rule::Normal);
/// Tangents at corners, which normal maps need. The first three numbers are the tangent t, a unit vector along the u
/// axis of the texture coordinates. The fourth number is a sign s, 1 or -1. If n is the normal, s (n x t) is the
/// bitangent, a vector along the v axis of the texture coordinates. The v axis points upwards in the texture.
pub const CORNER_TANGENT: Attribute<HalfEdgeId, DVec4> = Attribute::new("tangent", Rule::Drop);
/// The color of a vertex: red, green, blue and alpha, each from 0 to 1.
pub const COLOR: Attribute<VertexId, DVec4> = Attribute::new("color", Rule::Interpolate);
/// The material of a face, as an index into the object's list of materials. The first index is 0; -1 means that the
/// face has no material.
pub const MATERIAL: Attribute<FaceId, i32> = Attribute::new("material", Rule::Copy);
/// The number of the smoothing group of a face; 0 if the face is in no smoothing group.
pub const SMOOTHING: Attribute<FaceId, i32> = Attribute::new("smoothing", Rule::Copy);
/// The sharpness of an edge, from 0 (smooth) to 10 (infinitely sharp).
pub const CREASE: Attribute<EdgeId, f64> = Attribute::new("crease", Rule::Copy);
/// The sharpness of a vertex, from 0 (smooth) to 10 (infinitely sharp).
pub const VERTEX_SHARPNESS: Attribute<VertexId, f64> = Attribute::new("corner", Rule::Copy);

/// How edits and operations change the values of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// A new element gets the weighted mean of the values of its source elements. Whole numbers and tags (named
    /// selections) are not averaged: the new element gets the value of the source element with the largest weight.
    Interpolate,
    /// The values are unit vectors. New values are interpolated, then scaled to length 1. Transforms treat the vectors
    /// as normals of the surface. Subdivision drops the column, because the vectors would be wrong. Many other
    /// operations also remove normals that would be wrong; see [`Mesh::remove_normals`](crate::Mesh::remove_normals).
    Normal,
    /// A new element gets the value of the old element that contained it. If no old element contained the new element,
    /// the value of the new element is zero. For example, both parts of a split edge keep the tags of the edge; a new
    /// edge inside a face has no tags.
    Copy,
    /// The first edit that changes connectivity removes the column.
    Drop,
}

/// The name, domain, type and rule of an attribute, known at compile time.
#[derive(Debug)]
pub struct Attribute<I, T> {
    /// The name of the column.
    pub name: &'static str,
    /// How edits change the values.
    pub rule: Rule,
    kind: PhantomData<fn() -> (I, T)>,
}

impl<I, T> Attribute<I, T> {
    /// Creates an attribute with this name and rule.
    pub const fn new(name: &'static str, rule: Rule) -> Self {
        Self {
            name,
            rule,
            kind: PhantomData,
        }
    }
}

impl<I, T> Clone for Attribute<I, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<I, T> Copy for Attribute<I, T> {}
