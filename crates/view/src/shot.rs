//! Draws scenes from several cameras into images.

use glam::DVec3;
use progress::Progress;
use render::figure::label::{Label, draw_labels};
use render::figure::legend::{Corner, Legend, covered_pixels, draw_legend};
use render::{
    Camera, Drawing, Image, Overlays, PictureError, Style, TextureCache, View, build_within,
    bytes_needed, pixel_bytes, render,
};
use scene::Scene;

use crate::numbers::{ColorScale, Numbers};
use crate::sheet::{Cell, SheetStyle, sheet};

/// The text color of labels of elements, in sRGB.
const TEXT_COLOR: [u8; 4] = [0x1f, 0x29, 0x37, 255];

/// The font size of labels of elements, in pixels.
const FONT_SIZE: f64 = 13.0;

/// The number of progress units of one view.
const STEPS: u64 = 1000;

/// The cameras, sizes and style with which scenes are drawn.
#[derive(Clone, Debug)]
pub struct Shot<'a> {
    /// The width and the height of each view in pixels.
    pub size: [u32; 2],
    /// The cameras. The views of the cameras are placed side by side.
    pub cameras: &'a [Camera],
    /// The number of views in a row. If `None` and there are several scenes, each row shows all scenes from one camera.
    /// If `None` and there is one scene, a row shows the views of all cameras, but at most 4 views.
    pub columns: Option<u32>,
    /// Shading, lines and background.
    pub style: &'a Style,
    /// The number of images in one turn of the camera around the scenes; 1 without animation.
    pub frames: u32,
    /// The memory budget for all images and for drawing them, in bytes.
    pub budget: u64,
}

/// A scene that is prepared for drawing.
pub struct Subject<'s> {
    drawing: Drawing<'s>,
    scale: Option<ColorScale>,
    caption: &'s str,
}

impl<'s> Subject<'s> {
    /// Prepares a scene for drawing, with its overlays and with its numbers as colors. Also returns a message for each
    /// texture that cannot be drawn.
    ///
    /// If `caption` is not empty, it is written below the view. `images` is called with the path of an image file, as
    /// written in a material, and returns the bytes of this file. `budget` is the memory budget in bytes.
    ///
    /// # Errors
    ///
    /// Returns the errors of [`render::build_within`].
    pub fn new(
        scene: &'s Scene,
        caption: &'s str,
        style: &Style,
        mut overlays: Overlays,
        numbers: Option<Numbers>,
        budget: u64,
        images: &mut dyn FnMut(&str) -> Option<Vec<u8>>,
    ) -> Result<(Self, Vec<String>), PictureError> {
        let scale = numbers.map(|numbers| {
            overlays.colorings = numbers.colorings;
            numbers.scale
        });
        let textures = &mut TextureCache::default();
        let (drawing, missing) = build_within(scene, style, &overlays, budget, textures, images)?;
        let subject = Self {
            drawing,
            scale,
            caption,
        };
        Ok((subject, missing))
    }
}

/// The extent of a scene: the data from which the view and the color range for the whole scene are computed.
///
/// With the [joined](Self::join) extents of several scenes, each scene can be [drawn](Shot::draw) separately. The
/// pictures then have the same view and scale, and equal numbers have equal colors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Extent {
    /// The points that determine the view of each camera.
    points: Vec<DVec3>,
    /// The mapping from numbers to colors, if numbers are shown as colors.
    scale: Option<ColorScale>,
}

impl Extent {
    /// Adds the extent of another scene.
    pub fn join(&mut self, other: Self) {
        self.points.extend(other.points);
        match (&mut self.scale, other.scale) {
            (Some(scale), Some(other)) => scale.join(&other),
            (scale, other) => *scale = scale.take().or(other),
        }
    }

    /// Returns the numbers that the first and the last color represent, if numbers are shown as colors.
    pub fn range(&self) -> Option<[f64; 2]> {
        self.scale.as_ref().map(|scale| scale.range)
    }

    /// Returns the common legend of all joined scenes, if numbers are shown as colors with a legend.
    pub fn legend(&self) -> Option<Legend> {
        self.scale.as_ref().and_then(ColorScale::legend)
    }
}

