//! Measures the distance between two surfaces: the largest distance, with an upper bound, and the mean distance.
//!
//! The Hausdorff distance is the largest distance from a point of one surface to the other surface. The largest
//! distance can be at a point inside a face: for example, a spike of the other surface can end over the middle of a
//! face. Therefore triangles are cut into pieces. Let l be the largest distance found so far, plus a tolerance. The
//! cutting stops when no point of any piece can be further from the other surface than l:
//!
//! ```text
//!     c              c
//!    / \            /|\       Distances are computed at the corners and centers of pieces. By convexity,
//!   /   \   --->   / | \      no point of a piece is further from a triangle of the other surface than
//!  a-----b        a--m--b     the furthest corner of the piece. This gives a bound for all points.
//! ```
//!
//! A piece is cut only if its upper bound exceeds the largest distance found so far by more than the tolerance. Source
//! of the measures: Aspert, Santa-Cruz, Ebrahimi, "MESH: Measuring Errors between Surfaces using the Hausdorff
//! Distance", 2002. Source of the bounds and of the cutting: Tang, Lee, Kim, "Interactive Hausdorff Distance
//! Computation for General Polygonal Models", 2009. Pieces are cut in rounds. The largest distance is updated only
//! after each round, so that the result is the same for any number of threads.

mod piece;

use mesh::{DVec3, Domain, Element, FaceId, Mesh, VertexId, parallel};

use progress::{Cancelled, NoProgress, Progress};

use crate::surface_index::{Nearest, SurfaceIndex, Triangle, triangulate};
use crate::triangulate::Cutter;
use crate::{Scaled, area, bounds};

use piece::{Farthest, Piece, Sample, refine};

/// The distances between two surfaces, measured in both directions: from the first surface to the second, and back.
/// Lengths are in scene units.
#[derive(Clone, Debug, PartialEq)]
pub struct Distance {
    /// The distances from the points of the first surface to the second surface.
    pub forth: OneSided,
    /// The distances from the points of the second surface to the first surface.
    pub back: OneSided,
}

/// The distances from the points of one surface to another surface.
#[derive(Clone, Debug, PartialEq)]
pub struct OneSided {
    /// The largest distance found: the distance from the point `from` to the other surface, exact up to rounding. If
    /// very many triangles are almost equally near to this point, the search for the nearest triangle stops early. In
    /// this case, the value is only a lower bound of the distance from this point.
    pub largest: f64,
    /// An upper bound of the distances from all points of this surface to the other surface.
    pub at_most: f64,
    /// The distance averaged over the area of this surface, computed from samples at the corners of triangles and
    /// inside triangles. If the area of the surface is zero, this value is the mean over the vertices.
    pub mean: f64,
    /// The point of this surface at which the largest distance was found.
    pub from: SurfacePoint,
    /// The point of the other surface that is nearest to `from`.
    pub to: SurfacePoint,
}

/// A point on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The position of the point.
    pub position: DVec3,
    /// The vertex or face that the point lies on.
    pub on: Element,
}

/// The default tolerance, as a fraction of the diagonal of the common bounding box of both surfaces.
pub const TOLERANCE: f64 = 1e-5;

/// The text that progress reports show for the measurement.
const WHAT: &str = "measure the distance";

/// A function that asks the progress listener whether to continue. The measurement calls this function at least once
/// every few milliseconds.
type Ask<'a> = dyn Fn() -> Result<(), Cancelled> + Sync + 'a;

impl Distance {
    /// Measures the distance between two surfaces. `tolerance` is the largest allowed error of the Hausdorff distance,
    /// in scene units. If `None`, the tolerance is [`TOLERANCE`] times the [`diagonal`]. If the tolerance is very
    /// small, the search can stop before the error is within the tolerance. Even then, [`at_most`](Self::at_most) is a
    /// valid upper bound. Returns `None` if one of the meshes has no faces.
    pub fn between(a: &Mesh, b: &Mesh, tolerance: Option<f64>) -> Option<Self> {
        let found = Self::between_with(a, b, tolerance, &NoProgress);
        found.expect("never canceled")
    }

