//! A figure of texture coordinates: the charts on the page, which is the unit square.
//!
//! ```text
//!   +----------------+
//!   | +----+  +--+   |       thick lines are borders of charts, where the texture is cut;
//!   | | \  |  |\ |   |       thin lines are other edges;
//!   | |  \ |  | \|   |       the frame is the page: u and v from 0 to 1, v upwards
//!   | +----+  +--+   |
//!   +----------------+
//! ```

use geometry::uv::{Charts, aspects, is_border};
use glam::DVec2;
use mesh::{HalfEdgeId, Mesh};

use super::legend::{Legend, Scale, legend_size, write};
use super::{Color, Command, Paint, Svg};
use crate::ColorMap;

/// The meaning of the colors inside charts.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum UvFill {
    /// Nothing: charts are not filled.
    None,
    /// One of eight colors for each chart. Neighboring charts usually have different colors.
    Charts,
    /// How much angles are distorted, from dark (no distortion: the aspect is 1) to bright (the aspect is
    /// [`MAX_ASPECT`] or more). A small circle on the surface becomes an ellipse in the texture; the aspect is the
    /// ratio of the axes of the ellipse.
    Stretch,
}

/// [`UvFill::Stretch`] shows this aspect (ratio of the axes of an ellipse), and any larger aspect, in the last color of
/// the color map. See [`geometry::uv::Stretch`].
pub const MAX_ASPECT: f64 = 1.5;

const WHITE: Color = [255; 4];
const FRAME: Color = [0x9c, 0xa3, 0xaf, 255];
const EDGE: Color = [0x1f, 0x29, 0x37, 110];
const BORDER: Color = [0x1f, 0x29, 0x37, 255];
/// The smallest distance between the frame and the border of the figure, in pixels.
const MARGIN: f64 = 8.0;
/// The largest coordinate in a figure, in pixels. Points farther away are clamped.
const FAR: f64 = 1e6;
/// The number of colors that show the stretch. Faces of the same color form one shape.
const N_COLORS: usize = 16;

/// Draws the charts of texture coordinates in a figure that is `width` pixels wide. Coordinates outside the page are
/// drawn too, so the figure can be higher than wide. If `edges` is false, only the borders of charts are drawn. A
/// figure with colors for the stretch also has a legend, if the legend takes at most a third of the width.
pub fn uv_layout(
    mesh: &Mesh,
    uvs: &[DVec2],
    charts: &Charts,
    width: f64,
    fill: UvFill,
    edges: bool,
) -> Svg {
    let corners = || mesh.faces().flat_map(|f| mesh.face_half_edges(f));
    let points = corners().map(|h| uvs[h.index()]).filter(|p| p.is_finite());
    let (low, high) = points.fold((DVec2::ZERO, DVec2::ONE), |(low, high), p| {
        (low.min(p), high.max(p))
    });
    let (low, high) = if (high - low).is_finite() {
        (low, high)
    } else {
        (DVec2::ZERO, DVec2::ONE)
    };
    let legend = (fill == UvFill::Stretch).then(stretch_legend);
    let legend = legend.map(|legend| (legend_size(&legend), legend));
    let legend = legend.filter(|(size, _)| size.x <= width / 3.0);
    let [legend_width, legend_height] =
        (legend.as_ref()).map_or([0.0; 2], |(size, _)| [size.x, size.y]);
    let scale = (width - legend_width - 2.0 * MARGIN).max(1.0) / (high.x - low.x);
    // Without its margins, a figure is at most four times as high as wide.
    let scale = scale.min(4.0 * width / (high.y - low.y));
    let height = ((high.y - low.y) * scale + 2.0 * MARGIN).max(legend_height);
    let at = |p: DVec2| DVec2::new(p.x - low.x, high.y - p.y) * scale + MARGIN;
    let place = |h: HalfEdgeId| {
        let p = at(uvs[h.index()]);
        if p.is_finite() {
            p.clamp(DVec2::splat(-FAR), DVec2::splat(FAR))
        } else {
            at(DVec2::ZERO)
        }
    };

    let mut svg = Svg::new(width, height.ceil());
    svg.rectangle(
        DVec2::ZERO,
        DVec2::new(width, height.ceil()),
        &Paint::fill(WHITE),
    );
    for (color, path) in fills(mesh, uvs, charts, fill, &place) {
        svg.path(&path, &Paint::fill(color));
    }
    let frame = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(at);
    svg.path(&polygon(frame.into_iter()), &Paint::stroke(FRAME, 1.0));
    let lines = |borders: bool| -> Vec<Command> {
        let chosen = corners().filter(|&h| {
            let is_border = is_border(mesh, uvs, h);
            // An edge inside a chart has two half-edges at the same position, so only one of them is drawn.
            is_border == borders && (is_border || h < h.twin())
        });
        chosen
            .flat_map(|h| [('M', vec![place(h)]), ('L', vec![place(mesh.next(h))])])
            .collect()
    };
    if edges {
        svg.group("edges", |svg| {
            svg.path(&lines(false), &Paint::stroke(EDGE, 0.4));
        });
    }
    svg.group("borders", |svg| {
        svg.path(&lines(true), &Paint::stroke(BORDER, 1.2));
    });
    if let Some((size, legend)) = legend {
        write(&mut svg, &legend, DVec2::X * (width - size.x), size);
    }
    svg
}

