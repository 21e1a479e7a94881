//! Tessellate: turns Bezier patches into a mesh.
//!
//! ```text
//!    .-----.-----.            .--.--.--.--.
//!   /             \           | /| /| /| /|       every patch is divided into
//!  .   a  patch    .   -->    .--.--.--.--.       segments x segments cells
//!   \             /           | /| /| /| /|
//!    '-----'-----'            '--'--'--'--'
//! ```
//!
//! The module `tessellate` of the crate `bezier` documents the order of vertices, the division of cells,
//! and the handling of collapsed sides.

use std::sync::Arc;

use bezier::{BezierError, Patch, Tessellation, counts, tessellate_patch};
use mesh::{BuildOutput, BuildReport, DVec2, DVec3, Domain, NonManifold, UV, VERTEX_NORMAL};
use op::prelude::*;
use op::{Operation, TargetKind, target_names};
use scene::Geometry;

/// Turns Bezier patches into a mesh.
///
/// The step acts on the objects that its parameter `on` lists. Without `on`, the step acts on all objects that consist
/// of Bezier patches. Each object becomes one mesh of the same name. Every patch is divided into `segments` x
/// `segments` cells. Vertices, edges and faces of earlier patches have lower ids. Different patches share no vertices.
/// If two patches have the same control points on a common side, their vertices on this side have exactly equal
/// positions. `Weld(distance: 0)` then joins the patches. If all points of a side coincide, as at the pole of a
/// teapot's lid, the side becomes one vertex. Patches without area give no faces. The report counts the patches without
/// area. The mesh has UVs only with `uvs: true`, and normals only with `normals: true`.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Tessellate {
    /// The number of cells along each side of a patch.
    #[serde(default = "eight")]
    pub segments: Count<1, 4096>,
    /// Whether each cell becomes triangles or quads.
    #[serde(default)]
    pub faces: Faces,
    /// Whether to store the patch parameters (u, v) of each vertex as UVs of the face corners at this vertex.
    ///
    /// The UVs of different patches overlap, because each patch covers the whole square from 0 to 1.
    #[serde(default)]
    pub uvs: bool,
    /// Whether to store the exact unit normals of the patches as vertex normals.
    #[serde(default)]
    pub normals: bool,
}

/// Whether each cell of a patch becomes triangles or a quad.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Faces {
    /// Two triangles, divided by the diagonal from the corner with the lowest u and v to the opposite corner.
    #[default]
    Triangles,
    /// One quad. A cell at a collapsed side of the patch (a side whose points coincide) becomes one triangle.
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

const TARGET: TargetKind = TargetKind {
    operation: "Tessellate",
    does: "cuts patches",
    none: "no patches to cut",
    help: "load a .bez file in an earlier step",
};

impl Operation for Tessellate {
    const NAME: &'static str = "Tessellate";
    const SUMMARY: &'static str = "Turn Bezier patches into a mesh";
    const EXAMPLE: &'static str = "Tessellate(segments: 3)";
    const WORDS: &'static [&'static str] = &["patches", "mesh"];
    const TAKES_ON: bool = true;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        TARGET.plan(plan, cx, |geometry| {
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
            let (geometry, _) = scene.parts_mut(name).expect("the object was chosen above");
            let Geometry::Patches(patches) = geometry else {
                let message = TARGET.wrong_kind_message(name, geometry.kind());
                return Err(OpError::Object(message));
            };
            let patches = std::mem::take(patches);
            self.check_budget(name, &patches, scene, cx)?;
            let (mesh, mesh_report) = self.tessellated(&patches, cx)?;
            report.merge(mesh_report);
            let (geometry, _) = scene.parts_mut(name).expect("the object was chosen above");
            *geometry = Geometry::Mesh(Arc::new(mesh));
        }
        Ok(report)
    }
}

