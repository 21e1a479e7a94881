//! Blobs: files that each hold one long array of a scene, or one output file of a step.

use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

use scene::{ArraySource, DecodeError, Scene};
use serde::{Deserialize, Serialize};

use crate::folder::{
    Folder, Hash, Kind, Unusable, copy_hashed, hash, hash_rest, open, open_cache_file, read_hashed,
    unreadable,
};

/// Arrays with fewer bytes than this are stored in the record of the step instead of in a blob.
const MIN_BLOB_LEN: usize = 1 << 14;

/// A reference to a blob: the digest and the length of its content.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct BlobRef {
    pub(crate) hash: Hash,
    pub(crate) len: u64,
}

/// A scene whose long arrays are stored as blobs (separate files).
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct SceneRef {
    /// The canonical encoding of the scene, without the long arrays.
    #[serde(with = "serde_bytes")]
    pub(crate) rest: Vec<u8>,
    pub(crate) arrays: Vec<BlobRef>,
}

/// Stores a scene whose meshes have no removed elements. Returns `None` if the scene cannot be written.
pub(crate) fn store_scene(folder: &Folder, scene: &Scene) -> Option<SceneRef> {
    let mut arrays = Vec::new();
    let mut stored = true;
    let rest = scene.encode_with_separate_arrays(MIN_BLOB_LEN, &mut |bytes| {
        let blob = BlobRef {
            hash: hash(bytes),
            len: bytes.len() as u64,
        };
        stored = stored && store_bytes(folder, blob, bytes);
        arrays.push(blob);
    });
    stored.then_some(SceneRef { rest, arrays })
}

/// Loads a scene. Damaged blobs are removed.
pub(crate) fn load_scene(folder: &Folder, scene: &SceneRef) -> Result<Scene, Unusable> {
    let mut arrays = StoredArrays {
        folder,
        remaining: &scene.arrays,
        failed: None,
    };
    let decoded = Scene::decode(&scene.rest, MIN_BLOB_LEN, &mut arrays);
    decoded.map_err(|error| {
        let failed = arrays.failed.take();
        failed.unwrap_or_else(|| Unusable::Damaged(error.to_string()))
    })
}

struct StoredArrays<'a> {
    folder: &'a Folder,
    remaining: &'a [BlobRef],
    failed: Option<Unusable>,
}

impl ArraySource for StoredArrays<'_> {
    fn next_len(&self) -> Option<u64> {
        self.remaining.first().map(|blob| blob.len)
    }

    fn read(&mut self, bytes: &mut [u8]) -> Result<(), DecodeError> {
        let next = self.remaining.split_first();
        let (blob, remaining) = next.ok_or(DecodeError::Array("an array is missing"))?;
        self.remaining = remaining;
        load_bytes(self.folder, blob, bytes).map_err(|why| {
            self.failed = Some(why);
            DecodeError::Array("an array cannot be read")
        })
    }
}

fn store_bytes(folder: &Folder, blob: BlobRef, bytes: &[u8]) -> bool {
    let path = folder.path(Kind::Blob, &blob.hash);
    is_stored(folder, &blob)
        || folder.write(&path, |file| {
            file.write_all(bytes)?;
            Ok(blob.len)
        })
}

/// Whether a blob is already stored. Also marks a stored blob as used. The content of a blob is checked only when the
/// blob is read.
fn is_stored(folder: &Folder, blob: &BlobRef) -> bool {
    let exists = exists(folder, blob);
    if exists {
        Folder::touch(&folder.path(Kind::Blob, &blob.hash));
    }
    exists
}

fn load_bytes(folder: &Folder, blob: &BlobRef, into: &mut [u8]) -> Result<(), Unusable> {
    let path = folder.path(Kind::Blob, &blob.hash);
    let read = open_blob(&path, blob).and_then(|mut file| {
        let found = read_hashed(&mut file, into).map_err(unreadable)?;
        check_content(blob, (found, into.len() as u64))
    });
    touch_or_discard(&path, read)
}

/// Stores an output file of a step. Returns `None` if the file cannot be read or stored.
pub(crate) fn store_file(folder: &Folder, path: &Path) -> Option<BlobRef> {
    let (mut file, _) = open(path).ok()?;
    let (hash, len) = hash_rest(&mut file).ok()?;
    let blob = BlobRef { hash, len };
    let to = folder.path(Kind::Blob, &hash);
    let copy = |out: &mut File| {
        let mut from = &file;
        from.seek(SeekFrom::Start(0))?;
        io::copy(&mut from, out)
    };
    (is_stored(folder, &blob) || folder.write(&to, copy)).then_some(blob)
}

/// Whether a blob exists and has the right length. Does not read the blob.
pub(crate) fn exists(folder: &Folder, blob: &BlobRef) -> bool {
    let path = folder.path(Kind::Blob, &blob.hash);
    fs::symlink_metadata(path).is_ok_and(|meta| meta.is_file() && meta.len() == blob.len)
}

/// Writes a blob to a file. If writing fails or the blob is damaged, the written file is removed.
pub(crate) fn restore_file(folder: &Folder, blob: &BlobRef, to: &Path) -> Result<(), Unusable> {
    let path = folder.path(Kind::Blob, &blob.hash);
    let mut file = open_blob(&path, blob)?;
    let written = |error: io::Error| Unusable::Damaged(format!("{}: {error}", to.display()));
    let mut out = File::create(to).map_err(written)?;
    let mut failed = None;
    // Copies no more bytes than the recorded length of the blob, even if another process appends to the file.
    let copied = copy_hashed(&mut (&mut file).take(blob.len), |piece| {
        // If the output file cannot be written, the blob must not be treated as damaged.
        let done = out.write_all(piece);
        done.inspect_err(|error| failed = Some(error.to_string()))
    });
    if let Some(failed) = failed {
        Folder::discard(to);
        return Err(written(io::Error::other(failed)));
    }
    let restored = copied
        .map_err(unreadable)
        .and_then(|copied| check_content(blob, copied));
    if restored.is_err() {
        Folder::discard(to);
    }
    touch_or_discard(&path, restored)
}

fn open_blob(path: &Path, blob: &BlobRef) -> Result<File, Unusable> {
    match open_cache_file(path) {
        Ok((file, len)) if len == blob.len => Ok(file),
        Ok(_) => touch_or_discard(path, Err(Unusable::Damaged("its length is wrong".into()))),
        Err(error) => Err(error),
    }
}

fn check_content(blob: &BlobRef, found: (Hash, u64)) -> Result<(), Unusable> {
    if found == (blob.hash, blob.len) {
        Ok(())
    } else {
        Err(Unusable::Damaged(
            "the content of the file does not match its digest".to_owned(),
        ))
    }
}

/// Marks a blob as used, or removes it if it is damaged.
fn touch_or_discard<T>(path: &Path, result: Result<T, Unusable>) -> Result<T, Unusable> {
    match &result {
        Ok(_) => _ = Folder::touch(path),
        Err(Unusable::Damaged(_)) => Folder::discard(path),
        Err(Unusable::Missing) => {}
    }
    result
}
