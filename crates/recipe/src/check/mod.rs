//! Checking a recipe without running it: every step is planned on what is known of the scene before it.

mod attributes;

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use op::{Files, MeshPlan, Plan, PlanContext, PlannedGeometry, Problem, Range};

use crate::expect::{Other, golden};
use crate::recipe::{Placed, Recipe, RecipeStep};
use crate::shape::did_you_mean;
use ron_tree::{Diagnostic, PathItem, Severity, Span, field_span};

use attributes::Attributes;

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
        self.diagnostics
            .iter()
            .any(|d| d.severity == Severity::Error)
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
    let mut over_budget = false;
    let mut written = HashSet::new();
    let files = recipe.files(files);
    // The expectations come in the order of their steps, those of the end last.
    let mut expectations = recipe.expectations.iter().peekable();
    for (i, step) in recipe.steps.iter().enumerate() {
        let mut found = Vec::new();
        attributes.needs(step, &plan, &mut found);
        let before = attributes::certain(&plan);
        let files_of = &files[step.scope];
        plan_step(step, &mut plan, files_of, budget, &mut written, &mut found);
        attributes.losses(step, &before, &plan, &mut found);
        let bytes = plan.bytes();
        // Once: later steps only make it worse.
        if bytes.min > budget && !over_budget {
            over_budget = true;
            if !found.iter().any(|d| d.severity == Severity::Error) {
                found.push(over(step, bytes.min, budget));
            }
        }
        forecast.add(recipe, step.scope, found);
        while let Some(placed) = expectations.next_if(|p| p.after == Some(i)) {
            let found = expected(placed, &plan, &attributes, &files);
            forecast.add(recipe, placed.scope, found);
        }
        forecast.steps.push(totals(step, &plan));
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
        let path: Vec<PathItem> = problem
            .path
            .iter()
            .map(|item| {
                item.parse::<usize>()
                    .map_or_else(|_| item.as_str().into(), PathItem::Index)
            })
            .collect();
        let span = if path.is_empty() {
            step.span
        } else {
            field_span(&step.value, &path)
        };
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
    placed: &Placed,
    plan: &Plan,
    attributes: &Attributes,
    files: &[Files],
) -> Vec<Diagnostic> {
    let on = placed.on.as_deref().unwrap_or_default();
    let mut names: Vec<&str> = on.iter().map(String::as_str).collect();
    let mut found = Vec::new();
    match placed.that.others() {
        Some(Other::Object(name)) => names.push(name),
        Some(Other::File(path)) => {
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

fn totals(step: &RecipeStep, plan: &Plan) -> StepForecast {
    let meshes = || {
        plan.objects.iter().filter_map(|o| match &o.geometry {
            PlannedGeometry::Mesh(mesh) => Some(mesh),
            _ => None,
        })
    };
    let sum = |count: fn(&MeshPlan) -> Range| {
        let known = meshes().map(count).fold(Range::exactly(0), Range::plus);
        if plan.incomplete {
            Range {
                max: u64::MAX,
                ..known
            }
        } else {
            known
        }
    };
    StepForecast {
        label: step.label().to_owned(),
        vertices: sum(|m| m.vertices),
        edges: sum(|m| m.edges),
        faces: sum(|m| m.faces),
        bytes: plan.bytes(),
    }
}
