//! Triangulation of polygons: computes the diagonals that cut a polygon into triangles.
//!
//! ```text
//!    d ------- c          d ------- c          .---.                  .---.
//!    |         |          |      /  |         /     \                /|\   \
//!    |    f    |   -->    |   /     |        .       .      -->     . | \   .
//!    |         |          | /       |         \     /                \|  \ /
//!    a ------- b          a ------- b          '---'                  '---'
//! ```
//!
//! A quadrilateral is cut along its shorter diagonal. A polygon with more than four corners is cut by ear clipping or
//! into monotone pieces. Then diagonals are flipped until the result is a constrained Delaunay triangulation. A polygon
//! that cannot be cut in this way becomes a fan. See [`Cutter`] for the details.
//!
//! The corners of a face are numbered from 0, in their order around the face. The corners of a triangle are in
//! ascending order, so a triangle has the orientation of the face.

mod flips;
mod monotone;
mod sort;

use earcut::Earcut;
use flips::Flips;
use sort::sort_unless;

use mesh::{DVec3, FaceId, Mesh};

/// The indices of three corners of a face, in ascending order.
pub type Triangle = [u32; 3];

/// Squared lengths whose relative difference is at most this number are treated as equal. Areas are measured relative
/// to the size of the face; an area below this number is treated as 0.
const TOLERANCE: f64 = 1e-12;
/// The largest number of corners for which a face is cut by ear clipping. Ear clipping of a face with this number of
/// corners takes at most about 50 ms.
const MAX_EARS: usize = 4096;
/// The smallest number of corners for which the triangulation of a face can be canceled. Faces with fewer corners take
/// little time.
const MIN_CANCELLED: usize = 256;
/// A face with more than this number of corners becomes a fan, and no better triangulation is computed.
const MAX_CORNERS: usize = 10_000_000;

/// How a face is cut into triangles.
#[derive(Clone, Debug, PartialEq)]
pub enum Cut {
    /// The face is a triangle and is not cut.
    Keep,
    /// The face is a quadrilateral and is cut along one diagonal.
    Quad {
        /// Whether the diagonal joins corners 0 and 2. If false, the diagonal joins corners 1 and 3.
        from_zero: bool,
        /// Whether the quadrilateral could equally well be cut along its other diagonal: both diagonals are good, or
        /// both are bad. A bad diagonal gives a triangle that has zero area or is flipped.
        is_free: bool,
    },
    /// The face has more than four corners.
    Polygon {
        /// The triangles, sorted.
        triangles: Vec<Triangle>,
        /// Whether the polygon became a fan because it has too many corners, or because no other method can cut it. The
        /// triangles of a fan have a common vertex.
        is_fan: bool,
    },
}

impl Cut {
    /// Returns the number of diagonals. This is the number of new edges, and also the number of additional faces.
    pub fn n_diagonals(&self) -> usize {
        match self {
            Self::Keep => 0,
            Self::Quad { .. } => 1,
            Self::Polygon { triangles, .. } => triangles.len() - 1,
        }
    }

    /// Whether the polygon became a fan because it has too many corners, or because no other method can cut it. The
    /// triangles of a fan have a common vertex.
    pub fn is_fan(&self) -> bool {
        matches!(self, Self::Polygon { is_fan: true, .. })
    }

    /// Returns the triangles, sorted. The result is empty if the face is not cut.
    pub fn triangles(&self) -> &[Triangle] {
        match self {
            Self::Keep => &[],
            Self::Quad {
                from_zero: true, ..
            } => &[[0, 1, 2], [0, 2, 3]],
            Self::Quad { .. } => &[[0, 1, 3], [1, 2, 3]],
            Self::Polygon { triangles, .. } => triangles,
        }
    }

    /// Replaces the contents of `into` by the diagonals. Each diagonal is a pair of corners, the lower corner first.
    /// The pairs are sorted.
    pub fn diagonals(&self, into: &mut Vec<[u32; 2]>) {
        into.clear();
        // The corners of a triangle are in ascending order. In one triangle, the first corner is the first corner of
        // the face, and the last corner is the last corner of the face. The side between these two corners is a side of
        // the face. In all other triangles, the side between the first and the last corner is a diagonal. Each diagonal
        // joins the first and the last corner of exactly one triangle.
        let triangles = self.triangles();
        let last = u32::try_from(triangles.len()).expect("corners fit 32 bits") + 1;
        let sides = triangles.iter().map(|&[a, _, c]| [a, c]);
        into.extend(sides.filter(|&side| side != [0, last]));
        into.sort_unstable();
    }
}

