//! What the operations of all schemes have in common: the plan, the budget, and the levels.

use mesh::{CORNER_NORMAL, DVec3, Domain, EdgeId, Mesh, TANGENT, VERTEX_NORMAL};
use op::{
    Context, FaceSelection, MeshPlan, OpError, PlanContext, PlannedAttribute, Problem, Range,
    Report, Select,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::forecast::{Size, TooLarge};
use crate::local::refine_within;
use crate::meter::{Meter, Through};
use crate::{Rules, Scheme, check_faces, finer, limit};

/// The most levels that a step may ask for: a single triangle fills the ids before.
pub const MAX_LEVELS: u32 = 16;

/// When to stop, instead of after a number of levels.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Until {
    /// As soon as all edges are shorter than this.
    EdgeLength {
        /// In scene units.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        below: f64,
    },
    /// As soon as every vertex is nearer than this to the point of the limit surface that it goes to: for
    /// Loop and Catmull-Clark.
    LimitDistance {
        /// In scene units.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        below: f64,
    },
}

/// A step of a recipe that subdivides.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// The name of the operation, for messages.
    pub name: &'static str,
    /// The scheme and its choices.
    pub rules: Rules,
    /// How often: 1 if nothing is said. With [`until`](Self::until) the most levels that are allowed,
    /// [`MAX_LEVELS`] if nothing is said.
    pub levels: Option<u32>,
    /// When to stop.
    pub until: Option<Until>,
    /// Whether vertices are pushed to the limit surface in the end.
    pub to_limit: bool,
    /// Which faces are refined, if not all, with all that they become.
    pub faces: Option<&'a FaceSelection>,
}

impl Step<'_> {
    /// One level.
    pub const fn new(name: &'static str, rules: Rules) -> Self {
        Self {
            name,
            rules,
            levels: None,
            until: None,
            to_limit: false,
            faces: None,
        }
    }

    fn most_levels(&self) -> u32 {
        let otherwise = if self.until.is_some() { MAX_LEVELS } else { 1 };
        self.levels.unwrap_or(otherwise)
    }

    fn does_nothing(&self) -> bool {
        self.most_levels() == 0 && !self.to_limit && self.until.is_none()
    }

    /// What is wrong with the parameters, and which.
    fn problem(&self) -> Option<(String, &'static str)> {
        let levels = self.most_levels();
        if levels > MAX_LEVELS {
            let message = format!("levels must lie between 0 and {MAX_LEVELS}, not {levels}");
            return Some((message, "levels"));
        }
        if self.faces.is_some() && (self.until.is_some() || self.to_limit) {
            let message =
                "`until` and `to_limit` are for the whole mesh, not for some of its faces";
            return Some((message.to_owned(), "faces"));
        }
        let no_limit = !limit::has_limit(self.rules.scheme);
        match self.until {
            Some(Until::EdgeLength { below } | Until::LimitDistance { below })
                if !(below > 0.0 && below.is_finite()) =>
            {
                let message = format!("a length must be a number above 0, not {below}");
                Some((message, "until"))
            }
            Some(Until::LimitDistance { .. }) if no_limit => {
                let message = format!("the limit of {} is not known", self.rules.scheme.name());
                Some((message, "until"))
            }
            _ => None,
        }
    }

    /// Changes `plan` as [`apply`](Self::apply) will change the mesh, and returns what is wrong.
    pub fn plan(&self, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::new();
        if let Some((message, field)) = self.problem() {
            problems.push(Problem::error(message).at([field]));
        }
        let mut levels = self.most_levels().min(MAX_LEVELS);
        if self.does_nothing() {
            return problems;
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
        plan.drop_attribute(Domain::Vertex, TANGENT.name);

        let start = Size::of_plan(plan);
        if let Some(faces) = self.faces {
            self.plan_some(faces, plan, start, levels);
            return problems;
        }
        if let (Err(too_large), None) = (start.check(scheme, 0..levels, cx.budget), self.until) {
            problems.push(
                Problem::error(too_large.message())
                    .at(["levels"])
                    .help(too_large.help()),
            );
            // The plan goes on with what fits, so that later steps are not blamed for this one.
            levels = too_large.fits.unwrap_or(0);
        }
        let mut size = start;
        for level in 0..levels {
            size = size.after(scheme, level);
            let finer = scheme.degrees_after(plan.degrees);
            plan.degrees = if self.until.is_some() {
                plan.degrees.or(finer)
            } else {
                finer
            };
        }
        if self.until.is_some() {
            size = start.or(size);
        }
        plan.vertices = size.vertices;
        plan.edges = size.edges;
        plan.faces = size.faces;
        if self.to_limit {
            provide_limit(plan);
        }
        problems
    }

    /// Plans the refinement of some faces: between nothing and the whole mesh.
    fn plan_some(&self, faces: &FaceSelection, plan: &mut MeshPlan, start: Size, levels: u32) {
        if faces.count(plan).max == 0 {
            return;
        }
        let scheme = self.rules.scheme;
        let whole = (0..levels).fold(start, |size, level| size.after(scheme, level));
        let size = start.or(whole);
        plan.vertices = size.vertices;
        plan.edges = size.edges;
        plan.faces = size.faces;
        if !scheme.needs_triangles() {
            // Faces beside get corners on their sides.
            plan.degrees = Range {
                min: plan.degrees.min.min(4),
                max: plan.degrees.max.saturating_mul(1 << levels),
            };
        }
    }

    /// Subdivides.
    ///
    /// # Errors
    ///
    /// Those of [`subdivide`](crate::subdivide), [`OpError::Parameter`] for parameters out of their range,
    /// and [`OpError::Budget`] if the result would take more bytes than the context allows, or the
    /// condition is not met after the levels that are allowed.
    pub fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        if let Some((message, _)) = self.problem() {
            return Err(OpError::Parameter(message));
        }
        let (scheme, levels) = (self.rules.scheme, self.most_levels());
        cx.advance(scheme.name(), 0, 1)?;
        if self.does_nothing() {
            return Ok(Report::default());
        }
        mesh.compact();
        check_faces(mesh, scheme)?;
        if let Some(faces) = self.faces {
            let chosen = faces.mask(mesh, cx)?;
            let finer = refine_within(mesh, &chosen, self.rules, levels, cx.budget, &Through(cx))?;
            let n = mesh.n_faces();
            mesh.replace(finer);
            return Ok(Report::changed(mesh.n_faces().abs_diff(n)));
        }
        let torn = torn(mesh, scheme);
        let mut report = match self.until {
            None => self.all_levels(mesh, levels, cx)?,
            Some(until) => self.levels_until(mesh, until, levels, cx)?,
        };
        report.notes.extend(torn);
        if self.to_limit {
            push_to_limit(mesh, self.rules, cx)?;
        }
        Ok(report)
    }

    fn all_levels(&self, mesh: &mut Mesh, levels: u32, cx: &Context) -> Result<Report, OpError> {
        let size = Size::of(mesh);
        let scheme = self.rules.scheme;
        size.check(scheme, 0..levels, cx.budget).map_err(budget)?;
        let through = Through(cx);
        let meter = Meter::new(&through, scheme.name(), size.work(scheme, 0..levels));
        for level in 0..levels {
            mesh.replace(finer(mesh, self.rules, level, &meter)?);
        }
        meter.finish()?;
        Ok(Report::changed(mesh.n_faces()))
    }

    fn levels_until(
        &self,
        mesh: &mut Mesh,
        until: Until,
        levels: u32,
        cx: &Context,
    ) -> Result<Report, OpError> {
        let through = Through(cx);
        let scheme = self.rules.scheme;
        for level in 0..=levels {
            let (size, one) = (Size::of(mesh), level..level + 1);
            let work = size.work(scheme, one.clone());
            let meter = Meter::new(&through, scheme.name(), work);
            let (what, now, below) = match until {
                Until::EdgeLength { below } => ("an edge is", longest_edge(mesh), below),
                Until::LimitDistance { below } => {
                    let distance = limit::distance(mesh, self.rules, &meter)?;
                    ("a vertex is away from its limit by", distance, below)
                }
            };
            if now < below {
                let mut report = Report::changed(mesh.n_faces());
                report
                    .notes
                    .push(format!("{level} levels; {what} {now:.3} at most"));
                return Ok(report);
            }
            if level == levels {
                let message = format!("after level {level} {what} still {now}, not below {below}");
                return Err(OpError::Budget(message));
            }
            size.check(scheme, one, cx.budget).map_err(|too_large| {
                let message = format!("after level {level} {what} still {now}");
                OpError::Budget(format!(
                    "{message}, and the next is too large: {}",
                    too_large.message()
                ))
            })?;
            mesh.replace(finer(mesh, self.rules, level, &meter)?);
        }
        unreachable!("the last level returns")
    }
}

