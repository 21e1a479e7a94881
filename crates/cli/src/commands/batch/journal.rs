//! The journal of a batch: what is done, so that a batch that was ended goes on where it was.
//!
//! A file of lines, each one JSON object. A line is written in one piece and is on the disk before the
//! next; a last line that is torn is passed over and overwritten.
//!
//! ```text
//! {"meshwright": "0.1.0", "process": 4711}       a batch began
//! {"key": "1f2e..", "row": {..}}                 a file is done, or has failed; row.rs says the rest
//! ```
//!
//! The key is a digest of everything that the row depends on: recipe, parameters, the path and the
//! content of every file that is read, the paths of outputs, the version of the program, and for a failure
//! the budget.

use std::collections::HashMap;
use std::fs::{File, OpenOptions};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use serde::{Deserialize, Serialize};

use super::row::{Row, json_lines};

/// A row and what it depends on.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct Entry {
    pub(super) key: String,
    pub(super) row: Row,
}

#[derive(Deserialize, Serialize)]
struct Begin {
    meshwright: String,
    process: u32,
}

/// An open journal.
pub(super) struct Journal {
    path: PathBuf,
    file: File,
    /// What was done before, by the path of the input.
    pub(super) known: HashMap<String, Entry>,
    /// The processes that wrote it before.
    pub(super) processes: Vec<u32>,
}

impl Journal {
    /// Opens the journal of a batch, and makes it and its folder if they are not there.
    pub(super) fn open(path: PathBuf) -> anyhow::Result<Self> {
        let opened = (|| {
            std::fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
            let mut options = OpenOptions::new();
            options.read(true).write(true).create(true).truncate(false);
            let mut file = options.open(&path)?;
            if !file.metadata()?.is_file() {
                return Err(std::io::Error::other("it is no file"));
            }
            let mut bytes = Vec::new();
            file.read_to_end(&mut bytes)?;
            let whole = bytes.iter().rposition(|&b| b == b'\n').map_or(0, |i| i + 1);
            bytes.truncate(whole);
            file.set_len(whole as u64)?;
            file.seek(SeekFrom::End(0))?;
            std::io::Result::Ok((file, bytes))
        })();
        let (file, bytes) =
            opened.with_context(|| format!("cannot open the journal {}", path.display()))?;
        let (mut known, mut processes) = (HashMap::new(), Vec::new());
        // What cannot be read was written by another version, or not at all: it is done again.
        for line in bytes.split(|&b| b == b'\n') {
            if let Ok(entry) = serde_json::from_slice::<Entry>(line) {
                known.insert(entry.row.input.clone(), entry);
            } else if let Ok(begin) = serde_json::from_slice::<Begin>(line) {
                processes.push(begin.process);
            }
        }
        let mut journal = Self {
            path,
            file,
            known,
            processes,
        };
        journal.note(&[Begin {
            meshwright: env!("CARGO_PKG_VERSION").to_owned(),
            process: std::process::id(),
        }])?;
        Ok(journal)
    }

    /// Takes note of files that are done.
    pub(super) fn note(&mut self, entries: &[impl Serialize]) -> anyhow::Result<()> {
        if entries.is_empty() {
            return Ok(());
        }
        let text = json_lines(entries)?;
        let written = self.file.write_all(&text);
        let written = written.and_then(|()| self.file.sync_data());
        written.with_context(|| format!("cannot write the journal {}", self.path.display()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::batch::row::tests::row;

    #[test]
    fn what_is_noted_is_known_later_and_a_torn_line_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/batch.jsonl");
        let entry = |input: &str| Entry {
            key: format!("key of {input}"),
            row: row(input),
        };
        let mut journal = Journal::open(path.clone()).unwrap();
        journal.note(&[entry("a\n\"é"), entry("b")]).unwrap();
        drop(journal);
        let whole = std::fs::read(&path).unwrap();
        for torn in 0..60 {
            let mut bytes = whole.clone();
            bytes.extend(serde_json::to_vec(&entry("c")).unwrap().iter().take(torn));
            std::fs::write(&path, bytes).unwrap();
            let mut journal = Journal::open(path.clone()).unwrap();
            assert_eq!(journal.known["a\n\"é"].row, row("a\n\"é"));
            assert_eq!(journal.known["b"].key, "key of b");
            assert!(!journal.known.contains_key("c"));
            journal.note(&[entry("d")]).unwrap();
            let journal = Journal::open(path.clone()).unwrap();
            assert!(journal.known.contains_key("b") && journal.known.contains_key("d"));
            assert_eq!(journal.processes.len(), 2);
        }
    }
}
