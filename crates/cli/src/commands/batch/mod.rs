//! `meshwright batch`: one recipe on many files, several at once.
//!
//! ```text
//! patterns -> sorted list -> collisions? -> this part -> done before? -> check -> run -> rows
//!                                                             ^                     |
//!                                                             +------ journal <-----+
//! ```
//!
//! A line on the standard output for each file that was tried, in the order of the list, and a summary.
//! [`row`] describes the reports, [`journal`] how a batch goes on after it was ended. Outputs, reports
//! and notes are written beside their places and renamed; when the disk is full, the files at work fail,
//! and if even the journal cannot be written, no other file is begun.

mod failed;
pub(crate) mod inputs;
mod journal;
mod merge;
mod plan;
mod row;

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use engine::Engine;
use recipe::{InOrder, JobEnd, Jobs, Outcome};

use crate::args::BatchArgs;
use crate::listener::{QUIET, catch_interrupts, is_interrupted};
use crate::many::{self, CHECKED_AHEAD, Ended, all, first_error};
use crate::output::{print, shown};
use engine::{Loaded, Run};
use inputs::Input;
use journal::{Entry, Journal};
use plan::Batch;
use row::{Form, Output, Report, Row, State};

pub(crate) fn run(args: &BatchArgs, engine: &Engine) -> anyhow::Result<bool> {
    if let Some(report) = &args.report {
        Form::of(report)?;
    }
    if !args.merge.is_empty() {
        return merge::run(args);
    }
    let Some(batch) = Batch::plan(args, engine)? else {
        return Ok(false);
    };
    catch_interrupts();
    let mut journal = Journal::open(batch.journal())?;
    batch.remove_stale(&journal.processes);
    let mine = batch.mine();
    let (mut rows, mut kept) = (Vec::with_capacity(mine.len()), 0);
    for files in mine.chunks(CHECKED_AHEAD) {
        let chunk = Chunk::check(&batch, files, &journal)?;
        kept += chunk.count_kept();
        rows.extend(chunk.run(&mut journal)?);
    }
    let report = Report::new(batch.header(), rows);
    if let Some(path) = &args.report {
        report.write(path)?;
    }
    print(&summary(&report, kept, args))?;
    let header = &report.header;
    Ok(header.failed == 0 && header.skipped == 0)
}

fn summary(report: &Report, kept: usize, args: &BatchArgs) -> String {
    let header = &report.header;
    let mut text = format!("{} ok, {} failed", header.ok, header.failed);
    if header.failed > 0 {
        let folder = failed::folder(&args.out);
        text += &format!(" (see {})", folder.display());
    }
    if header.skipped > 0 {
        text += &format!(", {} not done: interrupted", header.skipped);
    }
    if kept > 0 {
        text += &format!("; {kept} of them were done before");
    }
    if let Some(shard) = header.shard {
        text += &format!("; part {shard} of {} files", header.listed);
    }
    text + "\n"
}

/// What is to be done with a file.
enum Task {
    /// Nothing: this is what came of it before.
    Keep(Row),
    /// It can run, and takes so many bytes.
    Run(Box<Loaded>, u64),
    /// It cannot run.
    Fail(Done),
}

/// What came of a file.
#[derive(Clone, Default)]
struct Done {
    row: Row,
    /// What the row depends on; `None` if it is not to be noted.
    key: Option<String>,
    /// The whole of what is to be said of a failure.
    text: String,
}

impl Done {
    /// A row that is not noted.
    fn silent(row: Row) -> Self {
        Self {
            row,
            ..Self::default()
        }
    }
}

/// Files that are checked and then run.
struct Chunk<'b> {
    batch: &'b Batch<'b>,
    files: &'b [&'b Input],
    tasks: Vec<Task>,
}