/// Triangulates faces, one after another, and uses the same buffers for all of them.
///
/// A quadrilateral is cut along its shorter diagonal. If both diagonals are equally long, the diagonal that ends at the
/// vertex with the lowest id is used. Diagonals count as equally long if the relative difference of their squared
/// lengths is at most 1e-12. A diagonal is bad if one of its two triangles has zero area or is flipped, as seen along
/// the face normal. If only one diagonal is bad, the other diagonal is used. A quadrilateral with a reflex corner is
/// therefore cut at that corner. If both diagonals are bad, the quadrilateral is cut as if both were good.
///
/// A face with more than four corners is projected along its normal and cut by ear clipping (Held, "FIST: Fast
/// Industrial-Strength Triangulation of Polygons", 2001, as implemented by the crate `earcut`). The time of ear
/// clipping can grow with the square of the number of corners. Therefore, a face with more than 4096 corners is cut
/// into monotone pieces instead (de Berg and others, "Computational Geometry: Algorithms and Applications", 2008,
/// chapter 3). Then diagonals are flipped until the result is a constrained Delaunay triangulation.
///
/// Some faces become a fan around their vertex with the lowest id. These are faces with more than ten million corners,
/// and faces that can be cut neither by ear clipping nor into monotone pieces. A face cannot be cut if its area is zero
/// or its sides cross. A face with more than 4096 corners also becomes a fan if some of its sides overlap. In a face
/// with n corners, where n is more than 4096, at most 1024 n diagonals are flipped. If this limit is reached, some
/// triangles are possibly not Delaunay triangles.
///
/// # Examples
///
/// ```
/// use geometry::triangulate::Cutter;
///
/// let prism = geometry::shapes::cylinder(5, true);
/// let mut cutter = Cutter::default();
/// let n: usize = prism.faces().map(|f| cutter.cut(&prism, f).n_diagonals()).sum();
/// assert_eq!(n, 5 * 1 + 2 * 2);
/// ```
#[derive(Default)]
pub struct Cutter {
    points: Vec<DVec3>,
    flat: Vec<[f64; 2]>,
    indices: Vec<u32>,
    earcut: Earcut<f64>,
    flips: Flips,
}

impl Cutter {
    /// Returns how `f` is cut.
    pub fn cut(&mut self, mesh: &Mesh, f: FaceId) -> Cut {
        self.cut_unless(&|| false, mesh, f)
    }

    /// Returns how `f` is cut. For a face with at least 256 corners, `is_cancelled` is called many times. When
    /// `is_cancelled` returns `true`, the triangulation stops, and the face becomes a fan.
    pub fn cut_unless(&mut self, is_cancelled: &dyn Fn() -> bool, mesh: &Mesh, f: FaceId) -> Cut {
        self.points.clear();
        let corners = mesh.face_vertices(f).map(|v| mesh.position(v));
        self.points.extend(corners);
        let n = self.points.len();
        if n <= 3 {
            return Cut::Keep;
        }
        let is_cancelled = &|| n >= MIN_CANCELLED && is_cancelled();
        normalize(&mut self.points);
        let lowest = mesh.face_vertices(f).zip(0..).min().map_or(0, |(_, i)| i);
        if let [a, b, c, d] = self.points[..] {
            return quad([a, b, c, d], lowest);
        }
        let ears = self.ears(is_cancelled);
        let is_fan = ears.is_none();
        let triangles = ears.unwrap_or_else(|| fan(n, lowest));
        Cut::Polygon { triangles, is_fan }
    }

