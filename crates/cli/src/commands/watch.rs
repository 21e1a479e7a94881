//! `meshwright watch`: runs a recipe again whenever the recipe, a recipe that it calls, or one of its inputs is saved.
//!
//! The program does not watch the files themselves but their folders, because many text editors replace a file when
//! they save it. The program ignores changes of files that the recipe does not read or that the run itself writes. The
//! cache compares the contents of files. Therefore, a step with unchanged inputs usually does not run again. If a file
//! is saved without a change, and the cache has the results of all steps, no results are printed. If a file is saved
//! during a run, the run is canceled and the next run starts. Ctrl-C cancels the current run, if any, and ends the
//! program with exit code 0.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use anyhow::Context as _;
use engine::Engine;
use notify::{RecursiveMode, Watcher as _};
use recipe::Outcome;
use store::folder_of;

use super::run::{execute, load_to_run, print_outcome, start_threads};
use crate::args::{Format, RunArgs};
use crate::cache;
use crate::file_kind::{FileKind, expect_kind};
use crate::listener::{catch_interrupts, is_interrupted, lock};
use crate::output::{print, print_error};
use crate::pipes;
use crate::recording::{RecordingDisk, with_real_folder};
use engine::Loaded;

/// The time for which the files must stay unchanged before a run starts. Editors save in several steps.
const SETTLE_TIME: Duration = Duration::from_millis(50);

/// The interval for checking whether Ctrl-C was pressed.
const POLL_INTERVAL: Duration = Duration::from_millis(100);

pub(crate) fn run(args: &RunArgs, engine: &Engine) -> anyhow::Result<bool> {
    pipes::refuse(&args.recipe.recipe, "watch")?;
    expect_kind(&args.recipe.recipe, FileKind::Recipe)?;
    start_threads(args.threads)?;
    let cache = cache::open(&args.cache)?;
    catch_interrupts();
    let is_human = args.recipe.format == Format::Human;
    let disk = Arc::new(RecordingDisk::default());
    let engine = &Engine::new(engine.registry()).with_store(disk.clone());
    let mut changes = FolderWatcher::new(disk)?;
    changes.follow(folder_of(&args.recipe.recipe))?;
    let mut texts = None;
    while !is_interrupted() {
        match load_to_run(args, engine) {
            Ok(loaded) => {
                for folder in folders(&loaded) {
                    // The error is ignored: if the folder does not exist, the check of the recipe has already reported
                    // the missing file.
                    let _ = changes.follow(&folder);
                }
                changes.ignore(&loaded.forecast.outputs);
                let go_on = || !changes.has_pending();
                let pictures = (args.picture_errors).of(&args.recipe.recipe, args.recipe.budget);
                let outcome = execute(args, &loaded, cache.as_ref(), &pictures, &go_on)?;
                if let Some(outcome) = &outcome {
                    changes.ignore(&outcome.written);
                }
                changes.follow_files();
                let is_cancelled = outcome.as_ref().is_some_and(|o| o.cancelled);
                let now = loaded.recipe.sources.iter().map(|s| s.text.clone());
                let now: Vec<_> = now.collect();
                let is_same = texts.as_ref() == Some(&now);
                // If the recipe is unchanged and the cache had the results of all steps, these results have already
                // been printed.
                let is_unchanged = |o: &Outcome| {
                    is_same && o.succeeded() && o.steps.iter().all(|s| s.ran.is_none())
                };
                if let Some(outcome) = outcome
                    && is_human
                    && !is_cancelled
                    && !is_unchanged(&outcome)
                {
                    print_outcome(args, &loaded, &outcome, &pictures)?;
                }
                texts = (!is_cancelled).then_some(now);
            }
            Err(error) => {
                texts = None;
                print_error(&format!("error: {error:#}\n"));
            }
        }
        if is_interrupted() {
            break;
        }
        if is_human {
            print(&format!(
                "watching {}, press Ctrl-C to stop\n",
                changes.describe()
            ))?;
        }
        let Some(changed) = changes.wait() else {
            break;
        };
        if is_human {
            print(&format!("\n{} changed\n", changed.display()))?;
        }
    }
    Ok(true)
}

/// Returns the folders of all files that a recipe reads.
fn folders(loaded: &Loaded) -> BTreeSet<PathBuf> {
    let sources = loaded.recipe.sources.iter().map(|source| &source.path);
    let files = sources.chain(&loaded.forecast.inputs);
    files.map(|file| folder_of(file).to_path_buf()).collect()
}

