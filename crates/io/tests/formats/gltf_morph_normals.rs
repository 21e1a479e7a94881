//! Tests of morph targets that change normals.

use glam::DVec3;
use mesh::{CORNER_NORMAL, Domain, Rule, VERTEX_NORMAL, Value as _, morph_name, morph_normal_name};
use mesh_io::WriteOptions;
use scene::{Geometry, Scene};
use serde_json::{Value, json};
use store::Disk;

use crate::Folder;
use crate::gltf_read::{read_baked, read_json};
use crate::gltf_rig::Accessors;

/// Returns a document with two triangles that share an edge but no vertices. The vertices have the given normals, and a
/// morph target adds `changes` to them.
fn folded(normals: [[f32; 3]; 6], changes: Option<[[f32; 3]; 6]>) -> Value {
    let mut a = Accessors::default();
    let corners = [
        [0., 0., 0.],
        [1., 0., 0.],
        [1., 1., 0.],
        [0., 0., 0.],
        [1., 1., 0.],
        [0., 1., 1.],
    ];
    let position = a.floats(corners.as_flattened(), "VEC3");
    let normal = a.floats(normals.as_flattened(), "VEC3");
    let moves = a.floats(&[0.25; 18], "VEC3");
    let mut target = json!({ "POSITION": moves });
    if let Some(changes) = changes {
        target["NORMAL"] = a.floats(changes.as_flattened(), "VEC3").into();
    }
    a.finish(json!({
        "asset": { "version": "2.0" },
        "nodes": [{ "mesh": 0 }], "scenes": [{ "nodes": [0] }], "scene": 0,
        "meshes": [{ "primitives": [{
            "attributes": { "POSITION": position, "NORMAL": normal }, "targets": [target],
        }] }],
    }))
}

pub(crate) fn scene(json: &Value) -> Scene {
    let loaded = read_json(json).unwrap();
    assert_eq!(loaded.notes, []);
    let mut scene = Scene::new();
    scene.append(loaded.objects, loaded.graph).unwrap();
    scene
}

pub(crate) fn only_mesh(scene: &Scene) -> &mesh::Mesh {
    scene.objects()[0].as_mesh().unwrap()
}

/// Writes a scene and reads it again.
pub(crate) fn written(scene: &Scene) -> Scene {
    let folder = Folder::new();
    let path = folder.path("a.glb");
    let report = mesh_io::write(&Disk, &path, scene, &WriteOptions::default()).unwrap();
    assert_eq!(report.losses, []);
    let loaded = crate::read(&path).unwrap();
    let mut back = Scene::new();
    back.append(loaded.objects, loaded.graph).unwrap();
    back
}

#[test]
fn changes_of_normals_become_normals_and_are_written_with_the_same_bits() {
    // These numbers use all bits of a 32-bit float, so any rounding changes them.
    let normals = [[0.6, 0.0, 0.8]; 6];
    let changes = [[-0.1, 0.123_456_79, 1e-3]; 6];
    let scene = scene(&folded(normals, Some(changes)));
    let column = |domain| {
        only_mesh(&scene)
            .attributes()
            .column(domain, &morph_normal_name(0))
    };
    assert_eq!(column(Domain::Corner), None);
    let column = column(Domain::Vertex).unwrap();
    assert_eq!(column.rule, Rule::Normal);
    let [normal, change] = [normals[0], changes[0]].map(|v| DVec3::from(v.map(f64::from)));
    assert_eq!(DVec3::of(&column.values).unwrap(), [normal + change; 4]);
    let back = written(&scene);
    assert_eq!(back.objects(), scene.objects());
}

