//! The color, size and opacity of highlighted elements.

use render::{Color, Elements, Highlight};

/// The default color of highlighted elements.
pub const HIGHLIGHT_COLOR: Color = Color::rgb(0xe6, 0x55, 0x0d);

/// The width of highlighted edges, in pixels, in a picture whose shorter side has 960 pixels.
const EDGE_WIDTH: f64 = 4.0;
/// The diameter of highlighted vertices, in pixels, in a picture whose shorter side has 960 pixels.
const VERTEX_DIAMETER: f64 = 13.0;

/// The exponent for pictures whose shorter side has less than 960 pixels. The width of edges is proportional to the
/// shorter side raised to this exponent. If the width were proportional to the shorter side itself, edges in small
/// pictures would be too thin to see.
const EDGE_POWER: f64 = 0.25;
/// The same exponent as `EDGE_POWER`, but for the diameter of vertices.
const VERTEX_POWER: f64 = 0.4;

/// The opacity of hidden edges.
const HIDDEN_EDGES: f64 = 0.3;
/// The opacity of hidden vertices, which are drawn as rings.
const HIDDEN_VERTICES: f64 = 0.75;

/// Converts `length`, which is meant for a picture whose shorter side has 960 pixels, to a length for a picture of this
/// size. If the shorter side has fewer than 960 pixels, the result is proportional to the shorter side raised to
/// `power`. Otherwise, the result is proportional to the shorter side, but at most 8 times `length`.
fn scaled(length: f64, power: f64, size: [u32; 2]) -> f64 {
    let scale = f64::from(size[0].min(size[1])) / 960.0;
    if scale < 1.0 {
        length * libm::pow(scale, power)
    } else {
        length * scale.min(8.0)
    }
}

/// Returns the largest diameter, in pixels, at which `n` dots cover at most 15 % of a picture of this size. The result
/// is at least 2.5, even if the dots then cover more than 15 %.
fn max_diameter(n: usize, [width, height]: [u32; 2]) -> f64 {
    #[expect(
        clippy::cast_precision_loss,
        reason = "the area of a dot need not be exact"
    )]
    let area = 0.15 * f64::from(width) * f64::from(height) / n.max(1) as f64;
    area.sqrt().max(2.5)
}

/// Returns a highlight of elements of an object. `width` is the width of edges and the diameter of vertices, in pixels.
/// If `width` is `None`, the default for a picture of this `size` is used.
pub fn highlight(
    object: &str,
    elements: Elements,
    color: Color,
    width: Option<f64>,
    size: [u32; 2],
) -> Highlight {
    let (default, hidden) = match &elements {
        Elements::Vertices(list) => {
            let diameter = scaled(VERTEX_DIAMETER, VERTEX_POWER, size);
            (
                diameter.min(max_diameter(list.len(), size)),
                HIDDEN_VERTICES,
            )
        }
        Elements::Edges(_) => (scaled(EDGE_WIDTH, EDGE_POWER, size), HIDDEN_EDGES),
        Elements::Faces(_) => (0.0, 0.0),
    };
    Highlight {
        object: object.to_owned(),
        elements,
        color,
        size: width.unwrap_or(default),
        hidden,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn default_widths_shrink_less_than_pictures_and_grow_in_proportion_to_them() {
        let sizes = [[128, 96], [320, 240], [640, 480], [1280, 960], [2560, 1920]];
        let rounded = |x: f64| (x * 10.0).round() / 10.0;
        let edges = sizes.map(|size| rounded(scaled(EDGE_WIDTH, EDGE_POWER, size)));
        let vertices = sizes.map(|size| rounded(scaled(VERTEX_DIAMETER, VERTEX_POWER, size)));
        // The documentation of the operation `Picture` states these numbers. If they change, update the documentation.
        assert_eq!(edges, [2.2, 2.8, 3.4, 4.0, 8.0]);
        assert_eq!(vertices, [5.2, 7.5, 9.9, 13.0, 26.0]);
        assert_eq!(max_diameter(1, sizes[0]).min(vertices[0]), vertices[0]);
        assert_eq!(max_diameter(100_000, sizes[0]), 2.5);
        assert_eq!(
            scaled(EDGE_WIDTH, EDGE_POWER, [240, 320]),
            scaled(EDGE_WIDTH, EDGE_POWER, sizes[1])
        );
    }
}
