//! Finds and loads the recipes given on the command line.

use std::collections::HashSet;
use std::io;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use engine::{Engine, Loaded, Options, Source, Values};
use walkdir::{DirEntry, WalkDir};

use crate::args::{ManyArgs, RecipeArgs, ValueArgs};
use crate::file_kind::{FileKind, expect_kind};
use crate::pipes;

/// Reads and checks the recipe given on the command line.
pub(crate) fn load(args: &RecipeArgs, engine: &Engine) -> anyhow::Result<Loaded> {
    let checking = Checking {
        budget: args.budget,
        strict: args.strict,
    };
    load_recipe(&args.recipe, &args.values, &args.out, checking, engine)
}

/// How recipes are checked.
#[derive(Clone, Copy)]
pub(crate) struct Checking {
    /// The memory budget for meshes, in bytes.
    pub(crate) budget: u64,
    /// Whether a loss is an error. A loss is data that a step cannot keep.
    pub(crate) strict: bool,
}

impl Checking {
    /// Returns settings with this memory budget. Losses are not errors.
    pub(crate) fn for_budget(budget: u64) -> Self {
        let strict = false;
        Self { budget, strict }
    }
}

impl ManyArgs {
    /// Returns how the recipes are checked.
    pub(crate) fn checking(&self) -> Checking {
        Checking {
            budget: self.budget,
            strict: self.strict,
        }
    }
}

/// Reads and checks a recipe.
pub(crate) fn load_recipe(
    path: &Path,
    values: &ValueArgs,
    out: &Path,
    checking: Checking,
    engine: &Engine,
) -> anyhow::Result<Loaded> {
    let source = if pipes::is_pipe(path) {
        pipes::read_recipe()?
    } else {
        expect_kind(path, FileKind::Recipe)?;
        engine.open(path)?
    };
    load_text(&source, values, out, checking, engine)
}

/// Checks a recipe whose text has already been read. If the value of a parameter is a path, this path is relative to
/// the working directory.
pub(crate) fn load_text(
    source: &Source,
    values: &ValueArgs,
    out: &Path,
    Checking { budget, strict }: Checking,
    engine: &Engine,
) -> anyhow::Result<Loaded> {
    let folder = std::env::current_dir().context("cannot determine the working directory")?;
    let values = Values {
        set: &values.set,
        preset: values.preset.as_deref(),
        folder: Some(&folder),
    };
    let options = Options {
        values,
        out,
        budget,
        strict,
    };
    Ok(engine.load(source, &options))
}

/// The path of a recipe, and how the recipe was found.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct RecipeFile {
    /// The path of the recipe.
    pub(crate) path: PathBuf,
    /// The name of the recipe's output folder. For a recipe that was found in a folder, this is its path relative to
    /// the searched folder, without extension. For a recipe whose path was given, this is its file name without
    /// extension.
    pub(crate) own_folder: PathBuf,
    /// Whether the user gave the path of the recipe itself, instead of a folder that contains it.
    pub(crate) is_named: bool,
}

/// Lists recipes. The arguments are handled in their given order. A folder is searched recursively, and its recipes are
/// sorted by name. Each path is listed once.
///
/// Skips hidden files and folders, folders named `assets`, links to folders, and sweeps (`*.sweep.ron`).
pub(crate) fn recipes(paths: &[PathBuf]) -> anyhow::Result<Vec<RecipeFile>> {
    let mut found = Vec::new();
    for path in paths {
        if path.is_dir() {
            search(path, &mut found)?;
        } else {
            anyhow::ensure!(
                path.exists(),
                "the file or folder {} does not exist",
                path.display()
            );
            expect_kind(path, FileKind::Recipe)?;
            let own_folder = path.file_stem().map(PathBuf::from).unwrap_or_default();
            found.push(RecipeFile {
                path: path.clone(),
                own_folder,
                is_named: true,
            });
        }
    }
    let mut seen = HashSet::new();
    found.retain(|f| seen.insert(f.path.clone()));
    Ok(found)
}

fn search(top: &Path, found: &mut Vec<RecipeFile>) -> anyhow::Result<()> {
    let is_searched = |entry: &DirEntry| {
        let name = entry.file_name().to_string_lossy();
        let is_assets = entry.file_type().is_dir() && name == "assets";
        entry.depth() == 0 || !(name.starts_with('.') || is_assets)
    };
    let entries = WalkDir::new(top).sort_by_file_name().into_iter();
    for entry in entries.filter_entry(is_searched) {
        let entry = entry.map_err(|error| {
            let folder = error.path().unwrap_or(top).display().to_string();
            anyhow::Error::new(io::Error::from(error)).context(format!("cannot list {folder}"))
        })?;
        let path = entry.path();
        let is_recipe = !entry.file_type().is_dir()
            && path.extension().is_some_and(|e| e == "ron")
            && !entry.file_name().to_string_lossy().ends_with(".sweep.ron");
        if is_recipe {
            found.push(RecipeFile {
                path: path.to_path_buf(),
                own_folder: path.strip_prefix(top).unwrap_or(path).with_extension(""),
                is_named: false,
            });
        }
    }
    Ok(())
}