    /// Whether the corners of `f` lie in a plane and form a convex polygon without straight corners.
    pub(crate) fn is_flat_and_convex(&mut self, mesh: &Mesh, f: FaceId) -> bool {
        self.points.clear();
        let corners = mesh.face_vertices(f).map(|v| mesh.position(v));
        self.points.extend(corners);
        normalize(&mut self.points);
        let Some(normal) = doubled_area(&self.points).try_normalize() else {
            return false;
        };
        // After `normalize`, the first point is the origin, so the plane of the face contains the origin.
        if self.points.iter().any(|p| normal.dot(*p).abs() > TOLERANCE) {
            return false;
        }
        let n = self.points.len();
        let side = |i: usize| self.points[(i + 1) % n] - self.points[i % n];
        let turns_left = (0..n).all(|i| normal.dot(side(i).cross(side(i + 1))) > 0.0);
        // The sides of a convex polygon turn by 360° in total. Therefore the components of the sides along an axis in
        // the plane change their sign exactly twice on the way around the polygon. If the sides turn by more than 360°,
        // the sign changes more often.
        let (axis, _) = normal.any_orthonormal_pair();
        let signs = (0..n).map(|i| axis.dot(side(i))).filter(|s| *s != 0.0);
        let signs: Vec<bool> = signs.map(|s| s > 0.0).collect();
        let changes = (0..signs.len()).filter(|&i| signs[i] != signs[(i + 1) % signs.len()]);
        turns_left && changes.count() == 2
    }

    /// Triangulates the polygon in `points`, and improves the triangles by flipping diagonals. Returns `None` if the
    /// points cannot be triangulated or `is_cancelled` returns `true`.
    fn ears(&mut self, is_cancelled: &dyn Fn() -> bool) -> Option<Vec<Triangle>> {
        let n = self.points.len();
        let normal = doubled_area(&self.points).try_normalize()?;
        if n > MAX_CORNERS || doubled_area(&self.points).length() < TOLERANCE {
            return None;
        }
        let (x, y) = normal.any_orthonormal_pair();
        self.flat.clear();
        let project = |p: &DVec3| [x.dot(*p), y.dot(*p)];
        self.flat.extend(self.points.iter().map(project));
        if is_cancelled() {
            return None;
        }
        let triangles = if n > MAX_EARS {
            monotone::triangulate(&self.flat, is_cancelled)?
        } else {
            clip(&mut self.earcut, &mut self.indices, &self.flat)?
        };
        if is_cancelled() {
            return None;
        }
        let mut refined = triangles.clone();
        self.flips.improve(&self.flat, &mut refined, is_cancelled);
        if is_cancelled() {
            return None;
        }
        Some(if is_triangulation_unless(is_cancelled, n, &refined)? {
            refined
        } else {
            triangles
        })
    }
}

/// Cuts a polygon by ear clipping. Returns `None` if the result is not a triangulation.
fn clip(
    earcut: &mut Earcut<f64>,
    indices: &mut Vec<u32>,
    points: &[[f64; 2]],
) -> Option<Vec<Triangle>> {
    earcut.earcut_slice(points, &[], indices);
    let mut triangles = to_triangles(indices);
    // Ear clipping skips a corner that is on one line with its neighbors, or at the position of a neighbor.
    insert_skipped_corners(points.len(), &mut triangles);
    triangles.sort_unstable();
    is_triangulation(points.len(), &triangles).then_some(triangles)
}

/// Translates the points so that the first point is at the origin. Then scales them by a power of two to a size near 1,
/// so that products of coordinates neither overflow nor underflow.
fn normalize(points: &mut [DVec3]) {
    let first = points[0];
    // Computes a quarter of each difference, because the difference of two very large finite numbers can be infinite.
    let quarter = |p: &DVec3| (0.25 * *p - 0.25 * first).abs().max_element();
    let extent = points.iter().map(quarter).fold(0.0, f64::max);
    if extent > 0.0 {
        let exponent = (extent.to_bits() >> 52).max(1);
        let scale = f64::from_bits(2046_u64.saturating_sub(exponent).max(1) << 52);
        for p in points {
            *p = 0.25 * *p - 0.25 * first;
            *p *= scale;
        }
    } else {
        points.fill(DVec3::ZERO);
    }
}

/// Returns twice the area vector of a polygon, by Newell's method.
fn doubled_area(points: &[DVec3]) -> DVec3 {
    points
        .windows(2)
        .map(|w| (w[0] - points[0]).cross(w[1] - points[0]))
        .sum()
}

