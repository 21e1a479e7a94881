//! The target lengths of edges.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use mesh::{DVec3, Domain, FaceId, VertexId};

use super::Length;
use super::original::{Original, Place};
use crate::{gaussian_curvatures, mean_curvatures};

/// An edge longer than this multiple of its target length is split.
pub(super) const LONG: f64 = 4.0 / 3.0;

/// An edge shorter than this multiple of its target length is collapsed.
pub(super) const SHORT: f64 = 4.0 / 5.0;

/// Along an edge, the target length is allowed to grow by at most this fraction of the length of the edge. The target
/// lengths of neighboring triangles therefore differ by at most about this fraction.
const GROWTH: f64 = 0.5;

/// The target length at each point of the original surface, in its scaled coordinates.
pub(super) enum Sizes {
    Uniform(f64),
    /// A target length for each vertex of the original surface.
    Varying(Vec<f64>),
}

impl Sizes {
    /// Computes the target lengths from the requested `length`. `error` is the largest allowed distance between the
    /// original surface and the result; `None` if there is no limit. Where edges of the target length would deviate
    /// from the surface by more than this distance, the target length is reduced. The reduced length is not below the
    /// smallest requested length `min`. A uniform length has no `min`; in this case, the reduced length is not below
    /// `error`.
    pub(super) fn new(original: &Original, length: Length, error: Option<f64>) -> Self {
        let (error, min, max) = match (length, error) {
            (Length::Uniform(length), None) => return Self::Uniform(length * original.scale),
            (Length::Uniform(length), Some(error)) => (error, error.min(length), length),
            (Length::Curvature { error, min, max }, limit) => {
                (limit.map_or(error, |limit| limit.min(error)), min, max)
            }
        };
        let [error, min, max] = [error, min, max].map(|length| length * original.scale);
        let mut sizes: Vec<f64> = curvatures(original)
            .into_iter()
            .map(|curvature| chord(curvature, error).max(min).min(max))
            .collect();
        grade(original, &mut sizes);
        Self::Varying(sizes)
    }

    /// Halves the target lengths at marked vertices of the original surface, and lowers the target lengths around these
    /// vertices, so that target lengths grow gradually.
    pub(super) fn halve(&mut self, original: &Original, is_marked: &[bool]) {
        let sizes = is_marked.iter().enumerate().map(|(v, is_marked)| {
            let size = self.at_vertex(VertexId::new(v));
            if *is_marked { 0.5 * size } else { size }
        });
        let mut sizes: Vec<f64> = sizes.collect();
        grade(original, &mut sizes);
        *self = Self::Varying(sizes);
    }

    /// Returns an estimate of the largest number of faces during remeshing. The estimate is a sum over the original
    /// faces. Each face adds 1 + 2 (m + s) to the sum. Here m is the area of the face, divided by the area of an
    /// equilateral triangle with sides of the target length. The number s is the number of splits along the longest
    /// side of the face.
    pub(super) fn n_faces(&self, original: &Original) -> f64 {
        let mesh = &original.mesh;
        mesh::parallel::sum(mesh.n_faces(), |f| {
            let f = FaceId::new(f);
            let vertices = mesh.face_vertices(f).map(|v| self.at_vertex(v));
            let size = vertices.fold(f64::INFINITY, f64::min);
            let lengths = mesh.face_half_edges(f).map(|h| mesh.length(h));
            let longest = lengths.fold(0.0, f64::max);
            let share = mesh.face_area(f) / (0.25 * 3.0_f64.sqrt() * size * size);
            // A very thin triangle has a small area, but its long sides must be split many times.
            let splits = longest / (LONG * size);
            1.0 + 2.0 * (share + splits.floor())
        })
    }

    pub(super) fn at_vertex(&self, v: VertexId) -> f64 {
        match self {
            Self::Uniform(size) => *size,
            Self::Varying(sizes) => sizes[v.index()],
        }
    }

    /// Returns the target length at the point nearest to `p` on a triangle of the original surface.
    pub(super) fn at(&self, original: &Original, chart: u32, triangle: u32, p: DVec3) -> f64 {
        match self {
            Self::Uniform(size) => *size,
            Self::Varying(sizes) => {
                let triangle = original.indexes[chart as usize].triangle(triangle);
                let weights = triangle.barycentric(p);
                (0..3)
                    .map(|i| weights[i] * sizes[triangle.vertices[i].index()])
                    .sum()
            }
        }
    }

