//! Steps on skinned, morphed and animated objects.

use geometry::shapes;
use glam::{DAffine3, DVec3};
use mesh::{Column, Domain, Mesh, Rule, Values, joint_name, morph_name};
use op::Report;
use scene::{
    AnimatedProperty, Animation, AnimationSampler, Channel, Interpolation, MeshLabel, Node, Object,
    Placement, Scene, Skin,
};

use crate::{Copy, Delete, Join, Rename, Separate, Transform};

fn moved(x: f64, y: f64) -> Placement {
    Placement::of(&DAffine3::from_translation(DVec3::new(x, y, 0.0))).unwrap()
}

fn insert(mesh: &mut Mesh, name: String, values: Values) {
    let rule = Rule::Interpolate;
    mesh.insert_column(Domain::Vertex, Column { name, rule, values });
}

/// Returns a scene with a tetrahedron, and a cube that is bound to the joints `hip` and `knee`. The cube has a morph
/// target. Animations move the joint `hip` and change the weight of the morph target.
fn scene() -> Scene {
    let mut cube = shapes::cube();
    let weights: Vec<f64> = (0..8).map(|v| f64::from(v) / 8.0).collect();
    insert(
        &mut cube,
        joint_name(0),
        Values::Float(weights.iter().map(|w| 1.0 - w).collect()),
    );
    insert(&mut cube, joint_name(1), Values::Float(weights));
    insert(&mut cube, morph_name(0), Values::Vec3(vec![DVec3::X; 8]));
    let mut scene = Scene::new();
    scene.insert(Object::mesh("body", cube)).unwrap();
    scene
        .insert(Object::mesh("hat", shapes::tetrahedron()))
        .unwrap();
    let graph = scene.graph_mut();
    graph.arrays = vec![vec![0.0, 1.0], vec![0.0; 6], vec![0.0, 1.0]];
    let node = |name: &str, parent, placement| Node {
        name: Some(name.to_owned()),
        parent,
        placement,
        ..Node::default()
    };
    graph.push(node("hip", None, moved(5.0, 0.0)));
    graph.push(node("knee", Some(0), moved(0.0, 2.0)));
    graph.push(Node {
        object: Some("body".to_owned()),
        skin: Some(0),
        ..node("body", None, moved(100.0, 0.0))
    });
    graph.push(Node {
        object: Some("hat".to_owned()),
        ..node("hat", None, moved(7.0, 3.0))
    });
    graph.skins.push(Skin {
        joints: vec![0, 1],
        ..Skin::default()
    });
    let weights = vec![0.5];
    graph.set_label(
        "body",
        MeshLabel {
            weights,
            ..MeshLabel::default()
        },
    );
    let sampler = |output| AnimationSampler {
        input: 0,
        output,
        interpolation: Interpolation::Linear,
        extras: None,
    };
    let channel = |sampler, node, property| Channel {
        sampler,
        node,
        property,
        extras: None,
    };
    graph.animations.push(Animation {
        samplers: vec![sampler(1), sampler(2)],
        channels: vec![
            channel(0, 0, AnimatedProperty::Translation),
            channel(1, 2, AnimatedProperty::Weights),
        ],
        ..Animation::default()
    });
    scene
}

/// Returns the points of an object in scene space.
fn points(scene: &Scene, name: &str) -> Vec<DVec3> {
    let placed = scene.placed();
    placed
        .object(name)
        .unwrap()
        .as_mesh()
        .unwrap()
        .positions()
        .to_vec()
}

fn run<T: op::Operation>(text: &str, scene: &mut Scene) -> Report {
    let step: T = op::test::read(text).unwrap();
    op::test::run(&step, scene).unwrap()
}

#[track_caller]
fn assert_near(a: &[DVec3], b: &[DVec3]) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        assert!(a.distance(*b) < 1e-12, "{a} {b}");
    }
}

