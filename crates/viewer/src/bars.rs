//! The bar at the top, the status at the bottom, and the controls over the view.

use editor::{Action, PickMode, Status};
use eframe::egui::{
    self, Align, Button, Color32, ComboBox, CornerRadius, Frame, Layout, Margin, Panel, Rect,
    RichText, Stroke, Ui, UiBuilder, Vec2,
};
use render::Shading;
use view::{ColorBy, Quantity};

use crate::app::{Parts, Pending};
use crate::camera::{Side, UpAxis};
use crate::gpu::{Wireframe, title};
use crate::theme::Colors;
use crate::view_pane::ViewPane;

/// The bar at the top.
pub(crate) fn top(ui: &mut Ui, parts: &mut Parts) {
    let colors = Colors::current(ui);
    let frame = Frame::new()
        .fill(colors.panel)
        .inner_margin(Margin::symmetric(10, 6));
    Panel::top("top").frame(frame).show(ui, |ui| {
        ui.horizontal(|ui| {
            ui.label(
                RichText::new("Meshwright")
                    .strong()
                    .size(15.0)
                    .color(colors.accent),
            );
            ui.add_space(6.0);
            file_menu(ui, parts);
            let ctx = ui.ctx().clone();
            let document = parts.editor.document();
            let undo = document
                .undo_label()
                .map(|label| format!("Undo: {label} (Ctrl+Z)"));
            let redo = document
                .redo_label()
                .map(|label| format!("Redo: {label} (Ctrl+Shift+Z)"));
            for (name, label, action) in
                [("Undo", undo, Action::Undo), ("Redo", redo, Action::Redo)]
            {
                let button = ui.add_enabled(label.is_some(), Button::new(name));
                if button.on_hover_text(label.unwrap_or_default()).clicked() {
                    parts.act(action, &ctx);
                }
            }
            ui.add_space(8.0);
            let search =
                Button::new(RichText::new("Search operations   Ctrl+K").color(colors.weak))
                    .min_size(Vec2::new(220.0, 24.0))
                    .fill(colors.field)
                    .stroke(Stroke::new(1.0, colors.line));
            if ui.add(search).clicked() {
                parts.act(Action::Palette, &ctx);
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if ui.button("Help").on_hover_text("All keys (H)").clicked() {
                    parts.act(Action::Help, &ctx);
                }
                let is_dark = ui.visuals().dark_mode;
                if ui
                    .button(if is_dark { "Light" } else { "Dark" })
                    .on_hover_text("Switch between dark and light")
                    .clicked()
                {
                    ctx.set_theme(if is_dark {
                        egui::Theme::Light
                    } else {
                        egui::Theme::Dark
                    });
                }
                let document = parts.editor.document();
                let name = document
                    .path()
                    .file_name()
                    .unwrap_or_default()
                    .to_string_lossy()
                    .into_owned();
                let mark = if document.is_dirty() { " •" } else { "" };
                ui.add_space(8.0);
                ui.label(RichText::new(format!("{name}{mark}")).color(colors.weak))
                    .on_hover_text(document.path().display().to_string());
            });
        });
    });
}

fn file_menu(ui: &mut Ui, parts: &mut Parts) {
    let ctx = ui.ctx().clone();
    ui.menu_button("File", |ui| {
        ui.set_min_width(200.0);
        let rows = [
            ("New", "Ctrl+N", Action::New),
            ("Open...", "Ctrl+O", Action::Open),
            ("Save", "Ctrl+S", Action::Save),
            ("Save as...", "Ctrl+Shift+S", Action::SaveAs),
        ];
        for (name, key, action) in rows {
            if ui.add(Button::new(name).shortcut_text(key)).clicked() {
                parts.act(action, &ctx);
                ui.close();
            }
        }
        ui.separator();
        if ui
            .button("Run and write the outputs")
            .on_hover_text("Runs all steps, and writes the files of Save and Picture")
            .clicked()
        {
            parts.editor.write_outputs();
            ui.close();
        }
        let recent = parts.files.recent().to_vec();
        if !recent.is_empty() {
            ui.separator();
            ui.label(RichText::new("Recent files").weak().small());
        }
        for path in recent {
            let name = path
                .file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned();
            if ui
                .button(name)
                .on_hover_text(path.display().to_string())
                .clicked()
            {
                parts.drop_document(Pending::Open(path), &ctx);
                ui.close();
            }
        }
    });
}

