//! Sweeps: run one recipe with many values of its parameters.
//!
//! ```text
//! (
//!     sweep: 1,
//!     about: "find the coarsest level that is good enough",
//!     recipe: "cow.ron",                      relative to the folder of the sweep
//!     over: { "levels": [0, 1, 2], "ratio": Range(from: 0.1, to: 0.5, steps: 5) },
//!     zip: { "width": [1, 2], "height": [3, 4] },
//!     set: { "smooth": true },                the same in every cell
//!     expect: true,                           also check the expectations of the recipe
//!     keep: [Faces, Area, DistanceTo(other: File("cow.obj")), Seconds],
//! )
//! ```
//!
//! [`read_sweep`] reads the text, and [`Sweep::grid`] checks its values against the parameters that the recipe
//! declares. Both [`read_sweep`] and [`Sweep::grid`] report all errors at once. `over` and `zip` contain lists of
//! parameter values. The lists of `zip` have the same length, and the n-th values of all lists of `zip` form a row.
//! Each cell stands for one run of the recipe. The cells are all combinations of one value from each list of `over` and
//! one row of `zip`. From one cell to the next, the row of `zip` changes fastest, then the value from the last list of
//! `over`.

mod metric;
mod values;

use std::ops::Range;
use std::path::Path;

use mesh::counted;
use serde_json::json;

use crate::read::wrong_version;
use crate::recipe::Parameter;
use crate::schema;
use crate::schema_check::{self, check_schema, did_you_mean};
use ron_tree::{Diagnostic, Span, Value, ValueKind};

pub use metric::{Measured, Metric, Statistic};

/// The version of the sweep file format that this program reads.
pub const SWEEP_VERSION: i128 = 1;

/// The maximum number of cells (runs) of a sweep.
pub const MAX_CELLS: usize = 10_000;

/// A sweep that was read. The values of the sweep are not yet checked against the recipe.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The path of the recipe, relative to the folder of the sweep.
    pub recipe: String,
    /// The span of the path of the recipe.
    pub recipe_span: Span,
    /// Whether the recipe's expectations must hold in every cell (run of the recipe).
    pub expects: bool,
    /// The metrics that are recorded for each cell (run of the recipe). Each metric has its span.
    pub keep: Vec<(Metric, Span)>,
    over: Vec<Entry>,
    zip: Vec<Entry>,
    set: Vec<Entry>,
}

/// A parameter with its value or values, as written in the sweep.
#[derive(Clone, Debug)]
struct Entry {
    name: String,
    name_span: Span,
    value: Value,
}

/// The cells of a sweep. Each cell stands for one run of the recipe.
#[derive(Clone, Debug, Default)]
pub struct Grid {
    /// The parameters that change. Those of `over` come first, then those of `zip`, both in the order of the text.
    pub parameters: Vec<String>,
    /// The axes: one for each parameter of `over`, and one for all parameters of `zip`. The last axis changes fastest.
    pub axes: Vec<Axis>,
    /// For each cell (run of the recipe), the values of `parameters`.
    pub cells: Vec<Vec<Setting>>,
    /// The parameters that have the same value in every run.
    pub set: Vec<(String, Setting)>,
}

/// A group of parameters whose values change together from run to run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Axis {
    /// The range of the indices that these parameters have in [`Grid::parameters`].
    pub parameters: Range<usize>,
    /// The number of values of each parameter.
    pub len: usize,
}

/// A value of a parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Setting {
    /// The value as plain text for [`read`](crate::read()). If the value is a path, the text includes the folder of the
    /// sweep.
    pub text: String,
    /// The value as written in the sweep.
    pub value: Value,
}

impl Setting {
    /// Returns the value as JSON.
    pub fn json(&self) -> serde_json::Value {
        ron_tree::to_json(&self.value)
    }
}

