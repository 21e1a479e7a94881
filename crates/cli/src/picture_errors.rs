//! `--picture-errors`: each failure as a picture of the scene, with the elements that it is about large and marked.

use std::path::{Path, PathBuf};
use std::sync::Mutex;

use clap::Args as ClapArgs;
use op::{Context, Files, NoProgress, Place, Progress};
use picture::draw_places;
use recipe::{Failure, Listener, StepDone};
use scene::Scene;

use crate::commands::picture::STAMP;
use crate::output::{complain, write_whole};
use crate::scenes::BUDGET;

#[derive(Debug, ClapArgs)]
pub(crate) struct PictureErrorsArgs {
    /// Draw each failure into this folder, the working directory unless told otherwise: the scene, with the
    /// elements that it is about large and marked
    #[arg(
        long,
        value_name = "DIR",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "."
    )]
    pub(crate) picture_errors: Option<PathBuf>,
}

impl PictureErrorsArgs {
    /// The pictures of a file, if they are wanted: beside each other, named after it and numbered.
    pub(crate) fn of(&self, file: &Path) -> Option<Pictures> {
        let name = file.file_stem().unwrap_or_default();
        self.named(Path::new(name))
    }

    /// The same with a name that may have folders.
    pub(crate) fn named(&self, name: &Path) -> Option<Pictures> {
        let folder = self.picture_errors.as_deref()?;
        let here = Path::new(".");
        let base = if folder == here {
            name.to_path_buf()
        } else {
            folder.join(name)
        };
        Some(Pictures {
            base: base.display().to_string(),
            drawn: Mutex::default(),
        })
    }
}

/// Pictures that are drawn during a run.
pub(crate) struct Pictures {
    /// How their paths begin.
    base: String,
    drawn: Mutex<Drawn>,
}

#[derive(Clone, Default)]
struct Drawn {
    paths: Vec<PathBuf>,
    problems: Vec<String>,
}

impl Pictures {
    /// Draws places of a scene. Why one could not be drawn is told with the others.
    pub(crate) fn draw(&self, scene: &Scene, places: &[Place], caption: &str) {
        let mut drawn = self.drawn();
        let number = drawn.paths.len() + drawn.problems.len() + 1;
        let path = PathBuf::from(format!("{}-error-{number}.png", self.base));
        match write(scene, places, caption, &path) {
            Ok(true) => drawn.paths.push(path),
            Ok(false) => {}
            Err(error) => drawn.problems.push(format!("{error:#}")),
        }
    }

    /// The files that were written.
    pub(crate) fn paths(&self) -> Vec<PathBuf> {
        self.drawn().paths.clone()
    }

    /// Says which pictures there are, and why others are not.
    pub(crate) fn tell(&self) {
        let drawn = self.drawn();
        for path in &drawn.paths {
            complain(&format!("see {}\n", path.display()));
        }
        for problem in &drawn.problems {
            complain(&format!("warning: a failure was not drawn: {problem}\n"));
        }
    }

    fn drawn(&self) -> std::sync::MutexGuard<'_, Drawn> {
        let drawn = self.drawn.lock();
        drawn.unwrap_or_else(std::sync::PoisonError::into_inner)
    }
}

/// Writes the picture; whether there was anything to see.
fn write(scene: &Scene, places: &[Place], caption: &str, path: &Path) -> anyhow::Result<bool> {
    let files = Files::default();
    let mut cx = Context::new(&NoProgress, &files);
    cx.budget = BUDGET;
    let Some(image) = draw_places(scene, places, caption, &mut cx)? else {
        return Ok(false);
    };
    write_whole(path, &image.to_png(&[("Software", STAMP)])?)?;
    Ok(true)
}

/// A listener that draws the failures of a run too.
pub(crate) struct Picturing<'a> {
    pub(crate) listener: &'a dyn Listener,
    /// Where to; nowhere if `None`.
    pub(crate) pictures: Option<&'a Pictures>,
}

impl Progress for Picturing<'_> {
    fn advance(&self, what: &str, done: u64, total: u64) -> bool {
        self.listener.advance(what, done, total)
    }
}

impl Listener for Picturing<'_> {
    fn step_begins(&self, number: usize, label: &str) {
        self.listener.step_begins(number, label);
    }

    fn step_done(&self, number: usize, done: &StepDone) {
        self.listener.step_done(number, done);
    }

    fn wants_digests(&self) -> bool {
        self.listener.wants_digests()
    }

    fn failed(&self, failure: &Failure) {
        if let Some(pictures) = self.pictures {
            pictures.draw(failure.scene, failure.places, &failure.diagnostic.message);
        }
    }

    fn wants_places(&self) -> bool {
        self.pictures.is_some()
    }
}
