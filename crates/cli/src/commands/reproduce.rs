//! `meshwright reproduce`: finds the recipe that wrote a file, runs this recipe again, and compares the bytes of the
//! new file and the old file.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use engine::{Disk, Engine, Options};
use recipe::stamp::{self, Run, Stamp};
use recipe::{Outcome, Source, Values};
use store::TemporaryFolder;
use walkdir::{DirEntry, WalkDir};

use crate::args::ReproduceArgs;
use crate::file_kind::{FileKind, expect_kind};
use crate::listener::{INTERRUPT, catch_interrupts};
use crate::output::{print, print_diagnostics, print_error};
use engine::Loaded;

pub(crate) fn run(args: &ReproduceArgs, engine: &Engine) -> anyhow::Result<bool> {
    catch_interrupts();
    let mut last: Option<Rerun> = None;
    let mut all_equal = true;
    for file in &args.files {
        expect_kind(file, FileKind::Mesh)?;
        let stamp = mesh_io::provenance(&Disk, file)?.and_then(|text| Stamp::parse(&text));
        let (source, run) = recipe_of(file, stamp.as_ref(), args, engine)?;
        // If the same run wrote several files that are adjacent in the arguments, this run is repeated only once.
        let rerun = match last.take() {
            Some(rerun) if rerun.is_of(&source, &run) => rerun,
            _ => Rerun::run(source, run, args.budget, engine)?,
        };
        all_equal &= rerun.compare(file, stamp.as_ref())?;
        last = Some(rerun);
    }
    Ok(all_equal)
}

/// Finds the recipe that wrote a file, unless `--recipe` names the recipe. If no recipe has the recorded digest, uses
/// the recipe with the recorded file name. Returns the text of the recipe, and the parameters and inputs that the file
/// records.
fn recipe_of(
    file: &Path,
    stamp: Option<&Stamp>,
    args: &ReproduceArgs,
    engine: &Engine,
) -> anyhow::Result<(Source, Run)> {
    let shown = file.display();
    let run = stamp.and_then(|stamp| stamp.run.clone());
    if let Some(path) = &args.recipe {
        return Ok((Source::open(path)?, run.unwrap_or_default()));
    }
    let stamp = stamp.with_context(|| {
        format!("{shown} does not record which recipe wrote it: name the recipe with --recipe")
    })?;
    // The recipe may have been renamed, and a different recipe may now have its name. Therefore the recipe is
    // identified by its digest and not by its name.
    let mut candidates = recipes_here();
    let is_named = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        run.as_ref().is_some_and(|run| run.file == name)
    };
    candidates.sort_by_key(|path| (!is_named(path), path.clone()));
    let run = run.clone().unwrap_or_default();
    for path in &candidates {
        if let Ok(source) = Source::open(path)
            && read(&source, &run, engine).recipe.digest() == stamp.recipe
        {
            return Ok((source, run));
        }
    }
    match candidates.into_iter().find(is_named) {
        Some(path) => Ok((Source::open(&path)?, run)),
        None => anyhow::bail!(
            "{shown} was written by the recipe {}, which was not found below the working directory: name the recipe with \
             --recipe",
            run.file
        ),
    }
}

