//! Tests of recipes with a small registry of test operations, from the text to the outcome.

mod check;
mod flow;
mod operations;
mod read;
mod run;
mod update;
mod upgrade;

use std::path::Path;

use op::Files;
use scene::{Graph, Object, Scene};

use self::operations::{registry, steps};
use crate::{Diagnostic, Forecast, Outcome, Reader, Reading, Settings, Silent, Violation};

/// A reader that calls a function to read the objects of a file. It cannot compare pictures.
pub(crate) struct Objects<F>(F);

/// Creates an [`Objects`] from a closure. The trait bound lets the compiler infer the types of the closure's
/// parameters.
pub(crate) fn objects<F>(read: F) -> Objects<F>
where
    F: Fn(&Path, &Files) -> Result<Vec<Object>, String> + Sync,
{
    Objects(read)
}

impl<F: Fn(&Path, &Files) -> Result<Vec<Object>, String> + Sync> Reader for Objects<F> {
    fn scene(&self, path: &Path, files: &Files) -> Result<Scene, Violation> {
        let mut scene = Scene::new();
        let appended = scene.append((self.0)(path, files)?, Graph::default());
        appended.map_err(|error| error.to_string())?;
        Ok(scene)
    }

    fn compare_pictures(
        &self,
        _: (&Path, &[u8]),
        _: (&Path, &[u8]),
        _: u8,
    ) -> Result<Option<String>, Violation> {
        Err("these tests compare no pictures".into())
    }
}

/// Reads a recipe as if it were the file `/work/test.ron`.
fn read(text: &str) -> Reading {
    read_with(text, &[])
}

fn read_with(text: &str, set: &[(&str, &str)]) -> Reading {
    let owned = |&(name, value): &(&str, &str)| (name.to_owned(), value.to_owned());
    let set: Vec<_> = set.iter().map(owned).collect();
    let values = crate::Values {
        set: &set,
        ..crate::Values::default()
    };
    crate::read(
        &crate::Source::new("/work/test.ron", text),
        &registry(),
        values,
    )
}

fn files(reading: &Reading, output: &Path) -> Files {
    Files {
        output: output.into(),
        placeholders: reading.recipe.placeholders(),
        ..Files::default()
    }
}

/// Reads a recipe, which must not have errors, and checks it.
#[track_caller]
fn checked(text: &str, budget: u64) -> Forecast {
    let reading = read(text);
    assert!(!reading.has_errors(), "{text}: {:#?}", reading.diagnostics);
    crate::check(&reading.recipe, &files(&reading, Path::new("out")), budget)
}

/// Runs a recipe without errors that reads and writes no files.
#[track_caller]
fn run(reading: &Reading) -> Outcome {
    assert!(!reading.has_errors(), "{:#?}", reading.diagnostics);
    let settings = Settings {
        files: &files(reading, Path::new("out")),
        budget: u64::MAX,
        reader: &objects(|path, _| Err(format!("the file {} does not exist", path.display()))),
        keep_outputs: false,
        writes: false,
        cache: None,
    };
    crate::run(&reading.recipe, settings, &Silent)
}

/// Returns the text in the span, the message and the help of each diagnostic.
fn shown<'t>(text: &'t str, diagnostics: &'t [Diagnostic]) -> Vec<(&'t str, &'t str, &'t str)> {
    let one = |d: &'t Diagnostic| {
        let place = d.span.map_or("no span", |span| span.of(text));
        (place, d.message.as_str(), d.help.as_deref().unwrap_or(""))
    };
    diagnostics.iter().map(one).collect()
}