fn stretch_legend() -> Legend {
    Legend {
        title: "stretch".to_owned(),
        scale: Scale::Continuous {
            low: 1.0,
            high: MAX_ASPECT,
            colors: (0..N_COLORS).map(stretch_color).collect(),
        },
    }
}

/// Returns one of the [`N_COLORS`] colors that show the stretch.
fn stretch_color(i: usize) -> Color {
    let last = (N_COLORS - 1) as f64;
    let [r, g, b] = ColorMap::Viridis.srgb(i as f64 / last);
    [r, g, b, 255]
}

/// Returns the shapes inside the charts, with their colors.
fn fills(
    mesh: &Mesh,
    uvs: &[DVec2],
    charts: &Charts,
    fill: UvFill,
    place: &impl Fn(HalfEdgeId) -> DVec2,
) -> Vec<(Color, Vec<Command>)> {
    let opaque = |[r, g, b]: [u8; 3]| [r, g, b, 255];
    // The colors are light, so that dark lines are visible on them.
    let light = |[r, g, b]: [u8; 3]| [r, g, b].map(|c| c / 2 + 127);
    let mut shapes: Vec<Vec<Command>> = Vec::new();
    let color: Box<dyn Fn(usize) -> Color> = match fill {
        UvFill::None => return Vec::new(),
        UvFill::Charts => {
            shapes.resize(8, Vec::new());
            for f in mesh.faces() {
                let class = charts.of_face[f.index()] as usize % 8;
                shapes[class].extend(polygon(mesh.face_half_edges(f).map(place)));
            }
            Box::new(move |i| opaque(light(ColorMap::Classes.class(i as f64))))
        }
        UvFill::Stretch => {
            shapes.resize(N_COLORS, Vec::new());
            for (triangle, aspect) in aspects(mesh, uvs) {
                let t = ((aspect - 1.0) / (MAX_ASPECT - 1.0)).clamp(0.0, 1.0);
                shapes[bin(t)].extend(polygon(triangle.into_iter().map(place)));
            }
            Box::new(stretch_color)
        }
    };
    let shapes = shapes.into_iter().enumerate();
    let shapes = shapes.filter(|(_, path)| !path.is_empty());
    shapes.map(|(i, path)| (color(i), path)).collect()
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "t is from 0 to 1"
)]
fn bin(t: f64) -> usize {
    ((t * N_COLORS as f64) as usize).min(N_COLORS - 1)
}

