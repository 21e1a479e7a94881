//! Recipes over a small registry of their own, from the text to the outcome.

mod check;
mod flow;
mod operations;
mod read;
mod run;
mod update;
mod upgrade;

use std::path::Path;

use op::Files;
use scene::Object;

use self::operations::{registry, steps};
use crate::{Diagnostic, Forecast, Outcome, Reader, Reading, Settings, Silent};

/// Reads objects by a function, and compares no pictures.
pub(crate) struct Objects<F>(F);

/// For closures, whose parameters the compiler then knows.
pub(crate) fn objects<F>(read: F) -> Objects<F>
where
    F: Fn(&Path, &Files) -> Result<Vec<Object>, String> + Sync,
{
    Objects(read)
}

impl<F: Fn(&Path, &Files) -> Result<Vec<Object>, String> + Sync> Reader for Objects<F> {
    fn objects(&self, path: &Path, files: &Files) -> Result<Vec<Object>, String> {
        (self.0)(path, files)
    }

    fn compare_pictures(
        &self,
        _: (&Path, &[u8]),
        _: (&Path, &[u8]),
        _: u8,
    ) -> Result<Option<String>, String> {
        Err("no pictures are compared here".to_owned())
    }
}

/// Reads a recipe that is said to lie in the working directory `/work`.
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

/// Checks a recipe without mistakes to be read.
#[track_caller]
fn checked(text: &str, budget: u64) -> Forecast {
    let reading = read(text);
    assert!(!reading.has_errors(), "{text}: {:#?}", reading.diagnostics);
    crate::check(&reading.recipe, &files(&reading, Path::new("out")), budget)
}

/// Runs a recipe that is read without mistakes, and that reads and writes no file.
#[track_caller]
fn run(reading: &Reading) -> Outcome {
    assert!(!reading.has_errors(), "{:#?}", reading.diagnostics);
    let settings = Settings {
        files: &files(reading, Path::new("out")),
        budget: u64::MAX,
        reader: &objects(|path, _| Err(format!("there is no file {}", path.display()))),
        keep_outputs: false,
        writes: false,
        cache: None,
    };
    crate::run(&reading.recipe, settings, &Silent)
}

/// What each diagnostic points at, its message and its advice.
fn shown<'t>(text: &'t str, diagnostics: &'t [Diagnostic]) -> Vec<(&'t str, &'t str, &'t str)> {
    let one = |d: &'t Diagnostic| {
        let place = d.span.map_or("nowhere", |span| span.of(text));
        (place, d.message.as_str(), d.help.as_deref().unwrap_or(""))
    };
    diagnostics.iter().map(one).collect()
}
