//! Checks a recipe without running it: plans each step, starting from the predicted state of the scene before that
//! step.

mod attributes;
mod selections;

use std::path::{Path, PathBuf};

use op::{Files, Loss, Plan, PlanContext, Problem, Range, readable_bytes};
use scene::Scene;

use crate::expect::{OtherMesh, golden};
use crate::recipe::{Recipe, RecipeExpectation, RecipeStep};
use crate::schema_check::did_you_mean;
use ron_tree::{Diagnostic, Span, field_span};

use attributes::{Attributes, KnownAttributes, may_fail, meshes};

use selections::missing_elements;

#[cfg(test)]
pub(crate) use attributes::VISITED;
pub(crate) use attributes::forbidden;

/// The predicted state of the scene after a step.
#[derive(Clone, Debug)]
pub struct StepForecast {
    /// The label of the step.
    pub label: String,
    /// The number of vertices of all meshes together.
    pub vertices: Range,
    /// The number of edges of all meshes together.
    pub edges: Range,
    /// The number of faces of all meshes together.
    pub faces: Range,
    /// The memory that all meshes take, in bytes.
    pub bytes: Range,
    /// The data that the step will certainly lose.
    pub losses: Vec<Loss>,
    /// The data that the step possibly loses. Losses that depend on the values of points and attributes are not listed.
    /// For example, coincident vertices or numbers that are not finite can cause losses.
    pub possible_losses: Vec<Loss>,
    /// This step and the steps before it read the first `n_inputs` files of [`Forecast::inputs`].
    pub n_inputs: usize,
    /// This step and the steps before it write the first `n_outputs` files of [`Forecast::outputs`].
    pub n_outputs: usize,
}

/// The result of checking a recipe without running it.
#[derive(Clone, Debug, Default)]
pub struct Forecast {
    /// The errors and warnings.
    pub diagnostics: Vec<Diagnostic>,
    /// The forecast after each step.
    pub steps: Vec<StepForecast>,
    /// The files that the recipe writes.
    pub outputs: Vec<PathBuf>,
    /// The files that the recipe reads.
    pub inputs: Vec<PathBuf>,
}

impl Forecast {
    /// Whether there are errors that prevent the recipe from running.
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }

    fn add(&mut self, recipe: &Recipe, scope: usize, found: Vec<Diagnostic>) {
        let located = found.into_iter().map(|d| recipe.located(d, scope));
        self.diagnostics.extend(located);
    }
}

/// Checks a recipe that was read. Plans every step, and returns the forecast. `budget` is the memory budget for meshes,
/// in bytes.
pub fn check(recipe: &Recipe, files: &Files, budget: u64) -> Forecast {
    check_from(recipe, &Scene::new(), files, budget)
}

/// Like [`check`], but for a run that starts with `scene` instead of an empty scene.
pub fn check_from(recipe: &Recipe, scene: &Scene, files: &Files, budget: u64) -> Forecast {
    let mut forecast = Forecast::default();
    let mut plan = Plan::of(scene);
    let mut attributes = Attributes::default();
    let mut totals = Totals::default();
    let mut over_budget = false;
    let files = recipe.files(files);
    // Expectations are in the order of their steps. Expectations for the end of the recipe come last.
    let mut expectations = recipe.expectations.iter().peekable();
    for (i, step) in recipe.steps.iter().enumerate() {
        let mut found = Vec::new();
        attributes.needs(step, &plan, &mut found);
        missing_elements(step, &plan, &mut found);
        let files_of = &files[step.scope];
        plan_step(step, &mut plan, files_of, budget, &mut found);
        let mut losses = std::mem::take(&mut plan.losses);
        let mut possible = std::mem::take(&mut plan.possible_losses);
        if plan.take_edited() {
            attributes.losses(step, &totals.attributes, &plan, &mut losses, &mut possible);
            totals = Totals::default();
        }
        let is_forbidden = |loss: &&Loss| !step.on_loss.allows(&loss.name);
        found.extend(
            losses
                .iter()
                .filter(is_forbidden)
                .map(|loss| forbidden(step, loss)),
        );
        if !found.iter().any(Diagnostic::is_error) {
            let loss = possible.iter().filter(is_forbidden);
            found.extend(loss.map(|loss| may_fail(step, loss)));
        }
        totals.add_objects(&plan);
        // Only the first step that exceeds the budget is reported.
        if totals.bytes.min > budget && !over_budget {
            over_budget = true;
            if !found.iter().any(Diagnostic::is_error) {
                found.push(exceeds_budget(step, totals.bytes.min, budget));
            }
        }
        forecast.add(recipe, step.scope, found);
        while let Some(placed) = expectations.next_if(|p| p.after == Some(i)) {
            let found = check_expectation(placed, &plan, &attributes, &files);
            forecast.add(recipe, placed.scope, found);
        }
        let mut step = totals.forecast(step, plan.incomplete);
        step.losses = losses;
        step.possible_losses = possible;
        step.n_inputs = plan.inputs.len();
        step.n_outputs = plan.outputs().len();
        forecast.steps.push(step);
    }
    for placed in expectations {
        let found = check_expectation(placed, &plan, &attributes, &files);
        forecast.add(recipe, placed.scope, found);
    }
    forecast.diagnostics.sort_by_key(|d| (d.source, d.span));
    // Each repetition of a step can give the same diagnostic, so duplicates are removed.
    forecast.diagnostics.dedup();
    forecast.outputs = plan.outputs().iter().cloned().collect();
    forecast.inputs = plan.inputs;
    forecast
}

