//! Runs many jobs at the same time, for the commands `test`, `batch` and `sweep`.

use recipe::{Diagnostic, InOrder, JobEnd, JobLimits, Jobs, Severity};

use crate::listener::is_interrupted;

/// The maximum number of runs that are checked together before the first of them starts. The number is limited because
/// the checked recipes of all these runs stay in memory.
pub(crate) const CHECKED_AHEAD: usize = 1000;

/// The result of a job. If the job failed or panicked, the error contains the message. If the job was canceled or not
/// started, the error is `None`.
pub(crate) type JobResult<T> = Result<T, Option<String>>;

/// Runs jobs, several at the same time, and passes their results to `each` in the order of the jobs.
pub(crate) fn run_in_order<T: Send>(
    count: usize,
    limits: JobLimits,
    bytes: impl Fn(usize) -> u64 + Sync,
    work: impl Fn(usize) -> T + Sync,
    mut each: impl FnMut(usize, JobResult<T>),
) -> anyhow::Result<()> {
    let stop = is_interrupted;
    let jobs = Jobs {
        count,
        bytes,
        stop,
        work,
    };
    let mut order = InOrder::default();
    jobs.run(limits, |ended| {
        for (i, end) in ended {
            order.put(i, end);
        }
        while let Some((i, end)) = order.take() {
            each(i, job_result(end));
        }
    })?;
    Ok(())
}

/// Runs jobs that need little memory, and returns their results in the order of the jobs.
pub(crate) fn run_all<T: Send>(
    count: usize,
    limits: JobLimits,
    work: impl Fn(usize) -> T + Sync,
) -> anyhow::Result<Vec<JobResult<T>>> {
    let mut results = Vec::with_capacity(count);
    run_in_order(count, limits, |_| 0, work, |_, end| results.push(end))?;
    Ok(results)
}

/// Converts a `JobEnd`, which says how a job ended, to a result.
pub(crate) fn job_result<T>(end: JobEnd<T>) -> JobResult<T> {
    match end {
        JobEnd::Done(result) => Ok(result),
        JobEnd::Panicked(message) => Err(Some(format!(
            "internal error in this run (please report it): {message}"
        ))),
        JobEnd::NotRun => Err(None),
    }
}

/// Returns the message about a job that ended without a result.
pub(crate) fn error_message(message: Option<String>) -> String {
    message.unwrap_or_else(|| "interrupted".to_owned())
}

/// Returns a text with the message of the first error and the number of further errors.
pub(crate) fn first_error(diagnostics: &[Diagnostic]) -> String {
    let errors = diagnostics.iter().filter(|d| d.severity == Severity::Error);
    let first = errors.clone().next();
    let message = first.map_or("failed", |d| d.message.as_str());
    match errors.count() {
        0 | 1 => message.to_owned(),
        n => format!("{message} (and {} more)", n - 1),
    }
}

/// Returns the messages of at most 20 errors, joined by `; `.
pub(crate) fn all_errors(diagnostics: &[Diagnostic]) -> String {
    const MAX: usize = 20;
    let errors = diagnostics.iter().filter(|d| d.severity == Severity::Error);
    let messages: Vec<&str> = errors.map(|d| d.message.as_str()).collect();
    match messages.len() {
        0 => "failed".to_owned(),
        n if n > MAX => format!("{}; and {} more", messages[..MAX].join("; "), n - MAX),
        _ => messages.join("; "),
    }
}

/// Formats a row of comma-separated values according to RFC 4180.
pub(crate) fn csv_line(cells: &[impl AsRef<str>]) -> String {
    let cell = |cell: &str| {
        if cell.contains([',', '"', '\r', '\n']) {
            format!("\"{}\"", cell.replace('"', "\"\""))
        } else {
            cell.to_owned()
        }
    };
    let cells: Vec<String> = cells.iter().map(|text| cell(text.as_ref())).collect();
    cells.join(",") + "\n"
}
