//! Lines and points of meshes: wireframes, boundaries, creases, highlights, normals, numbers.

use ::mesh::{CREASE, Domain, EdgeId, Mesh, VERTEX_NORMAL, VertexId};
use glam::DVec3;
use scene::Object;

use super::{Builder, Coloring, Elements};
use crate::PictureError;
use crate::color::narrow;
use crate::drawing::{Label, Line, NO_FACE};
use crate::style::Ids;

/// The diameter of vertices without edges, in pixels: of a mesh that has no others, and beside a surface.
const LONELY: f64 = 3.0;
const LONELY_BESIDE: f64 = 1.8;
/// The width of the border of marked vertices on both sides together, as a part of their diameter.
const BORDER: f64 = 0.25;
/// No more labels than this: they would cover each other.
const MOST_IDS: usize = 2000;
/// The sharpness that never fades.
const SHARPEST: f64 = 10.0;

impl Builder<'_, '_> {
    /// Adds what lies on the last part.
    pub(super) fn edges(
        &mut self,
        object: &Object,
        mesh: &Mesh,
        coloring: Option<&Coloring>,
    ) -> Result<(), PictureError> {
        let style = self.style;
        if let Some(lines) = style.wireframe {
            for e in mesh.edges() {
                self.edge(mesh, e, lines.width, lines.color.linear(), lines.hidden);
                if let Some(line) = self.drawing.lines.last_mut() {
                    line.room = room(mesh, e);
                }
            }
        }
        if let Some(c) = coloring.filter(|c| c.domain == Domain::Edge) {
            for e in mesh.edges() {
                let [r, g, b] = c.map.linear(c.values[e.index()], c.range);
                self.edge(mesh, e, 3.0, [r, g, b, 1.0], 0.0);
            }
        }
        if let (Some(lines), Some(creases)) = (style.creases, mesh.get(CREASE)) {
            for e in mesh.edges() {
                let sharpness = (creases[e.index()] / SHARPEST).clamp(0.0, 1.0);
                if sharpness > 0.0 {
                    let width = lines.width * (1.0 + sharpness);
                    self.edge(mesh, e, width, lines.color.linear(), lines.hidden);
                }
            }
        }
        if let Some(lines) = style.boundary {
            for e in mesh.edges().filter(|&e| mesh.is_boundary_edge(e)) {
                self.edge(mesh, e, lines.width, lines.color.linear(), lines.hidden);
            }
        }
        self.vertices(mesh);
        let highlights = self.overlays.highlights.iter();
        for highlight in highlights.filter(|h| h.object == object.name) {
            let color = highlight.color.linear();
            match &highlight.elements {
                Elements::Faces(_) => {}
                Elements::Edges(edges) => {
                    for &e in edges.iter().filter(|&&e| mesh.has_edge(e)) {
                        self.edge(mesh, e, highlight.size, color, highlight.hidden);
                    }
                }
                Elements::Vertices(vertices) => {
                    // The light border tells them apart from lines and from each other.
                    let white = [1.0, 1.0, 1.0, 0.9];
                    let border = highlight.size * (1.0 + BORDER);
                    for &v in vertices.iter().filter(|&&v| mesh.has_vertex(v)) {
                        let at = mesh.position(v);
                        self.dot(at, border, white, 0.0);
                        self.dot(at, highlight.size, color, highlight.hidden);
                    }
                }
            }
        }
        self.ids(object, mesh)
    }

    fn edge(&mut self, mesh: &Mesh, e: EdgeId, width: f64, color: [f32; 4], hidden: f64) {
        let ends = mesh.edge_vertices(e).map(|v| mesh.position(v));
        let faces = mesh.edge_faces(e).map(|f| {
            let face = f.and_then(|f| u32::try_from(f.index()).ok());
            face.map_or(NO_FACE, |f| f.saturating_add(self.n_faces))
        });
        self.line(ends, width, color, faces, hidden);
    }

    /// Adds a line.
    pub(super) fn line(
        &mut self,
        ends: [DVec3; 2],
        width: f64,
        color: [f32; 4],
        faces: [u32; 2],
        hidden: f64,
    ) {
        self.drawing.lines.push(Line {
            ends,
            width: narrow(width),
            color,
            faces,
            hidden: narrow(hidden),
            room: f64::INFINITY,
        });
    }

    /// Adds a point.
    pub(super) fn dot(&mut self, at: DVec3, diameter: f64, color: [f32; 4], hidden: f64) {
        self.line([at; 2], diameter, color, [NO_FACE; 2], hidden);
    }

    /// Vertices without edges, normals, and dots on all vertices.
    fn vertices(&mut self, mesh: &Mesh) {
        let dark = crate::Color::rgb(28, 34, 48).linear();
        let is_lonely = |v: &VertexId| mesh.vertex_half_edge(*v).is_none();
        // Beside a surface they are mostly remains, and say little.
        let (diameter, color) = if mesh.n_edges() == 0 {
            (LONELY, dark)
        } else {
            (LONELY_BESIDE, [dark[0], dark[1], dark[2], 0.4])
        };
        for v in mesh.vertices().filter(is_lonely) {
            self.dot(mesh.position(v), diameter, color, 0.0);
        }
        if let Some(length) = self.style.normals {
            let given = mesh.get(VERTEX_NORMAL);
            let of = |v: VertexId| match given {
                Some(given) => given[v.index()],
                None => mesh.vertex_faces(v).map(|f| mesh.area_vector(f)).sum(),
            };
            let color = crate::Color::rgb(0, 114, 178).linear();
            for v in mesh.vertices() {
                let (p, n) = (mesh.position(v), of(v).normalize_or_zero());
                if n != DVec3::ZERO {
                    let end = p + n * (length * self.radius);
                    self.line([p, end], 1.2, color, [NO_FACE; 2], 0.0);
                }
            }
        }
        if let Some(diameter) = self.style.points {
            for v in mesh.vertices() {
                self.dot(mesh.position(v), diameter, dark, 0.0);
            }
        }
    }

    /// Labels with the numbers of elements.
    fn ids(&mut self, object: &Object, mesh: &Mesh) -> Result<(), PictureError> {
        let Some(ids) = self.style.ids else {
            return Ok(());
        };
        let n = match ids {
            Ids::Vertices => mesh.n_vertices(),
            Ids::Faces => mesh.n_faces(),
        };
        if n > MOST_IDS {
            return Err(PictureError::Style(format!(
                "expected at most {MOST_IDS} elements to write numbers at, \"{}\" has more; leave `ids` away",
                object.name
            )));
        }
        let label = |i: usize, at| Label {
            at,
            text: i.to_string(),
        };
        let labels = &mut self.drawing.labels;
        match ids {
            Ids::Vertices => {
                labels.extend(mesh.vertices().map(|v| label(v.index(), mesh.position(v))));
            }
            Ids::Faces => {
                labels.extend(mesh.faces().map(|f| label(f.index(), mesh.face_center(f))));
            }
        }
        Ok(())
    }
}

/// The mean length of the sides of the faces beside an edge: how far apart edges are there.
fn room(mesh: &Mesh, e: EdgeId) -> f64 {
    let (mut sum, mut n) = (0.0, 0);
    let faces = mesh.edge_faces(e).into_iter().flatten();
    for h in faces.flat_map(|f| mesh.face_half_edges(f)) {
        let [p, q] = [mesh.origin(h), mesh.target(h)].map(|v| mesh.position(v));
        sum += p.distance(q);
        n += 1;
    }
    if n > 0 {
        sum / f64::from(n)
    } else {
        f64::INFINITY
    }
}