    /// Measures the distance like [`between`](Self::between), and reports progress.
    ///
    /// # Errors
    ///
    /// Returns [`Cancelled`] if `progress` asks to stop.
    pub fn between_with(
        a: &Mesh,
        b: &Mesh,
        tolerance: Option<f64>,
        progress: &dyn Progress,
    ) -> Result<Option<Self>, Cancelled> {
        progress.report(WHAT, 0, 2)?;
        let [scaled_a, scaled_b] = Scaled::pair(a, b);
        let (a, b) = (scaled_a.mesh(), scaled_b.mesh());
        let (from_a, from_b) = rayon::join(
            || SurfaceIndex::with_progress(a, progress),
            || SurfaceIndex::with_progress(b, progress),
        );
        let (Some(surface_a), Some(surface_b)) = (from_a?, from_b?) else {
            return Ok(None);
        };
        let tolerance = tolerance.map(|tolerance| scaled_a.scaled(tolerance));
        let tolerance = tolerance.unwrap_or_else(|| TOLERANCE * diagonal(a, b));
        let ask = |done| move || progress.report(WHAT, done, 2);
        Ok(Some(Self {
            forth: OneSided::measure(a, &surface_b, tolerance, &ask(0))?.restored(&scaled_a),
            back: OneSided::measure(b, &surface_a, tolerance, &ask(1))?.restored(&scaled_a),
        }))
    }

    /// Whether the [`largest`](OneSided::largest) distance from the first surface to the second is at least as large as
    /// the largest distance in the opposite direction.
    pub fn is_worst_forth(&self) -> bool {
        self.forth.largest >= self.back.largest
    }

    /// Returns the distances in one of the two directions: the one with the larger [`largest`](OneSided::largest)
    /// distance.
    pub fn worst(&self) -> &OneSided {
        if self.is_worst_forth() {
            &self.forth
        } else {
            &self.back
        }
    }

    /// Returns the largest distance that was found in either of the two directions. The Hausdorff distance is between
    /// this value and [`at_most`](Self::at_most).
    pub fn largest(&self) -> f64 {
        self.worst().largest
    }

    /// Returns an upper bound of the Hausdorff distance.
    pub fn at_most(&self) -> f64 {
        self.forth.at_most.max(self.back.at_most)
    }

    /// Returns the larger of the two mean distances.
    pub fn mean(&self) -> f64 {
        self.forth.mean.max(self.back.mean)
    }
}

/// Returns the length of the diagonal of the common bounding box of two meshes.
pub fn diagonal(a: &Mesh, b: &Mesh) -> f64 {
    match (bounds(a), bounds(b)) {
        (Some([min, max]), Some([low, high])) => max.max(high).distance(min.min(low)),
        (Some([min, max]), None) | (None, Some([min, max])) => max.distance(min),
        (None, None) => 0.0,
    }
}

impl std::fmt::Display for SurfacePoint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [x, y, z] = self.position.to_array().map(mesh::readable);
        write!(f, "{} at [{x}, {y}, {z}]", self.on)
    }
}

/// The approximate number of samples for the mean distance of a surface that has only a few large triangles.
const SAMPLES: f64 = 50_000.0;

/// The number of faces in a block. One thread measures all faces of a block. Neither the blocks nor the sums over the
/// blocks depend on the number of threads.
const BLOCK: usize = 1024;

/// The result of measuring one block of faces.
#[derive(Default)]
struct Block {
    /// Pieces (triangles) whose upper bounds exceed a limit: the largest distance measured at a vertex, plus the
    /// tolerance. Only these pieces can be cut later.
    pieces: Vec<Piece>,
    /// An upper bound of the distance to the other surface, for all points of the block that are in none of the
    /// `pieces`.
    ceiling: f64,
    farthest: Option<Farthest>,
    /// The sum of the areas of the triangles.
    area: f64,
    /// A sum over the triangles: the area of each triangle times its mean distance.
    weighted: f64,
}

