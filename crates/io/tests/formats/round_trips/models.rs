//! Scenes for round trips. Each scene has one feature that some formats can store and others cannot.

use std::sync::Arc;

use bezier::{Curve, Patch};
use geometry::shapes;
use glam::{DVec2, DVec3, DVec4};
use mesh::{
    COLOR, CORNER_NORMAL, CORNER_TANGENT, CREASE, Column, Domain, MATERIAL, Mesh, Rule, SMOOTHING,
    TANGENT, UV, VERTEX_NORMAL, VERTEX_SHARPNESS, Value, Values, VertexId,
};
use scene::{AlphaMode, Geometry, Image, Material, Object, Texture};

use super::flat::{Key, key};

/// A row of the table: a feature, and objects with this feature. `key` is the part of the objects that differs after a
/// round trip if the format does not store the feature.
pub(super) struct Feature {
    pub(super) name: &'static str,
    pub(super) key: Key,
    pub(super) objects: Vec<Object>,
}

/// A closed triangle mesh whose positions fit in 32 bits.
fn base() -> Mesh {
    shapes::octahedron()
}

/// Returns number `i` of a sequence of unsorted numbers that fit in 32 bits.
fn number(i: usize) -> f64 {
    [0.5, -0.25, 3.0, 0.0, 0.75][i * 7 % 5]
}

/// Returns a unit vector perpendicular to [`unit`], and a sign.
fn tangent(i: usize) -> DVec4 {
    let sign = if i % 5 < 2 { -1.0 } else { 1.0 };
    [DVec3::Z, DVec3::X, DVec3::NEG_Y][i % 3].extend(sign)
}

fn unit(i: usize) -> DVec3 {
    [DVec3::X, DVec3::NEG_Y, DVec3::Z][i % 3]
}

pub(super) fn column(mesh: &mut Mesh, domain: Domain, name: &str, rule: Rule, values: Values) {
    let column = Column {
        name: name.to_owned(),
        rule,
        values,
    };
    mesh.insert_column(domain, column);
}

/// Returns the base mesh with one more attribute. `value` gives the value of each element.
fn with<T: Value>(
    domain: Domain,
    name: &str,
    rule: Rule,
    value: impl Fn(usize) -> T,
) -> Vec<Object> {
    let mut mesh = base();
    let values = (0..mesh.domain_len(domain)).map(value).collect();
    column(&mut mesh, domain, name, rule, T::wrap(values));
    one(mesh)
}

/// Returns one object, which has the same name as the file.
pub(super) fn one(mesh: Mesh) -> Vec<Object> {
    vec![Object::mesh("it", mesh)]
}

pub(super) fn mesh_of(positions: Vec<DVec3>, faces: &[Vec<u32>]) -> Mesh {
    let (mesh, report) = Mesh::from_polygons(positions, faces).unwrap();
    assert!(report.is_clean());
    mesh
}

/// The base mesh with these materials, assigned to the faces in turn.
fn painted(materials: Vec<Material>) -> Vec<Object> {
    let mut mesh = base();
    let n = i32::try_from(materials.len()).unwrap();
    mesh.set(MATERIAL, (0..8).map(|f| f % n).collect());
    vec![Object {
        materials,
        ..Object::mesh("it", mesh)
    }]
}

/// Returns an image file in the folder of the model.
fn image_file(path: &str) -> Texture {
    Texture::new(Image::Loaded {
        path: path.to_owned(),
        bytes: format!("\u{89}PNG of {path}").into_bytes().into(),
    })
}

fn embedded() -> Texture {
    Texture::new(Image::Embedded {
        mime: "image/png".to_owned(),
        bytes: Arc::from(&b"\x89PNG\r\n\x1a\nno more"[..]),
    })
}

fn placed(x: f64) -> Mesh {
    let mut mesh = base();
    for p in mesh.positions_mut() {
        p.x += x;
    }
    mesh
}

fn two(a: &str, b: &str, x: f64) -> Vec<Object> {
    vec![Object::mesh(a, base()), Object::mesh(b, placed(x))]
}

/// A polygon in the shape of an L, with six corners. The polygon is not convex.
fn hollow() -> Mesh {
    let points = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)];
    let points = points.map(|(x, y)| DVec3::new(f64::from(x), f64::from(y), 0.0));
    mesh_of(points.to_vec(), &[vec![3, 4, 5, 0, 1, 2]])
}

/// All rows of the table, in order.
pub(super) fn features() -> Vec<Feature> {
    let mut all = geometry();
    all.extend(attributes());
    all.extend(materials());
    all.extend(other_values());
    all.extend(other_geometry());
    all
}

fn feature(name: &'static str, key: Key, objects: Vec<Object>) -> Feature {
    Feature { name, key, objects }
}

