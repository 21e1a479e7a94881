//! Runs a recipe again and again, each time with a store in which a different call fails.

use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use store::{Entry, NewFile, StoreError};

use super::*;

/// A store in memory in which one call fails: the call with the number `fails_at`, counted from 1. Calls that remove a
/// folder are not counted and never fail, because errors in the removal of temporary folders are ignored.
#[derive(Debug, Default)]
struct Faulty {
    files: Memory,
    calls: AtomicUsize,
    fails_at: AtomicUsize,
}

impl Faulty {
    fn call(&self) -> io::Result<()> {
        if self.calls.fetch_add(1, Relaxed) + 1 == self.fails_at.load(Relaxed) {
            return Err(io::Error::other("injected"));
        }
        Ok(())
    }

    fn call_with(&self, path: &Path) -> Result<(), StoreError> {
        self.call()
            .map_err(|error| StoreError::new("use", path, error))
    }
}

impl Store for Faulty {
    fn read_up_to(&self, path: &Path, limit: u64) -> Result<Vec<u8>, StoreError> {
        self.call_with(path)?;
        self.files.read_up_to(path, limit)
    }

    fn entry(&self, path: &Path) -> Option<Entry> {
        self.files.entry(path)
    }

    fn is_link(&self, path: &Path) -> bool {
        self.files.is_link(path)
    }

    fn canonical(&self, path: &Path) -> Result<PathBuf, StoreError> {
        self.call_with(path)?;
        self.files.canonical(path)
    }

    fn list(&self, folder: &Path) -> Result<Vec<PathBuf>, StoreError> {
        self.call_with(folder)?;
        self.files.list(folder)
    }

    fn make_folder(&self, folder: &Path) -> Result<(), StoreError> {
        self.call_with(folder)?;
        self.files.make_folder(folder)
    }

    fn make_temporary(&self, folder: Option<&Path>) -> Result<PathBuf, StoreError> {
        self.call_with(folder.unwrap_or(Path::new("")))?;
        self.files.make_temporary(folder)
    }

    fn remove_folder(&self, folder: &Path) -> Result<(), StoreError> {
        self.files.remove_folder(folder)
    }

    fn create(&self, path: &Path) -> Result<Box<dyn NewFile + '_>, StoreError> {
        self.call_with(path)?;
        let file = self.files.create(path)?;
        Ok(Box::new(FaultyFile { store: self, file }))
    }

    fn rename(&self, from: &Path, to: &Path) -> Result<(), StoreError> {
        self.call_with(to)?;
        self.files.rename(from, to)
    }
}

struct FaultyFile<'s> {
    store: &'s Faulty,
    file: Box<dyn NewFile + 's>,
}

impl Write for FaultyFile<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.store.call()?;
        // One call writes at most 100 bytes, so a later call can fail after a part of the file was written. A disk that
        // becomes full has the same effect.
        self.file.write(&bytes[..bytes.len().min(100)])
    }

    fn flush(&mut self) -> io::Result<()> {
        self.store.call()?;
        self.file.flush()
    }
}

impl NewFile for FaultyFile<'_> {
    fn sync(&mut self) -> io::Result<()> {
        self.store.call()?;
        self.file.sync()
    }

    fn commit(self: Box<Self>) -> Result<(), StoreError> {
        self.store.call_with(Path::new("file"))?;
        self.file.commit()
    }
}

const OUTPUTS: [&str; 3] = ["out/a.obj", "out/b/c.stl", "out/b/d.ply.gz"];

/// Runs a recipe that writes a cube of this size.
fn run(store: &Arc<Faulty>, size: u32) -> bool {
    let registry = registry();
    let engine = Engine::new(&registry).with_store(store.clone());
    let text = format!(
        "(recipe: 1, steps: [Cube(size: {size}), Save(path: \"a.obj\"), Save(path: \"b/c.stl\"), \
         Save(path: \"b/d.ply.gz\")])"
    );
    let recipe = engine.load(&Source::new("a.ron", text), &Options::default());
    assert_eq!(recipe.diagnostics, []);
    let keep = Run {
        keep_outputs: true,
        ..Run::default()
    };
    recipe.run(keep, &Silent).succeeded()
}

fn outputs(store: &Faulty) -> [Option<Vec<u8>>; 3] {
    OUTPUTS.map(|path| store.files.read(path.as_ref()).ok())
}

#[test]
fn a_failing_call_leaves_old_or_new_outputs_and_no_temporary_folder() {
    for had_outputs in [false, true] {
        let mut n_failed = 0;
        for fails_at in 1.. {
            let store = Arc::new(Faulty::default());
            if had_outputs {
                assert!(run(&store, 1));
            }
            let old = outputs(&store);
            let reference = Arc::new(Faulty::default());
            assert!(run(&reference, 2));
            let new = outputs(&reference);
            store.calls.store(0, Relaxed);
            store.fails_at.store(fails_at, Relaxed);
            let succeeded = run(&store, 2);
            let found = outputs(&store);
            for i in 0..OUTPUTS.len() {
                let is_whole = found[i] == old[i] || found[i] == new[i];
                assert!(is_whole, "call {fails_at}: {} is incomplete", OUTPUTS[i]);
            }
            assert!(!succeeded || found == new, "call {fails_at}");
            let left = store::files_below(&store.files, Path::new(""));
            let mut left = left.unwrap_or_default().into_iter();
            let temporary = left.find(|path| path.to_string_lossy().contains(".meshwright"));
            assert_eq!(temporary, None, "call {fails_at}");
            n_failed += usize::from(!succeeded);
            if store.calls.load(Relaxed) < fails_at {
                assert!(succeeded);
                break;
            }
        }
        assert!(n_failed > 20, "{n_failed}");
    }
}
