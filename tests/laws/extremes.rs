//! Tests every operation with numbers near the limits of floating point.

use std::panic::{AssertUnwindSafe, catch_unwind};

use glam::DVec3;
use op::{Entry, NoProgress, Plan, PlanContext, PlannedGeometry};
use ron_tree::{Lexer, TokenKind};
use scene::{Object, Scene};

use crate::every_op::{Case, defects, exact_plan, files};
use crate::samples::samples;
use crate::{assert_none, fixtures};

/// Extreme numbers: zero, a negative number, numbers at the limits of integers, and numbers that overflow, underflow or
/// lose precision when they are added, multiplied or squared.
const NUMBERS: &[&str] = &[
    "0",
    "-1",
    "5e-324",
    "1e-308",
    "1e-160",
    "1e-17",
    "1e15",
    "1e160",
    "-1e160",
    "1e308",
    "-1e308",
    "1.7976931348623157e308",
    "4294967294",
    "4294967295",
    "9223372036854775807",
];

/// The memory budget in bytes. To keep meshes small, a case is skipped if its plan predicts meshes that exceed this
/// budget.
const BUDGET: u64 = 1 << 20;

/// `parameters` is a sample of the parameters of an operation. Returns this sample, and variants of it. In each
/// variant, an extreme number replaces one number or all numbers. Variants that cannot be read as parameters of the
/// operation are left out.
fn extreme_variants(parameters: &str, can_be_read: impl Fn(&str) -> bool) -> Vec<String> {
    let tokens: Vec<_> = Lexer::new(parameters).collect();
    let with = |chosen: &[usize], number: &str| -> String {
        let texts = tokens.iter().enumerate().map(|(i, token)| {
            if chosen.contains(&i) {
                number
            } else {
                token.span.of(parameters)
            }
        });
        texts.collect()
    };
    let mut texts = vec![parameters.to_owned()];
    for number in NUMBERS {
        let mut places: Vec<usize> = (0..tokens.len()).collect();
        places.retain(|&i| tokens[i].kind == TokenKind::Number && can_be_read(&with(&[i], number)));
        texts.extend(places.iter().map(|&i| with(&[i], number)));
        texts.push(with(&places, number));
    }
    texts.sort();
    texts.dedup();
    texts.retain(|text| can_be_read(text));
    texts
}

/// Returns five scenes. One has an object of each kind, and one has a cube of triangles. Three have a very large or
/// very small copy of this cube.
fn scenes() -> Vec<(&'static str, Scene)> {
    let find = |wanted: &str| {
        let mut all = fixtures::scenes().into_iter();
        all.find(|(name, _)| *name == wanted).expect("a fixture")
    };
    let mut scenes = vec![find("everything"), find("cube of triangles")];
    let (_, cube) = scenes[1].clone();
    for (name, factor) in [("huge", 1.7e308), ("large", 1e155), ("tiny", 1e-320)] {
        let mut scene = Scene::new();
        for object in cube.objects() {
            let mut mesh = object.as_mesh().expect("a mesh").as_ref().clone();
            for p in mesh.positions_mut() {
                *p *= DVec3::splat(factor);
            }
            scene
                .insert(Object::mesh(&object.name, mesh))
                .expect("a new name");
        }
        scenes.push((name, scene));
    }
    scenes
}

/// Describes the failures of a step on a scene.
fn failures(entry: &Entry, sample: &str, fixture: &str, scene: &Scene) -> Vec<String> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let files = files(folder.path());
    let case = Case::new(entry, sample, fixture, scene);
    let ran = catch_unwind(AssertUnwindSafe(|| {
        let cx = PlanContext {
            files: &files,
            on: None,
            budget: BUDGET,
        };
        let mut plan = exact_plan(scene);
        let problems = case.step.plan(&mut plan, &cx);
        if problems.iter().any(|p| !p.is_warning) || bytes(&plan) > BUDGET {
            return Vec::new();
        }
        let (scene, result) = case.run(folder.path(), &NoProgress);
        match result {
            Ok(_) => scene.objects().iter().flat_map(defects).collect(),
            Err(_) => Vec::new(),
        }
    }));
    let found = ran.unwrap_or_else(|_| vec!["panicked".to_owned()]);
    found
        .into_iter()
        .map(|failure| format!("{}: {failure}", case.name))
        .collect()
}

