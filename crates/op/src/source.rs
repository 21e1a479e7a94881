//! Helpers for operations that work on a whole scene: sources, which create an object, and checks of object names.

use std::collections::HashSet;

use glam::DVec3;
use mesh::{Mesh, readable_bytes};
use scene::{Object, Scene};

use crate::plan::numbered;
use crate::{Context, MeshPlan, OpError, Plan, PlannedGeometry, Problem, Report, Vector};

/// The largest number of edges in the plan of a mesh that is built from polygons. Each edge is a side of at most two
/// polygons, so a mesh with n edges has at most 2 n corners. The builder can create a separate edge for each corner,
/// and each edge has two half-edges. It therefore creates at most 4 n half-edges. The largest possible id of a
/// half-edge is 2^32 - 2.
const MAX_EDGES: u64 = (u32::MAX as u64 - 1) / 4;

/// A mesh that a step creates. A `Source` consists of the name of the new object, the planned element counts of its
/// mesh, and the problems of the step's parameters.
///
/// An operation creates the same `Source` in its method `plan` and in its method `apply`:
///
/// ```
/// use geometry::shapes;
/// use op::{MeshPlan, Plan, Range, Source, Vector};
///
/// let counts = MeshPlan::counted(4, 6, 4, Range::exactly(3));
/// let source = || Source::new("Shape", Some("tetra"), counts.clone()).placed("radius", [2.0; 3], Vector::literal(0.0, 0.0, 1.0));
///
/// let mut plan = Plan::default();
/// assert_eq!(source().plan(&mut plan), []);
/// assert!(plan.object("tetra").is_some());
/// # let files = op::Files::default();
/// # let cx = op::Context::new(&op::NoProgress, &files);
/// # let mut scene = scene::Scene::new();
/// source().insert(&mut scene, &cx, shapes::tetrahedron)?;
/// # Ok::<(), op::OpError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Source<'a> {
    operation: &'static str,
    name: Option<&'a str>,
    counts: MeshPlan,
    scale: DVec3,
    /// The names of the parameters that determine `scale`, for error messages.
    scale_parameters: &'static str,
    center: DVec3,
    problems: Vec<Problem>,
}

impl<'a> Source<'a> {
    /// Creates a source for a new object and a mesh with these counts. If `name` is omitted, the object gets the name
    /// of the operation in lower case. If another object has that name, `.2`, `.3` or a later number is added.
    pub fn new(operation: &'static str, name: Option<&'a str>, counts: MeshPlan) -> Self {
        let source = Self {
            operation,
            name,
            counts,
            scale: DVec3::ONE,
            scale_parameters: "scale",
            center: DVec3::ZERO,
            problems: Vec::new(),
        };
        if source.counts.edges.min > MAX_EDGES {
            let message = format!(
                "the mesh would have {} edges, but at most {MAX_EDGES} are supported",
                source.counts.edges.min
            );
            return source.with(Problem::error(message));
        }
        source
    }

    /// Scales the mesh along each axis by a factor above 0, and then moves it from the origin to the point `center`.
    /// This point is the value of the operation's parameter `center`. `parameters` contains the names of the parameters
    /// that determine the scale factors, for error messages.
    #[must_use]
    pub fn placed(mut self, parameters: &'static str, scale: [f64; 3], center: Vector) -> Self {
        self.scale_parameters = parameters;
        self.scale = scale.into();
        self.center = center.get();
        self
    }

    /// Adds a problem.
    #[must_use]
    pub fn with(mut self, problem: Problem) -> Self {
        self.problems.push(problem);
        self
    }

    /// Adds the object to a plan and returns all problems.
    pub fn plan(self, plan: &mut Plan) -> Vec<Problem> {
        let name = match self.name {
            Some(name) => name.to_owned(),
            None => plan.free_name(&self.default_name()),
        };
        let mut problems = self.problems;
        problems.extend(plan.insert(&name, PlannedGeometry::Mesh(self.counts)));
        problems
    }

    /// Adds the object to a scene, after all other objects. `make` creates the mesh. It is called only if there are no
    /// problems, no other object has the name, and the memory is sufficient.
    ///
    /// # Errors
    ///
    /// Returns [`OpError::Parameter`] for the first problem, or if a coordinate overflows. Returns [`OpError::Object`]
    /// if the name is taken. Returns [`OpError::Budget`] if the mesh would exceed the memory budget of `cx` or the
    /// largest supported number of edges. Returns [`OpError::Cancelled`] if the run was canceled. If an error is
    /// returned, the scene is unchanged.
    pub fn insert(
        self,
        scene: &mut Scene,
        cx: &Context,
        make: impl FnOnce() -> Mesh,
    ) -> Result<Report, OpError> {
        let edges = self.counts.edges.min;
        let name = match self.name {
            Some(name) => name.to_owned(),
            None => free_name(scene, &self.default_name()),
        };
        if let Some(problem) = self.problems.into_iter().find(|p| !p.is_warning) {
            let path = problem.path.join(".");
            return Err(match path.as_str() {
                "" if edges > MAX_EDGES => OpError::Budget(problem.message),
                "" => OpError::Parameter(problem.message),
                _ => OpError::Parameter(format!("{path}: {}", problem.message)),
            });
        }
        check_name(scene, &name)?;
        let bytes = self.counts.bytes().min;
        if bytes > cx.budget {
            let message = format!(
                "the mesh needs {} of memory, but the memory budget is {}",
                readable_bytes(bytes),
                readable_bytes(cx.budget)
            );
            return Err(OpError::Budget(message));
        }
        cx.advance("make", 0, 1)?;
        let mut mesh = make();
        for p in mesh.positions_mut() {
            *p = *p * self.scale + self.center;
        }
        if mesh.positions().iter().any(|p| !p.is_finite()) {
            let parameters = format!("{} and center", self.scale_parameters);
            return Err(OpError::overflow(self.operation, &parameters));
        }
        let report = Report::changed(mesh.n_faces());
        cx.advance("make", 1, 1)?;
        scene
            .insert(Object::mesh(name, mesh))
            .expect("the name is free");
        Ok(report)
    }

