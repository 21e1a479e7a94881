//! `meshwright batch --merge`: joins the reports of parts.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{bail, ensure};

use super::row::{Header, Report, Row, State};
use crate::args::BatchArgs;
use crate::output::{complain, print, shown};

pub(super) fn run(args: &BatchArgs) -> anyhow::Result<bool> {
    let Some(target) = &args.report else {
        bail!("expected --report FILE: where the joined report goes");
    };
    let mut reports = Vec::new();
    for path in &args.merge {
        reports.push((path.as_path(), Report::read(path)?));
    }
    let joined = join(&reports)?;
    joined.write(target)?;
    let header = &joined.header;
    for missing in &header.missing_shards {
        let of = parts(&reports).unwrap_or_default();
        complain(&format!(
            "error: the report of part {missing}/{of} is missing\n"
        ));
    }
    print(&format!(
        "{} reports, {} files: {} ok, {} failed, {} not done\n",
        reports.len(),
        joined.rows.len(),
        header.ok,
        header.failed,
        header.skipped
    ))?;
    Ok(header.failed == 0 && header.skipped == 0 && header.missing_shards.is_empty())
}

/// Of how many parts the first report that is a part is one.
fn parts(reports: &[(&Path, Report)]) -> Option<u32> {
    let shards = reports.iter().filter_map(|(_, r)| r.header.shard);
    shards.map(|shard| shard.of).next()
}

/// Joins reports, and says which rows contradict each other.
fn join(reports: &[(&Path, Report)]) -> anyhow::Result<Report> {
    let Some((first_path, first)) = reports.first() else {
        bail!("expected a report to join");
    };
    for (path, report) in reports {
        let what = difference(&first.header, &report.header);
        ensure!(
            what.is_none(),
            "{} and {} have {}: they are no parts of one batch",
            first_path.display(),
            path.display(),
            what.unwrap_or_default()
        );
    }
    let mut rows: BTreeMap<&str, (&Path, &Row)> = BTreeMap::new();
    let mut contradictions = 0;
    for (path, report) in reports {
        for row in &report.rows {
            match rows.get(row.input.as_str()) {
                // What was not done in one is done in the other.
                Some(_) if row.state == State::Skipped => {}
                Some((_, earlier)) if earlier.state == State::Skipped => {
                    rows.insert(&row.input, (path, row));
                }
                Some((other, earlier)) if !earlier.is_same(row) => {
                    contradictions += 1;
                    complain(&format!(
                        "error: {} is {} in {} and {} in {}\n",
                        shown(&row.input),
                        account(earlier),
                        other.display(),
                        account(row),
                        path.display()
                    ));
                }
                Some(_) => {}
                None => {
                    rows.insert(&row.input, (path, row));
                }
            }
        }
    }
    ensure!(
        contradictions == 0,
        "{contradictions} contradictions, no report was written: leave out the reports that are not true any more"
    );
    let missing = parts(reports).map_or(Vec::new(), |of| {
        let has = |index: u32| {
            let mut shards = reports.iter().map(|(_, r)| r.header.shard);
            // A report of everything has every part.
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

/// What tells two batches apart.
fn difference(a: &Header, b: &Header) -> Option<&'static str> {
    if a.recipe_digest != b.recipe_digest {
        Some("different recipes")
    } else if a.set != b.set || a.preset != b.preset {
        Some("different values of parameters")
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

/// What is said of a row that another contradicts.
fn account(row: &Row) -> String {
    match (&row.message, &row.digest) {
        (Some(message), _) => format!("{} ({})", row.state.name(), shown(message)),
        (None, Some(digest)) => format!("{} (digest {digest})", row.state.name()),
        (None, None) => row.state.name().to_owned(),
    }
}
