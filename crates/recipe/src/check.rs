//! Checking a recipe without running it: every step is planned on what is known of the scene before it.

use std::path::Path;

use op::{Files, MeshPlan, Plan, PlanContext, PlannedGeometry, Problem, Range};

use crate::diagnostic::{Diagnostic, Severity, Span};
use crate::expect::Other;
use crate::read::{Recipe, RecipeStep};
use crate::syntax::{PathItem, field_span};

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
    pub outputs: Vec<std::path::PathBuf>,
    /// The files that the recipe reads.
    pub inputs: Vec<std::path::PathBuf>,
}

impl Forecast {
    /// Whether the recipe cannot run.
    pub fn has_errors(&self) -> bool {
        self.diagnostics
            .iter()
            .any(|d| d.severity == Severity::Error)
    }
}

/// Plans every step. `budget` is how many bytes meshes may take.
pub fn check(recipe: &Recipe, files: &Files, budget: u64) -> Forecast {
    let mut forecast = Forecast::default();
    let mut plan = Plan::default();
    let mut over_budget = false;
    for (i, step) in recipe.steps.iter().enumerate() {
        plan_step(step, &mut plan, files, budget, &mut forecast.diagnostics);
        let bytes = plan.bytes();
        // Once: later steps only make it worse.
        if bytes.min > budget && !over_budget {
            over_budget = true;
            let has_error = |d: &Diagnostic| d.span.is_some_and(|s| step.value.span.contains(s));
            if !forecast.diagnostics.iter().any(has_error) {
                forecast.diagnostics.push(over(step, bytes.min, budget));
            }
        }
        check_expected_names(recipe, i, &plan, &mut forecast.diagnostics);
        forecast.steps.push(totals(step, &plan));
    }
    for placed in recipe.expectations.iter().filter(|p| p.after.is_none()) {
        check_names(
            placed.on.as_deref(),
            placed.that.others(),
            placed.span,
            &plan,
            &mut forecast.diagnostics,
        );
    }
    for placed in &recipe.expectations {
        if let Some(Other::File(path)) = placed.that.others() {
            check_file(&files.to_read(path), placed.span, &mut forecast.diagnostics);
        }
    }
    forecast.diagnostics.sort_by_key(|d| d.span);
    forecast.outputs = plan.outputs;
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
        for problem in plan.check_names([name.as_str()], "on") {
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
    let (earlier, new) = plan.outputs.split_at(earlier.min(plan.outputs.len()));
    if problems.iter().all(|p| p.is_warning)
        && let Some(twice) = new.iter().find(|path| earlier.contains(path))
    {
        let message = format!("an earlier step writes {} too", twice.display());
        problems.push(Problem::error(message));
    }
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

fn check_expected_names(recipe: &Recipe, i: usize, plan: &Plan, diagnostics: &mut Vec<Diagnostic>) {
    for placed in recipe.expectations.iter().filter(|p| p.after == Some(i)) {
        check_names(
            placed.on.as_deref(),
            placed.that.others(),
            placed.span,
            plan,
            diagnostics,
        );
    }
}

fn check_names(
    on: Option<&[String]>,
    other: Option<&Other>,
    span: Span,
    plan: &Plan,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let mut names: Vec<&str> = on.unwrap_or_default().iter().map(String::as_str).collect();
    if let Some(Other::Object(name)) = other {
        names.push(name);
    }
    diagnostics.extend(
        plan.check_names(names, "on")
            .iter()
            .map(|problem| diagnostic(problem, span)),
    );
}

fn check_file(path: &Path, span: Span, diagnostics: &mut Vec<Diagnostic>) {
    if !path.is_file() {
        let message = format!("there is no file {}", path.display());
        diagnostics.push(Diagnostic::error(span, message));
    }
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