#[test]
fn a_skinned_object_is_moved_with_its_joints_and_keeps_its_animation() {
    let mut scene = scene();
    let before = points(&scene, "body");
    let text = "(move: (1, 2, 3))";
    let step: Transform = op::test::read(text).unwrap();
    let files = op::Files::default();
    let mut cx = op::Context::new(&op::NoProgress, &files);
    let on = ["body".to_owned()];
    cx.on = Some(&on);
    let report = op::Operation::apply(&step, &mut scene, &mut cx).unwrap();
    let shift = DVec3::new(1.0, 2.0, 3.0);
    let expected: Vec<DVec3> = before.iter().map(|p| *p + shift).collect();
    assert_near(&points(&scene, "body"), &expected);
    assert_near(
        &points(&scene, "hat")[..1],
        &[points(&self::scene(), "hat")[0]],
    );
    // The node of the animated joint `hip` gets a new parent and keeps its own placement.
    assert_eq!(report.notes, ["nodes inserted above animated nodes: 1"]);
    let graph = scene.graph();
    assert_eq!(graph.nodes()[1].name.as_deref(), Some("hip"));
    assert_eq!(graph.nodes()[1].placement, moved(5.0, 0.0));
    assert_eq!(graph.skins[0].joints, [1, 2]);
    let nodes: Vec<_> = graph.animations[0]
        .channels
        .iter()
        .map(|c| c.node)
        .collect();
    assert_eq!(nodes, [1, 3]);
}

#[test]
fn a_transform_of_the_object_moves_points_and_turns_deltas() {
    let mut scene = scene();
    run::<Transform>(
        "(scale: (2, 3, 4), move: (9, 9, 9), space: Object)",
        &mut scene,
    );
    let mesh = scene.object("body").unwrap().as_mesh().unwrap();
    assert_eq!(
        mesh.attributes().morphs()[0].1[0],
        DVec3::new(2.0, 0.0, 0.0)
    );
}

