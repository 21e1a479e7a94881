//! Tests of COLLADA files with elements other than geometry, such as nodes and libraries.

use geometry::shapes;
use glam::{DVec2, DVec3};
use mesh::{FaceId, UV, VERTEX_NORMAL};
use mesh_io::{PeekGeometry, ReadOptions};
use scene::Object;

use crate::dae_read::{CUBE, VERTEX, file, loaded, mesh, notes, only};
use crate::{Folder, assert_same, polygons, read};

#[test]
fn transforms_apply_from_the_last_to_the_first() {
    for (transforms, x, to) in [
        (
            "<translate>1 2 3</translate><scale>2 3 4</scale>",
            DVec3::ONE,
            DVec3::new(3.0, 5.0, 7.0),
        ),
        (
            "<scale>2 3 4</scale><translate>1 2 3</translate>",
            DVec3::ONE,
            DVec3::new(4.0, 9.0, 16.0),
        ),
        (
            "<rotate>0 0 2 90</rotate>",
            DVec3::ONE,
            DVec3::new(-1.0, 1.0, 1.0),
        ),
        (
            "<rotate>1 0 0 -90</rotate>",
            DVec3::ONE,
            DVec3::new(1.0, 1.0, -1.0),
        ),
        (
            "<rotate>1 1 1 120</rotate>",
            DVec3::new(1.0, -1.0, 1.0),
            DVec3::new(1.0, 1.0, -1.0),
        ),
        ("<rotate>0 0 0 30</rotate>", DVec3::ONE, DVec3::ONE),
        (
            "<matrix>1 0 0 5  0 2 0 6  0 0 3 7  0 0 0 1</matrix>",
            DVec3::ONE,
            DVec3::new(6.0, 8.0, 10.0),
        ),
        (
            "<lookat>0 0 9  0 0 0  0 1 0</lookat>",
            DVec3::ONE,
            DVec3::new(1.0, 1.0, 10.0),
        ),
        (
            "<lookat>9 0 0  0 0 0  0 1 0</lookat>",
            DVec3::ONE,
            DVec3::new(10.0, 1.0, -1.0),
        ),
    ] {
        let mesh = mesh(&file(CUBE, transforms));
        let v = shapes::cube()
            .vertices()
            .find(|v| shapes::cube().position(*v) == x)
            .unwrap();
        assert!(
            mesh.position(v).distance(to) < 1e-12,
            "{transforms}: {}",
            mesh.position(v)
        );
    }
    let skew = "<skew>45 1 0 0 0 1 0</skew>";
    assert_eq!(
        notes(&file(CUBE, skew)),
        ["Some(44): 1 skews of nodes left out"]
    );
}

#[test]
fn a_mirror_reverses_faces_and_their_values() {
    let list = r##"<triangles><input semantic="VERTEX" source="#at-vertices" offset="0"/>
        <input semantic="TEXCOORD" source="#uvs" offset="1"/><input semantic="NORMAL" source="#normals" offset="2"/>
        <p>0 0 1  2 1 1  3 2 1</p></triangles>"##;
    let mesh = mesh(&file(list, "<scale>-1 1 2</scale>"));
    assert_eq!(polygons(&mesh), [[0, 3, 2]]);
    let uv = mesh.get(UV).unwrap();
    let uvs: Vec<DVec2> = mesh
        .face_half_edges(FaceId::new(0))
        .map(|h| uv[h.index()])
        .collect();
    assert_eq!(
        uvs,
        [DVec2::new(0.0, 0.25), DVec2::ONE, DVec2::new(1.0, 0.5)]
    );
    assert_eq!(mesh.get(VERTEX_NORMAL).unwrap()[0], DVec3::NEG_X);
}

#[test]
fn nodes_can_be_nested_and_repeated_and_get_unique_names() {
    let text = file(CUBE, "").replace(
        r#"<visual_scene id="scene">"#,
        r##"<visual_scene id="scene"><node name="group"><translate>10 0 0</translate>
            <node name="box"><translate>0 5 0</translate><instance_geometry url="#shape-mesh"/>
              <node id="inner"><instance_node url="#part"/></node></node></node>"##,
    );
    let text = text.replace(
        "<library_visual_scenes>",
        r##"<library_nodes><node id="part"><translate>0 0 1</translate><instance_geometry url="#shape-mesh"/>
            </node></library_nodes><library_visual_scenes>"##,
    );
    let loaded = loaded(&text);
    let names: Vec<&str> = loaded.objects.iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["box", "part", "box.2"]);
    let start = |o: &Object| o.as_mesh().unwrap().positions()[0];
    let starts: Vec<DVec3> = loaded.objects.iter().map(start).collect();
    assert_eq!(
        starts,
        [
            DVec3::new(9.0, 4.0, -1.0),
            DVec3::new(9.0, 4.0, 0.0),
            DVec3::NEG_ONE
        ]
    );
}

