//! Checks how the time of operations and expectations grows with the mesh. On a mesh with twice as many faces, an
//! operation must take at most 2.3 times as long.
//!
//! These tests measure times, because no count shows how much work was done. For example, the number of progress
//! reports does not depend on the size of the mesh, and a quadratic search allocates no memory. The tests run only on
//! request, and take about ten minutes:
//!
//! ```text
//! MALLOC_ARENA_MAX=1 MALLOC_MMAP_MAX_=0 MALLOC_TRIM_THRESHOLD_=100000000000 \
//!     cargo test --release -p meshwright-tests --test laws growth -- --ignored --nocapture --test-threads 1
//! ```
//!
//! The environment variables tell the allocator of Linux to keep memory. Without them, the time jumps when the meshes
//! become so large that the system provides new memory for each run.
//!
//! Each measured time is the median of the processor times of several runs on one thread, so that other programs hardly
//! affect it. Each test compares the times on two meshes. The second mesh is four times as large as the first (doubled
//! twice). If the time grows too much, the same two meshes are measured again. If it still grows too much, the test
//! compares two larger meshes, because the time jumps once when the data no longer fit in a cache.

use std::collections::BTreeMap;
use std::time::Duration;

use engine::{Engine, Options, Run, Silent, Source};
use geometry::shapes;
use glam::DVec3;
use mesh::{Mesh, VertexId};
use op::NoProgress;
use rayon::ThreadPoolBuilder;
use rustix::time::{ClockId, clock_gettime};
use scene::{Geometry, Object, Scene};

use crate::assert_none;
use crate::every_op::Case;
use crate::extremes::MEASURES;
use crate::fixtures::with_attributes;
use crate::samples::samples;

/// The largest allowed growth of the time if a mesh becomes four times as large: a factor of 2.3 for each of two
/// doublings.
const MAX_GROWTH: f64 = 2.3 * 2.3;

/// The minimum time of a measurement. Meshes are enlarged until the work takes this long.
const LONG_ENOUGH: Duration = Duration::from_millis(4);

/// The maximum time of the work on the first mesh that is measured. If the work takes longer, the test fails.
const TOO_LONG: Duration = Duration::from_secs(20);

/// Two numbers of faces. The first measured mesh has the first number of faces. It is enlarged to at most the second
/// number of faces.
const SIZES: [usize; 2] = [1000, 64_000];

/// Operations that are not tested, because their samples fit no generated scene, or because their work does not grow
/// with the mesh.
const OTHER: &str = "Load Polygons MoveControlPoint MovePatchPoint CurveLevels SampleCurve CurveFigure HalfEdgeFigure";

/// Steps whose time is allowed to grow faster than `MAX_GROWTH`, each with its maximum growth. The comment above a step
/// gives the reason.
const STEEPER: &[(&str, f64)] = &[
    // The collapses merge all vertices of a row into one vertex, whose valence is the length of a row. So the time for
    // n faces is proportional to n^1.5.
    ("CollapseEdges(", 8.5),
    // After the flips, all edges of a row of faces end at one vertex. So this time is also proportional to n^1.5.
    ("FlipEdges(edges: All, on_refusal", 8.5),
    // The factorization of the sparse matrix of a surface takes a time proportional to n^1.5. Source: Lipton, Rose,
    // Tarjan, "Generalized Nested Dissection", 1979.
    ("Measure(of: Geodesic", 8.5),
    ("Smooth(by: Implicit", 8.5),
    // The time to fill a hole of at most 500 edges is cubic in the number of edges. The boundary of a grid with n faces
    // has a length proportional to n^0.5, so this time is proportional to n^1.5. Only the largest grids have boundaries
    // of more than 500 edges.
    ("FillHoles(", 8.5),
];

/// Steps whose selections examine a larger part of the mesh than the neighborhoods of single elements.
const SELECTIONS: &[&str] = &[
    "TagVertices(name: \"new\", vertices: Grow(Grow(Random(count: 1000, seed: 1))))",
    "TagVertices(name: \"new\", vertices: Nearest(to: (0, 0, 0), count: 1000))",
    "TagEdges(name: \"new\", edges: EdgeLoop(All))",
    "TagEdges(name: \"new\", edges: EdgeRing(All))",
    "TagEdges(name: \"new\", edges: Longest(count: 1000))",
    "TagFaces(name: \"new\", faces: Expand(to_angle: 180, of: Faces([0])))",
    "TagFaces(name: \"new\", faces: Component(All))",
];

/// The name of a scene whose mesh has two faces with many corners.
const LARGE_FACES: &str = "a cylinder with caps of many corners";

/// Creates a mesh of about the given number of faces.
type Shape = fn(usize) -> Mesh;

/// Meshes on which expectations are tested.
const SHAPES: [(&str, Shape); 2] = [
    ("a torus of triangles", |n| {
        shapes::fans(&shapes::torus(2 * side(n), side(n) / 2, 2.0, 1.0))
    }),
    (LARGE_FACES, |n| {
        shapes::cylinder(u32::try_from(n).expect("ids have 32 bits"), true)
    }),
];

