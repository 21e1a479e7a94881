//! Tests every operation, with every sample of its parameters (module `samples`), on every test scene (module
//! `fixtures`).

use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use mesh::{Mesh, Values};
use op::{
    Context, Entry, Files, MeshPlan, NoProgress, OpError, Plan, PlanContext, PlannedGeometry,
    Progress, Range, Report, Step,
};
use scene::{Geometry, Object, Scene};

use crate::samples::samples;
use crate::threads::POOLS;
use crate::{assert_none, fixtures};

/// An operation with its parameters and the scene on which it is tested.
pub(crate) struct Case {
    /// The name of the case, for example `Weld(distance: 0) on cube`.
    pub(crate) name: String,
    operation: &'static str,
    pub(crate) step: Box<dyn Step>,
    pub(crate) scene: Scene,
}

/// The result of a step: the scene and a report, or an error.
type StepResult = Result<(Scene, Report), OpError>;

impl Case {
    pub(crate) fn all() -> Vec<Self> {
        let scenes = fixtures::scenes();
        let registry = ops_all::registry();
        samples(&registry)
            .into_iter()
            .flat_map(|(entry, sample)| {
                let case = |(name, scene)| Self::new(entry, sample, name, scene);
                scenes.iter().map(|(name, scene)| (*name, scene)).map(case)
            })
            .collect()
    }

    pub(crate) fn new(entry: &Entry, sample: &str, fixture: &str, scene: &Scene) -> Self {
        Self {
            name: format!("{}{sample} on {fixture}", entry.name),
            operation: entry.name,
            step: entry
                .deserialize(&ron_tree::parse(sample).value)
                .expect("a different test checks that samples can be read"),
            scene: scene.clone(),
        }
    }

    /// Runs the step and writes its outputs to the given folder.
    pub(crate) fn run(
        &self,
        output: &Path,
        progress: &dyn Progress,
    ) -> (Scene, Result<Report, OpError>) {
        self.run_on(self.scene.clone(), output, progress)
    }

    /// Like [`run`](Self::run), but on another scene.
    pub(crate) fn run_on(
        &self,
        mut scene: Scene,
        output: &Path,
        progress: &dyn Progress,
    ) -> (Scene, Result<Report, OpError>) {
        let files = files(output);
        let mut cx = Context::new(progress, &files);
        cx.stream = "sample";
        let result = self.step.apply(&mut scene, &mut cx);
        (scene, result)
    }

    fn result(&self) -> StepResult {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let (scene, result) = self.run(folder.path(), &NoProgress);
        result.map(|report| (scene, report))
    }
}

/// Returns the file settings. The input files are the models of the recipes in `scenes/`.
pub(crate) fn files(output: &Path) -> Files {
    Files {
        input: crate::root().join("scenes/assets"),
        output: output.to_owned(),
        ..Files::default()
    }
}

#[test]
fn results_are_valid_and_finite_and_nothing_panics() {
    let mut failures = Vec::new();
    for case in Case::all() {
        match catch_unwind(AssertUnwindSafe(|| case.result())) {
            Err(_) => failures.push(format!("{}: panicked", case.name)),
            Ok(Err(_)) => {}
            Ok(Ok((scene, _))) => failures.extend(
                scene
                    .objects()
                    .iter()
                    .flat_map(defects)
                    .map(|defect| format!("{}: {defect}", case.name)),
            ),
        }
    }
    assert_none(&failures);
}