impl OneSided {
    fn measure(
        from: &Mesh,
        to: &SurfaceIndex,
        tolerance: f64,
        ask: &Ask,
    ) -> Result<Self, Cancelled> {
        let hits = vertex_hits(from, to, ask)?;
        let slots = from.domain_len(Domain::Face);
        let mut farthest = farthest_vertex(from, &hits).expect("a mesh with faces has vertices");
        // A triangle with more than this area gets several samples, so that no sample represents a larger area.
        let area_per_sample = area(from) / SAMPLES;
        let threshold = farthest.lower_bound() + tolerance;
        let blocks: Result<Vec<Block>, Cancelled> = parallel::map(slots.div_ceil(BLOCK), |b| {
            let (mut block, mut triangles) = (Block::default(), Vec::new());
            let mut cutter = Cutter::default();
            let faces = (b * BLOCK..slots.min((b + 1) * BLOCK)).map(FaceId::new);
            for f in faces.filter(|&f| from.has_face(f)) {
                triangles.clear();
                triangulate(from, f, &mut cutter, &mut triangles, ask)?;
                for (i, triangle) in triangles.iter().enumerate() {
                    if i % 64 == 0 {
                        ask()?;
                    }
                    block.add(triangle, &hits, to, area_per_sample, threshold, ask)?;
                }
            }
            Ok(block)
        })
        .into_iter()
        .collect();
        let blocks = blocks?;
        let (mut area, mut weighted) = (0.0, 0.0);
        let mut ceiling = hits
            .iter()
            .flatten()
            .fold(0.0, |c, hit| hit.distance.max(c));
        let mut pieces = Vec::new();
        for block in blocks {
            farthest = farthest.or(block.farthest);
            ceiling = ceiling.max(block.ceiling);
            area += block.area;
            weighted += block.weighted;
            pieces.extend(block.pieces);
        }
        let mean = if area > 0.0 {
            weighted / area
        } else {
            mean_of(&hits)
        };
        let (farthest, at_most) = refine(pieces, farthest, ceiling, to, tolerance, ask)?;
        let (from, to) = farthest.points(to);
        Ok(Self {
            largest: farthest.lower_bound(),
            at_most,
            mean,
            from,
            to,
        })
    }
}

impl OneSided {
    /// Converts the distances from the unit of length of the scaled meshes to scene units.
    fn restored(self, scaled: &Scaled) -> Self {
        let point = |point: SurfacePoint| SurfacePoint {
            position: scaled.restored_point(point.position),
            ..point
        };
        Self {
            largest: scaled.restored(self.largest, 1),
            at_most: scaled.restored(self.at_most, 1),
            mean: scaled.restored(self.mean, 1),
            from: point(self.from),
            to: point(self.to),
        }
    }
}

impl Block {
    fn add(
        &mut self,
        triangle: &Triangle,
        hits: &[Option<Nearest>],
        to: &SurfaceIndex,
        area_per_sample: f64,
        threshold: f64,
        ask: &Ask,
    ) -> Result<(), Cancelled> {
        let corners = [0, 1, 2].map(|k| Sample {
            at: triangle.positions[k],
            hit: hits[triangle.vertices[k].index()].expect("corners are vertices of the mesh"),
        });
        let mut piece = Piece::new(corners, triangle.face, to);
        let middle = piece.middle(to);
        piece.lower(&middle, to);
        self.record(piece.at(middle));

        let [a, b, c] = triangle.positions;
        let area = 0.5 * (b - a).cross(c - a).length();
        self.area += area;
        let rows = (area / area_per_sample).sqrt().ceil();
        let distance = if rows > 1.0 {
            self.mean_over(&piece, triangle, rows, to, ask)?
        } else {
            // Computes the mean distance over the triangle from the distances at the center and at the corners. The
            // formula is exact if the distance is a quadratic function of the position.
            let sum: f64 = corners.iter().map(|s| s.hit.distance).sum();
            0.75 * middle.hit.distance + sum / 12.0
        };
        self.weighted += area * distance;

        if piece.upper > threshold {
            self.pieces.push(piece);
        } else {
            self.ceiling = self.ceiling.max(piece.upper);
        }
        Ok(())
    }

