use glam::DVec3;
use mesh::{Column, Domain, Mesh, Rule, VERTEX_NORMAL, Values};

use super::*;
use crate::{DecodeError, NoArrays, Object, Scene, transformed};
use geometry::shapes;

fn moved(translation: [f64; 3], scale: [f64; 3]) -> Placement {
    Placement::Parts {
        translation,
        rotation: [0.0, 0.0, 0.0, 1.0],
        scale,
    }
}

/// A car: the node `car` has the children `body`, `left` and `right`. The nodes `left` and `right` reference the
/// wheel, and `left` has a child with a camera.
fn car() -> Scene {
    let mut scene = Scene::new();
    for name in ["body", "wheel"] {
        scene.insert(Object::mesh(name, shapes::cube())).unwrap();
    }
    let graph = scene.graph_mut();
    graph.cameras.push("{}".to_owned());
    let car = graph.push(Node {
        name: Some("car".to_owned()),
        placement: moved([10.0, 0.0, 0.0], [1.0; 3]),
        ..Node::default()
    });
    let node = |name: &str, placement, object: Option<&str>, parent| Node {
        name: Some(name.to_owned()),
        parent: Some(parent),
        placement,
        object: object.map(str::to_owned),
        ..Node::default()
    };
    graph.push(node(
        "body",
        moved([0.0, 1.0, 0.0], [2.0; 3]),
        Some("body"),
        car,
    ));
    let left = graph.push(node(
        "left",
        moved([0.0, 0.0, 5.0], [1.0; 3]),
        Some("wheel"),
        car,
    ));
    graph.push(node(
        "right",
        moved([0.0; 3], [1.0, 1.0, -1.0]),
        Some("wheel"),
        car,
    ));
    graph.push(Node {
        camera: Some(0),
        ..node("eye", Placement::IDENTITY, None, left)
    });
    scene
}

fn nodes(scene: &Scene) -> Vec<(&str, Option<&str>, Option<usize>)> {
    let nodes = scene.graph().nodes().iter();
    nodes
        .map(|n| {
            (
                n.name.as_deref().unwrap_or("-"),
                n.object.as_deref(),
                n.parent,
            )
        })
        .collect()
}

/// Checks that the canonical form contains every part of the scene, and that decoding restores the scene.
#[track_caller]
fn assert_consistent(scene: &Scene) {
    let mut bytes = Vec::new();
    scene.encode(&mut |piece| bytes.extend_from_slice(piece));
    let back = Scene::decode(&bytes, usize::MAX, &mut NoArrays).unwrap();
    assert_eq!(back, *scene);
}

#[test]
fn instances_are_placed_by_all_their_ancestors() {
    let scene = car();
    let instances = scene.instances();
    let all: Vec<_> = instances
        .iter()
        .map(|i| (i.name.as_str(), i.to_scene.transform_point3(DVec3::ONE)))
        .collect();
    let at = DVec3::new;
    let expected = [
        ("body", at(12.0, 3.0, 2.0)),
        ("left", at(11.0, 1.0, 6.0)),
        ("right", at(11.0, 1.0, -1.0)),
    ];
    assert_eq!(all, expected);
    let placed = scene.placed();
    for object in placed.objects() {
        let mesh = object.as_mesh().unwrap();
        assert_eq!(mesh.defects(), []);
        assert!(geometry::volume(mesh) > 0.0, "{}", object.name);
    }
    assert_eq!(placed.objects().len(), 3);
    assert!(placed.graph().is_empty());
    assert_consistent(&scene);
}

#[test]
fn a_deleted_object_leaves_the_nodes_that_are_still_needed() {
    let mut scene = car();
    scene.remove("wheel").unwrap();
    // The node `left` is kept because it has a child.
    let expected = [
        ("car", None, None),
        ("body", Some("body"), Some(0)),
        ("left", None, Some(0)),
        ("eye", None, Some(2)),
    ];
    assert_eq!(nodes(&scene), expected);
    assert_consistent(&scene);
    scene.remove("body").unwrap();
    assert_eq!(nodes(&scene)[1], ("left", None, Some(0)));
    assert_consistent(&scene);
}

#[test]
fn a_renamed_object_renames_the_node_with_its_name() {
    let mut scene = car();
    scene.rename("body", "hull").unwrap();
    scene.rename("wheel", "tire").unwrap();
    assert_eq!(nodes(&scene)[1], ("hull", Some("hull"), Some(0)));
    assert_eq!(nodes(&scene)[2], ("left", Some("tire"), Some(0)));
    assert_consistent(&scene);
    let label = MeshLabel {
        name: Some("Cube.001".to_owned()),
        ..MeshLabel::default()
    };
    scene.graph_mut().set_label("hull", label.clone());
    scene.rename("hull", "body").unwrap();
    assert_eq!(scene.graph().label("body"), Some(&label));
    assert_eq!(scene.graph().label("hull"), None);
}

#[test]
fn copies_and_parts_are_shown_at_the_same_places() {
    let mut scene = car();
    let places = |scene: &Scene, name: &str| -> Vec<DAffine3> {
        let instances = scene.instances().into_iter();
        let of_object = instances.filter(|i| i.object.name == name);
        of_object.map(|i| i.to_scene).collect()
    };
    for name in ["copy", "part"] {
        scene.insert(Object::mesh(name, shapes::cube())).unwrap();
    }
    scene.graph_mut().copy_object("wheel", "copy");
    scene.graph_mut().add_part("wheel", "part");
    for name in ["copy", "part"] {
        assert_eq!(places(&scene, name), places(&scene, "wheel"), "{name}");
    }
    assert_consistent(&scene);
}

