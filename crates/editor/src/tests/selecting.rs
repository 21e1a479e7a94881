//! Tests of picked elements, proposals of selections, keys and control points.

use mesh::{DVec2, DVec3, Domain, Mesh};
use op::{ElementKind, Selected};
use scene::{Object, Scene};

use super::*;
use crate::{Action, Command, Keys, KeysError, Picked, propose};

fn scene(mesh: Mesh) -> Scene {
    let mut scene = Scene::new();
    scene.insert(Object::mesh("a", mesh)).unwrap();
    scene
}

fn picked(scene: &Scene, text: &str, kind: ElementKind) -> Picked {
    Picked::by_text(scene, "a", text, Some(kind)).unwrap()
}

#[test]
fn grow_and_shrink_are_the_selections_of_these_names() {
    let scene = scene(geometry::shapes::grid(6, 5));
    let mesh = scene.objects()[0].as_mesh().unwrap().clone();
    for kind in ElementKind::ALL {
        for text in [
            "Boundary",
            "Random(count: 3, seed: 1)",
            "Random(count: 20, seed: 2)",
            "All",
            "Not(Boundary)",
        ] {
            let set = picked(&scene, text, kind);
            let grown = picked(&scene, &format!("Grow({text})"), kind);
            let shrunk = picked(&scene, &format!("Shrink({text})"), kind);
            assert_eq!(set.grown(&mesh).elements, grown.elements, "{text} {kind:?}");
            assert_eq!(
                set.shrunk(&mesh).elements,
                shrunk.elements,
                "{text} {kind:?}"
            );
        }
    }
}

#[test]
fn a_proposal_means_exactly_the_picked_elements_and_fails_closed() {
    let mut mesh = geometry::shapes::grid(6, 5);
    let marks = mesh.faces().map(|f| f.index() % 7 == 0).collect();
    let column = mesh::Column {
        name: "spots".into(),
        values: mesh::Values::Tag(marks),
        rule: mesh::Rule::Copy,
    };
    mesh.insert_column(Domain::Face, column);
    let scene = scene(mesh);
    let mesh = scene.objects()[0].as_mesh().unwrap().clone();
    let first = |text: &str, kind| {
        let set = picked(&scene, text, kind);
        let all = propose(&scene, &set, "");
        for proposal in &all {
            if proposal.before.is_none() {
                assert_eq!(
                    picked(&scene, &proposal.text, kind).elements,
                    set.elements,
                    "{proposal:?}"
                );
            }
        }
        all[0].clone()
    };
    let text = |text: &str, kind| first(text, kind).text;
    assert_eq!(
        text("Tagged(\"spots\")", ElementKind::Faces),
        "Expect(count: 5, of: Tagged(\"spots\"))"
    );
    assert_eq!(
        text("Boundary", ElementKind::Edges),
        "Expect(count: 22, of: Boundary)"
    );
    assert_eq!(text("All", ElementKind::Vertices), "All");
    assert_eq!(
        text("Vertices([8])", ElementKind::Vertices),
        "Vertices([8])"
    );
    assert_eq!(
        text("Faces([8, 9, 1])", ElementKind::Faces),
        "Faces([1, 8, 9])"
    );
    let inner = mesh.edges().find(|&e| !mesh.is_boundary_edge(e)).unwrap();
    let [v, w] = mesh.edge_vertices(inner).map(mesh::VertexId::index);
    let loops = text(&format!("EdgeLoop(Between({v}, {w}))"), ElementKind::Edges);
    assert!(loops.contains("EdgeLoop("), "{loops}");
    // If only a long list of indices would select the elements, the proposal is a tag instead: a new step tags the
    // elements, and the selection uses this tag.
    for (kind, operation) in [
        (ElementKind::Vertices, "TagVertices"),
        (ElementKind::Edges, "TagEdges"),
        (ElementKind::Faces, "TagFaces"),
    ] {
        let random = first("Random(count: 13, seed: 3)", kind);
        assert_eq!(random.text, "Expect(count: 13, of: Tagged(\"picked 1\"))");
        assert!(
            random
                .before
                .unwrap()
                .starts_with(&format!("{operation}(name: \"picked 1\", "))
        );
    }
}

