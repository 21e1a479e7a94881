//! Converts a mesh to arrays, with which a view draws the mesh and picks its elements.

use geometry::triangulate::Cutter;
use mesh::{DVec3, FaceId, HalfEdgeId, Mesh};

/// The arrays of a mesh. The indices of vertices and faces are the ids that recipes use.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arrays {
    /// The center of the bounding box of the vertices, in scene units.
    pub center: [f64; 3],
    /// The position of each vertex relative to the center: x, y and z, one vertex after another. The positions are
    /// relative because 32-bit numbers are precise only near 0.
    pub positions: Vec<f32>,
    /// The vertices of each triangle, counter-clockwise. A polygon has several triangles.
    pub triangles: Vec<u32>,
    /// The face of each triangle.
    pub faces: Vec<u32>,
    /// The two vertices of each edge.
    pub edges: Vec<u32>,
}

impl Arrays {
    /// Returns the arrays of a mesh.
    pub fn new(mesh: &Mesh) -> Self {
        let center = center(mesh);
        let mut arrays = Self {
            center: center.to_array(),
            ..Self::default()
        };
        let relative = |&p: &DVec3| (p - center).as_vec3().to_array();
        arrays.positions = mesh.positions().iter().flat_map(relative).collect();
        each_triangle(mesh, |f, corners| {
            let vertices = corners.map(|h| number(mesh.origin(h).index()));
            arrays.triangles.extend(vertices);
            arrays.faces.push(number(f.index()));
        });
        let ends = mesh.edges().flat_map(|e| mesh.edge_vertices(e));
        arrays.edges = ends.map(|v| number(v.index())).collect();
        arrays
    }
}

/// Calls `each` with the face and the corners of each triangle. A polygon has several triangles.
pub(crate) fn each_triangle(mesh: &Mesh, mut each: impl FnMut(FaceId, [HalfEdgeId; 3])) {
    let mut cutter = Cutter::default();
    let mut corners = Vec::new();
    for f in mesh.faces() {
        corners.clear();
        corners.extend(mesh.face_half_edges(f));
        let cut = cutter.cut(mesh, f);
        // A face that is a triangle is not cut, so the cutter returns no triangles for it.
        let whole = [[0, 1, 2]];
        let triangles = match cut.triangles() {
            [] if corners.len() == 3 => &whole[..],
            triangles => triangles,
        };
        for triangle in triangles {
            each(f, triangle.map(|c| corners[c as usize]));
        }
    }
}

fn number(id: usize) -> u32 {
    u32::try_from(id).unwrap_or(u32::MAX)
}

/// Returns the center of the bounding box; the origin if there are no vertices.
fn center(mesh: &Mesh) -> DVec3 {
    let positions = || mesh.vertices().map(|v| mesh.position(v));
    let low = positions().reduce(DVec3::min).unwrap_or(DVec3::ZERO);
    let high = positions().reduce(DVec3::max).unwrap_or(DVec3::ZERO);
    // Each term is halved first, so that the sum does not overflow.
    0.5 * low + 0.5 * high
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;

    #[test]
    fn a_cube_has_two_triangles_for_each_face() {
        let arrays = Arrays::new(&shapes::cube());
        assert_eq!(arrays.positions.len(), 3 * 8);
        assert_eq!(arrays.faces, [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5]);
        assert_eq!(arrays.triangles.len(), 3 * 12);
        assert_eq!(arrays.edges.len(), 2 * 12);
    }

    /// The signed volume of the triangles is the volume of the mesh: no triangle is missing or reversed.
    #[test]
    fn the_triangles_enclose_the_volume_of_the_mesh() {
        for mesh in [shapes::cube(), shapes::cylinder(7, true)] {
            let arrays = Arrays::new(&mesh);
            let at = |v: &u32| {
                let i = 3 * *v as usize;
                DVec3::from_array([0, 1, 2].map(|k| f64::from(arrays.positions[i + k])))
            };
            let six = |t: &[u32]| at(&t[0]).dot(at(&t[1]).cross(at(&t[2])));
            let volume = arrays.triangles.chunks(3).map(six).sum::<f64>() / 6.0;
            let expected = geometry::volume(&mesh);
            assert!(
                (volume - expected).abs() < 1e-6,
                "{volume}, expected {expected}"
            );
        }
    }

    #[test]
    fn large_coordinates_are_relative_to_the_center() {
        let mut mesh = shapes::cube();
        for p in mesh.positions_mut() {
            *p += DVec3::splat(1e9);
        }
        let arrays = Arrays::new(&mesh);
        let largest = arrays
            .positions
            .iter()
            .fold(0.0, |a: f32, p| a.max(p.abs()));
        assert!(largest <= 1.0, "{largest}");
        let empty = Arrays::new(&Mesh::default());
        assert_eq!(empty, Arrays::default());
    }
}
