//! Bezier patches, curves and polylines.

use bezier::{Curve, Faces, Patch};
use glam::{DVec2, DVec3};

use super::mesh_part::rgb;
use super::normals::narrowed;
use super::{Builder, Stroke};
use crate::PictureError;
use crate::color::Color;
use crate::drawing::{Channel, NO_FACE, Normals, Part, Surface};

/// Cells of a patch along each side.
const CELLS: u32 = 24;
/// Pieces of a curve.
const PIECES: u32 = 200;

impl Builder<'_, '_> {
    /// Adds Bezier patches, and their control nets if the style wants them.
    pub(super) fn patches(&mut self, patches: &[Patch], color: Color) -> Result<(), PictureError> {
        let surface = bezier::tessellate(patches, CELLS, Faces::Triangles)
            .map_err(|e| PictureError::Style(format!("the patches cannot be drawn: {e}")))?;
        let triangles: Vec<[u32; 3]> = surface
            .faces()
            .filter_map(|corners| corners.try_into().ok())
            .collect();
        let n_faces = u32::try_from(triangles.len()).unwrap_or(u32::MAX);
        let normals = Normals::Given(Channel::Point(narrowed(&surface.normals).into()));
        self.drawing.parts.push(Part {
            points: surface.positions.into(),
            triangles,
            corners: Vec::new(),
            faces: Vec::new(),
            n_faces,
            normals,
            colors: Channel::All(rgb(color.linear())),
            marks: Vec::new(),
            materials: vec![Surface::default()],
            material_of_face: Vec::new(),
            uvs: Vec::new(),
            back: self.style.back.map(|c| rgb(c.linear())),
        });
        self.n_faces = self.n_faces.saturating_add(n_faces);
        for patch in patches {
            let rows = *patch.points();
            let columns = *patch.transposed().points();
            for line in rows.iter().chain(&columns) {
                self.control_polygon(line);
            }
        }
        Ok(())
    }

    /// Adds a curve, and its control polygon if the style wants it.
    pub(super) fn curve(&mut self, curve: &Curve<DVec2>, color: Color) {
        let points: Vec<DVec3> = curve.sample(PIECES).map(|p| p.extend(0.0)).collect();
        self.chain(&points, color);
        let control: Vec<DVec3> = curve.points().iter().map(|p| p.extend(0.0)).collect();
        self.control_polygon(&control);
    }

    /// Adds polylines.
    pub(super) fn polylines(&mut self, lines: &[Vec<DVec3>], color: Color) {
        for line in lines {
            self.chain(line, color);
        }
    }

    /// Lines between consecutive points. They are darker than a surface would be, to be seen on white.
    fn chain(&mut self, points: &[DVec3], color: Color) {
        let [r, g, b, a] = color.linear();
        let color = if self.style.color.is_some() {
            [r, g, b, a]
        } else {
            [r * r * 0.5, g * g * 0.5, b * b * 0.6, a]
        };
        self.through(points, self.style.curve_width, color, 0.0);
    }

    /// Adds a line or a dot of an overlay.
    pub(super) fn stroke(&mut self, stroke: &Stroke) {
        let color = stroke.color.linear();
        self.through(&stroke.points, stroke.width, color, stroke.hidden);
    }

    /// A line through points; a dot if there is one.
    fn through(&mut self, points: &[DVec3], width: f64, color: [f32; 4], hidden: f64) {
        for ends in points.windows(2) {
            self.line([ends[0], ends[1]], width, color, [NO_FACE; 2], hidden);
        }
        if let [point] = points {
            self.dot(*point, width, color, hidden);
        }
    }

    /// A control polygon with its points, if the style wants it.
    fn control_polygon(&mut self, points: &[DVec3]) {
        let Some(lines) = self.style.control_nets else {
            return;
        };
        let color = lines.color.linear();
        if points.len() > 1 {
            self.through(points, lines.width, color, lines.hidden);
        }
        for &point in points {
            self.dot(point, 3.0 * lines.width + 1.5, color, lines.hidden);
        }
    }
}
