//! The cells of a sweep: each is a run with values of its own.

use std::ops::Range;
use std::path::PathBuf;

use ::cache::{Cache, Caching};
use engine::{Engine, FileReader, Loaded, Run};
use recipe::{Grid, JobEnd, Measured, Metric, Outcome, Source, Span};
use scene::Scene;
use view::Extent;

use crate::args::SweepArgs;
use crate::listener::QUIET;
use crate::loading::load_text;
use crate::many::{all, first_error, panicked};

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
    pub(super) fn of(end: JobEnd<Self>) -> Self {
        match end {
            JobEnd::Done(result) => result,
            JobEnd::Panicked(message) => Self::failed(panicked(&message)),
            JobEnd::NotRun => Self::not_run(),
        }
    }

    fn failed(error: String) -> Self {
        Self {
            error: Some(error),
            ..Self::default()
        }
    }

    fn not_run() -> Self {
        Self {
            is_not_run: true,
            ..Self::default()
        }
    }
}

impl Cells<'_> {
    /// Reads and checks the recipe for these cells.
    pub(super) fn check(&self, cells: Range<usize>) -> anyhow::Result<Vec<Task>> {
        let ends = all(cells.len(), self.args.many.limits(), |i| {
            self.load(cells.start + i)
                .map_err(|error| format!("{error:#}"))
        })?;
        let task = |end| match end {
            JobEnd::Done(loaded) => Task(loaded),
            JobEnd::Panicked(message) => Task(Err(panicked(&message))),
            JobEnd::NotRun => Task(Err("interrupted".to_owned())),
        };
        Ok(ends.into_iter().map(task).collect())
    }

    fn load(&self, i: usize) -> anyhow::Result<Loaded> {
        let grid = self.grid;
        let shared = grid.set.iter().map(|(name, setting)| (name, setting));
        let own = grid.parameters.iter().zip(&grid.cells[i]);
        let set: Vec<(String, String)> = shared
            .chain(own)
            .map(|(name, setting)| (name.clone(), setting.text.clone()))
            .collect();
        let out = match &self.args.keep_outputs {
            Some(folder) => folder.join((i + 1).to_string()),
            None => "out".into(),
        };
        let budget = self.args.many.budget;
        let mut loaded = load_text(self.source, (&set, None), &out, budget, self.engine)?;
        if !self.expects {
            loaded.recipe.expectations.clear();
        }
        Ok(loaded)
    }

    pub(super) fn run(&self, task: &Task) -> CellResult {
        let loaded = match &task.0 {
            Ok(loaded) => loaded,
            Err(error) => return CellResult::failed(error.clone()),
        };
        if loaded.has_errors() {
            return CellResult::failed(first_error(&loaded.diagnostics));
        }
        let mut outcome = match self.outcome(loaded, self.args.keep_outputs.is_some()) {
            Ok(outcome) => outcome,
            Err(Some(error)) => return CellResult::failed(error),
            Err(None) => return CellResult::not_run(),
        };
        let measure = |(metric, _): &(Metric, Span)| {
            let measured = metric.measure(&outcome, &loaded.files, &FileReader);
            measured.map_err(|problem| format!("{metric:?}: {problem}"))
        };
        let measures = match self.keep.iter().map(measure).collect() {
            Ok(measures) => measures,
            Err(error) => return CellResult::failed(error),
        };
        let seen = self.see.zip(outcome.scene.take());
        CellResult {
            measures: Some(measures),
            outputs: outcome.written,
            seen: seen.map(|(see, scene)| see(scene, loaded.forecast.peak_bytes())),
            ..CellResult::default()
        }
    }

    /// How the run of a cell that is checked ended, if it succeeded; else its error, or none if Ctrl-C ended it.
    fn outcome(&self, loaded: &Loaded, keeps: bool) -> Result<Outcome, Option<String>> {
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
        if outcome.cancelled {
            return Err(None);
        }
        if !outcome.succeeded() {
            return Err(Some(first_error(&outcome.failures)));
        }
        Ok(outcome)
    }

    /// The scene of a cell that has run before, made again.
    pub(super) fn scene(&self, i: usize) -> Result<Scene, String> {
        let loaded = self.load(i).map_err(|error| format!("{error:#}"))?;
        let outcome = self.outcome(&loaded, false);
        let outcome = outcome.map_err(|e| e.unwrap_or_else(|| "interrupted".to_owned()))?;
        outcome
            .scene
            .ok_or_else(|| "the scene stayed in the cache".to_owned())
    }
}
