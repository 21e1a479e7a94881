//! The view: draws the scene, turns the camera, and finds what is under the cursor.

use std::sync::Arc;

use editor::{Area, Hit, Indexes, PickMode, Picked, Projection, pick, pick_area};
use eframe::egui::{
    self, Align2, Color32, FontId, PointerButton, Pos2, Rect, Role, Sense, Stroke, StrokeKind, Ui,
    Vec2, WidgetInfo,
};
use eframe::{egui_wgpu, wgpu};
use glam::DVec2;
use mesh::{DVec3, Element};
use op::ElementKind;
use render::ColorMap;
use scene::{ErrorLocation, Scene};

use crate::camera::{Camera, Side};
use crate::gpu::{Look, Overlay, Painter, axis_color};
use crate::overlay;
use crate::theme::Colors;

/// Something that the user did in the view.
#[derive(Clone, Debug)]
pub(crate) enum ViewEvent {
    /// A click on an element, or beside all elements.
    Click {
        /// The element.
        hit: Option<Hit>,
        /// Whether the element is added to those that are picked.
        extends: bool,
        /// Whether it was a double click.
        is_double: bool,
    },
    /// A box around elements.
    Box {
        /// The elements of each object.
        picked: Vec<Picked>,
        /// Whether the elements are added to those that are picked.
        extends: bool,
    },
}

/// What the view shows.
pub(crate) struct Shown<'a> {
    pub(crate) scene: Option<&'a Arc<Scene>>,
    pub(crate) picked: Option<&'a Picked>,
    pub(crate) places: &'a [ErrorLocation],
    pub(crate) indexes: &'a Indexes,
    /// What is said about the picked elements, for people who do not see the picture.
    pub(crate) description: &'a str,
    /// Whether the scene is not up to date.
    pub(crate) is_stale: bool,
}

/// Everything that the last picture depends on.
#[derive(PartialEq)]
struct Drawn {
    scene: usize,
    look: Look,
    camera: Camera,
    /// The number of the overlay.
    overlay: u64,
    size: [u32; 2],
    scale: f32,
}

/// The state of the view.
pub(crate) struct ViewPane {
    /// The camera.
    pub(crate) camera: Camera,
    /// The appearance.
    pub(crate) look: Look,
    /// What a click picks.
    pub(crate) mode: PickMode,
    /// The element under the cursor.
    pub(crate) hovered: Option<Hit>,
    /// The device. `None` if there is no graphics adapter.
    gpu: Option<Gpu>,
    /// The scene that is uploaded, with its look.
    uploaded: Option<(Arc<Scene>, Look)>,
    drawn: Option<Drawn>,
    /// Messages about what cannot be drawn.
    pub(crate) messages: Vec<String>,
    /// Whether the camera was fitted to a scene.
    is_fitted: bool,
    /// The scene has been fitted with this size of the view.
    fit_requested: bool,
    box_start: Option<Pos2>,
    size: DVec2,
    legend: Option<(String, ColorMap, [f64; 2])>,
    /// The places of the shown overlay.
    overlay_key: Option<OverlayKey>,
    overlay: Overlay,
    /// Increases with every change of the overlay.
    overlay_number: u64,
}

type OverlayKey = (
    usize,
    Option<Picked>,
    Option<(String, Element)>,
    Vec<ErrorLocation>,
);

struct Gpu {
    state: egui_wgpu::RenderState,
    painter: Painter,
    texture: Option<(egui::TextureId, [u32; 2])>,
}

impl ViewPane {
    pub(crate) fn new(state: Option<&egui_wgpu::RenderState>) -> Self {
        Self {
            camera: Camera::default(),
            look: Look::default(),
            mode: PickMode::Any,
            hovered: None,
            gpu: state.map(|state| Gpu {
                state: state.clone(),
                painter: Painter::new(&state.device, &state.queue),
                texture: None,
            }),
            uploaded: None,
            drawn: None,
            messages: Vec::new(),
            is_fitted: false,
            fit_requested: false,
            box_start: None,
            size: DVec2::new(640.0, 480.0),
            legend: None,
            overlay_key: None,
            overlay: Overlay::default(),
            overlay_number: 0,
        }
    }

    /// Fits the camera to the scene in the next frame.
    pub(crate) fn fit(&mut self) {
        self.fit_requested = true;
    }

    /// Shows the scene from the default side.
    pub(crate) fn reset(&mut self) {
        self.camera.look_from(Side::ThreeQuarter);
        self.fit();
    }

