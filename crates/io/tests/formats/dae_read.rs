//! Tests that compare the result of reading handmade COLLADA files with the expected result.

use geometry::shapes;
use glam::{DVec2, DVec3, DVec4};
use mesh::{CORNER_NORMAL, Domain, FaceId, HalfEdgeId, MATERIAL, Mesh, UV, VERTEX_NORMAL, Values};
use mesh_io::Loaded;
use scene::{AlphaMode, Object, Texture};

use crate::{Folder, assert_same, polygons, read};

/// Returns a file with one geometry that has these lists of polygons, and one node that has these transforms.
pub(crate) fn file(lists: &str, transforms: &str) -> String {
    format!(
        r##"<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit meter="1"/><up_axis>Y_UP</up_axis></asset>
  <library_images><image id="wood"><init_from>maps/wood%20dark.png</init_from></image></library_images>
  <library_materials>
    <material id="red-material" name="red"><instance_effect url="#red-effect"/></material>
    <material id="wood-material" name="wood"><instance_effect url="#wood-effect"/></material>
  </library_materials>
  <library_effects>
    <effect id="red-effect"><profile_COMMON><technique sid="common"><phong>
      <diffuse><color>0.75 0.5 0.25 1</color></diffuse>
      <transparent opaque="A_ONE"><color>1 1 1 0.5</color></transparent><transparency><float>0.5</float></transparency>
    </phong></technique></profile_COMMON></effect>
    <effect id="wood-effect"><profile_COMMON>
      <newparam sid="wood-surface"><surface type="2D"><init_from>wood</init_from></surface></newparam>
      <newparam sid="wood-sampler"><sampler2D><source>wood-surface</source></sampler2D></newparam>
      <technique sid="common"><lambert><diffuse><texture texture="wood-sampler" texcoord="UVMap"/></diffuse></lambert>
    </technique></profile_COMMON></effect>
  </library_effects>
  <library_geometries><geometry id="shape-mesh" name="shape"><mesh>
    <source id="at"><float_array id="at-array" count="24">
      -1 -1 -1  1 -1 -1  -1 1 -1  1 1 -1  -1 -1 1  1 -1 1  -1 1 1  1 1 1</float_array>
      <technique_common><accessor source="#at-array" count="8" stride="3">
        <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
      </accessor></technique_common></source>
    <source id="normals"><float_array id="normals-array" count="6">0 0 1 1 0 0</float_array>
      <technique_common><accessor source="#normals-array" count="2" stride="3">
        <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
      </accessor></technique_common></source>
    <source id="uvs"><float_array id="uvs-array" count="9">9 0 0.25 7 1 0.5 7 1 1</float_array>
      <technique_common><accessor source="#uvs-array" count="3" stride="3" offset="1">
        <param name="S" type="float"/><param name="T" type="float"/><param type="float"/>
      </accessor></technique_common></source>
    <source id="colors"><float_array id="colors-array" count="6">1 0 0 0 1 0</float_array>
      <technique_common><accessor source="#colors-array" count="2" stride="3">
        <param name="R" type="float"/><param name="G" type="float"/><param name="B" type="float"/>
      </accessor></technique_common></source>
    <vertices id="at-vertices"><input semantic="POSITION" source="#at"/></vertices>
    {lists}
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="scene"><node id="node-id" name="box">
    {transforms}
    <instance_geometry url="#shape-mesh"><bind_material><technique_common>
      <instance_material symbol="paint" target="#red-material"/>
      <instance_material symbol="board" target="#wood-material"/>
    </technique_common></bind_material></instance_geometry>
  </node></visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
"##
    )
}

pub(crate) const VERTEX: &str = r##"<input semantic="VERTEX" source="#at-vertices" offset="0"/>"##;

pub(crate) const CUBE: &str = r##"<polylist count="6"><input semantic="VERTEX" source="#at-vertices" offset="0"/>
    <vcount>4 4 4 4 4 4</vcount>
    <p>0 2 3 1  4 5 7 6  0 1 5 4  1 3 7 5  3 2 6 7  2 0 4 6</p></polylist>"##;

pub(crate) fn loaded(text: &str) -> Loaded {
    let folder = Folder::new();
    read(&folder.with("a.dae", text)).unwrap_or_else(|error| panic!("{error}"))
}

pub(crate) fn only(text: &str) -> Object {
    let Loaded {
        mut objects, notes, ..
    } = loaded(text);
    // Some materials name image files that do not exist. The notes about these files are ignored.
    let is_other = |note: &&mesh_io::Note| !note.what.starts_with("image ");
    assert_eq!(notes.iter().find(is_other), None);
    assert_eq!(objects.len(), 1);
    objects.remove(0)
}

