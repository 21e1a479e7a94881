//! Which diagonals cut a polygon into triangles.
//!
//! ```text
//!    d ------- c          d ------- c          .---.                  .---.
//!    |         |          |      /  |         /     \                /|\   \
//!    |    f    |   -->    |   /     |        .       .      -->     . | \   .
//!    |         |          | /       |         \     /                \|  \ /
//!    a ------- b          a ------- b          '---'                  '---'
//! ```
//!
//! A quadrilateral is cut along its shorter diagonal, a larger polygon by ears, improved until it is a
//! Delaunay triangulation inside its sides; what cannot be cut this way becomes a fan. [`Cutter`] tells
//! all that is to know.
//!
//! Corners are counted from 0 along the face. A triangle is written with its corners in rising order,
//! which is also its direction.

use earcut::{Earcut, Refiner};

use mesh::{DVec3, FaceId, Mesh};

/// Three corners of a face, rising.
pub type Triangle = [u32; 3];

/// Lengths, areas and turns that differ by less than this, relatively, are taken as equal.
const TOLERANCE: f64 = 1e-12;
/// Ear clipping numbers its nodes by 32 bits, several bytes each. Larger faces become fans.
const MOST_CORNERS: usize = 10_000_000;

/// How a face is cut.
#[derive(Clone, Debug, PartialEq)]
pub enum Cut {
    /// Not at all: it is a triangle.
    Keep,
    /// A quadrilateral.
    Quad {
        /// Whether from corner 0 to 2, not from 1 to 3.
        from_zero: bool,
        /// Whether the other diagonal would do as well.
        is_free: bool,
    },
    /// A larger face.
    Polygon {
        /// Its triangles, in order.
        triangles: Vec<Triangle>,
        /// Whether they are a fan for want of anything better.
        is_fan: bool,
    },
}

impl Cut {
    /// How many edges it adds, and faces.
    pub fn n_diagonals(&self) -> usize {
        match self {
            Self::Keep => 0,
            Self::Quad { .. } => 1,
            Self::Polygon { triangles, .. } => triangles.len() - 1,
        }
    }

    /// Whether the triangles are a fan for want of anything better.
    pub fn is_fan(&self) -> bool {
        matches!(self, Self::Polygon { is_fan: true, .. })
    }

    /// The triangles, in order; none if it is not cut.
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

    /// Puts the diagonals into a list, which is emptied first: pairs of corners, lower first, in order.
    pub fn diagonals(&self, into: &mut Vec<[u32; 2]>) {
        into.clear();
        // Each triangle below a diagonal has it as the side from its last to its first corner; one
        // triangle has a side of the face there instead.
        let triangles = self.triangles();
        let last = u32::try_from(triangles.len()).expect("corners fit 32 bits") + 1;
        let sides = triangles.iter().map(|&[a, _, c]| [a, c]);
        into.extend(sides.filter(|&side| side != [0, last]));
        into.sort_unstable();
    }
}

/// Cuts faces, one after another, with buffers that are used again.
///
/// A quadrilateral is cut along its shorter diagonal; if both are equally long (squares of lengths
/// within 1e-12 of each other) along the one at its lowest vertex. But a diagonal with a triangle that
/// has no area or is turned over, seen along the normal of the face, is taken only if the other one is no
/// better: a quadrilateral with a reflex corner is cut there.
///
/// A larger face is projected along its normal and cut by ears (Held, "FIST: Fast Industrial-Strength
/// Triangulation of Polygons", 2001, as the crate `earcut` does it), and then diagonals are turned until
/// it is a Delaunay triangulation inside its sides. A face that has no area or whose sides cross may
/// not be cut this way: then it becomes a fan around its lowest vertex.
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
    refiner: Refiner,
}

