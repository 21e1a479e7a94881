//! Tests of the operation.

use super::*;
use geometry::shapes;
use mesh::{
    Attribute, DVec2, DVec3, FaceId, HalfEdgeId, MATERIAL, Mesh, Rule, UV, VERTEX_NORMAL, VertexId,
};
use op::Range;
use scene::{Geometry, Material};

fn step(text: &str) -> Join {
    op::test::read(text).unwrap()
}

fn scene(objects: Vec<Object>) -> Scene {
    let mut scene = Scene::new();
    for object in objects {
        scene.insert(object).unwrap();
    }
    scene
}

/// Joins the objects "a" and "b" into "all". Returns the mesh and the report.
fn joined(a: Mesh, b: Mesh) -> (Mesh, Report) {
    let mut scene = scene(vec![Object::mesh("a", a), Object::mesh("b", b)]);
    let report = op::test::run(&step(r#"(objects: ["a", "b"], name: "all")"#), &mut scene).unwrap();
    (mesh_of(&scene, "all"), report)
}

fn mesh_of(scene: &Scene, name: &str) -> Mesh {
    let mesh = scene.object(name).unwrap().as_mesh().unwrap();
    assert_eq!(mesh.defects(), []);
    mesh.as_ref().clone()
}

#[test]
fn counts_add_up_and_the_parts_are_not_connected() {
    let (mesh, report) = joined(shapes::cube(), shapes::grid(2, 1));
    assert_eq!(
        (mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()),
        (14, 19, 8)
    );
    assert_eq!(
        (geometry::n_components(&mesh), mesh.n_boundary_loops()),
        (2, 1)
    );
    assert_eq!(report.changed, 8);
    assert_eq!(mesh.positions()[8..], *shapes::grid(2, 1).positions());
    assert_eq!(
        (report.losses, report.notes),
        (vec![], Vec::<String>::new())
    );
}

#[test]
fn empty_parts_and_isolated_vertices_can_be_joined() {
    let isolated = Mesh::from_polygons(vec![DVec3::X], &[[0_u32; 3]; 0])
        .unwrap()
        .0;
    assert_eq!(joined(Mesh::default(), Mesh::default()).0.n_vertices(), 0);
    let (mesh, _) = joined(isolated, shapes::tetrahedron());
    assert_eq!((mesh.n_vertices(), mesh.n_isolated_vertices()), (5, 1));
}

#[test]
fn the_result_replaces_the_first_mesh_of_the_list() {
    let object = |name| Object::mesh(name, shapes::square());
    let mut scene = scene(vec![object("x"), object("a"), object("y"), object("b")]);
    op::test::run(&step(r#"(objects: ["b", "a"], name: "a")"#), &mut scene).unwrap();
    let names: Vec<_> = scene.objects().iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["x", "y", "a"]);
}

#[test]
fn faces_are_tagged_with_the_names_of_the_parts() {
    let (mesh, _) = joined(shapes::square(), shapes::grid(2, 1));
    assert_eq!(mesh.tag(Domain::Face, "a").unwrap(), [true, false, false]);
    assert_eq!(mesh.tag(Domain::Face, "b").unwrap(), [false, true, true]);

    let mut untagged = scene(vec![Object::mesh("a", shapes::square())]);
    let text = r#"(objects: ["a"], name: "b", tag_parts: false)"#;
    op::test::run(&step(text), &mut untagged).unwrap();
    assert_eq!(mesh_of(&untagged, "b"), shapes::square());
}

#[test]
fn an_existing_tag_is_extended_and_an_existing_attribute_is_kept() {
    let mut a = shapes::square();
    a.set(Attribute::<FaceId, bool>::new("b", Rule::Copy), vec![true]);
    a.set(Attribute::<FaceId, i32>::new("a", Rule::Copy), vec![7]);
    let (mesh, report) = joined(a, shapes::square());
    assert_eq!(mesh.tag(Domain::Face, "b").unwrap(), [true, true]);
    assert_eq!(
        mesh.get(Attribute::<FaceId, i32>::new("a", Rule::Copy))
            .unwrap(),
        [7, 0]
    );
    assert_eq!(report.notes.len(), 2);
    assert!(
        report.notes[1].starts_with("the faces of \"a\" are not tagged"),
        "{:?}",
        report.notes
    );
}

#[test]
fn equal_materials_become_one() {
    let part = |name, materials: &[&str], numbers: &[i32]| {
        let mut mesh = shapes::grid(3, 1);
        if !numbers.is_empty() {
            mesh.set(MATERIAL, numbers.to_vec());
        }
        let mut object = Object::mesh(name, mesh);
        object.materials = materials.iter().map(|&m| Material::new(m)).collect();
        object
    };
    let mut scene = scene(vec![
        part("a", &["red", "blue"], &[0, 1, -1]),
        part("b", &["green", "red"], &[0, 1, 9]),
        part("c", &[], &[]),
    ]);
    let text = r#"(objects: ["a", "b", "c"], name: "all")"#;
    let report = op::test::run(&step(text), &mut scene).unwrap();
    let names: Vec<_> = scene.objects()[0]
        .materials
        .iter()
        .map(|m| m.name.as_str())
        .collect();
    assert_eq!(names, ["red", "blue", "green"]);
    let mesh = mesh_of(&scene, "all");
    assert_eq!(
        mesh.get(MATERIAL).unwrap(),
        [0, 1, -1, 2, 0, -1, -1, -1, -1]
    );
    assert_eq!(report, Report::changed(9));
}

#[test]
fn values_stay_with_their_elements_and_missing_values_are_zero_with_a_note() {
    let mut a = shapes::square();
    a.set(UV, vec![DVec2::ONE; 8]);
    let (mesh, report) = joined(shapes::square(), a);
    let uv = mesh.get(UV).unwrap();
    assert_eq!(
        (&uv[..8], &uv[8..]),
        (&[DVec2::ZERO; 8][..], &[DVec2::ONE; 8][..])
    );
    assert_eq!(
        report.notes,
        [
            "\"a\" has no corner attribute \"uv\", so this attribute is zero for all elements of \"a\""
        ]
    );
    assert_eq!(report.losses, []);
}

#[test]
fn normals_are_lost_if_one_part_lacks_them() {
    let mut with = shapes::square();
    with.set(VERTEX_NORMAL, vec![DVec3::Z; 4]);
    let (mesh, report) = joined(with.clone(), shapes::square());
    assert!(mesh.get(VERTEX_NORMAL).is_none());
    assert_eq!(report.losses.len(), 1);
    assert_eq!(
        (report.losses[0].object.as_str(), report.notes.len()),
        ("a", 0)
    );

    assert_eq!(
        joined(with.clone(), with.clone())
            .0
            .get(VERTEX_NORMAL)
            .unwrap(),
        [DVec3::Z; 8]
    );
    assert_eq!(
        joined(with, Mesh::default()).0.get(VERTEX_NORMAL).unwrap(),
        [DVec3::Z; 4]
    );
}

#[test]
fn values_of_another_type_are_lost() {
    let (mut a, mut b) = (shapes::square(), shapes::square());
    a.set(
        Attribute::<VertexId, f64>::new("x", Rule::Copy),
        vec![1.0; 4],
    );
    b.set(Attribute::<VertexId, i32>::new("x", Rule::Copy), vec![1; 4]);
    b.set(
        Attribute::<HalfEdgeId, f64>::new("y", Rule::Copy),
        vec![2.0; 8],
    );
    let (mesh, report) = joined(a, b);
    let x = mesh
        .get(Attribute::<VertexId, f64>::new("x", Rule::Copy))
        .unwrap();
    assert_eq!(x, [1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(report.losses.len(), 1);
    assert_eq!(report.losses[0].object, "b");
}

#[test]
fn invalid_lists_are_errors_in_plan_and_apply_and_nothing_changes() {
    let objects = || {
        scene(vec![
            Object::mesh("a", shapes::square()),
            Object::mesh("b", shapes::square()),
            Object::new("lines", Geometry::Polylines(Vec::new())),
        ])
    };
    let files = op::Files::default();
    let cx = PlanContext::new(&files);
    for (text, field) in [
        (r#"(objects: [], name: "all")"#, "objects"),
        (r#"(objects: ["a", "b", "a"], name: "all")"#, "objects.2"),
        (r#"(objects: ["a", "c"], name: "all")"#, "objects.1"),
        (r#"(objects: ["lines", "a"], name: "all")"#, "objects.0"),
        (r#"(objects: ["a"], name: "b")"#, "name"),
    ] {
        let mut scene = objects();
        assert!(op::test::run(&step(text), &mut scene).is_err(), "{text}");
        assert_eq!(scene, objects());

        let mut plan = planned(&scene);
        let problems = step(text).plan(&mut plan, &cx);
        assert_eq!(
            problems
                .iter()
                .map(|p| p.path.join("."))
                .collect::<Vec<_>>(),
            [field]
        );
    }
}

fn planned(scene: &Scene) -> Plan {
    let mut plan = Plan::default();
    for object in scene.objects() {
        let geometry = object.as_mesh().map_or(PlannedGeometry::Polylines, |m| {
            PlannedGeometry::Mesh(MeshPlan::of(m))
        });
        assert_eq!(plan.insert(&object.name, geometry), None);
    }
    plan
}

#[test]
fn the_plan_agrees_with_the_result() {
    let mut colored = shapes::tetrahedron();
    colored.set(UV, vec![DVec2::ONE; 12]);
    let mut scene = scene(vec![
        Object::mesh("x", shapes::square()),
        Object::mesh("a", shapes::cube()),
        Object::mesh("b", colored),
    ]);
    let mut plan = planned(&scene);
    let files = op::Files::default();
    let cx = PlanContext::new(&files);
    let step = step(r#"(objects: ["a", "b"], name: "all")"#);
    assert_eq!(step.plan(&mut plan, &cx), []);
    op::test::run(&step, &mut scene).unwrap();

    let names: Vec<_> = plan.objects().iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["x", "all"]);
    let PlannedGeometry::Mesh(planned) = &plan.objects()[1].geometry else {
        panic!("a mesh");
    };
    let actual = MeshPlan::of(&mesh_of(&scene, "all"));
    assert_eq!(
        (planned.vertices, planned.edges),
        (actual.vertices, actual.edges)
    );
    assert_eq!(
        (planned.faces, planned.degrees),
        (actual.faces, Range { min: 3, max: 4 })
    );
    let known = |plan: &MeshPlan| {
        let mut names: Vec<_> = plan.attributes.iter().map(|a| a.name.clone()).collect();
        names.sort();
        names
    };
    assert_eq!(known(planned), known(&actual));
}
