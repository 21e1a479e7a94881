//! How large and how strong elements are marked.

use render::{Color, Elements, Highlight};

/// The color of marks, unless another one is asked for.
pub const MARK: Color = Color::rgb(0xe6, 0x55, 0x0d);

/// The width of marked edges and the diameter of marked vertices, in pixels of a picture that is 960 high.
const EDGES: f64 = 4.0;
const VERTICES: f64 = 13.0;

/// In smaller pictures they are smaller by these powers of the size: half as large a picture with half as wide lines
/// would hide what is marked.
const OF_EDGES: f64 = 0.25;
const OF_VERTICES: f64 = 0.4;

/// How much of marked edges is seen through a surface.
const HIDDEN_EDGES: f64 = 0.3;
/// How much of the rings that hidden vertices are.
const HIDDEN_VERTICES: f64 = 0.75;

/// What a length in a picture that is 960 high becomes in one of this size.
fn scaled(length: f64, power: f64, size: [u32; 2]) -> f64 {
    let scale = f64::from(size[0].min(size[1])) / 960.0;
    if scale < 1.0 {
        length * libm::pow(scale, power)
    } else {
        length * scale.min(8.0)
    }
}

/// The largest diameter of so many dots that do not cover a picture: 15 % of it, but 2.5 pixels each.
fn crowded(n: usize, [width, height]: [u32; 2]) -> f64 {
    #[expect(
        clippy::cast_precision_loss,
        reason = "a part of the size of a picture"
    )]
    let room = 0.15 * f64::from(width) * f64::from(height) / n.max(1) as f64;
    room.sqrt().max(2.5)
}

/// Elements of an object in a color. `width` is the width of edges and the diameter of vertices in pixels; if omitted, it
/// suits a picture of this size.
pub fn marked(
    object: &str,
    elements: Elements,
    color: Color,
    width: Option<f64>,
    size: [u32; 2],
) -> Highlight {
    let (usual, hidden) = match &elements {
        Elements::Vertices(list) => {
            let usual = scaled(VERTICES, OF_VERTICES, size);
            (usual.min(crowded(list.len(), size)), HIDDEN_VERTICES)
        }
        Elements::Edges(_) => (scaled(EDGES, OF_EDGES, size), HIDDEN_EDGES),
        Elements::Faces(_) => (0.0, 0.0),
    };
    Highlight {
        object: object.to_owned(),
        elements,
        color,
        size: width.unwrap_or(usual),
        hidden,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_shrink_less_than_pictures_and_grow_with_them() {
        let sizes = [[128, 96], [320, 240], [640, 480], [1280, 960], [2560, 1920]];
        let rounded = |x: f64| (x * 10.0).round() / 10.0;
        let edges = sizes.map(|size| rounded(scaled(EDGES, OF_EDGES, size)));
        let vertices = sizes.map(|size| rounded(scaled(VERTICES, OF_VERTICES, size)));
        // As the documentation of `Picture` says.
        assert_eq!(edges, [2.2, 2.8, 3.4, 4.0, 8.0]);
        assert_eq!(vertices, [5.2, 7.5, 9.9, 13.0, 26.0]);
        assert_eq!(crowded(1, sizes[0]).min(vertices[0]), vertices[0]);
        assert_eq!(crowded(100_000, sizes[0]), 2.5);
        assert_eq!(
            scaled(EDGES, OF_EDGES, [240, 320]),
            scaled(EDGES, OF_EDGES, sizes[1])
        );
    }
}
