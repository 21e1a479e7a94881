//! Draws some faces of a mesh and their half-edges as a figure.
//!
//! ```text
//!   v3 ------------ v2
//!    |  <----h2---  |       each half-edge is an arrow beside its edge, inside its face;
//!    | |          ^ |       a thin curve leads from its head to the next half-edge;
//!    | h3   f0   h1 |       its twin is on the other side of the edge;
//!    | v          | |       half-edges on the boundary have no face and are gray
//!    |  ---h0---->  |
//!   v0 ------------ v1
//! ```

use glam::{DVec2, DVec3};
use mesh::{FaceId, HalfEdgeId, Mesh, VertexId};

use super::{Anchor, Color, Font, Paint, Svg, Text};

/// The maximum number of faces in a figure.
pub const MAX_FACES: usize = 200;

const FACE: Color = [0xdb, 0xe7, 0xf5, 255];
const EDGE: Color = [0x9c, 0xa3, 0xaf, 255];
const ARROW: Color = [0x1d, 0x4e, 0x89, 255];
const BOUNDARY: Color = [0x6b, 0x72, 0x80, 255];
const TEXT: Color = [0x1f, 0x29, 0x37, 255];
const WHITE: Color = [255; 4];

/// The empty border around the faces, in pixels.
const MARGIN: f64 = 34.0;
/// The font size of names, in pixels.
const FONT_SIZE: f64 = 11.0;
/// The radius of the disk of a vertex, in pixels.
const RADIUS: f64 = 11.0;
/// The maximum distance between an edge and the arrows of its half-edges, in pixels.
const GAP: f64 = 9.0;
/// The distance between an arrow and its name, in pixels.
const NAME_GAP: f64 = 12.0;
/// The distance from each end of an edge to the nearer end of the arrow, as a fraction of the length of the edge.
const SHORTENING: f64 = 0.17;

/// Draws the half-edges of faces in a figure that is `width` pixels wide, with the names of half-edges, vertices and
/// faces.
///
/// The faces are seen along their mean normal. Back faces, and faces that are seen nearly edge-on, are left out.
/// Returns the figure and the number of faces that are left out. A figure with more than [`MAX_FACES`] faces is
/// unreadable.
pub fn half_edges(mesh: &Mesh, faces: &[FaceId], width: f64) -> (Svg, usize) {
    let normal: DVec3 = faces.iter().map(|&f| mesh.area_vector(f)).sum();
    let normal = normal.normalize_or(DVec3::Z);
    let visible: Vec<FaceId> = (faces.iter().copied())
        .filter(|&f| is_visible(mesh.area_vector(f), normal))
        .collect();
    let frame = Frame::new(mesh, &visible, normal, width);
    let mut svg = Svg::new(width, frame.height);
    svg.rectangle(
        DVec2::ZERO,
        DVec2::new(width, frame.height),
        &Paint::fill(WHITE),
    );
    for &f in &visible {
        let corners: Vec<DVec2> = mesh.face_vertices(f).map(|v| frame.map(mesh, v)).collect();
        let mut path = vec![('M', vec![corners[0]])];
        path.extend(corners[1..].iter().map(|&p| ('L', vec![p])));
        path.push(('Z', Vec::new()));
        svg.path(&path, &Paint::fill(FACE).with_stroke(EDGE, 1.5));
    }
    for &f in &visible {
        let center = middle(mesh.face_vertices(f).map(|v| frame.map(mesh, v)));
        write_loop(
            &mut svg,
            mesh,
            &frame,
            mesh.face_half_edges(f),
            ARROW,
            |p| p + (center - p).normalize_or_zero() * inset(center.distance(p)),
        );
        name(&mut svg, center, &f.to_string(), Font::Title, ARROW);
        let outer = mesh.face_half_edges(f).map(HalfEdgeId::twin);
        for h in outer.filter(|&h| mesh.face(h).is_none()) {
            let ends = [mesh.origin(h), mesh.target(h)].map(|v| frame.map(mesh, v));
            let away = ((ends[0] + ends[1]) / 2.0 - center).normalize_or_zero();
            let moved = ends.map(|p| p + away * GAP * 0.8);
            arrow(&mut svg, moved, BOUNDARY);
            let at = (moved[0] + moved[1]) / 2.0 + away * NAME_GAP;
            name(&mut svg, at, &h.to_string(), Font::Plain, BOUNDARY);
        }
    }
    let mut vertices: Vec<VertexId> = (visible.iter())
        .flat_map(|&f| mesh.face_vertices(f))
        .collect();
    vertices.sort_unstable();
    vertices.dedup();
    for v in vertices {
        let at = frame.map(mesh, v);
        let paint = Paint::fill(WHITE).with_stroke(TEXT, 1.0);
        svg.circle(at, RADIUS, &paint);
        name(&mut svg, at, &v.to_string(), Font::Plain, TEXT);
    }
    (svg, faces.len() - visible.len())
}

