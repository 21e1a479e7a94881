//! `meshwright batch`: runs one recipe on many files, several at the same time.
//!
//! ```text
//! patterns -> list -> collisions? -> this part -> done before? -> check -> run -> rows
//!                                                             ^                     |
//!                                                             +------ journal <-----+
//! ```
//!
//! Prints a line for each processed file, in the order of the list of files, and then a summary. The module [`row`]
//! describes the reports. The module [`journal`] describes how an interrupted batch is resumed. Outputs, reports and
//! descriptions of failures are first written to temporary files, which are then renamed. If the disk is full, the
//! files that are being processed count as failed. If the journal cannot be written, the batch starts no further files.

mod estimate;
mod failed;
pub(crate) mod inputs;
mod journal;
mod merge;
mod plan;
mod row;
mod sets;

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use engine::Engine;
use recipe::{InOrder, JobEnd, Jobs, Outcome};

use crate::args::BatchArgs;
use crate::junit::{self, Case, CaseEnd};
use crate::listener::{INTERRUPT, catch_interrupts, is_interrupted};
use crate::many::{self, CHECKED_AHEAD, JobResult, all_errors, run_all};
use crate::output::{escape_control, print, write_atomically};
use engine::{Loaded, Run};
use inputs::Input;
use journal::{Entry, Journal};
use plan::Batch;
use row::{Output, Report, ReportFormat, Row, State};

pub(crate) fn run(args: &BatchArgs, engine: &Engine) -> anyhow::Result<bool> {
    if let Some(report) = &args.report {
        ReportFormat::of(report)?;
    }
    if !args.merge.is_empty() {
        return merge::run(args);
    }
    let Some(batch) = Batch::plan(args, engine)? else {
        return Ok(false);
    };
    catch_interrupts();
    if let Some(n) = args.estimate {
        return estimate::run(&batch, n);
    }
    let files_of_part = batch.files_of_part();
    let wanted = files_of_part
        .iter()
        .map(|file| (file.path.as_str(), file.number()));
    let wanted: HashSet<(&str, usize)> = wanted.collect();
    let mut journal = Journal::open(batch.journal(), |row| wanted.contains(&row.key()))?;
    batch.remove_stale(&journal.processes);
    let (mut rows, mut kept) = (Vec::with_capacity(files_of_part.len()), 0);
    for files in files_of_part.chunks(CHECKED_AHEAD) {
        let chunk = Chunk::check(&batch, files, &journal)?;
        kept += chunk.count_kept();
        rows.extend(chunk.run(&mut journal)?);
    }
    let report = Report::new(batch.header(), rows);
    if let Some(path) = &args.report {
        report.write(path)?;
    }
    if let Some(path) = &args.junit {
        write_atomically(path, junit_report(&batch, &report.rows).as_bytes())?;
    }
    print(&summary(&report, kept, args))?;
    let header = &report.header;
    Ok(header.failed == 0 && header.skipped == 0)
}

/// Returns the results of the batch as a report in the format JUnit XML. The text of each failure is read from the file
/// that describes this failure, in the folder `failed` below the output folder.
fn junit_report(batch: &Batch, rows: &[Row]) -> String {
    let files = batch.files_of_part();
    let labels: Vec<String> = files.iter().map(|file| file.label()).collect();
    let cases = rows.iter().zip(files).zip(&labels);
    let cases: Vec<Case> = cases
        .map(|((row, file), label)| case(batch, file, label, row))
        .collect();
    junit::report(&batch.path.display().to_string(), &cases)
}

fn case<'b>(batch: &Batch, file: &Input, label: &'b str, row: &Row) -> Case<'b> {
    let message = || row.message.clone().unwrap_or_default();
    let end = match row.state {
        State::Ok => CaseEnd::Passed,
        State::Skipped => CaseEnd::Skipped("interrupted"),
        State::Failed => CaseEnd::Failed {
            message: message(),
            text: failed::read(batch, file).unwrap_or_else(|_| message()),
        },
    };
    Case {
        path: Path::new(label),
        time: row.seconds,
        end,
    }
}

fn summary(report: &Report, kept: usize, args: &BatchArgs) -> String {
    let header = &report.header;
    let mut text = format!("{} ok, {} failed", header.ok, header.failed);
    if header.failed > 0 {
        let folder = failed::folder(&args.out);
        text += &format!(" (see {})", folder.display());
    }
    if header.skipped > 0 {
        text += &format!(", {} not processed: interrupted", header.skipped);
    }
    if kept > 0 {
        text += &format!("; {kept} of them finished in earlier runs");
    }
    if let Some(shard) = header.shard {
        text += &format!("; part {shard} of {} files", header.listed);
    }
    text + "\n"
}

