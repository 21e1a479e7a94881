//! Checks properties that must hold when arbitrary bytes are read as a file of any format. The fuzzer runs these
//! checks, and so does the test that reads all files of the corpus.

use std::path::Path;

use mesh_io::{Loaded, ReadOptions, WriteOptions};
use peak_alloc::PeakAlloc;
use scene::Scene;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// The number of bytes of memory that reading can use for each byte of the file. [`SMALL`] and, for glTF and COLLADA,
/// [`INSTANCES`] are added to the limit.
const TIMES: usize = 64;

/// The number of bytes that reading can use for tables, threads and messages, even if the file is empty.
const SMALL: usize = 1 << 20;

/// The maximum number of rounds of writing and reading after the first round. Several rounds can be necessary until the
/// written bytes stay the same. For example, if writing loses all vertices of an object, the object itself is lost only
/// in the next round.
const ROUNDS: usize = 4;

/// The number of bytes that reading a glTF or COLLADA file can use for repeated instances, even if the file is small.
const INSTANCES: usize = 1 << 25;

/// Reads `bytes` as a file with this extension, and checks the memory that reading takes. Then writes and reads the
/// content in several rounds, until the written bytes stay the same. From the third round on, each round must write the
/// same bytes as the round before, unless the round before reported losses. An `.mtl` file is read as the library of an
/// `.obj` file, and the content of a `.dae` file is written as OBJ.
///
/// # Panics
///
/// Panics if one of these properties does not hold.
pub(crate) fn check(extension: &str, bytes: &[u8]) {
    let folder = tempfile::tempdir_in(memory_folder()).expect("a temporary folder can be created");
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
        "reading {} bytes takes {taken} bytes of memory",
        bytes.len()
    );
    let Ok(loaded) = read else {
        return;
    };
    let path = match extension {
        "dae" => path.with_extension("obj"),
        _ => path,
    };
    // Some formats cannot store all content that can be read, such as numbers outside the range of 32-bit floats.
    let Some(mut last) = round_trip(&path, loaded) else {
        return;
    };
    let mut lost_before = true;
    for _ in 0..ROUNDS {
        let Round { loaded, bytes, .. } = last;
        let next = round_trip(&path, loaded).expect("the content can be written again");
        if next.bytes == bytes {
            return;
        }
        assert!(
            lost_before,
            "the bytes differ after another round, but no loss was reported"
        );
        lost_before = next.has_losses;
        last = next;
    }
}

/// The result of writing and reading a file once.
struct Round {
    bytes: Vec<u8>,
    has_losses: bool,
    loaded: Loaded,
}

/// Writes the objects, and reads the file. Returns `None` if the format refuses the objects.
fn round_trip(path: &Path, loaded: Loaded) -> Option<Round> {
    let mut scene = Scene::new();
    for object in loaded.objects {
        scene.insert(object).expect("names differ");
    }
    let report = mesh_io::write(&store::Disk, path, &scene, &WriteOptions::default()).ok()?;
    let bytes = std::fs::read(path).expect("the written file exists");
    let again = mesh_io::read(&store::Disk, path, &ReadOptions::default());
    Some(Round {
        bytes,
        has_losses: !report.losses.is_empty(),
        loaded: again.expect("the written file can be read"),
    })
}

/// A folder in memory, if the system has such a folder.
fn memory_folder() -> std::path::PathBuf {
    let memory = Path::new("/dev/shm");
    if memory.is_dir() {
        memory.to_path_buf()
    } else {
        std::env::temp_dir()
    }
}