/// Creates scenes with about `n` faces. The meshes have the same names as in the module `fixtures`, because the samples
/// of the operations refer to these names.
fn scenes(n: usize) -> Vec<(&'static str, Scene)> {
    let side = side(n);
    let around = u32::try_from(n).expect("ids have 32 bits");
    let of = |object: Object| {
        let mut scene = Scene::new();
        scene.insert(object).expect("the first object");
        scene
    };
    let torus = shapes::torus(2 * side, side / 2, 2.0, 1.0);
    let mut two = of(Object::mesh("mesh", torus.clone()));
    let mut other = with_attributes(shapes::fans(&shapes::grid(side, side)));
    "other".clone_into(&mut other.name);
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
        (
            LARGE_FACES,
            of(with_attributes(shapes::cylinder(around, true))),
        ),
        ("two meshes", two),
        ("polylines", of(Object::new("lines", lines(n)))),
    ]
}

/// Returns the number of rows of a square mesh of at least `n` faces. The number of rows is at least 6, so that a torus
/// with half as many rows is possible.
fn side(n: usize) -> u32 {
    let is_enough = |side: &u32| side.pow(2) as usize >= n;
    (6..u32::MAX).find(is_enough).expect("ids have 32 bits")
}

/// Returns one mesh of `n` cubes side by side.
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
    /// The factor by which the time grows when the size of the mesh is doubled twice.
    By(f64),
    /// The work takes longer than [`TOO_LONG`].
    TooLong,
}

/// Measures how the time of `work` grows with the size of the scene. `work` processes a scene, and returns whether it
/// succeeded. `scene` creates a scene of the given size.
fn growth(scene: impl Fn(usize) -> Scene, work: impl Fn(Scene) -> bool) -> Growth {
    let time = |scene: &Scene| {
        let scene = scene.clone();
        let start = processor_time();
        let succeeded = work(scene);
        (processor_time().saturating_sub(start), succeeded)
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
        // Even on the largest mesh, the work takes almost no time. So the time hardly depends on the size of the mesh.
        return Growth::By(1.0);
    }
    let growth = |small: &Scene, large: &Scene| {
        let mut least = f64::INFINITY;
        for repetitions in [3, 5, 9] {
            let times = [small, large].map(|scene| median(scene, repetitions));
            least = least.min(times[1].as_secs_f64() / times[0].as_secs_f64());
            if least <= MAX_GROWTH {
                break;
            }
        }
        least
    };
    let large = scene(4 * n);
    let first = growth(&small, &large);
    if first <= MAX_GROWTH {
        return Growth::By(first);
    }
    // The time can jump once, when the data no longer fit in a cache, or when memory is no longer reused. If the
    // algorithm itself is too slow, the time also grows too much between two larger meshes.
    Growth::By(first.min(growth(&large, &scene(16 * n))))
}

/// The text of a recipe with the given number of parts.
type RecipeText = fn(usize) -> String;

/// Recipes that are read and checked.
const RECIPES: [(&str, RecipeText); 8] = [
    ("unnamed shapes", |n| steps(&"Cube(),".repeat(n))),
    ("named shapes", |n| {
        steps(&parts(n, |i| format!("Cube(name: \"{i}\"),")))
    }),
    ("outputs", |n| {
        steps(&("Cube(),".to_owned() + &parts(n, |i| format!("Save(path: \"{i}.obj\"),"))))
    }),
    ("ids", |n| {
        steps(&("Cube(),".to_owned() + &parts(n, |i| format!("(id: \"{i}\", run: Triangulate),"))))
    }),
    ("unused parameters", |n| {
        let params = parts(n, |i| format!("\"p{i}\": Int(default: 1),"));
        format!("(recipe: 1, params: {{{params}}}, steps: [Cube()])")
    }),
    ("parameters", |n| {
        let params = parts(n, |i| format!("\"p{i}\": Float(default: 1),"));
        let steps = parts(n, |i| format!("Cube(size: arg(\"p{i}\")),"));
        format!("(recipe: 1, params: {{{params}}}, steps: [{steps}])")
    }),
    ("wrong steps", |n| steps(&"Cub(),".repeat(n))),
    ("expectations", |n| {
        let expectations = "Faces(eq: 6),".repeat(n);
        format!("(recipe: 1, steps: [Cube()], expect: [{expectations}])")
    }),
];

fn parts(n: usize, part: impl Fn(usize) -> String) -> String {
    (0..n).map(part).collect()
}

fn steps(steps: &str) -> String {
    format!("(recipe: 1, steps: [{steps}])")
}

/// Reads and checks a recipe three times, and returns the shortest duration.
fn time_to_check(text: &str) -> Duration {
    let registry = ops_all::registry();
    let engine = Engine::new(&registry);
    let times = (0..3).map(|_| {
        let start = processor_time();
        engine.load(&Source::new("a.ron", text), &Options::default());
        processor_time().saturating_sub(start)
    });
    times.min().expect("three times")
}

