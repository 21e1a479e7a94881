//! Tests of morph targets that change texture coordinates and colors.

use glam::{DVec2, DVec4};
use mesh::{COLOR, Domain, UV, Values, morph_value_name};
use mesh_io::WriteOptions;
use serde_json::{Value, json};
use store::Disk;

use crate::Folder;
use crate::gltf_morph_normals::{only_mesh, scene, written};
use crate::gltf_read::{read_baked, read_json};
use crate::gltf_rig::Accessors;

/// The values of a vertex: texture coordinates in the first and in the second set, and a color.
type Row = ([f32; 2], [f32; 2], [f32; 4]);

const OWN: [Row; 6] = [
    ([0.0, 0.0], [0.5, 0.25], [1.0, 0.0, 0.0, 1.0]),
    ([1.0, 0.0], [0.5, 0.25], [0.0, 1.0, 0.0, 1.0]),
    ([1.0, 1.0], [0.5, 0.25], [0.0, 0.0, 1.0, 0.5]),
    ([0.0, 0.5], [0.5, 0.25], [1.0, 0.0, 0.0, 1.0]),
    ([0.5, 1.0], [0.5, 0.25], [0.0, 0.0, 1.0, 0.5]),
    ([0.0, 1.0], [0.5, 0.25], [1.0, 1.0, 0.0, 1.0]),
];

/// The changes that a morph target adds at each vertex. Their numbers use all bits of a 32-bit float. On the two sides
/// of the seam, the changes of the texture coordinates differ.
const CHANGES: [Row; 6] = [
    ([0.1, -0.123_456_79], [0.3, 0.7], [-0.3, 0.1, 0.7, 0.0]),
    ([0.2, 1e-3], [0.3, 0.7], [0.0, -0.9, 0.0, 0.0]),
    ([-7.5, 0.1], [0.3, 0.7], [0.0, 0.25, 0.0, 0.5]),
    ([0.3, 0.3], [0.3, 0.7], [-0.3, 0.1, 0.7, 0.0]),
    ([0.7, 0.0], [0.3, 0.7], [0.0, 0.25, 0.0, 0.5]),
    ([0.0, -0.6], [0.3, 0.7], [0.1, 0.1, 0.1, -0.1]),
];

/// Returns a document with two triangles that share an edge, which is a seam. There are two morph targets. The second
/// one adds these changes to the texture coordinates and colors.
fn folded(changes: &[Row; 6]) -> Value {
    let mut a = Accessors::default();
    let corners: [[f32; 3]; 6] = [
        [0., 0., 0.],
        [1., 0., 0.],
        [1., 1., 0.],
        [0., 0., 0.],
        [1., 1., 0.],
        [0., 1., 1.],
    ];
    let position = a.floats(corners.as_flattened(), "VEC3");
    let moves = a.floats(&[0.25; 18], "VEC3");
    let mut values = |rows: &[Row; 6]| {
        let [uv, uv1] = [rows.map(|row| row.0), rows.map(|row| row.1)];
        let uv = a.floats(uv.as_flattened(), "VEC2");
        let uv1 = a.floats(uv1.as_flattened(), "VEC2");
        let color = a.floats(rows.map(|row| row.2).as_flattened(), "VEC4");
        json!({ "TEXCOORD_0": uv, "TEXCOORD_1": uv1, "COLOR_0": color })
    };
    let mut attributes = values(&OWN);
    attributes["POSITION"] = position.into();
    let target = values(changes);
    a.finish(json!({
        "asset": { "version": "2.0" },
        "nodes": [{ "mesh": 0 }], "scenes": [{ "nodes": [0] }], "scene": 0,
        "meshes": [{ "primitives": [{
            "attributes": attributes, "targets": [{ "POSITION": moves }, target],
        }] }],
    }))
}

/// Returns the values of an attribute at the corners of both triangles.
fn at_corners(mesh: &mesh::Mesh, name: &str) -> Vec<[f64; 4]> {
    let column = |domain| mesh.attributes().column(domain, name);
    let corners = mesh.faces().flat_map(|f| mesh.face_half_edges(f));
    let value = |h: mesh::HalfEdgeId| {
        let (column, i) = match column(Domain::Corner) {
            Some(column) => (column, h.index()),
            None => (column(Domain::Vertex).unwrap(), mesh.origin(h).index()),
        };
        match &column.values {
            Values::Vec2(values) => [values[i].x, values[i].y, 0.0, 0.0],
            Values::Vec4(values) => values[i].to_array(),
            _ => panic!("unexpected type of {name}"),
        }
    };
    corners.map(value).collect()
}

