//! The limit masks of a settled star. A star is a vertex and its neighborhood. A star is settled if it has no
//! semi-sharp elements. (The sharpness of a semi-sharp element changes from level to level.)

use std::f64::consts::{PI, TAU};

use mesh::{DMat3, DVec3};

use super::star::Star;
use crate::sharpness::VertexRule;

/// The number of levels after which a dart (the end of a single sharp edge) has converged. Each level reduces
/// the error by more than a third.
const LEVELS_TO_CONVERGE: usize = 96;

/// A sector of a star: the faces that share one tangent plane. The sector has `n_faces` faces, counter-clockwise from
/// spoke `first`. (The spokes are the edges at the center of the star.)
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Sector {
    first: usize,
    n_faces: usize,
    /// Whether the sector goes all the way around the vertex, so that its first spoke is also its last spoke.
    is_closed: bool,
}

impl Sector {
    /// Returns the sector that contains face `face`. On each side of this face, the sector extends to the next sharp
    /// spoke.
    pub(crate) fn of_face(star: &Star, face: usize) -> Self {
        let n = star.spokes.len();
        let is_sharp = |i: usize| star.spoke_sharpness[i % n] > 0.0;
        let n_sharp = star.spoke_sharpness.iter().filter(|&&s| s > 0.0).count();
        if star.is_inner && n_sharp < 2 {
            return Self {
                first: star
                    .spoke_sharpness
                    .iter()
                    .position(|&s| s > 0.0)
                    .unwrap_or(0),
                n_faces: n,
                is_closed: true,
            };
        }
        let back = (0..n).find(|&i| is_sharp(face + n - i)).unwrap_or(0);
        let first = (face + n - back) % n;
        let n_faces = (1..n).find(|&i| is_sharp(first + i)).unwrap_or(n);
        Self {
            first,
            n_faces,
            is_closed: false,
        }
    }
}

impl Star {
    /// Returns the limit position of the vertex.
    pub(crate) fn limit(&self) -> DVec3 {
        match self.rule() {
            VertexRule::Corner => self.center,
            VertexRule::Crease([i, j]) => {
                2.0 / 3.0 * self.center + (self.spokes[i] + self.spokes[j]) / 6.0
            }
            VertexRule::Smooth if self.spoke_sharpness.iter().any(|&s| s > 0.0) => {
                let mut star = self.clone();
                for _ in 0..LEVELS_TO_CONVERGE {
                    star.refine();
                }
                star.center
            }
            VertexRule::Smooth => self.smooth_limit(),
        }
    }

    fn smooth_limit(&self) -> DVec3 {
        let n = self.spokes.len() as f64;
        let spokes: DVec3 = self.spokes.iter().sum();
        if let Some(weights) = self.loop_weights {
            let w = 1.0 / (n + 3.0 / (8.0 * weights.of(self.spokes.len())));
            return (1.0 - n * w) * self.center + w * spokes;
        }
        let opposite: DVec3 = self.opposite.iter().sum();
        (n * n * self.center + 4.0 * spokes + opposite) / (n * (n + 5.0))
    }

    /// Returns two vectors that span the tangent plane of a sector, counter-clockwise when seen from outside.
    pub(crate) fn tangents(&self, sector: Sector) -> [DVec3; 2] {
        match self.rule() {
            VertexRule::Smooth if self.spoke_sharpness.iter().any(|&s| s > 0.0) => {
                self.dart_tangents()
            }
            VertexRule::Smooth => self.smooth_tangents(),
            VertexRule::Crease(_) => self.crease_tangents(sector),
            VertexRule::Corner => self.corner_tangents(sector),
        }
    }

    /// Returns spoke `i` of a sector.
    fn spoke(&self, sector: Sector, i: usize) -> DVec3 {
        self.spokes[(sector.first + i) % self.spokes.len()]
    }

    fn smooth_tangents(&self) -> [DVec3; 2] {
        let n = self.spokes.len() as f64;
        let theta = TAU / n;
        // The weight of the opposite corner of a quad is `scale` times the sum of the weights of the quad's two spokes.
        let scale = if self.loop_weights.is_some() {
            0.0
        } else {
            1.0 / (16.0 * quad_eigenvalue(theta) - 4.0)
        };
        let mut tangents = [DVec3::ZERO; 2];
        for (i, spoke) in self.spokes.iter().enumerate() {
            let [here, next] = [i, i + 1].map(|i| libm::sincos(i as f64 * theta));
            tangents[0] += here.1 * spoke;
            tangents[1] += here.0 * spoke;
            if let Some(opposite) = self.opposite.get(i) {
                tangents[0] += scale * (here.1 + next.1) * opposite;
                tangents[1] += scale * (here.0 + next.0) * opposite;
            }
        }
        tangents
    }

