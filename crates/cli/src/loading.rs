//! From the path of a recipe to what runs it.

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use op::{Files, Registry};
use recipe::{Diagnostic, Forecast, Recipe, Severity, Source, Stamp, Values};
use scene::Object;

use crate::args::RecipeArgs;

/// A recipe that was read and checked.
pub(crate) struct Loaded {
    pub(crate) path: String,
    pub(crate) recipe: Recipe,
    pub(crate) files: Files,
    pub(crate) forecast: Forecast,
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

    /// The diagnostics as a compiler shows them.
    pub(crate) fn render(&self, diagnostics: &[Diagnostic], colours: bool) -> String {
        recipe::render(&self.recipe.sources, diagnostics, colours)
    }
}

/// Reads and checks the recipe of a command.
pub(crate) fn load(args: &RecipeArgs, registry: &Registry) -> anyhow::Result<Loaded> {
    let preset = args.preset.as_deref();
    load_recipe(
        &args.recipe,
        &args.set,
        preset,
        &args.out,
        args.budget,
        registry,
    )
}

/// Reads and checks a recipe.
pub(crate) fn load_recipe(
    path: &Path,
    set: &[(String, String)],
    preset: Option<&str>,
    out: &Path,
    budget: u64,
    registry: &Registry,
) -> anyhow::Result<Loaded> {
    let source = Source::open(path).map_err(anyhow::Error::msg)?;
    let folder = std::env::current_dir().context("cannot tell the working directory")?;
    let values = Values {
        set,
        preset,
        folder: Some(&folder),
    };
    Ok(load_source(&source, values, out, budget, registry))
}

/// Reads and checks a recipe whose text is known.
pub(crate) fn load_source(
    source: &Source,
    values: Values,
    out: &Path,
    budget: u64,
    registry: &Registry,
) -> Loaded {
    let reading = recipe::read(source, registry, values);
    let mut files = Files {
        input: source.folder().to_path_buf(),
        output: out.to_path_buf(),
        placeholders: reading.recipe.placeholders(),
        provenance: None,
    };
    let forecast = recipe::check(&reading.recipe, &files, budget);
    if !forecast.outputs.is_empty() && !forecast.has_errors() {
        let stamp = Stamp::new(&reading.recipe, &forecast.inputs);
        files.provenance = Some(stamp.to_string());
    }
    let mut diagnostics = reading.diagnostics;
    diagnostics.extend(forecast.diagnostics.iter().cloned());
    diagnostics.sort_by_key(|d| (d.source, d.span));
    Loaded {
        path: source.path.display().to_string(),
        recipe: reading.recipe,
        files,
        forecast,
        diagnostics,
    }
}

/// Reads the objects of a file, for expectations that compare with one.
pub(crate) fn read_objects(path: &Path) -> Result<Vec<Object>, String> {
    mesh_io::read(path, &mesh_io::ReadOptions::default())
        .map(|loaded| loaded.objects)
        .map_err(|error| error.to_string())
}

/// The recipes below the paths, in order; files as they are given.
pub(crate) fn recipes(paths: &[PathBuf]) -> anyhow::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for path in paths {
        if path.is_dir() {
            let entries = std::fs::read_dir(path)
                .with_context(|| format!("cannot list {}", path.display()))?;
            let mut here: Vec<PathBuf> = entries
                .map(|entry| entry.map(|e| e.path()))
                .collect::<Result<_, _>>()?;
            here.retain(|p| p.extension().is_some_and(|e| e == "ron"));
            here.sort();
            found.extend(here);
        } else {
            anyhow::ensure!(
                path.exists(),
                "there is no file or folder {}",
                path.display()
            );
            found.push(path.clone());
        }
    }
    Ok(found)
}