/// Watches folders for changed files.
struct FolderWatcher {
    watcher: notify::RecommendedWatcher,
    events: Mutex<Receiver<notify::Result<notify::Event>>>,
    folders: BTreeSet<PathBuf>,
    /// The store through which the recipe reads files, and which records the paths of these files. Changes of files
    /// that the recipe does not read are ignored.
    disk: Arc<RecordingDisk>,
    /// Files that the runs write. Changes of these output files are ignored.
    ignored: Mutex<BTreeSet<PathBuf>>,
    /// A file that has changed since the last call of [`wait`](Self::wait), or `None` if no file has changed.
    pending: Mutex<Option<PathBuf>>,
}

impl FolderWatcher {
    fn new(disk: Arc<RecordingDisk>) -> anyhow::Result<Self> {
        let (sender, events) = channel();
        let watcher = notify::recommended_watcher(sender).context("cannot watch files")?;
        Ok(Self {
            watcher,
            events: Mutex::new(events),
            folders: BTreeSet::new(),
            disk,
            ignored: Mutex::default(),
            pending: Mutex::default(),
        })
    }

    fn follow(&mut self, folder: &Path) -> anyhow::Result<()> {
        let failed = || format!("cannot watch {}", folder.display());
        let real = folder.canonicalize().with_context(failed)?;
        if !self.folders.contains(&real) {
            let watched = self.watcher.watch(&real, RecursiveMode::NonRecursive);
            watched.with_context(failed)?;
            self.folders.insert(real);
        }
        Ok(())
    }

    /// Starts to watch the folders of all files that the recipe has read. The files of a recipe include, for example,
    /// the material files of a model.
    fn follow_files(&mut self) {
        let is_temporary = |path: &Path| {
            let mut parts = path.components();
            parts.any(|part| is_temporary(&part.as_os_str().to_string_lossy()))
        };
        for file in self.disk.files() {
            if !is_temporary(&file) && !lock(&self.ignored).contains(&file) {
                // Errors are ignored: if the folder of one file cannot be watched, the folders of the other files are
                // still watched.
                let _ = self.follow(folder_of(&file));
            }
        }
    }

    fn describe(&self) -> String {
        match self.folders.len() {
            1 => "one folder".to_owned(),
            n => format!("{n} folders"),
        }
    }

    /// Ignores changes of these output files from now on.
    fn ignore(&self, written: &[PathBuf]) {
        let real = written.iter().filter_map(|path| with_real_folder(path));
        lock(&self.ignored).extend(real);
    }

    /// Whether a file has changed since the last call of [`wait`](Self::wait).
    fn has_pending(&self) -> bool {
        let mut pending = lock(&self.pending);
        if pending.is_none() {
            let events = lock(&self.events);
            while let Ok(event) = events.try_recv() {
                if let Some(path) = self.changed_file(event) {
                    pending.get_or_insert(path);
                }
            }
        }
        pending.is_some()
    }

    /// Waits for a change of a file. Then waits until no file changes for the time [`SETTLE_TIME`]. Returns `None` if
    /// Ctrl-C is pressed.
    fn wait(&self) -> Option<PathBuf> {
        loop {
            if is_interrupted() {
                return None;
            }
            if self.has_pending() {
                break;
            }
            let event = lock(&self.events).recv_timeout(POLL_INTERVAL);
            match event {
                Ok(event) => *lock(&self.pending) = self.changed_file(event),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return None,
            }
        }
        while lock(&self.events).recv_timeout(SETTLE_TIME).is_ok() {}
        lock(&self.pending).take()
    }

    /// Searches the files that the event lists, and returns the first one that the recipe reads and does not write.
    fn changed_file(&self, event: notify::Result<notify::Event>) -> Option<PathBuf> {
        let event = event.ok()?;
        if event.kind.is_access() {
            return None;
        }
        let ignored = lock(&self.ignored);
        event.paths.into_iter().find(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            !is_temporary(&name)
                && self.disk.has_recorded(path)
                && !ignored.contains(path)
                && !path.is_dir()
        })
    }
}

/// Whether a name is the name of a temporary file or folder of this program.
fn is_temporary(name: &str) -> bool {
    name.starts_with(".meshwright-")
}
