//! Tests the limit surface: all levels have the same limit surface, and it agrees with known surfaces.

use geometry::shapes;
use mesh::{CREASE, DVec3, Mesh, VERTEX_SHARPNESS, VertexId};
use progress::NoProgress;

use crate::fixtures;
use crate::{
    Boundary, Creasing, Limit, LoopWeights, Rules, Scheme, SubdivisionError, limit, subdivide,
};

const SCHEMES: [Scheme; 3] = [
    Scheme::Loop(LoopWeights::Warren),
    Scheme::Loop(LoopWeights::Loop),
    Scheme::CatmullClark,
];

fn limit_of(mesh: &Mesh, rules: Rules) -> Limit {
    limit(mesh, rules, &NoProgress).unwrap()
}

/// Returns every fixture, without sharpness and with several patterns of sharpness.
fn sharpened() -> Vec<(String, Mesh)> {
    let patterns: [&[f64]; 4] = [
        &[0.0],
        &[0.0, 0.0, 10.0],
        &[0.0, 0.0, 0.0, 2.5, 0.0, 0.3, 0.0],
        &[10.0, 1.7, 0.0, 0.0, 0.0],
    ];
    let mut meshes = Vec::new();
    for (name, mesh) in fixtures::all() {
        for (i, pattern) in patterns.iter().enumerate() {
            let mut mesh = mesh.clone();
            let n = mesh.n_edges();
            mesh.set(CREASE, pattern.iter().copied().cycle().take(n).collect());
            let vertex_sharpness = [0.0, 0.0, 0.0, 0.0, 1.5, 0.0, 0.0, 0.0, 10.0];
            let vertex_sharpness: &[f64] = if i > 1 { &vertex_sharpness } else { &[0.0] };
            let n = mesh.n_vertices();
            mesh.set(
                VERTEX_SHARPNESS,
                vertex_sharpness.iter().copied().cycle().take(n).collect(),
            );
            meshes.push((format!("{name} {i}"), mesh));
        }
    }
    meshes
}

fn rules() -> impl Iterator<Item = Rules> {
    SCHEMES.into_iter().flat_map(|scheme| {
        [
            Boundary::EdgesOnly,
            Boundary::EdgesAndCorners,
            Boundary::Fixed,
        ]
        .map(|boundary| Rules {
            boundary,
            ..Rules::of(scheme)
        })
    })
}

#[test]
fn a_level_does_not_change_the_limit() {
    for (name, mesh) in sharpened() {
        for rules in rules() {
            let finer = subdivide(&mesh, rules, 1, &NoProgress).unwrap();
            let (coarse, fine) = (limit_of(&mesh, rules), limit_of(&finer, rules));
            for v in mesh.vertices() {
                let [a, b] = [&coarse, &fine].map(|l| l.positions[v.index()]);
                let far = a.distance(b);
                assert!(far < 1e-13, "{name} {rules:?} {v}: {far:e}");
            }
        }
    }
}

#[test]
fn vertices_converge_to_their_limits() {
    for (name, mesh) in sharpened() {
        for rules in rules().filter(|r| r.boundary == Boundary::EdgesAndCorners) {
            let limit = limit_of(&mesh, rules);
            let fine = subdivide(&mesh, rules, 5, &NoProgress).unwrap();
            for v in mesh.vertices() {
                let far = limit.positions[v.index()].distance(fine.position(v));
                assert!(far < 2e-2, "{name} {rules:?} {v}: {far:e}");
            }
        }
    }
}

/// Returns the mean normal of the faces around a vertex.
fn mean_normal(mesh: &Mesh, v: VertexId) -> DVec3 {
    let faces = mesh
        .vertex_half_edges(v)
        .filter(|&h| mesh.face(h).is_some());
    let normal = |h| {
        let [a, b] = [mesh.next(h), mesh.prev(h)].map(|h| mesh.position(mesh.origin(h)));
        let p = mesh.position(v);
        (a - p)
            .normalize_or_zero()
            .cross((b - p).normalize_or_zero())
    };
    faces.map(normal).sum::<DVec3>().normalize_or_zero()
}

#[test]
fn normals_of_fine_faces_converge_to_limit_normals() {
    // The limit surfaces of these meshes are smooth everywhere except at the boundary.
    for (name, mesh) in fixtures::all() {
        if name == "pillow" {
            continue; // The pillow is flat: its limit has two sides and no normal.
        }
        for rules in rules().filter(|r| r.boundary == Boundary::EdgesOnly) {
            let normals = limit_of(&mesh, rules).normals();
            let fine = subdivide(&mesh, rules, 5, &NoProgress).unwrap();
            for v in mesh.vertices() {
                let [a, b] = [normals[v.index()], mean_normal(&fine, v)];
                if a == DVec3::ZERO {
                    assert!(mesh.vertex_half_edge(v).is_none(), "{name} {rules:?} {v}");
                    continue;
                }
                assert!(a.dot(b) > 0.99, "{name} {rules:?} {v}: {a} {b}");
            }
        }
    }
}

