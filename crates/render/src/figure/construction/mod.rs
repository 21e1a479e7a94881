//! De Casteljau's construction of a point of a Bezier curve, drawn as in a textbook.
//!
//! ```text
//!        b1 ---- o ------- b2          the control polygon b0 b1 b2 b3,
//!       /      /    \        \         the legs of each level in the color of the level,
//!      /      o--*---o        \        the point c(t), and the curve
//!     /      /        \        \
//!    o -----'          '------- o
//!   /                            \
//! b0                              b3
//! ```
//!
//! The legs of a level are the line segments between its consecutive points. Each point of the next level divides a leg
//! in the ratio t : 1 - t (de Casteljau, "Outillages méthodes calcul", 1959). The names `b_i^r` of the points are from
//! Farin, "Curves and Surfaces for CAGD", 5th edition, 2002, §4.2.

mod frame;
mod key;
mod label_placement;
mod names;
mod panel;

mod trace;

use std::fmt::Debug;

use bezier::Curve;
use glam::DVec2;

use self::frame::Frame;
use super::svg::{Color, Font, Paint, Run, Svg};
use crate::PictureError;

/// The maximum number of control points of a curve in a figure.
pub const MAX_DRAWN: usize = 256;

/// The maximum number of control points of a curve whose levels (the steps of de Casteljau's construction) are also
/// drawn.
pub const MAX_CONSTRUCTED: usize = 64;

/// The maximum number of panels of a figure.
pub const MAX_PANELS: usize = 256;

/// The maximum number of points of all panels of a figure. If a curve has n control points, its levels have n (n + 1) /
/// 2 points in total.
pub const MAX_POINTS: usize = 1 << 16;

/// The maximum width of a figure, in pixels.
pub const MAX_WIDTH: f64 = 8192.0;

/// One panel of a figure: a curve, and the construction of one of its points.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel<'a> {
    /// The curve.
    pub curve: &'a Curve<DVec2>,
    /// An earlier state of the curve. It is drawn faintly behind the curve, with arrows from its control points to
    /// their new positions.
    pub before: Option<&'a Curve<DVec2>>,
    /// The parameter of the point, from 0 to 1. If `None`, only the curve and its control polygon are drawn.
    pub t: Option<f64>,
    /// The number of levels that are drawn after the control polygon. If `None`, all levels and the point are drawn.
    pub levels: Option<usize>,
    /// The title above the panel. The value of `t` is written after the title.
    pub title: Option<&'a str>,
}

/// The layout of a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// The width in pixels.
    pub width: f64,
    /// The number of panels in a row, at least 1.
    pub columns: usize,
    /// Whether points are labeled with their names.
    pub labels: bool,
    /// Whether there is a legend below the panels.
    pub legend: bool,
}

impl Default for Layout {
    fn default() -> Self {
        Self {
            width: 640.0,
            columns: 1,
            labels: true,
            legend: true,
        }
    }
}

const POLYGON: Color = [0x6b, 0x72, 0x80, 255];
const CURVE: Color = [0x11, 0x18, 0x27, 255];
const POINT: Color = [0xd5, 0x2b, 0x1e, 255];
const FAINT: Color = [0xa3, 0xaa, 0xb5, 255];
const TEXT: Color = [0x1f, 0x29, 0x37, 255];
const WHITE: Color = [255; 4];

/// The colors of the levels between the control polygon and the point. Color-blind people can distinguish these colors
/// (Okabe and Ito, "Color universal design", 2008). After the fifth level, the colors repeat.
const LEVELS: [Color; 5] = [
    [0x00, 0x72, 0xb2, 255],
    [0x00, 0x9e, 0x73, 255],
    [0xe6, 0x9f, 0x00, 255],
    [0xb0, 0x4f, 0x9c, 255],
    [0x3f, 0xa7, 0xe0, 255],
];

/// Returns the color of level `r`, which is at least 1.
fn level_color(r: usize) -> Color {
    LEVELS[(r - 1) % LEVELS.len()]
}

/// Returns the color of level `r` of `n` levels. Level 0 is the control polygon, and level n - 1 is the point.
pub(crate) fn color_of_level(r: usize, n: usize) -> Color {
    match r {
        0 => POLYGON,
        r if r + 1 == n => POINT,
        r => level_color(r),
    }
}

/// Returns the name of the point, c(t).
fn point_name() -> Vec<Run> {
    vec![
        Run::new(Font::Letter, "c"),
        Run::new(Font::Digit, "("),
        Run::new(Font::Letter, "t"),
        Run::new(Font::Digit, ")"),
    ]
}

/// Returns the scale of line widths and letters in a panel of this width. The scale is 1 for panels that are at least
/// 440 pixels wide.
fn zoom(panel_width: f64) -> f64 {
    (panel_width / 440.0).clamp(0.62, 1.0)
}

/// The distance from the drawing to the edges of its panel, in pixels at zoom 1.
const MARGIN: f64 = 32.0;

/// The height of a title, in pixels at zoom 1.
const TITLE: f64 = 30.0;

/// The minimum width of the drawing in a panel, in pixels.
const MIN_DRAWING_WIDTH: f64 = 32.0;