    fn default_name(&self) -> String {
        self.operation.to_lowercase()
    }
}

/// Returns the first of the names `name`, `name.2`, `name.3` and so on that no object of the scene has.
fn free_name(scene: &Scene, name: &str) -> String {
    let taken: HashSet<&str> = scene.objects().iter().map(|o| o.name.as_str()).collect();
    let mut names = numbered(name, 1).map(|(_, name)| name);
    let free = names.find(|name| !taken.contains(name.as_str()));
    free.expect("fewer than 2^64 objects")
}

/// Checks that no object of a scene has this name.
///
/// # Errors
///
/// Returns [`OpError::Object`] if an object has this name.
pub fn check_name(scene: &Scene, name: &str) -> Result<(), OpError> {
    match scene.object(name) {
        None => Ok(()),
        Some(_) => Err(OpError::Object(
            scene::DuplicateName(name.to_owned()).to_string(),
        )),
    }
}

/// Returns the object with this name.
///
/// # Errors
///
/// Returns [`OpError::Object`] if no object has this name.
pub fn named_object<'s>(scene: &'s Scene, name: &str) -> Result<&'s Object, OpError> {
    scene
        .object(name)
        .ok_or_else(|| OpError::Object(format!("no object is named \"{name}\"")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Files, NoProgress, Range};
    use geometry::shapes;

    fn square() -> MeshPlan {
        MeshPlan::counted(4, 4, 1, Range::exactly(4))
    }

    fn insert(source: Source, scene: &mut Scene, budget: u64) -> Result<Report, OpError> {
        let files = Files::default();
        let mut cx = Context::new(&NoProgress, &files);
        cx.budget = budget;
        source.insert(scene, &cx, shapes::square)
    }

    #[test]
    fn a_taken_name_is_refused_in_plan_and_scene() {
        let mut plan = Plan::default();
        assert_eq!(
            Source::new("Shape", Some("a"), square()).plan(&mut plan),
            []
        );
        assert_eq!(
            Source::new("Shape", Some("a"), square()).plan(&mut plan)[0].path,
            ["name"]
        );

        let mut scene = Scene::new();
        insert(
            Source::new("Shape", Some("a"), square()),
            &mut scene,
            u64::MAX,
        )
        .unwrap();
        let second = insert(
            Source::new("Shape", Some("a"), square()),
            &mut scene,
            u64::MAX,
        );
        assert!(matches!(second, Err(OpError::Object(_))));
        assert_eq!(scene.objects().len(), 1);
    }

    #[test]
    fn a_mesh_that_exceeds_the_budget_or_the_ids_is_never_made() {
        let mut scene = Scene::new();
        let files = Files::default();
        let mut cx = Context::new(&NoProgress, &files);
        let huge = MeshPlan::counted(1, MAX_EDGES + 1, 1, Range::exactly(4));
        let made = Source::new("Shape", Some("a"), huge).insert(&mut scene, &cx, || unreachable!());
        assert!(matches!(made, Err(OpError::Budget(_))));

        cx.budget = square().bytes().min - 1;
        let made =
            Source::new("Shape", Some("a"), square()).insert(&mut scene, &cx, || unreachable!());
        assert!(matches!(made, Err(OpError::Budget(_))));
        assert!(
            insert(
                Source::new("Shape", Some("a"), square()),
                &mut scene,
                square().bytes().min
            )
            .is_ok()
        );
    }

    #[test]
    fn the_mesh_is_scaled_and_then_moved() {
        let mut scene = Scene::new();
        let source = Source::new("Shape", Some("a"), square()).placed(
            "size",
            [2.0, 3.0, 1.0],
            Vector::literal(1.0, 0.0, 5.0),
        );
        insert(source, &mut scene, u64::MAX).unwrap();
        let mesh = scene.object("a").unwrap().as_mesh().unwrap();
        assert_eq!(mesh.positions()[2], DVec3::new(3.0, 3.0, 5.0));
    }

    #[test]
    fn coordinates_that_overflow_are_refused() {
        let source = Source::new("Shape", Some("a"), square()).placed(
            "size",
            [f64::MAX; 3],
            Vector::literal(f64::MAX, 0.0, 0.0),
        );
        let made = insert(source, &mut Scene::new(), u64::MAX);
        assert_eq!(
            made.unwrap_err().to_string(),
            "Shape: with these values of size and center, a coordinate exceeds the largest number, 1.8e308"
        );
    }
}
