//! Creates the overlay, which is drawn on top of the scene: picked elements, the element under the cursor, an arrow for
//! the half-edge, and the places of errors.

use editor::Picked;
use geometry::triangulate::Cutter;
use glam::DAffine3;
use mesh::{DVec3, Element, FaceId, HalfEdgeId, Mesh};
use op::Selected;
use scene::{ErrorLocation, Scene};

use crate::gpu::{Overlay, OverlayLine};

/// The maximum number of elements that are drawn. More elements would take longer than a frame to draw, and would cover
/// the picture.
const MAX_ELEMENTS: usize = 300_000;

/// The color and the sizes of drawn elements.
#[derive(Clone, Copy)]
struct Pen {
    color: [u8; 3],
    face: u8,
    edge: f32,
    vertex: f32,
    hidden: f32,
}

const PICKED: Pen = Pen {
    color: [255, 138, 43],
    face: 120,
    edge: 4.0,
    vertex: 11.0,
    hidden: 0.3,
};
const HOVERED: Pen = Pen {
    color: [255, 205, 120],
    face: 60,
    edge: 2.6,
    vertex: 9.0,
    hidden: 0.0,
};
const WRONG: Pen = Pen {
    color: [236, 64, 64],
    face: 120,
    edge: 4.0,
    vertex: 11.0,
    hidden: 0.4,
};
const ARROW: [u8; 4] = [64, 196, 255, 255];

/// Returns the overlay of a scene. `hovered` is the element under the cursor, and `marked` is an element that is drawn
/// like a picked element.
pub(crate) fn overlay(
    scene: &Scene,
    picked: Option<&Picked>,
    [hovered, marked]: &[Option<(String, Element)>; 2],
    places: &[ErrorLocation],
) -> Overlay {
    let mut overlay = Overlay::default();
    for instance in scene.instances() {
        let Some(mesh) = instance.object.as_mesh() else {
            continue;
        };
        let name = &instance.object.name;
        let mut draw = Draw {
            mesh,
            to_scene: instance.to_scene,
            overlay: &mut overlay,
            cutter: Cutter::default(),
        };
        if let Some(picked) = picked.filter(|picked| picked.object == *name) {
            draw.picked(picked);
        }
        for (element, pen) in [(marked, PICKED), (hovered, HOVERED)] {
            if let Some((_, element)) = element.as_ref().filter(|(object, _)| object == name) {
                draw.element(*element, pen);
            }
        }
    }
    for place in places.iter().take(MAX_ELEMENTS) {
        draw_points(&mut overlay, &place.points, WRONG);
    }
    overlay
}

struct Draw<'a> {
    mesh: &'a Mesh,
    to_scene: DAffine3,
    overlay: &'a mut Overlay,
    cutter: Cutter,
}

impl Draw<'_> {
    fn picked(&mut self, picked: &Picked) {
        match &picked.elements {
            Selected::Vertices(list) => {
                for &v in list.iter().take(MAX_ELEMENTS) {
                    self.element(Element::Vertex(v), PICKED);
                }
            }
            Selected::Edges(list) => {
                for &e in list.iter().take(MAX_ELEMENTS) {
                    self.element(Element::Edge(e), PICKED);
                }
            }
            Selected::Faces(list) => {
                for &f in list.iter().take(MAX_ELEMENTS) {
                    self.element(Element::Face(f), PICKED);
                }
            }
        }
        if let Some(h) = picked.half_edge.filter(|h| self.mesh.has_edge(h.edge())) {
            self.arrow(h);
        }
    }

    fn element(&mut self, element: Element, pen: Pen) {
        let points: Vec<DVec3> = self
            .mesh
            .element_points(element)
            .iter()
            .map(|&p| self.to_scene.transform_point3(p))
            .collect();
        if let Element::Face(f) = element {
            if self.mesh.has_face(f) {
                self.face(f, &points, pen);
            }
        } else {
            draw_points(self.overlay, &points, pen);
        }
    }

    fn face(&mut self, f: FaceId, points: &[DVec3], pen: Pen) {
        let [r, g, b] = pen.color;
        let color = [r, g, b, pen.face];
        if let &[p, q, s] = points {
            self.overlay.triangles.push(([p, q, s], color));
        } else {
            for corners in self.cutter.cut(self.mesh, f).triangles() {
                let corners = corners.map(|c| points[c as usize]);
                self.overlay.triangles.push((corners, color));
            }
        }
        draw_outline(
            self.overlay,
            points,
            Pen {
                edge: 1.5,
                hidden: 0.0,
                ..pen
            },
        );
    }

    /// Draws the half-edge as an arrow inside its face.
    fn arrow(&mut self, h: HalfEdgeId) {
        let [p, q] = [self.mesh.origin(h), self.mesh.target(h)].map(|v| self.mesh.position(v));
        let along = q - p;
        let length = along.length();
        // The normal of the face of h. If h has no face, this is the normal of the face on the other side of the edge.
        let normal = match (self.mesh.face(h), self.mesh.face(h.twin())) {
            (Some(f), _) | (None, Some(f)) => self.mesh.face_normal(f),
            (None, None) => DVec3::ZERO,
        };
        let inwards = normal.cross(along).normalize_or_zero();
        let at = |t: f64, aside: f64| {
            self.to_scene
                .transform_point3(p + along * t + inwards * (aside * length))
        };
        let (tail, tip) = (at(0.2, 0.08), at(0.8, 0.08));
        for ends in [[tail, tip], [tip, at(0.7, 0.15)], [tip, at(0.7, 0.02)]] {
            self.overlay.lines.push(OverlayLine {
                ends,
                width: 3.4,
                hidden: 0.35,
                color: ARROW,
            });
        }
        self.overlay.lines.push(OverlayLine {
            ends: [tail; 2],
            width: 7.0,
            hidden: 0.35,
            color: ARROW,
        });
    }
}

