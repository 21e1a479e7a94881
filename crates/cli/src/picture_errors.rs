//! `--picture-errors`: draws the scene of each failure, with the affected elements enlarged and highlighted.

use std::path::{Path, PathBuf};
use std::sync::Mutex;

use mesh::counted;
use op::{ErrorLocation, Progress};
use recipe::{ActualValue, Failure, Listener, StepDone};
use render::{Image, difference};
use scene::Scene;
use view::draw_error_locations;
use view::sheet::{Cell, SheetStyle, sheet};

use crate::args::PictureErrorsArgs;
use crate::listener::{INTERRUPT, lock};
use crate::output::{STAMP, escape_control, print_error, write_atomically};

impl PictureErrorsArgs {
    /// Returns the object that draws the failures of a file, if pictures of failures are requested. `budget` is the
    /// memory budget of each picture, in bytes.
    pub(crate) fn of(&self, file: &Path, budget: u64) -> Pictures {
        self.named(Path::new(store::stem(file)), budget)
    }

    /// Like [`of`](Self::of), but the name of the pictures can contain folders.
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

/// Maximum number of pictures of a run.
const MAX_PICTURES: usize = 20;

/// The maximum size, in bytes, of the file of an expected image. A larger file is not drawn beside the actual image.
const MAX_FILE_SIZE: u64 = 64 << 20;

/// Draws the failures of a run if `--picture-errors` is given, and keeps a list of the pictures.
#[derive(Default)]
pub(crate) struct Pictures {
    /// The path of a picture is this path with an ending such as `-error-1.png`. If `None`, no pictures are drawn.
    base: Option<PathBuf>,
    /// The memory budget of each picture, in bytes.
    budget: u64,
    drawn: Mutex<Drawn>,
}

#[derive(Default)]
struct Drawn {
    /// The paths of the written pictures, each with its caption.
    files: Vec<(PathBuf, String)>,
    /// The errors that occurred while pictures were drawn or written.
    problems: Vec<String>,
    /// The number of failures beyond [`MAX_PICTURES`]. These failures are not drawn.
    further: usize,
}

impl Pictures {
    /// Draws a scene with the locations of a failure, unless the maximum number of pictures is reached. If an error
    /// occurs, it is kept, and [`warn`](Self::warn) prints it later.
    pub(crate) fn draw(&self, scene: &Scene, places: &[ErrorLocation], caption: &str) {
        let (budget, progress) = (self.budget, &INTERRUPT);
        self.add(caption, || {
            Ok(draw_error_locations(
                scene, places, caption, budget, progress,
            )?)
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

    /// Calls `draw`, and writes the image that it returns, if any.
    fn add(&self, caption: &str, draw: impl FnOnce() -> anyhow::Result<Option<Image>>) {
        let Some(base) = &self.base else { return };
        let mut drawn = lock(&self.drawn);
        let number = drawn.files.len() + drawn.problems.len() + 1;
        if number > MAX_PICTURES {
            drawn.further += 1;
            return;
        }
        let mut path = base.clone().into_os_string();
        path.push(format!("-error-{number}.png"));
        let path = PathBuf::from(path);
        let write = |image: Image| write_atomically(&path, &image.to_png(&[("Software", STAMP)])?);
        match draw().and_then(|image| image.map(write).transpose()) {
            Ok(Some(())) => drawn.files.push((path, caption.to_owned())),
            Ok(None) => {}
            Err(error) => drawn.problems.push(format!("{error:#}")),
        }
    }

    /// Returns the paths of the written files.
    pub(crate) fn paths(&self) -> Vec<PathBuf> {
        let drawn = lock(&self.drawn);
        drawn.files.iter().map(|(path, _)| path.clone()).collect()
    }

    /// Prints the paths and captions of the pictures, and warnings.
    pub(crate) fn print_list(&self) {
        for (path, caption) in &lock(&self.drawn).files {
            print_error(&format!(
                "see {}: {}\n",
                path.display(),
                escape_control(caption)
            ));
        }
        self.warn();
    }

    /// Prints warnings about failures that were not drawn.
    pub(crate) fn warn(&self) {
        let drawn = lock(&self.drawn);
        for problem in &drawn.problems {
            print_error(&format!(
                "warning: cannot make a picture of a failure: {problem}\n"
            ));
        }
        if drawn.further > 0 {
            let n = drawn.further;
            let failures = counted(n, "failure");
            print_error(&format!(
                "warning: at most {MAX_PICTURES} pictures of failures are written, so no picture shows the last {failures}\n"
            ));
        }
    }

    /// Draws the expected image, the actual image and their difference side by side. Returns `None` if one of the files
    /// is not a PNG image, or if the expected image is missing or too large.
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
        let is_small = std::fs::metadata(golden).is_ok_and(|file| file.len() <= MAX_FILE_SIZE);
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
        // Wide images are placed one below the other.
        let is_wide =
            expected.width.max(found.width) > expected.height.max(found.height).saturating_mul(3);
        let style = SheetStyle {
            columns: if is_wide { 1 } else { 3 },
            ..SheetStyle::default()
        };
        Ok(Some(sheet(&cells, &style, self.budget)?))
    }
}

/// A listener that also draws the failures of a run.
pub(crate) struct PictureListener<'a> {
    pub(crate) listener: &'a dyn Listener,
    pub(crate) pictures: &'a Pictures,
}

impl Progress for PictureListener<'_> {
    fn advance(&self, what: &str, done: u64, total: u64) -> bool {
        self.listener.advance(what, done, total)
    }
}

impl Listener for PictureListener<'_> {
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