#[test]
fn skins_and_other_libraries_are_counted() {
    let text = file(CUBE, "").replace(
        r##"<instance_geometry url="#shape-mesh">"##,
        r##"<instance_controller url="#morph"/><instance_geometry url="#shape-mesh">"##,
    );
    let text = text.replace(
        "<library_visual_scenes>",
        r##"<library_controllers><controller id="skin"><skin source="#shape-mesh"/></controller>
            <controller id="morph"><morph source="#skin"/></controller></library_controllers>
            <library_cameras><camera id="c"/></library_cameras>
            <library_animations><animation/><animation/></library_animations>
            <library_geometries><geometry id="unused"/></library_geometries>
            <library_visual_scenes><visual_scene id="other"/></library_visual_scenes>
            <library_visual_scenes>"##,
    );
    assert_eq!(loaded(&text).objects.len(), 2);
    let notes: Vec<String> = notes(&text)
        .iter()
        .map(|n| n.split_once(": ").unwrap().1.to_owned())
        .collect();
    assert_eq!(
        notes,
        [
            "1 other scenes left out",
            "1 geometries left out: not used by any node of the scene",
            "1 node named `box` renamed to `box.2`, because another node is named `box`",
            "2 animations left out",
            "1 cameras left out",
            "2 skins and morphs left out: geometries have their rest pose",
        ]
    );
}

#[test]
fn coordinates_are_unchanged_and_the_unit_is_noted() {
    let text = file(CUBE, "")
        .replace(
            r#"<unit meter="1"/>"#,
            r#"<unit name="inch" meter="0.0254"/>"#,
        )
        .replace("Y_UP", "Z_UP");
    assert_eq!(
        notes(&text),
        ["Some(3): 1 coordinate system kept as in the file: up_axis Z_UP, one unit is 0.0254 m"]
    );
    assert_same(loaded(&text).objects[0].as_mesh().unwrap(), &shapes::cube());
}

#[test]
fn without_a_scene_each_geometry_is_an_object() {
    let text = file(CUBE, "");
    let (before, rest) = text.split_once("<library_visual_scenes>").unwrap();
    let (_, after) = rest.split_once("</scene>").unwrap();
    assert_eq!(only(&format!("{before}{after}")).name, "shape");
}

#[test]
fn latin1_text_is_read() {
    let text = file(CUBE, "").replace("name=\"box\"", "name=\"caf\u{e9}\"");
    let bytes: Vec<u8> = text
        .chars()
        .map(|c| u8::try_from(u32::from(c)).unwrap())
        .collect();
    let folder = Folder::new();
    let loaded = read(&folder.with("a.dae", bytes)).unwrap();
    assert_eq!(loaded.objects[0].name, "café");
}

#[test]
fn peeking_counts_what_reading_gives() {
    let folder = Folder::new();
    let path = folder.with("a.dae", file(CUBE, ""));
    let peek = mesh_io::peek(&store::Disk, &path, &ReadOptions::default()).unwrap();
    assert_eq!(peek.objects[0].name, "box");
    let PeekGeometry::Mesh(counts) = peek.objects[0].geometry else {
        panic!("{peek:?}");
    };
    assert_eq!((counts.vertices, counts.faces, counts.corners), (8, 6, 24));
    assert_eq!(
        (counts.min_degree, counts.max_degree, counts.materials),
        (4, 4, false)
    );
}

/// Returns the triangles in order, each as a list of three positions.
fn triangles_of(loader: &mesh_loader::Mesh) -> Vec<[[f32; 3]; 3]> {
    let triangle = |f: &[u32; 3]| f.map(|v| loader.vertices[v as usize]);
    loader.faces.iter().map(triangle).collect()
}

/// The crate `mesh_loader` reads triangles and polygons, does not apply transforms, and returns positions as `f32`.
#[test]
fn another_reader_finds_the_same_triangles() {
    for (kind, content) in [
        ("triangles", "count=\"2\"|<p>0 1 3 0 3 2</p>"),
        (
            "polylist",
            "count=\"2\"|<vcount>3 3</vcount><p>0 1 3 4 5 7</p>",
        ),
    ] {
        let (count, content) = content.split_once('|').unwrap();
        let text = file(&format!("<{kind} {count}>{VERTEX}{content}</{kind}>"), "");
        let scene = mesh_loader::collada::from_str(&text).unwrap();
        assert_eq!(scene.meshes.len(), 1);
        let ours = mesh(&text);
        let ours: Vec<[[f32; 3]; 3]> = ours
            .faces()
            .map(|f| {
                let at: Vec<[f32; 3]> = ours
                    .face_vertices(f)
                    .map(|v| ours.position(v).as_vec3().to_array())
                    .collect();
                at.try_into().unwrap()
            })
            .collect();
        assert_eq!(triangles_of(&scene.meshes[0]), ours, "{kind}");
    }
}