/// Returns how to cut a quadrilateral. Corner `lowest` is at the vertex with the lowest id.
fn quad(points: [DVec3; 4], lowest: u32) -> Cut {
    let [a, b, c, d] = points;
    let normal = doubled_area(&points);
    let smallest = TOLERANCE * normal.length_squared();
    let faces_up = |p: DVec3, q: DVec3, r: DVec3| (q - p).cross(r - p).dot(normal) > smallest;
    let from_zero_fits = faces_up(a, b, c) && faces_up(a, c, d);
    let from_one_fits = faces_up(a, b, d) && faces_up(b, c, d);
    let (from_zero_length, from_one_length) = (a.distance_squared(c), b.distance_squared(d));
    let longer = from_zero_length.max(from_one_length);
    let from_zero = if from_zero_fits != from_one_fits {
        from_zero_fits
    } else if (from_zero_length - from_one_length).abs() <= TOLERANCE * longer {
        lowest.is_multiple_of(2)
    } else {
        from_zero_length < from_one_length
    };
    Cut::Quad {
        from_zero,
        is_free: from_zero_fits == from_one_fits,
    }
}

/// Returns the triangles of a fan around one corner of a polygon with `n` corners. The triangles are sorted.
fn fan(n: usize, corner: u32) -> Vec<Triangle> {
    let n = u32::try_from(n).expect("corners fit 32 bits");
    let mut triangles: Vec<Triangle> = (1..n - 1)
        .map(|i| with_sorted_corners([corner, (corner + i) % n, (corner + i + 1) % n]))
        .collect();
    triangles.sort_unstable();
    triangles
}

/// Converts a list of corner indices, three for each triangle, to a list of triangles.
fn to_triangles(indices: &[u32]) -> Vec<Triangle> {
    let triangles = indices.as_chunks().0;
    triangles
        .iter()
        .map(|&triangle| with_sorted_corners(triangle))
        .collect()
}

/// Returns the triangle with its corners in ascending order.
fn with_sorted_corners(mut triangle: Triangle) -> Triangle {
    triangle.sort_unstable();
    triangle
}

/// Inserts the corners that no triangle uses. If unused corners lie between two corners a and b of the polygon, the
/// triangle with the side from a to b is split.
///
/// ```text
///        c                c
///      /   \            / | \
///    a ----- b   -->   a--m--b
/// ```
fn insert_skipped_corners(n: usize, triangles: &mut Vec<Triangle>) {
    let mut is_used = vec![false; n];
    triangles
        .iter()
        .flatten()
        .for_each(|&i| is_used[i as usize] = true);
    if is_used.iter().all(|&used| used) {
        return;
    }
    let used: Vec<u32> = (0..)
        .zip(&is_used)
        .filter(|(_, u)| **u)
        .map(|(i, _)| i)
        .collect();
    let Some(&first) = used.first() else {
        return;
    };
    let next_used = |i: u32| {
        let place = used.partition_point(|&u| u <= i);
        used.get(place).copied().unwrap_or(first)
    };
    // The corners that are used by at least one triangle form a polygon. For the side of this polygon that starts at
    // corner i, `owner[i]` is the index of the triangle with this side.
    let mut owner = vec![None; n];
    for (t, triangle) in triangles.iter().enumerate() {
        for k in 0..3 {
            let [from, to] = [triangle[k], triangle[(k + 1) % 3]];
            if next_used(from) == to {
                owner[from as usize] = Some(t);
            }
        }
    }
    let n = u32::try_from(n).expect("corners fit 32 bits");
    for &a in &used {
        let b = next_used(a);
        let Some(t) = owner[a as usize].filter(|_| (a + 1) % n != b) else {
            continue;
        };
        let Some(&c) = triangles[t].iter().find(|&&c| c != a && c != b) else {
            continue;
        };
        // The old triangle is split into several triangles, which all have the corner c. The first of the new
        // triangles, which has the side from c to a, replaces the old triangle in the list. The last of the new
        // triangles has the side from b to c.
        let mut from = a;
        let mut part = t;
        while from != b {
            let to = (from + 1) % n;
            let triangle = with_sorted_corners([from, to, c]);
            if from == a {
                triangles[t] = triangle;
            } else {
                part = triangles.len();
                triangles.push(triangle);
            }
            from = to;
        }
        if next_used(b) == c {
            owner[b as usize] = Some(part);
        }
    }
}

/// Whether the given triangles, which must be sorted, are a triangulation of a polygon with `n` corners. In a
/// triangulation, there are n - 2 triangles. Each side of the polygon belongs to one triangle. Each diagonal belongs to
/// two triangles, which lie on opposite sides of the diagonal.
fn is_triangulation(n: usize, triangles: &[Triangle]) -> bool {
    is_triangulation_unless(&|| false, n, triangles) == Some(true)
}

