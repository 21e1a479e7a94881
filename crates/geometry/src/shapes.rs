//! Simple meshes for examples, tests and recipes.
//!
//! All shapes except [`square`] are centered at the origin. Faces are counter-clockwise when seen from outside. The
//! faces of flat shapes are counter-clockwise when seen from above (from +z).

use mesh::{DVec3, Mesh, VertexId, parallel};

/// Makes the square from (0, 0, 0) to (1, 1, 0): one face.
pub fn square() -> Mesh {
    let positions = vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
    of(positions, &[[0, 1, 2, 3]])
}

/// Makes a cube with corners at ±1: 8 vertices, 6 squares.
///
/// ```text
///      6 ------ 7        z
///     /|       /|        |  y
///    4 ------ 5 |        | /
///    | 2 -----| 3        |/
///    |/       |/         +---- x
///    0 ------ 1
/// ```
///
/// The id of a vertex is (x > 0) + 2 (y > 0) + 4 (z > 0), where a true condition counts as 1. The faces
/// are, in order, -z, +z, -y, +x, +y and -x.
pub fn cube() -> Mesh {
    let side = |bit: usize| if bit == 0 { -1.0 } else { 1.0 };
    let positions = (0..8)
        .map(|i| DVec3::new(side(i & 1), side(i & 2), side(i & 4)))
        .collect();
    of(
        positions,
        &[
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [1, 3, 7, 5],
            [3, 2, 6, 7],
            [2, 0, 4, 6],
        ],
    )
}

/// Makes a regular tetrahedron from four of the corners of the cube with corners at ±1: 4 vertices, 4 triangles.
pub fn tetrahedron() -> Mesh {
    let at = DVec3::new;
    let positions = vec![
        at(1., 1., 1.),
        at(-1., -1., 1.),
        at(-1., 1., -1.),
        at(1., -1., -1.),
    ];
    of(positions, &[[0, 1, 3], [0, 2, 1], [0, 3, 2], [1, 2, 3]])
}

/// Makes a regular octahedron with corners on the axes, at the distance 1 from the origin: 6 vertices, 8 triangles.
pub fn octahedron() -> Mesh {
    let positions = vec![
        DVec3::X,
        DVec3::NEG_X,
        DVec3::Y,
        DVec3::NEG_Y,
        DVec3::Z,
        DVec3::NEG_Z,
    ];
    of(
        positions,
        &[
            [0, 2, 4],
            [2, 1, 4],
            [1, 3, 4],
            [3, 0, 4],
            [2, 0, 5],
            [1, 2, 5],
            [3, 1, 5],
            [0, 3, 5],
        ],
    )
}

/// Makes a regular icosahedron with corners at distance 1 from the origin: 12 vertices, 20 triangles.
pub fn icosahedron() -> Mesh {
    let golden = f64::midpoint(1.0, 5.0_f64.sqrt());
    let scale = 1.0 / (1.0 + golden * golden).sqrt();
    let (a, b) = (scale, golden * scale);
    let at = DVec3::new;
    let positions = vec![
        at(-a, b, 0.),
        at(a, b, 0.),
        at(-a, -b, 0.),
        at(a, -b, 0.),
        at(0., -a, b),
        at(0., a, b),
        at(0., -a, -b),
        at(0., a, -b),
        at(b, 0., -a),
        at(b, 0., a),
        at(-b, 0., -a),
        at(-b, 0., a),
    ];
    of(
        positions,
        &[
            [0, 11, 5],
            [0, 5, 1],
            [0, 1, 7],
            [0, 7, 10],
            [0, 10, 11],
            [1, 5, 9],
            [5, 11, 4],
            [11, 10, 2],
            [10, 7, 6],
            [7, 1, 8],
            [3, 9, 4],
            [3, 4, 2],
            [3, 2, 6],
            [3, 6, 8],
            [3, 8, 9],
            [4, 9, 5],
            [2, 4, 11],
            [6, 2, 10],
            [8, 6, 7],
            [9, 8, 1],
        ],
    )
}

