//! From scenes to images.

use glam::DVec3;
use progress::Progress;
use render::figure::label::{Label, draw_labels};
use render::figure::legend::{Legend, draw_legend};
use render::{
    Camera, Drawing, Image, Overlays, PictureError, Style, View, build, bytes_needed, render,
};
use scene::Scene;

use crate::numbers::{Numbers, Shown};
use crate::sheet::{Cell, SheetStyle, sheet};

/// Ink of numbers beside elements, in sRGB.
const INK: [u8; 4] = [0x1f, 0x29, 0x37, 255];

/// The height of the numbers beside elements, in pixels.
const LETTERS: f64 = 13.0;

/// The steps in which the progress of an image is reported.
const PARTS: u64 = 1000;

/// How scenes are drawn.
#[derive(Clone, Debug)]
pub struct Shot<'a> {
    /// The width and the height of each view in pixels.
    pub size: [u32; 2],
    /// Where the scenes are seen from. The views stand side by side.
    pub cameras: &'a [Camera],
    /// How many views stand in a row. If omitted, one for each scene, or all views of one scene but at most 4.
    pub columns: Option<u32>,
    /// Shading, lines and background.
    pub style: &'a Style,
    /// The number of images in one turn of the camera around the scenes; 1 if nothing moves.
    pub frames: u32,
    /// The bytes that the images and the work for them may take.
    pub budget: u64,
}

/// A scene that is ready to be drawn.
pub struct Subject<'s> {
    drawing: Drawing<'s>,
    shown: Option<Shown>,
    caption: &'s str,
}

impl<'s> Subject<'s> {
    /// A scene with its overlays and numbers, and the `caption` below it unless that is empty. `images` gives the bytes
    /// of an image that a material names by its path. Returns also which images are missing, and why.
    ///
    /// # Errors
    ///
    /// Those of [`render::build()`].
    pub fn new(
        scene: &'s Scene,
        caption: &'s str,
        style: &Style,
        mut overlays: Overlays,
        numbers: Option<Numbers>,
        images: &mut dyn FnMut(&str) -> Option<Vec<u8>>,
    ) -> Result<(Self, Vec<String>), PictureError> {
        let shown = numbers.map(|numbers| {
            overlays.colorings = numbers.colorings;
            numbers.shown
        });
        let (drawing, missing) = build(scene, style, &overlays, images)?;
        let subject = Self {
            drawing,
            shown,
            caption,
        };
        Ok((subject, missing))
    }
}

/// What a scene takes up of a picture: pictures of several scenes [within](Shot::draw) what all of them take up
/// [together](Self::join) show the same place in the same scale, and the same numbers in the same colors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Extent {
    /// Points that decide where cameras are that fit.
    points: Vec<DVec3>,
    /// What their colors mean, if numbers are shown.
    shown: Option<Shown>,
}

impl Extent {
    /// Adds what another scene takes up.
    pub fn join(&mut self, other: Self) {
        self.points.extend(other.points);
        match (&mut self.shown, other.shown) {
            (Some(shown), Some(other)) => shown.join(&other),
            (none, other) => *none = none.take().or(other),
        }
    }

    /// The numbers of the first and the last color, if numbers are shown.
    pub fn range(&self) -> Option<[f64; 2]> {
        self.shown.as_ref().map(|shown| shown.range)
    }

    /// What the colors of numbers mean in all of them, if numbers are shown and explained.
    pub fn legend(&self) -> Option<Legend> {
        self.shown.as_ref().and_then(Shown::legend)
    }
}

