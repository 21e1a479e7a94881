//! Measures the size of a cache, and keeps the size below its limit.

use std::fs::{self, DirEntry, Metadata, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use crate::CacheSize;
use crate::folder::{Folder, Kind, Unusable, write_all};

/// The maximum age of temporary files. Older temporary files were left by killed processes and are removed.
const MAX_TEMPORARY_AGE: Duration = Duration::from_secs(3600);
/// The maximum length of the file `sizes`, in bytes. The file lists how many bytes each run has stored. If the file
/// `sizes` is longer, the total size of the cache is measured again, and this size replaces the list.
const MAX_SIZES_LEN: u64 = 1 << 16;

struct Entry {
    path: PathBuf,
    kind: Kind,
    len: u64,
    used: SystemTime,
}

/// Lists the files of the cache that hold steps, blobs and recipes. Files that are still being written are not listed.
fn entries(folder: &Folder) -> io::Result<Vec<Entry>> {
    let mut entries = Vec::new();
    for kind in Kind::ALL {
        for part in list(&folder.root().join(kind.name()))? {
            for file in list(&part.path())? {
                // Another process may have removed the file.
                if let Ok(meta) = file.metadata()
                    && meta.is_file()
                {
                    entries.push(Entry {
                        path: file.path(),
                        kind,
                        len: meta.len(),
                        used: modified(&meta),
                    });
                }
            }
        }
    }
    Ok(entries)
}

fn modified(meta: &Metadata) -> SystemTime {
    meta.modified().unwrap_or(SystemTime::UNIX_EPOCH)
}

/// Lists a folder. A missing folder, or a file in place of the folder, counts as an empty folder.
fn list(folder: &Path) -> io::Result<Vec<DirEntry>> {
    match fs::read_dir(folder) {
        Ok(found) => found.collect(),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Vec::new()),
        Err(error) if error.kind() == io::ErrorKind::NotADirectory && folder.exists() => {
            Ok(Vec::new())
        }
        Err(error) => Err(error),
    }
}

pub(crate) fn size(folder: &Folder) -> io::Result<CacheSize> {
    Ok(sum(&entries(folder)?))
}

fn sum(entries: &[Entry]) -> CacheSize {
    let count = |kind| entries.iter().filter(|e| e.kind == kind).count() as u64;
    CacheSize {
        bytes: entries.iter().map(|e| e.len).sum(),
        steps: count(Kind::Step),
        blobs: count(Kind::Blob),
    }
}

pub(crate) fn clear(folder: &Folder) -> io::Result<CacheSize> {
    let entries = entries(folder)?;
    for entry in &entries {
        remove(&entry.path)?;
    }
    for file in list(&folder.temporary())? {
        remove(&file.path())?;
    }
    remove(&sizes(folder))?;
    remove(&folder.key_file())?;
    // Only empty folders are removed, because a folder can contain files that the cache did not create.
    for kind in Kind::ALL {
        let kind = folder.root().join(kind.name());
        for part in list(&kind)? {
            let _ = fs::remove_dir(part.path());
        }
        let _ = fs::remove_dir(kind);
    }
    let _ = fs::remove_dir(folder.temporary());
    Ok(sum(&entries))
}

fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Returns the path of the file `sizes`. Each run appends the number of bytes that it stored, as an integer of 8 bytes.
/// If a run lists all files of the cache, the total size of these files replaces the content of `sizes`.
fn sizes(folder: &Folder) -> PathBuf {
    folder.root().join("sizes")
}

/// If something was stored since the last call, keeps the cache below its size limit. Errors are ignored, because the
/// next run that stores something tries again to reduce the size.
pub(crate) fn after_run(folder: &Folder, limit: u64) {
    let added = folder.take_written();
    if added > 0 {
        let _ = add_to_total(folder, added, limit);
    }
}

fn add_to_total(folder: &Folder, added: u64, limit: u64) -> io::Result<()> {
    remove_old_temporaries(&folder.temporary())?;
    let path = sizes(folder);
    // If the file `sizes` is too long or not a regular file, it is replaced.
    let before = Folder::read(&path, MAX_SIZES_LEN);
    if let Err(Unusable::Damaged(_)) = before {
        Folder::discard(&path);
    }
    let total = before.ok().map(|bytes| {
        let runs = bytes.as_chunks::<8>().0.iter();
        let runs = runs.map(|n| u64::from_le_bytes(*n));
        runs.fold(added, u64::saturating_add)
    });
    if total.is_some_and(|total| total <= limit) {
        // Appending 8 bytes to a file is atomic, so concurrent runs do not damage each other's numbers.
        let mut file = OpenOptions::new().append(true).create(true).open(&path)?;
        file.write_all(&added.to_le_bytes())?;
    } else {
        let remaining = evict(folder, limit)?;
        folder.write(&path, |file| write_all(file, &[&remaining.to_le_bytes()]));
        folder.take_written();
    }
    Ok(())
}

/// Removes temporary files that killed processes have left.
fn remove_old_temporaries(temporary: &Path) -> io::Result<()> {
    let now = SystemTime::now();
    for file in list(temporary)? {
        let meta = file.metadata();
        if meta.is_ok_and(|meta| {
            now.duration_since(modified(&meta))
                .is_ok_and(|age| age > MAX_TEMPORARY_AGE)
        }) {
            remove(&file.path())?;
        }
    }
    Ok(())
}

