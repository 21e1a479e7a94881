//! Tests of the arrows, the lasso, the player of edits, the labels of widgets, the layout, control points, and a window
//! that cannot draw.

use std::sync::Arc;

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, Pos2, Vec2, ViewportCommand};
use eframe::egui_wgpu::{RenderState, RendererOptions, WgpuSetup};
use eframe::wgpu;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use egui_kittest::wgpu::create_render_state;
use viewer::{App, Start};

use crate::adapter::setup;
use crate::window::{CUBE, Window};

#[test]
fn dragging_an_arrow_moves_the_picked_face() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    let scene = window.harness.state().editor().view().scene;
    let mesh = scene.objects()[0].as_mesh().unwrap().clone();
    let face = mesh.faces().find(|&f| mesh.face_normal(f).z > 0.9).unwrap();
    let center = mesh.face_center(face);
    let at = window.at(center);
    window.click(at, Modifiers::NONE);
    window.press(Key::G);
    // The drag starts on the arrow of the y axis, and follows the arrow upwards.
    let [base, above] = [0.0, 0.1].map(|y| window.at(center + mesh::DVec3::Y * y));
    let up = (above - base).normalized();
    let points: Vec<Pos2> = [50.0, 55.0, 70.0, 90.0].map(|t| base + up * t).into();
    window.drag(&points, Modifiers::NONE);
    let text = window.text();
    assert!(
        text.contains("MoveVertices(vertices: ") && text.contains("by: Offset((0, 0."),
        "{text}"
    );
    let scene = window.harness.state().editor().view().scene;
    let moved = scene.objects()[0].as_mesh().unwrap().face_center(face) - center;
    // On the screen, the face has moved by the same distance as the cursor: 40 pixels.
    let pixels = window.at(center + moved).distance(window.at(center));
    assert!((pixels - 40.0).abs() < 2.0, "{pixels} {moved}");
    assert!(moved.x == 0.0 && moved.z == 0.0);
    // A drag that starts beside the arrows turns the view and does not change the recipe.
    let beside = base + Vec2::new(150.0, 120.0);
    window.drag(&[beside, beside + Vec2::splat(30.0)], Modifiers::NONE);
    assert_eq!(window.text(), text);
}

#[test]
fn a_lasso_picks_the_vertices_inside() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    window.press_with(Modifiers::ALT, Key::Num1);
    let scene = window.harness.state().editor().view().scene;
    let mesh = scene.objects()[0].as_mesh().unwrap().clone();
    let v = mesh::VertexId::new(window.visible_edge()[0]);
    let at = window.at(mesh.position(v));
    let corners = [(-12.0, -12.0), (14.0, -10.0), (12.0, 12.0), (-12.0, 10.0)];
    let points = corners.map(|(x, y)| at + Vec2::new(x, y));
    window.drag(&points, Modifiers::COMMAND);
    let picked = window.harness.state().editor().picked().cloned().unwrap();
    assert_eq!(picked.elements, op::Selected::Vertices(vec![v]));
    window.drag(&points, Modifiers::COMMAND | Modifiers::ALT);
    assert_eq!(window.harness.state().editor().picked(), None);
}

#[test]
fn the_edits_of_a_step_are_played_forwards_and_backwards() {
    let text = CUBE.replace(
        "\n    ],\n    expect",
        "\n        FlipEdges(edges: Random(count: 5, seed: 3), on_refusal: Skip),\n    ],\n    expect",
    );
    let Some(mut window) = Window::open("cube.ron", &text) else {
        return;
    };
    window.harness.get_by_label("Play the edits").click();
    window.settle();
    let shows =
        |window: &Window, text: &str| window.harness.query_all_by_label_contains(text).count() > 0;
    assert!(shows(&window, "Next: flip e"));
    window.harness.get_by_label("Next").click();
    window.settle();
    assert!(shows(&window, "Done: flip e"));
    window.check_picture("playing");
    window
        .harness
        .get_by_role_and_label(Role::Slider, "edits done")
        .set_value_accesskit(5.0);
    window.settle();
    window.harness.get_by_label("Play").click();
    // The slider has moved the player to the last edit. The button Play therefore restarts at the first edit, and stops
    // after the last edit.
    for _ in 0..80 {
        window.harness.run_steps(8);
    }
    assert!(shows(&window, "Done: flip e"));
    assert_eq!(window.text(), text);
    // Any change of the recipe closes the player.
    window.press(Key::L);
    assert!(!shows(&window, "Edits of the step"));
}

