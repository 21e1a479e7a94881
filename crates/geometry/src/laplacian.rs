//! The cotangent Laplacian of a surface, and the areas of its vertices.
//!
//! ```text
//!            k                    The weight w(i, j) of the edge i-j is (cot α + cot β) / 2. These weights form the
//!           /α\                   stiffness matrix of linear finite elements. Row i of the matrix times values u is
//!          /   \
//!         i-----j                     sum over j of w(i, j) (u(i) - u(j)).
//!          \   /
//!           \β/                   This sum approximates -a(i) times the Laplacian of u at the vertex i, where a(i) is
//!            l                    the area of the vertex.
//! ```
//!
//! Source of the weights: Pinkall, Polthier, "Computing Discrete Minimal Surfaces and Their Conjugates", 1993. Source
//! for polygons: Bunge, Herholz, Kazhdan, Botsch, "Polygon Laplacian Made Simple", 2020. Source for degenerate
//! triangles: Sharp, Crane, "A Laplacian for Nonmanifold Triangle Meshes", 2020, section 4.5.

use mesh::{DVec3, Domain, FaceId, Mesh, parallel};
use progress::{Cancelled, Meter, Progress};

use crate::sparse::SymmetricMatrix;
use crate::triangulate::Cutter;

/// A polygon with at least 4 corners and at most this number of corners is divided into triangles around a virtual
/// vertex in its middle. A polygon with more corners is cut into triangles along diagonals.
const MAX_CORNERS: usize = 16;
/// In every triangle, the sum of any two sides must exceed the third side by at least this fraction of the mean edge
/// length. If one triangle fails this test, all edges of all triangles are lengthened by the same length.
const SLACK: f64 = 1e-5;
/// The number of faces in a block. One thread computes the matrix entries of all faces of a block.
const FACES: usize = 4096;

/// The cotangent Laplacian of a surface, and for each vertex, the area of the surface that belongs to it.
///
/// # Examples
///
/// ```
/// use geometry::{Laplacian, shapes};
/// use progress::NoProgress;
///
/// let mesh = shapes::icosahedron();
/// let laplacian = Laplacian::new(&mesh, &NoProgress)?;
/// // Constants are in the kernel, and the areas add up to the area of the surface.
/// let zero = laplacian.stiffness.times(&[1.0; 12]);
/// assert!(zero.iter().all(|x| x.abs() < 1e-14));
/// assert!((laplacian.areas.iter().sum::<f64>() - geometry::area(&mesh)).abs() < 1e-13);
/// # Ok::<(), progress::Cancelled>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Laplacian {
    /// The stiffness matrix, with one row for each vertex. The matrix is positive semidefinite, and each row adds up to
    /// 0. For an edge between the vertices i and j, the entries (i, j) and (j, i) are minus the weight of the edge. The
    ///    entries have no unit.
    pub stiffness: SymmetricMatrix,
    /// The diagonal of the lumped mass matrix: the area that belongs to each vertex, in scene unit². Areas too large
    /// for an `f64` are replaced by its largest value, 1.8e308. The area is 0 for vertices without faces. For vertices
    /// with faces, the area is more than 0, unless it is too small for an `f64`.
    pub areas: Vec<f64>,
}

