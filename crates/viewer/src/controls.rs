//! The controls over the view.

use editor::PickMode;
use eframe::egui::{
    self, Align, Button, ComboBox, CornerRadius, Frame, Layout, Margin, ProgressBar, Rect, Stroke,
    Ui, UiBuilder,
};
use render::Shading;
use view::{ColorBy, Quantity};

use crate::app::Parts;
use crate::banners::banners;
use crate::camera::{Side, UpAxis};
use crate::gpu::Wireframe;
use crate::theme::Colors;
use crate::view_pane::ViewPane;

/// Draws the controls over the view.
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
        progress(ui, parts);
    });
}

/// Draws the progress of the run at the bottom of the view, if the run takes a long time.
fn progress(ui: &mut Ui, parts: &Parts) {
    let Some(progress) = parts.editor.progress().filter(|_| parts.runs_long()) else {
        return;
    };
    let part = progress.done as f32 / progress.total.max(1) as f32;
    let text = match progress.task.as_str() {
        "" => format!("Running {}", progress.step),
        task => format!("Running {}: {task}", progress.step),
    };
    ui.with_layout(Layout::bottom_up(Align::Center), |ui| {
        let bar = ProgressBar::new(part)
            .desired_width(320.0)
            .text(text.as_str());
        ui.add(bar).accessible_name(text);
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
        .on_hover_text("Shading (Q switches between smooth and flat)");
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

/// Changes the view when one of the keys 0 to 7 is pressed.
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

/// Draws the list from which the user chooses the quantity that is shown as colors.
fn color_combo(ui: &mut Ui, view: &mut ViewPane, scene: &scene::Scene) {
    let current = view.look.color_by.as_ref().map(|by| by.of.clone());
    let name = current
        .as_ref()
        .map_or_else(|| "Material".to_owned(), Quantity::title);
    let combo = ComboBox::from_id_salt("color")
        .selected_text(name)
        // A long name is truncated, because the controls after the name would otherwise move to a second row. The
        // legend shows the whole name.
        .truncate()
        .width(90.0)
        .show_ui(ui, |ui| {
            if ui.selectable_label(current.is_none(), "Material").clicked() {
                view.look.set_color_by(None);
            }
            for quantity in Quantity::of_scene(scene) {
                let is_current = current.as_ref() == Some(&quantity);
                if ui.selectable_label(is_current, quantity.title()).clicked() {
                    view.look.set_color_by(Some(ColorBy::new(quantity)));
                }
            }
        });
    combo
        .response
        .accessible_name("Color by")
        .on_hover_text("What the colors show");
}