/// Makes a flat sheet of `columns` x `rows` unit squares. Vertices and faces are numbered row by row, from -y to +y.
///
/// # Panics
///
/// Panics if the mesh would have too many elements for 32-bit ids.
pub fn grid(columns: u32, rows: u32) -> Mesh {
    let corner = DVec3::new(f64::from(columns), f64::from(rows), 0.0) / 2.0;
    let positions = cells(columns + 1, rows + 1, |x, y| {
        DVec3::new(f64::from(x), f64::from(y), 0.0) - corner
    });
    let polygons = cells(columns, rows, |x, y| {
        let i = y * (columns + 1) + x;
        [i, i + 1, i + columns + 2, i + columns + 1]
    });
    of(positions, &polygons)
}

/// Makes a torus around the z axis with `around` x `across` quadrilaterals. `major` is the distance from the
/// axis to the center of the tube, and `minor` is the radius of the tube.
///
/// # Panics
///
/// Panics if `around` or `across` is below 3, `major + minor` is not finite, or the mesh would have too many elements
/// for 32-bit ids.
pub fn torus(around: u32, across: u32, major: f64, minor: f64) -> Mesh {
    assert!(
        around >= 3 && across >= 3,
        "a torus needs at least 3 x 3 faces"
    );
    let across_turns: Vec<_> = (0..across).map(|j| turn(j, across)).collect();
    let around_turns: Vec<_> = (0..around).map(|i| turn(i, around)).collect();
    let positions = cells(across, around, |j, i| {
        let ((out, up), (x, y)) = (across_turns[j as usize], around_turns[i as usize]);
        let r = major + minor * out;
        DVec3::new(r * x, r * y, minor * up)
    });
    let id = |i: u32, j: u32| (i % around) * across + j % across;
    let polygons = cells(across, around, |j, i| {
        [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)]
    });
    of(positions, &polygons)
}

/// Makes a cylinder around the z axis with radius 1, from z = -1 to z = 1. The side has `around` quadrilaterals. If
/// `caps` is true, each end is closed by one face with `around` corners.
///
/// # Panics
///
/// Panics if `around` is below 3.
pub fn cylinder(around: u32, caps: bool) -> Mesh {
    assert!(around >= 3, "a cylinder needs at least 3 sides");
    let positions = [-1.0, 1.0]
        .into_iter()
        .flat_map(|z| {
            (0..around).map(move |i| {
                let (x, y) = turn(i, around);
                DVec3::new(x, y, z)
            })
        })
        .collect();
    let mut polygons: Vec<Vec<u32>> = (0..around)
        .map(|i| {
            let j = (i + 1) % around;
            vec![i, j, around + j, around + i]
        })
        .collect();
    if caps {
        polygons.push((0..around).rev().collect());
        polygons.push((around..2 * around).collect());
    }
    of(positions, &polygons)
}

/// Makes a sphere of radius 1 with poles at ±z. The sphere has `around` meridians and `rings` bands of faces
/// from pole to pole: triangles at the poles and quadrilaterals between them.
///
/// # Panics
///
/// Panics if `around` is below 3 or `rings` below 2.
pub fn uv_sphere(around: u32, rings: u32) -> Mesh {
    assert!(
        around >= 3 && rings >= 2,
        "a sphere needs at least 3 meridians and 2 rings"
    );
    let mut positions = vec![DVec3::NEG_Z];
    for j in 1..rings {
        let (up, out) =
            libm::sincos(std::f64::consts::PI * (f64::from(j) / f64::from(rings) - 0.5));
        for i in 0..around {
            let (x, y) = turn(i, around);
            positions.push(DVec3::new(out * x, out * y, up));
        }
    }
    positions.push(DVec3::Z);
    let id = |j: u32, i: u32| 1 + (j - 1) * around + i % around;
    let top = 1 + (rings - 1) * around;
    let mut polygons: Vec<Vec<u32>> = (0..around)
        .map(|i| vec![0, id(1, i + 1), id(1, i)])
        .collect();
    for j in 1..rings - 1 {
        polygons.extend(
            (0..around).map(|i| vec![id(j, i), id(j, i + 1), id(j + 1, i + 1), id(j + 1, i)]),
        );
    }
    polygons.extend((0..around).map(|i| vec![id(rings - 1, i), id(rings - 1, i + 1), top]));
    of(positions, &polygons)
}