/// A sweep with its errors and warnings.
#[derive(Clone, Debug)]
pub struct SweepReading {
    /// The sweep. `None` if the errors make it impossible to read the parts of the sweep.
    pub sweep: Option<Sweep>,
    /// The errors and warnings.
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads the text of a sweep.
pub fn read_sweep(source: &str) -> SweepReading {
    let parsed = ron_tree::parse(source);
    let mut diagnostics = parsed.diagnostics;
    let root = parsed.value;
    let failed = |diagnostics| SweepReading {
        sweep: None,
        diagnostics,
    };
    if let Some(problem) = wrong_version(&root, "sweep", SWEEP_VERSION) {
        return failed(vec![problem]);
    }
    if matches!(root.kind, ValueKind::Error) && !diagnostics.is_empty() {
        return failed(diagnostics);
    }
    diagnostics.extend(check_schema(&root, &envelope()));
    let keep = keep(&root, &mut diagnostics);
    let mut entries = |field: &str| entries(root.field(field), &mut diagnostics);
    let (over, zip, set) = (entries("over"), entries("zip"), entries("set"));
    diagnostics.sort_by_key(|d| d.span);
    let Some(recipe) = root.field("recipe").filter(|r| r.as_str().is_some()) else {
        return failed(diagnostics);
    };
    let sweep = Sweep {
        recipe: recipe.as_str().unwrap_or_default().to_owned(),
        recipe_span: recipe.span,
        expects: matches!(
            root.field("expect").map(|v| &v.kind),
            Some(ValueKind::Bool(true))
        ),
        keep,
        over,
        zip,
        set,
    };
    SweepReading {
        sweep: Some(sweep),
        diagnostics,
    }
}

impl SweepReading {
    /// Whether there are errors that prevent the sweep from running.
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }
}

/// Returns the schema of the fields of a sweep. In this schema, the parameters can have any values.
fn envelope() -> serde_json::Value {
    let values = json!({ "type": "object", "additionalProperties": {} });
    json!({
        "type": "object",
        "properties": {
            "sweep": { "type": "integer", "const": 1 },
            "about": { "type": "string" },
            "recipe": { "type": "string", "minLength": 1 },
            "over": values,
            "zip": values,
            "set": values,
            "expect": { "type": "boolean" },
            "keep": { "type": "array", "items": {}, "minItems": 1 },
        },
        "required": ["sweep", "recipe", "keep"],
        "additionalProperties": false,
    })
}

fn keep(root: &Value, diagnostics: &mut Vec<Diagnostic>) -> Vec<(Metric, Span)> {
    let schema = schema::of::<Metric>();
    let mut keep = Vec::new();
    for item in root.field("keep").and_then(Value::items).unwrap_or(&[]) {
        match schema_check::typed(item, &schema) {
            Ok(metric) => keep.push((metric, item.span)),
            Err(wrong) => diagnostics.extend(wrong),
        }
    }
    keep
}

