//! Symmetry: counts the motions (rotations and reflections) of a group that map a mesh onto itself.

use mesh::{DVec3, Mesh, VertexId};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::same::{PositionIndex, same_faces};

/// A symmetry group about the origin.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Group {
    /// The 24 rotations of an axis-aligned cube.
    CubeRotations,
    /// The 48 symmetries of an axis-aligned cube: its rotations and reflections.
    CubeMotions,
    /// The 8 combinations of the reflections in the three coordinate planes.
    AxisMirrors,
}

/// A motion of a symmetry group: the images of the three coordinate axes, and whether the motion is a rotation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    axes: [DVec3; 3],
    is_rotation: bool,
}

impl Motion {
    fn apply(&self, p: DVec3) -> DVec3 {
        // The image of each axis is an axis or the opposite of an axis. In each coordinate, only one term of the sum is
        // not 0, so the sum is exact.
        p.x * self.axes[0] + p.y * self.axes[1] + p.z * self.axes[2]
    }
}

impl Group {
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
                    is_rotation: axes[0].cross(axes[1]).dot(axes[2]) > 0.0,
                }
            })
        });
        match self {
            Self::CubeRotations => all.filter(|m| m.is_rotation).collect(),
            Self::CubeMotions => all.collect(),
            Self::AxisMirrors => all.take(8).collect(),
        }
    }
}

/// Counts the motions that map the vertices of the mesh onto themselves. The image of each vertex is matched with a
/// vertex at a distance of at most the tolerance. Each vertex is matched only once. If `connectivity` is set, each
/// motion must also map every face onto a face.
pub(super) fn count(mesh: &Mesh, motions: &[Motion], tolerance: f64, connectivity: bool) -> u64 {
    let points = PositionIndex::new(mesh);
    let keeps = |motion: &Motion| {
        let image = |v: VertexId| motion.apply(mesh.position(v));
        points
            .matching(mesh, image, tolerance)
            .is_some_and(|map| !connectivity || same_faces(mesh, mesh, &map, !motion.is_rotation))
    };
    motions.iter().filter(|motion| keeps(motion)).count() as u64
}

/// Whether one of the motions maps the vertex to a point that has no vertex within the tolerance.
pub(super) fn has_unmatched_image(
    mesh: &Mesh,
    points: &PositionIndex,
    motions: &[Motion],
    v: VertexId,
    tolerance: f64,
) -> bool {
    let mut images = motions.iter().map(|motion| motion.apply(mesh.position(v)));
    images.any(|p| !points.any_near(p, tolerance))
}