impl Cutter {
    /// How `f` is cut.
    pub fn cut(&mut self, mesh: &Mesh, f: FaceId) -> Cut {
        self.points.clear();
        let corners = mesh.face_vertices(f).map(|v| mesh.position(v));
        self.points.extend(corners);
        let n = self.points.len();
        if n <= 3 {
            return Cut::Keep;
        }
        normalize(&mut self.points);
        let lowest = mesh.face_vertices(f).zip(0..).min().map_or(0, |(_, i)| i);
        if let [a, b, c, d] = self.points[..] {
            return quad([a, b, c, d], lowest);
        }
        let ears = self.ears();
        let is_fan = ears.is_none();
        let triangles = ears.unwrap_or_else(|| fan(n, lowest));
        Cut::Polygon { triangles, is_fan }
    }

    /// Cuts the points by ears; `None` if what comes out does not cover them.
    fn ears(&mut self) -> Option<Vec<Triangle>> {
        let n = self.points.len();
        let normal = doubled_area(&self.points).try_normalize()?;
        if n > MOST_CORNERS || doubled_area(&self.points).length() < TOLERANCE {
            return None;
        }
        let (x, y) = normal.any_orthonormal_pair();
        self.flat.clear();
        let project = |p: &DVec3| [x.dot(*p), y.dot(*p)];
        self.flat.extend(self.points.iter().map(project));
        self.earcut.earcut_slice(&self.flat, &[], &mut self.indices);
        let mut triangles = sorted(&self.indices);
        // Corners between two in line with them, or in their place, are left out by the ears.
        put_back(n, &mut triangles);
        triangles.sort_unstable();
        if !is_cut_of(n, &triangles) {
            return None;
        }
        self.indices.clear();
        self.indices.extend(triangles.iter().flatten());
        self.refiner.refine(&mut self.indices, &self.flat);
        let mut refined = sorted(&self.indices);
        refined.sort_unstable();
        Some(if is_cut_of(n, &refined) {
            refined
        } else {
            triangles
        })
    }
}

