//! Labels the points of a construction with their names.

use bezier::Curve;
use glam::DVec2;

use super::label_placement::LabelPlacement;
use super::{POINT, TEXT, WHITE, level_color, point_name};
use crate::figure::label::text_width;
use crate::figure::svg::{Color, Font, Run, Svg, Text};

/// The radius of control points, in pixels at zoom 1.
pub(super) const RADIUS: f64 = 4.2;

/// The font size of names, in pixels at zoom 1.
pub(super) const FONT_SIZE: f64 = 19.0;

/// If a curve has at most this number of control points, all control points have names. Otherwise, only the first and
/// the last control point have names.
const MAX_NAMED: usize = 12;

/// The points of the levels (the steps of de Casteljau's construction) are named only if the degree of the curve is at
/// most this number. In small panels, these points are never named.
const MAX_DEGREE: usize = 3;

/// Writes names, and records which points have names.
struct NameWriter<'s> {
    svg: &'s mut Svg,
    placement: LabelPlacement,
    zoom: f64,
    /// The points that have a name.
    named: Vec<DVec2>,
}

/// Writes the names of the control points and of the point c(t). If the levels have few points, also writes the names
/// of these points.
pub(super) fn draw(
    svg: &mut Svg,
    curve: &Curve<DVec2>,
    levels: &[Vec<DVec2>],
    arrows: &[[DVec2; 2]],
    area: [DVec2; 2],
    zoom: f64,
) {
    let points = curve.points();
    let n = curve.degree();
    let mut names = NameWriter {
        svg,
        placement: obstacles(curve, levels, arrows, area, zoom),
        zoom,
        named: Vec::new(),
    };
    let middle = points.iter().fold(DVec2::ZERO, |sum, &p| sum + p) / points.len() as f64;
    for (i, &p) in points.iter().enumerate() {
        if points.len() <= MAX_NAMED || i == 0 || i == n {
            let runs = vec![Run::new(Font::Letter, "b"), Run::subscript(i.to_string())];
            let from = |j: usize| (p - points[j]).normalize_or_zero();
            let outward = from(i.saturating_sub(1)) + from((i + 1).min(n));
            let is_straight = outward.length() < 0.1;
            let outward = if is_straight { p - middle } else { outward };
            names.write(p, runs, TEXT, 1.0, outward);
        }
    }
    if let Some([p]) = levels.last().map(Vec::as_slice)
        && n > 0
    {
        // The point c(t) has a name even if it is at the position of a control point.
        names.named.clear();
        names.write(*p, point_name(), POINT, 1.0, *p - middle);
        names.named.extend(points);
    }
    if n <= MAX_DEGREE && zoom > 0.8 {
        for (r, level) in levels.iter().enumerate().take(n).skip(1) {
            for (i, &p) in level.iter().enumerate() {
                let index = i.to_string();
                let level = Run::superscript(r.to_string(), index.len());
                let runs = vec![Run::new(Font::Letter, "b"), Run::subscript(index), level];
                names.write(p, runs, level_color(r), 0.85, p - middle);
            }
        }
    }
}

/// Returns the lines and points of the figure. Names should not hide them.
fn obstacles(
    curve: &Curve<DVec2>,
    levels: &[Vec<DVec2>],
    arrows: &[[DVec2; 2]],
    area: [DVec2; 2],
    zoom: f64,
) -> LabelPlacement {
    let points = curve.points();
    let mut placement = LabelPlacement {
        area: [area[0] + 3.0, area[1] - 3.0],
        segments: arrows.to_vec(),
        ..LabelPlacement::default()
    };
    let samples: Vec<DVec2> = curve.sample(48).collect();
    let between = || levels.iter().skip(1).map(Vec::as_slice);
    for line in [points, &samples].into_iter().chain(between()) {
        let pairs = line.windows(2).map(|pair| [pair[0], pair[1]]);
        placement.segments.extend(pairs);
    }
    let all = points.iter().chain(between().flatten());
    placement.discs = all.map(|&p| (p, RADIUS * zoom)).collect();
    placement
}

impl NameWriter<'_> {
    /// Writes a name beside a point, unless a point at the same position has a name.
    fn write(&mut self, point: DVec2, runs: Vec<Run>, color: Color, size: f64, outward: DVec2) {
        if self.named.iter().any(|other| other.distance(point) < 2.0) {
            return;
        }
        self.named.push(point);
        let size = FONT_SIZE * self.zoom * size;
        let text = Text::of(runs, size, color).with_halo(WHITE, 2.0 * self.zoom);
        let width = text_width(&text);
        let extent = DVec2::new(width, size * 0.9);
        let radius = (RADIUS + 2.0) * self.zoom.sqrt();
        let middle = self.placement.place(point, radius, extent, outward);
        let start = middle + DVec2::new(-width / 2.0, size * 0.28);
        self.svg.text(start, &text);
    }
}
