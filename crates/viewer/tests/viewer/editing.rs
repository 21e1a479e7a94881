//! Tests that edit recipes in the window.

use std::path::Path;
use std::time::{Duration, Instant};

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use engine::{Engine, Options, Run, Silent};
use viewer::{App, Start};

use crate::adapter::setup;
use crate::window::{CUBE, Window};

/// Runs a recipe without the window, and returns its digest.
fn digest(path: &Path) -> String {
    let registry = ops_all::registry();
    let engine = Engine::new(&registry);
    let recipe = engine.load(&engine.open(path).unwrap(), &Options::default());
    assert!(!recipe.has_errors(), "{:?}", recipe.diagnostics);
    recipe.run(Run::default(), &Silent).digest.to_string()
}

#[test]
fn a_cube_is_edited_by_clicks_and_keys_and_its_recipe_replays_to_the_same_digest() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    let [v, w] = window.visible_edge();
    let at = window.at(window.edge_middle(v, w));
    window.click(at, Modifiers::NONE);
    assert!(
        window
            .harness
            .query_all_by_label_contains(&format!("edge {v} to {w}"))
            .next()
            .is_some()
    );
    window.check_picture("picked");

    window.press(Key::F);
    assert!(
        window
            .text()
            .contains(&format!("FlipEdges(edges: Between({v}, {w}))")),
        "{}",
        window.text()
    );
    let flipped = window.text();
    let [v, w] = window.visible_edge();
    let at = window.at(window.edge_middle(v, w));
    window.click(at, Modifiers::NONE);
    window.press(Key::S);
    assert!(window.text().contains("SplitEdges"), "{}", window.text());
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.text(), flipped);
    window.press_with(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert!(window.text().contains("SplitEdges"));
    window.press(Key::L);
    assert!(
        window.text().contains("LoopSubdivide(levels: 1)"),
        "{}",
        window.text()
    );

    // The panel of the step has a slider for `levels`.
    window
        .harness
        .get_by_role_and_label(Role::Slider, "levels")
        .set_value_accesskit(3.0);
    window.settle();
    assert!(
        window.text().contains("LoopSubdivide(levels: 3)"),
        "{}",
        window.text()
    );
    window.check_picture("subdivided");

    window.press_with(Modifiers::COMMAND, Key::S);
    let saved = std::fs::read_to_string(window.path("cube.ron")).unwrap();
    assert_eq!(saved, window.text());
    assert!(saved.contains("// The start of everything."));
    let shown = window
        .harness
        .state()
        .editor()
        .run()
        .digest
        .unwrap()
        .to_string();
    assert_eq!(digest(&window.path("cube.ron")), shown);
}

#[test]
fn a_recipe_with_an_error_keeps_its_text_and_shows_the_message() {
    let text = CUBE.replace("Cube(", "Cubee(");
    let Some(mut window) = Window::open("cube.ron", &text) else {
        return;
    };
    assert!(
        window
            .harness
            .query_all_by_label_contains("Cubee")
            .next()
            .is_some()
    );
    assert_eq!(window.text(), text);
    window.check_picture("error");
    // After the error is corrected, the scene has the cube again.
    let corrected = text.replace("Cubee(", "Cube(");
    window.harness.state_mut().editor_mut().set_text(&corrected);
    window.settle();
    assert_eq!(
        window.harness.state().editor().view().scene.objects().len(),
        1
    );
}

#[test]
fn a_file_that_changes_on_disk_is_followed() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    let changed = CUBE.replace(
        "size: arg(\"size\"), triangles: true",
        "size: 3, triangles: false",
    );
    std::fs::write(window.path("cube.ron"), &changed).unwrap();
    let end = Instant::now() + Duration::from_secs(30);
    while window.text() != changed {
        assert!(Instant::now() < end, "the change is not followed");
        std::thread::sleep(Duration::from_millis(20));
        window.settle();
    }
    window.settle();
    assert_eq!(
        window.harness.state().editor().view().scene.objects()[0]
            .as_mesh()
            .unwrap()
            .n_faces(),
        6
    );
}

#[test]
fn an_idle_window_asks_for_no_repaint() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    window.harness.run_steps(20);
    let delays: Vec<Duration> = window
        .harness
        .output()
        .viewport_output
        .values()
        .map(|output| output.repaint_delay)
        .collect();
    assert!(
        delays.iter().all(|delay| *delay > Duration::from_secs(10)),
        "{delays:?}"
    );
}

#[test]
fn the_palette_finds_operations_and_the_help_lists_all_keys() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    window.press_with(Modifiers::COMMAND, Key::K);
    window
        .harness
        .get_by_label("Search operations")
        .type_text("poke");
    window.settle();
    window.check_picture("palette");
    window.press(Key::Enter);
    assert!(window.text().contains("PokeFaces"), "{}", window.text());
    window.press(Key::H);
    for text in [
        "Keys and mouse",
        "flip the picked edges",
        "search all operations",
    ] {
        assert!(
            window.harness.query_by_label_contains(text).is_some(),
            "{text}"
        );
    }
    window.check_picture("help");
    window.press(Key::Escape);
    assert!(
        window
            .harness
            .query_by_label_contains("Keys and mouse")
            .is_none()
    );
}

