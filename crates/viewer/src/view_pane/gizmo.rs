//! Handles at the picked elements: arrows that move them, rings that rotate them, and handles that scale them.

use editor::Movement;
use eframe::egui::{
    Align2, Color32, FontId, PointerButton, Pos2, Rect, Response, Shape, Stroke, Ui, Vec2,
};
use glam::DVec2;
use mesh::DVec3;

use super::input::place;
use super::{ViewEvent, ViewPane};
use crate::gpu::axis_color;
use crate::theme::Colors;

/// The length of the handles, in logical pixels.
const LENGTH: f64 = 84.0;
/// The maximum distance from the cursor at which a handle can be dragged, in logical pixels.
const REACH: f64 = 8.0;
/// The minimum length of an arrow that can be dragged, in logical pixels. A shorter arrow points almost exactly towards
/// or away from the viewer.
const SHORTEST: f64 = 12.0;
/// The number of straight segments of a ring.
const RING: u8 = 64;
/// The index of the handle that scales along all axes.
const ALL: usize = 3;

/// The kind of movement that the handles make.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tool {
    Move,
    Rotate,
    Scale,
}

/// The places of the handles, and the kind of movement that the handles make.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gizmo {
    pub(crate) tool: Tool,
    /// The base of the handles, in scene units.
    pub(crate) base: DVec3,
    /// The directions of the handles, as unit vectors of the scene.
    pub(crate) axes: [DVec3; 3],
}

/// A drag of a handle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drag {
    /// The handles at the start of the drag.
    gizmo: Gizmo,
    /// The index of the axis, or `ALL`.
    axis: usize,
    /// The base and the tip of the axis at the start of the drag, in logical pixels.
    line: [DVec2; 2],
    /// The length of the axis in scene units.
    length: f64,
    start: DVec2,
    /// The last place of the cursor.
    last: DVec2,
    /// The angle by which the cursor has moved around the base since the start of the drag, in degrees.
    turned: f64,
    /// The result of the drag so far: an offset in scene units, an angle in degrees, or a scale factor.
    value: f64,
}

impl Drag {
    /// Follows the cursor. `towards` says whether the axis points towards the viewer.
    fn follow(&mut self, at: DVec2, towards: bool) {
        let along = self.line[1] - self.line[0];
        let part = (at - self.start).dot(along) / along.length_squared();
        match self.gizmo.tool {
            Tool::Move => {
                self.value = round(part * self.length, self.length / along.length());
            }
            Tool::Rotate => {
                let [before, now] = [self.last, at].map(|p| p - self.line[0]);
                // The y axis of the screen points downwards, so the sign of the angle is reversed.
                let turn = libm::atan2(-before.perp_dot(now), before.dot(now)).to_degrees();
                self.turned += if towards { turn } else { -turn };
                self.value = libm::round(self.turned);
            }
            Tool::Scale => {
                let part = if self.axis == ALL {
                    (at.x - self.start.x) / LENGTH
                } else {
                    part
                };
                self.value = (libm::round((1.0 + part) * 100.0) / 100.0).max(0.01);
            }
        }
        self.last = at;
    }

    fn movement(&self) -> Movement {
        match self.gizmo.tool {
            Tool::Move => Movement::Offset(self.gizmo.axes[self.axis] * self.value),
            Tool::Rotate => Movement::Rotate(self.axis, self.value),
            Tool::Scale if self.axis == ALL => Movement::Scale(DVec3::splat(self.value)),
            Tool::Scale => {
                let mut factors = [1.0; 3];
                factors[self.axis] = self.value;
                Movement::Scale(factors.into())
            }
        }
    }

    fn text(&self) -> String {
        match self.gizmo.tool {
            Tool::Move => format!("{}", self.value),
            Tool::Rotate => format!("{}°", self.value),
            Tool::Scale => format!("× {}", self.value),
        }
    }
}

/// A handle in the picture: the index of its axis, and the line that can be dragged.
struct Handle {
    axis: usize,
    line: Vec<DVec2>,
}

impl Handle {
    fn distance(&self, at: DVec2) -> f64 {
        let to_part = |pair: &[DVec2]| {
            let along = pair[1] - pair[0];
            let t = (at - pair[0]).dot(along) / along.length_squared().max(1e-12);
            at.distance(pair[0] + along * t.clamp(0.0, 1.0))
        };
        let single = self.line.first().map(|p| p.distance(at));
        let parts = self.line.windows(2).map(to_part);
        parts.chain(single).fold(f64::INFINITY, f64::min)
    }
}