    /// Returns two tangents: one along the crease, and one that points across the crease into the k faces of the
    /// sector. The weights of the second tangent are a left eigenvector of the subdivision matrix. With θ = π/k, the
    /// weight of inner spoke i is sin(iθ), and the weight of the opposite corner between spokes i and i + 1 is m
    /// (sin(iθ) + sin((i+1)θ)). The factor m depends on the scheme and on θ. The weights at the ends of the crease and
    /// at the center follow from the other weights. (The literature gives the eigenvector for k ≤ 3 and for other
    /// crease rules.) If the sector has six or more triangles, the surface has no tangent plane in the sector. In this
    /// case, the returned plane contains the tangent of the crease.
    fn crease_tangents(&self, sector: Sector) -> [DVec3; 2] {
        let k = sector.n_faces;
        let [first, last] = [0, k].map(|i| self.spoke(sector, i));
        let along = first - last;
        if k == 1 {
            return [along, first + last - 2.0 * self.center];
        }
        let theta = PI / k as f64;
        let (sin, cos) = libm::sincos(theta);
        // The sum of sin(iθ) over the inner spokes i.
        let sines = (1.0 + cos) / sin;
        let (m, end) = if self.loop_weights.is_some() {
            (0.0, -cos * sines / (1.0 + 2.0 * cos))
        } else {
            let lambda = quad_eigenvalue(theta);
            let m = 1.0 / (16.0 * lambda - 4.0);
            let end = sin * (1.0 + 4.0 * m) / 16.0 - sines * (1.0 + 2.0 * m) / 8.0;
            (m, end / (lambda - 0.25))
        };
        let mut across = end * (first + last) - (2.0 * end + sines * (1.0 + 2.0 * m)) * self.center;
        let n = self.spokes.len();
        for i in 0..k {
            let [here, next] = [i, i + 1].map(|i| libm::sin(i as f64 * theta));
            if i > 0 {
                across += here * self.spoke(sector, i);
            }
            if let Some(opposite) = self.opposite.get((sector.first + i) % n) {
                across += m * (here + next) * opposite;
            }
        }
        [along, across]
    }

    /// Returns the directions of the first and the last spoke of a sector at a corner. These directions are tangents of
    /// the crease curves. The two directions are swapped if the corner is concave. In two cases, returns two vectors
    /// that are perpendicular to the mean of the face normals instead: if the two directions do not span a plane, or if
    /// the sector goes all the way around the vertex (a cone).
    fn corner_tangents(&self, sector: Sector) -> [DVec3; 2] {
        let arm = |i: usize| self.spoke(sector, i) - self.center;
        let faces = 0..sector.n_faces;
        let mean: DVec3 = faces.map(|i| arm(i).cross(arm(i + 1))).sum();
        let [first, last] = [arm(0), arm(sector.n_faces)];
        let turn = first.cross(last).dot(mean);
        if sector.n_faces == 1 {
            return [first, last];
        }
        let is_plane = turn.abs() > 1e-9 * first.length() * last.length() * mean.length();
        if sector.is_closed || !is_plane {
            let n = mean.normalize_or_zero();
            let along = first - first.dot(n) * n;
            return [along, n.cross(along)];
        }
        if turn > 0.0 {
            [first, last]
        } else {
            [last, first]
        }
    }

    /// Returns two vectors that span the plane to which the one-ring of a dart (the end of a single sharp edge)
    /// converges.
    fn dart_tangents(&self) -> [DVec3; 2] {
        let sector = Sector::of_face(self, 0);
        let [along, across] = self.corner_tangents(sector);
        let along = along.normalize_or_zero();
        let normal = along.cross(across).normalize_or_zero();
        let frame = DMat3::from_cols(along, normal.cross(along), normal);
        // The one-ring shrinks by different factors in different directions. Without a correction, only the direction
        // that shrinks most slowly would remain after some levels. Orthogonal iteration preserves all directions: after
        // each level the columns x, y and z are made orthonormal. An upper triangular matrix converts the orthonormal
        // columns back to the previous columns. The product of the upper triangular matrices over all levels is stored
        // without a common factor. The rows of the product are (1, b, c), s (0, 1, e) and s q (0, 0, 1); the five
        // numbers b, c, e, s and q are updated at each level. The first two rows converge to vectors that span the
        // plane.
        let mut star = self.clone();
        let to_frame = frame.transpose();
        for p in star.points() {
            *p = to_frame * (*p - self.center);
        }
        star.center = DVec3::ZERO;
        let (mut b, mut c, mut e) = (0.0, 0.0, 0.0);
        let (mut s, mut q) = (1.0, 1.0);
        for _ in 0..LEVELS_TO_CONVERGE {
            star.refine();
            let center = std::mem::take(&mut star.center);
            for p in star.points() {
                *p -= center;
            }
            let [x, y, z] = orthonormalize(&mut star);
            if x.x <= 0.0 || y.y <= 0.0 {
                break;
            }
            c += (y.x * s * e + z.x * s * q) / x.x;
            b += y.x * s / x.x;
            e += z.y * q / y.y;
            s *= y.y / x.x;
            q *= z.z / y.y;
        }
        let slowest = frame * DVec3::new(1.0, b, c).normalize();
        let normal = frame * DVec3::new(b * e - c, -e, 1.0);
        [slowest, normal.cross(slowest)]
    }

    /// Iterates over all points around the center.
    fn points(&mut self) -> impl Iterator<Item = &mut DVec3> {
        self.spokes.iter_mut().chain(&mut self.opposite)
    }
}

/// Returns the eigenvalue of Catmull-Clark subdivision whose eigenvectors turn by `theta` from spoke to spoke.
fn quad_eigenvalue(theta: f64) -> f64 {
    let (cos, half) = (libm::cos(theta), libm::cos(theta / 2.0));
    (5.0 + cos + half * (2.0 * (9.0 + cos)).sqrt()) / 16.0
}

/// Makes the columns of coordinates orthonormal (Gram-Schmidt). Returns the columns of the upper triangular matrix
/// that converts the orthonormal columns back to the original columns.
fn orthonormalize(star: &mut Star) -> [DVec3; 3] {
    let mut columns = [DVec3::ZERO; 3];
    for j in 0..3 {
        for i in 0..j {
            let dot: f64 = star.points().map(|p| p[i] * p[j]).sum();
            star.points().for_each(|p| p[j] -= dot * p[i]);
            columns[j][i] = dot;
        }
        let length = star.points().map(|p| p[j] * p[j]).sum::<f64>().sqrt();
        if length > 0.0 {
            star.points().for_each(|p| p[j] /= length);
        }
        columns[j][j] = length;
    }
    columns
}