impl<'b> Chunk<'b> {
    fn check(
        batch: &'b Batch<'b>,
        files: &'b [&'b Input],
        journal: &Journal,
    ) -> anyhow::Result<Self> {
        let limits = batch.args.many.limits();
        let ends = all(files.len(), limits, |i| {
            let known = journal.known.get(&files[i].path);
            check(batch, files[i], known)
        })?;
        let task = |(end, file): (Ended<Task>, &&Input)| {
            end.unwrap_or_else(|panicked| Task::Fail(without_result(file, panicked)))
        };
        let tasks = ends.into_iter().zip(files).map(task).collect();
        Ok(Self {
            batch,
            files,
            tasks,
        })
    }

    /// How many were done before.
    fn count_kept(&self) -> usize {
        let is_kept = |task: &&Task| matches!(task, Task::Keep(_));
        self.tasks.iter().filter(is_kept).count()
    }

    /// Runs what is to be run, and returns the rows in the order of the files.
    fn run(self, journal: &mut Journal) -> anyhow::Result<Vec<Row>> {
        let broken = AtomicBool::new(false);
        let jobs = Jobs {
            count: self.tasks.len(),
            bytes: |i: usize| match &self.tasks[i] {
                Task::Run(_, bytes) => *bytes,
                _ => 0,
            },
            stop: || is_interrupted() || broken.load(Ordering::Relaxed),
            work: |i: usize| self.work(i),
        };
        let (mut order, mut rows) = (InOrder::default(), Vec::new());
        let mut problem = Ok(());
        jobs.run(self.batch.args.many.limits(), |ended| {
            let ended: Vec<(usize, Done)> = ended
                .into_iter()
                .map(|(i, end)| (i, self.done(i, end)))
                .collect();
            if problem.is_ok() {
                problem = self.note(&ended, journal);
                broken.store(problem.is_err(), Ordering::Relaxed);
            }
            for (i, done) in ended {
                order.put(i, done.row);
            }
            while let Some((i, row)) = order.take() {
                if problem.is_ok() && !matches!(self.tasks[i], Task::Keep(_)) {
                    problem = print(&line(&row)).map_err(Into::into);
                    broken.store(problem.is_err(), Ordering::Relaxed);
                }
                rows.push(row);
            }
        })?;
        problem.map(|()| rows)
    }

    /// What is done with a file, on one of many threads.
    fn work(&self, i: usize) -> Done {
        let (loaded, begin) = match &self.tasks[i] {
            Task::Run(loaded, _) => (loaded, Instant::now()),
            Task::Keep(row) => return Done::silent(row.clone()),
            Task::Fail(failed) => return failed.clone(),
        };
        // Before the run: what changes meanwhile is done again.
        let key = self.batch.key(self.files[i], loaded);
        let run = Run {
            keep_outputs: true,
            cache: None,
        };
        let outcome = loaded.run(run, &QUIET);
        let row = Row {
            seconds: begin.elapsed().as_secs_f64(),
            ..row(&self.files[i].path, loaded, &outcome)
        };
        Done {
            key: key
                .filter(|_| row.state != State::Skipped)
                .map(|key| noted(key, &row, self.batch)),
            row,
            text: loaded.render(&outcome.failures, false),
        }
    }

    fn done(&self, i: usize, end: JobEnd<Done>) -> Done {
        many::result(end).unwrap_or_else(|panicked| match &self.tasks[i] {
            Task::Keep(row) => Done::silent(row.clone()),
            Task::Run(..) | Task::Fail(_) => without_result(self.files[i], panicked),
        })
    }

    /// Puts what ended into the journal and the folder of failures.
    fn note(&self, ended: &[(usize, Done)], journal: &mut Journal) -> anyhow::Result<()> {
        let mut entries = Vec::new();
        for (i, done) in ended {
            if matches!(self.tasks[*i], Task::Keep(_)) {
                continue;
            }
            match done.row.state {
                State::Failed => failed::write(self.batch, self.files[*i], &done.row, &done.text)?,
                State::Ok => failed::remove(self.batch, self.files[*i]),
                State::Skipped => {}
            }
            if let Some(key) = &done.key {
                entries.push(Entry {
                    key: key.clone(),
                    row: done.row.clone(),
                });
            }
        }
        journal.note(&entries)
    }
}

