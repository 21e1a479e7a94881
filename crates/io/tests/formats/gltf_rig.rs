//! Tests of skins, morph targets and animations of glTF files. If a file is read and written again, its skins, morph
//! targets and animations do not change.

use glam::{DAffine3, DVec3, Mat4};
use mesh::{joint_name, morph_name};
use mesh_io::{Loaded, WriteOptions};
use scene::Scene;
use serde_json::{Value, json};
use store::Disk;

use crate::Folder;
use crate::gltf_read::{data_uri, read_json};
use crate::gltf_valid::written;

/// Builds the accessors of a document.
#[derive(Default)]
pub(crate) struct Accessors {
    bytes: Vec<u8>,
    list: Vec<Value>,
    views: Vec<Value>,
}

impl Accessors {
    pub(crate) fn add(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.push(json!({
            "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len(),
        }));
        self.bytes.extend_from_slice(bytes);
        self.list.push(json!({
            "bufferView": self.views.len() - 1, "componentType": component, "type": kind, "count": count,
            "normalized": component != 5126 && kind == "VEC4" && bytes.len() == 4 * count && component == 5121,
        }));
        self.list.len() - 1
    }

    pub(crate) fn floats(&mut self, values: &[f32], kind: &str) -> usize {
        let width = match kind {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 16,
        };
        let bytes: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
        let at = self.add(&bytes, 5126, kind, values.len() / width);
        let rows = || values.chunks(width);
        let all = |pick: fn(f32, f32) -> f32| -> Vec<f32> {
            (0..width)
                .map(|k| rows().map(|row| row[k]).reduce(pick).unwrap())
                .collect()
        };
        self.list[at]["min"] = json!(all(|a, b| if a < b { a } else { b }));
        self.list[at]["max"] = json!(all(|a, b| if a > b { a } else { b }));
        at
    }

    pub(crate) fn finish(self, mut json: Value) -> Value {
        json["accessors"] = self.list.into();
        json["bufferViews"] = self.views.into();
        json["buffers"] = json!([{ "byteLength": self.bytes.len(), "uri": data_uri(&self.bytes) }]);
        json
    }
}

/// The number of rings of vertices in the arm.
const RINGS: usize = 5;

/// Returns the vertices of an arm along the y axis. The arm consists of rings of four vertices.
fn positions() -> Vec<f32> {
    let square = [[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]];
    let ring = |r: usize| square.map(|[x, z]| [0.25 * x, 0.5 * r as f32, 0.25 * z]);
    (0..RINGS).flat_map(|r| ring(r).concat()).collect()
}

fn triangles() -> Vec<u16> {
    let n = u16::try_from(RINGS).unwrap();
    let mut all = Vec::new();
    for r in 0..n - 1 {
        for k in 0..4 {
            let [a, b] = [4 * r + k, 4 * r + (k + 1) % 4];
            all.extend([a, b, b + 4, a, b + 4, a + 4]);
        }
    }
    all
}

/// For each ring of the arm, the joints and weights of its vertices.
const BOUND: [([u8; 4], [f32; 4]); RINGS] = [
    ([0, 0, 0, 0], [1.0, 0.0, 0.0, 0.0]),
    ([1, 0, 0, 0], [0.25, 0.75, 0.0, 0.0]),
    ([0, 1, 2, 0], [0.25, 0.5, 0.25, 0.0]),
    ([2, 0, 1, 0], [0.625, 0.125, 0.25, 0.0]),
    ([2, 0, 0, 0], [1.0, 0.0, 0.0, 0.0]),
];