/// Whether sorted triangles are a triangulation; see [`is_triangulation`]. Returns `None` if `is_cancelled` returns
/// `true`.
fn is_triangulation_unless(
    is_cancelled: &dyn Fn() -> bool,
    n: usize,
    triangles: &[Triangle],
) -> Option<bool> {
    if triangles.len() + 2 != n {
        return Some(false);
    }
    let n = u32::try_from(n).expect("corners fit 32 bits");
    // Each triangle has two sides that run from a lower to a higher corner index, and one side that runs from a higher
    // to a lower index. The list `ascending` has the sides that run to a higher index, and the list `descending` has
    // the others. In both lists, each side is stored with its lower corner first.
    let mut ascending: Vec<[u32; 2]> = triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c]])
        .collect();
    let mut descending: Vec<[u32; 2]> = triangles.iter().map(|&[a, _, c]| [a, c]).collect();
    // The side of the polygon from corner n - 1 to corner 0 is removed from the list `descending`. All other sides of
    // the polygon are added to this list. If the triangles form a triangulation, the lists `ascending` and `descending`
    // are then equal. Each diagonal is in both lists, because it belongs to two triangles, whose boundaries run along
    // it in opposite directions.
    let whole = [0, n - 1];
    let Some(place) = descending.iter().position(|&side| side == whole) else {
        return Some(false);
    };
    descending.swap_remove(place);
    descending.extend((1..n).map(|i| [i - 1, i]));
    sort_unless(is_cancelled, &mut ascending, Ord::cmp)?;
    sort_unless(is_cancelled, &mut descending, Ord::cmp)?;
    let is_valid = ascending == descending
        && ascending.windows(2).all(|w| w[0] != w[1])
        && ascending.iter().all(|[a, b]| a < b);
    Some(is_valid)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fans_are_triangulations() {
        for n in 4..9 {
            for corner in 0..u32::try_from(n).unwrap() {
                assert!(is_triangulation(n, &fan(n, corner)), "{n} {corner}");
            }
        }
    }

    #[test]
    fn a_large_face_becomes_a_fan_when_its_cut_is_cancelled() {
        let prism = crate::shapes::cylinder(5000, true);
        let f = prism.faces().find(|&f| prism.degree(f) == 5000).unwrap();
        let is_fan = |stop: bool| Cutter::default().cut_unless(&|| stop, &prism, f).is_fan();
        assert!(is_fan(true) && !is_fan(false));
    }

    #[test]
    fn invalid_triangulations_are_detected() {
        assert!(is_triangulation(5, &[[0, 1, 2], [0, 2, 3], [0, 3, 4]]));
        for wrong in [
            // Each of these lists of triangles has a different fault. The faults are, in order: too few triangles; a
            // duplicate triangle; crossing diagonals; a triangle that contains a corner twice; two triangles at one
            // side of the polygon.
            vec![[0, 1, 2], [0, 2, 4]],
            vec![[0, 1, 2], [0, 2, 4], [0, 2, 4]],
            vec![[0, 1, 2], [1, 2, 3], [0, 3, 4]],
            vec![[0, 1, 2], [0, 2, 4], [3, 3, 4]],
            vec![[0, 1, 4], [1, 2, 4], [0, 3, 4]],
        ] {
            assert!(!is_triangulation(5, &wrong), "{wrong:?}");
        }
    }

    #[test]
    fn skipped_corners_are_inserted_at_their_side() {
        // The triangle has the corners 1, 4 and 6 of a polygon with 8 corners.
        let mut triangles = vec![[1, 4, 6]];
        insert_skipped_corners(8, &mut triangles);
        triangles.sort_unstable();
        assert!(is_triangulation(8, &triangles), "{triangles:?}");
        // No triangle uses the corners 1, 3, 5 and 7.
        let mut triangles = vec![[0, 2, 4], [0, 4, 6]];
        insert_skipped_corners(8, &mut triangles);
        triangles.sort_unstable();
        assert!(is_triangulation(8, &triangles), "{triangles:?}");
    }

    #[test]
    fn without_triangles_no_corners_are_inserted() {
        let mut triangles = Vec::new();
        insert_skipped_corners(5, &mut triangles);
        assert!(triangles.is_empty());
    }
}
