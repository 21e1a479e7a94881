//! Lift: moves every vertex upwards.

use mesh::DVec3;
use op::prelude::*;

/// Moves every vertex along the z axis.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Lift {
    /// How far, in scene units.
    pub by: f64,
}

impl MeshOperation for Lift {
    const NAME: &'static str = "Lift";
    const SUMMARY: &'static str = "Move every vertex upwards";
    const EXAMPLE: &'static str = "Lift(by: 2.5)";

    fn plan(&self, _: &mut MeshPlan, _: &PlanContext) -> Vec<Problem> {
        Vec::new()
    }

    fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("lift", 0, 1)?;
        for p in mesh.positions_mut() {
            *p += DVec3::new(0.0, 0.0, self.by);
        }
        Ok(Report::changed(mesh.n_vertices()))
    }
}
