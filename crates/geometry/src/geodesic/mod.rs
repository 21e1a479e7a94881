//! Distances along a surface by the heat method.
//!
//! ```text
//!   heat u after a short time     its directions X = -∇u / |∇u|     the distance, whose gradient is nearest to X
//!
//!          . : # : .                   <- <- o -> ->                        2 1 0 1 2
//! ```
//!
//! The sources heat the surface for a short time. After that, the heat decreases in the directions X, away from the
//! nearest source. The result is the function whose gradient is nearest to X. Source of this method: Crane, Weischedel,
//! Wardetzky, "Geodesics in Heat", 2013. The method uses the Laplacian of the intrinsic Delaunay triangulation, which
//! is accurate even if triangles are very thin. Source of this Laplacian: Sharp, Crane, "A Laplacian for Nonmanifold
//! Triangle Meshes", 2020.

mod intrinsic;
#[cfg(test)]
pub(crate) mod tests;

use mesh::{Domain, Mesh, parallel};
use progress::Progress;

use crate::components;
use crate::laplacian::exponent;
use crate::sparse::{Factor, SolveError, SymmetricMatrix};
use intrinsic::{Intrinsic, area, cotangent, scaled_points};

/// Where the heat is at least this number, the direction of its gradient is accurate. This number is well above the
/// smallest positive `f64`.
const LEAST_HEAT: f64 = 1e-280;

/// Returns the distance along the surface from each vertex to the nearest source, in scene units. Entry i belongs to
/// the vertex with the index i. Entry i of `is_source` tells whether the vertex with the index i is a source. The
/// distance is infinite for dead (removed) vertices, and for vertices that are not connected to any source by edges.
///
/// The distances are approximate: on fine meshes of smooth surfaces, the mean error is below 1 %. A vertex that is
/// connected to a source by edges has a finite distance if all positions are finite, even if triangles are degenerate.
/// Polygons are cut into triangles. The result is identical bit for bit for any number of threads.
///
/// # Errors
///
/// Returns [`SolveError`] if the system of equations is too large, or if `progress` asks to stop.
///
/// # Panics
///
/// Panics if `is_source` does not have one flag for each vertex.
pub fn geodesic_distances(
    mesh: &Mesh,
    is_source: &[bool],
    progress: &dyn Progress,
) -> Result<Vec<f64>, SolveError> {
    let n = mesh.domain_len(Domain::Vertex);
    assert_eq!(is_source.len(), n, "one flag for each vertex");
    let is_reached = reached(mesh, is_source);
    let exponent = exponent(mesh.positions());
    let mut surface = Intrinsic::new(mesh, &scaled_points(mesh, -exponent));
    surface.flip_to_delaunay(progress)?;
    let (stiffness, areas) = laplacian(&surface, n);
    // A vertex has no equation if it has no face, or if its component has no source.
    let is_fixed: Vec<bool> = (0..n).map(|v| !is_reached[v] || areas[v] <= 0.0).collect();
    let is_pinned: Vec<bool> = (0..n).map(|v| is_fixed[v] || is_source[v]).collect();
    let is_hot = |v: usize| is_source[v] && !is_fixed[v];
    let start: Vec<f64> = (0..n).map(|v| f64::from(u8::from(is_hot(v)))).collect();
    let heat = heat(&surface, &stiffness, &areas, &start, &is_pinned, progress)?;
    let flow = flow(&surface, &heat, n);
    let mut distances = vec![0.0; n];
    Factor::with_pins(&stiffness, &is_pinned, progress)?.solve(&flow, &mut distances)?;
    for (v, distance) in distances.iter_mut().enumerate() {
        *distance = if is_source[v] && is_reached[v] {
            0.0
        } else if is_fixed[v] {
            f64::INFINITY
        } else {
            libm::scalbn(distance.max(0.0), exponent)
        };
    }
    Ok(distances)
}

/// Returns, for each vertex, whether its connected component has a source.
fn reached(mesh: &Mesh, is_source: &[bool]) -> Vec<bool> {
    let component = components(mesh);
    let mut has_source = vec![false; component.len()];
    for v in mesh.vertices().filter(|v| is_source[v.index()]) {
        has_source[component[v.index()]] = true;
    }
    let is_reached = component.iter().map(|&c| c != usize::MAX && has_source[c]);
    is_reached.collect()
}

