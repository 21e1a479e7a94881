//! Adds the lines, points and labels of meshes to a drawing: wireframes, boundaries, creases, highlights, normals and
//! ids.

use ::mesh::{CREASE, Domain, EdgeId, Mesh, VERTEX_NORMAL, VertexId};
use glam::DVec3;
use scene::Object;

use super::{Builder, Coloring, Elements};
use crate::PictureError;
use crate::color::narrow;
use crate::drawing::{Label, Line, NO_FACE};
use crate::style::Ids;

/// The diameter of isolated vertices in a mesh without edges, in pixels.
const ISOLATED_ALONE: f64 = 3.0;
/// The diameter of isolated vertices in a mesh with edges, in pixels.
const ISOLATED_BESIDE_EDGES: f64 = 1.8;
/// The border of a highlighted vertex: the difference between the outer and the inner diameter, as a fraction of the
/// inner diameter.
const BORDER: f64 = 0.25;
/// The maximum number of id labels of a mesh. With more labels than this, the labels would cover each other.
const MAX_IDS: usize = 2000;
/// Creases with at least this sharpness are drawn with twice the width of the style.
const MAX_SHARPNESS: f64 = 10.0;

impl Builder<'_, '_> {
    /// Adds the lines, points and labels of a mesh.
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
                    line.spacing = spacing(mesh, e);
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
                let sharpness = (creases[e.index()] / MAX_SHARPNESS).clamp(0.0, 1.0);
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
                    // Each dot has a white border, which separates it from lines and from other dots.
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

    /// Adds the line of an edge.
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
            spacing: f64::INFINITY,
        });
    }

    /// Adds a point.
    pub(super) fn dot(&mut self, at: DVec3, diameter: f64, color: [f32; 4], hidden: f64) {
        self.line([at; 2], diameter, color, [NO_FACE; 2], hidden);
    }

    /// Adds isolated vertices. If the style draws normals or points, also adds a normal or a dot for each vertex.
    fn vertices(&mut self, mesh: &Mesh) {
        let dark = crate::Color::rgb(28, 34, 48).linear();
        let is_isolated = |v: &VertexId| mesh.vertex_half_edge(*v).is_none();
        // Isolated vertices of a mesh with edges are rarely important, so they are small and faint.
        let (diameter, color) = if mesh.n_edges() == 0 {
            (ISOLATED_ALONE, dark)
        } else {
            (ISOLATED_BESIDE_EDGES, [dark[0], dark[1], dark[2], 0.4])
        };
        for v in mesh.vertices().filter(is_isolated) {
            self.dot(mesh.position(v), diameter, color, 0.0);
        }
        if let Some(length) = self.style.normals {
            let attribute = mesh.get(VERTEX_NORMAL);
            let area_vectors = mesh.area_vectors();
            let normal = |v: VertexId| match attribute {
                Some(normals) => normals[v.index()],
                None => mesh.vertex_faces(v).map(|f| area_vectors[f.index()]).sum(),
            };
            let color = crate::Color::rgb(0, 114, 178).linear();
            for v in mesh.vertices() {
                let (p, n) = (mesh.position(v), normal(v).normalize_or_zero());
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

    /// Adds labels with the ids of vertices or faces, if the style asks for them.
    fn ids(&mut self, object: &Object, mesh: &Mesh) -> Result<(), PictureError> {
        let Some(ids) = self.style.ids else {
            return Ok(());
        };
        let (n, elements) = match ids {
            Ids::Vertices => (mesh.n_vertices(), "vertices"),
            Ids::Faces => (mesh.n_faces(), "faces"),
        };
        if n > MAX_IDS {
            return Err(PictureError::Style(format!(
                "a picture can show the ids of at most {MAX_IDS} {elements}, but \"{}\" has {n} {elements}: omit `ids`",
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

/// Estimates the distance from the edge `e` to neighboring edges: the mean length of the edges of the faces beside `e`.
/// The distance is infinite if `e` has no faces.
fn spacing(mesh: &Mesh, e: EdgeId) -> f64 {
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
