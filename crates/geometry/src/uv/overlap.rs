//! Finds overlaps in the texture.

use std::ops::ControlFlow;

use mesh::{DVec2, FaceId, Mesh};
use progress::{Cancelled, Progress};

use crate::tangent::triangles;

/// The total area of the bounding boxes of some triangles is divided by the total area of the triangles. If the
/// quotient is above this number, most of the triangles are thin and oblique.
const MAX_BOXES: f64 = 16.0;

/// Returns a rotation, as a complex number. It makes the long sides of thin triangles vertical, so that the bounding
/// boxes of the triangles are small. To rotate a point, write it as a complex number and multiply it by the rotation.
/// Returns 1 if the bounding boxes are already small.
pub(super) fn upright(triangles: impl Iterator<Item = [DVec2; 3]>) -> DVec2 {
    let (mut boxes, mut areas, mut squares) = (0.0, 0.0, DVec2::ZERO);
    for [a, b, c] in triangles {
        let size = a.max(b).max(c) - a.min(b).min(c);
        boxes += size.x * size.y;
        areas += (b - a).perp_dot(c - a).abs() / 2.0;
        // The sides are squared as complex numbers. A vector and its opposite have the same square, so it does not
        // matter at which end a side starts.
        squares += [b - a, c - b, a - c]
            .iter()
            .map(|d| d.rotate(*d))
            .sum::<DVec2>();
    }
    if boxes.is_finite() && boxes > MAX_BOXES * areas {
        // The mean direction of the sides is the square root of the sum of their squares (as complex numbers).
        let square = squares.normalize_or(DVec2::X);
        let (cos, sin) = (
            f64::midpoint(1.0, square.x).sqrt(),
            f64::midpoint(1.0, -square.x).sqrt(),
        );
        DVec2::new(sin.copysign(square.y), cos)
    } else {
        DVec2::X
    }
}

/// A triangle in the texture, with its corners in counter-clockwise order. `low` and `high` are the corners of its
/// bounding box. The function `rotate` replaces this box by the bounding box of the rotated triangle.
pub(super) struct Flat {
    corners: [DVec2; 3],
    low: DVec2,
    high: DVec2,
    face: FaceId,
}

impl Flat {
    /// Returns `None` for a triangle with zero area.
    pub(super) fn new([a, b, c]: [DVec2; 3], face: FaceId) -> Option<Self> {
        let area = (b - a).perp_dot(c - a);
        (area != 0.0).then(|| Self {
            corners: if area > 0.0 { [a, b, c] } else { [a, c, b] },
            low: a.min(b).min(c),
            high: a.max(b).max(c),
            face,
        })
    }

    /// Computes the bounding box of the rotated triangle.
    fn rotate(&mut self, turn: DVec2) {
        let [a, b, c] = self.corners.map(|p| turn.rotate(p));
        self.low = a.min(b).min(c);
        self.high = a.max(b).max(c);
    }
}

/// Returns the faces that overlap another face or themselves in the texture. The faces are in ascending order.
/// Triangles that only share corners or sides do not count as overlapping, and neither do triangles with zero area in
/// the texture.
///
/// # Errors
///
/// Returns [`Cancelled`] if `progress` asks to stop.
pub fn overlapping_faces(
    mesh: &Mesh,
    uvs: &[DVec2],
    progress: &dyn Progress,
) -> Result<Vec<FaceId>, Cancelled> {
    let triangles = triangles(mesh).into_iter();
    let flat = triangles.filter_map(|triangle| {
        Flat::new(triangle.map(|h| uvs[h.index()]), mesh.face(triangle[0])?)
    });
    let mut faces = Vec::new();
    sweep(flat.collect(), progress, |pair| {
        faces.extend(pair);
        ControlFlow::Continue(())
    })?;
    faces.sort_unstable();
    faces.dedup();
    Ok(faces)
}

/// Returns the faces of the first two overlapping triangles that `sweep` finds.
///
/// # Errors
///
/// Returns [`Cancelled`] if `progress` asks to stop.
pub(super) fn first_overlap(
    flat: Vec<Flat>,
    progress: &dyn Progress,
) -> Result<Option<[FaceId; 2]>, Cancelled> {
    let mut first = None;
    sweep(flat, progress, |pair| {
        first = Some(pair);
        ControlFlow::Break(())
    })?;
    Ok(first)
}

