//! `meshwright reproduce`: runs the recipe that wrote a file again, and compares the bytes.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use engine::{Disk, Engine, Options};
use recipe::stamp::{self, Run, Stamp};
use recipe::{Outcome, Source, Values};
use store::TemporaryFolder;
use walkdir::{DirEntry, WalkDir};

use crate::args::ReproduceArgs;
use crate::listener::{QUIET, catch_interrupts};
use crate::output::{complain, print, show};
use engine::Loaded;

pub(crate) fn run(args: &ReproduceArgs, engine: &Engine) -> anyhow::Result<bool> {
    catch_interrupts();
    let mut last: Option<Again> = None;
    let mut all_are_same = true;
    for file in &args.files {
        let stamp = mesh_io::provenance(&Disk, file)?.and_then(|text| Stamp::parse(&text));
        let (source, run) = recipe_of(file, stamp.as_ref(), args, engine)?;
        // Files of one run follow each other.
        let again = match last.take() {
            Some(again) if again.is_of(&source, &run) => again,
            _ => Again::run(source, run, args.budget, engine)?,
        };
        all_are_same &= again.compare(file, stamp.as_ref())?;
        last = Some(again);
    }
    Ok(all_are_same)
}

/// The recipe that a file came from, and its parameters.
fn recipe_of(
    file: &Path,
    stamp: Option<&Stamp>,
    args: &ReproduceArgs,
    engine: &Engine,
) -> anyhow::Result<(Source, Run)> {
    let shown = file.display();
    let open = |path: &Path| Source::open(path).map_err(anyhow::Error::msg);
    let run = stamp.and_then(|stamp| stamp.run.clone());
    if let Some(path) = &args.recipe {
        return Ok((open(path)?, run.unwrap_or_default()));
    }
    let stamp = stamp.with_context(|| {
        format!("{shown} does not say where it comes from: name the recipe with --recipe")
    })?;
    // The name may have changed, and another recipe may have it.
    let mut candidates = recipes_here();
    let is_named = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        run.as_ref().is_some_and(|run| run.file == name)
    };
    candidates.sort_by_key(|path| (!is_named(path), path.clone()));
    let run = run.clone().unwrap_or_default();
    for path in &candidates {
        if let Ok(source) = open(path)
            && read(&source, &run, engine).recipe.digest() == stamp.recipe
        {
            return Ok((source, run));
        }
    }
    match candidates.into_iter().find(is_named) {
        Some(path) => Ok((open(&path)?, run)),
        None => anyhow::bail!(
            "{shown} comes from the recipe {} with the digest {}, which is not below the working directory: name it with --recipe",
            run.file,
            stamp.recipe
        ),
    }
}

/// The recipes below the working directory; hidden files and folders and those of builds are left out.
fn recipes_here() -> Vec<PathBuf> {
    const DEEPEST: usize = 9;
    let is_meant = |entry: &DirEntry| {
        let name = entry.file_name().to_string_lossy();
        entry.depth() == 0 || !(name.starts_with('.') || name == "target" || name == "node_modules")
    };
    let entries = WalkDir::new(".").max_depth(DEEPEST).into_iter();
    let recipes = entries.filter_entry(is_meant).flatten().filter(|entry| {
        !entry.file_type().is_dir() && entry.path().extension().is_some_and(|e| e == "ron")
    });
    let path = |entry: DirEntry| entry.path().strip_prefix(".").map(Path::to_path_buf);
    recipes.flat_map(path).collect()
}

fn read(source: &Source, run: &Run, engine: &Engine) -> recipe::Reading {
    let set: Vec<(String, String)> = run.set.clone().into_iter().collect();
    recipe::read(source, engine.registry(), values(&set, run))
}

fn values<'a>(set: &'a [(String, String)], run: &'a Run) -> Values<'a> {
    Values {
        set,
        preset: run.preset.as_deref(),
        folder: None,
    }
}

/// A recipe that was run again.
struct Again {
    source: Source,
    run: Run,
    loaded: Loaded,
    outcome: Outcome,
    /// What was written is there until this goes.
    _out: TemporaryFolder<'static>,
}