impl Shot<'_> {
    /// Returns the total number of pixels in the images of one scene.
    pub fn n_pixels(&self) -> u64 {
        let [width, height] = self.size.map(u64::from);
        width * height * self.cameras.len() as u64 * u64::from(self.frames)
    }

    /// Checks whether the budget is enough for the pixels of all images of `n_scenes` scenes. The check does not need
    /// the scenes themselves.
    ///
    /// # Errors
    ///
    /// Returns [`PictureError::Budget`] if the budget is too small.
    pub fn check_budget(&self, n_scenes: usize) -> Result<(), PictureError> {
        let needed = self.image_bytes(n_scenes);
        PictureError::check_budget(needed.saturating_add(pixel_bytes(self.size)), self.budget)
    }

    /// Returns the total size of the images of `n_scenes` scenes, in bytes.
    fn image_bytes(&self, n_scenes: usize) -> u64 {
        (4 * self.n_pixels()).saturating_mul(n_scenes as u64)
    }

    /// Returns the extent of a scene. To draw several scenes at the same scale with only one scene in memory at a time,
    /// join their extents first.
    ///
    /// # Errors
    ///
    /// Returns [`PictureError::Camera`] if a camera is invalid.
    pub fn extent(&self, subject: Subject) -> Result<Extent, PictureError> {
        let mut points = Vec::new();
        for camera in self.cameras {
            let each = |each: &mut dyn FnMut(DVec3)| subject.drawing.each_point(each);
            points.extend(camera.extreme_points(&each, self.size)?);
        }
        let scale = subject.scale;
        Ok(Extent { points, scale })
    }

    /// Draws scenes side by side at the same scale, each with its caption. Returns one image or, if
    /// [`frames`](Self::frames) is above 1, the images of an animation in which the camera turns around the scenes.
    ///
    /// A [`Camera::Fit`] shows the whole extent `within`. If `within` is `None`, the camera shows all scenes.
    ///
    /// # Errors
    ///
    /// Returns [`PictureError::Budget`] if the budget is too small, and [`PictureError::Camera`] if a camera is
    /// invalid. Returns [`PictureError::Cancelled`] if the listener cancels the work. Returns [`PictureError::Size`] if
    /// the views side by side are too large for one image. The budget is checked before anything is drawn.
    pub fn draw(
        &self,
        subjects: &[Subject],
        within: Option<&Extent>,
        progress: &dyn Progress,
    ) -> Result<Vec<Image>, PictureError> {
        self.check_budget(subjects.len())?;
        let points = |each: &mut dyn FnMut(DVec3)| match within {
            Some(extent) => extent.points.iter().for_each(|&p| each(p)),
            None => subjects.iter().for_each(|s| s.drawing.each_point(each)),
        };
        let mut frames = Vec::new();
        for frame in 0..self.frames {
            let turn = 360.0 * f64::from(frame) / f64::from(self.frames);
            let views = self.cameras.iter().map(|camera| {
                let camera = if self.frames > 1 {
                    camera.turned(turn, &points)
                } else {
                    *camera
                };
                View::new(&camera, &points, self.size)
            });
            frames.push(views.collect::<Result<Vec<_>, _>>()?);
        }
        let look = self.style.look();
        let render_bytes = |view: &View| {
            let bytes = |s: &Subject| bytes_needed(&s.drawing, view, self.size, &look);
            subjects.iter().map(bytes).max().unwrap_or(0)
        };
        let max_render_bytes = frames.iter().flatten().map(render_bytes).max().unwrap_or(0);
        let needed = self.image_bytes(subjects.len());
        PictureError::check_budget(needed.saturating_add(max_render_bytes), self.budget)?;
        let total = u64::from(self.frames) * (self.cameras.len() * subjects.len()) as u64;
        let mut done = 0;
        let mut all_views = Vec::new();
        for frame in &frames {
            let mut views = Vec::new();
            for view in frame {
                for subject in subjects {
                    let progress = ViewProgress {
                        parent: progress,
                        done,
                        total,
                    };
                    views.push((self.view(subject, view, &progress)?, subject));
                    done += 1;
                }
            }
            all_views.push(views);
        }
        self.draw_legends(&mut all_views);
        (all_views.into_iter())
            .map(|views| self.side_by_side(views, subjects.len()))
            .collect()
    }

    /// Draws the legend of each view. All legends are in the same corner: the corner in which they cover the fewest
    /// pixels of the scenes.
    fn draw_legends(&self, all_views: &mut [Vec<(Image, &Subject)>]) {
        let scale = (f64::from(self.size[1]) / 720.0).clamp(0.5, 8.0);
        let background = self.style.background.srgb();
        let mut images = Vec::new();
        for (image, subject) in all_views.iter_mut().flatten() {
            if let Some(legend) = subject.scale.as_ref().and_then(ColorScale::legend) {
                images.push((image, legend));
            }
        }
        let covered = |corner: &Corner| -> usize {
            (images.iter())
                .map(|(image, legend)| covered_pixels(image, legend, *corner, scale, background))
                .sum()
        };
        // If several corners are equally good, the first of them is chosen.
        let corner = Corner::ALL.into_iter().min_by_key(covered);
        for (image, legend) in images {
            draw_legend(image, &legend, corner.unwrap_or_default(), scale);
        }
    }

    /// Draws one view, with labels.
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
            .map(|(label, placed)| Label::new(placed.at, &*label.text, FONT_SIZE, TEXT_COLOR))
            .collect();
        draw_labels(&mut image, &labels);
        Ok(image)
    }

    /// Places views in rows, on the background of the style.
    fn side_by_side(
        &self,
        mut views: Vec<(Image, &Subject)>,
        n_scenes: usize,
    ) -> Result<Image, PictureError> {
        if let [(_, Subject { caption: "", .. })] = views[..] {
            return Ok(views.remove(0).0);
        }
        let cells: Vec<Cell> = (views.iter())
            .map(|(image, subject)| Cell {
                image,
                caption: subject.caption,
            })
            .collect();
        let default = if n_scenes > 1 {
            n_scenes
        } else {
            views.len().min(4)
        };
        let style = SheetStyle {
            columns: self.columns.map_or(default, |n| n as usize),
            gap: 0,
            font_size: caption_size(self.size),
            background: self.style.background.srgb(),
            ..SheetStyle::default()
        };
        sheet(&cells, &style, self.budget)
    }
}

/// Returns the font size of captions below views of this size, in pixels. The font size is 14 for views that are at
/// most 480 pixels high, and proportional to the height for higher views.
fn caption_size([_, height]: [u32; 2]) -> u32 {
    (height.saturating_mul(7) / 240).max(SheetStyle::default().font_size)
}

/// Converts the progress of one view to the progress of all views.
struct ViewProgress<'a> {
    parent: &'a dyn Progress,
    /// The number of completed views.
    done: u64,
    /// The number of all views.
    total: u64,
}

impl Progress for ViewProgress<'_> {
    fn advance(&self, what: &str, done: u64, total: u64) -> bool {
        let step = STEPS * done / total.max(1);
        self.parent
            .advance(what, STEPS * self.done + step, STEPS * self.total)
    }
}
