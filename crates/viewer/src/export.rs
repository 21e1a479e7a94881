//! Exports the edits in the player as an animation. One image is drawn in each frame of the window. A separate thread
//! encodes the images.

use std::path::{Path, PathBuf};
use std::thread::JoinHandle;

use eframe::egui::Context;
use op::NoProgress;
use render::Image;
use render::animation::{Timing, to_apng, to_gif};

use crate::app::Parts;

/// The maximum number of images of an animation, not counting the image after the last edit. If there are at least this
/// many edits, several edits are done between two images.
const MAX_IMAGES: usize = 300;

/// An animation that is being written.
pub(crate) enum Export {
    /// The images are being drawn.
    Drawing(Drawing),
    /// The file is being written.
    Writing(PathBuf, JoinHandle<Result<(), String>>),
}

/// Images that are being drawn.
pub(crate) struct Drawing {
    path: PathBuf,
    is_gif: bool,
    images: Vec<Image>,
    /// For each image, the number of edits that have been played when the image is drawn.
    moments: Vec<usize>,
}

impl Parts {
    /// Starts the export of an animation that shows the edits in the player.
    pub(crate) fn export(&mut self, path: &Path, is_gif: bool) {
        let Some(player) = &mut self.player else {
            return;
        };
        player.pause();
        let n = player.n_edits();
        let stride = (n + 1).div_ceil(MAX_IMAGES);
        let moments = (0..n).step_by(stride).chain([n]).collect();
        self.export = Some(Export::Drawing(Drawing {
            path: path.to_owned(),
            is_gif,
            images: Vec::new(),
            moments,
        }));
    }

    /// Shows the mesh as it must appear in the next image.
    pub(crate) fn show_exported(&mut self) {
        if let (Some(Export::Drawing(drawing)), Some(player)) = (&self.export, &mut self.player) {
            player.go_to(drawing.moments[drawing.images.len()]);
        }
    }

    /// Takes the image that the view has drawn, and writes the file after the last image.
    pub(crate) fn take_exported(&mut self, ctx: &Context) {
        match self.export.take() {
            None => return,
            Some(Export::Drawing(mut drawing)) => {
                let (Some(player), Some(image)) = (&self.player, self.view.picture()) else {
                    self.warn("The animation was not exported: the edits are no longer shown.");
                    return;
                };
                drawing.images.push(image);
                self.export = Some(if drawing.images.len() < drawing.moments.len() {
                    Export::Drawing(drawing)
                } else {
                    let timing = timing(player.speed());
                    let path = drawing.path.clone();
                    Export::Writing(path, std::thread::spawn(move || drawing.write(timing)))
                });
            }
            Some(Export::Writing(path, thread)) if thread.is_finished() => match thread.join() {
                Ok(Ok(())) => self.inform(format!("Saved {}", path.display())),
                Ok(Err(message)) => self.warn(message),
                Err(_) => self.warn("internal error while the animation was written"),
            },
            writing => self.export = writing,
        }
        ctx.request_repaint();
    }
}

/// Returns how long each image is shown, where `speed` is the number of edits per second.
fn timing(speed: f64) -> Timing {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the speed is from 0.5 to 30"
    )]
    let delay = (1000.0 / speed).clamp(20.0, 10_000.0) as u16;
    Timing { delay, plays: 0 }
}

impl Drawing {
    fn write(&self, timing: Timing) -> Result<(), String> {
        let bytes = if self.is_gif {
            to_gif(&self.images, timing, None, &NoProgress)
        } else {
            to_apng(&self.images, timing, &[], &NoProgress)
        };
        let bytes = bytes.map_err(|error| error.to_string())?;
        std::fs::write(&self.path, bytes)
            .map_err(|error| format!("cannot write {}: {error}", self.path.display()))
    }
}
