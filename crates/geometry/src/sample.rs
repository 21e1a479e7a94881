//! Random points on a surface, spread so that no two of them are very close to each other.

use std::collections::BinaryHeap;

use mesh::{DVec3, FaceId, Mesh};
use progress::{Cancelled, Progress};

use crate::Scaled;
use crate::deform::noise::random;
use crate::tangent::triangles;

/// A point on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The position.
    pub position: DVec3,
    /// The unit normal of the triangle that contains the point. Polygons are cut into triangles.
    pub normal: DVec3,
    /// The face that contains the point.
    pub face: FaceId,
}

/// The number of random candidates that are drawn for each returned point.
const CANDIDATES: usize = 5;

/// Returns exactly `count` random, evenly spread points on a surface. Polygons are triangulated. Returns no points if
/// the area of the surface is zero or not finite.
///
/// First, 5 × `count` random points are drawn; parts of the surface with equal areas get about equal numbers of points.
/// Then the most crowded point is removed, again and again, until `count` points are left (Yuksel, "Sample Elimination
/// for Generating Poisson Disk Sample Sets", 2015). A point is crowded if many other points are near it. A nearer point
/// counts more than a more distant one. Distances are Euclidean, not along the surface. The returned points are in the
/// order in which they were drawn. The result depends only on the mesh, `count` and the seed.
///
/// # Errors
///
/// Returns [`Cancelled`] if `progress` asks to stop.
pub fn samples(
    mesh: &Mesh,
    count: usize,
    seed: u64,
    progress: &dyn Progress,
) -> Result<Vec<Sample>, Cancelled> {
    let scaled = Scaled::new(mesh);
    let mesh = scaled.mesh();
    let (candidates, area) = candidates(mesh, CANDIDATES * count, seed);
    if candidates.is_empty() || count == 0 {
        return Ok(Vec::new());
    }
    // Suppose that a flat region with the area of the surface is packed as densely as possible with `count` equal
    // disks. This is the radius of these disks.
    let radius = (area / (2.0 * 3.0_f64.sqrt() * count as f64)).sqrt();
    // Two points that are closer than `least` are treated as if their distance were `least`. As a result, the points
    // are spread more evenly.
    let ratio = 1.0 / CANDIDATES as f64;
    let least = 2.0 * radius * (1.0 - ratio * ratio.sqrt()) * 0.65;
    let grid = Grid::new(&candidates, 2.0 * radius);
    let weight = |i: usize, j: usize| {
        let distance = candidates[i].position.distance(candidates[j].position);
        let t = (1.0 - distance.max(least) / (2.0 * radius)).max(0.0);
        let t = t * t;
        let t = t * t;
        t * t
    };
    let mut crowding = vec![0.0; candidates.len()];
    let mut heap = BinaryHeap::with_capacity(candidates.len());
    for (i, sum) in crowding.iter_mut().enumerate() {
        if i.is_multiple_of(4096) {
            progress.report("scatter", i as u64, 2 * candidates.len() as u64)?;
        }
        grid.each_near(i, |j| *sum += weight(i, j));
        heap.push(entry(*sum, i));
    }
    let mut is_kept = vec![true; candidates.len()];
    let mut n = candidates.len();
    while n > count {
        let Some((bits, std::cmp::Reverse(i))) = heap.pop() else {
            break;
        };
        // An entry of the queue is out of date if the weight of its candidate has changed since the entry was made.
        // Such an entry is skipped: the queue has a newer entry for the candidate.
        if !is_kept[i] || bits != f64::to_bits(crowding[i]) {
            continue;
        }
        is_kept[i] = false;
        n -= 1;
        if n.is_multiple_of(4096) {
            let done = 2 * candidates.len() - n;
            progress.report("scatter", done as u64, 2 * candidates.len() as u64)?;
        }
        grid.each_near(i, |j| {
            let w = weight(i, j);
            if is_kept[j] && w > 0.0 {
                crowding[j] = (crowding[j] - w).max(0.0);
                heap.push(entry(crowding[j], j));
            }
        });
    }
    let kept = candidates.into_iter().zip(is_kept);
    Ok(kept
        .filter_map(|(sample, is_kept)| is_kept.then_some(sample))
        .map(|sample| Sample {
            position: scaled.restored_point(sample.position),
            ..sample
        })
        .collect())
}

/// Returns the key by which the heap sorts the candidates. The candidate with the largest weight is removed first.
/// Among candidates with the same weight, the one with the lowest index is removed first. Weights are not negative, so
/// their bits (read as integers) have the same order as the weights.
fn entry(weight: f64, i: usize) -> (u64, std::cmp::Reverse<usize>) {
    (weight.to_bits(), std::cmp::Reverse(i))
}

