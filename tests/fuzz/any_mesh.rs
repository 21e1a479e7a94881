//! Turns arbitrary bytes into a mesh.

use mesh::{CREASE, DVec3, Mesh};

/// The factors by which the coordinates of a mesh are multiplied. Half of the factors are 1, so half of the meshes have
/// ordinary coordinates.
const SCALES: [f64; 8] = [1.0, 1.0, 1.0, 1.0, 0.0, 1e-300, 1e100, 1e290];

/// Removes the first byte and returns it. Returns 0 if there are no bytes.
pub(crate) fn take(bytes: &mut &[u8]) -> u8 {
    let Some((&first, rest)) = bytes.split_first() else {
        return 0;
    };
    *bytes = rest;
    first
}

/// Builds a mesh of at most 32 points and 39 faces, and removes the bytes that determine the mesh. If the first byte is
/// odd, the mesh has creases. Returns `None` if the bytes do not give a valid mesh.
pub(crate) fn mesh(bytes: &mut &[u8]) -> Option<Mesh> {
    let kind = take(bytes);
    let scale = SCALES[usize::from(kind >> 5)];
    let n = take(bytes) % 30 + 3;
    let mut coordinate = || f64::from(take(bytes).cast_signed()) / 16.0 * scale;
    let points: Vec<DVec3> = (0..n)
        .map(|_| DVec3::new(coordinate(), coordinate(), coordinate()))
        .collect();
    let n_faces = take(bytes) % 40;
    let mut polygons = Vec::new();
    for _ in 0..n_faces {
        let degree = take(bytes) % 4 + 3;
        let corners: Vec<u32> = (0..degree).map(|_| u32::from(take(bytes) % n)).collect();
        polygons.push(corners);
    }
    let (mut mesh, _) = Mesh::from_polygons(points, &polygons).ok()?;
    assert_eq!(mesh.defects(), []);
    if kind & 1 == 1 {
        let sharpness = (0..mesh.n_edges()).map(|_| f64::from(take(bytes) % 12));
        mesh.set(CREASE, sharpness.collect());
    }
    Some(mesh)
}