fn geometry() -> Vec<Feature> {
    use Domain::{Face, Vertex};
    let moved = |to: f64| {
        let mut mesh = base();
        mesh.positions_mut()[0].x = to;
        one(mesh)
    };
    let mut isolated = base().positions().to_vec();
    isolated.push(DVec3::splat(2.0));
    let faces = super::super::polygons(&base());
    let faces: Vec<Vec<u32>> = faces
        .iter()
        .map(|f| f.iter().map(|&v| u32::try_from(v).unwrap()).collect())
        .collect();
    let backwards: Vec<DVec3> = base().positions().iter().rev().copied().collect();
    let turned: Vec<Vec<u32>> = faces
        .iter()
        .rev()
        .map(|f| vec![5 - f[1], 5 - f[0], 5 - f[2]])
        .collect();
    let mut shared = base().positions().to_vec();
    shared.extend_from_slice(base().positions());
    let mut twice = faces.clone();
    twice.extend(faces.iter().map(|f| f.iter().map(|v| v + 6).collect()));
    vec![
        feature("coordinates", key(Vertex, "position"), moved(0.1)),
        feature(
            "coordinates beyond the range of 32 bits",
            key(Vertex, "position"),
            moved(1e300),
        ),
        feature("-0 as a coordinate", key(Vertex, "position"), moved(-0.0)),
        feature(
            "order of vertices and faces",
            key(None, "order"),
            one(mesh_of(backwards, &turned)),
        ),
        feature("polygons", key(Face, "polygon"), one(hollow())),
        feature(
            "boundaries",
            key(Face, "polygon"),
            one(shapes::fans(&shapes::grid(2, 3))),
        ),
        feature(
            "isolated vertices",
            key(Vertex, "position"),
            one(mesh_of(isolated, &faces)),
        ),
        feature(
            "coincident vertices",
            key(Vertex, "merged"),
            one(mesh_of(shared, &twice)),
        ),
        feature(
            "mesh without vertices",
            key(None, "name"),
            one(Mesh::default()),
        ),
        feature(
            "name of a single object",
            key(None, "name"),
            vec![Object::mesh("thing", base())],
        ),
        feature(
            "several objects",
            key(None, "name"),
            two("a", "odd name", 4.0),
        ),
    ]
}

#[expect(clippy::too_many_lines, reason = "a list")]
fn attributes() -> Vec<Feature> {
    use Domain::{Corner, Edge, Face, Vertex};
    let mut tangents = base();
    tangents.set(CORNER_NORMAL, (0..24).map(unit).collect());
    tangents.set(CORNER_TANGENT, (0..24).map(tangent).collect());
    let mut both = base();
    both.set(VERTEX_NORMAL, (0..6).map(unit).collect());
    both.set(CORNER_NORMAL, (0..24).map(unit).collect());
    let mut agreeing = base();
    let origins: Vec<usize> = agreeing
        .half_edges()
        .map(|h| agreeing.origin(h).index())
        .collect();
    let of_vertices = |v: &usize| DVec2::new(number(*v), 1.0 - number(*v));
    agreeing.set(UV, origins.iter().map(of_vertices).collect());
    let mut normals = base();
    normals.set(CORNER_NORMAL, origins.iter().map(|&v| unit(v)).collect());
    let mut sets = base();
    sets.set(UV, (0..24).map(|h| DVec2::new(number(h), 0.25)).collect());
    let more = (0..24).map(|h| DVec2::new(0.5, number(h))).collect();
    column(
        &mut sets,
        Corner,
        "uv1",
        Rule::Interpolate,
        DVec2::wrap(more),
    );
    let color = |i: usize| DVec4::new(0.2, number(i).abs().min(1.0), 0.0, 1.0);
    let glass = |i: usize| color(i).with_w(0.5);
    vec![
        feature(
            "vertex normals",
            key(Vertex, "normal"),
            with(Vertex, "normal", Rule::Normal, unit),
        ),
        feature(
            "corner normals",
            key(Corner, "normal"),
            with(Corner, "normal", Rule::Normal, unit),
        ),
        feature(
            "corner normals that agree at each vertex",
            key(None, "domain"),
            one(normals),
        ),
        feature(
            "vertex normals of a mesh with corner normals",
            key(Vertex, "normal"),
            one(both),
        ),
        feature(
            "texture coordinates without seams",
            key(Corner, "uv"),
            one(agreeing),
        ),
        feature(
            "texture coordinates with seams",
            key(Corner, "uv"),
            with(Corner, "uv", UV.rule, |h| DVec2::new(number(h), 0.25)),
        ),
        feature(
            "64-bit texture coordinates",
            key(Corner, "uv"),
            with(Corner, "uv", UV.rule, |h| DVec2::new(0.1 * number(h), 0.1)),
        ),
        feature(
            "additional sets of texture coordinates",
            key(Corner, "uv1"),
            one(sets),
        ),
        feature(
            "vertex colors",
            key(Vertex, "color"),
            with(Vertex, "color", COLOR.rule, color),
        ),
        feature(
            "vertex alpha",
            key(Vertex, "color"),
            with(Vertex, "color", COLOR.rule, glass),
        ),
        feature(
            "vertex colors above 1",
            key(Vertex, "color"),
            with(Vertex, "color", COLOR.rule, |i| color(i) * 2.0),
        ),
        feature(
            "face colors",
            key(Face, "color"),
            with(Face, "color", Rule::Copy, color),
        ),
        feature(
            "corner tangents with corner normals",
            key(Corner, "tangent"),
            one(tangents),
        ),
        feature(
            "vertex tangents",
            key(Vertex, "tangent"),
            with(Vertex, "tangent", TANGENT.rule, unit),
        ),
        feature(
            "smoothing groups",
            key(Face, "smoothing"),
            with(Face, "smoothing", SMOOTHING.rule, |f| i32::from(f % 3 == 0)),
        ),
        feature(
            "edge creases",
            key(Edge, "crease"),
            with(Edge, "crease", CREASE.rule, number),
        ),
        feature(
            "vertex sharpness",
            key(Vertex, "corner"),
            with(Vertex, "corner", VERTEX_SHARPNESS.rule, number),
        ),
        feature(
            "face tags",
            key(Face, "left"),
            with(Face, "left", Rule::Copy, |f| f % 3 == 0),
        ),
        feature(
            "face tags with special characters",
            key(Face, "a b"),
            with(Face, "a b", Rule::Copy, |f| f % 3 == 0),
        ),
        feature(
            "face tags that no face has",
            key(Face, "none"),
            with(Face, "none", Rule::Copy, |_| false),
        ),
        feature(
            "vertex tags",
            key(Vertex, "left"),
            with(Vertex, "left", Rule::Copy, |v| v % 2 == 0),
        ),
        feature(
            "edge tags",
            key(Edge, "left"),
            with(Edge, "left", Rule::Copy, |e| e % 2 == 0),
        ),
        feature(
            "corner tags",
            key(Corner, "left"),
            with(Corner, "left", Rule::Copy, |h| h % 2 == 0),
        ),
    ]
}