#[test]
fn picks_without_a_meaning_become_a_tag_and_a_step() {
    let (mut editor, _) = opened("(recipe: 1, steps: [Grid(name: \"a\", columns: 9, rows: 9)])");
    let set = Picked::by_text(
        &editor.view().scene,
        "a",
        "Random(count: 11, seed: 3)",
        Some(ElementKind::Faces),
    );
    editor.set_picked(Some(set.unwrap()));
    assert_eq!(editor.proposals().len(), 1);
    // If the command is an operation that tags the elements, no additional step tags them first.
    let selection = editor.selection();
    let tag = Command {
        selection,
        ..Command::new("TagFaces").with("name", "\"mine\"")
    };
    let steps = editor.steps_of(&tag).unwrap();
    let [step] = &steps[..] else {
        panic!("{steps:?}");
    };
    assert!(step.starts_with("TagFaces(faces: Faces(["), "{step}");
    assert!(step.ends_with("]), name: \"mine\")"), "{step}");
    let command = editor.command_of(Action::Extrude).unwrap();
    editor.apply(&command).unwrap();
    settled(&mut editor);
    let names: Vec<&str> = editor
        .outline()
        .steps
        .iter()
        .map(|step| step.name.as_str())
        .collect();
    assert_eq!(names, ["Grid", "TagFaces", "ExtrudeFaces"]);
    assert_eq!(editor.cursor(), 3);
    assert!(editor.undo());
    assert_eq!(editor.outline().steps.len(), 1);
}

#[test]
fn a_selection_of_another_kind_is_converted_and_names_its_object() {
    let (mut editor, _) = opened("(recipe: 1, steps: [Cube(name: \"a\"), Cube(name: \"b\")])");
    let set = Picked::by_text(
        &editor.view().scene,
        "b",
        "Faces([0])",
        Some(ElementKind::Faces),
    )
    .unwrap();
    editor.set_picked(Some(set));
    let split = editor.command_of(Action::Split).unwrap();
    let steps = editor.steps_of(&split).unwrap();
    assert_eq!(
        steps,
        ["(run: SplitEdges(edges: EdgesOf(Faces([0]))), on: [\"b\"])"]
    );
    editor.apply(&split).unwrap();
    settled(&mut editor);
    let picture = editor.steps_of(&Command {
        selection: split.selection,
        ..Command::new("Picture").with("path", "\"a.png\"")
    });
    assert_eq!(
        picture.unwrap(),
        ["(run: Picture(highlight: Faces(Faces([0])), path: \"a.png\"), on: [\"b\"])"]
    );
}

#[test]
fn a_written_selection_picks_its_elements_and_is_used_by_the_next_step() {
    let (mut editor, _) = opened("(recipe: 1, steps: [Cube(name: \"a\")])");
    // If no elements are picked, the selection is evaluated on the first mesh, and the text decides the kind of
    // elements.
    editor
        .pick_by_text("Sharp(above: 30)", ElementKind::Faces)
        .unwrap();
    let picked = editor.picked().unwrap();
    assert_eq!((picked.kind(), picked.len()), (ElementKind::Edges, 12));
    assert_eq!(editor.selection().unwrap().text, "Sharp(above: 30)");
    editor.next_proposal();
    let other = editor.selection().unwrap().text;
    assert_ne!(other, "Sharp(above: 30)");
    let again = Picked::by_text(&editor.view().scene, "a", &other, Some(ElementKind::Edges));
    assert_eq!(again.unwrap().len(), 12);
    // An invalid selection leaves the picked elements unchanged.
    for wrong in [
        "Sharp(",
        "Sharp(over: 3)",
        "Between(0, 99)",
        "Longer(than: 1000)",
    ] {
        assert!(
            editor.pick_by_text(wrong, ElementKind::Edges).is_err(),
            "{wrong}"
        );
        assert_eq!(editor.picked().unwrap().len(), 12);
    }
}