#[test]
fn every_widget_of_the_window_has_a_label() {
    let Some(mut window) = Window::open("cube.ron", CUBE) else {
        return;
    };
    let [v, w] = window.visible_edge();
    let at = window.at(window.edge_middle(v, w));
    window.click(at, Modifiers::NONE);
    let unnamed = |window: &Window| -> Vec<String> {
        let has_no_name = |node: &egui_kittest::Node<'_>| -> Option<bool> {
            let node = node.accesskit_node();
            let is_widget = matches!(
                node.role(),
                Role::Button
                    | Role::CheckBox
                    | Role::ComboBox
                    | Role::ListBoxOption
                    | Role::MultilineTextInput
                    | Role::RadioButton
                    | Role::Slider
                    | Role::SpinButton
                    | Role::Switch
                    | Role::TextInput
            );
            is_widget.then(|| node.label().is_none_or(|label| label.trim().is_empty()))
        };
        let all: Vec<_> = window.harness.root().children_recursive().collect();
        assert!(all.iter().filter_map(has_no_name).count() > 25);
        let all = all.iter();
        all.filter(|node| has_no_name(node) == Some(true))
            .map(|node| format!("{node:?}"))
            .collect()
    };
    assert_eq!(unnamed(&window), [""; 0]);
    // Each key opens a panel or a dialog. Together, they have many kinds of widgets, and every widget must have a name.
    for key in [Key::F, Key::L, Key::I, Key::H] {
        window.press(key);
        assert_eq!(unnamed(&window), [""; 0], "after {key:?}");
    }
    window.press(Key::Escape);
    window.press_with(Modifiers::COMMAND, Key::K);
    assert_eq!(unnamed(&window), [""; 0], "operations");
}

/// Edits and saves a recipe in a window that cannot draw the scene.
fn edit_and_save(state: Option<&RenderState>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cube.ron");
    std::fs::write(&path, CUBE).unwrap();
    let start = Start {
        path: Some(path.clone()),
        state_folder: Some(folder.path().join("state")),
        ..Start::default()
    };
    let harness = Harness::builder()
        .with_size(Vec2::new(1280.0, 800.0))
        .with_max_steps(60)
        .build_eframe(|cc| App::new(&cc.egui_ctx, state, start));
    let mut window = Window { harness, folder };
    window.settle();
    window.press(Key::L);
    window.press_with(Modifiers::COMMAND, Key::S);
    let saved = std::fs::read_to_string(path).unwrap();
    assert!(saved.contains("LoopSubdivide(levels: 1)"), "{saved}");
}

#[test]
fn without_a_graphics_adapter_the_recipe_can_be_edited_and_saved() {
    edit_and_save(None);
}

#[test]
fn with_a_device_without_storage_buffers_the_recipe_can_be_edited_and_saved() {
    let Some(mut setup) = setup() else { return };
    if let WgpuSetup::CreateNew(new) = &mut setup {
        new.device_descriptor = Arc::new(|_| wgpu::DeviceDescriptor {
            required_limits: wgpu::Limits::downlevel_webgl2_defaults(),
            ..wgpu::DeviceDescriptor::default()
        });
    }
    let state = create_render_state(setup, RendererOptions::PREDICTABLE);
    assert_eq!(
        state.device.limits().max_storage_buffers_per_shader_stage,
        0
    );
    edit_and_save(Some(&state));
}

#[test]
fn a_lost_graphics_device_closes_the_window_and_the_next_start_offers_the_text() {
    let Some(setup) = setup() else { return };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cube.ron");
    std::fs::write(&path, CUBE).unwrap();
    let start = Start {
        path: Some(path),
        state_folder: Some(folder.path().join("state")),
        ..Start::default()
    };
    let device = Arc::new(std::sync::OnceLock::new());
    let to_device = device.clone();
    let state_folder = start.state_folder.clone();
    let harness = Harness::builder()
        .with_size(Vec2::new(1280.0, 800.0))
        .with_max_steps(60)
        .wgpu_setup(setup.clone())
        .build_eframe(move |cc| {
            let state = cc.wgpu_render_state.as_ref();
            to_device.get_or_init(|| state.unwrap().device.clone());
            App::new(&cc.egui_ctx, state, start)
        });
    let mut window = Window { harness, folder };
    window.settle();
    window.press(Key::L);
    let unsaved = window.text();
    let device = device.get().unwrap();
    device.destroy();
    // The device completes its earlier commands before it reports that it is lost.
    device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
    let mut closes = false;
    for _ in 0..3 {
        window.harness.run_steps(1);
        let output = window.harness.output();
        let mut commands = output
            .viewport_output
            .values()
            .flat_map(|out| &out.commands);
        closes |= commands.any(|command| *command == ViewportCommand::Close);
    }
    assert!(closes);
    assert_eq!(window.text(), unsaved);
    let Window { harness, folder } = window;
    drop(harness);
    let start = Start {
        path: None,
        state_folder,
        ..Start::default()
    };
    let harness = Harness::builder()
        .with_size(Vec2::new(1280.0, 800.0))
        .with_max_steps(60)
        .wgpu_setup(setup)
        .build_eframe(move |cc| App::new(&cc.egui_ctx, cc.wgpu_render_state.as_ref(), start));
    let mut window = Window { harness, folder };
    window.settle();
    window.harness.get_by_label("Recover").click();
    window.settle();
    assert_eq!(window.text(), unsaved);
}

