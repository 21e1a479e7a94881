//! The names of the points of a construction.

use bezier::Curve;
use glam::DVec2;

use super::panel::RADIUS;
use super::placing::Placing;
use super::{POINT, TEXT, WHITE, level_color, point_name};
use crate::figure::label::text_width;
use crate::figure::svg::{Color, Font, Run, Svg, Text};

/// The names of points are as large as this, in pixels of a wide panel.
pub(super) const LETTERS: f64 = 19.0;

/// With more control points, only the first and the last have names.
const MAX_NAMED: usize = 12;

/// The levels of a curve have names up to this degree, in panels that are not small.
const MAX_DEGREE: usize = 3;

/// Names that are looked for a place.
struct Names<'s> {
    svg: &'s mut Svg,
    placing: Placing,
    zoom: f64,
    /// Points that have a name.
    named: Vec<DVec2>,
}

/// Writes the names of the control points, of the point c(t), and of the points between if they are few.
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
    let mut names = Names {
        svg,
        placing: obstacles(curve, levels, arrows, area, zoom),
        zoom,
        named: Vec::new(),
    };
    let middle = points.iter().fold(DVec2::ZERO, |sum, &p| sum + p) / points.len() as f64;
    for (i, &p) in points.iter().enumerate() {
        if points.len() <= MAX_NAMED || i == 0 || i == n {
            let runs = vec![Run::new(Font::Letter, "b"), Run::subscript(i.to_string())];
            let along = |j: usize| (p - points[j]).normalize_or_zero();
            let away = along(i.saturating_sub(1)) + along((i + 1).min(n));
            let is_straight = away.length() < 0.1;
            let away = if is_straight { p - middle } else { away };
            names.write(p, runs, TEXT, 1.0, away);
        }
    }
    if let Some([p]) = levels.last().map(Vec::as_slice)
        && n > 0
    {
        // It has its name even where it is a control point.
        names.named.clear();
        names.write(*p, point_name(), POINT, 1.0, *p - middle);
        names.named.extend(points);
    }
    if n <= MAX_DEGREE && zoom > 0.8 {
        for (r, level) in levels.iter().enumerate().take(n).skip(1) {
            for (i, &p) in level.iter().enumerate() {
                let below = i.to_string();
                let above = Run::superscript(r.to_string(), below.len());
                let runs = vec![Run::new(Font::Letter, "b"), Run::subscript(below), above];
                names.write(p, runs, level_color(r), 0.85, p - middle);
            }
        }
    }
}

/// What names keep away from.
fn obstacles(
    curve: &Curve<DVec2>,
    levels: &[Vec<DVec2>],
    arrows: &[[DVec2; 2]],
    area: [DVec2; 2],
    zoom: f64,
) -> Placing {
    let points = curve.points();
    let mut placing = Placing {
        area: [area[0] + 3.0, area[1] - 3.0],
        segments: arrows.to_vec(),
        ..Placing::default()
    };
    let samples: Vec<DVec2> = curve.sample(48).collect();
    let between = || levels.iter().skip(1).map(Vec::as_slice);
    for line in [points, &samples].into_iter().chain(between()) {
        let pairs = line.windows(2).map(|pair| [pair[0], pair[1]]);
        placing.segments.extend(pairs);
    }
    let all = points.iter().chain(between().flatten());
    placing.discs = all.map(|&p| (p, RADIUS * zoom)).collect();
    placing
}

impl Names<'_> {
    /// Writes a name beside a point, unless a point in the same place has one.
    fn write(&mut self, place: DVec2, runs: Vec<Run>, color: Color, size: f64, outward: DVec2) {
        if self.named.iter().any(|other| other.distance(place) < 2.0) {
            return;
        }
        self.named.push(place);
        let size = LETTERS * self.zoom * size;
        let text = Text::of(runs, size, color).with_halo(WHITE, 2.0 * self.zoom);
        let width = text_width(&text);
        let extent = DVec2::new(width, size * 0.9);
        let radius = (RADIUS + 2.0) * self.zoom.sqrt();
        let at = self.placing.place(place, radius, extent, outward);
        let start = at + DVec2::new(-width / 2.0, size * 0.28);
        self.svg.text(start, &text);
    }
}