/// The status at the bottom.
pub(crate) fn status(ui: &mut Ui, parts: &mut Parts) {
    let colors = Colors::current(ui);
    let frame = Frame::new()
        .fill(colors.panel)
        .inner_margin(Margin::symmetric(10, 4));
    Panel::bottom("status").frame(frame).show(ui, |ui| {
        ui.horizontal(|ui| {
            let run = parts.editor.run();
            let (color, text) = if let Some(progress) = parts.editor.progress() {
                let part = (100 * progress.done).checked_div(progress.total);
                let part = part.map_or_else(String::new, |part| format!(" {part} %"));
                (
                    colors.accent,
                    format!("Running {}{part}  (Esc cancels)", progress.step),
                )
            } else if run.has_failed() {
                let n =
                    run.failures.len() + run.diagnostics.iter().filter(|d| d.is_error()).count();
                (
                    colors.bad,
                    format!("{n} {}", if n == 1 { "error" } else { "errors" }),
                )
            } else if run.status == Status::Canceled {
                (colors.warning, "Canceled".to_owned())
            } else {
                let n = run.steps.len();
                let word = if n == 1 { "step" } else { "steps" };
                (
                    colors.good,
                    format!("{n} {word}, {} ran in {}", run.ran, duration(run.time)),
                )
            };
            dot(ui, color);
            ui.label(RichText::new(text).size(12.0));
            if let Some(digest) = run.digest {
                let text = digest.to_string();
                let short: String = text.chars().take(12).collect();
                ui.label(
                    RichText::new(format!("digest {short}"))
                        .monospace()
                        .size(11.0)
                        .color(colors.weak),
                )
                .on_hover_text(text);
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let at = parts.editor.view();
                let [v, e, f] = counts(&at.scene);
                ui.label(
                    RichText::new(format!(
                        "{} vertices   {} edges   {} faces",
                        grouped(v),
                        grouped(e),
                        grouped(f)
                    ))
                    .size(12.0)
                    .color(colors.weak),
                );
                ui.add_space(12.0);
                let hovered = parts
                    .view
                    .hovered
                    .as_ref()
                    .map(|hit| format!("{} of {}", word(hit.element), hit.object));
                let text = match (parts.description(), hovered) {
                    ("", Some(hovered)) => hovered,
                    (text, _) => text.to_owned(),
                };
                ui.add(egui::Label::new(RichText::new(text).size(12.0)).truncate());
            });
        });
    });
}

fn word(element: mesh::Element) -> String {
    match element {
        mesh::Element::Vertex(v) => format!("vertex {}", v.index()),
        mesh::Element::HalfEdge(h) => format!("half-edge {}", h.index()),
        mesh::Element::Edge(e) => format!("edge {}", e.index()),
        mesh::Element::Face(f) => format!("face {}", f.index()),
    }
}

/// Draws a round mark.
pub(crate) fn dot(ui: &mut Ui, color: Color32) {
    let (rect, _) = ui.allocate_exact_size(Vec2::splat(10.0), egui::Sense::hover());
    ui.painter().circle_filled(rect.center(), 4.0, color);
}

/// Returns the numbers of vertices, edges and faces of all meshes.
pub(crate) fn counts(scene: &scene::Scene) -> [usize; 3] {
    let meshes = scene.objects().iter().filter_map(|object| object.as_mesh());
    meshes.fold([0; 3], |[v, e, f], mesh| {
        [
            v + mesh.n_vertices(),
            e + mesh.n_edges(),
            f + mesh.n_faces(),
        ]
    })
}

/// Writes a count with groups of three digits.
pub(crate) fn grouped(n: usize) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// Writes a duration with a fitting unit.
pub(crate) fn duration(time: std::time::Duration) -> String {
    let seconds = time.as_secs_f64();
    if seconds < 1e-3 {
        format!("{:.0} µs", seconds * 1e6)
    } else if seconds < 1.0 {
        format!("{:.0} ms", seconds * 1e3)
    } else {
        format!("{seconds:.1} s")
    }
}

/// The controls over the view.
pub(crate) fn over_view(ui: &mut Ui, rect: Rect, parts: &mut Parts) {
    let colors = Colors::current(ui);
    let builder = UiBuilder::new().max_rect(rect.shrink(8.0));
    ui.scope_builder(builder, |ui| {
        let frame = Frame::new()
            .fill(colors.panel.gamma_multiply(0.92))
            .corner_radius(CornerRadius::same(7))
            .inner_margin(Margin::symmetric(7, 4))
            .stroke(Stroke::new(1.0, colors.line));
        frame.show(ui, |ui| ui.horizontal_wrapped(|ui| controls(ui, parts)));
        banners(ui, parts, &colors);
    });
}