/// Returns `n` random points on the surface. Parts of the surface with equal areas get about equal numbers of points.
/// Also returns the total area.
fn candidates(mesh: &Mesh, n: usize, seed: u64) -> (Vec<Sample>, f64) {
    let triangles = triangles(mesh);
    let mut sums = Vec::with_capacity(triangles.len());
    let mut total = 0.0;
    let corners = |i: usize| triangles[i].map(|h| mesh.position(mesh.origin(h)));
    for i in 0..triangles.len() {
        let [a, b, c] = corners(i);
        total += (b - a).cross(c - a).length() / 2.0;
        sums.push(total);
    }
    if total.is_nan() || total <= 0.0 || total.is_infinite() {
        return (Vec::new(), 0.0);
    }
    let sample = |i: usize| {
        // Random numbers from 0 to 1, excluding 1.
        let number = |k: u64| f64::midpoint(random(seed, 3 * i as u64 + k), 1.0);
        let at = number(0) * total;
        let triangle = sums.partition_point(|&sum| sum <= at).min(sums.len() - 1);
        let [a, b, c] = corners(triangle);
        let (s, t) = (number(1).sqrt(), number(2));
        Some(Sample {
            position: a * (1.0 - s) + b * (s * (1.0 - t)) + c * (s * t),
            normal: (b - a).cross(c - a).normalize_or_zero(),
            face: mesh.face(triangles[triangle][0])?,
        })
    };
    ((0..n).filter_map(sample).collect(), total)
}

/// Points, sorted into the cubic cells of a grid. With the grid, the points near a given point are found quickly.
struct Grid {
    points: Vec<DVec3>,
    size: f64,
    /// For each point, the cell that contains it.
    cells: Vec<[f64; 3]>,
    /// The indices of the points, sorted by cell.
    sorted: Vec<usize>,
}

impl Grid {
    fn new(samples: &[Sample], size: f64) -> Self {
        let points: Vec<DVec3> = samples.iter().map(|s| s.position).collect();
        let low = points.iter().copied().fold(points[0], DVec3::min);
        let cell = |p: &DVec3| ((*p - low) / size).floor().to_array();
        let cells: Vec<[f64; 3]> = points.iter().map(cell).collect();
        let mut sorted: Vec<usize> = (0..points.len()).collect();
        sorted.sort_by(|&i, &j| order(&cells[i], &cells[j]).then(i.cmp(&j)));
        Self {
            points,
            size,
            cells,
            sorted,
        }
    }

    /// Calls `each` with the index of every other point whose distance from point `i` is less than the size of a cell.
    /// The order of the calls depends only on the points.
    fn each_near(&self, i: usize, mut each: impl FnMut(usize)) {
        let [x, y, z] = self.cells[i];
        for dx in [-1.0, 0.0, 1.0] {
            for dy in [-1.0, 0.0, 1.0] {
                // Cells that are adjacent along z follow each other in the sorted list.
                let first = [x + dx, y + dy, z - 1.0];
                let last = [x + dx, y + dy, z + 1.0];
                let from = self
                    .sorted
                    .partition_point(|&j| order(&self.cells[j], &first).is_lt());
                for &j in &self.sorted[from..] {
                    if order(&self.cells[j], &last).is_gt() {
                        break;
                    }
                    if j != i && self.points[i].distance(self.points[j]) < self.size {
                        each(j);
                    }
                }
            }
        }
    }
}

fn order(a: &[f64; 3], b: &[f64; 3]) -> std::cmp::Ordering {
    (a[0].total_cmp(&b[0]))
        .then(a[1].total_cmp(&b[1]))
        .then(a[2].total_cmp(&b[2]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;
    use progress::NoProgress;

    #[test]
    fn counts_are_exact_and_points_lie_on_the_surface() {
        let mesh = shapes::cube();
        for count in [1, 2, 100, 1000] {
            let points = samples(&mesh, count, 7, &NoProgress).unwrap();
            assert_eq!(points.len(), count);
            for sample in points {
                assert!((sample.position.abs().max_element() - 1.0).abs() < 1e-12);
                assert!((sample.position.dot(sample.normal) - 1.0).abs() < 1e-12);
                assert_eq!(mesh.face_normal(sample.face), sample.normal);
            }
        }
    }

    #[test]
    fn points_keep_their_distance() {
        let mesh = shapes::grid(1, 1);
        let n = 500;
        let points = samples(&mesh, n, 3, &NoProgress).unwrap();
        let area = crate::area(&mesh);
        let radius = (area / (2.0 * 3.0_f64.sqrt() * n as f64)).sqrt();
        let mut least = f64::MAX;
        for (i, a) in points.iter().enumerate() {
            for b in &points[i + 1..] {
                least = least.min(a.position.distance(b.position));
            }
        }
        // If the points were random and independent, the smallest distance between two of them would be about a
        // thirtieth of the required distance.
        assert!(least > 0.6 * 2.0 * radius, "{least} {radius}");
    }

    #[test]
    fn points_are_distributed_by_area() {
        // On a torus with the radii M and m, the fraction of the area on the outer side is 1/2 + m / (π M).
        let mesh = shapes::torus(64, 32, 1.0, 0.4);
        let points = samples(&mesh, 2000, 1, &NoProgress).unwrap();
        let outer = |p: DVec3| p.truncate().length() > 1.0;
        let n = points.iter().filter(|s| outer(s.position)).count();
        let part = 0.5 + 0.4 / std::f64::consts::PI;
        assert!((n as f64 / 2000.0 - part).abs() < 0.01, "{n}");
    }

    #[test]
    fn the_seed_decides() {
        let mesh = shapes::cube();
        let of = |seed| samples(&mesh, 50, seed, &NoProgress).unwrap();
        assert_eq!(of(1), of(1));
        assert_ne!(of(1), of(2));
        assert!(
            samples(&Mesh::default(), 5, 1, &NoProgress)
                .unwrap()
                .is_empty()
        );
    }
}
