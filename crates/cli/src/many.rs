//! What commands that run many recipes at once share.

use recipe::{JobEnd, JobLimits, Jobs, Outcome, Settings};

use crate::listener::{Quiet, is_interrupted};
use crate::loading::{Loaded, read_objects};

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

/// Runs a recipe that can run, without a word, until Ctrl-C.
pub(crate) fn run_quietly(loaded: &Loaded, budget: u64, keep_outputs: bool) -> Outcome {
    let settings = Settings {
        files: &loaded.files,
        budget,
        read: &read_objects,
        keep_outputs,
        writes: !loaded.forecast.outputs.is_empty(),
    };
    recipe::run(&loaded.recipe, settings, &Quiet)
}

/// What is said of a run that panicked.
pub(crate) fn panicked(message: &str) -> String {
    format!("the program panicked in this run, which is a bug in it: {message}")
}
