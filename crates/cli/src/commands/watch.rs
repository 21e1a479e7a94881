//! `meshwright watch`: runs a recipe again whenever it, a recipe that it calls, or one of its inputs is
//! saved.
//!
//! The folders of these files are watched, since many editors save by putting another file in place. The
//! cache knows what a run depends on by content: what did not change is not run again, and a save that
//! changes nothing shows nothing. A run that is overtaken by a save ends, and the next one begins.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

use anyhow::Context as _;
use engine::Engine;
use notify::{RecursiveMode, Watcher as _};
use recipe::Outcome;
use store::folder_of;

use super::run::{execute, load_to_run, start_threads, tell};
use crate::args::{Format, RunArgs};
use crate::cache;
use crate::listener::{catch_interrupts, is_interrupted, lock};
use crate::output::{complain, print};
use engine::Loaded;

/// How long nothing must happen before a run: editors save in several moves.
const QUIET: Duration = Duration::from_millis(50);

/// How often it is looked whether Ctrl-C was pressed.
const TICK: Duration = Duration::from_millis(100);

pub(crate) fn run(args: &RunArgs, engine: &Engine) -> anyhow::Result<bool> {
    start_threads(args.threads)?;
    let cache = cache::open(&args.cache)?;
    catch_interrupts();
    let is_human = args.recipe.format == Format::Human;
    let mut changes = Changes::new()?;
    changes.follow(folder_of(&args.recipe.recipe))?;
    let mut texts = None;
    while !is_interrupted() {
        match load_to_run(args, engine) {
            Ok(loaded) => {
                for folder in folders(&loaded) {
                    // A folder that is not there has been told as an error.
                    let _ = changes.follow(&folder);
                }
                let go_on = || !changes.is_waiting();
                let pictures = (args.picture_errors).of(&args.recipe.recipe, args.recipe.budget);
                let outcome = execute(args, &loaded, cache.as_ref(), &pictures, &go_on)?;
                changes.ignore(&pictures.paths());
                if let Some(outcome) = &outcome {
                    changes.ignore(&outcome.written);
                }
                let is_overtaken = outcome.as_ref().is_some_and(|o| o.cancelled);
                let now = loaded.recipe.sources.iter().map(|s| s.text.clone());
                let now: Vec<_> = now.collect();
                let is_same = texts.as_ref() == Some(&now);
                // What comes out of the cache as a whole is what was shown before.
                let is_old = |o: &Outcome| {
                    is_same && o.succeeded() && o.steps.iter().all(|s| s.ran.is_none())
                };
                if let Some(outcome) = outcome
                    && is_human
                    && !is_overtaken
                    && !is_old(&outcome)
                {
                    tell(args, &loaded, &outcome, &pictures)?;
                }
                texts = (!is_overtaken).then_some(now);
            }
            Err(error) => {
                texts = None;
                complain(&format!("error: {error:#}\n"));
            }
        }
        if is_human {
            print(&format!("watching {}, Ctrl-C ends\n", changes.describe()))?;
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

/// The folders of everything that a recipe reads.
fn folders(loaded: &Loaded) -> BTreeSet<PathBuf> {
    let sources = loaded.recipe.sources.iter().map(|source| &source.path);
    let files = sources.chain(&loaded.forecast.inputs);
    files.map(|file| folder_of(file).to_path_buf()).collect()
}

/// Tells of files that change in some folders.
struct Changes {
    watcher: notify::RecommendedWatcher,
    events: Mutex<Receiver<notify::Result<notify::Event>>>,
    folders: BTreeSet<PathBuf>,
    /// Files that the runs write.
    own: Mutex<BTreeSet<PathBuf>>,
    /// The file that has changed, if one has since it was asked for last.
    waiting: Mutex<Option<PathBuf>>,
}

impl Changes {
    fn new() -> anyhow::Result<Self> {
        let (sender, events) = channel();
        let watcher = notify::recommended_watcher(sender).context("cannot watch files")?;
        Ok(Self {
            watcher,
            events: Mutex::new(events),
            folders: BTreeSet::new(),
            own: Mutex::default(),
            waiting: Mutex::default(),
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

    fn describe(&self) -> String {
        match self.folders.len() {
            1 => "one folder".to_owned(),
            n => format!("{n} folders"),
        }
    }

    /// Passes over these files from now on.
    fn ignore(&self, written: &[PathBuf]) {
        let real = written.iter().filter_map(|path| path.canonicalize().ok());
        lock(&self.own).extend(real);
    }

    /// Whether a file has changed and nobody has asked since.
    fn is_waiting(&self) -> bool {
        let mut waiting = lock(&self.waiting);
        if waiting.is_none() {
            let events = lock(&self.events);
            while let Ok(event) = events.try_recv() {
                if let Some(path) = self.meant(event) {
                    waiting.get_or_insert(path);
                }
            }
        }
        waiting.is_some()
    }

    /// Waits until a file has changed and nothing happens for a moment; `None` if Ctrl-C is pressed.
    fn wait(&self) -> Option<PathBuf> {
        loop {
            if is_interrupted() {
                return None;
            }
            if self.is_waiting() {
                break;
            }
            let event = lock(&self.events).recv_timeout(TICK);
            match event {
                Ok(event) => *lock(&self.waiting) = self.meant(event),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return None,
            }
        }
        while lock(&self.events).recv_timeout(QUIET).is_ok() {}
        lock(&self.waiting).take()
    }

    /// The file that an event is about, if it is one that a recipe may read.
    fn meant(&self, event: notify::Result<notify::Event>) -> Option<PathBuf> {
        let event = event.ok()?;
        if event.kind.is_access() {
            return None;
        }
        let own = lock(&self.own);
        event.paths.into_iter().find(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            !name.starts_with(".meshwright-") && !own.contains(path) && !path.is_dir()
        })
    }
}
