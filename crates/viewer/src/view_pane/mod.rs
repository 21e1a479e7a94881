//! The view: draws the scene, turns the camera, and finds the element under the cursor.

mod control_points;
mod decorations;
mod gizmo;
mod input;
mod loss;

use std::sync::Arc;

use editor::{ControlPoint, Hit, Indexes, Movement, PickMode, Picked};
use eframe::egui::{self, Align2, Color32, FontId, Pos2, Rect, Role, Sense, Ui, WidgetInfo};
use eframe::{egui_wgpu, wgpu};
use glam::DVec2;
use mesh::{DVec3, EdgeId, Element};
use render::{ColorMap, Image};
use scene::{ErrorLocation, Scene};

use crate::camera::{Camera, Side};
use crate::gpu::{Look, Overlay, Painter, can_draw};
use crate::overlay;
use crate::theme::Colors;
use control_points::PointDrag;
use gizmo::Drag;
pub(crate) use gizmo::{Gizmo, Tool};
use input::Outline;
pub(crate) use loss::Loss;

/// Something that the user did in the view.
#[derive(Clone, Debug)]
pub(crate) enum ViewEvent {
    /// A click on an element, or on a place without an element.
    Click {
        /// The clicked element. `None` if the click was beside all elements.
        hit: Option<Hit>,
        /// If true, the element is added to the picked elements or, if the element is already picked, removed from
        /// them. If false, the element replaces the picked elements.
        extends: bool,
        /// Whether it was a double click.
        is_double: bool,
    },
    /// A box or a lasso around elements.
    Area {
        /// The elements of each object.
        picked: Vec<Picked>,
        /// If true, the elements in the area are removed from the picked elements. If false, the elements in the area
        /// are added to the picked elements.
        removes: bool,
    },
    /// A drag of a handle at the picked elements.
    Move {
        /// How the elements have moved since the start of the drag.
        by: Movement,
        /// Whether the drag has ended.
        is_done: bool,
    },
    /// A drag of a control point of a curve or of patches.
    MoveControlPoint {
        /// The name of the object.
        object: String,
        /// The index of the control point.
        index: usize,
        /// The new position, in the space of the object.
        to: DVec3,
        /// Whether the drag has ended.
        is_done: bool,
    },
}

/// The scene, the marks and the handles that the view shows.
pub(crate) struct Shown<'a> {
    pub(crate) scene: Option<&'a Arc<Scene>>,
    pub(crate) picked: Option<&'a Picked>,
    /// An edge that is drawn like a picked edge, and the name of its object.
    pub(crate) edge: Option<(&'a str, EdgeId)>,
    /// The handles at the picked elements.
    pub(crate) gizmo: Option<Gizmo>,
    /// Whether clicks pick elements.
    pub(crate) can_pick: bool,
    pub(crate) places: &'a [ErrorLocation],
    pub(crate) indexes: &'a Indexes,
    /// The description of the picked elements, for screen readers.
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
    /// The value of `overlay_number` for this picture.
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
    /// The kind of elements that a click picks.
    pub(crate) mode: PickMode,
    /// The kind of movement that the handles at the picked elements make. If `None`, no handles are shown.
    pub(crate) tool: Option<Tool>,
    /// The element under the cursor.
    pub(crate) hovered: Option<Hit>,
    /// The control point under the cursor.
    pub(crate) hovered_point: Option<ControlPoint>,
    /// The device. `None` if there is no graphics adapter that can draw scenes.
    gpu: Option<Gpu>,
    /// The errors of the graphics device.
    pub(crate) loss: Loss,
    /// The scene that is uploaded, with its look.
    uploaded: Option<(Arc<Scene>, Look)>,
    drawn: Option<Drawn>,
    /// Messages about objects, textures and colors that cannot be drawn.
    pub(crate) messages: Vec<String>,
    /// Whether the camera was fitted to a scene.
    is_fitted: bool,
    /// Whether the camera is fitted to the scene in the next frame.
    fit_requested: bool,
    /// The area that is being drawn with the mouse.
    area: Option<Outline>,
    /// The handle that is being dragged.
    drag: Option<Drag>,
    /// The control point that is being dragged.
    point_drag: Option<PointDrag>,
    size: DVec2,
    /// The widget of the view in the last frame.
    pub(crate) id: Option<egui::Id>,
    legend: Option<(String, ColorMap, [f64; 2])>,
    /// The scene and the elements that the current overlay shows. If one of them changes, a new overlay is made.
    overlay_key: Option<OverlayKey>,
    overlay: Overlay,
    /// Increases with every change of the overlay.
    overlay_number: u64,
}