#[test]
fn the_layout_of_the_window_is_remembered() {
    let Some(setup) = setup() else { return };
    let folder = tempfile::tempdir().unwrap();
    let start = Start {
        path: None,
        state_folder: Some(folder.path().to_owned()),
        ..Start::default()
    };
    let open = |setup| {
        let start = start.clone();
        Harness::builder()
            .with_size(Vec2::new(1280.0, 800.0))
            .with_max_steps(60)
            .wgpu_setup(setup)
            .build_eframe(move |cc| App::new(&cc.egui_ctx, cc.wgpu_render_state.as_ref(), start))
    };
    let folder = tempfile::tempdir().unwrap();
    let mut window = Window {
        harness: open(setup.clone()),
        folder,
    };
    window.settle();
    let width = |window: &Window| {
        let view = window.harness.get_by(|node| {
            node.label()
                .is_some_and(|label| label.starts_with("3D view"))
        });
        view.rect()
    };
    let before = width(&window);
    let border = Pos2::new(before.left() - 0.5, 600.0);
    window.drag(&[border, border + Vec2::new(-60.0, 0.0)], Modifiers::NONE);
    let after = width(&window);
    assert!(
        (before.left() - after.left() - 60.0).abs() < 3.0,
        "{before} {after}"
    );
    let Window { harness, folder } = window;
    drop(harness);
    let mut window = Window {
        harness: open(setup),
        folder,
    };
    window.settle();
    assert!((width(&window).left() - after.left()).abs() < 3.0);
}

#[test]
fn dragging_a_control_point_is_one_step_and_one_undo() {
    let curve = "3\n0 0\n1 2\n2 0\n";
    let teapot = include_str!("../../../../scenes/assets/teapot.bez");
    for (name, content, index) in [("a.bzc", curve, 1), ("a.bez", teapot, 3)] {
        let Some(mut window) = Window::open(name, content) else {
            return;
        };
        let points = |window: &Window| {
            let scene = window.harness.state().editor().view().scene;
            editor::control_points(&scene.objects()[0])
        };
        let before = points(&window);
        let at = window.at(before[index]);
        let text = window.text();
        let through = [(0.0, 0.0), (10.0, 2.0), (30.0, -20.0), (24.0, -40.0)];
        let through = through.map(|(x, y)| at + Vec2::new(x, y));
        window.drag(&through, Modifiers::NONE);
        let outline = editor::Outline::of(&window.text());
        assert_eq!(outline.steps.len(), 2, "{}", window.text());
        // The control point has moved to the position of the cursor.
        let moved = points(&window)[index];
        assert!(moved.distance(before[index]) > 0.1, "{moved}");
        assert!(window.at(moved).distance(through[3]) < 1.5, "{moved}");
        // The drag does not move the camera.
        assert!(window.at(before[index]).distance(at) < 1e-3);
        window.press_with(Modifiers::COMMAND, Key::Z);
        assert_eq!(window.text(), text);
        assert_eq!(points(&window), before);
    }
}

#[test]
fn the_wheel_over_a_slider_changes_its_number_in_one_step_of_the_history() {
    let recipe = "(
    recipe: 1,
    steps: [
        Load(path: \"a.bzc\"),
        CurveLevels(t: 0.5),
    ],
)
";
    let Some(mut window) = Window::open("a.ron", recipe) else {
        return;
    };
    std::fs::write(window.path("a.bzc"), "3\n0 0\n1 2\n2 0\n").unwrap();
    let at = window
        .harness
        .get_by_role_and_label(Role::Slider, "t")
        .rect()
        .center();
    window.harness.hover_at(at);
    window.harness.run_steps(2);
    for _ in 0..2 {
        window.harness.event(eframe::egui::Event::MouseWheel {
            unit: eframe::egui::MouseWheelUnit::Line,
            delta: Vec2::new(0.0, 1.0),
            phase: eframe::egui::TouchPhase::Move,
            source: eframe::egui::MouseWheelSource::Wheel,
            modifiers: Modifiers::NONE,
        });
        window.harness.run_steps(1);
    }
    window.harness.run_steps(60);
    window.settle();
    let changed = editor::Outline::of(&window.text());
    let t: f64 = changed
        .run_of(1)
        .unwrap()
        .field("t")
        .unwrap()
        .to_string()
        .parse()
        .unwrap();
    assert!(t > 0.51 && t < 0.7, "{t}");
    window.press_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.text(), recipe);
}
