//! The record of a step: what it did, small enough to be read for every step of every run.

use std::path::PathBuf;

use recipe::Finding;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::blob::{BlobRef, SceneRef};
use crate::folder::{Folder, Hash, Kind, Unusable, write_all};
use crate::held::Held;
use crate::key::Key;
use crate::seen::Inputs;

/// The first bytes of every file that is not a blob.
const MAGIC: &[u8] = b"meshwright cache\n";
/// No record is larger, in bytes.
const MOST_BYTES: u64 = 1 << 26;
/// So many results are kept for one key, which differ in the files that were read.
const MOST_RESULTS: usize = 4;

/// What a step did.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub(crate) struct Record {
    pub(crate) read: Inputs,
    pub(crate) outputs: Option<Outputs>,
    pub(crate) finding: Finding,
    /// Whether the scene is the one from before.
    pub(crate) same: bool,
    /// The scene after the step, if it is kept.
    pub(crate) scene: Option<SceneRef>,
    /// The digest of the scene, if it was computed.
    pub(crate) digest: Option<[u8; 16]>,
    /// The expectations that held after the step.
    pub(crate) held: Vec<Held>,
}

/// What a step has written.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct Outputs {
    /// The line on where the files come from, which may stand in them.
    pub(crate) provenance: Option<String>,
    /// The paths that were asked for, as the recipe has them and below the output folder.
    pub(crate) asked: Vec<(String, PathBuf)>,
    /// The files, unless they are not kept.
    pub(crate) files: Option<Vec<OutputFile>>,
}

/// A file that a step has written.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct OutputFile {
    /// Below the output folder.
    pub(crate) path: PathBuf,
    pub(crate) content: BlobRef,
}

impl Record {
    /// Whether both are about the same files: then the later one takes the place of the other.
    fn is_about_the_same(&self, other: &Self) -> bool {
        let provenance = |r: &Self| {
            r.outputs
                .as_ref()
                .map(|o| (o.provenance.clone(), o.asked.clone()))
        };
        self.read == other.read && provenance(self) == provenance(other)
    }

    /// The arrays and files that belong to it.
    pub(crate) fn blobs(&self) -> impl Iterator<Item = &BlobRef> {
        let outputs = self.outputs.iter().filter_map(|o| o.files.as_ref());
        let scene = self.scene.iter().flat_map(|scene| &scene.arrays);
        outputs.flatten().map(|file| &file.content).chain(scene)
    }
}

/// The results that are known for a key, the latest first.
pub(crate) fn load(folder: &Folder, key: Key) -> Result<Vec<Record>, Unusable> {
    load_data(folder, Kind::Step, &key.0)
}

/// Stores a result beside those that are known for its key.
pub(crate) fn store(folder: &Folder, key: Key, record: Record) {
    let mut records = load(folder, key).unwrap_or_default();
    records.retain(|known| !known.is_about_the_same(&record));
    records.insert(0, record);
    records.truncate(MOST_RESULTS);
    store_data(folder, Kind::Step, &key.0, &records);
}

/// Reads plain data, which must match its digest under the key of the cache. What is damaged is removed.
pub(crate) fn load_data<T: DeserializeOwned>(
    folder: &Folder,
    kind: Kind,
    id: &Hash,
) -> Result<T, Unusable> {
    let path = folder.path(kind, id);
    let bytes = Folder::read(&path, MOST_BYTES);
    let read = bytes.and_then(|bytes| {
        let damaged = |what: &str| Unusable::Damaged(what.to_owned());
        let rest = bytes.strip_prefix(MAGIC);
        let (digest, data) = rest
            .and_then(|rest| rest.split_at_checked(size_of::<Hash>()))
            .ok_or_else(|| damaged("it is no file of this cache"))?;
        // A record under another name is a whole one, and still the wrong one.
        if digest != of(&folder.key()?, id, data) {
            return Err(damaged("its content is not what was stored"));
        }
        postcard::from_bytes(data).map_err(|_| damaged("it holds something else"))
    });
    if let Err(Unusable::Damaged(_)) = read {
        Folder::discard(&path);
    }
    read
}

/// Stores plain data under a name.
pub(crate) fn store_data(folder: &Folder, kind: Kind, id: &Hash, data: &impl Serialize) {
    // Paths that are no text cannot be stored.
    if let Ok(data) = postcard::to_stdvec(data)
        && (data.len() as u64) < MOST_BYTES / 2
        && let Some(key) = folder.key_or_new()
    {
        let digest = of(&key, id, &data);
        folder.write(&folder.path(kind, id), |file| {
            write_all(file, &[MAGIC, &digest, &data])
        });
    }
}

fn of(key: &Hash, id: &Hash, data: &[u8]) -> Hash {
    let mut hasher = blake3::Hasher::new_keyed(key);
    hasher.update(id).update(data);
    *hasher.finalize().as_bytes()
}
