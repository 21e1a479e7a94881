//! Draws the legend below a figure. The legend explains the lines and points of the figure.

use glam::DVec2;

use super::{CURVE, FAINT, LEVELS, POINT, POLYGON, Panel, TEXT, level_color, point_name};
use crate::figure::label::text_width;
use crate::figure::svg::{Font, Paint, Svg, Text};

/// An entry of the legend.
pub(super) struct Entry {
    /// The paint of the symbol if it is a line. `None` if the symbol is a dot.
    symbol: Option<Paint>,
    text: Text,
    /// The distance of the symbol from the left of the figure, in pixels.
    left: f64,
}

/// The width of a symbol and the gap after it, in pixels.
const SYMBOL: f64 = 31.0;

/// The gap between two entries, in pixels.
const GAP: f64 = 19.0;

/// The height of a line of entries, in pixels.
const LINE: f64 = 24.0;

/// Arranges the entries in lines, and centers each line in a width of `width` pixels.
pub(super) fn entries(panels: &[Panel], width: f64) -> Vec<Vec<Entry>> {
    // For each line of the legend: its entries, and its width.
    let mut lines: Vec<(Vec<Entry>, f64)> = Vec::new();
    for (symbol, text) in symbols(panels) {
        let entry_width = SYMBOL + text_width(&text);
        let fits = |(_, end): &&mut (_, f64)| *end + GAP + entry_width <= width - 16.0;
        if let Some((line, end)) = lines.last_mut().filter(fits) {
            let left = *end + GAP;
            line.push(Entry { symbol, text, left });
            *end = left + entry_width;
        } else {
            let left = 0.0;
            lines.push((vec![Entry { symbol, text, left }], entry_width));
        }
    }
    for (line, end) in &mut lines {
        for entry in line {
            entry.left += (width - *end) / 2.0;
        }
    }
    lines.into_iter().map(|(line, _)| line).collect()
}

/// Returns the symbols of the legend, with the explanation of each symbol.
fn symbols(panels: &[Panel]) -> Vec<(Option<Paint>, Text)> {
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
    // For each curve with a construction: its degree, and the last level that is drawn.
    let constructed = || {
        panels.iter().filter(|p| p.t.is_some()).map(|p| {
            let degree = p.curve.degree();
            (degree, p.levels.map_or(degree, |levels| levels.min(degree)))
        })
    };
    let levels = constructed().map(|(degree, last)| degree.min(last + 1));
    let levels = levels.max().unwrap_or(0);
    // If several levels have the same color, the legend does not list the levels.
    if levels <= LEVELS.len() + 1 {
        for r in 1..levels {
            entries.push((line(level_color(r), 1.8), plain(&format!("level {r}"))));
        }
    }
    if constructed().any(|(degree, last)| last == degree) {
        entries.push((None, Text::of(point_name(), 16.0, TEXT)));
    }
    entries
}

/// Returns the height of the legend in pixels.
pub(super) fn height(lines: &[Vec<Entry>]) -> f64 {
    if lines.is_empty() {
        0.0
    } else {
        lines.len() as f64 * LINE + 12.0
    }
}

/// Draws the legend with its top edge at `top`.
pub(super) fn draw(svg: &mut Svg, lines: &[Vec<Entry>], top: f64) {
    if lines.is_empty() {
        return;
    }
    svg.group("legend", |svg| {
        for (i, line) in lines.iter().enumerate() {
            let y = top + (i as f64 + 0.4) * LINE;
            for entry in line {
                let from = DVec2::new(entry.left, y);
                let to = from + DVec2::X * (SYMBOL - 8.0);
                match &entry.symbol {
                    Some(paint) => svg.polyline(&[from, to], paint),
                    None => svg.circle(to - DVec2::X * 6.0, 5.5, &Paint::fill(POINT)),
                }
                svg.text(from + DVec2::new(SYMBOL, 4.5), &entry.text);
            }
        }
    });
}
