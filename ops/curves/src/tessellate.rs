//! Tessellate: turns Bezier patches into a mesh.
//!
//! ```text
//!    .-----.-----.            .--.--.--.--.
//!   /             \           | /| /| /| /|       every patch is cut into
//!  .   a  patch    .   -->    .--.--.--.--.       segments x segments cells
//!   \             /           | /| /| /| /|
//!    '-----'-----'            '--'--'--'--'
//! ```
//!
//! How cells are numbered and cut, and what becomes of sides that are one point, is told by the
//! tessellation of the crate `bezier`.

use std::sync::Arc;

use bezier::{BezierError, Patch, Tessellation, counts, tessellate_patch};
use mesh::{BuildOutput, BuildReport, DVec2, DVec3, Domain, NonManifold, UV, VERTEX_NORMAL};
use op::prelude::*;
use op::{Operation, TargetKind, target_names};
use scene::Geometry;

/// Turns Bezier patches into a mesh.
///
/// Acts on every object that is patches, or on those named in `on`; each becomes one mesh of the same
/// name. Every patch is cut into `segments` x `segments` cells, patch after patch. Patches share no
/// vertices, but where they have the same control points on a common side their positions there are
/// the same bits: `Weld(distance: 0)` joins them. A side that is one point, as at the pole of a teapot's
/// lid, becomes one vertex; patches without any area give nothing and are counted. A tessellation has
/// no UVs and no normals unless they are asked for.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Tessellate {
    /// How many cells along each side of a patch.
    #[serde(default = "eight")]
    pub segments: Count<1, 4096>,
    /// What a cell becomes.
    #[serde(default)]
    pub faces: Faces,
    /// Whether to write the parameters (u, v) of each patch as UVs of corners.
    ///
    /// Each patch covers the whole square from 0 to 1.
    #[serde(default)]
    pub uvs: bool,
    /// Whether to write the exact unit normals of the patches as normals of vertices.
    #[serde(default)]
    pub normals: bool,
}

/// What a cell of a patch becomes.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Faces {
    /// Two triangles, cut from the corner of the lowest u and v.
    #[default]
    Triangles,
    /// One quadrilateral; a triangle beside a side that is one point.
    Quads,
}

impl From<Faces> for bezier::Faces {
    fn from(faces: Faces) -> Self {
        match faces {
            Faces::Triangles => Self::Triangles,
            Faces::Quads => Self::Quads,
        }
    }
}

const fn eight() -> Count<1, 4096> {
    Count::literal(8)
}

const WANTED: TargetKind = TargetKind {
    operation: "Tessellate",
    does: "cuts patches",
    none: "no patches to cut",
    help: "load a .bez file in an earlier step",
};

impl Operation for Tessellate {
    const NAME: &'static str = "Tessellate";
    const SUMMARY: &'static str = "Turn Bezier patches into a mesh";
    const EXAMPLE: &'static str = "Tessellate(segments: 3)";
    const TAKES_ON: bool = true;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        WANTED.plan(plan, cx, |geometry| {
            let PlannedGeometry::Patches(patches) = *geometry else {
                return None;
            };
            *geometry = PlannedGeometry::Mesh(self.planned(patches.max));
            Some(Vec::new())
        })
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        cx.advance("tessellate", 0, 1)?;
        let names = target_names(scene, cx, |g| matches!(g, Geometry::Patches(_)))?;
        let mut report = Report::default();
        for name in &names {
            let (geometry, _) = scene.parts_mut(name).expect("named above");
            let Geometry::Patches(patches) = geometry else {
                let message = WANTED.wrong_kind_message(name, geometry.kind());
                return Err(OpError::Object(message));
            };
            let patches = std::mem::take(patches);
            self.check_budget(name, &patches, scene, cx)?;
            let (mesh, done) = self.tessellated(&patches, cx)?;
            report.merge(done);
            let (geometry, _) = scene.parts_mut(name).expect("named above");
            *geometry = Geometry::Mesh(Arc::new(mesh));
        }
        Ok(report)
    }
}