impl Laplacian {
    /// Computes the Laplacian of a mesh. The rows of dead (removed) vertices have no entries.
    ///
    /// A polygon with 4 to 16 corners is divided into triangles around a virtual vertex at the mean of its corners. The
    /// value at the virtual vertex is the mean of the values at the corners. For a polygon with 4 to 16 corners, the
    /// result therefore does not depend on a choice of diagonals. The gradient of a linear function on a flat polygon
    /// is exact. Polygons with more than 16 corners are cut into triangles along diagonals.
    ///
    /// If any triangle is degenerate or almost degenerate, the same small length is added to the edge lengths of all
    /// triangles. A triangle is almost degenerate if the sum of two of its sides exceeds the third side by less than
    /// 1e-5 times the mean edge length. After the addition, no triangle is almost degenerate. All entries are therefore
    /// finite for any finite positions.
    ///
    /// # Errors
    ///
    /// Returns [`Cancelled`] if `progress` asks to stop.
    pub fn new(mesh: &Mesh, progress: &dyn Progress) -> Result<Self, Cancelled> {
        let exponent = exponent(mesh.positions());
        let positions = mesh.positions();
        let points = parallel::collect(positions.len(), |v| scaled(positions[v], -exponent));
        let n_faces = mesh.domain_len(Domain::Face);
        let meter = Meter::new(progress, "measure faces", 2 * n_faces as u64).every(65_536);
        let n_blocks = n_faces.div_ceil(FACES);
        let faces = |b: usize| {
            let all = (b * FACES..n_faces.min((b + 1) * FACES)).map(FaceId::new);
            all.filter(|&f| mesh.has_face(f))
        };
        // For each block of faces: the sum of the lengths of all sides of its triangles, and the number of these sides.
        let sums: Result<Vec<[f64; 2]>, Cancelled> = parallel::map(n_blocks, |b| {
            let (mut sum, mut n, mut pieces) = (0.0, 0.0, Pieces::default());
            for f in faces(b) {
                pieces.set(mesh, &points, f);
                for lengths in pieces.triangles.iter().map(|t| lengths(pieces.points(*t))) {
                    sum += lengths.iter().sum::<f64>();
                    n += 3.0;
                }
            }
            meter.add(FACES)?;
            Ok([sum, n])
        })
        .into_iter()
        .collect();
        let [sum, n] = sums?
            .iter()
            .fold([0.0, 0.0], |a, b| [a[0] + b[0], a[1] + b[1]]);
        let slack = if sum > 0.0 { SLACK * (sum / n) } else { 1.0 };
        let missing: Vec<f64> = parallel::map(n_blocks, |b| {
            let (mut missing, mut pieces) = (0.0, Pieces::default());
            for f in faces(b) {
                pieces.set(mesh, &points, f);
                for [a, b, c] in pieces.triangles.iter().map(|t| lengths(pieces.points(*t))) {
                    let least = (a + b - c).min(b + c - a).min(c + a - b);
                    missing = f64::max(missing, slack - least);
                }
            }
            missing
        });
        let more = missing.into_iter().fold(0.0, f64::max);
        let parts: Result<Vec<Entries>, Cancelled> = parallel::map(n_blocks, |b| {
            let (mut entries, mut pieces) = (Entries::default(), Pieces::default());
            for f in faces(b) {
                pieces.set(mesh, &points, f);
                pieces.entries(more, &mut entries);
            }
            meter.add(FACES)?;
            Ok(entries)
        })
        .into_iter()
        .collect();
        let n = mesh.domain_len(Domain::Vertex);
        let (mut areas, mut stiffness) = (vec![0.0; n], Vec::new());
        for part in parts? {
            for (v, area) in part.areas {
                areas[v as usize] += area;
            }
            stiffness.extend(part.stiffness);
        }
        for area in &mut areas {
            *area = libm::scalbn(*area, 2 * exponent).min(f64::MAX);
        }
        let stiffness = SymmetricMatrix::from_entries(n, stiffness);
        Ok(Self { stiffness, areas })
    }
}

/// Returns the largest whole number n for which 2^n is at most the largest absolute coordinate of the points. Returns 0
/// if all coordinates are 0, or if a coordinate is infinite.
pub(crate) fn exponent(points: &[DVec3]) -> i32 {
    match parallel::fold(
        points.len(),
        0.0,
        |i| points[i].abs().max_element(),
        f64::max,
    ) {
        largest if largest > 0.0 && largest.is_finite() => libm::ilogb(largest),
        _ => 0,
    }
}

/// Returns the point `p` times 2 to the power of `exponent`. Each coordinate of the product is exact unless it
/// overflows or is near 0.
pub(crate) fn scaled(p: DVec3, exponent: i32) -> DVec3 {
    DVec3::from_array(p.to_array().map(|x| libm::scalbn(x, exponent)))
}

/// Returns the lengths of the sides of a triangle: entry i is the length of the side opposite corner i.
fn lengths([a, b, c]: [DVec3; 3]) -> [f64; 3] {
    [b.distance(c), c.distance(a), a.distance(b)]
}

/// Returns half the cotangent of each angle of a triangle, and the area of the triangle. The length of each side is
/// first increased by `more`.
fn half_cotangents(corners: [DVec3; 3], more: f64) -> ([f64; 3], f64) {
    if more == 0.0 {
        let [a, b, c] = corners;
        let double = (b - a).cross(c - a).length();
        let half_cot = |p: DVec3, q: DVec3, r: DVec3| 0.5 * (q - p).dot(r - p) / double;
        return (
            [half_cot(a, b, c), half_cot(b, c, a), half_cot(c, a, b)],
            0.5 * double,
        );
    }
    let [a, b, c] = lengths(corners).map(|l| l + more);
    // Heron's formula. All four factors are positive, because `more`, which is added to all lengths, is large enough.
    let area = 0.25 * ((a + b + c) * (b + c - a) * (c + a - b) * (a + b - c)).sqrt();
    let half_cot = |a: f64, b: f64, c: f64| (b * b + c * c - a * a) / (8.0 * area);
    (
        [half_cot(a, b, c), half_cot(b, c, a), half_cot(c, a, b)],
        area,
    )
}

