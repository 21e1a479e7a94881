//! Regions of space.

use mesh::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{Length, Vector};

/// A region of space, including its surface.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Region {
    /// An axis-aligned box.
    Box {
        /// The corner with the lowest coordinates.
        min: Vector,
        /// The corner with the highest coordinates.
        max: Vector,
    },
    /// A ball.
    Sphere {
        /// The center.
        center: Vector,
        /// The radius, in scene units.
        radius: Length,
    },
    /// One side of a plane: all points p with (p - point) · normal >= 0.
    HalfSpace {
        /// A point on the plane.
        point: Vector,
        /// The normal of the plane, which points into the region. The length of the normal does not matter.
        normal: Vector,
    },
}

impl Region {
    /// Whether the point `p` is in the region or on its surface.
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
