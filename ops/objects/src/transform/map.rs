//! The affine transform that the parameters of `Transform` define, for points and normals.

use glam::{DAffine3, DMat3, DVec3};
use op::Turn;

/// The transform p -> L (p - center) + center + shift, where L scales and then rotates. The methods take `center` as an
/// argument.
pub(crate) struct Map {
    linear: DMat3,
    turns: DMat3,
    scale: DVec3,
    shift: DVec3,
}

impl Map {
    /// Creates the transform that scales by `scale`, then rotates by `rotate`, and then moves by `shift`.
    pub(crate) fn new(scale: DVec3, rotate: &[Turn], shift: DVec3) -> Self {
        let turns = Turn::all(rotate);
        Self {
            linear: turns * DMat3::from_diagonal(scale),
            turns,
            scale,
            shift,
        }
    }

    /// Transforms a point.
    pub(crate) fn point(&self, p: DVec3, center: DVec3) -> DVec3 {
        if self.only_moves() {
            // If the transform neither scales nor rotates, p + shift avoids the rounding error of p - center + center.
            return p + self.shift;
        }
        self.linear * (p - center) + center + self.shift
    }

    /// Transforms the vector between two points.
    pub(crate) fn vector(&self, v: DVec3) -> DVec3 {
        self.linear * v
    }

    /// Transforms a unit normal. A zero vector stays zero. If the transform contains a mirror, the normal is negated,
    /// because a mirror turns the faces over. The mesh is reversed afterwards, which negates the normal again.
    ///
    /// Normals are transformed by the inverse transpose of R S, which is R S^-1 (Turkowski, "Properties of
    /// Surface-Normal Transformations", 1990). Only the direction of the result matters. S^-1 is therefore multiplied
    /// by a number: the smallest absolute scale factor of the axes along which the coordinate of the normal is not 0.
    /// Because of this factor, no coordinate of the result overflows, and at least one coordinate does not underflow.
    pub(crate) fn normal(&self, n: DVec3) -> DVec3 {
        let zero = n.cmpeq(DVec3::ZERO);
        if zero.all() {
            return DVec3::ZERO;
        }
        let smallest = DVec3::select(zero, DVec3::INFINITY, self.scale.abs()).min_element();
        let smallest = if self.mirrors() { -smallest } else { smallest };
        let inverse = DVec3::select(zero, DVec3::ZERO, smallest / self.scale);
        let image = self.turns * (n * inverse);
        (image / image.abs().max_element()).normalize()
    }

    /// Returns the affine transform that scales and rotates about the point `center`.
    pub(crate) fn affine(&self, center: DVec3) -> DAffine3 {
        DAffine3 {
            matrix3: self.linear,
            translation: self.point(DVec3::ZERO, center),
        }
    }

    /// Returns the linear part of the transform.
    pub(crate) fn linear(&self) -> &DMat3 {
        &self.linear
    }

    /// Whether the transform only moves points, without scaling and rotation.
    pub(crate) fn only_moves(&self) -> bool {
        self.linear == DMat3::IDENTITY
    }

    /// Whether the transform reverses orientation.
    pub(crate) fn mirrors(&self) -> bool {
        let DVec3 { x, y, z } = self.scale;
        (x < 0.0) ^ (y < 0.0) ^ (z < 0.0)
    }

    /// Transforms the plane z = 0, and returns its new z coordinate; `None` if this coordinate is not constant.
    pub(crate) fn height_of_plane(&self, center: DVec3) -> Option<f64> {
        let level = self.linear.x_axis.z == 0.0 && self.linear.y_axis.z == 0.0;
        level.then(|| self.point(DVec3::new(center.x, center.y, 0.0), center).z)
    }
}
