//! Picture: draws the scene into an image file.
//!
//! ```text
//!   selections, numbers --resolved--> view::Subject --view::Shot--> images --encode--> .png, .apng, .gif
//! ```

mod colors;
#[cfg(test)]
mod tests;

use std::fmt::Display;
use std::path::{Component, Path};

use op::{
    Context, Count, Elements, Files, OpError, Operation, Plan, PlanContext, Problem, Progress,
    Report, Seconds, Selected, target_scene,
};
use render::animation::{Timing, to_apng, to_gif};
use render::{Camera, Color, Image, LARGEST_SIDE, Overlays, PictureError, Style};
use scene::Scene;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use view::{ColorBy, Extent, MARK, Shot, Subject, marked};

/// Draws the scene into an image file below the output folder.
///
/// The ending chooses the format: `.png`; for a turntable `.gif`, or `.apng` or `.png` for a PNG that moves. The
/// file appears when the whole recipe has succeeded; the scene stays as it is. It needs no graphics processor,
/// and gives the same bytes on every machine.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Picture {
    /// The file, seen from the output folder. `{name.stem}` stands for the name, without its ending, of
    /// the file that the parameter `name` of the recipe names.
    pub path: String,
    /// Width and height in pixels, of each view.
    #[serde(default = "size")]
    pub size: [Count<1, LARGEST_SIDE>; 2],
    /// Where the scene is seen from.
    #[serde(default)]
    pub camera: Camera,
    /// Several cameras, in place of `camera`: their views stand side by side.
    #[serde(default)]
    pub views: Vec<Camera>,
    /// How many views stand in a row; unless told otherwise all, at most 4.
    #[serde(default)]
    pub columns: Option<Count<1, 64>>,
    /// How it looks: shading, lines, background.
    #[serde(default)]
    pub style: Style,
    /// Elements that are marked in a strong color, as in `Sharp(above: 30)` or `Faces(Tagged("top"))`.
    #[serde(default)]
    pub highlight: Option<Elements>,
    /// The width of highlighted edges and the diameter of highlighted vertices, in pixels. Unless told otherwise
    /// 2.8 and 7.5 in pictures that are 240 high, 3.4 and 10 at 480, 4 and 13 at 960, 8 and 26 at 1920; vertices
    /// are smaller where they are many. Hidden edges shine through, hidden vertices are rings.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 100.0))]
    pub highlight_width: Option<f64>,
    /// More elements that are marked, each in a color of its own.
    #[serde(default)]
    pub marks: Vec<Mark>,
    /// Numbers that are shown as colors of the surface.
    #[serde(default)]
    pub color_by: Option<ColorBy>,
    /// Makes it an animation in which the camera goes once around the scene.
    #[serde(default)]
    pub turntable: Option<Turntable>,
    /// The folder in which images of materials are looked for, seen from the recipe's folder; without it
    /// the recipe's folder. What is not there is left out, and told.
    #[serde(default)]
    pub images: Option<String>,
}

/// Elements in a color.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Mark {
    /// Which elements.
    pub of: Elements,
    /// Their color.
    #[serde(default = "orange")]
    pub color: Color,
    /// The width of edges and the diameter of vertices, in pixels; unless told otherwise as of highlighted ones.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 100.0))]
    pub width: Option<f64>,
}

/// One turn around the scene.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Turntable {
    /// How many images.
    #[serde(default = "frames")]
    pub frames: Count<2, 720>,
    /// How long a turn takes.
    #[serde(default = "seconds")]
    pub seconds: Seconds,
}

fn size() -> [Count<1, LARGEST_SIDE>; 2] {
    [1280, 960].map(Count::literal)
}

fn orange() -> Color {
    MARK
}

fn frames() -> Count<2, 720> {
    Count::literal(36)
}

fn seconds() -> Seconds {
    Seconds::literal(4.0)
}

/// The formats of pictures.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
enum Format {
    Png,
    Apng,
    Gif,
}

impl Format {
    fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "png" => Some(Self::Png),
            "apng" => Some(Self::Apng),
            "gif" => Some(Self::Gif),
            _ => None,
        }
    }
}

impl Picture {
    /// A picture of this name, with defaults for everything else.
    pub fn new(path: impl Into<String>) -> Self {
        Self {
            path: path.into(),
            size: size(),
            camera: Camera::default(),
            views: Vec::new(),
            columns: None,
            style: Style::default(),
            highlight: None,
            highlight_width: None,
            marks: Vec::new(),
            color_by: None,
            turntable: None,
            images: None,
        }
    }

