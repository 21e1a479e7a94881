//! How the time of operations and expectations grows: doubling the mesh must not take more than 2.3 times as long.
//!
//! Nothing that a test could count stands for this work: progress is reported in parts of equal number for any size,
//! and a quadratic search allocates nothing. So these tests measure, and run only on request, on a machine that does
//! nothing else (about five minutes):
//!
//! ```text
//! cargo test --release -p meshwright-tests --test laws growth -- --ignored --nocapture
//! ```
//!
//! Each time is the median of several runs on one thread. Times are compared over two doublings, which evens out the
//! steps at which the data no longer fits into a cache. A growth that is too large is measured again before it counts.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use engine::{Engine, Options, Run, Silent, Source};
use geometry::shapes;
use glam::DVec3;
use mesh::{Mesh, VertexId};
use op::NoProgress;
use rayon::ThreadPoolBuilder;
use scene::{Geometry, Object, Scene};

use crate::assert_none;
use crate::every_op::Case;
use crate::extremes::MEASURES;
use crate::fixtures::with_attributes;
use crate::samples::samples;

/// The largest growth of the time when the mesh is doubled twice: 2.3 squared.
const MAX_GROWTH: f64 = 2.3 * 2.3;

/// The shortest time that is measured. Meshes are enlarged until the work takes this long.
const LONG_ENOUGH: Duration = Duration::from_millis(4);

/// A run of the smallest mesh that takes longer is a failure.
const TOO_LONG: Duration = Duration::from_secs(20);

/// The number of faces of the first mesh, and of the largest mesh before two doublings.
const SIZES: [usize; 2] = [1000, 64_000];

/// Operations with a sample that no generated scene fits, or that measure nothing that grows with a mesh.
const OTHER: &str =
    "Load Polygons MoveControlPoint CurveLevels SampleCurve CurveFigure HalfEdgeFigure";

/// Steps that take longer, with the largest growth of their time and the reason.
const STEEPER: &[(&str, f64)] = &[
    // All vertices of a row become one, whose valence is the length of a row: n^1.5.
    ("CollapseEdges(edges: All", 8.5),
    // Holes of up to 500 edges are filled in cubic time, which the boundary of the largest grids exceeds.
    ("FillHoles(", 8.5),
];

/// Selections that visit more than their neighborhood.
const SELECTIONS: &[&str] = &[
    "TagVertices(name: \"new\", vertices: Grow(Grow(Random(count: 1000, seed: 1))))",
    "TagVertices(name: \"new\", vertices: Nearest(to: (0, 0, 0), count: 1000))",
    "TagEdges(name: \"new\", edges: EdgeLoop(All))",
    "TagEdges(name: \"new\", edges: EdgeRing(All))",
    "TagEdges(name: \"new\", edges: Longest(count: 1000))",
    "TagFaces(name: \"new\", faces: Expand(to_angle: 180, of: Faces([0])))",
    "TagFaces(name: \"new\", faces: Component(All))",
];

/// Creates scenes of about this many faces. The meshes have the names of the fixtures of all operations.
fn scenes(n: usize) -> Vec<(&'static str, Scene)> {
    let side = side(n);
    let of = |object: Object| {
        let mut scene = Scene::new();
        scene.insert(object).expect("the first object");
        scene
    };
    let torus = shapes::torus(2 * side, side / 2, 2.0, 1.0);
    let mut two = of(Object::mesh("mesh", torus.clone()));
    let other = Object::mesh("other", shapes::fans(&shapes::grid(side, side)));
    two.insert(other).expect("another name");
    vec![
        ("a torus of quads", of(Object::mesh("mesh", torus.clone()))),
        (
            "a torus of triangles",
            of(Object::mesh("mesh", shapes::fans(&torus))),
        ),
        (
            "a grid of quads",
            of(with_attributes(shapes::grid(side, side))),
        ),
        (
            "a grid of triangles",
            of(with_attributes(shapes::fans(&shapes::grid(side, side)))),
        ),
        ("cubes", of(Object::mesh("mesh", cubes(n / 6)))),
        ("two meshes", two),
        ("polylines", of(Object::new("lines", lines(n)))),
    ]
}

/// The number of rows of a square mesh of at least `n` faces; at least 6, so that half as many rows make a torus.
fn side(n: usize) -> u32 {
    let is_enough = |side: &u32| side.pow(2) as usize >= n;
    (6..u32::MAX).find(is_enough).expect("ids have 32 bits")
}

/// Returns `n` cubes beside each other, as one mesh.
fn cubes(n: usize) -> Mesh {
    let cube = shapes::cube();
    let number = |v: VertexId| u32::try_from(v.index()).expect("ids have 32 bits");
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    for i in 0..n {
        let first = u32::try_from(positions.len()).expect("ids have 32 bits");
        let place = DVec3::new(
            (i % 100) as f64,
            (i / 100 % 100) as f64,
            (i / 10_000) as f64,
        );
        positions.extend(cube.positions().iter().map(|&p| p + 3.0 * place));
        faces.extend(
            cube.faces().map(|f| -> Vec<u32> {
                cube.face_vertices(f).map(|v| first + number(v)).collect()
            }),
        );
    }
    let (mesh, _) = Mesh::from_polygons(positions, &faces).expect("the cubes are valid");
    mesh
}

fn lines(n: usize) -> Geometry {
    let line = |i: usize| {
        (0..10)
            .map(|k| DVec3::new(i as f64, f64::from(k), 0.0))
            .collect()
    };
    Geometry::Polylines((0..n / 10).map(line).collect())
}

