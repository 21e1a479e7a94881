//! Flattening: computes positions in the plane for the vertices of a part (a connected set of faces, cut open at
//! seams).

use mesh::{DVec2, DVec3};
use progress::Progress;

use super::surface::{Part, is_solid};
use crate::sparse::{Factor, SolveError, SymmetricMatrix};

/// How much a change of area costs, compared with a change of angles: the factor lambda in the paper of Liu and others
/// (2008).
const AREA_WEIGHT: f64 = 0.5;
/// Let m be the root mean square of the movements of the vertices in one iteration. The iterations stop when m is less
/// than this fraction of the size of the part.
const SMALL_MOVE: f64 = 1e-4;
const MAX_ITERATIONS: usize = 40;
/// In the equations, a triangle with zero area gets this height, as a fraction of its longest side. If the height were
/// 0, the equations could not be solved.
const FLOOR: f64 = 1e-6;

/// A triangle in its own plane: the corners (0, 0), (x1, 0) and (x2, y2).
struct Frame {
    x1: f64,
    x2: f64,
    y2: f64,
}

impl Frame {
    fn new([a, b, c]: [DVec3; 3]) -> Self {
        let (x1, far) = ((b - a).length(), (c - a).length());
        if is_solid([a, b, c]) {
            let along = (b - a) / x1;
            let (x2, y2) = ((c - a).dot(along), along.cross(c - a).length());
            return Self { x1, x2, y2 };
        }
        let longest = x1.max(far).max((c - b).length());
        let longest = if longest > 0.0 { longest } else { FLOOR };
        let x1 = x1.max(FLOOR * longest);
        let x2 = (c - a).dot((b - a).normalize_or(DVec3::X));
        let y2 = FLOOR * longest;
        Self { x1, x2, y2 }
    }

    fn area(&self) -> f64 {
        self.x1 * self.y2 / 2.0
    }

    /// Returns the gradients of the three barycentric coordinates of the triangle, in its plane.
    fn gradients(&self) -> [DVec2; 3] {
        let &Self { x1, x2, y2 } = self;
        let b = DVec2::new(1.0 / x1, -x2 / (x1 * y2));
        let c = DVec2::new(0.0, 1.0 / y2);
        [-b - c, b, c]
    }
}

/// Returns two maps of a part into the plane: the result of the iterations, and the map at which the iterations start.
/// Both maps preserve the total area of the part. The result of the iterations has less distortion. However, the
/// starting map can be free of overlaps even if the result of the iterations is not. Positions are in the order of the
/// vertices of the part.
///
/// The starting map is a least squares conformal map (Levy and others, 2002, with the matrix of Mullen, Tong, Alliez,
/// Desbrun, "Spectral Conformal Parameterization", 2008). The iterations of the hybrid method improve this map (Liu,
/// Zhang, Xu, Gotsman, Gortler, "A Local/Global Approach to Mesh Parameterization", 2008). Each iteration has two
/// steps. First, it finds a similarity transformation for each triangle. This transformation has a scale near 1, and is
/// close to the map of the triangle. Then the iteration solves linear equations for positions that fit these
/// transformations. All iterations have the same matrix, which is factored once.
pub(super) fn flatten(part: &Part, progress: &dyn Progress) -> Result<[Vec<DVec2>; 2], SolveError> {
    let frames: Vec<Frame> = part
        .triangles
        .iter()
        .map(|t| Frame::new(t.map(|v| part.points[v as usize])))
        .collect();
    let stiffness = stiffness(part, &frames);
    let area: f64 = frames.iter().map(Frame::area).sum();
    let mut start = conformal(part, &stiffness, progress)?;
    let in_plane = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| start[v as usize]);
        (b - a).perp_dot(c - a) / 2.0
    };
    let scale = (area / part.triangles.iter().map(in_plane).sum::<f64>()).sqrt();
    for p in &mut start {
        *p *= scale;
    }
    let rigid = rigid(part, &frames, &stiffness, &start, progress)?;
    Ok([rigid, start])
}

/// Projects a part onto the plane perpendicular to its mean normal.
pub(super) fn project(part: &Part) -> Vec<DVec2> {
    let normal: DVec3 = part
        .triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|v| part.points[v as usize]);
            (b - a).cross(c - a)
        })
        .sum();
    let normal = normal.normalize_or(DVec3::Z);
    let (u, v) = normal.any_orthonormal_pair();
    // (u, v, normal) must be right-handed.
    let v = if u.cross(v).dot(normal) < 0.0 { -v } else { v };
    let origin = part.points.first().copied().unwrap_or_default();
    let points = part.points.iter().map(|&p| p - origin);
    points.map(|p| DVec2::new(p.dot(u), p.dot(v))).collect()
}

/// Returns the entries of the matrix of the Dirichlet energy: a quadratic form of the values of a function at the
/// vertices of a part.
fn stiffness(part: &Part, frames: &[Frame]) -> Vec<(u32, u32, f64)> {
    let mut entries = Vec::with_capacity(6 * frames.len());
    for (t, frame) in part.triangles.iter().zip(frames) {
        let (g, area) = (frame.gradients(), frame.area());
        for i in 0..3 {
            for j in 0..=i {
                entries.push((t[i], t[j], area * g[i].dot(g[j])));
            }
        }
    }
    entries
}