#[test]
fn the_selections_of_a_large_pick_are_searched_beside_the_window() {
    let text = "(recipe: 1, steps: [Grid(name: \"a\", columns: 180, rows: 180)])";
    let (mut editor, _) = opened(text);
    let scene = editor.view().scene;
    let kind = ElementKind::Faces;
    let set = Picked::by_text(&scene, "a", "Random(count: 500, seed: 3)", Some(kind)).unwrap();
    editor.set_picked(Some(set.clone()));
    while editor.is_searching() {
        std::thread::sleep(Duration::from_millis(2));
    }
    assert_eq!(editor.proposals(), propose(&scene, &set, ""));
    // `selection` waits until the search for proposals has ended.
    editor.set_picked(Some(set));
    assert!(editor.selection().is_some());
}

#[test]
fn sets_are_joined_and_toggled() {
    let faces = |list: &[usize]| {
        Picked::new(
            "a",
            Selected::Faces(list.iter().map(|&f| mesh::FaceId::new(f)).collect()),
        )
    };
    let mut set = faces(&[1, 3]);
    set.toggle(&faces(&[2]));
    assert_eq!(set, faces(&[1, 2, 3]));
    set.toggle(&faces(&[1, 3]));
    assert_eq!(set, faces(&[2]));
    let other = Picked {
        object: "b".into(),
        ..faces(&[7])
    };
    set.toggle(&other);
    assert_eq!(set, other);
}

#[test]
fn every_action_has_its_own_keys_and_a_file_changes_them() {
    let keys = Keys::default();
    for action in Action::all() {
        assert!(!action.doc().is_empty());
        for key in keys.of(action) {
            assert_eq!(keys.action(key), Some(action), "{key}");
        }
    }
    assert_eq!(keys.action("shift+ctrl+z"), Some(Action::Redo));
    assert_eq!(keys.action("f"), Some(Action::Flip));
    let changed = Keys::read("{ Flip: [\"Ctrl+F\", \"S\"], Split: [] }").unwrap();
    assert_eq!(
        (
            changed.action("S"),
            changed.action("F"),
            changed.of(Action::Split).len()
        ),
        (Some(Action::Flip), None, 0)
    );
    assert!(matches!(
        Keys::read("{ Flip: [\"X\"], Split: [\"x\"] }"),
        Err(KeysError::Twice(..))
    ));
    assert!(matches!(
        Keys::read("{ Flap: [] }"),
        Err(KeysError::Text { line: 1, .. })
    ));
}

#[test]
fn dragging_a_control_point_is_one_step() {
    let (mut editor, store) = editor();
    store
        .write(Path::new("c.bzc"), b"3\n0 0\n1 2\n2 0\n")
        .unwrap();
    editor.open(Path::new("c.bzc")).unwrap();
    settled(&mut editor);
    let points = |editor: &Editor| crate::control_points(&editor.view().scene.objects()[0]);
    let name = editor.view().scene.objects()[0].name.clone();
    assert_eq!(points(&editor)[1], DVec3::new(1.0, 2.0, 0.0));
    for x in [1.5, 1.75] {
        editor
            .move_control_point(&name, 1, DVec3::new(x, 3.0, 0.0), true)
            .unwrap();
        settled(&mut editor);
        assert_eq!(editor.outline().steps.len(), 1);
    }
    for x in [2.0, 2.5] {
        editor
            .move_control_point(&name, 1, DVec3::new(x, 3.0, 0.0), false)
            .unwrap();
        settled(&mut editor);
        assert_eq!(points(&editor)[1], DVec3::new(x, 3.0, 0.0));
    }
    assert!(
        editor
            .text()
            .contains("MoveControlPoint(index: 1, to: (2.5, 3)),"),
        "{}",
        editor.text()
    );
    assert_eq!(editor.outline().steps.len(), 2);
    assert!(
        editor
            .move_control_point("other", 1, DVec3::ZERO, false)
            .is_err()
    );
}

