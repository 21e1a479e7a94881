//! Turns the camera, and finds the element under the cursor.

use editor::{Area, Projection, keep_visible, pick, pick_area};
use eframe::egui::{self, PointerButton, Pos2, Rect, Ui};
use glam::DVec2;

use super::{Shown, ViewEvent, ViewPane};
use crate::gpu::Wireframe;

/// An area that is drawn with the mouse, in logical pixels.
#[derive(Clone, Debug)]
pub(super) enum Outline {
    /// A box, given by two opposite corners.
    Box(Pos2, Pos2),
    /// The points of a curve around the area.
    Lasso(Vec<Pos2>),
}

impl Outline {
    fn extend(&mut self, at: Pos2) {
        match self {
            Self::Box(_, end) => *end = at,
            Self::Lasso(points) => {
                if points.last().is_none_or(|last| last.distance(at) > 2.0) {
                    points.push(at);
                }
            }
        }
    }

    /// Returns the area relative to the upper left corner of `rect`, which is the rectangle of the view in the window.
    fn area(&self, rect: Rect) -> Area {
        match self {
            Self::Box(start, end) => Area::Box(place(rect, *start), place(rect, *end)),
            Self::Lasso(points) => Area::Lasso(points.iter().map(|&p| place(rect, p)).collect()),
        }
    }
}

impl ViewPane {
    /// Turns, moves and zooms the camera.
    pub(super) fn navigate(&mut self, ui: &Ui, rect: Rect, response: &egui::Response) {
        let delta = response.drag_delta();
        let pixels = DVec2::new(f64::from(delta.x), f64::from(delta.y));
        if response.dragged_by(PointerButton::Primary) && self.area.is_none() {
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
    pub(super) fn pick(
        &mut self,
        ui: &Ui,
        rect: Rect,
        response: &egui::Response,
        shown: &Shown,
        events: &mut Vec<ViewEvent>,
    ) {
        let Some(scene) = shown.scene.filter(|_| shown.can_pick) else {
            self.hovered = None;
            return;
        };
        let (modifiers, pointer) = ui.input(|input| (input.modifiers, input.pointer.hover_pos()));
        if response.drag_started_by(PointerButton::Primary)
            && let Some(start) = ui.input(|input| input.pointer.press_origin())
        {
            self.area = if modifiers.command {
                Some(Outline::Lasso(vec![start]))
            } else {
                modifiers.shift.then_some(Outline::Box(start, start))
            };
        }
        if let (Some(area), Some(at)) = (&mut self.area, pointer) {
            area.extend(at);
        }
        if response.drag_stopped_by(PointerButton::Primary)
            && let Some(area) = self.area.take()
        {
            let (kind, view) = (self.mode.kind(), self.projection());
            let mut picked = pick_area(scene, &view, &area.area(rect), kind);
            // Hidden elements can be seen, and therefore picked, only in a wireframe without a surface.
            if self.look.wireframe != Wireframe::Lines {
                keep_visible(scene, shown.indexes, &view, &mut picked);
            }
            events.push(ViewEvent::Area {
                picked,
                removes: modifiers.alt,
            });
        }
        // While a mouse button is down, the element under the cursor is not looked for, so that turning a large scene
        // stays fast.
        let is_down = ui.input(|input| input.pointer.any_down());
        if response.contains_pointer() && !is_down {
            let hovered = pointer.and_then(|at| {
                pick(
                    scene,
                    shown.indexes,
                    &self.projection(),
                    place(rect, at),
                    self.mode,
                )
            });
            if hovered != self.hovered {
                self.hovered = hovered;
                // The status bar was drawn before the view in this frame, so it shows the new element only in the next
                // frame.
                ui.ctx().request_repaint();
            }
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
            events.push(ViewEvent::Click {
                hit,
                extends: modifiers.shift,
                is_double: response.double_clicked(),
            });
        }
    }

    /// Returns the projection that converts points of the scene to positions in the view.
    pub(super) fn projection(&self) -> Projection {
        let extent = self.gpu.as_ref().and_then(|gpu| gpu.painter.extent());
        let (center, radius) = extent.unwrap_or((self.camera.target, self.camera.distance));
        Projection::new(
            self.camera.clip_matrix(self.size, center, radius * 1.01),
            self.size,
        )
    }
}

/// Converts a position in the window to a position relative to the upper left corner of the view.
pub(super) fn place(rect: Rect, at: Pos2) -> DVec2 {
    DVec2::new(f64::from(at.x - rect.left()), f64::from(at.y - rect.top()))
}
