//! The files in `tests/fuzz/corpus/`, each a test of its own: read or refused in little time and memory, as the
//! fuzzer asks of any bytes. What the fuzzer found is among them, under a name that says what it is.

mod files;

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use libtest_mimic::{Arguments, Failed, Trial};

/// A reader that takes this long on a small file hangs.
const LONG: Duration = Duration::from_secs(10);

fn main() {
    // One at a time: the peak of the memory is that of the program.
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
    // The first file pays for threads and tables that stay.
    files::check("off", b"OFF 0 0 0");
    libtest_mimic::run(&arguments, trials).exit();
}

fn check(extension: &str, path: &Path) -> Result<(), Failed> {
    let bytes = fs::read(path)?;
    let start = Instant::now();
    files::check(extension, &bytes);
    let taken = start.elapsed();
    if taken > LONG {
        return Err(format!("it takes {taken:?}").into());
    }
    Ok(())
}

fn sorted(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("the folder is there");
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.expect("it can be listed").path())
        .collect();
    paths.sort();
    paths
}

fn name_of(path: &Path) -> String {
    let name = path.file_name().expect("the path has a name");
    name.to_string_lossy().into_owned()
}