    /// Moves the camera to points of the scene.
    pub(crate) fn fit_points(&mut self, points: &[DVec3]) {
        let Some(&first) = points.first() else { return };
        let (min, max) = points
            .iter()
            .fold((first, first), |(a, b), &p| (a.min(p), b.max(p)));
        let scene = self
            .gpu
            .as_ref()
            .and_then(|gpu| gpu.painter.extent())
            .map_or(1.0, |(_, radius)| radius);
        let radius = (0.5 * min.distance(max)).max(0.03 * scene);
        self.camera.fit(0.5 * (min + max), radius * 1.6, self.size);
    }

    /// Returns the pixel of the view, from its upper left corner in points of the screen, where a point of the scene is shown.
    pub(crate) fn pixel_of(&self, point: DVec3) -> Option<DVec2> {
        self.camera.project(point, self.size)
    }

    /// Forgets the fit, so that the next scene is fitted.
    pub(crate) fn forget_fit(&mut self) {
        self.is_fitted = false;
    }

    pub(crate) fn ui(&mut self, ui: &mut Ui, shown: &Shown) -> Vec<ViewEvent> {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        let label = match shown.description {
            "" => "3D view, nothing picked".to_owned(),
            text => format!("3D view, picked: {text}"),
        };
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, &label));
        self.size = DVec2::new(
            f64::from(rect.width().max(1.0)),
            f64::from(rect.height().max(1.0)),
        );
        self.upload(shown);
        let mut events = Vec::new();
        self.navigate(ui, rect, &response);
        self.pick(ui, rect, &response, shown, &mut events);
        self.paint(ui, rect, shown);
        events
    }

    fn upload(&mut self, shown: &Shown) {
        let (Some(gpu), Some(scene)) = (&mut self.gpu, shown.scene) else {
            return;
        };
        let is_known = self
            .uploaded
            .as_ref()
            .is_some_and(|(known, look)| Arc::ptr_eq(known, scene) && *look == self.look);
        if !is_known {
            self.messages = gpu.painter.set_scene(scene, &self.look);
            self.legend = gpu.painter.legend();
            self.uploaded = Some((scene.clone(), self.look.clone()));
        }
        if let Some((center, radius)) = gpu.painter.extent()
            && (self.fit_requested || !self.is_fitted)
        {
            if !self.is_fitted {
                self.camera.up = gpu.painter.up_axis();
            }
            self.camera.fit(center, radius, self.size);
            self.is_fitted = true;
            self.fit_requested = false;
        }
    }

    /// Turns, moves and zooms.
    fn navigate(&mut self, ui: &Ui, rect: Rect, response: &egui::Response) {
        let delta = response.drag_delta();
        let pixels = DVec2::new(f64::from(delta.x), f64::from(delta.y));
        let shift = ui.input(|input| input.modifiers.shift);
        if response.dragged_by(PointerButton::Primary) && self.box_start.is_none() && !shift {
            self.camera.orbit(pixels);
        }
        if response.dragged_by(PointerButton::Secondary)
            || response.dragged_by(PointerButton::Middle)
        {
            self.camera.pan(pixels, self.size);
        }
        if response.contains_pointer() {
            let (scroll, pinch, at) = ui.input(|input| {
                (
                    input.smooth_scroll_delta().y,
                    input.zoom_delta(),
                    input.pointer.hover_pos(),
                )
            });
            let factor = libm::exp(-0.0035 * f64::from(scroll)) / f64::from(pinch);
            if let Some(at) = at.filter(|_| factor != 1.0) {
                self.camera.zoom(factor, place(rect, at), self.size);
            }
        }
    }

    /// Finds the element under the cursor, and handles clicks and boxes.
    fn pick(
        &mut self,
        ui: &Ui,
        rect: Rect,
        response: &egui::Response,
        shown: &Shown,
        events: &mut Vec<ViewEvent>,
    ) {
        let Some(scene) = shown.scene else { return };
        let (shift, pointer) = ui.input(|input| (input.modifiers.shift, input.pointer.hover_pos()));
        if response.drag_started_by(PointerButton::Primary) && shift {
            self.box_start = ui.input(|input| input.pointer.press_origin());
        }
        if let (Some(start), true) = (
            self.box_start,
            response.drag_stopped_by(PointerButton::Primary),
        ) {
            self.box_start = None;
            if let Some(end) = pointer {
                let area = Area::Box(place(rect, start), place(rect, end));
                let kind = match self.mode {
                    PickMode::Vertex => ElementKind::Vertices,
                    PickMode::Edge | PickMode::HalfEdge => ElementKind::Edges,
                    PickMode::Any | PickMode::Face => ElementKind::Faces,
                };
                let picked = pick_area(scene, &self.projection(), &area, kind);
                events.push(ViewEvent::Box {
                    picked,
                    extends: true,
                });
            }
        }
        // While a button is down, nothing is picked, so that turning a large scene stays fast.
        let is_down = ui.input(|input| input.pointer.any_down());
        if response.contains_pointer() && !is_down {
            self.hovered = pointer.and_then(|at| {
                pick(
                    scene,
                    shown.indexes,
                    &self.projection(),
                    place(rect, at),
                    self.mode,
                )
            });
        } else if !response.contains_pointer() {
            self.hovered = None;
        }
        if response.clicked_by(PointerButton::Primary)
            && let Some(at) = response.interact_pointer_pos()
        {
            let hit = pick(
                scene,
                shown.indexes,
                &self.projection(),
                place(rect, at),
                self.mode,
            );
            response.request_focus();
            events.push(ViewEvent::Click {
                hit,
                extends: shift,
                is_double: response.double_clicked(),
            });
        }
    }

    /// Returns the map from the scene to points of the view.
    fn projection(&self) -> Projection {
        let extent = self.gpu.as_ref().and_then(|gpu| gpu.painter.extent());
        let (center, radius) = extent.unwrap_or((self.camera.target, self.camera.distance));
        Projection::new(
            self.camera.clip_matrix(self.size, center, radius * 1.01),
            self.size,
        )
    }

    fn paint(&mut self, ui: &Ui, rect: Rect, shown: &Shown) {
        let colors = Colors::current(ui);
        let scale = ui.pixels_per_point();
        self.look.is_dark = ui.visuals().dark_mode;
        self.update_overlay(shown);
        let size = [rect.width(), rect.height()].map(|side| whole(side * scale));
        let Some(gpu) = &mut self.gpu else {
            let message = "There is no graphics adapter, so the scene cannot be drawn.\nThe recipe can still be edited and run.\n\nOn Debian, `apt-get install mesa-vulkan-drivers` installs a software renderer.";
            ui.painter().rect_filled(rect, 0.0, colors.base);
            ui.painter().text(
                rect.center(),
                Align2::CENTER_CENTER,
                message,
                FontId::proportional(14.0),
                colors.weak,
            );
            return;
        };
        let now = Drawn {
            scene: self
                .uploaded
                .as_ref()
                .map_or(0, |(scene, _)| Arc::as_ptr(scene).addr()),
            look: self.look.clone(),
            camera: self.camera,
            overlay: self.overlay_number,
            size,
            scale,
        };
        if self.drawn.as_ref() != Some(&now) {
            gpu.painter
                .draw(&now.camera, &now.look, &self.overlay, size, scale);
            if let Some(view) = gpu.painter.texture() {
                let (device, filter) = (&gpu.state.device, wgpu::FilterMode::Nearest);
                let mut renderer = gpu.state.renderer.write();
                match gpu.texture {
                    Some((id, known)) if known != size => {
                        renderer.update_egui_texture_from_wgpu_texture(device, view, filter, id);
                        gpu.texture = Some((id, size));
                    }
                    Some(_) => {}
                    None => {
                        gpu.texture =
                            Some((renderer.register_native_texture(device, view, filter), size));
                    }
                }
            }
            self.drawn = Some(now);
        }
        if let Some((id, _)) = gpu.texture {
            let uv = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
            let tint = if shown.is_stale {
                Color32::from_gray(150)
            } else {
                Color32::WHITE
            };
            ui.painter().image(id, rect, uv, tint);
        }
        if let (Some(start), Some(end)) =
            (self.box_start, ui.input(|input| input.pointer.hover_pos()))
        {
            let area = Rect::from_two_pos(start, end);
            ui.painter().rect(
                area,
                0.0,
                colors.accent.gamma_multiply(0.12),
                Stroke::new(1.0, colors.accent),
                StrokeKind::Inside,
            );
        }
        self.paint_axes(ui, rect);
        if let Some((title, map, range)) = &self.legend {
            paint_legend(ui, rect, title, *map, *range, &colors);
        }
    }

    fn update_overlay(&mut self, shown: &Shown) {
        let Some(scene) = shown.scene else {
            self.overlay = Overlay::default();
            self.overlay_key = None;
            return;
        };
        let hovered = self
            .hovered
            .as_ref()
            .map(|hit| (hit.object.clone(), hit.element));
        let key = (
            Arc::as_ptr(scene).addr(),
            shown.picked.cloned(),
            hovered,
            shown.places.to_vec(),
        );
        if self.overlay_key.as_ref() != Some(&key) {
            let hovered = key
                .2
                .as_ref()
                .map(|(object, element)| (object.as_str(), *element));
            self.overlay = overlay::overlay(scene, shown.picked, hovered, shown.places);
            self.overlay_key = Some(key);
            self.overlay_number += 1;
        }
    }

    /// Draws the directions of the axes in the lower left corner.
    fn paint_axes(&self, ui: &Ui, rect: Rect) {
        let center = rect.left_bottom() + Vec2::new(46.0, -46.0);
        let [right, up, back] = self.camera.axes();
        let mut axes = [(DVec3::X, "x"), (DVec3::Y, "y"), (DVec3::Z, "z")].map(|(axis, name)| {
            let [r, g, b] = axis_color(axis);
            (axis.dot(back), axis, name, Color32::from_rgb(r, g, b))
        });
        // Axes that point towards the viewer are drawn last.
        axes.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, axis, name, color) in axes {
            let direction = Vec2::new(narrow(axis.dot(right)), -narrow(axis.dot(up)));
            ui.painter()
                .line_segment([center, center + direction * 26.0], Stroke::new(2.2, color));
            ui.painter().text(
                center + direction * 35.0,
                Align2::CENTER_CENTER,
                name,
                FontId::proportional(12.0),
                color,
            );
        }
    }
}