/// If the files together exceed the limit, removes the least recently used files until the remaining files take at most
/// nine tenths of the limit. Returns the total size of the remaining files in bytes.
fn evict(folder: &Folder, limit: u64) -> io::Result<u64> {
    let mut entries = entries(folder)?;
    let mut total: u64 = entries.iter().map(|e| e.len).sum();
    if total > limit {
        entries.sort_by(|a, b| a.used.cmp(&b.used).then_with(|| a.path.cmp(&b.path)));
        for entry in &entries {
            if total <= limit / 10 * 9 {
                break;
            }
            // Another process may have removed the file.
            if fs::remove_file(&entry.path).is_ok() || !entry.path.exists() {
                total -= entry.len;
            }
        }
    }
    Ok(total)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a cache with `n` files of 1000 bytes each. The least recently used file comes first.
    fn filled(n: u8) -> (tempfile::TempDir, Folder) {
        let temporary = tempfile::tempdir().unwrap();
        let folder = Folder::new(temporary.path().join("cache"));
        let start = SystemTime::UNIX_EPOCH + Duration::from_secs(1_000_000);
        for i in 0..n {
            let path = folder.path(Kind::Blob, &[i; 32]);
            assert!(folder.write(&path, |file| write_all(file, &[&[i; 1000]])));
            let file = fs::File::options().write(true).open(path).unwrap();
            file.set_modified(start + Duration::from_secs(i.into()))
                .unwrap();
        }
        (temporary, folder)
    }

    #[test]
    fn over_the_limit_the_least_recently_used_files_are_removed() {
        let (_temporary, folder) = filled(10);
        after_run(&folder, 10_000);
        assert_eq!(size(&folder).unwrap().bytes, 10_000);
        assert!(
            folder.write(&folder.path(Kind::Step, &[77; 32]), |f| write_all(
                f,
                &[b"new"]
            ))
        );
        after_run(&folder, 10_000);
        let remaining = size(&folder).unwrap();
        assert_eq!(
            (remaining.bytes, remaining.steps, remaining.blobs),
            (8003, 1, 8)
        );
        assert!(!folder.path(Kind::Blob, &[1; 32]).exists());
        assert!(folder.path(Kind::Blob, &[2; 32]).exists());
    }

    #[test]
    fn files_are_listed_only_if_the_recorded_total_exceeds_the_limit() {
        let (_temporary, folder) = filled(3);
        after_run(&folder, 10_000);
        assert_eq!(fs::read(sizes(&folder)).unwrap(), 3000_u64.to_le_bytes());
        // The test created the files directly, without a run, so the recorded total size does not include these files.
        for i in 100..120 {
            let path = folder.path(Kind::Blob, &[i; 32]);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, [0; 1000]).unwrap();
        }
        folder.write(&folder.path(Kind::Blob, &[9; 32]), |f| {
            write_all(f, &[&[0; 6000]])
        });
        after_run(&folder, 10_000);
        assert_eq!(size(&folder).unwrap().bytes, 29_000);
        folder.write(&folder.path(Kind::Blob, &[8; 32]), |f| {
            write_all(f, &[&[0; 2000]])
        });
        after_run(&folder, 10_000);
        assert!(size(&folder).unwrap().bytes <= 9000);
    }

    #[test]
    fn old_temporary_files_are_removed() {
        let (_temporary, folder) = filled(1);
        let [old, new] = ["old", "new"].map(|name| folder.temporary().join(name));
        for path in [&old, &new] {
            fs::write(path, "half").unwrap();
        }
        let file = fs::File::options().write(true).open(&old).unwrap();
        file.set_modified(SystemTime::now() - 2 * MAX_TEMPORARY_AGE)
            .unwrap();
        after_run(&folder, 10_000);
        assert!(!old.exists() && new.exists());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_in_place_of_the_sizes_file_is_replaced() {
        let (_temporary, folder) = filled(3);
        for target in ["/dev/zero", "/dev/full", "/nowhere"] {
            remove(&sizes(&folder)).unwrap();
            std::os::unix::fs::symlink(target, sizes(&folder)).unwrap();
            folder.write(&folder.path(Kind::Blob, &[9; 32]), |f| {
                write_all(f, &[&[0; 1000]])
            });
            after_run(&folder, 10_000);
            assert_eq!(fs::read(sizes(&folder)).unwrap(), 4000_u64.to_le_bytes());
            assert!(!sizes(&folder).is_symlink());
        }
    }

    #[test]
    fn clearing_removes_what_was_stored_and_nothing_else() {
        let (_temporary, folder) = filled(4);
        let foreign = folder.root().join("blobs").join("mine");
        fs::write(&foreign, "x").unwrap();
        assert_eq!(clear(&folder).unwrap().blobs, 4);
        assert_eq!(size(&folder).unwrap(), CacheSize::default());
        assert!(foreign.exists());
        assert_eq!(clear(&folder).unwrap(), CacheSize::default());
    }
}
