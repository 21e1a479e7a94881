//! The journal of a batch: records finished files, so that an interrupted batch can be resumed.
//!
//! Each line is one JSON object. Lines that are appended together are written with one call. The written lines are
//! synced to disk before further lines are appended. If the last line of a journal is incomplete, it is ignored and
//! overwritten.
//!
//! ```text
//! {"meshwright": "0.1.0", "process": 4711}                 a process started on the batch
//! {"key": "1f2e..", "time": 1767225600000, "row": {..}}    a file is finished or has failed; see row.rs
//! ```
//!
//! The field `key` is a digest of everything on which the field `row` depends. These are the recipe, the parameters,
//! the path and content of every file that is read, the paths of outputs, and the version of the program. For a
//! failure, the key also depends on the memory budget.
//!
//! If a batch is divided into parts, each part writes its own journal, so that several parts can run at the same time.
//! A batch reads the journals of all parts in its folder. Therefore the batch can be resumed with a different number of
//! parts. If several entries are about the same input file, the latest entry is used, because each run replaces the
//! outputs of earlier runs.

use std::collections::HashMap;
use std::collections::hash_map::Entry as Slot;
use std::fs::{File, OpenOptions};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use anyhow::Context as _;
use serde::{Deserialize, Serialize};

use super::row::{Row, json_lines};

/// A row, with the digest of everything that the row depends on.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub(super) struct Entry {
    pub(super) key: String,
    /// The time at which the entry was made, in milliseconds since 1970.
    #[serde(default)]
    time: u64,
    pub(super) row: Row,
}

impl Entry {
    pub(super) fn new(key: String, row: Row) -> Self {
        let time = SystemTime::now().duration_since(UNIX_EPOCH);
        let time = time.map_or(0, |time| time.as_millis());
        Self {
            key,
            time: u64::try_from(time).unwrap_or(u64::MAX),
            row,
        }
    }
}

/// The first line that each process writes to the journal.
#[derive(Deserialize, Serialize)]
struct ProcessStart {
    meshwright: String,
    process: u32,
}

/// An open journal.
pub(super) struct Journal {
    path: PathBuf,
    file: File,
    /// The entries of earlier runs. The key of the map is the path of the input file and the number of the parameter
    /// set.
    pub(super) known: HashMap<(String, usize), Entry>,
    /// The ids of the processes that wrote to the journal in earlier runs of the batch.
    pub(super) processes: Vec<u32>,
}

impl Journal {
    /// Opens the journal of a batch. Creates the file and its folder if they do not exist. Keeps only the entries for
    /// which `is_wanted` returns true.
    pub(super) fn open(path: PathBuf, is_wanted: impl Fn(&Row) -> bool) -> anyhow::Result<Self> {
        let folder = path.parent().unwrap_or(Path::new("."));
        let opened = (|| {
            std::fs::create_dir_all(folder)?;
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
        let others = others(&path).into_iter().map(std::fs::read);
        for (i, bytes) in std::iter::once(Ok(bytes)).chain(others).enumerate() {
            // Another process can remove the journal of another part after the journals were listed. Such a journal
            // counts as empty. Lines that cannot be parsed, such as lines of a different version, are ignored, so the
            // input files of these lines are processed again.
            for line in bytes.unwrap_or_default().split(|&b| b == b'\n') {
                if let Ok(entry) = serde_json::from_slice::<Entry>(line) {
                    if is_wanted(&entry.row) {
                        insert(&mut known, entry);
                    }
                } else if let Ok(start) = serde_json::from_slice::<ProcessStart>(line)
                    && i == 0
                {
                    processes.push(start.process);
                }
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

/// Adds an entry to the map, unless the map has a later entry about the same input file. An entry about this file with
/// an earlier time or the same time is replaced.
fn insert(known: &mut HashMap<(String, usize), Entry>, entry: Entry) {
    let (input, set) = entry.row.key();
    match known.entry((input.to_owned(), set)) {
        Slot::Occupied(earlier) if earlier.get().time > entry.time => {}
        slot => {
            slot.insert_entry(entry);
        }
    }
}

/// Returns the paths of the journals of the other parts of the batch, sorted by name.
fn others(path: &Path) -> Vec<PathBuf> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let is_journal = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let part = name
            .strip_prefix("batch")
            .and_then(|n| n.strip_suffix(".jsonl"));
        part.is_some_and(|part| part.is_empty() || part.starts_with('-') && part.contains("-of-"))
    };
    let mut found: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    found.retain(|other| is_journal(other) && other.file_name() != path.file_name());
    found.sort();
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::batch::row::tests::row;

    #[test]
    fn entries_are_read_back_except_an_incomplete_last_line() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/batch.jsonl");
        let entry = |input: &str| Entry::new(format!("key of {input}"), row(input));
        let mut journal = Journal::open(path.clone(), |_| true).unwrap();
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
            let mut journal = Journal::open(path.clone(), |_| true).unwrap();
            let known =
                |journal: &Journal, input: &str| journal.known.get(&(input.to_owned(), 0)).cloned();
            assert_eq!(known(&journal, "a\n\"é").unwrap().row, row("a\n\"é"));
            assert_eq!(known(&journal, "b").unwrap().key, "key of b");
            assert!(known(&journal, "c").is_none());
            journal.append(&[entry("d")]).unwrap();
            let journal = Journal::open(path.clone(), |_| true).unwrap();
            assert!(known(&journal, "b").is_some() && known(&journal, "d").is_some());
            assert_eq!(journal.processes.len(), 2);
        }
    }

    #[test]
    fn the_latest_entry_of_all_journals_counts() {
        let folder = tempfile::tempdir().unwrap();
        let open = |name: &str| Journal::open(folder.path().join(name), |row| row.input != "c");
        let entry = |key: &str, time: u64, input: &str| Entry {
            key: key.to_owned(),
            time,
            row: row(input),
        };
        for (name, entries) in [
            ("batch.jsonl", [entry("old", 1, "a"), entry("new", 4, "b")]),
            (
                "batch-1-of-2.jsonl",
                [entry("new", 2, "a"), entry("old", 3, "b")],
            ),
            ("batch-2-of-3.jsonl", [entry("", 9, "c"), entry("", 9, "d")]),
            ("batches.jsonl", [entry("", 9, "e"), entry("", 9, "f")]),
        ] {
            open(name).unwrap().append(&entries).unwrap();
        }
        for name in ["batch.jsonl", "batch-1-of-2.jsonl", "batch-7-of-9.jsonl"] {
            let journal = open(name).unwrap();
            let mut known: Vec<&str> = journal
                .known
                .keys()
                .map(|(input, _)| input.as_str())
                .collect();
            known.sort_unstable();
            assert_eq!(known, ["a", "b", "d"]);
            for input in ["a", "b"] {
                assert_eq!(journal.known[&(input.to_owned(), 0)].key, "new");
            }
        }
    }
}