/// Whether the front of a face is seen at an angle that leaves enough room for names. `face_normal` can have any
/// length.
fn is_visible(face_normal: DVec3, direction: DVec3) -> bool {
    const MIN_COSINE: f64 = 0.15;
    face_normal.dot(direction) >= MIN_COSINE * face_normal.length()
}

/// Converts the positions of a mesh to pixels of the figure.
struct Frame {
    /// The directions to the right and upwards in the figure.
    axes: [DVec3; 2],
    /// The middle of the faces, in scene units. Positions of the mesh are taken relative to this point.
    middle: DVec3,
    /// The number of pixels per scene unit.
    scale: f64,
    /// The position in the figure at which the middle of the faces is drawn.
    center: DVec2,
    /// The height of the figure in pixels.
    height: f64,
}

impl Frame {
    fn new(mesh: &Mesh, faces: &[FaceId], normal: DVec3, width: f64) -> Self {
        // If the faces are seen from above or below, the back of the scene is at the top of the figure.
        let up = if normal.y.abs() > 0.9 {
            DVec3::NEG_Z
        } else {
            DVec3::Y
        };
        let right = up.cross(normal).normalize_or(DVec3::X);
        let axes = [right, normal.cross(right)];
        let positions = faces.iter().flat_map(|&f| mesh.face_vertices(f));
        let positions: Vec<DVec3> = positions.map(|v| mesh.position(v)).collect();
        let first = positions.first().copied().unwrap_or_default();
        let (mut low, mut high) = (DVec2::ZERO, DVec2::ZERO);
        for p in &positions {
            let p = DVec2::from(axes.map(|axis| (*p - first).dot(axis)));
            (low, high) = (low.min(p), high.max(p));
        }
        let size = high - low;
        let inner = (width - 2.0 * MARGIN).max(1.0);
        let scale = inner / size.max_element();
        let scale = if scale.is_finite() { scale } else { 0.0 };
        let height = size.y * scale + 2.0 * MARGIN;
        let middle = (low + high) / 2.0;
        Self {
            axes,
            middle: first + axes[0] * middle.x + axes[1] * middle.y,
            scale,
            center: DVec2::new(width / 2.0, height / 2.0),
            height: height.ceil(),
        }
    }

    fn map(&self, mesh: &Mesh, v: VertexId) -> DVec2 {
        let p = mesh.position(v) - self.middle;
        let [x, y] = self.axes.map(|axis| axis.dot(p) * self.scale);
        self.center + DVec2::new(x, -y)
    }
}

/// Returns the mean of points, or the origin if there are no points.
fn middle(points: impl Iterator<Item = DVec2>) -> DVec2 {
    let (sum, n) = points.fold((DVec2::ZERO, 0.0), |(sum, n), p| (sum + p, n + 1.0));
    sum / f64::max(n, 1.0)
}

/// Returns by how many pixels a corner of a face is moved towards the middle of the face. `distance` is the distance
/// between the corner and the middle, in pixels.
fn inset(distance: f64) -> f64 {
    (GAP * 1.8).min(0.3 * distance)
}

