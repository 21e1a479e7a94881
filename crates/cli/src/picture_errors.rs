//! `--picture-errors`: each failure as a picture of the scene, with the elements that it is about large and marked.

use std::path::{Path, PathBuf};
use std::sync::Mutex;

use op::{ErrorLocation, Progress};
use recipe::{ActualValue, Failure, Listener, StepDone};
use render::{Image, difference};
use scene::Scene;
use view::draw_places;
use view::sheet::{Cell, SheetStyle, sheet};

use crate::args::PictureErrorsArgs;
use crate::listener::{QUIET, lock};
use crate::output::{STAMP, complain, shown, write_whole};

impl PictureErrorsArgs {
    /// The numbered pictures of a file, and the memory that each may use, in bytes.
    pub(crate) fn of(&self, file: &Path, budget: u64) -> Pictures {
        self.named(Path::new(file.file_stem().unwrap_or_default()), budget)
    }

    /// The same with a name that may have folders.
    pub(crate) fn named(&self, name: &Path, budget: u64) -> Pictures {
        let base = self.picture_errors.as_deref().map(|folder| {
            if folder == Path::new(".") {
                name.to_path_buf()
            } else {
                folder.join(name)
            }
        });
        Pictures {
            base,
            budget,
            drawn: Mutex::default(),
        }
    }
}

/// So many failures of a run are drawn; others are like these.
const MOST: usize = 20;

/// Larger files are not pictures that a recipe makes.
const LARGEST: u64 = 64 << 20;

/// Pictures that are drawn during a run, if they are wanted.
#[derive(Default)]
pub(crate) struct Pictures {
    /// How their paths begin; `None` if nothing is drawn.
    base: Option<PathBuf>,
    /// The bytes that each may take.
    budget: u64,
    drawn: Mutex<Drawn>,
}

#[derive(Default)]
struct Drawn {
    /// The files, each with what it shows.
    files: Vec<(PathBuf, String)>,
    /// Why some are not there.
    problems: Vec<String>,
    /// How many failures were not drawn because there are others.
    further: usize,
}

impl Pictures {
    /// Draws places of a scene, unless many were drawn before. Why one could not be drawn is told with the others.
    pub(crate) fn draw(&self, scene: &Scene, places: &[ErrorLocation], caption: &str) {
        let (budget, progress) = (self.budget, &QUIET);
        self.add(caption, || {
            Ok(draw_places(scene, places, caption, budget, progress)?)
        });
    }

    /// Draws a failure of a run.
    fn draw_failure(&self, failure: &Failure) {
        let message = &failure.diagnostic.message;
        match failure.found.map(|found| self.of_difference(found)) {
            None | Some(Ok(None)) => self.draw(failure.scene, failure.places, message),
            Some(image) => self.add(message, || image),
        }
    }

    /// Writes an image, if there is anything to see.
    fn add(&self, caption: &str, draw: impl FnOnce() -> anyhow::Result<Option<Image>>) {
        let Some(base) = &self.base else { return };
        let mut drawn = lock(&self.drawn);
        let number = drawn.files.len() + drawn.problems.len() + 1;
        if number > MOST {
            drawn.further += 1;
            return;
        }
        let mut path = base.clone().into_os_string();
        path.push(format!("-error-{number}.png"));
        let path = PathBuf::from(path);
        let write = |image: Image| write_whole(&path, &image.to_png(&[("Software", STAMP)])?);
        match draw().and_then(|image| image.map(write).transpose()) {
            Ok(Some(())) => drawn.files.push((path, caption.to_owned())),
            Ok(None) => {}
            Err(error) => drawn.problems.push(format!("{error:#}")),
        }
    }

    /// The files that were written.
    pub(crate) fn paths(&self) -> Vec<PathBuf> {
        let drawn = lock(&self.drawn);
        drawn.files.iter().map(|(path, _)| path.clone()).collect()
    }

    /// Says which pictures there are.
    pub(crate) fn tell(&self) {
        for (path, caption) in &lock(&self.drawn).files {
            complain(&format!("see {}: {}\n", path.display(), shown(caption)));
        }
        self.warn();
    }

    /// Says which pictures there are not.
    pub(crate) fn warn(&self) {
        let drawn = lock(&self.drawn);
        for problem in &drawn.problems {
            complain(&format!("warning: a failure was not drawn: {problem}\n"));
        }
        if drawn.further > 0 {
            let n = drawn.further;
            let what = format!("failures behind the first {MOST} were not drawn: {n}");
            complain(&format!("warning: {what}\n"));
        }
    }

    /// The picture that was expected, the one that was found, and where they differ; `None` if these are no pictures of
    /// one image.
    fn of_difference(&self, found: &ActualValue) -> anyhow::Result<Option<Image>> {
        let ActualValue::File {
            golden,
            bytes,
            tolerance,
            ..
        } = found
        else {
            return Ok(None);
        };
        let ending = golden.extension().unwrap_or_default();
        let is_png = ending.eq_ignore_ascii_case("png");
        let is_small = std::fs::metadata(golden).is_ok_and(|file| file.len() <= LARGEST);
        if !(is_png && is_small) {
            return Ok(None);
        }
        let expected = Image::from_png(&std::fs::read(golden)?);
        let (Ok(expected), Ok(found)) = (expected, Image::from_png(bytes)) else {
            return Ok(None);
        };
        let difference = difference(&expected, &found, *tolerance);
        let images = [Some(&expected), Some(&found), difference.as_ref()];
        let captions = ["expected", "found", "difference"];
        let cells: Vec<Cell> = (images.into_iter().zip(captions))
            .filter_map(|(image, caption)| image.map(|image| Cell { image, caption }))
            .collect();
        // Wide ones stand below each other.
        let is_wide =
            expected.width.max(found.width) > expected.height.max(found.height).saturating_mul(3);
        let style = SheetStyle {
            columns: if is_wide { 1 } else { 3 },
            ..SheetStyle::default()
        };
        Ok(Some(sheet(&cells, &style, self.budget)?))
    }
}

/// A listener that draws the failures of a run too.
pub(crate) struct Picturing<'a> {
    pub(crate) listener: &'a dyn Listener,
    pub(crate) pictures: &'a Pictures,
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
        if self.wants_places() {
            self.pictures.draw_failure(failure);
        }
    }

    fn wants_places(&self) -> bool {
        self.pictures.base.is_some()
    }
}