fn plan_step(
    step: &RecipeStep,
    plan: &mut Plan,
    files: &Files,
    budget: u64,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let Some(operation) = &step.step else {
        plan.incomplete = true;
        return;
    };
    let on = step.on_names();
    let mut unknown = false;
    for (name, span) in step.on.iter().flatten() {
        if let Some(problem) = plan.missing(name, ["on"]) {
            diagnostics.push(diagnostic(&problem, *span));
            unknown = true;
        }
    }
    if unknown {
        plan.incomplete = true;
        return;
    }
    let cx = PlanContext {
        files,
        on: on.as_deref(),
        budget,
    };
    if step.refused.is_some() {
        // The recipe expects the operation to refuse its input. A refused step changes nothing, so its plan is
        // discarded, and the problems of the plan are not reported.
        operation.plan(&mut plan.clone(), &cx);
        return;
    }
    let problems = operation.plan(plan, &cx);
    plan.incomplete |= problems.iter().any(|p| !p.is_warning);
    for problem in &problems {
        let span = field_span(&step.value, &problem.path);
        // A problem with the whole step is shown at the name of the operation.
        let span = if span == step.value.span {
            step.span
        } else {
            span
        };
        diagnostics.push(diagnostic(problem, span));
    }
}

fn diagnostic(problem: &Problem, span: Span) -> Diagnostic {
    let create = if problem.is_warning {
        Diagnostic::warning
    } else {
        Diagnostic::error
    };
    let diagnostic = create(span, problem.message.clone());
    match &problem.help {
        Some(help) => diagnostic.with_help(help.clone()),
        None => diagnostic,
    }
}

fn exceeds_budget(step: &RecipeStep, bytes: u64, budget: u64) -> Diagnostic {
    let message = format!(
        "the meshes take {} after this step, more than the memory budget of {}",
        readable_bytes(bytes),
        readable_bytes(budget)
    );
    Diagnostic::error(step.span, message).with_help("raise the budget with --budget")
}

/// Returns the errors and warnings for an expectation at this point of the recipe.
fn check_expectation(
    placed: &RecipeExpectation,
    plan: &Plan,
    attributes: &Attributes,
    files: &[Files],
) -> Vec<Diagnostic> {
    let on = placed.on.as_deref().unwrap_or_default();
    let mut names: Vec<&str> = on.iter().map(String::as_str).collect();
    let mut found = Vec::new();
    match placed.that.other_mesh() {
        Some(OtherMesh::Object(name)) => names.push(name),
        Some(OtherMesh::File(path)) => {
            let path = files[placed.scope].to_read(path);
            found.extend(missing_file(&files[placed.scope], &path, placed.span));
        }
        None => {}
    }
    if let Some((path, golden)) = placed.that.output() {
        found.extend(check_output(
            path,
            golden,
            plan,
            &files[placed.scope],
            placed.span,
        ));
    }
    let missing = names
        .into_iter()
        .filter_map(|name| plan.missing(name, ["on"]));
    found.extend(missing.map(|p| diagnostic(&p, placed.span)));
    attributes.expected(placed, plan, &mut found);
    found
}

