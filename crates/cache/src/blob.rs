//! Blobs: the long arrays of scenes, and the files that steps have written.

use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

use scene::{Arrays, Scene};
use serde::{Deserialize, Serialize};

use crate::folder::{
    Folder, Hash, Kind, Unusable, copy_hashed, hash, hash_rest, open, open_own, read_hashed,
    unreadable,
};

/// Arrays of fewer bytes stand in the record itself.
const LONG: usize = 1 << 14;

/// The name of a blob.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct BlobRef {
    pub(crate) hash: Hash,
    pub(crate) len: u64,
}

/// A scene whose long arrays are blobs.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct SceneRef {
    /// The canonical form without the long arrays.
    #[serde(with = "serde_bytes")]
    pub(crate) rest: Vec<u8>,
    pub(crate) arrays: Vec<BlobRef>,
}

/// Stores a scene of dense meshes. `None` if it cannot be written.
pub(crate) fn store_scene(folder: &Folder, scene: &Scene) -> Option<SceneRef> {
    let mut arrays = Vec::new();
    let mut stored = true;
    let rest = scene.encode_apart(LONG, &mut |bytes| {
        let blob = BlobRef {
            hash: hash(bytes),
            len: bytes.len() as u64,
        };
        stored = stored && store_bytes(folder, blob, bytes);
        arrays.push(blob);
    });
    stored.then_some(SceneRef { rest, arrays })
}

/// Brings a scene back. What is damaged is removed.
pub(crate) fn load_scene(folder: &Folder, scene: &SceneRef) -> Result<Scene, Unusable> {
    let mut arrays = Stored {
        folder,
        left: &scene.arrays,
        failed: None,
    };
    let decoded = Scene::decode(&scene.rest, LONG, &mut arrays);
    decoded.map_err(|error| {
        let failed = arrays.failed.take();
        failed.unwrap_or_else(|| Unusable::Damaged(error.to_string()))
    })
}

struct Stored<'a> {
    folder: &'a Folder,
    left: &'a [BlobRef],
    failed: Option<Unusable>,
}

impl Arrays for Stored<'_> {
    fn next_len(&self) -> Option<u64> {
        self.left.first().map(|blob| blob.len)
    }

    fn read(&mut self, bytes: &mut [u8]) -> Result<(), String> {
        let (blob, left) = self.left.split_first().ok_or("there is no further array")?;
        self.left = left;
        load_bytes(self.folder, blob, bytes).map_err(|why| {
            self.failed = Some(why);
            "an array cannot be read".to_owned()
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

/// Whether a blob is stored already. Its content is looked at when it is read.
fn is_stored(folder: &Folder, blob: &BlobRef) -> bool {
    let is_there = seems_there(folder, blob);
    if is_there {
        Folder::touch(&folder.path(Kind::Blob, &blob.hash));
    }
    is_there
}

fn load_bytes(folder: &Folder, blob: &BlobRef, into: &mut [u8]) -> Result<(), Unusable> {
    let path = folder.path(Kind::Blob, &blob.hash);
    let read = open_blob(&path, blob).and_then(|mut file| {
        let found = read_hashed(&mut file, into).map_err(unreadable)?;
        matches(blob, (found, into.len() as u64))
    });
    done_with(&path, read)
}

/// Stores a file that a step has written. `None` if it cannot be read or stored.
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

/// Whether a blob seems to be there, without reading it.
pub(crate) fn seems_there(folder: &Folder, blob: &BlobRef) -> bool {
    let path = folder.path(Kind::Blob, &blob.hash);
    fs::symlink_metadata(path).is_ok_and(|meta| meta.is_file() && meta.len() == blob.len)
}

/// Writes a blob to a file. After an error there is none.
pub(crate) fn restore_file(folder: &Folder, blob: &BlobRef, to: &Path) -> Result<(), Unusable> {
    let path = folder.path(Kind::Blob, &blob.hash);
    let mut file = open_blob(&path, blob)?;
    let written = |error: io::Error| Unusable::Damaged(format!("{}: {error}", to.display()));
    let mut out = File::create(to).map_err(written)?;
    let mut failed = None;
    // No more than was stored, even if the file grows meanwhile.
    let copied = copy_hashed(&mut (&mut file).take(blob.len), |piece| {
        // The cache is not to blame for what happens here.
        let done = out.write_all(piece);
        done.inspect_err(|error| failed = Some(error.to_string()))
    });
    if let Some(failed) = failed {
        Folder::discard(to);
        return Err(written(io::Error::other(failed)));
    }
    let restored = copied
        .map_err(unreadable)
        .and_then(|copied| matches(blob, copied));
    if restored.is_err() {
        Folder::discard(to);
    }
    done_with(&path, restored)
}

fn open_blob(path: &Path, blob: &BlobRef) -> Result<File, Unusable> {
    match open_own(path) {
        Ok((file, len)) if len == blob.len => Ok(file),
        Ok(_) => done_with(path, Err(Unusable::Damaged("it has another length".into()))),
        Err(error) => Err(error),
    }
}

fn matches(blob: &BlobRef, found: (Hash, u64)) -> Result<(), Unusable> {
    if found == (blob.hash, blob.len) {
        Ok(())
    } else {
        Err(Unusable::Damaged("its content has changed".to_owned()))
    }
}

/// Removes a blob that is damaged.
fn done_with<T>(path: &Path, result: Result<T, Unusable>) -> Result<T, Unusable> {
    match &result {
        Ok(_) => _ = Folder::touch(path),
        Err(Unusable::Damaged(_)) => Folder::discard(path),
        Err(Unusable::Missing) => {}
    }
    result
}
