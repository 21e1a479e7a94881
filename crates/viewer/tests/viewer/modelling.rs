//! Tests that model meshes in the window: panels with live previews, handles, selections, animations and file paths.

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, Pos2, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use mesh::{DVec3, Mesh};
use viewer::{App, Start};

use crate::adapter::setup;
use crate::window::{CUBE, Window};

fn mesh_of(window: &Window) -> Arc<Mesh> {
    let scene = window.harness.state().editor().view().scene;
    scene.objects()[0].as_mesh().unwrap().clone()
}

/// Picks the face of the cube whose normal is the z axis, and returns its center.
fn pick_front(window: &mut Window) -> DVec3 {
    let mesh = mesh_of(window);
    let face = mesh.faces().find(|&f| mesh.face_normal(f).z > 0.9).unwrap();
    let center = mesh.face_center(face);
    let at = window.at(center);
    window.click(at, Modifiers::NONE);
    center
}

#[test]
fn after_a_click_in_the_view_space_resets_it_and_tab_begins_the_keyboard_focus() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    let corner = DVec3::splat(1.0);
    window.press(Key::Space);
    let home = window.at(corner);
    let beside = window.at(DVec3::ZERO) + Vec2::new(170.0, 130.0);
    window.drag(&[beside, beside + Vec2::splat(60.0)], Modifiers::NONE);
    assert!(window.at(corner).distance(home) > 5.0);
    pick_front(&mut window);
    window.press(Key::Space);
    assert!(window.at(corner).distance(home) < 0.5);
    let focus = |window: &Window| window.harness.ctx.memory(eframe::egui::Memory::focused);
    assert_eq!(focus(&window), None);
    window.press(Key::Tab);
    assert!(focus(&window).is_some());
}

#[test]
fn keys_for_steps_do_nothing_while_text_is_typed() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    window.harness.get_by_label("Recipe text").focus();
    window.settle();
    for key in [Key::D, Key::E, Key::Delete] {
        window.press_with(Modifiers::COMMAND, key);
        let outline = editor::Outline::of(&window.text());
        assert_eq!(outline.steps.len(), 1, "{key:?}");
        assert!(outline.steps[0].enabled, "{key:?}");
    }
}

#[test]
fn the_patches_of_the_teapot_become_a_mesh_by_a_button() {
    let teapot = include_str!("../../../../scenes/assets/teapot.bez");
    let Some(mut window) = Window::open("teapot.bez", teapot) else {
        return;
    };
    window.harness.get_by_label("Turn into a mesh").click();
    window.settle();
    assert!(mesh_of(&window).n_faces() > 1000);
    assert!(
        window.text().contains("Weld(distance: 0)"),
        "{}",
        window.text()
    );
    assert!(window.harness.query_by_label("Turn into a mesh").is_none());
}

#[test]
fn the_help_of_an_error_is_shown_with_its_message() {
    let text = CUBE.replace("triangles: true", "triangle: true");
    let Some(window) = Window::open("cube.ron", &text) else {
        return;
    };
    let run = window.harness.state().editor().run();
    let help = run.diagnostics.iter().find_map(|d| d.help.clone()).unwrap();
    assert!(
        window.harness.query_by_label_contains(&help).is_some(),
        "{help}"
    );
}

#[test]
fn the_content_of_a_variant_has_its_own_number_field() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    pick_front(&mut window);
    window.press(Key::E);
    assert!(
        window.text().contains("by: Distance(0.4)"),
        "{}",
        window.text()
    );
    window
        .harness
        .get_by_role_and_label(Role::SpinButton, "Distance")
        .set_value_accesskit(0.75);
    window.settle();
    assert!(
        window.text().contains("by: Distance(0.75)"),
        "{}",
        window.text()
    );
    window.check_picture("extruded");
}

#[test]
fn the_size_of_a_picture_has_two_number_fields() {
    let recipe = "(recipe: 1, steps: [Cube(), Picture(path: \"a.png\", size: (1600, 900))])";
    let Some(mut window) = Window::open("a.ron", recipe) else {
        return;
    };
    for (name, new, expected) in [
        ("size x", 800.0, "size: (800, 900)"),
        ("size y", 600.4, "size: (800, 600)"),
        ("size y", 0.0, "size: (800, 1)"),
    ] {
        let harness = &window.harness;
        let field = harness.get_by_role_and_label(Role::SpinButton, name);
        field.set_value_accesskit(new);
        window.settle();
        assert!(window.text().contains(expected), "{}", window.text());
    }
}