/// Returns the errors and warnings for an `Output` expectation. `path` is the written file, and `beside` is the
/// reference file.
fn check_output(
    path: &str,
    beside: &str,
    plan: &Plan,
    files: &Files,
    span: Span,
) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    match files.to_write(path) {
        Err(error) => found.push(Diagnostic::error(span, error.to_string())),
        Ok(full) if !plan.incomplete && !plan.outputs().contains(&full) => {
            let below = |path: &PathBuf| path.strip_prefix(&files.output).ok().map(Path::to_owned);
            let written: Vec<PathBuf> = plan.outputs().iter().filter_map(below).collect();
            let names = written.iter().filter_map(|path| path.to_str());
            let message = format!("no step writes \"{path}\" before this expectation is checked");
            let help = did_you_mean(path, names);
            found.push(Diagnostic::error(span, message).with_help(help));
        }
        Ok(_) => {}
    }
    let extension = |path: &str| Path::new(path).extension().unwrap_or_default().to_owned();
    if !extension(path).eq_ignore_ascii_case(extension(beside)) {
        let message = format!("\"{beside}\" and \"{path}\" are files of different formats");
        let help = "both files must have the same extension";
        found.push(Diagnostic::error(span, message).with_help(help));
    }
    match golden(files, beside) {
        Err(violation) => found.push(Diagnostic::error(span, violation.message)),
        Ok(full) if plan.inputs.contains(&full) => {
            let message =
                format!("a step reads \"{beside}\", so it cannot be used as the reference file");
            let help = "use a different file: `meshwright test --update` creates it";
            found.push(Diagnostic::error(span, message).with_help(help));
        }
        Ok(full) if !files.store.exists(&full) => {
            // A missing reference file is not an error, because `meshwright test --update` runs the recipe to create
            // the file.
            let message = format!("the file {} does not exist", full.display());
            let help = "run `meshwright test --update` to create it";
            found.push(Diagnostic::warning(span, message).with_help(help));
        }
        Ok(_) => {}
    }
    found
}

fn missing_file(files: &Files, path: &Path, span: Span) -> Option<Diagnostic> {
    let message = format!("the file {} does not exist", path.display());
    (!files.store.is_file(path)).then(|| Diagnostic::error(span, message))
}

/// The element counts and the memory of all meshes of a plan, added up. If a step only adds objects, only the new
/// objects are counted, so that unchanged objects cost no time.
struct Totals {
    /// The number of objects that have been counted.
    objects: usize,
    vertices: Range,
    edges: Range,
    faces: Range,
    bytes: Range,
    attributes: KnownAttributes,
}

impl Default for Totals {
    fn default() -> Self {
        let none = Range::exactly(0);
        Self {
            objects: 0,
            vertices: none,
            edges: none,
            faces: none,
            bytes: none,
            attributes: KnownAttributes::new(),
        }
    }
}

impl Totals {
    fn add_objects(&mut self, plan: &Plan) {
        for (name, mesh) in meshes(&plan.objects()[self.objects..]) {
            self.vertices = self.vertices.plus(mesh.vertices);
            self.edges = self.edges.plus(mesh.edges);
            self.faces = self.faces.plus(mesh.faces);
            self.bytes = self.bytes.plus(mesh.bytes());
            if !mesh.attributes.is_empty() {
                (self.attributes).push((name.to_owned(), mesh.attributes.clone()));
            }
        }
        self.objects = plan.objects().len();
    }

    fn forecast(&self, step: &RecipeStep, is_incomplete: bool) -> StepForecast {
        let unknown = if is_incomplete {
            Range::ANY
        } else {
            Range::exactly(0)
        };
        StepForecast {
            label: step.label().to_owned(),
            vertices: self.vertices.plus(unknown),
            edges: self.edges.plus(unknown),
            faces: self.faces.plus(unknown),
            bytes: self.bytes,
            losses: Vec::new(),
            possible_losses: Vec::new(),
            n_inputs: 0,
            n_outputs: 0,
        }
    }
}