fn materials() -> Vec<Feature> {
    let red = Material {
        base_color: [0.8, 0.1, 0.1, 1.0],
        metallic: 0.25,
        roughness: 0.3,
        emissive: [1.0, 0.5, 0.0],
        ..Material::new("red paint")
    };
    let glass = Material {
        base_color: [0.5, 0.5, 1.0, 0.25],
        alpha: AlphaMode::Blend,
        ..Material::new("glass")
    };
    let wood = Material {
        base_color_texture: Some(image_file("pictures/red wood.png")),
        normal_texture: Some(image_file("bumps.png")),
        ..Material::new("wood")
    };
    let cut_out = Material {
        alpha: AlphaMode::Mask(0.5),
        double_sided: true,
        ..Material::new("leaf")
    };
    let inside = Material {
        base_color_texture: Some(embedded()),
        ..Material::new("inside")
    };
    let with_uv = |materials| {
        let mut objects = painted(materials);
        let mut mesh = (**objects[0].as_mesh().unwrap()).clone();
        mesh.set(UV, (0..24).map(|h| DVec2::new(number(h), 0.25)).collect());
        objects[0].geometry = Geometry::Mesh(Arc::new(mesh));
        objects
    };
    let mut spare = painted(vec![red.clone()]);
    spare[0].materials.push(glass.clone());
    let mut unknown = painted(vec![red.clone()]);
    let mut mesh = (**unknown[0].as_mesh().unwrap()).clone();
    mesh.set(MATERIAL, vec![0, 0, 0, 0, 0, 0, 0, 7]);
    unknown[0].geometry = Geometry::Mesh(Arc::new(mesh));
    let material = || key(None, "materials");
    let mixed = painted(vec![red.clone(), glass.clone()]);
    vec![
        feature(
            "order of faces with several materials",
            key(None, "order of faces"),
            mixed,
        ),
        feature("materials", material(), painted(vec![red.clone(), glass])),
        feature(
            "image files of textures",
            material(),
            with_uv(vec![red, wood]),
        ),
        feature(
            "embedded images of textures",
            material(),
            with_uv(vec![inside]),
        ),
        feature(
            "alpha cutoff, double-sided materials",
            material(),
            painted(vec![cut_out]),
        ),
        feature("unused materials", material(), spare),
        feature(
            "indices of missing materials",
            key(Domain::Face, "material"),
            unknown,
        ),
    ]
}

