//! √3 subdivision: adds a vertex in each face and flips the old edges.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use crate::polygons::{Adjacency, Edge, Polygons};
use crate::split;

/// Computes one level. `cuts_boundary` is true for every second level.
pub(crate) fn refine(mesh: &Polygons, cuts_boundary: bool) -> Polygons {
    let adjacency = Adjacency::new(mesh.positions.len(), &mesh.faces);
    let p = |v: usize| mesh.positions[v];
    let mut positions = Vec::new();
    for v in 0..mesh.positions.len() {
        let neighbors = &adjacency.neighbors[v];
        let n = neighbors.len() as f64;
        let along = adjacency.along_boundary(v);
        positions.push(
            if neighbors.is_empty() || (!along.is_empty() && !cuts_boundary) {
                p(v)
            } else if along.is_empty() {
                let a = (4.0 - 2.0 * libm::cos(TAU / n)) / 9.0;
                (1.0 - a) * p(v) + a / n * neighbors.iter().map(|&w| p(w)).sum::<mesh::DVec3>()
            } else {
                (4.0 * p(along[0]) + 19.0 * p(v) + 4.0 * p(along[1])) / 27.0
            },
        );
    }

    // The loop appends the new vertices and fills two more collections: the new vertex opposite each side of a triangle
    // (`apex`), and the middle triangle of each triangle whose boundary side is cut in three.
    let mut apex: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    let mut faces = Vec::new();
    for (f, face) in mesh.faces.iter().enumerate() {
        let ends = |i: usize| (adjacency.at((f, i), 0), adjacency.at((f, i), 1));
        let is_boundary =
            |&i: &usize| cuts_boundary && adjacency.sides[&sorted(ends(i))].len() == 1;
        let boundary: Vec<usize> = (0..3).filter(is_boundary).collect();
        if let &[i] = boundary.as_slice() {
            let ((a, b), c) = (ends(i), adjacency.at((f, i), 2));
            let x = positions.len();
            let (before, after) = (adjacency.beyond(b, a), adjacency.beyond(a, b));
            positions.push((p(before) + 16.0 * p(a) + 10.0 * p(b)) / 27.0);
            positions.push((10.0 * p(a) + 16.0 * p(b) + p(after)) / 27.0);
            faces.push(vec![x, x + 1, c]);
            apex.insert((f, (i + 1) % 3), x + 1);
            apex.insert((f, (i + 2) % 3), x);
        } else {
            assert!(boundary.is_empty(), "at most one side on the boundary");
            apex.extend((0..3).map(|i| ((f, i), positions.len())));
            positions.push(split::mean(&mesh.positions, face));
        }
    }
    for sides in adjacency.sides.values() {
        match *sides.as_slice() {
            [one, other] => {
                let (a, b) = (adjacency.at(one, 0), adjacency.at(one, 1));
                faces.push(vec![a, apex[&other], apex[&one]]);
                faces.push(vec![b, apex[&one], apex[&other]]);
            }
            [one] => {
                if let Some(&center) = apex.get(&one) {
                    faces.push(vec![adjacency.at(one, 0), adjacency.at(one, 1), center]);
                }
            }
            _ => unreachable!("an edge has one side or two"),
        }
    }
    Polygons::new(positions, faces)
}

/// Returns the edge of two vertices.
fn sorted((a, b): (usize, usize)) -> Edge {
    crate::polygons::edge(a, b)
}