/// The number of comparisons of triangles between two progress reports.
const REPORT: usize = 1 << 16;

/// Finds pairs of triangles that overlap, and calls `visit` with the faces of each pair. A pair is left out if both of
/// its triangles are already known to overlap other triangles.
fn sweep(
    mut flat: Vec<Flat>,
    progress: &dyn Progress,
    mut visit: impl FnMut([FaceId; 2]) -> ControlFlow<()>,
) -> Result<(), Cancelled> {
    let turn = upright(flat.iter().map(|triangle| triangle.corners));
    if turn != DVec2::X {
        for triangle in &mut flat {
            triangle.rotate(turn);
        }
    }
    // The loop sweeps along u: only triangles whose ranges of u overlap are compared.
    flat.sort_by(|a, b| a.low.x.total_cmp(&b.low.x).then(a.face.cmp(&b.face)));
    let mut overlaps = vec![false; flat.len()];
    // The number of comparisons since the last progress report.
    let mut n_compared = REPORT;
    for (i, a) in flat.iter().enumerate() {
        if n_compared >= REPORT {
            n_compared = 0;
            progress.report("overlaps", i as u64, flat.len() as u64)?;
        }
        n_compared += 1;
        for (j, b) in flat.iter().enumerate().skip(i + 1) {
            if b.low.x >= a.high.x {
                break;
            }
            n_compared += 1;
            let is_new = !overlaps[i] || !overlaps[j];
            if is_new && b.low.y < a.high.y && a.low.y < b.high.y && overlap(a, b) {
                overlaps[i] = true;
                overlaps[j] = true;
                if visit([a.face, b.face]).is_break() {
                    return Ok(());
                }
            }
        }
    }
    Ok(())
}

/// Whether the interiors of two triangles overlap. They overlap if no line through a side of one of the triangles
/// separates the two triangles.
fn overlap(a: &Flat, b: &Flat) -> bool {
    let separates = |a: &Flat, b: &Flat| {
        (0..3).any(|i| {
            let (p, q) = (a.corners[i], a.corners[(i + 1) % 3]);
            b.corners.iter().all(|&c| (q - p).perp_dot(c - p) <= 0.0)
        })
    };
    !separates(a, b) && !separates(b, a)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the area of the bounding boxes of thin parallel triangles, relative to the area of the triangles.
    /// `direction` is the direction of the long sides.
    fn boxes(direction: DVec2, turned: bool) -> f64 {
        let across = direction.perp() * 1e-3;
        let strip = (0..100).map(|i| {
            let a = f64::from(i) * across;
            [a, a + across, a + direction]
        });
        let turn = if turned {
            upright(strip.clone())
        } else {
            DVec2::X
        };
        let turned = strip.map(|t| t.map(|p| turn.rotate(p)));
        let boxes = turned.map(|[a, b, c]| {
            let size = a.max(b).max(c) - a.min(b).min(c);
            size.x * size.y
        });
        boxes.sum::<f64>() / (100.0 * 0.5e-3 * direction.length_squared())
    }

    #[test]
    fn thin_triangles_are_turned_upright() {
        for (x, y) in [
            (1.0, 1.0),
            (-1.0, 1.0),
            (3.0, -4.0),
            (-0.3, -0.2),
            (1.0, 0.1),
        ] {
            let direction = DVec2::new(x, y);
            assert!(boxes(direction, false) > 50.0, "{direction}");
            assert!(boxes(direction, true) < 2.1, "{direction}");
        }
    }

    #[test]
    fn triangles_with_small_bounding_boxes_are_not_turned() {
        let triangle = [DVec2::ZERO, DVec2::X, DVec2::new(0.3, 0.9)];
        assert_eq!(upright([triangle].into_iter()), DVec2::X);
        assert_eq!(upright(std::iter::empty()), DVec2::X);
        assert_eq!(upright([[DVec2::ZERO; 3]].into_iter()), DVec2::X);
    }
}
