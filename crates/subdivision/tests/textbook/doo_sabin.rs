//! Doo-Sabin subdivision: makes a face of each old face, edge and vertex.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use mesh::DVec3;

use crate::polygons::{Adjacency, Polygons, ahead, edge};

/// Computes one level.
pub(crate) fn refine(mesh: &Polygons) -> Polygons {
    let adjacency = Adjacency::new(mesh.positions.len(), &mesh.faces);
    let p = |v: usize| mesh.positions[v];
    let mut positions: Vec<DVec3> = Vec::new();
    let mut faces = Vec::new();
    // `inside` maps each corner of a face to its new vertex. If the edge from v to w is on the boundary, `outside` maps
    // (v, w) to the new vertex near v on this edge.
    let mut inside: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    let mut outside: BTreeMap<(usize, usize), usize> = BTreeMap::new();

    for (f, face) in mesh.faces.iter().enumerate() {
        let n = face.len();
        let count = n as f64;
        let mut corners = Vec::new();
        for i in 0..n {
            let mut sum = (count + 5.0) / (4.0 * count) * p(face[i]);
            for j in 1..n {
                let weight = (3.0 + 2.0 * libm::cos(TAU * j as f64 / count)) / (4.0 * count);
                sum += weight * p(face[(i + j) % n]);
            }
            inside.insert((f, i), positions.len());
            corners.push(positions.len());
            positions.push(sum);
        }
        faces.push(corners);
    }
    for (&(a, b), sides) in &adjacency.sides {
        if sides.len() == 1 {
            for (v, w) in [(a, b), (b, a)] {
                outside.insert((v, w), positions.len());
                positions.push(0.75 * p(v) + 0.25 * p(w));
            }
        }
    }

    for sides in adjacency.sides.values() {
        let (f, i) = sides[0];
        let n = mesh.faces[f].len();
        let (a, b) = (adjacency.at((f, i), 0), adjacency.at((f, i), 1));
        let mut face = vec![inside[&(f, ahead(i, n))], inside[&(f, i)]];
        if let Some(&(g, j)) = sides.get(1) {
            face.extend([inside[&(g, ahead(j, mesh.faces[g].len()))], inside[&(g, j)]]);
        } else {
            face.extend([outside[&(a, b)], outside[&(b, a)]]);
        }
        faces.push(face);
    }
    for v in 0..mesh.positions.len() {
        let fan = adjacency.fan(v);
        let Some((&first, &last)) = fan.first().zip(fan.last()) else {
            positions.push(p(v));
            continue;
        };
        let mut face: Vec<usize> = fan.iter().map(|corner| inside[corner]).collect();
        let (leads, arrives) = (adjacency.at(first, 1), adjacency.before(last));
        if adjacency.is_boundary_edge(edge(v, leads)) {
            face.insert(0, outside[&(v, leads)]);
            face.push(outside[&(v, arrives)]);
        }
        // A polygon with two corners does not become a face: its two edges are merged.
        if face.len() > 2 {
            faces.push(face);
        }
    }
    Polygons::new(positions, faces)
}
