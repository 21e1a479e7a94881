use std::path::Path;

use engine::{Engine, Options, Run, Silent};
use mesh::{Element, VertexId};
use scene::Digest;

use super::*;
use crate::{Action, Command, CommandError, Movement, Picked, Walk, walk};

const CUBE: &str = "// A cube.
(
    recipe: 1,
    steps: [
        Cube(name: \"cube\", size: 2, triangles: true), // the start
    ],
)
";

/// Runs a saved recipe with the engine, without an editor, and returns the digest.
fn replayed(store: Arc<Memory>, path: &str) -> Digest {
    let registry = ops_all::registry();
    let engine = Engine::new(&registry).with_store(store);
    let source = engine.open(path.as_ref()).unwrap();
    let loaded = engine.load(&source, &Options::default());
    assert_eq!(loaded.n_errors(), 0, "{}", source.text);
    let outcome = loaded.run(Run::default(), &Silent);
    assert!(outcome.succeeded(), "{:?}", outcome.failures);
    outcome.digest
}

fn counts(editor: &Editor) -> [usize; 3] {
    let view = editor.view();
    assert!(view.is_current);
    let mesh = view.scene.objects()[0].as_mesh().unwrap().clone();
    [mesh.n_vertices(), mesh.n_edges(), mesh.n_faces()]
}

fn press(editor: &mut Editor, action: Action) {
    let command = editor.command_of(action).unwrap();
    editor.apply(&command).unwrap();
    settled(editor);
}

#[test]
fn a_split_after_a_flip_splits_the_edge_where_it_is_now() {
    let (mut editor, _) = opened(CUBE);
    let mesh = editor.view().scene.objects()[0].as_mesh().unwrap().clone();
    let diagonal = mesh
        .edges()
        .find(|&e| mesh.dihedral_angle(e) == Some(0.0))
        .unwrap();
    editor.set_picked(Some(Picked::one("cube", Element::Edge(diagonal))));
    let before = editor.proposal().unwrap().text.clone();
    let flip = editor.command_of(Action::Flip).unwrap();
    editor.apply(&flip).unwrap();
    // A window reads the selection in every frame, even while the recipe still runs.
    editor.proposal();
    let split = editor.command_of(Action::Split).unwrap();
    if !editor.view().is_current {
        assert_eq!(editor.apply(&split), Err(CommandError::NoScene));
    }
    settled(&mut editor);
    assert_ne!(editor.proposal().unwrap().text, before);
    press(&mut editor, Action::Split);
    assert_eq!(counts(&editor), [9, 21, 14]);
}

#[test]
fn picked_elements_that_a_new_scene_does_not_have_are_dropped() {
    let (mut editor, _) = opened(CUBE);
    let last = mesh::EdgeId::new(17);
    editor.set_picked(Some(Picked::one("cube", Element::Edge(last))));
    let tetrahedron = CUBE.replace(
        "Cube(name: \"cube\", size: 2, triangles: true)",
        "Tetrahedron(name: \"cube\")",
    );
    editor.set_text(&tetrahedron);
    settled(&mut editor);
    assert_eq!(counts(&editor), [4, 6, 4]);
    assert_eq!(editor.picked(), None);
    // The mesh of the preview does not have the picked elements. They are not shown as picked, but they are picked
    // again when the preview ends.
    let (mut editor, _) = opened(CUBE);
    let picked = Picked::one("cube", Element::Edge(last));
    editor.set_picked(Some(picked.clone()));
    let collapse = Command::new("CollapseEdges")
        .with("edges", "Random(count: 5, seed: 1)")
        .with("on_refusal", "Skip");
    editor.preview(&collapse).unwrap();
    settle(&mut editor);
    assert!(counts(&editor)[1] < 17 && editor.picked().is_none());
    editor.end_preview();
    settled(&mut editor);
    assert_eq!(editor.picked(), Some(&picked));
}

#[test]
fn picked_elements_go_only_to_the_first_selection() {
    let (mut editor, _) = opened(CUBE);
    editor.set_picked(Some(Picked::one("cube", Element::Vertex(VertexId::new(2)))));
    let selection = editor.selection();
    let smooth = Command {
        selection,
        ..Command::new("Smooth").with("by", "Taubin()")
    };
    let steps = |command: &Command| editor.steps_of(command).unwrap().concat();
    assert_eq!(
        steps(&smooth),
        "Smooth(vertices: Vertices([2]), by: Taubin())"
    );
    // If the command sets `vertices`, the picked vertex is not used. It must not become the value of the field `pin`.
    assert_eq!(
        steps(&smooth.with("vertices", "Boundary")),
        "Smooth(by: Taubin(), vertices: Boundary)"
    );
}

#[test]
fn dragging_the_same_elements_twice_gives_one_step() {
    let (mut editor, _) = opened(CUBE);
    let digest = editor.run().digest;
    let face = mesh::FaceId::new(0);
    editor.set_picked(Some(Picked::one("cube", Element::Face(face))));
    let start = editor.picked_center().unwrap();
    for x in [0.1, 0.2, 0.3] {
        editor
            .move_picked(Movement::Offset(mesh::DVec3::new(x, 0.0, 0.0)), true)
            .unwrap();
    }
    settled(&mut editor);
    assert_eq!(editor.text(), CUBE);
    assert!((editor.picked_center().unwrap().x - start.x - 0.3).abs() < 1e-12);
    for offset in [
        mesh::DVec3::X * 0.3,
        mesh::DVec3::Y * 0.7,
        mesh::DVec3::X * -0.1,
    ] {
        editor.move_picked(Movement::Offset(offset), true).unwrap();
        editor.move_picked(Movement::Offset(offset), false).unwrap();
        settled(&mut editor);
    }
    assert!(
        editor.text().contains("by: Offset((0.2, 0.7, 0)))"),
        "{}",
        editor.text()
    );
    assert_eq!(editor.outline().steps.len(), 2);
    let moved = editor.picked_center().unwrap() - start;
    assert!(moved.distance(mesh::DVec3::new(0.2, 0.7, 0.0)) < 1e-12);
    // A drag that ends at its start changes nothing.
    let text = editor.text().to_owned();
    editor
        .move_picked(Movement::Offset(mesh::DVec3::X), true)
        .unwrap();
    editor
        .move_picked(Movement::Offset(mesh::DVec3::ZERO), false)
        .unwrap();
    settled(&mut editor);
    assert_eq!(editor.text(), text);
    while editor.undo() {}
    settled(&mut editor);
    assert_eq!(editor.run().digest, digest);
}

#[test]
fn rotating_and_scaling_the_same_elements_change_one_step() {
    let (mut editor, _) = opened(CUBE);
    let face = mesh::FaceId::new(0);
    editor.set_picked(Some(Picked::one("cube", Element::Face(face))));
    let start = editor.picked_center().unwrap();
    let drag = |editor: &mut Editor, movement| {
        editor.move_picked(movement, true).unwrap();
        editor.move_picked(movement, false).unwrap();
        settled(editor);
    };
    drag(&mut editor, Movement::Rotate(1, 30.0));
    drag(&mut editor, Movement::Rotate(1, 15.0));
    assert!(
        editor.text().contains("by: Rotate(axis: Y, angle: 45))"),
        "{}",
        editor.text()
    );
    drag(&mut editor, Movement::Rotate(0, 10.0));
    drag(
        &mut editor,
        Movement::Scale(mesh::DVec3::new(2.0, 1.0, 1.0)),
    );
    drag(&mut editor, Movement::Scale(mesh::DVec3::splat(0.5)));
    assert!(
        editor.text().contains("by: Scale((1, 0.5, 0.5)))"),
        "{}",
        editor.text()
    );
    // The four steps are the cube, two rotations around different axes, and one scaling.
    assert_eq!(editor.outline().steps.len(), 4);
    // Rotations and scalings do not move the center of the picked elements.
    assert!(editor.picked_center().unwrap().distance(start) < 1e-12);
    // A drag that ends at its start does not change the recipe.
    let text = editor.text().to_owned();
    drag(&mut editor, Movement::Rotate(2, 0.0));
    assert_eq!(editor.text(), text);
}

#[test]
fn patches_become_a_mesh_by_one_change() {
    let (mut editor, store) = editor();
    let teapot = include_bytes!("../../../../scenes/assets/teapot.bez");
    store.write(Path::new("teapot.bez"), teapot).unwrap();
    editor.open(Path::new("teapot.bez")).unwrap();
    settled(&mut editor);
    assert_eq!(editor.patches(), ["teapot"]);
    let text = editor.text().to_owned();
    editor.turn_into_mesh().unwrap();
    settled(&mut editor);
    assert!(counts(&editor)[0] > 1000);
    assert!(editor.patches().is_empty());
    assert!(
        editor
            .text()
            .contains("Tessellate(),\n        Weld(distance: 0),"),
        "{}",
        editor.text()
    );
    assert!(editor.undo());
    assert_eq!(editor.text(), text);
    // If the scene has other objects, the step `Weld` is limited to the object that had the patches.
    editor
        .apply(&Command::new("Cube").with("name", "\"a\""))
        .unwrap();
    settled(&mut editor);
    editor.turn_into_mesh().unwrap();
    settled(&mut editor);
    assert!(
        editor
            .text()
            .contains("(run: Weld(distance: 0), on: [\"teapot\"])"),
        "{}",
        editor.text()
    );
}

#[test]
fn the_steps_after_a_preview_keep_their_results() {
    let text = "(recipe: 1, steps: [Cube(name: \"a\"), PokeFaces()])";
    let (mut editor, _) = opened(text);
    editor.set_cursor(1);
    editor.preview(&Command::new("Reverse")).unwrap();
    settled(&mut editor);
    let name = |editor: &Editor, item| {
        editor.run().steps[editor.steps_of_item(item)][0]
            .name
            .clone()
    };
    assert_eq!([name(&editor, 0), name(&editor, 1)], ["Cube", "PokeFaces"]);
}

#[test]
fn a_session_gives_a_recipe_that_replays_to_the_same_digest() {
    let (mut editor, store) = opened(CUBE);
    assert_eq!(counts(&editor), [8, 18, 12]);
    // The edge between two coplanar triangles is a diagonal of a face of the cube.
    let mesh = editor.view().scene.objects()[0].as_mesh().unwrap().clone();
    let diagonal = mesh
        .edges()
        .find(|&e| mesh.dihedral_angle(e) == Some(0.0))
        .unwrap();
    editor.set_picked(Some(Picked::one("cube", Element::Edge(diagonal))));
    press(&mut editor, Action::Flip);
    assert_eq!(counts(&editor), [8, 18, 12]);
    let flipped = editor.run().digest;
    press(&mut editor, Action::Split);
    assert_eq!(counts(&editor), [9, 21, 14]);
    press(&mut editor, Action::Loop);
    assert_eq!(counts(&editor)[2], 56);
    let whole = editor.run().digest.unwrap();

    assert!(editor.undo() && editor.undo());
    settled(&mut editor);
    assert_eq!((editor.run().digest, editor.run().ran), (flipped, 0));
    assert_eq!(counts(&editor), [8, 18, 12]);
    assert!(editor.redo() && editor.redo() && !editor.redo());
    settled(&mut editor);
    assert_eq!((editor.run().digest, editor.run().ran), (Some(whole), 0));

    editor.preview_parameter(3, &["levels"], "3").unwrap();
    settled(&mut editor);
    assert_eq!(counts(&editor)[2], 14 * 64);
    editor.preview_parameter(3, &["levels"], "2").unwrap();
    settled(&mut editor);
    assert!(editor.is_preview() && editor.text().contains("LoopSubdivide(levels: 1)"));
    editor.set_parameter(3, &["levels"], Some("2")).unwrap();
    settled(&mut editor);
    assert_eq!(
        (counts(&editor)[2], editor.run().ran, editor.is_preview()),
        (14 * 16, 0, false)
    );

    assert!(editor.document().is_dirty());
    editor.save().unwrap();
    assert!(!editor.document().is_dirty());
    assert_eq!(Some(replayed(store, "a.ron")), editor.run().digest);
    let [v, w] = mesh.edge_vertices(diagonal).map(VertexId::index);
    let (v, w) = (v.min(w), v.max(w));
    let lines: Vec<&str> = editor.text().lines().map(str::trim).collect();
    assert_eq!(lines[..2], ["// A cube.", "("]);
    assert_eq!(
        lines[4],
        "Cube(name: \"cube\", size: 2, triangles: true), // the start"
    );
    assert_eq!(lines[5], format!("FlipEdges(edges: Between({v}, {w})),"));
    assert!(
        lines[6].starts_with("SplitEdges(edges: Between("),
        "{}",
        lines[6]
    );
    assert_eq!(lines[7], "LoopSubdivide(levels: 2),");
}

#[test]
fn a_step_goes_after_the_cursor_and_the_view_shows_the_scene_there() {
    let (mut editor, _) = opened(CUBE);
    editor
        .apply(&Command::new("LoopSubdivide").with("levels", "1"))
        .unwrap();
    settled(&mut editor);
    editor.set_cursor(1);
    assert_eq!(counts(&editor)[2], 12);
    editor.apply(&Command::new("Reverse")).unwrap();
    settled(&mut editor);
    assert_eq!(editor.cursor(), 2);
    assert_eq!(counts(&editor)[2], 12);
    editor.set_cursor(3);
    assert_eq!(counts(&editor)[2], 48);
    editor.set_cursor(0);
    assert!(editor.view().scene.objects().is_empty() && editor.view().is_current);
    let names: Vec<&str> = editor
        .outline()
        .steps
        .iter()
        .map(|step| step.name.as_str())
        .collect();
    assert_eq!(names, ["Cube", "Reverse", "LoopSubdivide"]);
}

#[test]
fn a_step_that_fails_keeps_the_recipe_and_the_scene_before_it() {
    let (mut editor, _) = opened(CUBE);
    editor
        .apply(&Command::new("FlipEdges").with("edges", "Between(0, 7)"))
        .unwrap();
    settle(&mut editor);
    let run = editor.run();
    assert!(run.has_failed());
    let failure = run.failures[0].diagnostic.clone();
    assert_eq!(failure.span.unwrap().of(editor.text()), "FlipEdges");
    let view = editor.view();
    assert!(!view.is_current && view.scene.objects().len() == 1);
    assert!(editor.undo());
    settled(&mut editor);
    assert!(editor.view().is_current);
}

#[test]
fn a_command_without_its_selection_or_with_a_wrong_value_changes_nothing() {
    let (mut editor, _) = opened(CUBE);
    let text = editor.text().to_owned();
    let flip = editor.command_of(Action::Flip).unwrap();
    assert_eq!(
        editor.apply(&flip).unwrap_err().to_string(),
        "FlipEdges needs edges: pick some first"
    );
    let wrong = Command::new("LoopSubdivide").with("levels", "-1");
    let Err(CommandError::Parameter { field, .. }) = editor.apply(&wrong) else {
        panic!()
    };
    assert_eq!(field, "levels");
    assert!(matches!(
        editor.apply(&Command::new("Flip")),
        Err(CommandError::Unknown(_))
    ));
    assert_eq!(editor.text(), text);
    assert!(!editor.undo());
}

#[test]
fn a_model_becomes_a_recipe_that_loads_it() {
    let (mut editor, store) = editor();
    store
        .write(
            Path::new("m/a.obj"),
            b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        )
        .unwrap();
    editor.open(Path::new("m/a.obj")).unwrap();
    settled(&mut editor);
    assert!(editor.text().contains("Load(path: \"a.obj\")"));
    assert_eq!(counts(&editor), [3, 3, 1]);
    assert_eq!(
        (editor.document().path(), editor.document().has_file()),
        (Path::new("m/a.ron"), false)
    );
    assert!(
        editor.open(Path::new("m/b.obj")).is_err() && editor.open(Path::new("m/a.txt")).is_err()
    );
}

#[test]
fn keys_walk_over_half_edges() {
    let (editor, _) = opened(CUBE);
    let mesh = editor.view().scene.objects()[0].as_mesh().unwrap().clone();
    let h = mesh.half_edges().next().unwrap();
    let go = |steps: &[Walk]| steps.iter().fold(h, |h, &step| walk(&mesh, h, step));
    assert_eq!(go(&[Walk::Next, Walk::Next, Walk::Next]), h);
    assert_eq!(go(&[Walk::Twin, Walk::Twin]), h);
    assert_eq!(go(&[Walk::Next, Walk::Previous]), h);
    let around = vec![Walk::AroundVertex; mesh.valence(mesh.origin(h))];
    assert_eq!(go(&around), h);
    let info = crate::HalfEdgeInfo::of(&mesh, h).unwrap();
    assert_eq!(
        (info.next, info.twin, info.target),
        (mesh.next(h), h.twin(), mesh.target(h))
    );
}

#[test]
fn disabled_steps_do_not_run() {
    let (mut editor, store) = opened(CUBE);
    let start = editor.run().digest;
    editor
        .apply(&Command::new("LoopSubdivide").with("levels", "1"))
        .unwrap();
    settled(&mut editor);
    editor.set_enabled(1, false).unwrap();
    settled(&mut editor);
    assert!(
        editor
            .text()
            .contains("(run: LoopSubdivide(levels: 1), enabled: false),")
    );
    assert_eq!((editor.run().digest, editor.run().ran), (start, 0));
    assert_eq!(counts(&editor)[2], 12);
    editor.save().unwrap();
    assert_eq!(Some(replayed(store, "a.ron")), start);
    editor.set_enabled(1, true).unwrap();
    assert!(
        editor
            .text()
            .contains("        LoopSubdivide(levels: 1),\n")
    );
}

#[test]
fn a_disabled_step_is_not_checked_and_neither_are_expectations_after_it() {
    let text =
        "(recipe: 1, params: {\"smooth\": Bool(default: false), \"n\": Int(default: 1)}, steps: [
        Cube(name: \"a\", triangles: true),
        (id: \"loop\", run: LoopSubdivide(levels: arg(\"n\")), enabled: arg(\"smooth\")),
        (run: Nonsense(a: [1, 2]), enabled: false),
        (run: Repeat(times: 2, steps: [Sqrt3(levels: 1)]), enabled: false),
    ], expect: [(after: \"loop\", that: Faces(eq: 48)), Faces(max: 100)])";
    let (mut editor, _) = opened(text);
    settled(&mut editor);
    assert_eq!(editor.run().diagnostics, []);
    assert_eq!(
        (editor.run().steps.len(), editor.run().expectations.len()),
        (1, 1)
    );
    editor.set_recipe_parameter("smooth", "true").unwrap();
    settled(&mut editor);
    assert_eq!(
        (editor.run().steps.len(), editor.run().expectations.len()),
        (2, 2)
    );
    editor.set_enabled(2, true).unwrap();
    settle(&mut editor);
    assert!(editor.run().has_failed());
    let text = editor
        .text()
        .replace("enabled: arg(\"smooth\")", "enabled: 1");
    editor.set_text(&text);
    settle(&mut editor);
    assert!(
        editor
            .run()
            .diagnostics
            .iter()
            .any(|d| d.message.contains("`enabled`"))
    );
}