/// What to do with an input file.
enum Task {
    /// Keep this row from an earlier run.
    Keep(Row),
    /// Run the recipe. The number is the estimated peak memory of this run, in bytes.
    Run(Box<Loaded>, u64),
    /// Report a failure, because the recipe cannot be run on this file.
    Fail(FileResult),
}

/// The result of the run on an input file.
#[derive(Clone, Default)]
struct FileResult {
    row: Row,
    /// The key of the row in the journal, or `None` if the row is not recorded in the journal.
    key: Option<String>,
    /// The full error messages of a failure.
    text: String,
}

impl FileResult {
    /// Creates a result that is not recorded in the journal.
    fn unrecorded(row: Row) -> Self {
        Self {
            row,
            ..Self::default()
        }
    }
}

/// At most [`CHECKED_AHEAD`] input files. The recipe is checked for all of these files before the first run starts.
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
        let ends = run_all(files.len(), limits, |i| {
            let known = journal
                .known
                .get(&(files[i].path.clone(), files[i].number()));
            check(batch, files[i], known)
        })?;
        let task = |(end, file): (JobResult<Task>, &&Input)| {
            end.unwrap_or_else(|panicked| Task::Fail(without_result(file, panicked)))
        };
        let tasks = ends.into_iter().zip(files).map(task).collect();
        Ok(Self {
            batch,
            files,
            tasks,
        })
    }

    /// Returns the number of files that were finished in earlier runs.
    fn count_kept(&self) -> usize {
        let is_kept = |task: &&Task| matches!(task, Task::Keep(_));
        self.tasks.iter().filter(is_kept).count()
    }

    /// Runs the tasks, and returns the rows in the order of the files.
    fn run(self, journal: &mut Journal) -> anyhow::Result<Vec<Row>> {
        let has_problem = AtomicBool::new(false);
        let jobs = Jobs {
            count: self.tasks.len(),
            bytes: |i: usize| match &self.tasks[i] {
                Task::Run(_, bytes) => *bytes,
                _ => 0,
            },
            stop: || is_interrupted() || has_problem.load(Ordering::Relaxed),
            work: |i: usize| self.work(i),
        };
        let (mut order, mut rows) = (InOrder::default(), Vec::new());
        let mut problem = Ok(());
        jobs.run(self.batch.args.many.limits(), |ended| {
            let results: Vec<(usize, FileResult)> = ended
                .into_iter()
                .map(|(i, end)| (i, self.result(i, end)))
                .collect();
            if problem.is_ok() {
                problem = self.record(&results, journal);
                has_problem.store(problem.is_err(), Ordering::Relaxed);
            }
            for (i, result) in results {
                order.put(i, result.row);
            }
            while let Some((i, row)) = order.take() {
                if problem.is_ok() && !matches!(self.tasks[i], Task::Keep(_)) {
                    problem = print(&line(&row)).map_err(Into::into);
                    has_problem.store(problem.is_err(), Ordering::Relaxed);
                }
                rows.push(row);
            }
        })?;
        problem.map(|()| rows)
    }

    /// Performs the task of a file. Several threads can call this method at the same time.
    fn work(&self, i: usize) -> FileResult {
        let (loaded, begin) = match &self.tasks[i] {
            Task::Run(loaded, _) => (loaded, Instant::now()),
            Task::Keep(row) => return FileResult::unrecorded(row.clone()),
            Task::Fail(failed) => return failed.clone(),
        };
        // The key is computed before the run, so if an input changes during the run, the next batch processes the file
        // again.
        let key = self.batch.key(self.files[i], loaded);
        let run = Run {
            keep_outputs: true,
            cache: None,
        };
        let outcome = loaded.run(run, &INTERRUPT);
        let row = Row {
            seconds: begin.elapsed().as_secs_f64(),
            ..row(self.files[i], loaded, &outcome)
        };
        FileResult {
            key: key
                .filter(|_| row.state != State::Skipped)
                .map(|key| journal_key(key, &row, self.batch)),
            row,
            text: loaded.render(&outcome.failures, false),
        }
    }

    /// Returns the result of the run on an input file. `end` says how the job for this file ended.
    fn result(&self, i: usize, end: JobEnd<FileResult>) -> FileResult {
        many::job_result(end).unwrap_or_else(|panicked| match &self.tasks[i] {
            Task::Keep(row) => FileResult::unrecorded(row.clone()),
            Task::Run(..) | Task::Fail(_) => without_result(self.files[i], panicked),
        })
    }

    /// Records results in the journal, and describes each failure in a file in the folder `failed` below the output
    /// folder.
    fn record(&self, results: &[(usize, FileResult)], journal: &mut Journal) -> anyhow::Result<()> {
        let mut entries = Vec::new();
        for (i, result) in results {
            if matches!(self.tasks[*i], Task::Keep(_)) {
                continue;
            }
            match result.row.state {
                State::Failed => {
                    failed::write(self.batch, self.files[*i], &result.row, &result.text)?;
                }
                State::Ok => failed::remove(self.batch, self.files[*i]),
                State::Skipped => {}
            }
            if let Some(key) = &result.key {
                entries.push(Entry::new(key.clone(), result.row.clone()));
            }
        }
        journal.append(&entries)
    }
}