#[test]
fn a_part_without_a_skin_stays_where_it_is_and_follows_the_first_joint() {
    for order in [r#"["body", "hat"]"#, r#"["hat", "body"]"#] {
        let mut scene = scene();
        let before = scene.clone();
        let text = format!(r#"(objects: {order}, name: "all", tag_parts: false)"#);
        let report = run::<Join>(&text, &mut scene);
        assert_eq!(report.losses, []);
        let mut expected = points(&before, "body");
        let hat = points(&before, "hat");
        if order.starts_with("[\"hat") {
            expected.splice(0..0, hat);
        } else {
            expected.extend(hat);
        }
        assert_near(&points(&scene, "all"), &expected);
        let joined = scene.object("all").unwrap().as_mesh().unwrap();
        let joints = joined.attributes().joints();
        let sums = (0..joined.n_vertices()).map(|v| joints.iter().map(|(_, w)| w[v]).sum::<f64>());
        assert!(sums.into_iter().all(|sum| (sum - 1.0).abs() < 1e-12));
        let nodes = scene.graph().nodes_of("all");
        assert_eq!(nodes.len(), 1);
        assert_eq!(scene.graph().nodes()[nodes[0]].skin, Some(0));
        assert_eq!(scene.graph().n_channels(), 2);
    }
}

/// The names and default weights of morph targets are kept if they are the same in all parts, both with and without a
/// skin.
#[test]
fn a_morphed_object_joined_with_its_copy_keeps_names_and_weights_of_targets() {
    for has_skin in [true, false] {
        let mut scene = scene();
        if !has_skin {
            // Each node that places the body has a skin, so the test removes all these nodes.
            scene.graph_mut().remove_object("body");
        }
        let label = MeshLabel {
            extras: Some(r#"{"targetNames":["wide"]}"#.to_owned()),
            weights: vec![0.5],
            ..MeshLabel::default()
        };
        scene.graph_mut().set_label("body", label.clone());
        run::<Copy>(r#"(from: "body", to: "twin")"#, &mut scene);
        let expected = [points(&scene, "body"), points(&scene, "twin")].concat();
        let mut other = scene.clone();
        let report = run::<Join>(r#"(objects: ["body", "twin"], name: "all")"#, &mut scene);
        assert!(
            report
                .losses
                .iter()
                .all(|loss| loss.name != "morph targets"),
            "{:?}",
            report.losses
        );
        let kept = scene.graph().label("all").unwrap();
        assert_eq!(
            (&kept.extras, &kept.weights),
            (&label.extras, &label.weights)
        );
        assert_near(&points(&scene, "all"), &expected);
        // If the default weights differ, the names and weights of the morph targets are lost.
        let label = MeshLabel {
            weights: vec![0.25],
            ..label
        };
        other.graph_mut().set_label("twin", label);
        let report = run::<Join>(r#"(objects: ["body", "twin"], name: "all")"#, &mut other);
        assert!(
            report
                .losses
                .iter()
                .any(|loss| loss.name == "morph targets")
        );
    }
}

#[test]
fn parts_with_different_skins_are_joined_in_their_poses() {
    let mut scene = scene();
    run::<Copy>(r#"(from: "body", to: "twin")"#, &mut scene);
    let graph = scene.graph_mut();
    graph.skins.push(Skin {
        joints: vec![1, 0],
        ..Skin::default()
    });
    let mut graph = graph.clone();
    let twin = graph.nodes_of("twin")[0];
    let mut nodes = graph.nodes().to_vec();
    nodes[twin].skin = Some(1);
    let mut changed = scene::Graph::default();
    changed.skins = std::mem::take(&mut graph.skins);
    changed.arrays = std::mem::take(&mut graph.arrays);
    changed.animations = std::mem::take(&mut graph.animations);
    for node in nodes {
        changed.push(node);
    }
    *scene.graph_mut() = changed;
    let expected = [points(&scene, "body"), points(&scene, "twin")].concat();
    let report = run::<Join>(r#"(objects: ["body", "twin"], name: "all")"#, &mut scene);
    assert!(report.losses.iter().any(|loss| loss.name == "skins"));
    assert_near(&points(&scene, "all"), &expected);
    let mesh = scene.object("all").unwrap().as_mesh().unwrap();
    assert!(mesh.attributes().joints().is_empty());
}

#[test]
fn a_first_joint_without_an_inverse_matters_only_to_parts_without_a_skin() {
    let mut scene = scene();
    let flat = Placement::Parts {
        translation: [5.0, 0.0, 0.0],
        rotation: [0.0, 0.0, 0.0, 1.0],
        scale: [0.0, 1.0, 1.0],
    };
    scene.graph_mut().set_placement(0, flat);
    let mut with_hat = scene.clone();
    let report = run::<Join>(r#"(objects: ["body", "hat"], name: "all")"#, &mut with_hat);
    let skins = report.losses.iter().filter(|loss| loss.name == "skins");
    let reasons: Vec<&str> = skins.map(|loss| &*loss.reason).collect();
    assert_eq!(reasons.len(), 1);
    assert!(reasons[0].contains("first joint"), "{reasons:?}");

    run::<Copy>(r#"(from: "body", to: "twin")"#, &mut scene);
    let expected = [points(&scene, "body"), points(&scene, "twin")].concat();
    let report = run::<Join>(r#"(objects: ["body", "twin"], name: "all")"#, &mut scene);
    assert!(report.losses.iter().all(|loss| loss.name != "skins"));
    assert_near(&points(&scene, "all"), &expected);
    let graph = scene.graph();
    assert_eq!(graph.nodes()[graph.nodes_of("all")[0]].skin, Some(0));
}

#[test]
fn a_skin_without_weights_is_lost_for_this_reason() {
    let mut scene = scene();
    let (geometry, _) = scene.parts_mut("body").unwrap();
    *geometry = scene::Geometry::Mesh(shapes::cube().into());
    let report = run::<Join>(r#"(objects: ["body", "hat"], name: "all")"#, &mut scene);
    let reasons: Vec<&str> = report.losses.iter().map(|loss| &*loss.reason).collect();
    assert_eq!(reasons, ["no part has weights of joints"]);
}

#[test]
fn a_deleted_object_keeps_joints_and_drops_channels() {
    let mut scene = scene();
    let step: &dyn op::Step = &op::test::read::<Delete>(r#"(objects: ["body"])"#).unwrap();
    let files = op::Files::default();
    let mut cx = op::Context::new(&op::NoProgress, &files);
    let report = step.apply(&mut scene, &mut cx).unwrap();
    // A loss that concerns the whole scene has an empty object name.
    assert_eq!(report.losses[0].object, "");
    let losses: Vec<String> = report.losses.iter().map(ToString::to_string).collect();
    assert_eq!(
        losses,
        ["the scene lost 1 animation channel: the animated nodes were removed"]
    );
    assert_eq!(scene.graph().nodes().len(), 3);
    assert_eq!(scene.graph().skins[0].joints, [0, 1]);
    // `Scene::only` with one object keeps the joints of the skin of this object, and no other joints.
    let only = self::scene().only(|name| name == "body");
    assert_eq!(only.graph().nodes().len(), 3);
    assert_eq!(only.graph().n_channels(), 2);
    let only = self::scene().only(|name| name == "hat");
    assert_eq!(only.graph().nodes().len(), 1);
    assert!(only.graph().skins.is_empty());
    let mut bytes = Vec::new();
    only.encode(&mut |piece| bytes.extend_from_slice(piece));
    let back = Scene::decode(&bytes, usize::MAX, &mut scene::NoArrays).unwrap();
    assert_eq!(back, only);
}

/// The nodes, skins, animations and lost channels in the plan of a step are the same as after the run of the step.
#[test]
fn the_plan_has_the_nodes_of_the_run() {
    fn check<T: op::Operation>(text: &str, scene: &mut Scene) {
        let step: T = op::test::read(text).unwrap();
        let step: &dyn op::Step = &step;
        let files = op::Files::default();
        let mut plan = op::Plan::of(scene);
        assert_eq!(
            step.plan(&mut plan, &op::PlanContext::new(&files)),
            [],
            "{text}"
        );
        let mut cx = op::Context::new(&op::NoProgress, &files);
        let report = step.apply(scene, &mut cx).unwrap();
        assert_eq!(plan.graph(), scene.graph(), "{text}");
        let of_graph = |losses: Vec<op::Loss>| {
            let mut losses = losses;
            losses.retain(|loss| ["skins", "animations"].contains(&&*loss.name));
            losses
        };
        assert_eq!(
            of_graph(plan.losses.clone()),
            of_graph(report.losses),
            "{text}"
        );
        let names = |names: Vec<&str>| names.join(" ");
        let planned = plan.objects().iter().map(|o| &*o.name).collect();
        let actual = scene.objects().iter().map(|o| &*o.name).collect();
        assert_eq!(names(planned), names(actual), "{text}");
    }
    check::<Delete>(r#"(objects: ["body"])"#, &mut scene());
    check::<Delete>(r#"(objects: ["hat", "body"])"#, &mut scene());
    check::<Rename>(r#"(from: "body", to: "torso")"#, &mut scene());
    check::<Separate>(r#"(object: "hat", count: 1)"#, &mut scene());
    check::<Transform>("(scale: (2, 2, 2), move: (1, 2, 3))", &mut scene());
    check::<Transform>("(move: (1, 2, 3), about: Center)", &mut scene());
    for parts in [r#"["body", "hat"]"#, r#"["hat", "body"]"#, r#"["hat"]"#] {
        let text = format!(r#"(objects: {parts}, name: "all")"#);
        check::<Join>(&text, &mut scene());
    }
    // The following steps change the same scene, one after the other.
    let mut scene = scene();
    check::<Copy>(r#"(from: "body", to: "twin")"#, &mut scene);
    check::<Copy>(r#"(from: "hat", to: "cap")"#, &mut scene);
    check::<Join>(r#"(objects: ["cap", "hat"], name: "hats")"#, &mut scene);
    check::<Separate>(r#"(object: "hats", count: 2)"#, &mut scene);
    check::<Transform>("(rotate: [(axis: X, angle: 90)])", &mut scene);
    check::<Rename>(r#"(from: "hats 2", to: "cap")"#, &mut scene);
    check::<Join>(r#"(objects: ["twin", "body"], name: "all")"#, &mut scene);
    check::<Delete>(r#"(objects: ["all"])"#, &mut scene);
}

/// Scaling a rotated node by different factors along x and y gives a shear, which a node cannot store.
#[test]
fn the_plan_names_a_shear() {
    let turned = || {
        let mut scene = Scene::new();
        for name in ["wheel", "crate"] {
            let object = Object::mesh(name, shapes::cube());
            scene.insert(object).unwrap();
        }
        let turn = glam::DQuat::from_rotation_z(0.5);
        let placement = Placement::of(&DAffine3::from_quat(turn)).unwrap();
        scene.graph_mut().push(Node {
            object: Some("wheel".to_owned()),
            placement,
            ..Node::default()
        });
        scene
    };
    let files = op::Files::default();
    let uneven = "(scale: (1, 2, 1))";
    for (text, is_refused) in [
        (uneven, true),
        ("(scale: (1, 2, 1), about: Center)", true),
        ("(scale: (1, 2, 1), space: Object)", false),
        ("(scale: (2, 2, 2))", false),
    ] {
        let step: Transform = op::test::read(text).unwrap();
        let mut plan = op::Plan::of(&turned());
        let problems = op::Operation::plan(&step, &mut plan, &op::PlanContext::new(&files));
        let planned: Vec<String> = problems.into_iter().map(|p| p.message).collect();
        let result = op::test::run(&step, &mut turned());
        let actual: Vec<String> = result.err().iter().map(ToString::to_string).collect();
        assert_eq!(planned, actual, "{text}");
        assert_eq!(planned.len(), usize::from(is_refused), "{text}");
    }
    // If the plan is incomplete, the nodes of the plan may differ from the nodes of the run, so the plan reports no
    // problem.
    let step: Transform = op::test::read(uneven).unwrap();
    let mut plan = op::Plan::of(&turned());
    plan.incomplete = true;
    let problems = op::Operation::plan(&step, &mut plan, &op::PlanContext::new(&files));
    assert_eq!(problems, []);
}

#[test]
fn the_plan_of_a_join_names_the_loss_of_different_skins() {
    let [plain, skinned, other, twice] = [(1, None), (1, Some(0)), (1, Some(1)), (2, Some(0))];
    for (parts, kept, n_lost) in [
        ([plain, plain], None, 0),
        ([skinned, skinned], Some(0), 0),
        ([plain, other], Some(1), 0),
        ([skinned, other], None, 1),
        ([twice, plain], None, 1),
    ] {
        let mut scene = scene();
        let mut graph = scene::Graph::default();
        graph.skins = vec![Skin::default(); 2];
        for (name, (n, skin)) in ["body", "hat"].into_iter().zip(parts) {
            for _ in 0..n {
                graph.push(Node {
                    object: Some(name.to_owned()),
                    skin,
                    ..Node::default()
                });
            }
        }
        *scene.graph_mut() = graph;
        let mut plan = op::Plan::of(&scene);
        let step: Join = op::test::read(r#"(objects: ["body", "hat"], name: "all")"#).unwrap();
        let files = op::Files::default();
        let problems = op::Operation::plan(&step, &mut plan, &op::PlanContext::new(&files));
        assert_eq!(problems, []);
        assert_eq!(plan.losses.len(), n_lost, "{parts:?}");
        let nodes = plan.graph().nodes().iter().filter(|n| n.object.is_some());
        let skins: Vec<_> = nodes.map(|node| node.skin).collect();
        assert_eq!(skins, Vec::from_iter(kept.map(Some)), "{parts:?}");
    }
}
