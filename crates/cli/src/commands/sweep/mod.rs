//! `meshwright sweep`: runs one recipe with many parameter values and tabulates the results.
//!
//! The documentation of [`recipe::read_sweep`] describes the format of the sweep file. A cell is a run with one
//! combination of parameter values, and has a row in the table. The row consists of the number of the cell, the values
//! of the varying parameters, and the measured values that `keep` lists. If the run failed, the row also has the error.
//! `--out FILE.csv` writes the table. `--out FILE.json` and `--format json` write one JSON object:
//!
//! ```text
//! {
//!   "sweep": "levels.sweep.ron", "recipe": "cow.ron",
//!   "succeeded": true,                  no cell failed, Ctrl-C was not pressed
//!   "set": {"smooth": true},            values shared by all cells
//!   "parameters": ["levels"],           the varying parameters
//!   "keep": ["Faces", "Area"],
//!   "sheet": "levels.png",              the image of --sheet, or null
//!   "cells": [{
//!     "cell": 1,
//!     "parameters": {"levels": 0},
//!     "measures": {"Faces": 6, "Area": 6.0},    null if the cell failed; infinite numbers are null
//!     "outputs": ["kept/1/cow.glb"],    with --keep-outputs
//!     "error": null
//!   }]
//! }
//! ```

mod cell;
mod sheet;

use std::path::Path;

use anyhow::ensure;
use engine::Engine;
use mesh::counted;
use recipe::{
    Diagnostic, Grid, Measured, Metric, OtherMesh, Setting, Severity, Source, Sweep, read_sweep,
};
use scene::Scene;
use serde_json::{Value as Json, json};

use crate::args::{Format, SweepArgs, ValueArgs};
use crate::cache;
use crate::commands::picture::write_png;
use crate::commands::run::report_errors;
use crate::file_kind::{FileKind, expect_kind};
use crate::listener::catch_interrupts;
use crate::loading::load_text;
use crate::many::{CHECKED_AHEAD, csv_line, run_in_order};
use crate::output::{
    escape_control, number, print, print_diagnostics_in, print_error, print_json, table,
    write_atomically,
};
use cell::{CellResult, Cells};
use engine::Loaded;
use sheet::{Sheet, kept_bytes};

pub(crate) fn run(args: &SweepArgs, engine: &Engine) -> anyhow::Result<bool> {
    if let Some(path) = &args.out {
        let ending = path.extension().and_then(|e| e.to_str());
        ensure!(
            matches!(ending, Some("csv" | "json")),
            "{}: expected a table with the extension .csv or .json",
            path.display()
        );
    }
    let Some(plan) = Plan::read(args, engine)? else {
        return Ok(false);
    };
    catch_interrupts();
    // Times are meaningful only if every step runs, so the cache is not used if times are recorded.
    let is_timed = |(metric, _): &(Metric, recipe::Span)| matches!(metric, Metric::Seconds);
    let cache = if plan.sweep.keep.iter().any(is_timed) {
        None
    } else {
        cache::open(&args.cache)?
    };
    let sheet = Sheet::new(args, &plan)?;
    let collect =
        (sheet.as_ref()).map(|sheet| |scene: Scene, bytes: u64| sheet.collect(scene, bytes));
    let cells = Cells {
        args,
        cache: cache.as_ref(),
        engine,
        source: &plan.recipe,
        sweep: &plan.source.text,
        grid: &plan.grid,
        keep: &plan.sweep.keep,
        expects: plan.sweep.expects,
        collect: collect.as_ref().map(|collect| collect as _),
    };
    let mut limits = args.many.limits();
    if sheet.is_some() {
        limits.budget -= kept_bytes(limits.budget);
    }
    let count = plan.grid.cells.len();
    let mut results = Vec::with_capacity(count);
    for first in (0..count).step_by(CHECKED_AHEAD) {
        let tasks = cells.check(first..count.min(first + CHECKED_AHEAD))?;
        let (bytes, run) = (|i: usize| tasks[i].bytes(), |i: usize| cells.run(&tasks[i]));
        run_in_order(tasks.len(), limits, bytes, run, |_, end| {
            results.push(CellResult::of(end.and_then(|result| result)));
        })?;
    }
    // If the sheet of pictures cannot be drawn, the table of results is still written.
    let sheet_is_written = match &sheet {
        None => true,
        Some(sheet) => write_sheet(sheet, &plan, &cells, &results).unwrap_or_else(|error| {
            print_error(&format!("error: {error:#}\n"));
            false
        }),
    };
    Ok(finish(args, &plan, &results)? && sheet_is_written)
}

