//! The rows of a batch, and its reports.
//!
//! `--report FILE.json` writes one JSON object. The first line of a `.jsonl` report is the same object without the
//! field `rows`. Each further line is one row. A report with the extension `.csv` has only the rows. If an entry of
//! this table is a list, the items are joined by `; `.
//!
//! ```text
//! {
//!   "batch": 1, "meshwright": "0.1.0",
//!   "recipe": "clean.ron", "recipe_digest": "..",
//!   "preset": null, "set": {"ratio": "0.5"},
//!   "shard": {"index": 1, "of": 3},       null if the batch is not divided
//!   "listed": 12, "listed_digest": "..",  the input files of all parts
//!   "missing_shards": [],                 parts whose reports were not merged
//!   "ok": 10, "failed": 2, "skipped": 0,
//!   "rows": [{
//!     "input": "models/cow.obj",
//!     "state": "ok",                      or "failed", or "skipped": not processed because of Ctrl-C
//!     "step": null, "message": null,      the failed step and its errors, joined by `; `
//!     "vertices": 8, "edges": 12, "faces": 6,     at the end, or before the failed step
//!     "digest": "..",
//!     "losses": [".."],
//!     "outputs": [{"path": "out/cow.glb", "bytes": 1200}],
//!     "seconds": 0.01,
//!     "set": null, "values": {}           with `--sets`, the number of the parameter set and its values
//!   }]
//! }
//! ```

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context as _, bail, ensure};
use serde::{Deserialize, Serialize};

use super::inputs::Input;
use super::sets::label;
use crate::args::Shard;
use crate::many::csv_line;
use crate::output::write_atomically;

/// The result of the run on one input file: one row of the report.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(expecting = "an object")]
pub(super) struct Row {
    pub(super) input: String,
    pub(super) state: State,
    pub(super) step: Option<String>,
    pub(super) message: Option<String>,
    pub(super) vertices: Option<usize>,
    pub(super) edges: Option<usize>,
    pub(super) faces: Option<usize>,
    pub(super) digest: Option<String>,
    pub(super) losses: Vec<String>,
    pub(super) outputs: Vec<Output>,
    pub(super) seconds: f64,
    #[serde(default)]
    pub(super) set: Option<usize>,
    #[serde(default)]
    pub(super) values: BTreeMap<String, String>,
}

#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum State {
    Ok,
    Failed,
    #[default]
    Skipped,
}

/// A file that was written.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(expecting = "an object")]
pub(super) struct Output {
    pub(super) path: String,
    pub(super) bytes: u64,
}

impl Row {
    /// Creates a row that has no element counts and no outputs.
    pub(super) fn without_outputs(input: &Input, state: State, message: Option<String>) -> Self {
        let set = input.set.clone();
        Self {
            input: input.path.clone(),
            state,
            message,
            set: set.as_ref().map(|set| set.number),
            values: set.map(|set| set.values).unwrap_or_default(),
            ..Self::default()
        }
    }

    /// Returns the input file and the number of its parameter set, or 0 if there is no parameter set. No two rows of a
    /// batch have the same key.
    pub(super) fn key(&self) -> (&str, usize) {
        (&self.input, self.set.unwrap_or(0))
    }

    /// Returns a text that names the input file and the parameter values.
    pub(super) fn label(&self) -> String {
        label(&self.input, &self.values)
    }

    /// Whether two rows are equal, apart from the time that the run took.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        let mut other = other.clone();
        other.seconds = self.seconds;
        *self == other
    }

    /// Whether all outputs of the row still exist and have their recorded sizes.
    pub(super) fn has_outputs(&self) -> bool {
        self.outputs.iter().all(|output| {
            let file = Path::new(&output.path).metadata();
            file.is_ok_and(|m| m.is_file() && m.len() == output.bytes)
        })
    }

    fn cells(&self) -> [String; 13] {
        let number = |n: Option<usize>| n.map(|n| n.to_string()).unwrap_or_default();
        let text = |text: &Option<String>| text.clone().unwrap_or_default();
        let outputs: Vec<&str> = self.outputs.iter().map(|o| o.path.as_str()).collect();
        [
            self.input.clone(),
            self.state.name().to_owned(),
            text(&self.step),
            text(&self.message),
            number(self.vertices),
            number(self.edges),
            number(self.faces),
            text(&self.digest),
            self.losses.join("; "),
            outputs.join("; "),
            format!("{:.6}", self.seconds),
            number(self.set),
            label("", &self.values),
        ]
    }
}

const COLUMNS: [&str; 13] = [
    "input", "state", "step", "message", "vertices", "edges", "faces", "digest", "losses",
    "outputs", "seconds", "set", "values",
];

impl State {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Failed => "failed",
            Self::Skipped => "skipped",
        }
    }
}

/// The description of the batch to which the rows belong, and the number of rows in each state.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
#[serde(expecting = "an object")]
pub(super) struct Header {
    pub(super) batch: u32,
    pub(super) meshwright: String,
    pub(super) recipe: String,
    pub(super) recipe_digest: String,
    pub(super) preset: Option<String>,
    pub(super) set: BTreeMap<String, String>,
    pub(super) shard: Option<Shard>,
    pub(super) listed: usize,
    pub(super) listed_digest: String,
    #[serde(default)]
    pub(super) missing_shards: Vec<u32>,
    #[serde(default)]
    pub(super) ok: usize,
    #[serde(default)]
    pub(super) failed: usize,
    #[serde(default)]
    pub(super) skipped: usize,
}