impl Tessellate {
    /// Returns the plan of the mesh: the element counts and the attributes, as predicted before the run. `patches` is
    /// the number of patches. The counts are upper limits, because collapsed sides and zero-area patches give fewer
    /// elements.
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
            materials: None,
        };
        if self.uvs {
            plan.provide(Domain::Corner, UV.name);
        }
        if self.normals {
            plan.provide(Domain::Vertex, VERTEX_NORMAL.name);
        }
        plan
    }

    /// Checks that there are enough ids for the elements, and that the mesh fits into the memory budget. This check
    /// runs before memory is allocated.
    fn check_budget(
        &self,
        name: &str,
        patches: &[Patch],
        scene: &Scene,
        cx: &Context,
    ) -> Result<(), OpError> {
        let counts = counts(patches, self.segments.get(), self.faces.into()).map_err(too_large)?;
        // Each corner can need a separate edge, and each edge has two half-edges. The number of corners is therefore
        // limited to half the number of half-edge ids.
        let max = (u32::MAX - 1) / 2;
        if counts.corners > u64::from(max) {
            let corners = counts.corners;
            let message = format!(
                "\"{name}\" would have {corners} face corners, but a mesh can have at most {max}"
            );
            return Err(OpError::Parameter(message));
        }
        let meshes = scene.objects().iter().filter_map(|o| o.as_mesh());
        let present: u64 = meshes.map(|mesh| mesh.bytes() as u64).sum();
        let needed = self.planned(patches.len() as u64).bytes().max;
        if present.saturating_add(needed) > cx.budget {
            return Err(OpError::Budget(format!(
                "tessellating \"{name}\" needs up to {} in addition to the {} of the scene, which exceeds the memory \
                 budget of {}",
                op::readable_bytes(needed),
                op::readable_bytes(present),
                op::readable_bytes(cx.budget)
            )));
        }
        Ok(())
    }

    fn tessellated(&self, patches: &[Patch], cx: &Context) -> Result<(Mesh, Report), OpError> {
        let mut tessellation = Tessellation::default();
        let total = patches.len() as u64;
        for (done, patch) in (0..).zip(patches) {
            cx.advance("tessellate", done, total)?;
            let (segments, faces) = (self.segments.get(), self.faces.into());
            tessellate_patch(patch, segments, faces, &mut tessellation).map_err(too_large)?;
        }
        cx.advance("tessellate", total, total)?;
        let BuildOutput {
            mut mesh,
            report: build_report,
            half_edge_of_corner,
            ..
        } = mesh::build(
            tessellation.positions,
            &tessellation.offsets,
            &tessellation.indices,
            NonManifold::Split,
        )?;
        let mut report = Report::changed(mesh.n_faces());
        if let [first, ..] = tessellation.empty_patches[..] {
            let n = tessellation.empty_patches.len();
            report = report.note(format!(
                "zero-area patches, which give no faces: {n} (the first is patch {first})"
            ));
        }
        if !build_report.is_clean() {
            report = report.note(build_report.summary());
        }
        if self.uvs {
            let mut uvs = vec![DVec2::ZERO; mesh.n_half_edges()];
            for (h, &v) in half_edge_of_corner.iter().zip(&tessellation.indices) {
                // Corners of dropped faces have no half-edge.
                if let Some(h) = h.some() {
                    uvs[h.index()] = tessellation.uvs[v as usize];
                }
            }
            mesh.set(UV, uvs);
        }
        if self.normals {
            let normals = with_copies(tessellation.normals, &build_report);
            let n_without = normals.iter().filter(|&&n| n == DVec3::ZERO).count();
            report = report.count("vertices where the patch has no normal", n_without);
            mesh.set(VERTEX_NORMAL, normals);
        }
        Ok((mesh, report))
    }
}

/// When the mesh was built, some vertices were copied. Returns `values` with one more value for each copy: the value of
/// the original vertex.
fn with_copies(mut values: Vec<DVec3>, report: &BuildReport) -> Vec<DVec3> {
    for (original, _) in &report.split_vertices {
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
