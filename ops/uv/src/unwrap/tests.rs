use geometry::shapes;
use geometry::uv::{charts, overlapping_faces};
use mesh::{CORNER_TANGENT, DVec3, DVec4, Domain, UV};
use op::NoProgress;
use op::test::{applied_as_planned, planned, try_applied};

use super::*;

fn step(text: &str) -> Unwrap {
    op::test::read(text).unwrap()
}

#[test]
fn only_the_attribute_changes() {
    let before = shapes::torus(24, 12, 1.0, 0.4);
    let mut after = applied_as_planned(&step("()"), &before);
    assert!(after.get(UV).is_some());
    after.remove_column(Domain::Corner, "uv");
    assert_eq!(after, before);
}

#[test]
fn other_texture_coordinates_keep_their_seams() {
    let first = applied_as_planned(&step("()"), &shapes::cube());
    let both = applied_as_planned(&step(r#"(uv: "light", max_angle: 20, page: 64)"#), &first);
    assert_eq!(both.get(UV), first.get(UV));
    assert!(both.attributes().column(Domain::Corner, "light").is_some());
}

#[test]
fn tagged_edges_are_seams() {
    let mut mesh = shapes::grid(4, 2);
    let middle = mesh.edges().map(|e| {
        let [v, w] = mesh.edge_vertices(e);
        mesh.position(v).x == 0.0 && mesh.position(w).x == 0.0
    });
    let middle: Vec<bool> = middle.collect();
    let column = mesh::Column {
        name: "seam".to_owned(),
        rule: mesh::Rule::Copy,
        values: mesh::Value::wrap(middle),
    };
    mesh.insert_column(Domain::Edge, column);
    let (whole, report) = try_applied(&step("()"), mesh.clone()).unwrap();
    assert_eq!(charts(&whole, whole.get(UV).unwrap()).n, 1);
    assert_eq!(
        (report.changed, report.notes[0].as_str()),
        (32, "charts: 1")
    );
    let (cut, report) = try_applied(&step(r#"(seams: Tagged("seam"))"#), mesh).unwrap();
    assert_eq!(charts(&cut, cut.get(UV).unwrap()).n, 2);
    assert_eq!(report.notes[0], "charts: 2");
}

#[test]
fn tangents_are_removed() {
    let mut mesh = shapes::cube();
    mesh.set(CORNER_TANGENT, vec![DVec4::X; mesh.n_half_edges()]);
    let (plan, _) = planned(&step("()"), &mesh);
    assert!(plan.attributes.iter().all(|a| a.name != "tangent"));
    let (after, report) = try_applied(&step("()"), mesh).unwrap();
    assert!(after.get(CORNER_TANGENT).is_none());
    assert!(report.notes.iter().any(|note| note.contains("tangents")));
}

#[test]
fn a_polygon_that_overlaps_itself_is_refused() {
    // The mesh is a strip that winds around the z axis about twice. The strip is a single face, which cannot be
    // flattened without overlaps.
    let n = 16;
    let turn = |k: usize, radius: f64| {
        let (sin, cos) = geometry::sin_cos_degrees(k as f64 * 45.0);
        DVec3::new(radius * cos, radius * sin, 0.4 * k as f64)
    };
    let mut points: Vec<DVec3> = (0..n).map(|k| turn(k, 1.0)).collect();
    points.extend((0..n).rev().map(|k| turn(k, 2.0)));
    let face: Vec<u32> = (0..2 * n).map(|k| u32::try_from(k).unwrap()).collect();
    let (mesh, _) = Mesh::from_polygons(points, &[face]).unwrap();
    let result = try_applied(&step("()"), mesh.clone());
    if let Err(refused) = &result {
        assert!(refused.to_string().contains("f0 is bent"), "{refused}");
        assert_eq!(refused.elements(), [Element::from(mesh::FaceId::new(0))]);
        let (_, report) = try_applied(&step("(on_refusal: Skip)"), mesh).unwrap();
        assert_eq!(report.refused[0].count, 1);
    } else {
        let (after, _) = result.unwrap();
        let uvs = after.get(UV).unwrap();
        assert_eq!(overlapping_faces(&after, uvs, &NoProgress).unwrap(), []);
        panic!("expected a refusal");
    }
}

#[test]
fn a_page_without_room_is_refused() {
    let (_, problems) = planned(&step("(page: 16, padding: 8)"), &shapes::cube());
    assert_eq!(problems.len(), 1);
    let refused = try_applied(&step("(page: 16, padding: 7)"), shapes::cube()).unwrap_err();
    assert!(refused.to_string().contains("larger `page`"), "{refused}");
    assert!(op::test::read::<Unwrap>("(page: 15)").is_err());
}

#[test]
fn changes_by_morph_targets_are_removed_with_the_texture_coordinates_that_they_change() {
    let mut mesh = shapes::cube();
    for name in ["uv", "uv1", "morph_uv:0", "morph_uv:2", "morph_uv1:0"] {
        let column = mesh::Column {
            name: name.to_owned(),
            rule: mesh::Rule::Interpolate,
            values: mesh::Value::wrap(vec![mesh::DVec2::X; mesh.n_half_edges()]),
        };
        mesh.insert_column(Domain::Corner, column);
    }
    let after = applied_as_planned(&step("()"), &mesh);
    let names: Vec<_> = after.attributes().iter().map(|(_, c)| &*c.name).collect();
    assert_eq!(names, ["morph_uv1:0", "uv", "uv1"]);
    let (_, report) = try_applied(&step("()"), mesh).unwrap();
    let removed = report
        .notes
        .iter()
        .filter(|note| note.contains("`morph_uv:"));
    assert_eq!(removed.count(), 2, "{:?}", report.notes);
}
