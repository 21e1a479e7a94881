//! Projects points to a grid of 1/256 pixel, and clips triangles that reach behind the camera or far outside of the
//! picture.
//!
//! After the projection, computations with the edges of triangles are exact. If two triangles have a common edge, the
//! ends of the edge are the same two grid points in both triangles. Therefore each sample on a common edge is in
//! exactly one of the two triangles, if the triangles are on different sides of the edge.

use glam::DVec3;

use crate::color::narrow;
use crate::work::map_indices;
use crate::{ScreenPoint, View};

/// The base-2 logarithm of [`GRID`].
pub(super) const GRID_BITS: i32 = 8;
/// Grid steps per pixel.
pub(super) const GRID: i32 = 1 << GRID_BITS;
/// The maximum distance of a grid point from the upper left corner of the picture, in pixels along each axis.
const FAR: f64 = 32_768.0;

/// A point of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct GridPoint {
    /// The distances from the left and the top of the picture, in grid steps.
    pub(super) at: [i32; 2],
    /// See [`ScreenPoint::depth`].
    pub(super) depth: f32,
}

/// A triangle, projected to the picture.
pub(super) type ProjectedTriangle = [GridPoint; 3];

impl GridPoint {
    /// The value for a point that is behind the camera or too far outside of the picture.
    const OUTSIDE: Self = Self {
        at: [i32::MIN; 2],
        depth: 0.0,
    };

    pub(super) fn is_outside(self) -> bool {
        self.at[0] == i32::MIN
    }

    /// Rounds to the nearest grid point.
    fn new(point: ScreenPoint) -> Self {
        let at = point.at.to_array().map(|x| {
            let x = (x.clamp(-FAR, FAR) * f64::from(GRID) + 0.5).floor();
            #[expect(
                clippy::cast_possible_truncation,
                reason = "the number is clamped above"
            )]
            let x = x as i32;
            x
        });
        Self {
            at,
            depth: narrow(point.depth),
        }
    }

    /// Projects a point in camera coordinates.
    pub(super) fn projected(view: &View, v: DVec3) -> Self {
        if v.z < view.near {
            return Self::OUTSIDE;
        }
        let point = view.project(v);
        if point.at.abs().max_element() <= FAR {
            Self::new(point)
        } else {
            Self::OUTSIDE
        }
    }
}

/// Projects points.
pub(super) fn project(view: &View, points: &[DVec3]) -> Vec<GridPoint> {
    map_indices(points.len(), |i| {
        GridPoint::projected(view, view.camera_space(points[i]))
    })
}

/// Clips a triangle, and divides the resulting convex polygon into triangles.
///
/// Sutherland and Hodgman, "Reentrant Polygon Clipping", 1974. The point where an edge is cut does not depend on the
/// order of the ends of the edge. Therefore both triangles beside the edge get the same point.
pub(super) fn clipped(view: &View, corners: [DVec3; 3]) -> Vec<ProjectedTriangle> {
    let mut polygon: Vec<DVec3> = corners.iter().map(|&p| view.camera_space(p)).collect();
    for plane in 0..5 {
        let clip_distance = |v: DVec3| view.clip_distance(plane, FAR, v);
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (i, &a) in polygon.iter().enumerate() {
            let b = polygon[(i + 1) % polygon.len()];
            let (da, db) = (clip_distance(a), clip_distance(b));
            if da >= 0.0 {
                kept.push(a);
            }
            if (da >= 0.0) != (db >= 0.0) {
                let [(p, dp), (q, dq)] = if da >= 0.0 {
                    [(a, da), (b, db)]
                } else {
                    [(b, db), (a, da)]
                };
                kept.push(p + (q - p) * (dp / (dp - dq)));
            }
        }
        polygon = kept;
        if polygon.len() < 3 {
            return Vec::new();
        }
    }
    let points = polygon.iter().map(|&v| GridPoint::new(view.project(v)));
    let points: Vec<GridPoint> = points.collect();
    let fan = |pair: &[GridPoint]| [points[0], pair[0], pair[1]];
    points[1..].windows(2).map(fan).collect()
}
