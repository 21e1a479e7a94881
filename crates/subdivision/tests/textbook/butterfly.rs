//! Modified butterfly subdivision: old vertices stay.

use std::f64::consts::TAU;

use mesh::DVec3;
use subdivision::{LoopWeights, Rules, Scheme};

use crate::polygons::{Around, Edge, Polygons, edge};
use crate::split;

/// One level. The faces are those of Loop.
pub(crate) fn refine(mesh: &Polygons) -> Polygons {
    let around = Around::new(mesh.positions.len(), &mesh.faces);
    let mut fine = split::refine(mesh, Rules::of(Scheme::Loop(LoopWeights::Loop)));
    let mut positions = mesh.positions.clone();
    positions.extend(around.sides.keys().map(|&e| new_vertex(mesh, e, &around)));
    fine.positions = positions;
    fine
}

/// The new vertex of an edge.
fn new_vertex(mesh: &Polygons, (a, b): Edge, around: &Around) -> DVec3 {
    let p = |v: usize| mesh.positions[v];
    let sides = &around.sides[&(a, b)];
    if sides.len() == 1 {
        let outer = p(around.beyond(b, a)) + p(around.beyond(a, b));
        return 9.0 / 16.0 * (p(a) + p(b)) - outer / 16.0;
    }
    let is_odd = |v: usize| !around.is_boundary_vertex(v) && around.neighbors[v].len() != 6;
    match (is_odd(a), is_odd(b)) {
        (true, true) => {
            (extraordinary(mesh, a, b, around) + extraordinary(mesh, b, a, around)) / 2.0
        }
        (true, false) => extraordinary(mesh, a, b, around),
        (false, true) => extraordinary(mesh, b, a, around),
        (false, false) => {
            let opposite: DVec3 = sides.iter().map(|&side| p(around.at(side, 2))).sum();
            let mut wings = DVec3::ZERO;
            for &side in sides {
                let corners = [0, 1, 2].map(|by| around.at(side, by));
                wings += wing(mesh, [corners[1], corners[2], corners[0]], around);
                wings += wing(mesh, [corners[2], corners[0], corners[1]], around);
            }
            (p(a) + p(b)) / 2.0 + opposite / 8.0 - wings / 16.0
        }
    }
}

/// The corner beyond the side from a to b of a triangle a, b, c: reflected if there is no face.
fn wing(mesh: &Polygons, [a, b, c]: [usize; 3], around: &Around) -> DVec3 {
    let begins_at_b = |side: &&(usize, usize)| around.at(**side, 0) == b;
    match around.sides[&edge(a, b)].iter().find(begins_at_b) {
        Some(&side) => mesh.positions[around.at(side, 2)],
        None => mesh.positions[a] + mesh.positions[b] - mesh.positions[c],
    }
}

/// The new vertex from `v` to `towards` by the neighbors of `v` alone.
fn extraordinary(mesh: &Polygons, v: usize, towards: usize, around: &Around) -> DVec3 {
    let mut ring: Vec<usize> = around.fan(v).iter().map(|&c| around.at(c, 1)).collect();
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
    let around_it: DVec3 = ring
        .iter()
        .enumerate()
        .map(|(j, &w)| weight(j) * mesh.positions[w])
        .sum();
    0.75 * mesh.positions[v] + around_it
}
