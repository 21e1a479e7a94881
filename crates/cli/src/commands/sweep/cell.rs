//! The cells of a sweep: each is a run with values of its own.

use std::ops::Range;
use std::path::PathBuf;

use ::cache::{Cache, Caching};
use engine::{Engine, FileReader, Loaded, Run};
use recipe::{Grid, Measured, Metric, Outcome, Source, Span};
use scene::Scene;
use view::Extent;

use crate::args::{SweepArgs, ValueArgs};
use crate::listener::QUIET;
use crate::loading::load_text;
use crate::many::{Ended, all, first_error, interrupted};

/// All cells.
pub(super) struct Cells<'a> {
    pub(super) args: &'a SweepArgs,
    /// Steps that cells share run once.
    pub(super) cache: Option<&'a Cache>,
    pub(super) engine: &'a Engine<'a>,
    /// The text of the recipe.
    pub(super) source: &'a Source,
    pub(super) grid: &'a Grid,
    pub(super) keep: &'a [(Metric, Span)],
    /// Whether the recipe's expectations must hold.
    pub(super) expects: bool,
    /// If scenes are drawn: takes the scene of a cell and the number of bytes that making it needed.
    pub(super) see: Option<&'a (dyn Fn(Scene, u64) -> Seen + Sync)>,
}

/// A cell that is checked, or why it cannot run.
pub(super) struct Task(Result<Loaded, String>);

impl Task {
    /// The bytes that it takes at its peak.
    pub(super) fn bytes(&self) -> u64 {
        self.0.as_ref().map_or(0, |l| l.forecast.peak_bytes())
    }
}

/// What came of a cell.
#[derive(Debug, Default)]
pub(super) struct CellResult {
    /// What is kept, if it succeeded.
    pub(super) measures: Option<Vec<Measured>>,
    /// The files that were written, if outputs are kept.
    pub(super) outputs: Vec<PathBuf>,
    pub(super) error: Option<String>,
    /// What the sheet knows of it, if there is one and it succeeded.
    pub(super) seen: Option<Seen>,
    /// Whether Ctrl-C came before it was done.
    pub(super) is_not_run: bool,
}

/// What is known of a cell that succeeded.
#[derive(Debug)]
pub(super) struct Seen {
    pub(super) extent: Result<Extent, String>,
    /// The scene, if there is memory to keep it.
    pub(super) scene: Option<Scene>,
    /// The bytes that it takes to make it.
    pub(super) bytes: u64,
}

impl CellResult {
    pub(super) fn of(end: Ended<Self>) -> Self {
        end.unwrap_or_else(|error| Self {
            is_not_run: error.is_none(),
            error,
            ..Self::default()
        })
    }
}

impl Cells<'_> {
    /// Reads and checks the recipe for these cells.
    pub(super) fn check(&self, cells: Range<usize>) -> anyhow::Result<Vec<Task>> {
        let ends = all(cells.len(), self.args.many.limits(), |i| {
            self.load(cells.start + i)
                .map_err(|error| format!("{error:#}"))
        })?;
        let task = |end: Ended<_>| Task(end.unwrap_or_else(|e| Err(interrupted(e))));
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
        let budget = self.args.many.budget;
        let mut loaded = load_text(self.source, &values, &out, budget, self.engine)?;
        if !self.expects {
            loaded.recipe.expectations.clear();
        }
        Ok(loaded)
    }

    /// Runs a cell; an error is as that of [`outcome`](Self::outcome).
    pub(super) fn run(&self, task: &Task) -> Ended<CellResult> {
        let loaded = task.0.as_ref().map_err(|error| Some(error.clone()))?;
        if loaded.has_errors() {
            return Err(Some(first_error(&loaded.diagnostics)));
        }
        let mut outcome = self.outcome(loaded, self.args.keep_outputs.is_some())?;
        let measure = |(metric, _): &(Metric, Span)| {
            let measured = metric.measure(&outcome, &loaded.files, &FileReader);
            measured.map_err(|problem| Some(format!("{metric:?}: {problem}")))
        };
        let measures = self.keep.iter().map(measure).collect::<Result<_, _>>()?;
        let seen = self.see.zip(outcome.scene.take());
        Ok(CellResult {
            measures: Some(measures),
            outputs: outcome.written,
            seen: seen.map(|(see, scene)| see(scene, loaded.forecast.peak_bytes())),
            ..CellResult::default()
        })
    }

    /// How the run of a cell that is checked ended, if it succeeded; else its error, or none if Ctrl-C ended it.
    fn outcome(&self, loaded: &Loaded, keeps: bool) -> Ended<Outcome> {
        let cache = self.cache.map(|cache| Caching {
            cache,
            recipe: None,
            want_scene: true,
        });
        let run = Run {
            keep_outputs: keeps,
            cache: cache.as_ref().map(|caching| caching as _),
        };
        let outcome = loaded.run(run, &QUIET);
        if outcome.succeeded() && !outcome.cancelled {
            return Ok(outcome);
        }
        Err((!outcome.cancelled).then(|| first_error(&outcome.failures)))
    }

    /// The scene of a cell that has run before, made again.
    pub(super) fn scene(&self, i: usize) -> Result<Scene, String> {
        let loaded = self.load(i).map_err(|error| format!("{error:#}"))?;
        let outcome = self.outcome(&loaded, false).map_err(interrupted)?;
        let missing = || "the scene stayed in the cache".to_owned();
        outcome.scene.ok_or_else(missing)
    }
}
