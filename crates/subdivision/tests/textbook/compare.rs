//! Compares a mesh of the crate with a mesh of the textbook implementation.

use std::collections::{BTreeMap, BTreeSet};

use mesh::{COLOR, CREASE, DVec2, DVec3, DVec4, Mesh, UV, VERTEX_SHARPNESS, VertexId};

use crate::polygons::{Polygons, edge};

/// The tolerance for equal numbers. For positions, the tolerance is relative to the size of the mesh.
const TOLERANCE: f64 = 1e-12;

/// Converts polygon lists to a mesh with columns for sharpness and corner values. Each vertex also has its position as
/// its color.
pub(crate) fn mesh_of(polygons: &Polygons) -> Mesh {
    let number = |&v: &usize| u32::try_from(v).expect("few vertices");
    let faces: Vec<Vec<u32>> = polygons
        .faces
        .iter()
        .map(|face| face.iter().map(number).collect())
        .collect();
    let (mut mesh, report) =
        Mesh::from_polygons(polygons.positions.clone(), &faces).expect("valid polygons");
    assert!(report.is_clean(), "{}", report.summary());
    let sharpness = |e| {
        let [a, b] = mesh.edge_vertices(e).map(VertexId::index);
        polygons.crease.get(&edge(a, b)).copied().unwrap_or(0.0)
    };
    let crease: Vec<f64> = mesh.edges().map(sharpness).collect();
    mesh.set(CREASE, crease);
    mesh.set(VERTEX_SHARPNESS, polygons.corner.clone());
    let colors: Vec<DVec4> = mesh.positions().iter().map(|p| p.extend(1.0)).collect();
    mesh.set(COLOR, colors);
    if let Some(charts) = &polygons.charts {
        let mut uv = vec![DVec2::ZERO; mesh.n_half_edges()];
        for (f, numbers) in mesh.faces().zip(charts.numbers()) {
            let face = &polygons.faces[f.index()];
            for h in mesh.face_half_edges(f) {
                let i = face.iter().position(|&v| v == mesh.origin(h).index());
                uv[h.index()] = numbers[i.expect("a corner of the face")];
            }
        }
        mesh.set(UV, uv);
    }
    mesh
}

/// Describes the first difference between a mesh and the expected polygon lists; `None` if they are equal.
pub(crate) fn difference(mesh: &Mesh, expected: &Polygons) -> Option<String> {
    let defects = mesh.defects();
    if !defects.is_empty() {
        return Some(format!(
            "{} defects, the first {:?}",
            defects.len(),
            defects[0]
        ));
    }
    let vertices: Vec<VertexId> = mesh.vertices().collect();
    let positions: Vec<DVec3> = vertices.iter().map(|&v| mesh.position(v)).collect();
    let matched = match matches(&positions, &expected.positions) {
        Ok(matched) => matched,
        Err(error) => return Some(error),
    };
    let place: BTreeMap<VertexId, usize> = vertices.iter().copied().zip(matched).collect();

    // For each face: its vertices, as numbered in `expected`, and the texture coordinates of its corners.
    let uv = mesh.get(UV);
    let mut faces: BTreeMap<Vec<usize>, Vec<Option<DVec2>>> = BTreeMap::new();
    for f in mesh.faces() {
        let corners = mesh.face_half_edges(f);
        faces.extend([rotated(
            corners.clone().map(|h| place[&mesh.origin(h)]).collect(),
            corners.map(|h| uv.map(|uv| uv[h.index()])).collect(),
        )]);
    }
    if mesh.n_faces() != expected.faces.len() {
        return Some(format!(
            "{} faces, expected {}",
            mesh.n_faces(),
            expected.faces.len()
        ));
    }
    let numbers = expected.charts.as_ref().map(super::charts::Charts::numbers);
    for (f, face) in expected.faces.iter().enumerate() {
        let numbers = numbers.as_ref().map_or(vec![None; face.len()], |numbers| {
            numbers[f].iter().copied().map(Some).collect()
        });
        let (face, numbers) = rotated(face.clone(), numbers);
        let Some(found) = faces.get(&face) else {
            return Some(format!("missing face {face:?}"));
        };
        for (i, (found, expected)) in found.iter().zip(&numbers).enumerate() {
            let Some(expected) = expected else { continue };
            match found {
                Some(found) if (*found - *expected).abs().max_element() <= TOLERANCE => {}
                _ => {
                    return Some(format!(
                        "at corner {} of face {face:?}: {found:?}, expected {expected:?}",
                        face[i]
                    ));
                }
            }
        }
    }
    sharpness_difference(mesh, expected, &place).or_else(|| color_difference(mesh))
}

