//! Tests of the losses that are reported if written files do not store skins, morph targets or animations.

use mesh::{joint_name, morph_name};
use mesh_io::WriteOptions;
use scene::Scene;
use serde_json::json;
use store::Disk;

use crate::Folder;
use crate::gltf_rig::{arm_scene, changed_scene, numbers, output, scene_of};
use crate::gltf_valid::written;

#[test]
fn what_a_written_file_cannot_store_is_a_loss() {
    let losses = |change: &dyn Fn(&mut Scene)| {
        let mut scene = arm_scene();
        change(&mut scene);
        let (_, _, losses) = output(&scene);
        losses
    };
    let mesh = |scene: &mut Scene, change: &dyn Fn(&mut mesh::Mesh)| {
        let (geometry, _) = scene.parts_mut("arm").unwrap();
        let scene::Geometry::Mesh(mesh) = geometry else {
            panic!("a mesh");
        };
        change(std::sync::Arc::make_mut(mesh));
    };
    let set = |mesh: &mut mesh::Mesh, joint: usize, weight: f64| {
        let n = mesh.n_vertices();
        crate::gltf_attributes::add_column(
            mesh,
            mesh::Domain::Vertex,
            &joint_name(joint),
            vec![weight; n],
        );
    };
    assert_eq!(losses(&|_| ()), Vec::<String>::new());
    // The mesh has weights for a joint that the skin does not have.
    assert_eq!(
        losses(&|s| mesh(s, &|m| set(m, 7, 0.5))),
        ["20 joint weights"]
    );
    // The mesh has no weights, or some vertices have no weights.
    let none = |m: &mut mesh::Mesh| {
        (0..3).for_each(|j| drop(m.remove_column(mesh::Domain::Vertex, &joint_name(j))));
    };
    assert_eq!(losses(&|s| mesh(s, &none)), ["1 skins"]);
    let some = |m: &mut mesh::Mesh| drop(m.remove_column(mesh::Domain::Vertex, &joint_name(2)));
    assert_eq!(losses(&|s| mesh(s, &some)), ["4 joint weights"]);
    assert_eq!(
        losses(&|s| mesh(s, &|m| set(m, 0, -0.5))),
        ["20 joint weights", "4 joint weights"]
    );
    // If a mesh has no deltas of morph targets, the animations of its morph weights are also lost.
    let unmorphed = |m: &mut mesh::Mesh| {
        (0..2).for_each(|t| drop(m.remove_column(mesh::Domain::Vertex, &morph_name(t))));
    };
    assert_eq!(
        losses(&|s| mesh(s, &unmorphed)),
        ["2 morph targets", "2 morph weights", "1 animations"]
    );
    let one = |m: &mut mesh::Mesh| drop(m.remove_column(mesh::Domain::Vertex, &morph_name(0)));
    assert_eq!(losses(&|s| mesh(s, &one)), ["1 morph targets"]);
    // After the node of the arm is removed, no node with a skin references the arm.
    assert_eq!(losses(&|s| s.unplace("arm")), ["20 joint weights"]);
}

