//! What the operations of all schemes have in common: the plan, the budget, and the levels.

use mesh::Mesh;
use op::{Context, MeshPlan, OpError, PlanContext, Problem, Range, Report};

use crate::forecast::Size;
use crate::meter::{Meter, Through};
use crate::{Rules, check_faces, finer, work};

/// The most levels that a step may ask for: a single triangle fills the ids before.
pub const MAX_LEVELS: u32 = 16;

/// A step of a recipe that subdivides.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// The name of the operation, for messages.
    pub name: &'static str,
    /// The scheme and its choices.
    pub rules: Rules,
    /// How often.
    pub levels: u32,
}

impl Step {
    /// Changes `plan` as [`apply`](Self::apply) will change the mesh, and returns what is wrong.
    pub fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::new();
        if self.levels == 0 {
            return problems;
        }
        if self.levels > MAX_LEVELS {
            problems.push(Problem::error(self.too_many_levels()).at(["levels"]));
        }
        let scheme = self.rules.scheme;
        if scheme.needs_triangles() {
            if plan.degrees.min > 3 && plan.faces.max > 0 {
                let message = format!(
                    "{} needs triangles, but the faces have at least {} corners",
                    self.name, plan.degrees.min
                );
                problems.push(Problem::error(message).help("cut the faces into triangles before"));
            }
            plan.degrees = Range::exactly(3);
        }
        plan.drop_normals();

        let mut levels = self.levels.min(MAX_LEVELS);
        let mut size = Size::of_plan(plan);
        if let Err(too_large) = size.check(scheme, levels, cx.budget) {
            problems.push(
                Problem::error(too_large.message())
                    .at(["levels"])
                    .help(too_large.help()),
            );
            // The plan goes on with what fits, so that later steps are not blamed for this one.
            levels = too_large.fits.unwrap_or(0);
        }
        for level in 0..levels {
            size = size.after(scheme, level);
            plan.degrees = scheme.degrees_after(plan.degrees);
        }
        plan.vertices = size.vertices;
        plan.edges = size.edges;
        plan.faces = size.faces;
        problems
    }

    /// Subdivides.
    ///
    /// # Errors
    ///
    /// Those of [`subdivide`](crate::subdivide), [`OpError::Parameter`] for too many levels, and
    /// [`OpError::Budget`] if the result would take more bytes than the context allows.
    pub fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        if self.levels > MAX_LEVELS {
            return Err(OpError::Parameter(self.too_many_levels()));
        }
        let scheme = self.rules.scheme;
        cx.advance(scheme.name(), 0, 1)?;
        if self.levels == 0 {
            return Ok(Report::default());
        }
        mesh.compact();
        check_faces(mesh, scheme)?;
        let size = Size::of(mesh);
        size.check(scheme, self.levels, cx.budget)
            .map_err(|too_large| OpError::Budget(too_large.to_string()))?;

        let through = Through(cx);
        let meter = Meter::new(&through, scheme.name(), work(size, self.rules, self.levels));
        for level in 0..self.levels {
            mesh.replace(finer(mesh, self.rules, level, &meter)?);
        }
        meter.finish()?;
        Ok(Report::changed(mesh.n_faces()))
    }

    fn too_many_levels(&self) -> String {
        let levels = self.levels;
        format!("levels must lie between 0 and {MAX_LEVELS}, not {levels}")
    }
}
