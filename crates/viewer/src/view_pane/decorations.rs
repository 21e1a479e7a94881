//! Draws over the picture: the axes, the area that the user draws with the mouse, and the legend of colors.

use eframe::egui::{Align2, Color32, FontId, Pos2, Rect, Shape, Stroke, StrokeKind, Ui, Vec2};
use mesh::DVec3;
use render::ColorMap;

use super::input::Outline;
use crate::camera::Camera;
use crate::gpu::axis_color;
use crate::theme::Colors;

/// Draws the directions of the axes in the lower left corner.
pub(super) fn axes(ui: &Ui, rect: Rect, camera: &Camera) {
    let center = rect.left_bottom() + Vec2::new(46.0, -46.0);
    let [right, up, back] = camera.axes();
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

/// Draws the box or the lasso that the user is drawing with the mouse.
pub(super) fn outline(ui: &Ui, area: &Outline, colors: &Colors) {
    let stroke = Stroke::new(1.0, colors.accent);
    let fill = colors.accent.gamma_multiply(0.12);
    match area {
        Outline::Box(start, end) => {
            let area = Rect::from_two_pos(*start, *end);
            ui.painter()
                .rect(area, 0.0, fill, stroke, StrokeKind::Inside);
        }
        Outline::Lasso(points) => {
            ui.painter().add(Shape::closed_line(points.clone(), stroke));
        }
    }
}

/// Draws the title, the colors and the range of the numbers that are shown as colors.
pub(super) fn legend(
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

#[expect(
    clippy::cast_possible_truncation,
    reason = "the number is from -1 to 1"
)]
fn narrow(x: f64) -> f32 {
    x as f32
}