pub(crate) fn mesh(text: &str) -> Mesh {
    Mesh::clone(only(text).as_mesh().unwrap())
}

pub(crate) fn notes(text: &str) -> Vec<String> {
    let notes = loaded(text).notes;
    notes
        .into_iter()
        .map(|note| format!("{:?}: {} {}", note.line, note.count, note.what))
        .collect()
}

/// Creates a file whose geometry is one list of polygons with this kind and content. Returns the faces of the file.
pub(crate) fn faces(kind: &str, content: &str) -> Vec<Vec<usize>> {
    polygons(&mesh(&file(
        &format!("<{kind}>{VERTEX}{content}</{kind}>"),
        "",
    )))
}

#[test]
fn a_cube_is_read_exactly() {
    let object = only(&file(CUBE, ""));
    assert_eq!(object.name, "box");
    assert_same(object.as_mesh().unwrap(), &shapes::cube());
}

#[test]
fn each_kind_of_list_gives_its_faces() {
    let square = [vec![0, 1, 3], vec![0, 3, 2]];
    assert_eq!(faces("triangles", "<p>0 1 3 0 3 2</p>"), square);
    assert_eq!(faces("polygons", "<p>0 1 3</p><p>0 3 2</p>"), square);
    assert_eq!(faces("trifans", "<p>0 1 3 2</p>"), square);
    assert_eq!(
        faces("polylist", "<vcount>3 3</vcount><p>0 1 3 0 3 2</p>"),
        square
    );
    assert_eq!(
        faces("tristrips", "<p>0 1 2 3</p><p>4 5 6</p>"),
        [[0, 1, 2], [2, 1, 3], [4, 5, 6]]
    );
}

#[test]
fn holes_are_left_out_and_counted() {
    let list = format!(
        r#"<polygons count="1">{VERTEX}<ph><p>0 1 3 2</p><h>4 5 6</h><h>5 6 7</h></ph></polygons>"#
    );
    let text = file(&list, "");
    assert_eq!(notes(&text), ["Some(39): 2 holes of polygons left out"]);
    let loaded = loaded(&text);
    assert_eq!(
        polygons(loaded.objects[0].as_mesh().unwrap()),
        [[0, 1, 3, 2]]
    );
}

#[test]
fn lines_and_small_polygons_are_left_out_and_counted() {
    let lists = format!(
        r#"{CUBE}<lines count="2">{VERTEX}<p>0 1 2 3</p></lines>
        <polygons count="1">{VERTEX}<p>0 1</p></polygons>"#
    );
    assert_eq!(
        notes(&file(&lists, "")),
        [
            "Some(41): 2 lines and points left out",
            "Some(42): 1 polygons with fewer than 3 corners left out"
        ]
    );
}

#[test]
fn each_input_becomes_a_column_with_its_own_indices() {
    let list = r##"<triangles count="2">
        <input semantic="VERTEX" source="#at-vertices" offset="1"/>
        <input semantic="NORMAL" source="#normals" offset="2"/>
        <input semantic="TEXCOORD" source="#uvs" offset="0" set="3"/>
        <input semantic="TEXCOORD" source="#uvs" offset="2" set="7"/>
        <input semantic="COLOR" source="#colors" offset="2" set="0"/>
        <p>0 0 0  1 1 0  2 3 1   0 0 0  2 3 1  1 2 1</p></triangles>"##;
    let mesh = mesh(&file(list, ""));
    let h: Vec<HalfEdgeId> = mesh.faces().flat_map(|f| mesh.face_half_edges(f)).collect();
    let uv = mesh.get(UV).unwrap();
    let (a, b, c) = (DVec2::new(0.0, 0.25), DVec2::new(1.0, 0.5), DVec2::ONE);
    assert_eq!(
        h.iter().map(|h| uv[h.index()]).collect::<Vec<_>>(),
        [a, b, c, a, c, b]
    );
    let Values::Vec2(second) = &mesh
        .attributes()
        .column(Domain::Corner, "uv1")
        .unwrap()
        .values
    else {
        panic!("uv1 has two components");
    };
    assert_eq!(second[h[2].index()], b);
    // The corners of each vertex have equal normals and colors, so these become vertex attributes.
    let normals = mesh.get(VERTEX_NORMAL).unwrap();
    assert_eq!(normals[mesh.origin(h[0]).index()], DVec3::Z);
    assert_eq!(normals[mesh.origin(h[2]).index()], DVec3::X);
    let color = mesh.get(mesh::COLOR).unwrap();
    assert_eq!(
        color[mesh.origin(h[2]).index()],
        DVec4::new(0.0, 1.0, 0.0, 1.0)
    );
}

