//! Loop, Catmull-Clark and midpoint subdivision: each edge gets a new vertex, and each face is cut at the new vertices
//! of its edges.

use std::collections::BTreeMap;

use mesh::DVec3;
use subdivision::{Rules, Scheme, Split};

use crate::charts;
use crate::masks;
use crate::polygons::{Adjacency, Edge, Polygons, ahead, behind, edge};
use crate::sharpness::Sharpness;

/// The location of a corner of a new face in its old face.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Place {
    /// At this corner of the old face.
    Corner(usize),
    /// On the side of the old face that starts at this corner.
    Side(usize),
    /// In the center of the old face.
    Center,
}

/// Whether faces are cut into quads around their center.
fn has_centers(scheme: Scheme) -> bool {
    matches!(
        scheme,
        Scheme::CatmullClark | Scheme::Midpoint(Split::Quads)
    )
}

/// Returns the new faces into which an old face with n corners is cut.
pub(crate) fn pieces(scheme: Scheme, n: usize) -> Vec<Vec<Place>> {
    use Place::{Center, Corner, Side};
    if has_centers(scheme) {
        (0..n)
            .map(|i| vec![Corner(i), Side(i), Center, Side(behind(i, n))])
            .collect()
    } else {
        assert_eq!(n, 3, "a triangle");
        let mut pieces: Vec<Vec<Place>> = (0..3)
            .map(|i| vec![Corner(i), Side(i), Side(behind(i, 3))])
            .collect();
        pieces.push((0..3).map(Side).collect());
        pieces
    }
}

/// Computes one level.
pub(crate) fn refine(mesh: &Polygons, rules: Rules) -> Polygons {
    let adjacency = Adjacency::new(mesh.positions.len(), &mesh.faces);
    let sharpness = Sharpness::new(mesh, &adjacency, rules.boundary, rules.creasing);
    let (n_vertices, n_edges) = (mesh.positions.len(), adjacency.sides.len());
    let numbers: BTreeMap<Edge, usize> = adjacency
        .sides
        .keys()
        .enumerate()
        .map(|(i, &e)| (e, n_vertices + i))
        .collect();

    let centers: Vec<DVec3> = mesh
        .faces
        .iter()
        .map(|face| mean(&mesh.positions, face))
        .collect();
    let mut positions: Vec<DVec3> = (0..n_vertices)
        .map(|v| {
            let mask = masks::of_vertex(v, rules, &adjacency, &sharpness);
            mask.own * mesh.positions[v]
                + mask
                    .neighbors
                    .iter()
                    .map(|(&w, t)| *t * mesh.positions[w])
                    .sum::<DVec3>()
                + mask
                    .centers
                    .iter()
                    .map(|(&f, t)| *t * centers[f])
                    .sum::<DVec3>()
        })
        .collect();
    for (&(a, b), sides) in &adjacency.sides {
        let mask = masks::of_edge((a, b), rules, &sharpness);
        let beside = |&(f, i): &(usize, usize)| {
            if has_centers(rules.scheme) {
                centers[f]
            } else {
                mesh.positions[adjacency.at((f, i), 2)]
            }
        };
        let ends = mask.end * (mesh.positions[a] + mesh.positions[b]);
        positions.push(ends + mask.side * sides.iter().map(beside).sum::<DVec3>());
    }
    if has_centers(rules.scheme) {
        positions.extend(&centers);
    }

    let number = |f: usize, place: Place| {
        let face = &mesh.faces[f];
        match place {
            Place::Corner(i) => face[i],
            Place::Side(i) => numbers[&edge(face[i], face[ahead(i, face.len())])],
            Place::Center => n_vertices + n_edges + f,
        }
    };
    let mut faces = Vec::new();
    for (f, face) in mesh.faces.iter().enumerate() {
        for piece in pieces(rules.scheme, face.len()) {
            faces.push(piece.iter().map(|&place| number(f, place)).collect());
        }
    }

    let mut crease = BTreeMap::new();
    for (&(a, b), halves) in &sharpness.stored_halves {
        crease.insert(edge(a, numbers[&(a, b)]), halves[0]);
        crease.insert(edge(b, numbers[&(a, b)]), halves[1]);
    }
    let mut corner = sharpness.stored_vertices.clone();
    corner.resize(positions.len(), 0.0);
    let charts = (mesh.charts.as_ref())
        .map(|charts| charts::refine(charts, mesh, rules, &adjacency, &sharpness, &numbers));
    Polygons {
        positions,
        faces,
        crease,
        corner,
        charts,
    }
}

/// Returns the mean of the corners of a face.
pub(crate) fn mean(positions: &[DVec3], face: &[usize]) -> DVec3 {
    face.iter().map(|&v| positions[v]).sum::<DVec3>() / face.len() as f64
}