#[test]
fn a_control_point_under_the_cursor_is_dragged_in_its_plane() {
    use bezier::{Curve, Patch};
    use glam::{DMat4, DQuat, DVec4};
    use scene::{Geometry, Object, Scene};

    let size = DVec2::new(400.0, 300.0);
    // The camera is at (2, 3, 9). Its view direction differs slightly from -z.
    let (near, far) = (0.5, 30.0);
    let lens = DMat4::from_cols(
        DVec4::new(2.4, 0.0, 0.0, 0.0),
        DVec4::new(0.0, 3.2, 0.0, 0.0),
        DVec4::new(0.0, 0.0, far / (near - far), -1.0),
        DVec4::new(0.0, 0.0, near * far / (near - far), 0.0),
    );
    let turned = DMat4::from_quat(DQuat::from_xyzw(0.14, -0.1, 0.02, 0.98).normalize());
    let camera = turned * DMat4::from_translation(DVec3::new(-2.0, -3.0, -9.0));
    let view = crate::Projection::new(lens * camera, size);
    let steps = [0.0, 0.5, 1.0, 1.5];
    let corners = steps.map(|y| steps.map(|x| DVec3::new(x, y, 0.2 * x * y)));
    let curve = [[0.0, 0.0], [1.0, 2.0], [2.0, 0.0]].map(DVec2::from);
    for (geometry, index) in [
        (Geometry::Curve(Curve::new(curve.to_vec()).unwrap()), 1),
        (Geometry::Patches(vec![Patch::new(corners).unwrap()]), 7),
    ] {
        let is_curve = matches!(geometry, Geometry::Curve(_));
        let mut scene = Scene::new();
        scene.insert(Object::new("a", geometry)).unwrap();
        let point = crate::control_points(&scene.objects()[0])[index];
        let (pixel, depth) = view.to_pixel(point).unwrap();
        let near = pixel + DVec2::new(3.0, -2.0);
        let hit = crate::pick_control_point(&scene, &view, near).unwrap();
        assert_eq!(
            (hit.object.as_str(), hit.index, hit.point),
            ("a", index, point)
        );
        assert!(hit.dragged_to(&view, pixel).unwrap().distance(point) < 1e-9);
        // In the picture, the new position is at the cursor. A point of a curve stays in the plane z = 0, and a point
        // of a patch keeps its depth.
        let to = hit
            .dragged_to(&view, pixel + DVec2::new(40.0, 25.0))
            .unwrap();
        let (at, new_depth) = view.to_pixel(to).unwrap();
        assert!(at.distance(pixel + DVec2::new(40.0, 25.0)) < 1e-6);
        if is_curve {
            assert_eq!(to.z, 0.0);
        } else {
            assert!((new_depth - depth).abs() < 1e-9);
        }
        let beside = pixel + DVec2::new(0.0, -9.0);
        assert_eq!(crate::pick_control_point(&scene, &view, beside), None);
    }
}

#[test]
fn dragging_a_control_point_of_patches_is_one_step() {
    let (mut editor, store) = editor();
    let teapot = include_bytes!("../../../../scenes/assets/teapot.bez");
    store.write(Path::new("teapot.bez"), teapot).unwrap();
    editor.open(Path::new("teapot.bez")).unwrap();
    settled(&mut editor);
    let points = |editor: &Editor| crate::control_points(&editor.view().scene.objects()[0]);
    let to = DVec3::new(0.25, -1.5, 3.0);
    for y in [-1.0, to.y] {
        let to = to.with_y(y);
        editor.move_control_point("teapot", 3, to, false).unwrap();
        settled(&mut editor);
    }
    let text = editor.text();
    assert!(
        text.contains("MovePatchPoint(index: 3, to: (0.25, -1.5, 3)),"),
        "{text}"
    );
    assert_eq!(editor.outline().steps.len(), 2);
    // The first point of the next patch was at the same position, so it moves too.
    assert_eq!([points(&editor)[3], points(&editor)[16]], [to; 2]);
}
