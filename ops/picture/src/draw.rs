//! From a scene to images.

use std::borrow::Cow;
use std::path::{Component, Path};

use op::{Context, Files, OpError};
use render::figure::label::{Label, draw_labels};
use render::figure::legend::{Corner, draw_legend};
use render::sheet::{Cell, SheetStyle, sheet};
use render::{Camera, Drawing, Image, PictureError, View, build, bytes_needed, render};
use scene::Scene;

use crate::Picture;
use crate::numbers::Numbers;
use crate::overlays;

/// Ink of numbers beside elements, in sRGB.
const INK: [u8; 4] = [0x1f, 0x29, 0x37, 255];

/// The height of the numbers beside elements, in pixels.
const LETTERS: f64 = 13.0;

impl Picture {
    /// The pixels of all images together.
    pub(crate) fn n_pixels(&self) -> u64 {
        let [width, height] = self.size.map(u64::from);
        let frames = self.turntable.map_or(1, |turn| u64::from(turn.frames));
        width * height * self.cameras().len() as u64 * frames
    }
}

/// Draws the images of a picture whose parameters are in order.
pub(crate) fn images(
    picture: &Picture,
    scene: &Scene,
    cx: &mut Context,
) -> Result<(Vec<Image>, Vec<String>), OpError> {
    let n_frames = picture.turntable.map_or(1, |turn| turn.frames);
    let total = u64::from(n_frames) * picture.cameras().len() as u64;
    cx.advance("draw", 0, total)?;
    let scene = chosen(scene, cx.on);
    let numbers = picture.color_by.as_ref();
    let numbers = numbers.map(|by| by.numbers(&scene, cx)).transpose()?;
    let overlays = overlays::of(picture, &scene, numbers.as_ref(), cx)?;
    let folder = picture.images.as_deref();
    let mut images = |path: &str| read_image(cx.files(), folder, path);
    let (drawing, missing) = build(&scene, &picture.style, &overlays, &mut images).map_err(told)?;

    let look = picture.style.look();
    let all = 4 * picture.n_pixels();
    let needed = all.saturating_add(bytes_needed(&drawing, picture.size, &look));
    if needed > cx.budget {
        return Err(told(PictureError::Budget {
            needed,
            budget: cx.budget,
        }));
    }
    let mut frames = Vec::new();
    let mut done = 0;
    for frame in 0..n_frames {
        let mut views = Vec::new();
        for camera in picture.cameras() {
            let camera = if n_frames > 1 {
                camera.turned(360.0 * f64::from(frame) / f64::from(n_frames))
            } else {
                *camera
            };
            views.push(view(picture, &drawing, &camera, numbers.as_ref()).map_err(told)?);
            done += 1;
            cx.advance("draw", done, total)?;
        }
        frames.push(side_by_side(picture, views, cx.budget).map_err(told)?);
    }
    let mut notes: Vec<String> = missing
        .into_iter()
        .map(|why| format!("an image of a material is not shown: {why}"))
        .collect();
    notes.dedup();
    Ok((frames, notes))
}

/// The objects that the step was told to act on.
fn chosen<'s>(scene: &'s Scene, on: Option<&[String]>) -> Cow<'s, Scene> {
    let Some(on) = on else {
        return Cow::Borrowed(scene);
    };
    let mut chosen = Scene::new();
    for object in scene.objects() {
        if on.contains(&object.name) {
            chosen.insert(object.clone()).expect("names are unique");
        }
    }
    Cow::Owned(chosen)
}

fn view(
    picture: &Picture,
    drawing: &Drawing,
    camera: &Camera,
    numbers: Option<&Numbers>,
) -> Result<Image, PictureError> {
    let view = View::new(camera, &|each| drawing.each_point(each), picture.size)?;
    let rendered = render(drawing, &view, picture.size, &picture.style.look())?;
    let mut image = rendered.image;
    let labels: Vec<Label> = (drawing.labels.iter().zip(&rendered.labels))
        .filter_map(|(label, placed)| Some((label, placed.filter(|p| !p.is_hidden)?)))
        .map(|(label, placed)| Label::new(placed.at, &*label.text, LETTERS, INK))
        .collect();
    draw_labels(&mut image, &labels)?;
    if let Some(legend) = numbers.and_then(Numbers::legend) {
        // As large as letters are in a picture of usual size.
        let scale = (f64::from(picture.size[1]) / 720.0).clamp(0.5, 8.0);
        draw_legend(&mut image, &legend, Corner::TopRight, scale)?;
    }
    Ok(image)
}

/// Views in rows, on the background of the picture.
fn side_by_side(
    picture: &Picture,
    mut views: Vec<Image>,
    budget: u64,
) -> Result<Image, PictureError> {
    if views.len() == 1 {
        return Ok(views.remove(0));
    }
    let cells: Vec<Cell> = views
        .iter()
        .map(|image| Cell { image, caption: "" })
        .collect();
    let style = SheetStyle {
        columns: picture.columns.map_or(views.len().min(4), |n| n as usize),
        gap: 0,
        background: picture.style.background.srgb(),
        ..SheetStyle::default()
    };
    sheet(&cells, &style, budget)
}

/// The bytes of an image that a material names, if it is a file in the folder or in a folder in it.
fn read_image(files: &Files, folder: Option<&str>, path: &str) -> Option<Vec<u8>> {
    let is_inside = |c: Component| matches!(c, Component::Normal(_) | Component::CurDir);
    if path.contains("://") || !Path::new(path).components().all(is_inside) {
        return None;
    }
    let full = match folder {
        Some(folder) => files.to_read(&format!("{folder}/{path}")),
        None => files.to_read(path),
    };
    files.has_read(&full);
    std::fs::read(full).ok()
}

pub(crate) fn told(error: PictureError) -> OpError {
    match error {
        PictureError::Budget { .. } => OpError::Budget(error.to_string()),
        error => OpError::Parameter(error.to_string()),
    }
}
