//! Unwrap: computes texture coordinates without overlaps.
//!
//! ```text
//!        +---+               +---+
//!       /   /|               |   |
//!      +---+ +           +---+---+---+
//!      |   |/     -->    |   |   |   |
//!      +---+             +---+---+---+
//! ```

use geometry::uv::{UnwrapOptions, unwrap};
use mesh::Element;
use op::Refusal;
use op::prelude::*;

use crate::attribute::{coverage, error, padding, padding_problem, page, page_of, plan, set, uv};

/// Computes texture coordinates without overlaps.
///
/// The surface is cut into charts, which are connected parts of the surface. The charts are flattened and packed into
/// the page, the square of the texture with u and v from 0 to 1. Each chart grows from a flat region, as long as the
/// normals of its faces differ from their mean by at most `max_angle`. Each chart is flattened by a least squares
/// conformal map (Levy and others, 2002), which the hybrid method of Liu and others (2008) then improves. A chart is
/// cut again if its flattened shape overlaps itself or exceeds `max_stretch`. A chart is also cut again if its angles
/// are distorted too much. This distortion turns a small circle on the surface into an ellipse in the texture. On at
/// least 95 % of the area of a chart, the longer axis of this ellipse is at most 1.15 times the shorter axis. All
/// charts of a mesh have the same scale, and no chart is mirrored. No polygon is divided between charts. Each mesh gets
/// its own page. The charts are arranged on the page in the same way as by `PackUvs`.
///
/// The coordinates are written to the corner attribute that the parameter `uv` names. If this attribute already exists,
/// it is replaced. Edges at which charts meet become seams of the texture coordinates. Positions, faces and other
/// attributes do not change, but tangents are removed because they depend on the texture coordinates. Zero-area faces
/// also have zero area in the texture. The report counts the faces with zero area in the texture. If a polygon is bent
/// so far that it overlaps itself in the texture, the step fails and gives the reason `WrongPlace`. To avoid this
/// failure, triangulate the bent polygons before this step. With `on_refusal: Skip`, the step does not fail, and the
/// triangles of the bent polygons overlap in the texture.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Unwrap {
    /// Edges that become borders of charts, for example `Tagged("seam")` or `Sharp(above: 60)`. The algorithm adds more
    /// borders where charts need them. If omitted, the algorithm chooses all borders.
    #[serde(default)]
    pub seams: Option<EdgeSelection>,
    /// The largest angle between the normal of a face and the mean normal of its chart, in degrees. Smaller angles give
    /// more charts with less stretch.
    #[serde(default = "max_angle")]
    #[schemars(range(min = 1.0, max = 89.0))]
    pub max_angle: f64,
    /// The area scale of a triangle is allowed to differ from the area scale of its whole chart by at most this factor.
    /// The area scale is the area in the texture divided by the area on the surface.
    #[serde(default = "max_stretch")]
    #[schemars(range(min = 1.0, max = 1000.0))]
    pub max_stretch: f64,
    /// The width and height of the texture, in texels. Texture coordinates are from 0 to 1 for every size. The size
    /// matters only for `padding`, which is a number of texels.
    #[serde(default = "page")]
    pub page: Count<16, 16384>,
    /// The width of the empty border around each chart, in texels. The distance between two charts is at least twice
    /// this width. Defaults to 2.
    #[serde(default = "padding")]
    pub padding: Count<0, 256>,
    /// The name of the texture coordinates. Defaults to `uv`.
    #[serde(default = "uv")]
    pub uv: String,
    /// What to do if a polygon overlaps itself in the texture.
    #[serde(default)]
    pub on_refusal: OnRefusal,
}

const fn max_angle() -> f64 {
    70.0
}

const fn max_stretch() -> f64 {
    4.0
}

impl MeshOperation for Unwrap {
    const NAME: &'static str = "Unwrap";
    const VERSION: u32 = 5;
    const SUMMARY: &'static str = "Compute texture coordinates without overlaps";
    const EXAMPLE: &'static str = "Unwrap(max_angle: 60)";
    const WORDS: &'static [&'static str] = &["uv", "texture", "atlas", "lightmap", "parameterize"];

    fn plan(&self, mesh: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        plan(mesh, &self.uv);
        Vec::from_iter(padding_problem(page_of(self.page, self.padding)))
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        let seams = match &self.seams {
            Some(seams) => seams.resolve(mesh, cx)?,
            None => Vec::new(),
        };
        cx.advance("grow charts", 0, 1)?;
        let options = UnwrapOptions {
            seams: &seams,
            max_angle: self.max_angle,
            max_stretch: self.max_stretch,
            page: page_of(self.page, self.padding),
        };
        let unwrapped = unwrap(mesh, &options, cx.progress()).map_err(|e| error(&e))?;
        let mut report = Report::changed(mesh.faces().map(|f| mesh.degree(f)).sum());
        if let Some(first) = unwrapped.bent.first() {
            let n = unwrapped.bent.len();
            let message = format!(
                "{first} is bent so far that it overlaps itself in the texture (number of such faces: {n}); triangulate the faces first, with Triangulate"
            );
            let refused = OpError::refused(Refusal::WrongPlace, message);
            let faces = unwrapped.bent.iter().map(|&f| Element::from(f));
            self.on_refusal.refuse(refused.about(faces), &mut report)?;
        }
        set(mesh, &self.uv, unwrapped.uvs, &mut report);
        let mut report = report
            .count("charts", unwrapped.charts.n)
            .count("faces with zero area in the texture", unwrapped.flat.len());
        report.notes.push(coverage(unwrapped.coverage));
        Ok(report)
    }
}

#[cfg(test)]
mod tests;
