//! The code that the operations of all subdivision schemes share: the plan (the predicted counts), the check of the
//! memory budget, and the levels.

use mesh::{CORNER_NORMAL, DVec3, Domain, EdgeId, Mesh, TANGENT, VERTEX_NORMAL, counted};
use op::{
    Context, FaceSelection, Levels, MeshPlan, OpError, PlanContext, PlannedAttribute,
    PositiveLength, Problem, Range, Refusal, Report, Select, readable,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use subdivision::{
    Count, Rules, Scheme, Size, Split, SubdivisionError, check_faces, limit, limit_distance,
    refine_faces, subdivide_within,
};

/// A condition that ends the subdivision. The step fails if the mesh does not meet the condition even after the maximum
/// number of levels.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub enum Until {
    /// Stops as soon as all edges are shorter than `below`.
    EdgeLength {
        /// The length, in scene units.
        below: PositiveLength,
    },
    /// Stops as soon as the distance of every vertex to its limit position is less than `below`. Available only for
    /// Loop and Catmull-Clark subdivision.
    LimitDistance {
        /// The distance, in scene units.
        below: PositiveLength,
    },
}

/// The parameters of a subdivision operation, for any scheme.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step<'a> {
    pub(crate) rules: Rules,
    pub(crate) levels: Option<Levels>,
    pub(crate) until: Option<Until>,
    pub(crate) to_limit: bool,
    pub(crate) faces: Option<&'a FaceSelection>,
}

