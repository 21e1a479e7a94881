//! Modified Butterfly subdivision: old vertices stay in place.

use std::f64::consts::TAU;

use mesh::DVec3;
use subdivision::{LoopWeights, Rules, Scheme};

use crate::polygons::{Adjacency, Edge, Polygons, edge};
use crate::split;

/// Computes one level. The new faces have the same corners as in Loop subdivision.
pub(crate) fn refine(mesh: &Polygons) -> Polygons {
    let adjacency = Adjacency::new(mesh.positions.len(), &mesh.faces);
    let mut fine = split::refine(mesh, Rules::of(Scheme::Loop(LoopWeights::Loop)));
    let mut positions = mesh.positions.clone();
    positions.extend(
        adjacency
            .sides
            .keys()
            .map(|&e| new_vertex(mesh, e, &adjacency)),
    );
    fine.positions = positions;
    fine
}

/// Returns the new vertex on an edge.
fn new_vertex(mesh: &Polygons, (a, b): Edge, adjacency: &Adjacency) -> DVec3 {
    let p = |v: usize| mesh.positions[v];
    let sides = &adjacency.sides[&(a, b)];
    if sides.len() == 1 {
        let outer = p(adjacency.beyond(b, a)) + p(adjacency.beyond(a, b));
        return 9.0 / 16.0 * (p(a) + p(b)) - outer / 16.0;
    }
    let is_extraordinary =
        |v: usize| !adjacency.is_boundary_vertex(v) && adjacency.neighbors[v].len() != 6;
    match (is_extraordinary(a), is_extraordinary(b)) {
        (true, true) => {
            (extraordinary(mesh, a, b, adjacency) + extraordinary(mesh, b, a, adjacency)) / 2.0
        }
        (true, false) => extraordinary(mesh, a, b, adjacency),
        (false, true) => extraordinary(mesh, b, a, adjacency),
        (false, false) => {
            let opposite: DVec3 = sides.iter().map(|&side| p(adjacency.at(side, 2))).sum();
            let mut wings = DVec3::ZERO;
            for &side in sides {
                let corners = [0, 1, 2].map(|by| adjacency.at(side, by));
                wings += wing(mesh, [corners[1], corners[2], corners[0]], adjacency);
                wings += wing(mesh, [corners[2], corners[0], corners[1]], adjacency);
            }
            (p(a) + p(b)) / 2.0 + opposite / 8.0 - wings / 16.0
        }
    }
}

/// Returns the vertex opposite to the triangle a, b, c at the edge from a to b: the third corner of the neighboring
/// triangle. If there is no neighboring triangle, returns c reflected through the middle of the edge.
fn wing(mesh: &Polygons, [a, b, c]: [usize; 3], adjacency: &Adjacency) -> DVec3 {
    let begins_at_b = |side: &&(usize, usize)| adjacency.at(**side, 0) == b;
    match adjacency.sides[&edge(a, b)].iter().find(begins_at_b) {
        Some(&side) => mesh.positions[adjacency.at(side, 2)],
        None => mesh.positions[a] + mesh.positions[b] - mesh.positions[c],
    }
}

/// Returns the new vertex on the edge from `v` to `towards`, computed from `v` and its neighbors.
fn extraordinary(mesh: &Polygons, v: usize, towards: usize, adjacency: &Adjacency) -> DVec3 {
    let mut ring: Vec<usize> = adjacency
        .fan(v)
        .iter()
        .map(|&c| adjacency.at(c, 1))
        .collect();
    let first = ring.iter().position(|&w| w == towards).expect("a neighbor");
    ring.rotate_left(first);
    let k = ring.len();
    let weight = |j: usize| match (k, j) {
        (3, 0) => 5.0 / 12.0,
        (3, _) => -1.0 / 12.0,
        (4, 0) => 3.0 / 8.0,
        (4, 2) => -1.0 / 8.0,
        (4, _) => 0.0,
        _ => {
            let t = TAU * j as f64 / k as f64;
            (0.25 + libm::cos(t) + 0.5 * libm::cos(2.0 * t)) / k as f64
        }
    };
    let neighbor_sum: DVec3 = ring
        .iter()
        .enumerate()
        .map(|(j, &w)| weight(j) * mesh.positions[w])
        .sum();
    0.75 * mesh.positions[v] + neighbor_sum
}
