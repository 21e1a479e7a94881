//! The rate at which levels converge to the limit.

use std::f64::consts::TAU;

use geometry::shapes;
use mesh::{DVec3, Mesh};
use progress::NoProgress;

use crate::fixtures;
use crate::{LoopWeights, Rules, Scheme, limit, limit_distance, subdivide};

const LOOP: Scheme = Scheme::Loop(LoopWeights::Warren);

/// Returns the largest distance between a vertex and its limit position, for each level from 0 to `levels`.
fn distances(mut mesh: Mesh, rules: Rules, levels: u32) -> Vec<f64> {
    let mut distances_by_level = Vec::new();
    for _ in 0..=levels {
        distances_by_level.push(limit_distance(&mesh, rules, &NoProgress).unwrap());
        mesh = subdivide(&mesh, rules, 1, &NoProgress).unwrap();
    }
    distances_by_level
}

#[test]
fn meshes_converge_at_the_rate_of_their_valences() {
    // Around a vertex, each level scales the surface by the subdominant eigenvalue, a factor that depends on the
    // valence of the vertex. The distance from nearby points to their limits scales by the same factor. If all valences
    // are regular, the distance is quadratic in the edge length instead, so that each level divides the distance by 4.
    let loop_rate = |n: f64| 0.375 + 0.25 * libm::cos(TAU / n);
    let cases = [
        (LOOP, shapes::icosahedron(), 8, loop_rate(5.0)),
        (LOOP, shapes::fans(&shapes::torus(8, 8, 2.0, 1.0)), 5, 0.25),
        (Scheme::CatmullClark, shapes::cube(), 8, 0.410_097_2),
        (Scheme::CatmullClark, shapes::torus(8, 8, 2.0, 1.0), 5, 0.25),
    ];
    for (scheme, mesh, levels, rate) in cases {
        let distances_by_level = distances(mesh, Rules::of(scheme), levels);
        let last = distances_by_level[levels as usize] / distances_by_level[levels as usize - 1];
        assert!(
            (last / rate - 1.0).abs() < 0.05,
            "{scheme:?} {last} {rate} {distances_by_level:?}"
        );
    }
}

#[test]
fn a_vertex_converges_by_the_eigenvalue_of_its_valence() {
    // Let n be the valence of a vertex and u the weight of each neighbor. Loop subdivision maps the vertex and the mean
    // of its neighbors by the matrix (1 - n u, n u; 3/8, 5/8). Its eigenvalues are 1 and 5/8 - n u.
    for weights in [LoopWeights::Warren, LoopWeights::Loop] {
        let rules = Rules::of(Scheme::Loop(weights));
        for (name, mesh) in fixtures::all() {
            let goal = limit(&mesh, rules, &NoProgress).unwrap().positions;
            let next = subdivide(&mesh, rules, 1, &NoProgress).unwrap();
            for v in mesh.vertices().filter(|&v| !mesh.is_boundary_vertex(v)) {
                let n = mesh.valence(v);
                if n == 0 {
                    continue;
                }
                let lambda = 0.625 - n as f64 * weights.of(n);
                let offset = |m: &Mesh| -> DVec3 { m.position(v) - goal[v.index()] };
                let far = offset(&next).distance(lambda * offset(&mesh));
                assert!(far < 1e-13, "{name} {v} {far:e}");
            }
        }
    }
}
