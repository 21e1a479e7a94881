//! Adds Bezier patches, curves, polylines, and strokes of overlays to a drawing.

use std::collections::BTreeMap;

use bezier::{Curve, Faces, Patch, Tessellation};
use glam::{DVec2, DVec3};

use super::mesh_part::rgb;
use super::normals::narrowed;
use super::{Builder, Stroke};
use crate::PictureError;
use crate::color::Color;
use crate::drawing::{Channel, NO_FACE, Part, Surface};
use crate::figure::construction;
use crate::style::Lines;

/// A patch is drawn as a square grid of cells. This is the number of cells along each side of the grid.
const CELLS: u32 = 24;
/// The number of line segments into which a curve is divided for drawing.
const SEGMENTS: u32 = 200;
/// The diameter of the dot for a polyline with a single point, as a multiple of the line width.
const SINGLE_POINT: f64 = 3.0;

impl Builder<'_, '_> {
    /// Adds Bezier patches. If the style draws wireframes, also adds a grid on each patch. If the style draws control
    /// nets, also adds the control net of each patch.
    pub(super) fn patches(&mut self, patches: &[Patch], color: Color) -> Result<(), PictureError> {
        let surface = bezier::tessellate(patches, CELLS, Faces::Quads)
            .map_err(|e| PictureError::Style(format!("the patches cannot be drawn: {e}")))?;
        let (mut triangles, mut faces) = (Vec::new(), Vec::new());
        for (f, corners) in (0..).zip(surface.faces()) {
            for pair in corners[1..].windows(2) {
                triangles.push([corners[0], pair[0], pair[1]]);
                faces.push(f);
            }
        }
        let n_faces = u32::try_from(surface.faces().count()).unwrap_or(u32::MAX);
        if let Some(lines) = self.style.wireframe {
            self.grid(&surface, &lines);
        }
        let normals = Channel::Point(narrowed(&surface.normals).into());
        self.drawing.parts.push(Part {
            points: surface.positions.into(),
            triangles,
            corners: Vec::new(),
            faces,
            n_faces,
            normals,
            colors: Channel::All(rgb(color.linear())),
            highlights: Vec::new(),
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

    /// Adds the edges of a tessellated surface. This function must be called before the faces of the surface are added.
    /// It assumes that the indices of these faces start at `n_faces`.
    fn grid(&mut self, surface: &Tessellation, lines: &Lines) {
        let mut edges: BTreeMap<[u32; 2], [u32; 2]> = BTreeMap::new();
        for (f, corners) in (self.n_faces..).zip(surface.faces()) {
            for (i, &p) in corners.iter().enumerate() {
                let q = corners[(i + 1) % corners.len()];
                let faces = edges.entry([p.min(q), p.max(q)]).or_insert([f, NO_FACE]);
                if faces[0] != f {
                    faces[1] = f;
                }
            }
        }
        for (ends, faces) in edges {
            let ends = ends.map(|p| surface.positions[p as usize]);
            self.line(ends, lines.width, lines.color.linear(), faces, lines.hidden);
            if let Some(line) = self.drawing.lines.last_mut() {
                line.spacing = ends[0].distance(ends[1]);
            }
        }
    }

    /// Adds a curve. If the style draws control nets, also adds the control polygon of the curve.
    pub(super) fn curve(&mut self, curve: &Curve<DVec2>, color: Color) {
        let points: Vec<DVec3> = curve.sample(SEGMENTS).map(|p| p.extend(0.0)).collect();
        let color = self.line_color(color);
        self.polyline(&points, color);
        let control: Vec<DVec3> = curve.points().iter().map(|p| p.extend(0.0)).collect();
        self.control_polygon(&control);
    }

    /// Adds polylines. If the style draws points, also adds dots at the points of the polylines. If the style sets a
    /// color, the polylines have this color. Otherwise, if the polylines are the levels of de Casteljau's construction,
    /// they have the same colors as in a figure of the construction.
    pub(super) fn polylines(&mut self, lines: &[Vec<DVec3>], color: Color) {
        let default = self.line_color(color);
        let are_levels = self.style.color.is_none() && are_levels(lines);
        for (r, line) in lines.iter().enumerate() {
            let color = if are_levels {
                Color(construction::color_of_level(r, lines.len())).linear()
            } else {
                default
            };
            self.polyline(line, color);
            if let Some(diameter) = self.style.points {
                for &point in line {
                    self.dot(point, diameter, color, 0.0);
                }
            }
        }
    }

    /// Returns the color of lines. If the style does not set the color, lines are darker than surfaces, so that lines
    /// are visible on white.
    fn line_color(&self, color: Color) -> [f32; 4] {
        let [r, g, b, a] = color.linear();
        if self.style.color.is_some() {
            [r, g, b, a]
        } else {
            [r * r * 0.5, g * g * 0.5, b * b * 0.6, a]
        }
    }

    /// Adds lines between consecutive points, or a dot for a single point.
    fn polyline(&mut self, points: &[DVec3], color: [f32; 4]) {
        let width = self.style.curve_width;
        self.line_through(points, [width, SINGLE_POINT * width], color, 0.0);
    }

    /// Adds a line or a dot of an overlay.
    pub(super) fn stroke(&mut self, stroke: &Stroke) {
        let color = stroke.color.linear();
        self.line_through(&stroke.points, [stroke.width; 2], color, stroke.hidden);
    }

    /// Adds a line of this width through several points, or a dot of this diameter at a single point.
    fn line_through(
        &mut self,
        points: &[DVec3],
        [width, diameter]: [f64; 2],
        color: [f32; 4],
        hidden: f64,
    ) {
        for ends in points.windows(2) {
            self.line([ends[0], ends[1]], width, color, [NO_FACE; 2], hidden);
        }
        if let [point] = points {
            self.dot(*point, diameter, color, hidden);
        }
    }

    /// Adds a control polygon and its points, if the style draws control nets.
    fn control_polygon(&mut self, points: &[DVec3]) {
        let Some(lines) = self.style.control_nets else {
            return;
        };
        let color = lines.color.linear();
        if points.len() > 1 {
            self.line_through(points, [lines.width; 2], color, lines.hidden);
        }
        for &point in points {
            self.dot(point, 3.0 * lines.width + 1.5, color, lines.hidden);
        }
    }
}

/// Whether polylines are the levels of de Casteljau's construction: each polyline has one point fewer than the previous
/// one, and the last is a single point.
fn are_levels(lines: &[Vec<DVec3>]) -> bool {
    let loses_one = |pair: &[Vec<DVec3>]| pair[0].len() == pair[1].len() + 1;
    lines.len() > 1 && lines.windows(2).all(loses_one) && lines[lines.len() - 1].len() == 1
}

#[cfg(test)]
mod tests {
    use bezier::{Curve, Patch};
    use glam::{DVec2, DVec3};
    use scene::{Geometry, Object, Scene};

    use super::{CELLS, NO_FACE};
    use crate::{Color, Drawing, Lines, Overlays, Style, build};

    fn polylines(lines: Vec<Vec<DVec3>>) -> Scene {
        let mut scene = Scene::new();
        let object = Object::new("lines", Geometry::Polylines(lines));
        scene.insert(object).unwrap();
        scene
    }

    fn build_drawing<'s>(scene: &'s Scene, style: &Style) -> Drawing<'s> {
        let (drawing, _) = build(scene, style, &Overlays::default(), &mut |_| None).unwrap();
        drawing
    }

    #[test]
    fn a_wireframe_shows_the_cells_of_patches() {
        let points =
            [0.0, 1.0, 2.0, 3.0].map(|y| [0.0, 1.0, 2.0, 3.0].map(|x| DVec3::new(x, y, 0.0)));
        let patches = Geometry::Patches(vec![Patch::new(points).unwrap()]);
        let mut scene = Scene::new();
        scene.insert(Object::new("sheet", patches)).unwrap();
        assert!(build_drawing(&scene, &Style::default()).lines.is_empty());
        let style = Style {
            wireframe: Some(Lines::default()),
            ..Style::default()
        };
        let drawing = build_drawing(&scene, &style);
        let n = CELLS as usize;
        assert_eq!(drawing.lines.len(), 2 * n * (n + 1));
        assert_eq!(drawing.n_triangles(), 2 * n * n);
        // Both ends of a line must be corners of each face that the line names as a neighbor.
        for line in &drawing.lines {
            let part = &drawing.parts[0];
            for face in line.faces.into_iter().filter(|&f| f != NO_FACE) {
                let triangles =
                    (0..part.triangles.len()).filter(|&t| part.face(t) == face as usize);
                let corners: Vec<DVec3> = triangles.flat_map(|t| part.corners_at(t)).collect();
                assert!(line.ends.iter().all(|end| corners.contains(end)));
            }
        }
    }

    #[test]
    fn points_of_polylines_have_dots_if_the_style_has_points() {
        let line = vec![DVec3::ZERO, DVec3::X, DVec3::ONE];
        let scene = polylines(vec![line.clone(), vec![DVec3::Z, DVec3::Y]]);
        let lines = |points| {
            let style = Style {
                points,
                ..Style::default()
            };
            build_drawing(&scene, &style).lines
        };
        assert_eq!(lines(None).len(), 3);
        let dots: Vec<_> = (lines(Some(7.0)).iter())
            .filter(|l| l.ends[0] == l.ends[1] && l.width == 7.0)
            .map(|l| l.ends[0])
            .collect();
        assert_eq!(dots, [&line[..], &[DVec3::Z, DVec3::Y]].concat());
    }

    #[test]
    fn levels_of_a_construction_have_different_colors() {
        let points = [[0.0, 0.0], [1.0, 3.0], [3.0, 3.0], [4.0, 0.0]];
        let curve = Curve::new(points.map(DVec2::from).to_vec()).unwrap();
        let levels = curve.levels(0.5).into_iter();
        let scene = polylines(
            levels
                .map(|level| level.iter().map(|p| p.extend(0.0)).collect())
                .collect(),
        );
        let colors = |style: &Style| {
            let lines = build_drawing(&scene, style).lines;
            let mut colors: Vec<_> = lines.iter().map(|l| l.color).collect();
            colors.dedup();
            colors
        };
        let found = colors(&Style::default());
        assert_eq!(found.len(), 4);
        assert!((1..4).all(|i| !found[..i].contains(&found[i])));
        // If the style sets a color, all levels have this color.
        let blue = Color::rgb(0, 0, 200);
        let style = Style {
            color: Some(blue),
            ..Style::default()
        };
        assert_eq!(colors(&style), [blue.linear()]);
    }
}
