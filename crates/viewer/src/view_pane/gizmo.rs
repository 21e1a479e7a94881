//! Arrows along the axes at the picked elements. Dragging an arrow moves the elements.

use eframe::egui::{
    Align2, Color32, FontId, PointerButton, Pos2, Rect, Response, Stroke, Ui, Vec2,
};
use glam::DVec2;
use mesh::DVec3;

use super::input::place;
use super::{ViewEvent, ViewPane};
use crate::gpu::axis_color;

/// The length of the arrows, in points of the screen.
const LENGTH: f64 = 84.0;
/// The largest distance between the cursor and an arrow that is dragged, in points of the screen.
const REACH: f64 = 8.0;
/// Arrows that are shorter than this in the picture point towards the viewer, and cannot be dragged.
const SHORTEST: f64 = 12.0;
const AXES: [DVec3; 3] = [DVec3::X, DVec3::Y, DVec3::Z];

/// A drag of an arrow.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drag {
    axis: usize,
    /// The base of the arrows at the start, in scene units.
    base: DVec3,
    /// The base and the tip of the arrow at the start, in points of the screen.
    line: [DVec2; 2],
    /// The length of the arrow in scene units.
    length: f64,
    start: DVec2,
    offset: f64,
}

impl ViewPane {
    /// Handles drags of the arrows at `base`. Returns whether an arrow is dragged.
    pub(super) fn gizmo(
        &mut self,
        ui: &Ui,
        rect: Rect,
        response: &Response,
        base: Option<DVec3>,
        events: &mut Vec<ViewEvent>,
    ) -> bool {
        let pointer = ui.input(|input| input.pointer.hover_pos());
        if let (Some(drag), Some(at)) = (&mut self.drag, pointer) {
            let along = drag.line[1] - drag.line[0];
            let moved = (place(rect, at) - drag.start).dot(along) / along.length_squared();
            let offset = round(moved * drag.length, drag.length / along.length());
            let is_done = !response.dragged_by(PointerButton::Primary);
            if offset != drag.offset || is_done {
                drag.offset = offset;
                let offset = AXES[drag.axis] * offset;
                events.push(ViewEvent::Move { offset, is_done });
            }
            if is_done {
                self.drag = None;
            }
            return true;
        }
        self.drag = None;
        let pressed = ui.input(|input| (input.pointer.press_origin(), input.modifiers.any()));
        if let (Some(base), (Some(at), false), true) = (
            base,
            pressed,
            response.drag_started_by(PointerButton::Primary),
        ) {
            self.drag = self.arrow_at(base, place(rect, at));
        }
        self.drag.is_some()
    }

    /// Returns the arrow at a pixel.
    fn arrow_at(&self, base: DVec3, at: DVec2) -> Option<Drag> {
        let arrows = self.arrows(base)?;
        let near = |axis: usize| {
            let [p, q] = arrows.1[axis];
            let along = q - p;
            // The base belongs to no arrow.
            let t = ((at - p).dot(along) / along.length_squared()).clamp(0.2, 1.1);
            (at.distance(p + along * t), axis)
        };
        let axes = (0..3).filter(|&axis| {
            let [p, q] = arrows.1[axis];
            p.distance(q) >= SHORTEST
        });
        let (distance, axis) = axes.map(near).min_by(|a, b| a.0.total_cmp(&b.0))?;
        (distance <= REACH).then_some(Drag {
            axis,
            base,
            line: arrows.1[axis],
            length: arrows.0,
            start: at,
            offset: 0.0,
        })
    }

    /// Returns the length of the arrows in scene units, and the base and the tip of each arrow in the picture. `None` if the
    /// base is behind the camera.
    fn arrows(&self, base: DVec3) -> Option<(f64, [[DVec2; 2]; 3])> {
        let depth = if self.camera.is_perspective {
            self.camera.distance - (base - self.camera.target).dot(self.camera.axes()[2])
        } else {
            self.camera.distance
        };
        let pixel = self.camera.pixel_size(self.size.y) * depth / self.camera.distance;
        let length = LENGTH * pixel;
        let from = self.camera.project(base, self.size)?;
        let mut lines = [[from; 2]; 3];
        for (line, axis) in lines.iter_mut().zip(AXES) {
            line[1] = self.camera.project(base + axis * length, self.size)?;
        }
        Some((length, lines))
    }

    /// Draws the arrows.
    pub(super) fn paint_gizmo(&self, ui: &Ui, rect: Rect, base: Option<DVec3>) {
        let base = match self.drag {
            Some(drag) => Some(drag.base + AXES[drag.axis] * drag.offset),
            None => base,
        };
        let Some((_, lines)) = base.and_then(|base| self.arrows(base)) else {
            return;
        };
        let pointer = ui.input(|input| input.pointer.hover_pos());
        let hovered = match (self.drag, base, pointer) {
            (Some(drag), ..) => Some(drag.axis),
            (None, Some(base), Some(at)) => {
                self.arrow_at(base, place(rect, at)).map(|drag| drag.axis)
            }
            _ => None,
        };
        for (axis, line) in lines.iter().enumerate() {
            let [r, g, b] = axis_color(AXES[axis]);
            let (color, width) = if hovered == Some(axis) {
                (Color32::WHITE, 4.5)
            } else {
                (Color32::from_rgb(r, g, b), 3.2)
            };
            let [p, q] = line.map(|p| rect.min + Vec2::new(narrow(p.x), narrow(p.y)));
            if (q - p).length() < narrow(SHORTEST) {
                continue;
            }
            arrow(ui, [p, q], Stroke::new(width, color), ["x", "y", "z"][axis]);
        }
    }
}

fn arrow(ui: &Ui, [p, q]: [Pos2; 2], stroke: Stroke, name: &str) {
    let painter = ui.painter();
    painter.line_segment([p, q], stroke);
    painter.circle_filled(q, 5.5, stroke.color);
    let beyond = q + (q - p).normalized() * 15.0;
    let font = FontId::proportional(13.0);
    painter.text(beyond, Align2::CENTER_CENTER, name, font, stroke.color);
}

/// Rounds a length to a multiple of a power of ten that is at most half of a pixel.
pub(super) fn round(length: f64, pixel: f64) -> f64 {
    let size = 0.5 * pixel;
    if !(size > 0.0 && size.is_finite()) {
        return 0.0;
    }
    // Divisions by powers of ten give the nearest number with few digits.
    let digits = -libm::floor(libm::log10(size));
    let power = libm::pow(10.0, digits.abs());
    if digits >= 0.0 {
        libm::round(length * power) / power
    } else {
        libm::round(length / power) * power
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "positions on the screen are small"
)]
pub(super) fn narrow(x: f64) -> f32 {
    x as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_have_few_digits_and_are_exact_to_half_of_a_pixel() {
        for (length, pixel, expected) in [
            (0.123_456, 0.02, 0.12),
            (-1.987_654, 0.005, -1.988),
            (1234.5, 30.0, 1230.0),
            (0.3, 0.0, 0.0),
        ] {
            assert_eq!(round(length, pixel), expected);
        }
        for i in 0..200 {
            let length = 0.0137 * f64::from(i);
            assert!((round(length, 0.03) - length).abs() <= 0.5 * 0.03);
        }
    }
}