    /// What is wrong with the parameters, whatever the scene is.
    fn problems(&self) -> Vec<Problem> {
        let mut problems = Vec::new();
        match Format::of(Path::new(&self.path)) {
            None => {
                let message = format!("no format of pictures is known for \"{}\"", self.path);
                let help = "endings that can be written: .png, .apng, .gif";
                problems.push(Problem::error(message).at(["path"]).help(help));
            }
            Some(Format::Apng | Format::Gif) if self.turntable.is_none() => {
                let message = format!("\"{}\" is an animation, but nothing moves", self.path);
                let help = "add `turntable: ()`, or write a .png";
                problems.push(Problem::error(message).at(["path"]).help(help));
            }
            Some(_) => {}
        }
        let style = self.style.check().err().map(|error| (error, "style"));
        let cameras = self.cameras().iter().filter_map(|c| c.check().err());
        for (error, field) in style.into_iter().chain(cameras.map(|e| (e, "camera"))) {
            problems.push(Problem::error(error.to_string()).at([field]));
        }
        problems
    }

    /// The cameras, whichever of the two parameters names them.
    fn cameras(&self) -> &[Camera] {
        if self.views.is_empty() {
            std::slice::from_ref(&self.camera)
        } else {
            &self.views
        }
    }

    /// Draws scenes side by side, in one scale, each with a caption unless that is empty: the images of a turntable,
    /// else one. With an extent, cameras that fit see all of it, and numbers have the colors for all, without a legend,
    /// as that is [the same](Extent::legend) for all. The notes say what is not shown as the scenes have it.
    ///
    /// # Errors
    ///
    /// [`OpError::Parameter`] and [`OpError::File`] for what is wrong with the parameters, [`OpError::Budget`] if
    /// the images need more memory than `cx` allows; those of the selections; [`OpError::Cancelled`].
    pub fn draw(
        &self,
        scenes: &[(&Scene, &str)],
        within: Option<&Extent>,
        cx: &mut Context,
    ) -> Result<(Vec<Image>, Vec<String>), OpError> {
        self.in_order()?;
        let mut color_by = self.color_by.clone();
        if let (Some(color_by), Some(extent)) = (&mut color_by, within) {
            color_by.range = color_by.range.or(extent.range());
            color_by.legend = false;
        }
        cx.advance("draw", 0, 1)?;
        let chosen: Vec<_> = (scenes.iter())
            .map(|(scene, caption)| (target_scene(scene, cx), *caption))
            .collect();
        let (mut subjects, mut notes) = (Vec::new(), Vec::new());
        for (scene, caption) in &chosen {
            let (subject, more) = self.subject(scene, caption, color_by.as_ref(), true, cx)?;
            subjects.push(subject);
            notes.extend(more);
        }
        notes.dedup();
        let shot = self.shot(cx.budget);
        let images = shot.draw(&subjects, within, cx.progress());
        Ok((images.map_err(failed)?, notes))
    }

    /// What a scene takes up of the picture, to draw it beside others that are not in memory with it: see [`Extent`].
    ///
    /// # Errors
    ///
    /// As [`draw`](Self::draw).
    pub fn extent(&self, scene: &Scene, cx: &mut Context) -> Result<Extent, OpError> {
        self.in_order()?;
        let scene = target_scene(scene, cx);
        // Images of materials change nothing of where things are.
        let (subject, _) = self.subject(&scene, "", self.color_by.as_ref(), false, cx)?;
        self.shot(cx.budget).extent(subject).map_err(failed)
    }