#[test]
fn a_recorded_test_is_about_the_scene_at_the_cursor() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    window.press(Key::L);
    window.harness.state_mut().editor_mut().set_cursor(1);
    window.settle();
    window.harness.get_by_label("Record a test").click();
    window.settle();
    let text = window.text();
    assert!(
        text.contains("(after: \"cube\", that: [") && text.contains("Faces(eq: 12)"),
        "{text}"
    );
    assert!(!window.harness.state().editor().run().has_failed());
}

#[test]
fn a_new_step_is_previewed_while_its_parameters_are_chosen() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    let open = |window: &mut Window| {
        pick_front(window);
        window.press_with(Modifiers::COMMAND, Key::K);
        window
            .harness
            .get_by_label("Search operations")
            .type_text("ExtrudeFaces");
        window.settle();
        window.press(Key::Enter);
        window.settle();
    };
    let height = |window: &Window| {
        let mesh = mesh_of(window);
        mesh.positions().iter().map(|p| p.z).fold(0.0, f64::max)
    };
    open(&mut window);
    assert_eq!(window.text(), CUBE);
    assert!(mesh_of(&window).n_faces() > 12);
    window
        .harness
        .get_by_role_and_label(Role::SpinButton, "Distance")
        .set_value_accesskit(2.0);
    window.settle();
    assert!((height(&window) - 3.0).abs() < 1e-9, "{}", height(&window));
    window.harness.get_by_label("Cancel").click();
    window.settle();
    assert_eq!(
        (mesh_of(&window).n_faces(), window.text()),
        (12, CUBE.to_owned())
    );
    open(&mut window);
    window.harness.get_by_label("Apply").click();
    window.settle();
    assert!(
        window.text().contains("ExtrudeFaces(faces: Faces(["),
        "{}",
        window.text()
    );
}

#[test]
fn dragging_a_ring_rotates_and_dragging_the_center_scales_the_picked_face() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    let center = pick_front(&mut window);
    window.press_with(Modifiers::SHIFT, Key::R);
    // The drag below starts on the handle that is a ring around the z axis. The radius of a ring is 84 logical pixels,
    // measured in a direction parallel to the screen.
    let back = DVec3::new(0.46, 0.37, 0.8).normalize();
    let aside = back.cross(DVec3::Y).normalize();
    let pixels = window.at(center + aside * 0.1).distance(window.at(center));
    let radius = 84.0 * 0.1 / f64::from(pixels);
    let nearest = libm::atan2(back.y, back.x);
    let ring = |degrees: f64| {
        let angle = nearest + degrees.to_radians();
        center + radius * DVec3::new(libm::cos(angle), libm::sin(angle), 0.0)
    };
    let through: Vec<Pos2> = [0.0, 8.0, 20.0, 35.0].map(|a| window.at(ring(a))).into();
    window.drag(&through, Modifiers::NONE);
    let text = window.text();
    assert!(text.contains("by: Rotate(axis: Z, angle: "), "{text}");
    let before = window.at(center);
    window.press_with(Modifiers::SHIFT, Key::S);
    window.drag(&[before, before + Vec2::new(42.0, 0.0)], Modifiers::NONE);
    let text = window.text();
    assert!(text.contains("by: Scale((1.5, 1.5, 1.5))"), "{text}");
    window.check_picture("scaling");
}

#[test]
fn a_selection_is_typed_and_a_path_is_picked_between_two_vertices() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    let line = window.harness.get_by_label("Selection");
    line.focus();
    line.type_text("Sharp(above: 30)");
    window.settle();
    window.press(Key::Enter);
    let picked = window.harness.state().editor().picked().cloned();
    assert_eq!(picked.unwrap().len(), 12);
    window.press(Key::S);
    assert!(
        window
            .text()
            .contains("SplitEdges(edges: Sharp(above: 30))"),
        "{}",
        window.text()
    );
    window.press_with(Modifiers::COMMAND, Key::Z);
    window.press_with(Modifiers::ALT, Key::Num1);
    let [v, w] = window.visible_edge();
    let mesh = mesh_of(&window);
    for (i, modifiers) in [(v, Modifiers::NONE), (w, Modifiers::SHIFT)] {
        let at = window.at(mesh.position(mesh::VertexId::new(i)));
        window.click(at, modifiers);
    }
    window.press_with(Modifiers::SHIFT, Key::P);
    window.press(Key::S);
    let text = window.text();
    assert!(
        text.contains("SplitEdges(edges: Expect(count: 1, of: Path(from: "),
        "{text}"
    );
}

