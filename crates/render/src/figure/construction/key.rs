//! The legend below a construction.

use glam::DVec2;

use super::{CURVE, FAINT, LEVELS, POINT, POLYGON, Panel, TEXT, level_color, point_name};
use crate::figure::label::text_width;
use crate::figure::svg::{Font, Paint, Svg, Text};

/// An entry of the legend.
pub(super) struct Entry {
    /// How its line is drawn; `None` for a dot.
    mark: Option<Paint>,
    text: Text,
    /// The place of its mark from the left.
    left: f64,
}

/// The length of a mark, in pixels, with the gap behind it.
const MARK: f64 = 31.0;

/// Between two entries, in pixels.
const GAP: f64 = 19.0;

/// The height of a line, in pixels.
const LINE: f64 = 24.0;

/// The entries in lines, each line centered in `width` pixels.
pub(super) fn entries(panels: &[Panel], width: f64) -> Vec<Vec<Entry>> {
    // Each with its end, from the left.
    let mut lines: Vec<(Vec<Entry>, f64)> = Vec::new();
    for (mark, text) in explained(panels) {
        let long = MARK + text_width(&text);
        let fits = |(_, end): &&mut (_, f64)| *end + GAP + long <= width - 16.0;
        if let Some((line, end)) = lines.last_mut().filter(fits) {
            let left = *end + GAP;
            line.push(Entry { mark, text, left });
            *end = left + long;
        } else {
            let left = 0.0;
            lines.push((vec![Entry { mark, text, left }], long));
        }
    }
    for (line, end) in &mut lines {
        for entry in line {
            entry.left += (width - *end) / 2.0;
        }
    }
    lines.into_iter().map(|(line, _)| line).collect()
}

/// What the panels have.
fn explained(panels: &[Panel]) -> Vec<(Option<Paint>, Text)> {
    let plain = |text: &str| Text::new(Font::Plain, text, 13.0, TEXT);
    let line = |color, width| Some(Paint::stroke(color, width));
    let mut entries = vec![
        (line(CURVE, 3.2), plain("curve")),
        (line(POLYGON, 1.8), plain("control polygon")),
    ];
    if panels.iter().any(|p| p.before.is_some()) {
        let dashed = Paint::stroke(FAINT, 2.4).with_dashes(&[6.0, 5.0]);
        entries.push((Some(dashed), plain("before")));
    }
    let constructed = || panels.iter().filter(|p| p.t.is_some());
    let levels = constructed().map(|p| p.curve.degree()).max().unwrap_or(0);
    // With more levels, colors stand for several ones.
    if levels <= LEVELS.len() + 1 {
        for r in 1..levels {
            entries.push((line(level_color(r), 1.8), plain(&format!("level {r}"))));
        }
    }
    if constructed().next().is_some() {
        entries.push((None, Text::of(point_name(), 16.0, TEXT)));
    }
    entries
}

/// Pixels from top to bottom.
pub(super) fn height(lines: &[Vec<Entry>]) -> f64 {
    if lines.is_empty() {
        0.0
    } else {
        lines.len() as f64 * LINE + 12.0
    }
}

/// Draws the lines from `top` down.
pub(super) fn draw(svg: &mut Svg, lines: &[Vec<Entry>], top: f64) {
    if lines.is_empty() {
        return;
    }
    svg.group("legend", |svg| {
        for (i, line) in lines.iter().enumerate() {
            let y = top + (i as f64 + 0.4) * LINE;
            for entry in line {
                let from = DVec2::new(entry.left, y);
                let to = from + DVec2::X * (MARK - 8.0);
                match &entry.mark {
                    Some(paint) => svg.polyline(&[from, to], paint),
                    None => svg.circle(to - DVec2::X * 6.0, 5.5, &Paint::fill(POINT)),
                }
                svg.text(from + DVec2::new(MARK, 4.5), &entry.text);
            }
        }
    });
}
