//! Tests of the parameters of a step: conditions, faces, the limit surface, and errors. Also tests that plans
//! agree with results.

use geometry::shapes;
use mesh::{CREASE, DVec2, DVec3, Mesh, TANGENT, UV, VERTEX_NORMAL};
use op::{
    Context, FaceSelection, Files, Levels, MeshPlan, NoProgress, OpError, PlanContext,
    PositiveLength, Report,
};
use subdivision::{LoopWeights, Rules, Scheme, Split, limit, subdivide};

use super::{Step, Until};

const LOOP: Rules = Rules::of(Scheme::Loop(LoopWeights::Warren));

const SCHEMES: [Scheme; 7] = [
    Scheme::Loop(LoopWeights::Warren),
    Scheme::CatmullClark,
    Scheme::Midpoint(Split::Triangles),
    Scheme::Midpoint(Split::Quads),
    Scheme::Butterfly,
    Scheme::DooSabin,
    Scheme::Sqrt3,
];

/// Returns triangle meshes of different kinds, such as closed meshes and meshes with isolated vertices. Each mesh has a
/// name.
fn fixtures() -> Vec<(&'static str, Mesh)> {
    let of = |n: u32, triangles: &[[u32; 3]]| {
        let positions = (0..n).map(|i| {
            let (sin, cos) = libm::sincos(f64::from(i));
            DVec3::new(cos, sin, 0.3 * f64::from(i))
        });
        let (mesh, _) = Mesh::from_polygons(positions.collect(), triangles).unwrap();
        mesh
    };
    let fans = |mesh: Mesh| shapes::fans(&mesh);
    vec![
        ("nothing", Mesh::default()),
        ("one vertex", of(1, &[])),
        ("one triangle", of(3, &[[0, 1, 2]])),
        ("pillow", of(3, &[[0, 1, 2], [2, 1, 0]])),
        ("two triangles", of(4, &[[0, 1, 2], [2, 1, 3]])),
        ("tetrahedron", shapes::tetrahedron()),
        ("octahedron", shapes::octahedron()),
        ("icosahedron", shapes::icosahedron()),
        ("torus", fans(shapes::torus(6, 4, 2.0, 1.0))),
        ("sheet", sheet()),
        ("tube", fans(shapes::cylinder(5, false))),
        ("high valence", fans(shapes::uv_sphere(11, 3))),
        ("bow-tie", of(5, &[[0, 1, 2], [0, 3, 4]])),
        (
            "parts and isolated vertices",
            of(
                12,
                &[[1, 2, 3], [3, 2, 4], [6, 7, 8], [6, 8, 9], [6, 9, 10]],
            ),
        ),
    ]
}

fn sheet() -> Mesh {
    shapes::fans(&shapes::grid(4, 3))
}

fn apply(step: &Step, mesh: &Mesh) -> Result<(Mesh, Report), OpError> {
    let files = Files::default();
    let mut mesh = mesh.clone();
    let report = step.apply(&mut mesh, &mut Context::new(&NoProgress, &files))?;
    Ok((mesh, report))
}

fn problems(step: &Step, mesh: &Mesh) -> Vec<String> {
    let files = Files::default();
    let cx = PlanContext::new(&files);
    let found = step.plan("Test", &mut MeshPlan::of(mesh), &cx);
    found
        .into_iter()
        .map(|p| format!("{:?} {}", p.path, p.message))
        .collect()
}

fn longest(mesh: &Mesh) -> f64 {
    let length = |e| {
        let [a, b] = mesh.edge_vertices(e).map(|v| mesh.position(v));
        a.distance(b)
    };
    mesh.edges().map(length).fold(0.0, f64::max)
}

#[test]
fn until_edge_length_stops_at_the_first_level_with_short_edges() {
    let step = Step {
        until: Some(Until::EdgeLength {
            below: PositiveLength::literal(0.2),
        }),
        ..Step::new(LOOP)
    };
    let (mesh, report) = apply(&step, &shapes::icosahedron()).unwrap();
    assert!(longest(&mesh) < 0.2);
    let coarser = Step {
        levels: Some(Levels::literal(2)),
        ..Step::new(LOOP)
    };
    let (coarser, _) = apply(&coarser, &shapes::icosahedron()).unwrap();
    assert!(longest(&coarser) >= 0.2);
    assert_eq!(mesh.n_faces(), 4 * coarser.n_faces());
    assert!(
        report.notes[0].starts_with("3 levels; "),
        "{:?}",
        report.notes
    );
}

#[test]
fn until_limit_distance_stops_at_the_first_level_near_the_limit() {
    let step = Step {
        until: Some(Until::LimitDistance {
            below: PositiveLength::literal(0.01),
        }),
        ..Step::new(LOOP)
    };
    let (mesh, _) = apply(&step, &shapes::icosahedron()).unwrap();
    let goal = limit(&mesh, LOOP, &NoProgress).unwrap().positions;
    let far = |(p, q): (&DVec3, &DVec3)| p.distance(*q);
    assert!(
        mesh.positions()
            .iter()
            .zip(&goal)
            .map(far)
            .all(|d| d < 0.01)
    );
    assert_eq!(mesh.n_faces(), 20 << 6);
}

#[test]
fn a_condition_that_is_not_met_is_an_error_with_the_value_reached() {
    for levels in [0, 2] {
        let step = Step {
            levels: Some(Levels::literal(levels)),
            until: Some(Until::EdgeLength {
                below: PositiveLength::literal(0.01),
            }),
            ..Step::new(LOOP)
        };
        let error = apply(&step, &shapes::icosahedron())
            .unwrap_err()
            .to_string();
        let start = format!("after subdivision level {levels}, the longest edge is ");
        assert!(error.contains(&start), "{error}");
        assert!(
            error.ends_with("expected less than 0.01; raise `below` or `levels`"),
            "{error}"
        );
    }
}