type OverlayKey = (
    usize,
    Option<Picked>,
    [Option<(String, Element)>; 2],
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
            tool: None,
            hovered: None,
            hovered_point: None,
            gpu: state.filter(|state| can_draw(state)).map(|state| Gpu {
                state: state.clone(),
                painter: Painter::new(&state.device, &state.queue),
                texture: None,
            }),
            loss: Loss::watch(state.map(|state| &state.device)),
            uploaded: None,
            drawn: None,
            messages: Vec::new(),
            is_fitted: false,
            fit_requested: false,
            area: None,
            drag: None,
            point_drag: None,
            size: DVec2::new(640.0, 480.0),
            id: None,
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

    /// Moves the camera so that it shows the given points of the scene.
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

    /// Returns where the view shows a point of the scene, in logical pixels from the upper left corner of the view.
    pub(crate) fn pixel_of(&self, point: DVec3) -> Option<DVec2> {
        self.camera.project(point, self.size)
    }

    /// Returns the last picture. `None` without a graphics adapter.
    pub(crate) fn picture(&self) -> Option<Image> {
        self.gpu.as_ref()?.painter.read()
    }

    /// Requests that the camera is fitted to the scene that the view shows next.
    pub(crate) fn forget_fit(&mut self) {
        self.is_fitted = false;
    }

    pub(crate) fn ui(&mut self, ui: &mut Ui, shown: &Shown) -> Vec<ViewEvent> {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        self.id = Some(response.id);
        let label = match shown.description {
            "" => "3D view, nothing picked".to_owned(),
            text => format!("3D view, picked: {text}"),
        };
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, &label));
        self.size = DVec2::new(
            f64::from(rect.width().max(1.0)),
            f64::from(rect.height().max(1.0)),
        );
        if self.loss.reason().is_some() {
            self.gpu = None;
        }
        self.upload(shown);
        let mut events = Vec::new();
        let is_moving = self.gizmo(ui, rect, &response, shown.gizmo, &mut events)
            || self.drag_control_point(ui, rect, &response, shown, &mut events);
        if !is_moving {
            self.pick(ui, rect, &response, shown, &mut events);
            self.navigate(ui, rect, &response);
        }
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

    fn paint(&mut self, ui: &Ui, rect: Rect, shown: &Shown) {
        let colors = Colors::current(ui);
        let scale = ui.pixels_per_point();
        self.look.is_dark = ui.visuals().dark_mode;
        self.update_overlay(shown);
        let size = [rect.width(), rect.height()].map(|side| whole(side * scale));
        let Some(gpu) = &mut self.gpu else {
            let message = "There is no graphics adapter that can draw the scene.\nThe adapter must support Vulkan, Metal or Direct3D 12.\nThe recipe can still be edited and run.\n\nOn Debian, `apt-get install mesa-vulkan-drivers` installs a software renderer.";
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
        if let Some(area) = &self.area {
            decorations::outline(ui, area, &colors);
        }
        self.paint_gizmo(ui, rect, shown.gizmo);
        self.paint_control_point(ui, rect);
        decorations::axes(ui, rect, &self.camera);
        if let Some((title, map, range)) = &self.legend {
            decorations::legend(ui, rect, title, *map, *range, &colors);
        }
    }

    fn update_overlay(&mut self, shown: &Shown) {
        let Some(scene) = shown.scene else {
            self.overlay = Overlay::default();
            self.overlay_key = None;
            return;
        };
        let hovered = self.hovered.as_ref();
        let marked = [
            hovered.map(|hit| (hit.object.clone(), hit.element)),
            shown.edge.map(|(object, e)| (object.to_owned(), e.into())),
        ];
        let key = (
            Arc::as_ptr(scene).addr(),
            shown.picked.cloned(),
            marked,
            shown.places.to_vec(),
        );
        if self.overlay_key.as_ref() != Some(&key) {
            self.overlay = overlay::overlay(scene, shown.picked, &key.2, shown.places);
            self.overlay_key = Some(key);
            self.overlay_number += 1;
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "sizes of windows are small and positive"
)]
fn whole(x: f32) -> u32 {
    x.round().max(1.0) as u32
}
