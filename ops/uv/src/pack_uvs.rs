//! Pack UVs: moves existing charts into one page, and scales them so that areas in the texture are proportional to
//! areas on the surface.
//!
//! ```text
//!    +--+  +-----+           +-----+--+
//!    |  |  |     |           |     |  |
//!    +--+  |     |    -->    |     +--+--+
//!          +--+--+-----+     |     |     |
//!             |        |     +-----+-----+
//! ```

use geometry::uv::pack;
use mesh::Domain;
use op::prelude::*;

use crate::attribute::{
    coverage, error, get, missing, padding, padding_problem, page, page_of, plan, set, uv,
};

/// Moves, rotates and scales charts of texture coordinates so that they do not overlap and have the same scale.
///
/// A chart is a set of faces that are connected across edges at which the texture coordinates have no seam. After the
/// step, the area of each chart in the texture is proportional to its area on the surface. The shape of each chart in
/// the texture does not change. The step does not repair charts that are stretched or mirrored, or that overlap
/// themselves. A chart with zero area on the surface or in the texture becomes a point. The report counts these
/// zero-area charts, and the charts that overlap themselves. Each mesh gets its own page, that is, the whole square of
/// a texture. Tangents are removed, because charts are rotated.
///
/// If a mesh has at most 256 charts, charts can be placed in the hollows and holes of other charts. If a mesh has more
/// charts, all charts are packed in rows. Rows are computed much faster, but leave more of the page empty.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct PackUvs {
    /// The name of the texture coordinates. Defaults to `uv`.
    #[serde(default = "uv")]
    pub uv: String,
    /// The width and height of the texture, in texels. Texture coordinates are from 0 to 1 for every size. The size
    /// matters only for `padding`, which is a number of texels.
    #[serde(default = "page")]
    pub page: Count<16, 16384>,
    /// The width of the empty border around each chart, in texels. The distance between two charts is at least twice
    /// this width. Defaults to 2.
    #[serde(default = "padding")]
    pub padding: Count<0, 256>,
}

impl MeshOperation for PackUvs {
    const NAME: &'static str = "PackUvs";
    const VERSION: u32 = 3;
    const SUMMARY: &'static str = "Arrange charts of texture coordinates without overlaps";
    const EXAMPLE: &'static str = "PackUvs(page: 2048, padding: 4)";
    const WORDS: &'static [&'static str] = &["uv", "texture", "atlas", "lightmap", "island"];

    fn plan(&self, mesh: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::from_iter(padding_problem(page_of(self.page, self.padding)));
        let is_corner_uv =
            |a: &op::PlannedAttribute| a.domain == Domain::Corner && a.name == self.uv;
        if !mesh.has_unlisted_attributes && !mesh.attributes.iter().any(is_corner_uv) {
            problems.push(Problem::error(missing(&self.uv)).at(["uv"]));
        }
        plan(mesh, &self.uv);
        problems
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("pack charts", 0, 1)?;
        let page = page_of(self.page, self.padding);
        let packed = pack(mesh, get(mesh, &self.uv)?, page, cx.progress());
        let packed = packed.map_err(|e| error(&e))?;
        let mut report = Report::changed(packed.n_charts);
        set(mesh, &self.uv, packed.uvs, &mut report);
        let mut report = report
            .count("zero-area charts", packed.n_flat)
            .count("charts that overlap themselves", packed.n_overlapping);
        report.notes.push(coverage(packed.coverage));
        Ok(report)
    }
}

#[cfg(test)]
mod tests;