/// What schemes cannot keep whose faces lie across old edges.
fn torn(mesh: &Mesh, scheme: Scheme) -> Vec<String> {
    let mut lines = Vec::new();
    if matches!(scheme, Scheme::Sqrt3 | Scheme::DooSabin) {
        let seams = mesh.edges().filter(|&e| mesh.is_seam(e)).count();
        if seams > 0 {
            lines.push(format!(
                "{seams} seams of corner values are torn: new faces lie across them"
            ));
        }
    }
    let columns = mesh.attributes().of(Domain::Edge);
    if scheme == Scheme::Sqrt3 && !columns.is_empty() {
        let names: Vec<&str> = columns.iter().map(|c| c.name.as_str()).collect();
        let names = names.join(", ");
        lines.push(format!(
            "edges inside lose their values ({names}): every one is turned"
        ));
    }
    lines
}

fn budget(too_large: TooLarge) -> OpError {
    OpError::Budget(too_large.to_string())
}

/// The length of the longest edge of a dense mesh.
fn longest_edge(mesh: &Mesh) -> f64 {
    let squared = |e: usize| {
        let [a, b] = mesh.edge_vertices(EdgeId::new(e));
        mesh.position(a).distance_squared(mesh.position(b))
    };
    mesh::blocks::fold(mesh.n_edges(), 0.0, squared, f64::max).sqrt()
}

/// Moves the vertices to the limit surface and gives them its normals and tangents.
fn push_to_limit(mesh: &mut Mesh, rules: Rules, cx: &Context) -> Result<(), OpError> {
    let found = limit(mesh, rules, &Through(cx))?;
    let normals = found.normals();
    let tangent = |[along, _]: &[DVec3; 2]| along.normalize_or_zero();
    let tangents = found.tangents.iter().map(tangent).collect();
    mesh.positions_mut().copy_from_slice(&found.positions);
    mesh.remove_normals();
    match found.corner_normals {
        Some(normals) => mesh.set(CORNER_NORMAL, normals),
        None => mesh.set(VERTEX_NORMAL, normals),
    }
    mesh.set(TANGENT, tangents);
    Ok(())
}

/// Where nothing is sharp the normals are on vertices, else on corners.
fn provide_limit(plan: &mut MeshPlan) {
    for (domain, name) in [
        (Domain::Vertex, VERTEX_NORMAL.name),
        (Domain::Corner, CORNER_NORMAL.name),
    ] {
        plan.attributes.push(PlannedAttribute {
            domain,
            name: name.to_owned(),
            certain: false,
        });
    }
    plan.provide(Domain::Vertex, TANGENT.name);
}