#[test]
fn the_played_edits_are_saved_as_an_animation() {
    let text = CUBE.replace(
        "    ],\n    expect",
        "        FlipEdges(edges: Random(count: 5, seed: 3), on_refusal: Skip),\n    ],\n    expect",
    );
    let Some(mut window) = Window::open("cube.ron", &text) else {
        return;
    };
    window.harness.get_by_label("Play the edits").click();
    window.settle();
    for (name, file, start) in [
        ("Export as GIF", "cube.gif", b"GIF89a".as_slice()),
        ("Export as APNG", "cube.png", b"\x89PNG"),
    ] {
        window.harness.get_by_label(name).click();
        window.settle();
        // The dialog suggests a file in the folder of the recipe. The Enter key accepts this file.
        window.press(Key::Enter);
        let file = window.path(file);
        let end = Instant::now() + Duration::from_mins(1);
        while window.harness.query_by_label_contains("Saved ").is_none() {
            assert!(Instant::now() < end, "the animation is not written");
            window.harness.run_steps(2);
        }
        let bytes = std::fs::read(&file).unwrap();
        assert!(bytes.starts_with(start));
        // The notice "Saved .." disappears when the next key is pressed.
        window.press(Key::Escape);
    }
}

#[test]
fn without_dialogs_of_the_system_a_path_is_written_in_the_window() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    window.press(Key::L);
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    let other = window.path("other.ron");
    window.press_with(Modifiers::COMMAND, Key::A);
    window
        .harness
        .get_by_label("Path of the file")
        .type_text(&other.display().to_string());
    window.settle();
    window.press(Key::Enter);
    assert_eq!(std::fs::read_to_string(&other).unwrap(), window.text());
    assert_eq!(window.harness.state().editor().document().path(), other);
    // A file that does not exist cannot be opened.
    window.press_with(Modifiers::COMMAND, Key::O);
    let missing: &Path = Path::new("missing.ron");
    window
        .harness
        .get_by_label("Path of the file")
        .type_text(&missing.display().to_string());
    window.settle();
    assert!(
        window
            .harness
            .query_by_label("This file does not exist.")
            .is_some()
    );
    window.press(Key::Escape);
    assert!(window.harness.query_by_label("Path of the file").is_none());
}

#[test]
fn a_key_and_the_search_offer_the_tag_that_fits_the_picked_elements() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    pick_front(&mut window);
    let is_open = |window: &Window| {
        let title = window.harness.query_by_label("New step: TagFaces");
        title.is_some()
    };
    window.press_with(Modifiers::COMMAND, Key::K);
    let search = window.harness.get_by_label("Search operations");
    search.type_text("tag");
    window.settle();
    window.press(Key::Enter);
    assert!(is_open(&window));
    window.press(Key::Escape);
    assert!(!is_open(&window));
    window.press(Key::M);
    assert!(is_open(&window));
}

const GRID: &str = "(recipe: 1, steps: [Grid(name: \"grid\", columns: 2, rows: 2)])";

#[test]
fn without_dialogs_of_the_system_a_list_shows_folders_and_files() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    std::fs::create_dir(window.path("models")).unwrap();
    std::fs::write(window.path("models/two.ron"), GRID).unwrap();
    std::fs::write(window.path("models/notes.txt"), "").unwrap();
    std::fs::write(window.path("above.ron"), GRID).unwrap();
    window.press_with(Modifiers::COMMAND, Key::O);
    let click = |window: &mut Window, name: &str| {
        window.harness.get_by_label(name).click();
        window.settle();
    };
    assert!(window.harness.query_by_label("above.ron").is_some());
    click(&mut window, "models/");
    // The list of the folder `models` does not contain `notes.txt`, because that file is not a recipe. The list also
    // does not contain the files of the parent folder.
    for name in ["notes.txt", "above.ron"] {
        assert!(window.harness.query_by_label(name).is_none(), "{name}");
    }
    for name in ["../", "models/", "two.ron"] {
        click(&mut window, name);
    }
    window.press(Key::Enter);
    let path = window.harness.state().editor().document().path().to_owned();
    assert_eq!(path, window.path("models/two.ron"));
    assert_eq!(window.text(), GRID);
}

#[test]
fn a_window_has_the_operations_that_it_is_given() {
    let Some(setup) = setup() else { return };
    let start = Start {
        registry: Arc::default(),
        ..Start::default()
    };
    let mut harness = Harness::builder()
        .with_size(Vec2::new(1280.0, 800.0))
        .with_max_steps(60)
        .wgpu_setup(setup)
        .build_eframe(|cc| App::new(&cc.egui_ctx, cc.wgpu_render_state.as_ref(), start));
    let end = Instant::now() + Duration::from_mins(1);
    while harness.state().editor().is_running() && Instant::now() < end {
        harness.run_steps(2);
    }
    let diagnostics = &harness.state().editor().run().diagnostics;
    assert!(
        diagnostics.iter().any(|d| d.message.contains("Cube")),
        "{diagnostics:?}"
    );
}