/// Draws and writes the sheet. Returns whether the scenes of all successful runs are drawn on the sheet.
fn write_sheet(
    sheet: &Sheet,
    plan: &Plan,
    cells: &Cells,
    results: &[CellResult],
) -> anyhow::Result<bool> {
    let drawn = sheet.draw(plan, cells, results)?;
    for note in &drawn.notes {
        print_error(&format!("note: {note}\n"));
    }
    for (i, error) in &drawn.errors {
        print_error(&format!(
            "error: cell {} cannot be drawn: {}\n",
            i + 1,
            escape_control(error)
        ));
    }
    let is_human = cells.args.format == Format::Human;
    write_png(&drawn.image, sheet.path(), is_human)?;
    Ok(drawn.errors.is_empty())
}

/// A valid sweep.
struct Plan {
    sweep: Sweep,
    /// The text of the sweep.
    source: Source,
    /// The text of the recipe.
    recipe: Source,
    /// The recipe as loaded with the default values of all parameters.
    loaded: Loaded,
    grid: Grid,
}

impl Plan {
    /// Reads the sweep file and its recipe, and checks that the sweep fits the recipe. If there are errors, prints them
    /// and returns `None`.
    fn read(args: &SweepArgs, engine: &Engine) -> anyhow::Result<Option<Self>> {
        expect_kind(&args.sweep, FileKind::Sweep)?;
        let source = Source::open(&args.sweep)?;
        let reading = read_sweep(&source.text);
        let mut diagnostics = reading.diagnostics;
        let mut plan = None;
        if let Some(sweep) = reading.sweep {
            let path = source.folder().join(&sweep.recipe);
            if path.is_file() {
                let recipe = Source::open(&path)?;
                let out = args.keep_outputs.as_deref().unwrap_or(Path::new("out"));
                let loaded = load_text(
                    &recipe,
                    &ValueArgs::default(),
                    out,
                    args.many.checking(),
                    engine,
                )?;
                if !loaded.is_read {
                    print_diagnostics_in(&[source], &diagnostics);
                    return report_errors(&loaded, args.format == Format::Json).map(|_| None);
                }
                check_files(&sweep, &loaded, &mut diagnostics);
                match sweep.grid(loaded.recipe.parameters(), source.folder()) {
                    Ok(grid) => plan = Some((sweep, recipe, loaded, grid)),
                    Err(wrong) => diagnostics.extend(wrong),
                }
            } else {
                let message = format!("the file {} does not exist", path.display());
                diagnostics.push(Diagnostic::error(sweep.recipe_span, message));
            }
        }
        diagnostics.sort_by_key(|d| d.span);
        print_diagnostics_in(std::slice::from_ref(&source), &diagnostics);
        let is_error = |d: &&Diagnostic| d.severity == Severity::Error;
        let n = diagnostics.iter().filter(is_error).count();
        match plan {
            Some((sweep, recipe, loaded, grid)) if n == 0 => Ok(Some(Self {
                sweep,
                source,
                recipe,
                loaded,
                grid,
            })),
            _ => {
                print_error(&format!("{}, so no run was started\n", counted(n, "error")));
                Ok(None)
            }
        }
    }

    /// Returns the entries of `keep`, as written in the sweep.
    fn names(&self) -> Vec<String> {
        let keep = self.sweep.keep.iter();
        let words = keep.map(|(_, span)| span.of(&self.source.text).split_whitespace());
        words
            .map(|words| words.collect::<Vec<_>>().join(" "))
            .collect()
    }
}

/// Some measured values that `keep` lists, such as `DistanceTo`, compare a scene with a mesh file. Checks that these
/// mesh files exist.
fn check_files(sweep: &Sweep, loaded: &Loaded, diagnostics: &mut Vec<Diagnostic>) {
    for (metric, span) in &sweep.keep {
        if let Some(OtherMesh::File(path)) = Metric::other(metric) {
            let path = loaded.files.to_read(path);
            if !path.is_file() {
                let message = format!("the file {} does not exist", path.display());
                diagnostics.push(Diagnostic::error(*span, message));
            }
        }
    }
}