#[test]
fn a_level_does_not_change_the_limit_normals() {
    for (name, mesh) in sharpened() {
        if name.starts_with("pillow") {
            continue;
        }
        for rules in rules() {
            let finer = subdivide(&mesh, rules, 1, &NoProgress).unwrap();
            let [coarse, fine] = [&mesh, &finer].map(|m| limit_of(m, rules).normals());
            for v in mesh.vertices() {
                if is_corner(&mesh, rules, v) {
                    continue; // A corner without a tangent plane has no well-defined normal.
                }
                let far = coarse[v.index()].distance(fine[v.index()]);
                assert!(far < 1e-9, "{name} {rules:?} {v}: {far:e}");
            }
        }
    }
}

fn is_corner(mesh: &Mesh, rules: Rules, v: VertexId) -> bool {
    let sharp = mesh.vertex_half_edges(v).filter(|h| {
        mesh.is_boundary_edge(h.edge()) || mesh.get(CREASE).unwrap()[h.edge().index()] > 0.0
    });
    let is_boundary = mesh.is_boundary_vertex(v);
    let vertex_sharpness = mesh.get(VERTEX_SHARPNESS).unwrap()[v.index()];
    let fixed = is_boundary
        && match rules.boundary {
            Boundary::EdgesOnly => false,
            Boundary::EdgesAndCorners => mesh.valence(v) == 2,
            Boundary::Fixed => true,
        };
    sharp.count() > 2 || vertex_sharpness > 0.0 || fixed
}

#[test]
fn the_two_sides_of_a_crease_have_different_normals() {
    // If all edges of a cube are sharp, the limit surface is the cube itself, and each corner has the normal of its
    // face.
    let mut cube = shapes::cube();
    cube.set(CREASE, vec![10.0; 12]);
    let limit = limit_of(&cube, Rules::of(Scheme::CatmullClark));
    assert_eq!(limit.positions, cube.positions());
    let normals = limit.corner_normals.unwrap();
    for h in cube.half_edges() {
        let normal = cube.face_normal(cube.face(h).unwrap());
        assert!(normals[h.index()].distance(normal) < 1e-15, "{h}");
    }
    assert_eq!(
        limit_of(&shapes::cube(), Rules::of(Scheme::CatmullClark)).corner_normals,
        None
    );
}

#[test]
fn a_regular_loop_patch_has_the_value_of_the_box_spline() {
    // One vertex is raised to the height 1. The limit surface is then a quartic box spline, with the height 1/2 at this
    // vertex and 1/12 at its six neighbors.
    let mut mesh = fixtures::sheet(6, 6);
    let inner = mesh
        .vertices()
        .find(|&v| !mesh.is_boundary_vertex(v) && mesh.position(v).length() < 0.3);
    let v = inner.unwrap();
    mesh.positions_mut()[v.index()].z = 1.0;
    let limit = limit_of(&mesh, Rules::of(Scheme::Loop(LoopWeights::Loop)));
    assert!((limit.positions[v.index()].z - 0.5).abs() < 1e-15);
    for w in mesh.vertex_neighbors(v) {
        assert!((limit.positions[w.index()].z - 1.0 / 12.0).abs() < 1e-15);
    }
}

#[test]
fn a_regular_grid_has_the_values_of_the_bicubic_spline() {
    let mut mesh = shapes::grid(6, 6);
    let v = mesh
        .vertices()
        .find(|&v| mesh.position(v).length() < 0.01)
        .unwrap();
    mesh.positions_mut()[v.index()].z = 1.0;
    let limit = limit_of(&mesh, Rules::of(Scheme::CatmullClark));
    let z = |v: VertexId| limit.positions[v.index()].z;
    assert!((z(v) - 4.0 / 9.0).abs() < 1e-15);
    for h in mesh.vertex_half_edges(v) {
        assert!((z(mesh.target(h)) - 1.0 / 9.0).abs() < 1e-15);
        let opposite = mesh.target(mesh.next(h));
        assert!((z(opposite) - 1.0 / 36.0).abs() < 1e-15);
    }
}

#[test]
fn chaikin_creases_with_neighbors_of_lower_sharpness_keep_their_limit() {
    let mut mesh = shapes::icosahedron();
    mesh.set(CREASE, (0..30).map(|e| f64::from(e % 10)).collect());
    let rules = Rules {
        creasing: Creasing::Chaikin,
        ..Rules::of(Scheme::Loop(LoopWeights::Warren))
    };
    let fine = subdivide(&mesh, rules, 1, &NoProgress).unwrap();
    let [a, b] = [&mesh, &fine].map(|m| limit_of(m, rules));
    for v in mesh.vertices() {
        assert!(
            a.positions[v.index()].distance(b.positions[v.index()]) < 1e-12,
            "{v}"
        );
    }
}

#[test]
fn schemes_without_limit_masks_return_an_error() {
    let error = limit(&shapes::cube(), Rules::of(Scheme::DooSabin), &NoProgress).unwrap_err();
    assert_eq!(error, SubdivisionError::NoLimit(Scheme::DooSabin));
}
