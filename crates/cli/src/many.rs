//! What commands that run many recipes at once share.

use recipe::{Diagnostic, InOrder, JobEnd, JobLimits, Jobs, Severity};

use crate::listener::is_interrupted;

/// How many runs are checked before the first of them begins: what is known of each stays in memory.
pub(crate) const CHECKED_AHEAD: usize = 1000;

/// The result of a job; or why it has none: the message of a panic, or nothing if it was not begun.
pub(crate) type Ended<T> = Result<T, Option<String>>;

/// Does jobs, several at once, and hands over their results in the order of the jobs.
pub(crate) fn in_order<T: Send>(
    count: usize,
    limits: JobLimits,
    bytes: impl Fn(usize) -> u64 + Sync,
    work: impl Fn(usize) -> T + Sync,
    mut each: impl FnMut(usize, Ended<T>),
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
            each(i, result(end));
        }
    })?;
    Ok(())
}

/// Does jobs that take little memory, and returns their results in the order of the jobs.
pub(crate) fn all<T: Send>(
    count: usize,
    limits: JobLimits,
    work: impl Fn(usize) -> T + Sync,
) -> anyhow::Result<Vec<Ended<T>>> {
    let mut results = Vec::with_capacity(count);
    in_order(count, limits, |_| 0, work, |_, end| results.push(end))?;
    Ok(results)
}

/// How a job ended, as a result.
pub(crate) fn result<T>(end: JobEnd<T>) -> Ended<T> {
    match end {
        JobEnd::Done(result) => Ok(result),
        JobEnd::Panicked(message) => Err(Some(format!(
            "the program panicked in this run, which is a bug in it: {message}"
        ))),
        JobEnd::NotRun => Err(None),
    }
}

/// What is said of a job that was not begun, or did not end.
pub(crate) fn interrupted(message: Option<String>) -> String {
    message.unwrap_or_else(|| "interrupted".to_owned())
}

/// The first error in one line, and how many more there are.
pub(crate) fn first_error(diagnostics: &[Diagnostic]) -> String {
    let errors = diagnostics.iter().filter(|d| d.severity == Severity::Error);
    let first = errors.clone().next();
    let message = first.map_or("failed", |d| d.message.as_str());
    match errors.count() {
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
