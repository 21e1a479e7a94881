//! Tests of the operations on objects that nodes place.

use geometry::shapes;
use glam::{DAffine3, DVec3};
use scene::{Node, Object, Placement, Scene};

use super::*;
use crate::{Copy, Delete, Join, Rename, Separate};

fn moved(translation: [f64; 3], scale: [f64; 3]) -> Placement {
    Placement::Parts {
        translation,
        rotation: [0.0, 0.0, 0.6, 0.8],
        scale,
    }
}

/// Returns a scene with a car, a separate cube, and a camera without a parent node. The car has a body and two wheels,
/// one of which is mirrored.
fn car() -> Scene {
    let mut scene = Scene::new();
    for name in ["body", "wheel", "plain"] {
        scene.insert(Object::mesh(name, shapes::cube())).unwrap();
    }
    let graph = scene.graph_mut();
    graph.cameras.push("{}".to_owned());
    let node = |name: &str, placement, parent| Node {
        name: Some(name.to_owned()),
        parent,
        placement,
        ..Node::default()
    };
    let shown = |object: &str, node: Node| Node {
        object: Some(object.to_owned()),
        ..node
    };
    let car = graph.push(node("car", moved([10.0, 0.0, 0.0], [1.0; 3]), None));
    let body = node("body", moved([0.0, 1.0, 0.0], [2.0; 3]), Some(car));
    let body = graph.push(shown("body", body));
    let left = node("left", moved([0.0, 0.0, 5.0], [1.0; 3]), Some(body));
    graph.push(shown("wheel", left));
    let right = node("right", moved([0.0; 3], [1.0, 1.0, -1.0]), Some(car));
    graph.push(shown("wheel", right));
    graph.push(Node {
        camera: Some(0),
        ..node("eye", moved([0.0; 3], [1.0; 3]), None)
    });
    scene
}

fn run<T: Operation>(scene: &mut Scene, text: &str) -> Report {
    op::test::run(&op::test::read::<T>(text).unwrap(), scene).unwrap()
}

fn points(scene: &Scene, name: &str) -> Vec<DVec3> {
    let instances = scene.instances();
    let of_object = instances.iter().filter(|i| i.object.name == name);
    let placed = of_object.map(|i| i.placed().as_mesh().unwrap().positions().to_vec());
    placed.flatten().collect()
}

#[track_caller]
fn assert_near(a: &[DVec3], b: &[DVec3]) {
    assert_eq!(a.len(), b.len());
    for (p, q) in a.iter().zip(b) {
        assert!(p.distance(*q) < 1e-12, "{p} {q}");
    }
}

const NAMES: [&str; 3] = ["body", "wheel", "plain"];

#[test]
fn placed_points_move_as_points_do() {
    for (text, map) in [
        (
            "(move: (1, -2, 0.5))",
            DAffine3::from_translation(DVec3::new(1.0, -2.0, 0.5)),
        ),
        (
            "(scale: (2, 2, 2))",
            DAffine3::from_scale(DVec3::splat(2.0)),
        ),
        (
            "(scale: (1, 1, -1))",
            DAffine3::from_scale(DVec3::new(1.0, 1.0, -1.0)),
        ),
        (
            "(rotate: [(axis: X, angle: 90)], about: Point(1, 2, 3))",
            DAffine3::from_translation(DVec3::new(1.0, 2.0, 3.0))
                * DAffine3::from_cols(DVec3::X, DVec3::Z, -DVec3::Y, DVec3::ZERO)
                * DAffine3::from_translation(-DVec3::new(1.0, 2.0, 3.0)),
        ),
    ] {
        let mut scene = car();
        run::<Transform>(&mut scene, text);
        for name in NAMES {
            let before: Vec<_> = points(&car(), name)
                .iter()
                .map(|&p| map.transform_point3(p))
                .collect();
            assert_near(&points(&scene, name), &before);
        }
        // The meshes of objects that nodes place do not change. The camera moves with the objects.
        let mesh = |scene: &Scene| scene.object("wheel").unwrap().as_mesh().unwrap().clone();
        assert_eq!(mesh(&scene), mesh(&car()));
        let camera = |scene: &Scene| scene.graph().to_scene()[4];
        assert!(
            camera(&scene).abs_diff_eq(map * camera(&car()), 1e-12),
            "{text}"
        );
        // The placements of nodes below a moved node do not change.
        assert_eq!(
            scene.graph().nodes()[1..4],
            car().graph().nodes()[1..4],
            "{text}"
        );
    }
}