    /// Divides a triangle into `rows` rows of smaller triangles. Returns the mean of the distances at the centers of
    /// the smaller triangles.
    fn mean_over(
        &mut self,
        piece: &Piece,
        triangle: &Triangle,
        rows: f64,
        to: &SurfaceIndex,
        ask: &Ask,
    ) -> Result<f64, Cancelled> {
        let [a, b, c] = triangle.positions;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the number is positive and at most the square root of `SAMPLES`"
        )]
        let n = rows.min(SAMPLES.sqrt()) as u32;
        let third = 1.0 / 3.0;
        let (mut sum, mut count, mut hint) = (0.0, 0.0, 0);
        for i in 0..n {
            ask()?;
            for j in 0..n - i {
                // Parallels to the sides divide the large triangle into small triangles. Small triangle (i, j) has the
                // orientation of the large triangle. Beside it is an inverted small triangle, except at the end of a
                // row.
                let n_parts = if i + j + 2 <= n { 2 } else { 1 };
                for shift in [third, 2.0 * third].into_iter().take(n_parts) {
                    let (u, v) = (f64::from(i) + shift, f64::from(j) + shift);
                    let at = a + (u / f64::from(n)) * (b - a) + (v / f64::from(n)) * (c - a);
                    let hit = to.nearest(at, hint);
                    hint = hit.triangle;
                    self.record(piece.at(Sample { at, hit }));
                    sum += hit.distance;
                    count += 1.0;
                }
            }
        }
        Ok(sum / count)
    }

    fn record(&mut self, sample: Farthest) {
        self.farthest = Some(self.farthest.map_or(sample, |best| best.or(Some(sample))));
    }
}

/// Returns, for each vertex of `from`, the nearest point of the surface `to`. Entry i belongs to the vertex with the
/// index i. Isolated vertices also get an entry.
fn vertex_hits(
    from: &Mesh,
    to: &SurfaceIndex,
    ask: &Ask,
) -> Result<Vec<Option<Nearest>>, Cancelled> {
    let position = |i| {
        let v = VertexId::new(i);
        from.has_vertex(v).then(|| from.position(v))
    };
    to.nearest_to_all(from.domain_len(Domain::Vertex), position, &|_| ask())
}

/// Returns the distance from each vertex of `from` to the surface of `to`. Entry i belongs to the vertex with the index
/// i. The distance is NaN for dead (removed) vertices. Returns `None` if `to` has no faces.
pub fn vertex_distances(from: &Mesh, to: &Mesh) -> Option<Vec<f64>> {
    let found = vertex_distances_with(from, to, &NoProgress);
    found.expect("never canceled")
}

/// Returns the same distances as [`vertex_distances`], and reports progress.
///
/// # Errors
///
/// Returns [`Cancelled`] if `progress` asks to stop.
pub fn vertex_distances_with(
    from: &Mesh,
    to: &Mesh,
    progress: &dyn Progress,
) -> Result<Option<Vec<f64>>, Cancelled> {
    let [from, to] = Scaled::pair(from, to);
    let Some(index) = SurfaceIndex::with_progress(to.mesh(), progress)? else {
        return Ok(None);
    };
    let hits = index.nearest_to_vertices(from.mesh(), progress)?;
    let distance =
        |hit: Option<Nearest>| hit.map_or(f64::NAN, |hit| from.restored(hit.distance, 1));
    Ok(Some(hits.into_iter().map(distance).collect()))
}

fn farthest_vertex(from: &Mesh, hits: &[Option<Nearest>]) -> Option<Farthest> {
    let samples = from.vertices().filter_map(|v| {
        let at = from.position(v);
        let hit = hits[v.index()]?;
        let on = Element::Vertex(v);
        Some(Farthest {
            on,
            sample: Sample { at, hit },
        })
    });
    samples.reduce(|best, sample| best.or(Some(sample)))
}

fn mean_of(hits: &[Option<Nearest>]) -> f64 {
    let distance = |i: usize| hits[i].map_or(0.0, |hit| hit.distance);
    let count = hits.iter().flatten().count();
    parallel::sum(hits.len(), distance) / count as f64
}

#[cfg(test)]
mod tests;