/// Prints and writes the results of the sweep. Returns whether every run succeeded.
fn finish(args: &SweepArgs, plan: &Plan, results: &[CellResult]) -> anyhow::Result<bool> {
    let failed = results.iter().filter(|r| r.error.is_some()).count();
    let not_run = results.iter().filter(|r| r.is_not_run).count();
    let succeeded = failed == 0 && not_run == 0;
    let rows = rows(plan, results);
    let is_json = |path: &Path| path.extension().is_some_and(|e| e == "json");
    if let Some(path) = &args.out {
        let text: String = if is_json(path) {
            format!("{:#}\n", object(args, plan, results, succeeded))
        } else {
            rows.iter().map(|row| csv_line(row)).collect()
        };
        write_atomically(path, text.as_bytes())?;
    }
    if args.format == Format::Json {
        print_json(&object(args, plan, results, succeeded))?;
        return Ok(succeeded);
    }
    print(&table(&on_a_terminal(rows)))?;
    for (i, result) in results.iter().enumerate() {
        if let Some(error) = &result.error {
            print_error(&format!(
                "error: cell {}: {}\n",
                i + 1,
                escape_control(error)
            ));
        }
    }
    let mut summary = counted(results.len(), "cell");
    if failed > 0 {
        summary += &format!(", {failed} failed");
    }
    if not_run > 0 {
        summary += &format!(", {not_run} not run: interrupted");
    }
    let unchecked = plan.loaded.recipe.expectations.len();
    if unchecked > 0 && !plan.sweep.expects {
        let expectations = counted(unchecked, "expectation");
        summary += &format!(
            "; the sweep did not check {expectations} of the recipe: to check expectations, write `expect: true` in the sweep file"
        );
    }
    print(&format!("{summary}\n"))?;
    Ok(succeeded)
}

/// Returns the rows of the table, with its header.
fn rows(plan: &Plan, results: &[CellResult]) -> Vec<Vec<String>> {
    let mut heads = vec!["cell".to_owned()];
    heads.extend(plan.grid.parameters.iter().cloned());
    let names = plan.names();
    heads.extend(names.iter().cloned());
    heads.push("error".to_owned());
    let mut rows = vec![heads];
    for (i, (cell, result)) in plan.grid.cells.iter().zip(results).enumerate() {
        let mut row = vec![(i + 1).to_string()];
        row.extend(cell.iter().map(plain));
        match &result.measures {
            Some(measures) => row.extend(measures.iter().map(ToString::to_string)),
            None => row.extend(names.iter().map(|_| String::new())),
        }
        row.push(match &result.error {
            Some(error) => error.clone(),
            None if result.is_not_run => "not run".to_owned(),
            None => String::new(),
        });
        rows.push(row);
    }
    rows
}

/// Formats the value of a parameter for a table. The quotes around strings are left out.
fn plain(setting: &Setting) -> String {
    match setting.json() {
        Json::String(text) => text,
        _ => setting.value.to_string(),
    }
}

/// Shortens a long decimal number to six significant digits. In all other strings, escapes control characters for the
/// terminal.
fn short(text: &str) -> String {
    match text.parse::<f64>() {
        Ok(x) if text.contains('.') => number(x),
        _ => escape_control(text).into_owned(),
    }
}

/// Shortens the entries of the table, so that the table fits a terminal better. Numbers get fewer digits. Errors are
/// replaced by a short mark, because all errors are printed in full below the table.
fn on_a_terminal(rows: Vec<Vec<String>>) -> Vec<Vec<String>> {
    rows.into_iter()
        .map(|mut row| {
            let error = row.pop().unwrap_or_default();
            let mut row: Vec<String> = row.iter().map(|text| short(text)).collect();
            if error != "error" && !error.is_empty() {
                let is_not_run = error == "not run";
                row.push(if is_not_run { error } else { "FAILED".into() });
            }
            row
        })
        .collect()
}

fn object(args: &SweepArgs, plan: &Plan, results: &[CellResult], succeeded: bool) -> Json {
    let named = |names: &[String], values: &mut dyn Iterator<Item = Json>| -> Json {
        names.iter().cloned().zip(values).collect()
    };
    let grid = &plan.grid;
    let names = plan.names();
    let rows = grid.cells.iter().zip(results).zip(1..);
    let cells = rows.map(|((cell, result), i)| {
        let measures = result.measures.as_ref();
        json!({
            "cell": i,
            "parameters": named(&grid.parameters, &mut cell.iter().map(Setting::json)),
            "measures": measures.map(|m| named(&names, &mut m.iter().map(measured))),
            "outputs": result.outputs,
            "error": result.error,
        })
    });
    let set = grid.set.iter();
    json!({
        "sweep": args.sweep.display().to_string(),
        "recipe": plan.recipe.path.display().to_string(),
        "succeeded": succeeded,
        "set": set.map(|(name, setting)| (name.clone(), setting.json())).collect::<Json>(),
        "parameters": grid.parameters,
        "keep": names,
        "sheet": args.sheet.as_ref().map(|path| path.display().to_string()),
        "cells": cells.collect::<Json>(),
    })
}

fn measured(measured: &Measured) -> Json {
    match measured {
        Measured::Whole(n) => json!(n),
        Measured::Number(x) => json!(x),
        Measured::Text(text) => json!(text),
    }
}
