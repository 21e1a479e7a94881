//! Intersections of triangles.

use std::cmp::Ordering::{self, Equal, Greater, Less};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use mesh::{DVec2, DVec3, Domain, FaceId, Mesh};
use progress::{Cancelled, Progress};

use super::{SurfaceIndex, unit_scale};
use crate::predicates::{orient2d, orient3d};

/// Returns the faces of a mesh that intersect another face of the mesh, in ascending order. Polygons are divided into
/// triangles as in [`SurfaceIndex`], and the triangles are tested by [`triangles_intersect`]. Corners and sides that
/// two triangles have in common do not count as intersections. Corners of two triangles at the same position count as
/// common corners.
///
/// # Errors
///
/// Returns [`Cancelled`] if `progress` asks to stop.
pub fn self_intersecting_faces(
    mesh: &Mesh,
    progress: &dyn Progress,
) -> Result<Vec<FaceId>, Cancelled> {
    let Some(index) = SurfaceIndex::with_progress(mesh, progress)? else {
        return Ok(Vec::new());
    };
    let slots = mesh.domain_len(Domain::Face);
    let is_found: Vec<AtomicBool> = (0..slots).map(|_| AtomicBool::new(false)).collect();
    // A pair of triangles is skipped if both of their faces are already marked, because testing the pair could not mark
    // any further face.
    let visit = |i: u32, j: u32| {
        let faces = [i, j].map(|i| index.origins[i as usize].face);
        let found = faces.map(|f| &is_found[f.index()]);
        if faces[0] != faces[1]
            && !found.iter().all(|found| found.load(Relaxed))
            && triangles_intersect(&index.positions[i as usize], &index.positions[j as usize])
        {
            for found in found {
                found.store(true, Relaxed);
            }
        }
        false
    };
    index.pairs(visit, progress)?;
    let found = is_found.into_iter().map(AtomicBool::into_inner);
    let numbers = found
        .enumerate()
        .filter_map(|(i, found)| found.then_some(i));
    Ok(numbers.map(FaceId::new).collect())
}

/// Whether two triangles have a common point that is not on a common corner or side.
///
/// Corners at the same position are common corners, and sides between two common corners are common sides. Neighbors in
/// a mesh therefore intersect only if they also meet at other points. Two triangles with a common side intersect if
/// they overlap in the same plane. Two triangles with one common corner intersect if they also meet at another point.
/// Two triangles with the same three corners intersect. A zero-area triangle never counts as intersecting, because its
/// sides are usually also sides of its neighbors.
///
/// The answer is exact under two conditions: no coordinate is above 1e150 in magnitude, and every difference between
/// coordinates is either 0 or at least 1e-90 times the largest coordinate.
///
/// Two triangles have a common point if and only if a side of one of them meets the other triangle. The test uses only
/// the signs of volumes and areas, as in Guigue, Devillers, "Fast and Robust Triangle-Triangle Overlap Test Using
/// Orientation Predicates", 2003.
pub fn triangles_intersect(s: &[DVec3; 3], t: &[DVec3; 3]) -> bool {
    let largest = s
        .iter()
        .chain(t)
        .fold(0.0_f64, |m, p| m.max(p.abs().max_element()));
    if (1e-60..=1e60).contains(&largest) {
        return intersect(s, t);
    }
    let scale = unit_scale(largest);
    intersect(&s.map(|p| p * scale), &t.map(|p| p * scale))
}