    fn shot(&self, budget: u64) -> Shot<'_> {
        Shot {
            size: self.size.map(Count::get),
            cameras: self.cameras(),
            columns: self.columns.map(Count::get),
            style: &self.style,
            frames: self.turntable.map_or(1, |turn| turn.frames.get()),
            budget,
        }
    }

    /// A scene with what is marked in it and its numbers, and notes on what is not shown.
    fn subject<'s>(
        &self,
        scene: &'s Scene,
        caption: &'s str,
        color_by: Option<&ColorBy>,
        has_images: bool,
        cx: &mut Context,
    ) -> Result<(Subject<'s>, Vec<String>), OpError> {
        let numbers = match color_by {
            Some(by) => {
                let others = colors::others(by, cx)?;
                Some(by.numbers(scene, &others).map_err(failed)?)
            }
            None => None,
        };
        let mut overlays = Overlays::default();
        let first = (self.highlight.iter()).map(|of| (of, MARK, self.highlight_width));
        let marks = self.marks.iter().map(|m| (&m.of, m.color, m.width));
        for (of, color, width) in first.chain(marks) {
            for (object, mesh) in scene
                .objects()
                .iter()
                .filter_map(|o| Some((o, o.as_mesh()?)))
            {
                cx.materials = object.materials.iter().map(|m| m.name.clone()).collect();
                let selected = of.resolve(mesh, cx);
                cx.materials.clear();
                let elements = match selected? {
                    Selected::Vertices(list) => render::Elements::Vertices(list),
                    Selected::Edges(list) => render::Elements::Edges(list),
                    Selected::Faces(list) => render::Elements::Faces(list),
                };
                let size = self.size.map(Count::get);
                let marked = marked(&object.name, elements, color, width, size);
                overlays.highlights.push(marked);
            }
        }
        let mut notes: Vec<String> = self.unmarked(scene).into_iter().collect();
        let folder = self.images.as_deref();
        let read = |path: &str| read_image(cx.files(), folder, path);
        let mut images = |path: &str| if has_images { read(path) } else { None };
        let subject = Subject::new(scene, caption, &self.style, overlays, numbers, &mut images);
        let (subject, missing) = subject.map_err(failed)?;
        let note = |why| format!("an image of a material is not shown: {why}");
        notes.extend(missing.into_iter().map(note));
        Ok((subject, notes))
    }

    /// What is said where nothing can be marked.
    fn unmarked(&self, scene: &Scene) -> Option<String> {
        let has_marks = self.highlight.is_some() || !self.marks.is_empty();
        let has_mesh = scene.objects().iter().any(|o| o.as_mesh().is_some());
        (has_marks && !has_mesh && !scene.objects().is_empty()).then(|| {
            "nothing is marked: elements of meshes can be, and there is no mesh here; `style: (points: 8)` \
             shows the points of polylines, and `style: (control_nets: ())` control points"
                .to_owned()
        })
    }

    fn in_order(&self) -> Result<(), OpError> {
        match self.problems().into_iter().next() {
            Some(problem) => Err(OpError::Parameter(problem.message)),
            None => Ok(()),
        }
    }

    /// The images that were drawn as a file of the format that the path names. `stamp` says where it comes from.
    ///
    /// # Errors
    ///
    /// [`PictureError::Encode`] if there is no image, or the images are too large for the format;
    /// [`PictureError::Cancelled`].
    pub fn encode(
        &self,
        images: &[Image],
        stamp: Option<&str>,
        progress: &dyn Progress,
    ) -> Result<Vec<u8>, PictureError> {
        let texts: Vec<(&str, &str)> = stamp.iter().map(|stamp| ("Software", *stamp)).collect();
        let Some(turn) = self.turntable else {
            return match images {
                [image] => image.to_png_with_progress(&texts, progress),
                _ => Err(PictureError::Encode("there is no image".to_owned())),
            };
        };
        let delay = 1000.0 * turn.seconds.get() / f64::from(turn.frames.get());
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "it is held to what 16 bits can say"
        )]
        let delay = delay.round().clamp(1.0, f64::from(u16::MAX)) as u16;
        let timing = Timing { delay, plays: 0 };
        match Format::of(Path::new(&self.path)) {
            Some(Format::Gif) => to_gif(images, timing, stamp, progress),
            _ => to_apng(images, timing, &texts, progress),
        }
    }
}

impl Operation for Picture {
    const NAME: &'static str = "Picture";
    const SUMMARY: &'static str = "Draw the scene into an image file";
    const EXAMPLE: &'static str = r#"Picture(path: "a.png", size: (64, 48), highlight: Edges(Sharp(above: 30)), style: (wireframe: ()))"#;
    const TAKES_ON: bool = true;
    const ATOMIC: bool = true;

    fn plan(&self, plan: &mut Plan, cx: &PlanContext) -> Vec<Problem> {
        let mut problems = self.problems();
        problems.extend(plan.write(cx, &self.path, |_| None));
        if let Some(color_by) = &self.color_by {
            problems.extend(colors::plan(color_by, plan, cx));
        }
        let bytes = 4 * self.shot(cx.budget).n_pixels();
        if bytes > cx.budget {
            let message = format!("the images take {bytes} bytes, over the budget");
            problems.push(Problem::error(message).at(["size"]));
        }
        problems
    }

    fn apply(&self, scene: &mut Scene, cx: &mut Context) -> Result<Report, OpError> {
        let of_file = |error: &dyn Display| OpError::File(error.to_string());
        let path = cx.files().to_write(&self.path).map_err(|e| of_file(&e))?;
        let (images, notes) = self.draw(&[(scene, "")], None, cx)?;
        let stamp = cx.files().provenance.clone();
        let bytes = self.encode(&images, stamp.as_deref(), cx.progress());
        let bytes = bytes.map_err(failed)?;
        let store = &cx.files().store;
        store.write(&path, &bytes).map_err(|e| of_file(&e))?;
        Ok(Report {
            notes,
            ..Report::default()
        })
    }
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
        files.has_checked_existence(&full);
        None
    }
}

fn failed(error: PictureError) -> OpError {
    match error {
        PictureError::Cancelled => OpError::Cancelled,
        PictureError::Budget { .. } => OpError::Budget(error.to_string()),
        error => OpError::Parameter(error.to_string()),
    }
}