/// Draws a point, an edge or the outline of a face.
fn draw_points(overlay: &mut Overlay, points: &[DVec3], pen: Pen) {
    let [r, g, b] = pen.color;
    match *points {
        [] => {}
        [p] => {
            let dot = |width, color| OverlayLine {
                ends: [p; 2],
                width,
                hidden: 0.0,
                color,
            };
            overlay
                .lines
                .push(dot(pen.vertex + 3.0, [255, 255, 255, 230]));
            overlay.lines.push(OverlayLine {
                hidden: pen.hidden,
                ..dot(pen.vertex, [r, g, b, 255])
            });
        }
        [p, q] => {
            let color = [r, g, b, 255];
            overlay.lines.push(OverlayLine {
                ends: [p, q],
                width: pen.edge,
                hidden: pen.hidden,
                color,
            });
        }
        _ => {
            for i in 1..points.len() - 1 {
                let corners = [points[0], points[i], points[i + 1]];
                overlay.triangles.push((corners, [r, g, b, pen.face]));
            }
            draw_outline(overlay, points, pen);
        }
    }
}

fn draw_outline(overlay: &mut Overlay, points: &[DVec3], pen: Pen) {
    let [r, g, b] = pen.color;
    for (i, &p) in points.iter().enumerate() {
        let ends = [p, points[(i + 1) % points.len()]];
        let color = [r, g, b, 255];
        overlay.lines.push(OverlayLine {
            ends,
            width: pen.edge,
            hidden: pen.hidden,
            color,
        });
    }
}

/// Describes picked elements in words: "edge 3 to 7", "12 faces".
pub(crate) fn describe(mesh: &Mesh, picked: &Picked) -> String {
    let many = |n: usize, word: &str| format!("{n} {word}");
    match &picked.elements {
        Selected::Vertices(list) => match list[..] {
            [v] => {
                let p = mesh.position(v);
                format!(
                    "vertex {}, valence {}, at ({:.4}, {:.4}, {:.4})",
                    v.index(),
                    mesh.valence(v),
                    p.x,
                    p.y,
                    p.z
                )
            }
            _ => many(list.len(), "vertices"),
        },
        Selected::Edges(list) => match list[..] {
            [e] => {
                let [v, w] = mesh.edge_vertices(e);
                let length = mesh.position(v).distance(mesh.position(w));
                let angle = mesh.dihedral_angle(e);
                let angle = angle.map_or_else(
                    || "boundary".to_owned(),
                    |a| format!("angle {:.1}°", a.to_degrees()),
                );
                format!(
                    "edge {} to {}, length {length:.4}, {angle}",
                    v.index(),
                    w.index()
                )
            }
            _ => many(list.len(), "edges"),
        },
        Selected::Faces(list) => match list[..] {
            [f] => format!(
                "face {}, {} corners, area {:.4}",
                f.index(),
                mesh.degree(f),
                mesh.face_area(f)
            ),
            _ => many(list.len(), "faces"),
        },
    }
}