impl Again {
    fn run(source: Source, run: Run, budget: u64, engine: &Engine) -> anyhow::Result<Self> {
        let out = TemporaryFolder::new(&Disk, None).context("cannot make a folder to run in")?;
        let set: Vec<(String, String)> = run.set.clone().into_iter().collect();
        let options = Options {
            values: values(&set, &run),
            out: out.path(),
            budget,
        };
        let mut loaded = engine.load(&source, &options);
        if loaded.has_errors() {
            show(&loaded, &loaded.diagnostics);
            anyhow::bail!("{} cannot be run", loaded.path);
        }
        // They may be meant for other parameters; the bytes are what counts here.
        loaded.recipe.expectations.clear();
        let run_again = engine::Run {
            keep_outputs: true,
            cache: None,
        };
        let outcome = loaded.run(run_again, &QUIET);
        anyhow::ensure!(!outcome.cancelled, "interrupted");
        if !outcome.succeeded() {
            show(&loaded, &outcome.failures);
            anyhow::bail!("{} failed", loaded.path);
        }
        Ok(Self {
            source,
            run,
            loaded,
            outcome,
            _out: out,
        })
    }

    fn is_of(&self, source: &Source, run: &Run) -> bool {
        self.source == *source && self.run == *run
    }

    /// Prints whether the run has written the bytes of `file`.
    fn compare(&self, file: &Path, stamp: Option<&Stamp>) -> anyhow::Result<bool> {
        let (shown, recipe) = (file.display(), &self.loaded.path);
        let bytes = fs::read(file).with_context(|| format!("cannot read {shown}"))?;
        let name = file.file_name().unwrap_or_default();
        let mut of_name = None;
        for path in &self.outcome.written {
            let again = fs::read(path)?;
            if again == bytes {
                let digest = &stamp::digest(&Disk, file)?;
                let text = format!("{shown} is reproduced by {recipe}, digest {digest}\n");
                return Ok(print(&text).map(|()| true)?);
            }
            if path.file_name() == Some(name) {
                of_name = Some((path, again));
            }
        }
        complain(&format!("{shown} is not reproduced by {recipe}:\n"));
        match of_name {
            Some((path, again)) => {
                let at = bytes.iter().zip(&again).position(|(a, b)| a != b);
                let at = at.unwrap_or(bytes.len().min(again.len()));
                let (now, then) = (stamp::digest(&Disk, path)?, stamp::digest(&Disk, file)?);
                complain(&format!(
                    "  digest {now}, expected {then}; byte {at} is the first that differs\n"
                ));
            }
            None => complain("  no output has its bytes, and none its name\n"),
        }
        for reason in self.reasons(stamp) {
            complain(&format!("  {reason}\n"));
        }
        Ok(false)
    }

    /// What is other than when the file was written.
    fn reasons(&self, stamp: Option<&Stamp>) -> Vec<String> {
        let Some(stamp) = stamp else {
            return vec!["the file does not say where it comes from".to_owned()];
        };
        let mut reasons = Vec::new();
        let now = Stamp::new(&self.loaded.recipe, &self.loaded.forecast.inputs, &Disk);
        let [then, here] = [&stamp.program, &now.program];
        if then != here {
            reasons.push(format!("it was written by {then}, this is {here}"));
        }
        let [then, here] = [&stamp.recipe, &now.recipe];
        if then != here {
            reasons.push(format!("the recipe has changed: {then} then, {here} now"));
        }
        let inputs = |stamp: &Stamp| stamp.run.clone().unwrap_or_default().inputs;
        let (then, now) = (inputs(stamp), inputs(&now));
        for (name, digest) in &then {
            match now.get(name) {
                Some(same) if same == digest => {}
                Some(_) => reasons.push(format!("{name} has changed")),
                None => reasons.push(format!("{name} is not read any more")),
            }
        }
        if reasons.is_empty() {
            reasons.push("recipe, inputs and program are those that wrote it: it was changed afterwards, or a step is not deterministic".to_owned());
        }
        reasons
    }
}
