//! `meshwright check`: checks a recipe, and forecasts the element counts and the memory after each step.

use engine::Engine;
use mesh::counted;
use op::Range;
use op::readable_bytes;
use serde_json::json;

use super::run::report_errors;
use crate::args::{CheckArgs, Format};
use crate::loading::load;
use crate::output::{
    explain, group_digits, header_row, print, print_diagnostics, print_json, table,
};

pub(crate) fn run(args: &CheckArgs, engine: &Engine) -> anyhow::Result<bool> {
    let loaded = load(&args.recipe, engine)?;
    let json = args.recipe.format == Format::Json;
    if args.explain && !json {
        print(&explain(&loaded.recipe))?;
    }
    if loaded.has_errors() {
        return report_errors(&loaded, json);
    }
    let steps = &loaded.forecast.steps;
    if json {
        let range = |r: Range| json!({ "min": r.min, "max": (r.max < u64::MAX).then_some(r.max) });
        let forecast = steps.iter().map(|s| {
            json!({
                "step": s.label, "vertices": range(s.vertices), "edges": range(s.edges),
                "faces": range(s.faces), "bytes": range(s.bytes), "losses": engine::json::losses(&s.losses),
                "possible_losses": engine::json::losses(&s.possible_losses),
            })
        });
        print_json(&json!({
            "recipe": loaded.path, "succeeded": true, "forecast": forecast.collect::<Vec<_>>(),
            "warnings": engine::json::problems(&loaded.diagnostics, &loaded.recipe.sources),
        }))?;
        return Ok(true);
    }
    print_diagnostics(&loaded, &loaded.diagnostics);
    let mut rows = vec![header_row(["step", "vertices", "edges", "faces", "memory"])];
    for (i, step) in steps.iter().enumerate() {
        let mut row = vec![format!("{:>2} {}", i + 1, step.label)];
        row.extend([step.vertices, step.edges, step.faces].map(|r| range(r, group_digits)));
        row.push(range(step.bytes, readable_bytes));
        rows.push(row);
    }
    print(&table(&rows))?;
    for step in steps {
        for loss in &step.losses {
            print(&format!("{}: {loss}\n", step.label))?;
        }
        for loss in &step.possible_losses {
            print(&format!("{}: {}\n", step.label, loss.possible_message()))?;
        }
    }
    let n = loaded.recipe.expectations.len();
    print(&format!(
        "{} is valid: {}, {}\n",
        loaded.path,
        counted(steps.len(), "step"),
        counted(n, "expectation")
    ))?;
    Ok(true)
}

fn range(range: Range, show: impl Fn(u64) -> String) -> String {
    match (range.is_exact(), range.max) {
        (true, n) => show(n),
        (_, u64::MAX) if range.min == 0 => "?".to_owned(),
        (_, u64::MAX) => format!("{} or more", show(range.min)),
        (_, max) if range.min == 0 => format!("up to {}", show(max)),
        (_, max) => format!("{} to {}", show(range.min), show(max)),
    }
}
