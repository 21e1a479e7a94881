//! From the paths on the command line to recipes.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use engine::{Engine, Loaded, Options, Source, Values};

use crate::args::{RecipeArgs, ValueArgs};

/// Reads and checks the recipe of a command.
pub(crate) fn load(args: &RecipeArgs, engine: &Engine) -> anyhow::Result<Loaded> {
    load_recipe(&args.recipe, &args.values, &args.out, args.budget, engine)
}

/// Reads and checks a recipe.
pub(crate) fn load_recipe(
    path: &Path,
    values: &ValueArgs,
    out: &Path,
    budget: u64,
    engine: &Engine,
) -> anyhow::Result<Loaded> {
    let source = engine.open(path).map_err(anyhow::Error::msg)?;
    load_text(
        &source,
        (&values.set, values.preset.as_deref()),
        out,
        budget,
        engine,
    )
}

/// The same for a recipe whose text is known; paths among the values are seen from the working directory.
pub(crate) fn load_text(
    source: &Source,
    (set, preset): (&[(String, String)], Option<&str>),
    out: &Path,
    budget: u64,
    engine: &Engine,
) -> anyhow::Result<Loaded> {
    let folder = std::env::current_dir().context("cannot tell the working directory")?;
    let values = Values {
        set,
        preset,
        folder: Some(&folder),
    };
    let options = Options {
        values,
        out,
        budget,
    };
    Ok(engine.load(source, &options))
}

/// A recipe that was found.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Found {
    /// Its path.
    pub(crate) path: PathBuf,
    /// The folder below another one that is its own: its path in the folder that was searched, without
    /// the ending.
    pub(crate) own_folder: PathBuf,
    /// Whether it was named itself, and not a folder around it.
    pub(crate) is_named: bool,
}

/// The recipes in folders and in folders in them, in order, and files as they are given; each once.
///
/// Hidden ones, folders named `assets` and links to folders are passed over; so are files of other
/// kinds, `*.sweep.ron`.
pub(crate) fn recipes(paths: &[PathBuf]) -> anyhow::Result<Vec<Found>> {
    let mut found = Vec::new();
    for path in paths {
        if path.is_dir() {
            search(path, path, &mut found)?;
        } else {
            anyhow::ensure!(
                path.exists(),
                "there is no file or folder {}",
                path.display()
            );
            let own_folder = path.file_stem().map(PathBuf::from).unwrap_or_default();
            found.push(Found {
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

fn search(top: &Path, folder: &Path, found: &mut Vec<Found>) -> anyhow::Result<()> {
    let list = || -> std::io::Result<Vec<(PathBuf, bool)>> {
        let entries = std::fs::read_dir(folder)?.map(|entry| {
            let entry = entry?;
            Ok((entry.path(), entry.file_type()?.is_dir()))
        });
        entries.collect()
    };
    let mut here = list().with_context(|| format!("cannot list {}", folder.display()))?;
    here.sort();
    for (path, is_folder) in here {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if name.starts_with('.') {
            continue;
        }
        if is_folder {
            if name != "assets" {
                search(top, &path, found)?;
            }
        } else if path.extension().is_some_and(|e| e == "ron") && !name.ends_with(".sweep.ron") {
            let own_folder = path.strip_prefix(top).unwrap_or(&path).with_extension("");
            found.push(Found {
                path,
                own_folder,
                is_named: false,
            });
        }
    }
    Ok(())
}