impl Tessellate {
    /// What at most becomes of so many patches: collapsed sides and empty patches give fewer elements.
    fn planned(&self, patches: u64) -> MeshPlan {
        let n = u64::from(self.segments.get());
        let at_most = |each| Range::at_most(patches.saturating_mul(each));
        let (edges, faces, degrees) = match self.faces {
            Faces::Triangles => (3 * n * n + 2 * n, 2 * n * n, Range::exactly(3)),
            Faces::Quads => (2 * n * n + 2 * n, n * n, Range { min: 3, max: 4 }),
        };
        let mut plan = MeshPlan {
            vertices: at_most((n + 1) * (n + 1)),
            edges: at_most(edges),
            faces: at_most(faces),
            degrees,
            attributes: Vec::new(),
            has_unlisted_attributes: false,
        };
        if self.uvs {
            plan.provide(Domain::Corner, UV.name);
        }
        if self.normals {
            plan.provide(Domain::Vertex, VERTEX_NORMAL.name);
        }
        plan
    }

    /// Refuses what does not fit ids or the budget, before anything is allocated.
    fn check_budget(
        &self,
        name: &str,
        patches: &[Patch],
        scene: &Scene,
        cx: &Context,
    ) -> Result<(), OpError> {
        let counts = counts(patches, self.segments.get(), self.faces.into()).map_err(too_large)?;
        // Each corner may need an edge of its own.
        if counts.corners.saturating_mul(2) >= u64::from(u32::MAX) {
            let corners = counts.corners;
            let message = format!("\"{name}\" would have {corners} corners, more than ids");
            return Err(OpError::Parameter(message));
        }
        let meshes = scene.objects().iter().filter_map(|o| o.as_mesh());
        let present: u64 = meshes.map(|mesh| mesh.bytes() as u64).sum();
        let needed = self.planned(patches.len() as u64).bytes().max;
        if present.saturating_add(needed) > cx.budget {
            let budget = cx.budget;
            return Err(OpError::Budget(format!(
                "tessellating \"{name}\" needs up to {needed} bytes beside the {present} of the \
                 scene, but the budget is {budget}"
            )));
        }
        Ok(())
    }

    fn tessellated(&self, patches: &[Patch], cx: &Context) -> Result<(Mesh, Report), OpError> {
        let mut cut = Tessellation::default();
        let total = patches.len() as u64;
        for (done, patch) in (0..).zip(patches) {
            cx.advance("tessellate", done, total)?;
            tessellate_patch(patch, self.segments.get(), self.faces.into(), &mut cut)
                .map_err(too_large)?;
        }
        cx.advance("tessellate", total, total)?;
        let BuildOutput {
            mut mesh,
            report: built,
            half_edge_of_corner,
            ..
        } = mesh::build(
            cut.positions,
            &cut.offsets,
            &cut.indices,
            NonManifold::Split,
        )?;
        let mut report = Report::changed(mesh.n_faces());
        if !cut.empty_patches.is_empty() {
            let (n, first) = (cut.empty_patches.len(), cut.empty_patches[0]);
            report = report.note(format!(
                "patches without area, which gave nothing: {n} (first: patch {first})"
            ));
        }
        if !built.is_clean() {
            report = report.note(built.summary());
        }
        if self.uvs {
            let mut uvs = vec![DVec2::ZERO; mesh.n_half_edges()];
            for (h, &v) in half_edge_of_corner.iter().zip(&cut.indices) {
                // Corners of faces that were left out have none.
                if let Some(h) = h.some() {
                    uvs[h.index()] = cut.uvs[v as usize];
                }
            }
            mesh.set(UV, uvs);
        }
        if self.normals {
            let normals = with_copies(cut.normals, &built);
            let without = normals.iter().filter(|&&n| n == DVec3::ZERO).count();
            report = report.count("vertices where the patch has no normal", without);
            mesh.set(VERTEX_NORMAL, normals);
        }
        Ok((mesh, report))
    }
}

/// The values of vertices with those of the copies that the builder put behind them.
fn with_copies(mut values: Vec<DVec3>, built: &BuildReport) -> Vec<DVec3> {
    for (original, _) in &built.split_vertices {
        values.push(values[original.index()]);
    }
    values
}

fn too_large(error: BezierError) -> OpError {
    match error {
        BezierError::OutOfMemory(_) => OpError::Budget(error.to_string()),
        _ => OpError::Parameter(error.to_string()),
    }
}

#[cfg(test)]
mod tests;