fn other_values() -> Vec<Feature> {
    use Domain::{Corner, Edge, Face, Vertex};
    let int = |i: usize| i32::try_from(i).unwrap() - 3;
    let vec = |i: usize| DVec3::new(number(i), 1.0, -2.0);
    let is = Rule::Interpolate;
    let mut ruled = base();
    let tag = Values::Tag((0..8).map(|f| f % 3 == 0).collect());
    column(&mut ruled, Face, "left", Rule::Drop, tag);
    let color = |i: usize| DVec4::new(0.25, number(i).abs().min(1.0), 0.0, 1.0);
    let colors = Values::Vec4((0..6).map(color).collect());
    column(&mut ruled, Vertex, "color", Rule::Drop, colors);
    vec![
        feature(
            "custom vertex floats",
            key(Vertex, "a b"),
            with(Vertex, "a b", is, number),
        ),
        feature(
            "custom corner floats",
            key(Corner, "heat"),
            with(Corner, "heat", is, number),
        ),
        feature(
            "custom edge floats",
            key(Edge, "heat"),
            with(Edge, "heat", is, number),
        ),
        feature(
            "custom face floats",
            key(Face, "heat"),
            with(Face, "heat", is, number),
        ),
        feature(
            "custom 64-bit floats",
            key(Vertex, "heat"),
            with(Vertex, "heat", is, |i| 0.1 * number(i)),
        ),
        feature(
            "custom vertex vectors",
            key(Vertex, "wind"),
            with(Vertex, "wind", is, vec),
        ),
        feature(
            "custom corner vectors",
            key(Corner, "wind"),
            with(Corner, "wind", is, vec),
        ),
        feature(
            "custom face vectors",
            key(Face, "wind"),
            with(Face, "wind", is, vec),
        ),
        feature(
            "custom vertex integers",
            key(Vertex, "n"),
            with(Vertex, "n", Rule::Copy, int),
        ),
        feature(
            "custom corner integers",
            key(Corner, "n"),
            with(Corner, "n", Rule::Copy, int),
        ),
        feature(
            "custom edge integers",
            key(Edge, "n"),
            with(Edge, "n", Rule::Copy, int),
        ),
        feature(
            "custom face integers",
            key(Face, "n"),
            with(Face, "n", Rule::Copy, int),
        ),
        feature("edit rules of attributes", key(None, "rule"), one(ruled)),
        feature(
            "non-finite values",
            key(Vertex, "heat"),
            with(Vertex, "heat", is, |i| {
                if i == 2 { f64::INFINITY } else { number(i) }
            }),
        ),
    ]
}

fn other_geometry() -> Vec<Feature> {
    let points = [[0.1, -0.0, 1e30], [5e-324, 2.0, 3.0], [1.0, 1.0, 1.0]].map(DVec3::from_array);
    let lines = vec![points.to_vec(), points[..2].to_vec()];
    let rows = std::array::from_fn(|i| std::array::from_fn(|j| points[(i * j) % 3]));
    let patches = vec![Patch::new(rows).unwrap(); 2];
    let curve = Curve::new(points.map(DVec3::truncate).to_vec()).unwrap();
    let of = |geometry| vec![Object::new("it", geometry)];
    let it = || key(None, "geometry");
    vec![
        feature("polylines", it(), of(Geometry::Polylines(lines))),
        feature("patches", it(), of(Geometry::Patches(patches))),
        feature("curves", it(), of(Geometry::Curve(curve))),
    ]
}

/// Returns objects with meshes of all kinds. Each object has the same name as the file.
pub(super) fn shapes_of_all_kinds() -> Vec<Vec<Object>> {
    let mut deleted = shapes::cube();
    let f = deleted.faces().next().unwrap();
    deleted.delete_face(f).unwrap();
    let mut odd = shapes::torus(7, 5, 2.0, 0.5);
    for (i, x) in [-0.0, 1e-310, 0.1, 1.0 / 3.0, 1e30, f64::MIN_POSITIVE]
        .into_iter()
        .enumerate()
    {
        odd.set_position(
            VertexId::new(i),
            DVec3::new(x, f64::from(u32::try_from(i).unwrap()), -0.0),
        );
    }
    [
        shapes::square(),
        shapes::cube(),
        shapes::tetrahedron(),
        shapes::icosahedron(),
        shapes::grid(3, 2),
        shapes::torus(7, 5, 2.0, 0.5),
        shapes::cylinder(5, true),
        shapes::cylinder(5, false),
        shapes::uv_sphere(7, 4),
        shapes::fans(&shapes::uv_sphere(7, 4)),
        deleted,
        odd,
    ]
    .into_iter()
    .map(one)
    .collect()
}
