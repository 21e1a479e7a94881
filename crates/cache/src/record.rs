//! The record of a step: the result of the step without long arrays and output files. A record is short, so it can be
//! read quickly.

use std::path::PathBuf;

use recipe::StepResult;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::blob::{BlobRef, SceneRef};
use crate::expectations::MetExpectation;
use crate::folder::{Folder, Hash, Kind, Unusable, write_all};
use crate::inputs::Inputs;
use crate::key::Key;

/// The first bytes of every file with records or with a history.
const MAGIC: &[u8] = b"meshwright cache\n";
/// The maximum size of a file with records or with a history, in bytes.
const MAX_BYTES: u64 = 1 << 26;
/// The maximum number of records for one key. Two records for the same key differ in their input files, in their
/// requested output paths, or in their provenance.
const MAX_RECORDS: usize = 4;

/// The record of a step.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub(crate) struct Record {
    pub(crate) inputs: Inputs,
    pub(crate) outputs: Option<Outputs>,
    pub(crate) result: StepResult,
    /// Whether the step left the scene unchanged.
    pub(crate) keeps_scene: bool,
    /// The scene after the step, if it is stored.
    pub(crate) scene: Option<SceneRef>,
    /// The digest of the scene, if the digest was computed.
    pub(crate) digest: Option<[u8; 16]>,
    /// The expectations that hold after the step.
    pub(crate) met_expectations: Vec<MetExpectation>,
}

/// The output files of a step.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct Outputs {
    /// The provenance of the run. The provenance is a text about the origin of the files, and steps can write it into
    /// the output files.
    pub(crate) provenance: Option<String>,
    /// The requested paths: each path as written in the recipe, and the same path relative to the output folder.
    pub(crate) requested: Vec<(String, PathBuf)>,
    /// The files, if they are stored.
    pub(crate) files: Option<Vec<OutputFile>>,
}

/// An output file of a step.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub(crate) struct OutputFile {
    /// The path relative to the output folder.
    pub(crate) path: PathBuf,
    pub(crate) content: BlobRef,
}

impl Record {
    /// Whether both records have the same input files, the same requested output paths and the same provenance. If they
    /// do, the newer record replaces the older one.
    fn is_replaced_by(&self, other: &Self) -> bool {
        let provenance = |r: &Self| {
            r.outputs
                .as_ref()
                .map(|o| (o.provenance.clone(), o.requested.clone()))
        };
        self.inputs == other.inputs && provenance(self) == provenance(other)
    }

    /// Returns the arrays and output files that the record refers to.
    pub(crate) fn blobs(&self) -> impl Iterator<Item = &BlobRef> {
        let outputs = self.outputs.iter().filter_map(|o| o.files.as_ref());
        let scene = self.scene.iter().flat_map(|scene| &scene.arrays);
        outputs.flatten().map(|file| &file.content).chain(scene)
    }
}

/// Loads the records for a key, the newest first.
pub(crate) fn load(folder: &Folder, key: Key) -> Result<Vec<Record>, Unusable> {
    load_data(folder, Kind::Step, &key.0)
}

/// Adds a record to the records for its key.
pub(crate) fn store(folder: &Folder, key: Key, record: Record) {
    let mut records = load(folder, key).unwrap_or_default();
    records.retain(|known| !known.is_replaced_by(&record));
    records.insert(0, record);
    records.truncate(MAX_RECORDS);
    store_data(folder, Kind::Step, &key.0, &records);
}

/// Loads serialized data and checks it against its digest, which depends on the key of the cache. A damaged file is
/// removed.
pub(crate) fn load_data<T: DeserializeOwned>(
    folder: &Folder,
    kind: Kind,
    id: &Hash,
) -> Result<T, Unusable> {
    let path = folder.path(kind, id);
    let bytes = Folder::read(&path, MAX_BYTES);
    let read = bytes.and_then(|bytes| {
        let damaged = |what: &str| Unusable::Damaged(what.to_owned());
        let rest = bytes.strip_prefix(MAGIC);
        let (digest, data) = rest
            .and_then(|rest| rest.split_at_checked(size_of::<Hash>()))
            .ok_or_else(|| damaged("it is not a cache file"))?;
        // The digest also depends on `id`, from which the path of the file is derived. Therefore, the cache also
        // rejects a file that was renamed.
        if digest != keyed_digest(&folder.key()?, id, data) {
            return Err(damaged("the content of the file does not match its digest"));
        }
        postcard::from_bytes(data).map_err(|_| damaged("its content cannot be decoded"))
    });
    if let Err(Unusable::Damaged(_)) = read {
        Folder::discard(&path);
    }
    read
}

/// Stores serialized data.
pub(crate) fn store_data(folder: &Folder, kind: Kind, id: &Hash, data: &impl Serialize) {
    // If the data contain a path that is not valid Unicode, serialization fails and nothing is stored.
    if let Ok(data) = postcard::to_stdvec(data)
        && (data.len() as u64) < MAX_BYTES / 2
        && let Some(key) = folder.key_or_new()
    {
        let digest = keyed_digest(&key, id, &data);
        folder.write(&folder.path(kind, id), |file| {
            write_all(file, &[MAGIC, &digest, &data])
        });
    }
}

fn keyed_digest(key: &Hash, id: &Hash, data: &[u8]) -> Hash {
    let mut hasher = blake3::Hasher::new_keyed(key);
    hasher.update(id).update(data);
    *hasher.finalize().as_bytes()
}