/// Returns the stiffness matrix of the cotangent Laplacian, and the areas of the vertices.
fn laplacian(surface: &Intrinsic, n: usize) -> (SymmetricMatrix, Vec<f64>) {
    let mut areas = vec![0.0; n];
    let mut entries = Vec::with_capacity(9 * surface.corners.len());
    for (corners, &[a, b, c]) in surface.corners.iter().zip(&surface.lengths) {
        let third = area([a, b, c]) / 3.0;
        for (k, sides) in [[a, b, c], [b, c, a], [c, a, b]].into_iter().enumerate() {
            let (i, j) = (corners[k], corners[(k + 1) % 3]);
            areas[i as usize] += third;
            let weight = 0.5 * cotangent(sides);
            if i != j {
                entries.extend([(i, j, -weight), (i, i, weight), (j, j, weight)]);
            }
        }
    }
    (SymmetricMatrix::from_entries(n, entries), areas)
}

/// Returns the heat of each vertex after a short time. The pinned vertices, which include all sources, keep the heat
/// that they have in `start`. All sources are therefore equally hot, even at the ends of a line of sources.
///
/// The heat flows for a time equal to the square of the mean edge length. If a vertex is so far from all sources that
/// no heat arrives there in this time, the computation is repeated with a longer time.
fn heat(
    surface: &Intrinsic,
    stiffness: &SymmetricMatrix,
    areas: &[f64],
    start: &[f64],
    is_pinned: &[bool],
    progress: &dyn Progress,
) -> Result<Vec<f64>, SolveError> {
    let length = surface.mean_length();
    let mut time = length * length;
    let none = vec![0.0; areas.len()];
    loop {
        let matrix = stiffness.scaled_plus_diagonal(time, areas);
        let mut heat = start.to_vec();
        Factor::with_pins(&matrix, is_pinned, progress)?.solve(&none, &mut heat)?;
        let arrives = |(heat, is_pinned): (&f64, &bool)| *is_pinned || *heat > LEAST_HEAT;
        // The longest time is 1e16 times the squared mean edge length. Heat then reaches vertices at a distance of
        // about 1e8 edge lengths; in practice, no path is that long.
        let is_longest = time > length * length * 1e16;
        if is_longest || heat.iter().zip(is_pinned).all(arrives) {
            return Ok(heat);
        }
        time *= 16.0;
    }
}

/// Returns the right-hand side of the equations for the distances. The entry of a vertex is a sum over the triangles
/// around the vertex. Each triangle adds its area times the dot product of two vectors: the gradient of the hat
/// function of the vertex, and the direction in which the heat decreases.
fn flow(surface: &Intrinsic, heat: &[f64], n: usize) -> Vec<f64> {
    let of_triangle = |(corners, &[a, b, c]): (&[u32; 3], &[f64; 3])| {
        // The triangle is laid out in a plane. Its corners are at (0, 0), (a, 0) and (x, y), where a is the length of
        // the first side of the triangle.
        let x = (a * a + c * c - b * b) / (2.0 * a);
        let y = 2.0 * area([a, b, c]) / a;
        // A hat function is 1 at one corner and 0 at the two others. To get the gradient of a hat function, take the
        // side opposite the corner with the value 1. Turn this side by 90°, and divide it by twice the area of the
        // triangle.
        let hats = [[-y, x - a], [y, -x], [0.0, a]];
        let values = corners.map(|v| heat[v as usize]);
        let largest = values.iter().fold(0.0, |max: f64, u| max.max(u.abs()));
        let mut gradient = [0.0; 2];
        for (hat, u) in hats.iter().zip(values) {
            let u = if largest > 0.0 { u / largest } else { 0.0 };
            gradient[0] += hat[0] * u;
            gradient[1] += hat[1] * u;
        }
        let norm = (gradient[0] * gradient[0] + gradient[1] * gradient[1]).sqrt();
        let unit = gradient.map(|g| if norm > 0.0 { -g / norm } else { 0.0 });
        hats.map(|hat| 0.5 * (hat[0] * unit[0] + hat[1] * unit[1]))
    };
    let shares: Vec<[f64; 3]> = parallel::collect(surface.corners.len(), |t| {
        of_triangle((&surface.corners[t], &surface.lengths[t]))
    });
    let mut flow = vec![0.0; n];
    for (corners, shares) in surface.corners.iter().zip(shares) {
        for (&v, share) in corners.iter().zip(shares) {
            flow[v as usize] += share;
        }
    }
    flow
}