fn entries(map: Option<&Value>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Entry> {
    let Some(ValueKind::Map(written)) = map.map(|m| &m.kind) else {
        return Vec::new();
    };
    let mut entries: Vec<Entry> = Vec::new();
    for (key, value) in written {
        let Some(name) = key.as_str() else { continue };
        if entries.iter().any(|e| e.name == name) {
            let message = format!("`{name}` is given twice");
            diagnostics.push(Diagnostic::error(key.span, message));
            continue;
        }
        entries.push(Entry {
            name: name.to_owned(),
            name_span: key.span,
            value: value.clone(),
        });
    }
    entries
}

impl Sweep {
    /// Checks the values against the parameters of the recipe, and returns the cells (runs of the recipe). `folder` is
    /// the folder of the sweep. Values that are relative paths are relative to this folder.
    ///
    /// # Errors
    ///
    /// Returns all errors. Possible errors are parameters that the recipe does not have or that are given twice, and
    /// values of a wrong type or out of range. Empty lists, lists of `zip` with different lengths, and more than
    /// [`MAX_CELLS`] cells are errors, too.
    pub fn grid(&self, parameters: &[Parameter], folder: &Path) -> Result<Grid, Vec<Diagnostic>> {
        let mut diagnostics = Vec::new();
        self.check_names(parameters, &mut diagnostics);
        let mut checked = |entries: &[Entry], single: bool| -> Vec<(String, Span, Vec<Setting>)> {
            let mut lists = Vec::new();
            for entry in entries {
                let Some(parameter) = parameters.iter().find(|p| p.name == entry.name) else {
                    continue;
                };
                let param = &parameter.param;
                let settings = if single {
                    values::setting(param, &entry.value, folder).map(|one| vec![one])
                } else {
                    values::settings(param, &entry.value, folder)
                };
                match settings {
                    Ok(list) => lists.push((entry.name.clone(), entry.value.span, list)),
                    Err(wrong) => diagnostics.extend(wrong),
                }
            }
            lists
        };
        let (over, zip, set) = (
            checked(&self.over, false),
            checked(&self.zip, false),
            checked(&self.set, true),
        );
        if let Some((first, _, list)) = zip.first()
            && let Some((other, span, found)) = zip.iter().find(|z| z.2.len() != list.len())
        {
            let message = format!(
                "all lists of `zip` must have the same length, but `{other}` has {} and `{first}` has {}",
                counted(found.len(), "value"),
                list.len()
            );
            diagnostics.push(Diagnostic::error(*span, message).with_help(
                "`zip` combines the first values of all lists, then the second values, and so on; use `over` for all combinations of the values",
            ));
        }
        let columns = |lists: &[(String, Span, Vec<Setting>)]| -> Vec<Vec<Vec<Setting>>> {
            let column = |list: &Vec<Setting>| list.iter().map(|s| vec![s.clone()]).collect();
            lists.iter().map(|(_, _, list)| column(list)).collect()
        };
        let mut axes = columns(&over);
        if !zip.is_empty() && diagnostics.is_empty() {
            let row = |i: usize| zip.iter().map(|(_, _, list)| list[i].clone()).collect();
            axes.push((0..zip[0].2.len()).map(row).collect());
        }
        let count = axes
            .iter()
            .try_fold(1, |n: usize, axis| n.checked_mul(axis.len()));
        if count.is_none_or(|n| n > MAX_CELLS) {
            let lengths: Vec<String> = axes.iter().map(|axis| axis.len().to_string()).collect();
            let message = format!(
                "the sweep has {} cells (combinations of values), expected at most {MAX_CELLS}",
                lengths.join(" x ")
            );
            let span = self.over.first().or(self.zip.first()).map(|e| e.value.span);
            let place = Diagnostic::error(span.unwrap_or(self.recipe_span), message);
            diagnostics.push(place.with_help("use fewer values, or split the sweep"));
        }
        if !diagnostics.is_empty() {
            diagnostics.sort_by_key(|d| d.span);
            return Err(diagnostics);
        }
        let names = over.iter().chain(&zip).map(|(name, _, _)| name.clone());
        let only = |(name, _, list): (String, Span, Vec<Setting>)| {
            list.into_iter().next().map(|one| (name, one))
        };
        let mut first = 0;
        let axis = |rows: &Vec<Vec<Setting>>| {
            let n = rows.first().map_or(0, Vec::len);
            first += n;
            Axis {
                parameters: first - n..first,
                len: rows.len(),
            }
        };
        Ok(Grid {
            axes: axes.iter().map(axis).collect(),
            parameters: names.collect(),
            cells: product(&axes),
            set: set.into_iter().filter_map(only).collect(),
        })
    }

    /// Reports names that are not parameters of the recipe. Also reports names that have several entries in the sweep,
    /// for example in `over` and in `set`.
    fn check_names(&self, parameters: &[Parameter], diagnostics: &mut Vec<Diagnostic>) {
        let mut seen: Vec<&Entry> = Vec::new();
        for entry in self.over.iter().chain(&self.zip).chain(&self.set) {
            let name = &entry.name;
            if !parameters.iter().any(|p| p.name == *name) {
                let known = parameters.iter().map(|p| p.name.as_str());
                let message = format!("the recipe has no parameter `{name}`");
                let unknown = Diagnostic::error(entry.name_span, message);
                diagnostics.push(unknown.with_help(did_you_mean(name, known)));
            }
            if let Some(earlier) = seen.iter().find(|e| e.name == *name) {
                let message = format!("the sweep gives values for `{name}` in two places");
                let twice = Diagnostic::error(entry.name_span, message);
                diagnostics.push(twice.with_label(earlier.name_span, "and here"));
            }
            seen.push(entry);
        }
    }
}

/// Returns all combinations of one row from each axis. The last axis changes fastest.
fn product(axes: &[Vec<Vec<Setting>>]) -> Vec<Vec<Setting>> {
    let mut cells = vec![Vec::new()];
    for axis in axes {
        cells = cells
            .iter()
            .flat_map(|cell| {
                let extended = |row: &Vec<Setting>| [cell.as_slice(), row].concat();
                axis.iter().map(extended)
            })
            .collect();
    }
    cells
}

#[cfg(test)]
mod tests;
