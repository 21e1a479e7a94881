//! The files of a cache: their paths, and functions that read, write and hash them.

use std::collections::hash_map::RandomState;
use std::fs::{self, File, FileTimes};
use std::hash::BuildHasher;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, SystemTime};

/// A BLAKE3 digest.
pub(crate) type Hash = [u8; 32];

/// The size of a piece, in bytes. Files larger than a piece are read and hashed piece by piece on several threads.
const PIECE: usize = 4 << 20;
/// After a file was marked as used, it is not marked again during this time.
const TOUCH_INTERVAL: Duration = Duration::from_secs(3600);

/// Kinds of files. Each kind has its own folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Step,
    Blob,
    Recipe,
}

impl Kind {
    pub(crate) const ALL: [Self; 3] = [Self::Step, Self::Blob, Self::Recipe];

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Step => "steps",
            Self::Blob => "blobs",
            Self::Recipe => "recipes",
        }
    }
}

/// Why a file of the cache cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Unusable {
    /// The file does not exist.
    Missing,
    /// The file was changed after the cache stored it, or it cannot be read. The text is the reason.
    Damaged(String),
}

/// The folder of a cache.
#[derive(Debug)]
pub(crate) struct Folder {
    root: PathBuf,
    problem: OnceLock<String>,
    /// The number of bytes written since the last [`take_written`](Self::take_written).
    written: AtomicU64,
}

impl Folder {
    pub(crate) fn new(root: PathBuf) -> Self {
        Self {
            root,
            problem: OnceLock::new(),
            written: AtomicU64::new(0),
        }
    }

    pub(crate) fn root(&self) -> &Path {
        &self.root
    }

    pub(crate) fn problem(&self) -> Option<&str> {
        self.problem.get().map(String::as_str)
    }

    /// Returns the number of bytes written since the last call.
    pub(crate) fn take_written(&self) -> u64 {
        self.written.swap(0, Ordering::Relaxed)
    }

    pub(crate) fn path(&self, kind: Kind, hash: &Hash) -> PathBuf {
        let hex = blake3::Hash::from_bytes(*hash).to_hex();
        let folder = self.root.join(kind.name()).join(&hex[..2]);
        folder.join(&hex[2..])
    }

    pub(crate) fn temporary(&self) -> PathBuf {
        self.root.join("tmp")
    }

    /// Writes a file, completely or not at all, and returns whether writing succeeded. The first failure is stored as
    /// [`problem`](Self::problem). After a failure, nothing more is written to the cache.
    pub(crate) fn write(&self, path: &Path, fill: impl Fn(&mut File) -> io::Result<u64>) -> bool {
        if self.problem.get().is_some() {
            return false;
        }
        let try_write = || -> io::Result<u64> {
            let temporary = self.temporary();
            fs::create_dir_all(&temporary)?;
            let mut file = tempfile::NamedTempFile::new_in(temporary)?;
            let n = fill(file.as_file_mut())?;
            if let Some(parent) = path.parent() {
                fs::create_dir_all(parent)?;
            }
            file.persist(path)?;
            Ok(n)
        };
        // Another process may have cleared the cache folder in the meantime, so the file is written a second time.
        let retry = |error: io::Error| match error.kind() {
            io::ErrorKind::NotFound => try_write(),
            _ => Err(error),
        };
        match try_write().or_else(retry) {
            Ok(n) => {
                self.written.fetch_add(n, Ordering::Relaxed);
                true
            }
            Err(error) => {
                // The error message ends with the path of the temporary file. This path does not help the user, so the
                // path is removed from the message.
                let error = error.to_string();
                let error = error.split(" at path ").next().unwrap_or_default();
                let root = self.root.display();
                let problem = format!("cannot write to the cache folder {root}: {error}");
                let _ = self.problem.set(problem);
                false
            }
        }
    }

    /// Returns the path of the file that holds the secret key of this cache.
    pub(crate) fn key_file(&self) -> PathBuf {
        self.root.join("key")
    }

    /// Returns the key of this cache: random bytes that only the user can read. The digest of every record depends
    /// on the key. A person who edits a record without knowing the key cannot compute the new digest, so the record is
    /// rejected. Every call reads the key file again, because another process may have cleared the cache folder.
    pub(crate) fn key(&self) -> Result<Hash, Unusable> {
        let path = self.key_file();
        let key = Self::read(&path, size_of::<Hash>() as u64).and_then(|key| {
            Hash::try_from(key).map_err(|_| Unusable::Damaged("it is not a key".into()))
        });
        if let Err(Unusable::Damaged(_)) = key {
            Self::discard(&path);
        }
        key
    }

    /// Returns the key of this cache. If there is no key yet, creates one. Returns `None` if the key cannot be written.
    pub(crate) fn key_or_new(&self) -> Option<Hash> {
        if let Ok(key) = self.key() {
            return Some(key);
        }
        self.write(&self.key_file(), |file| write_all(file, &[&random()]));
        // Another process may have created a key at the same time. The key that was written last is valid, so the key
        // is read again.
        self.key().ok()
    }

    /// Reads a file of the cache. A file with more than `max` bytes counts as damaged.
    pub(crate) fn read(path: &Path, max: u64) -> Result<Vec<u8>, Unusable> {
        let (file, len) = open_cache_file(path)?;
        if len > max {
            return Err(Unusable::Damaged(format!(
                "the file is too large: {len} bytes"
            )));
        }
        let mut bytes = Vec::new();
        file.take(max).read_to_end(&mut bytes).map_err(unreadable)?;
        Ok(bytes)
    }

