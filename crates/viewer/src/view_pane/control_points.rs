//! Drags control points of curves and patches.

use editor::{ControlPoint, pick_control_point};
use eframe::egui::{CursorIcon, PointerButton, Pos2, Rect, Response, Stroke, Ui, Vec2};
use glam::DVec2;
use mesh::DVec3;

use super::gizmo::{narrow, round};
use super::input::place;
use super::{Shown, ViewEvent, ViewPane};
use crate::theme::Colors;

/// A drag of a control point.
#[derive(Clone, Debug)]
pub(super) struct PointDrag {
    point: ControlPoint,
    /// The offset from the cursor to the control point at the start of the drag, in logical pixels.
    grip: DVec2,
    /// The last position of the control point, in the space of the object.
    to: Option<DVec3>,
}

impl ViewPane {
    /// Finds the control point under the cursor, and moves a control point with the mouse. Returns whether the user is
    /// dragging a control point.
    pub(super) fn drag_control_point(
        &mut self,
        ui: &Ui,
        rect: Rect,
        response: &Response,
        shown: &Shown,
        events: &mut Vec<ViewEvent>,
    ) -> bool {
        let pointer = ui.input(|input| input.pointer.hover_pos());
        let view = self.projection();
        if let (Some(drag), Some(at)) = (&mut self.point_drag, pointer) {
            let pixel = place(rect, at) + drag.grip;
            let exact = drag.point.dragged_to(&view, pixel);
            let beside = drag.point.dragged_to(&view, pixel + DVec2::X);
            let to = exact.zip(beside).map(|(to, beside)| {
                let pixel = to.distance(beside);
                DVec3::from(to.to_array().map(|x| round(x, pixel)))
            });
            let is_done = !response.dragged_by(PointerButton::Primary);
            let is_new = to.is_some() && to != drag.to;
            drag.to = to.or(drag.to);
            if let (Some(to), true) = (drag.to, is_new || is_done) {
                events.push(ViewEvent::MoveControlPoint {
                    object: drag.point.object.clone(),
                    index: drag.point.index,
                    to,
                    is_done,
                });
            }
            if is_done {
                self.point_drag = None;
            }
            ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
            return true;
        }
        self.point_drag = None;
        let (pressed, modifiers, is_down) = ui.input(|input| {
            let pointer = &input.pointer;
            (pointer.press_origin(), input.modifiers, pointer.any_down())
        });
        let find = |at: Pos2| {
            let scene = shown
                .scene
                .filter(|_| shown.can_pick && self.look.control_nets)?;
            let is_over = response.contains_pointer() && !modifiers.any();
            pick_control_point(scene, &view, place(rect, at)).filter(|_| is_over)
        };
        if !is_down {
            self.hovered_point = pointer.and_then(find);
        } else if let (Some(at), true) = (pressed, response.drag_started_by(PointerButton::Primary))
            && let Some(point) = find(at)
        {
            let grip = self.camera.project(point.point, self.size);
            self.point_drag = grip.map(|pixel| PointDrag {
                point,
                grip: pixel - place(rect, at),
                to: None,
            });
        }
        if self.hovered_point.is_some() {
            ui.ctx().set_cursor_icon(CursorIcon::Grab);
        }
        self.point_drag.is_some()
    }

    /// Draws a ring around the control point under the cursor.
    pub(super) fn paint_control_point(&self, ui: &Ui, rect: Rect) {
        if self.point_drag.is_some() {
            return;
        }
        let hovered = self.hovered_point.as_ref();
        let pixel = hovered.and_then(|hit| self.camera.project(hit.point, self.size));
        if let Some(pixel) = pixel {
            let at = rect.min + Vec2::new(narrow(pixel.x), narrow(pixel.y));
            let stroke = Stroke::new(2.0, Colors::current(ui).picked);
            ui.painter().circle_stroke(at, 7.0, stroke);
        }
    }
}