#[test]
fn a_selection_of_objects_has_their_nodes_and_ancestors() {
    let only = car().only(|name| name == "body");
    let expected = [("car", None, None), ("body", Some("body"), Some(0))];
    assert_eq!(nodes(&only), expected);
    assert!(only.graph().cameras.is_empty());
    assert_consistent(&only);
}

#[test]
fn appended_graphs_keep_their_references() {
    let mut scene = car();
    let mut other = car();
    other.rename("body", "body 2").unwrap();
    other.rename("wheel", "wheel 2").unwrap();
    let objects = other.objects().to_vec();
    scene
        .append(objects.clone(), other.graph().clone())
        .unwrap();
    assert_eq!(nodes(&scene)[9], ("eye", None, Some(7)));
    assert_eq!(scene.graph().nodes()[9].camera, Some(1));
    assert_consistent(&scene);
    let mut document = Graph::default();
    for (expected, json) in [(0, "{}"), (0, "{}"), (1, "{ }")] {
        document
            .document
            .insert("asset".to_owned(), json.to_owned());
        assert_eq!(scene.append(Vec::new(), document.clone()), Ok(expected));
    }
    let before = scene.clone();
    assert!(scene.append(objects, Graph::default()).is_err());
    assert_eq!(scene, before);
}

#[test]
fn every_part_of_a_graph_changes_the_digest() {
    let digest = |change: fn(&mut Graph)| {
        let mut scene = car();
        change(scene.graph_mut());
        assert_consistent(&scene);
        scene.digest().to_string()
    };
    let all = [
        digest(|_| {}),
        digest(|g| *g = Graph::default()),
        digest(|g| g.nodes[1].name = None),
        digest(|g| g.nodes[1].name = Some(String::new())),
        digest(|g| g.nodes[1].parent = None),
        digest(|g| g.nodes[1].placement = Placement::IDENTITY),
        digest(|g| g.nodes[1].placement = moved([0.0; 3], [1.0, 1.0, -1.0])),
        digest(|g| g.nodes[1].placement = Placement::Matrix(glam::DMat4::IDENTITY.to_cols_array())),
        digest(|g| g.nodes[1].object = None),
        digest(|g| g.nodes[1].camera = Some(0)),
        digest(|g| g.nodes[1].extras = Some("1".to_owned())),
        digest(|g| g.nodes[0].extras = Some("1".to_owned())),
        digest(|g| g.cameras[0] = "{ }".to_owned()),
        digest(|g| g.lights.push("{}".to_owned())),
        digest(|g| g.set_label("body", MeshLabel::default())),
        digest(|g| drop(g.document.insert("asset".to_owned(), "{}".to_owned()))),
        digest(|g| drop(g.document.insert("root".to_owned(), "{}".to_owned()))),
    ];
    let unique: std::collections::BTreeSet<_> = all.iter().collect();
    assert_eq!(unique.len(), all.len());
}

#[test]
fn changed_bytes_of_a_graph_are_refused_or_give_a_consistent_graph() {
    let scene = car();
    let mut bytes = Vec::new();
    scene.encode(&mut |piece| bytes.extend_from_slice(piece));
    let mut plain = scene.clone();
    *plain.graph_mut() = Graph::default();
    let mut start = 0;
    plain.encode(&mut |piece| start += piece.len());
    for end in start + 1..bytes.len() {
        assert!(
            Scene::decode(&bytes[..end], usize::MAX, &mut NoArrays).is_err(),
            "{end}"
        );
    }
    for i in start..bytes.len() {
        let mut changed = bytes.clone();
        changed[i] ^= 1 << (i % 8);
        if let Ok(scene) = Scene::decode(&changed, usize::MAX, &mut NoArrays) {
            assert!(
                scene.instances().iter().all(|i| i.to_scene.is_finite()),
                "{i}"
            );
        }
    }
    let mut unknown = scene;
    unknown.graph_mut().nodes[1].object = Some("door".to_owned());
    let mut bytes = Vec::new();
    unknown.encode(&mut |piece| bytes.extend_from_slice(piece));
    let error = Scene::decode(&bytes, usize::MAX, &mut NoArrays).unwrap_err();
    assert!(matches!(error, DecodeError::Expected(_)), "{error}");
}

#[test]
fn transformed_meshes_keep_all_attributes_and_their_normals_stay_normal() {
    let mut mesh = shapes::octahedron();
    mesh.set(VERTEX_NORMAL, mesh.positions().to_vec());
    let column = Column {
        name: "order".to_owned(),
        rule: Rule::Drop,
        values: Values::Float((0..mesh.n_vertices()).map(|v| v as f64).collect()),
    };
    mesh.insert_column(Domain::Vertex, column.clone());
    for scale in [DVec3::new(1.0, 2.0, 0.5), DVec3::new(-1.0, 2.0, 0.5)] {
        let turn = glam::DQuat::from_xyzw(0.1, 0.7, -0.3, 0.5).normalize();
        let map = DAffine3::from_scale_rotation_translation(scale, turn, DVec3::ONE);
        let result = transformed(&mesh, &map);
        assert_eq!(result.defects(), []);
        assert!((geometry::volume(&result) - geometry::volume(&mesh)).abs() < 1e-12);
        assert_eq!(
            result.attributes().column(Domain::Vertex, "order"),
            Some(&column)
        );
        let outward = |mesh: &Mesh, v: usize| {
            let faces = mesh.vertex_faces(mesh::VertexId::new(v));
            faces
                .map(|f| mesh.area_vector(f))
                .sum::<DVec3>()
                .normalize()
        };
        // By symmetry, the sum of the area vectors of the faces around a vertex of the octahedron is parallel to the
        // normal of the vertex.
        for (v, normal) in result.get(VERTEX_NORMAL).unwrap().iter().enumerate() {
            assert!(normal.distance(outward(&result, v)) < 1e-12, "{scale}: {v}");
        }
    }
}