/// Moves the points so that the first is at 0, and scales them by a power of two to a size near 1, so that
/// products neither overflow nor vanish.
fn normalize(points: &mut [DVec3]) {
    let first = points[0];
    // Quarters, because the difference of two finite numbers may be infinite.
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

/// Twice the area vector of a polygon, by Newell's method.
fn doubled_area(points: &[DVec3]) -> DVec3 {
    points
        .windows(2)
        .map(|w| (w[0] - points[0]).cross(w[1] - points[0]))
        .sum()
}

/// Cuts a quadrilateral whose lowest vertex is at corner `lowest`.
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

/// All triangles at one corner.
fn fan(n: usize, corner: u32) -> Vec<Triangle> {
    let n = u32::try_from(n).expect("corners fit 32 bits");
    let mut triangles: Vec<Triangle> = (1..n - 1)
        .map(|i| rising([corner, (corner + i) % n, (corner + i + 1) % n]))
        .collect();
    triangles.sort_unstable();
    triangles
}

/// Triples of corners as triangles.
fn sorted(indices: &[u32]) -> Vec<Triangle> {
    let triangles = indices.as_chunks().0;
    triangles.iter().map(|&triangle| rising(triangle)).collect()
}

/// The triangle with its corners in rising order.
fn rising(mut triangle: Triangle) -> Triangle {
    triangle.sort_unstable();
    triangle
}

/// Puts corners that no triangle has back where they belong: on the side that skips them.
///
/// ```text
///        c                c
///      /   \            / | \
///    a ----- b   -->   a--m--b
/// ```
fn put_back(n: usize, triangles: &mut Vec<Triangle>) {
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
    let following = |i: u32| {
        let place = used.partition_point(|&u| u <= i);
        used.get(place).copied().unwrap_or(first)
    };
    // For each side of the smaller polygon its triangle, by the corner where it begins.
    let mut owner = vec![None; n];
    for (t, triangle) in triangles.iter().enumerate() {
        for k in 0..3 {
            let [from, to] = [triangle[k], triangle[(k + 1) % 3]];
            if following(from) == to {
                owner[from as usize] = Some(t);
            }
        }
    }
    let n = u32::try_from(n).expect("corners fit 32 bits");
    for &a in &used {
        let b = following(a);
        let Some(t) = owner[a as usize].filter(|_| (a + 1) % n != b) else {
            continue;
        };
        let Some(&c) = triangles[t].iter().find(|&&c| c != a && c != b) else {
            continue;
        };
        // The first piece keeps the place in the list and the side from c, the last gets that to c.
        let mut from = a;
        let mut piece = t;
        while from != b {
            let to = (from + 1) % n;
            let triangle = rising([from, to, c]);
            if from == a {
                triangles[t] = triangle;
            } else {
                piece = triangles.len();
                triangles.push(triangle);
            }
            from = to;
        }
        if following(b) == c {
            owner[b as usize] = Some(piece);
        }
    }
}

/// Whether sorted triangles are a triangulation of a polygon with `n` corners: there are n - 2, each side
/// of the polygon belongs to one of them, and each other side to one on either hand.
fn is_cut_of(n: usize, triangles: &[Triangle]) -> bool {
    if triangles.len() + 2 != n {
        return false;
    }
    let n = u32::try_from(n).expect("corners fit 32 bits");
    // Sides that run up, and sides that run down, written upwards.
    let mut up: Vec<[u32; 2]> = triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c]])
        .collect();
    let mut down: Vec<[u32; 2]> = triangles.iter().map(|&[a, _, c]| [a, c]).collect();
    // The polygon runs up from 0 to n - 1, and down once, from n - 1 to 0.
    let whole = [0, n - 1];
    let Some(place) = down.iter().position(|&side| side == whole) else {
        return false;
    };
    down.swap_remove(place);
    down.extend((1..n).map(|i| [i - 1, i]));
    up.sort_unstable();
    down.sort_unstable();
    up == down && up.windows(2).all(|w| w[0] != w[1]) && up.iter().all(|[a, b]| a < b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fans_are_triangulations() {
        for n in 4..9 {
            for corner in 0..u32::try_from(n).unwrap() {
                assert!(is_cut_of(n, &fan(n, corner)), "{n} {corner}");
            }
        }
    }

    #[test]
    fn what_is_no_triangulation_is_seen() {
        assert!(is_cut_of(5, &[[0, 1, 2], [0, 2, 3], [0, 3, 4]]));
        for wrong in [
            // Too few, one twice, crossing diagonals, a corner twice.
            vec![[0, 1, 2], [0, 2, 4]],
            vec![[0, 1, 2], [0, 2, 4], [0, 2, 4]],
            vec![[0, 1, 2], [1, 2, 3], [0, 3, 4]],
            vec![[0, 1, 2], [0, 2, 4], [3, 3, 4]],
            vec![[0, 1, 4], [1, 2, 4], [0, 3, 4]],
        ] {
            assert!(!is_cut_of(5, &wrong), "{wrong:?}");
        }
    }

    #[test]
    fn corners_that_were_left_out_come_back_on_their_side() {
        // A triangle with corners 1, 4, 6 of a polygon with 8.
        let mut triangles = vec![[1, 4, 6]];
        put_back(8, &mut triangles);
        triangles.sort_unstable();
        assert!(is_cut_of(8, &triangles), "{triangles:?}");
        // Two triangles, with corners left out on all of their sides but the shared one.
        let mut triangles = vec![[0, 2, 4], [0, 4, 6]];
        put_back(8, &mut triangles);
        triangles.sort_unstable();
        assert!(is_cut_of(8, &triangles), "{triangles:?}");
    }

    #[test]
    fn nothing_is_put_back_without_triangles() {
        let mut triangles = Vec::new();
        put_back(5, &mut triangles);
        assert!(triangles.is_empty());
    }
}