/// Draws a loop of half-edges, with their names and the curves that connect them. The function `moved` returns the
/// position of a corner after it was moved into the face.
fn write_loop(
    svg: &mut Svg,
    mesh: &Mesh,
    frame: &Frame,
    half_edges: impl Iterator<Item = HalfEdgeId>,
    color: Color,
    moved: impl Fn(DVec2) -> DVec2,
) {
    let corner = |v| moved(frame.map(mesh, v));
    for h in half_edges {
        let next = mesh.next(h);
        let [a, b, c] = [mesh.origin(h), mesh.target(h), mesh.target(next)].map(corner);
        let [_, head] = arrow(svg, [a, b], color);
        let tail = b.lerp(c, SHORTENING);
        let curve = [('M', vec![head]), ('Q', vec![b, tail])];
        svg.path(
            &curve,
            &Paint::stroke([color[0], color[1], color[2], 120], 0.8),
        );
        let inwards = (b - a).perp().normalize_or_zero() * -NAME_GAP;
        name(
            svg,
            (a + b) / 2.0 + inwards,
            &h.to_string(),
            Font::Plain,
            color,
        );
    }
}

/// Draws an arrow between two points, shortened at both ends. Returns the two ends of the arrow.
fn arrow(svg: &mut Svg, [a, b]: [DVec2; 2], color: Color) -> [DVec2; 2] {
    let ends = [a.lerp(b, SHORTENING), b.lerp(a, SHORTENING)];
    let along = (b - a).normalize_or_zero();
    let base = ends[1] - along * 7.0;
    svg.polyline(&[ends[0], base], &Paint::stroke(color, 1.4));
    let side = along.perp() * 3.2;
    let head = [
        ('M', vec![ends[1]]),
        ('L', vec![base + side]),
        ('L', vec![base - side]),
        ('Z', Vec::new()),
    ];
    svg.path(&head, &Paint::fill(color));
    ends
}

/// Writes a name with its middle at a point.
fn name(svg: &mut Svg, middle: DVec2, name: &str, font: Font, color: Color) {
    let text = Text::new(font, name, FONT_SIZE, color).anchored(Anchor::Middle);
    svg.text(middle + DVec2::Y * 0.36 * FONT_SIZE, &text);
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::shapes;

    fn drawn(mesh: &Mesh, faces: &[FaceId]) -> (String, usize) {
        let (svg, hidden) = half_edges(mesh, faces, 320.0);
        (svg.finish(None), hidden)
    }

    #[test]
    fn every_half_edge_and_its_twin_are_named_once() {
        let mesh = shapes::square();
        let faces: Vec<FaceId> = mesh.faces().collect();
        let (text, hidden) = drawn(&mesh, &faces);
        assert_eq!(hidden, 0);
        for i in 0..8 {
            assert_eq!(text.matches(&format!(">h{i}<")).count(), 1, "h{i}");
        }
        for name in ["v0", "v1", "v2", "v3", "f0"] {
            assert_eq!(text.matches(&format!(">{name}<")).count(), 1, "{name}");
        }
    }

    #[test]
    fn faces_that_face_away_are_left_out() {
        let mesh = shapes::cube();
        let faces: Vec<FaceId> = mesh.faces().collect();
        let [near, ..] = faces[..] else {
            panic!("a cube has faces")
        };
        let (text, hidden) = drawn(&mesh, &[near]);
        assert_eq!((text.matches(">h").count(), hidden), (4, 0));
        let up = mesh.area_vector(near);
        let opposite = faces.iter().find(|&&f| mesh.area_vector(f).dot(up) < 0.0);
        let three = [near, near, *opposite.unwrap()];
        assert_eq!(drawn(&mesh, &three).1, 1);
    }

    #[test]
    fn any_mesh_is_drawn_with_finite_numbers() {
        for scale in [0.0, 1e-300, 1e150] {
            let mut mesh = shapes::cube();
            mesh.positions_mut().iter_mut().for_each(|p| *p *= scale);
            let faces: Vec<FaceId> = mesh.faces().collect();
            let (text, _) = drawn(&mesh, &faces[..2]);
            assert!(!text.contains("NaN") && !text.contains("inf"), "{scale}");
        }
    }
}
