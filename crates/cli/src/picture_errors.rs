//! `--picture-errors`: each failure as a picture of the scene, with the elements that it is about large and marked.

use std::path::{Path, PathBuf};
use std::sync::Mutex;

use clap::Args as ClapArgs;
use op::{Context, Files, Place, Progress};
use picture::draw_places;
use recipe::{Failure, Found, Listener, StepDone};
use render::sheet::{Cell, SheetStyle, sheet};
use render::{Image, difference};
use scene::Scene;

use crate::commands::picture::STAMP;
use crate::listener::Quiet;
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
        self.write(drawn_scene(scene, places, caption));
    }

    /// Writes an image, if there is anything to see.
    fn write(&self, image: anyhow::Result<Option<Image>>) {
        let mut drawn = self.drawn();
        let number = drawn.paths.len() + drawn.problems.len() + 1;
        let path = PathBuf::from(format!("{}-error-{number}.png", self.base));
        let write = |image: Image| write_whole(&path, &image.to_png(&[("Software", STAMP)])?);
        match image.and_then(|image| image.map(write).transpose()) {
            Ok(Some(())) => drawn.paths.push(path),
            Ok(None) => {}
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

/// A picture of places of a scene, if there is anything to see.
fn drawn_scene(scene: &Scene, places: &[Place], caption: &str) -> anyhow::Result<Option<Image>> {
    let files = Files::default();
    let mut cx = Context::new(&Quiet, &files);
    cx.budget = BUDGET;
    Ok(draw_places(scene, places, caption, &mut cx)?)
}

/// The picture that was expected, the one that was found, and where they differ; `None` if these are no pictures.
fn drawn_difference(found: &Found) -> anyhow::Result<Option<Image>> {
    let Found::File { golden, bytes, .. } = found else {
        return Ok(None);
    };
    let expected = std::fs::read(golden).ok();
    let expected = expected.and_then(|bytes| Image::from_png(&bytes).ok());
    let (Some(expected), Ok(found)) = (expected, Image::from_png(bytes)) else {
        return Ok(None);
    };
    let difference = difference(&expected, &found);
    let images = [
        (Some(&expected), "expected"),
        (Some(&found), "found"),
        (difference.as_ref(), "difference"),
    ];
    let cells: Vec<Cell> = (images.into_iter())
        .filter_map(|(image, caption)| {
            Some(Cell {
                image: image?,
                caption,
            })
        })
        .collect();
    Ok(Some(sheet(&cells, &SheetStyle::default(), BUDGET)?))
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
            match failure.found.map(drawn_difference) {
                Some(Ok(Some(image))) => pictures.write(Ok(Some(image))),
                Some(Err(error)) => pictures.write(Err(error)),
                _ => pictures.draw(failure.scene, failure.places, &failure.diagnostic.message),
            }
        }
    }

    fn wants_places(&self) -> bool {
        self.pictures.is_some()
    }
}
