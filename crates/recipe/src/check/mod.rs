//! Checking a recipe without running it: every step is planned on what is known of the scene before it.

mod attributes;

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use op::{Files, Plan, PlanContext, Problem, Range};

use crate::expect::{OtherMesh, golden};
use crate::recipe::{Recipe, RecipeExpectation, RecipeStep};
use crate::shape::did_you_mean;
use ron_tree::{Diagnostic, Span, field_span};

use attributes::{Attributes, Before, meshes};

pub(crate) use attributes::forbidden;

/// What is known of the scene after a step.
#[derive(Clone, Debug)]
pub struct StepForecast {
    /// The step's id or operation.
    pub label: String,
    /// The vertices of all meshes together.
    pub vertices: Range,
    /// The edges.
    pub edges: Range,
    /// The faces.
    pub faces: Range,
    /// The bytes that all meshes take.
    pub bytes: Range,
}

/// What was found without running anything.
#[derive(Clone, Debug, Default)]
pub struct Forecast {
    /// What is wrong.
    pub diagnostics: Vec<Diagnostic>,
    /// What is known after each step.
    pub steps: Vec<StepForecast>,
    /// The files that the recipe writes.
    pub outputs: Vec<PathBuf>,
    /// The files that the recipe reads.
    pub inputs: Vec<PathBuf>,
}

impl Forecast {
    /// Whether the recipe cannot run.
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }

    fn add(&mut self, recipe: &Recipe, scope: usize, found: Vec<Diagnostic>) {
        let located = found.into_iter().map(|d| recipe.located(d, scope));
        self.diagnostics.extend(located);
    }
}

/// Plans every step. `budget` is how many bytes meshes may take.
pub fn check(recipe: &Recipe, files: &Files, budget: u64) -> Forecast {
    let mut forecast = Forecast::default();
    let mut plan = Plan::default();
    let mut attributes = Attributes::default();
    let mut known = Known::default();
    let mut over_budget = false;
    let mut written = HashSet::new();
    let files = recipe.files(files);
    // The expectations come in the order of their steps, those of the end last.
    let mut expectations = recipe.expectations.iter().peekable();
    for (i, step) in recipe.steps.iter().enumerate() {
        let mut found = Vec::new();
        attributes.needs(step, &plan, &mut found);
        let files_of = &files[step.scope];
        plan_step(step, &mut plan, files_of, budget, &mut written, &mut found);
        if plan.take_edited() {
            attributes.losses(step, &known.certain, &plan, &mut found);
            known = Known::default();
        }
        known.add_objects(&plan);
        // Once: later steps only make it worse.
        if known.bytes.min > budget && !over_budget {
            over_budget = true;
            if !found.iter().any(Diagnostic::is_error) {
                found.push(over(step, known.bytes.min, budget));
            }
        }
        forecast.add(recipe, step.scope, found);
        while let Some(placed) = expectations.next_if(|p| p.after == Some(i)) {
            let found = expected(placed, &plan, &attributes, &files);
            forecast.add(recipe, placed.scope, found);
        }
        forecast.steps.push(known.forecast(step, plan.incomplete));
    }
    for placed in expectations {
        let found = expected(placed, &plan, &attributes, &files);
        forecast.add(recipe, placed.scope, found);
    }
    forecast.diagnostics.sort_by_key(|d| (d.source, d.span));
    // The turns of a repetition say the same.
    forecast.diagnostics.dedup();
    forecast.outputs = plan.outputs;
    forecast.inputs = plan.inputs;
    forecast
}

fn plan_step(
    step: &RecipeStep,
    plan: &mut Plan,
    files: &Files,
    budget: u64,
    written: &mut HashSet<PathBuf>,
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
        // Must be refused when it runs, so it changes nothing and may well have problems.
        operation.plan(&mut plan.clone(), &cx);
        return;
    }
    let earlier = plan.outputs.len();
    let mut problems = operation.plan(plan, &cx);
    let new = plan.outputs.get(earlier..).unwrap_or_default();
    if problems.iter().all(|p| p.is_warning)
        && let Some(twice) = new.iter().find(|path| written.contains(*path))
    {
        let message = format!("an earlier step writes {} too", twice.display());
        problems.push(Problem::error(message));
    }
    written.extend(new.iter().cloned());
    plan.incomplete |= problems.iter().any(|p| !p.is_warning);
    for problem in &problems {
        let span = field_span(&step.value, &problem.path);
        // The whole step is shown by its name.
        let span = if span == step.value.span {
            step.span
        } else {
            span
        };
        diagnostics.push(diagnostic(problem, span));
    }
}