/// An arm with three joints, two morph targets and two animations.
pub(crate) fn arm() -> Value {
    let mut a = Accessors::default();
    let position = a.floats(&positions(), "VEC3");
    let indices = triangles();
    let bytes: Vec<u8> = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
    let indices = a.add(&bytes, 5123, "SCALAR", indices.len());
    let joints: Vec<u8> = BOUND
        .iter()
        .flat_map(|(joints, _)| joints.repeat(4))
        .collect();
    let joints = a.add(&joints, 5121, "VEC4", 4 * RINGS);
    a.list[joints]["normalized"] = json!(false);
    let weights: Vec<f32> = BOUND
        .iter()
        .flat_map(|(_, weights)| weights.repeat(4))
        .collect();
    let weights = a.floats(&weights, "VEC4");
    let delta = |t: usize| -> Vec<f32> {
        let delta = |v: usize| [0.125 * (v % (t + 2)) as f32, 0.0, -0.25 * t as f32];
        (0..4 * RINGS).flat_map(delta).collect()
    };
    let targets = [0, 1].map(|t| json!({ "POSITION": a.floats(&delta(t), "VEC3") }));
    let matrices: Vec<f32> = [0.0_f32, 0.5, 1.5]
        .iter()
        .flat_map(|y| {
            let mut matrix = Mat4::IDENTITY.to_cols_array();
            matrix[13] = -y;
            matrix
        })
        .collect();
    let matrices = a.floats(&matrices, "MAT4");
    let times = a.floats(&[0.0, 0.5, 2.0], "SCALAR");
    let turn = a.floats(
        &[0.0, 0.0, 0.0, 1.0, 0.6, 0.0, 0.0, 0.8, 0.0, 0.0, 1.0, 0.0],
        "VEC4",
    );
    let shift = a.floats(&[0.1; 9], "VEC3");
    let spline = a.floats(&[0.5; 18], "SCALAR");
    a.finish(json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0, 4] }],
        "nodes": [
            { "name": "rig", "children": [1], "translation": [3, 0, 0] },
            { "name": "shoulder", "children": [2], "rotation": [0, 0, 0.6, 0.8] },
            { "name": "elbow", "children": [3], "translation": [0, 0.5, 0] },
            { "name": "hand", "translation": [0, 1, 0] },
            { "name": "arm", "mesh": 0, "skin": 0, "weights": [0, 0.5], "extras": { "id": 1 } },
        ],
        "meshes": [{
            "name": "arm",
            "weights": [0.25, 0],
            "extras": { "targetNames": ["thin", "thick"] },
            "primitives": [{
                "attributes": { "POSITION": position, "JOINTS_0": joints, "WEIGHTS_0": weights },
                "indices": indices,
                "targets": targets,
            }],
        }],
        "skins": [{
            "name": "bones", "joints": [1, 2, 3], "inverseBindMatrices": matrices, "skeleton": 1,
            "extras": { "b": 1 },
        }],
        "animations": [
            {
                "name": "wave",
                "extras": { "fps": 24 },
                "samplers": [
                    { "input": times, "output": turn, "extras": { "s": 1 } },
                    { "input": times, "output": shift, "interpolation": "STEP" },
                ],
                "channels": [
                    { "sampler": 0, "target": { "node": 2, "path": "rotation" }, "extras": { "c": [] } },
                    { "sampler": 1, "target": { "node": 0, "path": "translation" } },
                    { "sampler": 1, "target": { "node": 3, "path": "scale" } },
                ],
            },
            {
                "samplers": [{ "input": times, "output": spline, "interpolation": "CUBICSPLINE" }],
                "channels": [{ "sampler": 0, "target": { "node": 4, "path": "weights" } }],
            },
        ],
    }))
}

pub(crate) fn scene_of(loaded: Loaded) -> Scene {
    let mut scene = Scene::new();
    scene.append(loaded.objects, loaded.graph).unwrap();
    scene
}

pub(crate) fn arm_scene() -> Scene {
    changed_scene(|_| ())
}

/// Changes the JSON of the arm, and returns the scene of the changed file.
pub(crate) fn changed_scene(change: impl Fn(&mut Value)) -> Scene {
    let mut json = arm();
    change(&mut json);
    let loaded = read_json(&json).unwrap();
    assert_eq!(loaded.notes, []);
    scene_of(loaded)
}

/// Writes a scene. Returns the document, its buffer and the losses.
pub(crate) fn output(scene: &Scene) -> (Value, Vec<u8>, Vec<String>) {
    let folder = Folder::new();
    let path = folder.path("a.gltf");
    let report = mesh_io::write(&Disk, &path, scene, &WriteOptions::default()).unwrap();
    let json = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    let bytes = std::fs::read(folder.path("a.bin")).unwrap_or_default();
    let losses = report
        .losses
        .iter()
        .map(|l| format!("{} {}", l.count, l.attribute));
    (json, bytes, losses.collect())
}