/// Describes the first difference in the sharpness columns.
fn sharpness_difference(
    mesh: &Mesh,
    expected: &Polygons,
    place: &BTreeMap<VertexId, usize>,
) -> Option<String> {
    let differs = |found: f64, expected: f64| (found - expected).abs() > TOLERANCE;
    let (Some(crease), Some(corner)) = (mesh.get(CREASE), mesh.get(VERTEX_SHARPNESS)) else {
        return Some("a sharpness column is missing".to_owned());
    };
    for e in mesh.edges() {
        let [a, b] = mesh.edge_vertices(e).map(|v| place[&v]);
        let s = expected.crease.get(&edge(a, b)).copied().unwrap_or(0.0);
        if differs(crease[e.index()], s) {
            return Some(format!(
                "edge {a}, {b} has sharpness {}, expected {s}",
                crease[e.index()]
            ));
        }
    }
    for v in mesh.vertices() {
        let s = expected.corner[place[&v]];
        if differs(corner[v.index()], s) {
            let found = corner[v.index()];
            return Some(format!(
                "vertex {} has sharpness {found}, expected {s}",
                place[&v]
            ));
        }
    }
    None
}

/// Describes the first vertex whose color differs from its position. Before subdivision, colors and positions were
/// equal.
fn color_difference(mesh: &Mesh) -> Option<String> {
    let Some(colors) = mesh.get(COLOR) else {
        return Some("the color column is missing".to_owned());
    };
    let size = size(mesh.positions());
    mesh.vertices().find_map(|v| {
        let (color, p) = (colors[v.index()], mesh.position(v).extend(1.0));
        let is_near = (color - p).abs().max_element() <= TOLERANCE * size.max(1.0);
        (!is_near).then(|| format!("{v:?} at {p} has the color {color}"))
    })
}

/// Returns the largest absolute coordinate.
fn size(points: &[DVec3]) -> f64 {
    points
        .iter()
        .map(|p| p.abs().max_element())
        .fold(0.0, f64::max)
}

/// Returns, for each point of the first list, the index of the point in the second list at the same position (up to a
/// tolerance). Fails if a point has no partner, or two points have the same partner.
fn matches(points: &[DVec3], expected: &[DVec3]) -> Result<Vec<usize>, String> {
    if points.len() != expected.len() {
        return Err(format!(
            "{} vertices, expected {}",
            points.len(),
            expected.len()
        ));
    }
    let size = size(expected);
    let mut by_x: Vec<usize> = (0..expected.len()).collect();
    by_x.sort_by(|&a, &b| expected[a].x.total_cmp(&expected[b].x));
    let mut taken = BTreeSet::new();
    let mut unmatched = BTreeMap::new();
    let mut matched = Vec::new();
    for (i, p) in points.iter().enumerate() {
        let reach = TOLERANCE * size;
        let from = by_x.partition_point(|&k| expected[k].x < p.x - reach);
        let to = by_x.partition_point(|&k| expected[k].x <= p.x + reach);
        let near = by_x[from..to]
            .iter()
            .find(|&&k| (expected[k] - *p).abs().max_element() <= reach);
        match near {
            Some(&k) if taken.insert(k) => matched.push(k),
            _ => {
                unmatched.insert(i, *p);
            }
        }
    }
    let Some((&i, &p)) = unmatched.first_key_value() else {
        return Ok(matched);
    };
    let free = (0..expected.len()).filter(|k| !taken.contains(k));
    let distance = |k: &usize| (expected[*k] - p).length();
    let nearest = free
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))
        .expect("both lists have the same length");
    Err(format!(
        "{} of {} vertices do not match: vertex {i} is at {p}; the nearest vertex of the textbook is {nearest} at \
         {}, {:.1e} away",
        unmatched.len(),
        points.len(),
        expected[nearest],
        distance(&nearest)
    ))
}

/// Rotates a face so that it starts at its lowest vertex.
fn rotated<T>(mut face: Vec<usize>, mut values: Vec<T>) -> (Vec<usize>, Vec<T>) {
    let lowest = (0..face.len()).min_by_key(|&i| face[i]).expect("corners");
    face.rotate_left(lowest);
    values.rotate_left(lowest);
    (face, values)
}
