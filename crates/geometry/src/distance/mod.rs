//! The distance between two surfaces: the largest, with a bound of its error, and the mean.
//!
//! The Hausdorff distance is the largest distance from a point of one surface to the other surface.
//! It need not be at a vertex: a spike of the other surface may end over the middle of a face. So triangles
//! are cut until what is left of them cannot be further away than what was found by more than a tolerance:
//!
//! ```text
//!     c              c
//!    / \            /|\       d(p) is known at corners and middles of the pieces. A bound for all points
//!   /   \   --->   / | \      of a piece follows from convexity: a point is no further from a triangle
//!  a-----b        a--m--b     of the other surface than the furthest corner of its piece is.
//! ```
//!
//! Only pieces whose bound is above the largest distance found so far are cut. Aspert, Santa-Cruz, Ebrahimi,
//! "MESH: Measuring Errors between Surfaces using the Hausdorff Distance", 2002, for the measures; Tang, Lee,
//! Kim, "Interactive Hausdorff Distance Computation for General Polygonal Models", 2009, for bounding and
//! cutting. All pieces of a round are cut before the next round looks at what was found, so that the result
//! is the same for any number of threads.

mod piece;
mod surface;
mod triangle;

use mesh::{DVec3, Domain, Element, FaceId, Mesh, VertexId, blocks};

use crate::{area, bounds};
use rayon::prelude::*;

use piece::{Farthest, Piece, Sample, refine};
use surface::{Hit, Surface, Triangle, fan};

/// The distances between two surfaces, both ways. Lengths are in scene units.
#[derive(Clone, Debug, PartialEq)]
pub struct Distance {
    /// From the first surface to the second.
    pub forth: OneSided,
    /// From the second surface to the first.
    pub back: OneSided,
}

/// The distances from the points of one surface to another surface.
#[derive(Clone, Debug, PartialEq)]
pub struct OneSided {
    /// The largest that was found, to the last digit unless very many places are nearly as far.
    pub largest: f64,
    /// No point is further away than this.
    pub at_most: f64,
    /// The mean over the area, from samples at the corners and in the triangles; over the vertices if
    /// there is no area.
    pub mean: f64,
    /// Where the largest one begins.
    pub from: SurfacePoint,
    /// Where it ends: the nearest point of the other surface.
    pub to: SurfacePoint,
}

/// A point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Where it is.
    pub position: DVec3,
    /// The vertex or face that it lies on.
    pub on: Element,
}

/// The largest error that is asked for unless another one is given, in proportion to the diagonal of the
/// bounds of both surfaces.
pub const TOLERANCE: f64 = 1e-5;

impl Distance {
    /// Measures two surfaces, so that the largest distance is known to within `tolerance`, in scene units,
    /// or else to within [`TOLERANCE`] of their size. A very small tolerance may not be reached: then the
    /// bound says so. `None` if one of them has no faces.
    pub fn between(a: &Mesh, b: &Mesh, tolerance: Option<f64>) -> Option<Self> {
        let (from_a, from_b) = rayon::join(|| Surface::new(a), || Surface::new(b));
        let (surface_a, surface_b) = (from_a?, from_b?);
        let tolerance = tolerance.unwrap_or_else(|| TOLERANCE * diagonal(a, b));
        Some(Self {
            forth: OneSided::measure(a, &surface_b, tolerance),
            back: OneSided::measure(b, &surface_a, tolerance),
        })
    }

    /// Whether the larger distance is that from the first surface; it is if both are equal.
    pub fn is_worst_forth(&self) -> bool {
        self.forth.largest >= self.back.largest
    }

    /// The side with the larger distance.
    pub fn worst(&self) -> &OneSided {
        if self.is_worst_forth() {
            &self.forth
        } else {
            &self.back
        }
    }

    /// The largest distance that was found: the Hausdorff distance is this, or up to [`at_most`](Self::at_most).
    pub fn largest(&self) -> f64 {
        self.worst().largest
    }

    /// What the Hausdorff distance does not exceed.
    pub fn at_most(&self) -> f64 {
        self.forth.at_most.max(self.back.at_most)
    }

    /// The larger of the mean distances of the two sides.
    pub fn mean(&self) -> f64 {
        self.forth.mean.max(self.back.mean)
    }
}

/// The length of the diagonal of the bounds of two meshes together.
pub fn diagonal(a: &Mesh, b: &Mesh) -> f64 {
    match (bounds(a), bounds(b)) {
        (Some([min, max]), Some([low, high])) => max.max(high).distance(min.min(low)),
        (Some([min, max]), None) | (None, Some([min, max])) => max.distance(min),
        (None, None) => 0.0,
    }
}

impl std::fmt::Display for SurfacePoint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} at {}", self.on, self.position)
    }
}

/// The number of samples that a surface of few large triangles gets for its mean.
const SAMPLES: f64 = 50_000.0;

/// Elements that are measured by one task. Fixed, because sums are added block by block.
const BLOCK: usize = 1024;

/// What one task found.
#[derive(Default)]
struct Block {
    /// Pieces that may be further away than what was found.
    pieces: Vec<Piece>,
    /// No point of the rest is further away than this.
    ceiling: f64,
    farthest: Option<Farthest>,
    /// The sums of areas, and of areas times distances.
    area: f64,
    weighted: f64,
}