/// Decides whether to run the recipe on an input file, to keep its row from an earlier run, or to report a failure.
fn check(batch: &Batch, file: &Input, known: Option<&Entry>) -> Task {
    let loaded = match batch.load(file) {
        Ok(loaded) => loaded,
        Err(error) => return Task::Fail(failure(file, format!("{error:#}"))),
    };
    let is_retried = |row: &Row| row.state == State::Failed && batch.args.retry_failed;
    if let Some(entry) = known
        && !is_retried(&entry.row)
        && let Some(key) = batch.key(file, &loaded)
        && journal_key(key, &entry.row, batch) == entry.key
        && entry.row.has_outputs()
    {
        return Task::Keep(entry.row.clone());
    }
    if loaded.has_errors() {
        let mut failed = failure(file, all_errors(&loaded.diagnostics));
        failed.text = loaded.render(&loaded.diagnostics, false);
        let key = batch.key(file, &loaded);
        failed.key = key.map(|key| journal_key(key, &failed.row, batch));
        return Task::Fail(failed);
    }
    let bytes = loaded.forecast.peak_bytes();
    Task::Run(Box::new(loaded), bytes)
}

/// Returns the key under which a row is recorded in the journal. The key of a failure includes the memory budget,
/// because a run with a larger budget can succeed.
fn journal_key(key: String, row: &Row, batch: &Batch) -> String {
    match row.state {
        State::Failed => format!("{key}-{}", batch.args.many.budget),
        _ => key,
    }
}

fn failure(file: &Input, message: String) -> FileResult {
    FileResult {
        text: format!("error: {message}\n"),
        row: Row::without_outputs(file, State::Failed, Some(message)),
        key: None,
    }
}

/// Returns a result for a file whose job panicked or was not started. `panicked` is the message of the panic, or `None`
/// if the job was not started.
fn without_result(file: &Input, panicked: Option<String>) -> FileResult {
    match panicked {
        Some(message) => failure(file, message),
        None => FileResult::unrecorded(Row::without_outputs(file, State::Skipped, None)),
    }
}

/// Returns the row of the report for an input file with which the recipe was run.
fn row(file: &Input, loaded: &Loaded, outcome: &Outcome) -> Row {
    let state = match (outcome.succeeded(), outcome.cancelled) {
        (_, true) => return Row::without_outputs(file, State::Skipped, None),
        (true, _) => State::Ok,
        (false, _) => State::Failed,
    };
    let mut row = Row::without_outputs(file, state, None);
    for step in &outcome.steps {
        let losses = step.report.losses.iter();
        row.losses
            .extend(losses.map(|loss| format!("{}: {loss}", step.label)));
    }
    // If a step failed, the row has the element counts of the scene before that step.
    let last = outcome.steps.last();
    row.vertices = last.map(|step| step.vertices);
    row.edges = last.map(|step| step.edges);
    row.faces = last.map(|step| step.faces);
    if state == State::Failed {
        let failed = loaded.recipe.steps.get(outcome.steps.len());
        row.step = failed.map(|step| step.label().to_owned());
        row.message = Some(all_errors(&outcome.failures));
        return row;
    }
    row.digest = Some(outcome.digest.to_string());
    let output = |path: &PathBuf| Output {
        bytes: path.metadata().map_or(0, |m| m.len()),
        path: path.display().to_string(),
    };
    row.outputs = outcome.written.iter().map(output).collect();
    row
}

/// Formats the line that is printed on the terminal for an input file.
fn line(row: &Row) -> String {
    let label = row.label();
    let input = escape_control(&label);
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
            format!("FAILED {input}: {step}{}\n", escape_control(message))
        }
        State::Skipped => String::new(),
    }
}