#[test]
fn a_new_step_shows_the_selection_that_it_takes() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    let [v, w] = window.visible_edge();
    let middle = window.at(window.edge_middle(v, w));
    window.click(middle, Modifiers::NONE);
    window.press_with(Modifiers::COMMAND, Key::K);
    window
        .harness
        .get_by_label("Search operations")
        .type_text("TagEdges");
    window.settle();
    window.press(Key::Enter);
    let field = window
        .harness
        .get_by_role_and_label(Role::TextInput, "edges");
    let value = field.value();
    let value = value.as_deref().unwrap_or_default().to_owned();
    assert!(value.starts_with("Between("), "{value}");
    window.harness.get_by_label("Apply").click();
    window.settle();
    let step = format!("TagEdges(edges: {value}, name: ");
    assert!(window.text().contains(&step), "{}", window.text());
}

#[test]
fn the_panel_shows_pictures_of_an_example_before_and_after_the_operation() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    window.press(Key::L);
    let pictures = |window: &Window| {
        let of = ["before", "after"].map(|when| format!("An example {when} LoopSubdivide"));
        of.map(|label| window.harness.query_by_label(&label).is_some())
    };
    assert_eq!(pictures(&window), [false, false]);
    window.harness.get_by_label("About this operation").click();
    window.settle();
    assert_eq!(pictures(&window), [true, true]);
    window.check_picture("about");
}

#[test]
fn an_unsaved_text_is_offered_after_a_crash() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    window.press(Key::L);
    let lost = window.text();
    let Window { harness, folder } = window;
    // `forget` ends the window without the events that are sent when a window is closed. A crash has the same effect.
    std::mem::forget(harness);
    let start = Start {
        path: None,
        state_folder: Some(folder.path().join("state")),
        ..Start::default()
    };
    let Some(setup) = setup() else { return };
    let harness = Harness::builder()
        .with_size(Vec2::new(1280.0, 800.0))
        .with_max_steps(60)
        .wgpu_setup(setup)
        .build_eframe(|cc| App::new(&cc.egui_ctx, cc.wgpu_render_state.as_ref(), start));
    let mut window = Window { harness, folder };
    window.settle();
    window.harness.get_by_label("Recover").click();
    window.settle();
    assert_eq!(window.text(), lost);
}

#[test]
fn the_help_of_the_course_walks_around_half_edges() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    let [v, w] = window.visible_edge();
    let at = window.at(window.edge_middle(v, w));
    window.click(at, Modifiers::NONE);
    let half_edge = |window: &Window| {
        window
            .harness
            .state()
            .editor()
            .picked()
            .unwrap()
            .half_edge
            .unwrap()
    };
    let start = half_edge(&window);
    window.press(Key::T);
    assert_eq!(half_edge(&window), start.twin());
    window.press(Key::T);
    for _ in 0..3 {
        window.press(Key::N);
    }
    assert_eq!(half_edge(&window), start);
    window.press(Key::N);
    window.press(Key::P);
    assert_eq!(half_edge(&window), start);
}

#[test]
fn the_teapot_is_colored_by_curvature_in_a_light_window() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/assets/teapot.bez");
    let teapot = std::fs::read_to_string(path).unwrap();
    let Some(mut window) = Window::open("teapot.bez", &teapot) else {
        return;
    };
    let text = window.text().replace("Load(path: \"teapot.bez\"),", "Load(path: \"teapot.bez\"),\n        Tessellate(segments: 10),\n        Weld(distance: 1e-6),");
    window.harness.state_mut().editor_mut().set_text(&text);
    window.harness.state_mut().editor_mut().set_cursor(3);
    window.settle();
    window
        .harness
        .get_by_role_and_label(Role::ComboBox, "Color by")
        .click();
    window.settle();
    window.harness.get_by_label("mean curvature").click();
    window.settle();
    window.harness.ctx.set_theme(eframe::egui::Theme::Light);
    window.press(Key::Space);
    window.check_picture("curvature");
}

#[test]
fn keys_belong_to_an_open_list_of_choices_and_escape_closes_it() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    window
        .harness
        .get_by_role_and_label(Role::ComboBox, "Color by")
        .click();
    window.settle();
    let text = window.text();
    window.press(Key::L);
    assert_eq!(window.text(), text);
    assert!(window.harness.query_by_label("mean curvature").is_some());
    window.press(Key::Escape);
    assert!(window.harness.query_by_label("mean curvature").is_none());
    window.press(Key::L);
    assert_ne!(window.text(), text);
}
