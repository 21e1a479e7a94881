//! The map that the parameters describe: where points and normals go.

use glam::{DMat3, DVec3};
use op::Turn;

use crate::transform::Transform;

/// p -> L (p - center) + center + shift, where L scales and then turns.
pub(crate) struct Map {
    linear: DMat3,
    turns: DMat3,
    scale: DVec3,
    shift: DVec3,
}

impl Map {
    /// The map of parameters.
    pub(crate) fn new(transform: &Transform) -> Self {
        let scale = transform.scale.get();
        let turns = Turn::all(&transform.rotate);
        Self {
            linear: turns * DMat3::from_diagonal(scale),
            turns,
            scale,
            shift: transform.translate.into(),
        }
    }

    /// Where a point goes.
    pub(crate) fn point(&self, p: DVec3, center: DVec3) -> DVec3 {
        if self.only_moves() {
            // Without the rounding of p - center + center.
            return p + self.shift;
        }
        self.linear * (p - center) + center + self.shift
    }

    /// Where a unit normal goes: zero stays zero. A mirror turns it over, as it does the faces;
    /// reversing them afterwards turns both back.
    ///
    /// By the inverse transpose of R S, which is R S^-1 (Turkowski, "Properties of Surface-Normal
    /// Transformations", 1990). Only the direction counts: the smallest factor that matters
    /// multiplies S^-1, so that nothing overflows and not everything underflows.
    pub(crate) fn normal(&self, n: DVec3) -> DVec3 {
        let zero = n.cmpeq(DVec3::ZERO);
        if zero.all() {
            return DVec3::ZERO;
        }
        let smallest = DVec3::select(zero, DVec3::INFINITY, self.scale.abs()).min_element();
        let smallest = if self.mirrors() { -smallest } else { smallest };
        let inverse = DVec3::select(zero, DVec3::ZERO, smallest / self.scale);
        let turned = self.turns * (n * inverse);
        (turned / turned.abs().max_element()).normalize()
    }

    /// Whether points are neither scaled nor turned.
    pub(crate) fn only_moves(&self) -> bool {
        self.linear == DMat3::IDENTITY
    }

    /// Whether left and right are exchanged.
    pub(crate) fn mirrors(&self) -> bool {
        let DVec3 { x, y, z } = self.scale;
        (x < 0.0) ^ (y < 0.0) ^ (z < 0.0)
    }

    /// The z coordinate of all points of the plane z = 0 afterwards, or `None` if they differ.
    pub(crate) fn height_of_plane(&self, center: DVec3) -> Option<f64> {
        let level = self.linear.x_axis.z == 0.0 && self.linear.y_axis.z == 0.0;
        level.then(|| self.point(DVec3::new(center.x, center.y, 0.0), center).z)
    }
}