pub(crate) fn index(value: &Value) -> usize {
    usize::try_from(value.as_u64().unwrap()).unwrap()
}

/// The numbers of an accessor.
pub(crate) fn numbers(json: &Value, bytes: &[u8], accessor: &Value) -> Vec<f64> {
    let accessor = &json["accessors"][index(accessor)];
    let view = &json["bufferViews"][index(&accessor["bufferView"])];
    let start = view["byteOffset"]
        .as_u64()
        .map_or(0, |n| usize::try_from(n).unwrap());
    let bytes = &bytes[start..start + index(&view["byteLength"])];
    match accessor["componentType"].as_u64().unwrap() {
        5121 => bytes.iter().map(|&x| f64::from(x)).collect(),
        5123 => bytes
            .as_chunks()
            .0
            .iter()
            .map(|&x| f64::from(u16::from_le_bytes(x)))
            .collect(),
        5126 => bytes
            .as_chunks()
            .0
            .iter()
            .map(|&x| f64::from(f32::from_le_bytes(x)))
            .collect(),
        other => panic!("{other}"),
    }
}

/// Converts a document to a form that does not depend on the order and the indices of its parts. Nodes are listed by
/// name, and each corner of a mesh has its joints sorted by weight.
fn canonical(json: &Value, bytes: &[u8]) -> Value {
    let name = |node: &Value| match node.as_u64() {
        Some(_) => json["nodes"][index(node)]["name"].clone(),
        None => Value::Null,
    };
    let floats = |accessor: &Value| match accessor.as_u64() {
        Some(_) => json!(numbers(json, bytes, accessor)),
        None => Value::Null,
    };
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let skins = list(&json["skins"]);
    let skins = skins.iter().map(|skin| {
        let joints: Vec<Value> = list(&skin["joints"]).iter().map(name).collect();
        json!([
            skin["name"],
            joints,
            floats(&skin["inverseBindMatrices"]),
            name(&skin["skeleton"]),
            skin["extras"]
        ])
    });
    let animations = list(&json["animations"]);
    let animations = animations.iter().map(|animation| {
        let channels = list(&animation["channels"]);
        let channels = channels.iter().map(|channel| {
            let sampler = &animation["samplers"][index(&channel["sampler"])];
            let interpolation = sampler["interpolation"]
                .as_str()
                .unwrap_or("LINEAR")
                .to_owned();
            json!([
                name(&channel["target"]["node"]),
                channel["target"]["path"],
                channel["extras"],
                floats(&sampler["input"]),
                floats(&sampler["output"]),
                interpolation,
                sampler["extras"],
            ])
        });
        json!([
            animation["name"],
            channels.collect::<Vec<_>>(),
            animation["extras"]
        ])
    });
    let meshes = list(&json["meshes"]);
    let meshes = meshes.iter().map(|mesh| {
        let primitive = &mesh["primitives"][0];
        let get = |name: &str| numbers(json, bytes, &primitive["attributes"][name]);
        let (points, joints, weights) = (get("POSITION"), get("JOINTS_0"), get("WEIGHTS_0"));
        let targets: Vec<Vec<f64>> = list(&primitive["targets"])
            .iter()
            .map(|target| numbers(json, bytes, &target["POSITION"]))
            .collect();
        let corners = numbers(json, bytes, &primitive["indices"]);
        let corners = corners.iter().map(|v| {
            let v: usize = v.to_string().parse().unwrap();
            let mut bound: Vec<(f64, f64)> = (4 * v..4 * v + 4)
                .filter(|&i| weights[i] > 0.0)
                .map(|i| (weights[i], joints[i]))
                .collect();
            bound.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.total_cmp(&b.1)));
            let three = |values: &[f64]| values[3 * v..3 * v + 3].to_vec();
            json!([
                three(&points),
                bound,
                targets.iter().map(|t| three(t)).collect::<Vec<_>>()
            ])
        });
        json!([
            mesh["name"],
            mesh["extras"],
            mesh["weights"]
                .as_array()
                .map(|w| w.iter().map(Value::as_f64).collect::<Vec<_>>()),
            corners.collect::<Vec<_>>()
        ])
    });
    let nodes = list(&json["nodes"]);
    let mut nodes: Vec<Value> = nodes
        .iter()
        .map(|node| {
            let skin = node["skin"]
                .as_u64()
                .map(|_| json["skins"][index(&node["skin"])]["name"].clone());
            let weights: Vec<f64> = list(&node["weights"])
                .iter()
                .map(|w| w.as_f64().unwrap())
                .collect();
            let children: Vec<Value> = list(&node["children"]).iter().map(name).collect();
            json!([node["name"], children, skin, weights, node["extras"]])
        })
        .collect();
    nodes.sort_by_key(Value::to_string);
    json!([
        nodes,
        skins.collect::<Vec<_>>(),
        animations.collect::<Vec<_>>(),
        meshes.collect::<Vec<_>>()
    ])
}

