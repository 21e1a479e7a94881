//! From scenes to images.

use std::borrow::Cow;
use std::path::{Component, Path};

use glam::DVec3;
use op::{Context, Files, OpError};
use render::figure::label::{Label, draw_labels};
use render::figure::legend::{Corner, Legend, draw_legend};
use render::sheet::{Cell, SheetStyle, sheet};
use render::{Drawing, GoOn, Image, Overlays, PictureError, View, build, bytes_needed, render};
use scene::Scene;

use crate::picture::Picture;
use crate::picture::numbers::{Numbers, Shown};
use crate::picture::overlays;

/// Ink of numbers beside elements, in sRGB.
const INK: [u8; 4] = [0x1f, 0x29, 0x37, 255];

/// The height of the numbers beside elements, in pixels.
const LETTERS: f64 = 13.0;

/// Steps in which the progress of an image is told.
pub(crate) const PARTS: u64 = 1000;

/// The steps that are done where this part of an image is, from 0 to 1.
pub(crate) fn parts(part: f64) -> u64 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "from 0 to 1000"
    )]
    let parts = (part.clamp(0.0, 1.0) * 1000.0) as u64;
    parts
}

impl Picture {
    /// The pixels of all images of a scene together.
    pub(crate) fn n_pixels(&self) -> u64 {
        let [width, height] = self.size.map(u64::from);
        let frames = self.turntable.map_or(1, |turn| u64::from(turn.frames));
        width * height * self.cameras().len() as u64 * frames
    }
}

/// A scene that is ready to be drawn.
struct Ready<'s> {
    drawing: Drawing<'s>,
    numbers: Option<Numbers>,
    caption: &'s str,
}

/// What a scene takes of a picture: pictures of several scenes [within](Picture::draw_within) what all of them take
/// [together](Self::join) show the same place in the same scale, and the same numbers in the same colors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Extent {
    /// Points that decide where cameras are that fit.
    points: Vec<DVec3>,
    /// What their colors mean, if numbers are shown.
    shown: Option<Shown>,
}

impl Extent {
    /// Takes what another scene takes in, too.
    pub fn join(&mut self, other: Self) {
        self.points.extend(other.points);
        match (&mut self.shown, other.shown) {
            (Some(shown), Some(other)) => shown.join(&other),
            (none, other) => *none = none.take().or(other),
        }
    }

    /// The numbers of the first and the last color, if numbers are shown.
    pub(crate) fn range(&self) -> Option<[f64; 2]> {
        self.shown.as_ref().map(|shown| shown.range)
    }

    /// What the colors of numbers mean in all of them, if numbers are shown and the picture says it.
    pub fn legend(&self) -> Option<Legend> {
        self.shown.as_ref().and_then(Shown::legend)
    }
}

/// What a scene takes of a picture whose parameters are in order.
pub(crate) fn extent(
    picture: &Picture,
    scene: &Scene,
    cx: &mut Context,
) -> Result<Extent, OpError> {
    let scene = chosen(scene, cx.on);
    // Images of materials change nothing of where things are.
    let (drawing, numbers) = prepare(
        picture,
        &scene,
        &Overlays::default(),
        &mut |_, _| None,
        cx,
        &mut Vec::new(),
    )?;
    let mut points = Vec::new();
    for camera in picture.cameras() {
        let each = |each: &mut dyn FnMut(DVec3)| drawing.each_point(each);
        points.extend(camera.decisive(&each, picture.size).map_err(told)?);
    }
    let shown = numbers.map(|n| n.shown);
    Ok(Extent { points, shown })
}

/// What decides of a picture beside its parameters.
#[derive(Default)]
pub(crate) struct Further<'a> {
    /// What cameras that fit see; unless told otherwise the scenes that are drawn.
    pub(crate) within: Option<&'a Extent>,
    /// What is shown beside what the picture shows.
    pub(crate) overlays: Overlays,
}