#[test]
fn only_the_named_object_and_the_nodes_below_it_move() {
    let mut scene = car();
    let files = op::Files::default();
    let on = ["body".to_owned()];
    let mut cx = Context::new(&op::NoProgress, &files);
    cx.on = Some(&on);
    let step: Transform = op::test::read("(rotate: [(axis: Z, angle: 90)])").unwrap();
    step.apply(&mut scene, &mut cx).unwrap();
    let turned: Vec<_> = points(&car(), "body")
        .iter()
        .map(|p| DVec3::new(-p.y, p.x, p.z))
        .collect();
    assert_near(&points(&scene, "body"), &turned);
    assert_near(&points(&scene, "plain"), &points(&car(), "plain"));
    // Only one of the two wheels has a node below the node of the body.
    let (after, before) = (points(&scene, "wheel"), points(&car(), "wheel"));
    assert_near(&after[8..], &before[8..]);
    assert!(after[0].distance(before[0]) > 1.0);
}

#[test]
fn the_center_of_an_object_is_that_of_all_its_instances() {
    let mut scene = car();
    run::<Transform>(&mut scene, "(scale: (-1, -1, -1), about: Center)");
    let bounds = |scene: &Scene, name| {
        let points = points(scene, name);
        let first = points[0];
        let low = points.iter().fold(first, |a, &b| a.min(b));
        [low, points.iter().fold(first, |a, &b| a.max(b))]
    };
    for name in NAMES {
        assert_near(&bounds(&scene, name), &bounds(&car(), name));
    }
}

#[test]
fn in_the_space_of_the_object_the_points_move() {
    let mut scene = car();
    run::<Transform>(&mut scene, "(move: (1, 0, 0), space: Object)");
    assert_eq!(scene.graph(), car().graph());
    let mesh = scene.object("wheel").unwrap().as_mesh().unwrap();
    assert_eq!(
        mesh.positions()[0],
        shapes::cube().positions()[0] + DVec3::X
    );
}

#[test]
fn a_shear_of_a_node_is_refused() {
    let mut scene = car();
    let step: Transform = op::test::read("(scale: (1, 2, 1))").unwrap();
    let error = op::test::run(&step, &mut scene).unwrap_err().to_string();
    assert!(error.contains("space: Object"), "{error}");
}

#[test]
fn joining_applies_the_placements_of_all_instances() {
    let mut scene = car();
    let before = [points(&scene, "plain"), points(&scene, "wheel")].concat();
    let report = run::<Join>(&mut scene, r#"(objects: ["plain", "wheel"], name: "all")"#);
    assert_eq!(
        report.notes,
        ["instances whose transforms were applied to their points: 3"]
    );
    assert_eq!(
        scene.object("all").unwrap().as_mesh().unwrap().positions(),
        before
    );
    assert_near(&points(&scene, "all"), &before);
    let names: Vec<_> = scene
        .graph()
        .nodes()
        .iter()
        .filter_map(|n| n.name.as_deref())
        .collect();
    assert_eq!(names, ["car", "body", "eye"]);
}

#[test]
fn copies_parts_and_new_names_keep_their_places() {
    let mut scene = car();
    let wheel = points(&scene, "wheel");
    run::<Copy>(&mut scene, r#"(from: "wheel", to: "tire")"#);
    assert_near(&points(&scene, "tire"), &wheel);
    run::<Rename>(&mut scene, r#"(from: "tire", to: "ring")"#);
    assert_near(&points(&scene, "ring"), &wheel);
    run::<Delete>(&mut scene, r#"(objects: ["wheel"])"#);
    assert_near(&points(&scene, "ring"), &wheel);

    let mesh = shapes::grid(2, 1);
    *scene.parts_mut("ring").unwrap().0 = Geometry::Mesh(Arc::new(mesh));
    let mut area = 0.0;
    for instance in scene.instances().iter().filter(|i| i.object.name == "ring") {
        area += geometry::area(instance.placed().as_mesh().unwrap());
    }
    run::<Separate>(&mut scene, r#"(object: "ring")"#);
    let parts = scene.placed();
    let parts = parts.objects().iter().filter(|o| o.name.contains("ring"));
    let of_parts: f64 = parts.map(|o| geometry::area(o.as_mesh().unwrap())).sum();
    assert!((of_parts - area).abs() < 1e-12);
}