/// Returns the maximum number of bytes that a plan predicts for its meshes.
fn bytes(plan: &Plan) -> u64 {
    let objects = plan.objects().iter().map(|object| match &object.geometry {
        PlannedGeometry::Mesh(mesh) => mesh.bytes().max,
        _ => 0,
    });
    objects.fold(0, u64::saturating_add)
}

#[test]
fn extreme_numbers_give_valid_results_or_errors() {
    let scenes = scenes();
    let registry = ops_all::registry();
    let mut failed = Vec::new();
    for (entry, sample) in samples(&registry) {
        let can_be_read = |text: &str| entry.deserialize(&ron_tree::parse(text).value).is_ok();
        // Each variant is tested on two scenes: the first scene and one other scene. The variants use the other scenes
        // in turn.
        let others = scenes[1..].iter().cycle();
        for (text, other) in extreme_variants(sample, can_be_read).iter().zip(others) {
            for (name, scene) in [&scenes[0], other] {
                failed.extend(failures(entry, text, name, scene));
            }
        }
    }
    assert_none(&failed);
}

/// Expectations that measure meshes.
pub(crate) const MEASURES: &[&str] = &[
    "Area(eq: 1, min: 2, max: 3, tolerance: 4)",
    "Volume(eq: 1, min: 2, max: 3, tolerance: 4)",
    "Bounds(min: (1, 2, 3), max: (4, 5, 6), tolerance: 7)",
    "Genus(eq: 1, min: 2, max: 3)",
    "EulerCharacteristic(eq: 1, min: 2, max: 3)",
    "Components(eq: 1, min: 2, max: 3)",
    "BoundaryLoops(eq: 1, min: 2, max: 3)",
    "Manifold",
    "Closed",
    "Valence(min: 1, max: 2)",
    "DihedralAngle(min: 1, max: 2, reaches: 3)",
    "EdgeLength(of: Longer(than: 1), min: 2, max: 3)",
    "MinAngle(min: 1, max: 2)",
    "MeanFaceArea(of: Degree(4), min: 1, max: 2)",
    "Position(of: Nearest(to: (1, 2, 3)), is: (4, 5, 6), tolerance: 7)",
    r#"Same(as: Object("a"), tolerance: 1)"#,
    r#"DistanceTo(other: Object("a"), below: 1)"#,
    "SymmetricUnder(group: CubeMotions, eq: 1, min: 2, max: 3, tolerance: 4)",
    "Count(of: Faces(Boundary), eq: 1, min: 2, max: 3)",
    "Count(of: Edges(Sharp(above: 30)), eq: 1)",
    "Count(of: Vertices(Inside(Sphere(center: (1, 2, 3), radius: 4))), eq: 1)",
    "Count(of: Vertices(Inside(Box(min: (1, 2, 3), max: (4, 5, 6)))), eq: 1)",
    "Count(of: Vertices(Inside(HalfSpace(point: (1, 2, 3), normal: (4, 5, 6)))), eq: 1)",
    "Count(of: Edges(Longest(count: 4)), eq: 1)",
];

#[test]
fn extreme_meshes_are_measured_without_a_panic() {
    let registry = ops_all::registry();
    let engine = engine::Engine::new(&registry);
    let mut failed = Vec::new();
    for (size, other) in [
        ("1e308", "-1e308"),
        ("1e155", "1"),
        ("1e-307", "1e-323"),
        ("5e-324", "1e308"),
    ] {
        for sample in MEASURES {
            let recipe = |that: &str| {
                let made = format!(
                    r#"Cube(name: "a", size: {size}), Cube(name: "b", size: {size}, triangles: true),
                    Transform(move: ({other}, 0, 0))"#
                );
                let text =
                    format!("(recipe: 1, steps: [{made}], expect: [(on: [\"b\"], that: {that})])");
                engine.load(
                    &engine::Source::new("a.ron", text),
                    &engine::Options::default(),
                )
            };
            assert!(
                recipe(sample).is_read,
                "{sample}: {:?}",
                recipe(sample).diagnostics
            );
            for that in extreme_variants(sample, |that| recipe(that).is_read) {
                let run = || recipe(&that).run(engine::Run::default(), &engine::Silent);
                if catch_unwind(AssertUnwindSafe(run)).is_err() {
                    failed.push(format!("{that} of a cube of size {size}: panicked"));
                }
            }
        }
    }
    assert_none(&failed);
}