fn bytes_of(json: &Value) -> Vec<u8> {
    crate::gltf_read::bytes_of_uri(json["buffers"][0]["uri"].as_str().unwrap())
}

#[test]
fn an_asset_that_no_step_touched_keeps_skin_targets_and_animations() {
    let scene = arm_scene();
    let (json, bytes, losses) = output(&scene);
    assert_eq!(losses, Vec::<String>::new());
    let (before, after) = (
        canonical(&arm(), &bytes_of(&arm())),
        canonical(&json, &bytes),
    );
    assert_eq!(before.to_string(), after.to_string());
    let folder = Folder::new();
    for extension in ["glb", "gltf", "mws"] {
        let path = folder.path("a").with_extension(extension);
        mesh_io::write(&Disk, &path, &scene, &WriteOptions::default()).unwrap();
        let peek = mesh_io::peek(&Disk, &path, &mesh_io::ReadOptions::default()).unwrap();
        let expected = match extension {
            "mws" => scene.graph().clone(),
            _ => crate::peeks::without_numbers(scene.graph()),
        };
        assert_eq!(peek.graph, expected, "{extension}");
        let back = scene_of(crate::read(&path).unwrap());
        assert_eq!(back.digest(), scene.digest(), "{extension}");
        assert_eq!(back, scene, "{extension}");
    }
    // The weights of the node are removed, because the validator would report that they replace the weights of the
    // mesh.
    let valid = changed_scene(|j| drop(j["nodes"][4].as_object_mut().unwrap().remove("weights")));
    written("rigged_arm", &valid);
}

#[test]
fn weights_and_deltas_become_vertex_attributes() {
    let scene = arm_scene();
    let mesh = scene.objects()[0].as_mesh().unwrap();
    assert_eq!(mesh.n_vertices(), 4 * RINGS);
    let attributes = mesh.attributes();
    let weights = |joint: usize| &attributes.joints()[joint].1[8..12];
    assert_eq!(
        [weights(0), weights(1), weights(2)],
        [[0.25; 4], [0.5; 4], [0.25; 4]]
    );
    assert_eq!(attributes.morphs()[1].1[2], DVec3::new(0.25, 0.0, -0.25));
    let names: Vec<_> = attributes.iter().map(|(_, c)| c.name.clone()).collect();
    let expected = [
        joint_name(0),
        joint_name(1),
        joint_name(2),
        morph_name(0),
        morph_name(1),
    ];
    assert_eq!(names, expected);
}