impl ViewPane {
    /// Processes the mouse input for the handles at the picked elements. Returns whether the user is dragging a handle.
    pub(super) fn gizmo(
        &mut self,
        ui: &Ui,
        rect: Rect,
        response: &Response,
        gizmo: Option<Gizmo>,
        events: &mut Vec<ViewEvent>,
    ) -> bool {
        let pointer = ui.input(|input| input.pointer.hover_pos());
        let back = self.camera.axes()[2];
        if let (Some(drag), Some(at)) = (&mut self.drag, pointer) {
            let before = drag.value;
            let axis = drag.gizmo.axes.get(drag.axis);
            drag.follow(
                place(rect, at),
                axis.is_none_or(|axis| axis.dot(back) >= 0.0),
            );
            let is_done = !response.dragged_by(PointerButton::Primary);
            if drag.value != before || is_done {
                let by = drag.movement();
                events.push(ViewEvent::Move { by, is_done });
            }
            if is_done {
                self.drag = None;
            }
            return true;
        }
        self.drag = None;
        let pressed = ui.input(|input| (input.pointer.press_origin(), input.modifiers.any()));
        if let (Some(gizmo), (Some(at), false), true) = (
            gizmo,
            pressed,
            response.drag_started_by(PointerButton::Primary),
        ) {
            self.drag = self.handle_at(gizmo, place(rect, at));
        }
        self.drag.is_some()
    }

    /// Finds the handle at a pixel, and returns a new drag of this handle. Returns `None` if no handle is near the
    /// pixel.
    fn handle_at(&self, gizmo: Gizmo, at: DVec2) -> Option<Drag> {
        let (length, lines) = self.axis_lines(gizmo)?;
        let handles = self.handles(gizmo, length, &lines);
        let near = handles
            .iter()
            .map(|handle| (handle.distance(at), handle.axis));
        let (distance, axis) = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (distance <= REACH).then_some(Drag {
            gizmo,
            axis,
            line: lines[axis.min(2)],
            length,
            start: at,
            last: at,
            turned: 0.0,
            value: if gizmo.tool == Tool::Scale { 1.0 } else { 0.0 },
        })
    }

    /// Returns the length of the axes in scene units, and the base and the tip of each axis in the picture. `None` if
    /// the base is behind the camera.
    fn axis_lines(&self, gizmo: Gizmo) -> Option<(f64, [[DVec2; 2]; 3])> {
        let base = gizmo.base;
        let depth = if self.camera.is_perspective {
            self.camera.distance - (base - self.camera.target).dot(self.camera.axes()[2])
        } else {
            self.camera.distance
        };
        let pixel = self.camera.pixel_size(self.size.y) * depth / self.camera.distance;
        let length = LENGTH * pixel;
        let from = self.camera.project(base, self.size)?;
        let mut lines = [[from; 2]; 3];
        for (line, axis) in lines.iter_mut().zip(gizmo.axes) {
            line[1] = self.camera.project(base + axis * length, self.size)?;
        }
        Some((length, lines))
    }

    /// Returns the handles in the picture.
    fn handles(&self, gizmo: Gizmo, length: f64, lines: &[[DVec2; 2]; 3]) -> Vec<Handle> {
        let straight = |axis: usize| {
            let [p, q] = lines[axis];
            // The lines of all axes meet at the base. Therefore the part of each line near the base does not belong to
            // its handle.
            let line = vec![p.lerp(q, 0.2), p.lerp(q, 1.1)];
            (p.distance(q) >= SHORTEST).then_some(Handle { axis, line })
        };
        match gizmo.tool {
            Tool::Move => (0..3).filter_map(straight).collect(),
            Tool::Scale => {
                let center = Handle {
                    axis: ALL,
                    line: vec![lines[0][0]],
                };
                (0..3).filter_map(straight).chain([center]).collect()
            }
            Tool::Rotate => (0..3).map(|axis| self.ring(gizmo, length, axis)).collect(),
        }
    }