    /// Removes a file. Errors are ignored: if a damaged file cannot be removed, the damage is detected again when the
    /// file is next read.
    pub(crate) fn discard(path: &Path) {
        let _ = fs::remove_file(path);
    }

    /// Marks a file as used and returns true. Does nothing and returns false if the file cannot be opened, or was
    /// marked as used within the last [`TOUCH_INTERVAL`].
    pub(crate) fn touch(path: &Path) -> bool {
        let now = SystemTime::now();
        let Ok(file) = File::open(path) else {
            return false;
        };
        let modified = file.metadata().and_then(|meta| meta.modified());
        let is_fresh =
            modified.is_ok_and(|at| now.duration_since(at).is_ok_and(|d| d < TOUCH_INTERVAL));
        if !is_fresh {
            let _ = file.set_times(FileTimes::new().set_modified(now));
        }
        !is_fresh
    }
}

/// Opens a file of the cache. Returns the file and its length. The cache never creates links, so a link in place of a
/// file counts as a damaged file.
pub(crate) fn open_cache_file(path: &Path) -> Result<(File, u64), Unusable> {
    let meta = fs::symlink_metadata(path).map_err(unreadable)?;
    if meta.is_symlink() {
        return Err(Unusable::Damaged("it is a link".to_owned()));
    }
    open(path)
}

/// Opens a regular file. Returns the file and its length.
pub(crate) fn open(path: &Path) -> Result<(File, u64), Unusable> {
    let meta = fs::metadata(path).map_err(unreadable)?;
    if !meta.is_file() {
        return Err(Unusable::Damaged("it is not a regular file".to_owned()));
    }
    let file = File::open(path).map_err(unreadable)?;
    Ok((file, meta.len()))
}

#[expect(clippy::needless_pass_by_value, reason = "for map_err")]
pub(crate) fn unreadable(error: io::Error) -> Unusable {
    match error.kind() {
        io::ErrorKind::NotFound => Unusable::Missing,
        _ => Unusable::Damaged(error.to_string()),
    }
}

/// Returns random bytes, derived from the random keys with which the standard library seeds hash maps. The operating
/// system generates these keys.
fn random() -> Hash {
    let mut hasher = blake3::Hasher::new();
    for i in 0..4 {
        hasher.update(&RandomState::new().hash_one(i).to_le_bytes());
    }
    *hasher.finalize().as_bytes()
}

pub(crate) fn hash(bytes: &[u8]) -> Hash {
    let mut hasher = blake3::Hasher::new();
    update(&mut hasher, bytes);
    *hasher.finalize().as_bytes()
}

fn update(hasher: &mut blake3::Hasher, bytes: &[u8]) {
    // More threads are faster only for long inputs.
    if bytes.len() < 1 << 17 {
        hasher.update(bytes);
    } else {
        hasher.update_rayon(bytes);
    }
}

/// Fills `into` from a file and returns the digest of the bytes. While one piece of the file is hashed, the next piece
/// is read.
pub(crate) fn read_hashed(file: &mut (impl Read + Send), into: &mut [u8]) -> io::Result<Hash> {
    let mut hasher = blake3::Hasher::new();
    let mut last: &[u8] = &[];
    for piece in into.chunks_mut(PIECE) {
        if last.is_empty() {
            file.read_exact(piece)?;
        } else {
            let (read, ()) = rayon::join(|| file.read_exact(piece), || update(&mut hasher, last));
            read?;
        }
        last = piece;
    }
    update(&mut hasher, last);
    Ok(*hasher.finalize().as_bytes())
}

/// Reads a file to its end, passes its content to `sink`, and returns its digest and length. While one piece of the
/// file is hashed and written, the next piece is read.
pub(crate) fn copy_hashed(
    from: &mut (impl Read + Send),
    mut sink: impl FnMut(&[u8]) -> io::Result<()> + Send,
) -> io::Result<(Hash, u64)> {
    let mut hasher = blake3::Hasher::new();
    let mut n = 0;
    let (mut full, mut spare) = (Vec::new(), Vec::new());
    read_piece(from, &mut full)?;
    while !full.is_empty() {
        n += full.len() as u64;
        if full.len() < PIECE {
            sink(&full)?;
            update(&mut hasher, &full);
            full.clear();
            // A short piece is not necessarily the last piece of the file. Only an empty piece means that the file
            // has ended.
            read_piece(from, &mut full)?;
            continue;
        }
        let (read, written) = rayon::join(
            || read_piece(from, &mut spare),
            || {
                let written = sink(&full);
                update(&mut hasher, &full);
                written
            },
        );
        read.and(written)?;
        std::mem::swap(&mut full, &mut spare);
    }
    Ok((*hasher.finalize().as_bytes(), n))
}

fn read_piece(from: &mut impl Read, piece: &mut Vec<u8>) -> io::Result<()> {
    piece.clear();
    from.take(PIECE as u64).read_to_end(piece).map(|_| ())
}

/// Reads a file from its current position to its end, and returns the digest and the length of this part.
pub(crate) fn hash_rest(file: &mut File) -> io::Result<(Hash, u64)> {
    copy_hashed(file, |_| Ok(()))
}

/// Writes the pieces, one after the other, and returns the number of written bytes.
pub(crate) fn write_all(file: &mut File, pieces: &[&[u8]]) -> io::Result<u64> {
    let mut n = 0;
    for piece in pieces {
        file.write_all(piece)?;
        n += piece.len() as u64;
    }
    Ok(n)
}