/// Computes the points of the posed arm directly from the definitions in the glTF specification.
fn posed_by_hand(scene: &Scene, turn: &DAffine3) -> Vec<DVec3> {
    let mesh = scene.objects()[0].as_mesh().unwrap();
    let at = |x: f64, y: f64| DAffine3::from_translation(DVec3::new(x, y, 0.0));
    let shoulder = at(3.0, 0.0) * DAffine3::from_quat(glam::DQuat::from_xyzw(0.0, 0.0, 0.6, 0.8));
    let elbow = shoulder * at(0.0, 0.5) * *turn;
    let hand = elbow * at(0.0, 1.0);
    let maps = [shoulder, elbow * at(0.0, -0.5), hand * at(0.0, -1.5)];
    let (joints, morphs) = (mesh.attributes().joints(), mesh.attributes().morphs());
    let point = |v: usize| {
        let p = mesh.positions()[v] + 0.5 * morphs[1].1[v];
        joints
            .iter()
            .map(|(j, weights)| weights[v] * maps[*j].transform_point3(p))
            .sum()
    };
    (0..mesh.n_vertices()).map(point).collect()
}

#[test]
fn instances_have_the_pose_of_the_joints_and_the_weights_of_the_node() {
    let scene = arm_scene();
    let placed = scene.placed();
    let expected = posed_by_hand(&scene, &DAffine3::IDENTITY);
    let mesh = placed.objects()[0].as_mesh().unwrap();
    for (p, q) in mesh.positions().iter().zip(&expected) {
        assert!(p.distance(*q) < 1e-7, "{p} {q}");
    }
    let baked = crate::gltf_read::read_baked(&arm()).unwrap();
    let notes: Vec<String> = baked
        .notes
        .iter()
        .map(|n| format!("{} {}", n.count, n.what))
        .collect();
    assert_eq!(
        notes,
        [
            "2 animations left out",
            "1 skins left out: the meshes have the pose of the joints"
        ]
    );
    let mesh = baked.objects[0].as_mesh().unwrap();
    assert!(mesh.attributes().joints().is_empty());
    for (p, q) in mesh.positions().iter().zip(&expected) {
        assert!(p.distance(*q) < 1e-7, "{p} {q}");
    }
}

#[test]
fn coincident_vertices_with_different_weights_are_not_merged() {
    let mut json = arm();
    // Two triangles without indices replace the mesh of the arm. Two pairs of their vertices coincide, and all vertices
    // have the same weights.
    let mut a = Accessors::default();
    let points = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
    ];
    let position = a.floats(&points.into_flattened_vec(), "VEC3");
    let joints = a.add(&[0; 24], 5121, "VEC4", 6);
    a.list[joints]["normalized"] = json!(false);
    let bind = |weights: [[u8; 4]; 6], a: &mut Accessors| {
        a.add(&weights.into_flattened_vec(), 5121, "VEC4", 6)
    };
    let weights = bind([[255, 0, 0, 0]; 6], &mut a);
    json["meshes"][0]["primitives"] = json!([{
        "attributes": { "POSITION": position, "JOINTS_0": joints, "WEIGHTS_0": weights },
    }]);
    json["skins"][0]
        .as_object_mut()
        .unwrap()
        .remove("inverseBindMatrices");
    json["animations"] = json!([]);
    json["nodes"][4].as_object_mut().unwrap().remove("weights");
    let build = |a: Accessors, json: &Value| {
        let loaded = read_json(&a.finish(json.clone())).unwrap();
        scene_of(loaded).objects()[0]
            .as_mesh()
            .unwrap()
            .as_ref()
            .clone()
    };
    let list = a.list.clone();
    let equal = build(
        Accessors {
            list,
            bytes: a.bytes.clone(),
            views: a.views.clone(),
        },
        &json,
    );
    assert_eq!((equal.n_vertices(), equal.n_edges()), (4, 5));
    // The first point belongs to two vertices. The second of these vertices now follows another joint, so the two
    // vertices are not merged.
    let offset = index(&a.views[joints]["byteOffset"]);
    a.bytes[offset + 16] = 1;
    let split = build(a, &json);
    // The triangles now share only one vertex and no edge. Reading splits this vertex, so the two triangles have six
    // vertices.
    assert_eq!((split.n_vertices(), split.n_edges()), (6, 6));
}

trait Flat<T> {
    fn into_flattened_vec(self) -> Vec<T>;
}

impl<T: Clone, const N: usize, const M: usize> Flat<T> for [[T; N]; M] {
    fn into_flattened_vec(self) -> Vec<T> {
        self.concat()
    }
}