/// Describes the defects of an object.
pub(crate) fn defects(object: &Object) -> Vec<String> {
    let mut found = Vec::new();
    match &object.geometry {
        Geometry::Mesh(mesh) => {
            found.extend(mesh.defects().iter().take(3).map(ToString::to_string));
            if !mesh.is_dense() {
                found.push("the mesh has dead elements".to_owned());
            }
            for (domain, column) in mesh.attributes().iter() {
                if !is_finite(&column.values) {
                    found.push(format!("{domain} attribute {} is not finite", column.name));
                }
            }
        }
        Geometry::Patches(patches) => {
            if !patches
                .iter()
                .all(|p| p.points().as_flattened().iter().all(|p| p.is_finite()))
            {
                found.push("a control point is not finite".to_owned());
            }
        }
        Geometry::Curve(curve) => {
            if !curve.points().iter().all(|p| p.is_finite()) {
                found.push("a control point is not finite".to_owned());
            }
        }
        Geometry::Polylines(lines) => {
            if !lines.as_slice().concat().iter().all(|p| p.is_finite()) {
                found.push("a point is not finite".to_owned());
            }
        }
    }
    found
}

fn is_finite(values: &Values) -> bool {
    match values {
        Values::Float(v) => v.iter().all(|x| x.is_finite()),
        Values::Vec2(v) => v.iter().all(|x| x.is_finite()),
        Values::Vec3(v) => v.iter().all(|x| x.is_finite()),
        Values::Vec4(v) => v.iter().all(|x| x.is_finite()),
        Values::Int(_) | Values::Tag(_) => true,
    }
}

#[test]
fn results_and_refusals_are_the_same_twice_and_for_any_number_of_threads() {
    let mut failures = Vec::new();
    for case in Case::all() {
        let first = summary(&case.result());
        if summary(&case.result()) != first {
            failures.push(format!("{}: the second run differs", case.name));
        }
        for pool in &*POOLS {
            let n = pool.current_num_threads();
            let again = pool.install(|| summary(&case.result()));
            if again != first {
                failures.push(format!(
                    "{}: {n} threads: {again}, first run: {first}",
                    case.name
                ));
            }
        }
    }
    assert_none(&failures);
}

/// Returns the part of a result that must be equal in all runs. The messages of file errors are left out, because they
/// contain names of temporary folders, which differ between runs.
fn summary(result: &StepResult) -> String {
    match result {
        Ok((scene, report)) => format!("{} {report:?}", scene.digest()),
        Err(OpError::File(_)) => "a file error".to_owned(),
        Err(error) => format!("{error:?}"),
    }
}

#[test]
fn results_are_as_planned() {
    let mut failures = Vec::new();
    for case in Case::all() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let files = files(folder.path());
        let cx = PlanContext::new(&files);
        let mut plan = exact_plan(&case.scene);
        let problems = case.step.plan(&mut plan, &cx);
        if problems.iter().any(|p| !p.is_warning) {
            continue;
        }
        if let Ok((scene, _)) = case.result() {
            let differences = differences(&scene, &plan);
            failures.extend(differences.iter().map(|d| format!("{}: {d}", case.name)));
        }
    }
    assert_none(&failures);
}

#[test]
fn planning_never_panics_even_for_incomplete_plans() {
    let mut failures = Vec::new();
    for case in Case::all() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let files = files(folder.path());
        let cx = PlanContext::new(&files);
        // A plan is incomplete if an earlier step could not be read or planned.
        for incomplete in [false, true] {
            let mut plan = exact_plan(&case.scene);
            plan.incomplete = incomplete;
            let planned = catch_unwind(AssertUnwindSafe(|| case.step.plan(&mut plan, &cx)));
            if planned.is_err() {
                let name = &case.name;
                failures.push(format!("{name}: panicked, incomplete: {incomplete}"));
            }
        }
    }
    assert_none(&failures);
}

/// Returns a plan (a prediction of element counts) that describes an existing scene. All counts in this plan are exact.
pub(crate) fn exact_plan(scene: &Scene) -> Plan {
    let exactly = |n: usize| Range::exactly(n as u64);
    let planned = |object: &Object| match &object.geometry {
        Geometry::Mesh(mesh) => PlannedGeometry::Mesh(MeshPlan::of(mesh)),
        Geometry::Patches(patches) => PlannedGeometry::Patches(exactly(patches.len())),
        Geometry::Curve(curve) => PlannedGeometry::Curve(exactly(curve.points().len())),
        Geometry::Polylines(_) => PlannedGeometry::Polylines,
    };
    let mut plan = Plan::default();
    for object in scene.objects() {
        assert_eq!(plan.insert(&object.name, planned(object)), None);
    }
    plan
}

