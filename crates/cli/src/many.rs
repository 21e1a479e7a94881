//! What commands that run many recipes at once share.

use recipe::{Diagnostic, JobEnd, JobLimits, Jobs, Severity};

use crate::listener::is_interrupted;

/// How many runs are checked before the first of them begins: what is known of each stays in memory.
pub(crate) const CHECKED_AHEAD: usize = 1000;

/// Does jobs that take little memory, and returns their ends in the order of the jobs.
pub(crate) fn all<T: Send>(
    count: usize,
    limits: JobLimits,
    work: impl Fn(usize) -> T + Sync,
) -> anyhow::Result<Vec<JobEnd<T>>> {
    let jobs = Jobs {
        count,
        bytes: |_| 0,
        stop: is_interrupted,
        work,
    };
    let mut ends: Vec<(usize, JobEnd<T>)> = Vec::with_capacity(count);
    jobs.run(limits, |ended| ends.extend(ended))?;
    ends.sort_by_key(|(job, _)| *job);
    Ok(ends.into_iter().map(|(_, end)| end).collect())
}

/// What is said of a run that panicked.
pub(crate) fn panicked(message: &str) -> String {
    format!("the program panicked in this run, which is a bug in it: {message}")
}

/// The first error in one line, and how many more there are.
pub(crate) fn first_error(diagnostics: &[Diagnostic]) -> String {
    let errors = || {
        let is_error = |d: &&Diagnostic| d.severity == Severity::Error;
        diagnostics.iter().filter(is_error)
    };
    let message = errors().next().map_or("failed", |d| d.message.as_str());
    match errors().count() {
        0 | 1 => message.to_owned(),
        n => format!("{message} (and {} more)", n - 1),
    }
}

/// A line of a table of comma-separated values, as RFC 4180 has it.
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