/// The test would notice a quadratic search among 8000 parts, because the search would take most of the time. A recipe
/// with four times as many parts may take up to 8 times as long, so that the test also passes on a busy machine.
#[test]
fn reading_and_checking_a_recipe_is_not_quadratic() {
    let failures = on_one_thread(|| {
        let growth = |text: fn(usize) -> String, n| {
            let [small, large] = [n, 4 * n].map(|n| time_to_check(&text(n)));
            large.as_secs_f64() / small.as_secs_f64()
        };
        RECIPES
            .iter()
            .filter_map(|(what, text)| {
                // If the growth is too large, it is measured again with a larger number of parts.
                let least = growth(*text, 2000);
                let least = if least > 8.0 {
                    least.min(growth(*text, 4000))
                } else {
                    least
                };
                (least > 8.0).then(|| {
                    format!("{what}: takes {least:.2} times as long for four times as many parts")
                })
            })
            .collect()
    });
    assert_none(&failures);
}

/// Returns the processor time of this thread.
pub(crate) fn processor_time() -> Duration {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    let seconds = time.tv_sec.unsigned_abs();
    Duration::from_secs(seconds) + Duration::from_nanos(time.tv_nsec.unsigned_abs())
}

/// Runs `measure` on one thread.
fn on_one_thread(measure: impl FnOnce() -> Vec<String> + Send) -> Vec<String> {
    let pool = ThreadPoolBuilder::new().num_threads(1).build();
    pool.expect("a thread can be started").install(measure)
}

#[test]
#[ignore = "measures times for about ten minutes"]
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
                            failures.push(format!(
                                "{name}: takes {factor:.2} times as long for a mesh four times as large"
                            ));
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

/// Measures the distance between two surfaces of long, thin triangles that are not parallel to an axis.
#[test]
#[ignore = "measures times for a few seconds"]
fn distances_of_thin_triangles_take_at_most_two_point_three_times_as_long_on_twice_the_mesh() {
    let failures = on_one_thread(|| {
        let scene = |n: usize| {
            let around = u32::try_from(n / 2).expect("ids have 32 bits");
            let mut tilted = shapes::fans(&shapes::cylinder(around, false));
            for p in tilted.positions_mut() {
                *p = DVec3::new(0.6 * p.x - 0.8 * p.z, p.y, 0.8 * p.x + 0.6 * p.z);
            }
            let mut other = tilted.clone();
            other
                .positions_mut()
                .iter_mut()
                .for_each(|p| *p += DVec3::new(0.003, 0.002, 0.005));
            let mut scene = Scene::new();
            for (name, mesh) in [("a", tilted), ("b", other)] {
                scene.insert(Object::mesh(name, mesh)).expect("two names");
            }
            scene
        };
        let work = |scene: Scene| {
            let mesh = |i: usize| scene.objects()[i].as_mesh().expect("a mesh");
            geometry::distance::Distance::between(mesh(0), mesh(1), None).is_some()
        };
        let failure = match growth(scene, work) {
            Growth::Refused => Some("was not measured".to_owned()),
            Growth::TooLong => Some("takes too long".to_owned()),
            Growth::By(factor) => (factor > MAX_GROWTH)
                .then(|| format!("takes {factor:.2} times as long for a mesh four times as large")),
        };
        Vec::from_iter(failure)
    });
    assert_none(&failures);
}

#[test]
#[ignore = "measures times for about ten minutes"]
fn expectations_take_at_most_two_point_three_times_as_long_on_twice_the_mesh() {
    let failures = on_one_thread(|| {
        let registry = ops_all::registry();
        let engine = Engine::new(&registry);
        let mut failures = Vec::new();
        for that in MEASURES {
            let text = format!("(recipe: 1, steps: [], expect: [(on: [\"b\"], that: {that})])");
            let recipe = engine.load(&Source::new("a.ron", text), &Options::default());
            assert!(recipe.is_read, "{that}: {:?}", recipe.diagnostics);
            // Every run computes the digest of the scene, which takes a time proportional to the size of the mesh.
            let work = |scene| {
                let outcome = recipe.run_from(0, scene, Run::default(), &Silent);
                outcome.checked > 0 || !outcome.failures.is_empty()
            };
            for (fixture, shape) in SHAPES {
                let scene = |n: usize| {
                    let mesh = shape(n);
                    let mut other = mesh.clone();
                    other.positions_mut().iter_mut().for_each(|p| p.z += 1e-3);
                    let mut scene = Scene::new();
                    for (name, mesh) in [("a", mesh), ("b", other)] {
                        scene.insert(Object::mesh(name, mesh)).expect("two names");
                    }
                    scene
                };
                match growth(scene, work) {
                    Growth::Refused => failures.push(format!("{that}: was not checked")),
                    Growth::TooLong => {
                        failures.push(format!("{that} on {fixture}: takes too long"));
                    }
                    Growth::By(factor) => {
                        println!("{factor:6.2} {that} on {fixture}");
                        if factor > MAX_GROWTH {
                            failures.push(format!(
                                "{that} on {fixture}: takes {factor:.2} times as long for a mesh four times as large"
                            ));
                        }
                    }
                }
            }
        }
        failures
    });
    assert_none(&failures);
}