#[test]
fn to_limit_sets_positions_normals_and_tangents() {
    let step = Step {
        levels: Some(Levels::literal(0)),
        to_limit: true,
        ..Step::new(LOOP)
    };
    let mesh = shapes::icosahedron();
    let (mesh, goal) = (
        apply(&step, &mesh).unwrap().0,
        limit(&mesh, LOOP, &NoProgress).unwrap(),
    );
    assert_eq!(mesh.positions(), goal.positions);
    assert_eq!(mesh.get(VERTEX_NORMAL).unwrap(), goal.normals());
    for (t, n) in mesh.get(TANGENT).unwrap().iter().zip(goal.normals()) {
        assert!((t.length() - 1.0).abs() < 1e-14 && t.dot(n).abs() < 1e-14);
    }
}

#[test]
fn invalid_parameters_are_reported_by_the_plan_and_by_the_step() {
    let faces = FaceSelection::All;
    let new = |rules| Step::new(rules);
    let cases = [
        (
            Step {
                until: Some(Until::LimitDistance {
                    below: PositiveLength::literal(1.0),
                }),
                ..new(Rules::of(Scheme::Butterfly))
            },
            "[\"until\"] the limit surface is not available for Butterfly subdivision",
        ),
        (
            Step {
                faces: Some(&faces),
                to_limit: true,
                ..new(LOOP)
            },
            "[\"faces\"] `faces` cannot be combined with `until` or `to_limit`, which need the whole mesh",
        ),
    ];
    for (step, message) in cases {
        assert_eq!(problems(&step, &shapes::icosahedron())[0], message);
        let error = apply(&step, &shapes::icosahedron()).unwrap_err();
        assert!(matches!(error, OpError::Parameter(_)), "{error}");
    }
}

#[test]
fn distorted_seams_and_lost_values_are_reported() {
    let mut mesh = shapes::octahedron();
    mesh.set(UV, (0..24).map(|i| DVec2::splat(f64::from(i))).collect());
    mesh.set(CREASE, vec![1.0; 12]);
    let notes = |scheme| apply(&Step::new(Rules::of(scheme)), &mesh).unwrap().1.notes;
    assert_eq!(notes(Scheme::Sqrt3).len(), 2);
    assert_eq!(
        notes(Scheme::DooSabin),
        [
            "12 seam edges: new faces across them mix corner values of both sides, which distorts textures"
        ]
    );
    assert_eq!(notes(Scheme::CatmullClark), Vec::<String>::new());
}

#[test]
fn planned_counts_are_exact_for_every_scheme_on_every_fixture() {
    let files = Files::default();
    let cx = PlanContext::new(&files);
    for (name, mut mesh) in fixtures() {
        mesh.set(UV, vec![DVec2::X; mesh.n_half_edges()]);
        mesh.set(CREASE, vec![1.5; mesh.n_edges()]);
        for scheme in SCHEMES {
            for levels in 0..3 {
                let step = Step {
                    levels: Some(Levels::literal(levels)),
                    ..Step::new(Rules::of(scheme))
                };
                let mut plan = MeshPlan::of(&mesh);
                assert_eq!(step.plan("Test", &mut plan, &cx), [], "{name} {scheme:?}");
                let mut new: Mesh = mesh.clone();
                let mut cx = Context::new(&NoProgress, &files);
                step.apply(&mut new, &mut cx).unwrap();
                if new.n_faces() == 0 {
                    plan.degrees = MeshPlan::of(&new).degrees;
                }
                let exactly = MeshPlan::of(&new);
                if scheme == Scheme::DooSabin && levels > 0 {
                    // Doo-Sabin subdivision replaces only some of the vertices with faces. The plan does not know the
                    // number of these vertices.
                    for (planned, exactly) in [
                        (&mut plan.vertices, exactly.vertices),
                        (&mut plan.edges, exactly.edges),
                        (&mut plan.faces, exactly.faces),
                        (&mut plan.degrees, exactly.degrees),
                    ] {
                        assert!(planned.min <= exactly.min && exactly.max <= planned.max);
                        *planned = exactly;
                    }
                }
                assert_eq!(plan, exactly, "{name} {scheme:?} {levels}");
                assert_eq!(new.defects(), [], "{name} {scheme:?} {levels}");
            }
        }
    }
}

#[test]
fn the_memory_budget_is_checked_at_every_level_until_a_condition_is_met() {
    // The sheet has a boundary, and Sqrt3 subdivision cuts boundary edges only at even levels.
    let mesh = sheet();
    let files = Files::default();
    for scheme in SCHEMES {
        let finer = subdivide(&mesh, Rules::of(scheme), 2, &NoProgress).unwrap();
        let bytes = finer.bytes() as u64;
        let message = |budget| {
            let step = Step {
                levels: Some(Levels::literal(2)),
                until: Some(Until::EdgeLength {
                    below: PositiveLength::literal(1e-9),
                }),
                ..Step::new(Rules::of(scheme))
            };
            let mut cx = Context::new(&NoProgress, &files);
            cx.budget = budget;
            step.apply(&mut mesh.clone(), &mut cx)
                .unwrap_err()
                .to_string()
        };
        let met = message(bytes);
        assert!(
            met.contains("after subdivision level 2, "),
            "{scheme:?} {met}"
        );
        let short = message(bytes - 1);
        assert!(
            short.contains("after subdivision level 1, "),
            "{scheme:?} {short}"
        );
        assert!(short.contains("level 2 would have "), "{scheme:?} {short}");
    }
}
