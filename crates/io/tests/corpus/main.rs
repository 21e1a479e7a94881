//! Reads each file in `tests/fuzz/corpus/` in a separate test. The reader must read or refuse the file quickly and with
//! little memory. The fuzzer checks this for random bytes. The corpus includes the files for which the fuzzer found
//! errors. These files have descriptive names.

mod files;

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use libtest_mimic::{Arguments, Failed, Trial};

/// The time after which reading a small file counts as a hang.
const LONG: Duration = Duration::from_secs(10);

fn main() {
    // Tests run one at a time, because the memory peak is measured for the whole process.
    let arguments = Arguments {
        test_threads: Some(1),
        ..Arguments::from_args()
    };
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/fuzz/corpus");
    let trials = sorted(&corpus).into_iter().flat_map(|folder| {
        let extension = name_of(&folder);
        sorted(&folder).into_iter().map(move |path| {
            let extension = extension.clone();
            Trial::test(format!("{extension}/{}", name_of(&path)), move || {
                check(&extension, &path)
            })
        })
    });
    let trials = trials.collect();
    // The first file that is read starts threads and allocates tables, which are not freed. Reading a file here keeps
    // this memory out of the measurements in the tests.
    files::check("off", b"OFF 0 0 0");
    libtest_mimic::run(&arguments, trials).exit();
}

fn check(extension: &str, path: &Path) -> Result<(), Failed> {
    let bytes = fs::read(path)?;
    let start = Instant::now();
    files::check(extension, &bytes);
    let taken = start.elapsed();
    if taken > LONG {
        return Err(format!("the check takes {taken:?}").into());
    }
    Ok(())
}

fn sorted(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("the folder exists");
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.expect("the folder can be listed").path())
        .collect();
    paths.sort();
    paths
}

fn name_of(path: &Path) -> String {
    let name = path.file_name().expect("the path has a name");
    name.to_string_lossy().into_owned()
}