fn polygon(points: impl Iterator<Item = DVec2>) -> Vec<Command> {
    let start = |(i, p)| (if i == 0 { 'M' } else { 'L' }, vec![p]);
    let mut path: Vec<Command> = points.enumerate().map(start).collect();
    path.push(('Z', Vec::new()));
    path
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;
    use geometry::uv::charts;

    /// Returns two squares that share an edge, and texture coordinates that are computed from x and y. The coordinates
    /// of the second square are moved by `shift` along x.
    fn two(shift: f64) -> (Mesh, Vec<DVec2>) {
        let mesh = shapes::grid(2, 1);
        let mut uvs = vec![DVec2::ZERO; mesh.n_half_edges()];
        for (i, f) in mesh.faces().enumerate() {
            for h in mesh.face_half_edges(f) {
                let p = mesh.position(mesh.origin(h)).truncate();
                uvs[h.index()] = p / 4.0 + 0.5 + DVec2::X * shift * i as f64;
            }
        }
        (mesh, uvs)
    }

    fn figure(shift: f64, fill: UvFill, edges: bool) -> (Svg, String) {
        let (mesh, uvs) = two(shift);
        let svg = uv_layout(&mesh, &uvs, &charts(&mesh, &uvs), 216.0, fill, edges);
        let text = svg.finish(None);
        (svg, text)
    }

    #[test]
    fn edges_become_borders_where_charts_meet() {
        let lines = |text: &str, id: &str| {
            let (_, group) = text.split_once(&format!("id=\"{id}\"")).unwrap();
            group.split("</g>").next().unwrap().matches('M').count()
        };
        let (svg, text) = figure(0.0, UvFill::Charts, true);
        assert_eq!((svg.width, svg.height), (216.0, 216.0));
        assert_eq!((lines(&text, "edges"), lines(&text, "borders")), (1, 6));
        let (_, text) = figure(0.1, UvFill::Charts, true);
        assert_eq!((lines(&text, "edges"), lines(&text, "borders")), (0, 8));
        let (_, text) = figure(0.0, UvFill::None, false);
        assert!(!text.contains("id=\"edges\""));
    }

    #[test]
    fn coordinates_outside_the_page_enlarge_the_figure() {
        let (mesh, mut uvs) = two(0.0);
        for uv in &mut uvs {
            uv.y += 1.0;
        }
        let charts = charts(&mesh, &uvs);
        let svg = uv_layout(&mesh, &uvs, &charts, 216.0, UvFill::Stretch, true);
        assert!(svg.height > 216.0, "{}", svg.height);
        uvs[0] = DVec2::splat(1e308);
        uvs[2] = DVec2::splat(-1e308);
        uvs[4] = DVec2::splat(f64::NAN);
        let svg = uv_layout(&mesh, &uvs, &charts, 216.0, UvFill::Stretch, true);
        assert!(svg.height.is_finite() && !svg.finish(None).contains("NaN"));
    }

    #[test]
    fn colors_show_charts_or_stretch() {
        // The background is filled too, but not counted.
        let colors = |text: &str| text.matches("fill=\"#").count() - 1;
        assert_eq!(colors(&figure(0.0, UvFill::Charts, true).1), 1);
        assert_eq!(colors(&figure(0.1, UvFill::Charts, true).1), 2);
        let (mesh, uvs) = two(0.0);
        let narrow = uv_layout(
            &mesh,
            &uvs,
            &charts(&mesh, &uvs),
            120.0,
            UvFill::Stretch,
            true,
        );
        assert_eq!(colors(&narrow.finish(None)), 1);
        assert_eq!(colors(&figure(0.0, UvFill::None, true).1), 0);
    }

    #[test]
    fn a_wide_picture_of_the_stretch_has_a_legend() {
        let (mesh, uvs) = two(0.0);
        let charts = charts(&mesh, &uvs);
        let text = |width, fill| uv_layout(&mesh, &uvs, &charts, width, fill, true).finish(None);
        assert!(text(400.0, UvFill::Stretch).contains(">stretch<"));
        assert!(!text(120.0, UvFill::Stretch).contains(">stretch<"));
        assert!(!text(400.0, UvFill::Charts).contains(">stretch<"));
    }
}
