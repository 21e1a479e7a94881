//! `meshwright batch --estimate N`: estimates the memory of N parts, and runs nothing. With this estimate, the
//! scheduler of a cluster can reserve memory for each part of the batch. `--report FILE.json` writes the estimates as
//! one JSON object:
//!
//! ```text
//! {"parts": [{"part": 1, "runs": 12, "bytes": 34603008}]}
//! ```
//!
//! A part can have several runs. `bytes` is the largest estimate for one of these runs. A process that makes one run at
//! a time (`--threads 1`) needs this memory.

use anyhow::ensure;
use mesh::counted;
use op::readable_bytes;
use recipe::Forecast;
use serde::Serialize;

use super::plan::Batch;
use crate::listener::is_interrupted;
use crate::many::run_all;
use crate::output::{print, write_atomically};

/// The estimated memory of one part of the batch.
#[derive(Clone, Debug, Default, Serialize)]
struct Memory {
    part: u32,
    runs: usize,
    bytes: u64,
}

#[derive(Serialize)]
struct Estimate {
    parts: Vec<Memory>,
}

/// Estimates the memory of `n` parts. A run whose recipe has errors counts as 0 bytes, because it is not started.
pub(super) fn run(batch: &Batch, n: u32) -> anyhow::Result<bool> {
    let args = batch.args;
    if let Some(path) = &args.report {
        ensure!(
            path.extension().is_some_and(|e| e == "json"),
            "{}: expected a file with the extension .json for the estimate",
            path.display()
        );
    }
    let files = batch.files_of_part();
    let all = run_all(files.len(), args.many.limits(), |i| {
        let loaded = batch.load(files[i]).ok().filter(|l| !l.has_errors());
        loaded.map_or(0, |loaded| memory(&loaded.forecast, args.many.budget))
    })?;
    ensure!(!is_interrupted(), "interrupted");
    let parts = (1..=n).map(|part| Memory {
        part,
        ..Memory::default()
    });
    let mut parts: Vec<Memory> = parts.collect();
    for (file, bytes) in files.iter().zip(all) {
        if let Some(part) = parts.get_mut(file.part(n) as usize - 1) {
            part.runs += 1;
            part.bytes = part.bytes.max(bytes.unwrap_or(0));
        }
    }
    let line = |p: &Memory| {
        let (part, runs) = (p.part, counted(p.runs, "run"));
        format!("part {part}/{n}: {runs}, {}\n", readable_bytes(p.bytes))
    };
    print(&parts.iter().map(line).collect::<String>())?;
    if let Some(path) = &args.report {
        let text = serde_json::to_vec_pretty(&Estimate { parts })?;
        write_atomically(path, &[text, b"\n".to_vec()].concat())?;
    }
    Ok(true)
}

/// Returns the estimated memory of a run: the peak memory of the forecast, plus the memory of a copy of the meshes. The
/// copy is included because the old and the new meshes are both in memory during a step. Between two consecutive steps,
/// the copy counts as the smaller of the two forecasts for these steps. The largest copy is added to the peak memory.
/// The peak memory and the copy are each limited to the memory budget, because meshes cannot exceed the budget.
fn memory(forecast: &Forecast, budget: u64) -> u64 {
    let steps = forecast.steps.windows(2);
    let smaller = steps.map(|pair| pair[0].bytes.max.min(pair[1].bytes.max));
    // If the memory of both steps of a pair has no upper limit, the pair is skipped. In this case, `peak_bytes` already
    // includes an edited copy of the meshes.
    let copy = smaller.filter(|&bytes| bytes < u64::MAX).max();
    forecast.peak_bytes().min(budget) + copy.unwrap_or(0).min(budget)
}
