//! `meshwright batch --merge`: merges the reports of several parts.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{bail, ensure};
use mesh::counted;

use super::row::{Header, Report, Row, State};
use crate::args::BatchArgs;
use crate::output::{escape_control, print, print_error};

pub(super) fn run(args: &BatchArgs) -> anyhow::Result<bool> {
    let Some(target) = &args.report else {
        bail!("expected --report FILE for the merged report");
    };
    let mut reports = Vec::new();
    for path in &args.merge {
        reports.push((path.as_path(), Report::read(path)?));
    }
    let merged = merge(&reports)?;
    merged.write(target)?;
    let header = &merged.header;
    for missing in &header.missing_shards {
        let of = n_parts(&reports).unwrap_or_default();
        print_error(&format!(
            "error: the report of part {missing}/{of} of the batch is missing\n"
        ));
    }
    print(&format!(
        "{}, {}: {} ok, {} failed, {} not processed\n",
        counted(reports.len(), "report"),
        counted(merged.rows.len(), "file"),
        header.ok,
        header.failed,
        header.skipped
    ))?;
    Ok(header.failed == 0 && header.skipped == 0 && header.missing_shards.is_empty())
}

/// Returns the number of parts of the batch, as recorded in the first report that covers only one part.
fn n_parts(reports: &[(&Path, Report)]) -> Option<u32> {
    let shards = reports.iter().filter_map(|(_, r)| r.header.shard);
    shards.map(|shard| shard.of).next()
}

/// Merges reports. If two rows about the same input file and parameter set contradict each other, prints the rows and
/// fails.
fn merge(reports: &[(&Path, Report)]) -> anyhow::Result<Report> {
    let Some((first_path, first)) = reports.first() else {
        bail!("expected at least one report to merge");
    };
    for (path, report) in reports {
        let what = difference(&first.header, &report.header);
        ensure!(
            what.is_none(),
            "{} and {} have {}, so they are not parts of one batch",
            first_path.display(),
            path.display(),
            what.unwrap_or_default()
        );
    }
    let mut rows: BTreeMap<(&str, usize), (&Path, &Row)> = BTreeMap::new();
    let mut contradictions = 0;
    for (path, report) in reports {
        for row in &report.rows {
            match rows.get(&row.key()) {
                // A file that is skipped in one report can be processed in another report. This is not a contradiction.
                Some(_) if row.state == State::Skipped => {}
                Some((_, earlier)) if earlier.state == State::Skipped => {
                    rows.insert(row.key(), (path, row));
                }
                Some((other, earlier)) if !earlier.is_same(row) => {
                    contradictions += 1;
                    print_error(&format!(
                        "error: {} is {} in {} and {} in {}\n",
                        escape_control(&row.label()),
                        description(earlier),
                        other.display(),
                        description(row),
                        path.display()
                    ));
                }
                Some(_) => {}
                None => {
                    rows.insert(row.key(), (path, row));
                }
            }
        }
    }
    ensure!(
        contradictions == 0,
        "{} between the reports, so no merged report was written: leave out the outdated reports",
        counted(contradictions, "contradiction")
    );
    let missing = n_parts(reports).map_or(Vec::new(), |of| {
        let has = |index: u32| {
            let mut shards = reports.iter().map(|(_, r)| r.header.shard);
            // If the header of a report names no part, the report covers the whole batch.
            shards.any(|s| s.is_none_or(|s| s.index == index))
        };
        (1..=of).filter(|&index| !has(index)).collect()
    });
    let header = Header {
        shard: None,
        missing_shards: missing,
        ..first.header.clone()
    };
    let rows = rows.into_values().map(|(_, row)| row.clone()).collect();
    Ok(Report::new(header, rows))
}

/// If two reports belong to different batches, returns a phrase that names the difference, such as `different recipes`.
fn difference(a: &Header, b: &Header) -> Option<&'static str> {
    if a.recipe_digest != b.recipe_digest {
        Some("different recipes")
    } else if a.set != b.set || a.preset != b.preset {
        Some("different parameter values")
    } else if a.meshwright != b.meshwright {
        Some("different versions of the program")
    } else if a.listed_digest != b.listed_digest {
        Some("different lists of files")
    } else if matches!((a.shard, b.shard), (Some(a), Some(b)) if a.of != b.of) {
        Some("different numbers of parts")
    } else {
        None
    }
}

/// Returns a description of a row, for the error message about rows that contradict each other.
fn description(row: &Row) -> String {
    match (&row.message, &row.digest) {
        (Some(message), _) => format!("{} ({})", row.state.name(), escape_control(message)),
        (None, Some(digest)) => format!("{} (digest {digest})", row.state.name()),
        (None, None) => row.state.name().to_owned(),
    }
}
