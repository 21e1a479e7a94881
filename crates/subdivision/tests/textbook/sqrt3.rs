//! √3 subdivision: a vertex in each face, and edges turned.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use crate::polygons::{Around, Edge, Polygons};
use crate::split;

/// One level; `is_even` for the second of a pair, which divides the boundary.
pub(crate) fn refine(mesh: &Polygons, is_even: bool) -> Polygons {
    let around = Around::new(mesh.positions.len(), &mesh.faces);
    let p = |v: usize| mesh.positions[v];
    let mut positions = Vec::new();
    for v in 0..mesh.positions.len() {
        let neighbors = &around.neighbors[v];
        let n = neighbors.len() as f64;
        let along = around.along_boundary(v);
        positions.push(if neighbors.is_empty() || (!along.is_empty() && !is_even) {
            p(v)
        } else if along.is_empty() {
            let a = (4.0 - 2.0 * libm::cos(TAU / n)) / 9.0;
            (1.0 - a) * p(v) + a / n * neighbors.iter().map(|&w| p(w)).sum::<mesh::DVec3>()
        } else {
            (4.0 * p(along[0]) + 19.0 * p(v) + 4.0 * p(along[1])) / 27.0
        });
    }

    // The new vertex that each side of a triangle sees, and triangles that no edge turns into.
    let mut apex: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    let mut faces = Vec::new();
    for (f, face) in mesh.faces.iter().enumerate() {
        let ends = |i: usize| (around.at((f, i), 0), around.at((f, i), 1));
        let is_boundary = |&i: &usize| is_even && around.sides[&sorted(ends(i))].len() == 1;
        let boundary: Vec<usize> = (0..3).filter(is_boundary).collect();
        if let &[i] = boundary.as_slice() {
            let ((a, b), c) = (ends(i), around.at((f, i), 2));
            let x = positions.len();
            let (before, after) = (around.beyond(b, a), around.beyond(a, b));
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
    for sides in around.sides.values() {
        match *sides.as_slice() {
            [one, other] => {
                let (a, b) = (around.at(one, 0), around.at(one, 1));
                faces.push(vec![a, apex[&other], apex[&one]]);
                faces.push(vec![b, apex[&one], apex[&other]]);
            }
            [one] => {
                if let Some(&center) = apex.get(&one) {
                    faces.push(vec![around.at(one, 0), around.at(one, 1), center]);
                }
            }
            _ => unreachable!("an edge has one side or two"),
        }
    }
    Polygons::new(positions, faces)
}

/// The edge of two vertices.
fn sorted((a, b): (usize, usize)) -> Edge {
    crate::polygons::edge(a, b)
}