    /// Returns the target length at the arc length `at` from the start of a chain.
    pub(super) fn on_chain(&self, original: &Original, chain: u32, at: f64) -> f64 {
        match self {
            Self::Uniform(size) => *size,
            Self::Varying(sizes) => {
                let (h, t) = original.chains[chain as usize].locate(at);
                let [a, b] = [original.mesh.origin(h), original.mesh.target(h)];
                (1.0 - t) * sizes[a.index()] + t * sizes[b.index()]
            }
        }
    }
}

/// Returns √(6 e / k - 3 e²), the side length of an equilateral triangle whose corners lie on a sphere of curvature k.
/// The center of this triangle is at the distance e, the `error`, from the sphere. Source: Dunyach, Vanderhaeghe,
/// Barthe, Botsch, "Adaptive Remeshing for Real-Time Mesh Deformation", 2013, §2.
fn chord(curvature: f64, error: f64) -> f64 {
    let squared = 6.0 * error / curvature - 3.0 * error * error;
    if squared > 0.0 { squared.sqrt() } else { 0.0 }
}

/// Returns the largest absolute normal curvature at each vertex of the original surface: |H| + √(H² - K). H is the mean
/// curvature and K the Gaussian curvature. The result at a vertex inside a chart is the average of two numbers: the
/// value at the vertex, and the average of the values at its neighbors inside charts. The curvature of the surface is
/// not used at vertices on lines, because the surface bends sharply at many lines. A vertex on a line gets the larger
/// of two values: the mean of the values of its neighbors inside charts, and the curvature of the line.
fn curvatures(original: &Original) -> Vec<f64> {
    let mesh = &original.mesh;
    let (gaussian, mean) = (gaussian_curvatures(mesh), mean_curvatures(mesh));
    let is_inside = |v: VertexId| matches!(original.places[v.index()], Place::Inside(_));
    let raw: Vec<Option<f64>> = mesh
        .vertices()
        .map(|v| {
            let (h, k) = (mean[v.index()], gaussian[v.index()]);
            let root = (h * h - k).max(0.0).sqrt();
            let curvature = h.abs() + root;
            (is_inside(v) && curvature.is_finite()).then_some(curvature)
        })
        .collect();
    mesh.vertices()
        .map(|v| {
            let around = mesh.vertex_neighbors(v).filter_map(|w| raw[w.index()]);
            let own = raw[v.index()];
            let (sum, n) = around.fold((0.0, 0.0), |(sum, n), k| (sum + k, n + 1.0));
            match own {
                Some(own) if n > 0.0 => 0.5 * own + 0.5 * (sum / n),
                Some(own) => own,
                None => line_curvature(original, v).max(if n > 0.0 { sum / n } else { 0.0 }),
            }
        })
        .collect()
}

/// Returns the curvature of a line at a vertex: the angle by which the line turns there, divided by the mean length of
/// its two edges at the vertex. The curvature is 0 at the corners of the line.
fn line_curvature(original: &Original, v: VertexId) -> f64 {
    let Place::Line { .. } = original.places[v.index()] else {
        return 0.0;
    };
    let mesh = &original.mesh;
    let on_line = |h: &mesh::HalfEdgeId| original.tracks[h.edge().index()].is_some();
    let ways = mesh.vertex_half_edges(v).filter(on_line);
    let ways: Vec<DVec3> = ways
        .map(|h| mesh.position(mesh.target(h)) - mesh.position(v))
        .collect();
    let [a, b] = ways[..] else {
        return 0.0;
    };
    let curvature = 2.0 * mesh::angle_between(a, -b) / (a.length() + b.length());
    if curvature.is_finite() {
        curvature
    } else {
        0.0
    }
}

/// Lowers target lengths so that they grow by at most [`GROWTH`] along edges.
fn grade(original: &Original, sizes: &mut [f64]) {
    let mesh = &original.mesh;
    debug_assert_eq!(sizes.len(), mesh.domain_len(Domain::Vertex));
    // The heap compares the bits of `f64` numbers. For non-negative numbers, the bits (read as an integer) have the
    // same order as the numbers.
    let mut waiting: BinaryHeap<Reverse<(u64, usize)>> = sizes
        .iter()
        .enumerate()
        .map(|(v, size)| Reverse((size.to_bits(), v)))
        .collect();
    while let Some(Reverse((bits, v))) = waiting.pop() {
        let size = f64::from_bits(bits);
        if size > sizes[v] {
            continue;
        }
        for h in mesh.vertex_half_edges(VertexId::new(v)) {
            let w = mesh.target(h).index();
            let most = size + GROWTH * mesh.length(h);
            if most < sizes[w] {
                sizes[w] = most;
                waiting.push(Reverse((most.to_bits(), w)));
            }
        }
    }
}