fn intersect(s: &[DVec3; 3], t: &[DVec3; 3]) -> bool {
    let in_t = s.map(|p| t.contains(&p));
    let in_s = t.map(|p| s.contains(&p));
    match in_t.iter().filter(|common| **common).count() {
        0 => {
            let Some(sides) = sides_of_plane(s, t) else {
                return false;
            };
            let Some(other_sides) = sides_of_plane(t, s) else {
                return false;
            };
            (0..3).any(|i| {
                let j = (i + 1) % 3;
                // A side is tested only if it reaches the plane of the other triangle.
                let reaches = |sides: [Ordering; 3]| sides[i] != sides[j] || sides[i] == Equal;
                reaches(sides) && meets([s[i], s[j]], t)
                    || reaches(other_sides) && meets([t[i], t[j]], s)
            }) && has_area(s)
                && has_area(t)
        }
        1 => {
            if sides_of_plane(s, t).is_none() || !has_area(s) || !has_area(t) {
                return false;
            }
            // The triangles have one common corner. Suppose that they have another common point, and consider the ray
            // from the common corner through this point. The ray leaves one of the two triangles before the other. At
            // this point, the ray crosses the side opposite the common corner, and is still in the other triangle.
            // Therefore it is enough to test these sides.
            let opposite = |t: &[DVec3; 3], common: [bool; 3]| {
                let i = common.iter().position(|c| *c).unwrap_or(0);
                [t[(i + 1) % 3], t[(i + 2) % 3]]
            };
            meets(opposite(s, in_t), t) || meets(opposite(t, in_s), s)
        }
        2 => {
            let apex = |t: &[DVec3; 3], common: [bool; 3]| {
                let i = common.iter().position(|c| !c).unwrap_or(0);
                [t[i], t[(i + 1) % 3], t[(i + 2) % 3]]
            };
            // If two corners of `s` are at the same position, both can count as common corners. However, `has_area(s)`
            // is then false.
            let [p, a, b] = apex(s, in_t);
            let [q, ..] = apex(t, in_s);
            orient3d(p, a, b, q) == Equal && has_area(s) && has_area(t) && {
                let flat = flatten(s);
                orient2d(flat(a), flat(b), flat(p)) == orient2d(flat(a), flat(b), flat(q))
            }
        }
        _ => has_area(s) && has_area(t),
    }
}

/// Returns, for each corner of `s`, on which side of the plane of `t` the corner lies. Returns `None` if all corners of
/// `s` are strictly on one side of this plane.
fn sides_of_plane(s: &[DVec3; 3], t: &[DVec3; 3]) -> Option<[Ordering; 3]> {
    let sides = s.map(|p| orient3d(t[0], t[1], t[2], p));
    let all_on = |side| sides.iter().all(|s| *s == side);
    (!all_on(Greater) && !all_on(Less)).then_some(sides)
}

/// Whether a segment and a triangle have a common point. The area of the triangle must not be zero.
fn meets([p, q]: [DVec3; 2], t: &[DVec3; 3]) -> bool {
    let side = |p| orient3d(t[0], t[1], t[2], p);
    let (at_p, at_q) = (side(p), side(q));
    if at_p == at_q {
        return at_p == Equal && meets_flat([p, q], t);
    }
    let turns = [0, 1, 2].map(|i| orient3d(p, q, t[i], t[(i + 1) % 3]));
    !(turns.contains(&Greater) && turns.contains(&Less))
}

/// Whether a segment and a triangle in the same plane have a common point.
fn meets_flat([p, q]: [DVec3; 2], t: &[DVec3; 3]) -> bool {
    let flat = flatten(t);
    let (p, q, t) = (flat(p), flat(q), t.map(flat));
    let contains = |p| {
        let turns = [0, 1, 2].map(|i| orient2d(t[i], t[(i + 1) % 3], p));
        !(turns.contains(&Greater) && turns.contains(&Less))
    };
    // A segment with both ends outside of the triangle meets the triangle if and only if it meets a side of the
    // triangle. Two segments on different lines meet if neither segment has both ends strictly on one side of the line
    // through the other segment.
    let crosses = |a, b| {
        let (at_a, at_b) = (orient2d(p, q, a), orient2d(p, q, b));
        let (at_p, at_q) = (orient2d(a, b, p), orient2d(a, b, q));
        at_a != at_b && at_p != at_q
    };
    contains(p) || contains(q) || (0..3).any(|i| crosses(t[i], t[(i + 1) % 3]))
}

/// Returns a projection along a coordinate axis. If possible, the axis is chosen so that the projected triangle has a
/// nonzero area.
fn flatten(t: &[DVec3; 3]) -> impl Fn(DVec3) -> DVec2 + use<> {
    let along = |axis: usize| move |p: DVec3| DVec2::new(p[(axis + 1) % 3], p[(axis + 2) % 3]);
    let axis = (0..3).find(|&axis| {
        let [a, b, c] = t.map(along(axis));
        orient2d(a, b, c) != Equal
    });
    along(axis.unwrap_or(0))
}

/// Whether the triangle has an area: its three corners are not on one line.
fn has_area(t: &[DVec3; 3]) -> bool {
    let flat = flatten(t);
    orient2d(flat(t[0]), flat(t[1]), flat(t[2])) != Equal
}