impl OneSided {
    fn measure(from: &Mesh, to: &Surface, tolerance: f64) -> Self {
        let hits = vertex_hits(from, to);
        let slots = from.domain_len(Domain::Face);
        let mut found = farthest_vertex(from, &hits).expect("a mesh with faces has vertices");
        // A sample stands for at most so much area.
        let portion = area(from) / SAMPLES;
        let enough = found.certain() + tolerance;
        let blocks: Vec<Block> = (0..slots.div_ceil(BLOCK))
            .into_par_iter()
            .map(|b| {
                let mut block = Block::default();
                let faces = (b * BLOCK..slots.min((b + 1) * BLOCK)).map(FaceId::new);
                for f in faces.filter(|&f| from.has_face(f)) {
                    for triangle in fan(from, f) {
                        block.add(&triangle, &hits, to, portion, enough);
                    }
                }
                block
            })
            .collect();
        let (mut area, mut weighted) = (0.0, 0.0);
        let mut ceiling = hits
            .iter()
            .flatten()
            .fold(0.0, |c, hit| hit.distance.max(c));
        let mut pieces = Vec::new();
        for block in blocks {
            found = found.or(block.farthest);
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
        let (found, at_most) = refine(pieces, found, ceiling, to, tolerance);
        let (from, to) = found.places(to);
        Self {
            largest: found.certain(),
            at_most,
            mean,
            from,
            to,
        }
    }
}

impl Block {
    fn add(
        &mut self,
        triangle: &Triangle,
        hits: &[Option<Hit>],
        to: &Surface,
        portion: f64,
        enough: f64,
    ) {
        let corners = [0, 1, 2].map(|k| Sample {
            at: triangle.at[k],
            hit: hits[triangle.vertices[k].index()].expect("corners are vertices of the mesh"),
        });
        let mut piece = Piece::new(corners, triangle.face, to);
        let middle = piece.middle(to);
        piece.lower(&middle, to);
        self.take(piece.at(middle));

        let [a, b, c] = triangle.at;
        let area = 0.5 * (b - a).cross(c - a).length();
        self.area += area;
        let rows = (area / portion).sqrt().ceil();
        let distance = if rows > 1.0 {
            self.mean_over(&piece, triangle, rows, to)
        } else {
            // Exact where the distance is a quadratic function of the place.
            let sum: f64 = corners.iter().map(|s| s.hit.distance).sum();
            0.75 * middle.hit.distance + sum / 12.0
        };
        self.weighted += area * distance;

        if piece.upper > enough {
            self.pieces.push(piece);
        } else {
            self.ceiling = self.ceiling.max(piece.upper);
        }
    }

    /// The mean of the distances at the middles of the parts of a triangle that is divided into so many rows.
    fn mean_over(&mut self, piece: &Piece, triangle: &Triangle, rows: f64, to: &Surface) -> f64 {
        let [a, b, c] = triangle.at;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small number: a triangle has at most the area of the mesh, save where that is not flat"
        )]
        let n = rows.min(SAMPLES.sqrt()) as u32;
        let third = 1.0 / 3.0;
        let (mut sum, mut count, mut hint) = (0.0, 0.0, 0);
        for i in 0..n {
            for j in 0..n - i {
                // The part that points as the triangle does, and, if it is inside, the one that points the
                // other way.
                let n_parts = if i + j + 2 <= n { 2 } else { 1 };
                for shift in [third, 2.0 * third].into_iter().take(n_parts) {
                    let (u, v) = (f64::from(i) + shift, f64::from(j) + shift);
                    let at = a + (u / f64::from(n)) * (b - a) + (v / f64::from(n)) * (c - a);
                    let hit = to.nearest(at, hint);
                    hint = hit.triangle;
                    self.take(piece.at(Sample { at, hit }));
                    sum += hit.distance;
                    count += 1.0;
                }
            }
        }
        sum / count
    }

    fn take(&mut self, sample: Farthest) {
        self.farthest = Some(self.farthest.map_or(sample, |best| best.or(Some(sample))));
    }
}

/// What is nearest to each vertex, by its place; vertices without faces belong to the mesh too.
fn vertex_hits(from: &Mesh, to: &Surface) -> Vec<Option<Hit>> {
    let mut hits = vec![None; from.domain_len(Domain::Vertex)];
    hits.par_chunks_mut(BLOCK)
        .enumerate()
        .for_each(|(b, block)| {
            // The last one found is a good guess, if the vertices have an order.
            let mut hint = 0;
            for (i, slot) in block.iter_mut().enumerate() {
                let v = VertexId::new(b * BLOCK + i);
                if from.has_vertex(v) {
                    let hit = to.nearest(from.position(v), hint);
                    hint = hit.triangle;
                    *slot = Some(hit);
                }
            }
        });
    hits
}

/// The distance from each vertex of a mesh to the surface of another, by its place; not a number for removed
/// vertices. `None` if the other one has no faces.
pub fn vertex_distances(from: &Mesh, to: &Mesh) -> Option<Vec<f64>> {
    let hits = vertex_hits(from, &Surface::new(to)?);
    let distance = |hit: Option<Hit>| hit.map_or(f64::NAN, |hit| hit.distance);
    Some(hits.into_iter().map(distance).collect())
}

fn farthest_vertex(from: &Mesh, hits: &[Option<Hit>]) -> Option<Farthest> {
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

fn mean_of(hits: &[Option<Hit>]) -> f64 {
    let distance = |i: usize| hits[i].map_or(0.0, |hit| hit.distance);
    let count = hits.iter().flatten().count();
    blocks::sum(hits.len(), distance) / count as f64
}

#[cfg(test)]
mod tests;