#[test]
fn changes_that_differ_along_a_seam_stay_on_the_corners() {
    let normals = [[0.0, 0.0, 1.0]; 6];
    let mut changes = [[0.5, 0.0, 0.0]; 6];
    changes[5] = [0.0, 0.5, 0.0];
    changes[3] = [0.0, 0.0, 0.0];
    let scene = scene(&folded(normals, Some(changes)));
    let mesh = only_mesh(&scene);
    assert!(mesh.get(VERTEX_NORMAL).is_some() && mesh.n_vertices() == 4);
    let column = mesh
        .attributes()
        .column(Domain::Corner, &morph_normal_name(0));
    let values = DVec3::of(&column.unwrap().values).unwrap();
    let of_face = |f: usize| {
        let corners = mesh.face_half_edges(mesh::FaceId::new(f));
        corners
            .map(|h| values[h.index()] - DVec3::Z)
            .collect::<Vec<_>>()
    };
    let y = 0.5 * DVec3::Y;
    let x = 0.5 * DVec3::X;
    assert_eq!(
        [of_face(0), of_face(1)],
        [vec![x, x, x], vec![DVec3::ZERO, x, y]]
    );
    assert_eq!(written(&scene).objects(), scene.objects());
}

#[test]
fn a_primitive_whose_target_has_no_normals_keeps_its_normals() {
    let normals = [[0.0, 0.0, 1.0]; 6];
    let mut json = folded(normals, Some([[0.5, 0.0, 0.0]; 6]));
    let mut second = json["meshes"][0]["primitives"][0].clone();
    second["targets"][0]
        .as_object_mut()
        .unwrap()
        .remove("NORMAL");
    json["meshes"][0]["primitives"]
        .as_array_mut()
        .unwrap()
        .push(second);
    let loaded = read_json(&json).unwrap();
    let mesh = loaded.objects[0].as_mesh().unwrap();
    let columns = mesh.attributes().iter();
    let column = columns
        .map(|(_, c)| c)
        .find(|c| c.name == morph_normal_name(0));
    let values = DVec3::of(&column.unwrap().values).unwrap();
    assert!(values.contains(&DVec3::Z));
    assert!(values.contains(&DVec3::new(0.5, 0.0, 1.0)));
}

/// The transform of a node changes the normals of a morph target in the same way as the normals of a mesh.
#[test]
fn a_node_transforms_changed_normals_like_normals() {
    let normals = [[0.6, 0.0, 0.8]; 6];
    for scale in [[1.0, 2.0, 3.0], [-1.0, 2.0, 3.0]] {
        let read = |normals, changes| {
            let mut json = folded(normals, changes);
            json["nodes"][0]["scale"] = json!(scale);
            let baked = read_baked(&json).unwrap();
            let placed = scene(&json).placed().into_owned();
            [baked.objects[0].clone(), placed.objects()[0].clone()]
        };
        let changed = read(normals, Some([[-0.6, 0.6, 0.0]; 6]));
        let plain = read([[0.0, 0.6, 0.8]; 6], None);
        for (changed, plain) in changed.iter().zip(&plain) {
            let [changed, plain] = [changed, plain].map(|object| object.as_mesh().unwrap());
            let column = changed
                .attributes()
                .column(Domain::Vertex, &morph_normal_name(0));
            let found = DVec3::of(&column.unwrap().values).unwrap();
            for (found, expected) in found.iter().zip(plain.get(VERTEX_NORMAL).unwrap()) {
                assert!(
                    found.distance(*expected) < 1e-6,
                    "{scale:?}: {found} {expected}"
                );
            }
        }
    }
}