#[test]
fn more_than_four_influences_are_reduced_or_written_as_more_sets() {
    let mut scene = changed_scene(|j| {
        j["nodes"][4].as_object_mut().unwrap().remove("weights");
        let nodes = j["nodes"].as_array_mut().unwrap();
        nodes[3]["children"] = json!([5, 6]);
        nodes.extend([json!({ "name": "thumb" }), json!({ "name": "finger" })]);
        j["skins"] = json!([{ "joints": [0, 1, 2, 3, 5, 6] }]);
    });
    let (geometry, _) = scene.parts_mut("arm").unwrap();
    let scene::Geometry::Mesh(mesh) = geometry else {
        panic!("a mesh");
    };
    let mesh = std::sync::Arc::make_mut(mesh);
    let n = mesh.n_vertices();
    for (joint, weight) in [0.25, 0.25, 0.125, 0.125, 0.1875, 0.0625]
        .into_iter()
        .enumerate()
    {
        crate::gltf_attributes::add_column(
            mesh,
            mesh::Domain::Vertex,
            &joint_name(joint),
            vec![weight; n],
        );
    }
    let (json, bytes, losses) = output(&scene);
    assert_eq!(losses, ["20 influences"]);
    let attributes = &json["meshes"][0]["primitives"][0]["attributes"];
    assert!(attributes["JOINTS_1"].is_null());
    assert_eq!(
        numbers(&json, &bytes, &attributes["JOINTS_0"])[..4],
        [0.0, 1.0, 4.0, 2.0]
    );
    let weights = numbers(&json, &bytes, &attributes["WEIGHTS_0"]);
    assert!((weights[..4].iter().sum::<f64>() - 1.0).abs() < 1e-7);
    written("rigged_reduced", &scene);
    let options = WriteOptions {
        weight_sets: Some(2),
        ..WriteOptions::default()
    };
    let folder = Folder::new();
    let path = folder.path("a.glb");
    let report = mesh_io::write(&Disk, &path, &scene, &options).unwrap();
    assert_eq!(report.losses, []);
    let back = scene_of(crate::read(&path).unwrap());
    let weights = |scene: &Scene| scene.objects()[0].as_mesh().unwrap().attributes().clone();
    assert_eq!(weights(&back), weights(&scene));
    // By default, the written file has as many sets of joints as the file that was read.
    let (json, _, losses) = output(&back);
    assert_eq!(losses, Vec::<String>::new());
    assert!(json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_1"].is_u64());
    written("rigged_eight", &back);
}

#[test]
fn formats_without_skins_get_the_pose_and_report_the_rest() {
    let scene = arm_scene();
    let folder = Folder::new();
    for extension in ["obj", "ply", "stl", "off"] {
        let path = folder.path("a").with_extension(extension);
        let report = mesh_io::write(&Disk, &path, &scene, &WriteOptions::default()).unwrap();
        let find = |name: &str| {
            report
                .losses
                .iter()
                .find(|loss| loss.attribute == name)
                .map(|l| l.count)
        };
        let found = ["nodes", "skins", "animations"].map(find);
        assert_eq!(found, [Some(5), Some(1), Some(2)], "{extension}");
        let targets = (extension != "ply").then_some(2);
        assert_eq!(find("morph targets"), targets, "{extension}");
        let joints = (extension != "ply").then_some(20);
        assert_eq!(find("joint weights"), joints, "{extension}");
        let back = crate::read(&path).unwrap();
        let mesh = back.objects[0].as_mesh().unwrap();
        let expected = scene.placed();
        let expected = expected.objects()[0].as_mesh().unwrap();
        assert!(
            (geometry::area(mesh) - geometry::area(expected)).abs() < 1e-6,
            "{extension}"
        );
    }
}

/// A loss names the object whose content is lost, even if this object is not the first object of the scene.
#[test]
fn lost_morph_weights_name_the_object_of_their_node() {
    let mut scene = Scene::new();
    let tetrahedron = |name| scene::Object::mesh(name, geometry::shapes::tetrahedron());
    scene.insert(tetrahedron("first")).unwrap();
    scene.insert(tetrahedron("second")).unwrap();
    scene.graph_mut().push(scene::Node {
        object: Some("second".to_owned()),
        weights: vec![0.5],
        ..scene::Node::default()
    });
    let folder = Folder::new();
    let report = mesh_io::write(
        &Disk,
        &folder.path("a.gltf"),
        &scene,
        &WriteOptions::default(),
    );
    let losses = report.unwrap().losses;
    let losses: Vec<_> = losses.iter().map(|l| (&*l.object, &*l.attribute)).collect();
    assert_eq!(losses, [("second", "morph weights")]);
}

#[test]
fn the_second_table_matches_the_measured_results() {
    let mut scene = arm_scene();
    scene.graph_mut().cameras.push("{}".to_owned());
    scene.graph_mut().lights.push("{}".to_owned());
    let table = include_str!("../../src/kept.md")
        .split("\n## ")
        .nth(1)
        .unwrap();
    let cells = |line: &str| -> Vec<String> {
        let line = line.trim_matches('|').split('|');
        line.map(|cell| cell.trim().trim_matches(['`', '.']).to_owned())
            .collect()
    };
    let mut lines = table
        .lines()
        .filter(|line| line.starts_with('|'))
        .map(cells);
    let formats = lines.next().unwrap();
    let folder = Folder::new();
    let lost = formats[1..].iter().map(|extension| {
        let path = folder.path("a").with_extension(extension);
        let report = mesh_io::write(&Disk, &path, &scene, &WriteOptions::default()).unwrap();
        report
            .losses
            .into_iter()
            .map(|loss| loss.attribute)
            .collect::<Vec<_>>()
    });
    let lost: Vec<_> = lost.collect();
    for row in lines.skip(1) {
        for (word, lost) in row[1..].iter().zip(&lost) {
            let expected = if lost.contains(&row[0]) {
                "lost"
            } else {
                "kept"
            };
            assert_eq!(word, expected, "{}", row[0]);
        }
    }
}