/// The result of comparing times.
enum Growth {
    /// The work is refused or fails.
    Refused,
    /// The factor of the time when the mesh is doubled twice.
    By(f64),
    /// The work takes longer than [`TOO_LONG`].
    TooLong,
}

/// Measures the growth of `work`, which gets a scene and returns whether it succeeded. `scene` creates a scene of the
/// given size.
fn growth(scene: impl Fn(usize) -> Scene, work: impl Fn(Scene) -> bool) -> Growth {
    let time = |scene: &Scene| {
        let scene = scene.clone();
        let start = Instant::now();
        let succeeded = work(scene);
        (start.elapsed(), succeeded)
    };
    let median = |scene: &Scene, n: usize| {
        let mut times: Vec<Duration> = (0..n).map(|_| time(scene).0).collect();
        times.sort();
        times[n / 2]
    };
    let [mut n, most] = SIZES;
    let mut small = scene(n);
    let (mut first, succeeded) = time(&small);
    if !succeeded {
        return Growth::Refused;
    }
    while first < LONG_ENOUGH && n < most {
        n *= 2;
        small = scene(n);
        first = time(&small).0;
    }
    if first > TOO_LONG {
        return Growth::TooLong;
    }
    if first < LONG_ENOUGH {
        // The time hardly depends on the mesh.
        return Growth::By(1.0);
    }
    let large = scene(4 * n);
    let mut least = f64::INFINITY;
    for repetitions in [3, 5, 9] {
        let times = [&small, &large].map(|scene| median(scene, repetitions));
        least = least.min(times[1].as_secs_f64() / times[0].as_secs_f64());
        if least <= MAX_GROWTH {
            break;
        }
    }
    Growth::By(least)
}

/// Runs `measure` on one thread.
fn on_one_thread(measure: impl FnOnce() -> Vec<String> + Send) -> Vec<String> {
    let pool = ThreadPoolBuilder::new().num_threads(1).build();
    pool.expect("a thread can be started").install(measure)
}

#[test]
#[ignore = "measures times, which needs a machine that does nothing else"]
fn operations_take_at_most_two_point_three_times_as_long_on_twice_the_mesh() {
    let failures = on_one_thread(|| {
        let registry = ops_all::registry();
        let folder = tempfile::tempdir().expect("a temporary folder");
        let mut steps = samples(&registry);
        for step in SELECTIONS {
            let (name, _) = step.split_once('(').expect("a step has parameters");
            steps.push((registry.get(name).expect(step), &step[name.len()..]));
        }
        let mut failures = Vec::new();
        let mut fits: BTreeMap<&str, bool> = BTreeMap::new();
        for (entry, sample) in steps {
            for (i, (fixture, _)) in scenes(16).into_iter().enumerate() {
                let case = Case::new(entry, sample, fixture, &Scene::new());
                let scene = |n: usize| scenes(n).swap_remove(i).1;
                let work = |scene| case.run_on(scene, folder.path(), &NoProgress).1.is_ok();
                let fit = fits.entry(entry.name).or_default();
                let name = &case.name;
                match growth(scene, work) {
                    Growth::Refused => continue,
                    Growth::TooLong => failures.push(format!("{name}: takes too long")),
                    Growth::By(factor) => {
                        println!("{factor:6.2} {name}");
                        let mut steeper = STEEPER.iter().filter(|(step, _)| name.starts_with(step));
                        if factor > steeper.next().map_or(MAX_GROWTH, |&(_, most)| most) {
                            failures.push(format!("{name}: {factor:.2} for four times the mesh"));
                        }
                    }
                }
                *fit = true;
            }
        }
        let untested = fits
            .iter()
            .filter(|(name, fit)| !**fit && !OTHER.contains(**name));
        failures.extend(untested.map(|(name, _)| format!("{name}: no scene fits its samples")));
        failures
    });
    assert_none(&failures);
}

#[test]
#[ignore = "measures times, which needs a machine that does nothing else"]
fn expectations_take_at_most_two_point_three_times_as_long_on_twice_the_mesh() {
    let failures = on_one_thread(|| {
        let registry = ops_all::registry();
        let engine = Engine::new(&registry);
        let mut failures = Vec::new();
        for that in MEASURES {
            let text = format!("(recipe: 1, steps: [], expect: [(on: [\"b\"], that: {that})])");
            let recipe = engine.load(&Source::new("a.ron", text), &Options::default());
            assert!(recipe.is_read, "{that}: {:?}", recipe.diagnostics);
            let scene = |n: usize| {
                let side = side(n);
                let torus = shapes::fans(&shapes::torus(2 * side, side / 2, 2.0, 1.0));
                let mut other = torus.clone();
                other.positions_mut().iter_mut().for_each(|p| p.z += 1e-3);
                let mut scene = Scene::new();
                for (name, mesh) in [("a", torus), ("b", other)] {
                    scene.insert(Object::mesh(name, mesh)).expect("two names");
                }
                scene
            };
            // The digest of the scene, which every run computes, takes a time in proportion to the mesh.
            let work = |scene| {
                let outcome = recipe.run_from(0, scene, Run::default(), &Silent);
                outcome.checked > 0 || !outcome.failures.is_empty()
            };
            match growth(scene, work) {
                Growth::Refused => failures.push(format!("{that}: was not checked")),
                Growth::TooLong => failures.push(format!("{that}: takes too long")),
                Growth::By(factor) => {
                    println!("{factor:6.2} {that}");
                    if factor > MAX_GROWTH {
                        failures.push(format!("{that}: {factor:.2} for four times the mesh"));
                    }
                }
            }
        }
        failures
    });
    assert_none(&failures);
}