/// Draws scenes side by side, each with what is written below it, in the same scale. The parameters of the picture
/// are in order.
pub(crate) fn images(
    picture: &Picture,
    scenes: &[(&Scene, &str)],
    further: &Further,
    cx: &mut Context,
) -> Result<(Vec<Image>, Vec<String>), OpError> {
    let n_frames = picture.turntable.map_or(1, |turn| turn.frames);
    let total = u64::from(n_frames) * (picture.cameras().len() * scenes.len()) as u64;
    cx.advance("draw", 0, PARTS * total)?;
    let chosen: Vec<_> = scenes
        .iter()
        .map(|(scene, _)| chosen(scene, cx.on))
        .collect();
    let mut ready = Vec::new();
    let mut notes = Vec::new();
    for (scene, &(_, caption)) in chosen.iter().zip(scenes) {
        let folder = picture.images.as_deref();
        let mut images = |files: &Files, path: &str| read_image(files, folder, path);
        let overlays = &further.overlays;
        let (drawing, numbers) = prepare(picture, scene, overlays, &mut images, cx, &mut notes)?;
        ready.push(Ready {
            drawing,
            numbers,
            caption,
        });
    }
    notes.dedup();

    let look = picture.style.look();
    let drawn = |r: &Ready| bytes_needed(&r.drawing, picture.size, &look);
    let all = 4 * picture.n_pixels() * scenes.len() as u64;
    let needed = all.saturating_add(ready.iter().map(drawn).max().unwrap_or(0));
    if needed > cx.budget {
        let budget = cx.budget;
        return Err(told(PictureError::Budget { needed, budget }));
    }
    let mut frames = Vec::new();
    let mut done = 0;
    for frame in 0..n_frames {
        let turn = 360.0 * f64::from(frame) / f64::from(n_frames);
        let mut views = Vec::new();
        for camera in picture.cameras() {
            let camera = if n_frames > 1 {
                camera.turned(turn)
            } else {
                *camera
            };
            let points = |each: &mut dyn FnMut(DVec3)| match further.within {
                Some(extent) => extent.points.iter().for_each(|&p| each(p)),
                None => ready.iter().for_each(|r| r.drawing.each_point(each)),
            };
            let view = View::new(&camera, &points, picture.size).map_err(told)?;
            for r in &ready {
                let go_on = |part: f64| {
                    let parts = PARTS * done + parts(part);
                    cx.advance("draw", parts, PARTS * total).is_ok()
                };
                let image = draw(picture, r, &view, &go_on).map_err(told)?;
                views.push((image, r.caption));
                done += 1;
                cx.advance("draw", PARTS * done, PARTS * total)?;
            }
        }
        frames.push(side_by_side(picture, views, scenes.len(), cx.budget).map_err(told)?);
    }
    Ok((frames, notes))
}

fn prepare<'s>(
    picture: &Picture,
    scene: &'s Scene,
    further: &Overlays,
    images: &mut dyn FnMut(&Files, &str) -> Option<Vec<u8>>,
    cx: &mut Context,
    notes: &mut Vec<String>,
) -> Result<(Drawing<'s>, Option<Numbers>), OpError> {
    let numbers = picture.color_by.as_ref();
    let numbers = numbers.map(|by| by.numbers(scene, cx)).transpose()?;
    let mut overlays = overlays::of(picture, scene, numbers.as_ref(), cx)?;
    overlays.highlights.extend_from_slice(&further.highlights);
    overlays.strokes.extend_from_slice(&further.strokes);
    overlays.labels.extend_from_slice(&further.labels);
    notes.extend(overlays::unmarked(picture, scene));
    let mut images = |path: &str| images(cx.files(), path);
    let (drawing, missing) = build(scene, &picture.style, &overlays, &mut images).map_err(told)?;
    let note = |why| format!("an image of a material is not shown: {why}");
    notes.extend(missing.into_iter().map(note));
    Ok((drawing, numbers))
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

fn draw(picture: &Picture, ready: &Ready, view: &View, go_on: GoOn) -> Result<Image, PictureError> {
    let drawing = &ready.drawing;
    let rendered = render(drawing, view, picture.size, &picture.style.look(), go_on)?;
    let mut image = rendered.image;
    let labels: Vec<Label> = (drawing.labels.iter().zip(&rendered.labels))
        .filter_map(|(label, placed)| Some((label, placed.filter(|p| !p.is_hidden)?)))
        .map(|(label, placed)| Label::new(placed.at, &*label.text, LETTERS, INK))
        .collect();
    draw_labels(&mut image, &labels);
    if let Some(legend) = ready.numbers.as_ref().and_then(|n| n.shown.legend()) {
        // As large as letters are in a picture of usual size.
        let scale = (f64::from(picture.size[1]) / 720.0).clamp(0.5, 8.0);
        draw_legend(&mut image, &legend, Corner::TopRight, scale);
    }
    Ok(image)
}

/// Views in rows, on the background of the picture.
fn side_by_side(
    picture: &Picture,
    mut views: Vec<(Image, &str)>,
    n_scenes: usize,
    budget: u64,
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
        columns: picture.columns.map_or(usual, |n| n as usize),
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
    if files.store.is_file(&full) {
        files.has_read(&full);
        files.store.read(&full).ok()
    } else {
        files.has_looked_for(&full);
        None
    }
}

pub(crate) fn told(error: PictureError) -> OpError {
    match error {
        PictureError::Cancelled => OpError::Cancelled,
        PictureError::Budget { .. } => OpError::Budget(error.to_string()),
        error => OpError::Parameter(error.to_string()),
    }
}