/// Computes a map into the plane that changes angles as little as possible. The scale of this map is arbitrary.
fn conformal(
    part: &Part,
    stiffness: &[(u32, u32, f64)],
    progress: &dyn Progress,
) -> Result<Vec<DVec2>, SolveError> {
    let n = part.points.len();
    let start = project(part);
    // The equations have exactly one solution if the positions of two vertices are fixed. The two fixed vertices are
    // those with the lowest and the highest coordinate along the longer side of the bounding box of the projection.
    let (low, high) = start
        .iter()
        .fold((DVec2::MAX, DVec2::MIN), |(low, high), &p| {
            (low.min(p), high.max(p))
        });
    let is_wide = (high - low).x >= (high - low).y;
    let at = |i: &usize| if is_wide { start[*i].x } else { start[*i].y };
    let first = (0..n).min_by(|i, j| at(i).total_cmp(&at(j))).unwrap_or(0);
    let last = (0..n).max_by(|i, j| at(i).total_cmp(&at(j))).unwrap_or(0);
    // The energy measures how much the map changes angles. Twice the energy is the Dirichlet energy of both coordinates
    // minus twice the area of the map. This area depends only on the border of the map.
    let mut sides: Vec<(u32, u32, bool)> = part
        .triangles
        .iter()
        .flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)])
        .map(|(i, j)| (i.min(j), i.max(j), i < j))
        .collect();
    sides.sort_unstable();
    let mut entries = Vec::with_capacity(2 * stiffness.len() + 2 * sides.len());
    for &(i, j, value) in stiffness {
        entries.push((2 * i, 2 * j, value));
        entries.push((2 * i + 1, 2 * j + 1, value));
    }
    for edge in sides.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let sum: f64 = edge.iter().map(|s| if s.2 { 0.5 } else { -0.5 }).sum();
        let (i, j, _) = edge[0];
        if sum != 0.0 {
            entries.push((2 * i, 2 * j + 1, -sum));
            entries.push((2 * j, 2 * i + 1, sum));
        }
    }
    let matrix = SymmetricMatrix::from_entries(2 * n, entries);
    let mut x: Vec<f64> = start.iter().flat_map(DVec2::to_array).collect();
    let mut is_pinned = vec![false; 2 * n];
    for i in [first, last] {
        is_pinned[2 * i] = true;
        is_pinned[2 * i + 1] = true;
    }
    Factor::with_pins(&matrix, &is_pinned, progress)?.solve(&vec![0.0; 2 * n], &mut x)?;
    Ok(x.chunks_exact(2).map(|p| DVec2::new(p[0], p[1])).collect())
}

/// Improves a map with the iterations described in [`flatten`].
fn rigid(
    part: &Part,
    frames: &[Frame],
    stiffness: &[(u32, u32, f64)],
    start: &[DVec2],
    progress: &dyn Progress,
) -> Result<Vec<DVec2>, SolveError> {
    let n = start.len();
    let area: f64 = frames.iter().map(Frame::area).sum();
    let mut uvs = start.to_vec();
    let matrix = SymmetricMatrix::from_entries(n, stiffness.to_vec());
    let mut is_pinned = vec![false; n];
    is_pinned[0] = true;
    let factor = Factor::with_pins(&matrix, &is_pinned, progress)?;
    let gradients: Vec<[DVec2; 3]> = frames.iter().map(Frame::gradients).collect();
    for iteration in 0..MAX_ITERATIONS {
        progress.report("flatten", iteration as u64, MAX_ITERATIONS as u64)?;
        let mut forces = vec![DVec2::ZERO; n];
        for ((t, frame), g) in part.triangles.iter().zip(frames).zip(&gradients) {
            let [a, b, c] = t.map(|v| uvs[v as usize]);
            let (x, y) = (
                a * g[0].x + b * g[1].x + c * g[2].x,
                a * g[0].y + b * g[1].y + c * g[2].y,
            );
            let turn = DVec2::new(x.x + y.y, x.y - y.x) / 2.0;
            let r = turn.length();
            let turn = if r > 0.0 {
                turn / r * scale_next_to(r)
            } else {
                DVec2::X
            };
            for (&v, g) in t.iter().zip(g) {
                forces[v as usize] += turn.rotate(*g) * frame.area();
            }
        }
        let mut next = uvs.clone();
        factor.solve(&forces, &mut next)?;
        let moved: f64 = next
            .iter()
            .zip(&uvs)
            .map(|(p, q)| p.distance_squared(*q))
            .sum();
        uvs = next;
        if moved <= SMALL_MOVE * SMALL_MOVE * area * n as f64 {
            break;
        }
    }
    Ok(uvs)
}

/// Returns the scale s that replaces the scale `r` of a similarity transformation: s minimizes
/// 2 (s - r)^2 + lambda (s^2 - 1)^2, where lambda is [`AREA_WEIGHT`]. The minimum is computed by Newton's method.
fn scale_next_to(r: f64) -> f64 {
    let mut s = if r > 1.0 { r } else { 1.0 };
    for _ in 0..20 {
        let slope = 1.0 - AREA_WEIGHT + 3.0 * AREA_WEIGHT * s * s;
        let step = (AREA_WEIGHT * s * s * s + (1.0 - AREA_WEIGHT) * s - r) / slope;
        s -= step;
        if step.abs() <= 1e-12 * s {
            break;
        }
    }
    s
}