/// Finds out what is to be done with a file.
fn check(batch: &Batch, file: &Input, known: Option<&Entry>) -> Task {
    let loaded = match batch.load(file) {
        Ok(loaded) => loaded,
        Err(error) => return Task::Fail(failure(file, format!("{error:#}"))),
    };
    let is_tried_again = |row: &Row| row.state == State::Failed && batch.args.retry_failed;
    if let Some(entry) = known
        && !is_tried_again(&entry.row)
        && let Some(key) = batch.key(file, &loaded)
        && noted(key, &entry.row, batch) == entry.key
        && entry.row.has_outputs()
    {
        return Task::Keep(entry.row.clone());
    }
    if loaded.has_errors() {
        let mut failed = failure(file, first_error(&loaded.diagnostics));
        failed.text = loaded.render(&loaded.diagnostics, false);
        let key = batch.key(file, &loaded);
        failed.key = key.map(|key| noted(key, &failed.row, batch));
        return Task::Fail(failed);
    }
    let bytes = loaded.forecast.peak_bytes();
    Task::Run(Box::new(loaded), bytes)
}

/// The key of a row for the journal: with another budget, what failed may be done.
fn noted(key: String, row: &Row, batch: &Batch) -> String {
    match row.state {
        State::Failed => format!("{key}-{}", batch.args.many.budget),
        _ => key,
    }
}

fn failure(file: &Input, message: String) -> Done {
    Done {
        text: format!("error: {message}\n"),
        row: Row::not_done(&file.path, State::Failed, Some(message)),
        key: None,
    }
}

/// What came of a file whose job panicked, with a message, or was not begun.
fn without_result(file: &Input, panicked: Option<String>) -> Done {
    match panicked {
        Some(message) => failure(file, message),
        None => Done::silent(Row::not_done(&file.path, State::Skipped, None)),
    }
}

/// The row of a file that was run.
fn row(path: &str, loaded: &Loaded, outcome: &Outcome) -> Row {
    let state = match (outcome.succeeded(), outcome.cancelled) {
        (_, true) => return Row::not_done(path, State::Skipped, None),
        (true, _) => State::Ok,
        (false, _) => State::Failed,
    };
    let mut row = Row::not_done(path, state, None);
    for step in &outcome.steps {
        let losses = step.report.losses.iter();
        row.losses
            .extend(losses.map(|loss| format!("{}: {loss}", step.label)));
    }
    if state == State::Failed {
        let failed = loaded.recipe.steps.get(outcome.steps.len());
        row.step = failed.map(|step| step.label().to_owned());
        row.message = Some(first_error(&outcome.failures));
        return row;
    }
    let last = outcome.steps.last();
    row.vertices = last.map(|step| step.vertices);
    row.edges = last.map(|step| step.edges);
    row.faces = last.map(|step| step.faces);
    row.digest = Some(outcome.digest.to_string());
    let output = |path: &PathBuf| Output {
        bytes: path.metadata().map_or(0, |m| m.len()),
        path: path.display().to_string(),
    };
    row.outputs = outcome.written.iter().map(output).collect();
    row
}

/// The line of a file.
fn line(row: &Row) -> String {
    let input = shown(&row.input);
    match row.state {
        State::Ok => {
            let (time, digest) = (row.seconds * 1e3, row.digest.as_deref());
            let digest = digest.unwrap_or_default();
            format!("ok     {input} ({time:.0} ms, digest {digest})\n")
        }
        State::Failed => {
            let step = row.step.as_ref().map(|s| format!("{s}: "));
            let step = step.unwrap_or_default();
            let message = row.message.as_deref().unwrap_or_default();
            format!("FAILED {input}: {step}{}\n", shown(message))
        }
        State::Skipped => String::new(),
    }
}