fn diagnostic(problem: &Problem, span: Span) -> Diagnostic {
    let made = if problem.is_warning {
        Diagnostic::warning
    } else {
        Diagnostic::error
    };
    let diagnostic = made(span, problem.message.clone());
    match &problem.help {
        Some(help) => diagnostic.with_help(help.clone()),
        None => diagnostic,
    }
}

fn over(step: &RecipeStep, bytes: u64, budget: u64) -> Diagnostic {
    let message = format!(
        "meshes take {} after this step, and the budget is {}",
        mebibytes(bytes),
        mebibytes(budget)
    );
    Diagnostic::error(step.span, message).with_help("allow more with --budget, or do less")
}

/// Bytes as text.
pub fn mebibytes(bytes: u64) -> String {
    let mebi = bytes as f64 / f64::from(1 << 20);
    if mebi < 10.0 {
        format!("{mebi:.1} MiB")
    } else {
        format!("{mebi:.0} MiB")
    }
}

/// What is wrong with an expectation at this point.
fn expected(
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
        found.extend(output(
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

/// What is wrong with a file that is to be written and held against one beside the recipe.
fn output(path: &str, beside: &str, plan: &Plan, files: &Files, span: Span) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    match files.to_write(path) {
        Err(error) => found.push(Diagnostic::error(span, error.to_string())),
        Ok(full) if !plan.incomplete && !plan.outputs.contains(&full) => {
            let below = |path: &PathBuf| path.strip_prefix(&files.output).ok().map(Path::to_owned);
            let written: Vec<PathBuf> = plan.outputs.iter().filter_map(below).collect();
            let names = written.iter().filter_map(|path| path.to_str());
            let message = format!("no step writes \"{path}\" before this is held");
            let help = did_you_mean(path, names);
            found.push(Diagnostic::error(span, message).with_help(help));
        }
        Ok(_) => {}
    }
    let ending = |path: &str| Path::new(path).extension().unwrap_or_default().to_owned();
    if !ending(path).eq_ignore_ascii_case(ending(beside)) {
        let message = format!("\"{beside}\" is no file of the kind of \"{path}\"");
        let help = "both need the same ending";
        found.push(Diagnostic::error(span, message).with_help(help));
    }
    match golden(files, beside) {
        Err(message) => found.push(Diagnostic::error(span, message)),
        Ok(full) if plan.inputs.contains(&full) => {
            let message = format!("a step reads \"{beside}\", which is to be what it makes");
            let help = "hold the output against another file: `meshwright test --update` writes it";
            found.push(Diagnostic::error(span, message).with_help(help));
        }
        Ok(full) if !files.store.exists(&full) => {
            // Not an error: then nothing could run that makes it.
            let message = format!("there is no file {}", full.display());
            let help = "run `meshwright test --update` to make it";
            found.push(Diagnostic::warning(span, message).with_help(help));
        }
        Ok(_) => {}
    }
    found
}

fn missing_file(files: &Files, path: &Path, span: Span) -> Option<Diagnostic> {
    let message = format!("there is no file {}", path.display());
    (!files.store.is_file(path)).then(|| Diagnostic::error(span, message))
}

/// What is known of all meshes of a plan together. Objects that a step adds are added to it, so that a step takes no
/// time in proportion to the objects that it leaves alone.
struct Known {
    /// How many objects are counted.
    objects: usize,
    vertices: Range,
    edges: Range,
    faces: Range,
    bytes: Range,
    certain: Before,
}

impl Default for Known {
    fn default() -> Self {
        let none = Range::exactly(0);
        Self {
            objects: 0,
            vertices: none,
            edges: none,
            faces: none,
            bytes: none,
            certain: Before::new(),
        }
    }
}

impl Known {
    fn add_objects(&mut self, plan: &Plan) {
        for (name, mesh) in meshes(&plan.objects()[self.objects..]) {
            self.vertices = self.vertices.plus(mesh.vertices);
            self.edges = self.edges.plus(mesh.edges);
            self.faces = self.faces.plus(mesh.faces);
            self.bytes = self.bytes.plus(mesh.bytes());
            let certain: Vec<_> = mesh
                .attributes
                .iter()
                .filter(|a| a.certain)
                .cloned()
                .collect();
            if !certain.is_empty() {
                self.certain.push((name.to_owned(), certain));
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
        }
    }
}