    /// Returns the visible part of the ring around an axis. If the ring faces the viewer, the whole ring is visible. If
    /// not, the half of the ring that is nearer to the viewer is visible.
    fn ring(&self, gizmo: Gizmo, length: f64, axis: usize) -> Handle {
        let normal = gizmo.axes[axis];
        let back = self.camera.axes()[2];
        // The ring starts at `first`, which is one end of the visible half.
        let first = normal
            .cross(back)
            .try_normalize()
            .unwrap_or(gizmo.axes[(axis + 1) % 3]);
        let second = normal.cross(first).normalize_or_zero();
        let second = if second.dot(back) < 0.0 {
            -second
        } else {
            second
        };
        // A ring that faces the viewer is visible as a whole.
        let whole = if normal.dot(back).abs() > 0.98 {
            2.0
        } else {
            1.0
        };
        let point = |i: u8| {
            let angle = whole * std::f64::consts::PI * f64::from(i) / f64::from(RING);
            let at = first * libm::cos(angle) + second * libm::sin(angle);
            self.camera.project(gizmo.base + at * length, self.size)
        };
        let line = (0..=RING).filter_map(point).collect();
        Handle { axis, line }
    }

    /// Draws the handles.
    pub(super) fn paint_gizmo(&self, ui: &Ui, rect: Rect, gizmo: Option<Gizmo>) {
        let gizmo = match (self.drag, gizmo) {
            (Some(drag), _) => {
                let mut gizmo = drag.gizmo;
                if let Movement::Offset(offset) = drag.movement() {
                    gizmo.base += offset;
                }
                gizmo
            }
            (None, Some(gizmo)) => gizmo,
            (None, None) => return,
        };
        let Some((length, lines)) = self.axis_lines(gizmo) else {
            return;
        };
        let pointer = ui.input(|input| input.pointer.hover_pos());
        let hovered = match (self.drag, pointer) {
            (Some(drag), _) => Some(drag.axis),
            (None, Some(at)) => self.handle_at(gizmo, place(rect, at)).map(|drag| drag.axis),
            _ => None,
        };
        for handle in self.handles(gizmo, length, &lines) {
            let axis = handle.axis;
            let color = match [DVec3::X, DVec3::Y, DVec3::Z].get(axis) {
                _ if hovered == Some(axis) => Color32::WHITE,
                Some(&axis) => {
                    let [r, g, b] = axis_color(axis);
                    Color32::from_rgb(r, g, b)
                }
                None => Colors::current(ui).picked,
            };
            let stroke = Stroke::new(if hovered == Some(axis) { 4.5 } else { 3.2 }, color);
            let on_screen = |p: DVec2| rect.min + Vec2::new(narrow(p.x), narrow(p.y));
            let line = lines.get(axis).map(|line| line.map(on_screen));
            match (gizmo.tool, line) {
                (Tool::Rotate, _) => {
                    let points = handle.line.iter().map(|&p| on_screen(p)).collect();
                    ui.painter().add(Shape::line(points, stroke));
                }
                (tool, Some(line)) => arrow(ui, line, stroke, ["x", "y", "z"][axis.min(2)], tool),
                (_, None) => square(ui, on_screen(lines[0][0]), 6.5, color),
            }
        }
        if let (Some(drag), Some(at)) = (self.drag, pointer) {
            let font = FontId::proportional(14.0);
            let place = at + Vec2::new(16.0, -16.0);
            ui.painter().text(
                place,
                Align2::LEFT_BOTTOM,
                drag.text(),
                font,
                Colors::current(ui).text,
            );
        }
    }
}

/// Draws an axis and its name. The end of the axis is a square if the handle scales, and a circle otherwise.
fn arrow(ui: &Ui, [p, q]: [Pos2; 2], stroke: Stroke, name: &str, tool: Tool) {
    let painter = ui.painter();
    painter.line_segment([p, q], stroke);
    if tool == Tool::Scale {
        square(ui, q, 5.0, stroke.color);
    } else {
        painter.circle_filled(q, 5.5, stroke.color);
    }
    let beyond = q + (q - p).normalized() * 15.0;
    let font = FontId::proportional(13.0);
    painter.text(beyond, Align2::CENTER_CENTER, name, font, stroke.color);
}

fn square(ui: &Ui, center: Pos2, half: f32, color: Color32) {
    let square = Rect::from_center_size(center, Vec2::splat(2.0 * half));
    ui.painter().rect_filled(square, 1.5, color);
}

/// Rounds a length to a multiple of a power of ten. This power of ten is at most half the size of a pixel.
pub(super) fn round(length: f64, pixel: f64) -> f64 {
    let size = 0.5 * pixel;
    if !(size > 0.0 && size.is_finite()) {
        return 0.0;
    }
    // A division by 10 gives the nearest number with few digits, such as 0.3. A multiplication by 0.1 can be inexact.
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