#[test]
fn changes_of_texture_coordinates_and_colors_are_written_with_the_same_bits() {
    let scene = scene(&folded(&CHANGES));
    let mesh = only_mesh(&scene);
    assert_eq!(mesh.n_vertices(), 4);
    let uv = |[u, v]: [f32; 2]| [f64::from(u), -f64::from(v), 0.0, 0.0];
    let expected = CHANGES.map(|row| [uv(row.0), uv(row.1), row.2.map(f64::from)]);
    for (k, changed) in ["uv", "uv1", "color"].into_iter().enumerate() {
        let name = morph_value_name(changed, 1);
        assert_eq!(
            at_corners(mesh, &name),
            expected.map(|row| row[k]),
            "{name}"
        );
    }
    let names: Vec<_> = mesh.attributes().iter().map(|(_, c)| &*c.name).collect();
    assert!(!names.contains(&"morph_uv:0"), "{names:?}");
    // Texture coordinates and their changes are stored for each corner, even if all corners of a vertex have equal
    // values.
    let uv1 = mesh.attributes().column(Domain::Corner, "morph_uv1:1");
    assert!(uv1.is_some(), "{names:?}");
    let back = written(&scene);
    assert_eq!(back.objects(), scene.objects());
}

#[test]
fn a_pose_adds_weighted_changes_and_clamps_colors() {
    let mut json = folded(&CHANGES);
    json["meshes"][0]["weights"] = json!([0.0, 0.5]);
    let placed = scene(&json).placed().into_owned();
    let baked = read_baked(&json).unwrap();
    for mesh in [only_mesh(&placed), baked.objects[0].as_mesh().unwrap()] {
        let (uvs, colors) = (at_corners(mesh, UV.name), at_corners(mesh, COLOR.name));
        for (i, (own, change)) in OWN.iter().zip(CHANGES).enumerate() {
            let [own_uv, change_uv] = [own.0, change.0].map(|uv| DVec2::from(uv.map(f64::from)));
            let sum = own_uv + 0.5 * change_uv;
            let found = DVec2::new(uvs[i][0], 1.0 - uvs[i][1]);
            assert!(found.distance(sum) < 1e-12, "{found} {sum}");
            let [own, change] = [own.2, change.2].map(|color| DVec4::from(color.map(f64::from)));
            let sum = (own + 0.5 * change).clamp(DVec4::ZERO, DVec4::ONE);
            assert!(DVec4::from(colors[i]).distance(sum) < 1e-12);
        }
    }
}

/// If a morph target changes an attribute in only some primitives of a mesh, the changes in the other primitives are 0.
#[test]
fn a_primitive_without_changes_gets_zeros() {
    let mut json = folded(&CHANGES);
    let mut other = json["meshes"][0]["primitives"][0].clone();
    let target = other["targets"][1].as_object_mut().unwrap();
    target.remove("TEXCOORD_0").unwrap();
    json["meshes"][0]["primitives"]
        .as_array_mut()
        .unwrap()
        .push(other);
    let loaded = read_json(&json).unwrap();
    let mesh = loaded.objects[0].as_mesh().unwrap();
    let found = at_corners(mesh, "morph_uv:1");
    assert_eq!(found[6..], [[0.0; 4]; 6]);
    assert!(found[..6].iter().all(|value| *value != [0.0; 4]));
}

#[test]
fn changes_of_attributes_that_the_mesh_has_lost_are_reported() {
    for (lost, domain) in [(COLOR.name, Domain::Vertex), (UV.name, Domain::Corner)] {
        let mut scene = scene(&folded(&CHANGES));
        let name = scene.objects()[0].name.clone();
        let (geometry, _) = scene.parts_mut(&name).unwrap();
        let scene::Geometry::Mesh(mesh) = geometry else {
            panic!("a mesh");
        };
        std::sync::Arc::make_mut(mesh)
            .remove_column(domain, lost)
            .unwrap();
        let folder = Folder::new();
        let path = folder.path("a.glb");
        let report = mesh_io::write(&Disk, &path, &scene, &WriteOptions::default()).unwrap();
        let name = morph_value_name(lost, 1);
        let mut losses = report.losses.iter();
        assert!(
            losses.any(|loss| loss.attribute == name),
            "{:?}",
            report.losses
        );
    }
}

#[test]
fn invalid_changes_are_errors_that_say_where() {
    for (key, accessor) in [("TEXCOORD_0", json!(1)), ("COLOR_0", json!("x"))] {
        let mut json = folded(&CHANGES);
        json["meshes"][0]["primitives"][0]["targets"][1][key] = accessor;
        let error = read_json(&json).unwrap_err().to_string();
        let at = format!("/meshes/0/primitives/0/targets/1/{key}");
        assert!(
            error.contains(&at) || error.contains("/accessors/1"),
            "{error}"
        );
    }
    let mut json = folded(&CHANGES);
    json["accessors"][5]["count"] = json!(2);
    assert!(read_json(&json).is_err());
}