/// Describes the differences between a scene and the plan that predicted it.
fn differences(scene: &Scene, plan: &Plan) -> Vec<String> {
    let found: Vec<_> = scene
        .objects()
        .iter()
        .map(|o| (o.name.as_str(), o.geometry.kind()))
        .collect();
    let planned: Vec<_> = plan
        .objects()
        .iter()
        .map(|o| (o.name.as_str(), o.geometry.kind()))
        .collect();
    // An incomplete plan contains only some of the objects.
    let is_known = |object: &&(&str, &str)| !plan.incomplete || planned.contains(object);
    let known: Vec<_> = found.iter().filter(is_known).copied().collect();
    if known != planned {
        return vec![format!("planned {planned:?}, found {found:?}")];
    }
    let mut differences = Vec::new();
    for planned in plan.objects() {
        let object = scene.object(&planned.name).expect("the names are the same");
        let name = &object.name;
        match (&object.geometry, &planned.geometry) {
            (Geometry::Mesh(mesh), PlannedGeometry::Mesh(plan)) => {
                let found = mesh_differences(mesh, plan);
                differences.extend(found.iter().map(|d| format!("{name}: {d}")));
            }
            (Geometry::Patches(patches), PlannedGeometry::Patches(n)) => {
                differences.extend(outside_range(*n, patches.len(), "patches"));
            }
            (Geometry::Curve(curve), PlannedGeometry::Curve(n)) => {
                differences.extend(outside_range(*n, curve.points().len(), "control points"));
            }
            _ => {}
        }
    }
    differences
}

fn mesh_differences(mesh: &Mesh, plan: &MeshPlan) -> Vec<String> {
    let mut differences = Vec::new();
    differences.extend(outside_range(plan.vertices, mesh.n_vertices(), "vertices"));
    differences.extend(outside_range(plan.edges, mesh.n_edges(), "edges"));
    differences.extend(outside_range(plan.faces, mesh.n_faces(), "faces"));
    let degrees: BTreeSet<usize> = mesh.faces().map(|f| mesh.degree(f)).collect();
    for degree in degrees {
        differences.extend(outside_range(plan.degrees, degree, "corners of a face"));
    }
    let attributes = mesh.attributes();
    for a in &plan.attributes {
        if a.certain && attributes.column(a.domain, &a.name).is_none() {
            let (domain, name) = (a.domain, &a.name);
            differences.push(format!("the {domain} attribute {name} is missing"));
        }
    }
    for (domain, column) in attributes.iter() {
        let is_planned = |a: &op::PlannedAttribute| a.domain == domain && a.name == column.name;
        if !plan.has_unlisted_attributes && !plan.attributes.iter().any(is_planned) {
            differences.push(format!(
                "the {domain} attribute {} was not planned",
                column.name
            ));
        }
    }
    differences
}

fn outside_range(planned: Range, found: usize, what: &str) -> Option<String> {
    let Range { min, max } = planned;
    (!planned.contains(found as u64))
        .then(|| format!("planned {min} to {max} {what}, found {found}"))
}

#[test]
fn every_operation_changes_something() {
    let mut unchanged: BTreeSet<&str> = ops_all::registry()
        .entries()
        .iter()
        .map(|e| e.name)
        .collect();
    for case in Case::all() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let (scene, result) = case.run(folder.path(), &NoProgress);
        let mut written = folder.path().read_dir().expect("the folder exists");
        let changes = scene.digest() != case.scene.digest() || written.next().is_some();
        if result.is_ok() && changes {
            unchanged.remove(case.operation);
        }
    }
    assert!(
        unchanged.is_empty(),
        "these operations change no fixture with any sample: {unchanged:?}"
    );
}