fn controls(ui: &mut Ui, parts: &mut Parts) {
    ui.spacing_mut().item_spacing.x = 3.0;
    ui.spacing_mut().button_padding.x = 6.0;
    let view = &mut parts.view;
    for (mode, name, doc) in [
        (
            PickMode::Any,
            "Any",
            "Pick the vertex, edge or face under the cursor",
        ),
        (PickMode::Vertex, "Vertex", "Pick vertices (Alt+1)"),
        (PickMode::Edge, "Edge", "Pick edges (Alt+2)"),
        (PickMode::Face, "Face", "Pick faces (Alt+3)"),
        (PickMode::HalfEdge, "Half-edge", "Pick half-edges (Alt+4)"),
    ] {
        if ui
            .selectable_label(view.mode == mode, name)
            .on_hover_text(doc)
            .clicked()
        {
            view.mode = mode;
        }
    }
    ui.separator();
    shading_combo(ui, view);
    wireframe_combo(ui, view);
    let scene = parts.editor.view().scene;
    color_combo(ui, view, &scene);
    overlay_menu(ui, view);
    view_menu(ui, view);
    view_keys(ui, view);
}

fn shading_combo(ui: &mut Ui, view: &mut ViewPane) {
    let shadings = [
        (Shading::Smooth, "Smooth"),
        (Shading::Flat, "Flat"),
        (Shading::Phong, "Phong"),
        (Shading::Matcap, "Clay"),
        (Shading::Plain, "Plain"),
    ];
    let name = shadings
        .iter()
        .find(|(shading, _)| *shading == view.look.shading)
        .map_or("", |(_, name)| name);
    let combo = ComboBox::from_id_salt("shading")
        .selected_text(name)
        .width(56.0)
        .show_ui(ui, |ui| {
            for (shading, name) in shadings {
                ui.selectable_value(&mut view.look.shading, shading, name);
            }
        });
    combo
        .response
        .accessible_name("Shading")
        .on_hover_text("Shading (Q switches smooth and flat)");
}

fn wireframe_combo(ui: &mut Ui, view: &mut ViewPane) {
    let wires = [
        (Wireframe::Shaded, "Edges on"),
        (Wireframe::None, "Edges off"),
        (Wireframe::HiddenLine, "Hidden line"),
        (Wireframe::Lines, "Wireframe"),
    ];
    let name = wires
        .iter()
        .find(|(wire, _)| *wire == view.look.wireframe)
        .map_or("", |(_, name)| name);
    let combo = ComboBox::from_id_salt("wireframe")
        .selected_text(name)
        .width(70.0)
        .show_ui(ui, |ui| {
            for (wire, name) in wires {
                ui.selectable_value(&mut view.look.wireframe, wire, name);
            }
        });
    combo
        .response
        .accessible_name("Edges")
        .on_hover_text("Edges (W)");
}

fn overlay_menu(ui: &mut Ui, view: &mut ViewPane) {
    ui.menu_button("Overlays", |ui| {
        let look = &mut view.look;
        for (value, name) in [
            (&mut look.boundary, "Boundary edges"),
            (&mut look.creases, "Creases"),
            (&mut look.seams, "Seams"),
            (&mut look.normals, "Vertex normals"),
            (&mut look.vertices, "Vertices"),
            (&mut look.control_nets, "Control nets"),
            (&mut look.grid, "Grid"),
        ] {
            ui.checkbox(value, name);
        }
    });
}

fn view_menu(ui: &mut Ui, view: &mut ViewPane) {
    ui.menu_button("View", |ui| {
        for (i, side) in Side::ALL.into_iter().enumerate() {
            if ui
                .add(Button::new(side.name()).shortcut_text((i + 1).to_string()))
                .clicked()
            {
                view.camera.look_from(side);
            }
        }
        ui.separator();
        ui.checkbox(&mut view.camera.is_perspective, "Perspective (0)");
        let mut is_z = view.camera.up == UpAxis::Z;
        if ui.checkbox(&mut is_z, "z points upwards").changed() {
            view.camera.up = if is_z { UpAxis::Z } else { UpAxis::Y };
        }
        if ui
            .add(Button::new("Fit the scene").shortcut_text("Space"))
            .clicked()
        {
            view.reset();
        }
    });
}

/// Changes the view by the keys 0 to 7.
fn view_keys(ui: &Ui, view: &mut ViewPane) {
    let is_typing = ui.ctx().text_edit_focused();
    let digits = [
        egui::Key::Num1,
        egui::Key::Num2,
        egui::Key::Num3,
        egui::Key::Num4,
        egui::Key::Num5,
        egui::Key::Num6,
        egui::Key::Num7,
    ];
    ui.input(|input| {
        if is_typing || input.modifiers.any() {
            return;
        }
        for (key, side) in digits.into_iter().zip(Side::ALL) {
            if input.key_pressed(key) {
                view.camera.look_from(side);
            }
        }
        if input.key_pressed(egui::Key::Num0) {
            view.camera.is_perspective = !view.camera.is_perspective;
        }
    });
}

