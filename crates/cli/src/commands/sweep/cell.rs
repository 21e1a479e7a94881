//! The cells of a sweep. Each cell is a run of the recipe with its own parameter values.

use std::ops::Range;
use std::path::PathBuf;

use ::cache::{Cache, Caching};
use engine::{Engine, FileReader, Loaded, Run};
use recipe::{Grid, Measured, Metric, Outcome, Source, Span};
use scene::Scene;
use view::Extent;

use crate::args::{SweepArgs, ValueArgs};
use crate::listener::INTERRUPT;
use crate::loading::load_text;
use crate::many::{JobResult, error_message, first_error, run_all};

/// Checks and runs the recipe for each cell of a sweep (each combination of parameter values).
pub(super) struct Cells<'a> {
    pub(super) args: &'a SweepArgs,
    /// The step cache. With this cache, a run can use the results of equal steps in earlier runs.
    pub(super) cache: Option<&'a Cache>,
    pub(super) engine: &'a Engine<'a>,
    /// The text of the recipe.
    pub(super) source: &'a Source,
    /// The text of the sweep.
    pub(super) sweep: &'a str,
    pub(super) grid: &'a Grid,
    pub(super) keep: &'a [(Metric, Span)],
    /// Whether the recipe's expectations are checked.
    pub(super) expects: bool,
    /// A function that receives the final scene of each run, and the estimated peak memory of the run in bytes. `None`
    /// if no sheet is drawn.
    pub(super) collect: Option<&'a (dyn Fn(Scene, u64) -> CellScene + Sync)>,
}

/// The recipe, loaded with the parameter values of one run of the sweep, or an error.
pub(super) struct Task(Result<Loaded, String>);

impl Task {
    /// The peak memory of the run, in bytes.
    pub(super) fn bytes(&self) -> u64 {
        self.0.as_ref().map_or(0, |l| l.forecast.peak_bytes())
    }
}

/// The result of one run of the sweep.
#[derive(Debug, Default)]
pub(super) struct CellResult {
    /// The measured values that `keep` lists, if the run succeeded.
    pub(super) measures: Option<Vec<Measured>>,
    /// The written files, if outputs are kept.
    pub(super) outputs: Vec<PathBuf>,
    pub(super) error: Option<String>,
    /// The final scene, if the run succeeded and a sheet (an image of all final scenes) is drawn.
    pub(super) scene: Option<CellScene>,
    /// Whether Ctrl-C canceled this run, or prevented its start.
    pub(super) is_not_run: bool,
}

/// The final scene of a successful run of the sweep, which is drawn on the sheet.
#[derive(Debug)]
pub(super) struct CellScene {
    /// The extent of the scene, or the reason why the scene cannot be drawn. The camera and the colors are chosen from
    /// the extents of all scenes.
    pub(super) extent: Result<Extent, String>,
    /// The scene, if there is enough memory to keep it.
    pub(super) scene: Option<Scene>,
    /// The peak memory of the run, in bytes.
    pub(super) bytes: u64,
}

impl CellResult {
    pub(super) fn of(end: JobResult<Self>) -> Self {
        end.unwrap_or_else(|error| Self {
            is_not_run: error.is_none(),
            error,
            ..Self::default()
        })
    }
}

impl Cells<'_> {
    /// Checks the recipe with the parameter values of each of these cells (runs of the sweep).
    pub(super) fn check(&self, cells: Range<usize>) -> anyhow::Result<Vec<Task>> {
        let ends = run_all(cells.len(), self.args.many.limits(), |i| {
            self.load(cells.start + i)
                .map_err(|error| format!("{error:#}"))
        })?;
        let task = |end: JobResult<_>| Task(end.unwrap_or_else(|e| Err(error_message(e))));
        Ok(ends.into_iter().map(task).collect())
    }

    fn load(&self, i: usize) -> anyhow::Result<Loaded> {
        let grid = self.grid;
        let shared = grid.set.iter().map(|(name, setting)| (name, setting));
        let own = grid.parameters.iter().zip(&grid.cells[i]);
        let all = shared.chain(own);
        let values = ValueArgs {
            set: all
                .map(|(name, setting)| (name.clone(), setting.text.clone()))
                .collect(),
            preset: None,
        };
        let out = match &self.args.keep_outputs {
            Some(folder) => folder.join((i + 1).to_string()),
            None => "out".into(),
        };
        let checking = self.args.many.checking();
        let mut loaded = load_text(self.source, &values, &out, checking, self.engine)?;
        if !self.expects {
            loaded.recipe.expectations.clear();
        }
        Ok(loaded)
    }

    /// Runs the recipe for one cell of the sweep. If the run fails, the error is its first problem. If Ctrl-C cancels
    /// the run, the error is `None`.
    pub(super) fn run(&self, task: &Task) -> JobResult<CellResult> {
        let loaded = task.0.as_ref().map_err(|error| Some(error.clone()))?;
        if loaded.has_errors() {
            return Err(Some(first_error(&loaded.diagnostics)));
        }
        let mut outcome = self.outcome(loaded, self.args.keep_outputs.is_some())?;
        let measure = |(metric, span): &(Metric, Span)| {
            let measured = metric.measure(&outcome, &loaded.files, &FileReader);
            measured.map_err(|problem| Some(format!("{}: {problem}", span.of(self.sweep))))
        };
        let measures = self.keep.iter().map(measure).collect::<Result<_, _>>()?;
        let scene = self.collect.zip(outcome.scene.take());
        Ok(CellResult {
            measures: Some(measures),
            outputs: outcome.written,
            scene: scene.map(|(collect, scene)| collect(scene, loaded.forecast.peak_bytes())),
            ..CellResult::default()
        })
    }

    /// Runs a recipe that was checked before, and returns the outcome of the run. If the run fails, the error is its
    /// first problem. If Ctrl-C cancels the run, the error is `None`.
    fn outcome(&self, loaded: &Loaded, keeps: bool) -> JobResult<Outcome> {
        let cache = self.cache.map(|cache| Caching {
            cache,
            recipe: None,
            want_scene: true,
        });
        let run = Run {
            keep_outputs: keeps,
            cache: cache.as_ref().map(|caching| caching as _),
        };
        let outcome = loaded.run(run, &INTERRUPT);
        if outcome.succeeded() && !outcome.cancelled {
            return Ok(outcome);
        }
        Err((!outcome.cancelled).then(|| first_error(&outcome.failures)))
    }

    /// Runs the recipe again for one cell of the sweep, and returns the final scene.
    pub(super) fn scene(&self, i: usize) -> Result<Scene, String> {
        let loaded = self.load(i).map_err(|error| format!("{error:#}"))?;
        let outcome = self.outcome(&loaded, false).map_err(error_message)?;
        let missing = || "internal error: the run returned no scene (please report it)".to_owned();
        outcome.scene.ok_or_else(missing)
    }
}
