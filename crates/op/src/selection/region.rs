//! Regions of space.

use mesh::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{Length, Vector};

/// A part of space, with its surface.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Region {
    /// A box along the axes.
    Box {
        /// The corner of the lowest coordinates.
        min: Vector,
        /// The corner of the highest coordinates.
        max: Vector,
    },
    /// A ball.
    Sphere {
        /// The middle.
        center: Vector,
        /// The radius, in scene units.
        radius: Length,
    },
    /// All on one side of a plane: where (p - point) · normal >= 0.
    HalfSpace {
        /// A point of the plane.
        point: Vector,
        /// Points into the region; of any length.
        normal: Vector,
    },
}

impl Region {
    /// Whether `p` lies in the region or on its surface.
    pub fn contains(&self, p: DVec3) -> bool {
        match *self {
            Self::Box { min, max } => p.cmpge(min.into()).all() && p.cmple(max.into()).all(),
            Self::Sphere { center, radius } => {
                p.distance_squared(center.into()) <= radius.get() * radius.get()
            }
            Self::HalfSpace { point, normal } => (p - DVec3::from(point)).dot(normal.into()) >= 0.0,
        }
    }
}