/// Lists the recipes in the working directory and up to eight levels of folders below it. Skips hidden files and
/// folders, and the folders `target` and `node_modules`.
fn recipes_here() -> Vec<PathBuf> {
    const MAX_DEPTH: usize = 9;
    let is_searched = |entry: &DirEntry| {
        let name = entry.file_name().to_string_lossy();
        entry.depth() == 0 || !(name.starts_with('.') || name == "target" || name == "node_modules")
    };
    let entries = WalkDir::new(".").max_depth(MAX_DEPTH).into_iter();
    let recipes = entries.filter_entry(is_searched).flatten().filter(|entry| {
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

/// A second run of a recipe.
struct Rerun {
    source: Source,
    run: Run,
    loaded: Loaded,
    outcome: Outcome,
    /// The output folder. It is removed when this value is dropped.
    _out: TemporaryFolder<'static>,
}

impl Rerun {
    fn run(source: Source, run: Run, budget: u64, engine: &Engine) -> anyhow::Result<Self> {
        let out = TemporaryFolder::new(&Disk, None)
            .context("cannot create a temporary folder for the outputs")?;
        let set: Vec<(String, String)> = run.set.clone().into_iter().collect();
        let options = Options {
            values: values(&set, &run),
            out: out.path(),
            budget,
            strict: false,
        };
        let mut loaded = engine.load(&source, &options);
        if loaded.has_errors() {
            print_diagnostics(&loaded, &loaded.diagnostics);
            anyhow::bail!("{} cannot be run", loaded.path);
        }
        // The expectations are not checked, because they do not necessarily hold for the parameter values of this run.
        // Only the bytes of the outputs are compared.
        loaded.recipe.expectations.clear();
        let run_again = engine::Run {
            keep_outputs: true,
            cache: None,
        };
        let outcome = loaded.run(run_again, &INTERRUPT);
        anyhow::ensure!(!outcome.cancelled, "interrupted");
        if !outcome.succeeded() {
            print_diagnostics(&loaded, &outcome.failures);
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

    /// Returns whether the run has written a file with the same bytes as `file`, and prints the result of the
    /// comparison.
    fn compare(&self, file: &Path, stamp: Option<&Stamp>) -> anyhow::Result<bool> {
        let (shown, recipe) = (file.display(), &self.loaded.path);
        let bytes = fs::read(file).with_context(|| format!("cannot read {shown}"))?;
        let name = file.file_name().unwrap_or_default();
        let mut same_name = None;
        for path in &self.outcome.written {
            let output = fs::read(path)?;
            if output == bytes {
                let digest = &stamp::digest(&Disk, file)?;
                let text = format!("{shown} is reproduced by {recipe}, digest {digest}\n");
                return Ok(print(&text).map(|()| true)?);
            }
            if path.file_name() == Some(name) {
                same_name = Some((path, output));
            }
        }
        print_error(&format!("{shown} is not reproduced by {recipe}:\n"));
        match same_name {
            Some((path, output)) => {
                let at = bytes.iter().zip(&output).position(|(a, b)| a != b);
                let at = at.unwrap_or(bytes.len().min(output.len()));
                let (now, then) = (stamp::digest(&Disk, path)?, stamp::digest(&Disk, file)?);
                print_error(&format!(
                    "  the new file has the digest {now}, expected {then}; the first difference is at byte {at}, counted from 0\n"
                ));
            }
            None => print_error("  the recipe writes no file with these bytes or this name\n"),
        }
        for reason in self.reasons(stamp) {
            print_error(&format!("  {reason}\n"));
        }
        Ok(false)
    }

    /// Returns possible reasons why the second run wrote a different file, such as inputs that have changed since the
    /// first run.
    fn reasons(&self, stamp: Option<&Stamp>) -> Vec<String> {
        let Some(stamp) = stamp else {
            return vec!["the file does not record which recipe wrote it".to_owned()];
        };
        let mut reasons = Vec::new();
        let now = Stamp::new(&self.loaded.recipe, &self.loaded.forecast.inputs, &Disk);
        let [then, here] = [&stamp.program, &now.program];
        if then != here {
            reasons.push(format!(
                "the file was written by {then}, but this program is {here}"
            ));
        }
        let [then, here] = [&stamp.recipe, &now.recipe];
        if then != here {
            reasons.push(format!(
                "the recipe has changed: its digest was {then} and is now {here}"
            ));
        }
        let inputs = |stamp: &Stamp| stamp.run.clone().unwrap_or_default().inputs;
        let (then, now) = (inputs(stamp), inputs(&now));
        for (name, digest) in &then {
            match now.get(name) {
                Some(same) if same == digest => {}
                Some(_) => reasons.push(format!("{name} has changed")),
                None => reasons.push(format!("the recipe no longer reads {name}")),
            }
        }
        if reasons.is_empty() {
            reasons.push(
                "the recipe, the inputs and the program are unchanged, so either the output file was modified or a \
                 step is not deterministic"
                    .to_owned(),
            );
        }
        reasons
    }
}
