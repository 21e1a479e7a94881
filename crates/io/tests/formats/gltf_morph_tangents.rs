//! Tests of morph targets that change tangents.

use glam::DVec4;
use mesh::{CORNER_TANGENT, Domain, Value as _, morph_tangent_name};
use serde_json::{Value, json};

use crate::gltf_morph_normals::{only_mesh, scene, written};
use crate::gltf_read::{read_baked, read_json};
use crate::gltf_rig::Accessors;

/// Returns a document with a triangle whose corners have these tangents. Morph targets add `changes` to the tangents.
fn triangle(tangents: [[f32; 4]; 3], changes: &[[[f32; 3]; 3]]) -> Value {
    let mut a = Accessors::default();
    let position = a.floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0.], "VEC3");
    let normal = a.floats([[0.0, 0.0, 1.0]; 3].as_flattened(), "VEC3");
    let tangent = a.floats(tangents.as_flattened(), "VEC4");
    let targets = changes.iter().map(|changes| {
        let moves = a.floats(&[0.25; 9], "VEC3");
        let changes = a.floats(changes.as_flattened(), "VEC3");
        json!({ "POSITION": moves, "TANGENT": changes })
    });
    let targets: Vec<Value> = targets.collect();
    a.finish(json!({
        "asset": { "version": "2.0" },
        "nodes": [{ "mesh": 0 }], "scenes": [{ "nodes": [0] }], "scene": 0,
        "meshes": [{ "primitives": [{
            "attributes": { "POSITION": position, "NORMAL": normal, "TANGENT": tangent }, "targets": targets,
        }] }],
    }))
}

/// Returns the tangents of the mesh or of a morph target at the corners of the face.
fn tangents(mesh: &mesh::Mesh, name: &str) -> Vec<DVec4> {
    let column = mesh.attributes().column(Domain::Corner, name).unwrap();
    let values = DVec4::of(&column.values).unwrap();
    let corners = mesh.face_half_edges(mesh::FaceId::new(0));
    corners.map(|h| values[h.index()]).collect()
}

const TANGENTS: [[f32; 4]; 3] = [
    [1.0, 0.0, 0.0, 1.0],
    [0.6, 0.8, 0.0, 1.0],
    [0.0, 1.0, 0.0, -1.0],
];

#[test]
fn changes_of_tangents_become_tangents_and_are_written_with_the_same_bits() {
    // These numbers use all bits of a 32-bit float, so any rounding changes them.
    let changes = [[-0.1, 0.123_456_79, 1e-3]; 3];
    let scene = scene(&triangle(TANGENTS, &[changes, [[0.0, 0.5, 0.0]; 3]]));
    let mesh = only_mesh(&scene);
    let own = tangents(mesh, CORNER_TANGENT.name);
    let change = DVec4::from([-0.1_f32, 0.123_456_79, 1e-3, 0.0].map(f64::from));
    let expected: Vec<DVec4> = own.iter().map(|tangent| tangent + change).collect();
    assert_eq!(tangents(mesh, &morph_tangent_name(0)), expected);
    let column = mesh
        .attributes()
        .column(Domain::Corner, &morph_tangent_name(1));
    assert_eq!(column.unwrap().rule, CORNER_TANGENT.rule);
    assert_eq!(written(&scene).objects(), scene.objects());
}

/// The transform of a node changes the tangents of a morph target in the same way as the tangents of a mesh.
#[test]
fn a_node_transforms_changed_tangents_like_tangents() {
    let changed = [
        [0.0, 1.0, 0.0, 1.0],
        [0.8, 0.6, 0.0, 1.0],
        [1.0, 0.0, 0.0, -1.0],
    ];
    let changes: [[f32; 3]; 3] =
        std::array::from_fn(|i| std::array::from_fn(|k| changed[i][k] - TANGENTS[i][k]));
    for scale in [[1.0, 2.0, 3.0], [-1.0, 2.0, 3.0]] {
        let read = |json: &Value| {
            let mut json = json.clone();
            json["nodes"][0]["scale"] = json!(scale);
            let baked = read_baked(&json).unwrap();
            let placed = scene(&json).placed().into_owned();
            [baked.objects[0].clone(), placed.objects()[0].clone()]
        };
        let found = read(&triangle(TANGENTS, &[changes]));
        let expected = read(&triangle(changed, &[]));
        for (found, expected) in found.iter().zip(&expected) {
            let [found, expected] = [found, expected].map(|object| object.as_mesh().unwrap());
            let found = tangents(found, &morph_tangent_name(0));
            let expected = tangents(expected, CORNER_TANGENT.name);
            for (found, expected) in found.iter().zip(&expected) {
                assert!(
                    found.distance(*expected) < 1e-6,
                    "{scale:?}: {found} {expected}"
                );
            }
        }
    }
}

/// A pose blends the tangents of the mesh and the tangents of the morph targets according to the weights of the
/// targets.
#[test]
fn a_pose_blends_the_tangents_of_targets() {
    let changes = [[[-0.5, 0.5, 0.25]; 3], [[0.0, 0.0, 1.0]; 3]];
    let mut json = triangle(TANGENTS, &changes);
    json["meshes"][0]["weights"] = json!([0.5, 0.25]);
    let placed = scene(&json).placed().into_owned();
    let baked = read_baked(&json).unwrap();
    for mesh in [only_mesh(&placed), baked.objects[0].as_mesh().unwrap()] {
        let found = tangents(mesh, CORNER_TANGENT.name);
        let target = tangents(mesh, &morph_tangent_name(0));
        for ((found, target), own) in found.iter().zip(&target).zip(TANGENTS) {
            let own = DVec4::from(own.map(f64::from));
            let sum = own.truncate() + glam::DVec3::new(-0.25, 0.25, 0.125 + 0.25);
            let expected = sum.normalize().extend(own.w);
            assert!(found.distance(expected) < 1e-6, "{found} {expected}");
            // The difference between the tangent of the morph target and the tangent of the mesh is the same as before.
            let change = DVec4::new(-0.5, 0.5, 0.25, 0.0);
            assert!((target - found).distance(change) < 1e-6, "{target} {found}");
        }
    }
}

#[test]
fn a_wrong_number_of_changed_tangents_is_an_error_that_says_where() {
    let mut json = triangle(TANGENTS, &[[[0.5, 0.0, 0.0]; 3]]);
    json["accessors"][4]["count"] = json!(2);
    let error = read_json(&json).unwrap_err().to_string();
    assert!(
        error.contains("/meshes/0/primitives/0/targets/0/TANGENT"),
        "{error}"
    );
}

#[test]
fn changed_tangents_are_lost_with_the_tangents_when_the_shape_changes() {
    let scene = scene(&triangle(TANGENTS, &[[[0.5, 0.0, 0.0]; 3]]));
    let mut mesh = only_mesh(&scene).clone();
    mesh.remove_normals();
    let names: Vec<_> = mesh.attributes().iter().map(|(_, c)| &*c.name).collect();
    assert_eq!(names, ["morph:0"]);
}
