//! Tests that the plan of `Save`, which predicts problems and losses, agrees with the writers of all formats.

use std::collections::BTreeSet;

use geometry::shapes;
use glam::{DVec2, DVec3, DVec4};
use mesh::{Column, Domain, Rule, Values};
use mesh_io::{Format, WriteOptions};
use op::{Files, Loss, Plan, PlanContext, Problem};
use scene::{Geometry, Material, Node, Object, Scene};
use store::Memory;

fn planned(path: &str, scene: &Scene) -> (Vec<Problem>, Plan) {
    let registry = ops_all::registry();
    let save = registry.get("Save").expect("an operation");
    let step = save.deserialize(&ron_tree::parse(&format!("(path: {path:?})")).value);
    let files = Files::default();
    let cx = PlanContext::new(&files);
    let mut plan = Plan::of(scene);
    let problems = step.expect("parameters of Save").plan(&mut plan, &cx);
    (problems, plan)
}

fn scene_of(objects: Vec<Object>) -> Scene {
    let mut scene = Scene::new();
    for object in objects {
        scene.insert(object).unwrap();
    }
    scene
}

fn writable() -> impl Iterator<Item = Format> {
    Format::all().filter(|format| format.can_write())
}

#[test]
fn a_kind_of_geometry_is_refused_exactly_if_writing_fails() {
    let read = |path: &str, text: &str| {
        let options = mesh_io::ReadOptions::default();
        let store = Memory::default();
        let bytes = text.as_bytes().to_vec();
        let read = mesh_io::read_bytes(&store, path.as_ref(), bytes, &options);
        read.unwrap().objects.remove(0).geometry
    };
    let kinds = [
        Object::mesh("a", shapes::tetrahedron()).geometry,
        Geometry::Polylines(vec![vec![DVec3::ZERO, DVec3::X]]),
        read("a.bez", &format!("1\n{}", "0 0 0\n".repeat(16))),
        read("a.bzc", "2\n0 0\n1 0\n"),
    ];
    for format in writable() {
        let path = format!("a.{}", format.extension());
        for geometry in &kinds {
            for n in 1..=2 {
                let object = |i| Object::new(format!("o{i}"), geometry.clone());
                let scene = scene_of((0..n).map(object).collect());
                let options = WriteOptions::default();
                let written = mesh_io::write(&Memory::default(), path.as_ref(), &scene, &options);
                let (problems, _) = planned(&path, &scene);
                let what = format!("{path}, {n} times {}", geometry.kind());
                assert_eq!(problems.is_empty(), written.is_ok(), "{what}: {problems:?}");
            }
        }
    }
    let (problems, _) = planned(
        "a.bez",
        &scene_of(vec![Object::mesh("box", shapes::cube())]),
    );
    assert_eq!(
        problems[0].message,
        "object `box`: a .bez file stores Bezier patches, found mesh"
    );
}

/// Returns a mesh with a float, an integer and a tag attribute in every domain, and with the standard attributes.
fn rich() -> Object {
    let mut mesh = shapes::cube();
    let mut add = |domain, name: &str, values: fn(usize) -> Values| {
        let n = mesh.domain_len(domain);
        mesh.insert_column(
            domain,
            Column {
                name: name.to_owned(),
                rule: Rule::Copy,
                values: values(n),
            },
        );
    };
    for domain in Domain::ALL {
        add(domain, "a", |n| Values::Float(vec![0.5; n]));
        add(domain, "b", |n| Values::Int(vec![1; n]));
        add(domain, "c", |n| {
            Values::Tag((0..n).map(|i| i == 0).collect())
        });
    }
    add(Domain::Vertex, "normal", |n| {
        Values::Vec3(vec![DVec3::X; n])
    });
    add(Domain::Corner, "normal", |n| {
        Values::Vec3(vec![DVec3::X; n])
    });
    add(Domain::Corner, "uv", |n| {
        Values::Vec2((0..n).map(|i| DVec2::splat(i as f64)).collect())
    });
    add(Domain::Corner, "uv2", |n| Values::Vec2(vec![DVec2::X; n]));
    add(Domain::Vertex, "color", |n| {
        Values::Vec4(vec![DVec4::splat(0.5); n])
    });
    add(Domain::Face, "color", |n| {
        Values::Vec4(vec![DVec4::splat(0.5); n])
    });
    add(Domain::Vertex, "tangent", |n| {
        Values::Vec3(vec![DVec3::X; n])
    });
    add(Domain::Corner, "tangent", |n| {
        Values::Vec4(vec![DVec4::X; n])
    });
    add(Domain::Edge, "crease", |n| Values::Float(vec![1.0; n]));
    add(Domain::Face, "material", |n| Values::Int(vec![0; n]));
    add(Domain::Face, "smoothing", |n| Values::Int(vec![1; n]));
    Object {
        materials: vec![Material::new("wood")],
        ..Object::mesh("rich", mesh)
    }
}

#[test]
fn the_losses_of_writing_are_planned() {
    let plain = || Object::mesh("plain", shapes::tetrahedron());
    let mut placed = scene_of(vec![rich()]);
    for _ in 0..2 {
        placed.graph_mut().push(Node {
            object: Some("rich".to_owned()),
            ..Node::default()
        });
    }
    let scenes = [
        scene_of(vec![rich()]),
        scene_of(vec![plain()]),
        scene_of(vec![plain(), rich()]),
        placed,
    ];
    for format in writable() {
        let path = format!("a.{}", format.extension());
        for (i, scene) in scenes.iter().enumerate() {
            let options = WriteOptions::default();
            let Ok(report) = mesh_io::write(&Memory::default(), path.as_ref(), scene, &options)
            else {
                continue;
            };
            // Only the names of the losses are compared, because other parts of a loss can depend on whether the
            // objects are joined.
            let lost: BTreeSet<String> = report.losses.into_iter().map(|l| l.attribute).collect();
            let (_, plan) = planned(&path, scene);
            let names = |losses: &[Loss]| losses.iter().map(|l| l.name.clone()).collect();
            let certain: BTreeSet<String> = names(&plan.losses);
            let possible: BTreeSet<String> = names(&plan.possible_losses);
            let all: BTreeSet<String> = certain.union(&possible).cloned().collect();
            assert!(certain.is_subset(&lost), "{path} {i}: {certain:?} {lost:?}");
            assert!(lost.is_subset(&all), "{path} {i}: {lost:?} {all:?}");
        }
    }
}