/// Returns a mesh in which each polygon is divided into a fan of triangles around its first corner. The triangles are
/// in the order of the polygons. The polygons should be convex, like the faces of the shapes in this module; otherwise,
/// triangles can overlap. The result has no attributes.
pub fn fans(mesh: &Mesh) -> Mesh {
    let number = |v: VertexId| u32::try_from(v.index()).expect("ids are below 2^32");
    let mut triangles = Vec::new();
    for f in mesh.faces() {
        let corners: Vec<u32> = mesh.face_vertices(f).map(number).collect();
        triangles.extend(corners[1..].windows(2).map(|w| [corners[0], w[0], w[1]]));
    }
    of(mesh.positions().to_vec(), &triangles)
}

/// Returns a list with a value for each cell of a table, row by row. `value` computes the value from the column and the
/// row of the cell.
fn cells<T: Send>(columns: u32, rows: u32, value: impl Fn(u32, u32) -> T + Sync) -> Vec<T> {
    let n = columns as usize * rows as usize;
    let number = |i: usize| u32::try_from(i).expect("a column or a row");
    parallel::collect(n, |i| {
        let columns = columns as usize;
        value(number(i % columns), number(i / columns))
    })
}

/// Divides the unit circle into `n` equal steps, beginning at (1, 0). Returns the point after `i` steps.
fn turn(i: u32, n: u32) -> (f64, f64) {
    let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(i) / f64::from(n));
    (cos, sin)
}

/// Builds a mesh from polygons. The polygons must form a manifold.
fn of(positions: Vec<DVec3>, polygons: &[impl AsRef<[u32]> + Sync]) -> Mesh {
    let (mesh, report) =
        Mesh::from_polygons(positions, polygons).expect("the polygons of a shape are valid");
    debug_assert!(report.is_clean(), "the polygons of a shape are a manifold");
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::volume;

    #[test]
    fn closed_shapes_are_closed_and_face_outwards() {
        let shapes = [
            (cube(), 2),
            (tetrahedron(), 2),
            (octahedron(), 2),
            (icosahedron(), 2),
            (torus(5, 4, 2.0, 0.5), 0),
            (cylinder(7, true), 2),
            (uv_sphere(6, 5), 2),
            (uv_sphere(3, 2), 2),
        ];
        for (mesh, euler) in shapes {
            assert_eq!(mesh.defects(), []);
            assert!(mesh.is_closed());
            assert_eq!(mesh.euler_characteristic(), euler);
            assert!(volume(&mesh) > 0.0);
        }
    }

    #[test]
    fn flat_shapes_face_upwards() {
        for mesh in [square(), grid(3, 2)] {
            assert_eq!(mesh.defects(), []);
            assert!(mesh.faces().all(|f| mesh.face_normal(f) == DVec3::Z));
        }
    }

    #[test]
    fn fans_keep_the_shape() {
        let fan = fans(&cylinder(7, true));
        assert!(fan.faces().all(|f| fan.is_triangle(f)));
        assert_eq!((fan.n_faces(), fan.euler_characteristic()), (24, 2));
        assert!((volume(&fan) - volume(&cylinder(7, true))).abs() < 1e-15);
    }

    #[test]
    fn an_open_cylinder_has_two_boundary_loops() {
        assert_eq!(cylinder(5, false).n_boundary_loops(), 2);
    }

    #[test]
    fn the_vertices_of_round_shapes_lie_on_their_sphere() {
        for mesh in [icosahedron(), uv_sphere(8, 6), octahedron()] {
            assert!(
                mesh.positions()
                    .iter()
                    .all(|p| (p.length() - 1.0).abs() < 1e-15)
            );
        }
    }
}