#[derive(Default)]
struct Entries {
    stiffness: Vec<(u32, u32, f64)>,
    areas: Vec<(u32, f64)>,
}

/// The triangles into which one face is divided.
#[derive(Default)]
struct Pieces {
    /// The vertices of the face.
    corners: Vec<u32>,
    /// The positions of the corners, and of the virtual vertex if there is one.
    positions: Vec<DVec3>,
    triangles: Vec<[usize; 3]>,
    has_virtual: bool,
    cutter: Cutter,
    /// For each corner of the face, the weight of the edge from this corner to the virtual vertex.
    spokes: Vec<f64>,
}

impl Pieces {
    fn set(&mut self, mesh: &Mesh, points: &[DVec3], f: FaceId) {
        self.corners.clear();
        let number = |v: mesh::VertexId| u32::try_from(v.index()).expect("ids fit 32 bits");
        self.corners.extend(mesh.face_vertices(f).map(number));
        self.positions.clear();
        self.positions
            .extend(self.corners.iter().map(|&v| points[v as usize]));
        self.triangles.clear();
        let n = self.corners.len();
        self.has_virtual = (4..=MAX_CORNERS).contains(&n);
        if self.has_virtual {
            let mean = self.positions.iter().sum::<DVec3>() / n as f64;
            self.positions.push(mean);
            self.triangles.extend((0..n).map(|i| [i, (i + 1) % n, n]));
        } else if n == 3 {
            self.triangles.push([0, 1, 2]);
        } else if n > 3 {
            let cut = self.cutter.cut(mesh, f);
            let corners = |t: &[u32; 3]| t.map(|i| i as usize);
            self.triangles.extend(cut.triangles().iter().map(corners));
        }
    }

    fn points(&self, triangle: [usize; 3]) -> [DVec3; 3] {
        triangle.map(|i| self.positions[i])
    }

    /// Appends the matrix entries and the vertex areas that the face contributes.
    fn entries(&mut self, more: f64, entries: &mut Entries) {
        let n = self.corners.len();
        self.spokes.clear();
        self.spokes.resize(n, 0.0);
        for t in 0..self.triangles.len() {
            let corners = self.triangles[t];
            let (weights, area) = half_cotangents(self.points(corners), more);
            for (k, weight) in weights.into_iter().enumerate() {
                let [i, j] = [corners[(k + 1) % 3], corners[(k + 2) % 3]];
                if i < n && j < n {
                    self.edge(i, j, weight, &mut entries.stiffness);
                } else {
                    self.spokes[i.min(j)] += weight;
                }
            }
            let third = area / 3.0;
            for &i in corners.iter().filter(|&&i| i < n) {
                entries.areas.push((self.corners[i], third));
            }
            if self.has_virtual {
                let share = third / n as f64;
                entries
                    .areas
                    .extend(self.corners.iter().map(|&v| (v, share)));
            }
        }
        if self.has_virtual {
            // A spoke is an edge from a corner to the virtual vertex. Let s(i) be the weight of the spoke to corner i.
            // Let u(i) be the value at corner i, and m the mean of these values. The energy is the sum of s(i) (u(i) -
            // m)² over all corners i.
            let total: f64 = self.spokes.iter().sum();
            let count = n as f64;
            for i in 0..n {
                for j in i + 1..n {
                    let weight =
                        (self.spokes[i] + self.spokes[j]) / count - total / (count * count);
                    self.edge(i, j, weight, &mut entries.stiffness);
                }
            }
        }
    }

    /// Appends the matrix entries of the energy `weight` times (u(i) - u(j))². Here u(i) is the value at corner i.
    fn edge(&self, i: usize, j: usize, weight: f64, entries: &mut Vec<(u32, u32, f64)>) {
        let [i, j] = [self.corners[i], self.corners[j]];
        if i != j {
            entries.extend([(i, j, -weight), (i, i, weight), (j, j, weight)]);
        }
    }
}

#[cfg(test)]
mod tests;
