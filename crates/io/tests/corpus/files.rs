//! What must hold for any bytes as a file of any format: shared by the fuzzer and the replay of its corpus.

use std::path::Path;

use mesh_io::{Loaded, ReadOptions, WriteOptions};
use peak_alloc::PeakAlloc;
use scene::Scene;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// Reading may take this many times the bytes of the file, ...
const TIMES: usize = 64;

/// ... and this much for tables, threads and messages.
const SMALL: usize = 1 << 20;

/// So often what is written may differ: an object that loses its last vertices is gone when it is read.
const ROUNDS: usize = 4;

/// What instances repeat may take this much even of a small file.
const INSTANCES: usize = 1 << 25;

/// Reads `bytes` as a file with this extension, with bounded memory; writes what was read, and again what that
/// reads as, until nothing is lost any more: then the bytes stay the same. An `.mtl` file is read as the
/// library of an `.obj` file, what a `.dae` file holds is written as OBJ.
///
/// # Panics
///
/// If any of this does not hold.
pub(crate) fn check(extension: &str, bytes: &[u8]) {
    let folder = tempfile::tempdir_in(memory_folder()).expect("there is a folder for files");
    let (name, content) = match extension {
        "mtl" => {
            std::fs::write(folder.path().join("a.mtl"), bytes).expect("the folder can be written");
            ("a.obj".to_owned(), b"mtllib a.mtl\n".to_vec())
        }
        _ => (format!("a.{extension}"), bytes.to_vec()),
    };
    let path = folder.path().join(name);
    MEMORY.reset_peak_usage();
    let before = MEMORY.current_usage();
    let read = mesh_io::read_bytes(&store::Disk, &path, content, &ReadOptions::default());
    let taken = MEMORY.peak_usage().saturating_sub(before);
    let repeated = match extension {
        "gltf" | "glb" | "dae" => INSTANCES,
        _ => 0,
    };
    assert!(
        taken <= TIMES * bytes.len() + SMALL + repeated,
        "reading {} bytes takes {taken}",
        bytes.len()
    );
    let Ok(loaded) = read else {
        return;
    };
    let path = match extension {
        "dae" => path.with_extension("obj"),
        _ => path,
    };
    // What is read may be more than the format can hold, such as numbers beyond those of 32 bits.
    let Some(mut last) = there_and_back(&path, loaded) else {
        return;
    };
    let mut lost_before = true;
    for _ in 0..ROUNDS {
        let Round { loaded, bytes, .. } = last;
        let next = there_and_back(&path, loaded).expect("it was written before");
        if next.bytes == bytes {
            return;
        }
        assert!(
            lost_before,
            "written, read and written again it differs, but nothing was lost"
        );
        lost_before = next.has_losses;
        last = next;
    }
}

/// What writing and reading gives.
struct Round {
    bytes: Vec<u8>,
    has_losses: bool,
    loaded: Loaded,
}

/// Writes what was read, and reads that; `None` if the format refuses to hold it.
fn there_and_back(path: &Path, loaded: Loaded) -> Option<Round> {
    let mut scene = Scene::new();
    for object in loaded.objects {
        scene.insert(object).expect("names differ");
    }
    let report = mesh_io::write(&store::Disk, path, &scene, &WriteOptions::default()).ok()?;
    let bytes = std::fs::read(path).expect("it was written");
    let again = mesh_io::read(&store::Disk, path, &ReadOptions::default());
    Some(Round {
        bytes,
        has_losses: !report.losses.is_empty(),
        loaded: again.expect("what was written can be read"),
    })
}

/// Where files are fast, if there is such a place.
fn memory_folder() -> std::path::PathBuf {
    let memory = Path::new("/dev/shm");
    if memory.is_dir() {
        memory.to_path_buf()
    } else {
        std::env::temp_dir()
    }
}