impl Step<'_> {
    /// Creates the parameters for one level of the whole mesh, with default options.
    pub(crate) const fn new(rules: Rules) -> Self {
        Self {
            rules,
            levels: None,
            until: None,
            to_limit: false,
            faces: None,
        }
    }

    fn most_levels(&self) -> u32 {
        match (self.levels, self.until) {
            (Some(levels), _) => levels.get(),
            (None, Some(_)) => Levels::HIGHEST.get(),
            (None, None) => 1,
        }
    }

    fn does_nothing(&self) -> bool {
        self.most_levels() == 0 && !self.to_limit && self.until.is_none()
    }

    /// If a parameter is wrong, returns an error message and the name of the parameter.
    fn problem(&self) -> Option<(String, &'static str)> {
        if self.faces.is_some() && (self.until.is_some() || self.to_limit) {
            let message =
                "`faces` cannot be combined with `until` or `to_limit`, which need the whole mesh";
            return Some((message.to_owned(), "faces"));
        }
        let scheme = self.rules.scheme;
        let needs_limit = matches!(self.until, Some(Until::LimitDistance { .. }));
        (needs_limit && !scheme.has_limit())
            .then(|| (SubdivisionError::NoLimit(scheme).to_string(), "until"))
    }

    /// Changes `plan`, which predicts the mesh, in the same way as [`apply`](Self::apply) will change the mesh. Returns
    /// the problems that it finds. `name` is the name of the operation.
    pub(crate) fn plan(&self, name: &str, plan: &mut MeshPlan, cx: &PlanContext) -> Vec<Problem> {
        let mut problems = Vec::new();
        if let Some((message, field)) = self.problem() {
            problems.push(Problem::error(message).at([field]));
        }
        let mut levels = self.most_levels();
        if self.does_nothing() {
            return problems;
        }
        let scheme = self.rules.scheme;
        if scheme.needs_triangles() {
            if plan.degrees.min > 3 && plan.faces.max > 0 {
                let message = format!(
                    "{name} needs triangles, but every face has at least {} corners",
                    plan.degrees.min
                );
                problems.push(Problem::error(message).help(help_for_polygons(scheme)));
            }
            plan.degrees = Range::exactly(3);
        }
        plan.drop_normals();

        if let Some(faces) = self.faces
            && faces.count(plan).max == 0
        {
            return problems;
        }
        let start = planned_size(plan);
        let is_certain = self.until.is_none() && self.faces.is_none();
        if is_certain && let Err(too_large) = start.check(scheme, 0..levels, cx.budget) {
            problems.push(
                Problem::error(too_large.to_string())
                    .at(["levels"])
                    .help(too_large.help()),
            );
            // The plan continues with the largest possible number of levels within the memory budget. Otherwise, later
            // steps would report the same problem again.
            levels = too_large.fits.unwrap_or(0);
        }
        let end = (0..levels).fold(start, |size, level| size.after(scheme, level));
        let degrees = (0..levels).fold(plan.degrees, |n, _| degrees_after(scheme, n));
        let change = |count: &mut Range, end: Range| {
            *count = if is_certain { end } else { count.or(end) };
        };
        change(&mut plan.vertices, end.vertices.0);
        change(&mut plan.edges, end.edges.0);
        change(&mut plan.faces, end.faces.0);
        if self.faces.is_some() && !scheme.needs_triangles() {
            // A face beside a refined face gets additional corners at the new vertices on their common edge.
            plan.degrees.min = plan.degrees.min.min(4);
            plan.degrees.max = plan.degrees.max.saturating_mul(1 << levels);
        } else {
            change(&mut plan.degrees, degrees);
        }
        if self.to_limit {
            provide_limit(plan);
        }
        problems
    }

    /// Subdivides the mesh.
    pub(crate) fn apply(&self, mesh: &mut Mesh, cx: &mut Context) -> Result<Report, OpError> {
        if let Some((message, _)) = self.problem() {
            return Err(OpError::Parameter(message));
        }
        let (scheme, levels) = (self.rules.scheme, self.most_levels());
        cx.advance(scheme.name(), 0, 1)?;
        if self.does_nothing() {
            return Ok(Report::default());
        }
        mesh.compact();
        check_faces(mesh, scheme).map_err(to_op_error)?;
        if let Some(faces) = self.faces {
            let chosen = faces.mask(mesh, cx)?;
            let (budget, progress) = (cx.budget, cx.progress());
            let finer = refine_faces(mesh, &chosen, self.rules, levels, budget, progress);
            let n = mesh.n_faces();
            mesh.replace(finer.map_err(to_op_error)?);
            return Ok(Report::changed(mesh.n_faces().abs_diff(n)));
        }
        let mut notes = loss_notes(mesh, scheme);
        match self.until {
            Some(until) => notes.insert(0, self.levels_until(mesh, until, cx)?),
            None if levels > 0 => {
                let finer = subdivide_within(mesh, self.rules, 0..levels, cx.budget, cx.progress());
                mesh.replace(finer.map_err(|error| match error {
                    SubdivisionError::TooLarge(size) => {
                        OpError::Budget(format!("{size}; {}", size.help()))
                    }
                    other => to_op_error(other),
                })?);
            }
            None => {}
        }
        let mut report = Report::changed(mesh.n_faces());
        report.notes = notes;
        if self.to_limit {
            push_to_limit(mesh, self.rules, cx)?;
        }
        Ok(report)
    }

    /// Subdivides the mesh until the condition is met. Returns a note with the number of levels.
    fn levels_until(&self, mesh: &mut Mesh, until: Until, cx: &Context) -> Result<String, OpError> {
        let levels = self.most_levels();
        for level in 0.. {
            let (measure, value, below) = match until {
                Until::EdgeLength { below } => {
                    ("the longest edge", longest_edge(mesh), below.get())
                }
                Until::LimitDistance { below } => {
                    let distance = limit_distance(mesh, self.rules, cx.progress());
                    let measure = "the largest distance to the limit surface";
                    (measure, distance.map_err(to_op_error)?, below.get())
                }
            };
            if value < below {
                let levels = counted(level, "level");
                return Ok(format!("{levels}; {measure} is {}", readable(value)));
            }
            let state = format!(
                "after subdivision level {level}, {measure} is {}, expected less than {}",
                readable(value),
                readable(below)
            );
            if level == levels {
                return Err(OpError::Budget(format!(
                    "{state}; raise `below` or `levels`"
                )));
            }
            let one = level..level + 1;
            let finer = subdivide_within(mesh, self.rules, one, cx.budget, cx.progress());
            mesh.replace(finer.map_err(|error| match error {
                SubdivisionError::TooLarge(size) => {
                    let help = match size.bytes {
                        Some(_) => "raise `below` or the memory budget (`--budget`)",
                        None => "raise `below`",
                    };
                    OpError::Budget(format!("{state}; {size}; {help}"))
                }
                other => to_op_error(other),
            })?);
        }
        unreachable!("the last level returns")
    }
}

/// Returns advice for a mesh with faces that are not triangles. `scheme` is a scheme that needs triangles.
fn help_for_polygons(scheme: Scheme) -> &'static str {
    match scheme {
        Scheme::Midpoint(_) => "write `into: Quads`, or triangulate the faces first",
        _ => "triangulate the faces first, with Triangulate",
    }
}

/// Converts an error of the crate `subdivision` to an error of the step.
fn to_op_error(error: SubdivisionError) -> OpError {
    let message = error.to_string();
    match error {
        SubdivisionError::Cancelled(_) => OpError::Cancelled,
        SubdivisionError::TooLarge(_) => OpError::Budget(message),
        SubdivisionError::NotTriangle { face, scheme, .. } => {
            let message = format!("{message}; {}", help_for_polygons(scheme));
            OpError::refused(Refusal::NotTriangle, message).about([face])
        }
        SubdivisionError::TooFar { vertex, .. } => {
            OpError::refused(Refusal::BadNumber, message).about([vertex])
        }
        SubdivisionError::WholeMesh(_)
        | SubdivisionError::FlagCount { .. }
        | SubdivisionError::NoLimit(_) => OpError::Parameter(message),
    }
}

