//! Draws one panel of a figure.

use bezier::Curve;
use glam::DVec2;

use super::frame::Frame;
use super::trace::trace;
use super::{CURVE, FAINT, POINT, POLYGON, Panel, TEXT, WHITE, level_color, names};
use crate::figure::label::shortened;
use crate::figure::svg::{Anchor, Font, Paint, Run, Svg, Text};

/// The width of lines, in pixels at zoom 1.
const LINE: f64 = 1.8;

/// The width of the curve, in pixels at zoom 1.
const CURVE_WIDTH: f64 = 3.2;

/// Draws a panel into `area`. `frame` maps the curve into the area, and `zoom` scales lines and letters.
pub(super) fn draw(
    svg: &mut Svg,
    panel: &Panel,
    frame: &Frame,
    area: [DVec2; 2],
    labels: bool,
    zoom: f64,
) {
    let curve = frame.curve(panel.curve);
    let points = curve.points();
    let before = panel.before.map(|before| frame.curve(before));
    if let Some(before) = &before {
        draw_before(svg, before, &curve, zoom);
    }
    // If a construction has many points, its lines are thinner.
    let fine = zoom.sqrt() * if points.len() > 16 { 0.5 } else { 1.0 };
    let mut levels = panel.t.map(|t| curve.levels(t)).unwrap_or_default();
    if let Some(n_levels) = panel.levels {
        levels.truncate(n_levels + 1);
    }
    let n = curve.degree();
    svg.group("polygon", |svg| {
        svg.polyline(points, &Paint::stroke(POLYGON, LINE * fine));
    });
    let between = || levels.iter().enumerate().take(n).skip(1);
    svg.group("levels", |svg| {
        for (r, level) in between() {
            svg.polyline(level, &Paint::stroke(level_color(r), LINE * fine));
        }
    });
    svg.group("curve", |svg| {
        let paint = Paint::stroke(CURVE, CURVE_WIDTH * zoom.sqrt());
        svg.path(&trace(&curve), &paint);
    });
    svg.group("points", |svg| {
        let paint = Paint::fill(WHITE).with_stroke(POLYGON, LINE * fine);
        for &p in points {
            svg.circle(p, names::RADIUS * fine, &paint);
        }
        for (r, level) in between() {
            for &p in level {
                svg.circle(p, names::RADIUS * 0.8 * fine, &Paint::fill(level_color(r)));
            }
        }
        if let Some([p]) = levels.last().map(Vec::as_slice) {
            let paint = Paint::fill(POINT).with_stroke(WHITE, 1.5 * zoom);
            svg.circle(*p, 6.0 * zoom.sqrt(), &paint);
        }
    });
    if labels {
        let arrows = before.map_or(Vec::new(), |before| arrows(&before, &curve));
        svg.group("names", |svg| {
            names::draw(svg, &curve, &levels, &arrows, area, zoom);
        });
    }
}

/// Draws the earlier state of a curve, dashed and faint, with arrows to the new positions of its control points.
fn draw_before(svg: &mut Svg, before: &Curve<DVec2>, now: &Curve<DVec2>, zoom: f64) {
    svg.group("before", |svg| {
        let dashed = |width, dashes| Paint::stroke(FAINT, width).with_dashes(dashes);
        svg.polyline(before.points(), &dashed(1.4, &[2.0, 5.0]));
        svg.path(&trace(before), &dashed(2.4, &[7.0, 6.0]));
        for &p in before.points() {
            let paint = Paint::fill(WHITE).with_stroke(FAINT, 1.4);
            svg.circle(p, names::RADIUS * 0.8 * zoom.sqrt(), &paint);
        }
        for [from, to] in arrows(before, now) {
            let gap = (to - from).normalize() * 8.0;
            draw_arrow(svg, from + gap, to - gap);
        }
    });
}

/// Returns the old and the new position of each control point that moved far enough for an arrow.
fn arrows(before: &Curve<DVec2>, now: &Curve<DVec2>) -> Vec<[DVec2; 2]> {
    if before.degree() != now.degree() {
        return Vec::new();
    }
    let pairs = before.points().iter().zip(now.points());
    let arrows = pairs.map(|(&from, &to)| [from, to]);
    arrows
        .filter(|[from, to]| from.distance(*to) > 28.0)
        .collect()
}

fn draw_arrow(svg: &mut Svg, from: DVec2, to: DVec2) {
    let direction = (to - from).normalize_or_zero();
    let side = direction.perp() * 4.0;
    let neck = to - direction * 9.0;
    svg.polyline(&[from, neck], &Paint::stroke(POLYGON, 1.3));
    let corners = [('M', to), ('L', neck + side), ('L', neck - side)];
    let mut head: Vec<_> = corners.map(|(letter, p)| (letter, vec![p])).into();
    head.push(('Z', Vec::new()));
    svg.path(&head, &Paint::fill(POLYGON));
}

/// Writes the title and the parameter of a panel, centered at `middle`.
pub(super) fn draw_title(svg: &mut Svg, panel: &Panel, middle: DVec2, width: f64, zoom: f64) {
    let size = names::FONT_SIZE * zoom;
    let mut runs = Vec::new();
    if let Some(title) = panel.title {
        let gap = if panel.t.is_some() { "   " } else { "" };
        let parameter_width = if panel.t.is_some() { size * 5.0 } else { 0.0 };
        let title_width = width - parameter_width - 8.0;
        let title = shortened(title, Font::Title, size * 0.85, title_width);
        runs.push(Run {
            size: 0.85,
            ..Run::new(Font::Title, format!("{title}{gap}"))
        });
    }
    if let Some(t) = panel.t {
        runs.push(Run::new(Font::Letter, "t"));
        runs.push(Run::new(Font::Digit, format!(" = {}", format_parameter(t))));
    }
    if let Some(level) = panel.levels {
        runs.push(Run {
            size: 0.85,
            ..Run::new(Font::Plain, format!("   level {level}"))
        });
    }
    if !runs.is_empty() {
        svg.text(middle, &Text::of(runs, size, TEXT).anchored(Anchor::Middle));
    }
}

/// Formats a parameter with at most four decimals. A parameter that would be rounded to 0 or 1 is written exactly.
fn format_parameter(t: f64) -> String {
    let rounded = (t * 1e4).round() / 1e4;
    let becomes_end = rounded != t && (rounded == 0.0 || rounded == 1.0);
    if becomes_end {
        format!("{t:e}")
    } else {
        rounded.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_are_rounded_but_not_to_the_ends() {
        for (t, text) in [
            (0.0, "0"),
            (0.5, "0.5"),
            (1.0 / 3.0, "0.3333"),
            (1e-9, "1e-9"),
            (1.0, "1"),
        ] {
            assert_eq!(format_parameter(t), text);
        }
        assert_ne!(format_parameter(1.0 - 1e-12), "1");
    }
}