#[test]
fn vertex_values_apply_to_all_corners_of_the_vertex() {
    let text = file(CUBE, "").replace(
        r##"<input semantic="POSITION" source="#at"/>"##,
        r##"<input semantic="POSITION" source="#at"/><input semantic="NORMAL" source="#at"/>"##,
    );
    let mesh = mesh(&text);
    let normals = mesh.get(VERTEX_NORMAL).unwrap();
    assert!(
        mesh.vertices()
            .all(|v| normals[v.index()] == mesh.position(v))
    );
}

#[test]
fn lists_without_an_input_get_zeros_and_white() {
    let lists = r##"<triangles><input semantic="VERTEX" source="#at-vertices" offset="0"/><p>0 2 3</p></triangles>
        <triangles><input semantic="VERTEX" source="#at-vertices" offset="0"/>
        <input semantic="NORMAL" source="#normals" offset="1"/>
        <input semantic="COLOR" source="#colors" offset="1"/><p>0 1 3 1 1 1</p></triangles>"##;
    let mesh = mesh(&file(lists, ""));
    let normals = mesh.get(CORNER_NORMAL).unwrap();
    let of = |f: usize| {
        mesh.face_half_edges(FaceId::new(f))
            .map(|h| normals[h.index()])
            .collect::<Vec<_>>()
    };
    assert_eq!(of(0), [DVec3::ZERO; 3]);
    assert_eq!(of(1), [DVec3::X; 3]);
    let colors = mesh.attributes().column(Domain::Corner, "color").unwrap();
    let h = mesh.face_half_edges(FaceId::new(0)).next().unwrap();
    assert_eq!(
        colors.values.gather(1, |_| Some(h.index())),
        Values::Vec4(vec![DVec4::ONE])
    );
}

#[test]
fn materials_are_bound_by_their_symbols() {
    let lists = r##"
        <triangles material="board"><input semantic="VERTEX" source="#at-vertices" offset="0"/><p>0 2 3</p></triangles>
        <triangles><input semantic="VERTEX" source="#at-vertices" offset="0"/><p>0 3 1</p></triangles>
        <triangles material="paint"><input semantic="VERTEX" source="#at-vertices" offset="0"/><p>4 5 7</p></triangles>
        <triangles material="board"><input semantic="VERTEX" source="#at-vertices" offset="0"/><p>4 7 6</p></triangles>"##;
    let object = only(&file(lists, ""));
    let mesh = object.as_mesh().unwrap();
    let material = mesh.get(MATERIAL).unwrap();
    assert_eq!(
        mesh.faces()
            .map(|f| material[f.index()])
            .collect::<Vec<_>>(),
        [0, -1, 1, 0]
    );
    let [wood, red] = &object.materials[..] else {
        panic!("{:?}", object.materials);
    };
    assert_eq!(wood.name, "wood");
    assert_eq!(wood.base_color, [1.0; 4]);
    assert_eq!(
        wood.base_color_texture.as_ref().and_then(Texture::path),
        Some("maps/wood dark.png")
    );
    assert_eq!(red.name, "red");
    assert_eq!(red.base_color, [0.75, 0.5, 0.25, 0.25]);
    assert_eq!(red.alpha, AlphaMode::Blend);
    assert_eq!(red.base_color_texture, None);
}

#[test]
fn unbound_symbols_become_white_materials_with_a_note() {
    let list = r##"<triangles material="none"><input semantic="VERTEX" source="#at-vertices" offset="0"/>
        <p>0 2 3</p></triangles>"##;
    let text = file(list, "");
    assert_eq!(
        notes(&text),
        ["Some(20): 1 materials that the file does not define: replaced by white materials"]
    );
    assert_eq!(
        loaded(&text).objects[0].materials,
        [scene::Material::new("none")]
    );
}

#[test]
fn all_four_opacity_modes_are_read() {
    for (mode, alpha) in [
        ("A_ONE", 0.125),
        ("A_ZERO", 0.875),
        ("RGB_ONE", 0.5),
        ("RGB_ZERO", 0.5),
    ] {
        let list = r##"<triangles material="paint"><input semantic="VERTEX" source="#at-vertices" offset="0"/>
            <p>0 2 3</p></triangles>"##;
        let text = file(list, "")
            .replace("A_ONE", mode)
            .replace("<color>1 1 1 0.5</color>", "<color>1 1 1 0.25</color>");
        let object = only(&text);
        assert!(
            (object.materials[0].base_color[3] - alpha).abs() < 1e-6,
            "{mode}"
        );
    }
}
