//! The journal of a batch: records finished files, so that an interrupted batch can be resumed.
//!
//! Each line is one JSON object. Lines that are appended together are written in one piece and synced to disk before
//! the next lines are written. An incomplete last line is ignored and overwritten.
//!
//! ```text
//! {"meshwright": "0.1.0", "process": 4711}       a process started on the batch
//! {"key": "1f2e..", "row": {..}}                 a file is finished or has failed; see row.rs
//! ```
//!
//! The key is a digest of everything that the row depends on: the recipe, the parameters, the path and content of
//! every file that is read, the paths of outputs, the version of the program, and for failures the memory budget.

use std::collections::HashMap;
use std::fs::{File, OpenOptions};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use serde::{Deserialize, Serialize};

use super::row::{Row, json_lines};

/// A row, with the digest of everything that the row depends on.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct Entry {
    pub(super) key: String,
    pub(super) row: Row,
}

/// The first line that each process writes.
#[derive(Deserialize, Serialize)]
struct ProcessStart {
    meshwright: String,
    process: u32,
}

/// An open journal.
pub(super) struct Journal {
    path: PathBuf,
    file: File,
    /// The entries of earlier runs, by the path of the input and the number of the parameter set.
    pub(super) known: HashMap<(String, usize), Entry>,
    /// The ids of the processes that wrote to the journal before.
    pub(super) processes: Vec<u32>,
}

impl Journal {
    /// Opens the journal of a batch. Creates the file and its folder if they do not exist.
    pub(super) fn open(path: PathBuf) -> anyhow::Result<Self> {
        let opened = (|| {
            std::fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
            let mut options = OpenOptions::new();
            options.read(true).write(true).create(true).truncate(false);
            let mut file = options.open(&path)?;
            if !file.metadata()?.is_file() {
                return Err(std::io::Error::other("not a file"));
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
        // Lines of a different version that cannot be parsed are ignored, so their files are processed again.
        for line in bytes.split(|&b| b == b'\n') {
            if let Ok(entry) = serde_json::from_slice::<Entry>(line) {
                let (input, set) = entry.row.key();
                known.insert((input.to_owned(), set), entry);
            } else if let Ok(start) = serde_json::from_slice::<ProcessStart>(line) {
                processes.push(start.process);
            }
        }
        let mut journal = Self {
            path,
            file,
            known,
            processes,
        };
        journal.append(&[ProcessStart {
            meshwright: env!("CARGO_PKG_VERSION").to_owned(),
            process: std::process::id(),
        }])?;
        Ok(journal)
    }

    /// Appends entries, and syncs them to disk.
    pub(super) fn append(&mut self, entries: &[impl Serialize]) -> anyhow::Result<()> {
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
    fn entries_are_read_back_except_an_incomplete_last_line() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/batch.jsonl");
        let entry = |input: &str| Entry {
            key: format!("key of {input}"),
            row: row(input),
        };
        let mut journal = Journal::open(path.clone()).unwrap();
        journal.append(&[entry("a\n\"é"), entry("b")]).unwrap();
        drop(journal);
        let whole = std::fs::read(&path).unwrap();
        for n_bytes in 0..60 {
            let mut bytes = whole.clone();
            bytes.extend(
                serde_json::to_vec(&entry("c"))
                    .unwrap()
                    .iter()
                    .take(n_bytes),
            );
            std::fs::write(&path, bytes).unwrap();
            let mut journal = Journal::open(path.clone()).unwrap();
            let known =
                |journal: &Journal, input: &str| journal.known.get(&(input.to_owned(), 0)).cloned();
            assert_eq!(known(&journal, "a\n\"é").unwrap().row, row("a\n\"é"));
            assert_eq!(known(&journal, "b").unwrap().key, "key of b");
            assert!(known(&journal, "c").is_none());
            journal.append(&[entry("d")]).unwrap();
            let journal = Journal::open(path.clone()).unwrap();
            assert!(known(&journal, "b").is_some() && known(&journal, "d").is_some());
            assert_eq!(journal.processes.len(), 2);
        }
    }
}