/// The choice of the quantity that is shown as colors.
fn color_combo(ui: &mut Ui, view: &mut ViewPane, scene: &scene::Scene) {
    let current = view.look.color_by.as_ref().map(|by| by.of.clone());
    let name = current
        .as_ref()
        .map_or_else(|| "Material".to_owned(), title);
    let mut choices = vec![
        Quantity::MeanCurvature,
        Quantity::GaussianCurvature,
        Quantity::Valence,
        Quantity::MinAngle,
        Quantity::Area,
        Quantity::DihedralAngle,
    ];
    let mut names: Vec<String> = Vec::new();
    for mesh in scene.objects().iter().filter_map(|object| object.as_mesh()) {
        names.extend(
            mesh.attributes()
                .iter()
                .map(|(_, column)| column.name.clone()),
        );
    }
    names.sort();
    names.dedup();
    choices.extend(names.into_iter().map(|name| Quantity::Attribute {
        name,
        component: None,
    }));
    let combo = ComboBox::from_id_salt("color")
        .selected_text(name)
        .width(64.0)
        .show_ui(ui, |ui| {
            if ui.selectable_label(current.is_none(), "Material").clicked() {
                view.look.color_by = None;
            }
            for quantity in choices {
                let is_current = current.as_ref() == Some(&quantity);
                if ui.selectable_label(is_current, title(&quantity)).clicked() {
                    view.look.color_by = Some(ColorBy::new(quantity));
                }
            }
        });
    combo
        .response
        .accessible_name("Color by")
        .on_hover_text("What the colors show");
}

/// Messages over the view: conflicts, recovery, errors.
fn banners(ui: &mut Ui, parts: &mut Parts, colors: &Colors) {
    let frame = |color: Color32| {
        Frame::new()
            .fill(colors.panel)
            .stroke(Stroke::new(1.0, color))
            .corner_radius(CornerRadius::same(7))
            .inner_margin(Margin::symmetric(10, 6))
    };
    ui.add_space(2.0);
    if parts.editor.document().conflict().is_some() {
        frame(colors.warning).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                ui.label("Another program changed the file while your text has unsaved changes.");
                if ui.button("Keep mine").clicked() {
                    parts.editor.keep_mine();
                }
                if ui.button("Take theirs").clicked() {
                    parts.editor.take_theirs();
                }
            });
        });
    }
    if let Some(recovery) = parts.files.recovery() {
        let name = recovery.path.file_name().unwrap_or_default().display();
        let message = format!("The last session ended before {name} was saved.");
        frame(colors.accent).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                ui.label(message);
                if ui.button("Recover").clicked()
                    && let Some(recovery) = parts.files.take_recovery()
                {
                    parts.editor.recover(&recovery);
                }
                if ui.button("Discard").clicked()
                    && let Some(recovery) = parts.files.take_recovery()
                {
                    recovery.discard(&engine::Disk);
                }
            });
        });
    }
    if let Some(notice) = parts.notice.clone() {
        frame(if notice.is_error {
            colors.bad
        } else {
            colors.accent
        })
        .show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                ui.label(&notice.text);
                if ui.small_button("Close").clicked() {
                    parts.notice = None;
                }
            });
        });
    }
    let first = first_error(parts);
    if let Some((message, offset)) = first {
        frame(colors.bad).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                dot(ui, colors.bad);
                ui.label(message);
                if let Some(offset) = offset
                    && ui.small_button("Show in the recipe").clicked()
                {
                    parts.text.go_to(offset);
                }
            });
        });
    }
    for message in &parts.view.messages {
        ui.label(RichText::new(message).color(colors.warning));
    }
}

/// Returns the message of the first error and its place in the text.
fn first_error(parts: &Parts) -> Option<(String, Option<usize>)> {
    if parts.editor.is_running() {
        return None;
    }
    let run = parts.editor.run();
    let errors = run
        .diagnostics
        .iter()
        .filter(|d| d.is_error())
        .chain(run.failures.iter().map(|f| &f.diagnostic));
    let first = errors.into_iter().next()?;
    let place = first
        .span
        .filter(|_| first.source == 0 && parts.editor.is_run_current());
    Some((first.message.clone(), place.map(|span| span.start)))
}