#[test]
fn changed_normals_without_normals_or_without_the_target_are_reported_as_lost() {
    let scene = scene(&folded([[0.0, 0.0, 1.0]; 6], Some([[0.5, 0.0, 0.0]; 6])));
    let losses = |name: &str, change: &dyn Fn(&mut mesh::Mesh)| {
        let mut object = scene.objects()[0].clone();
        let mut mesh = mesh::Mesh::clone(object.as_mesh().unwrap());
        change(&mut mesh);
        object.geometry = Geometry::Mesh(mesh.into());
        let folder = Folder::new();
        let losses = crate::write(&folder.path(name), [object]).losses;
        losses
            .into_iter()
            .map(|loss| loss.attribute)
            .collect::<Vec<_>>()
    };
    let lost = morph_normal_name(0);
    assert_eq!(losses("a.glb", &|_| ()), [""; 0]);
    let without_normals = |mesh: &mut mesh::Mesh| {
        mesh.remove_column(Domain::Vertex, VERTEX_NORMAL.name);
        mesh.remove_column(Domain::Corner, CORNER_NORMAL.name);
    };
    assert_eq!(losses("a.glb", &without_normals), [&*lost]);
    let without_target = |mesh: &mut mesh::Mesh| {
        mesh.remove_column(Domain::Vertex, &morph_name(0));
    };
    assert_eq!(losses("a.glb", &without_target), [&*lost]);
    assert!(losses("a.obj", &|_| ()).contains(&lost));
    let zero = |mesh: &mut mesh::Mesh| {
        let mut column = mesh.remove_column(Domain::Vertex, &lost).unwrap();
        column.values = DVec3::wrap(vec![DVec3::ZERO; 4]);
        mesh.insert_column(Domain::Vertex, column);
    };
    assert_eq!(losses("a.glb", &zero), [&*lost]);
}

#[test]
fn a_wrong_number_of_changed_normals_is_an_error_that_says_where() {
    let mut json = folded([[0.0, 0.0, 1.0]; 6], Some([[0.5, 0.0, 0.0]; 6]));
    json["accessors"][3]["count"] = json!(5);
    let error = read_json(&json).unwrap_err().to_string();
    assert!(
        error.contains("/meshes/0/primitives/0/targets/0/NORMAL"),
        "{error}"
    );
    assert!(
        error.contains("expected 6 elements, one for each position, found 5"),
        "{error}"
    );
}

/// A pose blends the normals of the mesh and the normals of the morph targets according to the weights of the targets.
#[test]
fn a_pose_blends_the_normals_of_targets() {
    let normals = [[0.6, 0.0, 0.8]; 6];
    let mut changes = [[-0.6, 0.6, 0.0]; 6];
    // If the changes differ between two corners of the same vertex, the blended normals are stored for each corner.
    for is_seam in [false, true] {
        if is_seam {
            changes[5] = [0.0, 0.8, -0.8];
            changes[4] = [0.0, 0.0, 0.0];
        }
        let mut json = folded(normals, Some(changes));
        json["meshes"][0]["weights"] = json!([0.5]);
        let placed = scene(&json).placed().into_owned();
        let baked = read_baked(&json).unwrap();
        for mesh in [only_mesh(&placed), baked.objects[0].as_mesh().unwrap()] {
            let vertex = mesh.get(VERTEX_NORMAL);
            let corner = mesh.get(CORNER_NORMAL);
            assert_eq!(corner.is_some(), is_seam);
            for f in mesh.faces() {
                for (i, h) in mesh.face_half_edges(f).enumerate() {
                    let k = 3 * f.index() + i;
                    let [own, change] =
                        [normals, changes].map(|v| DVec3::from(v[k].map(f64::from)));
                    let expected = (own + 0.5 * change).normalize();
                    let v = mesh.origin(h).index();
                    let found = corner.map_or_else(|| vertex.unwrap()[v], |c| c[h.index()]);
                    assert!(
                        found.distance(expected) < 1e-6,
                        "{f} {i}: {found} {expected}"
                    );
                    // The difference between the normal of the morph target and the normal of the mesh is the same as
                    // before.
                    let target = mesh
                        .attributes()
                        .iter()
                        .find(|(_, c)| c.name == morph_normal_name(0));
                    let (domain, column) = target.unwrap();
                    let at = if domain == Domain::Corner {
                        h.index()
                    } else {
                        v
                    };
                    let target = DVec3::of(&column.values).unwrap()[at];
                    assert!((target - found).distance(change) < 1e-6, "{target} {found}");
                }
            }
        }
    }
}