fn paint_legend(
    ui: &Ui,
    rect: Rect,
    title: &str,
    map: ColorMap,
    [low, high]: [f64; 2],
    colors: &Colors,
) {
    const WIDTH: f32 = 190.0;
    let font = FontId::proportional(12.0);
    let corner = rect.right_bottom() - Vec2::new(WIDTH + 16.0, 62.0);
    let frame = Rect::from_min_size(corner, Vec2::new(WIDTH, 50.0));
    ui.painter()
        .rect_filled(frame, 6.0, colors.panel.gamma_multiply(0.88));
    ui.painter().text(
        frame.left_top() + Vec2::new(10.0, 5.0),
        Align2::LEFT_TOP,
        title,
        font.clone(),
        colors.text,
    );
    let bar = Rect::from_min_size(
        frame.left_top() + Vec2::new(10.0, 22.0),
        Vec2::new(WIDTH - 20.0, 8.0),
    );
    let n = if map == ColorMap::Classes { 8_u8 } else { 48 };
    for i in 0..n {
        let [r, g, b] = if map == ColorMap::Classes {
            map.class(low + f64::from(i))
        } else {
            map.srgb((f64::from(i) + 0.5) / f64::from(n))
        };
        let left = bar.left() + bar.width() * f32::from(i) / f32::from(n);
        let part = Rect::from_min_size(
            Pos2::new(left, bar.top()),
            Vec2::new(bar.width() / f32::from(n) + 0.5, bar.height()),
        );
        ui.painter()
            .rect_filled(part.intersect(bar), 0.0, Color32::from_rgb(r, g, b));
    }
    let high = if map == ColorMap::Classes {
        low + 7.0
    } else {
        high
    };
    for (at, align, value) in [
        (bar.left_bottom(), Align2::LEFT_TOP, low),
        (bar.right_bottom(), Align2::RIGHT_TOP, high),
    ] {
        ui.painter().text(
            at + Vec2::new(0.0, 3.0),
            align,
            short(value),
            font.clone(),
            colors.weak,
        );
    }
}

/// Writes a number with about four digits.
fn short(x: f64) -> String {
    if x != 0.0 && !(1e-3..1e5).contains(&x.abs()) {
        return format!("{x:.2e}");
    }
    let text = format!("{x:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Returns a position in the view, from its upper left corner.
fn place(rect: Rect, at: Pos2) -> DVec2 {
    DVec2::new(f64::from(at.x - rect.left()), f64::from(at.y - rect.top()))
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the number is from -1 to 1"
)]
fn narrow(x: f64) -> f32 {
    x as f32
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "sizes of windows are small and positive"
)]
fn whole(x: f32) -> u32 {
    x.round().max(1.0) as u32
}