/// The smallest and the largest possible number of elements. This type implements the arithmetic that [`Size`] needs.
#[derive(Clone, Copy)]
struct Planned(Range);

impl Count for Planned {
    fn plus(self, other: Self) -> Self {
        Self(self.0.plus(other.0))
    }

    fn minus(self, other: Self) -> Self {
        Self(self.0.minus(other.0))
    }

    fn times(self, n: u64) -> Self {
        Self(self.0.by(n))
    }

    fn least(self) -> u64 {
        self.0.min
    }
}

/// Returns the size of a planned mesh. Each attribute counts as 16 bytes for each element.
fn planned_size(plan: &MeshPlan) -> Size<Planned> {
    let attributes = Domain::ALL.map(|domain| {
        let columns = plan.attributes.iter().filter(|a| a.domain == domain);
        16 * columns.count() as u64
    });
    Size {
        vertices: Planned(plan.vertices),
        edges: Planned(plan.edges),
        faces: Planned(plan.faces),
        corners: Planned(plan.corners_of(plan.faces)),
        isolated: Planned(plan.vertices.or_less()),
        inner_of_valence_2: Planned(plan.vertices.or_less()),
        attributes,
    }
}

/// Returns the smallest and the largest possible number of corners of a face after one level. `degrees` contains these
/// two numbers before the level.
fn degrees_after(scheme: Scheme, degrees: Range) -> Range {
    match scheme {
        Scheme::CatmullClark | Scheme::Midpoint(Split::Quads) => Range::exactly(4),
        // The new face at an old vertex has one corner for each edge of the vertex. A vertex can have any number of
        // edges.
        Scheme::DooSabin => Range::between(3, u64::MAX),
        _ => degrees,
    }
}

/// Returns notes about attribute values that a level mixes or loses, because the scheme creates faces that lie across
/// old edges.
fn loss_notes(mesh: &Mesh, scheme: Scheme) -> Vec<String> {
    let mut notes = Vec::new();
    if matches!(scheme, Scheme::Sqrt3 | Scheme::DooSabin) {
        let seams = mesh.edges().filter(|&e| mesh.is_seam(e)).count();
        if seams > 0 {
            let edges = if seams == 1 {
                "edge: new faces across it"
            } else {
                "edges: new faces across them"
            };
            notes.push(format!(
                "{seams} seam {edges} mix corner values of both sides, which distorts textures"
            ));
        }
    }
    let columns = mesh.attributes().of(Domain::Edge);
    if scheme == Scheme::Sqrt3 && !columns.is_empty() {
        let names: Vec<&str> = columns.iter().map(|c| c.name.as_str()).collect();
        let names = names.join(", ");
        notes.push(format!(
            "inner edges lose the values of their attributes ({names}), because the sqrt(3) scheme flips every inner edge"
        ));
    }
    notes
}

/// Returns the length of the longest edge. The mesh must be dense, that is, have no gaps left by removed elements.
fn longest_edge(mesh: &Mesh) -> f64 {
    let squared = |e: usize| {
        let [a, b] = mesh.edge_vertices(EdgeId::new(e));
        mesh.position(a).distance_squared(mesh.position(b))
    };
    mesh::parallel::fold(mesh.n_edges(), 0.0, squared, f64::max).sqrt()
}

/// Moves the vertices to the limit surface and stores its normals and tangents.
fn push_to_limit(mesh: &mut Mesh, rules: Rules, cx: &Context) -> Result<(), OpError> {
    let limit_surface = limit(mesh, rules, cx.progress()).map_err(to_op_error)?;
    let normals = limit_surface.normals();
    let tangent = |[along, _]: &[DVec3; 2]| along.normalize_or_zero();
    let tangents = limit_surface.tangents.iter().map(tangent).collect();
    mesh.positions_mut()
        .copy_from_slice(&limit_surface.positions);
    mesh.remove_normals();
    match limit_surface.corner_normals {
        Some(normals) => mesh.set(CORNER_NORMAL, normals),
        None => mesh.set(VERTEX_NORMAL, normals),
    }
    mesh.set(TANGENT, tangents);
    Ok(())
}

/// Adds the attributes of the limit surface to the plan. If no inner edge is sharp, the step stores the normals as
/// vertex normals, and otherwise as corner normals.
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

#[cfg(test)]
mod tests;
