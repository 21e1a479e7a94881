//! From the path of a recipe to what runs it.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use op::{Files, Registry};
use recipe::{Diagnostic, Forecast, Recipe, Schemas, Settings, Severity, Source, Stamp, Values};
use scene::Object;

use crate::args::{RecipeArgs, ValueArgs};

/// A recipe that was read and checked.
pub(crate) struct Loaded {
    pub(crate) path: String,
    pub(crate) recipe: Recipe,
    pub(crate) files: Files,
    pub(crate) forecast: Forecast,
    /// Whether every step and expectation could be read.
    pub(crate) is_read: bool,
    /// Everything that is wrong, from reading and from checking, in order.
    pub(crate) diagnostics: Vec<Diagnostic>,
}

impl Loaded {
    pub(crate) fn has_errors(&self) -> bool {
        self.n_errors() > 0
    }

    pub(crate) fn n_errors(&self) -> usize {
        self.diagnostics
            .iter()
            .filter(|d| d.severity == Severity::Error)
            .count()
    }

    /// How to run it: nothing is kept, and nothing comes from a cache.
    pub(crate) fn settings(&self, budget: u64) -> Settings<'_> {
        Settings {
            files: &self.files,
            budget,
            read: &read_objects,
            keep_outputs: false,
            writes: !self.forecast.outputs.is_empty(),
            cache: None,
        }
    }

    /// The diagnostics as a compiler shows them.
    pub(crate) fn render(&self, diagnostics: &[Diagnostic], colours: bool) -> String {
        recipe::render(&self.recipe.sources, diagnostics, colours)
    }
}

/// Reads and checks the recipe of a command.
pub(crate) fn load(args: &RecipeArgs, registry: &Registry) -> anyhow::Result<Loaded> {
    load_recipe(&args.recipe, &args.values, &args.out, args.budget, registry)
}

/// Reads and checks a recipe.
pub(crate) fn load_recipe(
    path: &Path,
    values: &ValueArgs,
    out: &Path,
    budget: u64,
    registry: &Registry,
) -> anyhow::Result<Loaded> {
    let source = Source::open(path).map_err(anyhow::Error::msg)?;
    let (set, preset) = (&values.set, values.preset.as_deref());
    load_text(&source, set, preset, out, budget, &Schemas::new(registry))
}

/// The same for a recipe whose text is known; paths among the values are seen from the working directory.
pub(crate) fn load_text(
    source: &Source,
    set: &[(String, String)],
    preset: Option<&str>,
    out: &Path,
    budget: u64,
    schemas: &Schemas,
) -> anyhow::Result<Loaded> {
    let folder = std::env::current_dir().context("cannot tell the working directory")?;
    let values = Values {
        set,
        preset,
        folder: Some(&folder),
    };
    Ok(load_by(schemas, source, values, out, budget))
}

/// Reads and checks a recipe whose text is known, with values that say from where paths are seen.
pub(crate) fn load_source(
    source: &Source,
    values: Values,
    out: &Path,
    budget: u64,
    registry: &Registry,
) -> Loaded {
    load_by(&Schemas::new(registry), source, values, out, budget)
}

fn load_by(schemas: &Schemas, source: &Source, values: Values, out: &Path, budget: u64) -> Loaded {
    let reading = recipe::read_by(schemas, source, values);
    let mut files = Files {
        input: source.folder().to_path_buf(),
        output: out.to_path_buf(),
        placeholders: reading.recipe.placeholders(),
        ..Files::default()
    };
    let forecast = recipe::check(&reading.recipe, &files, budget);
    if !forecast.outputs.is_empty() && !forecast.has_errors() {
        let stamp = Stamp::new(&reading.recipe, &forecast.inputs);
        files.provenance = Some(stamp.to_string());
    }
    let is_read = !reading.has_errors();
    let mut diagnostics = reading.diagnostics;
    diagnostics.extend(forecast.diagnostics.iter().cloned());
    diagnostics.sort_by_key(|d| (d.source, d.span));
    Loaded {
        path: source.path.display().to_string(),
        recipe: reading.recipe,
        files,
        forecast,
        is_read,
        diagnostics,
    }
}

/// Reads the objects of a file, for expectations that compare with one.
pub(crate) fn read_objects(path: &Path, files: &Files) -> Result<Vec<Object>, String> {
    let loaded = mesh_io::read(&store::Disk, path, &mesh_io::ReadOptions::default())
        .map_err(|error| error.to_string())?;
    for file in loaded.files {
        if file.is_read {
            files.has_read(file.path);
        } else {
            files.has_looked_for(file.path);
        }
    }
    Ok(loaded.objects)
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
