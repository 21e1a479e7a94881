//! Triangle meshes for the tests.

use geometry::shapes;
use mesh::{DVec3, FaceId, Mesh, VertexId};

/// Returns triangle meshes of many kinds, with their names. Positions are jittered, so that no two vertices have equal
/// neighborhoods.
pub(crate) fn all() -> Vec<(&'static str, Mesh)> {
    let fixtures = vec![
        ("nothing", Mesh::default()),
        ("one vertex", of(1, &[])),
        ("one triangle", of(3, &[[0, 1, 2]])),
        ("pillow", of(3, &[[0, 1, 2], [2, 1, 0]])),
        ("two triangles", of(4, &[[0, 1, 2], [2, 1, 3]])),
        ("tetrahedron", shapes::tetrahedron()),
        ("octahedron", shapes::octahedron()),
        ("icosahedron", shapes::icosahedron()),
        ("torus", triangulated(&shapes::torus(6, 4, 2.0, 1.0))),
        ("sheet", sheet(4, 3)),
        ("annulus", annulus()),
        ("tube", triangulated(&shapes::cylinder(5, false))),
        ("high valence", triangulated(&shapes::uv_sphere(11, 3))),
        ("bow-tie", of(5, &[[0, 1, 2], [0, 3, 4]])),
        (
            "three faces at an edge",
            of(5, &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]),
        ),
        (
            "parts and isolated vertices",
            of(
                12,
                &[[1, 2, 3], [3, 2, 4], [6, 7, 8], [6, 8, 9], [6, 9, 10]],
            ),
        ),
    ];
    fixtures
        .into_iter()
        .map(|(n, m)| (n, jittered(m)))
        .collect()
}

/// Returns a flat sheet of triangles with parallel diagonals, so that inner vertices have valence 6.
pub(crate) fn sheet(columns: u32, rows: u32) -> Mesh {
    triangulated(&shapes::grid(columns, rows))
}

/// Triangulates every face as a fan around its first corner.
pub(crate) fn triangulated(mesh: &Mesh) -> Mesh {
    let mut triangles = Vec::new();
    for f in mesh.faces() {
        let v: Vec<u32> = mesh.face_vertices(f).map(number).collect();
        triangles.extend((2..v.len()).map(|i| [v[0], v[i - 1], v[i]]));
    }
    Mesh::from_polygons(mesh.positions().to_vec(), &triangles)
        .unwrap()
        .0
}

/// Returns the sorted list of faces, each as its vertex ids. Each face starts with its lowest vertex. Two meshes
/// that differ only in the ids of edges and faces have equal lists.
pub(crate) fn triangles(mesh: &Mesh) -> Vec<[u32; 3]> {
    let mut triangles: Vec<[u32; 3]> = mesh.faces().map(|f| corners(mesh, f)).collect();
    for t in &mut triangles {
        while t[0] != *t.iter().min().unwrap() {
            t.rotate_left(1);
        }
    }
    triangles.sort_unstable();
    triangles
}

/// Returns the vertices of a triangle, starting with the origin of its first half-edge.
pub(crate) fn corners(mesh: &Mesh, f: FaceId) -> [u32; 3] {
    let mut v = mesh.face_vertices(f).map(number);
    [(); 3].map(|()| v.next().unwrap())
}

/// Returns the id of a vertex as a number.
pub(crate) fn number(v: VertexId) -> u32 {
    u32::try_from(v.index()).unwrap()
}

/// Moves every vertex by a pseudo-random vector that depends on its id, by at most 0.1 along each axis.
fn jittered(mut mesh: Mesh) -> Mesh {
    for (i, p) in (1_u32..).zip(mesh.positions_mut()) {
        let jitter = |k: u32| f64::from(i.wrapping_mul(k) >> 8) / f64::from(1_u32 << 24) - 0.5;
        *p += 0.2
            * DVec3::new(
                jitter(2_654_435_769),
                jitter(2_246_822_519),
                jitter(3_266_489_917),
            );
    }
    mesh
}

/// Returns a sheet without its middle square.
fn annulus() -> Mesh {
    let sheet = sheet(5, 5);
    let kept = sheet
        .faces()
        .filter(|&f| sheet.face_center(f).length() > 0.5);
    let triangles: Vec<[u32; 3]> = kept.map(|f| corners(&sheet, f)).collect();
    assert_eq!(triangles.len(), 48);
    Mesh::from_polygons(sheet.positions().to_vec(), &triangles)
        .unwrap()
        .0
}

/// Returns a mesh of the given triangles, over `n` vertices on a spiral.
fn of(n: u32, triangles: &[[u32; 3]]) -> Mesh {
    let positions = (0..n)
        .map(|i| {
            let (sin, cos) = libm::sincos(f64::from(i));
            DVec3::new(cos, sin, 0.3 * f64::from(i))
        })
        .collect();
    Mesh::from_polygons(positions, triangles).unwrap().0
}