/// Draws a figure that arranges the panels in rows, from left to right.
///
/// Each curve and its construction fill their panel, with the same scale in both axes. If all control points of a curve
/// are equal, the curve is drawn as a point.
///
/// # Errors
///
/// Returns [`PictureError::Style`] if
///
/// - there are no panels, or more than [`MAX_PANELS`],
/// - a curve has more than [`MAX_DRAWN`] control points, or more than [`MAX_CONSTRUCTED`] if its levels are drawn,
/// - there are more than [`MAX_POINTS`] points in all,
/// - a parameter is not from 0 to 1, or
/// - the width of the layout is too small for its columns, or more than [`MAX_WIDTH`].
pub fn construction(panels: &[Panel], layout: &Layout) -> Result<Svg, PictureError> {
    check(panels)?;
    let columns = layout.columns.clamp(1, panels.len());
    let panel_width = layout.width / columns as f64;
    let zoom = zoom(panel_width);
    let inner = panel_width - 2.0 * MARGIN * zoom;
    if inner.is_nan() || inner < MIN_DRAWING_WIDTH || layout.width > MAX_WIDTH {
        let min_width = (MIN_DRAWING_WIDTH + 2.0 * MARGIN * 0.62) * columns as f64;
        let columns = match columns {
            1 => "1 column".to_owned(),
            n => format!("{n} columns"),
        };
        let message = format!(
            "expected a width from {} to {MAX_WIDTH} pixels for a figure with {columns}, found {} pixels",
            min_width.ceil(),
            layout.width
        );
        return Err(PictureError::Style(message));
    }
    let rows: Vec<Row> = panels
        .chunks(columns)
        .map(|panels| Row::new(panels, inner, zoom))
        .collect();
    let key = if layout.legend {
        key::entries(panels, layout.width)
    } else {
        Vec::new()
    };
    let rows_height: f64 = rows.iter().map(|row| row.height).sum();
    let height = rows_height + key::height(&key);
    let mut svg = Svg::new(layout.width.round(), height.round());
    let size = DVec2::new(svg.width, svg.height);
    svg.rectangle(DVec2::ZERO, size, &Paint::fill(WHITE));
    let mut top = 0.0;
    for row in &rows {
        for (i, (panel, frame)) in row.panels.iter().zip(&row.frames).enumerate() {
            let corner = DVec2::new(i as f64 * panel_width, top);
            let area = [
                corner + DVec2::Y * row.title,
                corner + DVec2::new(panel_width, row.height),
            ];
            let frame = frame.placed(area);
            panel::draw(&mut svg, panel, &frame, area, layout.labels, zoom);
            let middle = corner + DVec2::new(panel_width / 2.0, TITLE * 0.77 * zoom);
            panel::draw_title(&mut svg, panel, middle, panel_width, zoom);
        }
        top += row.height;
    }
    key::draw(&mut svg, &key, rows_height);
    Ok(svg)
}

/// A row of panels.
struct Row<'p, 'c> {
    panels: &'p [Panel<'c>],
    frames: Vec<Frame>,
    /// The height of the titles.
    title: f64,
    /// The height of the row.
    height: f64,
}

impl<'p, 'c> Row<'p, 'c> {
    /// Creates a row of panels whose drawings are `inner` pixels wide.
    fn new(panels: &'p [Panel<'c>], inner: f64, zoom: f64) -> Self {
        let frame = |p: &Panel| Frame::new(p.curve, p.before, inner);
        let frames: Vec<Frame> = panels.iter().map(frame).collect();
        let has_title = panels.iter().any(|p| p.title.is_some() || p.t.is_some());
        let title = if has_title { TITLE * zoom } else { 0.0 };
        let highest = frames.iter().map(Frame::height).fold(0.0, f64::max);
        Self {
            panels,
            frames,
            title,
            height: highest + 2.0 * MARGIN * zoom + title,
        }
    }
}

/// Checks the number of panels, the number of points, and the parameters.
fn check(panels: &[Panel]) -> Result<(), PictureError> {
    let expect = |is_valid: bool, expected: &str, found: &dyn Debug| {
        let message = || PictureError::Style(format!("expected {expected}, found {found:?}"));
        is_valid.then_some(()).ok_or_else(message)
    };
    let n = panels.len();
    let expected = format!("1 to {MAX_PANELS} panels");
    expect((1..=MAX_PANELS).contains(&n), &expected, &n)?;
    let mut n_points = 0;
    for panel in panels {
        let n = panel.curve.points().len();
        let (limit, points) = match panel.t {
            Some(_) => (MAX_CONSTRUCTED, n * (n + 1) / 2),
            None => (MAX_DRAWN, n),
        };
        n_points += points;
        let n_before = panel.before.map_or(0, |c| c.points().len());
        for (n, limit) in [(n, limit), (n_before, MAX_DRAWN)] {
            let expected = format!("a curve of at most {limit} control points");
            expect(n <= limit, &expected, &n)?;
        }
        let t = panel.t.unwrap_or(0.0);
        expect((0.0..=1.0).contains(&t), "a parameter from 0 to 1", &t)?;
    }
    expect(
        n_points <= MAX_POINTS,
        &format!("at most {MAX_POINTS} points in all panels"),
        &n_points,
    )
}

#[cfg(test)]
mod tests;