impl Shot<'_> {
    /// The pixels of all images of a scene together.
    pub fn n_pixels(&self) -> u64 {
        let [width, height] = self.size.map(u64::from);
        width * height * self.cameras.len() as u64 * u64::from(self.frames)
    }

    /// What a scene takes up, to draw it beside others that are not in memory with it.
    ///
    /// # Errors
    ///
    /// [`PictureError::Camera`] if a camera does not see anything.
    pub fn extent(&self, subject: Subject) -> Result<Extent, PictureError> {
        let mut points = Vec::new();
        for camera in self.cameras {
            let each = |each: &mut dyn FnMut(DVec3)| subject.drawing.each_point(each);
            points.extend(camera.extreme_points(&each, self.size)?);
        }
        let shown = subject.shown;
        Ok(Extent { points, shown })
    }

    /// Draws scenes side by side in one scale, each with its caption: the images of a turn, or one. Cameras that fit see
    /// all of `within`, or if it is omitted, all of the scenes.
    ///
    /// # Errors
    ///
    /// [`PictureError::Budget`] before anything is drawn, [`PictureError::Camera`], [`PictureError::Cancelled`].
    pub fn draw(
        &self,
        subjects: &[Subject],
        within: Option<&Extent>,
        progress: &dyn Progress,
    ) -> Result<Vec<Image>, PictureError> {
        let look = self.style.look();
        let drawn = |subject: &Subject| bytes_needed(&subject.drawing, self.size, &look);
        let all = 4 * self.n_pixels() * subjects.len() as u64;
        let needed = all.saturating_add(subjects.iter().map(drawn).max().unwrap_or(0));
        if needed > self.budget {
            let budget = self.budget;
            return Err(PictureError::Budget { needed, budget });
        }
        let total = u64::from(self.frames) * (self.cameras.len() * subjects.len()) as u64;
        let mut done = 0;
        let mut frames = Vec::new();
        for frame in 0..self.frames {
            let turn = 360.0 * f64::from(frame) / f64::from(self.frames);
            let mut views = Vec::new();
            for camera in self.cameras {
                let camera = if self.frames > 1 {
                    camera.turned(turn)
                } else {
                    *camera
                };
                let points = |each: &mut dyn FnMut(DVec3)| match within {
                    Some(extent) => extent.points.iter().for_each(|&p| each(p)),
                    None => subjects.iter().for_each(|s| s.drawing.each_point(each)),
                };
                let view = View::new(&camera, &points, self.size)?;
                for subject in subjects {
                    let progress = OneOf {
                        all: progress,
                        done,
                        total,
                    };
                    views.push((self.view(subject, &view, &progress)?, subject.caption));
                    done += 1;
                }
            }
            frames.push(self.side_by_side(views, subjects.len())?);
        }
        Ok(frames)
    }

    fn view(
        &self,
        subject: &Subject,
        view: &View,
        progress: &dyn Progress,
    ) -> Result<Image, PictureError> {
        let drawing = &subject.drawing;
        let rendered = render(drawing, view, self.size, &self.style.look(), progress)?;
        let mut image = rendered.image;
        let labels: Vec<Label> = (drawing.labels.iter().zip(&rendered.labels))
            .filter_map(|(label, placed)| Some((label, placed.filter(|p| !p.is_hidden)?)))
            .map(|(label, placed)| Label::new(placed.at, &*label.text, LETTERS, INK))
            .collect();
        draw_labels(&mut image, &labels);
        if let Some(legend) = subject.shown.as_ref().and_then(Shown::legend) {
            // As large as letters are in a picture of usual size.
            let scale = (f64::from(self.size[1]) / 720.0).clamp(0.5, 8.0);
            draw_legend(&mut image, &legend, scale);
        }
        Ok(image)
    }

    /// Views in rows, on the background of the picture.
    fn side_by_side(
        &self,
        mut views: Vec<(Image, &str)>,
        n_scenes: usize,
    ) -> Result<Image, PictureError> {
        if let [(_, "")] = views[..] {
            return Ok(views.remove(0).0);
        }
        let cells: Vec<Cell> = (views.iter())
            .map(|(image, caption)| Cell { image, caption })
            .collect();
        let usual = if n_scenes > 1 {
            n_scenes
        } else {
            views.len().min(4)
        };
        let style = SheetStyle {
            columns: self.columns.map_or(usual, |n| n as usize),
            gap: 0,
            background: self.style.background.srgb(),
            ..SheetStyle::default()
        };
        sheet(&cells, &style, self.budget)
    }
}

/// The progress of one image out of several.
struct OneOf<'a> {
    all: &'a dyn Progress,
    done: u64,
    total: u64,
}

impl Progress for OneOf<'_> {
    fn advance(&self, what: &str, done: u64, total: u64) -> bool {
        let part = PARTS * done / total.max(1);
        self.all
            .advance(what, PARTS * self.done + part, PARTS * self.total)
    }
}