/// A report of a batch, or of one part of a batch.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(expecting = "an object")]
pub(super) struct Report {
    #[serde(flatten)]
    pub(super) header: Header,
    pub(super) rows: Vec<Row>,
}

/// The file formats of reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ReportFormat {
    Csv,
    Json,
    JsonLines,
}

impl ReportFormat {
    /// Returns the format that belongs to the extension of a path.
    pub(super) fn of(path: &Path) -> anyhow::Result<Self> {
        match path.extension().and_then(|e| e.to_str()) {
            Some("csv") => Ok(Self::Csv),
            Some("json") => Ok(Self::Json),
            Some("jsonl") => Ok(Self::JsonLines),
            _ => bail!(
                "{}: expected a report with the extension .csv, .json or .jsonl",
                path.display()
            ),
        }
    }
}

impl Report {
    /// Creates a report, and counts its rows by state.
    pub(super) fn new(mut header: Header, rows: Vec<Row>) -> Self {
        let count = |state| rows.iter().filter(|row| row.state == state).count();
        header.ok = count(State::Ok);
        header.failed = count(State::Failed);
        header.skipped = count(State::Skipped);
        Self { header, rows }
    }

    /// Writes the report in the format given by the extension of the path.
    pub(super) fn write(&self, path: &Path) -> anyhow::Result<()> {
        let bytes = match ReportFormat::of(path)? {
            ReportFormat::Csv => {
                let rows = self.rows.iter().map(|row| csv_line(&row.cells()));
                let lines = std::iter::once(csv_line(&COLUMNS)).chain(rows);
                lines.collect::<String>().into_bytes()
            }
            ReportFormat::Json => [serde_json::to_vec_pretty(self)?, b"\n".to_vec()].concat(),
            ReportFormat::JsonLines => {
                let mut text = json_lines(&[&self.header])?;
                text.extend(json_lines(&self.rows)?);
                text
            }
        };
        write_atomically(path, &bytes)
    }

    /// Reads a report in the format JSON or JSON Lines.
    pub(super) fn read(path: &Path) -> anyhow::Result<Self> {
        let shown = path.display();
        let form = ReportFormat::of(path)?;
        ensure!(
            form != ReportFormat::Csv,
            "{shown}: reports in .csv cannot be merged, since they do not record their batch: use .json or .jsonl"
        );
        let text = std::fs::read_to_string(path).with_context(|| format!("cannot read {shown}"))?;
        let not_a_report = || format!("{shown} is not a report of a batch");
        if form == ReportFormat::Json {
            return serde_json::from_str(&text).with_context(not_a_report);
        }
        let mut lines = text.lines().enumerate();
        let (_, first) = lines.next().with_context(not_a_report)?;
        let header = serde_json::from_str(first).with_context(not_a_report)?;
        let row = |(i, line): (usize, &str)| {
            let row: Result<Row, _> = serde_json::from_str(line);
            row.with_context(|| format!("{shown}:{}: expected a row of a batch", i + 1))
        };
        let rows = lines.map(row).collect::<anyhow::Result<_>>()?;
        Ok(Self { header, rows })
    }
}

/// Formats values as JSON, one per line.
pub(super) fn json_lines(values: &[impl Serialize]) -> serde_json::Result<Vec<u8>> {
    let mut text = Vec::new();
    for value in values {
        serde_json::to_writer(&mut text, value)?;
        text.push(b'\n');
    }
    Ok(text)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(in crate::commands::batch) fn row(input: &str) -> Row {
        Row {
            vertices: Some(8),
            losses: vec!["Save: cube lost \"a\", b".to_owned()],
            outputs: vec![Output {
                path: "out/a b.glb".to_owned(),
                bytes: 12,
            }],
            seconds: 0.25,
            input: input.to_owned(),
            state: State::Ok,
            ..Row::default()
        }
    }

    fn report() -> Report {
        let header = Header {
            batch: 1,
            meshwright: "0.1.0".to_owned(),
            recipe: "a.ron".to_owned(),
            recipe_digest: "d".to_owned(),
            preset: None,
            set: BTreeMap::from([("x".to_owned(), "1".to_owned())]),
            shard: Some(Shard { index: 2, of: 3 }),
            listed: 9,
            listed_digest: "l".to_owned(),
            ..Header::default()
        };
        Report::new(header, vec![row("a, \"b\"\nc.obj"), row("é.obj")])
    }

    #[test]
    fn reports_are_read_back_unchanged() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["a.json", "a.jsonl"] {
            let path = folder.path().join(name);
            report().write(&path).unwrap();
            assert_eq!(Report::read(&path).unwrap(), report());
        }
        let path = folder.path().join("a.csv");
        report().write(&path).unwrap();
        let mut table = csv::Reader::from_path(&path).unwrap();
        assert_eq!(table.headers().unwrap().len(), 13);
        let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
        assert_eq!(&rows[0][0], "a, \"b\"\nc.obj");
        assert_eq!(&rows[1][9], "out/a b.glb");
        assert!(Report::read(&path).is_err());
    }
}
