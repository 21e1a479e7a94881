//! Triangles in the picture: points on a grid of 1/256 pixel, and what of a triangle that reaches behind the
//! camera or far beyond the picture is left.
//!
//! From here on the edges of triangles are exact: two triangles with a common edge have the same two points
//! on the grid, so that each sample on it is in one of them.

use glam::DVec3;

use crate::color::narrow;
use crate::work::each;
use crate::{ScreenPoint, View};

/// Steps of the grid for a pixel, as a power of two.
pub(super) const GRID_BITS: i32 = 8;
/// Steps of the grid for a pixel.
pub(super) const GRID: i32 = 1 << GRID_BITS;
/// No point on the grid is farther from the corner of the picture, in pixels.
const FAR: f64 = 32_768.0;

/// A point in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Corner {
    /// Steps of the grid from the left and from the top.
    pub(super) at: [i32; 2],
    /// See [`ScreenPoint::depth`].
    pub(super) depth: f32,
}

/// A triangle in the picture.
pub(super) type Flat = [Corner; 3];

impl Corner {
    /// Stands for a point that is behind the camera or too far aside.
    const OUTSIDE: Self = Self {
        at: [i32::MIN; 2],
        depth: 0.0,
    };

    pub(super) fn is_outside(self) -> bool {
        self.at[0] == i32::MIN
    }

    /// The nearest point of the grid.
    fn new(seen: ScreenPoint) -> Self {
        let at = seen.at.to_array().map(|x| {
            let x = (x.clamp(-FAR, FAR) * f64::from(GRID) + 0.5).floor();
            #[expect(clippy::cast_possible_truncation, reason = "within the limits above")]
            let x = x as i32;
            x
        });
        Self {
            at,
            depth: narrow(seen.depth),
        }
    }

    fn of(view: &View, v: DVec3) -> Self {
        if v.z < view.near {
            return Self::OUTSIDE;
        }
        let seen = view.project(v);
        if seen.at.abs().max_element() <= FAR {
            Self::new(seen)
        } else {
            Self::OUTSIDE
        }
    }
}

/// Where points are seen.
pub(super) fn project(view: &View, points: &[DVec3]) -> Vec<Corner> {
    each(points.len(), |i| Corner::of(view, view.turned(points[i])))
}

/// What is left of a triangle inside the limits: a convex polygon cut into triangles.
///
/// Sutherland and Hodgman, "Reentrant Polygon Clipping", 1974. Where an edge is cut depends on its two ends
/// only, not on their order: the triangles beside it get the same point.
pub(super) fn clipped(view: &View, corners: [DVec3; 3]) -> Vec<Flat> {
    let mut polygon: Vec<DVec3> = corners.iter().map(|&p| view.turned(p)).collect();
    for side in 0..5 {
        let inside = |v: DVec3| view.inside(side, FAR, v);
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (i, &a) in polygon.iter().enumerate() {
            let b = polygon[(i + 1) % polygon.len()];
            let (da, db) = (inside(a), inside(b));
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
    let seen = polygon.iter().map(|&v| Corner::new(view.project(v)));
    let seen: Vec<Corner> = seen.collect();
    let fan = |pair: &[Corner]| [seen[0], pair[0], pair[1]];
    seen[1..].windows(2).map(fan).collect()
}
