//! Symmetry: how many motions of a group bring a mesh back onto itself.

use mesh::{DVec3, Mesh, VertexId};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::same::{Points, same_faces};

/// A group of motions about the origin.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Group {
    /// The 24 rotations of a cube along the axes.
    CubeRotations,
    /// The 48 motions of a cube along the axes, mirror images included.
    CubeMotions,
    /// The 8 mirror images in the three coordinate planes and their combinations.
    AxisMirrors,
}

/// A motion: the images of the three axes, and whether it is a rotation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    axes: [DVec3; 3],
    turns: bool,
}

impl Motion {
    fn apply(&self, p: DVec3) -> DVec3 {
        // Each axis goes to an axis, so that the sums are exact.
        p.x * self.axes[0] + p.y * self.axes[1] + p.z * self.axes[2]
    }
}

impl Group {
    /// The motions of the group.
    pub(super) fn motions(self) -> Vec<Motion> {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let orders = [
            [0, 1, 2],
            [1, 2, 0],
            [2, 0, 1],
            [1, 0, 2],
            [0, 2, 1],
            [2, 1, 0],
        ];
        let sign = |bits: usize, i: usize| if bits >> i & 1 == 0 { 1.0 } else { -1.0 };
        let all = orders.into_iter().flat_map(|order| {
            (0..8).map(move |bits| {
                let axes = [0, 1, 2].map(|i| sign(bits, i) * axes[order[i]]);
                Motion {
                    axes,
                    turns: axes[0].cross(axes[1]).dot(axes[2]) > 0.0,
                }
            })
        });
        match self {
            Self::CubeRotations => all.filter(|m| m.turns).collect(),
            Self::CubeMotions => all.collect(),
            Self::AxisMirrors => all.take(8).collect(),
        }
    }
}

/// Under how many of the motions every vertex comes onto a vertex within the tolerance and, if
/// `connectivity` is asked for, every face onto a face.
pub(super) fn count(mesh: &Mesh, motions: &[Motion], tolerance: f64, connectivity: bool) -> u64 {
    let points = Points::new(mesh);
    let keeps = |motion: &Motion| {
        let image = |v: VertexId| motion.apply(mesh.position(v));
        points
            .matching(mesh, image, tolerance)
            .is_some_and(|map| !connectivity || same_faces(mesh, mesh, &map, !motion.turns))
    };
    motions.iter().filter(|motion| keeps(motion)).count() as u64
}

/// Whether one of the motions brings a vertex to where no vertex is.
pub(super) fn is_alone(
    mesh: &Mesh,
    points: &Points,
    motions: &[Motion],
    v: VertexId,
    tolerance: f64,
) -> bool {
    let mut images = motions.iter().map(|motion| motion.apply(mesh.position(v)));
    images.any(|p| !points.any_near(p, tolerance))
}
